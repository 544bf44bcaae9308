//! H: the same bits whatever should not matter: threads, order, turns, repetition, surroundings.

use crate::case::{Case, case};
use crate::lab::Lab;
use crate::pattern::{Drawn, Pattern, rectangle};
use crate::scenes::{apart, ball, corners, cotton, del, even, lying, quarter_turns, top, turned_by, unequal, upright};
use crate::support::mesh::jitter::noise;
use crate::support::mesh::{Family, Mesh, sheet};
use crate::support::program::Ended;
use crate::support::trial::Trial;
use std::process::Command;
use toile_garment::Vec3;

pub fn cases() -> Vec<Case> {
    vec![
        case("H1-threads", threads).quick().once(),
        case("H3-order-of-pieces", pieces_in_order).quick().once(),
        case("H3-order-of-seams", seams_in_order).quick().once(),
        case("H4-renumbered", renumbered).quick().once(),
        case("H5-half-turn-hung", |lab: &mut Lab| turns(lab, straight(), &[2])).quick().once(),
        case("H5-quarter-turns-hung", |lab: &mut Lab| turns(lab, straight(), &[1, 3])).quick().once(),
        case("H5-half-turn-ball", |lab: &mut Lab| turns(lab, on_ball(), &[2])).quick().once(),
        case("H5-quarter-turns-ball", |lab: &mut Lab| turns(lab, on_ball(), &[1, 3])).quick().once(),
        case("H6-turned-37-and-moved", turned_and_moved).quick().once(),
        case("H7-mirror", mirror).quick().once(),
        case("H8-twice-in-one-process", twice).quick().once(),
        case("H10-surroundings", surroundings).quick().once(),
    ]
}

fn hung() -> Trial {
    let cloth = upright(del(0.25, 0.025));
    let held = corners(&cloth);
    Trial::new(cloth, cotton()).hold(held)
}

/// Held by its whole upper edge, a little rippled: it cannot come to rest in two ways.
fn straight() -> Trial {
    let cloth = upright(del(0.2, 0.025));
    let held = top(&cloth);
    let at = cloth.at.iter().map(|p| Vec3::new(p.x, 1e-3 * libm::sin(20.0 * p.x), p.z)).collect();
    Trial::new(Mesh { at, ..cloth }, cotton()).hold(held)
}

fn on_ball() -> Trial {
    Trial::new(lying(del(0.25, 0.025), 0.102), cotton()).over(ball(0.1, Vec3::zeros(), 3))
}

/// Outputs that are not byte for byte the same.
fn differ(a: &Ended, b: &Ended) -> Vec<String> {
    a.outputs().zip(b.outputs()).filter(|(p, q)| p != q).map(|(p, _)| p.0.clone()).collect()
}

fn threads(lab: &mut Lab) -> Result<(), String> {
    for scene in [hung(), on_ball()] {
        let one = lab.run(&scene, &["--threads", "1"])?;
        for n in ["2", "3", "8", "64"] {
            let other = lab.run(&scene, &["--threads", n])?;
            let differ = differ(&one, &other);
            lab.expect(
                differ.is_empty() && one.code == 0,
                format!("{n} threads: {differ:?}, exit code {}", other.code),
            );
        }
    }
    Ok(())
}

/// A tube of four pieces.
fn tube() -> Pattern {
    let side = |name, angle: f64, x: f64, z: f64| Drawn::at(name, &rectangle(160.0, 240.0), [x, 0.0, z]).facing(angle);
    let pieces = vec![
        side("front", 0.0, -80.0, 100.0),
        side("left", 90.0, 100.0, 80.0),
        side("back", 180.0, 80.0, -100.0),
        side("right", 270.0, -100.0, -80.0),
    ];
    let names = ["front", "left", "back", "right"];
    let seams = (0..4).map(|k| [(names[k], 1), (names[(k + 1) % 4], 3)]).collect();
    Pattern::new(pieces, seams, cotton()).set("gravity = \"0 m/s2\"")
}

/// The groups of an OBJ: name, and its vertices.
fn groups(run: &Ended) -> Vec<(String, Vec<String>)> {
    let text = String::from_utf8_lossy(run.output("final.obj").unwrap_or_default()).into_owned();
    let mut list: Vec<(String, Vec<String>)> = Vec::new();
    for line in text.lines() {
        if let Some(name) = line.strip_prefix("g ") {
            list.push((name.to_owned(), Vec::new()));
        } else if let (Some(group), true) = (list.last_mut(), line.starts_with("v ")) {
            group.1.push(line.to_owned());
        }
    }
    list.sort();
    list
}

fn pieces_in_order(lab: &mut Lab) -> Result<(), String> {
    let first = lab.program(&[], |folder| tube().write(folder, None))?;
    lab.expect(first.code == 0, format!("exit code {}: {}", first.code, first.said));
    for order in [[1, 0, 2, 3], [3, 2, 1, 0], [2, 3, 0, 1], [1, 3, 0, 2]] {
        let mut other = tube();
        other.pieces = order.map(|k| other.pieces[k].clone()).to_vec();
        let run = lab.program(&[], |folder| other.write(folder, None))?;
        lab.expect(run.code == 0, format!("exit code {}: {}", run.code, run.said));
        let (a, b) = (groups(&first), groups(&run));
        let wrong = a.iter().zip(&b).filter(|(p, q)| p != q).count();
        lab.expect(a.len() == 4 && wrong == 0, format!("{order:?}: {wrong} of {} pieces differ", a.len()));
    }
    Ok(())
}

fn seams_in_order(lab: &mut Lab) -> Result<(), String> {
    let first = lab.program(&[], |folder| tube().write(folder, None))?;
    for order in [[1, 0, 2, 3], [3, 2, 1, 0], [2, 3, 0, 1]] {
        let mut other = tube();
        other.seams = order.map(|k| other.seams[k]).to_vec();
        let run = lab.program(&[], |folder| other.write(folder, None))?;
        lab.expect(groups(&first) == groups(&run), format!("seams in the order {order:?}: another shape"));
    }
    Ok(())
}

/// Vertices and triangles in another order: the same rest, on a scene that cannot buckle.
fn renumbered(lab: &mut Lab) -> Result<(), String> {
    let cloth = upright(del(0.2, 0.025));
    let held = top(&cloth);
    let one = Trial::new(cloth, cotton()).hold(held).set("accuracy = \"reference\"");
    let n = one.cloth.at.len();
    let mut place: Vec<usize> = (0..n).collect();
    place.sort_by(|i, j| noise(*i as u64).total_cmp(&noise(*j as u64)));
    let mut to = vec![0; n];
    place.iter().enumerate().for_each(|(new, old)| to[*old] = new);
    let pick = |v: &usize| one.cloth.at[*v];
    let mut triangles: Vec<[usize; 3]> = one.cloth.triangles.iter().map(|t| t.map(|v| to[v])).collect();
    triangles.sort_by(|s, t| noise(s[0] as u64 + 7).total_cmp(&noise(t[0] as u64 + 7)));
    let rest = place.iter().map(|v| one.cloth.rest[*v]).collect();
    let cloth = Mesh { at: place.iter().map(pick).collect(), rest, triangles };
    let pins = one.pins.iter().map(|(v, p)| (to[*v], *p)).collect();
    let (d, e) = (lab.settles(&one)?, lab.settles(&Trial { cloth, pins, ..one.clone() })?);
    let back: Vec<Vec3> = (0..n).map(|v| e.at[to[v]]).collect();
    lab.below("off by m", apart(&d.at, &back), 1e-6);
    Ok(())
}

fn mapped(t: &Trial, to: impl Fn(Vec3) -> Vec3) -> Trial {
    let turn = |m: &Mesh| Mesh { at: m.at.iter().map(|p| to(*p)).collect(), ..m.clone() };
    let pins = t.pins.iter().map(|(v, p)| (*v, to(*p))).collect();
    Trial { cloth: turn(&t.cloth), body: t.body.as_ref().map(turn), pins, ..t.clone() }
}

/// Turned by 90, 180 and 270°: the same bits after turning back.
fn turns(lab: &mut Lab, one: Trial, quarters: &[usize]) -> Result<(), String> {
    let d = lab.settles(&one)?;
    for n in quarters.iter().copied() {
        let e = lab.settles(&mapped(&one, |p| quarter_turns(p, n)))?;
        let wrong = unequal(&d.at, &e.at, |p| quarter_turns(p, 4 - n));
        let back: Vec<Vec3> = e.at.iter().map(|p| quarter_turns(*p, 4 - n)).collect();
        let off = apart(&d.at, &back);
        lab.expect(wrong == 0, format!("{} degrees: {wrong} of {} differ, by up to {off:.1e} m", 90 * n, d.at.len()));
    }
    Ok(())
}

/// Turned by 37° and moved: as near as the goal of rest.
fn turned_and_moved(lab: &mut Lab) -> Result<(), String> {
    let cloth = upright(del(0.2, 0.025));
    let held = top(&cloth);
    let one = Trial::new(cloth, cotton()).hold(held).set("accuracy = \"fine\"");
    let angle = f64::to_radians(37.0);
    let by = Vec3::new(3.1, 0.0, -7.7);
    let (d, e) = (lab.settles(&one)?, lab.settles(&mapped(&one, |p| turned_by(p, angle) + by))?);
    let back: Vec<Vec3> = e.at.iter().map(|p| turned_by(p - by, -angle)).collect();
    lab.below("off by m", apart(&d.at, &back), 1e-4);
    Ok(())
}

/// The mirror image of an uneven scene: the same within the goal of rest.
fn mirror(lab: &mut Lab) -> Result<(), String> {
    let cloth = sheet::sheet([0.2, 0.2], 8, 9, Family::Regular, |_| true);
    let cloth = cloth.place(|[u, v]| Vec3::new(u - 0.1, 0.02 * u, v - 0.2));
    let held = top(&cloth);
    let one = Trial::new(cloth, cotton()).hold(held).set("accuracy = \"fine\"");
    let flip = |p: Vec3| Vec3::new(-p.x, p.y, p.z);
    let mut other = mapped(&one, flip);
    other.cloth.rest.iter_mut().for_each(|r| r[0] = 0.2 - r[0]);
    other.cloth.triangles.iter_mut().for_each(|t| t.swap(1, 2));
    let (d, e) = (lab.settles(&one)?, lab.settles(&other)?);
    let back: Vec<Vec3> = e.at.iter().map(|p| flip(*p)).collect();
    lab.below("off by m", apart(&d.at, &back), 1e-6);
    Ok(())
}

/// Another scene in between leaves nothing behind.
fn twice(lab: &mut Lab) -> Result<(), String> {
    let first = lab.run(&on_ball(), &[])?;
    lab.run(&Trial::new(upright(even(0.1, 0.1, 0.02)), cotton()).hold([0]), &[])?;
    let again = lab.run(&on_ball(), &[])?;
    let differ = differ(&first, &again);
    lab.expect(differ.is_empty() && first.code == 0, format!("another result: {differ:?}"));
    Ok(())
}

/// Another folder, language, time zone, home and size of the environment.
fn surroundings(lab: &mut Lab) -> Result<(), String> {
    let first = lab.run(&on_ball(), &[])?;
    let folder = tempfile::Builder::new().prefix("ein Ordner, größer ").tempdir().map_err(|e| e.to_string())?;
    on_ball().write(folder.path(), &[]).map_err(|e| e.to_string())?;
    let out = folder.path().join("out");
    let mut program = Command::new(env!("CARGO_BIN_EXE_toile"));
    program.env_clear().env("LC_ALL", "tr_TR.UTF-8").env("TZ", "Asia/Kathmandu").env("STUFF", "x".repeat(50_000));
    let done =
        program.arg("run").arg(folder.path().join("pipeline.toml")).arg("--out").arg(&out).arg("--quiet").output();
    let done = done.map_err(|e| e.to_string())?;
    lab.expect(done.status.success(), format!("{}: {}", done.status, String::from_utf8_lossy(&done.stderr)));
    for (name, bytes) in first.outputs() {
        let same = std::fs::read(out.join(name)).is_ok_and(|b| b == *bytes);
        lab.expect(same, format!("{name} differs"));
    }
    Ok(())
}
