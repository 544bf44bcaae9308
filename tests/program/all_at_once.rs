//! `check` tells all mistakes at once: none hides another, whatever file or parameter holds it.

use crate::support;
use std::collections::BTreeSet;
use support::bench::{Bench, SKIRT_STAGES, command};

/// A mistake: the code it is told under, and the file with the text that becomes another, text at the end of a file, or
/// an override.
struct Mistake {
    code: &'static str,
    change: Change,
}

enum Change {
    Text(&'static str, &'static str, &'static str),
    End(&'static str, &'static str),
    Set(&'static str),
}

const fn text(code: &'static str, file: &'static str, from: &'static str, to: &'static str) -> Mistake {
    Mistake { code, change: Change::Text(file, from, to) }
}

const fn end(code: &'static str, file: &'static str, more: &'static str) -> Mistake {
    Mistake { code, change: Change::End(file, more) }
}

const fn set(code: &'static str, set: &'static str) -> Mistake {
    Mistake { code, change: Change::Set(set) }
}

const SEWING: &str = "skirt.sewing.toml";

/// The stages behind `stitch`, each with a file or a value to be wrong.
const MORE_STAGES: &str = "[[stage]]
use = \"drape\"
[[stage]]
use = \"flatten\"
[[stage]]
use = \"texture\"
[[stage]]
use = \"export-dxf\"
with.file = \"{out}/flat.dxf\"
with.allowance = { width = \"10 mm\" }
[[stage]]
use = \"export-print\"
with.file = \"{out}/plot.pdf\"
[[stage]]
use = \"export-picture\"
[[stage]]
use = \"export-report\"
with.measures = \"measures.toml\"
";

const MEASURES: &str = "[[measure]]
name = \"hem\"
on = \"pattern\"
edges = [\"FRONT.0\", \"BACK.0\"]
[[measure]]
name = \"waist\"
on = \"drape\"
around = \"torso\"
at = \"waist-front\"
[[measure]]
name = \"back length\"
on = \"body\"
from = \"neck-back\"
to = \"waist-back\"
";

/// Mistakes that do not touch each other, in the order of the way of the data.
const MISTAKES: [Mistake; 49] = [
    set("size-not-found", "import-dxf.size=39"),
    set("piece-not-found", "import-dxf.pieces=[\"FRNT\"]"),
    set("out-of-range", "import-dxf.gap=\"90 mm\""),
    set("layer-unknown", "import-dxf.layers={ CUT = \"77\" }"),
    set("file-missing", "import-dxf.rules=\"none.rul\""),
    set("profile-unknown", "import-dxf.profile=\"nobody\""),
    set("code-page-unknown", "import-dxf.code_page=\"klingon\""),
    set("out-of-range", "import-dxf.allowance={ width = \"900 mm\" }"),
    text("edge-unknown", SEWING, "a = \"FRONT.1\"", "a = \"FRONT.91\""),
    text("piece-unknown", SEWING, "[[place]]\npiece = \"BACK\"", "[[place]]\npiece = \"BAKC\""),
    text("attach-target-unknown", SEWING, "edge = 2\nto = \"waist\"", "edge = 2\nto = \"waits\""),
    text("sewing-unknown-key", SEWING, "strength = \"hold\"\n\n[[attach]]", "strenght = \"hold\"\n\n[[attach]]"),
    end("piece-unknown", SEWING, "[[copy]]\nname = \"COPY\"\npiece = \"FRONNT\"\n"),
    end("piece-unknown", SEWING, "[[layer]]\npieces = [\"LINING\"]\norder = -1\n"),
    end("edge-unknown", SEWING, "[[elastic]]\nalong = [\"BACK.55\"]\nlength = \"60 %\"\n"),
    end(
        "piece-unknown",
        SEWING,
        "[[interlining]]\npieces = [\"BAND\"]\nareal_mass = \"60 g/m2\"\nbending = \"40 uN.m\"\n",
    ),
    end(
        "piece-unknown",
        SEWING,
        "[[fold]]\npiece = \"HEM\"\nline = [[\"0 mm\", \"40 mm\"], [\"300 mm\", \"40 mm\"]]\nangle = \"180 deg\"\n",
    ),
    end(
        "piece-unknown",
        SEWING,
        "[[dart]]\npiece = \"BUST\"\nmouth = [[\"0 mm\", \"0 mm\"], [\"20 mm\", \"0 mm\"]]\napex = [\"9 mm\", \"90 mm\"]\n",
    ),
    text("fabric-value", "fabric.toml", "friction = 0", "friction = \"rough\" # 0"),
    text("value-out-of-range", "fabric.toml", "lt_warp = 0.6", "lt_warp = 60"),
    text("unknown-key", "fabric.toml", "shear = ", "sheer = "),
    text("body-value", "body.toml", "waist_height = \"1050 mm\"", "waist_height = \"10500 mm\""),
    text("body-value", "body.toml", "hip-left = [\"177.616 mm\", ", "hip-left = ["),
    text("body-value", "body.toml", "half_depth = \"46.581 mm\"\n\n[segments.arm-right]", "\n[segments.arm-right]"),
    set("wrong-value", "triangulate.edge_length=\"20 qm\""),
    set("max-ease", "assemble.max_ease=-3 %"),
    set("setting-out-of-range", "stitch.clearance=\"900 mm\""),
    set("setting-out-of-range", "stitch.sewing_distance=\"900 mm\""),
    set("file-missing", "stitch.fabrics={ lining = \"none.toml\" }"),
    set("setting-out-of-range", "drape.gravity=-9.81 m/s2"),
    set("setting-out-of-range", "drape.self_gap=\"900 mm\""),
    set("flatten-parameter", "flatten.smooth=\"900 mm\""),
    set("value-out-of-range", "texture.roughness=2"),
    set("color", "texture.color=\"red\""),
    set("file-missing", "texture.image=\"none.png\""),
    set("code-page-unknown", "export-dxf.code_page=\"vulcan\""),
    set("file-missing", "export-dxf.grade_from=\"none.dxf\""),
    set("piece-unknown", "export-dxf.allowance.pieces={ SLEEVE = \"8 mm\" }"),
    set("paper-unknown", "export-print.paper=\"b7\""),
    set("file-missing", "export-print.font=\"none.ttf\""),
    set("out-of-range", "export-print.gap=\"900 mm\""),
    set("out-of-range", "export-picture.width=0"),
    text("measure-missing", "measures.toml", "BACK.0", "BACK.72"),
    text("measure-missing", "measures.toml", "torso", "trunk"),
    text("measure-missing", "measures.toml", "neck-back", "nape"),
    set("file-missing", "export-report.study=\"none.json\""),
    set("unknown-key", "import-dxf.untis=\"mm\""),
    set("unknown-key", "stitch.claerance=\"2 mm\""),
    set("unknown-input", "import-dxf.units=\"{unit}\""),
];

/// Errors of `check` with some of the mistakes: code, line and message.
fn errors(mistakes: &[&Mistake]) -> BTreeSet<(String, String)> {
    let bench = Bench::new();
    bench.sample_skirt().sample("bodies/size-38.obj", "body.obj").stages(&format!("{SKIRT_STAGES}{MORE_STAGES}"));
    bench.file("measures.toml", MEASURES);
    let mut more = Vec::new();
    for mistake in mistakes {
        match mistake.change {
            Change::Set(words) => more.extend(["--set", words]),
            Change::End(name, text) => {
                let file = bench.path("pipelines/test").join(name);
                let before = std::fs::read_to_string(&file).expect("text");
                std::fs::write(file, format!("{before}\n{text}")).expect("written");
            }
            Change::Text(name, from, to) => {
                let file = bench.path("pipelines/test").join(name);
                let before = std::fs::read_to_string(&file).expect("text");
                let after = before.replacen(from, to, 1);
                assert_ne!(before, after, "{from}");
                std::fs::write(file, after).expect("written");
            }
        }
    }
    errors_of(&bench, &more).into_iter().collect()
}

/// Code and message of all errors of `check`.
fn errors_of(bench: &Bench, more: &[&str]) -> Vec<(String, String)> {
    let arguments = ["check", "--format", "json"].map(Into::into).into_iter();
    let said = command(arguments.chain([bench.pipeline_file().into()]).chain(more.iter().map(Into::into)).collect());
    let value: serde_json::Value = serde_json::from_str(&said.out).expect("JSON");
    let list = value["findings"].as_array().expect("findings").clone();
    let word = |f: &serde_json::Value, key: &str| f[key].as_str().unwrap_or_default().to_owned();
    let is_error = |f: &&serde_json::Value| f["severity"] == "error";
    list.iter().filter(is_error).map(|f| (word(f, "code"), word(f, "message"))).collect()
}

#[test]
fn no_mistake_hides_another() {
    let alone: Vec<BTreeSet<(String, String)>> = MISTAKES.iter().map(|m| errors(&[m])).collect();
    for (mistake, told) in MISTAKES.iter().zip(&alone) {
        let codes: Vec<&str> = told.iter().map(|(code, _)| code.as_str()).collect();
        assert_eq!(codes, [mistake.code], "{told:?}");
    }
    let mut wrong = Vec::new();
    for (i, first) in MISTAKES.iter().enumerate() {
        for (k, second) in MISTAKES.iter().enumerate().skip(i + 1) {
            let told = errors(&[first, second]);
            let wanted: BTreeSet<_> = alone[i].union(&alone[k]).cloned().collect();
            if told != wanted {
                wrong.push(format!("{} and {}: {told:?} instead of {wanted:?}", first.code, second.code));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let all: Vec<&Mistake> = MISTAKES.iter().collect();
    assert_eq!(errors(&all), alone.into_iter().flatten().collect());
}

#[test]
fn what_is_set_twice_is_told() {
    let bench = Bench::new();
    bench.sample_skirt().sample("bodies/size-38.obj", "body.obj").stages(SKIRT_STAGES);
    let said = bench.findings(&["--set", "import-dxf.size=36", "--set", "import-dxf.size=38"]);
    let codes: Vec<&str> = said.iter().map(|f| f.0.as_str()).filter(|c| *c == "set-twice").collect();
    assert_eq!(codes, ["set-twice"], "{said:?}");
}

/// Codes of the errors of `check`.
fn codes(bench: &Bench, more: &[&str]) -> Vec<String> {
    errors_of(bench, more).into_iter().map(|(code, _)| code).collect()
}

#[test]
fn two_mistakes_of_one_stage_are_told() {
    let bench = Bench::new();
    let transfer = "[[stage]]\nuse = \"drape\"\n[[stage]]\nuse = \"transfer\"\nwith.body = \"body.obj\"\n";
    bench.sample_skirt().sample("bodies/size-38.obj", "body.obj").stages(&format!("{SKIRT_STAGES}{transfer}"));
    assert_eq!(codes(&bench, &[]), [""; 0]);
    let told = |sets: &[&str]| {
        let more: Vec<&str> = sets.iter().flat_map(|set| ["--set", set]).collect();
        codes(&bench, &more)
    };
    let all = ["transfer.body=\"none.obj\"", "transfer.from=\"nobody.obj\"", "transfer.add={ knee = \"9 mm\" }"];
    assert_eq!(told(&all), ["file-missing", "file-missing", "transfer-level"]);
    let both = ["triangulate.edge_length=\"0 mm\"", "import-dxf.size=39"];
    assert_eq!(told(&both), ["size-not-found", "edge-length"]);
}

#[test]
fn every_text_that_is_no_utf8_is_told_by_its_name() {
    const FILES: [&str; 6] = [SEWING, "fabric.toml", "body.toml", "measures.toml", "skirt.study.json", "v1.toml"];
    let bench = Bench::new();
    bench.sample_skirt().sample("bodies/size-38.obj", "body.obj").stages(&format!("{SKIRT_STAGES}{MORE_STAGES}"));
    bench.file("measures.toml", MEASURES).file("skirt.study.json", "{}");
    let study = ["--set", "export-report.study=\"skirt.study.json\""];
    assert_eq!(codes(&bench, &study), [""; 0]);
    for name in FILES {
        let file = bench.path("pipelines/test").join(name);
        let before = std::fs::read(&file).expect("bytes");
        std::fs::write(&file, [&before[..], b"\n# caf\xe9\n"].concat()).expect("written");
        let told = errors_of(&bench, &study);
        assert!(told.iter().any(|(code, m)| code == "text-not-utf8" && m.contains(name)), "{name}: {told:?}");
        std::fs::write(&file, before).expect("written");
    }
}
