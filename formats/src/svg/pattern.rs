//! The pattern as `toile inspect --svg` draws it: pieces side by side with numbered edges.

use super::canvas::{Bounds, Canvas, fixed};
use super::labels::{Labels, letters, room};
use super::spots::{self, SPOT_STYLE, Spot};
use crate::report::{Language, pick_name};
use toile_garment::dart::{Dart, DartKind};
use toile_garment::outline::{OutlineEdge, PieceLine};
use toile_garment::seam::Seam;
use toile_garment::{Garment, Piece, Vec2};

const STYLE: &str = "\
path{fill:none;stroke-linejoin:round;vector-effect:non-scaling-stroke}\
.cloth{fill:#fbf8f1;stroke:none}.cut{stroke:#111;stroke-width:1.6px}.sew{stroke:#1a56b0;stroke-width:1.2px;stroke-dasharray:6 3}\
.internal{stroke:#2c7a4b;stroke-width:1.1px;stroke-dasharray:8 3 2 3}.cutout{fill:#fff;stroke:#111;stroke-width:1.4px}\
.dart{stroke:#c0261c;stroke-width:1.5px}.dartfill{fill:#f6d9d5;stroke:none}.notch{stroke:#7a1fa2;stroke-width:2px}\
.grain{stroke:#555;stroke-width:1.2px}.fold{stroke:#555;stroke-width:1px;stroke-dasharray:12 3 2 3 2 3}.scale{stroke:#111;stroke-width:1.4px}\
.corner{fill:#111}.apex{fill:#c0261c}.drill{fill:#fff;stroke:#111;stroke-width:1.2px;vector-effect:non-scaling-stroke}\
text{font-family:'DejaVu Sans',Arial,Helvetica,sans-serif;text-anchor:middle;paint-order:stroke;stroke:#fff;stroke-width:.25em;stroke-linejoin:round}\
.label{fill:#333}.name{fill:#111;font-weight:bold}.edge{fill:#0b3d91}.dartname{fill:#a01810}.notchname{fill:#7a1fa2}";

/// The way of every edge, which a person needs who writes a sewing file.
const WAY_STYLE: &str = ".way{stroke:#0b3d91;stroke-width:1.2px}";

/// Seams are seen when they are picked, and take clicks near them.
const SEAM_STYLE: &str = "\
.seam{stroke:#e8590c;stroke-width:9px;stroke-opacity:0;stroke-linecap:round;pointer-events:stroke;cursor:pointer}\
.picked .seam{stroke-opacity:.85;stroke-width:5px}[data-pick]{cursor:pointer}.picked>.cloth{fill:#ffe2cc}\
.picked>.notch{stroke-width:6px}.picked>.notchname{font-weight:bold}";

/// Height of the label of a notch beside that of an edge.
const NOTCH_TEXT: f64 = 0.75;
/// How far before its tip the label of a notch may stand, in heights of its text.
const NOTCH_PLACES: [f64; 3] = [0.2, 0.8, 1.4];
/// Places that are tried for the number of an edge, as shares of its length.
const EDGE_PLACES: [f64; 7] = [0.5, 0.42, 0.58, 0.34, 0.66, 0.25, 0.75];
/// Places that are tried for the label of a dart on each of its three ways.
const DART_PLACES: i32 = 6;
/// Steps that the name of a piece may lie beside its middle, each way.
const NAME_PLACES: i32 = 10;
/// Points of an outline that are looked at to find room for a name.
const NAME_POINTS: usize = 500;

/// Draws pieces side by side: cut and sew line, numbered edges, darts, notches, grain, drill holes, internal lines.
#[must_use]
pub fn pattern(pieces: &[Piece], title: &str) -> String {
    pattern_in(pieces, title, Language::English)
}

/// The same in a language.
#[must_use]
pub fn pattern_in(pieces: &[Piece], title: &str, language: Language) -> String {
    sheet(pieces, None, &[], title, language)
}

/// Draws the pattern of a garment so that pieces, seams and darts can be picked in a page: groups with `data-pick`
/// `piece:NUMBER` and `seam:NUMBER`. Marked places have names of their own.
#[must_use]
pub fn pickable(garment: &Garment, spots: &[Spot<'_>], language: Language) -> String {
    sheet(&garment.pieces, Some(&garment.seams), spots, &garment.style, language)
}

fn sheet(pieces: &[Piece], picks: Option<&[Seam]>, spots: &[Spot<'_>], title: &str, language: Language) -> String {
    let boxes: Vec<Option<Bounds>> = pieces.iter().map(bounds).collect();
    let size = text_size(&boxes);
    // Where a name has no room on its piece, there is room for it below.
    let beside = |(piece, bounds): (&Piece, &Option<Bounds>)| bounds.map(|b| with_name(piece, b, size, language));
    let boxes: Vec<Option<Bounds>> = pieces.iter().zip(&boxes).map(beside).collect();
    let (places, sheet) = shelves(&boxes, 6.0 * size);
    let mut canvas = Canvas::default();
    for (k, ((piece, bounds), place)) in pieces.iter().zip(&boxes).zip(&places).enumerate() {
        if let (Some(bounds), Some(place)) = (bounds, place) {
            let number = picks.is_some().then_some(k);
            if picks.is_some() {
                canvas.open(&format!("piece:{k}"));
            }
            let (move_by, labels) = (place - bounds.min, Labels::default());
            let mut pen = Pen { canvas: &mut canvas, move_by, size, labels, language, number };
            pen.piece(piece);
            if picks.is_some() {
                canvas.close();
            } else {
                piece.edges.iter().for_each(|e| pen.way(piece, e));
            }
        }
    }
    for (k, seam) in picks.unwrap_or_default().iter().enumerate() {
        canvas.open(&format!("seam:{k}"));
        for run in [&seam.a, &seam.b].into_iter().flat_map(|side| &side.runs) {
            let i = run.piece.index();
            let mesh = pieces.get(i).and_then(|p| p.mesh.as_ref());
            let by = boxes.get(i).zip(places.get(i)).and_then(|(b, p)| Some(p.as_ref()? - b.as_ref()?.min));
            if let (Some(mesh), Some(by)) = (mesh, by) {
                let points = run.vertices.iter().filter_map(|v| mesh.rest.get(*v as usize));
                canvas.line("seam", &points.map(|p| mm(*p) + by).collect::<Vec<_>>(), false);
            }
        }
        canvas.close();
    }
    let moved = |i: usize, at: Vec2| Some(mm(at) + (places.get(i)?.as_ref()? - boxes.get(i)?.as_ref()?.min));
    spots::draw(&mut canvas, spots, size, moved);
    let sheet = spots::room(sheet, spots, size);
    let foot = Vec2::new(sheet.min.x + size, sheet.min.y - 3.5 * size);
    canvas.scale_bar(foot, 0.4 * sheet.size().x, size);
    let at = Vec2::new(sheet.min.x + size, foot.y - 2.4 * size);
    let legend = legend(&mut canvas, at, sheet.size().x, size, picks.is_none(), language);
    let all = Bounds { min: Vec2::new(sheet.min.x, legend), ..sheet };
    let style =
        if picks.is_none() { format!("{STYLE}{WAY_STYLE}") } else { format!("{STYLE}{SEAM_STYLE}{SPOT_STYLE}") };
    canvas.finish(all.grown(2.0 * size), title, &style)
}

/// The move from the coordinates of each piece to its place beside the others, metres; `None` for a piece without points.
pub(crate) fn places(pieces: &[Piece]) -> Vec<Option<Vec2>> {
    let boxes: Vec<Option<Bounds>> = pieces.iter().map(bounds).collect();
    let (places, _) = shelves(&boxes, 6.0 * text_size(&boxes));
    boxes.iter().zip(places).map(|(bounds, place)| Some((place? - bounds.as_ref()?.min) * 1e-3)).collect()
}

fn mm(p: Vec2) -> Vec2 {
    p * 1e3
}

fn lines(piece: &Piece) -> impl Iterator<Item = &PieceLine> {
    std::iter::once(&piece.outline).chain(&piece.cut_line).chain(&piece.internal_lines).chain(&piece.cutouts)
}

fn bounds(piece: &Piece) -> Option<Bounds> {
    let marks = piece.darts.iter().flat_map(|d| d.legs.iter().flatten().copied());
    let notches = piece.notches.iter().map(|n| n.at);
    Bounds::of(lines(piece).flat_map(|l| l.points.iter().map(|p| p.at)).chain(marks).chain(notches).map(mm))
}

/// Height of text so that about a hundred lines fit the sheet: legible on a screen at full width.
fn text_size(boxes: &[Option<Bounds>]) -> f64 {
    let area: f64 = boxes.iter().flatten().map(|b| b.size().x * b.size().y).sum();
    (area.sqrt() / 62.0).clamp(1.5, 40.0)
}

/// Lower left corner of each piece on shelves, top shelf first, and the sheet they fill.
fn shelves(boxes: &[Option<Bounds>], gap: f64) -> (Vec<Option<Vec2>>, Bounds) {
    let sizes = || boxes.iter().flatten().map(Bounds::size);
    let area: f64 = sizes().map(|s| (s.x + gap) * (s.y + gap)).sum();
    let width = sizes().map(|s| s.x + gap).fold((1.9 * area).sqrt(), f64::max);
    let (mut x, mut y, mut height, mut widest) = (0.0, 0.0, 0.0f64, 1.0f64);
    let mut places = Vec::new();
    for bounds in boxes {
        let Some(size) = bounds.as_ref().map(Bounds::size) else {
            places.push(None);
            continue;
        };
        if x > 0.0 && x + size.x > width {
            (x, y, height) = (0.0, y - height - gap, 0.0);
        }
        places.push(Some(Vec2::new(x, y - size.y)));
        widest = widest.max(x + size.x);
        height = height.max(size.y);
        x += size.x + gap;
    }
    (places, Bounds { min: Vec2::new(0.0, y - height), max: Vec2::new(widest, 0.0) })
}

struct Pen<'a> {
    canvas: &'a mut Canvas,
    move_by: Vec2,
    size: f64,
    labels: Labels,
    language: Language,
    /// The number of the piece, where a page can pick it.
    number: Option<usize>,
}

impl Pen<'_> {
    fn at(&self, p: Vec2) -> Vec2 {
        mm(p) + self.move_by
    }

    fn line(&mut self, class: &str, line: &PieceLine) {
        let points: Vec<Vec2> = line.points.iter().map(|p| self.at(p.at)).collect();
        self.canvas.line(class, &points, line.closed);
    }

    /// Draws a piece. Gives the room that its name takes below it, where it has none on the piece.
    fn piece(&mut self, piece: &Piece) -> Option<Bounds> {
        let cut = piece.cut_line.as_ref().unwrap_or(&piece.outline);
        self.line("cloth", cut);
        piece.cutouts.iter().for_each(|l| self.line("cutout", l));
        piece.darts.iter().for_each(|d| self.dart_area(d));
        self.line("cut", cut);
        if piece.cut_line.is_some() {
            self.line("sew", &piece.outline);
        }
        piece.internal_lines.iter().for_each(|l| self.line("internal", l));
        self.grain(piece);
        // The numbers of the edges come first; the other labels make room for them.
        let numbers: Vec<(Vec2, String)> = piece.edges.iter().filter_map(|e| self.edge_label(piece, e)).collect();
        let marks = piece.drill_holes.iter().map(|h| h.at).chain(piece.darts.iter().flat_map(|d| d.apexes.clone()));
        for at in marks.map(|p| self.at(p)).collect::<Vec<_>>() {
            self.labels.take_mark(at, 0.7 * self.size);
        }
        for (k, label) in piece.notch_labels().iter().enumerate() {
            self.notch(piece, k, label);
        }
        piece.darts.iter().for_each(|d| self.dart(d));
        piece.drill_holes.iter().for_each(|h| self.drill(h.at));
        piece.edges.iter().for_each(|e| self.corner(piece, e));
        numbers.iter().for_each(|(at, label)| self.canvas.text("edge", *at, self.size, label));
        self.name(piece)
    }

    fn dart_area(&mut self, dart: &Dart) {
        if dart.kind == DartKind::Pleat {
            return;
        }
        let back = dart.legs[1].iter().rev();
        let area: Vec<Vec2> = dart.legs[0].iter().chain(back).map(|p| self.at(*p)).collect();
        self.canvas.line("dartfill", &area, true);
    }

    fn dart(&mut self, dart: &Dart) {
        for leg in &dart.legs {
            let points: Vec<Vec2> = leg.iter().map(|p| self.at(*p)).collect();
            self.canvas.line("dart", &points, false);
        }
        for apex in &dart.apexes {
            let at = self.at(*apex);
            self.canvas.dot("apex", at, 0.3 * self.size);
        }
        let middle = (dart.mouth[0] + dart.mouth[1]) * 0.5;
        let Some(apex) = dart.apexes.first() else { return };
        let beyond = (apex - middle) * 1e3;
        let along = beyond / beyond.norm().max(1e-9) * self.size;
        let first = match dart.kind {
            DartKind::FishEye => self.at(middle),
            _ => self.at(*apex) + along * 2.6,
        };
        let label = format!("{} {} mm", dart.name, fixed(1e3 * dart.intake(), 1));
        let size = 0.85 * self.size;
        let step = Vec2::new(0.0, 1.2 * size);
        let aside =
            |k: i32| [first + along * (1.3 * f64::from(k)), first + step * f64::from(k), first - step * f64::from(k)];
        let places: Vec<Vec2> = (0..DART_PLACES).flat_map(aside).collect();
        let at = self.labels.place(&places, &[(0.0, size, &label)]).unwrap_or(first);
        self.canvas.text("dartname", at, size, &label);
    }

    /// A notch with its label, which a page can pick.
    fn notch(&mut self, piece: &Piece, number: usize, label: &str) {
        let notch = &piece.notches[number];
        let inward = match notch.angle {
            Some(a) => Vec2::new(libm::cos(a), libm::sin(a)),
            None => inward_normal(piece.cut_line.as_ref().unwrap_or(&piece.outline), notch.at),
        };
        let (at, length) = (self.at(notch.at), (1e3 * notch.depth).max(0.9 * self.size));
        let (tip, side) = (at + inward * length, Vec2::new(-inward.y, inward.x) * (0.3 * self.size));
        if let Some(p) = self.number {
            self.canvas.open(&pick_name((p, number)));
        }
        use toile_garment::notch::NotchKind as Kind;
        match notch.kind {
            Kind::Slit => self.canvas.line("notch", &[at, tip], false),
            Kind::V | Kind::Check => self.canvas.line("notch", &[at + side, tip, at - side], false),
            Kind::T => self.canvas.line("notch", &[at, tip, tip + side, tip - side], false),
            Kind::Castle | Kind::U => {
                self.canvas.line("notch", &[at + side, tip + side, tip - side, at - side], false);
            }
        }
        self.notch_label(tip, inward, label);
        if self.number.is_some() {
            self.canvas.close();
        }
    }

    /// The label of a notch: before its tip, else beside it, else a little deeper in the cloth.
    fn notch_label(&mut self, tip: Vec2, inward: Vec2, label: &str) {
        let size = NOTCH_TEXT * self.size;
        let half = Vec2::new(0.31 * letters(label), 0.5) * size;
        let away = |far: f64| inward * ((half.x * inward.x.abs() + half.y * inward.y.abs()) + far * size);
        let along = Vec2::new(-inward.y, inward.x);
        let beside = along * (half.x * along.x.abs() + half.y * along.y.abs() + 0.3 * size);
        // First as near to the tip as may be: deep in a narrow piece a label would stand at a notch of the other side.
        let near = NOTCH_PLACES.into_iter().flat_map(|far| [0.0, 1.0, -1.0, 2.0, -2.0].map(|side| (far, side)));
        let places: Vec<Vec2> = near.map(|(far, side)| tip + away(far) + beside * side).collect();
        let at = self.labels.place(&places, &[(0.0, size, label)]).unwrap_or(tip);
        self.canvas.text("notchname", at, size, label);
    }

    fn drill(&mut self, at: Vec2) {
        let (at, r) = (self.at(at), 0.4 * self.size);
        self.canvas.dot("drill", at, r);
        for arm in [Vec2::new(1.6 * r, 0.0), Vec2::new(0.0, 1.6 * r)] {
            self.canvas.line("scale", &[at - arm, at + arm], false);
        }
    }

    fn grain(&mut self, piece: &Piece) {
        if let Some([a, b]) = piece.fold {
            let line = [self.at(a), self.at(b)];
            self.canvas.line("fold", &line, false);
        }
        let Some([a, b]) = piece.grain else { return };
        let (a, b) = (self.at(a), self.at(b));
        let along = (b - a) / (b - a).norm().max(1e-9) * self.size;
        let across = Vec2::new(-along.y, along.x) * 0.4;
        self.canvas.line("grain", &[a, b], false);
        self.canvas.line("grain", &[b - along + across, b, b - along - across], false);
    }

    fn corner(&mut self, piece: &Piece, edge: &OutlineEdge) {
        let Some(from) = piece.outline.points.get(edge.from as usize) else { return };
        let corner = self.at(from.at);
        self.canvas.dot("corner", corner, 0.22 * self.size);
    }

    /// The label of an edge and its place, inside the cloth: at its middle, on a narrow piece beside that.
    fn edge_label(&mut self, piece: &Piece, edge: &OutlineEdge) -> Option<(Vec2, String)> {
        let label = edge.name.as_ref().map_or_else(|| edge.index.to_string(), |n| format!("{} {n}", edge.index));
        let place = |share: f64| {
            let (at, inward) = on_edge(&piece.outline, edge, share)?;
            let away = 1.1 + 0.28 * letters(&label) * inward.x.abs();
            Some(self.at(at) + inward * (away * self.size))
        };
        let places: Vec<Vec2> = EDGE_PLACES.into_iter().filter_map(place).collect();
        Some((self.labels.place(&places, &[(0.0, self.size, &label)])?, label))
    }

    /// An arrow in the middle of an edge.
    fn way(&mut self, piece: &Piece, edge: &OutlineEdge) {
        let Some((middle, inward)) = on_edge(&piece.outline, edge, 0.5) else { return };
        let (tip, along) = (self.at(middle), Vec2::new(inward.y, -inward.x) * (0.45 * self.size));
        let across = inward * (0.25 * self.size);
        self.canvas.line("way", &[tip - along + across, tip, tip - along - across], false);
    }

    /// Name, cut and area in the middle of a piece, or as near to it as there is room; where there is none, below it.
    fn name(&mut self, piece: &Piece) -> Option<Bounds> {
        let bounds = bounds(piece)?;
        let q = piece.quantity;
        let size = piece.size.as_ref().map(|s| self.language.fill("size {0}", std::slice::from_ref(s)));
        let words = if q.mirrored > 0 { "cut {0} + {1} mirrored" } else { "cut {0}" };
        let cut = self.language.fill(words, &[q.plain, q.mirrored].map(|n| n.to_string()));
        let cut = size.into_iter().chain([cut]).collect::<Vec<_>>().join(", ");
        let area = format!("{} cm²", fixed(1e4 * piece.cloth_area(), 1));
        let (below, small) = (-1.4 * self.size, 0.85 * self.size);
        let lines = [(0.0, 1.15 * self.size, piece.name.as_str()), (below, small, &cut), (1.9 * below, small, &area)];
        let centre = (bounds.min + bounds.max) * 0.5 + self.move_by;
        let points = &piece.outline.points;
        let rough = points.iter().step_by(points.len().div_ceil(NAME_POINTS).max(1));
        let line: Vec<Vec2> = rough.map(|p| self.at(p.at)).collect();
        let places = around(centre, bounds.size(), 1.3 * self.size);
        let inside = self.labels.free(&places, &lines, |room| is_inside(&line, room));
        let under = Vec2::new(centre.x, self.move_by.y + bounds.min.y - 1.6 * self.size);
        let at = inside.unwrap_or(under);
        for ((above, size, text), class) in lines.into_iter().zip(["name", "label", "label"]) {
            self.canvas.text(class, at + Vec2::new(0.0, above), size, text);
        }
        inside.is_none().then(|| room(at, &lines))
    }
}

/// The box of a piece, with its name where that stands below it.
fn with_name(piece: &Piece, bounds: Bounds, size: f64, language: Language) -> Bounds {
    let (mut canvas, move_by, labels) = (Canvas::default(), Vec2::zeros(), Labels::default());
    let below = Pen { canvas: &mut canvas, move_by, size, labels, language, number: None }.piece(piece);
    let all = [Some(bounds), below].into_iter().flatten().flat_map(|b| [b.min, b.max]);
    Bounds::of(all).unwrap_or(bounds)
}

/// Does a rectangle lie inside a closed line? Its corners and the middles of its sides are looked at.
fn is_inside(line: &[Vec2], room: &Bounds) -> bool {
    let (low, high, middle) = (room.min, room.max, (room.min + room.max) * 0.5);
    let xs = [low.x, middle.x, high.x];
    xs.into_iter().flat_map(|x| [low.y, middle.y, high.y].map(|y| Vec2::new(x, y))).all(|p| holds(line, p))
}

/// Does a closed line hold a point?
fn holds(line: &[Vec2], p: Vec2) -> bool {
    let next = line.iter().cycle().skip(1);
    let crosses =
        |(a, b): &(&Vec2, &Vec2)| (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) * (b.x - a.x) / (b.y - a.y);
    line.iter().zip(next).filter(crosses).count() % 2 == 1
}

/// Places around the middle of a rectangle, the nearest first, within its middle part.
fn around(centre: Vec2, size: Vec2, step: f64) -> Vec<Vec2> {
    let count = |length: f64| ((0.45 * length / step) as i32).min(NAME_PLACES);
    let (wide, high) = (count(size.x), count(size.y));
    let mut steps: Vec<(i32, i32)> = (-high..=high).flat_map(|y| (-wide..=wide).map(move |x| (x, y))).collect();
    steps.sort_by_key(|(x, y)| (x * x + y * y, *y, *x));
    steps.into_iter().map(|(x, y)| centre + Vec2::new(f64::from(x), f64::from(y)) * step).collect()
}

/// The point of an edge at a share of its length, and the direction into the cloth (the left of a counter-clockwise
/// outline).
fn on_edge(outline: &PieceLine, edge: &OutlineEdge, share: f64) -> Option<(Vec2, Vec2)> {
    let n = outline.points.len();
    let (from, to) = (edge.from as usize, edge.to as usize);
    if from >= n || to >= n {
        return None;
    }
    let count = if to > from { to - from } else { to + n - from };
    let point = |k: usize| outline.points[(from + k) % n].at;
    let total: f64 = (0..count).map(|k| (point(k + 1) - point(k)).norm()).sum();
    let mut left = share * total;
    for k in 0..count {
        let step = point(k + 1) - point(k);
        let length = step.norm();
        if left <= length && length > 0.0 {
            let along = step / length;
            return Some((point(k) + along * left, Vec2::new(-along.y, along.x)));
        }
        left -= length;
    }
    None
}

/// Direction into the cloth at the segment of a closed line nearest to a point.
#[must_use]
pub fn inward_normal(line: &PieceLine, at: Vec2) -> Vec2 {
    let n = line.points.len();
    let mut best = (f64::INFINITY, Vec2::new(0.0, 1.0));
    for k in 0..n {
        let (a, b) = (line.points[k].at, line.points[(k + 1) % n].at);
        let step = b - a;
        let t = ((at - a).dot(&step) / step.norm_squared().max(1e-18)).clamp(0.0, 1.0);
        let far = (at - a - step * t).norm();
        if far < best.0 && step.norm() > 0.0 {
            best = (far, Vec2::new(-step.y, step.x) / step.norm());
        }
    }
    if line.signed_area() < 0.0 { -best.1 } else { best.1 }
}

/// Draws the key in rows; gives the lowest y it used.
fn legend(canvas: &mut Canvas, at: Vec2, width: f64, size: f64, has_ways: bool, language: Language) -> f64 {
    let entries = [
        ("cut", "cut line"),
        ("sew", "sew line"),
        ("internal", "internal line"),
        ("dart", "dart, width of mouth"),
        ("notch", "notch"),
        ("grain", "grain"),
        ("fold", "fold"),
    ];
    let (mut x, mut y) = (at.x, at.y);
    let ways = has_ways.then_some(("way", "arrow: way of an edge from its start"));
    for (class, words) in entries.into_iter().chain(ways) {
        let words = language.say(words);
        let room = (4.0 + 0.62 * letters(words)) * size;
        if x > at.x && x + room > at.x + width {
            (x, y) = (at.x, y - 1.8 * size);
        }
        canvas.line(class, &[Vec2::new(x, y), Vec2::new(x + 2.5 * size, y)], false);
        canvas.text("label", Vec2::new(x + 3.0 * size + 0.29 * letters(words) * size, y), 0.85 * size, words);
        x += room;
    }
    y - size
}

#[cfg(test)]
mod tests {
    use super::*;
    use toile_garment::notch::Notch;
    use toile_garment::outline::{LinePoint, PointKind};

    fn square(name: &str) -> Piece {
        let corner = |x: f64, y: f64| LinePoint { at: Vec2::new(x, y), kind: PointKind::Turn };
        let points = vec![corner(0.0, 0.0), corner(0.2, 0.0), corner(0.2, 0.3), corner(0.0, 0.3)];
        let edge = |k: u32| OutlineEdge { index: k, name: (k == 1).then(|| "side".into()), from: k, to: (k + 1) % 4 };
        Piece {
            name: name.into(),
            outline: PieceLine { points, closed: true, ..PieceLine::default() },
            edges: (0..4).map(edge).collect(),
            grain: Some([Vec2::new(0.1, 0.05), Vec2::new(0.1, 0.25)]),
            ..Piece::default()
        }
    }

    #[test]
    fn every_edge_is_numbered_and_names_are_escaped() {
        let svg = pattern(&[square("a<b"), square("c")], "t & u");
        assert_eq!(svg.matches("class=\"edge\"").count(), 8);
        assert!(
            svg.contains(">1 side<")
                && svg.contains("a&lt;b")
                && svg.contains("600.0 cm²")
                && svg.contains("mm</text>")
        );
        assert_eq!(svg, pattern(&[square("a<b"), square("c")], "t & u"));
    }

    #[test]
    fn labels_lie_inside_the_cloth() {
        let (at, inward) = on_edge(&square("a").outline, &square("a").edges[1], 0.5).expect("edge");
        assert!((at - Vec2::new(0.2, 0.15)).norm() < 1e-12 && (inward - Vec2::new(-1.0, 0.0)).norm() < 1e-12);
        assert!((inward_normal(&square("a").outline, Vec2::new(0.1, 0.301)) - Vec2::new(0.0, -1.0)).norm() < 1e-12);
    }

    #[test]
    fn a_drawing_speaks_the_language_of_its_page() {
        let piece = Piece { size: Some("38".into()), ..square("前片") };
        let svg = pattern_in(&[piece], "t", Language::Chinese);
        assert!(svg.contains(">尺码 38, 裁 ") && svg.contains(">净线<") && svg.contains(">前片<"), "{svg}");
        assert!(!svg.contains("sew line") && !svg.contains("size 38"), "{svg}");
        assert!(letters("前片") > 3.0 && letters("ab") == 2.0);
    }

    /// Two darts whose points are near to each other, and a piece that is narrower than its name.
    #[test]
    fn labels_do_not_lie_on_each_other() {
        let wedge = |name: &str, x: f64| {
            let legs = [x - 0.01, x + 0.01].map(|mouth| vec![[mouth, 0.0], [0.1 + 0.2 * (x - 0.1), 0.12]]);
            dart(name, DartKind::Wedge, &[[0.1 + 0.2 * (x - 0.1), 0.12]], legs)
        };
        let front = Piece { darts: vec![wedge("dart-1", 0.07), wedge("dart-2", 0.13)], ..square("front") };
        let mut band = square("waistband");
        band.outline.points.iter_mut().for_each(|p| p.at.x *= 0.15);
        for piece in [front, band] {
            let svg = pattern(&[piece], "t");
            let labels: Vec<[f64; 4]> = svg.lines().filter_map(label).collect();
            assert!(labels.len() >= 5, "{svg}");
            for (k, [x, y, w, h]) in labels.iter().enumerate() {
                let covers = |o: &&[f64; 4]| (o[0] - x).abs() < o[2] + w - 1e-6 && (o[1] - y).abs() < o[3] + h - 1e-6;
                assert_eq!(labels[..k].iter().find(covers), None, "{svg}");
            }
        }
    }

    /// Place, half width and half height of a label on a piece; half letters are narrow here.
    fn label(line: &str) -> Option<[f64; 4]> {
        let value = |key: &str| line.split_once(&format!("{key}=\""))?.1.split_once('"')?.0.parse::<f64>().ok();
        let is_one =
            ["edge", "dartname", "notchname", "name"].iter().any(|c| line.contains(&format!("<text class=\"{c}\"")));
        let text = line.split_once('>')?.1.split_once('<')?.0;
        let size = value("font-size")?;
        let half = 0.25 * size * text.chars().count() as f64;
        is_one.then_some([value(" x")?, value(" y")? - 0.35 * size, half, 0.4 * size])
    }

    #[test]
    fn draws_nothing_wrong_for_nothing() {
        assert!(pattern(&[], "empty").contains("<svg"));
        assert!(pattern(&[Piece::default()], "empty").contains("</svg>"));
    }

    fn dart(name: &str, kind: DartKind, apexes: &[[f64; 2]], legs: [Vec<[f64; 2]>; 2]) -> Dart {
        let points = |l: &Vec<[f64; 2]>| l.iter().map(|p| Vec2::new(p[0], p[1])).collect::<Vec<_>>();
        let middle = |l: &Vec<[f64; 2]>| if kind == DartKind::FishEye { points(l)[l.len() / 2] } else { points(l)[0] };
        Dart {
            name: name.into(),
            kind,
            evidence: toile_garment::dart::DartEvidence::Declared,
            apexes: apexes.iter().map(|p| Vec2::new(p[0], p[1])).collect(),
            mouth: [middle(&legs[0]), middle(&legs[1])],
            legs: [points(&legs[0]), points(&legs[1])],
            line: "sew".into(),
            depth: None,
            mesh: None,
            source: None,
        }
    }

    /// Half bodice with seam allowance, a wedge, a fish-eye, notches, a drill hole and a pocket line.
    fn bodice(name: &str) -> Piece {
        let p = |x: f64, y: f64, kind| LinePoint { at: Vec2::new(x, y), kind };
        let (turn, curve) = (PointKind::Turn, PointKind::Curve);
        let sew = vec![
            p(0.0, 0.0, turn),
            p(0.09, 0.0, turn),
            p(0.105, 0.15, turn),
            p(0.12, 0.0, turn),
            p(0.23, 0.01, turn),
            p(0.245, 0.21, turn),
            p(0.19, 0.26, curve),
            p(0.185, 0.33, curve),
            p(0.2, 0.38, turn),
            p(0.08, 0.41, turn),
            p(0.05, 0.35, curve),
            p(0.0, 0.33, turn),
        ];
        let corners = [0u32, 1, 2, 3, 4, 5, 8, 9, 11];
        let edge = |k: usize| OutlineEdge {
            index: k as u32,
            name: (k == 4).then(|| "side".into()),
            from: corners[k],
            to: corners[(k + 1) % corners.len()],
        };
        let cut = [[-0.01, -0.01], [0.24, 0.0], [0.256, 0.216], [0.2, 0.265], [0.196, 0.33], [0.212, 0.388]];
        let cut = cut.iter().chain(&[[0.075, 0.422], [0.043, 0.358], [-0.01, 0.34]]);
        let line = |points, closed| PieceLine { points, closed, ..PieceLine::default() };
        let notch = |x, y, kind| Notch {
            kind,
            at: Vec2::new(x, y),
            depth: 0.005,
            width: 0.003,
            angle: None,
            on: "boundary".into(),
            name: None,
            source: None,
        };
        use toile_garment::notch::NotchKind as Kind;
        let fish = [[0.17, 0.06], [0.162, 0.12], [0.17, 0.19]].to_vec();
        let eye = [[0.17, 0.06], [0.178, 0.12], [0.17, 0.19]].to_vec();
        Piece {
            name: name.into(),
            size: Some("38".into()),
            outline: line(sew, true),
            edges: (0..corners.len()).map(edge).collect(),
            cut_line: Some(line(cut.map(|c| p(c[0], c[1], turn)).collect(), true)),
            internal_lines: vec![line(vec![p(0.03, 0.24, turn), p(0.13, 0.25, turn)], false)],
            grain: Some([Vec2::new(0.04, 0.05), Vec2::new(0.04, 0.2)]),
            fold: Some([Vec2::new(0.0, 0.0), Vec2::new(0.0, 0.33)]),
            drill_holes: vec![toile_garment::piece::DrillHole {
                at: Vec2::new(0.105, 0.16),
                diameter: None,
                source: None,
            }],
            notches: vec![notch(0.251, 0.15, Kind::V), notch(0.06, -0.007, Kind::Slit), notch(0.196, 0.33, Kind::T)],
            darts: vec![
                dart(
                    "waist",
                    DartKind::Wedge,
                    &[[0.105, 0.15]],
                    [[[0.09, 0.0], [0.105, 0.15]].to_vec(), [[0.12, 0.0], [0.105, 0.15]].to_vec()],
                ),
                dart("eye", DartKind::FishEye, &[[0.17, 0.06], [0.17, 0.19]], [fish, eye]),
            ],
            ..Piece::default()
        }
    }

    #[test]
    fn everything_on_a_piece_is_drawn() {
        let svg = pattern(&[bodice("front"), bodice("back")], "bodice");
        let count = |class: &str| svg.matches(&format!("class=\"{class}\"")).count();
        // Every line once per piece, and once in the key.
        assert_eq!((count("cut"), count("sew"), count("internal"), count("fold")), (3, 3, 3, 3));
        assert_eq!((count("dart"), count("dartfill"), count("apex")), (9, 4, 6));
        assert_eq!((count("notch"), count("drill"), count("edge"), count("corner")), (7, 2, 18, 18));
        assert!(svg.contains("waist 30.0 mm") && svg.contains("eye 16.0 mm") && svg.contains(">4 side<"));
    }
}
