//! The shadow seen from above, between the circles of the disc and of the flat specimen; the warp runs upwards.

use super::{finish, mm};
use crate::fabric_test::cusick::{Cusick, DISC};
use std::f64::consts::TAU;
use toile_formats::svg::canvas::Canvas;
use toile_garment::Vec2;

/// Height of letters, mm.
const LETTERS: f64 = 8.0;

/// Draws one reading.
#[must_use]
pub fn cusick(fabric: &str, read: &Cusick) -> String {
    let specimen = 0.5 * read.params.specimen;
    let mut canvas = Canvas::default();
    let at = |r: f64, angle: f64| mm([r * libm::cos(angle), r * libm::sin(angle)]);
    let step = TAU / read.outline.len().max(1) as f64;
    let outline: Vec<Vec2> = read.outline.iter().enumerate().map(|(k, r)| at(*r, k as f64 * step)).collect();
    canvas.line("shadow", &outline, true);
    canvas.dot("disc", Vec2::zeros(), 1e3 * DISC);
    canvas.dot("specimen", Vec2::zeros(), 1e3 * specimen);
    for (node, angle) in read.nodes.iter().zip(read.node_angles()) {
        canvas.dot("node", at(node.peak, angle), 1.2);
    }
    warp(&mut canvas);
    let edge = 1e3 * specimen;
    let words = format!("drape coefficient {:.1} %, {} nodes", 100.0 * read.drape_coefficient, read.nodes.len());
    canvas.text("name", Vec2::new(0.0, edge + 3.0 * LETTERS), LETTERS, fabric);
    canvas.text("label", Vec2::new(0.0, edge + 1.5 * LETTERS), LETTERS, &words);
    canvas.scale_bar(Vec2::new(-50.0, -edge - 3.0 * LETTERS), 100.0, LETTERS);
    let wide = edge + 2.0 * LETTERS;
    finish(canvas, [-wide, -edge - 4.0 * LETTERS], [wide, edge + 4.5 * LETTERS], fabric)
}

fn warp(canvas: &mut Canvas) {
    let (foot, tip) = (Vec2::new(0.0, -30.0), Vec2::new(0.0, 30.0));
    let head = |x: f64| tip + Vec2::new(x, -6.0);
    canvas.line("axis", &[foot, tip, head(-2.5), tip, head(2.5)], false);
    canvas.text("label", Vec2::new(16.0, 0.0), LETTERS, "warp");
}
