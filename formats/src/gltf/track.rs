//! One channel of an animation: values over time.

use gltf::animation::util::ReadOutputs;
use gltf::animation::{Channel, Interpolation, Property};
use nalgebra::{Quaternion, UnitQuaternion};

/// Values of one property of one node.
pub struct Track {
    node: usize,
    property: Property,
    way: Interpolation,
    times: Vec<f64>,
    values: Vec<Vec<f64>>,
}

fn wide<const N: usize>(v: [f32; N]) -> Vec<f64> {
    v.iter().copied().map(f64::from).collect()
}

impl Track {
    /// `None` where times or values are missing.
    pub fn read(channel: &Channel<'_>, bin: &[u8]) -> Option<Self> {
        let reader = channel.reader(|b| (b.index() == 0).then_some(bin));
        let times: Vec<f64> = reader.read_inputs()?.map(f64::from).collect();
        let way = channel.sampler().interpolation();
        let keys = times.len() * if way == Interpolation::CubicSpline { 3 } else { 1 };
        let values: Vec<Vec<f64>> = match reader.read_outputs()? {
            ReadOutputs::Translations(v) | ReadOutputs::Scales(v) => v.map(wide).collect(),
            ReadOutputs::Rotations(v) => v.into_f32().map(wide).collect(),
            ReadOutputs::MorphTargetWeights(v) => {
                let all: Vec<f64> = v.into_f32().map(f64::from).collect();
                let count = all.len().checked_div(keys).unwrap_or(0);
                if count == 0 {
                    return None;
                }
                all.chunks_exact(count).map(<[f64]>::to_vec).collect()
            }
        };
        let ordered = times.windows(2).all(|w| w[0] < w[1]) && times.iter().all(|t| t.is_finite());
        let (node, property) = (channel.target().node().index(), channel.target().property());
        (ordered && keys > 0 && values.len() == keys).then_some(Self { node, property, way, times, values })
    }

    pub fn is_weights(&self, node: usize) -> bool {
        self.node == node && self.property == Property::MorphTargetWeights
    }

    pub fn moves(&self, node: usize) -> bool {
        self.node == node && self.property != Property::MorphTargetWeights
    }

    /// Time of the last value, s.
    pub fn end(&self) -> f64 {
        self.times.last().copied().unwrap_or(0.0)
    }

    /// Puts the value at a time in its place of translation, rotation (x, y, z, w), scale.
    pub fn apply(&self, seconds: f64, t: &mut [f64; 3], r: &mut [f64; 4], s: &mut [f64; 3]) {
        let value = self.at(seconds);
        match self.property {
            Property::Translation => t.copy_from_slice(&value),
            Property::Rotation => r.copy_from_slice(&value),
            Property::Scale => s.copy_from_slice(&value),
            Property::MorphTargetWeights => {}
        }
    }

    /// The value at a time; the first and the last go on for ever.
    pub fn at(&self, seconds: f64) -> Vec<f64> {
        let last = self.times.len() - 1;
        let after = self.times.partition_point(|t| *t <= seconds);
        if after == 0 || after > last {
            return self.key(if after == 0 { 0 } else { last }).to_vec();
        }
        let (k, span) = (after - 1, self.times[after] - self.times[after - 1]);
        let u = (seconds - self.times[k]) / span;
        match self.way {
            Interpolation::Step => self.key(k).to_vec(),
            Interpolation::Linear if self.property == Property::Rotation => turn(self.key(k), self.key(after), u),
            Interpolation::Linear => self.key(k).iter().zip(self.key(after)).map(|(a, b)| a + (b - a) * u).collect(),
            Interpolation::CubicSpline => self.spline(k, u, span),
        }
    }

    fn key(&self, k: usize) -> &[f64] {
        if self.way == Interpolation::CubicSpline { &self.values[3 * k + 1] } else { &self.values[k] }
    }

    fn spline(&self, k: usize, u: f64, span: f64) -> Vec<f64> {
        let (u2, u3) = (u * u, u * u * u);
        let (out, into) = (&self.values[3 * k + 2], &self.values[3 * k + 3]);
        (0..out.len())
            .map(|i| {
                (2.0 * u3 - 3.0 * u2 + 1.0) * self.key(k)[i]
                    + span * (u3 - 2.0 * u2 + u) * out[i]
                    + (3.0 * u2 - 2.0 * u3) * self.key(k + 1)[i]
                    + span * (u3 - u2) * into[i]
            })
            .collect()
    }
}

/// The shorter way from one rotation to another.
fn turn(a: &[f64], b: &[f64], u: f64) -> Vec<f64> {
    let unit = |v: &[f64]| UnitQuaternion::from_quaternion(Quaternion::new(v[3], v[0], v[1], v[2]));
    let (from, to) = (unit(a), unit(b));
    let q = from.try_slerp(&to, u, 1e-9).unwrap_or(from);
    vec![q.i, q.j, q.k, q.w]
}
