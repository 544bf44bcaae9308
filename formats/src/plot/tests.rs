use super::*;
use toile_garment::Piece;
use toile_garment::outline::{LinePoint, PieceLine, PointKind};

/// A rectangle of 300 × 600 mm.
fn piece(name: &str) -> Piece {
    let points = [(0.0, 0.0), (0.3, 0.0), (0.3, 0.6), (0.0, 0.6)]
        .map(|(x, y)| LinePoint { at: Vec2::new(x, y), kind: PointKind::Turn });
    let outline = PieceLine { points: points.to_vec(), closed: true, ..PieceLine::default() };
    Piece { name: name.into(), outline, grain: Some([Vec2::new(0.1, 0.1), Vec2::new(0.1, 0.5)]), ..Piece::default() }
}

fn box_of(points: &[Vec2]) -> (Vec2, Vec2) {
    points.iter().fold((points[0], points[0]), |(lo, hi), p| (lo.inf(p), hi.sup(p)))
}

#[test]
fn pieces_lie_apart_at_their_size() {
    let sheet = lay(&[piece("A"), piece("B"), piece("C")], 20.0, None);
    let cuts: Vec<_> = sheet.on(Layer::Cut).map(|s| box_of(&s.points)).collect();
    assert_eq!(cuts.len(), 3);
    for (lo, hi) in &cuts {
        assert!(((hi - lo) - Vec2::new(300.0, 600.0)).norm() < 1e-9);
        assert!(lo.x >= 20.0 - 1e-9 && lo.y >= 20.0 - 1e-9);
        assert!(hi.x <= sheet.size.x - 20.0 + 1e-9 && hi.y <= sheet.size.y - 20.0 + 1e-9);
    }
    for (i, (lo, hi)) in cuts.iter().enumerate() {
        for (other_lo, other_hi) in &cuts[i + 1..] {
            let apart = (other_lo.x - hi.x).max(lo.x - other_hi.x).max(other_lo.y - hi.y).max(lo.y - other_hi.y);
            assert!(apart >= 20.0 - 1e-9, "{apart}");
        }
    }
}

#[test]
fn svg_is_in_millimetres_with_named_layers() {
    let sheet = lay(&[piece("<A>")], 20.0, None);
    let text = svg(&sheet, "T");
    let size =
        format!("width=\"{:.3}mm\" height=\"{:.3}mm\" viewBox=\"0 0 {0:.3} {1:.3}\"", sheet.size.x, sheet.size.y);
    assert!(text.contains(&size), "{size}");
    for layer in Layer::ALL {
        assert!(text.contains(&format!("inkscape:label=\"{}\"", layer.name())));
    }
    assert!(text.contains("&lt;A&gt;") && !text.contains("<A>"));
}

#[test]
fn hpgl_has_forty_units_a_millimetre() {
    let sheet = lay(&[piece("Ä")], 20.0, None);
    let (text, findings) = hpgl(&sheet).expect("hpgl");
    assert_eq!(findings.len(), 1);
    assert!(text.is_ascii() && text.starts_with("IN;") && text.contains("SP1;"));
    // The cut line: a rectangle of 12,000 × 24,000 units.
    let line = text.lines().skip_while(|l| *l != "SP1;").nth(1).expect("cut line");
    let numbers: Vec<i64> =
        line.split(|c: char| !(c.is_ascii_digit() || c == '-')).filter_map(|n| n.parse().ok()).collect();
    let (x, y): (Vec<i64>, Vec<i64>) = numbers.chunks(2).map(|c| (c[0], c[1])).unzip();
    let span = |v: &[i64]| v.iter().max().expect("max") - v.iter().min().expect("min");
    assert_eq!((span(&x), span(&y), x.len()), (12_000, 24_000, 5));
}

#[test]
fn pdf_is_tiled_without_gaps_at_one_to_one() {
    let sheet = lay(&[piece("A")], 20.0, Some(400.0));
    let (bytes, _) = pdf(&sheet, Paper::named("a4").expect("a4"), "T").expect("pdf");
    let text = String::from_utf8_lossy(&bytes);
    assert!(text.starts_with("%PDF-"));
    // 190 × 277 mm show on a page.
    let pages = ((sheet.size.x / 190.0).ceil() * (sheet.size.y / 277.0).ceil()) as usize;
    assert_eq!(text.matches("/Type /Page\n").count(), pages);
    assert!(text.contains("/MediaBox [0 0 595.27"), "210 mm are 595.276 points");
    let (one, _) = pdf(&sheet, Paper::Sheet, "T").expect("one page");
    assert_eq!(String::from_utf8_lossy(&one).matches("/Type /Page\n").count(), 1);
    assert_eq!(pdf(&sheet, Paper::Sheet, "T").expect("again").0, one, "the same bytes");
}

#[test]
fn what_is_too_large_is_said() {
    let large = Sheet { size: Vec2::new(1e6, 1e6), ..Sheet::default() };
    assert_eq!(hpgl(&large).expect_err("hpgl").code, "sheet-too-large");
    assert_eq!(pdf(&large, Paper::Sheet, "").expect_err("pdf").code, "sheet-too-large");
    assert_eq!(pdf(&large, Paper::named("a4").expect("a4"), "").expect_err("pdf").code, "sheet-too-large");
}
