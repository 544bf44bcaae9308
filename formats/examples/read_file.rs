//! Reads one file of any format this package knows and says what is in it; exit code 3 when it is refused.
//!
//! `cargo run --release -p toile-formats --example read_file -- FILE`

use std::io::Write as _;
use std::process::ExitCode;
use toile_formats::{body, fabric, gltf, obj, texture};

fn main() -> ExitCode {
    let Some(path) = std::env::args().nth(1) else { return say("usage: read_file FILE", 2) };
    let bytes = match std::fs::read(&path) {
        Ok(bytes) => bytes,
        Err(e) => return say(&format!("cannot read the file: {e}"), 5),
    };
    let text = String::from_utf8_lossy(&bytes);
    let facts = match path.rsplit('.').next() {
        Some("glb") => gltf::inspect(&bytes).map(|v| v.to_string()).map_err(|e| e.to_string()),
        Some("obj") => obj::inspect(&bytes, &path)
            .and_then(|v| body::read(&bytes, &path, None).map(|b| format!("{v}\nas a body: {:?}", b.findings)))
            .map_err(|d| lines(&d)),
        Some("toml") => fabric::read(&text, &path).map(|f| format!("{f:#?}")).map_err(|d| lines(&d)),
        _ => texture::read_image(&bytes, &path)
            .map(|i| format!("{} {} × {}", i.mime, i.width, i.height))
            .map_err(|d| d.to_string()),
    };
    match facts {
        Ok(facts) => say(&facts, 0),
        Err(why) => say(&why, 3),
    }
}

fn lines(found: &[toile_garment::Diagnostic]) -> String {
    found.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

fn say(words: &str, code: u8) -> ExitCode {
    let done = if code == 0 { writeln!(std::io::stdout(), "{words}") } else { writeln!(std::io::stderr(), "{words}") };
    if done.is_err() { ExitCode::from(5) } else { ExitCode::from(code) }
}
