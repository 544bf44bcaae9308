//! `check` tells all mistakes at once: none hides another, whatever file or parameter holds it.

use crate::support;
use std::collections::BTreeSet;
use support::bench::{Bench, SKIRT_STAGES, command};

/// A mistake: the code it is told under, and the file with the text that becomes another, or an override.
struct Mistake {
    code: &'static str,
    change: Change,
}

enum Change {
    Text(&'static str, &'static str, &'static str),
    Set(&'static str),
}

const fn text(code: &'static str, file: &'static str, from: &'static str, to: &'static str) -> Mistake {
    Mistake { code, change: Change::Text(file, from, to) }
}

const fn set(code: &'static str, set: &'static str) -> Mistake {
    Mistake { code, change: Change::Set(set) }
}

const SEWING: &str = "skirt.sewing.toml";

/// Mistakes that do not touch each other, in the order of the way of the data.
const MISTAKES: [Mistake; 16] = [
    set("size-not-found", "import-dxf.size=39"),
    set("piece-not-found", "import-dxf.pieces=[\"FRNT\"]"),
    set("out-of-range", "import-dxf.gap=\"90 mm\""),
    set("layer-unknown", "import-dxf.layers={ CUT = \"77\" }"),
    set("file-missing", "import-dxf.rules=\"none.rul\""),
    set("unknown-key", "import-dxf.untis=\"mm\""),
    set("unknown-input", "import-dxf.code_page=\"{page}\""),
    text("edge-unknown", SEWING, "a = \"FRONT.1\"", "a = \"FRONT.91\""),
    text("piece-unknown", SEWING, "[[place]]\npiece = \"BACK\"", "[[place]]\npiece = \"BAKC\""),
    text("attach-target-unknown", SEWING, "edge = 2\nto = \"waist\"", "edge = 2\nto = \"waits\""),
    text("sewing-unknown-key", SEWING, "strength = \"hold\"\n\n[[attach]]", "strenght = \"hold\"\n\n[[attach]]"),
    text("fabric-value", "fabric.toml", "friction = 0", "friction = \"rough\" # 0"),
    text("body-value", "body.toml", "waist_height = \"1050 mm\"", "waist_height = \"10500 mm\""),
    set("wrong-value", "triangulate.edge_length=\"20 qm\""),
    set("unknown-key", "stitch.claerance=\"2 mm\""),
    set("max-ease", "assemble.max_ease=-3 %"),
];

/// What is asked of a pattern file itself is looked at step by step: its table, how it is read, which pieces, which size.
const ONE_BY_ONE: [&str; 5] = ["file-missing", "layer-unknown", "out-of-range", "piece-not-found", "size-not-found"];

/// Does the first mistake keep the second from being seen, or the other way round? Without a body nobody knows its
/// landmarks.
fn is_read_later(first: &Mistake, second: &Mistake) -> bool {
    let codes = [first.code, second.code];
    codes.iter().all(|code| ONE_BY_ONE.contains(code)) || codes == ["attach-target-unknown", "body-value"]
}

/// Errors of `check` with some of the mistakes: code, line and message.
fn errors(mistakes: &[&Mistake]) -> BTreeSet<(String, String)> {
    let bench = Bench::new();
    bench.sample_skirt().sample("bodies/size-38.obj", "body.obj").stages(SKIRT_STAGES);
    let mut more = Vec::new();
    for mistake in mistakes {
        match mistake.change {
            Change::Set(words) => more.extend(["--set", words]),
            Change::Text(name, from, to) => {
                let file = bench.path("pipelines/test").join(name);
                let before = std::fs::read_to_string(&file).expect("text");
                let after = before.replacen(from, to, 1);
                assert_ne!(before, after, "{from}");
                std::fs::write(file, after).expect("written");
            }
        }
    }
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
            if is_read_later(first, second) {
                continue;
            }
            let told = errors(&[first, second]);
            let wanted: BTreeSet<_> = alone[i].union(&alone[k]).cloned().collect();
            if told != wanted {
                wrong.push(format!("{} and {}: {told:?} instead of {wanted:?}", first.code, second.code));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let together = |m: &&Mistake| !ONE_BY_ONE.contains(&m.code) && m.code != "body-value";
    let all: Vec<&Mistake> = MISTAKES.iter().filter(together).collect();
    let wanted: BTreeSet<_> = all.iter().flat_map(|m| errors(&[*m])).collect();
    assert_eq!(errors(&all), wanted);
}

#[test]
fn what_is_set_twice_is_told() {
    let bench = Bench::new();
    bench.sample_skirt().sample("bodies/size-38.obj", "body.obj").stages(SKIRT_STAGES);
    let said = bench.findings(&["--set", "import-dxf.size=36", "--set", "import-dxf.size=38"]);
    let codes: Vec<&str> = said.iter().map(|f| f.0.as_str()).filter(|c| *c == "set-twice").collect();
    assert_eq!(codes, ["set-twice"], "{said:?}");
}
