//! Even triangles: splits, collapses, flips and tangential smoothing on the field's surface
//! (Botsch and Kobbelt, "A remeshing approach to multiresolution modeling", 2004).

use super::field::Sample;
use super::net::Net;
use toile_garment::Vec3;

/// Longest step of a projection, metres.
const STEP: f64 = 0.008;

/// Moves a point onto the surface; a point of the midline stays in its plane.
pub fn project(mut p: Vec3, midline: bool, field: &impl Fn(Vec3) -> Sample) -> Vec3 {
    for _ in 0..6 {
        let sample = field(p);
        let mut slope = sample.slope;
        if midline {
            slope.x = 0.0;
        }
        let steep = slope.norm_squared();
        if steep < 1e-6 || sample.value.abs() < 1e-8 {
            break;
        }
        let step = slope * (-sample.value / steep);
        p += step * (STEP / step.norm().max(STEP));
        if !midline {
            p.x = p.x.max(1e-4);
        }
    }
    p
}

/// Puts all vertices onto the surface without changing the triangles.
pub fn settle(net: &mut Net, field: &impl Fn(Vec3) -> Sample) {
    for v in 0..net.positions.len() {
        net.positions[v] = project(net.positions[v], net.midline[v], field);
    }
}

/// Makes edges about as long as `target` says at their middle.
pub fn remesh(net: &mut Net, rounds: usize, field: &impl Fn(Vec3) -> Sample, target: &impl Fn(Vec3) -> f64) {
    for _ in 0..rounds {
        split_long(net, field, target);
        collapse_short(net, field, target);
        flip_all(net);
        for _ in 0..3 {
            relax(net, field);
        }
    }
    for _ in 0..4 {
        flip_all(net);
        relax(net, field);
    }
}

fn middle(net: &Net, a: u32, b: u32) -> Vec3 {
    (net.place(a) + net.place(b)) * 0.5
}

fn split_long(net: &mut Net, field: &impl Fn(Vec3) -> Sample, target: &impl Fn(Vec3) -> f64) {
    for (a, b) in net.edges() {
        let at = middle(net, a, b);
        if net.length(a, b) > 4.0 / 3.0 * target(at) {
            let on_midline = net.opposite(a, b).len() == 1;
            net.split(a, b, project(at, on_midline, field));
        }
    }
}

fn collapse_short(net: &mut Net, field: &impl Fn(Vec3) -> Sample, target: &impl Fn(Vec3) -> f64) {
    for (a, b) in net.edges() {
        if !net.used(a) || !net.used(b) || net.opposite(a, b).is_empty() {
            continue;
        }
        let wanted = target(middle(net, a, b));
        if net.length(a, b) >= 0.8 * wanted {
            continue;
        }
        let (kept, gone) = if net.midline[b as usize] { (b, a) } else { (a, b) };
        let both = net.midline[a as usize] == net.midline[b as usize];
        let at = if both { project(middle(net, a, b), net.midline[a as usize], field) } else { net.place(kept) };
        net.collapse(kept, gone, at, 4.0 / 3.0 * wanted);
    }
}

fn flip_all(net: &mut Net) {
    for (a, b) in net.edges() {
        net.flip(a, b);
    }
}

/// Moves each vertex within the surface towards the middle of its neighbours.
pub fn relax(net: &mut Net, field: &impl Fn(Vec3) -> Sample) {
    let mut moved = net.positions.clone();
    for v in (0_u32..).take(net.positions.len()).filter(|v| net.used(*v)) {
        let here = net.place(v);
        let midline = net.midline[v as usize];
        let (mut sum, mut weights) = (Vec3::zeros(), 0.0);
        for n in net.neighbours(v) {
            // Off the midline a neighbour stands for itself and its mirror image.
            let weight = if midline && !net.midline[n as usize] { 2.0 } else { 1.0 };
            sum += net.place(n) * weight;
            weights += weight;
        }
        let mut step = sum / weights - here;
        let slope = field(here).slope;
        step -= slope * (step.dot(&slope) / slope.norm_squared().max(1e-9));
        if midline {
            step.x = 0.0;
        }
        moved[v as usize] = project(here + step * 0.7, midline, field);
    }
    net.positions = moved;
}
