//! Places along a line by arc length: lyon's measurements of a path.

use super::{Frame, NO_CURVES};
use lyon::algorithms::measure::{PathMeasurements, SampleType};
use lyon::path::Path;
use toile_garment::Vec2;

/// Places at shares of the length of an open line. The share 0 is the first point, exactly.
///
/// The line is a stretch between two vertices that must be. Over a whole outline the lengths that lyon sums up in
/// `f32` drift by micrometres, and notches would miss their vertices; within a stretch they keep to the grid.
pub fn places_along(line: &[Vec2], shares: &[f64]) -> Vec<Vec2> {
    let Some(first) = line.first() else { return Vec::new() };
    let frame = Frame(*first);
    let mut builder = Path::builder();
    builder.begin(frame.to(*first));
    for p in &line[1..] {
        builder.line_to(frame.to(*p));
    }
    builder.end(false);
    let path = builder.build();
    let lengths = PathMeasurements::from_path(&path, NO_CURVES);
    let mut sampler = lengths.create_sampler(&path, SampleType::Normalized);
    let mut place = |share: f64| frame.back(sampler.sample(share as f32).position());
    shares.iter().map(|share| if *share > 0.0 { place(*share) } else { *first }).collect()
}
