//! Settings that trade accuracy for time, put into a chain from outside: by `accuracy` of the head and by `study`.

use super::document::{Document, StageEntry};
use std::borrow::Cow;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The settings that decide how exact a drape is and what it costs. What is `None` stays as the pipeline has it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Tuning {
    /// `edge_length` of `triangulate`, with its unit; takes the place of `triangles` too.
    pub edge_length: Option<String>,
    /// `accuracy` of `drape`: how near to rest.
    pub accuracy: Option<String>,
    /// `model` of `stitch` and `drape`.
    pub model: Option<String>,
    /// `integrator` of `stitch` and `drape`.
    pub integrator: Option<String>,
    /// `effects.self-contact` of `drape`.
    pub self_contact: Option<String>,
}

/// Writes the settings into the stages as if they stood there. `--set` comes later and has the last word.
pub fn tune(document: &mut Document<'_>, tuning: &Tuning) {
    for entry in &mut document.stages {
        let name = entry.name.get_ref().clone();
        match name.as_str() {
            "triangulate" => {
                if tuning.edge_length.is_some() {
                    entry.with.get_mut().remove("triangles");
                }
                put(entry, "edge_length", tuning.edge_length.as_ref());
            }
            "stitch" => tune_method(entry, tuning),
            "drape" => {
                tune_method(entry, tuning);
                put(entry, "accuracy", tuning.accuracy.as_ref());
                put_effect(entry, tuning.self_contact.as_ref());
            }
            _ => {}
        }
    }
}

fn tune_method(entry: &mut StageEntry<'_>, tuning: &Tuning) {
    put(entry, "model", tuning.model.as_ref());
    put(entry, "integrator", tuning.integrator.as_ref());
}

fn put(entry: &mut StageEntry<'_>, key: &'static str, value: Option<&String>) {
    let Some(value) = value else { return };
    let span = entry.with.span();
    let table = entry.with.get_mut();
    table.remove(key);
    let value = Spanned::new(span.clone(), DeValue::String(Cow::Owned(value.clone())));
    table.insert(Spanned::new(span, Cow::Borrowed(key)), value);
}

fn put_effect(entry: &mut StageEntry<'_>, value: Option<&String>) {
    let Some(value) = value else { return };
    let span = entry.with.span();
    let table = entry.with.get_mut();
    if !table.contains_key("effects") {
        let empty = Spanned::new(span.clone(), DeValue::Table(DeTable::new()));
        table.insert(Spanned::new(span.clone(), Cow::Borrowed("effects")), empty);
    }
    if let Some(DeValue::Table(effects)) = table.get_mut("effects").map(Spanned::get_mut) {
        effects.remove("self-contact");
        let value = Spanned::new(span.clone(), DeValue::String(Cow::Owned(value.clone())));
        effects.insert(Spanned::new(span, Cow::Borrowed("self-contact")), value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pipeline::{SourceText, link, parse};
    use toile_garment::Report;

    #[test]
    fn settings_take_the_place_of_what_the_pipeline_says() {
        let text = "toile = 1\n[pipeline]\nline = \"test\"\nversion = 1\n[[stage]]\nuse = \"triangulate\"\n\
                    with.triangles = 2200\n[[stage]]\nuse = \"drape\"\nwith.effects.friction = \"off\"\n";
        let source = SourceText::new("p.toml", text, Vec::new());
        let mut report = Report::default();
        let mut document = parse(&source, &mut report).expect("a pipeline");
        let some = |t: &str| Some(t.to_owned());
        let tuning = Tuning {
            edge_length: some("16 mm"),
            accuracy: some("fine"),
            self_contact: some("off"),
            ..Tuning::default()
        };
        tune(&mut document, &tuning);
        let registry = toile_stages::builtin();
        let pipeline = link(&document, &registry, &mut report);
        let params: Vec<serde_json::Value> = pipeline.steps.iter().map(|s| s.ready.params()).collect();
        assert_eq!((&params[0]["edge_length"], &params[0]["triangles"]), (&"16 mm".into(), &serde_json::Value::Null));
        assert_eq!((&params[1]["accuracy"], &params[1]["model"]), (&"fine".into(), &"coupled".into()));
        assert_eq!(params[1]["effects"]["self-contact"], "off");
        assert_eq!(params[1]["effects"]["friction"], "off");
    }
}
