//! Pieces that stand for each other: a long and a short sleeve, three hoods, two neckbands.
//!
//! A kit holds more pieces than one garment has. Two pieces of one kind that share a part of their outlines are drawn
//! over one another, and one of them is sewn. A neck takes one collar or one hood.

use toile_garment::piece::Quantity;
use toile_garment::{Piece, Vec2};
use toile_stages::proposal::Proposal;
use toile_stages::roles::{Facing, Part, Role};

/// Edges and their chords differ by no more in two such pieces, metres.
const SAME_EDGE: f64 = 2e-3;
/// Two pieces of one facing that share so much of the outline are drawn over each other, whatever their parts are called.
/// A front for a half collar shares 0.85 with the one for a full collar (GMG1016).
const NEARLY_ALL: f64 = 0.75;
/// So many edges in a row are the same at least, with the share of the shorter outline that they make.
const SHARED: [(usize, f64); 2] = [(4, 0.2), (2, 0.45)];
/// Two outlines that share more are of one shape.
const SAME_SHAPE: f64 = 0.97;
/// Length of a rib over that of the neckline that it is stretched on.
const RIB: f64 = 0.88;
/// Words of garments and cloths that are knits, beside ribs.
const KNITS: [&str; 6] = ["JERSEY", "KNIT", "LEGGING", "LEGGINGS", "TIGHT", "TIGHTS"];
/// Two openings that differ by less are a pair, such as two armholes: metres.
const PAIR_OF_OPENINGS: f64 = 3e-3;

/// A piece of a garment, with what is known of it.
#[derive(Clone, Copy)]
pub struct Known<'a> {
    /// The piece.
    pub piece: &'a Piece,
    /// Its role, as its name tells it.
    pub role: &'a Role,
    /// True where it is cut for both sides.
    pub is_double: bool,
    /// True where it is its own mirror image.
    pub is_own_image: bool,
}

/// Names of the pieces that an earlier one stands for.
pub fn drawn_over(pieces: &[Known<'_>]) -> Vec<String> {
    let mut kept: Vec<Known<'_>> = Vec::new();
    let mut out = Vec::new();
    for piece in pieces {
        if kept.iter().any(|k| stands_for(k, piece)) {
            out.push(piece.piece.name.clone());
        } else {
            kept.push(*piece);
        }
    }
    out
}

/// Does one piece stand for another one? Two of one shape, or of mirrored ones, that are cut once each are a left and a
/// right one.
fn stands_for(a: &Known<'_>, b: &Known<'_>) -> bool {
    let part = a.role.part.or(b.role.part);
    let is_one_of = matches!(part, Some(Part::Sleeve | Part::Leg | Part::Hood | Part::Collar | Part::Bodice));
    let is_told = part != Some(Part::Bodice) || a.role.facing.is_some();
    if !is_one_of || !is_told || a.role.facing != b.role.facing || a.role.lateral != b.role.lateral {
        return false;
    }
    let (p, q) = (edges(a.piece), edges(b.piece));
    let (count, share) = shared(&p, &q);
    let are_alike = [a, b].iter().all(|k| k.role.part.is_none() || k.role.part == part);
    if !are_alike && share < NEARLY_ALL {
        return false;
    }
    let mirrored: Vec<[f64; 2]> = q.iter().rev().copied().collect();
    let is_same = share > SAME_SHAPE || shared(&p, &mirrored).1 > SAME_SHAPE;
    SHARED.iter().any(|(edges, least)| count >= *edges && share >= *least) && (!is_same || a.is_double && b.is_double)
}

/// Length and chord of every edge, counter-clockwise.
fn edges(piece: &Piece) -> Vec<[f64; 2]> {
    let edge = |points: &[Vec2]| {
        let length = points.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
        Some([length, (points.last()? - points.first()?).norm()])
    };
    piece.edges.iter().filter_map(|e| edge(&piece.outline.edge_points(e))).collect()
}

/// The longest row of edges that two outlines share in the same order: their number, and their share of the shorter one.
fn shared(p: &[[f64; 2]], q: &[[f64; 2]]) -> (usize, f64) {
    let length = |e: &[[f64; 2]]| e.iter().map(|[length, _]| length).sum::<f64>();
    let is_same = |x: [f64; 2], y: [f64; 2]| x.iter().zip(y).all(|(x, y)| (x - y).abs() < SAME_EDGE);
    let (n, m) = (p.len(), q.len());
    let row = |i: usize, j: usize| (0..n.min(m)).take_while(|k| is_same(p[(i + k) % n], q[(j + k) % m])).count();
    let rows = (0..n).flat_map(|i| (0..m).map(move |j| (i, j))).map(|(i, j)| (i, row(i, j)));
    let sums = rows.map(|(i, count)| (count, (0..count).map(|k| p[(i + k) % n][0]).sum::<f64>()));
    let (count, sum) = sums.max_by(|x, y| x.1.total_cmp(&y.1)).unwrap_or_default();
    (count, sum / length(p).min(length(q)).max(1e-9))
}

/// Is a piece a layer that lies under another one: the lower collar under the upper one?
pub fn is_under_layer(piece: &Known<'_>, all: &[Known<'_>]) -> bool {
    let is = |k: &Known<'_>, facing: Facing| k.role.part == Some(Part::Collar) && k.role.facing == Some(facing);
    is(piece, Facing::Under) && all.iter().any(|k| is(k, Facing::Upper))
}

/// The pieces of which a neck takes one: whole collars and hoods. None where there are no two kinds of them. In a kit,
/// whose quantities are all 0, several stands are alternatives, too.
pub fn of_neck<'a>(pieces: &[Known<'a>]) -> Vec<Known<'a>> {
    let stands = pieces.iter().filter(|k| k.role.part == Some(Part::Stand)).count();
    // A piece that is copied counts once, whatever its quantity was.
    let is_kit = pieces.iter().all(|k| k.is_double || k.piece.quantity == Quantity { plain: 0, mirrored: 0 });
    let is_whole = |k: &&Known<'_>| match k.role.part {
        Some(Part::Collar) => {
            k.is_own_image && k.role.lateral.is_none() && !matches!(k.role.facing, Some(Facing::Front | Facing::Back))
        }
        Some(Part::Stand) => is_kit && stands > 1,
        Some(Part::Hood) => true,
        _ => false,
    };
    let found: Vec<Known<'_>> = pieces.iter().filter(is_whole).copied().collect();
    let collars = found.iter().filter(|k| k.role.part != Some(Part::Hood)).count();
    let kinds = collars + usize::from(found.len() > collars);
    if kinds < 2 { Vec::new() } else { found }
}

/// The piece at a neck that fits best, by its number among those: its long side against an opening that has no pair.
/// `proposal` is one of the garment without them. A hood is taken where there is nothing else, and the first piece where
/// no opening is found.
pub fn best_at_neck(necks: &[Known<'_>], proposal: &Proposal) -> usize {
    let lengths: Vec<f64> = proposal.openings.iter().map(|o| o.iter().map(|b| b.length).sum()).collect();
    let is_single = |k: &usize| {
        let others = lengths.iter().enumerate().filter(|(i, _)| i != k);
        others.map(|(_, l)| (l - lengths[*k]).abs()).all(|off| off > PAIR_OF_OPENINGS)
    };
    let single: Vec<f64> = (0..lengths.len()).filter(is_single).map(|k| lengths[k]).collect();
    let cost = |k: &Known<'_>| {
        let usual = if is_rib(k.piece) { RIB } else { 1.0 };
        let off = |opening: &f64| libm::log(long_side(k.piece) / (usual * opening)).abs();
        (k.role.part == Some(Part::Hood), single.iter().map(off).fold(f64::INFINITY, f64::min))
    };
    let costs: Vec<(bool, f64)> = necks.iter().map(cost).collect();
    let order = |x: &(bool, f64), y: &(bool, f64)| x.0.cmp(&y.0).then(x.1.total_cmp(&y.1));
    (0..costs.len()).min_by(|i, j| order(&costs[*i], &costs[*j])).unwrap_or(0)
}

/// Words for ribs in Chinese. They stand inside other words.
const RIBS: [&str; 2] = ["罗纹", "螺纹"];

/// Does a file say that a piece is cut of a rib?
pub fn is_rib(piece: &Piece) -> bool {
    word_of(piece, is_word_of_rib).is_some()
}

/// A word of a file that tells that a piece is cut of a knit.
pub fn word_of_knit(piece: &Piece) -> Option<String> {
    word_of(piece, |word| KNITS.contains(&word) || is_word_of_rib(word))
}

fn is_word_of_rib(word: &str) -> bool {
    let is_other = || ["RIBB", "TRIB", "CRIB"].iter().any(|other| word.contains(other));
    RIBS.iter().any(|rib| word.contains(rib)) || word.contains("RIB") && !is_other()
}

/// The first word of the name and the texts of a piece for which `holds` is true, in capital letters.
fn word_of(piece: &Piece, holds: impl Fn(&str) -> bool) -> Option<String> {
    let texts = [&piece.annotation, &piece.category].into_iter().flatten();
    let mut texts = texts.chain([&piece.name]).map(|t| t.to_uppercase());
    texts.find_map(|t| t.split(|c: char| !c.is_alphabetic()).find(|w| holds(w)).map(str::to_owned))
}

/// The longer side of a band, metres: half of what is left of its outline without its two ends.
fn long_side(piece: &Piece) -> f64 {
    let points = piece.outline.positions();
    let far = Vec2::repeat(f64::INFINITY);
    let [low, high] = points.iter().fold([far, -far], |[low, high], p| [low.inf(p), high.sup(p)]);
    let span = high - low;
    let perimeter: f64 = edges(piece).iter().map(|[length, _]| length).sum();
    (0.5 * perimeter - span.min()).max(span.max())
}

/// How often a piece is cut, as an annotation tells it: `2X FABRIC`, or `10 X 2` for ten sets.
pub fn count_told(piece: &Piece) -> Option<u32> {
    let text = piece.annotation.as_deref()?.trim().to_uppercase();
    let digits = |text: &str| text.chars().take_while(char::is_ascii_digit).collect::<String>();
    let first = digits(&text);
    let rest = text.get(first.len()..)?.trim_start().strip_prefix('X')?.trim_start();
    let second = digits(rest);
    let count: u32 = if second.is_empty() { first } else { second }.parse().ok()?;
    (1..=4).contains(&count).then_some(count)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_tell_ribs_and_other_knits() {
        let word = |category: &str| {
            let piece = Piece { category: Some(category.to_owned()), ..Piece::default() };
            (word_of_knit(&piece), is_rib(&piece))
        };
        assert_eq!(word("neckrib x"), (Some("NECKRIB".to_owned()), true));
        assert_eq!(word("Tight leg short"), (Some("TIGHT".to_owned()), false));
        let named = Piece { name: "袖口罗纹".to_owned(), ..Piece::default() };
        assert_eq!(word_of_knit(&named), Some("袖口罗纹".to_owned()));
        // A ribbon is no rib, and a tightener no legging.
        assert_eq!([word("RIBBON"), word("TIGHTENER"), word("")], [(None, false), (None, false), (None, false)]);
    }
}
