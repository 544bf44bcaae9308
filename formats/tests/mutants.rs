//! Two thousand damaged copies of pattern files: refused in words or read whole, never a panic.
//!
//! Many more: `cargo run --release -p toile-formats --example mutants -- 100000 FILE…`

#[path = "mutants/mod.rs"]
mod mutants;

use mutants::{Dice, fault, mutant};
use std::path::PathBuf;

#[test]
fn two_thousand_mutants() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../samples/patterns");
    let sample = |name: &str| (name.to_owned(), std::fs::read(folder.join(name)).expect("sample"));
    let specification = r#"{"pattern": {"panels": {"a": {"vertices": [[0,0],[40,0],[40,60],[23,60],[20,50],[17,60],[0,60]],
        "translation": [0,60,20], "rotation": [0,0,0], "edges": [{"endpoints": [0,1]}, {"endpoints": [1,2],
        "curvature": {"type": "cubic", "params": [[0.3,0.1],[0.6,-0.1]]}}, {"endpoints": [2,3]}, {"endpoints": [3,4]},
        {"endpoints": [4,5]}, {"endpoints": [5,6]}, {"endpoints": [6,0], "curvature": {"type": "circle", "params": [80,0,1]}}]}},
        "stitches": [[{"panel": "a", "edge": 3}, {"panel": "a", "edge": 4}]]}, "properties": {"units_in_meter": 100}}"#;
    let seeds = [
        sample("long-skirt.aama.dxf"),
        sample("fitted-bodice.aama.dxf"),
        sample("t-shirt.aama.dxf"),
        ("t.rul".to_owned(), b"UNITS: METRIC\nNUMBER OF SIZES: 2\nSIZE LIST: 38 40\nSAMPLE SIZE: 38\nRULE: DELTA 1\n0.0, 0.0 5.5, -2.0\nEND\n".to_vec()),
        ("t.json".to_owned(), specification.as_bytes().to_vec()),
    ];
    let mut dice = Dice(11);
    let mut faults = Vec::new();
    for i in 0..2000 {
        let (name, seed) = &seeds[i % seeds.len()];
        let bytes = mutant(seed, &mut dice);
        faults.extend(fault(name, &bytes).map(|f| format!("{name}, mutant {i}: {f}")));
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
