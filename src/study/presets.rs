//! Presets: named points of the front, each with the error it promises.
//!
//! Found by `toile study` on the three pipelines of `pipelines/`. The stated errors there, for skirt, T-shirt and bodice:
//! draft 1.2, 7.6 and 4.5 mm; normal 1.4, 4.3 and 2.7 mm; fine 0.7, 4.2 and 1.8 mm; reference 0.9, 2.6 and 1.6 mm.
//! Promises leave room for other folds: an earlier solver, that let the T-shirt down less far, was off by 12.4, 9.9, 7.1 and 6.5 mm there.

use super::grid::Setting;
use toile_stages::drape::AccuracyName;

/// A named setting with the length error it promises.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preset {
    /// Name, as `accuracy` of a pipeline's head takes it.
    pub name: &'static str,
    /// Length of a mesh edge, mm.
    pub edge: f64,
    /// How near to rest.
    pub accuracy: AccuracyName,
    /// Promised: hem heights and girths are off by no more than this, mm; what the finest mesh of the study is off itself
    /// included (`Study::stated`).
    pub bound: f64,
}

/// The presets, cheapest first.
pub const PRESETS: [Preset; 4] = [
    Preset { name: "draft", edge: 32.0, accuracy: AccuracyName::Draft, bound: 15.0 },
    Preset { name: "normal", edge: 22.0, accuracy: AccuracyName::Normal, bound: 12.0 },
    Preset { name: "fine", edge: 16.0, accuracy: AccuracyName::Normal, bound: 9.0 },
    Preset { name: "reference", edge: 11.0, accuracy: AccuracyName::Normal, bound: 8.0 },
];

impl Preset {
    /// Its place in the grid.
    #[must_use]
    pub fn setting(&self) -> Setting {
        Setting { accuracy: self.accuracy, ..Setting::plain(Some(self.edge)) }
    }

    /// The preset of a setting.
    #[must_use]
    pub fn of(setting: &Setting) -> Option<&'static Self> {
        PRESETS.iter().find(|p| p.setting() == *setting)
    }
}
