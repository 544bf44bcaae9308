//! Parts of an outline edge, between two places on it: its middle, a notch, a share, a length.

use super::codes;
use super::lookup::RawRun;
use super::marks::notches_on;
use super::ring::SAME;
use super::shapes::PieceShape;
use toile_formats::sewing::place_text;
use toile_garment::sewing::{EdgePlace, EdgeWay};
use toile_garment::{Diagnostic, Piece};

/// The part of a whole edge between two places. Its direction is not stated, as that of an edge.
///
/// # Errors
/// A place that is not on the edge, or two places that are one.
pub fn run(
    piece: &Piece,
    shape: &PieceShape,
    edge: &str,
    whole: &RawRun,
    places: [EdgePlace; 2],
) -> Result<RawRun, Diagnostic> {
    let ring = &shape.rings[whole.ring];
    let length = ring.sewn_ahead(whole.from, whole.to);
    let notches = notches_on(piece, shape, [whole.from, whole.to]);
    let way =
        |place: EdgePlace| way(place, length, &notches).ok_or_else(|| off_edge(piece, edge, place, length, &notches));
    let [p, q] = [way(places[0])?, way(places[1])?];
    if (p - q).abs() < SAME {
        let message = format!("piece `{}`: a part of edge `{edge}` starts and ends at one place", piece.name);
        return Err(Diagnostic::error(codes::RUN_WITHOUT_LENGTH, message).hint("give two different places"));
    }
    let at = |way: f64| ring.after_sewn(whole.from, way);
    Ok(RawRun { from: at(p.min(q)), to: at(p.max(q)), ..whole.clone() })
}

/// The way of a place from the start of the edge, m; `None` beyond the edge.
fn way(place: EdgePlace, length: f64, notches: &[f64]) -> Option<f64> {
    let turned = |way: f64| if place.from_end { length - way } else { way };
    match place.way {
        EdgeWay::Share(share) => Some(turned(share * length)),
        EdgeWay::Length(way) => (way <= length + SAME).then(|| turned(way.min(length))),
        EdgeWay::Notch(number) => {
            let k = (number as usize).checked_sub(1)?;
            let k = if place.from_end { notches.len().checked_sub(k + 1)? } else { k };
            notches.get(k).copied()
        }
    }
}

fn off_edge(piece: &Piece, edge: &str, place: EdgePlace, length: f64, notches: &[f64]) -> Diagnostic {
    let places: Vec<String> = notches.iter().map(|n| format!("{:.1} mm", n * 1e3)).collect();
    let told = if places.is_empty() {
        "it has no notch".to_owned()
    } else {
        format!("its notches are at {} from its start", places.join(", "))
    };
    let message = format!("piece `{}`: edge `{edge}` has no place `{}`", piece.name, place_text(place));
    Diagnostic::error(codes::EDGE_PLACE_UNKNOWN, message).hint(format!("it is {:.1} mm long; {told}", length * 1e3))
}
