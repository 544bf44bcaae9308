//! Pieces with grain and material of their own: B8, two fabrics in one seam; D15, a dart across the grain.

use crate::case::{Case, case};
use crate::drawing::{Drawing, Sheet};
use crate::lab::Lab;
use crate::pattern::rectangle;
use crate::scenes::{cotton, turned};
use crate::support::cloth::Cloth;
use crate::support::glb::{self, Part};
use crate::support::mesh::Mesh;
use crate::support::program::Ended;
use std::collections::BTreeMap;
use toile_garment::Vec3;

pub fn cases() -> Vec<Case> {
    vec![case("B8-light-sewn-to-heavy", light_and_heavy), case("D15-dart-across-the-grain", dart).quick()]
}

/// Accepted, at rest, closed, nothing crosses.
pub(super) fn good(lab: &mut Lab, run: &Ended) {
    lab.count.accepted += 1;
    let c = &run.record["certificate"];
    lab.expect(run.code == 0, format!("exit code {}: {}", run.code, run.said));
    lab.expect(
        c["settled"] == true && c["self_crossings"] == 0 && c["body_crossings"] == 0,
        format!("certificate {c}"),
    );
    lab.count.converged += usize::from(c["settled"] == true);
    lab.below("seam gap mm", c["seam_gap_max_mm"].as_f64().unwrap_or(f64::NAN), 0.1);
}

/// A skirt of two lengths, held at the waist: above 0.02 kg/m² and 100 N/m, below 2 kg/m² and 1e6 N/m. The upper one
/// carries the lower one and lengthens by that.
fn light_and_heavy(lab: &mut Lab) -> Result<(), String> {
    let (width, yoke, skirt) = (390.0, 150.0, 120.0);
    let nudge = 1e3 * lab.nudge(4e-4, 0);
    let sheet = |name, material, height: f64, y: f64, back: bool| Sheet {
        name,
        material,
        corners: rectangle(width, height).to_vec(),
        grain: 90.0,
        translation: if back { [0.5 * width + nudge, y, -140.0] } else { [-0.5 * width, y, 140.0 + nudge] },
        back,
    };
    let sheets = vec![
        sheet("UPPER-F", "light", yoke, 850.0, false),
        sheet("UPPER-B", "light", yoke, 850.0, true),
        sheet("LOWER-F", "heavy", skirt, 725.0, false),
        sheet("LOWER-B", "heavy", skirt, 725.0, true),
    ];
    let seams = [
        ("UPPER-F.1", "UPPER-B.3"),
        ("UPPER-F.3", "UPPER-B.1"),
        ("LOWER-F.1", "LOWER-B.3"),
        ("LOWER-F.3", "LOWER-B.1"),
        ("UPPER-F.0", "LOWER-F.2"),
        ("UPPER-B.0", "LOWER-B.2"),
    ];
    let mut sewing: String = seams
        .iter()
        .enumerate()
        .map(|(k, (a, b))| format!("[[seam]]\nname = \"s{k}\"\na = \"{a}\"\nb = \"{b}\"\n"))
        .collect();
    for piece in ["UPPER-F", "UPPER-B"] {
        sewing += &format!("[[attach]]\npiece = \"{piece}\"\nedge = \"2\"\nto = \"waist\"\nstrength = \"hold\"\n");
    }
    let of = |mass: f64, k: f64| Cloth { thickness: 4e-4, ..Cloth::linear(mass, k, 0.4 * k, 1e-5) };
    let fabrics = vec![("light", of(0.02, 1e2)), ("heavy", of(2.0, 1e6))];
    let trunk = turned(&[[0.1, 0.0], [0.1, 0.9], [0.12, 1.0], [0.12, 1.2]], 48);
    let at = trunk.at.iter().map(|p| Vec3::new(p.y, p.z, p.x)).collect();
    let body = Some((Mesh { at, ..trunk }.obj(), "[measures]\nwaist_height = \"1000 mm\"\n".to_owned()));
    let drawing = Drawing { sheets, sewing, fabrics, body, edge: 20.0, drape: Vec::new() };
    let accuracy = lab.accuracy().map(str::to_owned);
    let run = lab.program(&[], |folder| drawing.write(folder, accuracy.as_deref()))?;
    good(lab, &run);
    let parts = glb::parts(run.output("final.glb").ok_or("a GLB")?);
    let upper = height(&parts[0]);
    // Weight below the middle of the upper one, per width.
    let load = 9.81 * 1e-3 * (2.0 * skirt + 0.02 * 0.5 * yoke);
    lab.near("lengthening of the light cloth", upper / (1e-3 * yoke) - 1.0, load / 1e2, 0.03);
    lab.below("strain of the heavy cloth", strain(&parts[2]), 2e-4);
    Ok(())
}

/// How high it hangs, m.
fn height(part: &Part) -> f64 {
    let ys = part.positions.iter().map(|p| p[1]);
    ys.clone().fold(f64::NEG_INFINITY, f64::max) - ys.fold(f64::INFINITY, f64::min)
}

/// Largest strain of a mesh edge over its length in the cloth's coordinates.
fn strain(part: &Part) -> f64 {
    let of = |i: usize, j: usize| {
        let space = (Vec3::from(part.positions[i]) - Vec3::from(part.positions[j])).norm();
        (space / apart(part.uv[i], part.uv[j]) - 1.0).abs()
    };
    let edges = part.triangles.iter().flat_map(|t| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])]);
    edges.map(|(i, j)| of(i, j)).fold(0.0, f64::max)
}

/// Angle of the dart, and of the warp to +x, degrees.
const WEDGE: f64 = 30.0;
const WARP: f64 = 60.0;

/// A dart of 30° in a piece whose warp lies 30° off its height. In the written GLB the cloth coordinates are the
/// drawing turned by the grain, triangle by triangle. Coordinates differ at one place of the cloth on the dart's legs
/// alone, and there by the width of the wedge.
fn dart(lab: &mut Lab) -> Result<(), String> {
    let half = f64::to_radians(0.5 * WEDGE);
    let (x, y) = (80.0 * libm::sin(half), 80.0 * libm::cos(half));
    let top = 200.0 + y;
    let corners =
        vec![[0.0, 0.0], [400.0, 0.0], [400.0, top], [200.0 + x, top], [200.0, 200.0], [200.0 - x, top], [0.0, top]];
    let sheet = Sheet {
        name: "FRONT",
        corners: corners.clone(),
        grain: WARP,
        material: "cotton",
        translation: [1e3 * lab.nudge(4e-4, 0), 0.0, 0.0],
        back: false,
    };
    let drape = vec!["gravity = \"0 m/s2\"".to_owned()];
    let fabrics = vec![("cotton", cotton())];
    let drawing = Drawing { sheets: vec![sheet], sewing: String::new(), fabrics, body: None, edge: 16.0, drape };
    let accuracy = lab.accuracy().map(str::to_owned);
    let run = lab.program(&[], |folder| drawing.write(folder, accuracy.as_deref()))?;
    good(lab, &run);
    lab.expect(run.record["garment"]["darts"] == 1, "it is no dart");
    let part = glb::parts(run.output("final.glb").ok_or("a GLB")?).pop().ok_or("a mesh")?;
    on_grain(lab, &part, &corners);
    joined_at_legs(lab, &part);
    Ok(())
}

/// Where a texture coordinate lies in the drawing, mm: the grain undone; v counts downwards.
fn drawn(uv: [f64; 2]) -> [f64; 2] {
    let (s, c) = libm::sincos(WARP.to_radians());
    [1e3 * (uv[0] * s - uv[1] * c), 1e3 * (-uv[0] * c - uv[1] * s)]
}

fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}

/// The triangles fill the drawing, as long in the cloth's coordinates as they are in space, and no edge within the
/// piece is cut open. An edge of one triangle alone lies on the outline or on a leg.
fn on_grain(lab: &mut Lab, part: &Part, corners: &[[f64; 2]]) {
    let at: Vec<[f64; 2]> = part.uv.iter().map(|uv| drawn(*uv)).collect();
    let cross = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let areas: Vec<f64> = part.triangles.iter().map(|t| 0.5 * cross(at[t[0]], at[t[1]], at[t[2]])).collect();
    let n = corners.len();
    let whole: f64 = (0..n).map(|k| 0.5 * cross([0.0; 2], corners[k], corners[(k + 1) % n])).sum();
    lab.near("area in the cloth's coordinates", areas.iter().sum(), whole, 1e-6);
    lab.expect(areas.iter().all(|a| *a > 0.0), "a triangle is turned over");
    let missing = corners.iter().filter(|c| !at.iter().any(|p| apart(*p, **c) < 1e-3)).count();
    lab.expect(missing == 0, format!("{missing} corners are not where the grain puts them"));
    let mut users: BTreeMap<[usize; 2], usize> = BTreeMap::new();
    for t in &part.triangles {
        (0..3).map(|k| [t[k], t[(k + 1) % 3]]).for_each(|[i, j]| *users.entry([i.min(j), i.max(j)]).or_default() += 1);
    }
    lab.below("strain of the cloth", strain(part), 0.02);
    let side = |k: usize, p: [f64; 2]| {
        let (a, b) = (corners[k], corners[(k + 1) % n]);
        cross(a, b, p).abs() < 1e-3 * apart(a, b)
    };
    let open = users.iter().filter(|(_, count)| **count == 1).map(|(e, _)| e.map(|v| at[v]));
    let cut = open.filter(|[p, q]| !(0..n).any(|k| side(k, *p) && side(k, *q))).count();
    lab.expect(cut == 0, format!("{cut} edges inside the piece are cut open"));
}

/// Vertices at one place of the cloth with two coordinates lie on the two legs, equally far from the tip.
fn joined_at_legs(lab: &mut Lab, part: &Part) {
    let at: Vec<[f64; 2]> = part.uv.iter().map(|uv| drawn(*uv)).collect();
    let place = |i: usize| Vec3::from(part.positions[i]);
    let together =
        |i: usize| (i + 1..at.len()).filter(move |j| (place(i) - place(*j)).norm() < 1e-4).map(move |j| (i, j));
    let pairs: Vec<(usize, usize)> = (0..at.len()).flat_map(together).collect();
    lab.expect(pairs.len() >= 5, format!("{} pairs along the legs", pairs.len()));
    let wide = 2.0 * libm::sin(0.5 * WEDGE.to_radians());
    for (i, j) in pairs {
        let [s, t] = [i, j].map(|v| apart(at[v], [200.0, 200.0]));
        lab.below("difference of the ways from the tip mm", (s - t).abs(), 0.01);
        lab.below("jump over the seam beside the wedge mm", (apart(at[i], at[j]) - wide * s).abs(), 0.01);
    }
}
