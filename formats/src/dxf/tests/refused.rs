//! One piece or size that is drawn wrongly: the others can be used.

use super::*;

/// A block of one piece in one size.
fn block(w: Writer, name: &str, size: &str, outline: &[(f64, f64)]) -> Writer {
    let w = w.block(&format!("{name}_{size}")).text("1", &format!("Piece Name: {name}"));
    let w = w.text("1", &format!("Size: {size}")).line("7", (60.0, 150.0), (60.0, 250.0));
    w.polyline("1", true, outline).pair(0, "ENDBLK")
}

/// Name, size and outline of a piece.
type Drawn<'a> = (&'a str, &'a str, &'a [(f64, f64)]);

/// A file of blocks with sample size 36.
fn blocks(list: &[Drawn<'_>]) -> String {
    let w = Writer::default().pair(0, "SECTION").pair(2, "BLOCKS");
    let w = list.iter().fold(w, |w, (name, size, outline)| block(w, name, size, outline)).pair(0, "ENDSEC");
    let w = w.pair(0, "SECTION").pair(2, "ENTITIES").text("1", "Units: METRIC").text("1", "Sample Size: 36");
    w.pair(0, "ENDSEC").pair(0, "EOF").0
}

const BOW: [(f64, f64); 4] = [(0.0, 0.0), (300.0, 400.0), (300.0, 0.0), (0.0, 400.0)];
const SQUARE: [(f64, f64); 4] = [(0.0, 0.0), (400.0, 0.0), (400.0, 400.0), (0.0, 400.0)];

fn names(garment: &Garment) -> Vec<&str> {
    garment.pieces.iter().map(|p| p.name.as_str()).collect()
}

#[test]
fn a_crossing_piece_keeps_only_itself_out() {
    let text = blocks(&[("A", "36", &RECTANGLE), ("B", "36", &BOW), ("C", "36", &SQUARE)]);
    let mut pattern = good(&text);
    assert_eq!(pattern.findings, []);
    let [bow] = pattern.refused.as_slice() else { panic!("{:?}", pattern.refused) };
    assert_eq!(
        (bow.label(), bow.size.as_deref(), codes(&bow.faults)),
        ("B", Some("36"), vec!["outline-crosses-itself"])
    );
    assert_eq!(bow.positions().len(), 4);
    let faults = pattern.to_garment(None, None).expect_err("B is asked for too");
    assert_eq!(codes(&faults), ["outline-crosses-itself", "sound-parts"]);
    assert!(faults[1].message.contains("pieces = [\"A\", \"C\"]"), "{}", faults[1].message);
    // The inspection shows all three, the bad one with its place.
    let json = inspect(text.as_bytes(), "t.dxf", None).expect("inspection").json;
    let shown: Vec<&str> = (0..3).filter_map(|i| json["pieces"][i]["name"].as_str()).collect();
    assert_eq!(shown, ["A", "B", "C"]);
    assert_eq!(json["pieces"][1]["importable"], false);
    assert!(json["pieces"][1]["refused"][0]["message"].as_str().is_some_and(|m| m.contains("(150.0, 200.0) mm")));
    assert_eq!(json["findings"][0]["code"], "outline-crosses-itself");
    pattern.keep_pieces(&["c".into(), "A_36".into()]).expect("there");
    assert_eq!(names(&pattern.to_garment(None, None).expect("sound").0), ["A", "C"]);
    let missing = good(&text).keep_pieces(&["D".into()]).expect_err("no such piece");
    assert_eq!(codes(&missing), ["piece-not-found"]);
    assert!(missing[0].message.contains("A, B, C"));
}

#[test]
fn a_file_without_a_sound_piece_is_refused_and_still_shown() {
    let text = blocks(&[("B", "36", &BOW)]);
    assert_eq!(codes(&bad(&text)), ["outline-crosses-itself"]);
    let inspection = inspect(text.as_bytes(), "t.dxf", None).expect("inspection");
    assert!(inspection.pattern.pieces.is_empty() && inspection.refused.len() == 1);
    assert!(inspection.text.contains("cannot be used: outline-crosses-itself"), "{}", inspection.text);
}

#[test]
fn a_wrong_size_does_not_spoil_the_others() {
    let text = blocks(&[("A", "36", &RECTANGLE), ("A", "38", &SQUARE), ("A", "40", &BOW)]);
    let pattern = good(&text);
    assert_eq!(pattern.sizes, ["36", "38", "40"]);
    for size in ["36", "38"] {
        let (garment, findings) = pattern.to_garment(Some(size), None).expect(size);
        assert_eq!((garment.size.as_deref(), findings.len()), (Some(size), 0));
    }
    let faults = pattern.to_garment(Some("40"), None).expect_err("wrong");
    assert_eq!(codes(&faults), ["outline-crosses-itself", "sound-parts"]);
    assert!(faults[1].message.contains("another size (36, 38)"), "{}", faults[1].message);
}

/// A bad number spoils the piece in whose block it stands.
#[test]
fn a_bad_number_spoils_its_own_piece() {
    let text = blocks(&[("A", "36", &RECTANGLE), ("B", "36", &SQUARE)]).replacen("400", "nan", 1);
    let pattern = good(&text);
    assert_eq!(
        names(&{
            let mut only = pattern.clone();
            only.keep_pieces(&["A".into()]).expect("there");
            only.to_garment(None, None).expect("sound").0
        }),
        ["A"]
    );
    assert_eq!((pattern.refused[0].label(), codes(&pattern.refused[0].faults)), ("B", vec!["bad-number"]));
    // A part that is inserted into pieces is no piece: it spoils the file.
    let inserted = file(|w| {
        w.polyline("1", true, &RECTANGLE)
            .pair(0, "INSERT")
            .pair(8, "4")
            .pair(2, "MARK")
            .xy(10.0, 0.0)
            .pair(0, "ENDBLK")
            .block("MARK")
            .point("4", f64::NAN, 0.0)
    });
    assert_eq!(codes(&bad(&inserted)), ["bad-number"]);
}

#[test]
fn a_piece_that_is_not_drawn_in_a_size_is_left_out_and_said() {
    let text = blocks(&[("A", "36", &RECTANGLE), ("F", "36", &SQUARE), ("A", "38", &RECTANGLE)]);
    let pattern = good(&text);
    assert_eq!(codes(&pattern.findings), ["piece-lacks-size"]);
    let (garment, findings) = pattern.to_garment(Some("38"), None).expect("without F");
    assert_eq!((names(&garment), codes(&findings)), (vec!["A"], vec!["piece-not-in-size"]));
    assert!(findings[0].message.contains("piece `F` is not drawn in size `38`"));
    assert_eq!(codes(&pattern.to_garment(Some("50"), None).expect_err("no such size")), ["size-not-found"]);
}

#[test]
fn small_loops_at_a_corner_are_cut_off_and_said() {
    // The corner (0, 400) overshoots by 8 mm and comes back under the upper edge.
    let looped = [(0.0, 0.0), (400.0, 0.0), (400.0, 400.0), (-4.0, 400.0), (-4.0, 406.0), (2.0, 394.0)];
    let pattern = good(&blocks(&[("A", "36", &SQUARE), ("A", "38", &looped)]));
    // The cut leaves a corner more than the other size has, so its edges have other numbers.
    let told = ["outline-loop-cut-off", "sizes-differ-in-vertices"];
    assert_eq!((pattern.refused.len(), codes(&pattern.findings)), (0, told.to_vec()));
    let said = &pattern.findings[0];
    assert_eq!(said.source.as_ref().and_then(|s| s.block.as_deref()), Some("A_38"));
    assert!(said.message.contains("6.0 mm") && said.message.contains("(-1.0, 400.0) mm"), "{}", said.message);
    let piece = &pattern.pieces[1].boundary;
    let at: Vec<(f64, f64)> = piece.drawn.iter().map(|n| (n.at.x, n.at.y)).collect();
    assert_eq!(at, [(0.0, 0.0), (400.0, 0.0), (400.0, 400.0), (-1.0, 400.0), (2.0, 394.0)]);
    // No loop of 20 mm is cut off, and none at all where that is asked for.
    let large = looped.map(|(x, y)| if y > 380.0 && x < 10.0 { (4.0 * x, 400.0 + 4.0 * (y - 400.0)) } else { (x, y) });
    let pattern = good(&blocks(&[("A", "36", &SQUARE), ("A", "38", &large)]));
    assert_eq!(codes(&pattern.refused[0].faults), ["outline-crosses-itself"]);
    let tolerances = Tolerances { loops: 0.0, ..Tolerances::default() };
    let options = ReadOptions { tolerances, ..ReadOptions::default() };
    let text = blocks(&[("A", "38", &looped)]);
    assert_eq!(read(text.as_bytes(), "t.dxf", &options).expect_err("refused")[0].code, "outline-crosses-itself");
}
