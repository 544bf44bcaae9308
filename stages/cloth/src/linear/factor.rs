//! Multifrontal Cholesky factor in single precision: it only steers the descent, the state is double. Ours, because the
//! libraries' kernels choose their sums by the processor, and the same input must give the same bytes everywhere.
//!
//! Duff, Reid: The multifrontal solution of indefinite sparse symmetric linear equations, ACM TOMS 9 (1983).

use super::dense::{self, Pack};
use super::hessian::Pattern;
use super::symbolic::{Node, Symbolic};
use crate::Vec3;
use nalgebra::Matrix3;
use pulp::{Arch, NullaryFnOnce};

/// A factorised block matrix.
#[derive(Default)]
pub(crate) struct Factor {
    pattern: Pattern,
    symbolic: Symbolic,
    values: Vec<f32>,
    right: Vec<f32>,
    local: Vec<f32>,
    pack: Pack,
    arch: Arch,
    pub analyses: u32,
    pub factors: u32,
}

impl Factor {
    /// Factorises `values` on `pattern` plus `shift` on the diagonal; `false` when it is not positive definite (or the
    /// memory for it is not there).
    pub fn factorise(&mut self, pattern: &Pattern, values: &[Matrix3<f64>], shift: &[f64]) -> bool {
        if self.pattern != *pattern {
            let Some(symbolic) = Symbolic::new(pattern) else { return false };
            self.analyses += 1;
            self.values = vec![0.0; symbolic.length];
            self.right = vec![0.0; 3 * pattern.unknowns()];
            self.pattern = pattern.clone();
            self.symbolic = symbolic;
        }
        self.factors += 1;
        self.fill(values, shift);
        self.arch.dispatch(Eliminate { nodes: &self.symbolic.nodes, values: &mut self.values, pack: &mut self.pack })
    }

    /// Rounds the blocks into the columns they belong to.
    #[allow(clippy::cast_possible_truncation)]
    fn fill(&mut self, values: &[Matrix3<f64>], shift: &[f64]) {
        self.values.fill(0.0);
        for (value, target) in values.iter().zip(&self.symbolic.targets) {
            for c in 0..3 {
                for r in 0..3 {
                    let v = if target.mirrored { value[(c, r)] } else { value[(r, c)] };
                    self.values[target.at + c * target.height + r] = v as f32;
                }
            }
        }
        for (start, shift) in self.pattern.start.iter().zip(shift) {
            let target = self.symbolic.targets[*start as usize];
            let block = &values[*start as usize];
            for c in 0..3 {
                self.values[target.at + c * target.height + c] = (block[(c, c)] + shift) as f32;
            }
        }
    }

    /// Solves for one right-hand side, in place.
    #[allow(clippy::cast_possible_truncation)]
    pub fn solve(&mut self, b: &mut [Vec3]) {
        for (place, v) in self.symbolic.place.iter().zip(b.iter()) {
            for k in 0..3 {
                self.right[3 * *place as usize + k] = v[k] as f32;
            }
        }
        let (nodes, values) = (&self.symbolic.nodes, &self.values);
        self.arch.dispatch(Solve { nodes, values, right: &mut self.right, local: &mut self.local });
        for (place, v) in self.symbolic.place.iter().zip(b.iter_mut()) {
            *v = Vec3::from_fn(|k, _| f64::from(self.right[3 * *place as usize + k]));
        }
    }
}

// What runs under the widest registers of the machine; named types, because only they are compiled for them as a whole.
struct Eliminate<'a> {
    nodes: &'a [Node],
    values: &'a mut [f32],
    pack: &'a mut Pack,
}

impl NullaryFnOnce for Eliminate<'_> {
    type Output = bool;

    #[inline(always)]
    fn call(self) -> bool {
        eliminate(self.nodes, self.values, self.pack)
    }
}

struct Solve<'a> {
    nodes: &'a [Node],
    values: &'a [f32],
    right: &'a mut [f32],
    local: &'a mut Vec<f32>,
}

impl NullaryFnOnce for Solve<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for node in self.nodes {
            forward(node, self.values, self.right, self.local);
        }
        for node in self.nodes.iter().rev() {
            backward(node, self.values, self.right, self.local);
        }
    }
}

/// All nodes, children first; each takes its children's updates and leaves its own.
#[inline(always)]
fn eliminate(nodes: &[Node], values: &mut [f32], pack: &mut Pack) -> bool {
    let mut updates: Vec<Vec<f32>> = Vec::new();
    updates.resize_with(nodes.len(), Vec::new);
    for (k, node) in nodes.iter().enumerate() {
        let (height, width) = (node.height(), node.width());
        let panel = &mut values[node.start..node.start + height * width];
        if !dense::factor_panel(panel, height, width, pack) {
            return false;
        }
        let (Some(parent), below) = (node.parent, height - width) else { continue };
        // What the children left here for the rows below stands in the update already.
        let mut update = std::mem::take(&mut updates[k]);
        update.resize(below * below, 0.0);
        dense::subtract_square(&mut update, below, &panel[width..], (below, width, height), below, pack);
        let above = &nodes[parent as usize];
        let reach = above.height() - above.width();
        if updates[parent as usize].is_empty() {
            updates[parent as usize].resize(reach * reach, 0.0);
        }
        extend(node, above, &update, values, &mut updates[parent as usize]);
    }
    true
}

/// Adds a child's update to its parent's columns and to the parent's own update.
#[inline(always)]
fn extend(node: &Node, parent: &Node, update: &[f32], values: &mut [f32], above: &mut [f32]) {
    let (height, width) = (parent.height(), parent.width());
    let below = 3 * node.rows.len();
    let reach = height - width;
    for (a, column) in node.relative.iter().enumerate() {
        for c in 0..3 {
            let from = &update[(3 * a + c) * below..][..below];
            let to = 3 * *column as usize + c;
            let (target, skip) = if to < width {
                (&mut values[parent.start + to * height..][..height], 0)
            } else {
                (&mut above[(to - width) * reach..][..reach], width)
            };
            for run in node.runs.iter().filter(|r| r.from + r.length > 3 * a) {
                let late = (3 * a).saturating_sub(run.from);
                let at = run.to + late - skip;
                let length = run.length - late;
                for (t, p) in target[at..at + length].iter_mut().zip(&from[run.from + late..][..length]) {
                    *t += p;
                }
            }
        }
    }
}

#[inline(always)]
fn forward(node: &Node, values: &[f32], right: &mut [f32], local: &mut Vec<f32>) {
    let l = gather(node, values, right, local);
    dense::solve_lower(l, local, node.width());
    scatter(node, right, local);
}

#[inline(always)]
fn backward(node: &Node, values: &[f32], right: &mut [f32], local: &mut Vec<f32>) {
    let l = gather(node, values, right, local);
    dense::solve_upper(l, local, node.width());
    let first = 3 * node.first as usize;
    right[first..first + node.width()].copy_from_slice(&local[..node.width()]);
}

#[inline(always)]
fn gather<'a>(node: &Node, values: &'a [f32], right: &[f32], local: &mut Vec<f32>) -> &'a [f32] {
    let first = 3 * node.first as usize;
    local.clear();
    local.extend_from_slice(&right[first..first + node.width()]);
    for row in &node.rows {
        local.extend_from_slice(&right[3 * *row as usize..][..3]);
    }
    &values[node.start..node.start + node.height() * node.width()]
}

#[inline(always)]
fn scatter(node: &Node, right: &mut [f32], local: &[f32]) {
    let first = 3 * node.first as usize;
    right[first..first + node.width()].copy_from_slice(&local[..node.width()]);
    for (row, part) in node.rows.iter().zip(local[node.width()..].chunks_exact(3)) {
        right[3 * *row as usize..][..3].copy_from_slice(part);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A grid of blocks, whose elimination has many supernodes, with a known solution.
    #[test]
    fn solves_a_grid_of_blocks() {
        let side = 13u32;
        let n = (side * side) as usize;
        let at = |r: u32, c: u32| r * side + c;
        let mut pairs = Vec::new();
        for r in 0..side {
            for c in 0..side {
                pairs.extend((c + 1 < side).then(|| [at(r, c), at(r, c + 1)]));
                pairs.extend((r + 1 < side).then(|| [at(r, c), at(r + 1, c)]));
            }
        }
        let pattern = Pattern::new(n, pairs.clone());
        let off = Matrix3::new(-1.0, 0.2, 0.0, 0.1, -1.5, 0.3, 0.0, 0.4, -0.5);
        let mut values = vec![off; pattern.rows.len()];
        (0..n).for_each(|j| values[pattern.start[j] as usize] = Matrix3::identity() * 9.0);
        let x: Vec<Vec3> = (0..n).map(|i| Vec3::new((i % 7) as f64, 1.0 - (i % 5) as f64, 0.5)).collect();
        let mut b: Vec<Vec3> = x.iter().map(|v| v * 10.0).collect();
        for [j, i] in pairs.iter().map(|p| p.map(|v| v as usize)) {
            b[i] += off * x[j];
            b[j] += off.transpose() * x[i];
        }
        let mut factor = Factor::default();
        assert!(factor.factorise(&pattern, &values, &vec![1.0; n]));
        factor.solve(&mut b);
        for (p, q) in x.iter().zip(&b) {
            assert!((p - q).norm() < 2e-5, "{p} {q}");
        }
        assert!(!factor.factorise(&pattern, &values, &vec![-10.0; n]));
        assert_eq!(factor.analyses, 1);
    }
}
