//! The forecast of `triangulate`: edge length and number of triangles, from the area of the cloth.

use super::{Params, size};
use crate::sewing::shapes::shapes;
use toile_garment::Garment;
use toile_stage_api::{Errors, MeshSize, StageError};

/// Size of the mesh that the stage will make of these pieces; `None` without pieces.
///
/// # Errors
/// When the outlines or the parameters would end the run, too.
pub(super) fn mesh(params: &Params, garment: &Garment) -> Result<Option<MeshSize>, StageError> {
    let mut errors = Errors::default();
    errors.keep(size::check_asked(params));
    let shapes = errors.keep(shapes(garment).map_err(StageError::Input)).unwrap_or_default();
    errors.keep(size::check_pieces(garment, &shapes));
    errors.finish()?;
    if garment.pieces.is_empty() {
        return Ok(None);
    }
    let edge = size::edge_length(params, garment, &shapes)?;
    let triangles = size::triangles(size::cloth_area(garment, &shapes), edge);
    Ok((triangles > 0.0).then_some(MeshSize { triangles, edge }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{piece, v};
    use toile_garment::Vec2;
    use toile_garment::outline::{LinePoint, PieceLine, PointKind};
    use toile_garment::units::Length;

    fn hole(side: f64) -> PieceLine {
        let low = 500.0 - 0.5 * side;
        let corners = [[low, low], [low + side, low], [low + side, low + side], [low, low + side]];
        let at = |[x, y]: [f64; 2]| -> Vec2 { v(x, y) };
        let points = corners.map(|c| LinePoint { at: at(c), kind: PointKind::Turn });
        PieceLine { points: points.to_vec(), closed: true, ..PieceLine::default() }
    }

    #[test]
    fn triangles_cover_the_cloth_without_its_holes() {
        let square = [(0.0, 0.0, 't'), (1000.0, 0.0, 't'), (1000.0, 1000.0, 't'), (0.0, 1000.0, 't')];
        let mut sheet = piece(0, "sheet", &square);
        sheet.cutouts = vec![hole(500.0)];
        let garment = Garment { pieces: vec![sheet], ..Garment::default() };
        let ask = |edge_length: Option<f64>, triangles| {
            let params = Params { edge_length: edge_length.map(Length), triangles, ..Params::default() };
            mesh(&params, &garment).expect("sound").expect("a size")
        };
        let by_length = ask(Some(0.01), None);
        assert!((by_length.triangles * 0.25 * 3_f64.sqrt() * 1e-4 - 0.75).abs() < 1e-12);
        let by_count = ask(None, Some(1000));
        assert!((ask(Some(by_count.edge), None).triangles - 1000.0).abs() < 1e-6);
        assert_eq!(mesh(&Params::default(), &Garment::default()).expect("sound"), None);
    }
}
