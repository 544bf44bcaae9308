//! A garment for another body: the ease is as asked, and the written pattern is sewn again.

use crate::support;
use serde_json::Value;
use std::ffi::OsString;
use std::path::Path;
use support::bench::{Bench, Said, command};
use toile_formats::dxf::{self, ReadOptions};

/// Fits the long skirt into a folder of the bench. On a much coarser mesh the girths themselves differ from mesh to mesh.
fn fit(bench: &Bench, folder: &str, options: &[&str]) -> Said {
    let skirt = Path::new(env!("CARGO_MANIFEST_DIR")).join("pipelines/long-skirt/v1.toml");
    let mut words: Vec<OsString> = vec!["fit".into(), skirt.into()];
    words.extend(["--quiet", "--out"].map(OsString::from));
    words.push(bench.path(folder).into());
    words.extend(options.iter().map(OsString::from));
    command(words)
}

fn ease(result: &Value, name: &str, key: &str) -> f64 {
    let levels = result["ease"].as_array().expect("levels");
    levels.iter().find(|l| l["name"] == name).expect("level")[key].as_f64().expect("number")
}

#[test]
fn a_skirt_keeps_its_ease_or_gets_the_one_that_is_asked_for() {
    let bench = Bench::new();
    let said = fit(&bench, "fitted", &["--body", "40", "--ease", "waist=22 mm", "--json", "--language", "zh"]);
    assert_eq!(said.code, 0, "{said:?}");
    let result: Value = serde_json::from_str(&said.out).expect("JSON");
    // The waist of size 40 is 740 mm; it is taken 4 mm under the edge of the skirt.
    let waist = ease(&result, "waist", "body_mm");
    assert!(ease(&result, "waist", "asked_mm") == 22.0 && (waist - 740.0).abs() < 3.0, "{waist}");
    for name in ["waist", "hip"] {
        let [asked, got] = ["asked_mm", "ease_mm"].map(|key| ease(&result, name, key));
        assert!((asked - got).abs() <= 5.0, "{name}: {got} instead of {asked}");
    }
    assert!((ease(&result, "hip", "asked_mm") - ease(&result, "hip", "own_ease_mm")).abs() < 1e-9);
    // Both pieces together grow by the 40 mm of the body and by what the ease changes. At the hip the girth hardly changes
    // with the height, so that a little more or less of it does not matter.
    let changes = result["changes"].as_array().expect("changes");
    let hips = changes.iter().filter(|c| c["what"] == "width at the hip");
    let grown: f64 = hips.filter_map(|c| Some(c["mm"][1].as_f64()? - c["mm"][0].as_f64()?)).sum();
    let wanted = 40.0 + ease(&result, "hip", "ease_mm") - ease(&result, "hip", "own_ease_mm");
    assert!((grown - wanted).abs() < 4.0, "{grown} instead of {wanted}");
    // The folder runs by itself, and to the same bytes.
    let pipeline = bench.path("fitted/pipeline.toml");
    let words = ["run".into(), pipeline.into(), "--quiet".into(), "--out".into()];
    let again = command(words.into_iter().chain([bench.path("again").into()]).collect());
    assert_eq!(again.code, 0, "{again:?}");
    let glb = |folder: &str| std::fs::read(bench.path(folder).join("long-skirt.glb")).expect("GLB");
    assert!(glb("fitted/run") == glb("again"));
    // The page speaks Chinese, names and all.
    let page = std::fs::read_to_string(bench.path("fitted/fit.html")).expect("page");
    for words in ["lang=\"zh-Hans\"", "<h2>松量</h2>", "腰围处的宽度", "下摆离地高度", "新纸样的悬垂通过检验。"]
    {
        assert!(page.contains(words), "{words}");
    }
    assert!(!page.contains("Hem above") && !page.contains("width at"));
    the_change_is_in_all_sizes(&bench, &result);
}

/// Every size of the pattern grows by what it did before, and the one that was fitted is the pattern of the result.
fn the_change_is_in_all_sizes(bench: &Bench, result: &Value) {
    let told = result["findings"].as_array().expect("findings").iter().find(|f| f["code"] == "sizes-carried");
    assert!(told.is_some_and(|f| f["message"].as_str().is_some_and(|m| m.contains("36, 38, 40"))), "{told:?}");
    let all = std::fs::read(bench.path("fitted/all-sizes.dxf")).expect("all sizes");
    let rules = std::fs::read(bench.path("fitted/all-sizes.rul")).expect("rules");
    let rules = toile_formats::rul::read(&rules, "all-sizes.rul").expect("rules");
    assert_eq!((rules.sizes.len(), rules.sample.as_deref()), (3, Some("38")));
    let old = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/patterns/long-skirt.astm.dxf");
    let old = std::fs::read(old).expect("pattern");
    let fitted = std::fs::read(bench.path("fitted/pattern.dxf")).expect("pattern");
    // Widths of the pieces, millimetres.
    let widths = |bytes: &[u8], size: Option<&str>| -> Vec<f64> {
        let pattern = dxf::read(bytes, "pattern.dxf", &ReadOptions::default()).expect("pattern");
        let (garment, _) = pattern.to_garment(size, None).expect("size");
        let width = |p: &toile_garment::Piece| {
            let x: Vec<f64> = p.outline.points.iter().map(|p| 1e3 * p.at.x).collect();
            x.iter().copied().fold(f64::MIN, f64::max) - x.iter().copied().fold(f64::MAX, f64::min)
        };
        garment.pieces.iter().map(width).collect()
    };
    let near = |a: &[f64], b: &[f64]| a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 0.01);
    assert!(near(&widths(&all, Some("38")), &widths(&fitted, None)));
    let growth = |bytes: &[u8], size: &str| -> Vec<f64> {
        let [base, other] = ["38", size].map(|s| widths(bytes, Some(s)));
        other.iter().zip(&base).map(|(o, b)| o - b).collect()
    };
    for size in ["36", "40"] {
        let [before, after] = [&old, &all].map(|bytes| growth(bytes, size));
        assert!(near(&before, &after) && before.iter().all(|g| g.abs() > 1.0), "{size}: {before:?} {after:?}");
    }
}

#[test]
fn what_cannot_be_fitted_is_told() {
    let bench = Bench::new();
    let said = fit(&bench, "fitted", &["--body", "40", "--ease", "bust=30 mm"]);
    assert_eq!(said.code, 2, "{said:?}");
    assert!(said.err.contains("fit-no-measure") && said.err.contains("waist, hip"), "{said:?}");
    let said = fit(&bench, "other", &["--body", "41"]);
    assert!(said.code != 0 && said.err.contains("size-not-found"), "{said:?}");
    std::fs::create_dir_all(bench.path("taken")).expect("folder");
    std::fs::write(bench.path("taken/letter.txt"), "mine").expect("file");
    let said = fit(&bench, "taken", &["--body", "40", "--force"]);
    assert_eq!(said.code, 2, "{said:?}");
    assert!(said.err.contains("path-refused") && bench.path("taken/letter.txt").is_file(), "{said:?}");
}
