//! The drape of the finest mesh, carried onto a coarser one.
//!
//! A mesh that drapes by itself may find other folds than the finest one. The distance between both then tells of the folds
//! and not of the mesh. So the finest drape is carried over, and the coarse cloth comes to rest from there, in the same
//! folds. What is left is the error of its elements.
//!
//! The rest of cloth whose yarns rub depends on the way there, and the way is not carried over. So the finest drape comes to
//! rest once more on its own mesh, and that is what the others are measured by.

use toile_garment::garment::Shape;
use toile_garment::{Garment, MeshVertex, Vec3};
use toile_stages::flatten::point_location::PointLocation;
use toile_stages::joined::Joined;

/// The garment of a mesh before its drape, in the shape of the finest. `None` where they have other pieces.
#[must_use]
pub fn carried(coarse: &Garment, finest: &Garment) -> Option<Garment> {
    let drape = finest.drape.as_ref()?;
    if coarse.pieces.len() != finest.pieces.len() || drape.positions.len() != finest.pieces.len() {
        return None;
    }
    let pieces = coarse.pieces.iter().zip(&finest.pieces).zip(&drape.positions);
    let positions = pieces.map(|((to, from), shape)| {
        let (to, from) = (to.mesh.as_ref()?, from.mesh.as_ref()?);
        let cloth = PointLocation::new(&from.rest, &from.triangles);
        Some(to.rest.iter().map(|p| cloth.interpolate(*p, shape)).collect())
    });
    let mut positions: Vec<Vec<Vec3>> = positions.collect::<Option<_>>()?;
    join_stitches(coarse, &mut positions);
    let stitched = Shape { positions, sewn: true, ..Shape::default() };
    Some(Garment { stitched: Some(stitched), drape: None, certificate: None, ..coarse.clone() })
}

/// Puts all vertices that are sewn to each other at their mean place.
fn join_stitches(garment: &Garment, positions: &mut [Vec<Vec3>]) {
    let first: Vec<usize> = positions
        .iter()
        .scan(0, |next, piece| {
            let first = *next;
            *next += piece.len();
            Some(first)
        })
        .collect();
    let count: usize = positions.iter().map(Vec::len).sum();
    let index = |v: &MeshVertex| first[v.piece.index()] + v.vertex as usize;
    let mut joined = Joined::new(count);
    for stitch in garment.seams.iter().flat_map(|s| &s.stitches) {
        joined.join(index(&stitch.a), index(&stitch.b));
    }
    let mut sums = vec![(Vec3::zeros(), 0.0); count];
    for (i, p) in positions.iter().flatten().enumerate() {
        let sum = &mut sums[joined.root(i)];
        *sum = (sum.0 + p, sum.1 + 1.0);
    }
    for (i, p) in positions.iter_mut().flatten().enumerate() {
        let (sum, number) = sums[joined.root(i)];
        *p = sum / number;
    }
}
