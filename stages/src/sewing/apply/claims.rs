//! Wedges whose legs a declared seam takes: a godet or an insert is sewn in, so the wedge is no dart.

use crate::sewing::codes;
use crate::sewing::lookup::{self, RawRun};
use crate::sewing::ring::SAME;
use crate::sewing::shapes::{Shapes, mm};
use std::collections::BTreeSet;
use toile_garment::{Diagnostic, Garment, PieceId, Report};

/// Removes the darts that seams take, and the seams that only repeat a dart. Tells whether a dart was removed. Seams that
/// name what is not there take none.
pub fn release(garment: &mut Garment, shapes: &Shapes, report: &mut Report) -> bool {
    let mut taken: BTreeSet<(PieceId, usize)> = BTreeSet::new();
    let mut repeats: BTreeSet<usize> = BTreeSet::new();
    for (k, seam) in garment.plan.seams.iter().enumerate() {
        let find = |runs: &[toile_garment::sewing::RunSpec]| -> Result<Vec<RawRun>, Diagnostic> {
            runs.iter().map(|r| lookup::run(garment, shapes, r, seam.source.as_ref())).collect()
        };
        let (Ok(a), Ok(b)) = (find(&seam.a), find(&seam.b)) else { continue };
        let (claims_a, claims_b) = (claims(shapes, &a), claims(shapes, &b));
        // Both legs of one dart sewn to each other: that is the dart itself.
        if a.len() == 1 && b.len() == 1 && claims_a.len() == 1 && claims_a == claims_b {
            repeats.insert(k);
        } else {
            taken.extend(claims_a);
            taken.extend(claims_b);
        }
    }
    for k in repeats.iter().rev() {
        let seam = garment.plan.seams.remove(*k);
        let message = format!("seam `{}` sews the two legs of a dart, which is sewn already", seam.name);
        report.push(Diagnostic::info(codes::SEAM_IS_DART, message).at(seam.source));
    }
    let released = !taken.is_empty();
    for (piece, dart) in taken.into_iter().rev() {
        let p = &mut garment.pieces[piece.index()];
        let dart = p.darts.remove(dart);
        let at = dart.apexes.first().map_or(String::new(), |a| format!(" at {}", mm(*a)));
        let message =
            format!("piece `{}`: wedge `{}`{at} has its legs in a declared seam and is no dart", p.name, dart.name);
        report.push(Diagnostic::info(codes::WEDGE_IS_NO_DART, message).at(dart.source));
    }
    released
}

/// Darts a leg of which a side takes: a run ends inside the intake, or is the intake.
fn claims(shapes: &Shapes, runs: &[RawRun]) -> BTreeSet<(PieceId, usize)> {
    let mut out = BTreeSet::new();
    for run in runs {
        let ring = &shapes[run.piece.index()].rings[run.ring];
        let (start, end) = run.span();
        for g in ring.gaps.iter().filter(|g| g.apex.is_some()) {
            let (from, to) = (ring.arc[g.from], ring.arc[g.to]);
            let inside = |s: f64| {
                let x = ring.ahead(from, s);
                x > SAME && x < ring.ahead(from, to) - SAME
            };
            let is_intake = ring.ahead(from, start) < SAME && ring.ahead(to, end) < SAME;
            if inside(start) || inside(end) || is_intake {
                out.insert((run.piece, g.dart));
            }
        }
    }
    out
}
