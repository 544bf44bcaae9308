//! The body questioned: girths of the laid-out pattern beside those of the body.

use super::codes::{BODY_CHOSEN, BODY_DOES_NOT_FIT};
use super::dress::Dressed;
use super::pattern::Source;
use super::stock::Body;
use toile_garment::text::shown;
use toile_garment::{Diagnostic, Garment, Piece, Vec2, Vec3};
use toile_stages::arrange::{Place, Segment};
use toile_stages::body::{BodyMeasures, SIZE_TABLES, SizeTable, girth_at};
use toile_stages::roles::{Part, Role};

/// Distance of the heights at which the pattern is measured, metres.
const STEP: f64 = 0.01;
/// A garment may be narrower than its body by this share of the body's girth: knits stretch so far without a word.
const STRETCH: f64 = 0.08;
/// And no knit stretches by more than this share.
const MOST_STRETCH: f64 = 0.35;
/// Ease around the chest from which on a garment is looked at as too large, metres. A wide hoodie has 0.26.
const TENT: f64 = 0.28;
/// A body of the pattern's own size is the better one if its ease is nearer to the usual by so much, metres.
const NEARER: f64 = 0.03;
/// A piece whose outward normal points less to the front or the back lies at a side.
const SIDEWAYS: f64 = 0.3;
/// Usual ease around the chest and around the hips, metres.
const CHEST: [f64; 2] = [0.06, 0.14];
const HIPS: [f64; 2] = [0.02, 0.10];
/// Bodies that are named at most.
const NAMED: usize = 4;

/// A girth of the pattern and of the body.
struct Pair {
    place: &'static str,
    measure: &'static str,
    garment: f64,
    body: f64,
    usual: [f64; 2],
    may_hang: bool,
}

/// The doubt of a body that a pattern was laid on, if there is one.
pub fn question(
    source: &Source,
    dressed: &Dressed,
    own: &Body,
    body: &toile_garment::body::Body,
) -> Option<Diagnostic> {
    pairs(&source.garment, dressed, body, false).into_iter().find_map(|pair| ask(source, &pair, own))
}

/// The body of the pattern's own size, where the pattern has its usual ease on it and not on the usual body, or where a
/// person asked for this size of the pattern.
pub fn better(
    source: &Source,
    dressed: &Dressed,
    body: &toile_garment::body::Body,
    is_size_asked: bool,
) -> Option<(Body, Diagnostic)> {
    let garment = &source.garment;
    let label = garment.size.as_deref()?;
    let of = |pair: Pair| {
        let own = of_label(&pair, label, source);
        own.filter(|own| is_size_asked || is_better(&pair, own.1)).map(|own| (pair, own))
    };
    let (pair, (name, girth)) = pairs(garment, dressed, body, false).into_iter().find_map(of)?;
    let message = format!(
        "the pattern is of size {} and measures {} around the {}; body {name} has {}: it was chosen",
        shown(label, &[]),
        mm(pair.garment),
        pair.place,
        mm(girth)
    );
    let finding = Diagnostic::info(BODY_CHOSEN, message).hint("--body SIZE or --body FILE.obj takes another one");
    Some((Body::Size(name), finding))
}

/// How much narrower a garment is than its body, where that is more than woven cloth gives: the girths of both.
pub fn narrow(garment: &Garment, dressed: &Dressed, body: &toile_garment::body::Body) -> Option<String> {
    let is_knit = |p: &Pair| (STRETCH..MOST_STRETCH).contains(&(1.0 - p.garment / p.body));
    let pair = pairs(garment, dressed, body, true).into_iter().find(is_knit)?;
    Some(format!("{} around the {} on a body of {}", mm(pair.garment), pair.place, mm(pair.body)))
}

impl Pair {
    /// How far an ease is from the usual one.
    fn off(&self, ease: f64) -> f64 {
        (ease - 0.5 * (self.usual[0] + self.usual[1])).abs()
    }

    fn is_usual(&self, ease: f64) -> bool {
        (self.usual[0]..=self.usual[1]).contains(&ease)
    }
}

/// The size of a label, and its girth; of several kinds of person the one with the most usual ease.
fn of_label(pair: &Pair, label: &str, source: &Source) -> Option<(String, f64)> {
    let own = kinds(source).into_iter().flat_map(|table| {
        let sizes = table.sizes.iter().filter(|s| s.label() == label.trim());
        sizes.map(|s| (table.name(s), value(&table.measures(s), pair.measure)))
    });
    own.min_by(|a, b| pair.off(pair.garment - a.1).total_cmp(&pair.off(pair.garment - b.1)))
}

/// Has a garment a clearly more usual ease on another girth than on its body?
fn is_better(pair: &Pair, girth: f64) -> bool {
    let now = pair.garment - pair.body;
    pair.off(pair.garment - girth) + NEARER < pair.off(now) && !pair.is_usual(now)
}

/// Words of files for kinds of person.
const KINDS: [(&str, &[&str]); 3] = [
    ("women", &["WOMAN", "WOMEN", "WOMENS", "LADY", "LADIES", "DAMEN", "FEMME", "MUJER", "DONNA", "KADIN"]),
    ("men", &["MAN", "MEN", "MENS", "HERREN", "HOMME", "HOMBRE", "UOMO", "ERKEK"]),
    (
        "child",
        &["CHILD", "CHILDREN", "KID", "KIDS", "BOY", "BOYS", "GIRL", "GIRLS", "KINDER", "ENFANT", "BEBE", "BABY"],
    ),
];

/// The kinds of person that a garment may be for: those that the name of the file or the style names, else those that
/// have all sizes of the file. All of them where nothing is told.
fn kinds(source: &Source) -> Vec<&'static SizeTable> {
    let text = format!("{} {}", source.stem, source.garment.style).to_uppercase();
    let words: Vec<&str> = text.split(|c: char| !c.is_alphabetic()).collect();
    let is_named = |table: &SizeTable| {
        KINDS.iter().any(|(kind, known)| *kind == table.word && known.iter().any(|k| words.contains(k)))
    };
    let has = |table: &SizeTable, label: &str| table.sizes.iter().any(|s| s.label() == label.trim());
    let has_all = |table: &SizeTable| !source.sizes.is_empty() && source.sizes.iter().all(|s| has(table, s));
    let of = |holds: &dyn Fn(&SizeTable) -> bool| SIZE_TABLES.iter().filter(|t| holds(t)).collect::<Vec<_>>();
    let told = [of(&is_named), of(&has_all)].into_iter().find(|tables| !tables.is_empty());
    told.unwrap_or_else(|| SIZE_TABLES.iter().collect())
}

fn mm(x: f64) -> String {
    format!("{:.0} mm", 1e3 * x)
}

/// The girths that can be compared. Legs in one piece lie at the sides; `with_sides` counts them as before and behind.
fn pairs(garment: &Garment, dressed: &Dressed, body: &toile_garment::body::Body, with_sides: bool) -> Vec<Pair> {
    let height = |name: &str| body.measures.get(&format!("{name}_height")).copied();
    let (Some(bust), Some(waist), Some(hip)) = (height("bust"), height("waist"), height("hip")) else {
        return Vec::new();
    };
    let own = |name: &str, y: f64| body.measures.get(name).copied().unwrap_or_else(|| girth_at(body, y));
    let cloth = Cloth::of(garment, dressed, with_sides);
    let upper = cloth.above_the_waist();
    let mut out = Vec::new();
    // The armholes of a pattern may be deeper than the body's.
    let chest = upper.most(bust - 0.4 * (bust - waist), bust + 0.02);
    if let Some(garment) = chest.filter(|_| upper.is_around(bust - 0.1 * (bust - waist))) {
        let body = own("bust_girth", bust);
        out.push(Pair { place: "chest", measure: "bust_girth", garment, body, usual: CHEST, may_hang: false });
    }
    if let Some(garment) = cloth.most(hip - 0.03, hip + 0.03).filter(|_| cloth.is_around(hip)) {
        let body = own("hip_girth", hip);
        out.push(Pair { place: "hips", measure: "hip_girth", garment, body, usual: HIPS, may_hang: true });
    }
    out
}

fn ask(source: &Source, pair: &Pair, own: &Body) -> Option<Diagnostic> {
    let garment = &source.garment;
    let ease = pair.garment - pair.body;
    let is_narrow = ease < -STRETCH * pair.body;
    let is_wide = !pair.may_hang && ease > TENT;
    let is_other = garment
        .size
        .as_deref()
        .is_some_and(|label| of_label(pair, label, source).is_some_and(|own| is_better(pair, own.1)));
    if !is_narrow && !is_wide && !is_other {
        return None;
    }
    let name = match own {
        Body::Size(size) => format!("size {size}"),
        Body::File(path) => format!("`{}`", crate::engine::clean(path)),
    };
    let how = if ease < 0.0 { format!("{} too narrow", mm(-ease)) } else { format!("{} ease", mm(ease)) };
    let message = format!(
        "the garment measures {} around the {}; {name} has {}: {how}",
        mm(pair.garment),
        pair.place,
        mm(pair.body)
    );
    let label =
        garment.size.as_deref().map_or(String::new(), |s| format!("the pattern is of size {}; ", shown(s, &[])));
    let size = size_of_body(source, own).map_or(String::new(), |size| {
        format!("the file holds the size of the body, too: --size {}; ", shown(size, &[]))
    });
    let [least, most] = pair.usual.map(|x| 1e3 * x);
    let hint = match fitting(pair, source).as_slice() {
        [] => format!("no size has the usual ease of {least:.0} to {most:.0} mm; --body FILE.obj takes a mesh"),
        sizes => format!("bodies of the usual ease ({least:.0} to {most:.0} mm): --body {}", sizes.join(", --body ")),
    };
    Some(Diagnostic::warning(BODY_DOES_NOT_FIT, message).hint(format!("{label}{size}{hint}")))
}

/// The size of the file that is called as the body is, and is not the one that was taken.
fn size_of_body<'a>(source: &'a Source, own: &Body) -> Option<&'a str> {
    let Body::Size(name) = own else { return None };
    let label = name.rsplit('-').next()?;
    let is_taken = source.garment.size.as_deref().is_some_and(|s| s.trim() == label);
    source.sizes.iter().map(String::as_str).find(|s| s.trim() == label && !is_taken)
}

/// Sizes for a garment: that of its label, then those of the usual ease, the nearest first.
fn fitting(pair: &Pair, source: &Source) -> Vec<String> {
    let tables = kinds(source).into_iter();
    let all = tables.flat_map(|table| table.sizes.iter().map(|s| (table.name(s), table.measures(s))));
    let easy = all.map(|(name, measures)| (name, pair.garment - value(&measures, pair.measure)));
    let mut usual: Vec<(String, f64)> = easy.filter(|(_, ease)| pair.is_usual(*ease)).collect();
    usual.sort_by(|a, b| pair.off(a.1).total_cmp(&pair.off(b.1)));
    let label = source.garment.size.as_deref();
    let own = label.and_then(|label| of_label(pair, label, source)).filter(|own| is_better(pair, own.1));
    let own = own.map(|(name, _)| name);
    let others: Vec<String> =
        usual.into_iter().map(|(name, _)| name).filter(|name| Some(name) != own.as_ref()).collect();
    own.into_iter().chain(others).take(NAMED).collect()
}

fn value(measures: &BodyMeasures, name: &str) -> f64 {
    measures.entries().iter().find(|(n, _)| *n == name).map_or(0.0, |(_, v)| *v)
}

/// The pieces around the trunk, where they were laid.
struct Cloth {
    outlines: Vec<Outline>,
}

#[derive(Clone)]
struct Outline {
    /// Does it lie before the body? None for a piece at a side, which reaches to both.
    is_front: Option<bool>,
    /// Does it hang from the waist?
    is_low: bool,
    points: Vec<Vec3>,
}

impl Cloth {
    fn of(garment: &Garment, dressed: &Dressed, with_sides: bool) -> Self {
        let laid = garment.pieces.iter().zip(&dressed.roles).zip(&dressed.arrangement.places);
        let around = laid.filter_map(|((piece, role), place)| {
            let place = place.as_ref().filter(|p| is_around(role, p))?;
            let is_low =
                matches!(role.part, Some(Part::Skirt | Part::Leg | Part::Tier | Part::Waistband | Part::Godet));
            Some(Outline { is_front: is_front(place, with_sides), is_low, points: points(piece, place) })
        });
        Self { outlines: around.collect() }
    }

    /// Without the pieces that hang from the waist.
    fn above_the_waist(&self) -> Self {
        Self { outlines: self.outlines.iter().filter(|o| !o.is_low).cloned().collect() }
    }

    /// Length of the pieces around at a height, metres.
    fn girth(&self, y: f64) -> f64 {
        self.outlines.iter().map(|o| width(&o.points, y)).sum()
    }

    /// The largest girth between two heights.
    fn most(&self, from: f64, to: f64) -> Option<f64> {
        let steps = ((to - from) / STEP).max(1.0) as usize;
        let all = (0..=steps).map(|k| self.girth(from + (to - from) * k as f64 / steps as f64));
        all.max_by(f64::total_cmp).filter(|g| *g > 0.0)
    }

    /// Is there cloth before and behind the body at a height?
    fn is_around(&self, y: f64) -> bool {
        let has = |front: bool| self.outlines.iter().any(|o| o.is_front != Some(!front) && width(&o.points, y) > 0.0);
        has(true) && has(false)
    }
}

/// Pieces of one layer around the trunk.
fn is_around(role: &Role, place: &Place) -> bool {
    let is_trunk = matches!(place.segment, Segment::Torso | Segment::Leg(_));
    let is_other = |part: Part| {
        use Part::{
            BeltLoop, Binding, Collar, Cuff, Facing, Hood, Interlining, Lining, Placket, Pocket, Sleeve, Stand, Strap,
        };
        matches!(
            part,
            BeltLoop
                | Binding
                | Collar
                | Cuff
                | Facing
                | Hood
                | Interlining
                | Lining
                | Placket
                | Pocket
                | Sleeve
                | Stand
                | Strap
        )
    };
    is_trunk && !role.part.is_some_and(is_other)
}

fn is_front(place: &Place, with_sides: bool) -> Option<bool> {
    let ahead = place.rotation()[2][2];
    (!with_sides || ahead.abs() > SIDEWAYS).then_some(ahead > 0.0)
}

fn points(piece: &Piece, place: &Place) -> Vec<Vec3> {
    let (r, t) = (place.rotation(), place.translation());
    let at = |p: Vec2| Vec3::from([0, 1, 2].map(|k| r[k][0] * p.x + r[k][1] * p.y + t[k]));
    piece.outline.positions().into_iter().map(at).collect()
}

/// Length of a flat outline's inside at a height.
fn width(outline: &[Vec3], y: f64) -> f64 {
    let next = outline.iter().cycle().skip(1);
    let mut cuts: Vec<Vec3> = outline
        .iter()
        .zip(next)
        .filter(|(a, b)| (a.y < y) != (b.y < y))
        .map(|(a, b)| a + (b - a) * ((y - a.y) / (b.y - a.y)))
        .collect();
    let key = |p: &Vec3| p.x + 0.37 * p.z;
    cuts.sort_by(|a, b| key(a).total_cmp(&key(b)));
    cuts.chunks_exact(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
}
