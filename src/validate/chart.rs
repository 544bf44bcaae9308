//! The chart of a validation: predicted against captured, drape coefficients at the left and heights of the hem at the right.

use super::band::Band;
use super::laws::LAWS;
use super::rows::{Readings, Row, Validation};
use std::fmt::Write as _;
use toile_formats::svg::canvas::{escape, fixed};

/// Size of a panel, and of the strip under both, pixels.
const PANEL: f64 = 440.0;
const LEGEND: f64 = 40.0;
/// Space at the left, above, at the right and below a panel, pixels.
const MARGIN: [f64; 4] = [56.0, 36.0, 16.0, 48.0];
/// Colours of the laws.
const COLOURS: [&str; LAWS.len()] = ["#1f4e79", "#c77700", "#7b3fa0"];
const STYLE: &str = "text{font:12px 'DejaVu Sans',Arial,sans-serif;fill:#333}.title{font-size:14px;font-weight:bold}\
.grid{stroke:#e4dfd3}.frame{fill:none;stroke:#8b8576}.even{stroke:#8b8576;stroke-dasharray:4 3}.bar{stroke-width:1.2;opacity:.55}";

/// One quantity: title, range of both axes, step of the grid, and how it is read.
struct Quantity {
    title: &'static str,
    range: [f64; 2],
    step: f64,
    of: fn(&Readings) -> Option<Band>,
}

const QUANTITIES: [Quantity; 2] = [
    Quantity { title: "drape coefficient, %", range: [0.0, 100.0], step: 20.0, of: |r| Some(r.coefficient) },
    Quantity { title: "mean height of the hem, mm", range: [-60.0, 0.0], step: 10.0, of: |r| r.height },
];

impl Quantity {
    /// Place of a value along an axis from `from` to `to`.
    fn place(&self, value: f64, [from, to]: [f64; 2]) -> f64 {
        let [low, high] = self.range;
        from + ((value - low) / (high - low)).clamp(0.0, 1.0) * (to - from)
    }
}

/// The chart.
#[must_use]
pub fn svg(validation: &Validation) -> String {
    let [width, height] = [2.0 * PANEL, PANEL + LEGEND];
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" role=\"img\">\n<title>{}</title>\n\
         <style>{STYLE}</style>\n<rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n",
        escape(&super::table::title(validation))
    );
    for (k, quantity) in QUANTITIES.iter().enumerate() {
        panel(&mut out, validation, quantity, PANEL * k as f64);
    }
    for (k, law) in LAWS.iter().enumerate() {
        let x = MARGIN[0] + 180.0 * k as f64;
        let y = PANEL + 16.0;
        let _ = writeln!(
            out,
            "<circle cx=\"{x}\" cy=\"{}\" r=\"5\" fill=\"{}\"/><text x=\"{}\" y=\"{y}\">{}</text>",
            y - 4.0,
            COLOURS[k],
            x + 10.0,
            law.name
        );
    }
    out.push_str("</svg>\n");
    out
}

fn panel(out: &mut String, validation: &Validation, quantity: &Quantity, left: f64) {
    let x = [left + MARGIN[0], left + PANEL - MARGIN[2]];
    let y = [PANEL - MARGIN[3], MARGIN[1]];
    let mut tick = quantity.range[0];
    // Writing to a String cannot fail.
    while tick <= quantity.range[1] {
        let (at_x, at_y) = (fixed(quantity.place(tick, x), 1), fixed(quantity.place(tick, y), 1));
        let _ = writeln!(
            out,
            "<path class=\"grid\" d=\"M{at_x} {0}V{1}M{2} {at_y}H{3}\"/><text x=\"{at_x}\" y=\"{4}\" text-anchor=\"middle\">\
             {tick}</text><text x=\"{5}\" y=\"{at_y}\" text-anchor=\"end\">{tick}</text>",
            y[0],
            y[1],
            x[0],
            x[1],
            y[0] + 16.0,
            x[0] - 6.0
        );
        tick += quantity.step;
    }
    let middle = 0.5 * (y[0] + y[1]);
    let _ = writeln!(
        out,
        "<rect class=\"frame\" x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\"/>\n<path class=\"even\" d=\"M{0} {4}L{5} {1}\"/>\n\
         <text class=\"title\" x=\"{0}\" y=\"{6}\">{7}</text>\n<text x=\"{8}\" y=\"{9}\" text-anchor=\"middle\">captured</text>\n\
         <text transform=\"translate({10} {middle}) rotate(-90)\" text-anchor=\"middle\">predicted</text>",
        x[0],
        y[1],
        x[1] - x[0],
        y[0] - y[1],
        y[0],
        x[1],
        y[1] - 12.0,
        quantity.title,
        0.5 * (x[0] + x[1]),
        y[0] + 36.0,
        x[0] - 38.0
    );
    for row in &validation.rows {
        mark(out, quantity, row, x, y);
    }
}

fn mark(out: &mut String, quantity: &Quantity, row: &Row, x: [f64; 2], y: [f64; 2]) {
    let bands = row.captured.as_ref().and_then(quantity.of).zip((quantity.of)(&row.simulated));
    let Some((captured, simulated)) = bands else { return };
    let colour = LAWS.iter().position(|l| l.name == row.law).map_or("#333", |k| COLOURS[k]);
    let [cx, cy] = [quantity.place(captured.mean, x), quantity.place(simulated.mean, y)];
    let across = [-1.0, 1.0].map(|s| fixed(quantity.place(captured.mean + s * captured.scatter.unwrap_or(0.0), x), 1));
    let up = [-1.0, 1.0].map(|s| fixed(quantity.place(simulated.mean + s * simulated.scatter.unwrap_or(0.0), y), 1));
    let paint = if row.was_set { format!("fill=\"{colour}\"") } else { format!("fill=\"#fff\" stroke=\"{colour}\"") };
    let words = format!(
        "{} {}, {}: captured {:.1}, predicted {:.1}",
        row.fabric, row.face, row.law, captured.mean, simulated.mean
    );
    let _ = writeln!(
        out,
        "<path class=\"bar\" stroke=\"{colour}\" d=\"M{} {2}H{}M{3} {4}V{5}\"/>\
         <circle cx=\"{3}\" cy=\"{2}\" r=\"4\" {paint}><title>{6}</title></circle>",
        across[0],
        across[1],
        fixed(cy, 1),
        fixed(cx, 1),
        up[0],
        up[1],
        escape(&words)
    );
}
