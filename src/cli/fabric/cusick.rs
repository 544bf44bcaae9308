//! `toile fabric test cusick`

use super::args::CusickArgs;
use super::{Sheet, Tested, figure};
use crate::cli::codes;
use crate::codes::WRONG_VALUE;
use serde_json::{Value, json};
use std::fmt::Write as _;
use toile_garment::Diagnostic;
use toile_garment::fabric::Fabric;
use toile_stage_api::{StageContext, StageError};
use toile_stages::fabric_test::cusick::{DISC, SPECIMENS, cusick};
use toile_stages::fabric_test::{Cusick, CusickParams, picture};

/// Share by which repeats of one cloth scatter in the laboratory.
const SCATTER: f64 = 0.05;

pub(super) fn test(args: &CusickArgs, fabric: &Fabric, cx: &mut StageContext<'_>) -> Tested {
    let specimen = specimen(args)?;
    check_lab(args)?;
    let params = |repeat| CusickParams { specimen, edge: args.edge.0, repeat };
    let laid = if args.wrong_side { fabric.turned() } else { fabric.clone() };
    let read = (0..args.repeats).map(|k| cusick(&laid, &params(k), cx)).collect::<Result<Vec<_>, _>>()?;
    let all = Readings { read, lab: args.lab.map(|l| l.0) };
    all.compare(cx);
    let svg = all.read.first().map(|first| picture::cusick(&fabric.name, first)).unwrap_or_default();
    Ok(Sheet { json: all.json(), text: all.text(), svg })
}

fn specimen(args: &CusickArgs) -> Result<f64, StageError> {
    let asked = args.specimen.0;
    SPECIMENS.into_iter().find(|s| (s - asked).abs() < 1e-6).ok_or_else(|| {
        let message = format!("a specimen of {} is not one of the standard's", args.specimen);
        let hint = "write \"24 cm\" (limp), \"30 cm\" (usual) or \"36 cm\" (stiff)";
        StageError::parameter(Diagnostic::error(WRONG_VALUE, message).hint(hint))
    })
}

/// A drape coefficient is a share of the ring around the disc.
fn check_lab(args: &CusickArgs) -> Result<(), StageError> {
    let Some(lab) = args.lab.filter(|lab| !(0.0..=1.0).contains(&lab.0)) else { return Ok(()) };
    let message = format!("--lab: a drape coefficient of {lab} is none; it lies in 0 % to 100 %");
    Err(StageError::parameter(Diagnostic::error(WRONG_VALUE, message).hint("write e.g. \"62 %\"")))
}

/// The readings of one specimen, and the laboratory's.
struct Readings {
    read: Vec<Cusick>,
    lab: Option<f64>,
}

impl Readings {
    fn mean(&self, of: impl Fn(&Cusick) -> f64) -> f64 {
        self.read.iter().map(of).sum::<f64>() / self.read.len().max(1) as f64
    }

    fn coefficient(&self) -> f64 {
        self.mean(|c| c.drape_coefficient)
    }

    /// Largest less least coefficient.
    fn spread(&self) -> f64 {
        let of = |c: &Cusick| c.drape_coefficient;
        let most = self.read.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
        most - self.read.iter().map(of).fold(f64::INFINITY, f64::min)
    }

    fn nodes(&self) -> f64 {
        self.mean(|c| c.nodes.len() as f64)
    }

    fn compare(&self, cx: &mut StageContext<'_>) {
        let Some(lab) = self.lab else { return };
        let off = self.coefficient() - lab;
        if off.abs() > SCATTER {
            let message = format!(
                "the drape coefficient is {:.1} %, {:+.1} points from the laboratory's {:.1} %",
                100.0 * self.coefficient(),
                100.0 * off,
                100.0 * lab
            );
            let hint = "measure bending as a cantilever (FAST-2): its length holds the friction that KES-F gives apart";
            cx.report.push(Diagnostic::warning(codes::DRAPE_DIFFERS_FROM_LAB, message).hint(hint));
        }
    }

    fn json(&self) -> Value {
        let Some(first) = self.read.first() else { return json!({}) };
        json!({
            "standard": "BS 5058, ISO 9073-9",
            "disc_mm": figure(2e3 * DISC),
            "specimen_mm": figure(1e3 * first.params.specimen),
            "edge_mm": figure(1e3 * first.params.edge),
            "triangles": first.triangles,
            "drape_coefficient": figure(self.coefficient()),
            "drape_coefficient_spread": figure(self.spread()),
            "node_count": figure(self.nodes()),
            "lab_drape_coefficient": self.lab.map(figure),
            "readings": self.read.iter().map(reading).collect::<Vec<_>>(),
        })
    }

    fn text(&self) -> String {
        let Some(first) = self.read.first() else { return String::new() };
        let mut text = format!(
            "Cusick drape (BS 5058, ISO 9073-9), disc {:.0} cm, specimen {:.0} cm, edge {} mm, {} triangles\n",
            200.0 * DISC,
            100.0 * first.params.specimen,
            1e3 * first.params.edge,
            first.triangles
        );
        for c in &self.read {
            let _ = writeln!(
                text,
                "  drape coefficient {:>5.1} %   {:>2} nodes, amplitude {:>4.1} mm   radius {:.1} to {:.1} mm, mean {:.1} mm   hem {:.1} mm down",
                100.0 * c.drape_coefficient,
                c.nodes.len(),
                1e3 * c.node_amplitude(),
                1e3 * c.radius_min(),
                1e3 * c.radius_max(),
                1e3 * c.radius_mean(),
                1e3 * c.drop_max
            );
        }
        if self.read.len() > 1 {
            let (mean, spread) = (100.0 * self.coefficient(), 100.0 * self.spread());
            let _ = writeln!(text, "  mean {mean:.1} %, spread {spread:.1} points, {:.1} nodes", self.nodes());
        }
        if let Some(lab) = self.lab {
            let off = 100.0 * (self.coefficient() - lab);
            let _ = writeln!(text, "  laboratory {:.1} %: {off:+.1} points", 100.0 * lab);
        }
        text
    }
}

/// One reading; radii every degree from the weft's direction counter-clockwise.
fn reading(c: &Cusick) -> Value {
    let every = (c.outline.len() / 360).max(1);
    json!({
        "drape_coefficient": figure(c.drape_coefficient),
        "shadow_area_cm2": figure(1e4 * c.shadow_area),
        "node_count": c.nodes.len(),
        "node_amplitude_mm": figure(1e3 * c.node_amplitude()),
        "node_angles_deg": c.node_angles().map(|a| figure(a.to_degrees())).collect::<Vec<_>>(),
        "radius_min_mm": figure(1e3 * c.radius_min()),
        "radius_max_mm": figure(1e3 * c.radius_max()),
        "radius_mean_mm": figure(1e3 * c.radius_mean()),
        "hem_drop_max_mm": figure(1e3 * c.drop_max),
        "hem_drop_mean_mm": figure(1e3 * c.drop_mean),
        "energy_mJ": figure(1e3 * c.energy),
        "outline_radius_mm": c.outline.iter().step_by(every).map(|r| figure(1e3 * r)).collect::<Vec<_>>(),
    })
}
