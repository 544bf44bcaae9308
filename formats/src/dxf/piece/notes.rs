//! Texts of a block: keys of the piece, grade rules, labels.

use super::DrawnPiece;
use crate::dxf::chain::Path;
use crate::dxf::geom::PointIndex;
use crate::dxf::sheet::Note;
use crate::dxf::texts;
use toile_garment::Vec2;

impl DrawnPiece {
    pub(super) fn read_notes(&mut self, notes: Vec<Note>) {
        let starts = |p: &Path| [p.points[0].0, p.points[p.points.len() - 1].0];
        let not_mirrored = PointIndex::new(
            0.05,
            notes.iter().enumerate().filter(|(_, n)| n.text.eq_ignore_ascii_case("nm")).map(|(i, n)| (n.at, i)),
        );
        self.not_mirrored =
            self.internal.iter().map(|p| starts(p).iter().any(|s| not_mirrored.has(*s, 0.05))).collect();
        for note in notes {
            if let Some(rule) = texts::rule_number(&note.text) {
                self.rules.push((note.at, rule));
            } else if let Some((key, value)) = texts::key_value(&note.text) {
                self.take_key(&key, value, &note.text, note.at, note.layer);
            } else if !note.text.is_empty() {
                self.texts.push((note.at, note.layer, note.text));
            }
        }
    }

    fn take_key(&mut self, key: &str, value: String, text: &str, at: Vec2, layer: String) {
        match key {
            "piece name" if self.name.is_none() => self.name = Some(value).filter(|v| !v.is_empty()),
            "size" | "size name" | "sample size" if self.size.is_none() => {
                self.size = Some(value).filter(|v| !v.is_empty())
            }
            "quantity" => self.quantity = texts::quantity(&value).unwrap_or_default(),
            "category" | "annotation" | "material" | "fabric" => {
                self.keys.entry(key.to_owned()).or_insert(value);
            }
            _ => self.texts.push((at, layer, text.to_owned())),
        }
    }
}
