//! Differences of what went in and what was said: inputs, parameters, fabrics, certificate, findings.

use super::change::{Change, Group};
use super::side::Side;
use crate::figures::numbers;
use serde_json::Value;
use std::collections::BTreeMap;
use toile_garment::Garment;

/// Figures that differ by less say nothing.
const LEAST: f64 = 1e-9;

pub fn changes(a: &Side, b: &Side) -> Vec<Change> {
    let mut found = words(Group::Inputs, &inputs(a), &inputs(b));
    found.extend(words(Group::Parameters, &parameters(a), &parameters(b)));
    if let (Some(a), Some(b)) = (&a.garment, &b.garment) {
        found.extend(words(Group::Fabric, &fabrics(a), &fabrics(b)));
    }
    found.extend(certificate(&figures(a), &figures(b)));
    found.extend(words(Group::Findings, &findings(a), &findings(b)));
    found
}

type Words = BTreeMap<String, String>;

/// Words that are not the same on both sides, by name.
fn words(group: Group, a: &Words, b: &Words) -> Vec<Change> {
    let names = a.keys().chain(b.keys().filter(|k| !a.contains_key(*k)));
    names.filter_map(|name| Change::of_words(group, name, a.get(name).cloned(), b.get(name).cloned())).collect()
}

/// Digests of the files that were read, shortened for people. The pipeline file is not among them.
fn inputs(side: &Side) -> Words {
    let short = |digest: &str| digest.chars().take(12).collect::<String>();
    if let Some(garment) = &side.garment {
        return garment.provenance.inputs.iter().map(|i| (i.path.clone(), short(&i.blake3))).collect();
    }
    let all = side.record.iter().flat_map(|r| r["inputs"].as_array().into_iter().flatten().skip(1));
    all.filter_map(|i| Some((i["path"].as_str()?.to_owned(), short(i["blake3"].as_str()?)))).collect()
}

fn parameters(side: &Side) -> Words {
    let mut found = Words::new();
    if let Some(record) = &side.record {
        for stage in record["stages"].as_array().into_iter().flatten() {
            leaves(stage["id"].as_str().unwrap_or_default(), &stage["params"], &mut found);
        }
    } else if let Some(garment) = &side.garment {
        for stage in &garment.provenance.stages {
            leaves(&stage.id, &stage.params, &mut found);
        }
    }
    found
}

fn fabrics(garment: &Garment) -> Words {
    let mut found = Words::new();
    for (name, fabric) in &garment.fabrics {
        let name = if name.is_empty() { "fabric" } else { name };
        leaves(name, &as_written(serde_json::to_value(fabric).unwrap_or_default()), &mut found);
    }
    found
}

/// A fabric whose values stand as its file writes them, with their units.
fn as_written(mut fabric: Value) -> Value {
    let sources = fabric.as_object_mut().and_then(|f| f.remove("sources")).unwrap_or_default();
    for (key, source) in sources.as_object().into_iter().flatten() {
        if source["written"].is_string() {
            fabric[key] = source["written"].clone();
        }
    }
    fabric
}

/// All values of a document by their dotted keys.
fn leaves(name: &str, value: &Value, found: &mut Words) {
    match value {
        Value::Object(map) => map.iter().for_each(|(key, inner)| leaves(&format!("{name}.{key}"), inner, found)),
        Value::String(text) => drop(found.insert(name.to_owned(), text.clone())),
        Value::Null => {}
        other => drop(found.insert(name.to_owned(), other.to_string())),
    }
}

fn figures(side: &Side) -> BTreeMap<String, f64> {
    let own = side.garment.as_ref().and_then(|g| g.certificate.as_ref()).and_then(|c| serde_json::to_value(c).ok());
    let certificate = side.record.as_ref().map(|r| r["certificate"].clone()).or(own).unwrap_or_default();
    numbers(&certificate)
}

fn certificate(a: &BTreeMap<String, f64>, b: &BTreeMap<String, f64>) -> Vec<Change> {
    let both = a.iter().filter_map(|(name, x)| Some((name, [*x, *b.get(name)?])));
    both.filter_map(|(name, both)| {
        let unit = if name.ends_with("_mm") { "mm" } else { "" };
        Change::of_number(Group::Strain, name, both, unit, LEAST)
    })
    .collect()
}

/// Findings by code, with their messages.
fn findings(side: &Side) -> Words {
    let mut found: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for finding in side.record.iter().flat_map(|r| r["findings"].as_array().into_iter().flatten()) {
        let text = |key: &str| finding[key].as_str().unwrap_or_default().to_owned();
        found.entry(text("code")).or_default().push(text("message"));
    }
    found.into_iter().map(|(code, messages)| (code, messages.join("; "))).collect()
}
