//! Rest without time: the least of one energy (docs/static.md), by descents whose metric is a lagged Cholesky factor.

mod close;
mod coarse;
mod descent;
mod memory;
mod objective;
mod report;
mod rest;
mod seams;

pub(crate) use coarse::sew;
pub(crate) use rest::drape;
