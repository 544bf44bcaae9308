//! The result of a drape.

use super::program::Ended;
use serde_json::Value;
use std::collections::BTreeMap;
use toile_garment::Vec3;

/// Positions, forces and certificate.
pub struct Draped {
    pub at: Vec<Vec3>,
    /// Force on every pin, N.
    pub reactions: BTreeMap<usize, Vec3>,
    pub settled: bool,
    pub certificate: Value,
}

impl Draped {
    /// Reads `final.obj` and `reactions.json`.
    pub fn read(run: &Ended) -> Result<Self, String> {
        let certificate = run.record["certificate"].clone();
        let settled = certificate["settled"].as_bool().unwrap_or(false);
        Ok(Self { at: positions(run, "final.obj")?, reactions: reactions(run)?, settled, certificate })
    }

    /// Sum of the forces on these pins.
    pub fn reaction(&self, pins: impl IntoIterator<Item = usize>) -> Vec3 {
        pins.into_iter().filter_map(|v| self.reactions.get(&v)).sum()
    }

    pub fn energy(&self) -> f64 {
        self.figure("energy_J")
    }

    /// A figure of the certificate.
    pub fn figure(&self, name: &str) -> f64 {
        self.certificate[name].as_f64().unwrap_or(f64::NAN)
    }

    pub fn mean(&self, vertices: impl IntoIterator<Item = usize>) -> Vec3 {
        let (sum, n) = vertices.into_iter().fold((Vec3::zeros(), 0.0), |(s, n), v| (s + self.at[v], n + 1.0));
        sum / n
    }
}

/// The `v` lines of an OBJ among the outputs.
pub fn positions(run: &Ended, name: &str) -> Result<Vec<Vec3>, String> {
    let text = run.output(name).ok_or_else(|| format!("there is no {name}"))?;
    let text = std::str::from_utf8(text).map_err(|e| e.to_string())?;
    let point = |line: &str| -> Option<Vec3> {
        let mut c = line.strip_prefix("v ")?.split_whitespace().map(|w| w.parse::<f64>().expect("a number"));
        Some(Vec3::new(c.next()?, c.next()?, c.next()?))
    };
    Ok(text.lines().filter_map(point).collect())
}

fn reactions(run: &Ended) -> Result<BTreeMap<usize, Vec3>, String> {
    let bytes = run.output("reactions.json").ok_or("there are no reactions")?;
    let json: Value = serde_json::from_slice(bytes).map_err(|e| e.to_string())?;
    let number = |v: &Value| v.as_f64().unwrap_or(f64::NAN);
    let pin = |p: &Value| {
        let f = &p["force_N"];
        Some((p["index"].as_u64()? as usize, Vec3::new(number(&f[0]), number(&f[1]), number(&f[2]))))
    };
    Ok(json["pins"].as_array().into_iter().flatten().filter_map(pin).collect())
}
