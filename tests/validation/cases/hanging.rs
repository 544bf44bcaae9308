//! Sheets that hang by their upper edge: elongation and strain of the linear, stiffening and limited law.

use crate::case::{Case, case, share, within};
use crate::closed::{G, hanging};
use crate::lab::Lab;
use crate::support::cloth::{Cloth, Law};
use crate::support::draped::Draped;
use crate::support::mesh::{FAMILIES, Family, Mesh, sheet};
use crate::support::trial::Trial;
use toile_garment::Vec3;

const LENGTH: f64 = 1.0;
const ROWS: usize = 40;
const CELLS: usize = 3;

pub fn cases() -> Vec<Case> {
    let mut list = Vec::new();
    for f in FAMILIES {
        let name = |kind: &str| format!("hang-{kind}-0.{}", f.name());
        let linear = case(name("linear"), move |lab: &mut Lab| linear(lab, f));
        list.push(if f == Family::Right { linear.quick() } else { linear });
        list.push(case(name("exp"), move |lab: &mut Lab| exponential(lab, f)));
        list.push(case(name("limit"), move |lab: &mut Lab| limited(lab, f)));
    }
    list
}

/// Vertices of the rows by their rest place along the warp.
struct Hung {
    mesh: Mesh,
    draped: Draped,
}

fn hang(lab: &mut Lab, family: Family, fabric: Cloth) -> Result<Hung, String> {
    // Regular rows throughout, so that the strain of a row is a row's; the shaken family is shaken below.
    let calm = |v: f64| !(0.1..=LENGTH - 0.1).contains(&v);
    let mesh = sheet::sheet([0.075, LENGTH], CELLS, ROWS, family, calm).place(|[u, v]| Vec3::new(u, 0.0, v));
    let top = mesh.pick(|r| r[1] > LENGTH - 1e-9);
    let trial = Trial::new(mesh, fabric).hold(top);
    let draped = lab.drape(&trial)?;
    Ok(Hung { mesh: trial.cloth, draped })
}

impl Hung {
    /// Mean height of the vertices at this rest height.
    fn height(&self, v: f64) -> f64 {
        self.draped.mean(self.mesh.pick(|r| (r[1] - v).abs() < 1e-9)).z
    }

    fn elongation(&self) -> f64 {
        LENGTH - self.height(0.0) - LENGTH
    }

    /// Strain at the upper edge, from the first two rows of cells on a straight line.
    fn top_strain(&self) -> f64 {
        let h = LENGTH / ROWS as f64;
        let strain = |i: f64| (self.height(LENGTH - i * h) - self.height(LENGTH - (i + 1.0) * h)) / h - 1.0;
        strain(0.0) + 0.5 * (strain(0.0) - strain(1.0))
    }
}

fn linear(lab: &mut Lab, family: Family) -> Result<(), String> {
    let (w, k) = (1.962, 200.0);
    let h = hang(lab, family, Cloth::linear(w / G, k, 20.0, 0.0))?;
    lab.figure("elongation m", h.elongation(), hanging::elongation(LENGTH, w, |t| t / k), share(1e-3, 1e-2));
    lab.figure("top strain", h.top_strain(), w * LENGTH / k, share(5e-3, 3e-2));
    Ok(())
}

fn exponential(lab: &mut Lab, family: Family) -> Result<(), String> {
    let (w, k0, beta) = (1.962, 60.0, 25.0);
    let fabric = Cloth { warp: Law::Exponential { k0, beta }, ..Cloth::linear(w / G, 60.0, 20.0, 0.0) };
    let h = hang(lab, family, fabric)?;
    let strain = hanging::exponential(k0, beta);
    lab.figure("elongation m", h.elongation(), hanging::elongation(LENGTH, w, &strain), share(1e-3, 1e-2));
    lab.figure("top strain", h.top_strain(), strain(w * LENGTH), share(5e-3, 3e-2));
    Ok(())
}

fn limited(lab: &mut Lab, family: Family) -> Result<(), String> {
    let (w, k, limit) = (9.81, 100.0, 0.05);
    let h = hang(lab, family, Cloth { limit, ..Cloth::linear(w / G, k, 20.0, 0.0) })?;
    let expected = hanging::elongation(LENGTH, w, |t| (t / k).min(limit));
    lab.figure("elongation m", h.elongation(), expected, share(5e-3, 5e-2));
    let step = LENGTH / ROWS as f64;
    let strains: Vec<f64> =
        (0..ROWS).map(|i| (h.height((i + 1) as f64 * step) - h.height(i as f64 * step)) / step - 1.0).collect();
    if family != Family::Irregular {
        let full = strains.iter().filter(|e| **e > 0.99 * limit).count() as f64 / ROWS as f64;
        lab.figure("saturated fraction", full, 1.0 - k * limit / (w * LENGTH), within(0.02, 0.1));
    }
    let most = h.draped.certificate["strain_max"].as_f64().unwrap_or(f64::NAN);
    lab.figure("largest strain", most.max(limit), limit, share(1e-3, 1e-2));
    Ok(())
}
