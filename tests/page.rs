//! Opens reports in a headless browser: the view in 3D, maps, picking and the drawing work, and nothing is fetched.
//!
//! `tests/page/install` finds or installs the browser. Without one the tests say so, and check the page's text only.

// A machine without a browser is told so.
#![allow(clippy::print_stderr)]

#[path = "page/browser.rs"]
mod browser;

use browser::Browser;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::Command;

const CHECK: &str = include_str!("page/check.js");
const CHECK_START: &str = include_str!("page/check_start.js");
const COMPARE: &str = include_str!("page/compare.js");

/// Looks at the page with all its tables open. Gives what axe finds serious or critical.
const ACCESSIBLE: &str = "(async () => {
  document.querySelectorAll('details').forEach((d) => { d.open = true; });
  const { violations } = await axe.run(document);
  const bad = violations.filter((v) => ['serious', 'critical'].includes(v.impact));
  return JSON.stringify(bad.map((v) => [v.id, v.nodes.map((n) => n.html.slice(0, 200))]));
})()";

/// Runs a pipeline; gives the exit code.
fn run(pipeline: &Path, out: &Path, more: &[&str]) -> Option<i32> {
    let mut command = Command::new(env!("CARGO_BIN_EXE_toile"));
    command.arg("run").arg(pipeline).args(["--quiet", "--out"]).arg(out).args(more);
    command.output().expect("program").status.code()
}

/// The skirt on a coarse mesh.
fn skirt(out: &Path, more: &[&str]) -> Option<i32> {
    let pipeline = Path::new(env!("CARGO_MANIFEST_DIR")).join("pipelines/long-skirt/v1.toml");
    run(&pipeline, out, &[&["--set", "triangulate.triangles=700"], more].concat())
}

fn program() -> Option<PathBuf> {
    let found = browser::find();
    if found.is_none() {
        eprintln!("NOT CHECKED in a browser, because there is none; `tests/page/install` installs one");
    }
    found
}

/// Looks at the open page with axe, where `tests/page/axe` installed it.
fn is_accessible(browser: &mut Browser) {
    let Some(axe) = std::env::var_os("TOILE_AXE").filter(|path| !path.is_empty()) else {
        eprintln!("NOT CHECKED with axe; `tests/page/axe` installs it, and TOILE_AXE names it");
        return;
    };
    browser.value(&format!("{};0", std::fs::read_to_string(axe).expect("axe")));
    let found = browser.value(ACCESSIBLE);
    assert_eq!(found, json!("[]"));
}

/// Opens a report, runs its check, and gives what it saw.
fn opened(browser: &mut Browser, page: &Path, size: [u32; 2]) -> Value {
    checked(browser, page, size, CHECK)
}

/// Opens a page, runs a check in it, and gives what it saw.
fn checked(browser: &mut Browser, page: &Path, size: [u32; 2], check: &str) -> Value {
    browser.open(page, size);
    let saw: Value = serde_json::from_str(browser.value(check).as_str().expect("text")).expect("JSON");
    assert_eq!(saw["errors"], json!([]), "{saw}");
    assert_eq!(saw["requests"], json!([]), "{saw}");
    assert_eq!(browser.problems(), [""; 0]);
    assert!(number(&saw, "/wide") <= 0.0, "the page is wider than its window: {saw}");
    saw
}

fn number(value: &Value, pointer: &str) -> f64 {
    value.pointer(pointer).and_then(Value::as_f64).unwrap_or_else(|| panic!("{pointer} in {value}"))
}

fn says(value: &Value, pointer: &str, words: &str) {
    let text = value.pointer(pointer).and_then(Value::as_str).unwrap_or_default();
    assert!(text.contains(words), "{pointer} should say `{words}`: {value}");
}

#[test]
fn the_page_shows_the_garment_and_what_is_picked() {
    let folder = tempfile::tempdir().expect("folder");
    let out = folder.path().join("out");
    assert_eq!(skirt(&out, &[]), Some(0));
    let (page, csv) = (out.join("report.html"), std::fs::read_to_string(out.join("measures.csv")).expect("measures"));
    let size = std::fs::metadata(&page).expect("page").len();
    assert!(size < 2 << 20, "{size} bytes");
    assert!(csv.contains("\"hip_girth\",body,tape,960.0,mm,840.0,,,\r\n"), "{csv}");
    let Some(program) = program() else { return };
    let mut browser = Browser::start(&program, &[]);
    for window in [[1600, 1000], [1024, 768], [390, 844]] {
        let saw = opened(&mut browser, &page, window);
        let state = json!({"ready": true, "pieces": 2, "picked": null, "map": "cloth", "view": "three-quarter"});
        assert_eq!(saw["state"], state);
        // The skirt fills a good part of the view, with its body more, and less when it is cut.
        let share = |what: &str| number(&saw, &format!("/{what}/share"));
        assert!(share("bare") > 0.08 && share("worn") > share("bare") + 0.01, "{saw}");
        assert!(share("cut") < 0.8 * share("bare") && share("flat") > 0.05, "{saw}");
        assert_ne!(saw["map"]["mean"], saw["bare"]["mean"]);
        assert_eq!(saw["map"]["state"], "strain-warp");
        says(&saw, "/map/legend", "strain along warp, %");
        assert_eq!(saw["onMap"]["mean"], saw["map"]["mean"]);
        says(&saw, "/onMap/words", "strain along warp: ");
        says(&saw, "/onMap/words", "° to the warp, piece FRONT");
        says(&saw, "/cut/words", "mm, seen from above");
        says(&saw, "/picked/words", "piece FRONT");
        let marked = saw["marked"].as_array().expect("list");
        assert!(marked.iter().any(|m| m == "tr") && marked.iter().any(|m| m == "g"), "{saw}");
        says(&saw, "/fromTable/name", "seam:");
        assert_eq!((&saw["fromTable"]["marked"], &saw["fromDrawing"]), (&json!(1), &json!("piece:0")));
        assert_eq!((&saw["key"], &saw["nameless"]), (&json!("left"), &json!(0)));
        // A notch has one label in the table, the drawing and the view, and is found by a click on its place.
        assert_eq!((&saw["notch"]["row"], &saw["notch"]["drawing"]), (&json!("FRONT.n1"), &json!("n1")), "{saw}");
        assert_eq!((&saw["notch"]["spot"], &saw["notch"]["tags"][0]), (&json!(true), &json!("n1")), "{saw}");
        assert_eq!(saw["notch"]["clicked"], saw["notch"]["name"], "{saw}");
        says(&saw, "/notch/words", "notch FRONT.n1: ");
        says(&saw, "/notch/sewn", ", sewn to BACK.n");
    }
    // Paper shows the tables that are open, and axe looks at all of them.
    assert!(browser.sheets() <= 4);
    is_accessible(&mut browser);
    // The viewer measures the hip anew, from the model in single precision.
    let hip: Option<f64> =
        csv.lines().find_map(|l| l.strip_prefix("\"hip_girth\",drape,surface,")?.split(',').next()?.parse().ok());
    let again = 1e3 * browser.value("toile.section(0.84)").as_f64().expect("length");
    assert!((again - hip.expect("hip")).abs() < 1.0, "{again} mm against {hip:?}");
    // Without WebGL the pictures stand in the place of the view.
    drop(browser);
    let still = opened(&mut Browser::start(&program, &["--disable-3d-apis"]), &page, [1024, 768]);
    assert_eq!((&still["state"]["ready"], &still["state"]["view"]), (&json!(false), &json!("still")));
    assert_eq!(still["pictures"][0][1], 840);
}

/// The view draws what `export-picture` draws: the same outline of the cloth and the same colours.
#[test]
fn the_view_shows_what_the_pictures_of_the_command_line_show() {
    let Some(program) = program() else { return };
    let folder = tempfile::tempdir().expect("folder");
    let (out, pipeline) = (folder.path().join("out"), folder.path().join("pictures.toml"));
    let root = env!("CARGO_MANIFEST_DIR");
    let skirt = std::fs::read_to_string(Path::new(root).join("pipelines/long-skirt/v1.toml")).expect("pipeline");
    let mut text = skirt.replace("../../samples", &format!("{root}/samples"));
    let maps = ["cloth", "strain-warp", "ease"];
    for map in maps {
        text += &format!(
            "\n[[stage]]\nuse = \"export-picture\"\nwith.file = \"{{out}}/{map}.png\"\nwith.body = false\n\
             with.colours = \"{map}\"\nwith.width = 600\nwith.height = 800\n"
        );
    }
    std::fs::write(folder.path().join("toile.root"), "").expect("file");
    std::fs::write(&pipeline, text).expect("file");
    let more = ["--set", "triangulate.triangles=700", "--set", "export-report.language=zh", "--allow-read", root];
    assert_eq!(run(&pipeline, &out, &more), Some(0));
    let mut browser = Browser::start(&program, &[]);
    browser.open(&out.join("report.html"), [1024, 768]);
    for map in maps {
        let png = std::fs::read(out.join(format!("{map}.png"))).expect("picture");
        let picture = format!("const PICTURE = \"data:image/png;base64,{}\"", browser::encoded(&png));
        let script = COMPARE.replacen(
            "(async () => {",
            &format!("(async () => {{ {picture}, HEIGHT = 800, MAP = \"{map}\";"),
            1,
        );
        let saw: Value = serde_json::from_str(browser.value(&script).as_str().expect("text")).expect("JSON");
        assert!(number(&saw, "/overlap") > 0.93 && number(&saw, "/fields") > 300.0, "{map}: {saw}");
        assert!(number(&saw, "/median") < 12.0 && number(&saw, "/high") < 20.0, "{map}: {saw}");
    }
    is_accessible(&mut browser);
}

#[test]
fn a_drape_that_did_not_pass_says_why() {
    let folder = tempfile::tempdir().expect("folder");
    let out = folder.path().join("out");
    assert_eq!(skirt(&out, &["--set", "drape.limits.strain_max=0.0001"]), Some(1));
    let text = std::fs::read_to_string(out.join("report.html")).expect("page");
    assert!(text.contains("<p class=\"verdict bad\"><b>Not passed.</b>the largest strain is "), "the verdict");
}

/// A held square of cloth goes through a box: the drape refuses it, and the page shows where they cross.
#[test]
fn a_failed_start_leaves_a_page_that_shows_where() {
    let folder = tempfile::tempdir().expect("folder");
    let (out, pipeline) = (folder.path().join("out"), folder.path().join("crossed.toml"));
    let put = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("file");
    put("toile.root", "");
    let fabric = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/fabrics/wool-suiting.toml");
    std::fs::copy(fabric, folder.path().join("wool.toml")).expect("fabric");
    let cloth = "v -0.3 1 -0.3\nv 0.3 1 -0.3\nv 0.3 1 0.3\nv -0.3 1 0.3\nf 1 3 2\nf 1 4 3\n";
    put("cloth.obj", cloth);
    put("pins.txt", "0\n1\n2\n3\n");
    let corners = (0..8).map(|k| [k & 1, k >> 1 & 1, k >> 2].map(|high| if high == 1 { 0.1 } else { -0.1 }));
    let mut body: String = corners.map(|[x, y, z]| format!("v {x} {} {z}\n", y + 1.0)).collect();
    body.push_str("f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n");
    put("body.obj", &body);
    let text = "toile = 1\n[pipeline]\nline = \"crossed\"\nversion = 1\n[[stage]]\nuse = \"import-mesh\"\n\
                with.cloth = \"cloth.obj\"\nwith.rest = \"positions\"\nwith.fabric = \"wool.toml\"\n\
                with.body = \"body.obj\"\nwith.pins = \"pins.txt\"\n[[stage]]\nuse = \"drape\"\n[[stage]]\nuse = \"export-report\"\n\
                with.measures = \"measures.toml\"\n";
    put("crossed.toml", text);
    // What cannot be measured on a failed garment is no news.
    put("measures.toml", "[[measure]]\nname = \"hem\"\non = \"drape\"\nedges = [\"A.0\"]\n");
    assert_eq!(run(&pipeline, &out, &[]), Some(3));
    let page = out.join("failure.html");
    let said = std::fs::read_to_string(&page).expect("page");
    assert!(said.contains("<p class=\"verdict bad\"><b>Failed.</b>"), "the verdict");
    assert!(!said.contains("measure-missing"), "the measures");
    assert!(!out.join("report.html").exists(), "a failed run has no outputs");
    if let Some(program) = program() {
        let saw = opened(&mut Browser::start(&program, &[]), &page, [1024, 768]);
        // The page opens at the place, which the view, the list and the drawing mark with one number.
        assert_eq!((&saw["state"]["ready"], &saw["pins"]), (&json!(true), &json!(1)), "{saw}");
        assert_eq!((&saw["marks"]["picked"], &saw["marks"]["shown"]), (&saw["state"]["picked"], &json!(true)), "{saw}");
        assert_eq!((&saw["marks"]["list"], &saw["marks"]["drawing"]), (&json!(1), &json!(1)), "{saw}");
        assert_eq!(saw["spot"]["hidden"], json!(false), "{saw}");
    }
    // The next run takes the page away.
    put("crossed.toml", &text.replace("[[stage]]\nuse = \"drape\"\n", ""));
    assert_eq!(run(&pipeline, &out, &[]), Some(0));
    assert!(!page.exists());
}

/// A square of cloth that hangs from two corners and swings, in two colourways.
#[test]
fn the_page_changes_colours_and_plays_the_motion() {
    let Some(program) = program() else { return };
    let folder = tempfile::tempdir().expect("folder");
    let (out, pipeline) = (folder.path().join("out"), folder.path().join("swing.toml"));
    let put = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("file");
    put("toile.root", "");
    let fabric = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/fabrics/wool-suiting.toml");
    std::fs::copy(fabric, folder.path().join("wool.toml")).expect("fabric");
    put(
        "cloth.obj",
        "v -0.2 1 0\nv 0.2 1 0\nv 0.2 1 0.4\nv -0.2 1 0.4\nv 0 1 0.2\nf 1 5 2\nf 2 5 3\nf 3 5 4\nf 4 5 1\n",
    );
    put("pins.txt", "0\n1\n");
    put(
        "swing.toml",
        "toile = 1\n[pipeline]\nline = \"swing\"\nversion = 1\n[[stage]]\nuse = \"import-mesh\"\nwith.cloth = \"cloth.obj\"\n\
         with.rest = \"positions\"\nwith.fabric = \"wool.toml\"\nwith.pins = \"pins.txt\"\n[[stage]]\nuse = \"drape\"\n\
         with.gravity = \"0 m/s2\"\n[[stage]]\nuse = \"animate\"\nwith.frames = 12\n[[stage]]\nuse = \"texture\"\nwith.color = \"#ffffff\"\n\
         with.colourways = [{ name = \"navy\", color = \"#101a40\" }]\n[[stage]]\nuse = \"export-report\"\n",
    );
    assert_eq!(run(&pipeline, &out, &[]), Some(0));
    let saw = opened(&mut Browser::start(&program, &[]), &out.join("report.html"), [1024, 768]);
    let red = |what: &str| number(&saw, &format!("/{what}/mean/0"));
    assert!(red("navy") < red("sewn") - 40.0, "{saw}");
    let share = |what: &str| number(&saw, &format!("/{what}/share"));
    assert!((share("begin") - share("end")).abs() > 0.01, "{saw}");
    says(&saw, "/end/words", " s");
    // At 30 frames a second: 0, 100 and 150 ms after the start, and at the end, where it waits to be played again.
    assert_eq!((&saw["played"], &saw["waits"]), (&json!([0, 3, 4.5, 11]), &json!(true)), "{saw}");
}

/// The page of a proposal shows the pieces on the body, and makes lines for the sewing file of edges that are clicked.
#[test]
fn the_page_of_a_proposal_shows_the_pieces_on_the_body() {
    let Some(program) = program() else { return };
    let folder = tempfile::tempdir().expect("folder");
    let out = folder.path().join("new");
    let pattern = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/patterns/long-skirt.aama.dxf");
    let mut new = Command::new(env!("CARGO_BIN_EXE_toile"));
    let made = new.arg("new").arg(pattern).args(["--body", "38", "--out"]).arg(&out).output().expect("program");
    assert!(made.status.success(), "{made:?}");
    let (mut browser, page) = (Browser::start(&program, &[]), out.join("start.html"));
    for window in [[1400, 1000], [390, 844]] {
        let saw = checked(&mut browser, &page, window, CHECK_START);
        assert_eq!((&saw["ready"], &saw["pieces"], &saw["nameless"]), (&json!(true), &json!(2), &json!(0)));
        // The body, the pieces on it, and the flat pieces are seen, and threads go from one to the other.
        assert!(number(&saw, "/worn") > number(&saw, "/bare") + 0.01 && number(&saw, "/bare") > 0.05, "{saw}");
        assert!(number(&saw, "/flat") > 0.05, "{saw}");
        // A row of the table marks its seam in the view and in both drawings.
        assert_eq!((&saw["row"]["name"], &saw["row"]["marked"]), (&json!("seam:0"), &json!(2)));
        assert_ne!(saw["row"]["before"], saw["row"]["after"]);
        says(&saw, "/row/words", "% sure");
        let lines = saw["lines"].as_str().expect("lines");
        assert!(lines.starts_with("[[seam]]\nname = \"my seam\"\na = \"FRONT.0\"\nb = \"BACK.0\"\n"), "{lines}");
    }
    drop(browser);
    let still = checked(&mut Browser::start(&program, &["--disable-3d-apis"]), &page, [1024, 768], CHECK_START);
    assert_eq!((&still["ready"], &still["stills"]), (&json!(false), &json!(3)));
    assert!(still["lines"].as_str().is_some_and(|l| l.starts_with("[[seam]]")), "{still}");
}
