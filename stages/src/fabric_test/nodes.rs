//! The nodes (folds) of a drape: where its outline stands out.

/// A fold of the outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Ray on which it stands out most.
    pub ray: usize,
    /// Radius there, m.
    pub peak: f64,
    /// Least radius between it and the next node, m.
    pub valley: f64,
}

/// Nodes of a closed outline: maxima that stand at least `least` (m) over the valleys on both sides.
pub fn nodes(outline: &[f64], least: f64) -> Vec<Node> {
    let n = outline.len();
    let Some(lowest) = (0..n).min_by(|a, b| outline[*a].total_cmp(&outline[*b])) else { return Vec::new() };
    let mut found: Vec<Node> = Vec::new();
    let (mut rising, mut top, mut bottom) = (true, lowest, lowest);
    // Once around from the lowest point and back to it.
    for ray in (1..=n).map(|k| (lowest + k) % n) {
        if outline[ray] > outline[top] {
            top = ray;
        }
        if outline[ray] < outline[bottom] {
            bottom = ray;
        }
        if rising && outline[ray] < outline[top] - least {
            found.push(Node { ray: top, peak: outline[top], valley: outline[ray] });
            (rising, bottom) = (false, ray);
        } else if !rising && outline[ray] > outline[bottom] + least {
            (rising, top) = (true, ray);
        }
        if let (false, Some(last)) = (rising, found.last_mut()) {
            last.valley = outline[bottom];
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn outline(of: impl Fn(f64) -> f64) -> Vec<f64> {
        (0..720).map(|k| of(TAU * f64::from(k) / 720.0)).collect()
    }

    #[test]
    fn waves_are_counted_and_measured() {
        let found = nodes(&outline(|a| 0.12 + 0.01 * libm::cos(5.0 * a + 0.3)), 0.003);
        assert_eq!(found.len(), 5);
        assert!(found.iter().all(|n| (n.peak - 0.13).abs() < 1e-5 && (n.valley - 0.11).abs() < 1e-5), "{found:?}");
    }

    #[test]
    fn ripples_are_no_nodes() {
        let rippled = outline(|a| 0.12 + 0.01 * libm::cos(3.0 * a) + 0.001 * libm::cos(40.0 * a));
        assert_eq!(nodes(&rippled, 0.003).len(), 3);
        assert!(nodes(&outline(|_| 0.15), 0.003).is_empty());
        assert!(nodes(&[], 0.003).is_empty());
    }
}
