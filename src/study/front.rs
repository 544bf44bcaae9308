//! The Pareto front: settings that nothing cheaper beats.

/// A setting's place in the chart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// CPU seconds.
    pub seconds: f64,
    /// Length error, mm.
    pub error: f64,
}

/// Errors nearer to each other than this are one, mm.
const SAME: f64 = 0.1;

/// Which of the places are on the front: none is both as cheap and as exact. `None` stands for no result.
#[must_use]
pub fn front(places: &[Option<Place>]) -> Vec<bool> {
    let step = |error: f64| (error / SAME).round();
    let beats = |a: &Place, b: &Place| {
        let (cheaper, error, other) = (a.seconds < b.seconds, step(a.error), step(b.error));
        a.seconds <= b.seconds && error <= other && (cheaper || error < other)
    };
    let on_front = |p: &Option<Place>| p.as_ref().is_some_and(|p| !places.iter().flatten().any(|q| beats(q, p)));
    places.iter().map(on_front).collect()
}

/// The cheapest place that is as exact as `wanted` (mm).
#[must_use]
pub fn recommend(places: &[Option<Place>], wanted: f64) -> Option<usize> {
    let good = known(places).filter(|(_, p)| p.error <= wanted);
    good.min_by(|a, b| a.1.seconds.total_cmp(&b.1.seconds)).map(|(i, _)| i)
}

/// The most exact place.
#[must_use]
pub fn nearest(places: &[Option<Place>]) -> Option<usize> {
    known(places).min_by(|a, b| a.1.error.total_cmp(&b.1.error)).map(|(i, _)| i)
}

fn known(places: &[Option<Place>]) -> impl Iterator<Item = (usize, Place)> + '_ {
    places.iter().enumerate().filter_map(|(i, p)| Some((i, (*p)?)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places() -> Vec<Option<Place>> {
        let at = |seconds, error| Some(Place { seconds, error });
        vec![at(1.0, 30.0), at(2.0, 12.0), at(3.0, 14.0), None, at(9.0, 4.0), at(2.0, 12.5), at(9.5, 3.99)]
    }

    #[test]
    fn what_is_beaten_is_not_on_the_front() {
        assert_eq!(front(&places()), [true, true, false, false, true, false, false]);
    }

    #[test]
    fn recommends_the_cheapest_that_is_good_enough() {
        assert_eq!(recommend(&places(), 15.0), Some(1));
        assert_eq!(recommend(&places(), 1.0), None, "none reaches it");
        assert_eq!((nearest(&places()), nearest(&[None])), (Some(6), None));
    }
}
