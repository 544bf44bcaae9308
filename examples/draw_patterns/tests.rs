//! Is it a pattern? Lengths that are sewn together, closed lines, allowance, darts.

use super::*;

#[test]
fn committed_files_are_what_is_drawn_here() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("samples").join("patterns");
    for (name, bytes) in files().expect("drawn") {
        let committed = std::fs::read(folder.join(&name)).expect("committed file");
        assert!(committed == bytes, "{name} is stale: run cargo run --release --example draw_patterns");
    }
}
