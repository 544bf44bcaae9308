//! A Cholesky factor in double precision: 2 × 2 blocks, one per pair of vertices, and columns taken together in supernodes.
//!
//! Libraries choose the order of their sums by the processor, so the kernels are our own. They use registers as wide as
//! the processor has, and every sum has one order and products that are fused into it: the bits are the same everywhere.
//! A library orders the vertices and finds the supernodes, which are whole numbers.

mod dense;
mod eliminate;
mod supernodes;

use eliminate::Eliminate;
use nalgebra::Matrix2;
use pulp::Arch;
use supernodes::{Node, supernodes};
use toile_garment::Vec2;

/// A factor for one pattern of blocks.
pub struct Factor {
    /// The place of every vertex in the order of elimination.
    place: Vec<u32>,
    /// Children before parents.
    nodes: Vec<Node>,
    /// Where the blocks of the pattern stand.
    targets: Vec<Target>,
    /// Columns of the nodes.
    values: Vec<f64>,
    /// Right side, then solution, in the order of elimination.
    x: Vec<f64>,
    arch: Arch,
}

/// The place of a block in the factor.
#[derive(Clone, Copy)]
struct Target {
    /// Index of its first number.
    at: usize,
    /// Numbers from one column to the next.
    stride: usize,
    /// True where it is stored transposed.
    mirrored: bool,
}

impl Factor {
    /// An empty factor of `n` vertices. The blocks are the lower triangle by columns: the rows of column `c` are
    /// `rows[start[c]..start[c + 1]]`, ascending from the diagonal. `None` when there is no memory.
    pub fn new(n: usize, start: &[usize], rows: &[u32]) -> Option<Self> {
        let (place, nodes, length) = supernodes(n, start, rows)?;
        let mut node_of = Vec::with_capacity(n);
        for (k, node) in nodes.iter().enumerate() {
            node_of.extend(std::iter::repeat_n(k, node.columns as usize));
        }
        let target = |(column, row): (usize, u32)| {
            let (c, r) = (place[column], place[row as usize]);
            let node = &nodes[node_of[c.min(r) as usize]];
            let at = node.start + 2 * node.place(c.min(r)) * node.stride() + 2 * node.place(c.max(r));
            Target { at, stride: node.stride(), mirrored: r < c }
        };
        let blocks = (0..n).flat_map(|c| rows[start[c]..start[c + 1]].iter().map(move |r| (c, *r)));
        let targets = blocks.map(target).collect();
        let mut values = Vec::new();
        values.try_reserve_exact(length).ok()?;
        values.resize(length, 0.0);
        Some(Self { place, nodes, targets, values, x: vec![0.0; 2 * n], arch: Arch::new() })
    }

    /// Factors the matrix of these blocks, in the order of the pattern. `false` when it is not positive definite.
    pub fn eliminate(&mut self, blocks: &[Matrix2<f64>]) -> bool {
        self.values.fill(0.0);
        for (block, target) in blocks.iter().zip(&self.targets) {
            let (a, b) = if target.mirrored { (block.m12, block.m21) } else { (block.m21, block.m12) };
            let Target { at, stride, .. } = *target;
            (self.values[at], self.values[at + 1]) = (block.m11, a);
            (self.values[at + stride], self.values[at + stride + 1]) = (b, block.m22);
        }
        self.arch.dispatch(Eliminate { nodes: &self.nodes, values: &mut self.values })
    }

    /// Solves with the factor, in place.
    pub fn solve(&mut self, b: &mut [Vec2]) {
        for (place, v) in self.place.iter().zip(b.iter()) {
            let at = 2 * *place as usize;
            (self.x[at], self.x[at + 1]) = (v.x, v.y);
        }
        let mut local = Vec::new();
        self.nodes.iter().for_each(|node| node.forward(&self.values, &mut self.x, &mut local));
        self.nodes.iter().rev().for_each(|node| node.backward(&self.values, &mut self.x, &mut local));
        for (place, v) in self.place.iter().zip(b.iter_mut()) {
            let at = 2 * *place as usize;
            *v = Vec2::new(self.x[at], self.x[at + 1]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square grid of blocks, its solution, and the right side for that.
    struct Grid {
        start: Vec<usize>,
        rows: Vec<u32>,
        blocks: Vec<Matrix2<f64>>,
        x: Vec<Vec2>,
        b: Vec<Vec2>,
    }

    fn grid(side: usize) -> Grid {
        let n = side * side;
        let off = Matrix2::new(-1.0, 0.2, 0.1, -1.5);
        let x: Vec<Vec2> = (0..n).map(|i| Vec2::new((i % 7) as f64, 1.0 - (i % 5) as f64)).collect();
        let mut g = Grid { start: vec![0], rows: Vec::new(), blocks: Vec::new(), x, b: vec![Vec2::zeros(); n] };
        for c in 0..n {
            let beside = ((c + 1) % side != 0).then_some(c + 1);
            let below = Some(c + side).filter(|r| *r < n);
            for r in [Some(c), beside, below].into_iter().flatten() {
                let block = if r == c { Matrix2::new(9.0, 0.5, 0.5, 8.0) } else { off };
                g.rows.push(r as u32);
                g.blocks.push(block);
                g.b[r] += block * g.x[c];
                if r != c {
                    g.b[c] += block.transpose() * g.x[r];
                }
            }
            g.start.push(g.rows.len());
        }
        g
    }

    fn factor(g: &Grid) -> Factor {
        Factor::new(g.x.len(), &g.start, &g.rows).expect("memory")
    }

    #[test]
    fn solves_a_grid_and_vertices_without_neighbours() {
        for side in [1, 2, 5, 13, 40] {
            let g = grid(side);
            let (mut factor, mut x) = (factor(&g), g.b.clone());
            assert!(factor.eliminate(&g.blocks));
            factor.solve(&mut x);
            let off = x.iter().zip(&g.x).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
            assert!(off < 1e-12, "{side}: {off}");
        }
        let mut lone = Factor::new(3, &[0, 1, 2, 3], &[0, 1, 2]).expect("memory");
        let mut x = vec![Vec2::new(4.0, 6.0); 3];
        assert!(lone.eliminate(&[Matrix2::identity() * 2.0; 3]));
        lone.solve(&mut x);
        assert!(x.iter().all(|x| (x - Vec2::new(2.0, 3.0)).norm() < 1e-15));
    }

    #[test]
    fn a_matrix_that_is_not_positive_is_told_and_leaves_no_trace() {
        let mut g = grid(13);
        let mut factor = factor(&g);
        let last = g.blocks.len() - 1;
        let sound = std::mem::replace(&mut g.blocks[last], -Matrix2::identity());
        assert!(!factor.eliminate(&g.blocks));
        g.blocks[last] = sound;
        let mut x = g.b.clone();
        assert!(factor.eliminate(&g.blocks));
        factor.solve(&mut x);
        assert!(x.iter().zip(&g.x).all(|(a, b)| (a - b).norm() < 1e-12));
    }

    /// The solution may not differ by a bit, whatever registers a processor has.
    #[test]
    fn every_width_of_registers_gives_the_same_bits() {
        let g = grid(30);
        let bits = |arch: Arch| {
            let (mut factor, mut x) = (Factor { arch, ..factor(&g) }, g.b.clone());
            assert!(factor.eliminate(&g.blocks));
            factor.solve(&mut x);
            x.iter().flatten().map(|v| v.to_bits()).collect::<Vec<_>>()
        };
        let narrow = bits(Arch::Scalar);
        for arch in wider() {
            assert!(bits(arch) == narrow, "{arch:?} and single numbers differ");
        }
    }

    /// All vector instruction sets of this processor.
    fn wider() -> Vec<Arch> {
        #[cfg(target_arch = "x86_64")]
        let sets = [pulp::x86::V3::try_new().map(Arch::V3), pulp::x86::V4::try_new().map(Arch::V4)];
        #[cfg(not(target_arch = "x86_64"))]
        let sets = [Some(Arch::new())];
        sets.into_iter().flatten().collect()
    }
}
