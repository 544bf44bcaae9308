//! Wide skirts start on a cone.
//!
//! A circle skirt whose halves are placed as flat sheets, one in front and one behind, crumples while it is sewn. The panels
//! of a ring of cloth that stands around the forearms are laid on a common upright cone instead: a rigid turn and an
//! isometric bend, by the angles of their side seams. A full circle lies level around the waist then, as it was cut.

use toile_garment::body::BodySegment;
use toile_garment::seam::{Seam, Stitch};
use toile_garment::{Diagnostic, Garment, MeshVertex, Vec2, Vec3};

/// Least angle between the side seams of a panel that is laid on a cone, rad. Below it they count as parallel.
const SECTOR_LEAST: f64 = 0.05;
/// Least slope of the middle of a panel, rad. A level circle rose over the elbows of a body while it was sewn.
const SLOPE_LEAST: f64 = 0.25;
/// Distance from the torso at which the upper edges start, m.
const CLEARANCE: f64 = 0.02;

/// A panel as a sector of a ring.
#[derive(Clone, Debug)]
struct Sector {
    piece: usize,
    /// Where its side seams would meet, in piece coordinates, m.
    apex: Vec2,
    /// Direction of its middle, from the apex.
    middle: Vec2,
    /// Angle between its side seams, rad.
    angle: f64,
    /// Distance of the nearest end of a side seam from the apex, m.
    inner: f64,
    /// Azimuth of its middle as it is placed, from the front to the left, rad.
    azimuth: f64,
}

/// Lays the wide panels among these pieces on a cone. Returns their names; empty where they form no ring of sectors.
pub fn lay_on_cone(garment: &Garment, placed: &mut [Vec<Vec3>], pieces: &[usize]) -> Vec<String> {
    let Some(torso) = garment.body.as_ref().and_then(|b| b.segments.get("torso")) else { return Vec::new() };
    let wide: Vec<usize> = pieces.iter().copied().filter(|i| is_wide(&placed[*i], torso)).collect();
    let Some(ring) = ring_of_sectors(garment, placed, &wide, torso) else { return Vec::new() };
    let total: f64 = ring.iter().map(|s| s.angle).sum();
    let half_angle_sine = total / std::f64::consts::TAU;
    if half_angle_sine > 1.0 {
        return Vec::new();
    }
    let top = ring.iter().flat_map(|s| &placed[s.piece]).map(|p| p.y).fold(f64::NEG_INFINITY, f64::max);
    let mut from = middle_azimuth(&ring, total);
    for sector in &ring {
        let share = sector.angle / half_angle_sine;
        lay(garment, sector, from + 0.5 * share, half_angle_sine, top, torso, &mut placed[sector.piece]);
        from += share;
    }
    ring.iter().map(|s| garment.pieces[s.piece].name.clone()).collect()
}

/// Tells which pieces were laid on a cone.
#[must_use]
pub fn finding(names: &[String]) -> Option<Diagnostic> {
    let pieces: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    (!names.is_empty()).then(|| {
        let message =
            format!("{} start on a cone around the torso: so wide a ring crumples from flat sheets", pieces.join(", "));
        Diagnostic::info(super::codes::START_ON_CONE, message)
            .hint("place them around the torso in the sewing file to start them elsewhere")
    })
}

/// Returns `true` if a placed piece reaches farther from the torso's axis than the torso is wide.
fn is_wide(x: &[Vec3], torso: &BodySegment) -> bool {
    let away = |p: &Vec3| libm::hypot(p.x - torso.from.x, p.z - torso.from.z);
    x.iter().map(away).fold(0.0, f64::max) > 2.0 * torso.half_width
}

/// The pieces as sectors in their order around the torso, if each is sewn to exactly two others, or two are sewn twice.
fn ring_of_sectors(
    garment: &Garment,
    placed: &[Vec<Vec3>],
    pieces: &[usize],
    torso: &BodySegment,
) -> Option<Vec<Sector>> {
    let sectors = pieces.iter().map(|i| sector(garment, placed, *i, pieces, torso));
    let mut sectors = sectors.collect::<Option<Vec<_>>>().filter(|s| s.len() > 1)?;
    sectors.sort_by(|a, b| a.azimuth.total_cmp(&b.azimuth));
    Some(sectors)
}

/// The side seams of a piece, by which it is sewn to other pieces of a ring: their ends in piece coordinates, m, the end
/// nearer to the torso's axis or higher first.
fn side_seams(
    garment: &Garment,
    placed: &[Vec<Vec3>],
    piece: usize,
    ring: &[usize],
    torso: &BodySegment,
) -> Option<Vec<[Vec2; 2]>> {
    let mesh = garment.pieces[piece].mesh.as_ref()?;
    let outwards_and_down = |v: &&u32| {
        let p = placed[piece][**v as usize];
        libm::hypot(p.x - torso.from.x, p.z - torso.from.z) - p.y
    };
    let is_own = |v: MeshVertex| v.piece.index() == piece;
    let is_other = |v: MeshVertex| !is_own(v) && ring.contains(&v.piece.index());
    let own_vertex = |s: &Stitch| match (is_own(s.a) && is_other(s.b), is_own(s.b) && is_other(s.a)) {
        (true, _) => Some(s.a.vertex),
        (_, true) => Some(s.b.vertex),
        _ => None,
    };
    let ends = |seam: &Seam| {
        let on: Vec<u32> = seam.stitches.iter().filter_map(own_vertex).collect();
        let upper = on.iter().min_by(|a, b| outwards_and_down(a).total_cmp(&outwards_and_down(b)))?;
        let lower = on.iter().max_by(|a, b| outwards_and_down(a).total_cmp(&outwards_and_down(b)))?;
        (on.len() > 1).then(|| [mesh.rest[*upper as usize], mesh.rest[*lower as usize]])
    };
    Some(garment.seams.iter().filter_map(ends).collect())
}

/// A piece as a sector between its two side seams.
fn sector(
    garment: &Garment,
    placed: &[Vec<Vec3>],
    piece: usize,
    ring: &[usize],
    torso: &BodySegment,
) -> Option<Sector> {
    let mesh = garment.pieces[piece].mesh.as_ref()?;
    let sides = side_seams(garment, placed, piece, ring, torso)?;
    let [[a, b], [c, d]] = sides[..] else { return None };
    let (u, v) = ((b - a).try_normalize(1e-9)?, (d - c).try_normalize(1e-9)?);
    let mut angle = libm::atan2(u.perp(&v).abs(), u.dot(&v));
    if angle < SECTOR_LEAST {
        return None;
    }
    let level = std::f64::consts::PI - angle < SECTOR_LEAST;
    let apex = if level { (a + c) * 0.5 } else { a + u * ((c - a).perp(&v) / u.perp(&v)) };
    let centre = mesh.rest.iter().sum::<Vec2>() / mesh.rest.len() as f64;
    let mut middle = if level { Vec2::new(v.y - u.y, u.x - v.x).normalize() } else { (u + v).normalize() };
    if middle.dot(&(centre - apex)) < 0.0 {
        middle = -middle;
        angle = if level { angle } else { std::f64::consts::TAU - angle };
    }
    let inner = (a - apex).norm().min((c - apex).norm());
    // The panel widens downwards: its ends lie beyond the apex in the direction of the seams.
    let widens = (a - apex).dot(&u) > 0.0 && (c - apex).dot(&v) > 0.0;
    let at = placed[piece].iter().sum::<Vec3>() / placed[piece].len() as f64;
    let azimuth = libm::atan2(at.x - torso.from.x, at.z - torso.from.z);
    widens.then_some(Sector { piece, apex, middle, angle, inner, azimuth })
}

/// Azimuth at which the first sector of a ring begins, so that the sectors keep their azimuths as well as they can, rad.
fn middle_azimuth(ring: &[Sector], total: f64) -> f64 {
    let mut from = 0.0;
    let (mut sin, mut cos) = (0.0, 0.0);
    for s in ring {
        let share = s.angle * std::f64::consts::TAU / total;
        let (y, x) = libm::sincos(s.azimuth - (from + 0.5 * share));
        (sin, cos) = (sin + y, cos + x);
        from += share;
    }
    libm::atan2(sin, cos)
}

/// Puts a sector on the cone, moved outwards until the middle of its upper edge clears the torso.
fn lay(
    garment: &Garment,
    s: &Sector,
    azimuth: f64,
    half_angle_sine: f64,
    top: f64,
    torso: &BodySegment,
    x: &mut [Vec3],
) {
    let Some(mesh) = &garment.pieces[s.piece].mesh else { return };
    let half_angle_cosine = (1.0 - half_angle_sine * half_angle_sine).max(0.0).sqrt();
    let out = (torso.half_width + CLEARANCE - s.inner * half_angle_sine).max(0.0);
    let ahead = |angle: f64| {
        let (sin, cos) = libm::sincos(angle);
        Vec3::new(sin, 0.0, cos)
    };
    // A level ring might rise as well as fall.
    let (tilt_sin, tilt_cos) = libm::sincos((SLOPE_LEAST - libm::asin(half_angle_cosine)).max(0.0));
    let origin = Vec3::new(torso.from.x, top + s.inner * half_angle_cosine, torso.from.z) + ahead(azimuth) * out;
    for (p, rest) in x.iter_mut().zip(&mesh.rest) {
        let d = rest - s.apex;
        // Seen from the right side of the cloth x runs to the wearer's left, and so does the azimuth.
        let turn = libm::atan2(s.middle.perp(&d), s.middle.dot(&d));
        let radius = d.norm();
        let on_cone = ahead(azimuth + turn / half_angle_sine) * (radius * half_angle_sine)
            - Vec3::y() * (radius * half_angle_cosine);
        let (out, up) = (on_cone.dot(&ahead(azimuth)), on_cone.y);
        let tilted =
            ahead(azimuth) * (out * tilt_cos + up * tilt_sin - out) + Vec3::y() * (up * tilt_cos - out * tilt_sin - up);
        *p = origin + on_cone + tilted;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use toile_garment::body::Body;
    use toile_garment::mesh::PieceMesh;
    use toile_garment::seam::{SeamKind, SeamSide};
    use toile_garment::{Piece, PieceId, SeamId};

    /// Angles of a half ring of 12 columns, and radii of its rows, m.
    const COLUMNS: u32 = 12;
    const RADII: [f64; 3] = [0.13, 0.4, 0.8];

    /// Two halves of a circle skirt, flat in front and behind, of this sector each.
    fn halves(sector: f64) -> (Garment, Vec<Vec<Vec3>>) {
        let angle = |i: u32| sector * (f64::from(i) / f64::from(COLUMNS) - 0.5);
        let rest: Vec<Vec2> = RADII
            .iter()
            .flat_map(|r| (0..=COLUMNS).map(move |i| Vec2::new(r * libm::sin(angle(i)), -r * libm::cos(angle(i)))))
            .collect();
        let cell = |i: u32, j: u32| {
            let a = j * (COLUMNS + 1) + i;
            [[a, a + COLUMNS + 1, a + 1], [a + 1, a + COLUMNS + 1, a + COLUMNS + 2]]
        };
        let triangles: Vec<_> = (0..2).flat_map(|j| (0..COLUMNS).flat_map(move |i| cell(i, j))).collect();
        let piece = |id: usize| Piece {
            id: PieceId::from(id),
            name: ["back", "front"][id].into(),
            mesh: Some(PieceMesh { rest: rest.clone(), triangles: triangles.clone(), ..PieceMesh::default() }),
            ..Piece::default()
        };
        let vertex = |p: usize, row: u32, column: u32| MeshVertex {
            piece: PieceId::from(p),
            vertex: row * (COLUMNS + 1) + column,
        };
        let seam = |left: bool| Seam {
            stitches: (0..3)
                .map(|row| {
                    let [a, b] = if left { [COLUMNS, 0] } else { [0, COLUMNS] };
                    Stitch { a: vertex(1, row, a), b: vertex(0, row, b) }
                })
                .collect(),
            id: SeamId::from(usize::from(left)),
            name: String::new(),
            kind: SeamKind::Seam,
            a: SeamSide { runs: Vec::new(), length: 0.0 },
            b: SeamSide { runs: Vec::new(), length: 0.0 },
            ease: 0.0,
            gather: None,
            source: None,
        };
        let torso = BodySegment {
            from: Vec3::new(0.0, 1.4, 0.0),
            to: Vec3::new(0.0, 0.8, 0.0),
            half_width: 0.15,
            half_depth: 0.1,
        };
        let garment = Garment {
            pieces: vec![piece(0), piece(1)],
            seams: vec![seam(true), seam(false)],
            body: Some(Body { segments: [("torso".to_owned(), torso)].into(), ..Body::default() }),
            ..Garment::default()
        };
        let at =
            |turned: f64| rest.iter().map(|p| Vec3::new(turned * p.x, p.y + 1.2, turned * 0.2)).collect::<Vec<_>>();
        (garment, vec![at(-1.0), at(1.0)])
    }

    #[test]
    fn halves_of_a_circle_lie_level_and_keep_their_lengths() {
        for sector in [std::f64::consts::PI, 1.9] {
            let (garment, mut placed) = halves(sector);
            assert_eq!(lay_on_cone(&garment, &mut placed, &[0, 1]), ["front", "back"]);
            let (low, high) = placed.iter().flatten().fold((9.0_f64, 0.0_f64), |(l, h), p| (l.min(p.y), h.max(p.y)));
            let half_angle_sine = sector / std::f64::consts::PI;
            let slope = (1.0 - half_angle_sine * half_angle_sine).max(0.0).sqrt();
            // A level panel is tilted about a line through its apex.
            let tilted = RADII[2] * libm::sin(SLOPE_LEAST);
            let height = if half_angle_sine < 1.0 { slope * (RADII[2] - RADII[0]) } else { tilted };
            assert!(((high - low) - height).abs() < 1e-9, "{sector}: {low} to {high}");
            // Along a radius lengths are kept; across, a chord is no longer than it was.
            for (piece, x) in garment.pieces.iter().zip(&placed) {
                let mesh = piece.mesh.as_ref().expect("mesh");
                for t in &mesh.triangles {
                    let (flat, now) = (
                        (mesh.rest[t[0] as usize] - mesh.rest[t[1] as usize]).norm(),
                        (x[t[0] as usize] - x[t[1] as usize]).norm(),
                    );
                    assert!(now <= flat + 1e-9 && now > 0.99 * flat, "{flat} {now}");
                }
                // The middle of the upper edge clears the torso.
                assert!(libm::hypot(x[6].x, x[6].z) > 0.15);
            }
            // The front stays in front, and its left side meets the left side of the back.
            assert!(placed[1][6].z > 0.0 && placed[0][6].z < 0.0);
            for seam in &garment.seams {
                for s in &seam.stitches {
                    let [a, b] = [s.a, s.b].map(|v| placed[v.piece.index()][v.vertex as usize]);
                    assert!((a - b).norm() < 0.2, "{a} {b}");
                }
            }
        }
    }
}
