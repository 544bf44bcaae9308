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

/// A font with the letters `A` (a square of 500 units) and `å` (a triangle), both 600 wide; 1,000 units to the em.
fn font() -> Vec<u8> {
    let be = |values: &[i16]| values.iter().flat_map(|v| v.to_be_bytes()).collect::<Vec<u8>>();
    let glyph = |points: &[[i16; 2]]| {
        let (mut x, mut y, mut last) = (Vec::new(), Vec::new(), [0, 0]);
        for p in points {
            x.push(p[0] - last[0]);
            y.push(p[1] - last[1]);
            last = *p;
        }
        let head = be(&[1, 0, 0, 500, 500, points.len() as i16 - 1, 0]);
        [head, vec![1; points.len()], be(&x), be(&y)].concat()
    };
    let mut glyf = glyph(&[[0, 0], [500, 0], [500, 500], [0, 500]]);
    glyf.resize(glyf.len().next_multiple_of(4), 0);
    let second = glyf.len() as i16;
    glyf.extend(glyph(&[[0, 0], [500, 0], [250, 500]]));
    glyf.resize(glyf.len().next_multiple_of(4), 0);
    let end = glyf.len() as i16;
    let mut head = vec![0_u8; 54];
    head[18..20].copy_from_slice(&1_000_i16.to_be_bytes());
    let mut maxp = be(&[1, 0, 3]);
    maxp.resize(32, 0);
    let mut hhea = vec![0_u8; 36];
    hhea[34..36].copy_from_slice(&3_i16.to_be_bytes());
    let segments =
        [be(&[4, 40, 0, 6, 0, 0, 0]), be(&[65, 0xE5, -1, 0, 65, 0xE5, -1]), be(&[-64, 2 - 0xE5, 1, 0, 0, 0])];
    let cmap = [be(&[0, 1, 3, 1, 0, 12]), segments.concat()].concat();
    let tables: Vec<(&[u8; 4], Vec<u8>)> = vec![
        (b"cmap", cmap),
        (b"glyf", glyf),
        (b"head", head),
        (b"hhea", hhea),
        (b"hmtx", be(&[600, 0, 600, 0, 600, 0])),
        (b"loca", be(&[0, 0, second / 2, end / 2])),
        (b"maxp", maxp),
    ];
    let mut out = [be(&[1, 0]), be(&[tables.len() as i16, 0, 0, 0])].concat();
    let mut at = out.len() + 16 * tables.len();
    let mut body = Vec::new();
    for (name, mut data) in tables {
        out.extend(name.iter());
        for number in [0, at as u32, data.len() as u32] {
            out.extend(number.to_be_bytes());
        }
        data.resize(data.len().next_multiple_of(4), 0);
        at += data.len();
        body.extend(data);
    }
    [out, body].concat()
}

#[test]
fn letters_of_a_font_are_drawn() {
    let bytes = font();
    let font = Font::read(&bytes, "t.ttf").expect("font");
    let label = |text: &str| Label { at: Vec2::new(100.0, 50.0), height: 7.0, text: text.into() };
    let mut sheet = Sheet { size: Vec2::new(200.0, 100.0), ..Sheet::default() };
    sheet.labels = vec![label("Aå"), label("A前")];
    let findings = spell(&mut sheet, &font);
    // 7 mm are 700 units: two letters of 6 mm about the middle, each 5 mm wide and high.
    assert_eq!((sheet.letters.len(), sheet.letters[0].len(), sheet.letters[0][1].len()), (1, 2, 3));
    let (lo, hi) = box_of(&sheet.letters[0].concat());
    assert!((lo - Vec2::new(94.0, 50.0)).norm() < 1e-9 && (hi - Vec2::new(105.0, 55.0)).norm() < 1e-9, "{lo} {hi}");
    assert!(findings.len() == 1 && findings[0].message.contains("`前`") && sheet.labels.len() == 1);
    let (text, _) = hpgl(&sheet).expect("hpgl");
    assert!(text.contains("PU3760,2000;PD3960,2000,3960,2200,3760,2200,3760,2000;"), "{text}");
    assert!(svg(&sheet, "T").contains("M94.000 50.000L99.000 50.000L99.000 45.000L94.000 45.000Z"));
    assert!(pdf(&sheet, Paper::Sheet, "T").is_ok());
    assert_eq!(Font::read(b"no font", "t.ttf").err().expect("refused").code, "font-unreadable");
}

#[test]
fn what_is_too_large_is_said() {
    let large = Sheet { size: Vec2::new(1e6, 1e6), ..Sheet::default() };
    assert_eq!(hpgl(&large).expect_err("hpgl").code, "sheet-too-large");
    assert_eq!(pdf(&large, Paper::Sheet, "").expect_err("pdf").code, "sheet-too-large");
    assert_eq!(pdf(&large, Paper::named("a4").expect("a4"), "").expect_err("pdf").code, "sheet-too-large");
}
