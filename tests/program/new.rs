//! `toile new`: the seams that it proposes for the samples, against the samples' own sewing files.

use crate::support;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use support::bench::{Said, command};
use toile_formats::dxf::{self, ReadOptions};
use toile_garment::{Garment, Report, Vec2};
use toile_stages::roles::joins_of_plan;
use toile_stages::sewing::{apply, resolve, shapes};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn toile(arguments: &[&str]) -> Said {
    command(arguments.iter().map(Into::into).collect())
}

/// Makes a folder from a sample's pattern.
fn new(name: &str, folder: &Path, more: &[&str]) -> (Said, Value) {
    let pattern = root().join(format!("samples/patterns/{name}.aama.dxf"));
    let mut arguments = vec!["new", pattern.to_str().expect("path"), "--out", folder.to_str().expect("path")];
    arguments.extend(more);
    let said = toile(&arguments);
    assert!(said.code <= 1, "{said:?}");
    let text = std::fs::read_to_string(folder.join("proposal.json")).expect("proposal");
    (said, serde_json::from_str(&text).expect("JSON"))
}

/// A point on a piece: block, instance, millimetres.
type Place = (String, u64, Vec2);

/// Points that the sample's own sewing file sews to each other.
fn true_pairs(name: &str) -> Vec<[Place; 2]> {
    let bytes = std::fs::read(root().join(format!("samples/patterns/{name}.aama.dxf"))).expect("pattern");
    let text = std::fs::read_to_string(root().join(format!("samples/patterns/{name}.sewing.toml"))).expect("text");
    let pattern = dxf::read(&bytes, name, &ReadOptions::default()).expect("DXF");
    let (mut garment, _) = pattern.to_garment(None, None).expect("garment");
    let plan = toile_formats::sewing::read(&text, name).expect("sewing file");
    apply(&mut garment, plan, &mut Report::default()).expect("applies");
    let rings = shapes::shapes(&garment).expect("outlines");
    let seams = resolve::placed(resolve::find(&garment, &rings)).expect("seams");
    let place = |p: toile_stages::roles::PiecePoint| place(&garment, p.piece, p.at);
    joins_of_plan(&seams, &rings).into_iter().flat_map(|j| j.pairs).map(|pair| pair.map(place)).collect()
}

/// A point as `proposal.json` has it: copies are drawn as the piece they are cut from.
fn place(garment: &Garment, piece: usize, at: Vec2) -> Place {
    let piece = &garment.pieces[piece];
    let copy = garment.plan.copies.iter().find(|c| c.name == piece.name);
    let x = if copy.is_some_and(|c| c.mirror) { -at.x } else { at.x };
    (piece.block.clone(), u64::from(copy.is_some()), Vec2::new(x, at.y) * 1e3)
}

/// The runs of a side: block, instance and points.
fn runs(side: &Value) -> Vec<(String, u64, Vec<Vec2>)> {
    let number = |v: &Value| v.as_f64().expect("number");
    let point = |v: &Value| Vec2::new(number(&v[0]), number(&v[1]));
    let run = |r: &Value| {
        let points = r["points_mm"].as_array().expect("points").iter().map(point).collect();
        (r["piece"].as_str().expect("block").to_owned(), r["instance"].as_u64().expect("instance"), points)
    };
    side["runs"].as_array().expect("runs").iter().map(run).collect()
}

/// Shares of a side's length at which it passes a point within 6 mm.
fn shares(side: &Value, place: &Place) -> Vec<f64> {
    let runs = runs(side);
    let length = |points: &[Vec2]| points.windows(2).map(|w| (w[1] - w[0]).norm()).sum::<f64>();
    let total: f64 = runs.iter().map(|r| length(&r.2)).sum();
    let (mut before, mut out) = (0.0, Vec::new());
    for (block, instance, points) in &runs {
        for w in points.windows(2) {
            let d = w[1] - w[0];
            let t = ((place.2 - w[0]).dot(&d) / d.norm_squared().max(1e-12)).clamp(0.0, 1.0);
            if (block, *instance) == (&place.0, place.1) && (w[0] + d * t - place.2).norm() < 6.0 {
                out.push((before + t * d.norm()) / total);
            }
            before += d.norm();
        }
    }
    out
}

/// Does a proposed seam sew two points to each other, within 12 mm along it?
fn sews(seam: &Value, [p, q]: &[Place; 2]) -> bool {
    let length: f64 = runs(&seam["a"]).iter().flat_map(|r| r.2.windows(2)).map(|w| (w[1] - w[0]).norm()).sum();
    let meets = |x: &Place, y: &Place| {
        let (a, b) = (shares(&seam["a"], x), shares(&seam["b"], y));
        a.iter().any(|s| b.iter().any(|t| (s - t).abs() * length < 12.0))
    };
    meets(p, q) || meets(q, p)
}

/// Share of the points sewn by the sample's own file that a proposal sews too.
fn found(name: &str, proposal: &Value) -> f64 {
    let pairs = true_pairs(name);
    let seams = proposal["seams"].as_array().expect("seams");
    let hits = pairs.iter().filter(|pair| seams.iter().any(|s| sews(s, pair))).count();
    hits as f64 / pairs.len() as f64
}

fn folder() -> (tempfile::TempDir, PathBuf) {
    let dir = tempfile::tempdir().expect("folder");
    let out = dir.path().join("new");
    (dir, out)
}

/// Shares of the samples' seams that are found at least, and can the garment be sewn and draped without a correction?
/// The bodice has side seams that a dart parts on one side alone, and the neckband of the T-shirt has no mark where front
/// and back meet.
const FOUND: [(&str, f64, bool); 3] =
    [("long-skirt", 1.0, true), ("fitted-bodice", 0.55, false), ("t-shirt", 0.78, true)];

#[test]
fn the_seams_of_the_samples_are_found_as_far_as_their_marks_tell() {
    for (name, least, drapes) in FOUND {
        let (_dir, out) = folder();
        let (said, proposal) = new(name, &out, &[]);
        assert_eq!(said.code, 0, "{said:?}");
        assert!(said.err.contains("start.html") && said.err.contains("toile watch"), "{said:?}");
        let share = found(name, &proposal);
        assert!(share >= least, "{name}: {share}");
        let pipeline = out.join("pipeline.toml");
        let checked = toile(&["check", pipeline.to_str().expect("path")]);
        // Every seam is told until somebody confirms it.
        assert!(checked.err.contains("seam-proposed"), "{}", checked.err);
        // Sides are edges and parts of edges, never points; seams have the names of the workroom.
        let sewing = std::fs::read_to_string(out.join("sewing.toml")).expect("sewing file");
        assert!(!sewing.contains("from = [") && sewing.contains("name = \"side seam left"), "{sewing}");
        let page = std::fs::read_to_string(out.join("start.html")).expect("page");
        if drapes {
            let folder = out.join("out");
            let more = ["--quiet", "--set", "triangulate.edge_length=\"25 mm\""];
            let places = [pipeline.to_str().expect("path"), "--out", folder.to_str().expect("path")];
            let run = toile(&[&["run"], &places[..], &more[..]].concat());
            assert_eq!(run.code, 0, "{name}: {run:?}");
        }
        assert!(page.contains("data-toile-page") && page.contains("id=\"toile-model\"") && !page.contains("http:"));
        // Three views of the pieces on the body, one drawing for each piece, and every edge can be clicked.
        let count = |text: &str| page.matches(text).count();
        let pieces = page.split("<div class=\"pieces\">").nth(1).map_or(0, |p| p.matches("<svg").count());
        assert!(pieces >= 2 && count("<svg") == pieces + 3 && count("data-edge=") >= 4 * pieces, "{name}: {pieces}");
    }
}

#[test]
fn a_folder_that_was_made_in_part_is_completed_with_the_same_bytes() {
    let (_dir, out) = folder();
    let (said, _) = new("fitted-bodice", &out, &[]);
    let names: Vec<String> =
        said.out.lines().filter_map(|l| Path::new(l).file_name()?.to_str().map(str::to_owned)).collect();
    let whole: Vec<Vec<u8>> = names.iter().map(|n| std::fs::read(out.join(n)).expect("file")).collect();
    assert!(names.len() > 5 && names.last().is_some_and(|n| n == "sewing.toml"), "{names:?}");
    // The files got their names in this order. A kill leaves the first few, and a file under a temporary name.
    for count in 1..names.len() {
        let (_dir, part) = folder();
        std::fs::create_dir_all(&part).expect("folder");
        for name in &names[..count] {
            std::fs::copy(out.join(name), part.join(name)).expect("copied");
        }
        std::fs::write(part.join(".4711-0.tmp-toile"), "half").expect("file");
        new("fitted-bodice", &part, &[]);
        for (name, bytes) in names.iter().zip(&whole) {
            assert_eq!(&std::fs::read(part.join(name)).expect("file"), bytes, "{name} after {count} files");
        }
        assert_eq!(std::fs::read_dir(&part).expect("folder").count(), names.len(), "{count}");
    }
}

/// A name that turns the order of letters is written out in every file that a person opens, and still means the same.
#[test]
fn a_name_that_turns_letters_is_escaped_in_every_file() {
    let dir = tempfile::tempdir().expect("folder");
    let name = "F\u{202e}RONT";
    let sample = root().join("samples/patterns/long-skirt.aama.dxf");
    let text = std::fs::read_to_string(sample).expect("pattern").replace("FRONT", name);
    let pattern = dir.path().join("turned.dxf");
    std::fs::write(&pattern, text).expect("pattern");
    let (folder, out) = (dir.path().join("folder"), dir.path().join("out"));
    let path = |path: &Path| path.to_str().expect("path").to_owned();
    let said = toile(&["new", &path(&pattern), "--out", &path(&folder)]);
    assert!(said.code <= 1, "{said:?}");
    let pipeline = path(&folder.join("pipeline.toml"));
    let more = format!(
        "{}\n[[stage]]\nuse = \"export-obj\"\nwith.file = \"{{out}}/a.obj\"\n\
         [[stage]]\nuse = \"export-dxf\"\nwith.file = \"{{out}}/a.dxf\"\nwith.code_page = \"utf-8\"\n\
         with.sewing = \"{{out}}/a.sewing.toml\"\n",
        std::fs::read_to_string(&pipeline).expect("pipeline")
    );
    std::fs::write(&pipeline, more).expect("pipeline");
    let coarse = ["--set", "triangulate.edge_length=40 mm", "--quiet"];
    let said = toile(&[&["run", &pipeline, "--out", &path(&out)][..], &coarse].concat());
    assert!(said.code <= 1, "{said:?}");
    let mut looked_at = 0;
    for file in [&folder, &out].into_iter().flat_map(|f| std::fs::read_dir(f).expect("folder")) {
        let file = file.expect("file").path();
        if file.ends_with("turned.dxf") || file.is_dir() {
            continue;
        }
        let bytes = std::fs::read(&file).expect("file");
        let turn = "\u{202e}".as_bytes();
        assert!(!bytes.windows(turn.len()).any(|w| w == turn), "{}", file.display());
        looked_at += 1;
    }
    assert!(looked_at >= 14, "{looked_at} files");
    let plan = std::fs::read_to_string(folder.join("sewing.toml")).expect("sewing");
    assert!(plan.contains("F\\u202eRONT"), "{plan}");
    let plan = toile_formats::sewing::read(&plan, "sewing.toml").expect("sewing file");
    assert!(format!("{plan:?}").contains(&format!("{name:?}").trim_matches('"').to_owned()), "{plan:?}");
    let again = std::fs::read(out.join("a.dxf")).expect("DXF");
    let again = dxf::read(&again, "a.dxf", &ReadOptions::default()).expect("DXF");
    assert!(again.pieces.iter().any(|p| p.label() == name));
}

#[test]
fn a_seam_that_nobody_confirmed_is_no_surer_when_asked_again() {
    let sure = |proposal: &Value| -> BTreeMap<String, String> {
        let seams = proposal["seams"].as_array().expect("seams").iter();
        seams.map(|s| (s["name"].as_str().expect("name").to_owned(), s["confidence"].to_string())).collect()
    };
    let (_dir, out) = folder();
    let (_, first) = new("fitted-bodice", &out, &[]);
    let (_, again) = new("fitted-bodice", &out, &[]);
    let (first, again) = (sure(&first), sure(&again));
    let both: Vec<&String> = first.keys().filter(|k| again.contains_key(*k)).collect();
    assert!(both.len() > 3, "{first:?} {again:?}");
    assert!(both.iter().all(|k| first[*k] == again[*k]), "{first:?} {again:?}");
}

#[test]
fn a_folder_keeps_what_a_person_wrote() {
    let (_dir, out) = folder();
    new("long-skirt", &out, &[]);
    let file = out.join("sewing.toml");
    std::fs::write(&file, "# mine\n").expect("written");
    let (said, _) = new("long-skirt", &out, &["--anonymous"]);
    assert_eq!(std::fs::read_to_string(&file).expect("text"), "# mine\n");
    assert!(said.err.contains("kept"), "{said:?}");
}

#[test]
fn a_sewing_file_is_filled_and_what_a_person_took_out_stays_out() {
    let (_dir, out) = folder();
    new("long-skirt", &out, &[]);
    let file = out.join("sewing.toml");
    let written = std::fs::read_to_string(&file).expect("text");
    let tables: Vec<&str> = written.split("\n[[seam]]\n").collect();
    assert!(tables.len() > 2, "{written}");
    // The person confirms all seams, and takes the last one out.
    let confirmed: Vec<String> = tables[..tables.len() - 1]
        .iter()
        .map(|t| t.lines().filter(|l| !l.starts_with("proposed")).map(|l| format!("{l}\n")).collect())
        .collect();
    let mine = confirmed.join("\n[[seam]]\n");
    std::fs::write(&file, &mine).expect("written");
    for _ in 0..2 {
        new("long-skirt", &out, &[]);
        assert_eq!(std::fs::read_to_string(&file).expect("text"), mine, "nothing is proposed again");
    }
    // Without the memory the seam is only missing: it is added below, and no line of the person changes.
    std::fs::remove_file(out.join("proposal.json")).expect("removed");
    new("long-skirt", &out, &[]);
    let filled = std::fs::read_to_string(&file).expect("text");
    assert!(filled.starts_with(&mine), "{filled}");
    assert_eq!(filled.matches("[[seam]]").count(), tables.len() - 1);
    assert_eq!(filled.matches("\nproposed = ").count(), 1);
}

/// The page and the proposal show a person's seams to the millimetre, also where no notch marks their ends.
#[test]
fn seams_of_the_file_are_shown_as_they_were_written() {
    let (_dir, out) = folder();
    let (_, proposed) = new("long-skirt", &out, &[]);
    let length = |of: &Value| {
        let points = of["runs"][0]["points_mm"].as_array().expect("points");
        let at = |p: &Value| [0, 1].map(|k| p[k].as_f64().expect("number"));
        let step = |w: &[Value]| [0, 1].map(|k| at(&w[1])[k] - at(&w[0])[k]);
        points.windows(2).map(step).map(|[x, y]| (x * x + y * y).sqrt()).sum::<f64>()
    };
    let side = |p: &Value, name: &str| {
        let seams = p["seams"].as_array().expect("seams").clone();
        seams.into_iter().find(|s| s["name"] == name).unwrap_or_else(|| panic!("{name}"))
    };
    let whole = length(&side(&proposed, "side seam left")["a"]);
    let part = |edge: &str| {
        let (piece, number) = edge.split_once('.').expect("edge");
        format!("{{ piece = \"{piece}\", edge = {number}, from = \"30 %\", to = \"90 %\" }}")
    };
    let text = std::fs::read_to_string(out.join("sewing.toml")).expect("text");
    let seam = text.split("[[seam]]").find(|t| t.contains("\"side seam left\"")).expect("seam");
    let edges: Vec<&str> = seam.lines().filter_map(|l| l.split('"').nth(1)).filter(|e| e.contains('.')).collect();
    let mine = format!("[[seam]]\nname = \"slit\"\na = {}\nb = {}\n", part(edges[0]), part(edges[1]));
    let mine = mine.replacen("\"30 %\", to = \"90 %\"", "\"10 %\", to = \"70 %\"", 1);
    std::fs::write(out.join("sewing.toml"), &mine).expect("written");
    let (_, again) = new("long-skirt", &out, &[]);
    let shown = side(&again, "slit");
    assert!((length(&shown["a"]) - 0.6 * whole).abs() < 0.5 && shown["confidence"] == 1.0, "{shown} {whole}");
    let page = std::fs::read_to_string(out.join("start.html")).expect("page");
    assert!(page.contains("Yours, from sewing.toml") && page.contains("slit: "), "{mine}");
}

/// A pattern in millimetres with all places in metres.
fn in_metres(pattern: &Path) -> String {
    let text = std::fs::read_to_string(pattern).expect("pattern");
    let lines: Vec<&str> = text.lines().collect();
    let pair = |pair: &[&str]| {
        let is_place = matches!(pair[0].trim(), "10" | "20" | "11" | "21" | "30" | "39");
        let value = pair[1].trim().parse::<f64>().ok().filter(|_| is_place);
        format!("{}\n{}\n", pair[0], value.map_or_else(|| pair[1].to_owned(), |v| format!("{:.7}", v * 1e-3)))
    };
    lines.chunks_exact(2).map(pair).collect()
}

#[test]
fn a_unit_that_the_person_gives_reaches_the_pipeline() {
    let (_dir, out) = folder();
    let (_, in_mm) = new("long-skirt", &out, &["--units", "mm"]);
    let text = std::fs::read_to_string(out.join("pipeline.toml")).expect("text");
    assert!(text.contains("with.units  = \"mm\""), "{text}");
    let (_dir, out) = folder();
    let (_, plain) = new("long-skirt", &out, &[]);
    assert_eq!(in_mm["seams"], plain["seams"]);
    // The same pattern in metres, and its unit said.
    let (dir, out) = folder();
    let pattern = dir.path().join("metres.dxf");
    std::fs::write(&pattern, in_metres(&root().join("samples/patterns/long-skirt.aama.dxf"))).expect("pattern");
    let arguments = ["new", pattern.to_str().expect("path"), "--out", out.to_str().expect("path"), "--units", "m"];
    assert_eq!(toile(&arguments).code, 0);
    assert!(std::fs::read_to_string(out.join("pipeline.toml")).expect("text").contains("with.units  = \"m\""));
    let proposal = std::fs::read_to_string(out.join("proposal.json")).expect("proposal");
    let proposal: Value = serde_json::from_str(&proposal).expect("JSON");
    let ends = |v: &Value| v["seams"].as_array().expect("seams").len();
    assert_eq!(ends(&proposal), ends(&plain));
    let (_dir, out) = folder();
    let pattern = root().join("samples/patterns/long-skirt.aama.dxf");
    let places = [pattern.to_str().expect("path"), "--out", out.to_str().expect("path"), "--units", "ell"];
    assert_eq!(toile(&[&["new"], &places[..]].concat()).code, 2);
}

#[test]
fn a_pattern_too_small_for_any_garment_is_refused_until_its_unit_is_said() {
    let (dir, out) = folder();
    let text = std::fs::read_to_string(root().join("samples/patterns/long-skirt.aama.dxf")).expect("text");
    // The same drawing in decimetres, which still says that it is in millimetres.
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    for pair in lines.chunks_mut(2).filter(|p| matches!(p[0].trim(), "10" | "20")) {
        pair[1] = (pair[1].trim().parse::<f64>().expect("number") / 100.0).to_string();
    }
    let pattern = dir.path().join("small.dxf");
    std::fs::write(&pattern, lines.join("\n") + "\n").expect("written");
    let places = ["new", pattern.to_str().expect("path"), "--out", out.to_str().expect("path")];
    let said = toile(&places);
    assert_eq!(said.code, 3, "{said:?}");
    assert!(
        said.err.contains("error[pattern-tiny]") && said.err.contains("`--units inch` makes it 220 mm long"),
        "{said:?}"
    );
    assert!(!out.exists());
    assert_eq!(toile(&[&places[..], &["--units", "mm"]].concat()).code, 0);
}

#[test]
fn samples_are_made_without_the_repository_and_can_be_checked() {
    for word in ["skirt", "bodice", "t-shirt"] {
        let (_dir, out) = folder();
        let said = toile(&["new", word, "--body", "36", "--out", out.to_str().expect("path")]);
        assert_eq!(said.code, 0, "{said:?}");
        let checked = toile(&["check", out.join("pipeline.toml").to_str().expect("path")]);
        assert_eq!(checked.code, 0, "{word}: {checked:?}");
    }
}

#[test]
fn what_is_not_there_is_named() {
    let (_dir, out) = folder();
    let out = out.to_str().expect("path");
    let said = toile(&["new", "skirt", "--fabric", "tweed", "--out", out]);
    assert!(said.code == 2 && said.err.contains("cotton-shirting"), "{said:?}");
    let said = toile(&["new", "skirt", "--body", "99", "--out", out]);
    assert!(said.code == 2 && said.err.contains("women-32 to women-56"), "{said:?}");
    assert!(!Path::new(out).exists());
    assert_eq!(toile(&["new", "no-such.dxf", "--out", out]).code, 3);
}

/// Makes a folder from the bodice, of which the size has another name.
fn bodice_of_size(label: &str, more: &[&str]) -> (Said, Vec<String>) {
    let folder = tempfile::tempdir().expect("folder");
    let text = std::fs::read_to_string(root().join("samples/patterns/fitted-bodice.aama.dxf")).expect("pattern");
    let pattern = folder.path().join("bodice.dxf");
    std::fs::write(&pattern, text.replace("Size: 38", &format!("Size: {label}"))).expect("pattern");
    let out = folder.path().join("out");
    let mut arguments = vec!["new", pattern.to_str().expect("path"), "--out", out.to_str().expect("path")];
    arguments.extend(more);
    let said = toile(&arguments);
    let names =
        std::fs::read_dir(&out).expect("folder").map(|e| e.expect("entry").file_name().into_string().expect("name"));
    let bodies = names.filter(|n| n.ends_with(".obj")).collect();
    (said, bodies)
}

#[test]
fn the_body_is_questioned() {
    // 914 mm around the bust: 34 mm ease on 38, and 114 mm on 34.
    let (said, bodies) = bodice_of_size("38", &[]);
    assert!(!said.err.contains("[body-") && bodies == ["body-38.obj"], "{said:?}");
    let (said, bodies) = bodice_of_size("34", &[]);
    assert!(said.err.contains("note[body-chosen]") && bodies == ["body-women-34.obj"], "{said:?}");
    let (said, bodies) = bodice_of_size("34", &["--body", "38"]);
    assert!(said.err.contains("warning[body-does-not-fit]") && said.err.contains("--body women-34"), "{said:?}");
    assert_eq!(bodies, ["body-38.obj"]);
    let (said, _) = bodice_of_size("38", &["--body", "men-56"]);
    assert!(said.err.contains("mm too narrow"), "{said:?}");
    let (said, _) = bodice_of_size("38", &["--body", "child-110"]);
    assert!(said.err.contains("mm ease") && said.err.contains("--body women-38"), "{said:?}");
    let (said, _) = bodice_of_size("M", &[]);
    assert!(!said.err.contains("[body-"), "{said:?}");
}

#[test]
fn a_mesh_that_stands_otherwise_is_stood_upright() {
    let folder = tempfile::tempdir().expect("folder");
    let at = |name: &str| folder.path().join(name).to_str().expect("path").to_owned();
    let text = std::fs::read_to_string(root().join("samples/bodies/size-38.obj")).expect("body");
    let turned = |line: &str| match line.strip_prefix("v ") {
        None => format!("{line}\n"),
        Some(numbers) => {
            let p: Vec<f64> = numbers.split_whitespace().map(|n| 1e3 * n.parse::<f64>().expect("number")).collect();
            format!("v {} {} {}\n", p[0], -p[2], p[1])
        }
    };
    std::fs::write(at("scan.obj"), text.lines().map(turned).collect::<String>()).expect("mesh");
    let said = toile(&["body", "measure", &at("scan.obj"), "--picture", &at("scan.svg")]);
    assert_eq!(said.code, 3, "{said:?}");
    assert!(said.err.contains("error[body-not-standing]") && said.out.contains("+z up, front to -y, mm; A pose"));
    assert!(!folder.path().join("scan.toml").exists() && folder.path().join("scan.svg").exists());
    let said = toile(&["body", "measure", &at("scan.obj"), "--out", &at("upright.obj")]);
    assert_eq!(said.code, 0, "{said:?}");
    let said = toile(&["body", "measure", &at("upright.obj"), "--force"]);
    assert!(said.code == 0 && said.out.contains("+y up, front to +z, m; A pose"), "{said:?}");
    let pattern = root().join("samples/patterns/fitted-bodice.aama.dxf");
    let arguments = ["new", pattern.to_str().expect("path"), "--out", &at("out"), "--body", &at("scan.obj")];
    let said = toile(&arguments);
    assert!(said.err.contains("warning[body-not-standing]") && !said.err.contains("body-does-not-fit"), "{said:?}");
    let side = std::fs::read_to_string(folder.path().join("out/scan.toml")).expect("side file");
    assert!(side.contains("waist_height") && side.contains("[segments.torso]"), "{side}");
    // Asked again, the folder keeps its body.
    let said = toile(&["new", pattern.to_str().expect("path"), "--out", &at("out")]);
    assert!(said.code <= 1 && !folder.path().join("out/body-38.obj").exists(), "{said:?}");
}

/// The text of a file in a folder.
fn text_of(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).expect(name)
}

#[test]
fn another_size_of_a_pattern_is_taken_with_its_body() {
    let (_dir, out) = folder();
    let (said, _) = new("long-skirt", &out, &["--size", "40"]);
    assert!(said.err.contains("note[size-taken] size 40 was taken; the file holds 36, 38, 40"), "{said:?}");
    let bodies: Vec<String> = support::bench::list(&out).into_iter().filter(|n| n.ends_with(".obj")).collect();
    assert!(bodies.len() == 1 && bodies[0].ends_with("40.obj"), "{bodies:?}");
    let pipeline = text_of(&out, "pipeline.toml");
    assert!(pipeline.contains("default = \"40\"") && pipeline.contains("with.size   = \"{size}\""), "{pipeline}");
    // Any size is a plain word on the command line, by the input and by the stage.
    let file = out.join("pipeline.toml");
    let check = |set: &str| toile(&["check", file.to_str().expect("path"), "--set", set]);
    assert_eq!(check("size=36").code, 0, "{:?}", check("size=36"));
    assert_eq!(check("import-dxf.size=36").code, 0, "{:?}", check("import-dxf.size=36"));
    let wrong = check("size=37");
    assert!(wrong.code == 2 && wrong.err.contains("36, 38, 40"), "{wrong:?}");
    // A parameter without its stage is told with the line to type.
    let wrong = check("edge_length=20 mm");
    assert!(wrong.err.contains("write --set 'triangulate.edge_length=20 mm'"), "{wrong:?}");
    // The folder stays one of its size.
    let (again, _) = new("long-skirt", &out, &[]);
    assert!(again.err.contains("size 40 was taken"), "{again:?}");
    let sample = root().join("samples/patterns/long-skirt.aama.dxf");
    let places = ["new", sample.to_str().expect("path"), "--out", out.to_str().expect("path")];
    let other = toile(&[&places[..], &["--size", "36"]].concat());
    assert!(other.code == 2 && other.err.contains("error[folder-of-another] this folder sews size 40"), "{other:?}");
    let (_dir, out) = folder();
    let missing = toile(&["new", "skirt", "--size", "99", "--out", out.to_str().expect("path")]);
    assert!(missing.code == 2 && missing.err.contains("there are: 36, 38, 40"), "{missing:?}");
    let said = toile(&["new", "skirt", "--size", "36", "--out", out.to_str().expect("path")]);
    assert!(said.code == 0 && out.join("body-36.obj").exists(), "{said:?}");
    assert!(text_of(&out, "pipeline.toml").contains("default = \"36\""));
}

#[test]
fn a_body_of_another_size_of_the_file_leads_to_that_size() {
    let (_dir, out) = folder();
    let (said, _) = new("fitted-bodice", &out, &["--body", "56"]);
    assert!(said.err.contains("warning[body-does-not-fit]") && !said.err.contains("child-"), "{said:?}");
    let (_dir, out) = folder();
    let (said, _) = new("fitted-bodice", &out, &["--size", "36", "--body", "men-50"]);
    assert!(!said.err.contains("--body men") && !said.err.contains("--body child"), "{said:?}");
}

#[test]
fn a_folder_of_another_pattern_is_refused() {
    let (_dir, out) = folder();
    new("long-skirt", &out, &[]);
    let other = root().join("samples/patterns/fitted-bodice.aama.dxf");
    let said = toile(&["new", other.to_str().expect("path"), "--out", out.to_str().expect("path")]);
    assert!(said.code == 2 && said.err.contains("this folder is that of"), "{said:?}");
    assert!(said.err.contains("choose another folder with --out") && !out.join("fitted-bodice.aama.dxf").exists());
    // A new drawing under the old name is not proposed for the old one.
    let (dir, renewed) = (tempfile::tempdir().expect("folder"), "long-skirt.aama.dxf");
    let text = std::fs::read_to_string(root().join("samples/patterns").join(renewed)).expect("pattern");
    std::fs::write(dir.path().join(renewed), text + "999\nnew\n").expect("pattern");
    let renewed = dir.path().join(renewed);
    let said = toile(&["new", renewed.to_str().expect("path"), "--out", out.to_str().expect("path")]);
    assert!(said.code == 2 && said.err.contains("copy the new pattern over the one in the folder"), "{said:?}");
}

#[test]
fn a_pattern_too_large_for_any_garment_is_refused() {
    let (_dir, out) = folder();
    let pattern = root().join("samples/patterns/long-skirt.aama.dxf");
    let places = ["new", pattern.to_str().expect("path"), "--out", out.to_str().expect("path")];
    for unit in ["cm", "inch", "m"] {
        let said = toile(&[&places[..], &["--units", unit]].concat());
        assert!(said.code == 3 && !out.exists(), "{unit}: {said:?}");
    }
    let said = toile(&[&places[..], &["--units", "cm"]].concat());
    assert!(said.err.contains("error[pattern-huge]") && said.err.contains("`--units mm` makes it"), "{said:?}");
}

#[test]
fn a_misspelt_name_is_guessed() {
    let (_dir, out) = folder();
    let out = out.to_str().expect("path");
    let said = toile(&["new", "skirt", "--fabric", "cotton-poplin-blue", "--out", out]);
    assert!(said.err.contains("did you mean `cotton-poplin`?"), "{said:?}");
    let misspelt = root().join("samples/patterns/long-skrit.aama.dxf");
    let said = toile(&["new", misspelt.to_str().expect("path"), "--out", out]);
    assert!(said.code == 3 && said.err.contains("did you mean `") && said.err.contains("long-skirt.a"), "{said:?}");
}

#[test]
fn a_layer_of_another_number_is_named() {
    let (dir, out) = folder();
    let text = std::fs::read_to_string(root().join("samples/patterns/long-skirt.aama.dxf")).expect("pattern");
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    for pair in lines.chunks_mut(2).filter(|p| p[0].trim() == "8" && p[1].trim() == "1") {
        pair[1] = "21".to_owned();
    }
    let pattern = dir.path().join("layer.dxf");
    std::fs::write(&pattern, lines.join("\n") + "\n").expect("pattern");
    let places = ["new", pattern.to_str().expect("path"), "--out", out.to_str().expect("path")];
    assert_eq!(toile(&places).code, 3);
    let said = toile(&[&places[..], &["--layer", "21=1"]].concat());
    assert_eq!(said.code, 0, "{said:?}");
    let pipeline = text_of(&out, "pipeline.toml");
    assert!(pipeline.contains("with.layers = { \"21\" = \"1\" }"), "{pipeline}");
    assert_eq!(toile(&["check", out.join("pipeline.toml").to_str().expect("path")]).code, 0);
    // Asked again, the folder knows its layers.
    assert_eq!(toile(&places).code, 0);
    assert_eq!(toile(&[&places[..], &["--layer", "21=77"]].concat()).code, 2);
}

/// A garment whose seams stand open is not draped: its start is written, and the run says which seam it is.
#[test]
fn seams_that_stand_wide_open_end_the_run_before_the_drape() {
    let (_dir, out) = folder();
    new("long-skirt", &out, &[]);
    let (file, result) = (out.join("pipeline.toml"), out.join("out"));
    let places = ["run", file.to_str().expect("path"), "--out", result.to_str().expect("path"), "--quiet"];
    // Sewing in time that has no time.
    let sewing = ["--set", "stitch.integrator=central-difference", "--set", "stitch.max_time=1 ms"];
    let sets = [&sewing[..], &["--set", "triangulate.edge_length=30 mm"]].concat();
    let said = toile(&[&places[..], &sets].concat());
    assert_eq!(said.code, 1, "{said:?}");
    let record: Value = serde_json::from_str(&text_of(&result, "run.json")).expect("JSON");
    let all = record["findings"].as_array().expect("findings").clone();
    let told = |code: &str| all.iter().find(|f| f["code"] == code).unwrap_or_else(|| panic!("{code}: {all:?}"));
    assert!(told("not-draped")["hint"].as_str().is_some_and(|h| h.contains("with.open_seams")));
    assert!(told("certificate-failed")["message"].as_str().is_some_and(|m| m.contains("the seam \"")), "{all:?}");
    assert_eq!(record["certificate"]["settled"], false);
    assert!(support::bench::list(&result).iter().any(|n| n.ends_with(".glb")));
}
