//! All tuned numbers and mechanisms of the solver in one table, and experiments with them.
//!
//! `docs/tuning.md` is generated from [`table`]. A build with the feature `experiments` also has `begin`, which reads an
//! experiment file:
//!
//! ```toml
//! off = ["gap-update"]      # mechanisms that do not act
//!
//! [scale]
//! LBFGS_PAIRS = 2.0         # factors of tuned numbers
//! ```

use crate::tuning::{Mechanism, Number};

const NUMBERS: &[&[&dyn Number]] = &[
    crate::collision::tuning::NUMBERS,
    crate::contact::tuning::NUMBERS,
    crate::dynamics::tuning::NUMBERS,
    crate::energy::tuning::NUMBERS,
    crate::explicit::tuning::NUMBERS,
    crate::hierarchy::tuning::NUMBERS,
    crate::linear::tuning::NUMBERS,
    crate::optimize::tuning::NUMBERS,
    crate::prepare::tuning::NUMBERS,
    crate::sewing::tuning::NUMBERS,
];
const MECHANISMS: &[&[&Mechanism]] = &[
    crate::collision::tuning::MECHANISMS,
    crate::contact::tuning::MECHANISMS,
    crate::energy::tuning::MECHANISMS,
    crate::explicit::tuning::MECHANISMS,
    crate::hierarchy::tuning::MECHANISMS,
    crate::linear::tuning::MECHANISMS,
    crate::optimize::tuning::MECHANISMS,
    crate::prepare::tuning::MECHANISMS,
    crate::sewing::tuning::MECHANISMS,
];

fn numbers() -> impl Iterator<Item = &'static dyn Number> {
    NUMBERS.iter().flat_map(|room| room.iter().copied())
}

fn mechanisms() -> impl Iterator<Item = &'static Mechanism> {
    MECHANISMS.iter().flat_map(|room| room.iter().copied())
}

/// Names of all tuned numbers, room by room.
#[must_use]
pub fn number_names() -> Vec<&'static str> {
    numbers().map(|n| n.about().name).collect()
}

/// Names of all mechanisms that can be switched off, room by room.
#[must_use]
pub fn mechanism_names() -> Vec<&'static str> {
    mechanisms().map(|m| m.name).collect()
}

fn joined(lines: &[&str]) -> String {
    lines.iter().map(|l| l.trim()).collect::<Vec<_>>().join(" ")
}

/// The text of `docs/tuning.md`: mechanisms and tuned numbers of every room, in Markdown.
#[must_use]
pub fn table() -> String {
    let mut text = String::from(
        "# Tuned numbers and mechanisms of the solver\n\n\
         This page is generated from the files `stages/cloth/src/*/tuning.rs`. CONTRIBUTING.md tells how to write it anew,\n\
         and how to switch a mechanism off or scale a number in an experiment.\n\n\
         ## Mechanisms\n\n| room | name | task |\n|---|---|---|\n",
    );
    for m in mechanisms() {
        text += &format!("| {} | `{}` | {} |\n", m.room, m.name, joined(m.task));
    }
    let mut room = "";
    for n in numbers() {
        let a = n.about();
        if a.room != room {
            room = a.room;
            text += &format!(
                "\n## Numbers of {room}\n\n| name | value | unit | meaning | larger | smaller | tried | evidence |\n\
                 |---|---|---|---|---|---|---|---|\n"
            );
        }
        text += &format!(
            "| `{}` | {} | {} | {} | {} | {} | {} | {} |\n",
            a.name,
            n.value(),
            a.unit,
            joined(a.meaning),
            a.larger,
            a.smaller,
            a.tried,
            a.evidence
        );
    }
    text
}

/// Begins an experiment, before any scene is solved.
///
/// # Errors
/// A text that is no experiment, a name that is no number or mechanism, or an experiment that has begun before.
#[cfg(feature = "experiments")]
pub fn begin(text: &str) -> Result<(), String> {
    use crate::tuning::store;
    #[derive(serde::Deserialize)]
    #[serde(deny_unknown_fields)]
    struct File {
        #[serde(default)]
        off: std::collections::BTreeSet<String>,
        #[serde(default)]
        scale: std::collections::BTreeMap<String, f64>,
    }
    let File { off, scale } = toml::from_str(text).map_err(|e| e.to_string())?;
    if let Some(name) = off.iter().find(|name| mechanisms().all(|m| m.name != name.as_str())) {
        return Err(format!("there is no mechanism `{name}`; there are: {}", mechanism_names().join(", ")));
    }
    if let Some(name) = scale.keys().find(|name| numbers().all(|n| n.about().name != name.as_str())) {
        return Err(format!("there is no tuned number `{name}`; docs/tuning.md lists all"));
    }
    if store::begin(store::Experiment { off, scale }) { Ok(()) } else { Err("an experiment has begun before".into()) }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_unique() {
        for mut names in [number_names(), mechanism_names()] {
            let all = names.len();
            names.sort_unstable();
            names.dedup();
            assert_eq!(names.len(), all);
        }
    }

    /// `TOILE_BLESS=1` writes the page anew.
    #[test]
    fn the_tuning_page_is_not_stale() {
        let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/tuning.md");
        if std::env::var_os("TOILE_BLESS").is_some() {
            std::fs::write(page, table()).unwrap();
        }
        assert!(
            std::fs::read_to_string(page).unwrap() == table(),
            "docs/tuning.md is stale; TOILE_BLESS=1 writes it anew"
        );
    }
}
