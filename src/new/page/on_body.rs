//! The pieces around the body in 3D: coarse meshes at their places, with the proposed seams and threads between them.

use super::colour::{Colour, colour};
use crate::new::dress::Dressed;
use std::sync::atomic::AtomicBool;
use toile_formats::picture::lay;
use toile_formats::report::viewer::{Line, Scene, Stretch, Thread};
use toile_formats::report::{Fit, model};
use toile_garment::body::Body;
use toile_garment::garment::Shape;
use toile_garment::units::Length;
use toile_garment::{Garment, Report, Vec2, Vec3};
use toile_stage_api::{Stage as _, StageContext};
use toile_stages::arrange::Sheet;
use toile_stages::proposal::Proposal;
use toile_stages::roles::PiecePoint;
use toile_stages::triangulate::{Params, Triangulate};

/// Edge length of the meshes, which are only looked at, metres.
const EDGE_LENGTH: f64 = 0.025;
/// Longest stretch of a seam that is drawn straight: pieces are bent around the body, metres.
const STRAIGHT: f64 = 0.01;

/// The view of a garment that is not sewn yet.
pub struct OnBody {
    /// For each piece of the garment its number in the view.
    pub numbers: Vec<Option<usize>>,
    /// The model as the page holds it; `None` where nothing has a place, or a piece cannot be meshed.
    pub model: Option<String>,
    /// The other facts that the view knows.
    pub scene: Scene,
}

/// The pieces that have a place, numbered as the view numbers them.
struct Placed<'a> {
    /// For each piece of the garment its number in the view.
    numbers: Vec<Option<usize>>,
    /// For each piece of the view its sheet.
    sheets: Vec<&'a Sheet>,
    /// For each piece of the view where its flat form lies.
    lay: Vec<Vec2>,
}

impl Placed<'_> {
    /// A point of a piece of the garment: its number in the view, and the point in space and in the flat lay.
    fn point(&self, piece: usize, at: Vec2) -> Option<(usize, [f64; 5])> {
        let number = *self.numbers.get(piece)?.as_ref()?;
        let (p, flat) = (self.sheets[number].at(at), at + self.lay[number]);
        Some((number, [p.x, p.y, p.z, flat.x, flat.y]))
    }
}

/// Puts the view together. Words for the pieces and seams are asked for by their numbers in garment and proposal.
pub fn on_body(
    garment: &Garment,
    proposal: &Proposal,
    dressed: &Dressed,
    body: Option<&Body>,
    words: [&dyn Fn(usize) -> String; 2],
) -> OnBody {
    let places = |k: usize| Some(&dressed.arrangement.places.get(k)?.as_ref()?.sheet);
    let kept: Vec<usize> = (0..garment.pieces.len()).filter(|k| places(*k).is_some()).collect();
    let mut shown = Garment { body: body.cloned(), ..Garment::default() };
    let mut numbers = vec![None; garment.pieces.len()];
    for (number, k) in kept.iter().enumerate() {
        let mut piece = garment.pieces[*k].clone();
        piece.id = toile_garment::PieceId(number as u32);
        shown.pieces.push(piece);
        numbers[*k] = Some(number);
    }
    let sheets: Vec<&Sheet> = kept.iter().filter_map(|k| places(*k)).collect();
    let meshed = meshed(shown).map(|mut shown| {
        shown.stitched = Some(shape(&shown, &sheets));
        shown
    });
    let Some(shown) = meshed.filter(|g| !g.pieces.is_empty()) else {
        return OnBody { numbers: Vec::new(), model: None, scene: Scene::default() };
    };
    let placed = Placed { numbers, sheets, lay: lay(&shown) };
    let [piece_words, seam_words] = words;
    let mut scene = Scene {
        pieces: shown.pieces.len(),
        lines: lines(proposal, &placed),
        threads: threads(dressed, &placed),
        ..Scene::default()
    };
    let names = kept.iter().enumerate().map(|(number, k)| (format!("piece:{number}"), piece_words(*k)));
    let seams = (0..proposal.seams.len()).map(|k| (format!("seam:{k}"), seam_words(k)));
    scene.names.extend(names.chain(seams).map(|(key, words)| (key, words.into())));
    OnBody { numbers: placed.numbers, model: model(&shown, &Fit::default()), scene }
}

/// The pieces as coarse meshes.
fn meshed(garment: Garment) -> Option<Garment> {
    let params = Params { edge_length: Some(Length(EDGE_LENGTH)), ..Params::default() };
    let cx = &mut StageContext {
        report: &mut Report::default(),
        progress: &mut (),
        files: &mut (),
        cancel: &AtomicBool::new(false),
        seed: 0,
        threads: 1,
    };
    Triangulate.run(&params, garment, cx).ok()
}

fn shape(garment: &Garment, sheets: &[&Sheet]) -> Shape {
    let rest = |k: usize| garment.pieces[k].mesh.iter().flat_map(|m| &m.rest);
    let positions = |(k, sheet): (usize, &&Sheet)| rest(k).map(|p| sheet.at(*p)).collect::<Vec<Vec3>>();
    Shape { positions: sheets.iter().enumerate().map(positions).collect(), ..Shape::default() }
}

fn lines(proposal: &Proposal, placed: &Placed<'_>) -> Vec<Line> {
    let all = proposal.seams.iter().enumerate();
    all.map(|(k, seam)| {
        let runs = seam.a.iter().chain(&seam.b);
        let stretch = |run: &toile_stages::proposal::Run| {
            let points = fine(&run.points).into_iter().filter_map(|p| Some(placed.point(run.piece, p)?.1));
            Some(Stretch::Points((*placed.numbers.get(run.piece)?)?, points.collect()))
        };
        let Colour([red, green, blue]) = colour(k);
        Line { stretches: runs.filter_map(stretch).collect(), colour: Some([red, green, blue]) }
    })
    .collect()
}

fn threads(dressed: &Dressed, placed: &Placed<'_>) -> Vec<Thread> {
    let end = |p: &PiecePoint| placed.point(p.piece, p.at);
    let all = dressed.joins.iter().enumerate().flat_map(|(k, join)| join.pairs.iter().map(move |pair| (k, pair)));
    all.filter_map(|(line, [a, b])| Some(Thread { line, ends: [end(a)?, end(b)?] })).collect()
}

/// A line with points no further apart than [`STRAIGHT`].
pub fn fine(points: &[Vec2]) -> Vec<Vec2> {
    let mut out: Vec<Vec2> = points.first().copied().into_iter().collect();
    for ends in points.windows(2) {
        let parts = ((ends[1] - ends[0]).norm() / STRAIGHT).ceil().max(1.0);
        out.extend((1..=parts as usize).map(|k| ends[0] + (ends[1] - ends[0]) * (k as f64 / parts)));
    }
    out
}
