//! The test that every pair of legs must pass, drawn in the outline or inside the piece.

use super::thresholds::{ANGLE_OF_DART, LENGTH_OF_LEG, RATIO_OF_LEGS, WIDTH_OF_MOUTH};
use crate::dxf::geom;
use toile_garment::Vec2;

/// Tells that two legs from an apex, with their mouth points `a` and `b`, can make a dart, or why they cannot. Evidence
/// decides later.
///
/// # Errors
/// The test that failed.
pub fn wedge_test(apex: Vec2, a: Vec2, b: Vec2) -> Result<(), &'static str> {
    let (u, v) = (a - apex, b - apex);
    let (short, long) = (u.norm().min(v.norm()), u.norm().max(v.norm()));
    let angle = geom::angle(u, v);
    if !LENGTH_OF_LEG.contains(&short) || !LENGTH_OF_LEG.contains(&long) {
        return Err("its legs are not 25 to 400 mm long");
    }
    if short < RATIO_OF_LEGS * long {
        return Err("its legs are too unequal");
    }
    if angle > ANGLE_OF_DART {
        return Err("its angle is above 60 degrees");
    }
    if (a - b).norm() < *WIDTH_OF_MOUTH.start() {
        return Err("its mouth is narrower than 2 mm: a slit");
    }
    if (a - b).norm() > *WIDTH_OF_MOUTH.end() {
        return Err("its mouth is wider than 150 mm");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reasons_name_the_limits_that_hold() {
        let test = |a: (f64, f64), b: (f64, f64)| wedge_test(Vec2::zeros(), Vec2::new(a.0, a.1), Vec2::new(b.0, b.1));
        assert_eq!(test((-15.0, 100.0), (15.0, 100.0)), Ok(()));
        assert_eq!(test((-1.5, 190.0), (1.5, 190.0)), Ok(()), "a needle");
        let reasons = [
            (test((-2.0, 20.0), (2.0, 20.0)), vec![*LENGTH_OF_LEG.start(), *LENGTH_OF_LEG.end()]),
            (test((-0.9, 100.0), (0.9, 100.0)), vec![*WIDTH_OF_MOUTH.start()]),
            (test((-70.0, 100.0), (70.0, 100.0)), vec![ANGLE_OF_DART]),
            (test((-80.0, 200.0), (80.0, 200.0)), vec![*WIDTH_OF_MOUTH.end()]),
        ];
        for (reason, limits) in reasons {
            let why = reason.expect_err("no dart");
            assert!(limits.iter().all(|l| why.contains(&l.to_string())), "{why}: {limits:?}");
        }
    }
}
