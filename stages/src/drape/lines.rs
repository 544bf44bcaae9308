//! Elastic bands and pressed folds as they came to rest.

use super::{ELASTIC_AT_REST, FOLD_OPEN};
use crate::solve::{Layout, lines, scene};
use std::f64::consts::PI;
use toile_garment::garment::{BandAtRest, Certificate, FoldAtRest};
use toile_garment::piece::PressedFold;
use toile_garment::{Diagnostic, Garment, Piece, Vec3};

/// Share of its pressed angle below which a fold counts as open somewhere.
const OPEN: f64 = 0.5;

/// Cloth that is sewn flat onto itself lies folded by half a turn, and the sign of that angle says nothing. So it is from
/// this far below half a turn on, rad.
const FLAT_ONTO_ITSELF: f64 = 0.01;

/// The bands of a garment whose vertices are at `now`, m.
pub(super) fn bands(garment: &Garment, layout: &Layout, now: &[Vec<Vec3>]) -> Vec<BandAtRest> {
    let x = layout.join(now);
    let state = |b| {
        let band = lines::band(b, layout);
        let (length, tension) = toile_cloth::band_state(&band, &x);
        let unstretched_mm = band.rest_length() * 1e3;
        BandAtRest { name: b.name.clone(), unstretched_mm, length_mm: length * 1e3, tension_n: tension }
    };
    garment.bands.iter().map(state).collect()
}

/// The pressed folds of a garment whose vertices are at `now`, m.
pub(super) fn folds(garment: &Garment, layout: &Layout, now: &[Vec<Vec3>]) -> Vec<FoldAtRest> {
    let x = layout.join(now);
    let Ok(scene) = scene(garment, layout, x.clone(), Vec3::zeros()) else { return Vec::new() };
    let names = all_folds(garment).map(|(p, f)| format!("{} {}", p.name, f.name));
    let state = |(name, fold): (String, &toile_cloth::FoldLine)| {
        let lies = |a: f64| if PI - a.abs() < FLAT_ONTO_ITSELF { a.abs().copysign(fold.angle) } else { a };
        let angles: Vec<[f64; 2]> =
            toile_cloth::fold_angles(&scene, fold, &x).into_iter().map(|[a, length]| [lies(a), length]).collect();
        let length: f64 = angles.iter().map(|a| a[1]).sum();
        let mean = angles.iter().map(|a| a[0] * a[1]).sum::<f64>() / length.max(1e-9);
        let least = angles.iter().map(|a| a[0] / fold.angle).fold(f64::INFINITY, f64::min);
        FoldAtRest {
            name,
            pressed_deg: fold.angle.to_degrees(),
            mean_deg: mean.to_degrees(),
            least_share: if angles.is_empty() { 0.0 } else { least },
        }
    };
    names.zip(&scene.folds).map(state).collect()
}

/// Words for the place where a fold lies open most.
fn at_worst(fold: &FoldAtRest) -> String {
    if fold.least_share < 0.0 {
        let turned = (fold.least_share * fold.pressed_deg).abs();
        return format!("is folded the wrong way somewhere, by {turned:.0}°");
    }
    format!("opens to {:.0} % of its angle", fold.least_share * 1e2)
}

/// All folds of a garment with their pieces, in the order of its certificate.
fn all_folds(garment: &Garment) -> impl Iterator<Item = (&Piece, &PressedFold)> {
    garment.pieces.iter().flat_map(|p| p.folds.iter().map(move |f| (p, f)))
}

/// Words on a pleat whose folds lie nearer to each other than the edges of the mesh are long.
fn too_coarse(piece: &Piece, fold: &PressedFold) -> Option<String> {
    let middle = |f: &PressedFold| Some((f.line.first()? + f.line.last()?) * 0.5);
    let others = piece.folds.iter().filter(|f| f.pleat.is_some() && f.pleat == fold.pleat && f.name != fold.name);
    let between = others.filter_map(|f| Some((middle(f)? - middle(fold)?).norm())).reduce(f64::min)?;
    let mesh = piece.mesh.as_ref()?;
    // The side of an equilateral triangle of the mean area.
    let edge = (mesh.area() / mesh.triangles.len().max(1) as f64 * 4.0 / 3.0_f64.sqrt()).sqrt();
    let words = format!(
        "its pleat has folds {:.0} mm apart on a mesh with edges of {:.0} mm: a shorter `edge_length` of `triangulate` helps",
        between * 1e3,
        edge * 1e3
    );
    (between < edge).then_some(words)
}

/// Findings on the bands of a certificate, and on its folds that lie open.
pub(super) fn findings(garment: &Garment, certificate: &Certificate) -> Vec<Diagnostic> {
    let band = |b: &BandAtRest| {
        let message = format!(
            "elastic `{}`: {:.0} mm long before it is stretched, {:.0} mm on the garment, tension {:.2} N",
            b.name, b.unstretched_mm, b.length_mm, b.tension_n
        );
        Diagnostic::info(ELASTIC_AT_REST, message)
    };
    let fold = |(f, (piece, pressed)): (&FoldAtRest, (&Piece, &PressedFold))| {
        let message = format!(
            "fold `{}`: pressed to {:.0}°, it lies at {:.0}° in the mean and {}",
            f.name,
            f.pressed_deg,
            f.mean_deg,
            at_worst(f)
        );
        let remedy = "give it more room, or sew it down further";
        let coarse = too_coarse(piece, pressed).map_or_else(String::new, |words| format!("; {words}"));
        Diagnostic::warning(FOLD_OPEN, message).hint(format!("{remedy}{coarse}"))
    };
    let folds = certificate.folds.iter().zip(all_folds(garment));
    let open = folds.filter(|(f, _)| f.least_share < OPEN).map(fold);
    certificate.bands.iter().map(band).chain(open).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{one, rectangle};
    use toile_garment::Vec2;
    use toile_garment::mesh::PieceMesh;

    /// A square of 100 mm in two triangles, with a pleat whose folds lie 20 mm apart.
    fn pleated() -> Garment {
        let rest = [(0.0, 0.0), (0.1, 0.0), (0.1, 0.1), (0.0, 0.1)].map(|(x, y)| Vec2::new(x, y)).to_vec();
        let mesh = PieceMesh { rest, triangles: vec![[0, 1, 2], [0, 2, 3]], ..PieceMesh::default() };
        let mut piece = rectangle(0, "front", 100.0, 100.0);
        piece.mesh = Some(mesh);
        let fold = |n: u8| {
            let x = 0.02 * f64::from(n);
            let line = vec![Vec2::new(x, 0.0), Vec2::new(x, 0.1)];
            PressedFold { name: format!("p-{n}"), line, angle: 3.0, pleat: Some("p".into()) }
        };
        piece.folds = vec![fold(1), fold(2)];
        one(piece)
    }

    fn told(least_share: f64) -> Diagnostic {
        let fold = FoldAtRest { name: "front p-1".into(), pressed_deg: 180.0, mean_deg: 40.0, least_share };
        let certificate = Certificate { folds: vec![fold], ..Certificate::default() };
        findings(&pleated(), &certificate).remove(0)
    }

    #[test]
    fn a_fold_the_wrong_way_is_told_in_words_and_a_coarse_mesh_with_its_remedy() {
        let (wrong, open) = (told(-0.5), told(0.25));
        assert!(wrong.message.ends_with("is folded the wrong way somewhere, by 90°"), "{}", wrong.message);
        assert!(open.message.ends_with("opens to 25 % of its angle"), "{}", open.message);
        assert!(open.hint.as_ref().is_some_and(|h| h.contains("20 mm apart") && h.contains("edge_length")), "{open:?}");
    }
}
