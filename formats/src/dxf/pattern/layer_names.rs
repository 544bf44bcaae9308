//! The layers of a file by name: a user's table of them, and the remedy where the outlines lie on none of the standard.

use super::{codes, is_model_space};
use crate::dxf::findings::Findings;
use crate::dxf::model::{Drawing, Entity, Shape};
use std::collections::BTreeMap;
use toile_garment::Diagnostic;

/// Most layers that are listed in a finding.
const LAYERS: usize = 20;

/// The lines of a file by layer.
pub(super) struct LayerNames {
    /// Lines and points of every layer, and the size of the largest, file units.
    by_name: BTreeMap<String, (usize, f64)>,
}

impl LayerNames {
    /// The layers of a whole file.
    pub fn of_file(drawing: &Drawing) -> Self {
        let blocks = drawing.blocks.iter().filter(|b| !is_model_space(&b.name));
        Self::of(blocks.flat_map(|b| &b.entities).chain(&drawing.entities))
    }

    /// The layers of these entities.
    pub fn of<'a>(entities: impl Iterator<Item = &'a Entity>) -> Self {
        let mut by_name: BTreeMap<String, (usize, f64)> = BTreeMap::new();
        for e in entities {
            let entry = by_name.entry(e.layer.clone()).or_default();
            entry.0 += usize::from(!matches!(e.shape, Shape::Text { .. } | Shape::Insert { .. }));
            entry.1 = entry.1.max(size(&e.shape));
        }
        Self { by_name }
    }

    /// Tells of every layer in the user's table that the file does not have.
    pub fn check_table(&self, table: &BTreeMap<String, String>, findings: &mut Findings) {
        for (layer, _) in table.iter().filter(|(layer, _)| !self.by_name.contains_key(layer.trim())) {
            let text = format!("`layers` names the layer `{layer}`, and the file has no such layer");
            let hint = format!(
                "{}; the left side is a layer of the file, the right side one of the standard or \"ignore\"",
                self.list()
            );
            let at = findings.place(1);
            findings.push(Diagnostic::warning(codes::LAYER_NOT_IN_FILE, text).at(at).hint(hint));
        }
    }

    /// The remedy for a file or block without outlines: the layers that there are, and the line to write.
    pub fn remedy(&self) -> String {
        let largest = self.by_name.iter().filter(|(_, (_, size))| *size > 0.0).max_by(|a, b| a.1.1.total_cmp(&b.1.1));
        let Some((layer, _)) = largest else { return "export as AAMA or ASTM; there is no line at all".to_owned() };
        format!(
            "{}; if the outlines are on `{layer}`, write: with.layers = {{ \"{}\" = \"1\" }}",
            self.list(),
            layer.replace('\\', "\\\\").replace('"', "\\\"")
        )
    }

    fn list(&self) -> String {
        let drawn: Vec<String> =
            self.by_name.iter().filter(|(_, (n, _))| *n > 0).map(|(l, _)| format!("`{l}`")).collect();
        let more = if drawn.len() > LAYERS { format!(" and {} more", drawn.len() - LAYERS) } else { String::new() };
        format!("there are lines on the layers {}{more}", drawn[..drawn.len().min(LAYERS)].join(", "))
    }
}

/// Longer side of the box round an entity, file units.
fn size(shape: &Shape) -> f64 {
    let points = shape.extent();
    let range = |of: fn(&toile_garment::Vec2) -> f64| {
        let (low, high) =
            points.iter().map(of).fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        (high - low).max(0.0)
    };
    if points.is_empty() { 0.0 } else { range(|p| p.x).max(range(|p| p.y)) }
}
