//! A sewing plan as the text of a sewing file.

use super::run::place_text;
use std::fmt::Write as _;
use toile_garment::Vec2;
use toile_garment::dart::DartKind;
use toile_garment::sewing::{
    Around, AttachStrength, BandLength, DartSpec, EdgeNameSpec, ElasticSpec, FoldSpec, InterliningSpec, PlaceSpec,
    Placement, PleatPress, RunSpec, RunWay, SeamSpec, SewingPlan,
};
use toile_garment::text::quoted;
use toile_garment::units::tidy;

/// The text of a sewing file that says this; `head` stands above it as a comment.
///
/// Lengths are written in millimetres with four decimals, so reading it gives every point back within 0.05 µm.
#[must_use]
pub fn text(plan: &SewingPlan, head: &str) -> String {
    let mut out: String = head.lines().map(|l| format!("# {l}\n")).collect();
    if !plan.leave_out.is_empty() {
        let names: Vec<String> = plan.leave_out.iter().map(|n| quoted(n)).collect();
        let _ = writeln!(out, "\nleave_out = [{}]", names.join(", "));
    }
    plan.edge_names.iter().for_each(|e| edge(&mut out, e));
    plan.seams.iter().for_each(|s| seam(&mut out, s));
    plan.darts.iter().for_each(|d| dart(&mut out, d));
    plan.folds.iter().for_each(|f| fold(&mut out, f));
    plan.elastics.iter().for_each(|e| elastic(&mut out, e));
    plan.interlinings.iter().for_each(|i| interlining(&mut out, i));
    for whole in &plan.wholes {
        let names: Vec<String> = whole.pieces.iter().map(|n| quoted(n)).collect();
        let _ = write!(out, "\n[[whole]]\nname = {}\npieces = [{}]\n", quoted(&whole.name), names.join(", "));
    }
    plan.places.iter().for_each(|p| place(&mut out, p));
    for layer in &plan.layers {
        let names: Vec<String> = layer.pieces.iter().map(|n| quoted(n)).collect();
        let _ = write!(out, "\n[[layer]]\npieces = [{}]\norder = {}\n", names.join(", "), layer.order);
    }
    for attach in &plan.attachments {
        let strength = match attach.strength {
            AttachStrength::Hold => "hold".to_owned(),
            AttachStrength::WhileSewing => "while-sewing".to_owned(),
            AttachStrength::Elastic(share) => format!("elastic {share}"),
        };
        let [piece, edge, to] = [&attach.piece, &attach.edge, &attach.to].map(|t| quoted(t));
        let strength = quoted(&strength);
        let _ = write!(out, "\n[[attach]]\npiece = {piece}\nedge = {edge}\nto = {to}\nstrength = {strength}\n");
    }
    for copy in &plan.copies {
        let [piece, name] = [&copy.piece, &copy.name].map(|t| quoted(t));
        let _ = write!(out, "\n[[copy]]\npiece = {piece}\nname = {name}\nmirror = {}\n", copy.mirror);
    }
    out
}

fn seam(out: &mut String, seam: &SeamSpec) {
    let _ = write!(out, "\n[[seam]]\nname = {}\na = {}\nb = {}\n", quoted(&seam.name), side(&seam.a), side(&seam.b));
    if let Some(reverse) = seam.reverse {
        let _ = writeln!(out, "reverse = {reverse}");
    }
    if let Some(ease) = seam.ease {
        let _ = writeln!(out, "ease = {}", length(ease));
    }
    if let Some(gather) = seam.gather {
        let _ = writeln!(out, "gather = {gather:.5}");
    }
    if let Some(proposed) = seam.proposed {
        let _ = writeln!(out, "proposed = {proposed}");
    }
}

fn side(runs: &[RunSpec]) -> String {
    let parts: Vec<String> = runs.iter().map(run).collect();
    match parts.as_slice() {
        [only] => only.clone(),
        many => format!("[{}]", many.join(", ")),
    }
}

fn run(run: &RunSpec) -> String {
    match run {
        RunSpec::Edge { piece, edge } => quoted(&format!("{piece}.{edge}")),
        RunSpec::Part { piece, .. } | RunSpec::Points { piece, .. } | RunSpec::Line { piece, .. } => {
            format!("{{ piece = {}, {} }}", quoted(piece), ends(run, ", "))
        }
    }
}

/// The run part of a table, its keys parted by `between`.
fn ends(run: &RunSpec, between: &str) -> String {
    match run {
        RunSpec::Edge { edge, .. } => format!("edge = {}", quoted(edge)),
        RunSpec::Part { edge, from, to, .. } => {
            let [from, to] = [*from, *to].map(|p| quoted(&place_text(p)));
            format!("edge = {}{between}from = {from}{between}to = {to}", quoted(edge))
        }
        RunSpec::Points { from, to, way, .. } => {
            let way = match way {
                RunWay::Short => "short",
                RunWay::Long => "long",
                RunWay::Left => "left",
                RunWay::Right => "right",
            };
            format!("from = {}{between}to = {}{between}way = \"{way}\"", point(*from), point(*to))
        }
        RunSpec::Line { line, .. } => format!("line = {}", points(line)),
    }
}

fn edge(out: &mut String, edge: &EdgeNameSpec) {
    let _ = write!(
        out,
        "\n[[edge]]\npiece = {}\nname = {}\n{}\n",
        quoted(edge.run.piece()),
        quoted(&edge.name),
        ends(&edge.run, "\n")
    );
}

fn dart(out: &mut String, dart: &DartSpec) {
    let _ = write!(out, "\n[[dart]]\npiece = {}\n", quoted(&dart.piece));
    if let Some(name) = &dart.name {
        let _ = writeln!(out, "name = {}", quoted(name));
    }
    let kind = match dart.kind {
        Some(DartKind::Wedge | DartKind::MarkedWedge) => "wedge",
        Some(DartKind::FishEye) => "fish-eye",
        Some(DartKind::Pleat) => "pleat",
        None => "none",
    };
    let _ = writeln!(out, "kind = \"{kind}\"");
    let apexes: Vec<String> = dart.apexes.iter().map(|p| point(*p)).collect();
    match apexes.as_slice() {
        [] => {}
        [only] => {
            let _ = writeln!(out, "apex = {only}");
        }
        many => {
            let _ = writeln!(out, "apexes = [{}]", many.join(", "));
        }
    }
    let _ = writeln!(out, "mouth = [{}, {}]", point(dart.mouth[0]), point(dart.mouth[1]));
    let press = dart.press.map(|press| match press {
        PleatPress::Knife => "knife",
        PleatPress::Inverted => "inverted",
        PleatPress::Box => "box",
    });
    if let Some(press) = press {
        let _ = writeln!(out, "press = \"{press}\"");
    }
    if let Some(sewn) = dart.sewn {
        let _ = writeln!(out, "sewn = {}", length(sewn));
    }
}

fn fold(out: &mut String, fold: &FoldSpec) {
    let _ = write!(out, "\n[[fold]]\npiece = {}\nname = {}\n", quoted(&fold.piece), quoted(&fold.name));
    let _ = write!(out, "line = {}\nangle = \"{} deg\"\n", points(&fold.line), fold.angle.to_degrees());
}

fn elastic(out: &mut String, elastic: &ElasticSpec) {
    let along: Vec<String> = elastic.along.iter().map(run).collect();
    let length = match elastic.length {
        BandLength::Length(metres) => length(metres),
        BandLength::Share(share) => format!("\"{} %\"", tidy(1e2 * share)),
    };
    let _ = write!(out, "\n[[elastic]]\nname = {}\nalong = [{}]\n", quoted(&elastic.name), along.join(", "));
    let _ = write!(out, "length = {length}\nstretch = \"{} N\"\n", elastic.stretch);
}

fn interlining(out: &mut String, interlining: &InterliningSpec) {
    let names: Vec<String> = interlining.pieces.iter().map(|n| quoted(n)).collect();
    let [mass, bending] = [1e3 * interlining.areal_mass, 1e6 * interlining.bending].map(tidy);
    let _ = write!(out, "\n[[interlining]]\npieces = [{}]\n", names.join(", "));
    let _ = write!(out, "areal_mass = \"{mass} g/m2\"\nbending = \"{bending} uN.m\"\n");
}

fn place(out: &mut String, place: &PlaceSpec) {
    let _ = write!(out, "\n[[place]]\npiece = {}\n", quoted(&place.piece));
    match &place.placement {
        Placement::Explicit { rotation, translation } => {
            let rows: Vec<String> = rotation.iter().map(|[a, b, c]| format!("[{a}, {b}, {c}]")).collect();
            let [x, y, z] = [translation.x, translation.y, translation.z].map(length);
            let _ = write!(out, "rotation = [{}]\ntranslation = [{x}, {y}, {z}]\n", rows.join(", "));
        }
        Placement::Moved { by } => {
            let [x, y, z] = [by.x, by.y, by.z].map(length);
            let _ = writeln!(out, "move = [{x}, {y}, {z}]");
        }
        Placement::Around(Around { segment, side, height, turn, shift }) => {
            let _ = write!(
                out,
                "around = {}\nside = {}\nheight = {}\nturn = \"{} deg\"\n",
                quoted(segment),
                quoted(side),
                length(*height),
                turn.to_degrees()
            );
            if *shift != 0.0 {
                let _ = writeln!(out, "shift = {}", length(*shift));
            }
        }
    }
    if let Some(ignores) = &place.ignores {
        let names: Vec<String> = ignores.iter().map(|n| quoted(n)).collect();
        let _ = writeln!(out, "ignores = [{}]", names.join(", "));
    }
}

fn point(p: Vec2) -> String {
    format!("[{}, {}]", length(p.x), length(p.y))
}

fn points(line: &[Vec2]) -> String {
    let line: Vec<String> = line.iter().map(|p| point(*p)).collect();
    format!("[{}]", line.join(", "))
}

fn length(metres: f64) -> String {
    // Minus zero has no sign in a text for people.
    let mm = 1e3 * metres;
    format!("\"{:.4} mm\"", if mm.abs() < 5e-5 { 0.0 } else { mm })
}

#[cfg(test)]
mod tests {
    use super::*;
    use toile_garment::Vec3;
    use toile_garment::sewing::{AttachSpec, LayerSpec, WholeSpec};

    #[test]
    fn what_is_written_is_read_again() {
        let points = |piece: &str, way| RunSpec::Points {
            piece: piece.to_owned(),
            from: Vec2::new(0.0123, -0.2),
            to: Vec2::new(0.3, 0.4),
            way,
        };
        let named = RunSpec::Edge { piece: "front \"A\"".to_owned(), edge: "3".to_owned() };
        let line = RunSpec::Line {
            piece: "back".to_owned(),
            line: [[0.1, 0.2], [0.1, 0.05], [0.25, 0.2]].map(Vec2::from).to_vec(),
        };
        let plan = SewingPlan {
            seams: vec![SeamSpec {
                name: "side".to_owned(),
                a: vec![points("front \"A\"", RunWay::Left), named.clone()],
                b: vec![points("back", RunWay::Right)],
                reverse: None,
                ease: Some(-0.0041),
                gather: None,
                proposed: None,
                source: None,
            }],
            darts: vec![DartSpec {
                piece: "back".to_owned(),
                name: Some("waist".to_owned()),
                apexes: vec![Vec2::new(0.1, 0.2), Vec2::new(0.1, 0.3)],
                mouth: [Vec2::new(0.09, 0.25), Vec2::new(0.11, 0.25)],
                kind: Some(DartKind::Pleat),
                press: Some(PleatPress::Box),
                sewn: Some(0.03),
                source: None,
            }],
            folds: vec![FoldSpec {
                piece: "back".to_owned(),
                name: "hem".to_owned(),
                line: vec![Vec2::new(0.0, 0.04), Vec2::new(0.5, 0.04)],
                angle: 1.5,
                source: None,
            }],
            elastics: vec![ElasticSpec {
                name: "waist".to_owned(),
                along: vec![named.clone()],
                length: BandLength::Share(0.9),
                stretch: 30.0,
                source: None,
            }],
            interlinings: vec![InterliningSpec {
                pieces: vec!["back".to_owned()],
                areal_mass: 0.06,
                bending: 4e-5,
                source: None,
            }],
            wholes: vec![WholeSpec {
                name: "front".to_owned(),
                pieces: vec!["front \"A\"".to_owned(), "side".to_owned()],
                source: None,
            }],
            places: vec![
                PlaceSpec {
                    piece: "collar".to_owned(),
                    placement: Placement::Moved { by: Vec3::new(0.0, 0.02, -0.005) },
                    ignores: None,
                    source: None,
                },
                PlaceSpec {
                    piece: "back".to_owned(),
                    placement: Placement::Around(Around {
                        segment: "torso".to_owned(),
                        side: "back".to_owned(),
                        height: 1.46,
                        turn: 0.25,
                        shift: -0.08,
                    }),
                    ignores: Some(vec!["forearm-left".to_owned()]),
                    source: None,
                },
                PlaceSpec {
                    piece: "front \"A\"".to_owned(),
                    placement: Placement::Explicit {
                        rotation: [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
                        translation: Vec3::new(0.0, 0.9, 0.25),
                    },
                    ignores: None,
                    source: None,
                },
            ],
            layers: vec![LayerSpec { pieces: vec!["back".to_owned()], order: -1, source: None }],
            attachments: vec![AttachSpec {
                piece: "back".to_owned(),
                edge: "top".to_owned(),
                to: "waist".to_owned(),
                strength: AttachStrength::Elastic(0.9),
                source: None,
            }],
            edge_names: vec![
                EdgeNameSpec { run: points("back", RunWay::Short), name: "top".to_owned(), source: None },
                EdgeNameSpec { run: line.clone(), name: "pocket".to_owned(), source: None },
            ],
            leave_out: vec!["facing".to_owned()],
            leave_out_source: None,
            copies: Vec::new(),
        };
        let read = crate::sewing::read(&text(&plan, "made for a test\nwith two lines"), "s.toml").expect("reads");
        let bare = |mut plan: SewingPlan| {
            plan.seams.iter_mut().for_each(|x| x.source = None);
            plan.darts.iter_mut().for_each(|x| x.source = None);
            plan.places.iter_mut().for_each(|x| x.source = None);
            plan.attachments.iter_mut().for_each(|x| x.source = None);
            plan.layers.iter_mut().for_each(|x| x.source = None);
            plan.wholes.iter_mut().for_each(|x| x.source = None);
            plan
        };
        let read = bare(read);
        assert_eq!((&read.layers, &read.attachments), (&plan.layers, &plan.attachments));
        assert_eq!((&read.leave_out, &read.wholes), (&plan.leave_out, &plan.wholes));
        let (RunSpec::Points { from, way, .. }, RunSpec::Edge { .. }) = (&read.seams[0].a[0], &read.seams[0].a[1])
        else {
            panic!("runs: {:?}", read.seams[0].a)
        };
        assert!((from - Vec2::new(0.0123, -0.2)).norm() < 1e-12 && *way == RunWay::Left);
        assert!((read.seams[0].ease.expect("ease") + 0.0041).abs() < 1e-12);
        assert_eq!((read.darts[0].kind, read.darts[0].apexes.len()), (Some(DartKind::Pleat), 2));
        assert_eq!((read.darts[0].press, read.darts[0].sewn), (Some(PleatPress::Box), Some(0.03)));
        let (fold, band, stiff) = (&read.folds[0], &read.elastics[0], &read.interlinings[0]);
        assert!((fold.angle - 1.5).abs() < 1e-12 && (fold.line[1] - Vec2::new(0.5, 0.04)).norm() < 1e-12);
        assert_eq!((band.length, band.stretch, band.along.len()), (BandLength::Share(0.9), 30.0, 1));
        assert!((stiff.areal_mass - 0.06).abs() < 1e-12 && (stiff.bending - 4e-5).abs() < 1e-15);
        assert_eq!((read.edge_names.len(), read.places.len()), (2, 3));
        assert_eq!((&read.edge_names[1].run, read.seam_lines("BACK").len()), (&line, 1));
        assert_eq!(read.places[0].placement, plan.places[0].placement);
        let Placement::Around(Around { turn, height, .. }) = &read.places[1].placement else { panic!("around") };
        assert!((turn - 0.25).abs() < 1e-12 && (height - 1.46).abs() < 1e-12);
        assert_eq!(read.places[1].placement, plan.places[1].placement);
    }
}
