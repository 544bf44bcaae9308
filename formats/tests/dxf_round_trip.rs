//! What the writer writes, the reader reads: the sample patterns, out and in again.

use std::path::PathBuf;
use toile_formats::dxf::write::{Dialect, Drawing, PieceOptions, StyleText, piece_drawing, write};
use toile_formats::dxf::{ReadOptions, read};
use toile_garment::{Garment, Piece, Severity};

fn import(bytes: &[u8], name: &str, size: &str) -> Garment {
    let pattern = read(bytes, name, &ReadOptions::default()).expect("read");
    let (garment, findings) = pattern.to_garment(Some(size), None).expect("garment");
    for f in &findings {
        assert!(f.severity != Severity::Error, "{name} {size}: {f}");
    }
    garment
}

fn export(garment: &Garment, dialect: Dialect) -> Vec<u8> {
    let mut findings = Vec::new();
    let pieces = garment.pieces.iter().map(|p| piece_drawing(p, PieceOptions::default(), &mut findings)).collect();
    let style = StyleText { name: garment.style.clone(), sample_size: garment.size.clone(), author: String::new() };
    write(&Drawing { style, pieces }, dialect).expect("written").bytes
}

fn same(a: &Piece, b: &Piece) {
    let lines = |p: &Piece| {
        let mut v = vec![p.outline.clone()];
        v.extend(p.cut_line.clone());
        v.extend(p.internal_lines.clone());
        v
    };
    let (la, lb) = (lines(a), lines(b));
    assert_eq!(la.len(), lb.len(), "{}", a.name);
    for (x, y) in la.iter().zip(&lb) {
        assert_eq!(x.points.len(), y.points.len(), "{}", a.name);
        for (p, q) in x.points.iter().zip(&y.points) {
            assert!((p.at - q.at).norm() < 1e-6, "{}: {} against {}", a.name, p.at, q.at);
        }
    }
    assert_eq!(a.edges.len(), b.edges.len());
    assert_eq!(a.notches.len(), b.notches.len());
    for (x, y) in a.notches.iter().zip(&b.notches) {
        assert!((x.at - y.at).norm() < 1e-6);
        assert_eq!(x.kind, y.kind);
    }
    assert_eq!(a.darts.len(), b.darts.len(), "{}", a.name);
    for (x, y) in a.darts.iter().zip(&b.darts) {
        assert_eq!(x.kind, y.kind);
        assert!(x.apexes.iter().zip(&y.apexes).all(|(p, q)| (p - q).norm() < 1e-6));
        assert!((x.intake() - y.intake()).abs() < 1e-6);
    }
    assert_eq!(a.drill_holes.len(), b.drill_holes.len());
    let g = |p: &Piece| p.grain.expect("grain");
    assert!((g(a)[0] - g(b)[0]).norm() < 1e-6 && (g(a)[1] - g(b)[1]).norm() < 1e-6);
    assert_eq!((&a.name, &a.size, &a.material, &a.category), (&b.name, &b.size, &b.material, &b.category));
}

#[test]
fn samples_go_out_and_in_unchanged() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../samples/patterns");
    for style in ["long-skirt", "fitted-bodice", "t-shirt"] {
        for word in ["aama", "astm"] {
            let name = format!("{style}.{word}.dxf");
            let bytes = std::fs::read(folder.join(&name)).expect("sample");
            for size in ["36", "38", "40"] {
                let first = import(&bytes, &name, size);
                for dialect in [Dialect::Aama, Dialect::Astm, Dialect::Clo] {
                    let second = import(&export(&first, dialect), "again.dxf", size);
                    assert_eq!(first.pieces.len(), second.pieces.len());
                    for (a, b) in first.pieces.iter().zip(&second.pieces) {
                        same(a, b);
                    }
                }
            }
        }
    }
}
