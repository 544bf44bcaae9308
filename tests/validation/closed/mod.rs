//! Closed forms and boundary value problems of one variable: none of it shares code with the program.

pub mod buckling;
pub mod catenary;
pub mod cone;
pub mod contact;
pub mod damped;
pub mod elastica;
pub mod fall;
pub mod hanging;
pub mod leapfrog;
pub mod penalty;
pub mod ring;
pub mod sector;
pub mod slip;
pub mod swing;

/// m/s².
pub const G: f64 = 9.81;

/// A root of a function that changes sign between the bounds.
pub fn root(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let rising = f(high) > f(low);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if (f(middle) > 0.0) == rising { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}

/// One Runge–Kutta step of fourth order.
pub fn rk4<const N: usize>(y: [f64; N], t: f64, h: f64, f: &impl Fn(f64, [f64; N]) -> [f64; N]) -> [f64; N] {
    let add = |y: [f64; N], d: [f64; N], s: f64| std::array::from_fn(|i| y[i] + s * d[i]);
    let a = f(t, y);
    let b = f(t + 0.5 * h, add(y, a, 0.5 * h));
    let c = f(t + 0.5 * h, add(y, b, 0.5 * h));
    let d = f(t + h, add(y, c, h));
    std::array::from_fn(|i| y[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]))
}
