//! Packs the boxes of all pieces into the unit square: shelves, tallest first, no turning, no overlap.

/// Shelf widths that are tried, between the widest piece and a single shelf.
const TRIES: u32 = 64;

/// Coordinates in 0–1 for every vertex of every piece; one scale for all, `margin` (metres) around each box.
pub fn pack(pieces: &[Vec<[f64; 2]>], margin: f64) -> Vec<Vec<[f64; 2]>> {
    let boxes: Vec<([f64; 2], [f64; 2])> = pieces.iter().map(|p| bounds(p)).collect();
    let sizes: Vec<[f64; 2]> = boxes.iter().map(|(lo, hi)| [hi[0] - lo[0] + margin, hi[1] - lo[1] + margin]).collect();
    let (corners, side) = best(&sizes, margin);
    // A garment without extent still gives finite numbers.
    let scale = if side > 0.0 { 1.0 / side } else { 0.0 };
    pieces
        .iter()
        .zip(&boxes)
        .zip(corners)
        .map(|((piece, (lo, _)), at)| {
            let place = |k: usize, x: f64| ((x - lo[k] + at[k] + margin) * scale).clamp(0.0, 1.0);
            piece.iter().map(|[u, v]| [place(0, *u), place(1, *v)]).collect()
        })
        .collect()
}

fn bounds(points: &[[f64; 2]]) -> ([f64; 2], [f64; 2]) {
    let first = points.first().copied().unwrap_or([0.0; 2]);
    points
        .iter()
        .fold((first, first), |(lo, hi), p| ([lo[0].min(p[0]), lo[1].min(p[1])], [hi[0].max(p[0]), hi[1].max(p[1])]))
}

/// The layout whose square is smallest: lower corners and the side of the square.
fn best(sizes: &[[f64; 2]], margin: f64) -> (Vec<[f64; 2]>, f64) {
    let mut order: Vec<usize> = (0..sizes.len()).collect();
    // Tallest first; the sort is stable, so equal pieces keep their order.
    order.sort_by(|a, b| sizes[*b][1].total_cmp(&sizes[*a][1]));
    let widest = sizes.iter().map(|s| s[0]).fold(0.0, f64::max);
    let all: f64 = sizes.iter().map(|s| s[0]).sum();
    let mut found = (vec![[0.0; 2]; sizes.len()], f64::INFINITY);
    for i in 0..=TRIES {
        let width = widest + (all - widest) * f64::from(i) / f64::from(TRIES);
        let (corners, used) = shelves(sizes, &order, width);
        let side = used[0].max(used[1]) + margin;
        if side < found.1 {
            found = (corners, side);
        }
    }
    found
}

fn shelves(sizes: &[[f64; 2]], order: &[usize], width: f64) -> (Vec<[f64; 2]>, [f64; 2]) {
    let mut corners = vec![[0.0; 2]; sizes.len()];
    let (mut x, mut y, mut shelf, mut used) = (0.0, 0.0, 0.0f64, [0.0f64; 2]);
    for i in order {
        let [w, h] = sizes[*i];
        // The slack keeps rounding from opening a shelf for the widest piece.
        if x > 0.0 && x + w > width * (1.0 + 1e-12) {
            (x, y, shelf) = (0.0, y + shelf, 0.0);
        }
        corners[*i] = [x, y];
        x += w;
        shelf = shelf.max(h);
        used = [used[0].max(x), used[1].max(y + shelf)];
    }
    (corners, used)
}
