//! Writes a DXF in every dialect and reads it again: `round_trip_dxf [--out FOLDER] IN.dxf…`. Exit code 1 when anything
//! differs. Sizes of a nest are also written as a size run, and its sample size is graded with the rules and compared.
//! With `--out` what is written stays in the folder, for other readers. The environment variable `VERTICES` lists the
//! vertices that differ.
#![allow(clippy::print_stdout, clippy::print_stderr)]

use std::process::ExitCode;
use toile_formats::dxf::write::{
    Dialect, Drawing, PieceOptions, Sizes, StyleText, drawn_vertices, piece_drawing, write,
};
use toile_formats::dxf::{Pattern, ReadOptions, geom, grade, read};
use toile_formats::rul;
use toile_garment::dart::Dart;
use toile_garment::outline::{LinePoint, PieceLine, PointKind};
use toile_garment::{Garment, Piece, Vec2};

/// Metres.
const SAME: f64 = 1e-6;

fn main() -> ExitCode {
    let mut wrong = 0_usize;
    let mut arguments: Vec<String> = std::env::args().skip(1).collect();
    let out = arguments.iter().position(|a| a == "--out").map(|i| {
        arguments.remove(i);
        std::path::PathBuf::from(arguments.remove(i))
    });
    let mut trips = 0_usize;
    for input in arguments {
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
                trips += 1;
                let (faults, bytes) = trip(&first, dialect);
                keep(out.as_deref(), &input, &format!("{}-{dialect:?}.dxf", size.unwrap_or("x")), &bytes);
                for fault in faults {
                    println!("{input} {size:?} {dialect:?}: {fault}");
                    wrong += 1;
                }
            }
        }
        for (fault, files) in nest(&pattern, &input) {
            trips += 1;
            for (name, bytes) in files {
                keep(out.as_deref(), &input, &name, &bytes);
            }
            if let Some(fault) = fault {
                println!("{input} nest: {fault}");
                wrong += 1;
            }
        }
    }
    println!("{trips} trip(s), {wrong} difference(s)");
    if wrong == 0 { ExitCode::SUCCESS } else { ExitCode::from(1) }
}

/// Writes a file into the folder, if there is one.
fn keep(folder: Option<&std::path::Path>, input: &str, name: &str, bytes: &[u8]) {
    let Some(folder) = folder else { return };
    let stem = std::path::Path::new(input).file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned());
    let name: String = format!("{stem}-{name}").chars().map(|c| if c == '/' { '_' } else { c }).collect();
    if let Err(error) = std::fs::write(folder.join(&name), bytes) {
        eprintln!("{name}: {error}");
    }
}

type Files = Vec<(String, Vec<u8>)>;

/// Every dialect of the whole size run: what its sample size, graded by the written rules, differs from the sizes
/// drawn.
fn nest(pattern: &Pattern, input: &str) -> Vec<(Option<String>, Files)> {
    let table = std::fs::read(std::path::Path::new(input).with_extension("rul")).ok();
    let table = table.and_then(|b| rul::read(&b, "t.rul").ok());
    if pattern.size_order(table.as_ref()).len() < 2 {
        return Vec::new();
    }
    let run = match Sizes::new(pattern, table.as_ref()) {
        Ok(sizes) => sizes.draw(PieceOptions::default()),
        Err(faults) => return vec![(Some(faults.iter().map(|f| f.message.clone()).collect()), Vec::new())],
    };
    let Some(rules) = &run.table else { return vec![(Some("no rule table".into()), Vec::new())] };
    let trips = Dialect::ALL.into_iter().map(|dialect| {
        let bytes = write(&run.drawing, dialect).map(|w| w.bytes).unwrap_or_default();
        let text = rul::write(rules, dialect.is_astm(), dialect != Dialect::Clo);
        let fault = graded(&bytes, &text).err().map(|f| format!("{dialect:?}: {f}"));
        (fault, vec![(format!("run-{dialect:?}.dxf"), bytes), (format!("run-{dialect:?}.rul"), text)])
    });
    trips.collect()
}

/// Grades the sample size of a nest by its table; every ruled vertex must lie on a vertex of the size drawn, within
/// 0.01 mm.
fn graded(bytes: &[u8], table: &[u8]) -> Result<(), String> {
    let pattern = read(bytes, "nest.dxf", &ReadOptions::default()).map_err(|e| format!("{:?}", e[0].message))?;
    let table = rul::read(table, "nest.rul").map_err(|e| format!("{:?}", e[0].message))?;
    let sample = table.sample.clone().unwrap_or_default();
    let is = |size: &Option<String>, wanted: &str| size.as_deref().is_some_and(|s| s.eq_ignore_ascii_case(wanted));
    let mut worst = 0.0_f64;
    for piece in pattern.pieces.iter().filter(|p| is(&p.size, &sample) && !p.texts.rules.is_empty()) {
        for size in &table.sizes {
            let drawn = pattern.pieces.iter().find(|p| p.name == piece.name && is(&p.size, size));
            let Some(drawn) = drawn else { return Err(format!("{} {size} is not drawn", piece.label())) };
            let graded = grade::grade(piece, &table, size).map_err(|e| format!("{e:?}"))?;
            // A vertex that one size needs may stand in another only on the dense copy.
            let mut there = drawn.boundary.positions();
            there.extend(drawn.boundary.work_positions());
            let ruled = |p: Vec2| piece.texts.rules.iter().any(|r| (r.at - p).norm() <= 0.02);
            for (from, to) in piece.boundary.positions().iter().zip(graded.boundary.positions()) {
                if ruled(*from) {
                    worst = there.iter().map(|q| (q - to).norm()).fold(f64::INFINITY, f64::min).max(worst);
                }
            }
        }
    }
    if worst <= 0.01 { Ok(()) } else { Err(format!("a graded vertex is {worst:.4} mm off")) }
}

fn trip(first: &Garment, dialect: Dialect) -> (Vec<String>, Vec<u8>) {
    let mut findings = Vec::new();
    let pieces = first.pieces.iter().map(|p| piece_drawing(p, PieceOptions::default(), &mut findings)).collect();
    let style = StyleText { name: first.style.clone(), sample_size: first.size.clone(), ..StyleText::default() };
    let bytes = match write(&Drawing { style, pieces }, dialect) {
        Ok(written) => written.bytes,
        Err(faults) => return (faults.iter().map(|f| f.message.clone()).collect(), Vec::new()),
    };
    let again = read(&bytes, "again.dxf", &ReadOptions::default()).and_then(|p| p.to_garment(None, None));
    let second = match again {
        Ok((garment, _)) => garment,
        Err(faults) => return (faults.iter().map(|f| f.message.clone()).collect(), bytes),
    };
    if first.pieces.len() != second.pieces.len() {
        return (vec![format!("{} pieces against {}", first.pieces.len(), second.pieces.len())], bytes);
    }
    (first.pieces.iter().zip(&second.pieces).flat_map(|(a, b)| compare(a, b, dialect)).collect(), bytes)
}

/// The lines of a piece with the vertices that are drawn.
fn lines(piece: &Piece) -> Vec<PieceLine> {
    let drawn = piece.drawn.clone().unwrap_or_default();
    let told =
        |line: &PieceLine, drawn: &[LinePoint]| PieceLine { points: drawn_vertices(line, drawn), ..line.clone() };
    let outline = told(&piece.outline, &drawn.outline);
    let cut = piece.cut_line.iter().map(|l| told(l, &drawn.cut_line));
    let others = piece.internal_lines.iter().chain(&piece.cutouts).chain(&piece.match_lines).cloned();
    std::iter::once(outline).chain(cut).chain(others).collect()
}

/// How far the sewn lines of two pieces are apart, mm.
fn apart(a: &Piece, b: &Piece) -> f64 {
    let (p, q) = (a.outline.positions(), b.outline.positions());
    geom::deviation(&p, &q, true).max(geom::deviation(&q, &p, true)) * 1e3
}

fn compare(a: &Piece, b: &Piece, dialect: Dialect) -> Vec<String> {
    let mut faults = Vec::new();
    let mut say = |what: String| faults.push(format!("{}: {what}", a.name));
    // A mark on the fold of a piece that is written whole is a short internal line.
    let on_fold = a.notches.iter().filter(|n| n.on == "fold").count();
    let mut b = b.clone();
    b.internal_lines.truncate(b.internal_lines.len().saturating_sub(on_fold));
    let mut a = a.clone();
    a.notches.retain(|n| n.on != "fold");
    let (a, b) = (&a, &b);
    let (la, lb) = (lines(a), lines(b));
    let shape = |l: &[PieceLine]| l.iter().map(|l| l.points.len()).collect::<Vec<_>>();
    if shape(&la) != shape(&lb) {
        say(format!("vertices {:?} against {:?}", shape(&la), shape(&lb)));
        if let (true, Some((x, y))) = (std::env::var_os("VERTICES").is_some(), la.first().zip(lb.first())) {
            let far = |p: &LinePoint, l: &PieceLine| l.points.iter().all(|q| (p.at - q.at).norm() > SAME);
            for p in x.points.iter().filter(|p| far(p, y)).chain(y.points.iter().filter(|p| far(p, x))) {
                say(format!("    {:?} {:?}", p.at * 1e3, p.kind));
            }
        }
    } else {
        // The outline is compared from its first corner on: a line has no beginning of its own.
        let start = |l: &PieceLine| l.points.iter().position(|p| p.kind == PointKind::Turn).unwrap_or(0);
        for (k, (x, y)) in la.iter().zip(&lb).enumerate() {
            let (i, j) = if k == 0 { (start(x), start(y)) } else { (0, 0) };
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
    if apart(a, b) > if dialect.has_dense() { 0.01 } else { 2.0 } {
        say(format!("the sewn lines are {:.3} mm apart", apart(a, b)));
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
