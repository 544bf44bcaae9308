//! Moving the inner vertices: towards the centroid of their triangles, then towards the largest least angle.

use toile_garment::Vec2;

/// Vertices whose triangles all have larger angles stay (40°).
const GOOD: f64 = 40.0 / 180.0 * std::f64::consts::PI;

/// Triangles around every vertex.
pub struct Fans {
    start: Vec<u32>,
    list: Vec<u32>,
}

impl Fans {
    /// Indexes triangles by vertex.
    pub fn new(vertices: usize, triangles: &[[u32; 3]]) -> Self {
        let mut start = vec![0_u32; vertices + 1];
        for v in triangles.iter().flatten() {
            start[*v as usize + 1] += 1;
        }
        for i in 0..vertices {
            start[i + 1] += start[i];
        }
        let mut next = start.clone();
        let mut list = vec![0; triangles.len() * 3];
        for (i, t) in triangles.iter().enumerate() {
            for v in t {
                list[next[*v as usize] as usize] = i as u32;
                next[*v as usize] += 1;
            }
        }
        Self { start, list }
    }

    /// Triangles at a vertex.
    pub fn at(&self, v: usize) -> &[u32] {
        &self.list[self.start[v] as usize..self.start[v + 1] as usize]
    }
}

/// Twice the signed area.
pub fn cross(a: Vec2, b: Vec2, c: Vec2) -> f64 {
    (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)
}

/// Cosine of the least angle, larger is worse; 2 for a triangle that is turned over.
fn worst_cosine(a: Vec2, b: Vec2, c: Vec2) -> f64 {
    if cross(a, b, c) <= 0.0 {
        return 2.0;
    }
    let (u, v, w) = (b - a, c - b, a - c);
    let (lu, lv, lw) = (u.norm_squared(), v.norm_squared(), w.norm_squared());
    // The least angle lies opposite the shortest side.
    let (shortest, p, q) = if lu <= lv && lu <= lw {
        (lu, lv, lw)
    } else if lv <= lw {
        (lv, lu, lw)
    } else {
        (lw, lu, lv)
    };
    (p + q - shortest) / (2.0 * (p * q).sqrt())
}

/// Least angle of a triangle, radians; negative when it is turned over.
pub fn least_angle(a: Vec2, b: Vec2, c: Vec2) -> f64 {
    let cosine = worst_cosine(a, b, c);
    if cosine > 1.5 { -1.0 } else { libm::acos(cosine.clamp(-1.0, 1.0)) }
}

/// One pass towards the area-weighted centroid of the surrounding triangles.
pub fn centroids(points: &mut [Vec2], triangles: &[[u32; 3]], fixed: usize) {
    let fans = Fans::new(points.len(), triangles);
    for v in fixed..points.len() {
        let (mut sum, mut weight) = (Vec2::zeros(), 0.0);
        for t in fans.at(v) {
            let [a, b, c] = triangles[*t as usize].map(|i| points[i as usize]);
            let area = cross(a, b, c);
            sum += (a + b + c) * (area / 3.0);
            weight += area;
        }
        if weight > 0.0 {
            let goal = sum / weight;
            let old = points[v];
            let worst = |points: &[Vec2]| fan_worst(points, triangles, &fans, v);
            let before = worst(points);
            for share in [1.0, 0.5, 0.25] {
                points[v] = old + (goal - old) * share;
                // Never turn a triangle over; a slightly worse angle is evened out by the later passes.
                if worst(points) < before.max(0.94) {
                    break;
                }
                points[v] = old;
            }
        }
    }
}

fn fan_worst(points: &[Vec2], triangles: &[[u32; 3]], fans: &Fans, v: usize) -> f64 {
    fans.at(v).iter().fold(-1.0, |worst: f64, t| {
        let [a, b, c] = triangles[*t as usize].map(|i| points[i as usize]);
        worst.max(worst_cosine(a, b, c))
    })
}

/// Eight directions, exactly on the axes and diagonals.
const COMPASS: [(f64, f64); 8] = [
    (1.0, 0.0),
    (std::f64::consts::FRAC_1_SQRT_2, std::f64::consts::FRAC_1_SQRT_2),
    (0.0, 1.0),
    (-std::f64::consts::FRAC_1_SQRT_2, std::f64::consts::FRAC_1_SQRT_2),
    (-1.0, 0.0),
    (-std::f64::consts::FRAC_1_SQRT_2, -std::f64::consts::FRAC_1_SQRT_2),
    (0.0, -1.0),
    (std::f64::consts::FRAC_1_SQRT_2, -std::f64::consts::FRAC_1_SQRT_2),
];

/// One pass that moves vertices with small angles about to where the least of them is largest.
pub fn widen_angles(points: &mut [Vec2], triangles: &[[u32; 3]], fixed: usize) {
    let fans = Fans::new(points.len(), triangles);
    let good = libm::cos(GOOD);
    for v in fixed..points.len() {
        let mut worst = fan_worst(points, triangles, &fans, v);
        if worst <= good {
            continue;
        }
        let mut step = 0.2 * shortest_edge(points, triangles, &fans, v);
        for _ in 0..12 {
            let old = points[v];
            let mut best = old;
            for (x, y) in COMPASS {
                points[v] = old + Vec2::new(x, y) * step;
                let here = fan_worst(points, triangles, &fans, v);
                if here < worst - 1e-9 {
                    worst = here;
                    best = points[v];
                }
            }
            points[v] = best;
            if best == old {
                step *= 0.5;
            }
        }
    }
}

fn shortest_edge(points: &[Vec2], triangles: &[[u32; 3]], fans: &Fans, v: usize) -> f64 {
    let edges = fans.at(v).iter().flat_map(|t| triangles[*t as usize]).filter(|w| *w as usize != v);
    edges.map(|w| (points[w as usize] - points[v]).norm()).fold(f64::INFINITY, f64::min)
}
