//! The stage `import-dxf` on a small file written here.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use toile_garment::{Aspect, Garment, Report, Severity};
use toile_stage_api::{FileError, Files, Stage, StageContext, StageError};
use toile_stages::builtin;
use toile_stages::import_dxf::{ImportDxf, ImportDxfParams};

struct InMemory(BTreeMap<String, Vec<u8>>);

impl Files for InMemory {
    fn read(&mut self, path: &Path) -> Result<Vec<u8>, FileError> {
        let name = path.to_string_lossy().into_owned();
        self.0.get(&name).cloned().ok_or(FileError::Missing { path: name, reason: "not there".into() })
    }

    fn read_optional(&mut self, path: &Path) -> Result<Option<Vec<u8>>, FileError> {
        Ok(self.0.get(path.to_string_lossy().as_ref()).cloned())
    }

    fn write(&mut self, _: &Path, _: &[u8]) -> Result<(), FileError> {
        Ok(())
    }
}

fn pairs(list: &[(i32, &str)]) -> String {
    list.iter().map(|(c, v)| format!("{c}\n{v}\n")).collect()
}

fn pattern() -> String {
    let mut body = pairs(&[
        (0, "SECTION"),
        (2, "BLOCKS"),
        (0, "BLOCK"),
        (2, "BACK_40"),
        (0, "TEXT"),
        (8, "1"),
        (1, "Piece Name: BACK"),
    ]);
    body += &pairs(&[(0, "TEXT"), (8, "1"), (1, "Size: 40"), (0, "POLYLINE"), (8, "1"), (70, "1")]);
    for (x, y) in [("0", "0"), ("200", "0"), ("200", "400"), ("0", "400")] {
        body += &pairs(&[(0, "VERTEX"), (8, "1"), (10, x), (20, y)]);
    }
    body += &pairs(&[(0, "SEQEND"), (0, "TEXT"), (8, "1"), (10, "200"), (20, "400"), (1, "# 1")]);
    body += &pairs(&[(0, "TEXT"), (8, "1"), (10, "0"), (20, "0"), (1, "# 2"), (0, "ENDBLK"), (0, "ENDSEC")]);
    body += &pairs(&[
        (0, "SECTION"),
        (2, "ENTITIES"),
        (0, "INSERT"),
        (2, "BACK_40"),
        (0, "TEXT"),
        (8, "1"),
        (1, "Units: METRIC"),
    ]);
    body + &pairs(&[(0, "ENDSEC"), (0, "EOF")])
}

const RULES: &str =
    "NUMBER OF SIZES: 2\nSIZE LIST: 40 42\nSAMPLE SIZE: 40\nRULE: DELTA 1\n0 0 20 0\nRULE: DELTA 2\n0 0 0 0\nEND\n";

fn run(params: &str, files: &[(&str, &str)]) -> (Result<Garment, StageError>, Report) {
    let params: ImportDxfParams = toml::from_str(params).expect("params");
    let mut files = InMemory(files.iter().map(|(n, t)| ((*n).to_owned(), t.as_bytes().to_vec())).collect());
    let (mut report, cancel) = (Report::default(), AtomicBool::new(false));
    let mut cx = StageContext {
        report: &mut report,
        progress: &mut (),
        files: &mut files,
        cancel: &cancel,
        seed: 0,
        threads: 1,
    };
    let result = ImportDxf.run(&params, Garment::default(), &mut cx);
    (result, report)
}

#[test]
fn pieces_in_metres_with_ids_and_a_ledger() {
    let (garment, report) = run("file = \"p.dxf\"", &[("p.dxf", &pattern())]);
    let garment = garment.expect("garment");
    assert!(garment.has(Aspect::Pieces));
    assert_eq!((garment.size.as_deref(), garment.pieces[0].name.as_str()), (Some("40"), "BACK"));
    assert!((garment.pieces[0].outline.signed_area() - 0.08).abs() < 1e-12);
    assert!(report.findings.iter().any(|f| f.code == "ledger"));
}

#[test]
fn a_size_from_the_table_beside_the_file() {
    let files = [("p.dxf", pattern()), ("p.rul", RULES.to_owned())];
    let files: Vec<(&str, &str)> = files.iter().map(|(n, t)| (*n, t.as_str())).collect();
    let (garment, _) = run("file = \"p.dxf\"\nsize = \"42\"", &files);
    let garment = garment.expect("graded");
    let right = garment.pieces[0].outline.positions().iter().map(|p| p.x).fold(0.0, f64::max);
    assert!((right - 0.22).abs() < 1e-12);
    assert_eq!(garment.size.as_deref(), Some("42"));
}

#[test]
fn profile_code_page_and_tolerances_are_parameters() {
    let open = pattern().replacen("70\n1\n", "70\n0\n", 1).replace("0\nVERTEX\n8\n1\n10\n0\n20\n400\n", "");
    let open =
        open.replace("0\nSEQEND\n", "0\nVERTEX\n8\n1\n10\n0\n20\n400\n0\nVERTEX\n8\n1\n10\n0\n20\n3\n0\nSEQEND\n");
    let files = [("p.dxf", open.as_str())];
    assert!(matches!(run("file = \"p.dxf\"", &files).0, Err(StageError::Input(f)) if f[0].code == "outline-open"));
    let (garment, report) =
        run("file = \"p.dxf\"\ngap = \"4 mm\"\nprofile = \"browzwear\"\ncode_page = \"gbk\"", &files);
    assert!((garment.expect("closed").pieces[0].outline.signed_area() - 0.08).abs() < 1e-3);
    let profile = report.findings.iter().find(|f| f.code == "dxf-profile").expect("profile");
    assert!(
        profile.message.contains("browzwear") && profile.message.contains("set by the user"),
        "{}",
        profile.message
    );
    let (result, _) = run("file = \"p.dxf\"\ngap = \"4 m\"\ncorner = \"0 deg\"\nprofile = \"x\"", &files);
    let Err(StageError::Parameter(faults)) = result else { panic!("{result:?}") };
    let codes: Vec<&str> = faults.iter().map(|f| f.code.as_str()).collect();
    assert_eq!(codes, ["out-of-range", "out-of-range", "profile-unknown"]);
}

#[test]
fn wrong_parameters_and_wrong_files_are_told_apart() {
    let (result, _) = run("file = \"p.dxf\"\nsize = \"44\"", &[("p.dxf", &pattern())]);
    assert!(matches!(&result, Err(StageError::Parameter(f)) if f[0].message.contains("there are: 40")), "{result:?}");
    let (result, _) = run("file = \"p.dxf\"", &[("p.dxf", "no dxf")]);
    assert!(matches!(&result, Err(StageError::Input(f)) if f[0].code == "not-dxf"), "{result:?}");
    let (result, _) = run("file = \"p.dxf\"", &[]);
    assert!(matches!(result, Err(StageError::File(_))));
    assert!(toml::from_str::<ImportDxfParams>("file = \"p.dxf\"\nsizes = 3").is_err());
    assert!(builtin().get("import-dxf").is_some());
}

/// A second block, FLAP, whose outline crosses itself.
fn with_a_crossing_flap() -> String {
    let mut flap = pairs(&[(0, "BLOCK"), (2, "FLAP_40"), (0, "TEXT"), (8, "1"), (1, "Piece Name: FLAP")]);
    flap += &pairs(&[(0, "TEXT"), (8, "1"), (1, "Size: 40"), (0, "POLYLINE"), (8, "1"), (70, "1")]);
    for (x, y) in [("300", "0"), ("500", "100"), ("500", "0"), ("300", "100")] {
        flap += &pairs(&[(0, "VERTEX"), (8, "1"), (10, x), (20, y)]);
    }
    flap += &pairs(&[(0, "SEQEND"), (0, "ENDBLK")]);
    pattern().replacen("0\nENDBLK\n", &format!("0\nENDBLK\n{flap}"), 1)
}

#[test]
fn pieces_that_are_asked_for_come_without_a_wrong_one() {
    let text = with_a_crossing_flap();
    let files = [("p.dxf", text.as_str())];
    let Err(StageError::Input(faults)) = run("file = \"p.dxf\"", &files).0 else { panic!("FLAP is asked for too") };
    assert_eq!(faults.iter().map(|f| f.code.as_str()).collect::<Vec<_>>(), ["outline-crosses-itself", "sound-parts"]);
    assert_eq!(faults[0].source.as_ref().and_then(|s| s.block.as_deref()), Some("FLAP_40"));
    let (garment, report) = run("file = \"p.dxf\"\npieces = [\"back\"]", &files);
    assert_eq!(garment.expect("sound").pieces.iter().map(|p| p.name.as_str()).collect::<Vec<_>>(), ["BACK"]);
    let told = report.findings.iter().find(|f| f.code == "pieces-refused").expect("told");
    assert!(told.message.contains("`FLAP` in size 40 (outline-crosses-itself)"), "{}", told.message);
    let (wrong, _) = run("file = \"p.dxf\"\npieces = [\"SLEEVE\"]", &files);
    assert!(matches!(&wrong, Err(StageError::Parameter(f)) if f[0].code == "piece-not-found"), "{wrong:?}");
}

/// A broken table beside the pattern, which nobody asked for, does not keep drawn sizes from being read.
#[test]
fn a_broken_table_beside_the_pattern_is_a_warning() {
    let files = [("p.dxf", pattern()), ("p.RUL", RULES.replace("20 0", "20"))];
    let files: Vec<(&str, &str)> = files.iter().map(|(n, t)| (*n, t.as_str())).collect();
    let (garment, report) = run("file = \"p.dxf\"", &files);
    assert_eq!(garment.expect("drawn").size.as_deref(), Some("40"));
    let warnings = report.findings.iter().filter(|f| f.severity == Severity::Warning);
    let codes: Vec<&str> = warnings.map(|f| f.code.as_str()).collect();
    assert_eq!(codes, ["rule-table-broken", "rule-count-differs", "grain-missing"], "every mistake is told");
    let (asked, _) = run("file = \"p.dxf\"\nrules = \"p.RUL\"", &files);
    assert!(matches!(&asked, Err(StageError::Input(f)) if f[0].code == "rule-count-differs"), "{asked:?}");
}

#[test]
fn a_list_of_sizes_gives_every_piece_in_each() {
    let files = [("p.dxf", pattern()), ("p.rul", RULES.to_owned())];
    let files: Vec<(&str, &str)> = files.iter().map(|(n, t)| (*n, t.as_str())).collect();
    for sizes in ["[\"40\", \"42\"]", "[\"all\"]"] {
        let (garment, _) = run(&format!("file = \"p.dxf\"\nsize = {sizes}"), &files);
        let garment = garment.expect("both");
        let names: Vec<&str> = garment.pieces.iter().map(|p| p.name.as_str()).collect();
        assert_eq!(names, ["BACK@40", "BACK@42"], "{sizes}");
        // 200 × 400 mm; in 42 the upper right corner is 20 mm further right, the lower left stays: between them by
        // length.
        assert!((garment.pieces[0].outline.signed_area() - 0.08).abs() < 1e-12);
        let right = garment.pieces[1].outline.positions().iter().map(|p| p.x).fold(0.0, f64::max);
        assert!((right - 0.22).abs() < 1e-12);
    }
    let (missing, _) = run("file = \"p.dxf\"\nsize = [\"40\", \"48\"]", &files);
    assert!(matches!(missing, Err(StageError::Parameter(f)) if f[0].code == "size-not-found"));
    let (sewn, _) = run("file = \"p.dxf\"\nsize = [\"40\"]\nsewing = \"s.toml\"", &files);
    let Err(StageError::Several(all)) = sewn else { panic!("several mistakes") };
    assert!(matches!(&all[0], StageError::Parameter(f) if f[0].code == "sizes-with-sewing"));
    assert!(matches!(all[1], StageError::File(_)), "nor is there such a file");
}

#[test]
fn a_cut_line_is_made_when_asked_for() {
    let (garment, _) = run("file = \"p.dxf\"\nallowance = { width = \"10 mm\" }", &[("p.dxf", &pattern())]);
    let piece = &garment.expect("garment").pieces[0];
    // The drawn 200 × 400 mm is sewn, 220 × 420 mm is cut.
    assert!((piece.outline.signed_area() - 0.08).abs() < 1e-12);
    assert!((piece.cut_line.as_ref().expect("cut line").signed_area() - 0.0924).abs() < 1e-9);
    let (wrong, _) = run(
        "file = \"p.dxf\"\nallowance = { width = \"10 mm\", edges = { \"BACK.9\" = \"1 mm\" } }",
        &[("p.dxf", &pattern())],
    );
    assert!(matches!(wrong, Err(StageError::Parameter(f)) if f[0].code == "edge-unknown"));
}
