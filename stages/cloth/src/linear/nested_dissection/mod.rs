//! An order of elimination by nested dissection (George 1973).
//!
//! A separator, a few vertices that part the cloth in two halves, comes last, and so on in each half. Small pieces are
//! ordered by least degree. All numbers are whole, so the order is the same on every machine.

pub(crate) mod bisection;
pub(crate) mod graph;
#[cfg(test)]
pub(crate) mod tests;

use crate::linear::pattern::Pattern;
use crate::linear::tuning::{DISSECTION_PIECE_MAX, DISSECTION_UNKNOWNS_MIN, NESTED_DISSECTION, SEPARATOR_PARTS_MIN};
use bisection::Side;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;
use graph::{Graph, number};

/// The order in which unknowns are eliminated, and the place of each in it; `None` without memory.
pub(crate) fn order(pattern: &Pattern) -> Option<(Vec<u32>, Vec<u32>)> {
    let n = pattern.unknowns();
    let mut order = Vec::with_capacity(n);
    let (graph, names) = (Graph::new(pattern), (0..u32::try_from(n).ok()?).collect::<Vec<_>>());
    if n < DISSECTION_UNKNOWNS_MIN.get() || !NESTED_DISSECTION.is_on() {
        least_degree(&graph, &names, &mut order)?
    } else {
        order_pieces(&graph, &names, &mut order)?
    }
    let mut place = vec![0; n];
    (0u32..).zip(&order).for_each(|(k, v)| place[*v as usize] = k);
    Some((order, place))
}

/// Orders a graph, whose vertices have these names, piece by piece.
fn order_pieces(graph: &Graph, names: &[u32], order: &mut Vec<u32>) -> Option<()> {
    if graph.len() <= DISSECTION_PIECE_MAX.get() {
        return least_degree(graph, names, order);
    }
    let mut seen = vec![false; graph.len()];
    for v in 0..number(graph.len()) {
        if seen[v as usize] {
            continue;
        }
        let mut connected = graph.reached_from(v, &mut seen);
        if connected.len() == graph.len() {
            return order_connected(graph, names, order);
        }
        connected.sort_unstable();
        order_connected(&graph.of(&connected), &named(&connected, names), order)?;
    }
    Some(())
}

/// Orders a connected graph: its halves, and then the separator between them.
fn order_connected(graph: &Graph, names: &[u32], order: &mut Vec<u32>) -> Option<()> {
    let sides = if graph.len() > DISSECTION_PIECE_MAX.get() { bisection::bisect(graph) } else { Vec::new() };
    let side = |s: Side| -> Vec<u32> { (0u32..).zip(&sides).filter(|(_, t)| **t == s).map(|(v, _)| v).collect() };
    let separator = side(Side::Separator);
    if sides.is_empty() || separator.len() * SEPARATOR_PARTS_MIN.get() > graph.len() {
        return least_degree(graph, names, order);
    }
    for half in [side(Side::First), side(Side::Second)] {
        order_pieces(&graph.of(&half), &named(&half, names), order)?;
    }
    order.extend(named(&separator, names));
    Some(())
}

/// Orders a piece by least degree.
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

/// The names of some vertices.
fn named(some: &[u32], names: &[u32]) -> Vec<u32> {
    some.iter().map(|v| names[*v as usize]).collect()
}
