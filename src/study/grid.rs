//! Which settings a study runs: the axes, and the order from cheap to dear.

use super::presets::PRESETS;
use serde::{Deserialize, Serialize};
use toile_stages::drape::{AccuracyName, CorrectionName, IntegratorName, ModelName, PenaltyName, SwitchName};

/// One point of the grid: everything that trades accuracy for time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct Setting {
    /// Length of a mesh edge, mm; `None` where the chain has no `triangulate` that could be told.
    #[serde(rename = "edge_mm")]
    pub edge: Option<f64>,
    /// How near to rest.
    pub accuracy: AccuracyName,
    /// In-plane model.
    pub model: ModelName,
    /// Integrator.
    pub integrator: IntegratorName,
    /// Correction of over-elongation, by central differences.
    #[serde(default)]
    pub correction: CorrectionName,
    /// Force of a contact by its distance, by central differences.
    #[serde(default)]
    pub penalty: PenaltyName,
    /// Cloth against cloth.
    #[serde(rename = "self_contact")]
    pub self_contact: SwitchName,
}

impl Setting {
    /// The program's own choice of everything, at an edge length in mm.
    #[must_use]
    pub fn plain(edge: Option<f64>) -> Self {
        Self {
            edge,
            accuracy: AccuracyName::default(),
            model: ModelName::default(),
            integrator: IntegratorName::default(),
            correction: CorrectionName::default(),
            penalty: PenaltyName::default(),
            self_contact: SwitchName::default(),
        }
    }

    /// Differs from another setting in the edge length at most.
    #[must_use]
    pub fn same_but_for_edge(&self, other: &Self) -> bool {
        Self { edge: None, ..*self } == Self { edge: None, ..*other }
    }

    /// Takes model, integrator and contact as the program does. Only such settings are recommended: where a poorer model
    /// agrees on one garment, that is luck.
    #[must_use]
    pub fn is_own(&self) -> bool {
        Self { accuracy: AccuracyName::default(), ..*self } == Self::plain(self.edge)
    }

    /// The name of its folder: `16mm-normal`, and what departs from the program's own choice.
    #[must_use]
    pub fn name(&self) -> String {
        let edge = self.edge.map_or_else(|| "mesh".to_owned(), |mm| format!("{mm}mm"));
        let own = Self::plain(self.edge);
        let mut name = format!("{edge}-{}", word(&self.accuracy));
        if self.model != own.model {
            name = format!("{name}-{}", word(&self.model));
        }
        if self.integrator != own.integrator {
            name = format!("{name}-{}", word(&self.integrator));
        }
        if self.correction != own.correction {
            name = format!("{name}-{}", word(&self.correction));
        }
        if self.penalty != own.penalty {
            name = format!("{name}-{}", word(&self.penalty));
        }
        if self.self_contact != own.self_contact {
            name = format!("{name}-self-contact-{}", word(&self.self_contact));
        }
        name
    }

    /// About how dear it is, beside the others: for the order and for what comes next.
    #[must_use]
    pub fn weight(&self) -> f64 {
        let mesh = self.edge.map_or(1.0, |mm| libm::pow(10.0 / mm, 2.6));
        let rest = match self.accuracy {
            AccuracyName::Draft => 0.9,
            AccuracyName::Normal => 1.0,
            AccuracyName::Fine => 1.1,
            AccuracyName::Reference => 1.2,
        };
        let steps = if self.integrator == IntegratorName::Static { 1.0 } else { 4.0 };
        mesh * rest * steps
    }
}

/// A value in the word that pipelines use for it.
#[must_use]
pub fn word(value: &impl Serialize) -> String {
    serde_json::to_value(value).ok().and_then(|v| v.as_str().map(str::to_owned)).unwrap_or_default()
}

/// The settings that a study varies.
#[derive(Clone, Debug, PartialEq)]
pub struct Axes {
    /// Edge lengths, mm.
    pub edges: Vec<f64>,
    /// Tolerances of the rest.
    pub accuracies: Vec<AccuracyName>,
    /// In-plane models.
    pub models: Vec<ModelName>,
    /// Integrators.
    pub integrators: Vec<IntegratorName>,
    /// Cloth against cloth.
    pub self_contact: Vec<SwitchName>,
    /// Every combination, not only the ladder of edge lengths with departures from it.
    pub full: bool,
}

impl Default for Axes {
    fn default() -> Self {
        Self {
            edges: vec![32.0, 22.0, 16.0, 11.0, 8.0],
            accuracies: vec![AccuracyName::Normal],
            models: vec![ModelName::Coupled, ModelName::Springs],
            integrators: vec![IntegratorName::Static, IntegratorName::CentralDifference],
            self_contact: vec![SwitchName::Auto, SwitchName::Off],
            full: false,
        }
    }
}

impl Axes {
    /// The settings to run, cheapest first; the last is the finest, which the others are measured by.
    ///
    /// The ladder takes every edge length with the program's own choice of the rest. One departure at a time is tried on
    /// the coarser half of the ladder, other integrators on its coarsest mesh alone: explicit steps get ever shorter on
    /// finer ones. `full` runs every combination instead. Presets between the ends of the ladder are always among them.
    #[must_use]
    pub fn settings(&self, has_mesh_stage: bool) -> Vec<Setting> {
        let edges = if has_mesh_stage { self.ladder() } else { vec![None] };
        let mut all = if self.full { self.product(&edges) } else { self.star(&edges) };
        if has_mesh_stage && !self.full {
            all.extend(self.presets());
        }
        let finest = self.finest(&edges);
        all.retain(|s| s.edge != finest.edge || edges.len() == 1);
        all.push(finest);
        all.sort_by(|a, b| a.weight().total_cmp(&b.weight()));
        let mut once: Vec<Setting> = Vec::new();
        for s in all {
            if s != finest && !once.contains(&s) {
                once.push(s);
            }
        }
        once.push(finest);
        once
    }

    /// Edge lengths from long to short.
    fn ladder(&self) -> Vec<Option<f64>> {
        let mut edges = self.edges.clone();
        edges.sort_by(|a, b| b.total_cmp(a));
        edges.dedup();
        edges.into_iter().map(Some).collect()
    }

    fn finest(&self, edges: &[Option<f64>]) -> Setting {
        let own = Setting::plain(edges.last().copied().flatten());
        let strictest = self.accuracies.iter().copied().max_by_key(|a| *a as u8);
        Setting { accuracy: strictest.unwrap_or(own.accuracy), ..own }
    }

    fn presets(&self) -> impl Iterator<Item = Setting> {
        let longest = self.edges.iter().copied().fold(0.0, f64::max);
        let shortest = self.edges.iter().copied().fold(f64::INFINITY, f64::min);
        PRESETS
            .iter()
            .map(super::presets::Preset::setting)
            .filter(move |s| s.edge.is_some_and(|mm| mm <= longest && mm > shortest))
    }

    fn star(&self, edges: &[Option<f64>]) -> Vec<Setting> {
        let mut all: Vec<Setting> = edges.iter().map(|e| Setting::plain(*e)).collect();
        for edge in &edges[..edges.len().div_ceil(2)] {
            let own = Setting::plain(*edge);
            all.extend(self.accuracies.iter().map(|a| Setting { accuracy: *a, ..own }));
            all.extend(self.models.iter().map(|m| Setting { model: *m, ..own }));
            all.extend(self.self_contact.iter().map(|s| Setting { self_contact: *s, ..own }));
        }
        let coarsest = Setting::plain(edges.first().copied().flatten());
        all.extend(self.integrators.iter().map(|i| Setting { integrator: *i, ..coarsest }));
        all
    }

    fn product(&self, edges: &[Option<f64>]) -> Vec<Setting> {
        let mut all = Vec::new();
        for edge in edges {
            for accuracy in &self.accuracies {
                for model in &self.models {
                    for integrator in &self.integrators {
                        all.extend(self.self_contact.iter().map(|self_contact| Setting {
                            accuracy: *accuracy,
                            model: *model,
                            integrator: *integrator,
                            self_contact: *self_contact,
                            ..Setting::plain(*edge)
                        }));
                    }
                }
            }
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_finest_comes_last_and_nothing_twice() {
        for full in [false, true] {
            let all = Axes { full, ..Axes::default() }.settings(true);
            let finest = all.last().expect("some");
            assert_eq!((finest.edge, finest.accuracy), (Some(8.0), AccuracyName::Normal));
            assert_eq!(all.iter().filter(|s| s.edge == Some(8.0)).count(), 1, "the finest mesh is dear: once");
            let names: std::collections::BTreeSet<String> = all.iter().map(Setting::name).collect();
            assert_eq!(names.len(), all.len());
        }
        assert_eq!(Axes { full: true, ..Axes::default() }.settings(true).len(), 4 * 2 * 2 * 2 + 1);
    }

    #[test]
    fn presets_are_among_the_settings() {
        let all = Axes::default().settings(true);
        for preset in PRESETS {
            assert!(all.contains(&preset.setting()), "{}", preset.name);
        }
    }

    #[test]
    fn a_mesh_from_a_file_keeps_its_edges() {
        let accuracies = vec![AccuracyName::Draft, AccuracyName::Normal, AccuracyName::Fine];
        let all = Axes { accuracies, ..Axes::default() }.settings(false);
        assert!(all.iter().all(|s| s.edge.is_none()));
        assert_eq!(all.last().map(|s| s.accuracy), Some(AccuracyName::Fine));
    }

    #[test]
    fn names_tell_what_departs() {
        let own = Setting::plain(Some(16.0));
        assert_eq!(own.name(), "16mm-normal");
        let other = Setting { model: ModelName::Springs, self_contact: SwitchName::Off, ..own };
        assert_eq!(other.name(), "16mm-normal-springs-self-contact-off");
        assert!(own.same_but_for_edge(&Setting::plain(Some(8.0))) && !own.same_but_for_edge(&other));
    }
}
