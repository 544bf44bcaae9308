//! The mistakes that people make most often, and all that the program answers to each: `mistakes.txt`.
//! `TOILE_BLESS=1` writes the answers anew.

use crate::support;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use support::bench::command;

/// Stages up to the one that sews a pattern, which lies beside the pipeline with its sewing file.
const PIPELINE: &str = "toile = 1

[pipeline]
line = \"mistakes\"
version = 1

[[stage]]
use = \"import-dxf\"
with.file = \"PATTERN.aama.dxf\"
with.sewing = \"PATTERN.sewing.toml\"

[[stage]]
use = \"triangulate\"
with.edge_length = \"30 mm\"

[[stage]]
use = \"assemble\"

[[stage]]
use = \"stitch\"
with.body = \"size-38.obj\"
with.fabric = \"cotton-jersey.toml\"
";

/// Makes a mistake, and gives the answer to it.
type Answer = fn() -> String;

/// A folder with all that a garment needs.
struct Folder(tempfile::TempDir);

impl Folder {
    fn of(pattern: &str) -> Self {
        let samples = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples");
        let folder = Self(tempfile::tempdir().expect("folder"));
        let patterns = ["aama.dxf", "sewing.toml"].map(|end| format!("patterns/{pattern}.{end}"));
        let others = ["bodies/size-38.obj", "bodies/size-38.toml", "fabrics/cotton-jersey.toml"];
        for name in patterns.iter().map(String::as_str).chain(others) {
            std::fs::copy(samples.join(name), folder.path(name.split('/').next_back().expect("name"))).expect("copy");
        }
        std::fs::write(folder.path("pipeline.toml"), PIPELINE.replace("PATTERN", pattern)).expect("pipeline");
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Writes a file anew.
    fn edit(&self, name: &str, edit: impl Fn(&str) -> String) {
        let text = std::fs::read_to_string(self.path(name)).expect("text");
        let edited = edit(&text);
        assert_ne!(text, edited, "{name}: nothing was changed");
        std::fs::write(self.path(name), edited).expect("written");
    }

    /// The answer to a command in this folder. Words in `paths` name files of it.
    fn answer(&self, words: &[&str]) -> String {
        let is_file = |word: &str| word.ends_with(".toml") && self.path(word).exists() || word.ends_with(".dxf");
        let word = |w: &&str| if is_file(w) || *w == "out" { self.path(w).into_os_string() } else { (*w).into() };
        let said = command(words.iter().map(word).collect());
        let folder = format!("{}/", self.0.path().display());
        format!("exit {}\n{}{}", said.code, said.err, said.out).replace(&folder, "")
    }

    fn check(&self) -> String {
        self.answer(&["check", "pipeline.toml"])
    }
}

fn misspelt_edges() -> String {
    let folder = Folder::of("t-shirt");
    folder.edit("t-shirt.sewing.toml", |t| t.replacen("\"FRONT.2\"", "\"FRONT.22\"", 1).replacen(".cap", ".cup", 1));
    folder.check()
}

fn seam_turned_round() -> String {
    let folder = Folder::of("fitted-bodice");
    let seam = "a = \"FRONT.9\"\nb = \"BACK.5\"\n";
    folder.edit("fitted-bodice.sewing.toml", |t| t.replace(seam, &format!("{seam}reverse = false\n")));
    folder.check()
}

fn wrong_size() -> String {
    Folder::of("t-shirt").answer(&["check", "pipeline.toml", "--set", "import-dxf.size=\"42\""])
}

fn metres_for_millimetres() -> String {
    Folder::of("t-shirt").answer(&["new", "t-shirt.aama.dxf", "--units", "m", "--out", "out"])
}

fn body_in_millimetres() -> String {
    let folder = Folder::of("t-shirt");
    let millimetres = |line: &str| match line.strip_prefix("v ") {
        Some(at) => {
            let numbers = at.split(' ').map(|n| format!(" {:.3}", 1e3 * n.parse::<f64>().expect("number")));
            format!("v{}\n", numbers.collect::<String>())
        }
        None => format!("{line}\n"),
    };
    folder.edit("size-38.obj", |t| t.lines().map(millimetres).collect());
    folder.check()
}

fn sleeves_on_the_wrong_arms() -> String {
    let folder = Folder::of("t-shirt");
    let exchanged =
        |t: &str| t.replace("SLEEVE.cap", "?.cap").replace("SLEEVE-R.cap", "SLEEVE.cap").replace('?', "SLEEVE-R");
    folder.edit("t-shirt.sewing.toml", exchanged);
    folder.check()
}

fn piece_without_seams() -> String {
    let folder = Folder::of("t-shirt");
    let is_kept = |table: &&str| !table.contains("NECKBAND") && !table.starts_with("[[place]]");
    folder.edit("t-shirt.sewing.toml", |t| t.split("\n\n").filter(is_kept).collect::<Vec<_>>().join("\n\n"));
    folder.check()
}

fn dart_the_wrong_way() -> String {
    let folder = Folder::of("fitted-bodice");
    let dart = "\n[[dart]]\npiece = \"FRONT\"\nkind = \"wedge\"\n\
                mouth = [[\"79.2 mm\", \"961.6 mm\"], [\"110.8 mm\", \"961.6 mm\"]]\n\
                apexes = [[\"95 mm\", \"722 mm\"]]\n";
    folder.edit("fitted-bodice.sewing.toml", |t| t.to_owned() + dart);
    folder.check()
}

fn missing_layer() -> String {
    let folder = Folder::of("t-shirt");
    let moved = |text: &str| {
        let lines: Vec<&str> = text.lines().collect();
        let pair = |pair: &[&str]| match pair {
            [code, layer] if code.trim() == "8" && layer.trim() == "1" => format!("{code}\n21\n"),
            pair => pair.join("\n") + "\n",
        };
        lines.chunks(2).map(pair).collect::<String>()
    };
    folder.edit("t-shirt.aama.dxf", moved);
    folder.answer(&["new", "t-shirt.aama.dxf", "--out", "out"])
}

fn unknown_fabric() -> String {
    let folder = Folder::of("t-shirt");
    folder.edit("pipeline.toml", |t| t.replace("cotton-jersey.toml", "coton-jersey.toml"));
    folder.check() + &folder.answer(&["new", "t-shirt.aama.dxf", "--fabric", "coton-jersy", "--out", "out"])
}

#[test]
fn the_usual_mistakes_are_answered_in_words_of_a_pattern_maker() {
    let mistakes: [(&str, Answer); 10] = [
        ("misspelt edges", misspelt_edges),
        ("a seam turned round", seam_turned_round),
        ("a size that the file does not hold", wrong_size),
        ("metres for millimetres", metres_for_millimetres),
        ("a body in millimetres", body_in_millimetres),
        ("the sleeves on the wrong arms", sleeves_on_the_wrong_arms),
        ("a piece without seams", piece_without_seams),
        ("a dart the wrong way round", dart_the_wrong_way),
        ("the outlines on another layer", missing_layer),
        ("an unknown fabric", unknown_fabric),
    ];
    let mut found = String::new();
    for (mistake, answer) in mistakes {
        let _ = write!(found, "## {mistake}\n\n{}\n", answer());
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/program/mistakes.txt");
    if std::env::var_os("TOILE_BLESS").is_some() {
        std::fs::write(&path, &found).expect("written");
    }
    let pinned = std::fs::read_to_string(&path).unwrap_or_default().replace("\r\n", "\n");
    assert!(
        found == pinned,
        "the answers have changed; look at them, and write them anew with TOILE_BLESS=1:\n{found}"
    );
}
