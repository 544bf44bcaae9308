//! An order of elimination by nested dissection: a few vertices that part the cloth in two halves come last, and so on in
//! each half; small pieces in the order of least degree (George 1973). Whole numbers only, so the same on every machine.

pub(crate) mod bisection;
pub(crate) mod graph;
#[cfg(test)]
pub(crate) mod tests;

use crate::linear::hessian::Pattern;
use bisection::{BETWEEN, FIRST, SECOND};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;
use graph::{Graph, number};

/// Cloth of fewer unknowns is ordered by least degree as a whole: that takes up to a third fewer sums at 1,700, as many at 1,100
/// and 3,300, a third more at 5,000 and 6,200.
const LARGE: usize = 3_000;
/// Pieces of at most so many unknowns are not parted.
const SMALL: usize = 200;
/// A piece is not parted by more than one in so many of it.
const DEAR: usize = 4;

/// The order in which unknowns are eliminated, and the place of each in it.
pub(crate) fn order(pattern: &Pattern) -> Option<(Vec<u32>, Vec<u32>)> {
    let n = pattern.unknowns();
    let mut order = Vec::with_capacity(n);
    let (graph, names) = (Graph::new(pattern), (0..u32::try_from(n).ok()?).collect::<Vec<_>>());
    if n < LARGE {
        least_degree(&graph, &names, &mut order)?
    } else {
        dissect(&graph, &names, &mut order)?
    }
    let mut place = vec![0; n];
    (0u32..).zip(&order).for_each(|(k, v)| place[*v as usize] = k);
    Some((order, place))
}

/// Orders a graph, whose vertices have these names.
fn dissect(graph: &Graph, names: &[u32], order: &mut Vec<u32>) -> Option<()> {
    if graph.len() <= SMALL {
        return least_degree(graph, names, order);
    }
    let mut seen = vec![false; graph.len()];
    for v in 0..number(graph.len()) {
        if seen[v as usize] {
            continue;
        }
        let mut connected = graph.front(v, &mut seen);
        if connected.len() == graph.len() {
            return dissect_connected(graph, names, order);
        }
        connected.sort_unstable();
        dissect_connected(&graph.of(&connected), &named(&connected, names), order)?;
    }
    Some(())
}

/// Orders a graph that hangs together. As deep as halves can be halved.
fn dissect_connected(graph: &Graph, names: &[u32], order: &mut Vec<u32>) -> Option<()> {
    let sides = if graph.len() > SMALL { bisection::part(graph) } else { Vec::new() };
    let side = |s| -> Vec<u32> { (0u32..).zip(&sides).filter(|(_, t)| **t == s).map(|(v, _)| v).collect() };
    let between = side(BETWEEN);
    if sides.is_empty() || between.len() * DEAR > graph.len() {
        return least_degree(graph, names, order);
    }
    for half in [side(FIRST), side(SECOND)] {
        dissect(&graph.of(&half), &named(&half, names), order)?;
    }
    order.extend(named(&between, names));
    Some(())
}

/// A small piece, in the order of least degree.
fn least_degree(graph: &Graph, names: &[u32], order: &mut Vec<u32>) -> Option<()> {
    let n = graph.len();
    let (mut start, mut rows) = (vec![0u32], Vec::new());
    for v in 0..number(n) {
        rows.push(v);
        rows.extend(graph.around(v).iter().filter(|w| **w > v));
        start.push(number(rows.len()));
    }
    let matrix = SymbolicSparseColMatRef::new_unsorted_checked(n, n, &start, None, &rows);
    let (mut own, mut place) = (vec![0u32; n], vec![0u32; n]);
    let mut memory = MemBuffer::try_new(amd::order_maybe_unsorted_scratch::<u32>(n, rows.len())).ok()?;
    let stack = MemStack::new(&mut memory);
    amd::order_maybe_unsorted(&mut own, &mut place, matrix, amd::Control::default(), stack).ok()?;
    order.extend(named(&own, names));
    Some(())
}

fn named(some: &[u32], names: &[u32]) -> Vec<u32> {
    some.iter().map(|v| names[*v as usize]).collect()
}
