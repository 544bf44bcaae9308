//! Presets: named points of the front, each with the error it promises.

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
    /// Promised: hem heights and girths differ from the finest by no more than this, mm.
    pub bound: f64,
}

/// The presets, cheapest first.
pub const PRESETS: [Preset; 4] = [
    Preset { name: "draft", edge: 32.0, accuracy: AccuracyName::Draft, bound: 40.0 },
    Preset { name: "normal", edge: 22.0, accuracy: AccuracyName::Normal, bound: 20.0 },
    Preset { name: "fine", edge: 16.0, accuracy: AccuracyName::Normal, bound: 10.0 },
    Preset { name: "reference", edge: 11.0, accuracy: AccuracyName::Normal, bound: 5.0 },
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
