//! Supernodes: neighbouring columns of the factor that have the same rows below them.

use super::dense::STRIP;
use faer::Side;
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};

/// Columns that share their rows; counted in vertices, each two numbers.
pub struct Node {
    /// Place of the first column in the order of elimination.
    pub first: u32,
    /// Number of columns.
    pub columns: u32,
    /// Rows below the columns, ascending.
    pub rows: Vec<u32>,
    /// The nodes whose columns are `rows`.
    pub ancestors: Vec<Ancestor>,
    /// Index of its first number in the factor. It is stored by columns, with the square of its own columns on top.
    pub start: usize,
}

/// A node in which some rows of another one are columns.
pub struct Ancestor {
    /// Index of its first number, and numbers from one of its columns to the next.
    pub at: (usize, usize),
    /// First of these rows, and the one after them.
    pub rows: [usize; 2],
    /// Places of these rows and of all after them in that node.
    pub places: Vec<u32>,
}

impl Node {
    /// Number of numbers in a column.
    pub fn height(&self) -> usize {
        2 * (self.columns as usize + self.rows.len())
    }

    /// Number of columns of numbers.
    pub fn width(&self) -> usize {
        2 * self.columns as usize
    }

    /// Numbers from one column to the next: whole strips.
    pub fn stride(&self) -> usize {
        self.height().next_multiple_of(STRIP)
    }

    /// The place of a vertex among the columns and rows.
    pub fn place(&self, row: u32) -> usize {
        if row < self.first + self.columns {
            return (row - self.first) as usize;
        }
        self.columns as usize + self.rows.partition_point(|r| *r < row)
    }

    fn index(&self, k: usize) -> usize {
        let vertex = match (k / 2).checked_sub(self.columns as usize) {
            None => self.first as usize + k / 2,
            Some(below) => self.rows[below] as usize,
        };
        2 * vertex + k % 2
    }

    /// Takes the columns out of a right side.
    pub fn forward(&self, values: &[f64], x: &mut [f64], local: &mut Vec<f64>) {
        let (height, width) = (self.height(), self.width());
        local.clear();
        local.resize(height, 0.0);
        local[..width].copy_from_slice(&x[2 * self.first as usize..][..width]);
        for (c, column) in values[self.start..].chunks(self.stride()).take(width).enumerate() {
            let now = local[c] / column[c];
            local[c] = now;
            local[c + 1..].iter_mut().zip(&column[c + 1..]).for_each(|(l, v)| *l -= v * now);
        }
        x[2 * self.first as usize..][..width].copy_from_slice(&local[..width]);
        (width..height).for_each(|k| x[self.index(k)] += local[k]);
    }

    /// Finds the unknowns of the columns from those of the rows.
    pub fn backward(&self, values: &[f64], x: &mut [f64], local: &mut Vec<f64>) {
        let (height, width) = (self.height(), self.width());
        local.clear();
        local.extend((0..height).map(|k| x[self.index(k)]));
        for c in (0..width).rev() {
            let column = &values[self.start + c * self.stride()..][..height];
            let known: f64 = local[c + 1..].iter().zip(&column[c + 1..]).map(|(l, v)| l * v).sum();
            local[c] = (local[c] - known) / column[c];
        }
        x[2 * self.first as usize..][..width].copy_from_slice(&local[..width]);
    }
}

/// The place of every vertex in the order of elimination, the nodes, and the length of the factor.
pub fn supernodes(n: usize, start: &[usize], rows: &[u32]) -> Option<(Vec<u32>, Vec<Node>, usize)> {
    if rows.len() == n {
        // Nothing is coupled, and the library makes no supernodes.
        let order: Vec<u32> = (0..u32::try_from(n).ok()?).collect();
        let (nodes, length) = placed(order.iter().map(|k| (*k, 1, Vec::new())))?;
        return Some((order, nodes, length));
    }
    let start: Vec<u32> = start.iter().map(|s| u32::try_from(*s)).collect::<Result<_, _>>().ok()?;
    let lower = SymbolicSparseColMatRef::new_checked(n, n, &start, None, rows);
    let params = CholeskySymbolicParams {
        supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
        ..CholeskySymbolicParams::default()
    };
    let analysis = factorize_symbolic_cholesky(lower, Side::Lower, SymmetricOrdering::Amd, params).ok()?;
    let place = match analysis.perm() {
        Some(perm) => perm.arrays().1.to_vec(),
        None => (0..u32::try_from(n).ok()?).collect(),
    };
    let (nodes, length) = placed(found(&analysis)?.into_iter())?;
    Some((place, nodes, length))
}

/// First column, number of columns, and rows below.
type Columns = (u32, u32, Vec<u32>);

fn found(analysis: &SymbolicCholesky<u32>) -> Option<Vec<Columns>> {
    let SymbolicCholeskyRaw::Supernodal(s) = analysis.raw() else { return None };
    let columns = |k: usize| {
        let (first, end) = (s.supernode_begin()[k], s.supernode_end()[k]);
        let mut rows = s.supernode(k).pattern().to_vec();
        rows.sort_unstable();
        (first, end - first, rows)
    };
    Some((0..s.n_supernodes()).map(columns).collect())
}

/// Nodes with their places in the factor and in each other.
fn placed(columns: impl Iterator<Item = Columns>) -> Option<(Vec<Node>, usize)> {
    let (mut nodes, mut length, mut node_of) = (Vec::new(), 0usize, Vec::new());
    for (k, (first, columns, rows)) in columns.enumerate() {
        let node = Node { first, columns, rows, ancestors: Vec::new(), start: length };
        length = length.checked_add(node.stride().checked_mul(node.width())?)?;
        node_of.extend(std::iter::repeat_n(k, columns as usize));
        nodes.push(node);
    }
    for k in 0..nodes.len() {
        let (node, mut from) = (&nodes[k], 0);
        let mut ancestors = Vec::new();
        for same in node.rows.chunk_by(|p, q| node_of[*p as usize] == node_of[*q as usize]) {
            let to = &nodes[node_of[same[0] as usize]];
            let places = node.rows[from..].iter().map(|r| to.place(*r) as u32).collect();
            ancestors.push(Ancestor { at: (to.start, to.stride()), rows: [from, from + same.len()], places });
            from += same.len();
        }
        nodes[k].ancestors = ancestors;
    }
    Some((nodes, length))
}
