//! Tension against strain in one direction of the cloth: the measured, non-linear curve whose slope is the
//! stiffness of a spring (paper §1.2.1).

/// Tension per width (N/m) as a function of strain. Compression follows the slope at rest.
#[derive(Clone, Debug, PartialEq)]
pub enum Curve {
    /// `T = stiffness · ε`.
    Linear {
        /// N/m.
        stiffness: f64,
    },
    /// `T = k0/beta · (exp(beta ε) − 1)`.
    Exponential {
        /// Slope at rest, N/m.
        k0: f64,
        /// Growth, dimensionless, > 0.
        beta: f64,
    },
    /// Measured (strain, tension N/m) pairs, ascending from (0, 0); linear between, the last slope beyond.
    Samples(Vec<[f64; 2]>),
}

impl Curve {
    /// Tension, N/m.
    #[must_use]
    pub fn tension(&self, strain: f64) -> f64 {
        match self {
            Self::Linear { stiffness } => stiffness * strain,
            Self::Exponential { k0, .. } if strain <= 0.0 => k0 * strain,
            Self::Exponential { k0, beta } => k0 / beta * libm::expm1(beta * strain),
            Self::Samples(points) => {
                let (a, slope) = segment(points, strain);
                a[1] + slope * (strain - a[0])
            }
        }
    }

    /// Slope dT/dε, N/m.
    #[must_use]
    pub fn tangent(&self, strain: f64) -> f64 {
        match self {
            Self::Linear { stiffness } => *stiffness,
            Self::Exponential { k0, beta } => k0 * libm::exp(beta * strain.max(0.0)),
            Self::Samples(points) => segment(points, strain).1,
        }
    }

    /// The curve of so many times the tension.
    #[must_use]
    pub fn times(&self, share: f64) -> Self {
        match self {
            Self::Linear { stiffness } => Self::Linear { stiffness: stiffness * share },
            Self::Exponential { k0, beta } => Self::Exponential { k0: k0 * share, beta: *beta },
            Self::Samples(points) => Self::Samples(points.iter().map(|p| [p[0], p[1] * share]).collect()),
        }
    }

    /// The force that measured samples carry over a straight line of their smallest slope; `None` where there are none.
    pub(crate) fn above_least_slope(&self) -> Option<Vec<[f64; 2]>> {
        let Self::Samples(points) = self else { return None };
        let slope = points.windows(2).map(|w| (w[1][1] - w[0][1]) / (w[1][0] - w[0][0])).fold(f64::INFINITY, f64::min);
        Some(points.iter().map(|p| [p[0], p[1] - slope * p[0]]).collect())
    }

    /// Energy per rest area, J/m²: the integral of the tension from rest.
    #[must_use]
    pub fn energy(&self, strain: f64) -> f64 {
        match self {
            Self::Linear { stiffness } => 0.5 * stiffness * strain * strain,
            Self::Exponential { k0, .. } if strain <= 0.0 => 0.5 * k0 * strain * strain,
            Self::Exponential { k0, beta } => k0 / beta * (libm::expm1(beta * strain) / beta - strain),
            Self::Samples(points) => samples_energy(points, strain),
        }
    }

    /// Returns `true` for a law that a solver can use: finite, of positive slope, with samples ascending from the
    /// origin.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        let positive = |v: f64| v.is_finite() && v > 0.0;
        match self {
            Self::Linear { stiffness } => positive(*stiffness),
            Self::Exponential { k0, beta } => positive(*k0) && positive(*beta),
            Self::Samples(p) => {
                p.len() >= 2
                    && p[0] == [0.0, 0.0]
                    && p.windows(2).all(|w| positive(w[1][0] - w[0][0]) && positive(w[1][1] - w[0][1]))
            }
        }
    }
}

/// The sample a strain lies after, and the slope there.
fn segment(points: &[[f64; 2]], strain: f64) -> ([f64; 2], f64) {
    let last = points.len().saturating_sub(2);
    let i = points.iter().skip(1).position(|p| strain <= p[0]).unwrap_or(last).min(last);
    match (points.get(i), points.get(i + 1)) {
        (Some(a), Some(b)) if strain > 0.0 => (*a, (b[1] - a[1]) / (b[0] - a[0])),
        (Some(a), Some(b)) => ([0.0, 0.0], (b[1] - a[1]) / (b[0] - a[0])),
        _ => ([0.0, 0.0], 0.0),
    }
}

fn samples_energy(points: &[[f64; 2]], strain: f64) -> f64 {
    let (start, slope) = segment(points, strain);
    let mut sum = 0.0;
    for w in points.windows(2) {
        if w[1][0] <= start[0] {
            sum += 0.5 * (w[0][1] + w[1][1]) * (w[1][0] - w[0][0]);
        }
    }
    let d = strain - start[0];
    sum + start[1] * d + 0.5 * slope * d * d
}
