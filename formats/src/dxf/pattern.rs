//! A whole pattern: pieces in sizes, units, ledger and findings.

use super::darts::{DrawnDart, Form};
use super::findings::Findings;
use super::geom;
use super::layers::{Layers, Role};
use super::ledger::{Ledger, Verdict};
use super::lib_curves::{self, Census};
use super::limits;
use super::model::{Block, Drawing, Entity, Shape};
use super::parse;
use super::piece::{Desk, DrawnPiece};
use super::sheet::{Sheet, Sorter};
use super::texts;
use super::units::{self, Evidence, Units};
use std::collections::{BTreeMap, BTreeSet};
use toile_garment::outline::PointKind;
use toile_garment::{Diagnostic, Severity, Vec2};

/// What the user may say about a file.
#[derive(Clone, Debug, Default)]
pub struct ReadOptions {
    /// Millimetres per file unit, overruling the file.
    pub mm_per_unit: Option<f64>,
    /// Layer of the file → layer of the standard.
    pub layers: BTreeMap<String, String>,
}

/// A pattern as read, pieces in millimetres.
#[derive(Clone, Debug)]
pub struct Pattern {
    /// File name for messages.
    pub file: String,
    /// `Style Name`.
    pub style: Option<String>,
    /// Style texts by key in lower case.
    pub style_texts: BTreeMap<String, String>,
    /// Unit.
    pub units: Units,
    /// Code page.
    pub encoding: String,
    /// `$ACADVER`.
    pub release: Option<String>,
    /// Sizes drawn, in file order.
    pub sizes: Vec<String>,
    /// `Sample Size`.
    pub sample_size: Option<String>,
    /// One entry per piece and size, in file order.
    pub pieces: Vec<DrawnPiece>,
    /// What became of every entity.
    pub ledger: Ledger,
    /// Number of polyline vertices in the file.
    pub vertices: u64,
    /// What the library reader and ours agreed on.
    pub census: Census,
    /// Findings; none is an error.
    pub findings: Vec<Diagnostic>,
}

/// Reads a pattern.
///
/// # Errors
/// All findings, at least one of them an error.
pub fn read(bytes: &[u8], file: &str, options: &ReadOptions) -> Result<Pattern, Vec<Diagnostic>> {
    let mut findings = Findings::new(file);
    match read_into(bytes, file, options, &mut findings) {
        Ok(mut pattern) if !findings.has_errors() => {
            pattern.findings = findings.finish();
            Ok(pattern)
        }
        Ok(_) => {
            let mut list = findings.finish();
            list.sort_by_key(|f| std::cmp::Reverse(f.severity));
            Err(list)
        }
        Err(error) => {
            let mut list = findings.finish();
            list.push(error);
            list.sort_by_key(|f| std::cmp::Reverse(f.severity));
            Err(list)
        }
    }
}

fn read_into(bytes: &[u8], file: &str, options: &ReadOptions, findings: &mut Findings) -> Result<Pattern, Diagnostic> {
    let mut drawing = parse::parse(bytes, findings)?;
    let census = lib_curves::cross_read(&mut drawing, findings);
    let layers = Layers::new(&options.layers);
    let mut ledger = Ledger::new(drawing.entity_count);
    let style_texts = style_texts(&drawing);
    let units = decide_units(&drawing, &layers, &style_texts, options, findings);
    let blocks: Vec<Block> = std::mem::take(&mut drawing.blocks);
    let mut by_name: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    for (i, block) in blocks.iter().enumerate() {
        by_name.entry(block.name.clone()).or_default().push(i);
    }
    let mirrored = inserts(&drawing, &blocks, &by_name, findings, &mut ledger);
    let sheets = sheets(&drawing, &blocks, &by_name, &layers, units.mm_per_unit, &mirrored, findings, &mut ledger);
    if sheets.len() > limits::PIECES {
        let text = format!("{} pieces, over the limit of {}", sheets.len(), limits::PIECES);
        return Err(Diagnostic::error("too-many-pieces", text).at(findings.place(1)));
    }
    let mut desk = Desk { findings, ledger: &mut ledger };
    let mut pieces: Vec<DrawnPiece> = sheets
        .into_iter()
        .filter_map(|(name, line, sheet)| DrawnPiece::outline(&name, line, sheet, &mut desk))
        .collect();
    if pieces.is_empty() && !desk.findings.has_errors() {
        let text = "there is no piece in this file: no block has a line on layer 1, and ENTITIES holds no closed line";
        return Err(Diagnostic::error("no-pieces", text)
            .at(desk.findings.place(1))
            .hint("export as AAMA or ASTM, or map the layer of the outlines to \"1\""));
    }
    let sample_size = style_texts.get("sample size").cloned().filter(|s| !s.is_empty());
    carry_between_sizes(&mut pieces, &mut desk);
    for piece in &mut pieces {
        piece.finish(&mut desk);
    }
    deny_inserts_and_unmarked(&mut pieces, &mut desk);
    report_layers(&drawing, &blocks, &layers, desk.findings);
    ledger.close();
    let mut sizes: Vec<String> = Vec::new();
    let mut seen = BTreeSet::new();
    for size in pieces.iter().filter_map(|p| p.size.as_ref()) {
        if seen.insert(size.clone()) {
            sizes.push(size.clone());
        }
    }
    Ok(Pattern {
        file: file.to_owned(),
        style: style_texts.get("style name").cloned(),
        units,
        encoding: drawing.encoding.name(),
        release: drawing.release,
        sizes,
        sample_size,
        pieces,
        vertices: drawing.vertex_count,
        census,
        findings: Vec::new(),
        ledger,
        style_texts,
    })
}

fn style_texts(drawing: &Drawing) -> BTreeMap<String, String> {
    let mut map = BTreeMap::new();
    for entity in &drawing.entities {
        if let Shape::Text { value, .. } = &entity.shape
            && let Some((key, value)) = texts::key_value(value)
        {
            map.entry(key).or_insert(value);
        }
    }
    map
}

fn decide_units(
    drawing: &Drawing,
    layers: &Layers,
    style: &BTreeMap<String, String>,
    options: &ReadOptions,
    findings: &mut Findings,
) -> Units {
    let side = |entities: &[Entity], all: bool| {
        let outline = entities.iter().filter(|e| all || layers.role(&e.layer) == Role::Boundary);
        geom::bounds(outline.flat_map(|e| e.shape.extent())).map_or(0.0, |(lo, hi)| (hi.x - lo.x).max(hi.y - lo.y))
    };
    let mut largest = drawing.blocks.iter().map(|b| side(&b.entities, false)).fold(0.0, f64::max);
    if largest <= 0.0 {
        largest = drawing.entities.iter().map(|e| side(std::slice::from_ref(e), true)).fold(0.0, f64::max);
    }
    let tolerance = ["tolerance", "curve tolerance"].iter().find_map(|k| style.get(*k)).and_then(|t| t.parse().ok());
    let text = style.get("units").map(String::as_str).filter(|t| !t.is_empty());
    let evidence = Evidence { asked: options.mm_per_unit, text, insunits: drawing.insunits, tolerance, side: largest };
    units::decide(&evidence, findings)
}

fn is_model_space(name: &str) -> bool {
    let name = name.trim_start_matches(['$', '*']).to_ascii_lowercase();
    name.starts_with("model_space") || name.starts_with("paper_space")
}

/// Looks at the INSERTs of ENTITIES; tells for each block whether it is inserted mirrored.
fn inserts(
    drawing: &Drawing,
    blocks: &[Block],
    by_name: &BTreeMap<String, Vec<usize>>,
    findings: &mut Findings,
    ledger: &mut Ledger,
) -> Vec<bool> {
    let mut mirrored = vec![false; blocks.len()];
    let mut used: BTreeMap<&str, usize> = BTreeMap::new();
    for entity in &drawing.entities {
        let Shape::Insert { block, scale, rotation, .. } = &entity.shape else { continue };
        let place = findings.place_in(block, Some(&entity.layer), entity.line);
        let Some(named) = by_name.get(block) else {
            let text = format!("an INSERT names block `{block}`, which is not in the file");
            findings.push(Diagnostic::warning("block-missing", text).at(place));
            ledger.note(entity.id, Verdict::Refused, "INSERT of a block that is missing");
            continue;
        };
        let turn = used.entry(block.as_str()).or_insert(0);
        let index = named[(*turn).min(named.len() - 1)];
        *turn += 1;
        let sizes = [scale[0].abs(), scale[1].abs()];
        if sizes.iter().any(|s| (s - 1.0).abs() > 1e-6) || libm::fmod(rotation.abs(), 360.0) > 1e-6 {
            let text = format!(
                "block `{block}` is inserted with scale {} × {} and turned by {rotation}°; the piece was read as drawn in its block",
                scale[0], scale[1]
            );
            findings.push(Diagnostic::warning("insert-transformed", text).at(place.clone()));
        }
        if scale[0] * scale[1] < 0.0 {
            mirrored[index] = true;
            let text = format!("block `{block}` is inserted mirrored; the piece was mirrored");
            findings.push(Diagnostic::warning("insert-mirrored", text).at(place));
            ledger.note(entity.id, Verdict::Interpreted, "mirrored INSERT: the piece is mirrored");
        } else {
            ledger.note(entity.id, Verdict::Accepted, "INSERT of a piece");
        }
    }
    for (name, list) in by_name {
        if list.len() > 1 && !is_model_space(name) {
            let text = format!("{} blocks are called `{name}`; all were read", list.len());
            let place = findings.place_in(name, None, blocks[list[1]].line);
            findings.push(Diagnostic::warning("block-name-repeats", text).at(place));
        }
    }
    mirrored
}

#[allow(clippy::too_many_arguments)]
fn sheets(
    drawing: &Drawing,
    blocks: &[Block],
    by_name: &BTreeMap<String, Vec<usize>>,
    layers: &Layers,
    mm: f64,
    mirrored: &[bool],
    findings: &mut Findings,
    ledger: &mut Ledger,
) -> Vec<(String, u64, Sheet)> {
    let mut sorter = Sorter::new(layers, mm, blocks, by_name, ledger, findings);
    let mut out = Vec::new();
    for (i, block) in blocks.iter().enumerate() {
        if is_model_space(&block.name) {
            for e in &block.entities {
                sorter.ledger.note(e.id, Verdict::Refused, "in the block of a drawing space");
            }
            continue;
        }
        let sheet = sorter.block(i, mirrored[i]);
        if !sheet.boundary.is_empty() {
            out.push((block.name.clone(), block.line, sheet));
        } else if !block.entities.is_empty() {
            let text = format!("block `{}` has no outline on layer 1; it is no piece", block.name);
            let place = sorter.findings.place_in(&block.name, None, block.line);
            sorter.findings.push(Diagnostic::warning("block-without-outline", text).at(place));
        }
    }
    for e in &drawing.entities {
        match &e.shape {
            Shape::Text { value, .. } if texts::key_value(value).is_some() => {
                sorter.ledger.note(e.id, Verdict::Accepted, "style text");
            }
            Shape::Text { .. } if !out.is_empty() => {
                sorter.ledger.note(e.id, Verdict::Interpreted, "text outside the pieces, kept aside")
            }
            _ => {}
        }
    }
    if out.is_empty() {
        return flat(drawing, &mut sorter);
    }
    let loose = drawing.entities.iter().filter(|e| !e.shape.extent().is_empty());
    let mut count = 0_usize;
    for e in loose {
        count += 1;
        sorter.ledger.note(e.id, Verdict::Refused, "line outside any block");
    }
    if count > 0 {
        let text = format!("{count} line(s) stand in ENTITIES outside any block; they were left out");
        let place = sorter.findings.place(1);
        sorter.findings.push(Diagnostic::warning("lines-outside-blocks", text).at(place));
    }
    out
}

/// No block is a piece: the outermost closed lines in ENTITIES are.
fn flat(drawing: &Drawing, sorter: &mut Sorter<'_>) -> Vec<(String, u64, Sheet)> {
    let on_one =
        drawing.entities.iter().any(|e| sorter.layers.role(&e.layer) == Role::Boundary && !e.shape.extent().is_empty());
    // On plain drawings every line may be an outline; with layer 1 in use only those on it.
    let as_boundary = Layers::new(&BTreeMap::new());
    let relabelled: Vec<Entity> = drawing
        .entities
        .iter()
        .filter(|e| !matches!(e.shape, Shape::Insert { .. }))
        .map(|e| {
            let mut e = e.clone();
            if !on_one && !e.shape.extent().is_empty() && as_boundary.role(&e.layer) == Role::Unknown {
                e.layer = "1".into();
            }
            e
        })
        .collect();
    let all = sorter.loose(relabelled.iter());
    let chained = super::chain::chain(all.boundary.clone());
    let mut loops = chained.closed;
    let area = |p: &super::chain::Path| geom::area(&p.positions()).abs();
    loops.sort_by(|a, b| area(b).total_cmp(&area(a)));
    let mut outer: Vec<(Vec<Vec2>, Sheet, u64)> = Vec::new();
    for path in loops.into_iter().take(limits::PIECES + 1).chain(chained.open) {
        let home = outer.iter().position(|(polygon, ..)| geom::inside(path.points[0].0, polygon));
        match home {
            Some(i) => outer[i].1.internal.push(path),
            None => {
                let line = path.line;
                let polygon = path.positions();
                let sheet = Sheet { boundary: vec![path], ..Sheet::default() };
                outer.push((polygon, sheet, line));
            }
        }
    }
    if outer.is_empty() {
        return Vec::new();
    }
    let place = sorter.findings.place(1);
    let text = format!("no block holds an outline; {} closed line(s) of ENTITIES were read as pieces", outer.len());
    sorter.findings.push(Diagnostic::warning("pieces-from-entities", text).at(place));
    share_out(all, &mut outer);
    outer.sort_by_key(|o| o.2);
    outer.into_iter().enumerate().map(|(i, (_, sheet, line))| (format!("PIECE_{}", i + 1), line, sheet)).collect()
}

fn share_out(all: Sheet, outer: &mut [(Vec<Vec2>, Sheet, u64)]) {
    let home = |p: Vec2, outer: &[(Vec<Vec2>, Sheet, u64)]| {
        outer.iter().position(|(polygon, ..)| geom::inside(p, polygon) || geom::distance(p, polygon, true) <= 0.5)
    };
    macro_rules! share {
        ($($field:ident by $at:expr),+) => {$(
            for item in all.$field {
                let at: Vec2 = $at(&item);
                if let Some(i) = home(at, outer) {
                    outer[i].1.$field.push(item);
                }
            }
        )+};
    }
    let first = |p: &super::chain::Path| p.points.first().map_or(Vec2::zeros(), |p| p.0);
    let start = |s: &super::sheet::Stroke| (s.ends[0] + s.ends[1]) * 0.5;
    share!(
        dense by first, sew by first, dense_sew by first, internal by first, cutouts by first,
        turn by |p: &Vec2| *p, curve by |p: &Vec2| *p, marks by |m: &super::sheet::Mark| m.at,
        notch_strokes by start, reference by start, mirror by start, grain by start, drills by start,
        notes by |n: &super::sheet::Note| n.at
    );
}

/// Points and notches stand only in the sample size of a nest: other sizes take them over vertex by vertex.
fn carry_between_sizes(pieces: &mut [DrawnPiece], desk: &mut Desk<'_>) {
    let mut groups: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    for (i, piece) in pieces.iter().enumerate() {
        if let Some(name) = &piece.name {
            groups.entry(name.clone()).or_default().push(i);
        }
    }
    for (name, list) in groups {
        let Some(sample) = list.iter().copied().find(|i| pieces[*i].marked) else { continue };
        if list.len() < 2 {
            continue;
        }
        let sample = pieces[sample].clone();
        let mut failed = Vec::new();
        for i in list {
            if !pieces[i].marked && !pieces[i].take_from_sample(&sample) {
                failed.push(pieces[i].size.clone().unwrap_or_default());
            }
        }
        if !failed.is_empty() {
            let text = format!(
                "the sizes {} of `{name}` have other vertices than the sample size; corners were found by angle and notches are missing there",
                failed.join(", ")
            );
            let place = desk.findings.place_in(&sample.block, None, sample.line);
            desk.findings.push(Diagnostic::warning("sizes-differ-in-vertices", text).at(place));
        }
    }
}

/// A wedge whose legs are as long as the two sides of another piece's point is a place for a godet; and where the file
/// marks its darts by drill holes, a wedge without one is a slit or vent.
fn deny_inserts_and_unmarked(pieces: &mut [DrawnPiece], desk: &mut Desk<'_>) {
    let points: Vec<Vec<[f64; 2]>> = pieces.iter().map(convex_points).collect();
    let drilled = |piece: &DrawnPiece, dart: &DrawnDart| {
        let polygon = [dart.mouth[0], dart.apexes[0], dart.mouth[1]];
        piece.drills.iter().any(|d| {
            (d.ends[0] - dart.apexes[0]).norm() <= 30.0
                && (geom::inside(d.ends[0], &polygon) || geom::distance(d.ends[0], &polygon, true) <= 20.0)
        })
    };
    let notched = |piece: &DrawnPiece, dart: &DrawnDart| {
        dart.mouth.iter().all(|m| piece.notches.iter().any(|n| (n.at - m).norm() <= 12.0))
    };
    let is_wedge = |d: &DrawnDart| d.form == Form::Wedge;
    // A habit needs more than one witness: at least two drilled darts, and no fewer than without.
    let (mut with, mut without) = (0_usize, 0_usize);
    for piece in pieces.iter() {
        for dart in piece.darts.iter().filter(|d| is_wedge(d)) {
            if drilled(piece, dart) { with += 1 } else { without += 1 }
        }
    }
    let habit = with >= 2 && with >= without;
    for i in 0..pieces.len() {
        let (name, size) = (pieces[i].name.clone(), pieces[i].size.clone());
        let verdicts: Vec<Option<&'static str>> = pieces[i]
            .darts
            .iter()
            .map(|dart| {
                if !is_wedge(dart) {
                    return None;
                }
                let legs = [dart.leg_path(0), dart.leg_path(1)];
                let fits = |p: &[f64; 2]| {
                    let near = |a: f64, b: f64| (a - b).abs() <= (0.004 * b).max(0.5);
                    (near(p[0], legs[0]) && near(p[1], legs[1])) || (near(p[0], legs[1]) && near(p[1], legs[0]))
                };
                let other = (0..points.len()).filter(|j| {
                    *j != i && pieces[*j].size == size && (pieces[*j].name.is_none() || pieces[*j].name != name)
                });
                if other.into_iter().any(|j| points[j].iter().any(fits)) {
                    Some("another piece has a point with sides as long as its legs: an insert (godet) goes there")
                } else if habit && !drilled(&pieces[i], dart) && !notched(&pieces[i], dart) {
                    Some("the darts of this file have a drill hole at the apex and this wedge has neither that nor notches at its mouth")
                } else {
                    None
                }
            })
            .collect();
        let mut verdicts = verdicts.into_iter();
        let piece = &mut pieces[i];
        let (label, block) = (piece.label().to_owned(), piece.block.clone());
        piece.darts.retain(|dart| {
            let Some(why) = verdicts.next().flatten() else { return true };
            let at = dart.apexes[0];
            let text =
                format!("the wedge at ({:.1}, {:.1}) mm of `{label}` was not taken as a dart: {why}", at.x, at.y);
            let place = desk.findings.place_in(&block, Some("1"), dart.line);
            let hint = "if it is a dart, declare it in the sewing file: [[dart]] piece, apex, mouth, kind = \"wedge\"";
            desk.findings.push(Diagnostic::warning("wedge-not-a-dart", text).at(place).hint(hint));
            false
        });
    }
}

/// Lengths of the two edges at each sharp convex corner.
fn convex_points(piece: &DrawnPiece) -> Vec<[f64; 2]> {
    let nodes = &piece.sewn().drawn;
    let n = nodes.len();
    let corners: Vec<usize> = (0..n)
        .filter(|i| {
            let turn = geom::turn(nodes[(i + n - 1) % n].at, nodes[*i].at, nodes[(i + 1) % n].at).to_degrees();
            nodes[*i].kind == PointKind::Turn && turn.abs() > 20.0
        })
        .collect();
    let m = corners.len();
    if m < 3 || n > 5000 {
        return Vec::new();
    }
    let run = |from: usize, to: usize| {
        let steps = (to + n - from) % n;
        (0..steps).map(|k| (nodes[(from + k + 1) % n].at - nodes[(from + k) % n].at).norm()).sum::<f64>()
    };
    (0..m)
        .filter_map(|k| {
            let (a, c, b) = (corners[(k + m - 1) % m], corners[k], corners[(k + 1) % m]);
            let turn = geom::turn(nodes[(c + n - 1) % n].at, nodes[c].at, nodes[(c + 1) % n].at).to_degrees();
            // An insert is pointed: 100 degrees or less inside.
            (turn > 80.0).then(|| [run(a, c), run(c, b)])
        })
        .collect()
}

/// One finding per layer and entity type that has no meaning.
fn report_layers(drawing: &Drawing, blocks: &[Block], layers: &Layers, findings: &mut Findings) {
    let mut unknown: BTreeMap<(String, String), (usize, u64)> = BTreeMap::new();
    let all = blocks.iter().filter(|b| !is_model_space(&b.name)).flat_map(|b| &b.entities).chain(&drawing.entities);
    for e in all {
        let odd = match &e.shape {
            Shape::Other(_) => true,
            Shape::Text { .. } | Shape::Insert { .. } | Shape::Attribute => false,
            _ => matches!(layers.role(&e.layer), Role::Unknown | Role::Match | Role::Annotation),
        };
        if odd {
            let entry = unknown.entry((e.layer.clone(), e.shape.name().to_owned())).or_insert((0, e.line));
            entry.0 += 1;
        }
    }
    for ((layer, kind), (count, line)) in unknown {
        let mut place = findings.place(line);
        place.layer = Some(layer.clone());
        let severity = if layers.role(&layer) == Role::Boundary { Severity::Warning } else { Severity::Info };
        let text = format!("{count} {kind} on layer `{layer}` have no meaning here and were left out");
        findings.push(Diagnostic::new(severity, "entities-left-out", text).at(place));
    }
}
