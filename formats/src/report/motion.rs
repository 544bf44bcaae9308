//! The motion of a garment for the view: every frame, or as many as the page has room for.

use super::viewer::Motion;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::Value;
use toile_garment::{Garment, Vec3};

/// Numbers of a motion that a page has room for; each takes 16 bits.
const MOST_NUMBERS: usize = 1_500_000;

/// Steps along the longest side of the box around the motion.
const STEPS: f64 = 65_535.0;

/// The frames that are shown, evenly chosen. Empty without a motion, or where frames do not fit the meshes.
#[must_use]
pub fn times(garment: &Garment) -> Vec<usize> {
    let frames = garment.animation.as_ref().map_or(&[][..], |a| &a.frames);
    let sizes: Vec<usize> = garment.pieces.iter().map(|p| p.mesh.as_ref().map_or(0, |m| m.rest.len())).collect();
    let fits =
        |frame: &Vec<Vec<Vec3>>| frame.len() == sizes.len() && frame.iter().zip(&sizes).all(|(f, n)| f.len() == *n);
    let sound = |frame: &Vec<Vec<Vec3>>| frame.iter().flatten().flat_map(|p| p.iter()).all(|x| x.is_finite());
    if !frames.iter().all(|f| fits(f) && sound(f)) {
        return Vec::new();
    }
    let numbers = 3 * sizes.iter().sum::<usize>().max(1);
    let stride = (frames.len() * numbers).div_ceil(MOST_NUMBERS).max(1);
    (0..frames.len()).step_by(stride).collect()
}

/// The motion as the view reads it. `None` where nothing moves.
#[must_use]
pub fn motion(garment: &Garment) -> Option<Motion> {
    let times = times(garment);
    let animation = garment.animation.as_ref().filter(|_| times.len() > 1)?;
    let points = || times.iter().filter_map(|t| animation.frames.get(*t)).flatten().flatten();
    let far = Vec3::repeat(f64::INFINITY);
    let (low, high) = points().fold((far, -far), |(low, high), p| (low.inf(p), high.sup(p)));
    let step = ((high - low).max() / STEPS).max(1e-9);
    let number = |x: f64| (x.round() as u16).to_le_bytes();
    let piece = |k: usize| {
        let vertices = times.iter().filter_map(|t| animation.frames.get(*t)?.get(k)).flatten();
        let bytes: Vec<u8> =
            vertices.flat_map(|p| [p.x - low.x, p.y - low.y, p.z - low.z]).flat_map(|x| number(x / step)).collect();
        STANDARD.encode(bytes)
    };
    Some(Motion {
        fps: animation.fps / times.get(1).copied().unwrap_or(1).max(1) as f64,
        count: times.len(),
        low: low.into(),
        step,
        pieces: (0..garment.pieces.len()).map(piece).collect(),
        body_stands: !body_moves(garment),
    })
}

/// Was the body given frames of its own? The view has none of them.
fn body_moves(garment: &Garment) -> bool {
    let moves = |params: &Value| params.get("body").is_some_and(|body| !body.is_null());
    garment.provenance.stages.iter().any(|s| s.stage == "animate" && moves(&s.params))
}

#[cfg(test)]
mod tests {
    use super::*;
    use toile_garment::animation::Animation;
    use toile_garment::mesh::PieceMesh;
    use toile_garment::{Piece, Vec2};

    fn garment(frames: usize, vertices: usize) -> Garment {
        let mesh = PieceMesh { rest: vec![Vec2::zeros(); vertices], ..PieceMesh::default() };
        let frame = |k: usize| vec![(0..vertices).map(|v| Vec3::new(v as f64, k as f64, 0.5)).collect()];
        let animation = Animation { fps: 30.0, frames: (0..frames).map(frame).collect(), ..Animation::default() };
        let piece = Piece { mesh: Some(mesh), ..Piece::default() };
        Garment { pieces: vec![piece], animation: Some(animation), ..Garment::default() }
    }

    #[test]
    fn places_come_back_within_half_a_step() {
        let shown = motion(&garment(3, 4)).expect("a motion");
        let bytes = STANDARD.decode(&shown.pieces[0]).expect("base64");
        let numbers: Vec<f64> = bytes.chunks_exact(2).map(|b| f64::from(u16::from_le_bytes([b[0], b[1]]))).collect();
        assert_eq!((shown.count, shown.fps, numbers.len()), (3, 30.0, 36));
        // The second vertex in the third frame.
        let back: Vec<f64> = (0..3).map(|k| shown.low[k] + shown.step * numbers[2 * 12 + 3 + k]).collect();
        assert!(back.iter().zip([1.0, 2.0, 0.5]).all(|(x, want)| (x - want).abs() <= 0.5 * shown.step), "{back:?}");
    }

    #[test]
    fn a_long_motion_shows_fewer_frames_and_a_damaged_one_none() {
        let long = garment(60, 20_000);
        let times = times(&long);
        assert!(times.len() * 60_000 <= MOST_NUMBERS && times.len() == 20, "{}", times.len());
        assert!((motion(&long).expect("a motion").fps - 10.0).abs() < 1e-12);
        let mut damaged = garment(3, 4);
        damaged.animation.iter_mut().for_each(|a| a.frames[1][0].truncate(2));
        assert!(motion(&damaged).is_none() && motion(&Garment::default()).is_none());
    }
}
