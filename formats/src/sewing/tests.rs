use super::*;
use toile_garment::Vec2;
use toile_garment::dart::DartKind;
use toile_garment::sewing::{Around, AttachStrength, EdgePlace, Placement, RunSpec, RunWay};

const WHOLE: &str = r#"
leave_out = ["LINING"]

[[seam]]
name = "side-left"
a = { piece = "front", from = ["0 mm", "384 mm"], to = ["0 mm", "0 mm"], way = "left" }
b = ["back.side", "gusset.3"]
ease = "-2 mm"
reverse = true

[[seam]]
a = "front.waist"
b = "band.lower"
gather = 1.6

[[dart]]
piece = "front"
apex = ["154 mm", "330 mm"]
mouth = [["140 mm", "443 mm"], ["168 mm", "443 mm"]]

[[dart]]
piece = "back"
apexes = [["0 mm", "0 mm"], ["0 mm", "150 mm"]]
mouth = [["-9 mm", "75 mm"], ["9 mm", "75 mm"]]
kind = "fish-eye"

[[dart]]
piece = "back"
mouth = [["-9 mm", "75 mm"], ["9 mm", "75 mm"]]
kind = "none"

[[place]]
piece = "front"
rotation = [[1,0,0],[0,1,0],[0,0,1]]
translation = ["0 mm", "914 mm", "25 cm"]

[[place]]
piece = "sleeve"
around = "arm-left"
side = "front"
turn = "90 deg"

[[layer]]
pieces = ["lining-front"]
order = -1

[[attach]]
piece = "band"
edge = 2
to = "waist"
strength = "elastic 0.9"

[[copy]]
piece = "sleeve"
name = "sleeve-right"
mirror = true

[[edge]]
piece = "front"
number = 4
name = "side-left"
"#;

#[test]
fn reads_every_table() {
    let plan = read(WHOLE, "a.sewing.toml").expect("plan");
    assert_eq!(plan.leave_out, ["LINING"]);
    let seam = &plan.seams[0];
    assert_eq!((seam.name.as_str(), seam.ease, seam.reverse), ("side-left", Some(-0.002), Some(true)));
    let RunSpec::Points { from, way, .. } = &seam.a[0] else { panic!("points") };
    assert_eq!((*from, *way), (Vec2::new(0.0, 0.384), RunWay::Left));
    assert_eq!(seam.b[1], RunSpec::Edge { piece: "gusset".into(), edge: "3".into() });
    assert_eq!(seam.source.as_ref().and_then(|s| s.line), Some(4));
    assert_eq!((plan.seams[1].name.as_str(), plan.seams[1].gather), ("seam-2", Some(1.6)));
    let kinds: Vec<_> = plan.darts.iter().map(|d| d.kind).collect();
    assert_eq!(kinds, [Some(DartKind::Wedge), Some(DartKind::FishEye), None]);
    let Placement::Explicit { translation, .. } = &plan.places[0].placement else { panic!("explicit") };
    assert_eq!(translation.z, 0.25);
    let Placement::Around(Around { height, turn, .. }) = &plan.places[1].placement else { panic!("around") };
    assert!(*height == 0.0 && (turn - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    assert_eq!(plan.layers[0].order, -1);
    assert_eq!(plan.attachments[0].strength, AttachStrength::Elastic(0.9));
    assert_eq!(plan.attachments[0].edge, "2");
    assert!(plan.copies[0].mirror);
    assert_eq!(plan.edge_names[0].run, RunSpec::Edge { piece: "front".into(), edge: "4".into() });
}

/// Code, line and column of every mistake.
fn mistakes(text: &str) -> Vec<(String, u64, u64)> {
    let errors = read(text, "bad.toml").expect_err("mistakes");
    errors
        .iter()
        .map(|e| {
            let source = e.source.as_ref().expect("every mistake has a place");
            assert_eq!(source.file, "bad.toml");
            (e.code.clone(), source.line.expect("line"), source.column.expect("column"))
        })
        .collect()
}

#[test]
fn finds_all_mistakes_at_once() {
    let text = "[[seam]]\na = \"front.1\"\nease = 5\n[[place]]\npiece = \"front\"\naround = \"torsoo\"\nside = \"front\"\n\
                heigth = \"9 mm\"\n[[seem]]\n";
    assert_eq!(
        mistakes(text),
        [
            ("sewing-key-missing".to_owned(), 1, 1),
            ("sewing-bare-number".to_owned(), 3, 8),
            ("sewing-key-missing".to_owned(), 4, 1),
            ("sewing-unknown-word".to_owned(), 6, 10),
            ("sewing-unknown-key".to_owned(), 8, 1),
            ("sewing-unknown-key".to_owned(), 9, 3),
        ]
    );
    let errors = read(text, "bad.toml").expect_err("mistakes");
    let hints: Vec<_> = errors.iter().filter_map(|e| e.hint.as_deref()).collect();
    assert!(hints.iter().any(|h| h.contains("`height`")), "{hints:?}");
    assert!(hints.iter().any(|h| h.contains("`seam`")), "{hints:?}");
    assert!(hints.iter().any(|h| h.contains("\"5 mm\"")), "{hints:?}");
    assert!(hints.iter().any(|h| h.contains("`torso`")), "{hints:?}");
}

#[test]
fn parts_that_a_piece_ignores_are_known_words() {
    let place = |ignores: &str| {
        let at = "piece = \"front\"\naround = \"torso\"\nside = \"front\"\nheight = \"1 m\"\n";
        format!("[[place]]\n{at}{ignores}\n")
    };
    let read_ignores = |text: &str| read(text, "good.toml").expect("a sewing file").places[0].ignores.clone();
    assert_eq!(read_ignores(&place("")), None);
    assert_eq!(read_ignores(&place("ignores = []")), Some(Vec::new()));
    let two = read_ignores(&place("ignores = [\"forearm-left\", \"arm-right\"]"));
    assert_eq!(two, Some(vec!["forearm-left".to_owned(), "arm-right".to_owned()]));
    assert_eq!(mistakes(&place("ignores = [\"forarm-left\"]"))[0].0, "sewing-unknown-word");
    assert_eq!(mistakes(&place("ignores = \"arm-left\""))[0].0, "sewing-wrong-type");
}

#[test]
fn refuses_what_cannot_be() {
    let one = |text: &str| mistakes(text)[0].0.clone();
    let seam = |rest: &str| format!("[[seam]]\na = \"f.1\"\nb = \"b.1\"\n{rest}\n");
    assert_eq!(one(&seam("gather = 0.5")), "sewing-bad-gather");
    assert_eq!(one(&seam("gather = nan")), "sewing-wrong-type");
    assert_eq!(one(&seam("gather = 1.2\nease = \"2 mm\"")), "sewing-ease-and-gather");
    assert_eq!(one("[[seam]]\na = \"front\"\nb = \"b.1\""), "sewing-bad-run");
    assert_eq!(one("[[seam]]\na = []\nb = \"b.1\""), "sewing-empty-list");
    assert_eq!(one("seam = 3"), "sewing-wrong-type");
    assert_eq!(one("[[seam"), "sewing-file-syntax");
    let mirror =
        "[[place]]\npiece=\"f\"\nrotation=[[-1,0,0],[0,1,0],[0,0,1]]\ntranslation=[\"0 mm\",\"0 mm\",\"0 mm\"]";
    assert_eq!(one(mirror), "sewing-no-rotation");
    let move_by = |by: &str| format!("[[place]]\npiece = \"f\"\nmove = [\"0 mm\", \"{by}\", \"0 mm\"]\n");
    assert_eq!(one(&move_by("200 m")), "out-of-range");
    assert!(read(&move_by("-200 mm"), "good.toml").is_ok());
    let around = |rest: &str| format!("[[place]]\npiece = \"f\"\naround = \"torso\"\nside = \"front\"\n{rest}\n");
    assert_eq!(one(&around("height = \"1050 m\"")), "out-of-range");
    assert_eq!(one(&around("height = \"1 m\"\nshift = \"-80 m\"")), "out-of-range");
    assert_eq!(one("[[dart]]\npiece=\"f\"\nmouth=[[\"0 mm\",\"0 mm\"],[\"1 mm\",\"0 mm\"]]"), "sewing-dart-apexes");
}

#[test]
fn refuses_tables_that_would_do_nothing_or_something_else() {
    let one = |text: &str| {
        let errors = read(text, "bad.toml").expect_err("a mistake");
        assert_eq!(errors.len(), 1, "{errors:?}");
        (errors[0].code.clone(), errors[0].source.as_ref().and_then(|s| s.line), errors[0].message.clone())
    };
    for table in ["[[layer]]\norder = 1", "[[interlining]]\nareal_mass = \"60 g/m2\"\nbending = \"40 uN.m\""] {
        let (code, line, _) = one(&format!("{table}\npieces = []\n"));
        assert_eq!((code.as_str(), line), ("sewing-empty-list", Some(table.lines().count() as u64 + 1)));
    }
    for name in ["2", "-3", "007"] {
        let found = one(&format!("[[edge]]\npiece = \"front\"\nnumber = 0\nname = \"{name}\"\n"));
        assert_eq!((found.0.as_str(), found.1), ("sewing-edge-name", Some(4)));
    }
    let dart = "[[dart]]\npiece = \"f\"\nmouth = [[\"0 mm\", \"0 mm\"], [\"20 mm\", \"0 mm\"]]\n";
    let both = "apex = [\"9 mm\", \"80 mm\"]\napexes = [[\"0 mm\", \"80 mm\"], [\"20 mm\", \"80 mm\"]]\n";
    let found = one(&format!("{dart}{both}"));
    assert_eq!((found.0.as_str(), found.2.as_str()), ("sewing-dart-apexes", "a dart has `apex` or `apexes`, not both"));
    let pleat = "kind = \"pleat\"\napexes = [[\"0 mm\", \"80 mm\"], [\"20 mm\", \"80 mm\"]]\nsewn = \"-10 mm\"\n";
    let found = one(&format!("{dart}{pleat}"));
    assert_eq!((found.0.as_str(), found.2.as_str()), ("sewing-press", "`sewn` is a length of 0 or more"));
}

#[test]
fn survives_mangled_text() {
    // Every prefix, and every byte replaced by a bracket: an answer, never a panic.
    for end in (0..WHOLE.len()).step_by(7) {
        let _ = read(&WHOLE[..end], "f");
    }
    for at in (0..WHOLE.len()).step_by(5) {
        for with in ["[", "\"", "=", "\n", "é"] {
            let _ = read(&format!("{}{with}{}", &WHOLE[..at], &WHOLE[at + 1..]), "f");
        }
    }
}

/// The ends of the part in a sewing file.
fn part(from: &str, to: &str) -> Result<[EdgePlace; 2], Vec<Diagnostic>> {
    let text = format!("[[edge]]\npiece = \"front\"\nname = \"slit\"\nedge = 3\nfrom = \"{from}\"\nto = \"{to}\"\n");
    read(&text, "s.toml").map(|plan| match &plan.edge_names[0].run {
        RunSpec::Part { piece, edge, from, to } if piece == "front" && edge == "3" => [*from, *to],
        other => panic!("{other:?}"),
    })
}

#[test]
fn places_on_an_edge_are_read_and_written() {
    let texts = ["start", "middle", "end", "notch 2", "notch 1 from end", "40 %", "120.5 mm", "33.25 mm from end"];
    for text in texts {
        let [place, end] = part(text, "end").expect("reads");
        assert_eq!((place_text(place), place_text(end)), (text.to_owned(), "end".to_owned()));
    }
    assert_eq!(place_text(part("5 cm", "end").expect("reads")[0]), "50 mm");
}

#[test]
fn a_place_that_is_none_is_told_with_the_words_that_are() {
    for text in ["halfway", "notch", "notch 0", "120 %", "-3 mm", "", "40"] {
        let found = part(text, "end").expect_err(text);
        assert_eq!(found[0].code, codes::SEWING_BAD_RUN);
        let place = found[0].source.as_ref().and_then(|s| s.line);
        assert!(found[0].hint.as_ref().is_some_and(|h| h.contains("\"middle\"")) && place == Some(5), "{found:?}");
    }
}
