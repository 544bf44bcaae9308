use crate::linear::hessian::grid_pairs;
use crate::linear::nested_dissection::*;

/// A square grid, each point coupled with those up to two lines away.
fn grid(side: u32) -> Pattern {
    let pairs = grid_pairs(side, &[(0, 1), (1, 0), (1, 1), (0, 2), (2, 0)]);
    Pattern::new((side * side) as usize, pairs)
}

/// Number of sums in the factorisation of a matrix in this order.
fn sums(pattern: &Pattern, order: &[u32]) -> usize {
    let graph = Graph::new(pattern);
    let mut place = vec![0; order.len()];
    (0..).zip(order).for_each(|(k, v): (usize, &u32)| place[*v as usize] = k);
    let mut rows: Vec<std::collections::BTreeSet<usize>> = vec![std::collections::BTreeSet::new(); order.len()];
    for (k, v) in order.iter().enumerate() {
        rows[k].extend(graph.around(*v).iter().map(|w| place[*w as usize]).filter(|p| *p > k));
    }
    let mut all = 0;
    for k in 0..order.len() {
        let column = std::mem::take(&mut rows[k]);
        all += column.len() * column.len();
        if let Some(next) = column.first().copied() {
            rows[next].extend(column.into_iter().skip(1));
        }
    }
    all
}

/// The order by nested dissection, however small the whole is.
fn parted(pattern: &Pattern) -> Vec<u32> {
    let (names, mut order) = ((0..number(pattern.unknowns())).collect::<Vec<_>>(), Vec::new());
    order_pieces(&Graph::new(pattern), &names, &mut order).expect("an order");
    order
}

#[test]
fn the_order_holds_every_unknown_once() {
    let pattern = grid(123);
    let (order, place) = order(&pattern).expect("an order");
    assert!((0..15_129).all(|v: u32| order[place[v as usize] as usize] == v));
}

/// Nested dissection is compared with least degree of the whole.
#[test]
fn large_cloth_takes_fewer_sums_than_in_the_order_of_least_degree() {
    let pattern = grid(125);
    let (parted, _) = order(&pattern).expect("an order");
    let names: Vec<u32> = (0..number(pattern.unknowns())).collect();
    let mut whole = Vec::new();
    least_degree(&Graph::new(&pattern), &names, &mut whole).expect("an order");
    let (ours, least) = (sums(&pattern, &parted), sums(&pattern, &whole));
    assert!(10 * ours < 9 * least, "{ours} and {least}");
}

/// A grid whose points are coupled over two lines needs a separator of two lines. No coupling crosses the separator.
#[test]
fn the_separator_of_a_square_has_little_more_than_two_lines() {
    let (side, pattern) = (80, grid(80));
    let graph = Graph::new(&pattern);
    let sides = bisection::bisect(&graph);
    let size = |s: Side| sides.iter().filter(|t| **t == s).count();
    assert!(size(Side::Separator) <= 5 * side / 2, "{} in the separator", size(Side::Separator));
    assert!(
        3 * size(Side::First).max(size(Side::Second)) <= 2 * graph.len(),
        "{} and {}",
        size(Side::First),
        size(Side::Second)
    );
    for v in (0..number(graph.len())).filter(|v| sides[*v as usize] == Side::First) {
        assert!(graph.around(v).iter().all(|w| sides[*w as usize] != Side::Second), "{v} touches the other side");
    }
}

#[test]
fn unconnected_pieces_are_ordered_one_by_one() {
    let one = grid(16);
    let mut pairs = Vec::new();
    for c in 0..256u32 {
        for k in one.start[c as usize] as usize + 1..one.start[c as usize + 1] as usize {
            pairs.extend([[c, one.rows[k]], [c + 256, one.rows[k] + 256]]);
        }
    }
    let order = parted(&Pattern::new(512, pairs));
    let mut first: Vec<u32> = order[..256].to_vec();
    first.sort_unstable();
    assert!(first == (0..256).collect::<Vec<_>>() || first == (256..512).collect::<Vec<_>>());
}

/// The middle of a star is its separator.
#[test]
fn one_vertex_separates_a_star() {
    let pattern = Pattern::new(1000, (1..1000).map(|k| [0, k]).collect());
    let order = parted(&pattern);
    assert!(sums(&pattern, &order) <= 1000, "{}", sums(&pattern, &order));
}
