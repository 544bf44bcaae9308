//! Symbolic analysis: the order of elimination and the supernodes of a factor.
//!
//! Nested dissection gives the order (`nested_dissection/`). `faer` orders small parts and counts the factor's entries.
//!
//! It has whole numbers only, so it is the same on every machine.

use crate::linear::nested_dissection;
use crate::linear::pattern::Pattern;
use crate::linear::separator_halves::SeparatorHalves;
use crate::linear::supernode::{Ancestor, Node, RowRun};
use crate::linear::tuning::{
    LARGE_SYSTEM_UNKNOWNS, MERGED_LARGE_ZEROS, MERGED_MIDDLE_VERTICES, MERGED_MIDDLE_ZEROS, MERGED_SMALL_VERTICES,
    MERGED_SMALL_ZEROS, ORDER_REUSE, ORDER_REUSE_COUPLING_PARTS, ORDER_REUSE_GROWTH_PARTS, SEPARATOR_HALVES,
    SUPERNODE_COLUMNS_MAX, SUPERNODE_COLUMNS_MAX_SMALL,
};
use faer::Side;
use faer::perm::PermRef;
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::linalg::{SupernodalThreshold, SymbolicSupernodalParams};

/// The number of no node.
const NONE: u32 = u32::MAX;
/// Numbers of vertices up to which neighbouring supernodes are merged, each with the largest share of stored zeros.
fn merging() -> [(usize, f64); 4] {
    [
        (2, 1.0),
        (MERGED_SMALL_VERTICES.get(), MERGED_SMALL_ZEROS.get()),
        (MERGED_MIDDLE_VERTICES.get(), MERGED_MIDDLE_ZEROS.get()),
        (usize::MAX, MERGED_LARGE_ZEROS.get()),
    ]
}

/// The place of a block of the pattern in the factor.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BlockTarget {
    /// Index of its first scalar.
    at: u32,
    /// Twice the height of its node; the last bit is set for a mirrored block.
    shape: u32,
}

impl BlockTarget {
    /// The target of a block; `None` for a factor with more numbers than 32 bits count.
    fn new(at: usize, height: usize, mirrored: bool) -> Option<Self> {
        Some(Self { at: u32::try_from(at).ok()?, shape: u32::try_from(2 * height).ok()? | u32::from(mirrored) })
    }

    /// Returns `true` for a block that is stored transposed.
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

/// An order of elimination, and the size of the system for which it was made.
#[derive(Clone, Debug, Default)]
pub(crate) struct EliminationOrder {
    /// Unknowns in the order of their elimination.
    unknowns: Vec<u32>,
    /// Place of every unknown among them.
    pub place: Vec<u32>,
    /// Blocks of the pattern for which it was made.
    pairs: usize,
    /// Scalars of the factor for which it was made.
    length: usize,
}

impl EliminationOrder {
    /// Returns `true` if it was made for nearly the same couplings.
    fn may_fit(&self, pattern: &Pattern) -> bool {
        let pairs = pattern.rows.len();
        let many = pairs >= self.pairs - self.pairs / ORDER_REUSE_GROWTH_PARTS.get()
            && pairs <= self.pairs + self.pairs / ORDER_REUSE_COUPLING_PARTS.get();
        pattern.unknowns() == self.place.len() && !self.place.is_empty() && many
    }
}

/// The symbolic factor of a pattern.
#[derive(Debug, Default)]
pub(crate) struct Symbolic {
    pub order: EliminationOrder,
    /// Children before parents.
    pub nodes: Vec<Node>,
    /// Halves of the factor of a large system.
    pub halves: SeparatorHalves,
    /// Targets of the blocks of the pattern.
    pub targets: Vec<BlockTarget>,
    /// Scalars of the factor.
    pub length: usize,
}

impl Symbolic {
    /// The analysis in a new order; `None` when there is nothing to factorise or no memory for it.
    pub fn new(pattern: &Pattern) -> Option<Self> {
        if pattern.unknowns() == 0 {
            return None;
        }
        let (unknowns, place) = nested_dissection::order(pattern)?;
        let order = EliminationOrder { unknowns, place, pairs: pattern.rows.len(), length: 0 };
        let mut found = Self::in_order(pattern, order)?;
        found.order.length = found.length;
        Some(found)
    }

    /// The analysis in the order made for another pattern of the same unknowns; `None` where the patterns differ much.
    ///
    /// It is far cheaper than a new order, and as good while the patterns are nearly the same.
    pub fn with_order_of(pattern: &Pattern, order: &EliminationOrder) -> Option<Self> {
        if !(ORDER_REUSE.is_on() && order.may_fit(pattern)) {
            return None;
        }
        let found = Self::in_order(pattern, order.clone())?;
        (found.length <= order.length + order.length / ORDER_REUSE_GROWTH_PARTS.get()).then_some(found)
    }

    fn in_order(pattern: &Pattern, order: EliminationOrder) -> Option<Self> {
        let n = pattern.unknowns();
        let lower = SymbolicSparseColMatRef::new_checked(n, n, &pattern.start, None, &pattern.rows);
        let merging = merging();
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            supernodal_params: SymbolicSupernodalParams { relax: Some(&merging) },
            ..CholeskySymbolicParams::default()
        };
        let ordering = SymmetricOrdering::Custom(PermRef::new_checked(&order.unknowns, &order.place, n));
        let analysis = factorize_symbolic_cholesky(lower, Side::Lower, ordering, params).ok()?;
        let (nodes, length) = if pattern.rows.len() == n { uncoupled_nodes(n)? } else { nodes(&analysis)? };
        drop(analysis);
        let targets = targets(pattern, &order.place, &nodes)?;
        let halves = if n >= LARGE_SYSTEM_UNKNOWNS.get() && SEPARATOR_HALVES.is_on() {
            SeparatorHalves::new(&nodes)
        } else {
            SeparatorHalves::none(&nodes)
        };
        Some(Self { order, nodes, halves, targets, length })
    }
}

/// Nodes of uncoupled unknowns, as when only one vertex is free; `faer` makes no supernodes of them.
fn uncoupled_nodes(n: usize) -> Option<(Vec<Node>, usize)> {
    let node = |k: u32| Node { first: k, columns: 1, rows: Vec::new(), ancestors: Vec::new(), start: 9 * k as usize };
    Some(((0..u32::try_from(n).ok()?).map(node).collect(), 9 * n))
}

/// The supernodes of an analysis and the number of scalars of the factor; wide ones are cut.
fn nodes(analysis: &SymbolicCholesky<u32>) -> Option<(Vec<Node>, usize)> {
    let SymbolicCholeskyRaw::Supernodal(s) = analysis.raw() else { return None };
    let widest = if analysis.ncols() < LARGE_SYSTEM_UNKNOWNS.get() {
        SUPERNODE_COLUMNS_MAX_SMALL.get()
    } else {
        SUPERNODE_COLUMNS_MAX.get()
    };
    let (mut start, mut nodes) = (0, Vec::new());
    for k in 0..s.n_supernodes() {
        let (first, end) = (s.supernode_begin()[k], s.supernode_end()[k]);
        let mut rows = s.supernode(k).pattern().to_vec();
        rows.sort_unstable();
        for (from, to) in cuts(first, end, widest) {
            let rows = (to..end).chain(rows.iter().copied()).collect();
            let node = Node { first: from, columns: to - from, rows, ancestors: Vec::new(), start };
            start += node.height() * node.width();
            nodes.push(node);
        }
    }
    let node_of = node_of_column(&nodes);
    for k in 0..nodes.len() {
        let found = ancestors_of(k, &nodes, &node_of)?;
        nodes[k].ancestors = found;
    }
    Some((nodes, start))
}

/// Ranges of the columns `first..end`, each of at most `widest`.
fn cuts(first: u32, end: u32, widest: u32) -> impl Iterator<Item = (u32, u32)> {
    (first..end).step_by(widest as usize).map(move |from| (from, end.min(from + widest)))
}

/// The ancestors of a node, in the order of its rows.
fn ancestors_of(k: usize, nodes: &[Node], node_of: &[u32]) -> Option<Vec<Ancestor>> {
    let node = &nodes[k];
    let mut found = Vec::new();
    let mut from = 0;
    for same in node.rows.chunk_by(|p, q| node_of[*p as usize] == node_of[*q as usize]) {
        let at = node_of[same[0] as usize];
        if at == NONE || at as usize <= k {
            return None;
        }
        let runs = runs(&node.rows[from..], node.columns + u32::try_from(from).ok()?, &nodes[at as usize]);
        from += same.len();
        found.push(Ancestor { node: at, to: node.width() + 3 * from, runs });
    }
    Some(found)
}

/// Runs of the rows that stand at `first` and after it in one node and somewhere in another.
fn runs(rows: &[u32], first: u32, node: &Node) -> Vec<RowRun> {
    let mut runs: Vec<RowRun> = Vec::new();
    for (k, row) in (first..).zip(rows) {
        let (from, to) = (3 * k, 3 * node.place(*row));
        match runs.last_mut() {
            Some(r) if r.to + r.length == to => r.length += 3,
            _ => runs.push(RowRun { from, to, length: 3 }),
        }
    }
    runs.shrink_to_fit();
    runs
}

/// The node of every column.
fn node_of_column(nodes: &[Node]) -> Vec<u32> {
    let n = nodes.iter().map(|n| n.columns as usize).sum();
    let mut node_of = vec![NONE; n];
    for (k, node) in (0u32..).zip(nodes) {
        node_of[node.first as usize..(node.first + node.columns) as usize].fill(k);
    }
    node_of
}

/// The targets of all blocks of a pattern; `None` for a factor with more numbers than 32 bits count.
fn targets(pattern: &Pattern, place: &[u32], nodes: &[Node]) -> Option<Vec<BlockTarget>> {
    let node_of = node_of_column(nodes);
    let mut targets = Vec::with_capacity(pattern.rows.len());
    for j in 0..pattern.unknowns() {
        for k in pattern.start[j] as usize..pattern.start[j + 1] as usize {
            let (column, row) = (place[j], place[pattern.rows[k] as usize]);
            let mirrored = row < column;
            let (column, row) = (column.min(row), column.max(row));
            let node = &nodes[node_of[column as usize] as usize];
            let height = node.height();
            let at = node.start + 3 * node.place(column) as usize * height + 3 * node.place(row) as usize;
            targets.push(BlockTarget::new(at, height, mirrored)?);
        }
    }
    Some(targets)
}
