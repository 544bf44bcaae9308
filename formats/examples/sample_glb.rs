//! Writes a GLB of a small sewn tube, for looking at and for checking with other programs.
//!
//! `cargo run --release -p toile-formats --example sample_glb -- OUT.glb`

#[path = "../src/sample.rs"]
mod sample;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let out = std::env::args().nth(1).ok_or("usage: sample_glb OUT.glb")?;
    std::fs::write(out, toile_formats::gltf::write_garment(&sample::two_pieces())?)?;
    Ok(())
}
