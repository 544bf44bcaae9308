//! The pipelines that the comparison with other programs runs (stages/cloth/benches/comparison) do what its table says.

mod support;
use std::path::Path;
use support::draped::positions;
use support::mesh::{Family, sheet::sheet};
use support::program::run;
use toile_garment::Vec3;

/// Hung by two corners its own weight would stretch single edges there by several percent.
#[test]
fn no_edge_of_a_hanging_square_is_stretched_by_1_5_percent() {
    let dir = tempfile::tempdir().expect("folder");
    let keep = |name: &str, text: &str| std::fs::write(dir.path().join(name), text).expect("written");
    let ours = Path::new(env!("CARGO_MANIFEST_DIR")).join("stages/cloth/benches/comparison");
    let ours = |name: &str| std::fs::read_to_string(ours.join(name)).expect("a file of the comparison");
    keep("pipeline.toml", &ours("held.toml"));
    keep("plain-cotton.toml", &ours("plain-cotton.toml"));
    let square = sheet([1.0, 1.0], 24, 24, Family::Right, |_| true).place(|[u, v]| Vec3::new(u, v, 1.0));
    keep("garment.obj", &square.obj());
    let held = square.pick(|[u, v]| v < 1e-9 && !(1e-9..1.0 - 1e-9).contains(&u));
    keep("pins.txt", &held.iter().map(|v| format!("{v}\n")).collect::<String>());
    let ended = run(dir.path(), 60.0, &[]);
    assert!(ended.code == 0 && held.len() == 2, "{}", ended.said);
    let most = square.stretch(&positions(&ended, "final.obj").expect("positions"));
    assert!((0.008..0.015).contains(&most), "{most}");
}
