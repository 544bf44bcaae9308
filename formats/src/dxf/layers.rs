//! Layers and what they mean.

use std::collections::BTreeMap;
use toile_garment::notch::NotchKind;

/// Meaning of a layer in AAMA and ASTM files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// 1: cut line and texts.
    Boundary,
    /// 2: corners and run ends.
    Turn,
    /// 3: points on curves.
    Curve,
    /// 4 and 80 to 83; `None` is slit or V by width.
    Notch(Option<NotchKind>),
    /// 5: reference line of the grading.
    GradeReference,
    /// 6: fold of a half piece.
    Mirror,
    /// 7: grain line.
    Grain,
    /// 8: internal lines.
    Internal,
    /// 9 and 10: stripes and plaids.
    Match,
    /// 11: internal cutouts.
    Cutout,
    /// 13: drill holes.
    Drill,
    /// 14: sew line.
    Sew,
    /// 15 and 19: text.
    Annotation,
    /// 84: dense copy of 1.
    DenseBoundary,
    /// 85 and 86: dense copies of 8 and 11.
    DenseOther,
    /// 87: dense copy of 14.
    DenseSew,
    /// Anything else.
    Unknown,
}

/// The word for a layer of the file that is to be left out.
const IGNORE: &str = "ignore";

/// Layer names of the file to layer numbers of the standard.
#[derive(Clone, Debug, Default)]
pub struct Layers {
    remap: BTreeMap<String, String>,
}

impl Layers {
    /// With the user's own table: layer of the file → layer of the standard.
    #[must_use]
    pub fn new(remap: &BTreeMap<String, String>) -> Self {
        Self { remap: remap.iter().map(|(k, v)| (tidy(k).to_owned(), tidy(v).to_owned())).collect() }
    }

    /// Can a layer of a file stand for this one: a layer of the standard, or "ignore"?
    #[must_use]
    pub fn is_target(layer: &str) -> bool {
        tidy(layer) == IGNORE || Self::default().role(layer) != Role::Unknown
    }

    /// Has neither the standard nor the user's table a word on this layer?
    #[must_use]
    pub(crate) fn is_without_word(&self, layer: &str) -> bool {
        !self.remap.contains_key(tidy(layer)) && self.role(layer) == Role::Unknown
    }

    /// Meaning of a layer of the file.
    #[must_use]
    pub fn role(&self, layer: &str) -> Role {
        let layer = tidy(layer);
        match self.remap.get(layer).map_or(layer, String::as_str) {
            "1" => Role::Boundary,
            "2" => Role::Turn,
            "3" => Role::Curve,
            "4" => Role::Notch(None),
            "80" => Role::Notch(Some(NotchKind::T)),
            "81" => Role::Notch(Some(NotchKind::Castle)),
            "82" => Role::Notch(Some(NotchKind::Check)),
            "83" => Role::Notch(Some(NotchKind::U)),
            "5" => Role::GradeReference,
            "6" => Role::Mirror,
            "7" => Role::Grain,
            "8" => Role::Internal,
            "9" | "10" => Role::Match,
            "11" => Role::Cutout,
            "13" => Role::Drill,
            "14" => Role::Sew,
            "15" | "19" => Role::Annotation,
            "84" => Role::DenseBoundary,
            "85" | "86" => Role::DenseOther,
            "87" => Role::DenseSew,
            _ => Role::Unknown,
        }
    }
}

fn tidy(layer: &str) -> &str {
    let layer = layer.trim();
    if layer.len() <= 1 || !layer.bytes().all(|b| b.is_ascii_digit()) {
        return layer;
    }
    let digits = layer.trim_start_matches('0');
    if digits.is_empty() { "0" } else { digits }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trims_and_remaps() {
        let remap = BTreeMap::from([("CUT".to_owned(), "1".to_owned()), ("3".to_owned(), "4".to_owned())]);
        let layers = Layers::new(&remap);
        assert_eq!(layers.role(" CUT "), Role::Boundary);
        assert_eq!(layers.role("3"), Role::Notch(None));
        assert_eq!(layers.role("014"), Role::Sew);
        assert_eq!(layers.role("99"), Role::Unknown);
    }
}
