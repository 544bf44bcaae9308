//! The pieces, surfaces and garments of the tests.

use super::*;

/// A plane mesh whose columns lie on straight rulings.
pub struct Grid {
    pub points: Vec<Vec2>,
    pub columns: usize,
    pub rows: usize,
}

impl Grid {
    pub fn new(columns: usize, rows: usize, at: impl Fn(f64, f64) -> Vec2) -> Self {
        let share = |k: usize, n: usize| k as f64 / n as f64;
        let points = (0..=columns)
            .flat_map(|i| (0..=rows).map(move |j| (i, j)))
            .map(|(i, j)| at(share(i, columns), share(j, rows)))
            .collect();
        Self { points, columns, rows }
    }

    pub fn id(&self, i: usize, j: usize) -> u32 {
        (i * (self.rows + 1) + j) as u32
    }

    /// Counter-clockwise where columns run to +x and rows to +y.
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        let cell = |(i, j): (usize, usize)| {
            let [a, b, c, d] = [self.id(i, j), self.id(i + 1, j), self.id(i + 1, j + 1), self.id(i, j + 1)];
            if (i + j) % 2 == 0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] }
        };
        (0..self.columns).flat_map(|i| (0..self.rows).map(move |j| (i, j))).flat_map(cell).collect()
    }

    /// Folds by `angle` at every inner ruling.
    pub fn fold(&self, angle: f64) -> Vec<Vec3> {
        let (mut turn, mut shift) = (Rotation3::identity(), Vec3::zeros());
        let mut out = Vec::new();
        for i in 0..=self.columns {
            let column = &self.points[i * (self.rows + 1)..(i + 1) * (self.rows + 1)];
            let lifted: Vec<Vec3> = column.iter().map(|p| turn * Vec3::new(p.x, p.y, 0.0) + shift).collect();
            let (foot, head) = (lifted[0], lifted[self.rows]);
            let about = Rotation3::from_axis_angle(&Unit::new_normalize(head - foot), angle);
            (turn, shift) = (about * turn, about * (shift - foot) + foot);
            out.extend(lifted);
        }
        out
    }

    pub fn corners(&self) -> [u32; 4] {
        [self.id(0, 0), self.id(self.columns, 0), self.id(self.columns, self.rows), self.id(0, self.rows)]
    }

    pub fn outline(&self) -> Vec<u32> {
        let (m, n) = (self.columns, self.rows);
        let bottom = (0..m).map(|i| self.id(i, 0));
        let right = (0..n).map(|j| self.id(m, j));
        let top = (1..=m).rev().map(|i| self.id(i, n));
        let left = (1..=n).rev().map(|j| self.id(0, j));
        bottom.chain(right).chain(top).chain(left).collect()
    }

    pub fn piece(&self) -> Piece {
        piece(self.points.clone(), self.triangles(), self.outline(), &self.corners())
    }
}

pub fn piece(rest: Vec<Vec2>, triangles: Vec<[u32; 3]>, outline: Vec<u32>, corners: &[u32]) -> Piece {
    let point = |v: &u32| LinePoint { at: rest[*v as usize], kind: PointKind::Turn };
    let n = corners.len() as u32;
    let edge = |k: u32| OutlineEdge { index: k, name: None, from: k, to: (k + 1) % n };
    Piece {
        name: "piece".into(),
        outline: PieceLine { points: corners.iter().map(point).collect(), closed: true, ..PieceLine::default() },
        edges: (0..n).map(edge).collect(),
        mesh: Some(PieceMesh {
            triangles,
            chains: vec![MeshChain { kind: ChainKind::Outline, index: 0, vertices: outline, closed: true }],
            outline_vertex: corners.iter().map(|v| Some(*v)).collect(),
            rest,
            rest_corners: None,
        }),
        ..Piece::default()
    }
}

/// Polar coordinates, triangles, and the vertices of every ring.
type Disc = (Vec<[f64; 2]>, Vec<[u32; 3]>, Vec<Vec<u32>>);

/// Disc of `rings` rings with a wedge left out; vertex 0 is the centre, dart legs are its two straight sides.
pub fn disc(radius: f64, rings: usize, sector: f64) -> Disc {
    let closed = sector >= TAU - 1e-12;
    let mut polar = vec![[0.0, 0.0]];
    let mut ring_ids: Vec<Vec<u32>> = vec![vec![0]];
    for j in 1..=rings {
        let n = (6.0 * j as f64 * sector / TAU).round() as usize;
        let first = polar.len() as u32;
        let count = if closed { n } else { n + 1 };
        polar.extend((0..count).map(|k| [radius * j as f64 / rings as f64, sector * k as f64 / n as f64]));
        let mut ids: Vec<u32> = (0..count as u32).map(|k| first + k).collect();
        if closed {
            ids.push(first);
        }
        ring_ids.push(ids);
    }
    let mut triangles = Vec::new();
    for pair in ring_ids.windows(2) {
        let (inner, outer) = (&pair[0], &pair[1]);
        let (mut i, mut o) = (0, 0);
        while o + 1 < outer.len() || i + 1 < inner.len() {
            let share = |k: usize, ids: &[u32]| (k + 1) as f64 / (ids.len().max(2) - 1) as f64;
            let take_outer = i + 1 >= inner.len() || (o + 1 < outer.len() && share(o, outer) <= share(i, inner) + 1e-9);
            if take_outer {
                triangles.push([inner[i], outer[o], outer[o + 1]]);
                o += 1;
            } else {
                triangles.push([inner[i], outer[o], inner[i + 1]]);
                i += 1;
            }
        }
    }
    (polar, triangles, ring_ids)
}

pub fn plane(polar: &[[f64; 2]]) -> Vec<Vec2> {
    polar.iter().map(|[r, a]| Vec2::new(r * libm::cos(*a), r * libm::sin(*a))).collect()
}

/// A cone of which the sector is the development, the two straight sides welded.
pub fn cone(polar: &[[f64; 2]], sector: f64) -> Vec<Vec3> {
    let slope = sector / TAU;
    let height = (1.0 - slope * slope).sqrt();
    let at = |[r, a]: &[f64; 2]| {
        let turn = if (a - sector).abs() < 1e-12 { 0.0 } else { a / slope };
        Vec3::new(r * slope * libm::cos(turn), -r * height, -r * slope * libm::sin(turn))
    };
    polar.iter().map(at).collect()
}

/// The disc with its slit as a dart.
pub fn dart_piece(polar: &[[f64; 2]], triangles: &[[u32; 3]], rings: &[Vec<u32>]) -> Piece {
    let rest = plane(polar);
    let leg = |end: fn(&Vec<u32>) -> u32| rings.iter().rev().map(end).collect::<Vec<u32>>();
    let (first, last) = (leg(|r| r[0]), leg(|r| r[r.len() - 1]));
    let mut outline = rings[rings.len() - 1].clone();
    outline.extend(last[1..].iter().chain(first[1..first.len() - 1].iter().rev()));
    let corners = [first[0], last[0], 0];
    let mut piece = piece(rest.clone(), triangles.to_vec(), outline, &corners);
    let points = |ids: &[u32]| ids.iter().map(|v| rest[*v as usize]).collect::<Vec<_>>();
    piece.darts.push(Dart {
        name: "dart".into(),
        kind: DartKind::Wedge,
        evidence: DartEvidence::BoundaryWedge,
        apexes: vec![rest[0]],
        mouth: [rest[last[0] as usize], rest[first[0] as usize]],
        legs: [points(&last), points(&first)],
        line: "cut".into(),
        depth: None,
        mesh: Some(DartMesh { legs: [last, first] }),
        source: None,
    });
    piece
}

pub fn garment(pieces: Vec<Piece>, surface: Vec<Vec<Vec3>>) -> Garment {
    let drape = Some(Shape { positions: surface, sewn: true, welded: true, ..Shape::default() });
    Garment { pieces, drape, ..Garment::default() }
}

pub fn edited(piece: Piece, before: Vec<Vec3>, now: Vec<Vec3>) -> Garment {
    let mut g = garment(vec![piece], vec![now]);
    g.drape_before_edit = Some(Shape { positions: vec![before], sewn: true, welded: true, ..Shape::default() });
    g
}

pub fn flatten(g: &Garment, params: &FlattenParams) -> Flat {
    let mut report = Report::default();
    let flat = flatten_garment(g, params, &mut report, &mut |_, _| true).expect("flattens");
    let mesh = g.pieces[0].mesh.as_ref().expect("mesh");
    for t in &mesh.triangles {
        assert!(metric::edges2(&flat.pieces[0].positions, *t).determinant() > 0.0, "flipped triangle");
    }
    flat
}

/// Largest distance in mm from the known answer, after the best rotation and shift.
pub fn error_mm(flat: &[Vec2], answer: &[Vec2], triangles: &[[u32; 3]]) -> f64 {
    let fit = Rigid::best(flat, answer, &vertex_areas(answer, triangles));
    flat.iter().zip(answer).map(|(f, a)| 1e3 * (fit.apply(*f) - a).norm()).fold(0.0, f64::max)
}

/// A stored piece that is wrong everywhere, so that the answer can only come from the surface.
pub fn distorted(p: &[Vec2]) -> Vec<Vec2> {
    p.iter().map(|p| Vec2::new(1.06 * p.x + 0.2 * p.y * p.y, 0.95 * p.y + 0.05 * p.x)).collect()
}
