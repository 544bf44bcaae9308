//! `toile fabric test`: what the laboratory's tests on the solver promise to a person and to other programs.

use crate::support;
use serde_json::Value;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use support::bench::{Said, command};

fn sample(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/fabrics").join(name)
}

fn test(arguments: &[&dyn AsRef<std::ffi::OsStr>]) -> Said {
    let all = ["fabric", "test"].map(OsString::from).into_iter();
    command(all.chain(arguments.iter().map(|a| OsString::from(a.as_ref()))).chain(["--quiet".into()]).collect())
}

fn json(said: &Said) -> Value {
    assert_eq!(said.code, 0, "{said:?}");
    serde_json::from_str(&said.out).expect("JSON alone on stdout")
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("no number: {value}"))
}

/// Keys, the picture, and the same bytes again.
#[test]
fn a_drape_is_read_drawn_and_compared_with_the_laboratory() {
    let dir = tempfile::tempdir().expect("folder");
    let svg = dir.path().join("drape.svg");
    let fabric = sample("wool-suiting.toml");
    let run = || {
        let edge: [&dyn AsRef<std::ffi::OsStr>; 4] = [&"cusick", &fabric, &"--edge", &"9 mm"];
        let more: [&dyn AsRef<std::ffi::OsStr>; 6] = [&"--repeats", &"2", &"--lab", &"5 %", &"--json", &"--force"];
        test(&[&edge[..], &more[..], &[&"--svg", &svg]].concat())
    };
    let said = run();
    let facts = json(&said);
    let coefficient = number(&facts["drape_coefficient"]);
    assert!((0.35..0.75).contains(&coefficient), "{coefficient}");
    for key in ["test", "fabric", "standard", "disc_mm", "specimen_mm", "edge_mm", "triangles", "node_count"] {
        assert!(!facts[key].is_null(), "{key}");
    }
    let readings = facts["readings"].as_array().expect("readings");
    assert_eq!(readings.len(), 2);
    let mean = readings.iter().map(|r| number(&r["drape_coefficient"])).sum::<f64>() / 2.0;
    assert!((mean - coefficient).abs() < 1e-5);
    for r in readings {
        assert_eq!(r["outline_radius_mm"].as_array().map(Vec::len), Some(360));
        assert_eq!(r["node_angles_deg"].as_array().map(Vec::len), r["node_count"].as_u64().map(|n| n as usize));
        assert!(number(&r["radius_min_mm"]) >= 90.0 && number(&r["radius_max_mm"]) <= 150.0);
        assert!(number(&r["hem_drop_max_mm"]) < 61.0);
        // The shadow's area is that of the coefficient.
        let area = std::f64::consts::PI * (8100.0 + number(&r["drape_coefficient"]) * (22500.0 - 8100.0));
        assert!((number(&r["shadow_area_cm2"]) / (1e-2 * area) - 1.0).abs() < 1e-4);
    }
    assert_eq!(facts["findings"][0]["code"], "drape-differs-from-lab");
    let drawing = std::fs::read(&svg).expect("picture");
    let text = String::from_utf8(drawing.clone()).expect("text");
    for class in ["shadow", "disc", "specimen", "node"] {
        assert!(text.contains(&format!("class=\"{class}\"")), "{class}");
    }
    assert!(run().out == said.out && std::fs::read(&svg).expect("picture") == drawing, "the same bytes again");
}

#[test]
fn strips_stand_beside_the_numbers_of_the_file() {
    let dir = tempfile::tempdir().expect("folder");
    let svg = dir.path().join("strips.svg");
    let text = std::fs::read_to_string(sample("denim-11oz.toml")).expect("a sample");
    let smooth = dir.path().join("denim.toml");
    let lines = text.lines().filter(|l| !l.starts_with("bending_hysteresis"));
    std::fs::write(&smooth, lines.collect::<Vec<_>>().join("\n")).expect("written");
    let read = |fabric: &Path, svg: &Path| {
        json(&test(&[&"cantilever", &fabric, &"--edge", &"3 mm", &"--json", &"--svg", &svg]))
    };
    let facts = read(&smooth, &svg);
    let strips = facts["strips"].as_array().expect("strips");
    let words: Vec<&str> = strips.iter().filter_map(|s| s["direction"].as_str()).collect();
    assert_eq!(words, ["warp", "weft", "bias"]);
    for s in strips {
        let (shown, said) = (number(&s["bending_length_mm"]), number(&s["file_bending_length_mm"]));
        assert!((shown / said - 1.0).abs() < 0.02, "{s}");
        assert!((number(&s["overhang_mm"]) / shown - 2.0).abs() < 1e-4);
    }
    assert_eq!(strips[2]["file_rigidity_estimated"], true);
    // Friction of the yarns (2HB) stiffens a strip, in the laboratory too.
    let rubbing = read(&sample("denim-11oz.toml"), &dir.path().join("rubbing.svg"));
    for s in rubbing["strips"].as_array().expect("strips") {
        let more = number(&s["bending_length_mm"]) / number(&s["file_bending_length_mm"]);
        assert!((1.1..1.4).contains(&more), "{s}");
    }
    let text = std::fs::read_to_string(&svg).expect("picture");
    assert!(words.iter().all(|w| text.contains(&format!("class=\"{w}\""))));
    let one = test(&[&"cantilever", &sample("denim-11oz.toml"), &"--direction", &"weft"]);
    assert!(one.code == 0 && one.out.contains("\n  weft ") && !one.out.contains("\n  warp "), "{one:?}");
}

#[test]
fn shear_is_read_from_bias_strip_and_frame() {
    let fabric = sample("linen-plain.toml");
    let bias = json(&test(&[&"bias", &fabric, &"--edge", &"8 mm", &"--extension", &"4 %", &"--json"]));
    let (eb5, fast) = (number(&bias["eb5"]), number(&bias["shear_fast_N_per_m_rad"]));
    assert!((fast * 100.0 * eb5 / 122.6 - 1.0).abs() < 1e-3, "G = 123/EB5");
    assert!((1.1..1.7).contains(&(fast / 35.0)), "clamps make a short strip look stiffer: {fast}");
    let last = bias["readings"].as_array().and_then(|r| r.last()).expect("readings");
    assert!(number(&last["extension"]) == 0.04 && number(&last["shear_angle_deg"]) > 5.0, "{last}");
    let frame = json(&test(&[&"picture-frame", &fabric, &"--edge", &"8 mm", &"--angle", &"30 deg", &"--json"]));
    let last = frame["readings"].as_array().and_then(|r| r.last()).expect("readings");
    let expected = 35.0 * 30.0_f64.to_radians();
    assert!((number(&last["shear_stress_N_per_m"]) / expected - 1.0).abs() < 0.02, "{last}");
}

#[test]
fn what_cannot_be_tested_is_refused_in_words() {
    let dir = tempfile::tempdir().expect("folder");
    let fabric = sample("cotton-shirting.toml");
    let refused = |arguments: &[&dyn AsRef<std::ffi::OsStr>], code: u8, words: &str| {
        let said = test(arguments);
        assert_eq!((said.code, said.out.as_str()), (code, ""), "{said:?}");
        assert!(said.err.contains(words), "{words} in {}", said.err);
    };
    refused(&[&"cusick", &dir.path().join("none.toml")], 3, "error[file-missing]");
    refused(&[&"cusick", &fabric, &"--edge", &"4"], 2, "a length needs a unit");
    refused(&[&"cusick", &fabric, &"--edge", &"0.1 mm"], 2, "allowed is 1.5 mm to 12 mm");
    refused(&[&"cusick", &fabric, &"--specimen", &"25 cm"], 2, "24 cm");
    refused(&[&"cantilever", &fabric, &"--direction", &"diagonal"], 2, "warp, weft, bias");
    refused(&[&"cantilever", &fabric, &"--edge", &"30 mm"], 2, "error[setting-out-of-range]");
    refused(&[&"bias", &fabric, &"--extension", &"90 %"], 2, "0.5 % to 30 %");
    refused(&[&"picture-frame", &fabric, &"--angle", &"80 deg"], 2, "60 deg");
    refused(&[&"picture-frame", &fabric, &"--angle", &"100 deg"], 2, "allowed is 0.573 deg to 60 deg");
    refused(&[&"cusick", &fabric, &"--lab", &"600 %"], 2, "0 % to 100 %");
    let wrong = dir.path().join("wrong.toml");
    let text = std::fs::read_to_string(&fabric).expect("fabric");
    std::fs::write(&wrong, text.replace("\"0.28 mm\"", "0.28")).expect("file");
    refused(&[&"bias", &wrong], 3, "| thickness = 0.28");
    std::fs::write(&wrong, text.replace("\"8 uN.m\"", "\"0 uN.m\"")).expect("file");
    refused(&[&"cusick", &wrong], 3, "error[fabric-without-bending]");
    std::fs::write(&wrong, b"\xff").expect("file");
    refused(&[&"cusick", &wrong], 3, "error[text-not-utf8]");
    refused(&[&"cusick", &fabric, &"--svg", &wrong], 2, "--force");
}

/// Cloth that curls keeps more of its shadow where its hollow side lies upwards.
#[test]
fn cloth_that_curls_drapes_differently_with_its_wrong_side_upwards() {
    let dir = tempfile::tempdir().expect("folder");
    let text = std::fs::read_to_string(sample("cotton-shirting.toml")).expect("a sample");
    let curled = dir.path().join("curled.toml");
    let curls = "rest_curvature_warp = \"15 1/m\"\nrest_curvature_weft = \"15 1/m\"\nareal_mass";
    std::fs::write(&curled, text.replacen("areal_mass", curls, 1)).expect("written");
    let read = |more: &[&dyn AsRef<std::ffi::OsStr>]| {
        let all: [&dyn AsRef<std::ffi::OsStr>; 7] =
            [&"cusick", &curled, &"--edge", &"12 mm", &"--repeats", &"1", &"--json"];
        number(&json(&test(&[&all, more].concat()))["drape_coefficient"])
    };
    let (right, wrong) = (read(&[]), read(&[&"--wrong-side"]));
    assert!(right > wrong + 0.05, "{right} and {wrong}");
}

/// Of a cloth whose faces drape differently, one number predicts the first face, and a curl also the second.
#[test]
fn measured_drapes_are_predicted() {
    let dir = tempfile::tempdir().expect("folder");
    let table = dir.path().join("drapes.csv");
    let captures = "fabric,face,dc_percent,rim_z_mean_mm,areal_mass_gsm,comment\n\
                    denim,right,77,-31,200,a\ndenim,right,78,-30,,b\ndenim,right,74,-33,,c\n\
                    denim,wrong,62,-40,,d\ndenim,wrong,60,-41,,e\ndenim,wrong,65,-38,,f\n";
    std::fs::write(&table, captures).expect("written");
    let out = dir.path().join("out");
    let all: [&dyn AsRef<std::ffi::OsStr>; 9] =
        [&"validate", &"drape", &table, &"--edge", &"12 mm", &"--falls", &"2", &"--json", &"--out"];
    let run = || command(all.iter().copied().chain([&out as _]).map(OsString::from).collect());
    let said = run();
    assert!(said.err.contains("`comment` is not used"), "{said:?}");
    let facts = json(&said);
    let rows = facts["rows"].as_array().expect("rows");
    let laws: Vec<&str> = rows.iter().filter_map(|r| r["law"].as_str()).collect();
    assert_eq!(laws, ["elastic", "hysteresis", "rest-curvature"].repeat(2));
    let [elastic, curled] = [&rows[3], &rows[5]];
    let off = |row: &Value| {
        let mean = |side: &str| number(&row[side]["coefficient"]["mean"]);
        (mean("simulated") - mean("captured")).abs()
    };
    assert!(off(elastic) > 6.0 && off(curled) < 4.0, "{} and {}", off(elastic), off(curled));
    assert!(number(&rows[2]["rest_curvature_per_m"]) > 1.0, "hollow on the face that keeps more of its shadow");
    assert_eq!(number(&rows[2]["rest_curvature_per_m"]), -number(&curled["rest_curvature_per_m"]));
    for name in ["validate.json", "validate.svg", "validate.md"] {
        assert!(out.join(name).is_file(), "{name}");
    }
    // What is there is replaced only where that is asked for.
    let again = run();
    assert!(again.code == 2 && again.err.contains("replace it with --force"), "{again:?}");
    // A table that cannot be read is refused with the line, and nothing is simulated.
    std::fs::write(&table, captures.replace(",62,", ",162,")).expect("written");
    let refused = run();
    assert!(refused.code == 3 && refused.err.contains("drapes.csv:5"), "{refused:?}");
}
