use super::lay::turn;
use super::*;
use crate::assemble::Assemble;
use crate::import_dxf::{ImportDxf, ImportDxfParams};
use crate::testing::{piece, rectangle, run, seam};
use crate::triangulate::Triangulate;
use std::path::Path;
use toile_garment::Vec2;
use toile_garment::body::Body;
use toile_garment::sewing::{EdgeNameSpec, EdgePlace, EdgeWay, RunSpec, SewingPlan};
use toile_stage_api::{FileError, Files, Stage, StageContext};

/// Places on a circle of 0.14 m, at bearings in degrees.
fn around(bearings: impl Iterator<Item = i32>) -> (Vec<(u32, f64)>, Vec<Vec3>) {
    let place = |b: i32| {
        let (sin, cos) = libm::sincos(f64::from(b).to_radians());
        Vec3::new(0.14 * sin, 1.05, 0.14 * cos)
    };
    let placed: Vec<Vec3> = bearings.map(place).collect();
    ((0..placed.len() as u32).map(|v| (v, f64::from(v))).collect(), placed)
}

#[test]
fn an_edge_round_the_whole_body_turns_as_it_is_walked() {
    // A waistband whose ends lie 20 degrees apart at the back, walked to the right and to the left.
    let (stations, placed) = around((-17..=17).map(|k| -10 * k));
    assert!((turn(&stations, &placed).to_degrees() + 340.0).abs() < 1e-9);
    let (stations, placed) = around((-17..=17).map(|k| 10 * k));
    assert!((turn(&stations, &placed).to_degrees() - 340.0).abs() < 1e-9);
    // The upper edge of a back, over the bearing where the angle jumps.
    let (stations, placed) = around((0..=12).map(|k| 240 - 10 * k));
    assert!((turn(&stations, &placed).to_degrees() + 120.0).abs() < 1e-9);
}

/// A trunk 280 mm wide and deep, and an arm beside it, both open at their ends.
fn body() -> Body {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for (middle, half) in [(0.0, 0.14), (0.4, 0.05)] {
        let first = positions.len() as u32;
        let corners = [(half, half), (half, -half), (-half, -half), (-half, half)];
        positions.extend([0.8, 1.2].iter().flat_map(|y| corners.map(|(x, z)| Vec3::new(middle + x, *y, z))));
        let wall = |k: u32| [[k, (k + 1) % 4, (k + 1) % 4 + 4], [k, (k + 1) % 4 + 4, k + 4]];
        triangles.extend((0..4).flat_map(wall).map(|t| t.map(|v| first + v)));
    }
    let marks = [("waist", (0.0, 0.0)), ("waist-front", (0.0, 0.14)), ("elbow-left", (0.4, 0.0))];
    let landmarks = marks.map(|(name, (x, z))| (name.to_owned(), Vec3::new(x, 1.0, z))).into();
    Body { positions, triangles, landmarks, ..Body::default() }
}

fn attach(piece: &str, edge: &str, to: &str, strength: AttachStrength) -> AttachSpec {
    AttachSpec { piece: piece.into(), edge: edge.into(), to: to.into(), strength, source: None }
}

fn hold(piece: &str, edge: &str) -> AttachSpec {
    attach(piece, edge, "waist", AttachStrength::Hold)
}

/// A skirt of two pieces with side seams. Its upper edge is edge 2 of the back, and the edges 2 and 3 of the front.
fn skirt(attachments: Vec<AttachSpec>) -> Garment {
    let corners = [(0.0, 0.0, 't'), (560.0, 0.0, 't'), (560.0, 200.0, 't'), (280.0, 200.0, 't'), (0.0, 200.0, 't')];
    let pieces = vec![piece(0, "front", &corners), rectangle(1, "back", 560.0, 200.0)];
    let edge = |piece: &str, edge: &str| vec![RunSpec::Edge { piece: piece.into(), edge: edge.into() }];
    let seams =
        vec![seam("left", edge("front", "1"), edge("back", "3")), seam("right", edge("front", "4"), edge("back", "1"))];
    let plan = SewingPlan { seams, attachments, ..SewingPlan::default() };
    Garment { pieces, plan, body: Some(body()), ..Garment::default() }
}

fn codes_of(garment: &Garment) -> Vec<String> {
    faults(garment).iter().map(|f| f.code.clone()).collect()
}

#[test]
fn edges_that_go_part_of_the_way_round_are_refused_with_what_is_missing() {
    let found = faults(&skirt(vec![hold("front", "2"), hold("front", "3")]));
    assert_eq!((found.len(), found[0].code.as_str()), (1, "attach-part-of-ring"));
    assert!(found[0].message.ends_with("is edge `2` of `back`"), "{}", found[0].message);
    let found = faults(&skirt(vec![hold("front", "2"), hold("back", "2")]));
    assert!(found[0].message.contains("edge `3` of `front`"), "{}", found[0].message);
    let mut whole = vec![hold("front", "2"), hold("front", "3"), hold("back", "2")];
    assert!(faults(&skirt(whole.clone())).is_empty());
    // A landmark of the same height is the same ring.
    whole[2].to = "waist-front".into();
    assert!(faults(&skirt(whole.clone())).is_empty());
    assert_eq!(heights(&skirt(whole)).0.len(), 1);
}

#[test]
fn a_landmark_on_a_limb_is_refused_and_not_offered() {
    let found = faults(&skirt(vec![attach("front", "0", "elbow-left", AttachStrength::Hold)]));
    assert_eq!((found.len(), found[0].code.as_str()), (1, "attach-to-limb"));
    let hint = found[0].hint.as_deref().expect("hint");
    assert!(hint.contains("[[elastic]]") && hint.ends_with("landmarks waist, waist-front"), "{hint}");
    let found = faults(&skirt(vec![attach("front", "0", "elbow", AttachStrength::Hold)]));
    assert!(found[0].hint.as_deref().is_some_and(|h| !h.contains("elbow")), "{found:?}");
}

#[test]
fn an_edge_is_attached_once() {
    let whole = || vec![hold("front", "2"), hold("front", "3"), hold("back", "2")];
    let again = [whole(), vec![attach("FRONT", "3", "waist-front", AttachStrength::WhileSewing)]].concat();
    assert_eq!(codes_of(&skirt(again)), ["attached-twice"]);
}

#[test]
fn a_name_goes_before_a_number_and_parts_of_edges_are_told_as_such() {
    let mut garment = skirt(vec![hold("back", "2"), hold("front", "half")]);
    garment.pieces[1].edges[0].name = Some("2".into());
    let [back, front] = [1, 0].map(|k| edges_of_spec(&garment, &garment.pieces[k], &garment.plan.attachments[1 - k]));
    assert_eq!(back.expect("found"), [0]);
    assert_eq!(front.expect_err("none").code, EDGE_UNKNOWN);
    let end = |share| EdgePlace { way: EdgeWay::Share(share), from_end: false };
    let part = RunSpec::Part { piece: "front".into(), edge: "2".into(), from: end(0.0), to: end(0.5) };
    let line = RunSpec::Line { piece: "front".into(), line: vec![Vec2::new(0.1, 0.1), Vec2::new(0.2, 0.1)] };
    for (run, words) in [(part, "is a part of an edge of `front`"), (line, "is a line inside `front`")] {
        garment.plan.edge_names = vec![EdgeNameSpec { run, name: "half".into(), source: None }];
        let found = faults(&garment);
        assert_eq!((found.len(), found[0].code.as_str()), (1, "attach-no-edge"));
        assert!(found[0].message.contains(words), "{}", found[0].message);
    }
}

#[test]
fn every_edge_is_held_as_its_own_table_says() {
    let strengths = [AttachStrength::Hold, AttachStrength::Elastic(0.8), AttachStrength::Elastic(0.9)];
    let edges = [("front", "2"), ("front", "3"), ("back", "2")];
    for order in [[0, 1, 2], [2, 1, 0]] {
        let specs = order.map(|k| attach(edges[k].0, edges[k].1, "waist", strengths[k])).to_vec();
        let (garment, _) = run(&Triangulate, &Default::default(), skirt(specs)).expect("mesh");
        let (garment, _) = run(&Assemble, &Default::default(), garment).expect("seams");
        let at = |p: &Vec2, side: f64| Vec3::new(side * (p.x - 0.28), 0.8 + p.y, side * 0.2);
        let sides = garment.pieces.iter().zip([1.0, -1.0]);
        let rest = |p: &Piece, side: f64| p.mesh.iter().flat_map(|m| &m.rest).map(|q| at(q, side)).collect::<Vec<_>>();
        let placed: Vec<Vec<Vec3>> = sides.map(|(p, side)| rest(p, side)).collect();
        let holds = holds(&garment, &placed, 1e-3, 1e-3).expect("holds");
        let of = |piece: usize, edge: usize| {
            let mut vertices = edge_vertices(&garment.pieces[piece], edge);
            vertices.sort_unstable();
            vertices
        };
        let lasting: Vec<u32> = holds.lasting.iter().map(|p| p.vertex.vertex).collect();
        assert_eq!(lasting, of(0, 2), "held for good: one edge of the front");
        let mut bands: Vec<Vec<u32>> =
            holds.bands.iter().map(|b| b.vertices.iter().map(|v| v.vertex).collect()).collect();
        bands.iter_mut().for_each(|b| b.sort_unstable());
        assert_eq!(bands.len(), 2);
        assert!(bands.contains(&of(0, 3)) && bands.contains(&of(1, 2)), "{bands:?}");
    }
}

/// The samples as files.
struct Samples;

impl Files for Samples {
    fn read(&mut self, path: &Path) -> Result<Vec<u8>, FileError> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../samples");
        let missing =
            |e: std::io::Error| FileError::Missing { path: path.display().to_string(), reason: e.to_string() };
        std::fs::read(folder.join(path)).map_err(missing)
    }
    fn read_optional(&mut self, path: &Path) -> Result<Option<Vec<u8>>, FileError> {
        Ok(self.read(path).ok())
    }
    fn write(&mut self, _: &Path, _: &[u8]) -> Result<(), FileError> {
        Ok(())
    }
}

#[test]
fn the_samples_go_all_the_way_round() {
    let (mut report, cancel) = (toile_garment::Report::default(), std::sync::atomic::AtomicBool::new(false));
    let names = ["circle", "gathered", "pocket", "long", "pleated"].map(|name| format!("{name}-skirt"));
    for name in names.into_iter().chain(["trousers", "jacket", "shirt"].map(str::to_owned)) {
        let mut cx = StageContext {
            report: &mut report,
            progress: &mut (),
            files: &mut Samples,
            cancel: &cancel,
            seed: 0,
            threads: 1,
        };
        let files = [format!("patterns/{name}.astm.dxf"), format!("patterns/{name}.sewing.toml")];
        let params = serde_json::json!({ "file": files[0], "sewing": files[1], "size": "38" });
        let params: ImportDxfParams = serde_json::from_value(params).expect("parameters");
        let mut garment = ImportDxf.run(&params, Garment::default(), &mut cx).expect("pattern");
        garment.body = Some(crate::stitch::load::body(Path::new("bodies/size-38.obj"), &mut cx).expect("body"));
        assert_eq!(faults(&garment), Vec::new(), "{name}");
    }
}
