//! The shape of a factor: order of elimination and supernodes, from `faer`'s analysis (whole numbers only, so the same
//! on every machine).

use crate::linear::hessian::Pattern;
use crate::linear::nested_dissection;
use crate::linear::separator_halves::Halves;
use crate::linear::supernode::{Node, Owner, Run};
use faer::Side;
use faer::perm::PermRef;
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::linalg::{SupernodalThreshold, SymbolicSupernodalParams};

/// No node.
const NONE: u32 = u32::MAX;
/// Neighbouring supernodes are joined up to so many vertices when the share of zeros it stores stays below.
const RELAX: [(usize, f64); 4] = [(2, 1.0), (6, 0.8), (16, 0.1), (usize::MAX, 0.05)];

/// Vertices in the columns of a supernode, at most: wider ones are cut, so that half of their corner need not be stored, and
/// what is worked on at a time stays near the processor. In a small system that saves nothing.
const WIDE: u32 = 32;
const WIDE_OF_SMALL: u32 = 128;
/// Unknowns of a large one, at least.
const LARGE: usize = 3_000;

/// A factor that is larger by more than one part in so many asks for an order of its own, and so do couplings that are fewer
/// by as much.
const MUCH: usize = 5;
/// Couplings that are more by one part in so many are not even tried in an order.
const FAR: usize = 2;

/// Where a block of the pattern goes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Target {
    /// Index of its first scalar.
    at: u32,
    /// Height of its node; the last bit says whether the block is mirrored.
    shape: u32,
}

impl Target {
    /// `None` for a factor beyond all memory.
    fn new(at: usize, height: usize, mirrored: bool) -> Option<Self> {
        Some(Self { at: u32::try_from(at).ok()?, shape: u32::try_from(2 * height).ok()? | u32::from(mirrored) })
    }

    #[inline]
    pub fn is_mirrored(self) -> bool {
        self.shape & 1 == 1
    }

    /// Place of a scalar of the block in the factor.
    #[inline]
    pub fn scalar(self, row: usize, column: usize) -> usize {
        self.at as usize + column * (self.shape >> 1) as usize + row
    }
}

/// An order of elimination, and what it was made for.
#[derive(Clone, Debug, Default)]
pub(crate) struct Order {
    /// Unknowns as they are eliminated.
    unknowns: Vec<u32>,
    /// Place of every unknown among them.
    pub place: Vec<u32>,
    pairs: usize,
    /// Scalars of the factor then.
    length: usize,
}

impl Order {
    /// Was it made for much the same couplings?
    fn may_fit(&self, pattern: &Pattern) -> bool {
        let pairs = pattern.rows.len();
        let many = pairs >= self.pairs - self.pairs / MUCH && pairs <= self.pairs + self.pairs / FAR;
        pattern.unknowns() == self.place.len() && !self.place.is_empty() && many
    }
}

#[derive(Debug, Default)]
pub(crate) struct Symbolic {
    pub order: Order,
    /// Children before parents.
    pub nodes: Vec<Node>,
    /// Of a large system.
    pub halves: Halves,
    pub targets: Vec<Target>,
    /// Scalars of the factor.
    pub length: usize,
}

impl Symbolic {
    /// In an order of its own; `None` when there is nothing to factorise or no memory for it.
    pub fn new(pattern: &Pattern) -> Option<Self> {
        if pattern.unknowns() == 0 {
            return None;
        }
        let (unknowns, place) = nested_dissection::order(pattern)?;
        let order = Order { unknowns, place, pairs: pattern.rows.len(), length: 0 };
        let mut found = Self::in_order(pattern, order)?;
        found.order.length = found.length;
        Some(found)
    }

    /// In the order made for another pattern of the same unknowns: far cheaper than a new one, and as good while they are much the
    /// same. `None` where they are not.
    pub fn alike(pattern: &Pattern, order: &Order) -> Option<Self> {
        if !order.may_fit(pattern) {
            return None;
        }
        let found = Self::in_order(pattern, order.clone())?;
        (found.length <= order.length + order.length / MUCH).then_some(found)
    }

    fn in_order(pattern: &Pattern, order: Order) -> Option<Self> {
        let n = pattern.unknowns();
        let lower = SymbolicSparseColMatRef::new_checked(n, n, &pattern.start, None, &pattern.rows);
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            supernodal_params: SymbolicSupernodalParams { relax: Some(&RELAX) },
            ..CholeskySymbolicParams::default()
        };
        let ordering = SymmetricOrdering::Custom(PermRef::new_checked(&order.unknowns, &order.place, n));
        let analysis = factorize_symbolic_cholesky(lower, Side::Lower, ordering, params).ok()?;
        let (nodes, length) = if pattern.rows.len() == n { apart(n)? } else { nodes(&analysis)? };
        let targets = targets(pattern, &order.place, &nodes)?;
        let halves = if n < LARGE { Halves::none(&nodes) } else { Halves::new(&nodes) };
        Some(Self { order, nodes, halves, targets, length })
    }
}

/// Unknowns that know nothing of each other, as when only one vertex is free: `faer` makes no supernodes of them.
fn apart(n: usize) -> Option<(Vec<Node>, usize)> {
    let node = |k: u32| Node { first: k, columns: 1, rows: Vec::new(), owners: Vec::new(), start: 9 * k as usize };
    Some(((0..u32::try_from(n).ok()?).map(node).collect(), 9 * n))
}

fn nodes(analysis: &SymbolicCholesky<u32>) -> Option<(Vec<Node>, usize)> {
    let SymbolicCholeskyRaw::Supernodal(s) = analysis.raw() else { return None };
    let widest = if analysis.ncols() < LARGE { WIDE_OF_SMALL } else { WIDE };
    let (mut start, mut nodes) = (0, Vec::new());
    for k in 0..s.n_supernodes() {
        let (first, end) = (s.supernode_begin()[k], s.supernode_end()[k]);
        let mut rows = s.supernode(k).pattern().to_vec();
        rows.sort_unstable();
        for (from, to) in cuts(first, end, widest) {
            let rows = (to..end).chain(rows.iter().copied()).collect();
            let node = Node { first: from, columns: to - from, rows, owners: Vec::new(), start };
            start += node.height() * node.width();
            nodes.push(node);
        }
    }
    let owner = owners(&nodes);
    for k in 0..nodes.len() {
        let found = owners_of(k, &nodes, &owner)?;
        nodes[k].owners = found;
    }
    Some((nodes, start))
}

/// Columns by the nodes that hold them, none more than `widest`.
fn cuts(first: u32, end: u32, widest: u32) -> impl Iterator<Item = (u32, u32)> {
    (first..end).step_by(widest as usize).map(move |from| (from, end.min(from + widest)))
}

/// The owners of a node's rows, in order.
fn owners_of(k: usize, nodes: &[Node], owner: &[u32]) -> Option<Vec<Owner>> {
    let node = &nodes[k];
    let mut found = Vec::new();
    let mut from = 0;
    for same in node.rows.chunk_by(|p, q| owner[*p as usize] == owner[*q as usize]) {
        let at = owner[same[0] as usize];
        if at == NONE || at as usize <= k {
            return None;
        }
        let runs = runs(&node.rows[from..], node.columns + u32::try_from(from).ok()?, &nodes[at as usize]);
        from += same.len();
        found.push(Owner { node: at, to: node.width() + 3 * from, runs });
    }
    Some(found)
}

/// Where rows that stand at `first` and after it in one node stand in another.
fn runs(rows: &[u32], first: u32, node: &Node) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    for (k, row) in (first..).zip(rows) {
        let (from, to) = (3 * k, 3 * node.place(*row));
        match runs.last_mut() {
            Some(r) if r.to + r.length == to => r.length += 3,
            _ => runs.push(Run { from, to, length: 3 }),
        }
    }
    runs.shrink_to_fit();
    runs
}

/// The node of every column.
fn owners(nodes: &[Node]) -> Vec<u32> {
    let n = nodes.iter().map(|n| n.columns as usize).sum();
    let mut owner = vec![NONE; n];
    for (k, node) in (0u32..).zip(nodes) {
        owner[node.first as usize..(node.first + node.columns) as usize].fill(k);
    }
    owner
}

/// `None` for a factor beyond all memory.
fn targets(pattern: &Pattern, place: &[u32], nodes: &[Node]) -> Option<Vec<Target>> {
    let owner = owners(nodes);
    let mut targets = Vec::with_capacity(pattern.rows.len());
    for j in 0..pattern.unknowns() {
        for k in pattern.start[j] as usize..pattern.start[j + 1] as usize {
            let (column, row) = (place[j], place[pattern.rows[k] as usize]);
            let mirrored = row < column;
            let (column, row) = (column.min(row), column.max(row));
            let node = &nodes[owner[column as usize] as usize];
            let height = node.height();
            let at = node.start + 3 * node.place(column) as usize * height + 3 * node.place(row) as usize;
            targets.push(Target::new(at, height, mirrored)?);
        }
    }
    Some(targets)
}
