//! C and G: tolerances and steps; numbers, emptiness, many parts.

use crate::case::{Case, case};
use crate::lab::Lab;
use crate::scenes::{apart, ball, corners, cotton, del, even, lying, top, unequal, upright};
use crate::support::draped::Draped;
use crate::support::mesh::Mesh;
use crate::support::trial::Trial;
use toile_garment::Vec3;

pub fn cases() -> Vec<Case> {
    vec![
        case("C2-accuracies", accuracies).quick().once(),
        case("C3-time-runs-out", out_of_time).quick().once(),
        case("C6-settings-refused", settings).quick().once(),
        case("G2-zero-is-minus-zero", signed_zero).quick().once(),
        case("G2-denormals", denormals).quick().once(),
        case("G3-gravity-0", weightless).quick(),
        case("G3-gravity-1e3", heavy).quick(),
        case("G3-gravity-nan", gravity).quick().once(),
        case("G4-nothing-there", nothing).quick().once(),
        case("G5-one-triangle", |lab: &mut Lab| tiny(lab, 1)).quick(),
        case("G5-two-triangles", |lab: &mut Lab| tiny(lab, 2)).quick(),
        case("G6-forty-parts", parts),
        case("G9-100000-bad-triangles", flood).quick().once(),
        case("G-falls-unheld", unheld).quick().once(),
    ]
}

fn hung() -> Trial {
    let cloth = upright(del(0.2, 0.025));
    let held = corners(&cloth);
    Trial::new(cloth, cotton()).hold(held)
}

/// The finer, the nearer to the reference, in energy; each says what it reached.
fn accuracies(lab: &mut Lab) -> Result<(), String> {
    let cloth = upright(del(0.2, 0.025));
    let held = top(&cloth);
    let one = Trial::new(cloth, cotton()).hold(held);
    let best = lab.settles(&one.clone().set("accuracy = \"reference\""))?;
    let mut errors = Vec::new();
    for name in ["draft", "normal", "fine"] {
        let d = lab.settles(&one.clone().set(&format!("accuracy = \"{name}\"")))?;
        errors.push(apart(&d.at, &best.at));
    }
    // Lengths that rounding to single precision may hide.
    lab.expect(errors.windows(2).all(|e| e[1] <= e[0] + 1e-6), format!("errors {errors:?} m"));
    lab.below("error of normal m", errors[1], 1e-3);
    Ok(())
}

/// So many triangles without area in the cloth and in the body: one finding each with the number of them and the first
/// five, and the drape is what it is without them.
fn flood(lab: &mut Lab) -> Result<(), String> {
    let one = Trial::new(lying(del(0.2, 0.04), 0.052), cotton()).over(ball(0.05, Vec3::zeros(), 2));
    let d = lab.settles(&one)?;
    let bad = |m: &Mesh, line: &str| format!("{}{}", m.obj(), line.repeat(100_000));
    let ball = one.body.as_ref().ok_or("a body")?;
    let trial =
        one.clone().text("cloth.obj", bad(&one.cloth, "f 1/1 1/1 2/2\n")).text("body.obj", bad(ball, "f 1 2 2\n"));
    let run = lab.run(&trial, &[])?;
    let e = Draped::read(&run)?;
    lab.expect(d.at == e.at, format!("another rest, by {:.1e} m", apart(&d.at, &e.at)));
    lab.expect(run.findings().count() == 2, format!("{} findings", run.findings().count()));
    for (code, n) in [("triangles-flat", one.cloth.triangles.len()), ("body-triangles-flat", ball.triangles.len())] {
        let found = run.findings().find(|f| f["code"] == code).and_then(|f| f["message"].as_str()).unwrap_or_default();
        let first = format!("{}, {}, {}, {}, {}, …", n + 1, n + 2, n + 3, n + 4, n + 5);
        let told = found.contains(": 100000 ") && found.ends_with(&first) && found.lines().count() == 1;
        lab.expect(told, format!("`{code}` does not say how many and which: {found}"));
    }
    lab.below("bytes said", run.said.len() as f64, 1000.0);
    Ok(())
}

/// Too little time: unfinished, said so, and nothing crosses.
fn out_of_time(lab: &mut Lab) -> Result<(), String> {
    let trial = Trial::new(lying(del(0.3, 0.03), 0.102), cotton()).over(ball(0.1, Vec3::zeros(), 3));
    let trial = trial.set("integrator = \"central-difference\"").set("max_time = \"0.02 s\"");
    let run = lab.run(&trial, &[])?;
    lab.expect(run.code == 1, format!("exit code {}", run.code));
    lab.expect(run.findings().any(|f| f["code"] == "drape-not-settled"), "no word that it is unfinished");
    let c = Draped::read(&run)?.certificate;
    let crossings = [&c["self_crossings"], &c["body_crossings"]];
    lab.expect(crossings.iter().all(|n| **n == 0) && c["passed"] == false, format!("certificate {c}"));
    Ok(())
}

/// Settings that mean nothing are refused.
fn settings(lab: &mut Lab) -> Result<(), String> {
    for (key, code) in [
        ("max_time = \"0 s\"", 2),
        ("max_time = \"-1 s\"", 2),
        ("max_time = \"nan s\"", 2),
        ("body_gap = \"0 mm\"", 2),
        ("body_gap = \"1 m\"", 2),
        ("body_gap = \"-1 mm\"", 2),
        ("accuracy = \"1e-12\"", 2),
    ] {
        let run = lab.run(&hung().set(key), &[])?;
        lab.expect(run.code == code, format!("{key}: exit code {} instead of {code}", run.code));
    }
    for key in [
        "step = \"0 s\"",
        "step = \"-1 ms\"",
        "step = \"nan s\"",
        "step = \"1e-12 s\"",
        "frames = 4294967295",
        "fps = 0.0",
    ] {
        let mut trial = hung();
        trial.stages = format!("[[stage]]\nuse = \"animate\"\nwith.{key}\n");
        let run = lab.run(&trial, &[])?;
        lab.expect(run.code == 2, format!("animate, {key}: exit code {} instead of 2: {}", run.code, run.said));
    }
    Ok(())
}

/// The same bits whether a zero has a sign or not.
fn signed_zero(lab: &mut Lab) -> Result<(), String> {
    let plain = hung();
    let mut signed = plain.clone();
    for c in signed.cloth.at.iter_mut().flat_map(|p| p.iter_mut()).filter(|c| **c == 0.0) {
        *c = -0.0;
    }
    signed.cloth.rest.iter_mut().flatten().filter(|c| **c == 0.0).for_each(|c| *c = -0.0);
    let (d, e) = (lab.settles(&plain)?, lab.settles(&signed)?);
    lab.expect(unequal(&d.at, &e.at, |p| p) == 0, "other bits");
    Ok(())
}

/// Numbers near the smallest ones count as nothing.
fn denormals(lab: &mut Lab) -> Result<(), String> {
    let plain = hung();
    let mut small = plain.clone();
    for (i, p) in small.cloth.at.iter_mut().enumerate().filter(|(_, p)| p.y == 0.0) {
        p.y = if i % 2 == 0 { 1e-320 } else { -1e-320 };
    }
    let (d, e) = (lab.settles(&plain)?, lab.settles(&small)?);
    lab.below("off by m", apart(&d.at, &e.at), 1e-6);
    Ok(())
}

/// Without weight nothing moves.
fn weightless(lab: &mut Lab) -> Result<(), String> {
    let trial = hung().weightless();
    let d = lab.settles_as_is(&trial)?;
    // The export rounds to single precision.
    lab.below("moved m", apart(&d.at, &trial.cloth.at), 2e-8);
    Ok(())
}

fn heavy(lab: &mut Lab) -> Result<(), String> {
    let mut trial = Trial { gravity: 1e3, ..hung() };
    trial.fabric.limit = 2.0;
    lab.settles(&trial)?;
    Ok(())
}

fn gravity(lab: &mut Lab) -> Result<(), String> {
    for gravity in [f64::NAN, f64::INFINITY] {
        let run = lab.run(&Trial { gravity, ..hung() }, &[])?;
        lab.expect(run.code == 2, format!("gravity {gravity}: exit code {}", run.code));
    }
    let run = lab.run(&Trial { gravity: 1e9, ..hung() }, &[])?;
    lab.expect(run.code == 2 || run.code == 3, format!("gravity 1e9: exit code {}", run.code));
    Ok(())
}

/// No cloth, no body in the file, no file.
fn nothing(lab: &mut Lab) -> Result<(), String> {
    let plain = Trial::new(lying(even(0.1, 0.1, 0.05), 0.11), cotton()).over(ball(0.1, Vec3::zeros(), 1));
    lab.refuses(&plain.clone().text("cloth.obj", String::new()), 3, "obj-empty")?;
    lab.refuses(&plain.clone().text("cloth.obj", "v 0 0 0\n".to_owned()), 3, "obj-empty")?;
    lab.refuses(&plain.clone().text("body.obj", String::new()), 3, "obj-empty")?;
    lab.refuses(&plain.text("fabric.toml", String::new()), 3, "fabric-value-missing")
}

/// One or two triangles held by a corner.
fn tiny(lab: &mut Lab, count: usize) -> Result<(), String> {
    let mut cloth = upright(even(0.1, 0.1, 0.1));
    cloth.triangles.truncate(count);
    if count == 1 {
        cloth.rest.pop();
        cloth.at.pop();
        let used: Vec<usize> = cloth.triangles[0].to_vec();
        let pick = |m: &Mesh| used.iter().map(|v| (m.at[*v], m.rest[*v])).collect::<Vec<_>>();
        let kept = if used.iter().any(|v| *v >= cloth.at.len()) {
            return Err("the square is cut otherwise".into());
        } else {
            pick(&cloth)
        };
        cloth = Mesh {
            at: kept.iter().map(|k| k.0).collect(),
            rest: kept.iter().map(|k| k.1).collect(),
            triangles: vec![[0, 1, 2]],
        };
    }
    lab.settles(&Trial::new(cloth, cotton()).hold([0]))?;
    Ok(())
}

/// Forty loose squares of which two touch a ball: these two lie as they do alone, bit for bit.
fn parts(lab: &mut Lab) -> Result<(), String> {
    let patch = |x: f64, y: f64, z: f64| {
        let m = lying(even(0.06, 0.06, 0.03), z);
        Mesh { at: m.at.iter().map(|p| p + Vec3::new(x, y, 0.0)).collect(), ..m }
    };
    let mut cloth = Mesh::default();
    let mut held = Vec::new();
    for (x, z) in [(-0.05, 0.11), (0.05, 0.11)] {
        held.push(cloth.join(&patch(x, 0.0, z)));
    }
    let alone = Trial::new(cloth.clone(), cotton()).over(ball(0.1, Vec3::zeros(), 3)).hold(held.clone());
    for k in 0..38 {
        held.push(cloth.join(&patch(0.1 * f64::from(k % 8), 0.5 + 0.1 * f64::from(k / 8), 0.0)));
    }
    let all = Trial::new(cloth, cotton()).over(ball(0.1, Vec3::zeros(), 3)).hold(held);
    let (d, e) = (lab.settles(&alone)?, lab.settles(&all)?);
    let n = d.at.len();
    let off = apart(&d.at, &e.at[..n]);
    lab.expect(d.at[..] == e.at[..n], format!("the two lie otherwise, by up to {off:.1e} m"));
    Ok(())
}

/// Held by nothing: told, not taken for rest.
fn unheld(lab: &mut Lab) -> Result<(), String> {
    let run = lab.run(&Trial::new(lying(even(0.2, 0.2, 0.05), 0.0), cotton()), &[])?;
    lab.expect(run.code == 1 || run.code == 4, format!("exit code {}", run.code));
    let said = run.findings().any(|f| f["code"] == "drape-not-settled" && f["message"].to_string().contains("holds"));
    lab.expect(said, "no word that nothing holds it");
    Ok(())
}
