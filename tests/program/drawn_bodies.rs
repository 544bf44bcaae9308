//! The committed bodies are what the drawing program draws.

use toile_stages::body::{BodyMeasures, parametric};

/// Sizes of the samples.
const SIZES: [&str; 3] = ["36", "38", "40"];

#[test]
fn committed_bodies_are_drawn_bit_equal() {
    for label in SIZES {
        let body = parametric(&BodyMeasures::size(label).unwrap()).unwrap();
        let (mesh, side) = toile_formats::body::write(&body);
        for (kind, drawn) in [("obj", mesh), ("toml", side)] {
            let path = format!("{}/samples/bodies/size-{label}.{kind}", env!("CARGO_MANIFEST_DIR"));
            let committed = std::fs::read_to_string(&path).unwrap();
            assert!(committed == drawn, "{path} is stale: cargo run --release --example draw_bodies");
        }
    }
}

/// Every length of the side file carries its unit, and the file is TOML with the agreed tables.
#[test]
fn side_files_carry_units() {
    for label in SIZES {
        let path = format!("{}/samples/bodies/size-{label}.toml", env!("CARGO_MANIFEST_DIR"));
        let table: toml::Table = std::fs::read_to_string(&path).unwrap().parse().unwrap();
        let lengths = table["measures"]
            .as_table()
            .unwrap()
            .values()
            .chain(table["landmarks"].as_table().unwrap().values().flat_map(|p| p.as_array().unwrap()));
        for length in lengths {
            assert!(length.as_str().unwrap().parse::<toile_garment::units::Length>().is_ok(), "{length}");
        }
        for name in ["torso", "neck", "arm-left", "arm-right", "leg-left", "leg-right"] {
            let segment = table["segments"][name].as_table().unwrap();
            assert!(["from", "to", "half_width", "half_depth"].iter().all(|key| segment.contains_key(*key)), "{name}");
        }
    }
}
