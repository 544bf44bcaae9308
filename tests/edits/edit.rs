//! Edits of a shape in space.

use super::dice::Dice;
use super::garments::Draped;
use super::support::glb;

/// The edits of a draped garment before it is laid flat.
pub struct Edit {
    pub kind: &'static str,
    /// The edit in words.
    pub words: String,
    /// Every change of the shape, one after another.
    pub changes: Vec<Change>,
    /// The body that the garment is moved to.
    pub size: Option<&'static str>,
    pub metric: &'static str,
    /// Smoothing, mm.
    pub smooth: f64,
}

/// A change of the shape; lengths in metres.
#[derive(Clone, Debug)]
pub enum Change {
    /// Every coordinate is multiplied.
    Scale([f64; 3]),
    /// Cloth below a height is wider, by a share that grows downwards to that at the other height.
    Flare { from: f64, to: f64, share: f64 },
    /// Cloth around a place is pushed away from the axis of the garment.
    Bump { at: [f64; 3], height: f64, radius: f64 },
    /// Every vertex is moved; vertices at one place alike.
    Noise { seed: u64, size: f64 },
}

impl Change {
    fn on(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        match self {
            Self::Scale([a, b, c]) => [a * x, b * y, c * z],
            Self::Flare { from, to, share } => {
                let wider = 1.0 + share * ((from - y) / (from - to)).clamp(0.0, 1.0);
                [wider * x, y, wider * z]
            }
            Self::Bump { at, height, radius } => {
                let off = [x - at[0], y - at[1], z - at[2]].map(|d| d * d).iter().sum::<f64>();
                let out = height * libm::exp(-off / (radius * radius)) / libm::hypot(at[0], at[2]).max(1e-3);
                [x + out * at[0], y, z + out * at[2]]
            }
            Self::Noise { seed, size } => {
                let place = [x, y, z].map(|c| (c * 1e6).round() as i64 as u64);
                let mixed = place.iter().fold(*seed, |k, c| (k ^ c).wrapping_mul(0x9e37_79b9_7f4a_7c15));
                let mut dice = Dice::new(mixed);
                [x, y, z].map(|c| c + size * dice.normal())
            }
        }
    }
}

impl Edit {
    pub fn of(kind: &'static str, changes: Vec<Change>) -> Self {
        let words = changes.iter().map(Change::words).collect::<Vec<_>>().join(", ");
        Self { kind, words: format!("{kind} {words}"), changes, size: None, metric: "auto", smooth: 0.0 }
    }

    /// The GLB after the edit.
    pub fn on(&self, glb: &[u8]) -> Vec<u8> {
        glb::moved(glb, |place| self.changes.iter().fold(place, |place, change| change.on(place)))
    }
}

impl Change {
    fn words(&self) -> String {
        let mm = |x: f64| format!("{:.1} mm", 1e3 * x);
        match self {
            Self::Scale(by) => format!("by {:.3}, {:.3}, {:.3}", by[0], by[1], by[2]),
            Self::Flare { from, to, share } => format!("{:.1} % from {} to {}", 1e2 * share, mm(*from), mm(*to)),
            Self::Bump { height, radius, .. } => format!("of {} over {}", mm(*height), mm(*radius)),
            Self::Noise { size, .. } => format!("of {}", mm(*size)),
        }
    }
}

/// Sizes of bodies that garments are moved to.
const SIZES: [&str; 5] = ["34", "36", "40", "42", "44"];

/// An edit: its kind goes round, all else is by chance.
pub fn random(dice: &mut Dice, number: usize, garment: &Draped) -> Edit {
    match number % 7 {
        0 => Edit::of("scale", vec![Change::Scale([0; 3].map(|_| dice.between(0.9, 1.12)))]),
        1 => Edit::of("flare", vec![flare(dice, garment)]),
        2 => Edit::of("bump", (0..1 + dice.below(3)).map(|_| bump(dice, garment)).collect()),
        3 => {
            let smooth = [0.0, 20.0][dice.below(2)];
            Edit { smooth, ..Edit::of("noise", vec![noise(dice)]) }
        }
        4 => {
            let size = SIZES[dice.below(SIZES.len())];
            Edit { size: Some(size), words: format!("body {size}"), ..Edit::of("body", Vec::new()) }
        }
        5 => Edit { metric: "surface", ..Edit::of("worn", vec![flare(dice, garment)]) },
        _ => {
            let changes = vec![flare(dice, garment), bump(dice, garment), noise(dice)];
            let (metric, smooth) = (["auto", "surface"][dice.below(2)], [0.0, 20.0][dice.below(2)]);
            Edit { metric, smooth, ..Edit::of("mixed", changes) }
        }
    }
}

fn flare(dice: &mut Dice, garment: &Draped) -> Change {
    let [low, high] = garment.heights();
    let [from, to] = [dice.between(low, high), [low, high][dice.below(2)]];
    Change::Flare { from, to, share: dice.between(-0.12, 0.3) }
}

fn bump(dice: &mut Dice, garment: &Draped) -> Change {
    let at = garment.place(dice);
    Change::Bump { at, height: dice.between(-0.03, 0.03), radius: dice.between(0.03, 0.15) }
}

fn noise(dice: &mut Dice) -> Change {
    Change::Noise { seed: dice.below(1 << 30) as u64, size: dice.between(1e-4, 1e-3) }
}
