//! The pieces around the body as they are before they are sewn, seen from three sides, with threads where seams will be.

use super::colour::colour;
use super::on_body::fine;
use crate::new::dress::Dressed;
use std::fmt::Write as _;
use toile_formats::svg::canvas::escape as escaped;
use toile_garment::body::Body;
use toile_garment::{Garment, Piece, Vec2, Vec3};
use toile_stages::body::Slices;
use toile_stages::proposal::Proposal;
use toile_stages::roles::PiecePoint;

/// Pixels for a metre.
const SCALE: f64 = 330.0;
/// Room around a view, pixels.
const EDGE: f64 = 12.0;
/// Distance of the rows of which the picture of the body consists, m.
const ROW: f64 = 0.008;

/// A side from which the garment is seen: its name, the direction to the right of the picture, and the one to the eye.
struct View {
    name: &'static str,
    right: Vec3,
    to_eye: Vec3,
}

impl View {
    fn all() -> [Self; 3] {
        let view = |name, right, to_eye| Self { name, right, to_eye };
        [
            view("from the front", Vec3::x(), Vec3::z()),
            view("from the left", -Vec3::z(), Vec3::x()),
            view("from behind", -Vec3::x(), -Vec3::z()),
        ]
    }

    fn at(&self, p: Vec3) -> Vec2 {
        Vec2::new(p.dot(&self.right), p.y)
    }
}

/// A piece in space: outline, and stretches of seams with the number of the seam.
struct Placed<'a> {
    piece: &'a Piece,
    outline: Vec<Vec3>,
    seams: Vec<(usize, Vec<Vec3>)>,
}

/// The views; empty where no piece has a place.
pub fn views(garment: &Garment, proposal: &Proposal, dressed: &Dressed, body: Option<&Body>) -> String {
    let pieces = placed(garment, proposal, dressed);
    if pieces.is_empty() {
        return String::new();
    }
    let mut out = String::new();
    let threads = threads(dressed);
    View::all().iter().for_each(|view| draw(&mut out, view, &pieces, &threads, body));
    out
}

fn placed<'a>(garment: &'a Garment, proposal: &Proposal, dressed: &Dressed) -> Vec<Placed<'a>> {
    let one = |(index, piece): (usize, &'a Piece)| {
        let sheet = &dressed.arrangement.places.get(index)?.as_ref()?.sheet;
        let line = |points: Vec<Vec2>| fine(&points).into_iter().map(|p| sheet.at(p)).collect::<Vec<Vec3>>();
        let mut outline = piece.outline.positions();
        outline.extend(outline.first().copied());
        let runs = proposal.seams.iter().enumerate().flat_map(|(k, s)| s.a.iter().chain(&s.b).map(move |r| (k, r)));
        let seams = runs.filter(|(_, r)| r.piece == index).map(|(k, r)| (k, line(r.points.clone()))).collect();
        Some(Placed { piece, outline: line(outline), seams })
    };
    garment.pieces.iter().enumerate().filter_map(one).collect()
}

/// Pairs of points that are sewn to each other, with the number of their seam.
fn threads(dressed: &Dressed) -> Vec<(usize, [Vec3; 2])> {
    let at = |p: &PiecePoint| Some(dressed.arrangement.places.get(p.piece)?.as_ref()?.sheet.at(p.at));
    let of = |(k, pairs): (usize, &Vec<[PiecePoint; 2]>)| {
        pairs.iter().filter_map(|[a, b]| Some((k, [at(a)?, at(b)?]))).collect::<Vec<_>>()
    };
    dressed.joins.iter().map(|j| &j.pairs).enumerate().flat_map(of).collect()
}

fn draw(out: &mut String, view: &View, pieces: &[Placed<'_>], threads: &[(usize, [Vec3; 2])], body: Option<&Body>) {
    let solid = body.map_or(&[][..], |b| b.positions.as_slice());
    let all = pieces.iter().flat_map(|p| &p.outline).chain(solid).map(|p| view.at(*p));
    let far = Vec2::repeat(f64::INFINITY);
    let (low, high) = all.fold((far, -far), |(low, high), p| (low.inf(&p), high.sup(&p)));
    let pixel = |p: Vec2| (EDGE + (p.x - low.x) * SCALE, EDGE + (high.y - p.y) * SCALE);
    let path = |points: &[Vec3]| {
        points.iter().map(|p| pixel(view.at(*p))).map(|(x, y)| format!("{x:.1},{y:.1} ")).collect::<String>()
    };
    let size = (high - low) * SCALE;
    let _ = writeln!(
        out,
        "<figure><figcaption>{}</figcaption>\n<svg viewBox=\"0 0 {:.0} {:.0}\" role=\"img\" aria-label=\"{}\">",
        view.name,
        size.x + 2.0 * EDGE,
        size.y + 2.0 * EDGE,
        view.name
    );
    // What lies behind the body is drawn before it.
    let depth = |p: &Placed<'_>| p.outline.iter().map(|q| q.dot(&view.to_eye)).sum::<f64>() / p.outline.len() as f64;
    let mut order: Vec<&Placed<'_>> = pieces.iter().collect();
    order.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
    let (behind, before) = order.split_at(order.partition_point(|p| depth(p) <= 0.0));
    behind.iter().for_each(|placed| draw_piece(out, placed, path));
    silhouette(out, view, body, pixel);
    before.iter().for_each(|placed| draw_piece(out, placed, path));
    for (k, ends) in threads {
        let _ = writeln!(
            out,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\".8\" stroke-opacity=\".7\"/>",
            path(ends),
            colour(*k)
        );
    }
    out.push_str("</svg></figure>\n");
}

fn draw_piece(out: &mut String, placed: &Placed<'_>, path: impl Fn(&[Vec3]) -> String) {
    let _ = writeln!(
        out,
        "<polygon points=\"{}\" fill=\"#f7f5ef\" fill-opacity=\".82\" stroke=\"#888\"><title>{}</title></polygon>",
        path(&placed.outline),
        escaped(&placed.piece.name)
    );
    for (k, line) in &placed.seams {
        let _ = writeln!(
            out,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"3\"/>",
            path(line),
            colour(*k)
        );
    }
}

/// The body as rows, each as wide as it is seen.
fn silhouette(out: &mut String, view: &View, body: Option<&Body>, pixel: impl Fn(Vec2) -> (f64, f64)) {
    let Some(body) = body else { return };
    let slices = Slices::new(body);
    let mut rows = String::new();
    for k in 0..(slices.height / ROW) as usize {
        let y = slices.low + (k as f64 + 0.5) * ROW;
        for section in slices.cut(y) {
            let (near, far) = section.bounds();
            let (x, bottom) = pixel(Vec2::new(view.at(near).x.min(view.at(far).x), y - 0.5 * ROW));
            let (to, top) = pixel(Vec2::new(view.at(near).x.max(view.at(far).x), y + 0.6 * ROW));
            let _ = write!(rows, "M{x:.1} {bottom:.1}H{to:.1}V{top:.1}H{x:.1}Z");
        }
    }
    let _ = writeln!(out, "<path d=\"{rows}\" fill=\"#d9dde6\"/>");
}
