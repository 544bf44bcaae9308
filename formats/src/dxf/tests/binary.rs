//! Binary DXF, sound and malformed.

use super::*;

/// The binary form of a text DXF.
fn binary(text: &str, wide: bool) -> Vec<u8> {
    let mut out = b"AutoCAD Binary DXF\r\n\x1a\0".to_vec();
    let lines: Vec<&str> = text.lines().collect();
    for pair in lines.chunks(2) {
        let (code, value) = (pair[0].trim().parse::<i16>().expect("code"), pair[1]);
        code_bytes(&mut out, code, wide);
        match code {
            10..=59 => out.extend(value.trim().parse::<f64>().expect("number").to_le_bytes()),
            60..=79 => out.extend(value.trim().parse::<i16>().expect("number").to_le_bytes()),
            _ => {
                out.extend(value.as_bytes());
                out.push(0);
            }
        }
    }
    out
}

fn code_bytes(out: &mut Vec<u8>, code: i16, wide: bool) {
    match (wide, u8::try_from(code)) {
        (false, Ok(short)) => out.push(short),
        (false, Err(_)) => {
            out.push(255);
            out.extend(code.to_le_bytes());
        }
        (true, _) => out.extend(code.to_le_bytes()),
    }
}

fn read_bytes(bytes: &[u8]) -> Result<Pattern, Vec<Diagnostic>> {
    read(bytes, "t.dxf", &ReadOptions::default())
}

#[test]
fn one_and_two_byte_codes_give_the_piece() {
    let text = wedge_file();
    let plain = inspect(text.as_bytes(), "t.dxf", None).expect("text");
    for wide in [false, true] {
        let bytes = binary(&text, wide);
        let pattern = read_bytes(&bytes).expect("binary");
        assert_wedge(&pattern);
        assert_eq!(codes(&pattern.findings), ["binary-dxf-read"]);
        let same = inspect(&bytes, "t.dxf", None).expect("binary");
        assert_eq!(same.json["pieces"], plain.json["pieces"]);
    }
}

#[test]
fn a_date_written_as_a_string_is_passed_over() {
    // The header of a known writer: a double as text, so that all after it stands at wrong places.
    let text = wedge_file().replace("HEADER\n", "HEADER\n  9\n$ACADVER\n  1\nAC1009\n  9\n$TDCREATE\n  1\nX\n");
    let mut bytes = binary(&text, true);
    let at = bytes.windows(4).position(|w| w == b"\x01\0X\0").expect("date");
    bytes.splice(at..at + 4, b"\x28\x00".iter().chain(b"2459000.5123\0").copied());
    let pattern = read_bytes(&bytes).expect("recovered");
    assert_wedge(&pattern);
    assert_eq!(codes(&pattern.findings)[0], "binary-dxf-damaged");
}

#[test]
fn damaged_geometry_is_refused_with_its_byte() {
    let bytes = binary(&wedge_file(), true);
    let at = bytes.windows(6).position(|w| w == b"VERTEX").expect("vertex");
    let mut text_number = bytes.clone();
    // The x of the first vertex as a string.
    let x = at + 7 + 2 + 2 + 2;
    text_number.splice(x..x + 8, b"165.000000\0".iter().copied());
    let mut bad_code = bytes.clone();
    bad_code[x - 2] = 0xFF;
    bad_code[x - 1] = 0x7F;
    for damaged in [text_number, bad_code] {
        let e = read_bytes(&damaged).expect_err("refused");
        assert_eq!(codes(&e)[0], "binary-dxf", "{e:?}");
        assert!(e[0].message.contains("at byte") && e[0].message.contains("BLOCKS"), "{}", e[0].message);
    }
}

#[test]
fn a_cut_binary_file_never_gives_a_shorter_piece() {
    let bytes = binary(&wedge_file(), false);
    for cut in 0..bytes.len() {
        if let Ok(pattern) = read_bytes(&bytes[..cut]) {
            assert_wedge(&pattern);
            assert!(pattern.findings.iter().any(|f| f.severity == Severity::Warning), "cut at {cut}");
        }
    }
}

#[test]
fn wide_text_is_read() {
    let text = wedge_file().replace("Piece Name: FRONT", "Piece Name: 前片");
    for (mark, little) in [([0xFF, 0xFE], true), ([0xFE, 0xFF], false)] {
        let units = text.encode_utf16().flat_map(|u| if little { u.to_le_bytes() } else { u.to_be_bytes() });
        let bytes: Vec<u8> = mark.into_iter().chain(units).collect();
        let pattern = read_bytes(&bytes).expect("UTF-16");
        assert_wedge(&pattern);
        assert_eq!(pattern.pieces[0].name.as_deref(), Some("前片"));
    }
}
