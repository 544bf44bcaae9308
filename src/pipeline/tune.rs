//! Settings that trade accuracy for time, put into a chain from outside: by `accuracy` of the head and by `study`.

use super::chain::Pipeline;
use super::document::{Document, StageEntry};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::Range;
use toile_stage_api::{AnyStage, Knob, Meaning, Registry};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The settings that decide how exact a drape is and what it costs, each in the words of its meaning. What is not
/// there stays as the pipeline has it.
pub type Tuning = BTreeMap<Meaning, String>;

/// Writes the settings into the stages that have knobs for them, as if they stood there. `--set` comes later and has the
/// last word.
pub fn tune<'a>(document: &mut Document<'a>, registry: &Registry, tuning: &'a Tuning) {
    for entry in &mut document.stages {
        let knobs = registry.get(entry.name.get_ref()).map_or(&[][..], |s| s.knobs());
        for knob in knobs {
            if let Some(value) = tuning.get(&knob.meaning) {
                turn(entry, knob, value);
            }
        }
    }
}

/// Writes a value into the stages that have a knob for it and say nothing themselves.
pub fn offer(document: &mut Document<'_>, registry: &Registry, meaning: Meaning, value: &str) {
    for entry in &mut document.stages {
        let knobs = registry.get(entry.name.get_ref()).map_or(&[][..], |s| s.knobs());
        let Some(knob) = knob(knobs, meaning) else { continue };
        let span = entry.with.span();
        let table = entry.with.get_mut();
        if !table.contains_key(knob.key.as_ref()) {
            let here = |value| Spanned::new(span.clone(), value);
            let key = Spanned::new(span.clone(), Cow::Owned(knob.key.to_string()));
            table.insert(key, here(DeValue::String(Cow::Owned(value.to_owned()))));
        }
    }
}

/// Name and key of the first stage that has a knob of this meaning: the one to tell of where a chain has none.
#[must_use]
pub fn turned_by(registry: &Registry, meaning: Meaning) -> (String, String) {
    let of = |s: &dyn AnyStage| Some((s.info().name.into_owned(), knob(s.knobs(), meaning)?.key.to_string()));
    registry.iter().find_map(of).unwrap_or_default()
}

/// The knob of this meaning.
#[must_use]
pub fn knob(knobs: &[Knob], meaning: Meaning) -> Option<&Knob> {
    knobs.iter().find(|k| k.meaning == meaning)
}

/// Cuts the chain behind its drape, the last stage that can be told how near to rest, and takes out taps before it: they
/// write files and change nothing. False where there is none.
pub fn cut_behind_drape(pipeline: &mut Pipeline<'_>) -> bool {
    let Some(last) = pipeline.steps.iter().rposition(|s| knob(s.ready.knobs(), Meaning::Tolerance).is_some()) else {
        return false;
    };
    pipeline.steps.truncate(last + 1);
    pipeline.steps.retain(|s| !s.ready.info().gives.is_empty());
    true
}

fn turn<'a>(entry: &mut StageEntry<'a>, knob: &Knob, value: &'a str) {
    let span = entry.with.span();
    let table = entry.with.get_mut();
    if let Some(other) = &knob.instead_of {
        table.remove(other.as_ref());
    }
    put(table, &span, &knob.key, value);
}

/// Puts a value, a whole number or else a text, at a key with dots; inner tables are made where they are missing.
fn put<'a>(table: &mut DeTable<'a>, span: &Range<usize>, key: &str, value: &'a str) {
    let here = |value| Spanned::new(span.clone(), value);
    let named = |key: &str| Spanned::new(span.clone(), Cow::Owned(key.to_owned()));
    let Some((first, rest)) = key.split_once('.') else {
        table.remove(key);
        let number = DeValue::parse(value).map(Spanned::into_inner).ok().filter(DeValue::is_integer);
        table.insert(named(key), here(number.unwrap_or(DeValue::String(Cow::Borrowed(value)))));
        return;
    };
    if !table.contains_key(first) {
        table.insert(named(first), here(DeValue::Table(DeTable::new())));
    }
    if let Some(DeValue::Table(inner)) = table.get_mut(first).map(Spanned::get_mut) {
        put(inner, span, rest, value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pipeline::{SourceText, link, parse};
    use toile_garment::Report;

    #[test]
    fn an_override_takes_the_place_of_what_the_file_says_in_another_word() {
        let meshed = |size: &str, sets: &[&str]| {
            let text = format!(
                "toile = 1\n[pipeline]\nline = \"test\"\nversion = 1\n[[stage]]\nuse = \"triangulate\"\nwith.{size}\n"
            );
            let source = SourceText::new("p.toml", &text, sets.iter().map(|s| (*s).to_owned()).collect());
            let mut report = Report::default();
            let document = parse(&source, &mut report).expect("a pipeline");
            let registry = toile_stages::builtin();
            let pipeline = link(&document, &registry, &mut report);
            pipeline
                .steps
                .first()
                .map(|s| [s.ready.params()["edge_length"].clone(), s.ready.params()["triangles"].clone()])
        };
        let null = serde_json::Value::Null;
        let by_edge = Some(["16 mm".into(), null.clone()]);
        assert_eq!(meshed("triangles = 2200", &["triangulate.edge_length=16 mm"]), by_edge);
        assert_eq!(meshed("edge_length = \"16 mm\"", &["triangulate.triangles=300"]), Some([null, 300.into()]));
    }

    #[test]
    fn what_is_offered_is_taken_where_the_pipeline_says_nothing() {
        let text = "toile = 1\n[pipeline]\nline = \"test\"\nversion = 1\n[[stage]]\nuse = \"export-report\"\n\
                    [[stage]]\nuse = \"export-report\"\nwith.study = \"own.json\"\n[[stage]]\nuse = \"drape\"\n";
        let source = SourceText::new("p.toml", text, Vec::new());
        let mut report = Report::default();
        let mut document = parse(&source, &mut report).expect("a pipeline");
        let registry = toile_stages::builtin();
        offer(&mut document, &registry, Meaning::Study, "p.study.json");
        let pipeline = link(&document, &registry, &mut report);
        let studies: Vec<_> = pipeline.steps.iter().map(|s| s.ready.params()["study"].clone()).collect();
        assert_eq!(studies, ["p.study.json".into(), "own.json".into(), serde_json::Value::Null]);
    }

    #[test]
    fn settings_take_the_place_of_what_the_pipeline_says() {
        let text = "toile = 1\n[pipeline]\nline = \"test\"\nversion = 1\n[[stage]]\nuse = \"triangulate\"\n\
                    with.triangles = 2200\n[[stage]]\nuse = \"drape\"\nwith.effects.friction = \"off\"\n";
        let source = SourceText::new("p.toml", text, Vec::new());
        let mut report = Report::default();
        let mut document = parse(&source, &mut report).expect("a pipeline");
        let asked = [(Meaning::EdgeLength, "16 mm"), (Meaning::Tolerance, "fine"), (Meaning::SelfContact, "off")];
        let tuning: Tuning = asked.into_iter().map(|(m, t)| (m, t.to_owned())).collect();
        let registry = toile_stages::builtin();
        tune(&mut document, &registry, &tuning);
        let pipeline = link(&document, &registry, &mut report);
        let params: Vec<serde_json::Value> = pipeline.steps.iter().map(|s| s.ready.params()).collect();
        assert_eq!((&params[0]["edge_length"], &params[0]["triangles"]), (&"16 mm".into(), &serde_json::Value::Null));
        assert_eq!((&params[1]["accuracy"], &params[1]["model"]), (&"fine".into(), &"coupled".into()));
        assert_eq!(params[1]["effects"]["self-contact"], "off");
        assert_eq!(params[1]["effects"]["friction"], "off");
    }
}
