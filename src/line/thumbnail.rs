//! A small picture of every job, for the page of the line.

use crate::engine::{output_below, read_limited, write_whole};
use serde_json::Value;
use std::path::Path;
use toile_formats::gltf;
use toile_formats::picture::{View, Wishes, png};

/// Width and height, pixels.
const SIZE: [u32; 2] = [200, 280];
/// Largest garment that is drawn, bytes.
const MAX_GARMENT: u64 = 256 << 20;

/// Draws the first garment among the outputs of a job. `None` where there is none, or it cannot be drawn: the page then
/// shows no picture.
pub fn draw(folder: &Path, record: &Value, to: &Path) -> Option<()> {
    let outputs = || record["outputs"].as_array().into_iter().flatten().filter_map(|o| o["path"].as_str());
    let name = outputs().find(|p| p.ends_with(".glb"))?;
    let path = folder.join(output_below(Path::new(name)).ok()?);
    let garment = gltf::read_garment(&read_limited(&path, &path, MAX_GARMENT).ok()?).ok()?;
    let [width, height] = SIZE;
    let wishes = Wishes { views: vec![View::ThreeQuarter], width, height, body: true, field: None };
    std::fs::create_dir_all(to.parent()?).ok()?;
    write_whole(to, &png(&garment, &wishes).ok()?).ok()
}
