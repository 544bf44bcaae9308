//! A: degenerate meshes and pieces.

use crate::case::{Case, case};
use crate::lab::Lab;
use crate::pattern::{Drawn, Pattern};
use crate::scenes::{apart, corners, cotton, even, sag, top, upright};
use crate::support::cloth::Cloth;
use crate::support::draped::Draped;
use crate::support::mesh::Mesh;
use crate::support::trial::Trial;
use toile_garment::Vec3;

pub fn cases() -> Vec<Case> {
    // A shaken start moves more than the narrow columns are wide: these run once.
    vec![
        case("A1-column-of-200um", |lab: &mut Lab| squeezed(lab, 1e-2)).quick(),
        case("A1-column-of-20um", |lab: &mut Lab| squeezed(lab, 1e-3)).quick().once(),
        case("A1-column-of-2um", |lab: &mut Lab| squeezed(lab, 1e-4)).quick().once(),
        case("A2-column-of-20nm", |lab: &mut Lab| squeezed(lab, 1e-6)).quick().once(),
        case("A2-needle-179.99deg", needle).quick(),
        case("A3-flat-triangles", flat).quick().once(),
        case("A4-vertices-twice", |lab: &mut Lab| twice(lab, 0.0)).quick().once(),
        case("A4-vertices-1nm-apart", |lab: &mut Lab| twice(lab, 1e-9)).quick().once(),
        case("A5-t-junction", junction).quick().once(),
        case("A6-loose-vertices", loose).quick().once(),
        case("A7-three-on-an-edge", fin).quick(),
        case("A8-wound-backwards", |lab: &mut Lab| wound(lab, 1)).quick().once(),
        case("A8-half-wound-backwards", |lab: &mut Lab| wound(lab, 2)).quick().once(),
        case("A10-outlines-refused", outlines).quick().once(),
        case("A10-spike-of-0.01mm", spiked).quick().once(),
        case("A12-strip-of-0.2mm", |lab: &mut Lab| {
            meshed(lab, &[[0.0, 0.0], [300.0, 0.0], [300.0, 0.2], [0.0, 0.2]], 10.0)
        })
        .quick()
        .once(),
        case("A13-corner-of-0.5deg", |lab: &mut Lab| meshed(lab, &[[0.0, 0.0], [300.0, 0.0], [300.0, 2.618]], 5.0))
            .quick()
            .once(),
        case("A14-too-many-triangles", too_many).quick().once(),
        case("A15-graded-200-to-1", graded).quick(),
        case("A16-thicker-than-edges", thick).quick(),
    ]
}

fn hung(cloth: Mesh) -> Trial {
    let held = corners(&cloth);
    Trial::new(cloth, cotton()).hold(held)
}

/// A clean sheet of 300 mm, hung by two corners.
fn clean(lab: &mut Lab) -> Result<Draped, String> {
    let trial = hung(upright(even(0.3, 0.3, 0.02)));
    lab.settles(&trial)
}

/// One column of triangles so narrow.
fn squeezed(lab: &mut Lab, aspect: f64) -> Result<(), String> {
    let wanted = sag(&clean(lab)?.at);
    let mut cloth = even(0.3, 0.3, 0.02);
    // The lines at 140 and 160 mm move together; their neighbours stay.
    for r in cloth.rest.iter_mut().filter(|r| (r[0] - 0.14).abs() < 1e-6) {
        r[0] = 0.16 - 0.02 * aspect;
    }
    let trial = hung(upright(cloth));
    // At an aspect of 1e-4 the cloth is to be draped; past that it may be refused.
    if aspect > 1e-5 {
        let d = lab.settles(&trial)?;
        lab.near("sag m", sag(&d.at), wanted, 0.02);
    } else if let Some(d) = lab.settles_or_refuses(&trial, "flat-triangle")? {
        lab.near("sag m", sag(&d.at), wanted, 0.02);
    }
    Ok(())
}

/// A vertex moved next to the opposite edge of a triangle.
fn needle(lab: &mut Lab) -> Result<(), String> {
    let wanted = sag(&clean(lab)?.at);
    let mut cloth = even(0.3, 0.3, 0.02);
    let v = cloth.pick(|[u, w]| (u - 0.14).abs() < 1e-6 && (w - 0.14).abs() < 1e-6)[0];
    // On the diagonal through it 179.99° remain.
    cloth.rest[v] = [cloth.rest[v][0] + 0.01 - 8.7e-7, cloth.rest[v][1] + 0.01 - 8.7e-7];
    let trial = hung(upright(cloth));
    if let Some(d) = lab.settles_or_refuses(&trial, "flat-triangle")? {
        lab.near("sag m", sag(&d.at), wanted, 0.02);
    }
    Ok(())
}

/// A triangle of three points in a line, and one with a doubled corner, change nothing.
fn flat(lab: &mut Lab) -> Result<(), String> {
    let one = hung(upright(even(0.3, 0.3, 0.02)));
    let d = lab.settles(&one)?;
    let more = format!("{}f 1/1 2/2 3/3\nf 5/5 5/5 6/6\n", one.cloth.obj());
    let run = lab.run(&one.clone().text("cloth.obj", more), &[])?;
    let e = Draped::read(&run)?;
    lab.expect(run.findings().any(|f| f["code"] == "triangles-flat"), "no word about the flat triangles");
    lab.expect(d.at == e.at, format!("another rest, by {:.1e} m", apart(&d.at, &e.at)));
    Ok(())
}

/// Vertices along a line doubled: they are joined, or the message says what to do; the sheet does not tear.
fn twice(lab: &mut Lab, off: f64) -> Result<(), String> {
    let wanted = sag(&clean(lab)?.at);
    let mut cloth = upright(even(0.3, 0.3, 0.02));
    let line = cloth.pick(|[u, _]| (u - 0.14).abs() < 1e-6);
    let mut pairs = Vec::new();
    for v in line {
        let copy = cloth.rest.len();
        pairs.push((v, copy));
        cloth.rest.push([cloth.rest[v][0] + off, cloth.rest[v][1]]);
        cloth.at.push(cloth.at[v] + Vec3::x() * off);
        let rest = cloth.rest.clone();
        for t in &mut cloth.triangles {
            let right = t.iter().any(|i| rest[*i][0] > 0.14 + 1e-3);
            t.iter_mut().filter(|i| **i == v && right).for_each(|i| *i = copy);
        }
    }
    let run = lab.run(&hung(cloth), &[])?;
    if run.code > 1 {
        lab.refusal(&run, "vertices-doubled");
        return Ok(());
    }
    let d = Draped::read(&run)?;
    let torn = pairs.iter().map(|(v, w)| (d.at[*v] - d.at[*w]).norm()).fold(0.0, f64::max);
    lab.below("torn m", torn, 1e-5);
    lab.near("sag m", sag(&d.at), wanted, 0.02);
    Ok(())
}

/// A vertex in the middle of a neighbour's edge.
fn junction(lab: &mut Lab) -> Result<(), String> {
    let mut cloth = upright(even(0.2, 0.2, 0.05));
    let find = |c: &Mesh, u: f64, v: f64| c.pick(|r| (r[0] - u).abs() < 1e-6 && (r[1] - v).abs() < 1e-6)[0];
    let (a, b) = (find(&cloth, 0.1, 0.05), find(&cloth, 0.1, 0.1));
    let middle = cloth.at.len();
    cloth.at.push((cloth.at[a] + cloth.at[b]) * 0.5);
    cloth.rest.push([0.1, 0.075]);
    let t = cloth.triangles.iter().position(|t| t.contains(&a) && t.contains(&b)).ok_or("a triangle")?;
    let [p, q] = [a, b].map(|v| cloth.triangles[t].map(|i| if i == v { middle } else { i }));
    cloth.triangles[t] = p;
    cloth.triangles.push(q);
    let trial = hung(cloth);
    lab.refuses(&trial, 3, "mesh-t-junction")
}

/// Vertices of no triangle and an edge without one do nothing, and the program says so.
fn loose(lab: &mut Lab) -> Result<(), String> {
    let one = hung(upright(even(0.3, 0.3, 0.02)));
    let d = lab.settles(&one)?;
    let mut text = one.cloth.obj();
    (0..5).for_each(|i| text += &format!("v {i} 5 5\n"));
    text += "l 1 2\n";
    let run = lab.run(&one.text("cloth.obj", text), &[])?;
    let e = Draped::read(&run)?;
    lab.expect(run.findings().any(|f| f["code"] == "vertices-unused"), "no word about the vertices");
    lab.expect(d.at[..] == e.at[..d.at.len()], "another rest");
    Ok(())
}

/// A second sheet on an edge line of the first: a surface with a fin.
fn fin(lab: &mut Lab) -> Result<(), String> {
    let mut cloth = upright(even(0.2, 0.2, 0.02));
    let line = cloth.pick(|[u, _]| (u - 0.1).abs() < 1e-6);
    let mut grown = Vec::new();
    for v in &line {
        grown.push(cloth.at.len());
        cloth.at.push(cloth.at[*v] + Vec3::y() * 0.02);
        cloth.rest.push([cloth.rest[*v][0] + 0.02, cloth.rest[*v][1]]);
    }
    for k in 1..line.len() {
        cloth.triangles.push([line[k - 1], grown[k - 1], line[k]]);
        cloth.triangles.push([line[k], grown[k - 1], grown[k]]);
    }
    let held = top(&cloth);
    let trial = Trial::new(cloth, cotton()).hold(held);
    lab.settles_or_refuses(&trial, "mesh-not-manifold").map(drop)
}

/// Every triangle, or every second, runs the other way: the same drape.
fn wound(lab: &mut Lab, step: usize) -> Result<(), String> {
    let cloth = upright(even(0.2, 0.2, 0.02));
    let held = top(&cloth);
    let one = Trial::new(cloth, cotton()).hold(held);
    let mut other = one.clone();
    other.cloth.triangles.iter_mut().step_by(step).for_each(|t| t.swap(1, 2));
    let d = lab.settles(&one)?;
    if let Some(e) = lab.settles_or_refuses(&other, "mesh-winding")? {
        lab.below("off by m", apart(&d.at, &e.at), 1e-6);
        let run = lab.run(&other, &[])?;
        lab.expect(run.findings().any(|f| f["code"] == "uv-mirrored"), "no word about the winding");
    }
    Ok(())
}

fn one_piece(corners: &[[f64; 2]], edge: f64) -> Pattern {
    let mut p = Pattern::new(vec![Drawn::at("strip", corners, [0.0; 3])], Vec::new(), cotton());
    p.edge = edge;
    p.set("gravity = \"0 m/s2\"")
}

/// Outlines that bound no cloth are refused at the point.
fn outlines(lab: &mut Lab) -> Result<(), String> {
    for corners in [
        vec![[0.0, 0.0], [300.0, 200.0], [300.0, 0.0], [0.0, 300.0]],
        vec![[5.0, 5.0]; 4],
        vec![[0.0, 0.0], [100.0, 0.0], [200.0, 0.0], [300.0, 0.0]],
    ] {
        let run = lab.program(&[], |folder| one_piece(&corners, 20.0).write(folder, None))?;
        let error = run.findings().find(|f| f["severity"] == "error").cloned();
        let code = error.as_ref().and_then(|e| e["code"].as_str().map(str::to_owned)).unwrap_or_default();
        lab.expect(run.code == 3, format!("{corners:?}: exit code {}: {}", run.code, run.said));
        lab.refusal(&run, &code);
        let names = error.is_some_and(|e| e["message"].as_str().is_some_and(|m| m.contains("strip")));
        lab.expect(names, format!("`{code}` does not name the piece"));
    }
    Ok(())
}

/// A spike of 0.01 mm at the outline is smoothed away, meshed or refused at its place.
fn spiked(lab: &mut Lab) -> Result<(), String> {
    let corners =
        [[0.0, 0.0], [300.0, 0.0], [300.0, 300.0], [150.01, 300.0], [150.005, 350.0], [150.0, 300.0], [0.0, 300.0]];
    let run = lab.program(&[], |folder| one_piece(&corners, 20.0).write(folder, None))?;
    if run.code > 1 {
        lab.refusal(&run, "lines-cross");
        return Ok(());
    }
    accepted(lab, &run)
}

/// Meshed, at rest, nothing crosses.
fn meshed(lab: &mut Lab, corners: &[[f64; 2]], edge: f64) -> Result<(), String> {
    let run = lab.program(&[], |folder| one_piece(corners, edge).write(folder, None))?;
    lab.below("CPU s", run.cpu, 3.0);
    accepted(lab, &run)
}

fn accepted(lab: &mut Lab, run: &crate::support::program::Ended) -> Result<(), String> {
    lab.expect(run.code == 0, format!("exit code {}: {}", run.code, run.said));
    let c = &run.record["certificate"];
    lab.expect(c["settled"] == true && c["self_crossings"] == 0, format!("certificate {c}"));
    Ok(())
}

fn too_many(lab: &mut Lab) -> Result<(), String> {
    let pattern = one_piece(&[[0.0, 0.0], [1000.0, 0.0], [1000.0, 1000.0], [0.0, 1000.0]], 0.05);
    let run = lab.program(&[], |folder| pattern.write(folder, None))?;
    lab.expect(run.code == 3, format!("exit code {}: {}", run.code, run.said));
    lab.below("CPU s", run.cpu, 1.0);
    lab.expect(run.findings().any(|f| f["code"] == "limit"), "no word about the limit");
    lab.count.refused += 1;
    Ok(())
}

/// Columns that get 200 times narrower towards one side, against even ones.
fn graded(lab: &mut Lab) -> Result<(), String> {
    let even_one = upright(even(0.3, 0.1, 0.01));
    let mut cloth = even(0.3, 0.1, 0.01);
    let n = 30.0;
    let growth = libm::pow(200.0, 1.0 / (n - 1.0));
    let total = (libm::pow(growth, n) - 1.0) / (growth - 1.0);
    for r in &mut cloth.rest {
        let k = (r[0] / 0.01).round();
        r[0] = 0.3 * (libm::pow(growth, k) - 1.0) / (growth - 1.0) / total;
    }
    let cloth = upright(cloth);
    let held = |c: &Mesh| top(c);
    let fabric = Cloth { bending: 1e-4, ..cotton() };
    let one = Trial::new(even_one.clone(), fabric).hold(held(&even_one));
    let other = Trial::new(cloth.clone(), fabric).hold(held(&cloth));
    let (d, e) = (lab.settles(&one)?, lab.settles(&other)?);
    lab.near("sag m", sag(&e.at), sag(&d.at), 0.01);
    Ok(())
}

/// Cloth of 4 mm on edges of 2 mm stays flat where nothing bends it, and bends like thin cloth of the same stiffness.
fn thick(lab: &mut Lab) -> Result<(), String> {
    let strip = even(0.02, 0.06, 0.002);
    let level = strip.place(|[u, v]| Vec3::new(u, v, 0.0));
    let clamp = level.pick(|[_, v]| v < 0.0021);
    let of = |thickness: f64, gravity: f64| {
        let fabric = Cloth { thickness, bending: 1e-4, ..cotton() };
        Trial { gravity, ..Trial::new(level.clone(), fabric) }.hold(clamp.clone()).set("accuracy = \"reference\"")
    };
    let flat = lab.settles_as_is(&of(4e-3, 0.0))?;
    lab.below("off the plane m", flat.at.iter().map(|p| p.z.abs()).fold(0.0, f64::max), 1e-9);
    let (d, e) = (lab.settles_as_is(&of(4e-3, 9.81))?, lab.settles_as_is(&of(1e-4, 9.81))?);
    lab.near("sag m", sag(&d.at), sag(&e.at), 0.01);
    Ok(())
}
