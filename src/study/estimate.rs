//! What the error is, from two levels of the mesh alone.
//!
//! With `q(h) = q + C h^p` (Richardson), a coarser mesh H tells the error at h: `|q(H) − q(h)| / ((H/h)^p − 1)`, and the
//! distance to the result at a still finer mesh f: `|q(H) − q(h)| (h^p − f^p) / (H^p − h^p)`.

use super::measure::{Lengths, difference};

/// Order of hem heights and girths in the edge length. Linear triangles give energies of second order on smooth shapes;
/// contact and folds that are as wide as a few edges make lengths of a garment first order.
pub const ORDER: f64 = 1.0;

/// One mesh: its edge length in mm and what was measured.
#[derive(Clone, Copy, Debug)]
pub struct Level<'a> {
    /// Edge length, mm.
    pub edge: f64,
    /// Hem heights and girths.
    pub lengths: &'a Lengths,
}

/// Estimated largest error of a hem height or girth on `this` mesh, mm, against the limit of fine meshes, or against the
/// result of a mesh of the edge length `finest`. `None` when the levels cannot be compared.
#[must_use]
pub fn estimate(coarser: Level<'_>, this: Level<'_>, finest: Option<f64>) -> Option<f64> {
    let [hem, girth, _] = difference(coarser.lengths, this.lengths)?;
    let power = |h: f64| libm::pow(h, ORDER);
    let (step, rest) = (power(coarser.edge) - power(this.edge), power(this.edge) - finest.map_or(0.0, power));
    (step > 0.0).then(|| hem.max(girth) * rest.max(0.0) / step)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_error_of_a_first_order_quantity() {
        let at =
            |h: f64| Lengths { hems_mm: vec![300.0 + 0.5 * h], girths_mm: vec![900.0 - 0.8 * h], tapes_mm: vec![] };
        let (coarse, fine) = (at(16.0), at(11.0));
        let levels = (Level { edge: 16.0, lengths: &coarse }, Level { edge: 11.0, lengths: &fine });
        let all = estimate(levels.0, levels.1, None).expect("levels");
        assert!((all - 0.8 * 11.0).abs() < 1e-9);
        let to_finest = estimate(levels.0, levels.1, Some(8.0)).expect("levels");
        assert!((to_finest - 0.8 * 3.0).abs() < 1e-9);
        assert_eq!(estimate(levels.1, levels.0, None), None, "the coarser one comes first");
    }
}
