//! A plain chart: axes from zero, round marks, curves.

use super::LETTERS;
use toile_formats::svg::canvas::{Canvas, fixed};
use toile_garment::Vec2;

/// Width and height of the field, mm.
pub const FIELD: [f64; 2] = [140.0, 90.0];

/// A chart with its lower left corner at the origin.
pub struct Chart {
    pub canvas: Canvas,
    most: [f64; 2],
}

impl Chart {
    /// Axes up to `most` (rounded up), with their names.
    pub fn new(most: [f64; 2], names: [&str; 2]) -> Self {
        let mut chart = Self { canvas: Canvas::default(), most: most.map(|m| round_up(m.max(1e-9))) };
        let [w, h] = FIELD;
        chart.canvas.line("axis", &[Vec2::new(0.0, h), Vec2::zeros(), Vec2::new(w, 0.0)], false);
        for k in 0..=5 {
            let share = f64::from(k) / 5.0;
            let (x, y) = (share * w, share * h);
            chart.canvas.line("axis", &[Vec2::new(x, 0.0), Vec2::new(x, -1.5)], false);
            chart.canvas.line("axis", &[Vec2::new(0.0, y), Vec2::new(-1.5, y)], false);
            let small = 0.8 * LETTERS;
            chart.canvas.text("label", Vec2::new(x, -1.2 * LETTERS), small, &mark(share * chart.most[0]));
            chart.canvas.text("label", Vec2::new(-1.6 * LETTERS, y), small, &mark(share * chart.most[1]));
        }
        chart.canvas.text("label", Vec2::new(0.5 * w, -2.7 * LETTERS), LETTERS, names[0]);
        chart.canvas.text("label", Vec2::new(0.0, h + 1.2 * LETTERS), LETTERS, names[1]);
        chart
    }

    /// A curve in the units of the axes.
    pub fn curve(&mut self, class: &str, points: impl IntoIterator<Item = [f64; 2]>) {
        let place = |p: [f64; 2]| Vec2::new(p[0] / self.most[0] * FIELD[0], p[1] / self.most[1] * FIELD[1]);
        let points: Vec<Vec2> = points.into_iter().map(place).collect();
        self.canvas.line(class, &points, false);
    }

    /// The whole drawing under a title and a line of words.
    pub fn finish(mut self, title: &str, words: &str) -> String {
        let [w, h] = FIELD;
        self.canvas.text("name", Vec2::new(0.5 * w, h + 5.2 * LETTERS), LETTERS, title);
        self.canvas.text("label", Vec2::new(0.5 * w, h + 3.5 * LETTERS), 0.8 * LETTERS, words);
        super::finish(self.canvas, [-4.5 * LETTERS, -4.0 * LETTERS], [w + 2.0 * LETTERS, h + 7.0 * LETTERS], title)
    }
}

/// The next of 1, 2, 2.5, 5 times a power of ten.
fn round_up(x: f64) -> f64 {
    let power = libm::pow(10.0, libm::log10(x).floor());
    [1.0, 2.0, 2.5, 5.0, 10.0].into_iter().map(|f| f * power).find(|r| *r >= x * (1.0 - 1e-9)).unwrap_or(x)
}

fn mark(x: f64) -> String {
    let text = fixed(x, 2);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_end_at_round_numbers() {
        for (x, end) in [(9.7, 10.0), (10.0, 10.0), (0.031, 0.05), (17.0, 20.0), (23.0, 25.0)] {
            assert!((round_up(x) / end - 1.0).abs() < 1e-12, "{x}");
        }
        assert_eq!(mark(2.5), "2.5");
        assert_eq!(mark(20.0), "20");
    }
}
