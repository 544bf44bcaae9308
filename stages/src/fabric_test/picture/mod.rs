//! Pictures of the tests as SVG, in millimetres.

mod cantilever;
mod chart;
mod curves;
mod cusick;
mod tension;

pub use cantilever::cantilever;
pub use curves::{bias, frame};
pub use cusick::cusick;
pub use tension::tension;

use toile_formats::svg::canvas::{Bounds, Canvas};
use toile_garment::Vec2;

const STYLE: &str = "\
path,circle{fill:none;stroke-linejoin:round;vector-effect:non-scaling-stroke}\
.shadow{fill:#d5d9dd;stroke:#111;stroke-width:1.6px}.disc{fill:#fff;stroke:#555;stroke-width:1px}\
.specimen{stroke:#555;stroke-width:1px;stroke-dasharray:5 4}.node{fill:#d0281c}\
.platform{fill:#e8e8e8;stroke:#555;stroke-width:1px}.plane{stroke:#555;stroke-width:1px;stroke-dasharray:5 4}\
.warp{stroke:#0b6b3a;stroke-width:1.8px}.weft{stroke:#1c5fd0;stroke-width:1.8px}.bias{stroke:#d0281c;stroke-width:1.8px}\
.measured{stroke:#0b6b3a;stroke-width:1.8px}.law{stroke:#555;stroke-width:1px;stroke-dasharray:5 4}\
.axis{stroke:#111;stroke-width:1px}.scale{stroke:#111;stroke-width:1.4px}\
text{font-family:'DejaVu Sans',Arial,Helvetica,sans-serif;text-anchor:middle}.label{fill:#333}.name{fill:#111;font-weight:bold}";

/// Height of letters, mm.
const LETTERS: f64 = 5.0;

/// Metres in the plane as millimetres on paper.
fn mm(p: [f64; 2]) -> Vec2 {
    Vec2::new(1e3 * p[0], 1e3 * p[1])
}

fn finish(canvas: Canvas, low: [f64; 2], high: [f64; 2], title: &str) -> String {
    let bounds = Bounds { min: Vec2::new(low[0], low[1]), max: Vec2::new(high[0], high[1]) };
    canvas.finish(bounds, title, STYLE)
}
