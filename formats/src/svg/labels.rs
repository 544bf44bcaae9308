//! Places of labels that do not lie on each other.

use super::canvas::Bounds;
use toile_garment::Vec2;

/// Half the width of a letter and half the height of a line, as shares of the size of a text, with some room around.
const HALF_LETTER: f64 = 0.32;
const HALF_LINE: f64 = 0.68;

/// The first of the wide letters, which are those of China, Japan and Korea, and how many narrow ones are as wide.
const WIDE_FROM: char = '\u{2e80}';
const WIDE: f64 = 1.65;

/// How many narrow letters a text is as wide as.
pub fn letters(text: &str) -> f64 {
    text.chars().map(|c| if c >= WIDE_FROM { WIDE } else { 1.0 }).sum()
}

/// The room that labels take.
#[derive(Clone, Debug, Default)]
pub struct Labels {
    taken: Vec<Bounds>,
}

impl Labels {
    /// Takes the room of a text whose place is fixed.
    pub fn take(&mut self, at: Vec2, size: f64, text: &str) {
        self.taken.push(room(at, &[(0.0, size, text)]));
    }

    /// Takes the room of a mark, such as a drill hole.
    pub fn take_mark(&mut self, at: Vec2, half: f64) {
        self.taken.push(Bounds { min: at.add_scalar(-half), max: at.add_scalar(half) });
    }

    /// The first of several places at which lines of text lie on no other label, and in a room that is good; their room
    /// is taken.
    pub fn free(
        &mut self,
        places: &[Vec2],
        lines: &[(f64, f64, &str)],
        is_good: impl Fn(&Bounds) -> bool,
    ) -> Option<Vec2> {
        let is_free = |room: &Bounds| self.taken.iter().all(|t| shared(t, room) <= 0.0);
        let rooms = places.iter().map(|at| (*at, room(*at, lines)));
        let (at, room) = rooms.into_iter().find(|(_, room)| is_free(room) && is_good(room))?;
        self.taken.push(room);
        Some(at)
    }

    /// The first of several places at which lines of text lie on no other label, else the one where they cover least;
    /// their room is taken. A line is told by its height above the place, its size and its text.
    pub fn place(&mut self, places: &[Vec2], lines: &[(f64, f64, &str)]) -> Option<Vec2> {
        let covered = |at: &Vec2| self.taken.iter().map(|t| shared(t, &room(*at, lines))).sum::<f64>();
        let costs: Vec<(f64, Vec2)> = places.iter().map(|at| (covered(at), *at)).collect();
        let free = costs.iter().find(|(cost, _)| *cost <= 0.0);
        let (_, at) = free.or_else(|| costs.iter().min_by(|a, b| a.0.total_cmp(&b.0)))?;
        self.taken.push(room(*at, lines));
        Some(*at)
    }
}

/// The rectangle around lines of text that are centred at a place.
pub fn room(at: Vec2, lines: &[(f64, f64, &str)]) -> Bounds {
    let corner = |(above, size, text): &(f64, f64, &str)| {
        let half = Vec2::new(HALF_LETTER * letters(text), HALF_LINE) * *size;
        let middle = at + Vec2::new(0.0, *above);
        [middle - half, middle + half]
    };
    Bounds::of(lines.iter().flat_map(corner)).unwrap_or(Bounds { min: at, max: at })
}

/// The area that two rectangles share.
fn shared(a: &Bounds, b: &Bounds) -> f64 {
    let size = a.max.inf(&b.max) - a.min.sup(&b.min);
    size.x.max(0.0) * size.y.max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_label_goes_where_none_lies_or_where_it_covers_least() {
        let mut labels = Labels::default();
        let [here, beside, far] = [0.0, 4.0, 20.0].map(|x| Vec2::new(x, 0.0));
        labels.take(here, 1.0, "dart-1 31.7 mm");
        assert_eq!(labels.place(&[here, beside, far], &[(0.0, 1.0, "dart-2 28.0 mm")]), Some(far));
        assert_eq!(labels.place(&[here, beside], &[(0.0, 1.0, "dart-3")]), Some(beside));
        assert_eq!(labels.place(&[], &[(0.0, 1.0, "x")]), None);
        let mut labels = Labels::default();
        labels.take_mark(here, 1.0);
        let line = [(0.0, 1.0, "dart-1")];
        assert_eq!(labels.free(&[here, beside], &line, |room| room.max.x > 9.0), None);
        assert_eq!(labels.free(&[here, beside], &line, |_| true), Some(beside));
        assert_eq!(labels.free(&[beside], &line, |_| true), None);
    }
}
