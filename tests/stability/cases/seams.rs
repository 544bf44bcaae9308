//! D: seams and darts.

use crate::case::{Case, case};
use crate::lab::Lab;
use crate::pattern::{Drawn, Pattern, rectangle};
use crate::scenes::{cotton, even, rolled, torso};
use crate::support::mesh::Mesh;
use crate::support::mesh::polar;
use crate::support::mesh::{Family, sheet};
use crate::support::program::Ended;
use crate::support::trial::Trial;
use std::f64::consts::TAU;
use toile_garment::Vec3;

pub fn cases() -> Vec<Case> {
    let mut list = vec![
        case("D1-two-sheets-round-a-trunk", trunk),
        case("D2-gather-390-onto-300", gather).quick(),
        case("D3-five-gussets", gussets).quick(),
        case("D4-tube", |lab: &mut Lab| closed(lab, 1.0)).quick(),
        case("D4-cone", cone).quick(),
        case("D4-moebius", moebius).quick(),
        case("D5-cuff-turned-90", cuff).quick(),
        case("D6-seam-reversed", reversed).quick(),
        case("D6-points-reversed", reversed_points).quick().once(),
        case("D7-7-onto-53", counts).quick(),
        case("D8-stitches-refused", refused).quick().once(),
        case("D8-seams-refused", no_such_edge).quick().once(),
        case("D11-darts-0.1mm-apart", near_darts).quick().once(),
        case("D19-chain-of-three", chain).quick(),
        case("D20-stitches-in-any-order", any_order).quick().once(),
    ];
    for degrees in [5.0, 30.0, 90.0, 150.0, 170.0] {
        let one = case(format!("D9-dart-{degrees}deg"), move |lab: &mut Lab| dart(lab, degrees));
        // Wide ones take long to come to rest without weight.
        list.push(if degrees < 10.0 { one.quick() } else { one });
    }
    list
}

/// Stitches vertices whose rest places `a` and `b` answer to, in the order of v.
fn pairs(m: &Mesh, a: impl Fn([f64; 2]) -> bool, b: impl Fn([f64; 2]) -> bool) -> Vec<[usize; 2]> {
    let line = |is: &dyn Fn([f64; 2]) -> bool| {
        let mut line = m.pick(is);
        line.sort_by(|i, j| m.rest[*i][1].total_cmp(&m.rest[*j][1]));
        line
    };
    line(&a).into_iter().zip(line(&b)).map(|(a, b)| [a, b]).collect()
}

/// Front and back half a metre before and behind a trunk, sewn at both sides; held at the top by nothing but the trunk.
fn trunk(lab: &mut Lab) -> Result<(), String> {
    let size = [0.56, 0.4];
    let half = |z: f64| even(size[0], size[1], 0.04).place(move |[u, v]| Vec3::new(u - 0.28, z, v + 0.1));
    let mut cloth = half(0.5);
    let n = cloth.at.len();
    let back = half(-0.5);
    let side = |u: f64| cloth.pick(|r| (r[0] - u).abs() < 1e-9);
    let stitches = [side(0.0), side(size[0])].concat().into_iter().map(|v| [v, v + n]).collect();
    cloth.join(&back);
    let mut trial = Trial::new(cloth, cotton()).weightless().over(torso(24, 48));
    trial.stitches = stitches;
    sewn(lab, &trial)
}

/// Settles, and every pair is closed.
fn sewn(lab: &mut Lab, trial: &Trial) -> Result<(), String> {
    let d = lab.settles(trial)?;
    let gap = trial.stitches.iter().map(|[a, b]| (d.at[*a] - d.at[*b]).norm()).fold(0.0, f64::max);
    lab.below("seam gap m", gap, 1e-4);
    Ok(())
}

fn tube_of(girth: f64, height: f64, cells: usize, rows: usize) -> Mesh {
    rolled(sheet::sheet([girth, height], cells, rows, Family::Right, |_| true), 1.0)
}

/// A ring of 390 mm sewn to one of 300 mm.
fn gather(lab: &mut Lab) -> Result<(), String> {
    let (cells, rows) = (48, 4);
    let mut cloth = tube_of(0.3, 0.04, cells, rows);
    let n = cloth.at.len();
    let skirt = tube_of(0.39, 0.06, cells, rows);
    let down = Mesh { at: skirt.at.iter().map(|p| p - Vec3::z() * 0.065).collect(), ..skirt };
    let mut stitches = pairs(&cloth, |r| r[0] < 1e-9, |r| r[0] > 0.3 - 1e-9);
    stitches.extend(pairs(&down, |r| r[0] < 1e-9, |r| r[0] > 0.39 - 1e-9).into_iter().map(|p| p.map(|v| v + n)));
    stitches.extend((0..=cells).map(|k| [k, n + rows * (cells + 1) + k]));
    let held: Vec<usize> = cloth.pick(|r| r[1] > 0.04 - 1e-9);
    cloth.join(&down);
    let mut trial = Trial::new(cloth, cotton()).hold(held);
    trial.stitches = stitches;
    sewn(lab, &trial)
}

/// Five gussets of 72° that meet in one point.
fn gussets(lab: &mut Lab) -> Result<(), String> {
    let mut cloth = Mesh::default();
    let (mut stitches, mut sides, mut tips) = (Vec::new(), Vec::new(), Vec::new());
    for k in 0..5 {
        let turn = TAU * f64::from(k) / 5.0;
        let wedge = polar::sector(0.0, 0.15, f64::to_radians(72.0), 0.02, Family::Regular).place(|r, a| {
            Vec3::new((r + 0.004) * libm::cos(turn + 0.97 * a), (r + 0.004) * libm::sin(turn + 0.97 * a), 0.02 * r)
        });
        let first = cloth.join(&wedge.mesh);
        sides.push(wedge.sides().into_iter().map(|p| p.map(|v| v + first)).collect::<Vec<_>>());
        tips.push(wedge.circles[0][0] + first);
    }
    for k in 0..5 {
        stitches.push([tips[k], tips[(k + 1) % 5]]);
        stitches.extend(sides[k].iter().zip(&sides[(k + 1) % 5]).map(|(a, b)| [a[1], b[0]]));
    }
    let mut trial = Trial::new(cloth, cotton()).weightless();
    trial.stitches = stitches;
    sewn(lab, &trial)
}

/// A sheet sewn to a tube from a start that is `share` of the way round.
fn closed(lab: &mut Lab, share: f64) -> Result<(), String> {
    let cloth = even(0.3, 0.15, 0.02).place(|[u, v]| {
        let a = 0.9 * share * TAU * u / 0.3;
        Vec3::new(0.05 * libm::cos(a), 0.05 * libm::sin(a), v)
    });
    let stitches = pairs(&cloth, |r| r[0] < 1e-9, |r| r[0] > 0.3 - 1e-9);
    let mut trial = Trial::new(cloth, cotton()).weightless();
    trial.stitches = stitches;
    sewn(lab, &trial)
}

/// Three quarters of a disc sewn to a cone.
fn cone(lab: &mut Lab) -> Result<(), String> {
    let sector = polar::sector(0.0, 0.15, 0.75 * TAU, 0.02, Family::Regular);
    let sides = sector.sides();
    let start = sector.onto_cone(0.95 * TAU);
    let mut trial = Trial::new(start.mesh, cotton()).weightless();
    trial.stitches = sides;
    sewn(lab, &trial)
}

/// A band sewn to itself with a half twist: one-sided, but cloth all the same.
fn moebius(lab: &mut Lab) -> Result<(), String> {
    let cloth = even(0.6, 0.04, 0.02).place(|[u, v]| {
        let a = 0.97 * TAU * u / 0.6;
        let (r, w) = (0.6 / TAU, v - 0.02);
        let (s, c) = (libm::sin(0.5 * a), libm::cos(0.5 * a));
        Vec3::new((r + w * s) * libm::cos(a), (r + w * s) * libm::sin(a), w * c)
    });
    let line = |u: f64| cloth.pick(|r| (r[0] - u).abs() < 1e-9);
    let stitches = line(0.0).into_iter().zip(line(0.6).into_iter().rev()).map(|(a, b)| [a, b]).collect();
    let mut trial = Trial::new(cloth, cotton()).weightless();
    trial.stitches = stitches;
    sewn(lab, &trial)
}

/// A cuff of 200 mm sewn into a sleeve of 240 mm, a quarter turn off at the start: it turns back.
fn cuff(lab: &mut Lab) -> Result<(), String> {
    let (cells, rows) = (24, 4);
    let mut cloth = tube_of(0.24, 0.08, cells, rows);
    let n = cloth.at.len();
    let held = cloth.pick(|r| r[1] > 0.08 - 1e-9);
    let small = tube_of(0.2, 0.04, cells, rows);
    let down = Mesh { at: small.at.iter().map(|p| Vec3::new(-p.y, p.x, p.z - 0.05)).collect(), ..small };
    let mut stitches = pairs(&cloth, |r| r[0] < 1e-9, |r| r[0] > 0.24 - 1e-9);
    stitches.extend(pairs(&down, |r| r[0] < 1e-9, |r| r[0] > 0.2 - 1e-9).into_iter().map(|p| p.map(|v| v + n)));
    stitches.extend((0..=cells).map(|k| [k, n + rows * (cells + 1) + k]));
    cloth.join(&down);
    let mut trial = Trial::new(cloth, cotton()).hold(held);
    trial.stitches = stitches;
    let d = lab.settles(&trial)?;
    let angle = |v: usize| libm::atan2(d.at[v].y, d.at[v].x);
    // The hem of the cuff stands under the held edge of the sleeve again.
    let twist = (0..cells).map(|k| {
        let off = angle(n + k) - angle(rows * (cells + 1) + k);
        libm::atan2(libm::sin(off), libm::cos(off))
    });
    let twist = (twist.sum::<f64>() / cells as f64).to_degrees();
    lab.below("twist degrees", twist.abs(), 5.0);
    Ok(())
}

/// Front and back whose side seam is named the wrong way round: told, refused, or sewn as it should be.
fn reversed(lab: &mut Lab) -> Result<(), String> {
    let flat = |z: f64| even(0.2, 0.2, 0.02).place(move |[u, v]| Vec3::new(u, z, v));
    let mut cloth = flat(0.0);
    let n = cloth.at.len();
    let back = flat(0.05);
    let side = cloth.pick(|r| r[0] < 1e-9);
    let stitches: Vec<[usize; 2]> = side.iter().zip(side.iter().rev()).map(|(a, b)| [*a, b + n]).collect();
    cloth.join(&back);
    let mut trial = Trial::new(cloth, cotton()).weightless();
    trial.stitches = stitches;
    let shaken = lab.shaken(&trial);
    let run = lab.run(&shaken, &[])?;
    if run.code > 1 {
        lab.refusal(&run, "start-crosses");
        return Ok(());
    }
    let said = run.findings().any(|f| f["code"] == "stitches-cross" || f["code"] == "seam-reversed");
    lab.expect(said, format!("twisted without a word: exit code {}", run.code));
    Ok(())
}

/// The right side of `left`, 150 by 200 mm, sewn from its foot to the left side of `right` between these heights, mm.
fn side_seam(heights: [u32; 2]) -> String {
    let side = |piece: &str, x: u32, [from, to]: [u32; 2]| {
        format!("{{ piece = \"{piece}\", from = [\"{x} mm\", \"{from} mm\"], to = [\"{x} mm\", \"{to} mm\"] }}")
    };
    let (a, b) = (side("left", 150, [0, 200]), side("right", 0, heights));
    format!("[[seam]]\nname = \"side\"\na = {a}\nb = {b}\n")
}

/// The same by the points of a sewing file: told as the pieces are placed, whether or not the twist can be sewn.
fn reversed_points(lab: &mut Lab) -> Result<(), String> {
    let piece = |name, x| Drawn::at(name, &rectangle(150.0, 200.0), [x, 0.0, 0.0]);
    for (heights, reversed) in [([0, 200], false), ([200, 0], true)] {
        let pieces = vec![piece("left", -160.0), piece("right", 10.0)];
        let pattern = Pattern::new(pieces, Vec::new(), cotton()).set("gravity = \"0 m/s2\"");
        let sewing = side_seam(heights);
        let run = lab.program(&[], |folder| Pattern { sewing, ..pattern }.write(folder, None))?;
        if !reversed {
            good(lab, &run)?;
        }
        let told = run.findings().any(|f| f["code"] == "seam-reversed");
        lab.expect(told == reversed, format!("heights {heights:?}: told {told}"));
    }
    Ok(())
}

/// Edges cut into 7 and 53: both sides get the same stitches, equal by length.
fn counts(lab: &mut Lab) -> Result<(), String> {
    let mut left: Vec<[f64; 2]> = vec![[0.0, 0.0], [150.0, 0.0]];
    left.extend((1..7).map(|k| [150.0, 200.0 * f64::from(k) / 7.0]));
    left.extend([[150.0, 200.0], [0.0, 200.0]]);
    let mut right: Vec<[f64; 2]> = vec![[0.0, 0.0], [150.0, 0.0], [150.0, 200.0], [0.0, 200.0]];
    right.extend((1..53).rev().map(|k| [0.0, 200.0 * f64::from(k) / 53.0]));
    let pieces = vec![Drawn::at("left", &left, [-160.0, 0.0, 0.0]), Drawn::at("right", &right, [10.0, 0.0, 0.0])];
    let pattern = Pattern::new(pieces, Vec::new(), cotton()).set("gravity = \"0 m/s2\"");
    let sewing = side_seam([0, 200]);
    let run = lab.program(&[], |folder| Pattern { sewing, ..pattern }.write(folder, None))?;
    good(lab, &run)
}

/// Accepted, at rest, closed, nothing crosses.
fn good(lab: &mut Lab, run: &Ended) -> Result<(), String> {
    lab.count.accepted += 1;
    let c = &run.record["certificate"];
    lab.expect(run.code == 0, format!("exit code {}: {}", run.code, run.said));
    lab.expect(c["settled"] == true && c["self_crossings"] == 0, format!("certificate {c}"));
    lab.count.converged += usize::from(c["settled"] == true);
    lab.below("seam gap mm", c["seam_gap_max_mm"].as_f64().unwrap_or(f64::NAN), 0.1);
    Ok(())
}

/// Stitches that make no seam are refused with their line.
fn refused(lab: &mut Lab) -> Result<(), String> {
    let one = Trial::new(even(0.1, 0.1, 0.05), cotton()).hold([0]);
    for text in ["3 3\n", "1 99\n", "1\n", "1 2 3 4\n", "-1 2\n", "a b\n"] {
        let mut trial = one.clone().text("stitches.txt", text.to_owned());
        trial.stitches = vec![[0, 1]];
        lab.refuses(&trial, 3, "vertex-list")?;
    }
    Ok(())
}

/// Seams to a missing edge, and of an edge with itself.
fn no_such_edge(lab: &mut Lab) -> Result<(), String> {
    let piece = || vec![Drawn::at("front", &rectangle(200.0, 200.0), [0.0; 3])];
    for seam in [[("front", 1), ("front", 9)], [("front", 1), ("back", 1)], [("front", 1), ("front", 1)]] {
        let pattern = Pattern::new(piece(), vec![seam], cotton());
        let run = lab.program(&[], |folder| pattern.write(folder, None))?;
        lab.expect(run.code == 3 || run.code == 2, format!("{seam:?}: exit code {}", run.code));
        let error = run.findings().find(|f| f["severity"] == "error");
        lab.expect(error.is_some_and(|e| e["source"]["file"].is_string()), format!("{seam:?}: no place: {}", run.said));
        lab.count.refused += 1;
    }
    Ok(())
}

/// A wedge of so many degrees, legs of 80 mm, in the upper edge of a piece of 300 mm (wide ones need the room).
fn dart(lab: &mut Lab, degrees: f64) -> Result<(), String> {
    let half = f64::to_radians(0.5 * degrees);
    let (x, y) = (80.0 * libm::sin(half), 80.0 * libm::cos(half));
    let top = 200.0 + y;
    let corners =
        [[0.0, 0.0], [400.0, 0.0], [400.0, top], [200.0 + x, top], [200.0, 200.0], [200.0 - x, top], [0.0, top]];
    let pattern =
        Pattern::new(vec![Drawn::at("piece", &corners, [0.0; 3])], vec![[("piece", 3), ("piece", 4)]], cotton());
    let pattern = Pattern { edge: 16.0, ..pattern }.set("gravity = \"0 m/s2\"");
    let run = lab.program(&[], |folder| pattern.write(folder, None))?;
    good(lab, &run)?;
    let gap = run.record["certificate"]["dart_gap_max_mm"].as_f64().unwrap_or(f64::NAN);
    lab.below("dart gap mm", gap, 0.1);
    lab.expect(run.record["garment"]["darts"] == 1, "it is no dart");
    Ok(())
}

/// Two darts whose tips are 0.1 mm from each other, from two edges.
fn near_darts(lab: &mut Lab) -> Result<(), String> {
    let corners = [
        [0.0, 0.0],
        [190.0, 0.0],
        [200.0, 149.95],
        [210.0, 0.0],
        [400.0, 0.0],
        [400.0, 300.0],
        [210.0, 300.0],
        [200.0, 150.05],
        [190.0, 300.0],
        [0.0, 300.0],
    ];
    let seams = vec![[("piece", 1), ("piece", 2)], [("piece", 6), ("piece", 7)]];
    let pattern =
        Pattern::new(vec![Drawn::at("piece", &corners, [0.0; 3])], seams, cotton()).set("gravity = \"0 m/s2\"");
    let run = lab.program(&[], |folder| pattern.write(folder, None))?;
    good(lab, &run)
}

/// A–B, B–C and C–A of three sheets edge to edge: one seam of three.
fn chain(lab: &mut Lab) -> Result<(), String> {
    let leaf = |angle: f64| {
        even(0.1, 0.1, 0.02)
            .place(move |[u, v]| Vec3::new((u + 0.003) * libm::cos(angle), (u + 0.003) * libm::sin(angle), v))
    };
    let mut cloth = leaf(0.0);
    let n = cloth.at.len();
    let spine = cloth.pick(|r| r[0] < 1e-9);
    cloth.join(&leaf(2.0));
    cloth.join(&leaf(4.0));
    let mut trial = Trial::new(cloth, cotton()).weightless();
    trial.stitches = spine.iter().flat_map(|v| [[*v, v + n], [v + n, v + 2 * n], [v + 2 * n, *v]]).collect();
    sewn(lab, &trial)
}

/// The same stitches in another order, and named from the other side: the same bytes.
fn any_order(lab: &mut Lab) -> Result<(), String> {
    let cloth = even(0.3, 0.15, 0.02).place(|[u, v]| {
        let a = 0.9 * TAU * u / 0.3;
        Vec3::new(0.05 * libm::cos(a), 0.05 * libm::sin(a), v)
    });
    let stitches = pairs(&cloth, |r| r[0] < 1e-9, |r| r[0] > 0.3 - 1e-9);
    let mut one = Trial::new(cloth, cotton()).weightless();
    one.stitches = stitches;
    let mut other = one.clone();
    other.stitches.reverse();
    other.stitches.iter_mut().step_by(2).for_each(|p| p.swap(0, 1));
    let (d, e) = (lab.settles(&one)?, lab.settles(&other)?);
    lab.expect(d.at == e.at, format!("another shape, by {:.1e} m", crate::scenes::apart(&d.at, &e.at)));
    Ok(())
}
