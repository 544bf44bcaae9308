//! The notches of a garment: where each lies and which one it meets. They have the same labels in the drawing, the table,
//! the view and the findings.

use super::places::Place;
use super::tables::{Cell, Table};
use super::words::{Language, Phrase};
use std::collections::BTreeMap;
use toile_garment::seam::SeamKind;
use toile_garment::{Garment, Piece, Vec2};

/// A notch.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Piece, and index in its list of notches.
    pub at: (usize, usize),
    /// Its name: `FRONT.n3`.
    pub name: String,
    /// The edge that it lies on, and its way from the start of the edge, metres.
    pub edge: Option<(String, f64)>,
    /// The seams that pass it: index, and the name of the notch that it meets there.
    pub seams: Vec<(usize, Option<String>)>,
}

/// The name by which the page picks a notch.
#[must_use]
pub fn pick_name((piece, notch): (usize, usize)) -> String {
    format!("notch:{piece}:{notch}")
}

/// A vertex of the mesh of a piece.
type Vertex = (usize, u32);

/// All notches, by piece and number.
#[must_use]
pub fn rows(garment: &Garment) -> Vec<Row> {
    let labels: Vec<Vec<String>> = garment.pieces.iter().map(Piece::notch_labels).collect();
    let all: Vec<(usize, usize)> = garment
        .pieces
        .iter()
        .enumerate()
        .flat_map(|(p, piece)| (0..piece.notches.len()).map(move |k| (p, k)))
        .collect();
    let name = |(p, k): (usize, usize)| format!("{}.{}", garment.pieces[p].name, labels[p][k]);
    let vertices: Vec<Option<Vertex>> = all.iter().map(|at| vertex(garment, *at)).collect();
    let mut marked: BTreeMap<Vertex, (usize, usize)> = BTreeMap::new();
    for (at, v) in all.iter().zip(&vertices) {
        if let Some(v) = v {
            marked.entry(*v).or_insert(*at);
        }
    }
    let sewn = sewn(garment, &marked);
    let row = |(at, v): (&(usize, usize), &Option<Vertex>)| {
        let piece = &garment.pieces[at.0];
        let edge = piece.edge_of_notch(&piece.notches[at.1]);
        let edge = edge.map(|(e, way)| (e.name.clone().unwrap_or_else(|| format!("edge {}", e.index)), way));
        let met = v.as_ref().and_then(|v| sewn.get(v)).map_or(&[][..], Vec::as_slice);
        let seams = met.iter().map(|(k, other)| (*k, marked.get(other).map(|at| name(*at)))).collect();
        Row { at: *at, name: name(*at), edge, seams }
    };
    let mut out: Vec<Row> = all.iter().zip(&vertices).map(row).collect();
    out.sort_by_key(|r| (r.at.0, labels[r.at.0][r.at.1].get(1..).and_then(|n| n.parse::<u32>().ok())));
    out
}

/// The vertex of the sewn line that is nearest to a notch on an edge.
fn vertex(garment: &Garment, (p, k): (usize, usize)) -> Option<Vertex> {
    let piece = &garment.pieces[p];
    let (mesh, notch) = (piece.mesh.as_ref()?, piece.notches.get(k).filter(|n| n.is_on_edge())?);
    let far = |v: &&u32| mesh.rest.get(**v as usize).map_or(f64::INFINITY, |q| (q - notch.at).norm_squared());
    let nearest = mesh.outline()?.vertices.iter().min_by(|a, b| far(a).total_cmp(&far(b)))?;
    Some((p, *nearest))
}

/// The stitches of seams at marked vertices: seam, and the vertex on the other side.
fn sewn(garment: &Garment, marked: &BTreeMap<Vertex, (usize, usize)>) -> BTreeMap<Vertex, Vec<(usize, Vertex)>> {
    let mut out: BTreeMap<Vertex, Vec<(usize, Vertex)>> = BTreeMap::new();
    for (k, seam) in garment.seams.iter().enumerate().filter(|(_, s)| s.kind == SeamKind::Seam) {
        for stitch in &seam.stitches {
            let [a, b] = [stitch.a, stitch.b].map(|v| (v.piece.index(), v.vertex));
            for (one, other) in [(a, b), (b, a)] {
                if marked.contains_key(&one) {
                    let list = out.entry(one).or_default();
                    match list.iter_mut().find(|(seam, _)| *seam == k) {
                        // Of several stitches at one vertex, the one that leads to a notch counts.
                        Some(known) if !marked.contains_key(&known.1) => known.1 = other,
                        Some(_) => {}
                        None => list.push((k, other)),
                    }
                }
            }
        }
    }
    out
}

/// The table.
pub fn table(garment: &Garment) -> Table {
    let mut t = Table::new(
        "notches",
        "Notches",
        "Numbers count along the sewn line, from the start of the first edge, counter-clockwise on the drawing.",
        &[
            ("notch", "notch"),
            ("edge", "edge"),
            ("from_start_mm", "from its start mm"),
            ("seam", "seam"),
            ("meets", "meets"),
        ],
    );
    t.rows = rows(garment).iter().map(|r| cells(garment, r)).collect();
    t
}

fn cells(garment: &Garment, row: &Row) -> Vec<Cell> {
    let (edge, way) = match &row.edge {
        Some((name, way)) => (Cell::Text(name.clone()), Cell::Number(1e3 * way, 1)),
        None => (Cell::Phrases(vec![Phrase::new("on no edge", [])]), Cell::Empty),
    };
    let joined = |all: Vec<String>| if all.is_empty() { Cell::Empty } else { Cell::Text(all.join(", ")) };
    let seams = row.seams.iter().map(|(k, _)| garment.seams[*k].name.clone()).collect();
    let met = row.seams.iter().filter_map(|(_, other)| other.clone()).collect();
    vec![Cell::Text(row.name.clone()), edge, way, joined(seams), joined(met)]
}

/// The words of the page for a notch that is picked.
pub fn words(row: &Row, language: Language) -> String {
    let mm = |x: f64| crate::svg::canvas::fixed(1e3 * x, 1);
    let mut out = match &row.edge {
        Some((edge, way)) => {
            let values = [row.name.clone(), language.edge(edge), mm(*way)];
            language.fill("notch {0}: {1}, {2} mm from its start", &values)
        }
        None => language.fill("notch {0}", std::slice::from_ref(&row.name)),
    };
    for other in row.seams.iter().filter_map(|(_, other)| other.as_ref()) {
        out += &language.fill(", sewn to {0}", std::slice::from_ref(other));
    }
    out
}

/// The place of a notch. It is seen only when it is picked.
pub fn place(garment: &Garment, row: &Row) -> Place {
    let (p, k) = row.at;
    let at: Vec2 = garment.pieces[p].notches[k].at;
    Place { pick: pick_name(row.at), points: vec![(p, at)], target: Some(format!("piece:{p}")), ..Place::default() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use toile_garment::mesh::{ChainKind, MeshChain, PieceMesh};
    use toile_garment::notch::{Notch, NotchKind};
    use toile_garment::outline::{LinePoint, OutlineEdge, PieceLine, PointKind};
    use toile_garment::seam::{Seam, SeamSide, Stitch};
    use toile_garment::{MeshVertex, PieceId};

    /// A square of 100 mm with a notch half way up its right edge and one half way up its left edge.
    fn square(id: usize, name: &str) -> Piece {
        let rest: Vec<Vec2> =
            [[0.0, 0.0], [0.1, 0.0], [0.1, 0.05], [0.1, 0.1], [0.0, 0.1], [0.0, 0.05]].map(Vec2::from).to_vec();
        let corners = [0, 1, 3, 4].map(|k| LinePoint { at: rest[k], kind: PointKind::Turn });
        let edge = |k: u32| OutlineEdge { index: k, name: (k == 1).then(|| "side".into()), from: k, to: (k + 1) % 4 };
        let notch = |k: usize| {
            let (kind, at, on) = (NotchKind::Slit, rest[k], "sew".to_owned());
            Notch { kind, at, depth: 4e-3, width: 0.0, angle: None, on, name: None, source: None }
        };
        let notches = vec![notch(5), notch(2)];
        let chains = vec![MeshChain { kind: ChainKind::Outline, index: 0, vertices: (0..6).collect(), closed: true }];
        let triangles = vec![[0, 1, 2], [0, 2, 5], [5, 2, 3], [5, 3, 4]];
        let outline = PieceLine { points: corners.to_vec(), closed: true, ..PieceLine::default() };
        let mesh = Some(PieceMesh { rest, triangles, chains, ..PieceMesh::default() });
        let (id, name, edges) = (PieceId::from(id), name.to_owned(), (0..4).map(edge).collect());
        Piece { id, name, outline, edges, notches, mesh, ..Piece::default() }
    }

    fn garment() -> Garment {
        let vertex = |piece: usize, vertex| MeshVertex { piece: piece.into(), vertex };
        let stitches = [(1, 0), (2, 5), (3, 4)].map(|(a, b)| Stitch { a: vertex(0, a), b: vertex(1, b) }).to_vec();
        let seam = Seam {
            id: 0.into(),
            name: "side".into(),
            kind: SeamKind::Seam,
            a: SeamSide::default(),
            b: SeamSide::default(),
            ease: 0.0,
            gather: None,
            stitches,
            source: None,
        };
        Garment { pieces: vec![square(0, "FRONT"), square(1, "BACK")], seams: vec![seam], ..Garment::default() }
    }

    #[test]
    fn a_notch_tells_its_edge_and_the_notch_that_it_meets() {
        let rows = rows(&garment());
        let names: Vec<&str> = rows.iter().map(|r| r.name.as_str()).collect();
        assert_eq!(names, ["FRONT.n1", "FRONT.n2", "BACK.n1", "BACK.n2"]);
        let (edge, way) = rows[0].edge.clone().expect("an edge");
        assert!((way - 0.05).abs() < 1e-12, "{way}");
        assert_eq!((rows[0].at, edge.as_str()), ((0, 1), "side"));
        assert_eq!(rows[0].seams, [(0, Some("BACK.n2".to_owned()))]);
        assert_eq!((rows[1].seams.len(), &rows[3].seams), (0, &vec![(0, Some("FRONT.n1".to_owned()))]));
        let told = words(&rows[0], Language::English);
        assert_eq!(told, "notch FRONT.n1: side, 50.0 mm from its start, sewn to BACK.n2");
        assert_eq!(words(&rows[1], Language::Chinese), "剪口 FRONT.n2：边 3，距起点 50.0 mm");
    }

    #[test]
    fn the_table_has_a_row_for_each_notch() {
        let table = table(&garment());
        let text = |k: usize, c: usize| table.rows[k][c].clone();
        assert_eq!((table.rows.len(), text(0, 4)), (4, Cell::Text("BACK.n2".into())));
        assert!(matches!(text(1, 2), Cell::Number(mm, 1) if (mm - 50.0).abs() < 1e-9));
        assert_eq!(text(1, 3), Cell::Empty);
    }
}
