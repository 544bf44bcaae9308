//! Names of the free edges of a sewn garment, by the parts that they run along and by where they lie.

use super::surface::Hem;
use crate::roles::Part;

/// An edge that stays this far on one side of the middle of the body belongs to that side, metres.
const BESIDE_MIDDLE: f64 = 0.01;
/// An edge this near to the waist of the body lies on it, metres.
const AT_WAIST: f64 = 0.1;
/// An edge that reaches over this share of the height of the garment runs down an opening.
const RUNS_DOWN: f64 = 0.75;
/// The lowest edges of both sides are hems of legs in this share of the height of the garment.
const LEG_SHARE: f64 = 0.3;

/// A name without its side, and the side of the wearer.
type Word = (&'static str, Option<&'static str>);

/// Names of all free edges, such as `hem` and `armhole left`; no two are the same.
///
/// `hems` go from below to above, `parts` are those of the pieces, `waist` is a height, and `range` are the heights of
/// the whole cloth, metres.
#[must_use]
pub fn edge_names(hems: &[Hem], parts: &[Option<Part>], waist: Option<f64>, range: [f64; 2]) -> Vec<String> {
    let cloth = Cloth::of(hems, waist, range);
    let words: Vec<Word> = hems.iter().enumerate().map(|(k, hem)| (cloth.word(k, hem, parts), side(hem))).collect();
    let text = |word: &Word| [Some(word.0), word.1].into_iter().flatten().collect::<Vec<_>>().join(" ");
    let numbered = |(k, word): (usize, &Word)| {
        let same = |list: &[Word]| list.iter().filter(|w| *w == word).count();
        let name = text(word);
        if same(&words) > 1 { format!("{name} {}", same(&words[..=k])) } else { name }
    };
    words.iter().enumerate().map(numbered).collect()
}

/// The side of the wearer that an edge lies on as a whole.
fn side(hem: &Hem) -> Option<&'static str> {
    let [right, left] = hem.sides;
    match (right > BESIDE_MIDDLE, left < -BESIDE_MIDDLE) {
        (true, _) => Some("left"),
        (_, true) => Some("right"),
        _ => None,
    }
}

/// The garment that the edges belong to.
struct Cloth {
    range: [f64; 2],
    waist: Option<f64>,
    /// The lowest and the highest edge that goes around the middle of the body.
    middle: Option<[usize; 2]>,
    has_leg_hems: bool,
    has_armholes: bool,
}

impl Cloth {
    fn of(hems: &[Hem], waist: Option<f64>, range: [f64; 2]) -> Self {
        let around = |k: &usize| side(&hems[*k]).is_none() && !runs_down(&hems[*k], range);
        let all: Vec<usize> = (0..hems.len()).filter(around).collect();
        let middle = all.first().zip(all.last()).map(|(low, high)| [*low, *high]);
        let beside = |low: bool| hems.iter().any(|h| side(h).is_some() && (share(h, range) < LEG_SHARE) == low);
        Self { range, waist, middle, has_leg_hems: beside(true), has_armholes: beside(false) }
    }

    fn word(&self, k: usize, hem: &Hem, parts: &[Option<Part>]) -> &'static str {
        let mut of_pieces = hem.pieces.iter().map(|p| parts.get(*p as usize).copied().flatten());
        let first = of_pieces.next().flatten();
        let part = first.filter(|part| of_pieces.all(|other| other == Some(*part)));
        if let Some(word) = part.and_then(of_part) {
            return word;
        }
        if side(hem).is_some() {
            return if share(hem, self.range) < LEG_SHARE { "leg hem" } else { "armhole" };
        }
        if runs_down(hem, self.range) {
            return "front edge";
        }
        match self.middle {
            // One edge alone is the upper one of trousers, and of others that to which it is nearer.
            Some([low, high]) if low == high => {
                if self.has_leg_hems || share(hem, self.range) > 0.5 {
                    self.top(hem)
                } else {
                    "hem"
                }
            }
            Some([low, _]) if k == low => "hem",
            Some([_, high]) if k == high => self.top(hem),
            _ => "free edge",
        }
    }

    /// The word for the highest edge around the body.
    fn top(&self, hem: &Hem) -> &'static str {
        if self.waist.is_some_and(|waist| (hem.height - waist).abs() < AT_WAIST) {
            "waist edge"
        } else if self.has_armholes && self.waist.is_none_or(|waist| hem.height > waist) {
            "neckline"
        } else {
            "top edge"
        }
    }
}

/// How far up the garment an edge lies: 0 is its lowest point, 1 its highest.
fn share(hem: &Hem, [low, high]: [f64; 2]) -> f64 {
    (hem.height - low) / (high - low)
}

fn runs_down(hem: &Hem, [low, high]: [f64; 2]) -> bool {
    hem.heights[1] - hem.heights[0] > RUNS_DOWN * (high - low)
}

/// The edge of pieces that have one free edge each.
fn of_part(part: Part) -> Option<&'static str> {
    Some(match part {
        Part::Sleeve | Part::Cuff => "sleeve hem",
        Part::Collar | Part::Stand => "collar edge",
        Part::Hood => "hood edge",
        Part::Pocket => "pocket edge",
        Part::Lining => "lining edge",
        Part::Facing => "facing edge",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An edge of piece 0, between two places to the side and two heights.
    fn edge(sides: [f64; 2], heights: [f64; 2]) -> Hem {
        let middle = |x: [f64; 2]| 0.5 * (x[0] + x[1]);
        Hem {
            pieces: vec![0],
            height: middle(heights),
            side: middle(sides),
            sides,
            heights,
            length: 1.0,
            edges: Vec::new(),
        }
    }

    const AROUND: [f64; 2] = [-0.2, 0.2];

    #[test]
    fn edges_of_a_bodice_and_of_a_skirt_have_their_names() {
        let bodice = [
            edge(AROUND, [0.98, 1.0]),
            edge([-0.25, -0.15], [1.25, 1.4]),
            edge([0.15, 0.25], [1.25, 1.4]),
            edge([-0.1, 0.1], [1.4, 1.46]),
        ];
        let names = edge_names(&bodice, &[None], Some(1.05), [0.98, 1.46]);
        assert_eq!(names, ["hem", "armhole right", "armhole left", "neckline"]);
        let skirt = [edge(AROUND, [0.2, 0.22]), edge(AROUND, [1.04, 1.06])];
        assert_eq!(edge_names(&skirt, &[None], Some(1.05), [0.2, 1.06]), ["hem", "waist edge"]);
    }

    #[test]
    fn edges_of_trousers_and_of_an_open_jacket_have_their_names() {
        let trousers = [edge([0.02, 0.2], [0.1, 0.1]), edge([-0.2, -0.02], [0.1, 0.1]), edge(AROUND, [1.04, 1.06])];
        let names = edge_names(&trousers, &[Some(Part::Leg)], Some(1.05), [0.1, 1.06]);
        assert_eq!(names, ["leg hem left", "leg hem right", "waist edge"]);
        let sleeve = Hem { pieces: vec![1], ..edge([0.3, 0.5], [0.8, 0.9]) };
        let jacket = [sleeve, edge(AROUND, [0.8, 1.5])];
        let names = edge_names(&jacket, &[Some(Part::Bodice), Some(Part::Sleeve)], None, [0.8, 1.5]);
        assert_eq!(names, ["sleeve hem left", "front edge"]);
    }

    #[test]
    fn edges_without_a_word_of_their_own_are_numbered() {
        let layers = [0.2, 0.4, 0.5, 1.0].map(|y| edge(AROUND, [y, y]));
        let names = edge_names(&layers, &[None], None, [0.2, 1.0]);
        assert_eq!(names, ["hem", "free edge 1", "free edge 2", "top edge"]);
    }
}
