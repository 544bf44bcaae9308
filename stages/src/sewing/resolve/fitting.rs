//! The remedy where a seam names the wrong edge: free edges of the garment that are as long as one of its sides, and sides
//! of other seams that do not fit their own.

use super::lengths::WRONG_EDGE;
use super::{Found, ResolvedSeam, Side};
use crate::sewing::edges::{Edge, edges};
use crate::sewing::shapes::Shapes;
use toile_garment::Garment;

/// Most edges that are named for one side.
const NAMED: usize = 3;

/// Words for the edges that would fit the sides of this seam; `None` where its own sides may well be meant, and where no
/// edge would.
pub fn fitting(garment: &Garment, shapes: &Shapes, all: &[Found], seam: &ResolvedSeam, limit: f64) -> Option<String> {
    let (a, b) = (seam.a.length, seam.b.length);
    if (a - b).abs() <= WRONG_EDGE * a.min(b) {
        return None;
    }
    let seams = || all.iter().filter_map(|f| f.seam.as_ref().ok());
    let on = |side: &Side, e: &Edge| !side.find(shapes, e.piece, 0, e.middle).is_empty();
    let are_apart = |s: &ResolvedSeam| (s.a.length - s.b.length).abs() > WRONG_EDGE * s.a.length.min(s.b.length);
    let others: Vec<(&str, f64)> = seams()
        .filter(|s| s.name != seam.name && are_apart(s))
        .flat_map(|s| [&s.a, &s.b].map(|side| (s.name.as_str(), side.length)))
        .collect();
    let is_free = |e: &Edge| !seams().any(|s| on(&s.a, e) || on(&s.b, e));
    let free: Vec<Edge> = edges(garment, shapes).into_iter().filter(is_free).collect();
    let of = |side: &Side| -> Option<String> {
        let mut fits: Vec<&Edge> =
            free.iter().filter(|e| (e.length - side.length).abs() <= limit * side.length.min(e.length)).collect();
        fits.sort_by(|x, y| (x.length - side.length).abs().total_cmp(&(y.length - side.length).abs()));
        let as_long = |length: f64| (length - side.length).abs() <= limit * side.length.min(length);
        let exchanged = others.iter().filter(|(_, length)| as_long(*length));
        let named: Vec<String> = fits
            .iter()
            .map(|e| format!("`{}` ({:.1} mm)", e.name, e.length * 1e3))
            .chain(exchanged.map(|(name, length)| format!("a side of seam `{name}` ({:.1} mm)", length * 1e3)))
            .take(NAMED)
            .collect();
        (!named.is_empty()).then(|| format!("to {:.1} mm fits {}", side.length * 1e3, named.join(", ")))
    };
    let fits: Vec<String> = [&seam.a, &seam.b].into_iter().filter_map(of).collect();
    (!fits.is_empty()).then(|| fits.join("; "))
}
