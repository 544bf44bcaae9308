//! The cost of accuracy for the garment of a page, as a study found it.
//!
//! A study is shown only where it is of this very garment: the same files, and the same parameters up to the drape but
//! for those that a study varies.

mod chart;

pub use chart::{KINDS, svg};

use super::tables::{Cell, Table};
use super::words::{Language, Phrase};
use crate::svg::canvas::{escape, fixed};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::fmt::Write as _;
use toile_garment::Garment;
use toile_garment::provenance::{InputRecord, StageRecord};

/// Energies that differ by less than this share are those of one drape: a file holds all digits but the last.
const SAME_ENERGY: f64 = 1e-12;

/// A study.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Accuracy {
    /// Product line and version.
    pub pipeline: String,
    /// The error that the recommended setting must reach, mm.
    pub wanted_mm: f64,
    /// Its settings.
    pub points: Vec<Point>,
    /// The garment that it is of.
    pub made_of: Origin,
}

/// One setting of a study.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Name.
    pub name: String,
    /// Number of its kind in the chart.
    pub kind: usize,
    /// Triangles of all pieces.
    pub triangles: usize,
    /// CPU seconds.
    pub cpu_seconds: f64,
    /// Largest memory, MB.
    pub peak_mb: Option<f64>,
    /// The error that may be stated, mm. `None` where nothing can.
    pub error_mm: Option<f64>,
    /// Is nothing both cheaper and more exact?
    pub on_front: bool,
    /// Name of the preset at this setting.
    pub preset: Option<String>,
    /// The error that the preset promises, mm.
    pub promised_mm: Option<f64>,
    /// True for the one by which the others are measured.
    pub is_finest: bool,
    /// True where it is recommended.
    pub is_recommended: bool,
    /// Energy of its drape, J, by which the drape is known again.
    pub energy_j: Option<f64>,
}

/// The stages and inputs that a garment is made of, up to its drape.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Origin {
    /// Program version.
    pub toile: String,
    /// Files that were read.
    pub inputs: Vec<InputRecord>,
    /// Stages.
    pub stages: Vec<StageRecord>,
    /// For each stage the keys of parameters that a study varies; a dot leads into an inner table.
    pub varied: Vec<Vec<String>>,
}

impl Origin {
    /// The origin of a garment that was draped last. `varied` tells the keys of a stage that a study varies.
    #[must_use]
    pub fn of(garment: &Garment, varied: impl Fn(&str) -> Vec<String>) -> Self {
        let past = &garment.provenance;
        let plain = |s: &StageRecord| StageRecord { params: plain(&s.params, &varied(&s.stage)), ..s.clone() };
        Self {
            toile: past.toile.clone(),
            inputs: past.inputs.clone(),
            stages: past.stages.iter().map(plain).collect(),
            varied: past.stages.iter().map(|s| varied(&s.stage)).collect(),
        }
    }

    /// The part of a garment that is not as it was, in words; `None` where all is.
    #[must_use]
    pub fn changed(&self, garment: &Garment) -> Option<String> {
        let past = &garment.provenance;
        if self.stages.is_empty() {
            return Some("it does not tell what its garment is made of".to_owned());
        }
        if past.toile != self.toile {
            return Some(format!("it was made by version {} of the program", self.toile));
        }
        let is_there = |i: &&InputRecord| past.inputs.iter().all(|now| now.blake3 != i.blake3);
        if let Some(input) = self.inputs.iter().find(is_there) {
            return Some(format!("`{}` was another file then", input.path));
        }
        let mut now = past.stages.iter().filter(|s| !s.stage.starts_with("export-"));
        self.stages.iter().zip(&self.varied).find_map(|(then, varied)| match now.next() {
            Some(now) if (&now.stage, now.revision) == (&then.stage, then.revision) => {
                other_key(&then.params, &plain(&now.params, varied))
                    .map(|key| format!("`{key}` of the stage `{}` was set otherwise then", then.stage))
            }
            _ => Some(format!("the stage `{}` stands elsewhere now", then.stage)),
        })
    }
}

/// The parameters of a stage without those that a study varies, and with names in place of paths: what a file holds is
/// known by its digest.
fn plain(params: &Value, varied: &[String]) -> Value {
    let mut out = params.clone();
    for key in varied {
        let (table, key) = key.rsplit_once('.').map_or(("", key.as_str()), |(table, key)| (table, key));
        let table = if table.is_empty() { String::new() } else { format!("/{}", table.replace('.', "/")) };
        if let Some(map) = out.pointer_mut(&table).and_then(Value::as_object_mut) {
            map.remove(key);
        }
    }
    names(&mut out);
    out
}

fn names(value: &mut Value) {
    match value {
        Value::String(text) => *text = text.rsplit(['/', '\\']).next().unwrap_or_default().to_owned(),
        Value::Array(items) => items.iter_mut().for_each(names),
        Value::Object(map) => map.values_mut().for_each(names),
        _ => {}
    }
}

/// The first key at which two tables differ.
fn other_key(a: &Value, b: &Value) -> Option<String> {
    let (Some(a), Some(b)) = (a.as_object(), b.as_object()) else {
        return (a != b).then(|| "with".to_owned());
    };
    a.keys().chain(b.keys()).find(|key| a.get(*key) != b.get(*key)).cloned()
}

impl Accuracy {
    /// Reads the text of a `study.json`.
    ///
    /// # Errors
    /// Why it cannot be shown, in words.
    pub fn read(text: &str) -> Result<Self, String> {
        #[derive(Deserialize)]
        struct File {
            shown: Option<Accuracy>,
        }
        let file: File = serde_json::from_str(text).map_err(|e| format!("it is no study: {e}"))?;
        let found = file.shown.ok_or("it is no study, or one of an older program")?;
        let numbers = found.points.iter().flat_map(|p| [Some(p.cpu_seconds), p.peak_mb, p.error_mm, p.promised_mm]);
        if numbers.flatten().any(|x| !x.is_finite() || x < 0.0) {
            return Err("a figure of it is none".to_owned());
        }
        Ok(found)
    }

    /// The number of the point that is the drape of a garment.
    #[must_use]
    pub fn here(&self, garment: &Garment) -> Option<usize> {
        let energy = garment.certificate.as_ref()?.energy_j;
        let triangles: usize = garment.pieces.iter().filter_map(|p| p.mesh.as_ref()).map(|m| m.triangles.len()).sum();
        let is_same = |e: f64| (e - energy).abs() <= SAME_ENERGY * energy.abs();
        self.points.iter().position(|p| p.triangles == triangles && p.energy_j.is_some_and(is_same))
    }

    /// Sentences: what this drape is, and what is recommended.
    fn advice(&self, here: Option<usize>) -> Vec<Phrase> {
        let mut out = Vec::new();
        let told = |p: &Point| Some([p.name.clone(), fixed(p.error_mm?, 1), fixed(p.cpu_seconds, 1)]);
        if let Some(values) = here.and_then(|k| told(&self.points[k])) {
            out.push(Phrase::new("This garment was draped as `{0}`: error {1} mm, {2} CPU seconds.", values));
        } else {
            out.push(Phrase::new("The setting of this garment is none of the study.", []));
        }
        let best = self.points.iter().find(|p| p.is_recommended);
        out.push(match best.and_then(told) {
            Some([name, error, seconds]) => {
                let values = [self.wanted_mm.to_string(), name, error, seconds];
                Phrase::new("Recommended for {0} mm: `{1}`, error {2} mm, {3} CPU seconds.", values)
            }
            None => Phrase::new("None of these settings reaches {0} mm.", [self.wanted_mm.to_string()]),
        });
        out
    }

    /// The table of its points.
    pub(super) fn table(&self, garment: &Garment) -> Table {
        let mut t = Table::new(
            "accuracy",
            "What accuracy costs",
            "Error: the largest difference in hem heights, girths and surface from the limit of fine meshes, as the study \
             of this garment states it.",
            &[
                ("setting", "setting"),
                ("triangles", "triangles"),
                ("cpu_seconds", "CPU seconds"),
                ("peak_mb", "memory MB"),
                ("error_mm", "error mm"),
                ("remarks", "remarks"),
            ],
        );
        let here = self.here(garment);
        let number = |x: Option<f64>, decimals| x.map_or(Cell::Empty, |x| Cell::Number(x, decimals));
        let row = |(k, p): (usize, &Point)| {
            let remarks = [
                (here == Some(k), "this garment"),
                (p.is_recommended, "recommended"),
                (p.is_finest, "the finest"),
                (p.on_front, "on the front"),
            ];
            let remarks: Vec<Phrase> = remarks.iter().filter(|r| r.0).map(|r| Phrase::new(r.1, [])).collect();
            vec![
                Cell::Text(p.name.clone()),
                Cell::Count(p.triangles as u64),
                Cell::Number(p.cpu_seconds, 1),
                number(p.peak_mb, 0),
                number(p.error_mm, 1),
                if remarks.is_empty() { Cell::Empty } else { Cell::Phrases(remarks) },
            ]
        };
        t.rows = self.points.iter().enumerate().map(row).collect();
        t
    }

    /// The chart and the advice, as they stand before the table.
    pub(super) fn html(&self, out: &mut String, garment: &Garment, language: Language) {
        let here = self.here(garment);
        let picture = STANDARD.encode(svg(self, here, language));
        let alt = escape(language.say("error against time and against memory"));
        let _ = writeln!(
            out,
            "<figure class=\"chart\"><img alt=\"{alt}\" width=\"1040\" height=\"464\" \
             src=\"data:image/svg+xml;base64,{picture}\"></figure>"
        );
        for phrase in self.advice(here) {
            let _ = writeln!(out, "<p>{}</p>", escape(&language.phrases(&[phrase]).replace('`', "")));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;
    use toile_garment::Piece;
    use toile_garment::garment::Certificate;
    use toile_garment::mesh::PieceMesh;

    fn garment() -> Garment {
        let stage = |stage: &str, params| StageRecord { stage: stage.into(), id: stage.into(), revision: 1, params };
        let input = |path: &str, blake3: &str| InputRecord { path: path.into(), blake3: blake3.into() };
        let mesh = PieceMesh { triangles: vec![[0, 1, 2]; 7], ..PieceMesh::default() };
        let mut garment =
            Garment { pieces: vec![Piece { mesh: Some(mesh), ..Piece::default() }], ..Garment::default() };
        garment.provenance.toile = "0.1.0".into();
        garment.provenance.inputs = vec![input("skirt.dxf", "aa"), input("wool.toml", "bb")];
        garment.provenance.stages = vec![
            stage("import-dxf", json!({ "file": "/home/anna/skirt.dxf", "size": "38" })),
            stage("drape", json!({ "accuracy": "normal", "effects": { "friction": "auto", "self-contact": "on" } })),
        ];
        garment.certificate = Some(Certificate { energy_j: 0.25, ..Certificate::default() });
        garment
    }

    fn origin() -> Origin {
        let varied = |stage: &str| match stage {
            "drape" => ["accuracy", "effects.self-contact"].map(str::to_owned).to_vec(),
            _ => Vec::new(),
        };
        Origin::of(&garment(), varied)
    }

    #[test]
    fn a_study_is_of_a_garment_while_all_but_its_settings_is_the_same() {
        let (origin, mut now) = (origin(), garment());
        assert_eq!(origin.changed(&now), None);
        // Other settings, another folder and an export between are the same garment.
        now.provenance.stages[0].params["file"] = json!("D:\\patterns\\skirt.dxf");
        now.provenance.stages[1].params["accuracy"] = json!("fine");
        now.provenance.stages[1].params["effects"]["self-contact"] = json!("off");
        let tap = StageRecord { stage: "export-dxf".into(), id: "x".into(), revision: 1, params: json!({}) };
        now.provenance.stages.insert(1, tap);
        assert_eq!(origin.changed(&now), None);
        let change = |edit: &dyn Fn(&mut Garment)| {
            let mut garment = garment();
            edit(&mut garment);
            origin.changed(&garment).unwrap_or_default()
        };
        assert!(change(&|g| g.provenance.inputs[1].blake3 = "cc".into()).contains("`wool.toml`"));
        assert!(change(&|g| g.provenance.stages[0].params["size"] = json!("40")).contains("`size`"));
        assert!(change(&|g| g.provenance.stages[1].params["effects"]["friction"] = json!("off")).contains("`effects`"));
        assert!(change(&|g| g.provenance.stages[0].revision = 2).contains("`import-dxf`"));
        assert!(change(&|g| g.provenance.toile = "0.2.0".into()).contains("0.1.0"));
        assert!(change(&|g| g.provenance.stages[1].stage = "alter".into()).contains("`drape`"));
        assert!(Origin::default().changed(&garment()).is_some());
    }

    fn accuracy() -> Accuracy {
        let point = |name: &str, energy: f64, error: f64| Point {
            name: name.into(),
            triangles: 7,
            cpu_seconds: 2.0,
            error_mm: Some(error),
            energy_j: Some(energy),
            ..Point::default()
        };
        let points = vec![point("32mm-normal", 0.5, 8.0), point("22mm-normal", 0.25, 4.0)];
        Accuracy { pipeline: "skirt v1".into(), wanted_mm: 5.0, points, made_of: origin() }
    }

    #[test]
    fn the_drape_of_the_page_is_known_again_by_its_energy() {
        let study = accuracy();
        assert_eq!(study.here(&garment()), Some(1));
        let mut other = garment();
        other.certificate = Some(Certificate { energy_j: 0.26, ..Certificate::default() });
        assert_eq!(study.here(&other), None);
        let mut out = String::new();
        study.html(&mut out, &garment(), Language::English);
        assert!(out.contains("This garment was draped as 22mm-normal: error 4.0 mm, 2.0 CPU seconds."), "{out}");
        assert!(svg(&study, Some(1), Language::English).contains("class=\"here\""));
        let table = study.table(&garment());
        assert_eq!(table.rows[1][5], Cell::Phrases(vec![Phrase::new("this garment", [])]));
    }

    #[test]
    fn what_is_no_study_says_why() {
        let text = json!({ "toile_study": 1, "shown": accuracy() }).to_string();
        assert_eq!(Accuracy::read(&text), Ok(accuracy()));
        assert!(Accuracy::read("{}").is_err_and(|e| e.contains("older program")));
        assert!(Accuracy::read("[").is_err_and(|e| e.contains("no study")));
        let spoilt = text.replace("\"cpu_seconds\":2.0", "\"cpu_seconds\":-2.0");
        assert!(Accuracy::read(&spoilt).is_err());
    }

    #[test]
    fn every_word_of_the_study_can_be_told_in_chinese() {
        let study = accuracy();
        let table = study.table(&garment());
        let heads = [table.title, &table.note].into_iter().chain(table.columns.iter().map(|c| c.1));
        let kinds = KINDS.iter().map(|k| k.0);
        for english in heads.chain(kinds) {
            assert_ne!(Language::Chinese.say(english), english);
        }
        let chinese = svg(&study, Some(1), Language::Chinese);
        let is_english = |line: &str| ["error", "memory", "Black", "Red"].iter().any(|w| line.contains(w));
        let text = chinese.split_once("</style>").map_or("", |(_, text)| text);
        assert!(!text.lines().any(is_english), "{chinese}");
        for here in [None, Some(1)] {
            for phrase in study.advice(here) {
                assert_ne!(Language::Chinese.say(phrase.words), phrase.words);
            }
        }
    }
}
