//! Side view of the strips at the overhang that meets the sloping plane.

use super::{LETTERS, finish, mm};
use crate::fabric_test::cantilever::{Cantilever, SLOPE};
use toile_formats::svg::canvas::Canvas;
use toile_garment::Vec2;

/// Length of the platform that is drawn, mm.
const PLATFORM: f64 = 30.0;

/// Draws the strips of all directions from one edge.
#[must_use]
pub fn cantilever(fabric: &str, read: &[Cantilever]) -> String {
    let mut canvas = Canvas::default();
    let reach = 1e3 * read.iter().map(|c| c.overhang).fold(0.01, f64::max) + 5.0;
    let slope = libm::tan(SLOPE.to_radians());
    let (edge, foot) = (Vec2::zeros(), Vec2::new(0.0, -reach * slope));
    let back = |y: f64| Vec2::new(-PLATFORM, y);
    canvas.line("platform", &[back(0.0), edge, foot, back(foot.y)], true);
    canvas.line("plane", &[edge, Vec2::new(reach, -reach * slope)], false);
    for c in read {
        let line: Vec<Vec2> = c.profile.iter().map(|[along, down]| mm([*along, -*down])).collect();
        canvas.line(c.direction.word(), &[&[back(0.0)], line.as_slice()].concat(), false);
    }
    canvas.text("name", Vec2::new(0.5 * reach, 2.0 * LETTERS + 7.0 * read.len() as f64), LETTERS, fabric);
    for (k, c) in read.iter().enumerate() {
        let y = 1.4 * LETTERS + 7.0 * (read.len() - 1 - k) as f64;
        canvas.line(c.direction.word(), &[back(y), Vec2::new(-PLATFORM + 10.0, y)], false);
        let words =
            format!("{}: c {:.1} mm, B {:.2} uN.m", c.direction.word(), 1e3 * c.bending_length, 1e6 * c.rigidity);
        canvas.text("label", Vec2::new(14.0, y), 0.8 * LETTERS, &words);
    }
    canvas.scale_bar(Vec2::new(-PLATFORM, foot.y - 2.0 * LETTERS), 50.0, LETTERS);
    let high = 4.0 * LETTERS + 7.0 * read.len() as f64;
    finish(canvas, [-PLATFORM - 5.0, foot.y - 3.0 * LETTERS], [reach.max(60.0) + 5.0, high], fabric)
}
