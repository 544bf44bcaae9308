use super::*;
use toile_garment::sewing::RunSpec;

/// A front with a dart, 400 × 600 mm, and a back drawn clockwise; all in cm.
fn spec() -> String {
    r#"{"pattern": {"panels": {
      "front": {"translation": [0, 60, 20], "rotation": [0, 0, 0], "vertices":
        [[0,0],[40,0],[40,60],[23,60],[20,50],[17,60],[0,60]], "edges": [
        {"endpoints": [0,1]}, {"endpoints": [1,2]}, {"endpoints": [2,3]}, {"endpoints": [3,4]},
        {"endpoints": [4,5]}, {"endpoints": [5,6]}, {"endpoints": [6,0], "label": "side"}]},
      "back": {"translation": [0, 60, -20], "rotation": [0, 0, 0], "vertices": [[0,0],[0,60],[40,60],[40,0]], "edges": [
        {"endpoints": [0,1]}, {"endpoints": [1,2], "curvature": {"type": "quadratic", "params": [[0.5, 0.1]]}},
        {"endpoints": [2,3]}, {"endpoints": [3,0], "curvature": {"type": "circle", "params": [20, 0, 1]}}]}},
      "stitches": [[{"panel": "front", "edge": 3}, {"panel": "front", "edge": 4}],
        [{"panel": "front", "edge": 1}, {"panel": "back", "edge": 2}],
        [{"panel": "front", "edge": 6}, {"panel": "back", "edge": 0}]]},
      "properties": {"curvature_coords": "relative", "units_in_meter": 100}}"#
        .to_owned()
}

fn good(text: &str) -> Read {
    read(text.as_bytes(), "a/skirt_specification.json", 5e-5).unwrap_or_else(|e| panic!("{e:?}"))
}

#[test]
fn panels_darts_and_seams() {
    let read = good(&spec());
    assert_eq!((read.garment.style.as_str(), read.garment.pieces.len(), read.findings.len()), ("skirt", 2, 0));
    let front = read.garment.pieces.iter().find(|p| p.name == "front").expect("front");
    // 400 × 600 less half of 60 × 100 mm.
    assert!((front.outline.signed_area() - 0.237).abs() < 1e-12);
    let dart = &front.darts[0];
    assert_eq!((front.darts.len(), dart.name.as_str()), (1, "dart-1"));
    assert!((dart.apexes[0] - toile_garment::Vec2::new(0.2, 0.5)).norm() < 1e-12);
    assert!((dart.intake() - 0.06).abs() < 1e-12);
    // Counter-clockwise the leg that starts at x = 230 mm comes first.
    assert!((dart.legs[0][0].x - 0.23).abs() < 1e-12 && (dart.legs[1][0].x - 0.17).abs() < 1e-12);
    assert_eq!(read.plan.seams.len(), 2);
    assert_eq!(read.plan.seams[1].a, [RunSpec::Edge { piece: "front".into(), edge: "6".into() }]);
    assert_eq!(front.edges[6].name.as_deref(), Some("side"));
}

#[test]
fn a_clockwise_panel_is_turned_round_and_stays_where_it_was() {
    let read = good(&spec());
    let back = read.garment.pieces.iter().find(|p| p.name == "back").expect("back");
    assert!(back.outline.signed_area() > 0.0);
    let place = read.plan.places.iter().find(|p| p.piece == "back").expect("place");
    let Placement::Explicit { rotation, translation } = &place.placement else { panic!("explicit") };
    let world = |x: f64, y: f64| {
        let row = |r: [f64; 3], t: f64| r[0] * x + r[1] * y + t;
        [row(rotation[0], translation.x), row(rotation[1], translation.y), row(rotation[2], translation.z)]
    };
    // The corner (40, 60) cm of the file stands at (0.4, 1.2, −0.2) m; the piece has it at x = −0.4 m.
    let at = world(-0.4, 0.6);
    assert!((at[0] - 0.4).abs() + (at[1] - 1.2).abs() + (at[2] + 0.2).abs() < 1e-12, "{at:?}");
    // Its right side looks to the back.
    assert!((rotation[2][2] + 1.0).abs() < 1e-12);
}

#[test]
fn curves_have_the_area_of_their_closed_forms() {
    let read = good(&spec());
    let back = read.garment.pieces.iter().find(|p| p.name == "back").expect("back");
    // The parabola over the chord of 400 mm rises 0.05 · 400 mm to the left (outwards): 2/3 · 400 · 20 mm². The arc
    // of radius 200 mm over the chord of 400 mm is a half circle; to the right of its way is into the panel.
    let expected = 0.24 + 2.0 / 3.0 * 0.4 * 0.02 - 0.5 * std::f64::consts::PI * 0.04;
    assert!((back.outline.signed_area() - expected).abs() < 3e-5, "{} {expected}", back.outline.signed_area());
}

#[test]
fn rotations_turn_about_x_then_y_then_z() {
    let r = rotation([90.0, 0.0, 90.0]);
    // y goes to z by the first turn and stays; x goes to y by the last.
    assert!((r[2][1] - 1.0).abs() < 1e-12 && (r[1][0] - 1.0).abs() < 1e-12);
}

#[test]
fn different_lengths_are_eased_or_gathered() {
    let eased = spec().replace("[40,60],[40,0]]", "[40,63],[40,0]]");
    let seam = &good(&eased).plan.seams[0];
    assert!((seam.ease.expect("ease") + 0.03).abs() < 1e-9 && seam.gather.is_none());
    let gathered = good(&spec().replace("[40,60],[40,0]]", "[40,90],[40,0]]"));
    assert!((gathered.plan.seams[0].gather.expect("gather") - 1.5).abs() < 1e-9);
    assert_eq!(gathered.findings[0].code, "garmentcode-gathers");
}

#[test]
fn what_is_wrong_is_said_with_its_place() {
    for (was, is, word) in [
        ("\"panels\"", "\"pieces\"", "panels"),
        ("[40,60],[23", "[40,1e9],[23", "front"),
        ("{\"endpoints\": [1,2]}, {\"endpoints\": [2,3]}", "{\"endpoints\": [1,9]}, {\"endpoints\": [2,3]}", "edge 1"),
        ("[20, 0, 1]", "[10, 0, 1]", "radius"),
        ("\"quadratic\"", "\"spiral\"", "spiral"),
        ("\"edge\": 6", "\"edge\": 3", "sewn twice"),
        ("\"edge\": 6", "\"edge\": 60", "stitch 2"),
        ("\"units_in_meter\": 100", "\"units_in_meter\": 0", "above 0"),
        // So small that metres overflow: found among mutants.
        ("\"units_in_meter\": 100", "\"units_in_meter\": 1e-320", "above 0"),
        ("{\"endpoints\": [0,1]}, {\"endpoints\": [1,2]}", "{\"endpoints\": [0,1]}, {\"endpoints\": [0,2]}", "loop"),
    ] {
        let text = spec().replacen(was, is, 1);
        assert_ne!(text, spec(), "{was}");
        let errors = read(text.as_bytes(), "t.json", 5e-5).expect_err(was);
        assert!(errors.iter().any(|e| e.message.contains(word)), "{was}: {errors:?}");
    }
    assert_eq!(read(b"{", "t.json", 5e-5).expect_err("cut short")[0].code, "garmentcode-not-json");
}
