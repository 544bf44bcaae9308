//! `inspect`, `plan`, `flatten` and `body` on files as a person has them.

use crate::support;
use serde_json::Value;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use support::bench::{Bench, Said, command};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn sample(name: &str) -> PathBuf {
    root().join("samples").join(name)
}

fn toile(arguments: &[&dyn AsRef<std::ffi::OsStr>]) -> Said {
    command(arguments.iter().map(|a| OsString::from(a.as_ref())).collect())
}

fn json(said: &Said) -> Value {
    assert_eq!(said.code, 0, "{said:?}");
    serde_json::from_str(&said.out).expect("JSON")
}

/// The keys other programs rely on.
#[test]
fn inspects_a_pattern_with_all_promised_keys() {
    let facts = json(&toile(&[&"inspect", &sample("patterns/long-skirt.astm.dxf"), &"--json"]));
    for key in ["units", "mm_per_unit", "style_name", "sizes", "sample_size", "ledger", "findings", "pieces"] {
        assert!(!facts[key].is_null(), "{key}");
    }
    let piece = facts["pieces"].as_array().expect("pieces").first().expect("one").clone();
    let keys = "block name size quantity area_cm2 area_unfolded_cm2 perimeter_mm bbox_mm boundary_vertices \
        half_piece_on_fold net_area_cm2 net_perimeter_mm darts notches notch_count drill_count internal_line_count \
        cutout_count grain_line_mm turn_point_count curve_point_count edges";
    for key in keys.split_whitespace() {
        assert!(!piece[key].is_null(), "{key}");
    }
    for key in ["kind", "apex_mm", "mouth_mm", "leg_chord_mm", "leg_path_mm", "width_mm"] {
        assert!(!piece["darts"][0][key].is_null(), "dart {key}");
    }
    for key in ["index", "from_mm", "to_mm", "length_mm"] {
        assert!(!piece["edges"][0][key].is_null(), "edge {key}");
    }
    let perimeter: f64 = piece["edges"].as_array().into_iter().flatten().filter_map(|e| e["length_mm"].as_f64()).sum();
    let net = piece["net_perimeter_mm"].as_f64().expect("net perimeter");
    // Edges follow the smooth curve through the curve points, the perimeter its chords.
    assert!((0.0..1e-4 * net).contains(&(perimeter - net)), "edges {perimeter} mm, chords {net} mm");
}

/// The same table in the other dialect: a pattern is not its spelling.
#[test]
fn both_dialects_hold_the_same_pieces() {
    let pieces = |dialect: &str| {
        let file = sample(&format!("patterns/long-skirt.{dialect}.dxf"));
        let facts = json(&toile(&[&"inspect", &file, &"--json"]));
        let list = facts["pieces"].as_array().cloned().unwrap_or_default();
        let area = |p: &Value| (p["net_area_cm2"].as_f64().unwrap_or(0.0) * 100.0).round();
        list.iter().map(|p| (p["name"].clone(), p["size"].clone(), area(p) as i64)).collect::<Vec<_>>()
    };
    assert_eq!(pieces("aama"), pieces("astm"));
}

#[test]
fn draws_the_sample_size_with_numbered_edges() {
    let dir = tempfile::tempdir().expect("folder");
    let drawing = dir.path().join("skirt.svg");
    let file = sample("patterns/long-skirt.astm.dxf");
    assert_eq!(toile(&[&"inspect", &file, &"--svg", &drawing]).code, 0);
    let svg = std::fs::read_to_string(&drawing).expect("SVG");
    assert!(svg.starts_with("<svg") || svg.starts_with("<?xml"), "{}", &svg[..40]);
    assert_eq!(svg.matches(">FRONT").count(), 1, "one size only");
    let again = toile(&[&"inspect", &file, &"--svg", &drawing]);
    assert_eq!(again.code, 2, "nothing is replaced without --force");
    assert_eq!(toile(&[&"inspect", &file, &"--svg", &drawing, &"--force"]).code, 0);
    let mesh = toile(&[&"inspect", &sample("bodies/size-38.obj"), &"--svg", &drawing, &"--force"]);
    assert_eq!(mesh.code, 2, "a mesh has no pieces to draw");
}

/// A pattern in size 36 of pieces with these corners, as DXF.
fn pattern(pieces: &[(&str, [[f64; 2]; 4])]) -> String {
    let mut text = "0\nSECTION\n2\nBLOCKS\n".to_owned();
    for (name, corners) in pieces {
        text += &format!("0\nBLOCK\n8\n0\n2\n{name}\n");
        for line in [format!("Piece Name: {name}"), "Size: 36".to_owned()] {
            text += &format!("0\nTEXT\n8\n1\n10\n50\n20\n50\n40\n2\n1\n{line}\n");
        }
        text += "0\nPOLYLINE\n8\n1\n66\n1\n70\n1\n";
        for [x, y] in corners {
            text += &format!("0\nVERTEX\n8\n1\n10\n{x}\n20\n{y}\n");
        }
        text += "0\nSEQEND\n0\nENDBLK\n";
    }
    text + "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nTEXT\n8\n1\n10\n0\n20\n0\n40\n2\n1\nUnits: METRIC\n0\nENDSEC\n0\nEOF\n"
}

/// A piece that cannot be used does not hide the edges of the others.
#[test]
fn edges_of_good_pieces_are_listed_beside_a_bad_one() {
    let dir = tempfile::tempdir().expect("folder");
    let file = dir.path().join("pattern.dxf");
    let good = [[0.0, 0.0], [300.0, 0.0], [300.0, 400.0], [0.0, 400.0]];
    let bow = [[0.0, 0.0], [300.0, 400.0], [300.0, 0.0], [0.0, 400.0]];
    std::fs::write(&file, pattern(&[("A", good), ("B", bow)])).expect("pattern");
    let said = toile(&[&"inspect", &file]);
    assert!(said.code == 0 && said.out.contains("\nA.0 ") && !said.out.contains("\nB.0 "), "{said:?}");
    assert!(said.out.contains("cannot be used: outline-crosses-itself"), "{said:?}");
    assert_eq!(json(&toile(&[&"inspect", &file, &"--json"]))["edges"].as_array().map(Vec::len), Some(4));
}

/// A piece that no stage takes is told, and a file whose name breaks the line is shown in one.
#[test]
fn a_piece_out_of_reach_and_a_name_of_two_lines() {
    let dir = tempfile::tempdir().expect("folder");
    let file = dir.path().join("two\nlines.dxf");
    let good = [[0.0, 0.0], [300.0, 0.0], [300.0, 400.0], [0.0, 400.0]];
    let far = good.map(|[x, y]| [x + 1e7, y]);
    std::fs::write(&file, pattern(&[("A", good), ("B", far)])).expect("pattern");
    let said = toile(&[&"inspect", &file]);
    assert!(said.err.contains("error[coordinate-out-of-range] piece `B`"), "{said:?}");
    assert!(said.out.contains("\nA.0 ") && !said.out.contains("\nB.0 "), "{said:?}");
    assert!(said.out.contains("two\\nlines.dxf"), "{said:?}");
}

/// The rule table beside a pattern is found whatever the case of its name.
#[test]
fn the_rule_table_beside_a_pattern_counts() {
    let dir = tempfile::tempdir().expect("folder");
    let good = std::fs::read(root().join("tests/bad/size-not-found/pattern.dxf")).expect("pattern");
    let bad = std::fs::read(root().join("tests/bad/rule-table/pattern.rul")).expect("table");
    let file = dir.path().join("pattern.dxf");
    std::fs::write(&file, good).expect("pattern");
    assert_eq!(toile(&[&"inspect", &file]).code, 0);
    std::fs::write(dir.path().join("Pattern.RUL"), &bad).expect("table");
    // A broken table is told, and the pieces are shown all the same.
    let said = toile(&[&"inspect", &file]);
    let all = format!("{}{}", said.out, said.err);
    assert_eq!(said.code, 0, "{said:?}");
    for code in ["rule-table-broken", "rule-bad-number", "rule-count-differs"] {
        assert!(all.contains(&format!("warning[{code}]")), "{code}: {all}");
    }
    assert!(said.out.contains("style BAD"), "{said:?}");
    let alone = toile(&[&"inspect", &dir.path().join("Pattern.RUL")]);
    assert_eq!((alone.code, alone.out.as_str()), (3, ""));
    let errors = ["error[rule-bad-number]", "error[rule-count-differs]"];
    assert!(errors.iter().all(|e| alone.err.contains(e)), "{alone:?}");
}

#[test]
fn inspects_meshes() {
    let facts = json(&toile(&[&"inspect", &sample("bodies/size-38.obj"), &"--json"]));
    assert_eq!(facts["vertices"].as_u64().map(|v| v * 2 - 4), facts["triangles"].as_u64(), "a closed surface");
    let height = facts["size_m"][1].as_f64().expect("height");
    assert!((height - 1.68).abs() < 0.01, "{height} m");
    for (name, bytes, code) in [("a.glb", &b"glTF\x02\0\0\0"[..], "glb-damaged"), ("a.obj", b"v 0 0 x\n", "obj-number")]
    {
        let dir = tempfile::tempdir().expect("folder");
        let file = dir.path().join(name);
        std::fs::write(&file, bytes).expect("file");
        let said = toile(&[&"inspect", &file, &"--json"]);
        assert_eq!((said.code, said.out.as_str()), (3, ""));
        assert!(said.err.starts_with(&format!("error[{code}]")), "{}", said.err);
    }
}

/// A body made by the command is the sample of the same size, byte by byte.
#[test]
fn makes_bodies_from_measures() {
    let dir = tempfile::tempdir().expect("folder");
    let out = dir.path().join("size-38.obj");
    assert_eq!(toile(&[&"body", &"--size", &"38", &"--out", &out]).code, 0);
    for ending in ["obj", "toml"] {
        let made = std::fs::read(out.with_extension(ending)).expect("made");
        assert!(made == std::fs::read(sample(&format!("bodies/size-38.{ending}"))).expect("sample"), "{ending}");
    }
    assert_eq!(toile(&[&"body", &"--size", &"38", &"--out", &out]).code, 2, "nothing is replaced without --force");
    let list = toile(&[&"body"]);
    let row = |size: &str| list.out.lines().rfind(|l| l.starts_with(size)).unwrap_or_default();
    let cells: Vec<&str> = row("women-38").split_whitespace().collect();
    assert_eq!(cells[1..], ["880", "761", "700", "960", "360", "280", "160", "550"], "{}", list.out);
    assert!(row("men-50").contains("1000") && row("child-104").contains("560"), "{}", list.out);
    assert!(list.out.contains("waist_girth"), "{}", list.out);
}

#[test]
fn impossible_bodies_are_refused_in_words() {
    let dir = tempfile::tempdir().expect("folder");
    let out = dir.path().join("b.obj");
    let said = toile(&[&"body", &"--size", &"99", &"--set", &"wast=1 mm", &"--set", &"bust_girth=3", &"--out", &out]);
    assert_eq!(said.code, 2);
    for code in ["size-not-found", "unknown-measure", "wrong-value"] {
        assert!(said.err.contains(&format!("error[{code}]")), "{code} in {}", said.err);
    }
    let said = toile(&[&"body", &"--set", &"waist_girth=2 m", &"--out", &out]);
    assert!(said.code == 2 && said.err.contains("error[body-measure-out-of-range]"), "{said:?}");
    assert!(std::fs::read_dir(dir.path()).expect("folder").next().is_none(), "nothing is left");
}

/// A GLB alone gives the same flat pieces as the garment document it was made of.
#[test]
fn flattens_from_the_glb_alone() {
    let bench = Bench::new();
    bench.stages(
        "[[stage]]\nuse = \"test-sheet\"\nwith.side = \"1 m\"\n[[stage]]\nuse = \"test-drape\"\n\
         [[stage]]\nuse = \"test-write\"\nwith = { file = \"{out}/g.json\", document = true }\n",
    );
    bench.run(&[]);
    let document = bench.out().join("g.json");
    let text = std::fs::read_to_string(&document).expect("document");
    let garment = toile_garment::bundle::from_text(&text).expect("garment");
    let glb = bench.path("g.glb");
    let bytes = toile_formats::gltf::write_garment(&garment).expect("GLB");
    std::fs::write(&glb, &bytes).expect("GLB");
    let mut results = Vec::new();
    let left = bench.path(".4711-0.tmp-toile");
    std::fs::write(&left, "of a process that was killed").expect("file");
    for (garment, name) in [(&document, "a.json"), (&glb, "b.json")] {
        let said = toile(&[&"flatten", garment, &"--json", &bench.path(name)]);
        assert_eq!(said.code, 0, "{said:?}");
        assert!(said.out.starts_with("front "), "{}", said.out);
        results.push(std::fs::read(bench.path(name)).expect("flat"));
    }
    assert!(results[0] == results[1] && !left.exists());
    let result: Value = serde_json::from_slice(&results[1]).expect("JSON");
    let piece = &result["pieces"][0];
    for key in ["flat_vertices_mm", "orig_vertices_mm", "surface_vertices_mm", "triangles", "features"] {
        assert!(!piece[key].is_null(), "{key}");
    }
    let inspected = json(&toile(&[&"inspect", &glb, &"--json"]));
    assert_eq!((&inspected["triangles"], &inspected["toile"]["pieces"][0]), (&2.into(), &"front".into()));
    std::fs::write(&glb, &bytes[..bytes.len() - 9]).expect("cut");
    let said = toile(&[&"flatten", &glb]);
    assert_eq!((said.code, said.out.as_str()), (3, ""));
    assert!(said.err.starts_with("error[glb-damaged]"), "{}", said.err);
}

/// A GLB whose document an editor left out is read by that of the original, and a saved garment has a picture.
#[test]
fn a_glb_without_its_document_is_flattened_by_the_original_and_drawn() {
    let bench = Bench::new();
    bench.stages(
        "[[stage]]\nuse = \"test-sheet\"\nwith.side = \"1 m\"\n[[stage]]\nuse = \"test-drape\"\n\
         [[stage]]\nuse = \"test-write\"\nwith = { file = \"{out}/g.json\", document = true }\n",
    );
    bench.run(&[]);
    let document = bench.out().join("g.json");
    let text = std::fs::read_to_string(&document).expect("document");
    let garment = toile_garment::bundle::from_text(&text).expect("garment");
    let (original, saved) = (bench.path("g.glb"), bench.path("saved.glb"));
    std::fs::write(&original, toile_formats::gltf::write_garment(&garment).expect("GLB")).expect("file");
    let nothing = toile_formats::gltf::Wishes { document: toile_formats::gltf::Carried::Nothing, ..Default::default() };
    let bare = toile_formats::gltf::write_garment_with(&garment, &nothing).expect("GLB");
    std::fs::write(&saved, bare).expect("file");
    let said = toile(&[&"flatten", &saved]);
    assert!(said.code == 3 && said.err.contains("--document ORIGINAL.glb"), "{said:?}");
    for given in [&original, &document] {
        let said = toile(&[&"flatten", &saved, &"--document", given]);
        assert!(said.code == 0 && said.out.starts_with("front "), "{said:?}");
    }
    let said = toile(&[&"flatten", &original, &"--lock", &"dart"]);
    assert!(said.code == 2 && said.err.contains("did you mean `darts`?"), "{said:?}");
    let garment = "[[stage]]\nuse = \"import-garment\"\nwith = { file = \"saved.glb\", document = \"g.glb\" }\n";
    let shown = "[[stage]]\nuse = \"export-picture\"\n[[stage]]\nuse = \"export-obj\"\n";
    let second = Bench::new();
    for file in ["saved.glb", "g.glb"] {
        let beside = second.path(&format!("pipelines/test/{file}"));
        std::fs::copy(bench.path(file), beside).expect("copied");
    }
    second.stages(&[garment, shown].concat());
    let said = second.run(&[]);
    assert!(said.code == 0 && second.out().join("picture.png").exists(), "{said:?}");
    // What is there was at rest, so nothing can be draped from it.
    second.stages(&[garment, "[[stage]]\nuse = \"drape\"\n"].concat());
    assert!(second.check(&[]).err.contains("`drape` needs stitched"));
}

/// Stretches all places of a GLB upwards in its binary chunk, as an editor does.
fn stretch_upwards(glb: &mut [u8], factor: f32) {
    let word = |bytes: &[u8], at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().expect("4")) as usize;
    let binary = 20 + word(glb, 12) + 8;
    let document: Value = serde_json::from_slice(&glb[20..binary - 8]).expect("JSON");
    let number = |v: &Value| v.as_u64().unwrap_or(0) as usize;
    let mut places = std::collections::BTreeSet::new();
    for mesh in document["meshes"].as_array().expect("meshes") {
        let parts = mesh["primitives"].as_array().expect("parts");
        places.extend(parts.iter().map(|part| number(&part["attributes"]["POSITION"])));
    }
    for accessor in places.into_iter().map(|i| &document["accessors"][i]) {
        let view = &document["bufferViews"][number(&accessor["bufferView"])];
        let first = binary + number(&view["byteOffset"]) + number(&accessor["byteOffset"]);
        let stride = number(&view["byteStride"]).max(12);
        for y in (0..number(&accessor["count"])).map(|i| first + i * stride + 4) {
            let height = f32::from_le_bytes(glb[y..y + 4].try_into().expect("4"));
            glb[y..y + 4].copy_from_slice(&(height * factor).to_le_bytes());
        }
    }
}

/// A bodice with upright darts at the waist. Its cloth is nearly upright, so it grows by nearly as much as it is
/// stretched, and its flat pieces cover as much as the stretched surface.
#[test]
fn a_bodice_that_is_stretched_upwards_is_flattened_as_stretched() {
    let dir = tempfile::tempdir().expect("folder");
    let pipeline = root().join("pipelines/fitted-bodice/v1.toml");
    let out = dir.path().join("out");
    let said = toile(&[&"run", &pipeline, &"--out", &out, &"--set", &"triangulate.edge_length=24 mm", &"--quiet"]);
    assert_eq!(said.code, 0, "{said:?}");
    let glb = out.join("fitted-bodice.glb");
    let mut bytes = std::fs::read(&glb).expect("GLB");
    stretch_upwards(&mut bytes, 1.05);
    std::fs::write(&glb, bytes).expect("GLB");
    let flat = dir.path().join("flat.json");
    let said = toile(&[&"flatten", &glb, &"--json", &flat]);
    assert_eq!(said.code, 0, "{said:?}");
    let flat: Value = serde_json::from_slice(&std::fs::read(flat).expect("flat")).expect("JSON");
    assert_eq!(flat["metric"], "carried");
    for piece in flat["pieces"].as_array().expect("pieces") {
        let area = |key: &str| piece["figures"]["area"][key].as_f64().expect(key);
        assert!((3.0..5.0).contains(&area("flat_vs_original_pct")), "{}", piece["figures"]["area"]);
        assert!(area("flat_vs_surface_pct").abs() < 0.2, "{}", piece["figures"]["area"]);
    }
}

/// Mesh, effects, seconds and memory from the files alone.
#[test]
fn a_plan_foresees_mesh_effects_and_cost() {
    let file = root().join("pipelines/long-skirt/v1.toml");
    let plan = |more: &[&str]| {
        let mut arguments: Vec<OsString> = vec!["plan".into(), file.clone().into(), "--json".into()];
        arguments.extend(more.iter().flat_map(|set| ["--set".into(), OsString::from(set)]));
        json(&command(arguments))
    };
    let usual = plan(&[]);
    let effects = usual["effects"].as_array().expect("effects").clone();
    let on: Vec<(&str, bool)> = effects.iter().map(|e| (e["name"].as_str().expect("name"), e["on"] == true)).collect();
    let all = ["self-contact", "body-contact", "friction", "strain-limit", "bending-hysteresis"];
    assert_eq!(on, all.map(|name| (name, true)));
    assert!(effects[1]["evidence"].as_str().is_some_and(|e| e.contains("size-38")), "{}", effects[1]);
    assert!(effects[2]["evidence"].as_str().is_some_and(|e| e.ends_with("0.35")), "{}", effects[2]);
    assert!(effects.iter().all(|e| e["rule"].as_str().is_some_and(|r| !r.is_empty())));

    let expected = |plan: &Value, key: &str| plan["expected"][key].as_f64().unwrap_or_else(|| panic!("{key}"));
    assert_eq!(expected(&usual, "triangles"), 2200.0);
    let edge = expected(&usual, "edge_mm");
    let stages = usual["stages"].as_array().expect("stages");
    assert!(stages.iter().all(|s| s["expected_seconds"].as_f64().is_some_and(|t| t > 0.0)), "{stages:?}");
    let sum: f64 = stages.iter().filter_map(|s| s["expected_seconds"].as_f64()).sum();
    assert!((sum - expected(&usual, "seconds")).abs() < 0.01, "seconds of the stages add up");

    // Half the edge: four times the triangles, by the area of the DXF's pieces.
    let finer = ["triangulate.triangles=8800", "drape.effects.self-contact=off", "drape.effects.friction=off"];
    let finer = plan(&finer);
    assert!((expected(&finer, "edge_mm") / edge - 0.5).abs() < 1e-3, "{edge}");
    // Draping grows with the cloth alone. Sewing counts the triangles of the body too, which stay as they are.
    let seconds = |plan: &Value, stage: &str| {
        let stages = plan["stages"].as_array().expect("stages");
        let found = stages.iter().find(|s| s["use"] == stage).and_then(|s| s["expected_seconds"].as_f64());
        found.unwrap_or_else(|| panic!("{stage}"))
    };
    assert!(seconds(&finer, "drape") > 3.0 * seconds(&usual, "drape"));
    assert!(seconds(&finer, "stitch") > 2.0 * seconds(&usual, "stitch"));
    assert!(expected(&finer, "mb") > expected(&usual, "mb"));
    assert_eq!((&finer["effects"][0]["on"], &finer["effects"][2]["on"]), (&false.into(), &false.into()));
    assert!(finer["effects"][0]["rule"].as_str().is_some_and(|r| r.contains("switched off")));
}

/// Rests from starts that differ by 1 µm are measured where it is asked, and `plan` advises it where nothing holds the
/// cloth.
#[test]
fn repeats_tell_how_far_apart_the_rests_lie() {
    let file = root().join("pipelines/long-skirt/v1.toml");
    let out = tempfile::tempdir().expect("folder");
    let run = |name: &str, more: &[&str]| -> Value {
        let folder = out.path().join(name);
        let mut arguments: Vec<OsString> = vec!["run".into(), file.clone().into(), "--out".into()];
        arguments.extend([folder.clone().into(), "--quiet".into(), "--set".into(), "triangulate.triangles=700".into()]);
        arguments.extend(more.iter().map(OsString::from));
        let said = command(arguments);
        assert_eq!(said.code, 0, "{said:?}");
        let text = std::fs::read_to_string(folder.join("run.json")).expect("record");
        serde_json::from_str::<Value>(&text).expect("JSON")["certificate"].clone()
    };
    let (once, thrice) = (run("once", &[]), run("thrice", &["--repeats", "2"]));
    assert!(once["rests"].is_null() && once["energy_J"] == thrice["energy_J"], "{once} {thrice}");
    let figure = |key: &str| thrice["rests"][key].as_f64().unwrap_or_else(|| panic!("{key}: {thrice}"));
    assert_eq!((figure("repeats"), figure("settled")), (2.0, 2.0));
    let apart = ["apart_median_mm", "apart_p95_mm", "apart_max_mm"].map(figure);
    assert!(apart[0] > 0.0 && apart.is_sorted() && apart[2] < 1e3, "{apart:?}");

    let plan = |line: &str, more: &[&dyn AsRef<std::ffi::OsStr>]| {
        let file = root().join(format!("pipelines/{line}/v1.toml"));
        toile(&[&[&"plan" as &dyn AsRef<std::ffi::OsStr>, &file], more].concat())
    };
    let advised = |said: &Said| said.out.contains("--repeats 4 measures");
    assert!(advised(&plan("t-shirt", &[])) && !advised(&plan("long-skirt", &[])));
    assert!(!advised(&plan("t-shirt", &[&"--repeats", &"4"])));
    let bench = Bench::new();
    bench.stages("[[stage]]\nuse = \"import-dxf\"\nwith.file = \"p.dxf\"\n");
    let said = toile(&[&"check", &bench.pipeline_file(), &"--repeats", &"2"]);
    assert!(said.code != 0 && said.err.contains("repeats-no-stage"), "{said:?}");
}

/// A garment of another importer is foreseen as well: its mesh, and every stage to the end.
#[test]
fn a_plan_foresees_a_garmentcode_garment() {
    let bench = Bench::new();
    for file in ["tests/golden/garmentcode/tube.json", "samples/fabrics/wool-suiting.toml"] {
        let name = file.rsplit('/').next().expect("name");
        std::fs::copy(root().join(file), bench.path("pipelines/test").join(name)).expect("file");
    }
    let stages = [
        "import-garmentcode\"\nwith.file = \"tube.json",
        "triangulate\"\nwith.edge_length = \"8 mm",
        "assemble",
        "stitch\"\nwith.fabric = \"wool-suiting.toml",
        "drape",
        "export-gltf\"\nwith.file = \"{out}/tube.glb",
    ];
    let text: String = stages.iter().map(|s| format!("[[stage]]\nuse = \"{s}\"\n")).collect();
    bench.stages(&text);
    let plan = json(&toile(&[&"plan", &bench.pipeline_file(), &"--json"]));
    assert_eq!(plan["expected"]["stages_not_foreseen"], 0, "{plan}");
    // Two pieces of about 0.6 m² in all, less the dart: an edge of 8 mm makes 36,000 triangles of a square metre.
    let triangles = plan["expected"]["triangles"].as_f64().expect("triangles");
    assert!((20_000.0..23_000.0).contains(&triangles), "{triangles}");
    assert!(plan["expected"]["seconds"].as_f64().is_some_and(|s| s > 1.0), "{plan}");
    assert!(plan["effects"][0]["evidence"].as_str().is_some_and(|e| e.starts_with("2 pieces, about")), "{plan}");
}

/// A file that would end the run ends the plan, with the same exit code.
#[test]
fn a_plan_says_what_is_wrong_with_the_files() {
    let bench = Bench::new();
    std::fs::write(bench.path("pipelines/test/p.dxf"), "0\nSECTION\n2\nENTITIES\n0\nENDSEC\n0\nEOF\n").expect("file");
    bench.stages("[[stage]]\nuse = \"import-dxf\"\nwith.file = \"p.dxf\"\n");
    let said = toile(&[&"plan", &bench.pipeline_file()]);
    assert_eq!((said.code, said.out.as_str()), (3, ""), "{said:?}");
    assert!(said.err.contains("p.dxf"), "{}", said.err);
}

/// The garment can be looked at while it is worked on, and the end of the work is foreseen.
#[test]
fn a_preview_shows_every_level_and_events_tell_the_time_left() {
    let folder = tempfile::tempdir().expect("folder");
    let (out, events) = (folder.path().join("out"), folder.path().join("events.jsonl"));
    let pipeline = root().join("pipelines/t-shirt/v1.toml");
    let run: [&dyn AsRef<std::ffi::OsStr>; 8] =
        [&"run", &pipeline, &"--out", &out, &"--preview", &"--events", &events, &"--quiet"];
    let said = toile(&run);
    assert_eq!(said.code, 0, "{said:?}");
    let text = std::fs::read_to_string(&events).expect("events");
    let events: Vec<Value> = text.lines().map(|l| serde_json::from_str(l).expect("JSON")).collect();
    let of = |kind: &str| events.iter().filter(|e| e["kind"] == kind).cloned().collect::<Vec<_>>();
    let levels: Vec<Value> = of("preview").iter().map(|e| e["words"].clone()).collect();
    assert!(levels.len() >= 3, "a coarse cloth, the sewn one, the draped one: {levels:?}");
    assert!(of("progress").iter().any(|e| e["left_s"].as_f64().is_some_and(|s| s > 0.0)));
    // The last one is the drape.
    let facts = |file: &str| json(&toile(&[&"inspect", &out.join(file), &"--json"]));
    let (shown, made) = (facts("preview.glb"), facts("t-shirt.glb"));
    assert_eq!(shown["bbox_m"], made["bbox_m"]);
    assert!(!shown["bbox_m"].is_null());
    // It is a file like others: it is not replaced in silence.
    assert_eq!(toile(&[&"run", &pipeline, &"--out", &out, &"--preview", &"--quiet"]).code, 2);
    let (other, name) = (folder.path().join("other"), "export-gltf.file={out}/preview.glb");
    let said = toile(&[&"run", &pipeline, &"--set", &name, &"--out", &other, &"--preview", &"--quiet"]);
    assert_eq!(said.code, 2, "{said:?}");
    assert!(!other.join("run.json").exists(), "found before any work");
    // Beside the results of another run it would show the wrong garment.
    let project = support::project::Project::new();
    let printed = project.path("printed.toml");
    let said = toile(&[&"run", &printed, &"--out", &out, &"--force", &"--quiet"]);
    assert!(said.code == 0 && !out.join("preview.glb").exists(), "{said:?}");
}

/// No output replaces the file that its verb reads.
#[test]
fn no_verb_replaces_what_it_reads() {
    let dir = tempfile::tempdir().expect("folder");
    let copy = |from: &str, name: &str| {
        let path = dir.path().join(name);
        std::fs::copy(sample(from), &path).expect("copy");
        path
    };
    let pattern = copy("patterns/long-skirt.astm.dxf", "skirt.dxf");
    let fabric = copy("fabrics/wool-suiting.toml", "cloth.toml");
    let garment = dir.path().join("garment.json");
    std::fs::write(&garment, "{}").expect("file");
    let same = dir.path().join("sub/../garment.json");
    std::fs::create_dir(dir.path().join("sub")).expect("folder");
    let other = dir.path().join("other.dxf");
    let said = [
        toile(&[&"inspect", &pattern, &"--svg", &pattern, &"--force"]),
        toile(&[&"fabric", &"test", &"cantilever", &fabric, &"--svg", &fabric, &"--force"]),
        toile(&[&"flatten", &garment, &"--dxf", &garment, &"--force"]),
        toile(&[&"flatten", &garment, &"--json", &same, &"--force"]),
    ];
    for said in said {
        assert_eq!(said.code, 2, "{said:?}");
        assert!(said.err.contains("an output never replaces an input"), "{}", said.err);
    }
    assert_eq!(
        std::fs::read(&pattern).expect("file"),
        std::fs::read(sample("patterns/long-skirt.astm.dxf")).expect("file")
    );
    assert_eq!(std::fs::read_to_string(&garment).expect("file"), "{}");
    let twice = toile(&[&"flatten", &garment, &"--dxf", &other, &"--json", &other]);
    assert_eq!(twice.code, 2);
    assert!(twice.err.contains("outputs-collide"), "{}", twice.err);
}

/// The page holds the body, so a plan with it needs more memory than one without.
#[test]
fn a_plan_foresees_the_memory_of_the_page() {
    let project = support::project::Project::new();
    let chain = support::project::DRAPED;
    project.write("bare.toml", chain.split("[[stage]]\nuse = \"export-report\"").next().expect("a chain"));
    let mb = |file: &str| {
        let (code, out, err) = project.toile(&format!("plan {file} --json"));
        assert_eq!(code, 0, "{err}");
        let plan: Value = serde_json::from_str(&out).expect("JSON");
        plan["expected"]["mb"].as_f64().expect("memory")
    };
    let [with, without] = ["draped.toml", "bare.toml"].map(mb);
    assert!(with > without + 15.0, "{with} and {without} MB");
}
