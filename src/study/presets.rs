//! Presets: named points of the front, each with the error it promises.
//!
//! Found by `toile study` on three pipelines of `pipelines/`. The stated errors there, for skirt, T-shirt and bodice: draft
//! 10.6, 10.5 and 7.4 mm; normal 5.8, 6.5 and 5.2 mm; fine 3.5, 4.7 and 3.5 mm; reference 2.7, 3.9 and 2.5 mm. The promises
//! leave room for other garments: they are the largest of these times 1.4 to 1.5. None is more than 2.4 times an error. All
//! have the program's own tolerance of rest: a draft saved nothing and gave the same drape within 0.1 mm.

use super::grid::Setting;

/// A named setting with the error it promises.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preset {
    /// Name, as `accuracy` of a pipeline's head takes it.
    pub name: &'static str,
    /// Length of a mesh edge, mm.
    pub edge: f64,
    /// Promised: hem heights, girths and, in the same folds, 95 % of the surface are off by no more than this, mm; what the
    /// finest mesh of the study is off itself included (`Study::stated`).
    pub bound: f64,
}

/// The presets, cheapest first.
pub const PRESETS: [Preset; 4] = [
    Preset { name: "draft", edge: 32.0, bound: 15.0 },
    Preset { name: "normal", edge: 22.0, bound: 9.0 },
    Preset { name: "fine", edge: 16.0, bound: 7.0 },
    Preset { name: "reference", edge: 11.0, bound: 6.0 },
];

impl Preset {
    /// Its place in the grid.
    #[must_use]
    pub fn setting(&self) -> Setting {
        Setting::plain(Some(self.edge))
    }

    /// The preset of a setting.
    #[must_use]
    pub fn of(setting: &Setting) -> Option<&'static Self> {
        PRESETS.iter().find(|p| p.setting() == *setting)
    }
}
