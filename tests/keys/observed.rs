//! A project that is run, and what can be seen of its result.

use super::project;
use crate::support::bench::{Bench, list};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use toile_formats::gltf;

/// Parts of the document that only repeat what the files say.
const AS_READ: [&str; 4] = ["body", "fabrics", "plan", "provenance"];
/// Outputs that hold such copies; the garment of the GLB is looked at instead.
const WITH_COPIES: [&str; 4] = [".glb", ".html", "report.json", "run.json"];

/// All that a user can see of a run, apart from times.
#[derive(PartialEq)]
pub struct Observed {
    exit: u8,
    findings: Vec<String>,
    certificate: Value,
    garment: Value,
    files: BTreeMap<String, Option<Vec<u8>>>,
}

impl Observed {
    /// Exit code.
    pub fn exit(&self) -> u8 {
        self.exit
    }
}

impl std::fmt::Debug for Observed {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "exit {}: {:#?} {}", self.exit, self.findings, self.certificate)
    }
}

/// A project before it is run.
pub struct Project {
    bench: Bench,
    name: &'static str,
    set: Vec<String>,
}

impl Project {
    /// The project of this name, as `project` writes it.
    pub fn new(name: &'static str) -> Self {
        let bench = Bench::new();
        project::write(&bench, name);
        Self { bench, name, set: Vec::new() }
    }

    /// With these changes, `key=value` in the words of TOML: overrides of the pipeline, or keys of a file.
    pub fn changed<'a>(mut self, file: &str, changes: impl Iterator<Item = &'a str>) -> Self {
        if file == "pipeline" {
            // A key in a list that the pipeline writes is changed there.
            let text = std::fs::read_to_string(self.bench.pipeline_file()).expect("pipeline");
            let has_lists = text.contains("[[stage.with.");
            let is_in_list = |c: &&str| has_lists && c.split_once('=').is_some_and(|(key, _)| key.contains('['));
            let (in_lists, set): (Vec<&str>, Vec<&str>) = changes.partition(is_in_list);
            self.set.extend(set.into_iter().map(str::to_owned));
            in_lists.into_iter().for_each(|change| self.change_stage(change));
            return self;
        }
        let path = self.bench.pipeline_file().with_file_name(format!("{file}.toml"));
        let text = std::fs::read_to_string(&path).expect("file");
        let mut table: toml::Table = toml::from_str(&text).expect("TOML");
        for change in changes {
            let (key, value) = change.split_once('=').expect("key=value");
            let value: toml::Table =
                toml::from_str(&format!("v = {value}")).unwrap_or_else(|e| panic!("{change}: {e}"));
            put(&mut table, key, value["v"].clone());
        }
        std::fs::write(path, toml::to_string(&table).expect("TOML")).expect("file");
        self
    }

    /// Changes a key of a stage in the pipeline, `stage.list[0].key=value`.
    fn change_stage(&self, change: &str) {
        let path = self.bench.pipeline_file();
        let text = std::fs::read_to_string(&path).expect("pipeline");
        let mut table: toml::Table = toml::from_str(&text).expect("TOML");
        let (key, value) = change.split_once('=').expect("key=value");
        let (name, key) = key.split_once('.').expect("stage.key");
        let value: toml::Table = toml::from_str(&format!("v = {value}")).unwrap_or_else(|e| panic!("{change}: {e}"));
        let stages = table["stage"].as_array_mut().expect("stages").iter_mut().filter_map(toml::Value::as_table_mut);
        let stage = stages.into_iter().find(|s| s["use"].as_str() == Some(name)).expect("the stage");
        let with = stage.entry("with").or_insert(toml::Value::Table(toml::Table::new()));
        put(with.as_table_mut().expect("parameters"), key, value["v"].clone());
        std::fs::write(path, toml::to_string(&table).expect("TOML")).expect("pipeline");
    }

    /// Runs it.
    pub fn observe(self) -> Observed {
        let set: Vec<&str> = self.set.iter().flat_map(|s| ["--set", s.as_str()]).collect();
        let said = self.bench.run(&set);
        assert_ne!(said.code, 5, "{} {:?}: {said:?}", self.name, self.set);
        let mut out = Observed {
            exit: said.code,
            findings: Vec::new(),
            certificate: Value::Null,
            garment: Value::Null,
            files: BTreeMap::new(),
        };
        if !self.bench.out().exists() {
            out.findings = said.err.lines().map(str::to_owned).collect();
            return out;
        }
        let record = self.bench.record();
        let told = record["findings"].as_array().cloned().unwrap_or_default();
        out.findings = told.iter().map(|f| format!("{} {} {}", f["code"], f["message"], f["severity"])).collect();
        out.certificate = [record["certificate"].clone(), record["motion"].clone()].into();
        for name in list(&self.bench.out()) {
            let bytes = std::fs::read(self.bench.out().join(&name)).ok();
            if name.ends_with(".glb") {
                out.garment = garment(bytes.as_deref().unwrap_or_default());
            }
            let has_copies = WITH_COPIES.iter().any(|end| name.ends_with(end));
            let language = bytes.as_deref().filter(|_| name.ends_with(".html")).map(language);
            out.files.insert(name, language.or(bytes.filter(|_| !has_copies)));
        }
        out
    }
}

/// The tag of a page with its language; the rest of a page holds copies of what was read.
fn language(page: &[u8]) -> Vec<u8> {
    page.split(|b| *b == b'\n').find(|line| line.starts_with(b"<html")).unwrap_or_default().to_vec()
}

/// The garment in a GLB without copies of what was read, and what else the GLB shows.
fn garment(glb: &[u8]) -> Value {
    // One that is packed for the web is for others to read.
    let name = b"EXT_meshopt_compression";
    if glb.windows(name.len()).any(|w| w == name) {
        return json!({ "glb": "packed for the web" });
    }
    let garment = gltf::read_garment(glb).expect("a garment");
    let mut value = serde_json::to_value(&garment).expect("JSON");
    let inside = gltf::inspect(glb).expect("a GLB");
    if let Some(parts) = value.as_object_mut() {
        AS_READ.iter().for_each(|part| drop(parts.remove(*part)));
        let has = |word: &[u8]| glb.windows(word.len()).any(|w| w == word);
        let (is_packed, repeats) = (has(b"\"packed\""), !has(b"KHR_texture_transform"));
        let shown = json!({
            "meshes": inside["meshes"], "materials": inside["materials"], "packed": is_packed, "repeats": repeats,
        });
        parts.insert("glb".to_owned(), shown);
    }
    value
}

/// Puts a value at a key such as `seam[0].ease`; a list grows by one.
fn put(table: &mut toml::Table, key: &str, value: toml::Value) {
    let (first, rest) = key.split_once('.').map_or((key, None), |(first, rest)| (first, Some(rest)));
    if let Some((name, number)) = first.trim_end_matches(']').split_once('[') {
        let list = table.entry(name).or_insert(toml::Value::Array(Vec::new())).as_array_mut().expect("a list");
        let number: usize = number.parse().expect("number");
        if number == list.len() {
            list.push(toml::Value::Table(toml::Table::new()));
        }
        match rest {
            Some(rest) => put(list[number].as_table_mut().expect("a table"), rest, value),
            None => list[number] = value,
        }
    } else if let Some(rest) = rest {
        let inner = table.entry(first).or_insert(toml::Value::Table(toml::Table::new()));
        put(inner.as_table_mut().expect("a table"), rest, value);
    } else {
        table.insert(first.to_owned(), value);
    }
}
