//! The pictures of the sample garments in the book.

use crate::run::{Done, cargo};
use std::fs;
use std::path::Path;

/// The first stage that a picture does not need.
const REST: &str = "[[stage]]\nuse = \"export-gltf\"";

/// The program that draws the picture instead.
const PICTURE: &str = "[[stage]]
use = \"export-picture\"
with.file = \"{out}/garment.png\"
with.view = [\"front\", \"back\"]
with.width = 112
with.height = 164
";

/// Runs every pipeline up to its looks and draws the garment from the front and from the back.
pub fn draw(more: &[String]) -> Done {
    let (work, book) = (Path::new("target/garments"), Path::new("docs/book/src/pictures/garments"));
    let say = |what: &Path, e: std::io::Error| format!("{}: {e}", what.display());
    for folder in [work, book] {
        fs::create_dir_all(folder).map_err(|e| say(folder, e))?;
    }
    let entries = fs::read_dir("pipelines").map_err(|e| say(Path::new("pipelines"), e))?;
    let mut styles: Vec<_> =
        entries.flatten().filter(|e| e.path().join("v1.toml").is_file()).map(|e| e.file_name()).collect();
    styles.sort();
    for style in styles {
        let from = Path::new("pipelines").join(&style).join("v1.toml");
        let text = fs::read_to_string(&from).map_err(|e| say(&from, e))?;
        let head = text.split(REST).next().unwrap_or(&text);
        let pipeline = work.join(&style).with_extension("toml");
        fs::write(&pipeline, format!("{head}{PICTURE}")).map_err(|e| say(&pipeline, e))?;
        let out = work.join(&style);
        let words = [pipeline.display().to_string(), "--out".to_owned(), out.display().to_string()];
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let head = ["run", "--release", "--locked", "--quiet", "-p", "toile", "--", "run", "--quiet", "--force"];
        cargo(&[&head[..], &words[..]].concat(), more)?;
        let (picture, to) = (out.join("garment.png"), book.join(&style).with_extension("png"));
        fs::copy(&picture, &to).map_err(|e| say(&picture, e))?;
    }
    Ok(())
}
