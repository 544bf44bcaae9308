//! Writes a DXF in every dialect and reads it again: `round_trip_dxf IN.dxf…`. Exit code 1 when anything differs.
#![allow(clippy::print_stdout, clippy::print_stderr)]

use std::process::ExitCode;
use toile_formats::dxf::write::{Dialect, Drawing, PieceOptions, StyleText, piece_drawing, write};
use toile_formats::dxf::{ReadOptions, read};
use toile_garment::dart::Dart;
use toile_garment::outline::PieceLine;
use toile_garment::{Garment, Piece};

/// Metres.
const SAME: f64 = 1e-6;

fn main() -> ExitCode {
    let mut wrong = 0_usize;
    for input in std::env::args().skip(1) {
        let Ok(bytes) = std::fs::read(&input) else {
            eprintln!("{input}: cannot be read");
            return ExitCode::from(5);
        };
        let Ok(pattern) = read(&bytes, &input, &ReadOptions::default()) else {
            println!("{input}: refused");
            continue;
        };
        let sizes: Vec<Option<&str>> = if pattern.sizes.is_empty() {
            vec![None]
        } else {
            pattern.sizes.iter().map(|s| Some(s.as_str())).collect()
        };
        for size in sizes {
            let Ok((first, _)) = pattern.to_garment(size, None) else { continue };
            for dialect in Dialect::ALL {
                for fault in trip(&first, dialect) {
                    println!("{input} {size:?} {dialect:?}: {fault}");
                    wrong += 1;
                }
            }
        }
    }
    println!("{wrong} difference(s)");
    if wrong == 0 { ExitCode::SUCCESS } else { ExitCode::from(1) }
}

fn trip(first: &Garment, dialect: Dialect) -> Vec<String> {
    let mut findings = Vec::new();
    let pieces = first.pieces.iter().map(|p| piece_drawing(p, PieceOptions::default(), &mut findings)).collect();
    let style = StyleText { name: first.style.clone(), sample_size: first.size.clone(), ..StyleText::default() };
    let bytes = match write(&Drawing { style, pieces }, dialect) {
        Ok(written) => written.bytes,
        Err(faults) => return faults.iter().map(|f| f.message.clone()).collect(),
    };
    let again = read(&bytes, "again.dxf", &ReadOptions::default()).and_then(|p| p.to_garment(None, None));
    let second = match again {
        Ok((garment, _)) => garment,
        Err(faults) => return faults.iter().map(|f| f.message.clone()).collect(),
    };
    if first.pieces.len() != second.pieces.len() {
        return vec![format!("{} pieces against {}", first.pieces.len(), second.pieces.len())];
    }
    first.pieces.iter().zip(&second.pieces).flat_map(|(a, b)| compare(a, b, dialect)).collect()
}

fn lines(piece: &Piece) -> Vec<&PieceLine> {
    let own = std::iter::once(&piece.outline).chain(&piece.cut_line);
    own.chain(&piece.internal_lines).chain(&piece.cutouts).chain(&piece.match_lines).collect()
}

fn compare(a: &Piece, b: &Piece, dialect: Dialect) -> Vec<String> {
    let mut faults = Vec::new();
    let mut say = |what: String| faults.push(format!("{}: {what}", a.name));
    let (la, lb) = (lines(a), lines(b));
    let shape = |l: &[&PieceLine]| l.iter().map(|l| l.points.len()).collect::<Vec<_>>();
    if shape(&la) != shape(&lb) {
        say(format!("vertices {:?} against {:?}", shape(&la), shape(&lb)));
    } else {
        // The outline is compared from its first corner on: a line has no beginning of its own.
        let start = |p: &Piece| p.edges.first().map_or(0, |e| e.from as usize);
        for (k, (x, y)) in la.iter().zip(&lb).enumerate() {
            let (i, j) = if k == 0 { (start(a), start(b)) } else { (0, 0) };
            let n = x.points.len();
            let off = |j: usize| {
                let pairs = (0..n).map(|s| (x.points[(i + s) % n].at, y.points[(j + s) % n].at));
                pairs.map(|(p, q)| (p - q).norm()).fold(0.0, f64::max)
            };
            // Cut lines and cutouts may begin anywhere.
            let off = if k == 0 || !x.closed { off(j) } else { (0..n).map(off).fold(f64::INFINITY, f64::min) };
            if off > SAME {
                say(format!("a vertex of line {k} moved by {:.4} mm", off * 1e3));
            }
        }
    }
    let counts = |p: &Piece| [p.edges.len(), p.darts.len(), p.notches.len(), p.drill_holes.len(), p.texts.len()];
    if counts(a) != counts(b) {
        say(format!("edges, darts, notches, drills, texts {:?} against {:?}", counts(a), counts(b)));
    }
    let kinds = |p: &Piece| p.notches.iter().map(|n| n.kind).collect::<Vec<_>>();
    if dialect.is_astm() && kinds(a) != kinds(b) {
        say(format!("kinds of notches {:?} against {:?}", kinds(a), kinds(b)));
    }
    // Darts are listed as they are met on the outline, wherever that begins.
    let same = |x: &Dart, y: &Dart| {
        x.kind == y.kind
            && x.apexes.iter().zip(&y.apexes).chain(x.mouth.iter().zip(&y.mouth)).all(|(p, q)| (p - q).norm() <= SAME)
    };
    if !a.darts.iter().all(|x| b.darts.iter().any(|y| same(x, y))) {
        say("a dart".into());
    }
    if !dialect.is_narrow() {
        let texts = |p: &Piece| p.texts.iter().map(|t| (t.layer.clone(), t.text.clone())).collect::<Vec<_>>();
        if texts(a) != texts(b) || (&a.name, &a.size, &a.material) != (&b.name, &b.size, &b.material) {
            say("texts".into());
        }
    }
    faults
}
