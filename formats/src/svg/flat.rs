//! Flattened pieces over their originals, coloured by the strain of the cloth.

use super::canvas::{Bounds, Canvas, fixed};
use super::labels::Labels;
use crate::report::Language;
use toile_garment::flat::{FlatPiece, StrainMap};
use toile_garment::mesh::PieceMesh;
use toile_garment::{Garment, Piece, Vec2};

const STYLE: &str = "\
path{fill:none;stroke-linejoin:round;vector-effect:non-scaling-stroke}\
.cell{stroke-width:.4px}.original{stroke:#111;stroke-width:1.3px;stroke-dasharray:5 4}.flat{stroke:#0b6b3a;stroke-width:1.6px}\
.dartoriginal{stroke:#7d1a12;stroke-width:1.2px;stroke-dasharray:5 4}.dart{stroke:#d0281c;stroke-width:1.6px}\
.notch{stroke:#7a1fa2;stroke-width:2px}.grain{stroke:#555;stroke-width:1.1px}.scale{stroke:#111;stroke-width:1.4px}\
text{font-family:'DejaVu Sans',Arial,Helvetica,sans-serif;text-anchor:middle;paint-order:stroke;stroke:#fff;\
stroke-width:.2em;stroke-linejoin:round}.label{fill:#333}.name{fill:#111;font-weight:bold}.notchname{fill:#7a1fa2}";

/// Colour steps on each side of zero.
const STEPS: i32 = 10;

/// One flattened piece over its original. `None` when the piece has no mesh that fits.
#[must_use]
pub fn flat_piece(garment: &Garment, flat: &FlatPiece, strain: &StrainMap, language: Language) -> Option<String> {
    let (piece, mesh) = fitting(garment, flat)?;
    let bounds = bounds(mesh, flat)?;
    let size = (bounds.size().x.max(bounds.size().y) / 42.0).clamp(1.0, 40.0);
    let limit = limit(strain);
    let mut canvas = Canvas::default();
    Pen { canvas: &mut canvas, move_by: Vec2::zeros(), size }.piece(piece, mesh, flat, strain, limit);
    Some(finish(canvas, bounds, [size, limit], &piece.name, language))
}

/// All flattened pieces side by side, coloured by the strain that the flat cut has when worn.
#[must_use]
pub fn flat_sheet(garment: &Garment, language: Language) -> Option<String> {
    let flat = garment.flat.as_ref()?;
    let drawn: Vec<_> = flat
        .pieces
        .iter()
        .filter_map(|f| fitting(garment, f).and_then(|(p, m)| Some((p, m, f, bounds(m, f)?))))
        .collect();
    let widest = drawn.iter().map(|d| d.3.size().x).fold(0.0, f64::max);
    let tallest = drawn.iter().map(|d| d.3.size().y).fold(0.0, f64::max);
    let size = (widest.max(tallest) / 40.0).clamp(1.0, 40.0);
    let columns = (drawn.len() as f64).sqrt().ceil().max(1.0);
    let limit = drawn.iter().map(|d| limit(&d.2.flat_strain)).fold(0.005, f64::max);
    let (cell, mut canvas) = (Vec2::new(widest + 4.0 * size, tallest + 5.0 * size), Canvas::default());
    let mut used: Option<Bounds> = None;
    for (k, (piece, mesh, flat, bounds)) in drawn.iter().enumerate() {
        let (column, row) = (k as f64 % columns, (k as f64 / columns).floor());
        let corner = Vec2::new(column * cell.x, -row * cell.y - bounds.size().y);
        let top = corner + bounds.size() + Vec2::new(0.0, 2.0 * size);
        Pen { canvas: &mut canvas, move_by: corner - bounds.min, size }.piece(
            piece,
            mesh,
            flat,
            &flat.flat_strain,
            limit,
        );
        canvas.text("name", Vec2::new(corner.x + 0.5 * bounds.size().x, top.y - size), size, &piece.name);
        used = Bounds::of(used.into_iter().flat_map(|b| [b.min, b.max]).chain([corner, top]));
    }
    Some(finish(canvas, used?, [size, limit], &garment.style, language))
}

fn fitting<'a>(garment: &'a Garment, flat: &FlatPiece) -> Option<(&'a Piece, &'a PieceMesh)> {
    let piece = garment.pieces.get(flat.piece.index())?;
    let mesh = piece.mesh.as_ref()?;
    let n = mesh.rest.len();
    let fits = flat.positions.len() == n && mesh.triangles.iter().flatten().all(|v| (*v as usize) < n);
    fits.then_some((piece, mesh))
}

fn bounds(mesh: &PieceMesh, flat: &FlatPiece) -> Option<Bounds> {
    Bounds::of(mesh.rest.iter().chain(&flat.positions).map(|p| p * 1e3))
}

/// The strain of larger size of warp and weft, per triangle.
fn signed(strain: &StrainMap) -> impl Iterator<Item = f64> + '_ {
    strain.warp.iter().zip(&strain.weft).map(|(a, b)| if a.abs() > b.abs() { *a } else { *b })
}

/// End of the colour scale: the smallest round strain that covers 98 % of the triangles.
fn limit(strain: &StrainMap) -> f64 {
    let mut sizes: Vec<f64> = signed(strain).map(f64::abs).filter(|s| s.is_finite()).collect();
    sizes.sort_unstable_by(f64::total_cmp);
    let high = sizes.get(sizes.len().saturating_mul(98) / 100).or(sizes.last()).copied().unwrap_or(0.0);
    [0.005, 0.01, 0.02, 0.03, 0.05, 0.1, 0.2, 0.5].into_iter().find(|l| *l >= high).unwrap_or(1.0)
}

/// Blue where the cloth is pressed together, white at rest, red where it is stretched.
fn colour(step: i32) -> String {
    let t = f64::from(step.abs()) / f64::from(STEPS);
    let end = if step < 0 { [33.0, 102.0, 172.0] } else { [190.0, 30.0, 45.0] };
    let [r, g, b] = end.map(|e| (247.0 + (e - 247.0) * t).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

struct Pen<'a> {
    canvas: &'a mut Canvas,
    move_by: Vec2,
    size: f64,
}

impl Pen<'_> {
    fn piece(&mut self, piece: &Piece, mesh: &PieceMesh, flat: &FlatPiece, strain: &StrainMap, limit: f64) {
        self.cells(mesh, flat, strain, limit);
        for chain in mesh.chains.iter().filter(|c| c.closed) {
            self.chain("original", &mesh.rest, &chain.vertices, true);
            self.chain("flat", &flat.positions, &chain.vertices, true);
        }
        for legs in piece.darts.iter().filter_map(|d| d.mesh.as_ref()).map(|m| &m.legs) {
            for leg in legs {
                self.chain("dartoriginal", &mesh.rest, leg, false);
                self.chain("dart", &flat.positions, leg, false);
            }
        }
        self.notches(piece, mesh, flat);
        if let Some([a, b]) = piece.grain {
            let line = [self.at(a), self.at(b)];
            let along = (line[1] - line[0]) / (line[1] - line[0]).norm().max(1e-9) * self.size;
            let across = Vec2::new(-along.y, along.x) * 0.4;
            self.canvas.line("grain", &line, false);
            self.canvas.line("grain", &[line[1] - along + across, line[1], line[1] - along - across], false);
        }
    }

    fn at(&self, p: Vec2) -> Vec2 {
        p * 1e3 + self.move_by
    }

    fn chain(&mut self, class: &str, x: &[Vec2], chain: &[u32], closed: bool) {
        let points: Vec<Vec2> = chain.iter().filter_map(|v| x.get(*v as usize)).map(|p| self.at(*p)).collect();
        self.canvas.line(class, &points, closed);
    }

    fn cells(&mut self, mesh: &PieceMesh, flat: &FlatPiece, strain: &StrainMap, limit: f64) {
        let mut bins = vec![Vec::new(); 2 * STEPS as usize + 1];
        for (t, s) in mesh.triangles.iter().zip(signed(strain)) {
            let step = (s / limit * f64::from(STEPS)).round().clamp(-f64::from(STEPS), f64::from(STEPS));
            let bin = if step.is_finite() { (step as i32 + STEPS) as usize } else { STEPS as usize };
            bins[bin].push(t.map(|v| self.at(flat.positions[v as usize])));
        }
        for (bin, cells) in bins.iter().enumerate().filter(|(_, c)| !c.is_empty()) {
            self.canvas.shapes("cell", &colour(bin as i32 - STEPS), cells);
        }
    }

    /// Notches ride on the outline vertex nearest to them.
    fn notches(&mut self, piece: &Piece, mesh: &PieceMesh, flat: &FlatPiece) {
        let Some(outline) = mesh.outline() else { return };
        let mut labels = Labels::default();
        for (notch, label) in piece.notches.iter().zip(piece.notch_labels()) {
            let far = |v: &&u32| mesh.rest.get(**v as usize).map_or(f64::INFINITY, |p| (p - notch.at).norm_squared());
            let Some(v) = outline.vertices.iter().min_by(|a, b| far(a).total_cmp(&far(b))) else { continue };
            let (Some(from), Some(to)) = (mesh.rest.get(*v as usize), flat.positions.get(*v as usize)) else {
                continue;
            };
            let at = self.at(notch.at + (to - from));
            self.canvas.dot("notch", at, 0.25 * self.size);
            let size = 0.7 * self.size;
            let beside =
                [1.1, 2.0].iter().flat_map(|far| [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]].map(|w| (far, w)));
            let places: Vec<Vec2> = beside.map(|(far, w)| at + Vec2::from(w) * (far * size)).collect();
            if let Some(place) = labels.place(&places, &[(0.0, size, &label)]) {
                self.canvas.text("notchname", place, size, &label);
            }
        }
    }
}

fn finish(mut canvas: Canvas, bounds: Bounds, [size, limit]: [f64; 2], title: &str, language: Language) -> String {
    let left = bounds.min - Vec2::new(0.0, 3.0 * size);
    let width = bounds.size().x.max(24.0 * size);
    canvas.scale_bar(left, 0.5 * width, size);
    let bar = left - Vec2::new(0.0, 3.2 * size);
    let step = width.min(30.0 * size) / f64::from(2 * STEPS + 1);
    for k in -STEPS..=STEPS {
        let at = bar + Vec2::new(f64::from(k + STEPS) * step, 0.0);
        canvas.rect("key", &colour(k), at, Vec2::new(step, size));
    }
    for (k, words) in [(0.0, -limit), (0.5, 0.0), (1.0, limit)] {
        let at = bar + Vec2::new((0.06 + 0.88 * k) * step * f64::from(2 * STEPS + 1), -0.8 * size);
        canvas.text("label", at, 0.9 * size, &format!("{} %", fixed(100.0 * words, 1)));
    }
    let key = bar - Vec2::new(0.0, 3.0 * size);
    let entries = [("original", "original"), ("flat", "flattened"), ("dart", "dart"), ("notch", "notch")];
    for (k, (class, words)) in entries.into_iter().enumerate() {
        let at = key + Vec2::new((k % 2) as f64 * 12.0 * size, -((k / 2) as f64) * 1.6 * size);
        canvas.line(class, &[at, at + Vec2::new(3.0 * size, 0.0)], false);
        canvas.text("label", at + Vec2::new(6.6 * size, 0.0), 0.9 * size, language.say(words));
    }
    let all = Bounds {
        min: Vec2::new(bounds.min.x, key.y - 2.5 * size),
        max: bounds.max.sup(&(bounds.min + Vec2::new(width, 0.0))),
    };
    canvas.finish(all.grown(1.5 * size), title, STYLE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_run_from_blue_over_white_to_red() {
        assert_eq!(
            (colour(-STEPS).as_str(), colour(0).as_str(), colour(STEPS).as_str()),
            ("#2166ac", "#f7f7f7", "#be1e2d")
        );
    }

    #[test]
    fn the_scale_covers_the_strain() {
        let map = StrainMap { warp: vec![0.001, -0.018, 0.0], weft: vec![0.002, 0.004, 0.0], shear: vec![0.0; 3] };
        assert_eq!(signed(&map).collect::<Vec<_>>(), vec![0.002, -0.018, 0.0]);
        assert_eq!(limit(&map), 0.02);
        assert_eq!(limit(&StrainMap::default()), 0.005);
    }
}
