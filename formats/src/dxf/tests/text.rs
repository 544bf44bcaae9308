//! Text forms, lost lines, damage, code pages.

use super::*;

#[test]
fn plain_piece_without_any_warning() {
    let pattern = good(&wedge_file());
    assert_wedge(&pattern);
    assert_eq!(codes(&pattern.findings), [] as [&str; 0]);
    assert_eq!((pattern.ledger.count(ledger::Verdict::Refused), pattern.sizes.len()), (0, 1));
    let g = garment(&pattern);
    let piece = &g.pieces[0];
    assert_eq!((g.style.as_str(), g.size.as_deref(), piece.name.as_str()), ("TEST", Some("38"), "FRONT"));
    assert!((piece.outline.signed_area() - 0.1785).abs() < 1e-9, "counter-clockwise, metres");
    assert_eq!((piece.edges.len(), piece.darts.len()), (7, 1));
    let dart = &piece.darts[0];
    assert_eq!(dart.kind, DartKind::Wedge);
    // Legs run from the mouth to the apex on vertices of the outline, the first one met counter-clockwise.
    assert_eq!(dart.legs[0][0], toile_garment::Vec2::new(0.165, 0.6));
    let outline = piece.outline.positions();
    assert!(dart.legs.iter().flatten().all(|p| outline.contains(p)));
    assert_eq!(piece.grain.map(|g| (g[1] - g[0]).y), Some(0.45 - 0.15));
}

#[test]
fn text_forms_change_nothing() {
    let plain = wedge_file();
    let forms = [
        plain.replace('\n', "\r\n"),
        plain.replace('\n', "\r"),
        plain.replacen('\n', "\r\n", 40),
        format!("\u{FEFF}{plain}"),
        format!("999\na comment\n{plain}"),
        plain.replace("POLYLINE", "polyline").replace("SECTION", "Section").replace("VERTEX", "vertex"),
        plain.replacen("  8\n1\n", "  8\n1\n250\n2\n5000\nx\n155\ny\n", 3),
        plain.replace("HEADER\n", "HEADER\n  9\n$TDCREATE\n 40\n1e300\n"),
        plain.replace("  0\nSECTION\n  2\nHEADER\n  0\nENDSEC\n", ""),
        plain.replace("\n1\n", "\n  1 \n"),
    ];
    for form in forms {
        assert_wedge(&good(&form));
    }
}

#[test]
fn missing_end_mark_and_blank_lines_are_said() {
    let plain = wedge_file();
    let no_eof = good(&plain.replace("  0\nEOF\n", ""));
    assert_wedge(&no_eof);
    assert_eq!(codes(&no_eof.findings), ["eof-missing"]);
    let blank = good(&plain.replacen("  0\nVERTEX", "\n  0\nVERTEX", 1));
    assert_wedge(&blank);
    assert_eq!(codes(&blank.findings), ["blank-line"]);
    assert!(blank.findings[0].source.as_ref().is_some_and(|s| s.line.is_some()));
    let seqend = good(&plain.replacen("  0\nSEQEND\n", "", 1));
    assert_wedge(&seqend);
    assert_eq!(codes(&seqend.findings), ["polyline-without-seqend"]);
}

#[test]
fn a_cut_file_never_gives_a_shorter_piece() {
    let plain = wedge_file();
    let whole = good(&plain);
    let area = geom::area(&whole.pieces[0].boundary.positions());
    for cut in (0..plain.len()).step_by(7) {
        if let Ok(pattern) = read(&plain.as_bytes()[..cut], "t.dxf", &ReadOptions::default()) {
            assert_eq!(pattern.pieces.len(), 1, "cut at {cut}");
            assert_eq!(geom::area(&pattern.pieces[0].boundary.positions()), area, "cut at {cut}");
            assert!(pattern.findings.iter().any(|f| f.severity == Severity::Warning), "cut at {cut}");
        }
    }
}

#[test]
fn lost_lines_are_never_silent() {
    let plain = wedge_file();
    let lines: Vec<&str> = plain.lines().collect();
    let start = lines.iter().position(|l| *l == "POLYLINE").expect("polyline");
    let end = lines.iter().position(|l| *l == "SEQEND").expect("seqend");
    for lost in start..end {
        let rest: Vec<&str> = lines.iter().enumerate().filter(|(i, _)| *i != lost).map(|(_, l)| *l).collect();
        if let Ok(pattern) = read(rest.join("\n").as_bytes(), "t.dxf", &ReadOptions::default()) {
            panic!("line {} lost, and still {} vertices", lost + 1, pattern.pieces[0].boundary.drawn.len());
        }
    }
}

#[test]
fn bad_numbers_are_refused_with_their_line() {
    let cases = [
        ("165,0", "decimal-comma"),
        ("nan", "bad-number"),
        ("inf", "bad-number"),
        ("1.0D+02", "bad-number"),
        ("0x10", "bad-number"),
        ("", "bad-number"),
        ("1e300", "number-out-of-range"),
    ];
    let plain = wedge_file();
    let line = plain.lines().position(|l| l == "165").expect("number") as u64 + 1;
    for (text, code) in cases {
        let e = bad(&plain.replacen("\n165\n", &format!("\n{text}\n"), 1));
        assert_eq!(codes(&e), [code], "{text}");
        assert_eq!(e[0].source.as_ref().and_then(|s| s.line), Some(line), "{text}");
    }
}

#[test]
fn damaged_structure_is_refused() {
    let plain = wedge_file();
    let cases = [
        (plain.replacen("  0\nVERTEX\n  8\n1\n 10\n165\n", " 10\n165\n", 1), "coordinate-twice"),
        (plain.replacen("\nVERTEX\n", "\nVERTfX\n", 1), "stray-vertex"),
        (plain.replacen(" 20\n500\n", "", 1), "coordinate-missing"),
        (plain.replacen("  0\nBLOCK\n", "", 1), "endblk-without-block"),
        (plain.replacen("\nSECTION\n  2\nBLOCKS", "\nSEXTION\n  2\nBLOCKS", 1), "outside-section"),
        ("hello\nworld\n".to_owned(), "not-dxf"),
        (String::new(), "file-empty"),
        ("AutoCAD Binary DXF\r\n\u{1a}".to_owned(), "binary-dxf"),
        ("0\nEOF\n".to_owned(), "not-dxf"),
        (format!("  1\n{}\n{plain}", "x".repeat(70_000)), "line-too-long"),
    ];
    for (text, code) in cases {
        let e = bad(&text);
        assert!(codes(&e).contains(&code), "{code}: {:?}", codes(&e));
    }
}

#[test]
fn names_cannot_carry_terminal_codes() {
    let text = wedge_file().replace("Piece Name: FRONT", "Piece Name: A\u{1b}[2JB");
    let name = good(&text).pieces[0].name.clone().expect("name");
    assert!(!name.chars().any(char::is_control), "{name:?}");
}

#[test]
fn gbk_names_are_read_and_said() {
    let text = wedge_file();
    let at = text.find("FRONT\n").expect("name");
    let mut bytes = text.as_bytes()[..at].to_vec();
    bytes.extend_from_slice(b"\xc7\xb0\xc6\xac");
    bytes.extend_from_slice(&text.as_bytes()[at + 5..]);
    let pattern = read(&bytes, "t.dxf", &ReadOptions::default()).expect("gbk");
    assert!(pattern.pieces[0].name.as_deref() == Some("前片") || pattern.pieces[0].block.starts_with("前片"));
    assert_eq!(codes(&pattern.findings)[0], "encoding-guessed");
}
