//! Evidence decides what is a dart: needles, slits, vents and godets with and without marks. The same piece as in
//! `dart_forms`.

use super::dart_forms::{Fact, check, notched, piece, top};
use super::*;
use crate::codes::DART_UNDECIDED;
use toile_garment::Vec2;

type Point = (f64, f64);

/// A needle dart of 3 mm over 190 mm.
const NEEDLE: [Point; 3] = [(151.5, 600.0), (150.0, 410.0), (148.5, 600.0)];
const NEEDLE_MOUTH: [Point; 2] = [NEEDLE[0], NEEDLE[2]];
/// √(1.5² + 190²).
const NEEDLE_LEG: f64 = 190.0059;
/// A slit in the hem, 20 mm wide and 298 mm deep.
const SLIT: [Point; 3] = [(240.0, 0.0), (250.0, 298.0), (260.0, 0.0)];

fn needle(kind: &'static str) -> [Fact; 1] {
    [(kind, NEEDLE[1], NEEDLE_MOUTH, [NEEDLE_LEG, NEEDLE_LEG])]
}

/// Codes of a file that is read, and how many darts its first piece has.
fn outcome(text: &str) -> (Vec<String>, usize) {
    let pattern = good(text);
    (pattern.findings.iter().map(|f| f.code.clone()).collect(), garment(&pattern).pieces[0].darts.len())
}

/// The rectangle with a slit in its hem and darts of 30 × 100 mm in its waist, cut or drawn as lines, drilled or not.
fn skirt(slit: bool, darts: &[f64], cut: bool, drilled: bool) -> String {
    let dart = |x: f64| [(x + 15.0, 600.0), (x, 500.0), (x - 15.0, 600.0)];
    let mut line = vec![(0.0, 0.0)];
    line.extend(if slit { SLIT.as_slice() } else { &[] });
    line.extend([(300.0, 0.0), (300.0, 600.0)]);
    line.extend(darts.iter().rev().filter(|_| cut).flat_map(|x| dart(*x)));
    line.push((0.0, 600.0));
    piece(&line, |w| {
        darts.iter().fold(w, |w, x| {
            let w = if cut { w } else { w.polyline("8", false, &dart(*x)) };
            if drilled { w.point("13", *x, 510.0) } else { w }
        })
    })
}

#[test]
fn a_needle_that_is_marked_is_a_dart() {
    let cut = top(&NEEDLE);
    let wedge = needle("boundary_wedge");
    check("notches", &piece(&cut, |w| notched(w, &NEEDLE_MOUTH)), &wedge);
    check("drill hole", &piece(&cut, |w| w.point("13", 150.0, 422.0)), &wedge);
    check("text", &piece(&cut, |w| w.text_at("8", "Waist Dart", 150.0, 560.0)), &wedge);
    let corners = file(|w| notched(w.polyline("1", true, &cut), &NEEDLE_MOUTH));
    check("no turn points", &corners, &wedge);
    // A blunt apex, 0.4 mm wide.
    let blunt = top(&[NEEDLE[0], (150.2, 410.0), (149.8, 410.0), NEEDLE[2]]);
    check("blunt", &piece(&blunt, |w| notched(w, &NEEDLE_MOUTH)), &wedge);
    let lines = needle("internal_line");
    check("lines", &piece(&RECTANGLE, |w| w.polyline("8", false, &NEEDLE)), &lines);
    let full = |w: Writer| notched(w.line("8", NEEDLE[0], NEEDLE[1]).line("8", NEEDLE[2], NEEDLE[1]), &NEEDLE_MOUTH);
    check("lines and notches", &piece(&top(&NEEDLE_MOUTH), |w| full(w).point("13", 150.0, 420.0)), &lines);
}

#[test]
fn a_bare_needle_is_undecided_and_its_lines_declare_it() {
    let text = piece(&top(&NEEDLE), |w| w);
    let found = check("bare", &text, &needle("boundary_wedge"));
    assert_eq!(found["darts"][0]["candidate"], true);
    assert_eq!(outcome(&text), (vec![DART_UNDECIDED.name().to_owned()], 0));
    let pattern = good(&text);
    let finding = &pattern.findings[0];
    assert_eq!(finding.severity, Severity::Warning);
    let place = finding.source.as_ref().expect("place");
    assert_eq!((place.block.as_deref(), place.layer.as_deref()), (Some("FRONT_38"), Some("1")));
    assert!(finding.message.contains("`FRONT`, 3.0 mm wide and 190 mm long"), "{}", finding.message);
    // The hint holds the table, word for word.
    let hint = finding.hint.as_deref().expect("hint");
    let from = hint.find("[[dart]]").expect("table");
    let lines: Vec<&str> = hint[from..].lines().take(4).collect();
    let plan = crate::sewing::read(&lines.join("\n"), "s.toml").expect("a sewing file");
    let declared = &plan.darts[0];
    let undecided = pattern.undecided_darts(None, None).expect("size");
    assert_eq!(undecided.len(), 1);
    let spec = &undecided[0].spec;
    assert_eq!((&declared.piece, declared.kind), (&spec.piece, spec.kind));
    let pairs = [(declared.apexes[0], spec.apexes[0]), (declared.mouth[0], spec.mouth[0])];
    assert!(pairs.iter().all(|(a, b)| (a - b).norm() < 1e-6));
    assert!((spec.apexes[0] - Vec2::new(0.15, 0.41)).norm() < 1e-12);
}

#[test]
fn a_sure_sibling_decides_and_one_notch_for_both_ends_does_not() {
    let shifted = NEEDLE.map(|(x, y)| (x - 80.0, y));
    let two = top(&[NEEDLE.as_slice(), &shifted].concat());
    assert_eq!(outcome(&piece(&two, |w| notched(w, &NEEDLE_MOUTH))), (vec![], 2));
    assert_eq!(outcome(&piece(&two, |w| w)), (vec![DART_UNDECIDED.name().to_owned(); 2], 0));
    assert_eq!(outcome(&piece(&top(&NEEDLE), |w| notched(w, &[(150.0, 600.0)]))).1, 0);
}

#[test]
fn an_unsewn_slit_is_no_dart() {
    // Alone nothing says what it is.
    assert_eq!(outcome(&skirt(true, &[], true, false)), (vec![DART_UNDECIDED.name().to_owned()], 0));
    // Beside darts that are drilled it is none, however they are drawn.
    for cut in [true, false] {
        assert_eq!(outcome(&skirt(true, &[80.0, 200.0], cut, true)), (vec!["wedge-not-a-dart".to_owned()], 2), "{cut}");
        assert_eq!(
            outcome(&skirt(true, &[80.0, 200.0], cut, false)),
            (vec![DART_UNDECIDED.name().to_owned()], 2),
            "{cut}"
        );
        assert_eq!(outcome(&skirt(false, &[80.0, 200.0], cut, true)), (vec![], 2), "{cut}");
    }
    // Two vents do not vouch for each other.
    let other = SLIT.map(|(x, y)| (x - 150.0, y));
    let line = [&[(0.0, 0.0)], other.as_slice(), &SLIT, &RECTANGLE[1..]].concat();
    assert_eq!(outcome(&piece(&line, |w| w)), (vec![DART_UNDECIDED.name().to_owned(); 2], 0));
    // Drawn as two lines it stays undecided, beside drilled darts too.
    for darts in [vec![], vec![80.0, 200.0]] {
        let slit = Writer::default().polyline("8", false, &SLIT).0;
        let text = skirt(false, &darts, false, true).replacen("  0\nENDBLK\n", &format!("{slit}  0\nENDBLK\n"), 1);
        assert_eq!(outcome(&text), (vec![DART_UNDECIDED.name().to_owned()], darts.len()));
        assert_eq!(garment(&good(&text)).pieces[0].internal_lines.len(), 1, "its line stays");
    }
    // A word settles it.
    let named = piece(&[&[(0.0, 0.0)], SLIT.as_slice(), &RECTANGLE[1..]].concat(), |w| {
        notched(w, &[SLIT[0], SLIT[2]]).text_at("8", "BACK VENT", 250.0, 100.0)
    });
    assert_eq!(outcome(&named), (vec!["wedge-not-a-dart".to_owned()], 0));
}

#[test]
fn slits_with_parallel_legs_are_none() {
    let slit = [(240.0, 0.0), (240.0, 298.0), (260.0, 298.0), (260.0, 0.0)];
    assert_eq!(outcome(&piece(&[&[(0.0, 0.0)], slit.as_slice(), &RECTANGLE[1..]].concat(), |w| w)), (vec![], 0));
    for line in [&slit[..], &[(249.0, 0.0), (249.5, 298.0), (250.5, 298.0), (251.0, 0.0)]] {
        assert_eq!(outcome(&piece(&RECTANGLE, |w| w.polyline("8", false, line))).1, 0);
        let sides = |w: Writer| w.line("8", line[0], line[1]).line("8", line[3], line[2]);
        assert_eq!(outcome(&piece(&RECTANGLE, sides)).1, 0);
    }
    // One line alone, as slits are drawn.
    assert_eq!(outcome(&piece(&RECTANGLE, |w| w.line("8", (250.0, 0.0), (250.0, 298.0)))), (vec![], 0));
}

#[test]
fn narrow_wedges_with_unequal_legs_need_more_than_legs() {
    // 2.7 degrees, legs of 120 and 145 mm at a slanted edge.
    let line = [(0.0, 0.0), (300.0, 0.0), (300.0, 560.0), (153.0, 600.0), (150.0, 480.0), (145.6, 625.0), (0.0, 640.0)];
    assert_eq!(outcome(&piece(&line, |w| w)), (vec!["wedge-not-a-dart".to_owned()], 0));
    let marked = outcome(&piece(&line, |w| notched(w, &[line[3], line[5]])));
    assert_eq!(marked, (vec!["dart-legs-differ".to_owned()], 1));
}

#[test]
fn a_place_for_a_godet_is_none_although_it_is_marked() {
    // Sides of √(10² + 298²) mm.
    let insert = [(500.0, 0.0), (520.0, 0.0), (510.0, 298.0)];
    let w = Writer::default().block("GODET").text("1", "Piece Name: GODET").text("1", "SIZE: 38");
    let w = w.polyline("1", true, &insert).points("2", &insert).line("7", (510.0, 50.0), (510.0, 200.0));
    let godet = w.pair(0, "ENDBLK").0;
    let line = [&[(0.0, 0.0)], SLIT.as_slice(), &RECTANGLE[1..]].concat();
    let text = piece(&line, |w| notched(w, &[SLIT[0], SLIT[2]]).point("13", 250.0, 290.0));
    assert_eq!(outcome(&text), (vec![], 1), "without the insert its marks count");
    let text = text.replacen("  0\nENDBLK\n", &format!("  0\nENDBLK\n{godet}"), 1);
    let text = inserting(&text, "GODET");
    assert_eq!(outcome(&text), (vec!["wedge-not-a-dart".to_owned()], 0));
}

/// A lining with the same dart, whose leg is as long as the edge beside it. A corner of both is no point of an insert.
#[test]
fn a_dart_of_another_piece_is_no_insert() {
    let dart = [(165.0, 600.0), (150.0, 500.0), (135.0, 600.0)];
    let leg = libm::hypot(15.0, 100.0);
    let shell = piece(&top(&dart), |w| w.point("13", 150.0, 510.0));
    let lining =
        [(500.0, 0.0), (665.0 + leg, 0.0), (665.0 + leg, 600.0), (665.0, 600.0), (650.0, 500.0), (635.0, 600.0)];
    let lining = [&lining[..], &[(500.0, 600.0)]].concat();
    let w = Writer::default().block("LINING").text("1", "Piece Name: LINING").text("1", "SIZE: 38");
    let w = w.polyline("1", true, &lining).points("2", &lining).line("7", (560.0, 50.0), (560.0, 200.0));
    let lining = w.pair(0, "ENDBLK").0;
    let text = shell.replacen("  0\nENDBLK\n", &format!("  0\nENDBLK\n{lining}"), 1);
    let text = inserting(&text, "LINING");
    assert_eq!(outcome(&text), (vec![], 1));
}

#[test]
fn a_nest_tells_the_undecided_darts_of_the_size_that_is_asked_for() {
    let small: Vec<Point> = top(&NEEDLE).iter().map(|(x, y)| (x * 0.9, y * 0.9)).collect();
    let w = Writer::default().block("FRONT_36").text("1", "Piece Name: FRONT").text("1", "SIZE: 36");
    let w = w.polyline("1", true, &small).points("2", &small).line("7", (60.0, 150.0), (60.0, 450.0));
    let text = piece(&top(&NEEDLE), |w| w);
    let nest = text.replacen("  0\nENDBLK\n", &format!("  0\nENDBLK\n{}  0\nENDBLK\n", w.0), 1);
    let pattern = good(&inserting(&nest, "FRONT_36"));
    assert_eq!(codes(&pattern.findings), [DART_UNDECIDED.name(); 2]);
    for (size, y) in [("36", 0.369), ("38", 0.41)] {
        let told = pattern.undecided_darts(Some(size), None).expect(size);
        assert_eq!((told.len(), told[0].spec.piece.as_str()), (1, "FRONT"), "{size}");
        assert!((told[0].spec.apexes[0].y - y).abs() < 1e-9, "{size}");
    }
    // What is a dart in one size is one in all: 14 mm over 200 mm is, 11 mm alone is undecided.
    let wide = top(&[(157.0, 600.0), (150.0, 400.0), (143.0, 600.0)]);
    let narrow: Vec<Point> = top(&[(155.5, 600.0), (150.0, 400.0), (144.5, 600.0)]);
    let w = Writer::default().block("FRONT_36").text("1", "Piece Name: FRONT").text("1", "SIZE: 36");
    let w = w.polyline("1", true, &narrow).points("2", &narrow).line("7", (60.0, 150.0), (60.0, 450.0));
    let nest =
        |line: &[Point]| piece(line, |w| w).replacen("  0\nENDBLK\n", &format!("  0\nENDBLK\n{}  0\nENDBLK\n", w.0), 1);
    let darts = |text: &str| good(text).pieces.iter().map(|p| p.darts.len()).collect::<Vec<_>>();
    assert_eq!(darts(&nest(&wide)), [1, 1]);
    assert_eq!(darts(&nest(&narrow)), [0, 0]);
    // A half piece is told with its mirror image.
    let half = piece(&top(&NEEDLE), |w| w.line("6", (0.0, 0.0), (0.0, 600.0)));
    let told = good(&half).undecided_darts(None, None).expect("size");
    let x: Vec<f64> = told.iter().map(|d| d.spec.apexes[0].x).collect();
    assert!(x.len() == 2 && (x[0] + x[1]).abs() < 1e-9, "{x:?}");
}
