//! Lengths as pattern makers take them, where the roles of the pieces tell what is what: shoulder, sleeve, armhole,
//! back length, side seam, inseam, outseam, rise.
//!
//! A seam is measured on the side of the trunk or leg, else on its shorter side, into which the other is eased. A
//! length along a piece lies on the straight grain through its highest point.

use super::along::{Cloth, Lengths};
use super::balance;
use super::maps::shape;
use super::points::surface_way;
use super::surface::Surface;
use crate::roles::{Facing, Part, PiecePoint, Role, joins_of_meshes, roles, seam_names};
use std::collections::{BTreeMap, BTreeSet};
use toile_formats::report::{Balance, Length, PieceSize};
use toile_garment::body::Body;
use toile_garment::seam::{Seam, SeamKind, SeamSide};
use toile_garment::{Garment, Piece, Vec2, Vec3};

/// Cloth this near to the middle of the body lies on the centre line, metres.
const ON_CENTRE: f64 = 0.015;
/// A line at the edge of a piece is measured so far inside it, metres.
const INSIDE: f64 = 0.003;

/// Seams that are measured: the words in their name, and the name of the measure.
const SEAMS: [(&str, &str); 9] = [
    ("shoulder", "shoulder length"),
    ("armhole", "armhole girth"),
    ("sleeve seam", "sleeve seam"),
    ("neckline", "neckline seam"),
    ("side seam", "side seam"),
    ("inseam", "inseam"),
    ("outseam", "outseam"),
    ("front crotch seam", "front rise"),
    ("back crotch seam", "back rise"),
];

/// Seams that hang plumb in a garment that is in balance: words in their names.
const SIDE_SEAMS: [&str; 2] = ["side seam", "outseam"];

/// The worn garment with what is known of its parts.
struct Worn<'a> {
    garment: &'a Garment,
    at: &'a [Vec<Vec3>],
    roles: Vec<Role>,
}

/// The worn garment, and its seams with their names in the trade. `None` without positions in 3D.
fn worn(garment: &Garment) -> Option<(Worn<'_>, Vec<(String, &Seam)>)> {
    let shape = shape(garment)?;
    let joins = joins_of_meshes(garment);
    let worn = Worn { garment, at: &shape.positions, roles: roles(&garment.pieces, &joins) };
    let names = seam_names(&worn.roles, &joins, |p| worn.place(p));
    let seams = garment.seams.iter().filter(|s| s.kind == SeamKind::Seam);
    let named = names.into_iter().zip(seams).filter_map(|(name, seam)| Some((name?, seam))).collect();
    Some((worn, named))
}

/// How far the lower ends of the side seams hang before their upper ends. Empty without positions in 3D.
#[must_use]
pub fn leaning_seams(garment: &Garment) -> Vec<Balance> {
    let Some((worn, named)) = worn(garment) else { return Vec::new() };
    let mut out = Vec::new();
    for (word, side) in SIDE_SEAMS.into_iter().flat_map(|word| ["left", "right"].map(|side| (word, side))) {
        let of_side = named.iter().filter(|(name, _)| name.contains(word) && lateral(name) == side);
        let runs = of_side.flat_map(|(_, seam)| &seam.a.runs);
        let points = runs.flat_map(|run| run.vertices.iter().map(move |v| (run.piece.index(), *v as usize)));
        let places = points.filter_map(|(p, v)| worn.at.get(p)?.get(v).copied());
        out.extend(balance::of_seam(format!("{word} forward {side}"), places));
    }
    out
}

/// All lengths that the garment has. Empty without positions in 3D.
#[must_use]
pub fn lengths(garment: &Garment) -> Vec<Length> {
    let Some((worn, seams)) = worn(garment) else { return Vec::new() };
    let named: Vec<(&str, &Seam)> = seams.iter().map(|(name, seam)| (name.as_str(), *seam)).collect();
    let mut out = worn.of_seams(&named);
    out.extend(worn.of_sleeves(&named));
    out.extend(worn.of_centre(&named));
    if let Some(body) = &garment.body {
        let surface = Surface::of_body(body);
        for length in &mut out {
            length.body = on_body(&length.name, body, &surface);
        }
    }
    out
}

/// Length along the grain and width across it of every piece, through its middle, flat and worn.
#[must_use]
pub fn piece_sizes(garment: &Garment) -> Vec<PieceSize> {
    let Some(shape) = shape(garment) else { return Vec::new() };
    let size = |(k, piece): (usize, &Piece)| {
        let cloth = cloth(garment, &shape.positions, k)?;
        let (middle, warp) = (cloth.middle()?, piece.warp());
        let [length, width] = [warp, Vec2::new(-warp.y, warp.x)].map(|along| cloth.line(middle, along));
        let both = |l: Lengths| [l.rest, l.worn];
        Some(PieceSize { name: piece.name.clone(), length: both(length?), width: both(width?) })
    };
    garment.pieces.iter().enumerate().filter_map(size).collect()
}

fn cloth<'a>(garment: &'a Garment, at: &'a [Vec<Vec3>], piece: usize) -> Option<Cloth<'a>> {
    let mesh = garment.pieces.get(piece)?.mesh.as_ref()?;
    let worn = at.get(piece).filter(|x| x.len() == mesh.rest.len())?;
    Some(Cloth { mesh, worn })
}

impl Worn<'_> {
    fn cloth(&self, piece: usize) -> Option<Cloth<'_>> {
        cloth(self.garment, self.at, piece)
    }

    fn part(&self, piece: usize) -> Option<Part> {
        self.roles.get(piece)?.part
    }

    /// Where a point of a piece is worn: the place of its nearest vertex.
    fn place(&self, p: PiecePoint) -> Option<Vec3> {
        let cloth = self.cloth(p.piece)?;
        let far = |v: &usize| (cloth.mesh.rest[*v] - p.at).norm_squared();
        let nearest = (0..cloth.worn.len()).min_by(|a, b| far(a).total_cmp(&far(b)))?;
        Some(cloth.worn[nearest])
    }

    /// Lengths of seams. Several seams of one name are one line, and cloth that two layers are sewn to counts once.
    fn of_seams(&self, named: &[(&str, &Seam)]) -> Vec<Length> {
        let mut out = Vec::new();
        for (word, name) in SEAMS {
            let mut sides: BTreeMap<&str, BTreeSet<(usize, [u32; 2])>> = BTreeMap::new();
            for (seam_name, seam) in named.iter().filter(|(n, _)| n.contains(word)) {
                // Both inseams meet in the middle, and their names may be one.
                let by_place = || if word == "inseam" { side_of(self.middle(seam)) } else { "" };
                let side = Some(lateral(seam_name)).filter(|side| !side.is_empty()).unwrap_or_else(by_place);
                sides.entry(side).or_default().extend(edges(self.side(seam)));
            }
            for (lateral, edges) in sides {
                let mut sum = Lengths::default();
                edges.iter().filter_map(|(p, e)| self.cloth(*p)?.edge(*e)).for_each(|l| sum += l);
                out.extend(length(&with_side(name, lateral), sum));
            }
        }
        out
    }

    /// How far the middle of a seam lies to the wearer's left, metres.
    fn middle(&self, seam: &Seam) -> f64 {
        let runs = [&seam.a, &seam.b].into_iter().flat_map(|side| &side.runs);
        let points = runs.flat_map(|run| run.vertices.iter().map(move |v| (run.piece.index(), *v as usize)));
        let xs: Vec<f64> = points.filter_map(|(p, v)| Some(self.at.get(p)?.get(v)?.x)).collect();
        xs.iter().sum::<f64>() / xs.len().max(1) as f64
    }

    /// The side of a seam that is measured.
    fn side<'s>(&self, seam: &'s Seam) -> &'s SeamSide {
        let is_trunk = |side: &SeamSide| {
            let parts = side.runs.iter().map(|r| self.part(r.piece.index()));
            parts.clone().count() > 0 && parts.clone().all(|p| matches!(p, Some(Part::Bodice | Part::Yoke | Part::Leg)))
        };
        match [&seam.a, &seam.b].map(is_trunk) {
            [true, false] => &seam.a,
            [false, true] => &seam.b,
            _ if seam.b.length < seam.a.length => &seam.b,
            _ => &seam.a,
        }
    }

    /// Lengths of sleeves from the top of the armhole, and their widths at its lowest point.
    fn of_sleeves(&self, named: &[(&str, &Seam)]) -> Vec<Length> {
        let mut heads: BTreeMap<(&str, usize), BTreeSet<u32>> = BTreeMap::new();
        for (name, seam) in named.iter().filter(|(n, _)| n.contains("armhole")) {
            for run in [&seam.a, &seam.b].into_iter().flat_map(|s| &s.runs) {
                if self.part(run.piece.index()) == Some(Part::Sleeve) {
                    heads.entry((lateral(name), run.piece.index())).or_default().extend(&run.vertices);
                }
            }
        }
        // Of several pieces of one sleeve the one whose head is highest is measured.
        let mut tops: BTreeMap<&str, (f64, usize, u32)> = BTreeMap::new();
        for ((side, piece), head) in &heads {
            let Some(cloth) = self.cloth(*piece) else { continue };
            let height = |v: &u32| cloth.worn.get(*v as usize).map_or(f64::NEG_INFINITY, |p| p.y);
            let Some(top) = head.iter().max_by(|a, b| height(a).total_cmp(&height(b))) else { continue };
            if tops.get(side).is_none_or(|(best, ..)| height(top) > *best) {
                tops.insert(side, (height(top), *piece, *top));
            }
        }
        let of_top = |(side, (_, piece, top)): (&&str, &(f64, usize, u32))| {
            let (cloth, warp) = (self.cloth(*piece)?, self.garment.pieces[*piece].warp());
            let along = cloth.line(*cloth.mesh.rest.get(*top as usize)?, warp)?;
            length(&with_side("sleeve length", side), along)
        };
        tops.iter().filter_map(of_top).collect()
    }

    /// Lengths on the centre line of front and back, without bands.
    fn of_centre(&self, named: &[(&str, &Seam)]) -> Vec<Length> {
        let trunks = [(Facing::Front, "front length"), (Facing::Back, "back length")];
        let skirts = [(Facing::Front, "skirt length front"), (Facing::Back, "skirt length back")];
        let of = |parts: &'static [Part]| {
            move |(facing, name)| self.centre(facing, parts, named).and_then(|l| length(name, l))
        };
        // The yoke of a skirt hangs at the waist.
        let has_trunk = self.roles.iter().any(|r| r.part == Some(Part::Bodice));
        let trunk = trunks.into_iter().filter(|_| has_trunk).filter_map(of(&[Part::Bodice, Part::Yoke]));
        trunk.chain(skirts.into_iter().filter_map(of(&[Part::Skirt, Part::Tier]))).collect()
    }

    /// The length of the cloth on the centre line: each part once, whatever its layers.
    fn centre(&self, facing: Facing, parts: &[Part], named: &[(&str, &Seam)]) -> Option<Lengths> {
        let mut sum: Option<Lengths> = None;
        for part in parts {
            let faces = |r: &Role| {
                r.part == Some(*part) && (r.facing == Some(facing) || (r.facing.is_none() && *part == Part::Yoke))
            };
            let mut pieces = (0..self.roles.len()).filter(|k| faces(&self.roles[*k]));
            let found = pieces.find_map(|k| {
                let (line, seam) = (self.on_centre(k, facing)?, self.on_centre_seam(k, facing, named));
                Some(if seam.rest > line.rest { seam } else { line })
            });
            if let Some(found) = found {
                *sum.get_or_insert_default() += found;
            }
        }
        sum
    }

    /// The length of a piece along the centre seam. A shaped seam leaves the straight line on which a centre without a seam
    /// is measured; an open centre has a part of a seam or none.
    fn on_centre_seam(&self, piece: usize, facing: Facing, named: &[(&str, &Seam)]) -> Lengths {
        let words = if facing == Facing::Back { "centre back" } else { "centre front" };
        let seams = named.iter().filter(|(name, _)| name.contains(words));
        let sides = seams.flat_map(|(_, seam)| [&seam.a, &seam.b]);
        let on_piece: BTreeSet<[u32; 2]> =
            sides.flat_map(edges).filter(|(p, _)| *p == piece).map(|(_, edge)| edge).collect();
        let mut sum = Lengths::default();
        on_piece.iter().filter_map(|e| self.cloth(piece)?.edge(*e)).for_each(|l| sum += l);
        sum
    }

    /// The length of a piece along its grain, through its highest point on the centre line.
    fn on_centre(&self, piece: usize, facing: Facing) -> Option<Lengths> {
        let cloth = self.cloth(piece)?;
        let is_here = |p: &Vec3| p.x.abs() < ON_CENTRE;
        let top = (0..cloth.worn.len()).filter(|v| is_here(&cloth.worn[*v]));
        let top = top.max_by(|a, b| cloth.worn[*a].y.total_cmp(&cloth.worn[*b].y))?;
        let warp = self.garment.pieces[piece].warp();
        // A piece may end at the centre line, so its cloth is measured a little inside.
        let top = cloth.mesh.rest[top];
        let across = Vec2::new(-warp.y, warp.x);
        let inside = INSIDE.copysign((cloth.middle()? - top).dot(&across));
        let line = cloth.line(top + across * inside, warp)?;
        let faces = if facing == Facing::Back { -1.0 } else { 1.0 };
        let low = (0..cloth.worn.len()).filter(|v| is_here(&cloth.worn[*v]));
        let low = low.min_by(|a, b| cloth.worn[*a].y.total_cmp(&cloth.worn[*b].y))?;
        let middle = self.garment.body.as_ref().and_then(|b| b.segments.get("torso")).map_or(0.0, |s| s.from.z);
        (faces * (cloth.worn[low].z - middle) > 0.0).then_some(line)
    }
}

/// Edges of the mesh along a side of a seam.
fn edges(side: &SeamSide) -> impl Iterator<Item = (usize, [u32; 2])> {
    let of_run = |run: &toile_garment::seam::SeamRun| {
        let piece = run.piece.index();
        run.vertices.windows(2).map(move |w| (piece, [w[0].min(w[1]), w[0].max(w[1])])).collect::<Vec<_>>()
    };
    side.runs.iter().flat_map(of_run)
}

/// The side of the wearer in a name.
fn lateral(name: &str) -> &'static str {
    let is = |word: &str| name.split(' ').any(|w| w == word);
    if is("left") {
        "left"
    } else if is("right") {
        "right"
    } else {
        ""
    }
}

/// The wearer's side on which a line lies whose middle is so far to the left, metres; none for one on both legs.
fn side_of(left: f64) -> &'static str {
    match left {
        x if x > ON_CENTRE => "left",
        x if x < -ON_CENTRE => "right",
        _ => "",
    }
}

fn with_side(name: &str, side: &str) -> String {
    if side.is_empty() { name.to_owned() } else { format!("{name} {side}") }
}

fn length(name: &str, l: Lengths) -> Option<Length> {
    (l.rest > 0.0).then(|| Length { name: name.to_owned(), pattern: l.rest, worn: l.worn, body: None })
}

/// The length of the body that a measure is compared with, metres, and the way in which it is taken.
fn on_body(name: &str, body: &Body, surface: &Surface) -> Option<(f64, &'static str)> {
    let side = lateral(name);
    let mark = |name: &str| body.landmarks.get(name).copied();
    let on_side = |name: &str| mark(&format!("{name}-{side}"));
    let measure = |name: &str| body.measures.get(name).copied();
    let along = |a: Option<Vec3>, b: Option<Vec3>| Some((surface_way(surface, a?, b?)?, "surface"));
    let straight = |length: Option<f64>| Some((length?, "straight"));
    match name.trim_end_matches(side).trim_end() {
        "shoulder length" => along(on_side("neck-side"), on_side("shoulder")),
        "sleeve length" => straight(measure("arm_length")),
        "back length" => along(mark("neck-back"), mark("waist-back")),
        "front length" => along(mark("neck-front"), mark("waist-front")),
        "neckline seam" => Some((measure("neck_girth")?, "tape")),
        "inseam" => straight(measure("crotch_height").or_else(|| mark("crotch").map(|p| p.y))),
        "outseam" => straight(measure("waist_height").or_else(|| on_side("waist").map(|p| p.y))),
        _ => None,
    }
}
