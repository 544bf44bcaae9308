//! Writers told by their habits.

use super::*;

fn vendor(text: &str) -> (&'static str, Vec<String>) {
    let profile = good(text).profile;
    (profile.vendor.name(), profile.reasons)
}

fn styled(body: impl Fn(Writer) -> Writer, style: &[&str]) -> String {
    file_with(body, |w| style.iter().fold(w.text("1", "Units: METRIC"), |w, t| w.text("1", t)))
}

fn runs(w: Writer) -> Writer {
    (0..4).fold(w, |w, i| w.polyline("1", false, &[RECTANGLE[i], RECTANGLE[(i + 1) % 4]]))
}

#[test]
fn texts_name_the_writer() {
    let cases = [
        ("Author: AccuMark ; 10.0.1 ; x", "gerber"),
        ("PRODUCT: CLO Standalone OnlineAuth 4.0.129", "clo"),
        ("Author: Browzwear; VStitcher; 3.0.0", "browzwear"),
        ("Product: RichPeace CAD V9", "richpeace"),
        ("PRODUCT: OptiTex PDS 15", "optitex"),
        ("Author: Lectra; Modaris; V8", "lectra"),
        ("Product: PolyPattern", "polypattern"),
        ("Author: GRAFIS", "grafis"),
    ];
    for (text, name) in cases {
        let (found, reasons) = vendor(&styled(|w| w.polyline("1", true, &RECTANGLE), &[text]));
        assert_eq!(found, name, "{reasons:?}");
        assert!(reasons.iter().any(|r| r.contains(text.split_once(": ").expect("key").1)), "{reasons:?}");
    }
    // A style may be called anything.
    let (found, _) = vendor(&styled(|w| w.polyline("1", true, &RECTANGLE), &["Style Name: CLO GERBER"]));
    assert_ne!(found, "clo");
}

#[test]
fn habits_tell_the_writer() {
    let gerber = file(runs);
    assert_eq!(vendor(&gerber).0, "gerber");
    let clo = file(|w| w.polyline("1", true, &RECTANGLE)).replace(" 66\n1\n", " 66\n1\n250\n2\n");
    let clo = clo.replace("HEADER\n", "HEADER\n  9\n$ACADVER\n  1\nAC1006\n");
    assert_eq!(vendor(&clo).0, "clo");
    let valentina =
        file(|w| w.polyline("1", true, &RECTANGLE).line("4", (0.0, 100.0), (5.0, 100.0)).point("13", 100.0, 100.0));
    let valentina =
        format!("999\ndxfrw 0.6.3\n{}", valentina.replace("HEADER\n", "HEADER\n  9\n$ACADVER\n  1\nAC1009\n"));
    assert_eq!(vendor(&valentina).0, "valentina");
    let flat = Writer::default().pair(0, "SECTION").pair(2, "ENTITIES").polyline("CUT", true, &RECTANGLE);
    assert_eq!(vendor(&flat.pair(0, "ENDSEC").pair(0, "EOF").0).0, "plain");
    let nothing = file(|w| w.polyline("1", true, &RECTANGLE)).replace(" 40\n0.25\n", " 40\n3\n");
    assert_eq!(vendor(&nothing).0, "unknown");
}

#[test]
fn depths_in_centimetres_are_known_by_their_writer() {
    let text = styled(
        |w| {
            let w = w.polyline("1", true, &RECTANGLE).point("4", 300.0, 200.0).pair(30, "0.7").pair(38, "0.7");
            w.pair(39, "0.3").point("4", 0.0, 200.0).pair(38, "0.5")
        },
        &["Author: Browzwear; VStitcher; 3.0.0"],
    );
    let pattern = good(&text);
    let depths: Vec<f64> = pattern.pieces[0].notches.iter().map(|n| n.depth).collect();
    assert!((depths[0] - 7.0).abs() < 1e-9 && (depths[1] - 5.0).abs() < 1e-9, "{depths:?}");
    assert!((pattern.pieces[0].notches[0].width - 3.0).abs() < 1e-9);
    assert_eq!(pattern.profile.effects.len(), 1);
    let options = ReadOptions { vendor: Some(Vendor::Gerber), ..ReadOptions::default() };
    let asked = read(text.as_bytes(), "t.dxf", &options).expect("asked");
    assert!((asked.pieces[0].notches[0].depth - 0.7).abs() < 1e-9);
    assert_eq!((asked.profile.vendor, asked.profile.reasons[0].as_str()), (Vendor::Gerber, "set by the user"));
}

#[test]
fn standard_and_reasons_stand_in_the_inspection() {
    let json = inspect(file(runs).as_bytes(), "t.dxf", None).expect("inspection").json;
    assert_eq!((&json["profile"]["vendor"], &json["profile"]["standard"]), (&"gerber".into(), &"AAMA".into()));
    assert!(json["profile"]["reasons"].as_array().is_some_and(|r| r.len() == 2));
    let astm = file(|w| w.polyline("1", true, &RECTANGLE).point("81", 0.0, 100.0));
    assert_eq!(good(&astm).profile.standard.0, "ASTM");
    assert_eq!(Vendor::names().len(), 15);
    assert!(Vendor::names().iter().all(|n| Vendor::named(n).is_some()));
}

#[test]
fn code_page_and_tolerances_can_be_set() {
    let text = file(|w| w.polyline("1", true, &RECTANGLE));
    let at = text.find("FRONT\n").expect("name");
    let mut bytes = text.as_bytes()[..at].to_vec();
    bytes.extend_from_slice(b"\xcf\xf0");
    bytes.extend_from_slice(&text.as_bytes()[at + 5..]);
    let options = ReadOptions { code_page: Some("windows-1251".into()), ..ReadOptions::default() };
    let pattern = read(&bytes, "t.dxf", &options).expect("cyrillic");
    assert_eq!(pattern.pieces[0].name.as_deref(), Some("Пр"));
    assert_eq!(codes(&pattern.findings), [] as [&str; 0]);
    let wrong = ReadOptions { code_page: Some("klingon".into()), ..ReadOptions::default() };
    assert_eq!(codes(&read(&bytes, "t.dxf", &wrong).expect_err("unknown")), ["code-page-unknown"]);
    let open = file(|w| w.polyline("1", false, &[(0.0, 0.0), (300.0, 0.0), (300.0, 600.0), (0.0, 600.0), (0.0, 2.0)]));
    assert_eq!(codes(&bad(&open)), ["outline-open"]);
    let tolerances = Tolerances { gap: 2.5, ..Tolerances::default() };
    let options = ReadOptions { tolerances, ..ReadOptions::default() };
    let closed = read(open.as_bytes(), "t.dxf", &options).expect("closed");
    assert_eq!(codes(&closed.findings), ["outline-gap-closed"]);
}
