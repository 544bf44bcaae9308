//! Verdicts on flattened pieces.

use super::*;
use crate::flatten::verdict::verdicts;
use crate::testing::notch;
use toile_garment::flat::{Check, CheckKind, PieceVerdict};
use toile_garment::units::Share;

fn judged(g: &Garment, limits: &FlattenTolerance) -> Vec<PieceVerdict> {
    let flat = flatten(g, &FlattenParams::default());
    verdicts(g, &flat, limits).expect("verdicts")
}

fn of(verdict: &PieceVerdict, kind: CheckKind) -> &Check {
    verdict.checks.iter().find(|c| c.kind == kind).expect("check")
}

#[test]
fn a_wider_sheet_passes_until_a_limit_is_given() {
    let grid = sheet(10, 15);
    let mut g = edit(&grid, |p| Vec3::new(1.02 * p.x, p.y, 0.0));
    // 150 mm from the left end of the hem.
    g.pieces[0].notches = vec![notch(50.0, 0.0)];
    let all = judged(&g, &FlattenTolerance::default());
    let verdict = &all[0];
    assert!(verdict.passes() && verdict.fails().is_empty());
    assert!((of(verdict, CheckKind::Area).value - 0.02).abs() < 1e-6);
    assert!((of(verdict, CheckKind::Edge).value.abs() - 4e-3).abs() < 1e-6);
    let moved = of(verdict, CheckKind::Notch);
    assert!((moved.value - 3e-3).abs() < 1e-6 && (moved.along.expect("place") - 0.15).abs() < 1e-9, "{moved:?}");
    assert!(of(verdict, CheckKind::Corner).value.abs() < 1e-6 && of(verdict, CheckKind::Bow).value < 1e-6);
    assert!(of(verdict, CheckKind::Symmetry).value < 1e-6);
    let limits = FlattenTolerance { area: Some(Share(0.01)), notch: Some(Length(1e-3)), ..FlattenTolerance::default() };
    let all = judged(&g, &limits);
    assert_eq!(all[0].fails()[0], "area +2.00 %");
    assert!(!all[0].passes() && all[0].fails()[1].contains("moved by +3.00 mm, 150 mm from its start"));
}

#[test]
fn a_seam_that_no_longer_fits_its_partner_fails_where_they_differ_most() {
    let (g, _) = one_sided();
    let all = judged(&g, &FlattenTolerance::default());
    for verdict in &all {
        let seam = of(verdict, CheckKind::Seam);
        // The sides differ more and more along the seam.
        let along = seam.along.expect("station");
        assert!((seam.value.abs() - 0.03 * along).abs() < 1e-5, "{seam:?}");
        assert!(!verdict.passes() && verdict.fails()[0].starts_with("seam `side`"), "{:?}", verdict.fails());
    }
    // What came back unchanged has no verdict.
    let mut same = g.clone();
    (same.drape, same.drape_before_edit) = (same.drape_before_edit.take(), None);
    same.certificate = Some(toile_garment::garment::Certificate::default());
    assert!(judged(&same, &FlattenTolerance::default()).is_empty());
}

#[test]
fn a_piece_that_is_no_longer_its_mirror_image_fails_where_that_is_asked_for() {
    let grid = sheet(21, 30);
    let g = edit(&grid, |p| Vec3::new(p.x + 2.0 * p.x.max(0.0) * p.x.max(0.0), p.y, 0.0));
    let limits = FlattenTolerance { symmetry: Some(Length(1e-3)), ..FlattenTolerance::default() };
    let all = judged(&g, &limits);
    assert!(all[0].fails().iter().any(|f| f.ends_with("off its own mirror image")), "{:?}", all[0]);
}
