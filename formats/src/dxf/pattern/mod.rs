//! A whole pattern: pieces in sizes, units, ledger and findings.

mod attributes;
mod block_names;
pub(crate) mod codes;
mod inserts;
mod sheets;

pub use inserts::InsertRule;

use crate::dxf::codes::SIZES_DIFFER_IN_VERTICES;
use inserts::Inserted;

use super::checks;
use super::darts;
use super::desk::{Desk, Rules};
use super::findings::Findings;
use super::geom;
use super::layers::{Layers, Role};
use super::ledger::Ledger;
use super::library::Census;
use super::limits;
use super::model::{Block, Drawing, Entity, Shape};
use super::parse;
use super::piece::DrawnPiece;
use super::sheet::{Sheet, Sorter, has_boundary};
use super::texts;
use super::tolerances::Tolerances;
use super::units::{self, Evidence, Units};
use super::vendor::{self, Profile, Vendor};
use std::collections::{BTreeMap, BTreeSet};
use toile_garment::{Diagnostic, Severity};

/// What the user may say about a file.
#[derive(Clone, Debug, Default)]
pub struct ReadOptions {
    /// Millimetres per file unit, overruling the file.
    pub mm_per_unit: Option<f64>,
    /// Layer of the file → layer of the standard.
    pub layers: BTreeMap<String, String>,
    /// Code page of the texts, overruling the file.
    pub code_page: Option<String>,
    /// Writer of the file, overruling the evidence.
    pub vendor: Option<Vendor>,
    /// Tolerances.
    pub tolerances: Tolerances,
    /// What INSERTs do to pieces.
    pub inserts: InsertRule,
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
    /// Who wrote it, and why that is thought.
    pub profile: Profile,
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
    /// How many curves the library read.
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
    let mut drawing = parse::parse(bytes, options.code_page.as_deref(), findings)?;
    let layers = Layers::new(&options.layers);
    let mut ledger = Ledger::new(drawing.entity_count);
    let style_texts = style_texts(&drawing);
    let profile = vendor::detect(&drawing, &layers, &style_texts, options.vendor);
    let mut blocks: Vec<Block> = std::mem::take(&mut drawing.blocks);
    let mut by_name: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    for (i, block) in blocks.iter().enumerate() {
        by_name.entry(block.name.clone()).or_default().push(i);
    }
    attributes::give(&mut drawing, &mut blocks, &by_name, &mut ledger);
    inserts::check_expansion(&blocks, &by_name, findings)?;
    let own = |block: &Block| has_boundary(&layers, block);
    let inserted = inserts::inserts(&drawing, &blocks, &by_name, &own, findings, &mut ledger);
    let sides = Sides { drawing: &drawing, blocks: &blocks, inserted: &inserted, layers: &layers };
    let units = sides.decide_units(&style_texts, options, findings);
    let (mm, flatness) = (units.mm_per_unit, options.tolerances.curve);
    let mut sorter = Sorter::new(&layers, mm, flatness, &blocks, &by_name, &mut ledger, findings);
    let sheets = sheets::sheets(&drawing, &blocks, &mut sorter, &inserted, options.inserts, &options.tolerances);
    let rules = Rules { tolerances: options.tolerances, notch_scale: profile.notch_scale };
    let sample_size = style_texts.get("sample size").cloned().filter(|s| !s.is_empty());
    let pieces = build_pieces(sheets, &rules, sample_size.as_deref(), &mut ledger, findings)?;
    report_layers(&drawing, &blocks, &layers, &ledger, findings);
    ledger.close();
    Ok(Pattern {
        file: file.to_owned(),
        style: style_texts.get("style name").cloned(),
        profile,
        units,
        encoding: drawing.encoding.name(),
        release: drawing.release,
        sizes: sizes_in_order(&pieces),
        sample_size,
        pieces,
        vertices: drawing.vertex_count,
        census: drawing.census,
        findings: Vec::new(),
        ledger,
        style_texts,
    })
}

/// Makes pieces of the sheets: outlines first, then what the sizes take over from each other, then notches and darts.
fn build_pieces(
    sheets: Vec<(String, u64, Sheet)>,
    rules: &Rules,
    sample_size: Option<&str>,
    ledger: &mut Ledger,
    findings: &mut Findings,
) -> Result<Vec<DrawnPiece>, Diagnostic> {
    if sheets.len() > limits::PIECES {
        let text = format!("{} pieces, over the limit of {}", sheets.len(), limits::PIECES);
        return Err(Diagnostic::error(codes::TOO_MANY_PIECES, text).at(findings.place(1)));
    }
    let mut overruled = Vec::new();
    let mut desk = Desk { findings, overruled: &mut overruled, rules };
    let outlines = desk.each(sheets, |(name, line, sheet), desk| DrawnPiece::outline(&name, line, sheet, desk));
    let mut pieces: Vec<DrawnPiece> = outlines.into_iter().flatten().collect();
    if pieces.is_empty() && !desk.findings.has_errors() {
        let text = "there is no piece in this file: no block has a line on layer 1, and ENTITIES holds no closed line";
        return Err(Diagnostic::error(codes::NO_PIECES, text)
            .at(desk.findings.place(1))
            .hint("export as AAMA or ASTM, or map the layer of the outlines to \"1\""));
    }
    block_names::fill(&mut pieces, sample_size, &mut desk);
    carry_between_sizes(&mut pieces, &mut desk);
    desk.each(&mut pieces, DrawnPiece::finish);
    darts::decide(&mut pieces, &mut desk);
    checks::pieces(&pieces, sample_size, &mut desk);
    for (id, verdict, rule) in overruled {
        ledger.overrule(id, verdict, rule);
    }
    Ok(pieces)
}

/// The sizes of all pieces, each once, in file order.
fn sizes_in_order(pieces: &[DrawnPiece]) -> Vec<String> {
    let mut seen = BTreeSet::new();
    pieces.iter().filter_map(|p| p.size.clone()).filter(|size| seen.insert(size.clone())).collect()
}

fn style_texts(drawing: &Drawing) -> BTreeMap<String, String> {
    let mut map = BTreeMap::new();
    for entity in &drawing.entities {
        let Shape::Text { value, .. } = &entity.shape else { continue };
        for (key, value) in value.lines().filter_map(texts::key_value) {
            map.entry(key).or_insert(value);
        }
    }
    map
}

/// What tells how large the pieces are in file units.
struct Sides<'a> {
    drawing: &'a Drawing,
    blocks: &'a [Block],
    inserted: &'a [Inserted],
    layers: &'a Layers,
}

impl Sides<'_> {
    fn side(&self, entities: &[Entity], all: bool) -> f64 {
        let outline = entities.iter().filter(|e| all || self.layers.role(&e.layer) == Role::Boundary);
        geom::bounds(outline.flat_map(|e| e.shape.extent())).map_or(0.0, |(lo, hi)| (hi.x - lo.x).max(hi.y - lo.y))
    }

    fn decide_units(&self, style: &BTreeMap<String, String>, options: &ReadOptions, findings: &mut Findings) -> Units {
        let sides = self.blocks.iter().zip(self.inserted);
        let mut largest =
            sides.map(|(b, i)| self.side(&b.entities, false) * i.growth(options.inserts)).fold(0.0, f64::max);
        if largest <= 0.0 {
            let loose = self.drawing.entities.iter().map(|e| self.side(std::slice::from_ref(e), true));
            largest = loose.fold(0.0, f64::max);
        }
        let tolerance =
            ["tolerance", "curve tolerance"].iter().find_map(|k| style.get(*k)).and_then(|t| t.parse().ok());
        let text = style.get("units").map(String::as_str).filter(|t| !t.is_empty());
        let insunits = self.drawing.insunits;
        let other = text.and_then(|t| self.other_unit(t));
        let evidence = Evidence { asked: options.mm_per_unit, text, other, insunits, tolerance, side: largest };
        units::decide(&evidence, findings)
    }

    /// A second text `Units` that says something else.
    fn other_unit(&self, first: &str) -> Option<String> {
        let lines = self.drawing.entities.iter().filter_map(|e| match &e.shape {
            Shape::Text { value, .. } => Some(value.as_str()),
            _ => None,
        });
        let units = lines.flat_map(str::lines).filter_map(texts::key_value).filter(|(key, _)| key == "units");
        let mut others =
            units.map(|(_, value)| value).filter(|v| !v.is_empty() && texts::unit(v) != texts::unit(first));
        others.next()
    }
}

fn is_model_space(name: &str) -> bool {
    let name = name.trim_start_matches(['$', '*']).to_ascii_lowercase();
    name.starts_with("model_space") || name.starts_with("paper_space")
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
        let Some(sample) = list.iter().copied().find(|i| pieces[*i].points.marked) else { continue };
        if list.len() < 2 {
            continue;
        }
        let sample = pieces[sample].clone();
        let mut failed = Vec::new();
        for i in list {
            if !pieces[i].points.marked && !pieces[i].take_from_sample(&sample) {
                failed.push(pieces[i].size.clone().unwrap_or_default());
            }
        }
        if !failed.is_empty() {
            let text = format!(
                "the sizes {} of `{name}` have other vertices than the sample size; corners were found by angle and notches are missing there",
                failed.join(", ")
            );
            let place = desk.findings.place_in(&sample.block, None, sample.line);
            desk.findings.push(Diagnostic::warning(SIZES_DIFFER_IN_VERTICES, text).at(place));
        }
    }
}

/// One finding per layer and entity type that has no meaning.
fn report_layers(drawing: &Drawing, blocks: &[Block], layers: &Layers, ledger: &Ledger, findings: &mut Findings) {
    let mut unknown: BTreeMap<(String, String), (usize, u64)> = BTreeMap::new();
    let all = blocks.iter().filter(|b| !is_model_space(&b.name)).flat_map(|b| &b.entities).chain(&drawing.entities);
    for e in all {
        let odd = match &e.shape {
            Shape::Other(_) => true,
            Shape::Text { .. } | Shape::Insert { .. } | Shape::Attribute { .. } => false,
            _ => matches!(layers.role(&e.layer), Role::Unknown | Role::Annotation),
        };
        if odd && !ledger.used(e.id) {
            let entry = unknown.entry((e.layer.clone(), e.shape.name().to_owned())).or_insert((0, e.line));
            entry.0 += 1;
        }
    }
    for ((layer, kind), (count, line)) in unknown {
        let mut place = findings.place(line);
        place.layer = Some(layer.clone());
        let severity = if layers.role(&layer) == Role::Boundary { Severity::Warning } else { Severity::Info };
        let text = format!("{count} {kind} on layer `{layer}` have no meaning here and were left out");
        findings.push(Diagnostic::new(severity, codes::ENTITIES_LEFT_OUT, text).at(place));
    }
}
