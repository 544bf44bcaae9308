//! Darts and necklines on the fold of a half piece: x = 0 is the fold, the half is 150 mm wide and 600 mm high.

use super::*;
use toile_garment::Vec2;

fn half(top: &[(f64, f64)], fold: f64, body: impl Fn(Writer) -> Writer) -> String {
    let mut line = vec![(0.0, 0.0), (150.0, 0.0), (150.0, 600.0)];
    line.extend(top);
    file(|w| body(w.polyline("1", true, &line).points("2", &line).line("6", (0.0, 0.0), (0.0, fold))))
}

fn only_piece(text: &str) -> toile_garment::Piece {
    let pattern = good(text);
    assert!(pattern.pieces[0].axes.fold.is_some());
    garment(&pattern).pieces.remove(0)
}

/// The half of a dart 30 mm wide and 100 mm deep.
const HALF: [(f64, f64); 2] = [(15.0, 600.0), (0.0, 500.0)];

#[test]
fn half_a_wedge_becomes_a_whole_one() {
    // The mirror line ends at the apex, or runs on over the mouth.
    for fold in [500.0, 600.0] {
        let piece = only_piece(&half(&HALF, fold, |w| w));
        assert_eq!((piece.darts.len(), piece.darts[0].kind), (1, DartKind::Wedge), "{fold}");
        let dart = &piece.darts[0];
        assert!((dart.apexes[0] - Vec2::new(0.0, 0.5)).norm() < 1e-9);
        assert!((dart.intake() - 0.03).abs() < 1e-9);
        // 300 × 600 mm less half of 30 × 100.
        assert!((geom::area(&piece.outline.positions()) - 0.1785).abs() < 1e-9);
    }
}

#[test]
fn half_a_v_neckline_is_no_dart() {
    let text = half(&[(70.0, 600.0), (0.0, 450.0)], 450.0, |w| w);
    assert!(only_piece(&text).darts.is_empty());
    let json = inspect(text.as_bytes(), "t.dxf", None).expect("read").json;
    assert!(json["pieces"][0]["not_darts"][0]["why"].as_str().is_some_and(|w| w.contains("neckline")));
}

#[test]
fn half_of_a_marked_dart_and_half_of_a_fish_eye() {
    let marked = only_piece(&half(&[(0.0, 600.0)], 600.0, |w| w.line("8", HALF[0], HALF[1])));
    assert_eq!((marked.darts.len(), marked.darts[0].kind), (1, DartKind::MarkedWedge));
    assert!((marked.darts[0].intake() - 0.03).abs() < 1e-9);
    assert!(marked.internal_lines.is_empty());
    for m in marked.darts[0].mouth {
        assert!(marked.outline.points.iter().any(|p| (p.at - m).norm() < 1e-9), "the mouth is on the outline");
    }
    let eye = [(0.0, 450.0), (12.0, 300.0), (0.0, 150.0)];
    let lens = only_piece(&half(&[(0.0, 600.0)], 600.0, |w| w.polyline("8", false, &eye)));
    assert_eq!((lens.darts.len(), lens.darts[0].kind), (1, DartKind::FishEye));
    let mut ends: Vec<f64> = lens.darts[0].apexes.iter().map(|p| p.y).collect();
    ends.sort_by(f64::total_cmp);
    assert!((ends[0] - 0.15).abs() < 1e-9 && (ends[1] - 0.45).abs() < 1e-9);
    assert!((lens.darts[0].intake() - 0.024).abs() < 1e-9, "{}", lens.darts[0].intake());
}

#[test]
fn half_of_a_fish_eye_in_strokes_closed_or_on_the_cutouts_layer() {
    let eye = [(0.0, 450.0), (12.0, 300.0), (0.0, 150.0)];
    let draw = |layer: &'static str| {
        [
            half(&[(0.0, 600.0)], 600.0, |w| w.line(layer, eye[0], eye[1]).line(layer, eye[1], eye[2])),
            half(&[(0.0, 600.0)], 600.0, |w| w.polyline(layer, true, &eye)),
            half(&[(0.0, 600.0)], 600.0, |w| w.polyline(layer, false, &eye)),
        ]
    };
    for text in draw("8").into_iter().chain(draw("11")) {
        let piece = only_piece(&text);
        assert_eq!((piece.darts.len(), piece.darts[0].kind), (1, DartKind::FishEye), "{text}");
        assert!((piece.darts[0].intake() - 0.024).abs() < 1e-9);
        assert!((piece.darts[0].leg_length(0) - 0.300_958).abs() < 1e-6);
        assert!(piece.internal_lines.is_empty() && piece.cutouts.is_empty());
    }
    let centred = half(&[(0.0, 600.0)], 600.0, |w| w.polyline("8", false, &eye).line("8", eye[0], eye[2]));
    assert_eq!(only_piece(&centred).darts.len(), 1, "a centre line on the fold");
}

/// A mirror line at net length lies on the cut edge and ends an allowance short of it.
#[test]
fn a_mirror_line_at_net_length_is_the_fold() {
    let cut = [(0.0, -10.0), (160.0, -10.0), (160.0, 640.0), (0.0, 640.0)];
    let net = [(0.0, 30.0), (150.0, 30.0), (150.0, 630.0), (0.0, 630.0)];
    let text = file(|w| w.polyline("1", true, &cut).polyline("14", true, &net).line("6", (0.0, 30.0), (0.0, 630.0)));
    let piece = only_piece(&text);
    // The whole of the sew line: 300 × 600 mm.
    assert!((geom::area(&piece.outline.positions()) - 0.18).abs() < 1e-9);
    let aside = file(|w| w.polyline("1", true, &cut).line("6", (0.5, 30.0), (0.5, 630.0)));
    assert!(good(&aside).pieces[0].axes.fold.is_none());
}
