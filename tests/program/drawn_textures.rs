//! The committed fabric bitmaps are what the drawing program draws, and they tile.

#[allow(dead_code)]
#[path = "../../examples/draw_textures.rs"]
mod draw_textures;

use draw_textures::{drawings, png};

#[test]
fn committed_bitmaps_are_drawn_bit_equal() {
    for (name, drawing) in drawings() {
        let path = format!("{}/samples/textures/{name}.png", env!("CARGO_MANIFEST_DIR"));
        let committed = std::fs::read(&path).unwrap();
        assert!(committed == png(&drawing).unwrap(), "{path} is stale: cargo run --release --example draw_textures");
    }
}

/// Over the border the picture changes no more than between any two columns or rows one yarn apart.
#[test]
fn bitmaps_tile_without_a_seam() {
    for (name, drawing) in drawings() {
        let (w, h) = drawing.dimensions();
        let step = |a: (u32, u32), b: (u32, u32)| {
            let (a, b) = (drawing.get_pixel(a.0 % w, a.1 % h), drawing.get_pixel(b.0 % w, b.1 % h));
            a.0.iter().zip(b.0).map(|(a, b)| u64::from(a.abs_diff(b))).sum::<u64>()
        };
        let column = |x: u32| (0..h).map(|y| step((x, y), (x + 1, y))).sum::<u64>();
        let row = |y: u32| (0..w).map(|x| step((x, y), (x, y + 1))).sum::<u64>();
        assert!(column(w - 1) <= (0..w - 1).map(column).max().unwrap(), "{name}: a seam between the columns");
        assert!(row(h - 1) <= (0..h - 1).map(row).max().unwrap(), "{name}: a seam between the rows");
    }
}
