//! Named points of the body (ISO 8559-1 words), found on the figure's surface.

use super::figure::Figure;
use super::measures::BodyMeasures;
use std::collections::BTreeMap;
use toile_garment::Vec3;

/// Where a ray from outside meets the surface.
pub fn cast(figure: &Figure, from: Vec3, along: Vec3) -> Option<Vec3> {
    let mut t = 0.0;
    let mut last = 0.0;
    while t < 3.0 {
        let value = figure.at(from + along * t).value;
        if value <= 0.0 {
            return Some(from + along * bisect(|t| figure.at(from + along * t).value, last, t));
        }
        last = t;
        t += (0.4 * value).clamp(0.0003, 0.02);
    }
    None
}

fn bisect(f: impl Fn(f64) -> f64, mut outside: f64, mut inside: f64) -> f64 {
    for _ in 0..40 {
        let middle = 0.5 * (outside + inside);
        if f(middle) > 0.0 {
            outside = middle;
        } else {
            inside = middle;
        }
    }
    0.5 * (outside + inside)
}

fn hit(figure: &Figure, from: Vec3, along: Vec3) -> Vec3 {
    cast(figure, from, along).unwrap_or(from)
}

/// The left acromion: the top of the shoulder at half the shoulder width.
pub fn shoulder(figure: &Figure) -> Vec3 {
    let a = figure.acromion;
    hit(figure, Vec3::new(a.x, a.y + 0.15, a.z), -Vec3::y())
}

/// The left bust point: the foremost point of the bust; on a flat chest the middle of its half.
pub fn bust(figure: &Figure, m: &BodyMeasures) -> Vec3 {
    let front = |x: f64, y: f64| hit(figure, Vec3::new(x, y, 0.5), -Vec3::z());
    let mut best = front(0.085, m.bust_height);
    if m.flatness() == 1.0 {
        return best;
    }
    let mut step = 0.016;
    while step > 1e-4 {
        let around = [(step, 0.0), (-step, 0.0), (0.0, step), (0.0, -step)];
        let ahead = around.map(|(dx, dy)| front((best.x + dx).max(0.0), best.y + dy));
        match ahead.into_iter().filter(|p| p.z > best.z + 1e-9).max_by(|a, b| a.z.total_cmp(&b.z)) {
            Some(better) => best = better,
            None => step *= 0.5,
        }
    }
    best
}

/// The left underarm point: the highest point between arm and torso.
fn underarm(figure: &Figure, m: &BodyMeasures) -> Vec3 {
    let start = m.bust_height - 0.10;
    let side = hit(figure, Vec3::new(0.9, start, figure.acromion.z), -Vec3::x()).x;
    let arm_side = side.min(0.5);
    let torso =
        (0..200).map(|i| f64::from(i) * 0.002).find(|x| figure.at(Vec3::new(*x, start, figure.acromion.z)).value > 0.0);
    let from = torso.unwrap_or(0.1);
    let columns = (1..200).map(|i| from + f64::from(i) * 0.001).take_while(|x| *x < arm_side);
    columns
        .filter(|x| figure.at(Vec3::new(*x, start, figure.acromion.z)).value > 0.0)
        .map(|x| hit(figure, Vec3::new(x, start, figure.acromion.z), Vec3::y()))
        .fold(Vec3::new(from, start, figure.acromion.z), |best, p| if p.y > best.y { p } else { best })
}

/// All landmarks by name, metres; left and right ones mirrored.
pub fn landmarks(figure: &Figure, m: &BodyMeasures) -> BTreeMap<String, Vec3> {
    let front = |y: f64| hit(figure, Vec3::new(0.0, y, 0.6), -Vec3::z());
    let back = |y: f64| hit(figure, Vec3::new(0.0, y, -0.6), Vec3::z());
    let side = |y: f64, z: f64, from: f64| hit(figure, Vec3::new(from, y, z), -Vec3::x());
    let gap = |y: f64| m.bust_height.min(y);
    let neck_x = m.girths.neck / (2.0 * std::f64::consts::PI) + 0.008;
    let (arm, along) = figure.arm_axis();
    let out = Vec3::new(-along.y, along.x, 0.0);
    let on_arm = |t: f64| hit(figure, arm + along * t + out * 0.2, -out);
    let knee = 0.285 * m.stature;
    let mut found = BTreeMap::new();
    let single = [
        ("crown", hit(figure, Vec3::new(0.0, m.stature + 0.3, 0.018), -Vec3::y())),
        ("neck-front", front(m.neck_height - 0.062)),
        ("neck-back", back(m.neck_height)),
        ("waist-front", front(m.waist_height)),
        ("waist-back", back(m.waist_height)),
        ("hip-front", front(m.hip_height)),
        ("hip-back", back(m.hip_height)),
        ("crotch", hit(figure, Vec3::new(0.0, 0.5 * m.crotch_height, -0.015), Vec3::y())),
    ];
    found.extend(single.map(|(name, p)| (name.to_owned(), p)));
    let lefts = [
        ("neck-side", hit(figure, Vec3::new(neck_x, m.neck_height + 0.1, -0.02), -Vec3::y())),
        ("shoulder", shoulder(figure)),
        ("bust", bust(figure, m)),
        ("underarm", underarm(figure, m)),
        ("waist", side(gap(m.waist_height), 0.0, 0.26)),
        ("hip", side(m.hip_height, -0.015, 0.36)),
        ("elbow", on_arm(0.54 * figure.wrist_at)),
        ("wrist", on_arm(figure.wrist_at)),
        ("knee", hit(figure, figure.leg_centre(knee) + Vec3::new(0.0, 0.0, 0.4), -Vec3::z())),
        ("ankle", side(0.05 * m.stature, -0.026, 0.3)),
    ];
    for (name, p) in lefts {
        found.insert(format!("{name}-left"), p);
        found.insert(format!("{name}-right"), Vec3::new(-p.x, p.y, p.z));
    }
    found
}
