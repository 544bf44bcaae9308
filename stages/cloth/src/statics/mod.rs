//! Rest without time: the least of one energy (docs/static.md), by descents whose metric is a lagged Cholesky factor.

mod ahead;
mod close;
mod coarse;
pub(crate) mod descent;
mod far;
mod lay;
mod lead;
mod locks;
mod memory;
mod metric;
pub(crate) mod objective;
mod report;
mod rest;
mod saddle;
mod seams;
#[cfg(test)]
mod sheet;
mod slate;
mod step;

pub(crate) use coarse::sew;
pub(crate) use report::effects;
pub(crate) use rest::drape;
