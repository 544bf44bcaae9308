//! Shaking without chance: the same mesh every time.

/// A number in −1 … 1 from a counter.
pub fn noise(seed: u64) -> f64 {
    let mut z = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(0x1234_5678_9abc_def1);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// Moves every point by up to `reach` in each direction that `free` leaves it (1: all of it, 0: none).
pub fn shake(rest: &mut [[f64; 2]], reach: f64, free: impl Fn([f64; 2]) -> [f64; 2]) {
    for (i, p) in rest.iter_mut().enumerate() {
        let f = free(*p);
        for k in 0..2 {
            p[k] += reach * f[k] * noise(2 * i as u64 + k as u64);
        }
    }
}
