//! An order of elimination by nested dissection: a few vertices that part the cloth in two halves come last, and so on in
//! each half; small pieces in the order of least degree (George 1973; separators from fronts of a breadth-first search,
//! improved by moves after Fiduccia and Mattheyses 1982). Whole numbers only, so the same on every machine.

use super::hessian::Pattern;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;
use std::collections::BinaryHeap;

/// Fewer unknowns are ordered by least degree as a whole: it fills 10 % less at 1,000, as much at 5,000 to 10,000, and takes
/// a quarter more sums at 20,000, two fifths more at 50,000 (skirts, vertices).
const LARGE: usize = 15_000;
/// Pieces of at most so many unknowns are not parted.
const SMALL: usize = 120;
/// Largest share of a piece that may lie on one side, as a fraction.
const UNEVEN: (usize, usize) = (13, 20);
/// Fronts that are tried.
const FRONTS: usize = 3;
/// Rounds of moves, and moves in a row without gain after which a round ends.
const ROUNDS: usize = 6;
const IDLE: usize = 120;
/// A piece is not parted by more than one in so many of it.
const DEAR: usize = 4;

const FIRST: u8 = 0;
const SECOND: u8 = 1;
const BETWEEN: u8 = 2;
const NONE: u32 = u32::MAX;

/// Neighbours of every unknown.
struct Graph {
    start: Vec<u32>,
    ends: Vec<u32>,
}

impl Graph {
    fn new(pattern: &Pattern) -> Self {
        let n = pattern.unknowns();
        let mut count = vec![0u32; n + 1];
        let pairs = || {
            (0..n).flat_map(|c| {
                let rows = &pattern.rows[pattern.start[c] as usize + 1..pattern.start[c + 1] as usize];
                rows.iter().map(move |r| (c, *r as usize))
            })
        };
        for (c, r) in pairs() {
            count[c + 1] += 1;
            count[r + 1] += 1;
        }
        for i in 0..n {
            count[i + 1] += count[i];
        }
        let (start, mut at) = (count.clone(), count);
        let mut ends = vec![0; start[n] as usize];
        for (c, r) in pairs() {
            for (a, b) in [(c, r), (r, c)] {
                ends[at[a] as usize] = u32::try_from(b).unwrap_or(NONE);
                at[a] += 1;
            }
        }
        Self { start, ends }
    }

    #[inline]
    fn around(&self, v: u32) -> &[u32] {
        &self.ends[self.start[v as usize] as usize..self.start[v as usize + 1] as usize]
    }
}

/// The order in which unknowns are eliminated, and the place of each in it.
pub(crate) fn order(pattern: &Pattern) -> Option<(Vec<u32>, Vec<u32>)> {
    let n = u32::try_from(pattern.unknowns()).ok()?;
    let mut d = Dissection::new(pattern, n);
    if pattern.unknowns() < LARGE {
        d.least_degree(&(0..n).collect::<Vec<_>>())?;
    } else {
        d.part((0..n).collect())?;
    }
    let mut place = d.local;
    (0..n).zip(&d.order).for_each(|(k, v)| place[*v as usize] = k);
    Some((d.order, place))
}

struct Dissection {
    graph: Graph,
    /// The piece that every unknown is in now.
    piece: Vec<u32>,
    pieces: u32,
    side: Vec<u8>,
    /// Marks, or numbers in a piece, while they are needed.
    local: Vec<u32>,
    order: Vec<u32>,
}

impl Dissection {
    fn new(pattern: &Pattern, n: u32) -> Self {
        let n = n as usize;
        let order = Vec::with_capacity(n);
        let (piece, side, local) = (vec![0; n], vec![FIRST; n], vec![NONE; n]);
        Self { graph: Graph::new(pattern), piece, pieces: 1, side, local, order }
    }

    /// Orders a piece.
    fn part(&mut self, piece: Vec<u32>) -> Option<()> {
        if piece.len() <= SMALL {
            return self.least_degree(&piece);
        }
        let own = self.piece[piece[0] as usize];
        for v in &piece {
            if self.piece[*v as usize] != own {
                continue;
            }
            let connected = self.front(*v);
            if connected.len() == piece.len() {
                return self.part_connected(&piece);
            }
            self.name(&connected);
            self.part_connected(&connected)?;
        }
        Some(())
    }

    /// Makes a piece of its own of these.
    fn name(&mut self, piece: &[u32]) {
        piece.iter().for_each(|v| self.piece[*v as usize] = self.pieces);
        self.pieces += 1;
    }

    /// Orders a piece that hangs together. As deep as halves can be halved.
    fn part_connected(&mut self, piece: &[u32]) -> Option<()> {
        let between = if piece.len() > SMALL { self.separate(piece) } else { None };
        let Some(between) = between else { return self.least_degree(piece) };
        let half = |side| -> Vec<u32> { piece.iter().copied().filter(|v| self.side[*v as usize] == side).collect() };
        for half in [half(FIRST), half(SECOND)] {
            self.name(&half);
            self.part(half)?;
        }
        self.order.extend(between);
        Some(())
    }

    fn neighbours(&self, v: u32) -> impl Iterator<Item = u32> + '_ {
        let piece = self.piece[v as usize];
        self.graph.around(v).iter().copied().filter(move |w| self.piece[*w as usize] == piece)
    }

    /// All of the piece that `from` reaches, the nearest first.
    fn front(&mut self, from: u32) -> Vec<u32> {
        let mut seen = vec![from];
        self.local[from as usize] = 0;
        let mut next = 0;
        while let Some(v) = seen.get(next).copied() {
            next += 1;
            let piece = self.piece[v as usize];
            for w in self.graph.around(v) {
                if self.piece[*w as usize] == piece && self.local[*w as usize] == NONE {
                    self.local[*w as usize] = 0;
                    seen.push(*w);
                }
            }
        }
        seen.iter().for_each(|v| self.local[*v as usize] = NONE);
        seen
    }

    /// Parts a piece in two sides; what lies between them, `None` where that is too much.
    fn separate(&mut self, piece: &[u32]) -> Option<Vec<u32>> {
        let mut front = self.front(piece[0]);
        let mut best: Option<(usize, Vec<u8>)> = None;
        for _ in 0..FRONTS {
            let far = *front.last()?;
            front = self.front(far);
            self.halve(&front);
            (0..ROUNDS).take_while(|_| self.improve(piece)).count();
            let between = piece.iter().filter(|v| self.side[**v as usize] == BETWEEN).count();
            if best.as_ref().is_none_or(|b| between < b.0) {
                best = Some((between, piece.iter().map(|v| self.side[*v as usize]).collect()));
            }
        }
        let (size, sides) = best?;
        if size * DEAR > piece.len() {
            return None;
        }
        piece.iter().zip(sides).for_each(|(v, s)| self.side[*v as usize] = s);
        Some(piece.iter().copied().filter(|v| self.side[*v as usize] == BETWEEN).collect())
    }

    /// The nearer half on the first side; of the other, what touches it lies between.
    fn halve(&mut self, front: &[u32]) {
        let (near, far) = front.split_at(front.len() / 2);
        near.iter().for_each(|v| self.side[*v as usize] = FIRST);
        far.iter().for_each(|v| self.side[*v as usize] = SECOND);
        for v in far {
            if self.neighbours(*v).any(|w| self.side[w as usize] == FIRST) {
                self.side[*v as usize] = BETWEEN;
            }
        }
    }

    /// One round of moves out of what lies between; says whether it became less.
    fn improve(&mut self, piece: &[u32]) -> bool {
        let mut round = Round::new(self, piece);
        let before = round.sizes[usize::from(BETWEEN)];
        round.go();
        let best = round.undo();
        best < before
    }

    /// A small piece, in the order of least degree.
    fn least_degree(&mut self, piece: &[u32]) -> Option<()> {
        for (k, v) in (0u32..).zip(piece) {
            self.local[*v as usize] = k;
        }
        let mut start = vec![0u32];
        let mut rows: Vec<u32> = Vec::new();
        for v in piece {
            rows.push(self.local[*v as usize]);
            rows.extend(self.neighbours(*v).map(|w| self.local[w as usize]).filter(|k| *k > self.local[*v as usize]));
            start.push(u32::try_from(rows.len()).ok()?);
        }
        piece.iter().for_each(|v| self.local[*v as usize] = NONE);
        let n = piece.len();
        let matrix = SymbolicSparseColMatRef::new_unsorted_checked(n, n, &start, None, &rows);
        let (mut order, mut place) = (vec![0u32; n], vec![0u32; n]);
        let mut memory = MemBuffer::try_new(amd::order_maybe_unsorted_scratch::<u32>(n, rows.len())).ok()?;
        let stack = MemStack::new(&mut memory);
        amd::order_maybe_unsorted(&mut order, &mut place, matrix, amd::Control::default(), stack).ok()?;
        self.order.extend(order.iter().map(|k| piece[*k as usize]));
        Some(())
    }
}

/// Moves of one round: who has moved stays until it is over.
struct Round<'a> {
    of: &'a mut Dissection,
    most: usize,
    sizes: [usize; 3],
    offers: BinaryHeap<(i64, u32, u8)>,
    /// Whose side changed, and what it was.
    log: Vec<(u32, u8)>,
    moved: Vec<u32>,
    /// Fewest that lay between, and how long the log was then.
    best: usize,
    kept: usize,
}

impl<'a> Round<'a> {
    fn new(of: &'a mut Dissection, piece: &[u32]) -> Self {
        let mut sizes = [0usize; 3];
        piece.iter().for_each(|v| sizes[usize::from(of.side[*v as usize])] += 1);
        let most = piece.len() * UNEVEN.0 / UNEVEN.1;
        let best = sizes[usize::from(BETWEEN)];
        let (offers, log, moved) = (BinaryHeap::new(), Vec::new(), Vec::new());
        let mut round = Self { of, most, sizes, offers, log, moved, best, kept: 0 };
        for v in piece {
            if round.of.side[*v as usize] == BETWEEN {
                round.offer(*v);
            }
        }
        round
    }

    /// By how much fewer lie between when `v` goes to a side.
    fn gain(&self, v: u32, to: u8) -> i64 {
        1 - self.of.neighbours(v).filter(|w| self.of.side[*w as usize] == 1 - to).count() as i64
    }

    fn offer(&mut self, v: u32) {
        for to in [FIRST, SECOND] {
            self.offers.push((self.gain(v, to), v, to));
        }
    }

    fn set(&mut self, v: u32, side: u8) {
        let before = std::mem::replace(&mut self.of.side[v as usize], side);
        self.sizes[usize::from(before)] -= 1;
        self.sizes[usize::from(side)] += 1;
        self.log.push((v, before));
    }

    /// Takes the best moves, also such that lose, until long none has won.
    fn go(&mut self) {
        let mut idle = 0;
        while let Some((gain, v, to)) = self.offers.pop().filter(|_| idle <= IDLE) {
            if self.of.side[v as usize] != BETWEEN || self.of.local[v as usize] != NONE {
                continue;
            }
            let now = self.gain(v, to);
            if now != gain {
                self.offers.push((now, v, to));
            } else if self.sizes[usize::from(to)] < self.most {
                self.take(v, to);
                idle += 1;
                if self.sizes[usize::from(BETWEEN)] < self.best {
                    (self.best, self.kept, idle) = (self.sizes[usize::from(BETWEEN)], self.log.len(), 0);
                }
            }
        }
    }

    /// Moves `v` to a side; what it touches on the other lies between from now on.
    fn take(&mut self, v: u32, to: u8) {
        self.of.local[v as usize] = 0;
        self.moved.push(v);
        self.set(v, to);
        let drawn: Vec<u32> = self.of.neighbours(v).filter(|w| self.of.side[*w as usize] == 1 - to).collect();
        for w in drawn {
            self.set(w, BETWEEN);
            self.offer(w);
        }
    }

    /// Back to where the fewest lay between; how many those were.
    fn undo(self) -> usize {
        for (v, side) in self.log[self.kept..].iter().rev() {
            self.of.side[*v as usize] = *side;
        }
        self.moved.iter().for_each(|v| self.of.local[*v as usize] = NONE);
        self.best
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square grid, each knot coupled with those up to two lines away.
    fn grid(side: u32) -> Pattern {
        let mut pairs = Vec::new();
        for (r, c) in (0..side).flat_map(|r| (0..side).map(move |c| (r, c))) {
            for (dr, dc) in [(0, 1), (1, 0), (1, 1), (0, 2), (2, 0)] {
                if r + dr < side && c + dc < side {
                    pairs.push([r * side + c, (r + dr) * side + c + dc]);
                }
            }
        }
        Pattern::new((side * side) as usize, pairs)
    }

    /// Sums of the factor of a matrix eliminated in this order.
    fn sums(pattern: &Pattern, order: &[u32]) -> usize {
        let graph = Graph::new(pattern);
        let mut place = vec![0; order.len()];
        (0..).zip(order).for_each(|(k, v): (usize, &u32)| place[*v as usize] = k);
        let mut rows: Vec<std::collections::BTreeSet<usize>> = vec![std::collections::BTreeSet::new(); order.len()];
        for (k, v) in order.iter().enumerate() {
            rows[k].extend(graph.around(*v).iter().map(|w| place[*w as usize]).filter(|p| *p > k));
        }
        let mut all = 0;
        for k in 0..order.len() {
            let column = std::mem::take(&mut rows[k]);
            all += column.len() * column.len();
            if let Some(next) = column.first().copied() {
                rows[next].extend(column.into_iter().skip(1));
            }
        }
        all
    }

    #[test]
    fn the_order_holds_every_unknown_once() {
        let pattern = grid(123);
        let (order, place) = order(&pattern).expect("an order");
        assert!((0..15_129).all(|v: u32| order[place[v as usize] as usize] == v));
    }

    /// Against the order of least degree of the whole.
    #[test]
    fn large_cloth_takes_fewer_sums_than_in_the_order_of_least_degree() {
        let pattern = grid(125);
        let (parted, _) = order(&pattern).expect("an order");
        let n = u32::try_from(pattern.unknowns()).expect("small");
        let mut d = Dissection::new(&pattern, n);
        d.least_degree(&(0..n).collect::<Vec<_>>()).expect("an order");
        let (ours, least) = (sums(&pattern, &parted), sums(&pattern, &d.order));
        assert!(10 * ours < 9 * least, "{ours} and {least}");
    }

    #[test]
    fn pieces_that_do_not_hang_together_are_ordered_one_by_one() {
        let one = grid(16);
        let mut pairs = Vec::new();
        for c in 0..256u32 {
            for k in one.start[c as usize] as usize + 1..one.start[c as usize + 1] as usize {
                pairs.extend([[c, one.rows[k]], [c + 256, one.rows[k] + 256]]);
            }
        }
        let mut d = Dissection::new(&Pattern::new(512, pairs), 512);
        d.part((0..512).collect()).expect("an order");
        let mut first: Vec<u32> = d.order[..256].to_vec();
        first.sort_unstable();
        assert!(first == (0..256).collect::<Vec<_>>() || first == (256..512).collect::<Vec<_>>());
    }
}
