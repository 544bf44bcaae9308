//! A drawn file is a sound pattern: lengths that are sewn together, closed lines, allowance, darts.

use super::*;
use crate::draft::{Edge, length};
use crate::sheet::ALLOWANCE;
use toile_formats::dxf::write::PieceDrawing;
use toile_garment::Vec2;

fn edges(draft: &Draft, which: &[usize]) -> Vec<Edge> {
    which.iter().map(|i| draft.edges[*i].clone()).collect()
}

fn run(draft: &Draft, which: &[usize]) -> f64 {
    length(&edges(draft, which))
}

fn near(a: f64, b: f64, tolerance: f64, what: &str) {
    assert!((a - b).abs() <= tolerance, "{what}: {a:.3} against {b:.3} mm");
}

/// Distance of a point from a closed line.
fn distance(p: Vec2, ring: &[Vec2]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    ring.iter()
        .zip(next)
        .map(|(a, b)| {
            let d = b - a;
            let t = ((p - a).dot(&d) / d.norm_squared()).clamp(0.0, 1.0);
            (a + d * t - p).norm()
        })
        .fold(f64::MAX, f64::min)
}

fn cross(a: Vec2, b: Vec2, c: Vec2) -> f64 {
    (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)
}

fn crosses_itself(ring: &[Vec2]) -> bool {
    let n = ring.len();
    let meets = |i: usize, j: usize| {
        let [a, b, c, d] = [ring[i], ring[(i + 1) % n], ring[j], ring[(j + 1) % n]];
        cross(a, b, c) * cross(a, b, d) < 0.0 && cross(c, d, a) * cross(c, d, b) < 0.0
    };
    (0..n).any(|i| (i + 2..n).any(|j| !(i == 0 && j == n - 1) && meets(i, j)))
}

fn area(ring: &[Vec2]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(a, b)| 0.5 * (a.x * b.y - a.y * b.x)).sum()
}

fn all() -> Vec<(&'static str, Draft, PieceDrawing)> {
    let mut out = Vec::new();
    for (style, m) in STYLES.iter().flat_map(|s| SIZES.iter().map(move |m| (s, m))) {
        out.extend((style.pieces)(m).into_iter().map(|d| (style.file, d.clone(), d.drawing(m.size))));
    }
    out
}

#[test]
fn committed_files_are_what_is_drawn_here() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("samples").join("patterns");
    let files = files(&SIZES).expect("drawn");
    assert_eq!(files.len(), 2 * STYLES.len());
    for (name, bytes) in files {
        let committed = std::fs::read(folder.join(&name)).expect("committed file");
        assert!(committed == bytes, "{name} is stale: run cargo run --release --example draw_patterns");
    }
}

#[test]
fn outlines_are_closed_simple_and_counter_clockwise() {
    let mut wide = Vec::new();
    for (style, draft, drawing) in all() {
        for (a, b) in draft.edges.iter().zip(draft.edges.iter().cycle().skip(1)) {
            assert!((a.last() - b.first()).norm() < 1e-9, "{style} {}: gap after {}", draft.name, a.name);
            assert!(a.length() > 15.0, "{style} {}: {} is short", draft.name, a.name);
        }
        let sew = drawing.sew_line.as_ref().expect("sew line");
        for line in [sew, &drawing.boundary] {
            let dense = line.dense_points();
            assert!(area(&dense) > 0.0 && !crosses_itself(&dense), "{style} {}", draft.name);
            assert!(line.points.iter().all(|p| dense.contains(&p.at)));
            // The pattern's own vertices stay within 0.2 mm of the fine curve.
            let sparse: Vec<_> = line.points.iter().map(|p| p.at).collect();
            let worst = dense.iter().map(|p| distance(*p, &sparse)).fold(0.0, f64::max);
            if worst > 0.2 {
                wide.push(format!(
                    "{style} {} {:?}: chords leave the curve by {worst:.3} mm",
                    draft.name, drawing.size
                ));
            }
        }
    }
    assert!(wide.is_empty(), "{wide:#?}");
}

/// The corners between two edges at which the outline turns to the right.
fn inner_corners(draft: &Draft) -> Vec<Vec2> {
    let pairs = draft.edges.iter().zip(draft.edges.iter().cycle().skip(1));
    let inner = pairs.filter(|(a, b)| cross(a.dense()[a.dense().len() - 2], a.last(), b.dense()[1]) < 0.0);
    inner.map(|(a, _)| a.last()).collect()
}

#[test]
fn the_cut_line_lies_one_allowance_outside() {
    for (style, draft, drawing) in all() {
        let sew = drawing.sew_line.as_ref().expect("sew line").dense_points();
        let cut = drawing.boundary.dense_points();
        let legs: Vec<_> = draft.wedges.iter().flat_map(|w| [w.leg, w.leg + 1]).collect();
        let inner = inner_corners(&draft);
        for (i, edge) in draft.edges.iter().enumerate().filter(|(i, _)| !legs.contains(i)) {
            // Beside an inner corner the cut line has its own corner, which lies farther off.
            for p in edge.dense().iter().filter(|p| inner.iter().all(|c| (c - **p).norm() > ALLOWANCE)) {
                let d = distance(p + draft.shift, &cut);
                near(d, ALLOWANCE, 0.05, &format!("{style} {} edge {i} {}", draft.name, edge.name));
            }
        }
        let too_near = cut.iter().map(|p| distance(*p, &sew)).fold(f64::MAX, f64::min);
        assert!(too_near > ALLOWANCE - 0.05, "{style} {}: {too_near}", draft.name);
        for notch in &drawing.notches {
            assert!(distance(notch.at, &cut) < 1e-6, "{style} {}: notch off the cut line", draft.name);
            let d = distance(notch.at, &sew);
            let at_mouth = draft
                .wedges
                .iter()
                .any(|w| draft.wedge(*w)[..2].iter().any(|m| (m + draft.shift - notch.at).norm() < 1.3 * ALLOWANCE));
            assert!(at_mouth || (d - ALLOWANCE).abs() < 0.05, "{style} {}: notch {d}", draft.name);
        }
    }
}

#[test]
fn dart_legs_are_equal_and_darts_can_be_found() {
    let mut count = 0;
    for (style, draft, _) in all() {
        for wedge in &draft.wedges {
            let [first, second, apex] = draft.wedge(*wedge);
            let (a, b) = (apex - first, apex - second);
            near(a.norm(), b.norm(), 1e-6, &format!("{style} {} legs", draft.name));
            let angle = libm::acos(a.dot(&b) / a.norm() / b.norm()).to_degrees();
            assert!(
                (5.0..60.0).contains(&angle) && (25.0..400.0).contains(&a.norm()),
                "{style} {}: {angle}°",
                draft.name
            );
            count += 1;
        }
        for [low, right, high, left] in &draft.fish_eyes {
            near((right - low).norm(), (left - low).norm(), 1e-9, "fish-eye, lower half");
            near((right - high).norm(), (left - high).norm(), 1e-9, "fish-eye, upper half");
            count += 1;
        }
    }
    // Long skirt, bodice, shell and lining of the skirt with pockets, and trousers.
    assert_eq!(count, 3 * (2 + 2 + 4 + 2 + 4 + 4 + 1));
}

/// When a dart is closed the lines on both sides of its mouth run smoothly into each other.
#[test]
fn closed_darts_leave_a_smooth_line() {
    for (style, draft, _) in all() {
        for wedge in &draft.wedges {
            let n = draft.edges.len();
            let before = draft.edges[(wedge.leg + n - 1) % n].dense();
            let after = draft.edges[(wedge.leg + 2) % n].dense();
            let [first, second, apex] = draft.wedge(*wedge);
            let angle = |v: Vec2| libm::atan2(v.y, v.x).to_degrees();
            let turn = |a: f64, b: f64| (b - a + 540.0).rem_euclid(360.0) - 180.0;
            let arriving = turn(angle(apex - first), angle(first - before[before.len() - 2]));
            let leaving = turn(angle(apex - second), angle(after[1] - second));
            assert!((arriving - leaving).abs() < 3.0, "{style} {}: kink of {}°", draft.name, arriving - leaving);
        }
    }
}

#[test]
fn skirt_fits_and_its_seams_match() {
    for m in &SIZES {
        let pieces = long_skirt::pieces(m);
        let [front, back] = pieces.as_slice() else { panic!("two pieces") };
        near(run(front, &[1]), run(back, &[9]), 1e-6, "side");
        near(run(front, &[1]), run(front, &[9]), 1e-9, "left and right");
        let waist: f64 = pieces.iter().map(|p| run(p, &[2, 5, 8])).sum();
        near(waist, m.waist + long_skirt::WAIST_EASE, 1e-6, "finished waist");
        let names: Vec<_> = front.edges.iter().map(|e| e.name).collect();
        assert_eq!(names[..6], ["hem", "side", "waist-side", "leg", "leg", "waist-centre"]);
        assert_eq!(names[6..], ["leg", "leg", "waist-side-2", "side-2"]);
    }
}

#[test]
fn plain_skirts_are_as_wide_as_their_gathers_and_pleats() {
    for m in &SIZES {
        let waist = |pieces: Vec<Draft>| pieces.iter().map(|p| run(p, &[2])).sum::<f64>();
        near(waist(plain_skirts::gathered(m)), plain_skirts::GATHER * m.waist, 1e-9, "gathered waist");
        let pleats = 2.0 * plain_skirts::PLEATS as f64 * plain_skirts::PLEAT;
        let finished = m.waist + plain_skirts::PLEATED_WAIST_EASE;
        near(waist(plain_skirts::pleated(m)) - pleats, finished, 1e-9, "finished waist");
    }
}

/// Width of an outline at a height, dart intakes left out.
fn width_at(draft: &Draft, y: f64) -> f64 {
    let ring: Vec<_> = draft.edges.iter().flat_map(|e| e.dense()[1..].to_vec()).collect();
    let next = ring.iter().cycle().skip(1);
    let mut xs: Vec<f64> = ring
        .iter()
        .zip(next)
        .filter(|(a, b)| (a.y > y) != (b.y > y))
        .map(|(a, b)| a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y))
        .collect();
    xs.sort_by(f64::total_cmp);
    xs.chunks(2).map(|c| c[1] - c[0]).sum()
}

#[test]
fn bodice_fits_and_its_seams_match() {
    for m in &SIZES {
        let pieces = fitted_bodice::pieces(m);
        let [front, back] = pieces.as_slice() else { panic!("two pieces") };
        near(run(front, &[4, 7]), run(back, &[7]), 1e-6, "side left");
        near(run(front, &[13, 16]), run(back, &[1]), 1e-6, "side right");
        near(run(front, &[9]), run(back, &[5]), 1e-9, "shoulder");
        let bust = 2.0 * (front.edges[7].last().x + back.edges[1].last().x);
        near(bust, m.bust + fitted_bodice::BUST_EASE, 1e-6, "bust");
        let y = body::WAIST_HEIGHT;
        let waist = width_at(front, y) + width_at(back, y) - 2.0 * fitted_bodice::BACK_DART;
        near(waist, m.waist + fitted_bodice::WAIST_EASE, 0.5, "waist");
        assert!(run(front, &[10]) + run(back, &[4]) > m.neck + 20.0, "the neckline strangles");
    }
}

#[test]
fn t_shirt_fits_and_its_seams_match() {
    for m in &SIZES {
        let pieces = t_shirt::pieces(m);
        let [front, back, sleeve, band] = pieces.as_slice() else { panic!("four pieces") };
        near(run(front, &[1]), run(back, &[7]), 1e-6, "side");
        near(run(front, &[3]), run(back, &[5]), 1e-6, "shoulder");
        near(run(sleeve, &[2]), run(front, &[2]) + run(back, &[6]) + t_shirt::CAP_EASE, 1e-3, "sleeve cap");
        near(run(sleeve, &[1]), run(sleeve, &[3]), 1e-6, "underarm seam");
        let neckline = run(front, &[4]) + run(back, &[4]);
        near(neckline, run(band, &[0]) * t_shirt::NECK_STRETCH, 1e-6, "neckband");
        near(run(band, &[1]), run(band, &[3]), 1e-9, "join of the neckband");
        near(2.0 * (front.edges[1].last().x + back.edges[1].last().x), m.bust + t_shirt::BUST_EASE, 1e-6, "bust");
        // The single notch of the front armhole meets that of the cap.
        let notch = |d: &Draft, edge, k| d.notches.iter().filter(|n| n.0 == edge).nth(k).expect("notch").1;
        near(run(sleeve, &[2]) - notch(sleeve, 2, 3), notch(front, 2, 0), 1e-6, "front notch");
        near(notch(sleeve, 2, 0), run(back, &[6]) - notch(back, 6, 0), 1e-6, "back notch");
    }
}

#[test]
fn circle_skirt_is_two_half_circles() {
    for m in &SIZES {
        for piece in circle_skirt::pieces(m) {
            near(run(&piece, &[2]), (m.waist + circle_skirt::WAIST_EASE) / 2.0, 1e-2, "waist");
            near(run(&piece, &[1]), run(&piece, &[3]), 1e-9, "sides");
            near(run(&piece, &[0]) - run(&piece, &[2]), std::f64::consts::PI * run(&piece, &[1]), 0.1, "hem");
        }
    }
}

#[test]
fn pockets_and_lining_fit_the_skirt() {
    for m in &SIZES {
        let pieces = pocket_skirt::pieces(m);
        let [front, back, bag_back, bag_front, lining_front, lining_back] = pieces.as_slice() else { panic!("six") };
        near(run(front, &[1]) + run(bag_back, &[0]), run(back, &[9]), 1e-2, "side");
        near(run(front, &[2]), run(bag_front, &[0]), 1e-9, "opening");
        near(run(bag_back, &[3]), run(bag_front, &[2]), 1e-9, "bag");
        near(run(bag_back, &[2]), run(bag_front, &[1]), 1e-9, "waist of the bag");
        let front_waist = run(front, &[3, 6, 9]) + 2.0 * run(bag_back, &[1]);
        near(front_waist + run(back, &[2, 5, 8]), m.waist + pocket_skirt::WAIST_EASE, 1e-2, "waist");
        let lining: f64 = [lining_front, lining_back].map(|d| run(d, &[2, 5, 8])).iter().sum();
        near(lining, m.waist + pocket_skirt::LINING_EASE, 1e-6, "waist of the lining");
        near(run(lining_front, &[1]), run(lining_back, &[9]), 1e-6, "side of the lining");
    }
}

#[test]
fn puff_sleeves_are_as_full_as_their_gathers() {
    for m in &SIZES {
        let pieces = puff_blouse::pieces(m);
        let [front, back, sleeve, cuff] = pieces.as_slice() else { panic!("four pieces") };
        near(run(front, &[1]), run(back, &[7]), 1e-6, "side");
        near(run(front, &[3]), run(back, &[5]), 1e-6, "shoulder");
        let armhole = run(front, &[2]) + run(back, &[6]);
        near(run(sleeve, &[2]), puff_blouse::CAP_GATHER * armhole, 1e-3, "sleeve cap");
        near(run(sleeve, &[0]), puff_blouse::CUFF_GATHER * run(cuff, &[0]), 1e-6, "cuff");
        near(run(sleeve, &[1]), run(sleeve, &[3]), 1e-6, "underarm seam");
    }
}

#[test]
fn princess_seams_and_godets_match() {
    for m in &SIZES {
        let pieces = princess_dress::pieces(m);
        let [front, side_front, back, side_back, godet] = pieces.as_slice() else { panic!("five pieces") };
        for (centre, side) in [(front, side_front), (back, side_back)] {
            near(run(centre, &[2]), run(side, &[3]), 1e-3, "princess seam");
            near(run(centre, &[1]), run(side, &[4]), 1e-6, "godet");
            near(run(centre, &[1]), run(godet, &[1]), 1e-6, "side of the godet");
        }
        near(run(godet, &[1]), run(godet, &[2]), 1e-9, "sides of the godet");
        near(run(side_front, &[1]), run(side_back, &[1]), 1e-3, "side");
        near(run(front, &[4]), run(back, &[6]), 1e-6, "shoulder");
    }
}

#[test]
fn hoodie_fits_and_its_seams_match() {
    for m in &SIZES {
        let pieces = hoodie::pieces(m);
        let [front, back, sleeve, cuff, waistband, hood] = pieces.as_slice() else { panic!("six pieces") };
        near(run(front, &[1]), run(back, &[7]), 1e-6, "side");
        near(run(front, &[3]), run(back, &[5]), 1e-6, "shoulder");
        near(run(sleeve, &[2]), run(front, &[2]) + run(back, &[6]) + hoodie::CAP_EASE, 1e-3, "sleeve cap");
        near(run(sleeve, &[0]), hoodie::CUFF_STRETCH * run(cuff, &[2]), 1e-6, "cuff");
        near(run(front, &[0]) + run(back, &[0]), hoodie::HEM_STRETCH * run(waistband, &[2]), 1e-6, "hem");
        near(2.0 * run(hood, &[0]), run(front, &[4]) + run(back, &[4]), 1e-3, "hood");
    }
}

#[test]
fn jacket_fits_and_its_seams_match() {
    for m in &SIZES {
        let pieces = jacket::pieces(m);
        let [front, back, sleeve, stand, collar, lining, lining_back] = pieces.as_slice() else {
            panic!("seven pieces")
        };
        near(run(front, &[1]), run(back, &[7]), 1e-6, "side");
        near(run(front, &[3]), run(back, &[5]), 1e-6, "shoulder");
        near(run(sleeve, &[2]), run(front, &[2]) + run(back, &[6]) + jacket::CAP_EASE, 1e-3, "sleeve cap");
        near(run(stand, &[0]), 2.0 * run(front, &[4]) + run(back, &[4]), 0.1, "stand");
        near(run(stand, &[1]), run(collar, &[2]), 0.1, "collar");
        near(run(lining, &[1]), run(lining_back, &[7]), 1e-6, "side of the lining");
        near(run(lining, &[2]) + run(lining_back, &[6]), run(front, &[2]) + run(back, &[6]), 0.1, "armhole");
        near(run(lining, &[3]), run(lining_back, &[5]), 1e-6, "shoulder of the lining");
    }
}

#[test]
fn shirt_fits_and_its_seams_match() {
    for m in &SIZES {
        let pieces = shirt::pieces(m);
        let [front, back, sleeve, cuff, stand, collar] = pieces.as_slice() else { panic!("six pieces") };
        near(run(front, &[1]), run(back, &[7]), 1e-6, "side");
        near(run(front, &[3]), run(back, &[5]), 1e-6, "shoulder");
        near(run(sleeve, &[2]), run(front, &[2]) + run(back, &[6]) + shirt::CAP_EASE, 1e-3, "sleeve cap");
        near(run(sleeve, &[0]), shirt::CUFF_GATHER * run(cuff, &[2]), 1e-6, "cuff");
        let neckline = 2.0 * (run(front, &[4]) - shirt::EXTENSION) + run(back, &[4]);
        near(run(stand, &[0]), neckline, 0.1, "stand");
        near(run(stand, &[2]), run(collar, &[2]), 0.1, "collar");
    }
}

#[test]
fn trousers_fit_and_their_seams_match() {
    for m in &SIZES {
        let pieces = trousers::pieces(m);
        let [front, back, waistband] = pieces.as_slice() else { panic!("three pieces") };
        near(run(front, &[4]), run(back, &[7]), 1e-3, "inseam");
        near(run(front, &[1]), run(back, &[1]), 12.0, "side, which is eased");
        let waist = run(front, &[2]) - 2.0 * trousers::PLEAT + run(back, &[2, 5]);
        near(run(waistband, &[0]), 2.0 * waist, 1e-3, "waistband");
        near(run(waistband, &[0]), m.waist + trousers::WAIST_EASE, 1e-6, "waist");
        near(run(back, &[3]), run(back, &[4]), 1e-6, "legs of the dart");
    }
}
