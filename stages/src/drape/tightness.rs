//! Where a garment is too tight: the place, its strains, and the girths of body and cloth there.

use crate::body::{Section, sections};
use crate::solve::level_cut::level_cut;
use crate::solve::place::{nearest, on_body};
use toile_cloth::Tightest;
use toile_garment::garment::Certificate;
use toile_garment::{Diagnostic, Garment, Vec3};

/// A finding on a drape whose strain is above its gate.
#[must_use]
pub fn finding(garment: &Garment, certificate: &Certificate, tightest: Option<&Tightest>) -> Option<Diagnostic> {
    let limit = certificate.limits.get("strain_over_limit").copied().unwrap_or(f64::INFINITY);
    let worst = tightest.filter(|_| certificate.strain_over_limit > limit)?;
    let at = worst.place.at;
    let piece = nearest(garment, &garment.drape.as_ref()?.positions, &at)?;
    let girths = girths(garment, &at);
    // Cloth that is longer than the way round is stretched by something else than the body.
    let is_loose = girths.is_some_and(|[body, cloth]| cloth > body * LOOSE);
    let message = format!(
        "piece `{}` is {} near ({:.0}, {:.0}, {:.0}) mm{}: strain {:.1} % along the warp, {:.1} % along the weft, \
         {:.1} % along the bias, {:.2} of the fabric's limit{}",
        piece.name,
        if is_loose { "stretched" } else { "too tight" },
        at.x * 1e3,
        at.y * 1e3,
        at.z * 1e3,
        on_body(garment, at),
        worst.warp * 1e2,
        worst.weft * 1e2,
        worst.bias * 1e2,
        certificate.strain_over_limit,
        girths.map_or_else(String::new, |[body, cloth]| {
            format!("; at this height the body measures {:.0} mm round and the cloth {:.0} mm", body * 1e3, cloth * 1e3)
        })
    );
    let hint = if is_loose {
        "the cloth is wider than the body there, so a seam pulls it: look for a seam beside it that is open or wrong"
    } else {
        "widen the pattern there, take a larger size, a fabric that stretches further, or a smaller body"
    };
    Some(Diagnostic::warning(super::TOO_TIGHT, message).at(piece.source.clone()).hint(hint))
}

/// Cloth that is so many times as long as the way round the body is not stretched by the body.
const LOOSE: f64 = 1.1;

/// Girth of the body by a tape, and length of the cloth around it before it is stretched, m, in the level plane of a place.
fn girths(garment: &Garment, at: &Vec3) -> Option<[f64; 2]> {
    let body = garment.body.as_ref()?;
    let all = sections(&body.positions, &body.triangles, *at, Vec3::y());
    let beside = |p: &Vec3| {
        let gap = |s: &Section| s.points.iter().map(|q| (q - p).norm_squared()).fold(f64::INFINITY, f64::min);
        (0..all.len()).min_by(|a, b| gap(&all[*a]).total_cmp(&gap(&all[*b])))
    };
    let mine = beside(at)?;
    let mut cloth = 0.0;
    for (piece, x) in garment.pieces.iter().zip(&garment.drape.as_ref()?.positions) {
        let Some(mesh) = &piece.mesh else { continue };
        for ([p, q], length) in level_cut(mesh, x, at.y) {
            if beside(&((p + q) * 0.5)) == Some(mine) {
                cloth += length;
            }
        }
    }
    Some([all[mine].girth(), cloth])
}
