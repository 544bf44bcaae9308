//! Rest without time: the least of one energy (docs/static.md), by descents whose metric is a lagged Cholesky factor.

mod descent;
mod memory;
mod objective;
mod report;
mod seams;

pub(crate) use descent::{drape, sew};
