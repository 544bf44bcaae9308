//! `accuracy = "2 mm"` chooses the cheapest setting whose stated error is no larger.
//!
//! The settings come from the study beside the pipeline. Without a study they come from the presets.

use super::grid::{Setting, word};
use super::presets::{PRESETS, Preset};
use super::report::Study;
use crate::pipeline::Tuning;
use toile_garment::units::{Length, tidy};
use toile_stage_api::Meaning;

/// The accuracy that a pipeline asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wanted {
    /// A named point.
    Preset(&'static Preset),
    /// Hem heights and girths within this, mm.
    Length(f64),
}

/// The chosen setting with its error.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// The setting.
    pub setting: Setting,
    /// Its stated error, mm.
    pub error: f64,
    /// The name of the preset.
    pub preset: Option<&'static str>,
    /// Does the error come from a study of this very garment?
    pub studied: bool,
}

/// Why nothing was chosen.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    /// The least error that is known, mm.
    OutOfReach(f64),
}

/// A length above 0 in a text, mm.
///
/// # Errors
/// When it is none.
pub fn millimetres(text: &str) -> Result<f64, String> {
    let metres = text.parse::<Length>().map_err(|e| e.to_string())?.0;
    if metres > 0.0 { Ok(tidy(1e3 * metres)) } else { Err(format!("`{text}` is not above 0")) }
}

impl Wanted {
    /// Reads the name of a preset or a length.
    ///
    /// # Errors
    /// When it is neither.
    pub fn read(text: &str) -> Result<Self, String> {
        if let Some(preset) = PRESETS.iter().find(|p| p.name == text) {
            return Ok(Self::Preset(preset));
        }
        let names = PRESETS.map(|p| p.name).join(", ");
        let wrong = |why: String| format!("{why}; an accuracy is one of {names}, or a length such as \"2 mm\"");
        millimetres(text).map(Self::Length).map_err(wrong)
    }

    /// Chooses.
    ///
    /// # Errors
    /// When nothing known is as exact.
    pub fn choose(self, study: Option<&Study>) -> Result<Choice, Refusal> {
        match self {
            Self::Preset(preset) => Ok(of_preset(preset, study)),
            Self::Length(mm) => cheapest(mm, study),
        }
    }
}

impl Choice {
    /// Mesh and tolerance as settings of the chain. Model, integrator and contact stay as the pipeline has them.
    #[must_use]
    pub fn tuning(&self) -> Tuning {
        let mut all = tuning(&self.setting);
        all.retain(|meaning, _| matches!(meaning, Meaning::EdgeLength | Meaning::Tolerance));
        all
    }
}

/// A setting as the chain takes it, in full.
#[must_use]
pub fn tuning(setting: &Setting) -> Tuning {
    let edge = setting.edge.map(|mm| (Meaning::EdgeLength, format!("{mm} mm")));
    let rest = [
        (Meaning::Tolerance, word(&setting.accuracy)),
        (Meaning::Model, word(&setting.model)),
        (Meaning::Integrator, word(&setting.integrator)),
        (Meaning::SelfContact, word(&setting.self_contact)),
    ];
    let own = Setting::plain(None);
    let correction = (setting.correction != own.correction).then(|| (Meaning::Correction, word(&setting.correction)));
    let penalty = (setting.penalty != own.penalty).then(|| (Meaning::Penalty, word(&setting.penalty)));
    edge.into_iter().chain(rest).chain(correction).chain(penalty).collect()
}

/// A preset's error is what the study of this garment found; without one it is what the preset promises.
fn of_preset(preset: &'static Preset, study: Option<&Study>) -> Choice {
    let setting = preset.setting();
    let found = study.and_then(|s| {
        let row = s.rows.iter().position(|r| r.done.setting == setting)?;
        s.stated(row)
    });
    Choice { setting, error: found.unwrap_or(preset.bound), preset: Some(preset.name), studied: found.is_some() }
}

fn cheapest(mm: f64, study: Option<&Study>) -> Result<Choice, Refusal> {
    let known: Vec<(f64, Choice)> = study.map_or_else(of_presets, of_study);
    let least = known.iter().map(|(_, c)| c.error).fold(f64::INFINITY, f64::min);
    let good = known.into_iter().filter(|(_, c)| c.error <= mm).min_by(|a, b| a.0.total_cmp(&b.0));
    good.map(|(_, choice)| choice).ok_or(Refusal::OutOfReach(least))
}

fn of_presets() -> Vec<(f64, Choice)> {
    PRESETS.iter().enumerate().map(|(i, p)| (i as f64, of_preset(p, None))).collect()
}

/// Every row of the program's own method that passed its certificate, with its seconds.
fn of_study(study: &Study) -> Vec<(f64, Choice)> {
    let choice = |i: usize| {
        let row = &study.rows[i];
        let preset = Preset::of(&row.done.setting).map(|p| p.name);
        let choice = Choice { setting: row.done.setting, error: study.stated(i)?, preset, studied: true };
        Some((row.done.cpu_seconds, choice)).filter(|_| row.is_good() && row.done.setting.is_own())
    };
    (0..study.rows.len()).filter_map(choice).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_names_and_lengths() {
        assert_eq!(Wanted::read("2 mm"), Ok(Wanted::Length(2.0)));
        assert_eq!(Wanted::read("0.5 cm"), Ok(Wanted::Length(5.0)));
        assert!(matches!(Wanted::read("fine"), Ok(Wanted::Preset(p)) if p.name == "fine"));
        for wrong in ["2", "-1 mm", "coarse", ""] {
            assert!(Wanted::read(wrong).is_err_and(|e| e.contains("draft")), "{wrong}");
        }
    }

    #[test]
    fn the_cheapest_preset_that_promises_enough() {
        for (i, preset) in PRESETS.iter().enumerate() {
            let choice = Wanted::Length(preset.bound).choose(None).expect("a preset");
            assert_eq!((choice.preset, choice.error, choice.studied), (Some(preset.name), preset.bound, false));
            assert!(PRESETS[..i].iter().all(|p| p.bound > preset.bound), "a dearer preset promises more");
        }
        let most = PRESETS[3].bound;
        assert_eq!(Wanted::Length(0.5 * most).choose(None), Err(Refusal::OutOfReach(most)));
    }

    #[test]
    fn a_study_of_the_garment_is_better_than_a_promise() {
        let study = super::super::report::tests::sample();
        let choice = Wanted::Length(2.5).choose(Some(&study)).expect("a setting");
        assert_eq!((choice.setting.edge, choice.error, choice.studied), (Some(22.0), 2.5, true));
        assert_eq!(choice.setting.model, Setting::plain(None).model, "a poorer model that agrees by luck is not taken");
        assert_eq!(Wanted::Length(0.4).choose(Some(&study)), Err(Refusal::OutOfReach(0.5)));
    }
}
