//! A sparse symmetric matrix of 3 × 3 blocks, as it is factorised.

use crate::Vec3;
use crate::linear::pattern::{IsotropicBlocks, Pattern};
use nalgebra::Matrix3;
use std::sync::Arc;

/// A block of a matrix.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Block<'a> {
    /// A multiple of the identity.
    Isotropic(f64),
    General(&'a Matrix3<f64>),
}

impl Block<'_> {
    /// The block as a whole.
    pub fn matrix(self) -> Matrix3<f64> {
        match self {
            Self::Isotropic(factor) => Matrix3::from_diagonal_element(factor),
            Self::General(block) => *block,
        }
    }
}

/// A symmetric matrix: the lower triangle by columns.
pub(crate) struct System {
    /// All couplings.
    pub pattern: Pattern,
    /// Blocks that are multiples of the identity, where `general` has none.
    isotropic: IsotropicBlocks,
    /// Couplings whose blocks are of any kind. Every diagonal is one of them.
    general: Pattern,
    /// Their blocks, N/m.
    values: Vec<Matrix3<f64>>,
}

impl System {
    /// The matrix of these blocks; those of `general` hold where both patterns have a place. Its pattern is that of
    /// `isotropic`, or wider where `joins` others.
    pub fn new(isotropic: IsotropicBlocks, general: Pattern, values: Vec<Matrix3<f64>>, joins: bool) -> Self {
        let mut system = Self { pattern: isotropic.pattern.clone(), isotropic, general, values };
        if joins {
            system.pattern = system.joined_pattern();
        }
        system
    }

    /// The matrix of blocks of any kind.
    #[cfg(test)]
    pub fn of_blocks(pattern: Pattern, values: Vec<Matrix3<f64>>) -> Self {
        let none = Pattern { start: vec![0; pattern.start.len()].into(), rows: Vec::new().into() };
        Self::new(IsotropicBlocks { pattern: none, factors: Vec::new().into() }, pattern, values, true)
    }

    fn joined_pattern(&self) -> Pattern {
        let n = self.general.unknowns();
        let (mut start, mut rows) = (Vec::with_capacity(n + 1), Vec::with_capacity(self.isotropic.pattern.rows.len()));
        start.push(0);
        for column in 0..n {
            rows.extend(self.column(column).map(|(row, _)| row));
            start.push(u32::try_from(rows.len()).unwrap_or(u32::MAX));
        }
        Pattern { start: start.into(), rows: rows.into() }
    }

    /// Row and block of all places of a column, ascending.
    fn column(&self, column: usize) -> impl Iterator<Item = (u32, Block<'_>)> {
        let all = &self.isotropic.pattern;
        let own = self.general.places(column);
        let springs = all.places(column);
        let mut own = self.general.rows[own.clone()].iter().zip(&self.values[own]).peekable();
        let mut springs = all.rows[springs.clone()].iter().zip(&self.isotropic.factors[springs]).peekable();
        std::iter::from_fn(move || {
            let spring = springs.next_if(|(row, _)| own.peek().is_none_or(|(other, _)| *row <= other));
            match (spring, own.peek()) {
                (Some((row, k)), next) if next.is_none_or(|(other, _)| *row < **other) => {
                    Some((*row, Block::Isotropic(*k)))
                }
                _ => own.next().map(|(row, block)| (*row, Block::General(block))),
            }
        })
    }

    /// All blocks, in the order of the pattern.
    pub fn blocks(&self) -> impl Iterator<Item = Block<'_>> {
        (0..self.general.unknowns()).flat_map(|column| self.column(column)).map(|(_, block)| block)
    }

    /// Sums of the absolute values of all blocks by place in the block.
    pub fn absolute_sums(&self) -> Matrix3<f64> {
        let isotropic = self.isotropic.factors.iter().map(|k| k.abs()).sum();
        self.values.iter().fold(Matrix3::from_diagonal_element(isotropic), |sums, m| sums + m.abs())
    }

    /// The blocks of the diagonal.
    pub fn diagonal(&self) -> impl Iterator<Item = &Matrix3<f64>> {
        self.general.start.iter().take(self.general.unknowns()).map(|k| &self.values[*k as usize])
    }

    /// Adds numbers to the diagonal, one for each unknown.
    pub fn add_to_diagonal(&mut self, shift: impl Iterator<Item = f64>) {
        for (k, s) in self.general.start.iter().zip(shift) {
            self.values[*k as usize] += Matrix3::from_diagonal_element(s);
        }
    }

    /// Becomes `other` less itself, where both have the same pattern.
    pub fn subtract_from(&mut self, other: &Self) {
        self.values.iter_mut().zip(&other.values).for_each(|(own, v)| *own = v - *own);
        let factors = Arc::make_mut(&mut self.isotropic.factors).iter_mut().zip(&*other.isotropic.factors);
        factors.for_each(|(own, k)| *own = k - *own);
    }

    /// Product of the matrix and a vector.
    pub fn times(&self, v: &[Vec3]) -> Vec<Vec3> {
        let mut out = vec![Vec3::zeros(); v.len()];
        for column in 0..self.general.unknowns() {
            for (row, block) in self.column(column) {
                let (row, block) = (row as usize, block.matrix());
                out[row] += block * v[column];
                if row != column {
                    out[column] += block.tr_mul(&v[row]);
                }
            }
        }
        out
    }
}
