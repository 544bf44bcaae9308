//! Draws the sample bodies: `cargo run --release --example draw_bodies` writes `samples/bodies/`.

use std::path::Path;
use std::process::ExitCode;
use toile_stages::body::{BodyMeasures, parametric};

/// Sizes of the samples.
const SIZES: [&str; 3] = ["36", "38", "40"];

fn main() -> ExitCode {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/bodies");
    for label in SIZES {
        if let Err(problem) = draw(&folder, label) {
            report(&format!("size {label}: {problem}"));
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}

#[allow(clippy::print_stderr)]
fn report(problem: &str) {
    eprintln!("{problem}");
}

fn draw(folder: &Path, label: &str) -> Result<(), String> {
    let measures = BodyMeasures::size(label).ok_or("no such size")?;
    let body =
        parametric(&measures).map_err(|found| found.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))?;
    let write = |kind: &str, text: String| {
        let path = folder.join(format!("{}.{kind}", body.name));
        std::fs::write(&path, text).map_err(|e| format!("{}: {e}", path.display()))
    };
    let (mesh, side) = toile_formats::body::write(&body);
    write("obj", mesh)?;
    write("toml", side)
}
