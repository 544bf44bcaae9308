//! Proposals for garments drafted here.

use super::atoms::Mark;
use super::layout;
use super::mirror::{ALONE, maps};
use super::tuning::{CALIBRATION, confidence};
use super::{Known, Nameless, Proposal, RoleNames, Run, propose};
use crate::sewing::shapes::shapes;
use crate::testing::{dart, notch, piece, rectangle};
use toile_garment::dart::DartKind;
use toile_garment::outline::PointKind;
use toile_garment::{Garment, Piece, PieceId};

fn garment(pieces: Vec<Piece>) -> Garment {
    let pieces = pieces.into_iter().enumerate().map(|(i, p)| Piece { id: PieceId::from(i), ..p }).collect();
    Garment { pieces, ..Garment::default() }
}

/// A panel of a skirt, mm: wide at the hem, sloping sides of the same length.
fn panel(name: &str, top: f64) -> Piece {
    piece(0, name, &[(0.0, 0.0, 't'), (top + 150.0, 0.0, 't'), (top + 75.0, 600.0, 't'), (75.0, 600.0, 't')])
}

/// A skirt with waistbands.
fn skirt() -> Garment {
    garment(vec![
        panel("front", 350.0),
        panel("back", 390.0),
        rectangle(0, "band front", 350.0, 40.0),
        rectangle(0, "band back", 390.0, 40.0),
    ])
}

/// The seams as pairs of `piece.edges`, in alphabetical order.
fn sewn(garment: &Garment, proposal: &Proposal) -> Vec<String> {
    let side = |runs: &[Run]| {
        let one = |r: &Run| {
            r.edges.iter().map(|e| format!("{}.{}", garment.pieces[r.piece].name, e.number)).collect::<Vec<_>>()
        };
        runs.iter().flat_map(one).collect::<Vec<_>>().join("+")
    };
    let mut out: Vec<String> = proposal
        .seams
        .iter()
        .map(|s| {
            let mut sides = [side(&s.a), side(&s.b)];
            sides.sort();
            sides.join(" = ")
        })
        .collect();
    out.sort();
    out
}

#[test]
fn a_skirt_is_sewn_at_its_sides_and_to_its_bands_and_stays_open_at_hem_and_waist() {
    let skirt = skirt();
    let proposal = propose(&skirt, &Nameless, &Known::default()).expect("proposal");
    assert_eq!(
        sewn(&skirt, &proposal),
        [
            "back.1 = front.3",
            "back.2 = band back.0",
            "back.3 = front.1",
            "band back.1 = band front.3",
            "band back.3 = band front.1",
            "band front.0 = front.2",
        ]
    );
    let mut bare: Vec<(usize, u32)> = proposal.bare.iter().map(|b| (b.piece, b.edge)).collect();
    bare.sort_unstable();
    assert_eq!(bare, [(0, 0), (1, 0), (2, 2), (3, 2)]);
    for seam in &proposal.seams {
        let sum =
            |runs: &[Run]| -> f64 { runs.iter().flat_map(|r| r.points.windows(2)).map(|w| (w[1] - w[0]).norm()).sum() };
        assert!((sum(&seam.a) - seam.length_a).abs() < 1e-9 && (sum(&seam.b) - seam.length_b).abs() < 1e-9);
        assert!(seam.ease().abs() < 1e-9 && !seam.fold_over, "{seam:?}");
    }
}

#[test]
fn a_place_of_grading_on_one_side_of_a_seam_does_not_part_it() {
    // The sides of the back have a corner that does not turn. The sides of the front have none.
    let marked = |name: &str, top: f64| {
        let right = |share: f64| (top + 150.0 - 75.0 * share, 600.0 * share, 't');
        let left = |share: f64| (75.0 * share, 600.0 * share, 't');
        piece(0, name, &[left(0.0), right(0.0), right(0.36), right(1.0), left(1.0), left(0.36)])
    };
    let skirt = garment(vec![panel("front", 350.0), marked("back", 390.0)]);
    let proposal = propose(&skirt, &Nameless, &Known::default()).expect("proposal");
    assert_eq!(sewn(&skirt, &proposal), ["back.2+back.1 = front.3", "back.5+back.4 = front.1"]);
    // Where both have one it is a mark that meets its like.
    let skirt = garment(vec![marked("front", 350.0), marked("back", 390.0)]);
    let layout = layout::marked(&skirt, &shapes(&skirt).expect("shapes"), &[]);
    assert_eq!(layout.panels.iter().map(|p| p.atoms.len()).collect::<Vec<_>>(), [6, 6]);
}

#[test]
fn places_of_grading_elsewhere_on_both_sides_of_a_seam_do_not_part_it() {
    let graded = |name: &str, top: f64, share: f64| {
        let right = |share: f64| (top + 150.0 - 75.0 * share, 600.0 * share, 't');
        let left = |share: f64| (75.0 * share, 600.0 * share, 't');
        piece(
            0,
            name,
            &[left(0.0), right(0.0), right(share), right(0.8), right(1.0), left(1.0), left(0.8), left(share)],
        )
    };
    // The place at 0.8 of both is a mark that meets its like.
    let skirt = garment(vec![graded("front", 350.0, 0.25), graded("back", 390.0, 0.37)]);
    let layout = layout::marked(&skirt, &shapes(&skirt).expect("shapes"), &[]);
    assert_eq!(layout.panels.iter().map(|p| p.atoms.len()).collect::<Vec<_>>(), [6, 6]);
}

#[test]
fn ribs_are_sewn_last_around_the_openings_of_the_others() {
    let neckline = 2.0 * (libm::hypot(60.0, 120.0) + libm::hypot(60.0, 60.0));
    let rib = |name: &str, length: f64, height: f64| rectangle(0, name, length, height);
    // The hem rib is as long as the hem of the front with its side, and all ends are alike.
    let pieces = vec![
        top("front", 120.0),
        top("back", 60.0),
        sleeve("left sleeve"),
        sleeve("right sleeve"),
        rib("hem rib", 0.85 * 960.0, 60.0),
        rib("neck rib", 0.85 * neckline, 60.0),
        rib("left cuff", 0.7 * 300.0, 60.0),
        rib("right cuff", 0.7 * 300.0, 60.0),
    ];
    let top = garment(pieces);
    let proposal = propose(&top, &RoleNames::new(&top), &Known::default()).expect("proposal");
    let rings = |band: usize| {
        let of_band = proposal.seams.iter().filter(move |s| s.b[0].piece == band && s.a[0].piece != band);
        of_band.map(|s| (s.length_a, s.a.iter().map(|r| r.piece).collect::<Vec<_>>())).collect::<Vec<_>>()
    };
    for (band, length, places) in
        [(4, 960.0, vec![0, 1]), (5, neckline, vec![0, 1]), (6, 300.0, vec![2]), (7, 300.0, vec![3])]
    {
        let [(around, pieces)] = &rings(band)[..] else { panic!("{band}: {:?}", sewn(&top, &proposal)) };
        assert!((around - length * 1e-3).abs() < 1e-6, "{band}: {around}");
        assert!(places.iter().all(|p| pieces.contains(p)), "{band}: {pieces:?}");
    }
}

#[test]
fn sleeves_without_a_name_are_found_by_their_shape() {
    let lopsided = |side: f64| {
        let mut all: Vec<(f64, f64, char)> = vec![
            (0.0, 0.0, 't'),
            (300.0, 0.0, 't'),
            (330.0, 100.0, 't'),
            (285.0, 160.0, 'c'),
            (200.0, 215.0, 'c'),
            (150.0, 225.0, 'c'),
            (100.0, 215.0, 'c'),
            (30.0, 160.0, 'c'),
            (-30.0, 100.0, 't'),
        ];
        all.iter_mut().for_each(|p| p.0 *= side);
        if side < 0.0 {
            all.reverse();
        }
        piece(0, if side > 0.0 { "P3" } else { "P4" }, &all)
    };
    let top = garment(vec![top("P1", 120.0), top("P2", 60.0), lopsided(1.0), lopsided(-1.0)]);
    let proposal = propose(&top, &Nameless, &Known::default()).expect("proposal");
    let has = |runs: &[Run], p: usize| runs.iter().any(|r| r.piece == p);
    for sleeve in [2, 3] {
        let own = proposal.seams.iter().filter(|s| has(&s.a, sleeve) && has(&s.b, sleeve)).count();
        let on: f64 = proposal
            .seams
            .iter()
            .filter(|s| has(&s.a, sleeve) != has(&s.b, sleeve))
            .map(|s| if has(&s.a, sleeve) { s.length_b } else { s.length_a })
            .sum();
        let armhole = 2.0 * (libm::hypot(50.0, 80.0) + libm::hypot(10.0, 140.0)) * 1e-3;
        assert!(own == 1 && (on - armhole).abs() < 1e-6, "{own} {on} {armhole}: {:?}", sewn(&top, &proposal));
    }
}

#[test]
fn the_same_pieces_give_the_same_proposal() {
    let skirt = skirt();
    let (one, two) = (
        propose(&skirt, &Nameless, &Known::default()).expect("one"),
        propose(&skirt, &Nameless, &Known::default()).expect("two"),
    );
    assert_eq!(one.seams, two.seams);
}

#[test]
fn a_closed_dart_is_one_joint_with_the_angle_of_the_closed_cloth() {
    // The waist is drawn with a wedge of 40 mm; closed, it runs straight on within the slope of the legs.
    let points =
        [(0.0, 0.0), (300.0, 0.0), (300.0, 500.0), (170.0, 500.0), (150.0, 400.0), (130.0, 500.0), (0.0, 500.0)];
    let corners: Vec<(f64, f64, char)> = points.iter().map(|(x, y)| (*x, *y, 't')).collect();
    let mut front = piece(0, "front", &corners);
    front.darts.push(dart("waist", DartKind::Wedge, &[(150.0, 400.0)], [(170.0, 500.0), (130.0, 500.0)]));
    let garment = garment(vec![front]);
    let shapes = shapes(&garment).expect("shapes");
    let layout = layout::marked(&garment, &shapes, &[]);
    // Hem, side, two parts of the waist, side: no leg.
    assert_eq!(layout.atoms.len(), 5);
    let joint = layout.atoms.iter().map(|a| a.joint).find(|j| j.mark == Mark::Dart).expect("dart");
    let leg = libm::atan(100.0 / 20.0);
    assert!((joint.angle - 2.0 * (std::f64::consts::PI - leg)).abs() < 1e-9, "{}", joint.angle.to_degrees());
    assert!(layout.atoms.iter().map(|a| a.length).sum::<f64>() < 1.57);
}

#[test]
fn mirror_images_are_found_between_pieces_and_within_one() {
    // A left and a right half that are no images of themselves, and a piece that is its own.
    let half = [(0.0, 0.0), (200.0, 0.0), (220.0, 300.0), (0.0, 400.0)];
    let left: Vec<(f64, f64, char)> = half.iter().map(|(x, y)| (*x, *y, 't')).collect();
    let right: Vec<(f64, f64, char)> = half.iter().rev().map(|(x, y)| (-x, *y, 't')).collect();
    let garment = garment(vec![piece(0, "a", &left), piece(0, "b", &right), panel("c", 300.0)]);
    let shapes = shapes(&garment).expect("shapes");
    let layout = layout::marked(&garment, &shapes, &[]);
    let map = &maps(&layout, &|_, _| false)[0];
    assert_eq!(map.panel, [1, 0, 2]);
    // Every atom is the image of its image, as long, and on the panel that mirrors its own.
    for (a, atom) in layout.atoms.iter().enumerate() {
        let m = map.atom[a];
        assert!(m != ALONE && map.atom[m] == a);
        assert!((layout.atoms[m].length - atom.length).abs() < 1e-9);
        assert_eq!(layout.atoms[m].panel, map.panel[atom.panel]);
    }
    // Hem and top of the third piece lie on its axis, its sides are images of each other.
    let first = layout.panels[2].atoms.start;
    assert_eq!(map.atom[first..], [first, first + 3, first + 2, first + 1]);
}

#[test]
fn a_larger_margin_is_never_less_sure() {
    let steps: Vec<f64> = (0..400).map(|k| confidence(f64::from(k) * 0.05 - 1.0)).collect();
    assert!(steps.windows(2).all(|w| w[1] >= w[0]));
    assert_eq!(confidence(1e9), CALIBRATION[CALIBRATION.len() - 1].1);
}

/// Half a top, mm: hem, side, armhole, shoulder, and a neckline of one depth.
fn top(name: &str, neckline: f64) -> Piece {
    let points = [(0.0, 0.0), (480.0, 0.0), (480.0, 400.0), (430.0, 480.0), (420.0, 620.0), (300.0, 650.0)];
    let neck = [(240.0, 650.0 - neckline)];
    let mirror = points.iter().rev().map(|(x, y)| (480.0 - x, *y));
    // Corners of the right half, the middle of the neckline, and the left half; hem and side are no corners twice.
    let all: Vec<(f64, f64)> = points[1..].iter().copied().chain(neck).chain(mirror.take(5)).collect();
    piece(0, name, &all.iter().map(|(x, y)| (*x, *y, 't')).collect::<Vec<_>>())
}

#[test]
fn a_band_without_marks_goes_around_the_neckline_and_is_closed() {
    let (front, back) = (top("front bodice", 120.0), top("back bodice", 60.0));
    let neckline = |deep: f64| 2.0 * libm::hypot(60.0, deep);
    let around = neckline(120.0) + neckline(60.0);
    let band = rectangle(0, "neck band", 0.9 * around, 30.0);
    let top = garment(vec![front, back, band]);
    let proposal = propose(&top, &RoleNames::new(&top), &Known::default()).expect("proposal");
    let of_band: Vec<_> = proposal.seams.iter().filter(|s| s.b.iter().any(|r| r.piece == 2)).collect();
    let ring = of_band.iter().find(|s| s.a.iter().all(|r| r.piece != 2)).expect("a seam around the neck");
    assert!((ring.length_a - around * 1e-3).abs() < 1e-6, "{}", ring.length_a);
    assert!((ring.length_b - 0.9 * around * 1e-3).abs() < 1e-6);
    let pieces: Vec<usize> = ring.a.iter().map(|r| r.piece).collect();
    assert!(pieces.contains(&0) && pieces.contains(&1));
    let ends = of_band.iter().find(|s| s.a.iter().all(|r| r.piece == 2)).expect("the ends of the band");
    assert!((ends.length_a - 0.03).abs() < 1e-9 && !ends.fold_over);
}

#[test]
fn a_single_band_goes_around_no_opening_of_a_pair() {
    // It is a better length for an armhole: 0.9 of it, and 0.96 of the neckline.
    let armhole = 2.0 * (libm::hypot(50.0, 80.0) + libm::hypot(10.0, 140.0));
    let band = || rectangle(0, "neck band", 0.9 * armhole, 30.0);
    let top = garment(vec![top("front bodice", 120.0), top("back bodice", 60.0), band()]);
    let proposal = propose(&top, &RoleNames::new(&top), &Known::default()).expect("proposal");
    let ring = proposal.seams.iter().find(|s| s.b[0].piece == 2 && s.a[0].piece != 2).expect("a ring");
    let around = 2.0 * (libm::hypot(60.0, 120.0) + libm::hypot(60.0, 60.0));
    assert!((ring.length_a - around * 1e-3).abs() < 1e-6, "{}", ring.length_a);
}

#[test]
fn a_collar_stands_open_in_the_middle_of_the_front() {
    // The second front has a round neckline: no mark tells its middle.
    let round = |mut front: Piece| {
        front
            .outline
            .points
            .iter_mut()
            .filter(|p| (p.at.x - 0.24).abs() < 1e-9 && p.at.y > 0.1)
            .for_each(|p| p.kind = PointKind::Curve);
        front
    };
    for is_round in [false, true] {
        let front = top("front bodice", if is_round { 20.0 } else { 120.0 });
        let front = if is_round { round(front) } else { front };
        let back = top("back bodice", 60.0);
        let around = 2.0 * (libm::hypot(60.0, if is_round { 20.0 } else { 120.0 }) + libm::hypot(60.0, 60.0));
        let garment = garment(vec![front, back, rectangle(0, "collar", 0.95 * around, 70.0)]);
        let proposal = propose(&garment, &RoleNames::new(&garment), &Known::default()).expect("proposal");
        let of_collar: Vec<_> = proposal.seams.iter().filter(|s| s.b.iter().any(|r| r.piece == 2)).collect();
        let [ring] = of_collar[..] else { panic!("its ends are free: {}", of_collar.len()) };
        assert!((ring.length_a - around * 1e-3).abs() < 1e-6, "{}", ring.length_a);
        let (first, last) = (&ring.a[0], &ring.a[ring.a.len() - 1]);
        assert_eq!((first.piece, last.piece), (0, 0));
        assert!(
            (first.ends[0].x - 0.24).abs() < 1e-6 && (first.ends[0] - last.ends[1]).norm() < 1e-9,
            "{:?}",
            first.ends
        );
    }
}

/// A sleeve of one piece without marks, mm: hem, sides of 104 mm, and a cap.
fn sleeve(name: &str) -> Piece {
    let corners = [(0.0, 0.0), (300.0, 0.0), (330.0, 100.0)];
    let cap = [(270.0, 160.0), (200.0, 215.0), (150.0, 225.0), (100.0, 215.0), (30.0, 160.0)];
    let turns = corners.iter().chain(&[(-30.0, 100.0)]).map(|(x, y)| (*x, *y, 't'));
    let mut all: Vec<(f64, f64, char)> = turns.collect();
    all.splice(3..3, cap.iter().map(|(x, y)| (*x, *y, 'c')));
    piece(0, name, &all)
}

#[test]
fn a_sleeve_without_marks_is_sewn_to_a_tube_and_all_round_its_armhole() {
    let pieces =
        vec![top("front bodice", 120.0), top("back bodice", 60.0), sleeve("left sleeve"), sleeve("right sleeve")];
    let top = garment(pieces);
    let proposal = propose(&top, &RoleNames::new(&top), &Known::default()).expect("proposal");
    let has = |runs: &[Run], p: usize| runs.iter().any(|r| r.piece == p);
    let armhole = 4.0 * (libm::hypot(50.0, 80.0) + libm::hypot(10.0, 140.0)) * 0.5e-3;
    for sleeve in [2, 3] {
        let own: Vec<_> = proposal.seams.iter().filter(|s| has(&s.a, sleeve) && has(&s.b, sleeve)).collect();
        assert_eq!(own.len(), 1);
        assert!((own[0].length_a - libm::hypot(30.0, 100.0) * 1e-3).abs() < 1e-6, "{}", own[0].length_a);
        let on: Vec<_> = proposal.seams.iter().filter(|s| has(&s.b, sleeve) && !has(&s.a, sleeve)).collect();
        assert!((on.iter().map(|s| s.length_a).sum::<f64>() - armhole).abs() < 1e-6);
        let points = |s: &&super::ProposedSeam| s.b.iter().flat_map(|r| r.points.clone()).collect::<Vec<_>>();
        assert!(on.iter().flat_map(points).all(|p| p.y > 0.0999), "only the cap is sewn to the trunk");
        // The underarm of the sleeve meets the side seams, the lowest place of the armhole.
        let meets = |s: &&super::ProposedSeam| {
            let at = |runs: &[Run], last: bool| {
                if last { runs[runs.len() - 1].ends[1] } else { runs[0].ends[0] }
            };
            [false, true]
                .iter()
                .any(|end| (at(&s.a, *end).y - 0.4).abs() < 1e-6 && (at(&s.b, *end).y - 0.1).abs() < 1e-6)
        };
        assert_eq!(on.iter().filter(|s| meets(s)).count(), on.len().min(2));
    }
}

/// Lengths of the side seams of a skirt, over the whole. Both sides have a mark at the hip. The front has another one above
/// it, at the mouth of a pocket.
fn sides_with_pocket(pocket: f64) -> Vec<f64> {
    let mark = |at: (f64, f64)| notch(at.0, at.1);
    let right = |top: f64, share: f64| (top + 150.0 - 75.0 * share, 600.0 * share);
    let left = |share: f64| (75.0 * share, 600.0 * share);
    let mut skirt = skirt();
    skirt.pieces[0].notches = [right(350.0, 0.6), left(0.6), right(350.0, pocket), left(pocket)].map(mark).to_vec();
    skirt.pieces[1].notches = [right(390.0, 0.6), left(0.6)].map(mark).to_vec();
    let proposal = propose(&skirt, &Nameless, &Known::default()).expect("proposal");
    assert!(proposal.bare.iter().all(|b| b.edge % 2 == 0), "no side is free: {:?}", proposal.bare);
    let is_side = |s: &&super::ProposedSeam| s.a.iter().chain(&s.b).all(|r| r.piece < 2);
    proposal.seams.iter().filter(is_side).map(|s| s.length_a / libm::hypot(0.075, 0.6)).collect()
}

#[test]
fn a_seam_goes_on_past_a_mark_that_one_side_alone_has() {
    // Nothing is as long as what lies between the marks, so the mark of the pocket is passed over.
    let sides = sides_with_pocket(0.64);
    assert_eq!(sides.iter().filter(|s| (*s - 1.0).abs() < 1e-6).count(), 2, "{sides:?}");
}

/// Half a leg whose waist, crotch and hem are all as long as those of its mirror image.
fn leg(name: &str, side: f64) -> Piece {
    let points = [(0.0, 0.0), (220.0, 0.0), (330.0, 600.0), (250.0, 680.0), (240.0, 860.0), (-10.0, 860.0)];
    let points = [&points[..], &[(-20.0, 680.0), (-100.0, 600.0)]].concat();
    let mut all: Vec<(f64, f64, char)> = points.iter().map(|(x, y)| (side * x, *y, 't')).collect();
    if side < 0.0 {
        all.reverse();
    }
    piece(0, name, &all)
}

#[test]
fn legs_are_not_sewn_to_each_other_all_round() {
    let legs = garment(vec![leg("leg left", 1.0), leg("leg right", -1.0)]);
    let proposal = propose(&legs, &RoleNames::new(&legs), &Known::default()).expect("proposal");
    let between = proposal.seams.iter().filter(|s| s.a[0].piece != s.b[0].piece);
    let sewn: f64 = between.map(|s| s.length_a).sum();
    let around: f64 = proposal.layout.panels[0].perimeter;
    assert!(sewn > 0.0 && sewn < 0.6 * around, "{sewn} of {around}");
}

/// A leg in one piece, mm: both inseams are as long, and one of them has a place of grading. The back rise is longer.
fn whole_leg(name: &str, side: f64) -> Piece {
    let right = [(-106.0, 0.0, 't'), (106.0, 0.0, 't'), (260.0, 700.0, 't'), (216.0, 745.0, 'c'), (205.0, 880.0, 't')];
    let left = [(-155.0, 960.0, 't'), (-185.0, 790.0, 'c'), (-200.0, 750.0, 'c'), (-260.0, 700.0, 't')];
    let mut all: Vec<(f64, f64, char)> = [&right[..], &left, &[(-235.0, 582.0, 't')]].concat();
    all.iter_mut().for_each(|p| p.0 *= side);
    if side < 0.0 {
        all.reverse();
    }
    piece(0, name, &all)
}

#[test]
fn legs_in_one_piece_are_sewn_to_themselves_below_the_crotch_and_to_each_other_above_it() {
    let waist = libm::hypot(360.0, 80.0);
    let band = rectangle(0, "waistband", 2.0 * waist, 50.0);
    let legs = garment(vec![whole_leg("leg left", 1.0), whole_leg("leg right", -1.0), band]);
    let proposal = propose(&legs, &RoleNames::new(&legs), &Known::default()).expect("proposal");
    let told = sewn(&legs, &proposal);
    let piece = |runs: &[Run]| runs[0].piece;
    let lowest = |runs: &[Run]| runs.iter().flat_map(|r| &r.points).map(|p| p.y).fold(f64::INFINITY, f64::min);
    for seam in &proposal.seams {
        match (piece(&seam.a), piece(&seam.b)) {
            (0, 1) | (1, 0) => assert!(lowest(&seam.a) > 0.6999 && lowest(&seam.b) > 0.6999, "{told:?}"),
            (a, b) if a == b && a < 2 => assert!((seam.length_a - seam.length_b).abs() < 2e-3, "{told:?}"),
            (_, leg) | (leg, _) if leg < 2 => assert!(lowest(&seam.b).max(lowest(&seam.a)) > 0.87, "{told:?}"),
            _ => {}
        }
    }
    let length = |p: usize, q: usize| -> f64 {
        let joins =
            |s: &&super::ProposedSeam| [piece(&s.a), piece(&s.b)] == [p, q] || [piece(&s.b), piece(&s.a)] == [p, q];
        proposal.seams.iter().filter(joins).map(|s| s.length_a).sum()
    };
    let inseam = libm::hypot(0.154, 0.7);
    assert!((length(0, 0) - inseam).abs() < 2e-3 && (length(1, 1) - inseam).abs() < 2e-3, "{told:?}");
    assert!(length(0, 1) > 0.45, "both rises are sewn: {told:?}");
}

#[test]
fn a_sleeve_that_fits_badly_is_not_sure() {
    let weights = super::tuning::SleeveWeights::default();
    assert_eq!(weights.confidence(0.01), weights.confidence);
    assert!(weights.confidence(0.06) < 0.65 && weights.confidence(1.0) == weights.doubtful);
}

/// Half a raglan top, mm: hem, side, a slanted armhole up to the neckline, and a neckline of one depth.
fn raglan_top(name: &str, neckline: f64, slant: f64) -> Piece {
    let right = [(480.0, 0.0), (480.0, 400.0), (240.0 + 90.0, 400.0 + slant)];
    let left = right.iter().rev().map(|(x, y)| (480.0 - x, *y));
    let points = right.iter().copied().chain([(240.0, 400.0 + slant - neckline)]).chain(left);
    piece(0, name, &points.map(|(x, y)| (x, y, 't')).collect::<Vec<_>>())
}

/// A sleeve whose two edges to the trunk end at a neckline of 80 mm. One side has a mark that the other has not.
fn raglan_sleeve(name: &str, [front, back]: [f64; 2], side: f64) -> Piece {
    let points =
        [(0.0, 0.0), (300.0, 0.0), (340.0, 200.0), (190.0, 200.0 + front), (110.0, 200.0 + back), (-40.0, 200.0)];
    let mut all = points.map(|(x, y)| (side * x, y, 't'));
    if side < 0.0 {
        all.reverse();
    }
    Piece { notches: vec![notch(side * 320.0, 100.0)], ..piece(0, name, &all) }
}

#[test]
fn raglan_sleeves_end_at_the_neckline_and_their_sides_are_closed() {
    let (front, back) = (raglan_top("front bodice", 80.0, 220.0), raglan_top("back bodice", 20.0, 250.0));
    let slants = [220.0, 250.0];
    let [left, right] = [("left sleeve", 1.0), ("right sleeve", -1.0)].map(|(n, side)| raglan_sleeve(n, slants, side));
    let top = garment(vec![front, back, left, right]);
    let proposal = propose(&top, &RoleNames::new(&top), &Known::default()).expect("proposal");
    let told = sewn(&top, &proposal);
    let between = |p: usize, q: usize| {
        let has = |runs: &[Run], p: usize| runs.iter().any(|r| r.piece == p);
        proposal.seams.iter().filter(|s| has(&s.a, p) && has(&s.b, q) || has(&s.a, q) && has(&s.b, p)).count()
    };
    for sleeve in [2, 3] {
        assert!(between(0, sleeve) == 1 && between(1, sleeve) == 1 && between(sleeve, sleeve) >= 1, "{told:?}");
    }
}
