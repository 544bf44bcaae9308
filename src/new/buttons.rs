//! The tables of fronts that are closed by buttons: facings that are folded in, and a short seam for every button.

use super::sewing::point;
use std::fmt::Write as _;
use toile_garment::Garment;
use toile_garment::text::quoted;
use toile_stages::proposal::{ButtonFront, button_fronts};

/// Length of a buttonhole, metres.
const BUTTONHOLE: f64 = 12e-3;
/// Likelihood that holes on the centre line are those of buttons.
const SURE: f64 = 0.8;

/// The tables of a garment.
pub fn text(garment: &Garment) -> String {
    let fronts = button_fronts(garment);
    let copies = garment.plan.copies.iter().filter(|c| c.mirror);
    let of = |name: &str| fronts.iter().find(|f| garment.pieces[f.piece].name == name);
    copies.filter_map(|copy| Some(front(&copy.piece, &copy.name, of(&copy.piece)?))).collect()
}

/// The tables of one front and its copy. The copy has the mirror images of folds and lines.
fn front(piece: &str, copy: &str, front: &ButtonFront) -> String {
    let mut out = String::new();
    if let Some([from, to]) = front.fold {
        let (from, to) = (point(from), point(to));
        let piece = quoted(piece);
        let _ = write!(
            out,
            "\n# The facing is folded in.\n[[fold]]\npiece = {piece}\nname = \"facing\"\nline = [{from}, {to}]\nangle = \"180 deg\"\n"
        );
    }
    for (k, at) in (1..).zip(&front.buttons) {
        let half = front.along * (0.5 * BUTTONHOLE);
        let (from, to, piece) = (point(at - half), point(at + half), quoted(piece));
        let _ = write!(out, "\n[[edge]]\npiece = {piece}\nname = \"button-{k}\"\nline = [{from}, {to}]\n");
    }
    for k in 1..=front.buttons.len() {
        let [a, b] = [piece, copy].map(|name| quoted(&format!("{name}.button-{k}")));
        let _ = write!(out, "\n[[seam]]\nname = \"button {k}\"\na = {a}\nb = {b}\nproposed = {SURE:.2}\n");
    }
    out
}
