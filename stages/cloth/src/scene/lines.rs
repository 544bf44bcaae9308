//! Lines on the cloth: elastic bands sewn along it, and fold lines pressed into it.

/// An elastic band that is sewn along a line of vertices. It pulls, and never pushes.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    /// Vertices along the band.
    pub vertices: Vec<u32>,
    /// Length of the unstretched band from each vertex to the next, m. A closed band goes on from the last to the first.
    pub rest: Vec<f64>,
    /// Tension per strain, N.
    pub stiffness: f64,
}

impl Band {
    /// Returns `true` if the last vertex is joined to the first.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.rest.len() == self.vertices.len()
    }

    /// Length of the whole unstretched band, m.
    #[must_use]
    pub fn rest_length(&self) -> f64 {
        self.rest.iter().sum()
    }

    /// The band with new numbers; `None` for a vertex that is left out. Its neighbours then share the length of both
    /// stretches. Returns `None` where fewer than two vertices are left.
    pub(crate) fn renumbered(&self, to: impl Fn(u32) -> Option<u32>) -> Option<Self> {
        let n = self.vertices.len();
        let numbers: Vec<Option<u32>> = self.vertices.iter().map(|v| to(*v)).collect();
        let first = numbers.iter().position(Option::is_some)?;
        let mut band = Self { vertices: vec![numbers[first]?], rest: Vec::new(), stiffness: self.stiffness };
        let mut way = 0.0;
        let stretches = if self.is_closed() { n } else { n - 1 - first };
        for k in (0..stretches).map(|k| (first + k) % n) {
            way += self.rest[k];
            let Some(v) = numbers[(k + 1) % n] else { continue };
            if band.vertices.last() == Some(&v) {
                continue;
            }
            band.rest.push(std::mem::take(&mut way));
            band.vertices.push(v);
        }
        if self.is_closed() && band.vertices.len() > 1 && band.vertices.first() == band.vertices.last() {
            band.vertices.pop();
        }
        (band.vertices.len() > 1).then_some(band)
    }
}

/// A fold that is pressed into the cloth along a line of vertices. Cloth bends freely across it, but for the fold itself.
#[derive(Clone, Debug, PartialEq)]
pub struct FoldLine {
    /// Vertices along the fold.
    pub vertices: Vec<u32>,
    /// Angle at rest by which the cloth is folded back from flat, rad, over 0 where the right side is outside.
    pub angle: f64,
    /// Moment per length and angle, N.
    pub stiffness: f64,
}

impl FoldLine {
    /// The fold with new numbers; vertices that are left out drop out of it. Returns `None` where none is left.
    pub(crate) fn renumbered(&self, to: impl Fn(u32) -> Option<u32>) -> Option<Self> {
        let mut vertices: Vec<u32> = self.vertices.iter().filter_map(|v| to(*v)).collect();
        vertices.dedup();
        (vertices.len() > 1).then(|| Self { vertices, ..self.clone() })
    }

    /// Edges of the fold, each from its lower to its higher vertex.
    pub(crate) fn edges(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        self.vertices.windows(2).map(|w| [w[0].min(w[1]), w[0].max(w[1])])
    }
}

/// Edges of several folds, ascending.
pub(crate) fn folded_edges(folds: &[FoldLine]) -> Vec<[u32; 2]> {
    let mut edges: Vec<[u32; 2]> = folds.iter().flat_map(FoldLine::edges).collect();
    edges.sort_unstable();
    edges
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_band_keeps_its_length_where_vertices_drop_out_or_become_one() {
        let open = Band { vertices: vec![3, 4, 5, 6], rest: vec![0.1, 0.2, 0.3], stiffness: 1.0 };
        let fewer = open.renumbered(|v| (v != 5).then_some(v - 3)).expect("band");
        assert_eq!((fewer.vertices, fewer.rest), (vec![0, 1, 3], vec![0.1, 0.5]));
        let ring = Band { vertices: vec![0, 1, 2, 3], rest: vec![0.1, 0.2, 0.3, 0.4], stiffness: 1.0 };
        let fewer = ring.renumbered(|v| (v != 0).then_some(v)).expect("band");
        assert_eq!((fewer.vertices.clone(), fewer.is_closed()), (vec![1, 2, 3], true));
        assert!((fewer.rest_length() - 1.0).abs() < 1e-12, "{fewer:?}");
        let joined = ring.renumbered(|v| Some(v.max(1))).expect("band");
        assert_eq!((joined.vertices.clone(), joined.is_closed()), (vec![1, 2, 3], true));
        assert!((joined.rest_length() - 1.0).abs() < 1e-12, "{joined:?}");
        assert!(ring.renumbered(|v| (v == 2).then_some(v)).is_none());
    }
}
