//! A whole pattern: pieces in sizes, units, ledger and findings.

mod attributes;
mod block_names;
pub(crate) mod codes;
mod flat;
mod frames;
mod inserts;
mod layer_names;
mod nest_findings;
mod sheets;
mod titles;

pub use inserts::InsertRule;

use crate::dxf::codes::SIZES_DIFFER_IN_VERTICES;
use block_names::Named;
use inserts::Inserted;
use layer_names::LayerNames;
use sheets::Draft;

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
use super::outline::Outline;
use super::parse;
use super::piece::SEW_LINE_ON_8;
use super::piece::{DrawnPiece, PieceTexts, RefusedPiece, in_file_order};
use super::sheet::{FOREIGN_DRILL, FOREIGN_NOTCH, Sorter, has_boundary};
use super::texts;
use super::tolerances::Tolerances;
use super::units::{self, Evidence, Units};
use super::vendor::{self, Profile, Vendor};
use std::collections::{BTreeMap, BTreeSet};
use toile_garment::{Diagnostic, Severity, SourceRef};

/// Most keys that are listed in a finding.
const KEYS: usize = 40;

/// The user's own word about a file.
#[derive(Clone, Debug, Default)]
pub struct ReadOptions {
    /// Millimetres per file unit, overruling the file.
    pub mm_per_unit: Option<f64>,
    /// Unit that the rule table beside the file names, in its words.
    pub rule_units: Option<String>,
    /// Layer of the file → layer of the standard.
    pub layers: BTreeMap<String, String>,
    /// Code page of the texts, overruling the file.
    pub code_page: Option<String>,
    /// Writer of the file, overruling the evidence.
    pub vendor: Option<Vendor>,
    /// Tolerances.
    pub tolerances: Tolerances,
    /// The parts of INSERTs that are applied to pieces.
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
    /// Pieces and sizes that are drawn too wrongly to be used, in file order.
    pub refused: Vec<RefusedPiece>,
    /// The verdict on every entity.
    pub ledger: Ledger,
    /// Number of polyline vertices in the file.
    pub vertices: u64,
    /// How many curves the library read.
    pub census: Census,
    /// Findings; none is an error but that of a unit to be confirmed. Others stand with the pieces that are refused.
    pub findings: Vec<Diagnostic>,
}

impl Pattern {
    /// All findings: those of the file, and the errors of the pieces that cannot be used.
    #[must_use]
    pub fn all_findings(&self) -> Vec<Diagnostic> {
        let faults = self.refused.iter().flat_map(|p| &p.faults);
        faults.chain(&self.findings).cloned().collect()
    }

    /// The findings to be read by a person: as all, but those of the file in the sample size alone.
    #[must_use]
    pub fn told_findings(&self) -> Vec<Diagnostic> {
        let faults = self.refused.iter().flat_map(|p| &p.faults);
        faults.cloned().chain(self.findings_of_size(None)).collect()
    }

    /// Can any piece of it be imported?
    #[must_use]
    pub fn is_usable(&self) -> bool {
        !self.pieces.is_empty() && self.units.unlikely_guess.is_none()
    }

    /// Says which pieces cannot be used, whether they are asked for or not.
    #[must_use]
    pub fn set_aside(&self) -> Option<Diagnostic> {
        let first = self.refused.first()?;
        let one = |p: &RefusedPiece| {
            let codes: Vec<&str> = p.faults.iter().map(|f| f.code.as_str()).collect();
            let size = p.size.as_ref().map_or_else(String::new, |s| format!(" in size {s}"));
            format!("`{}`{size} ({})", p.label(), codes.join(", "))
        };
        let list: Vec<String> = self.refused.iter().map(one).collect();
        let text = format!("{} piece(s) of this file cannot be used: {}", list.len(), list.join(", "));
        let place = SourceRef { block: Some(first.block.clone()), ..SourceRef::file(&self.file).at_line(first.line) };
        Some(Diagnostic::info(codes::PIECES_REFUSED, text).at(place).hint("`toile inspect` shows them"))
    }
}

/// Reads a pattern. Pieces that are drawn too wrongly to be used are set aside; the others can be used all the same.
///
/// # Errors
/// All findings, at least one of them an error: the file cannot be read, or no piece of it can be used.
pub fn read(bytes: &[u8], file: &str, options: &ReadOptions) -> Result<Pattern, Vec<Diagnostic>> {
    let pattern = read_all(bytes, file, options)?;
    if pattern.is_usable() {
        return Ok(pattern);
    }
    let faults = pattern.refused.into_iter().flat_map(|p| p.faults);
    Err(worst_first(pattern.findings.into_iter().chain(faults).collect()))
}

/// Reads a pattern as [`read`] does, even where no piece of it can be used.
pub(crate) fn read_all(bytes: &[u8], file: &str, options: &ReadOptions) -> Result<Pattern, Vec<Diagnostic>> {
    let mut findings = Findings::new(file);
    match read_into(bytes, file, options, &mut findings) {
        Ok(mut pattern) if !findings.has_errors() => {
            let unconfirmed = pattern.units.unconfirmed().map(|f| f.at(SourceRef::file(file).at_line(1)));
            pattern.findings = findings.finish().into_iter().chain(unconfirmed).collect();
            Ok(pattern)
        }
        Ok(pattern) => {
            let faults = pattern.refused.into_iter().flat_map(|p| p.faults);
            Err(worst_first(findings.finish().into_iter().chain(faults).collect()))
        }
        Err(error) => Err(worst_first(findings.finish().into_iter().chain([error]).collect())),
    }
}

fn worst_first(mut list: Vec<Diagnostic>) -> Vec<Diagnostic> {
    list.sort_by_key(|f| std::cmp::Reverse(f.severity));
    list
}

fn read_into(bytes: &[u8], file: &str, options: &ReadOptions, findings: &mut Findings) -> Result<Pattern, Diagnostic> {
    let mut drawing = parse::parse(bytes, options.code_page.as_deref(), findings)?;
    let layers = Layers::new(&options.layers);
    let layer_names = LayerNames::of_file(&drawing);
    layer_names.check_table(&options.layers, findings);
    let mut ledger = Ledger::new(drawing.entity_count);
    let style_texts = style_texts(&drawing, findings);
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
    let drafts = sheets::sheets(&drawing, &blocks, &mut sorter, &inserted, options.inserts, &options.tolerances);
    let rules = Rules { tolerances: options.tolerances, notch_scale: profile.notch_scale };
    let sample_size = style_texts.get("sample size").cloned().filter(|s| !s.is_empty());
    if drafts.is_empty() && !findings.has_errors() {
        let text = "there is no piece in this file: no block has a line on layer 1, and ENTITIES holds no closed line";
        return Err(Diagnostic::error(codes::NO_PIECES, text).at(findings.place(1)).hint(layer_names.remedy()));
    }
    let (pieces, refused) = build_pieces(drafts, &rules, sample_size.as_deref(), &mut ledger, findings)?;
    report_keys(&pieces, findings);
    report_foreign_lines(&ledger, findings);
    report_layers(&drawing, &blocks, &layers, &ledger, findings);
    ledger.close();
    Ok(Pattern {
        file: file.to_owned(),
        style: style_texts.get("style name").cloned(),
        profile,
        units,
        encoding: drawing.encoding.name(),
        release: drawing.release,
        sizes: sizes_in_order(&pieces, &refused),
        sample_size,
        pieces,
        refused,
        vertices: drawing.vertex_count,
        census: drawing.census,
        findings: Vec::new(),
        ledger,
        style_texts,
    })
}

/// Makes pieces of the sheets: outlines first, then what the sizes take over from each other, then notches and darts.
/// Pieces with errors are set aside.
fn build_pieces(
    drafts: Vec<Draft>,
    rules: &Rules,
    sample_size: Option<&str>,
    ledger: &mut Ledger,
    findings: &mut Findings,
) -> Result<(Vec<DrawnPiece>, Vec<RefusedPiece>), Diagnostic> {
    if drafts.len() > limits::PIECES {
        let text = format!("{} pieces, over the limit of {}", drafts.len(), limits::PIECES);
        return Err(Diagnostic::error(codes::TOO_MANY_PIECES, text).at(findings.place(1)));
    }
    let mut overruled = Vec::new();
    let mut desk = Desk { findings, overruled: &mut overruled, rules };
    let outlined = desk.each(drafts, Draft::outlined);
    let (mut pieces, mut refused) = apart(outlined);
    block_names::fill(named(&mut pieces, &mut refused), sample_size, &mut desk);
    carry_between_sizes(&mut pieces, &mut desk);
    carry_texts(&mut pieces);
    desk.each(&mut pieces, DrawnPiece::prepare);
    share_cut_notches(&mut pieces);
    let finished = desk.each(pieces, |mut piece, desk| {
        piece.finish(desk);
        let faults = desk.findings.take_errors(|_| true);
        if faults.is_empty() { Ok(piece) } else { Err(piece.refuse(faults)) }
    });
    let (mut pieces, spoilt) = apart(finished);
    refused.extend(spoilt);
    refused.sort_by_key(|r| r.line);
    darts::decide(&mut pieces, &mut desk);
    checks::pieces(&pieces, &refused, sample_size, &mut desk);
    for (id, verdict, rule) in overruled {
        ledger.overrule(id, verdict, rule);
    }
    Ok((pieces, refused))
}

impl Draft {
    /// The piece with its outline, or set aside with all its faults.
    fn outlined(self, desk: &mut Desk<'_>) -> Result<DrawnPiece, RefusedPiece> {
        let made = DrawnPiece::outline(&self.block, self.line, self.sheet, desk);
        let faults: Vec<Diagnostic> = self.faults.into_iter().chain(desk.findings.take_errors(|_| true)).collect();
        match made {
            Ok(piece) if faults.is_empty() => Ok(piece),
            Ok(piece) => Err(piece.refuse(faults)),
            Err(refused) => Err(RefusedPiece { faults, ..refused }),
        }
    }
}

/// The sound pieces, and those set aside.
fn apart(list: Vec<Result<DrawnPiece, RefusedPiece>>) -> (Vec<DrawnPiece>, Vec<RefusedPiece>) {
    let (mut pieces, mut refused) = (Vec::new(), Vec::new());
    for piece in list {
        match piece {
            Ok(piece) => pieces.push(piece),
            Err(piece) => refused.push(piece),
        }
    }
    (pieces, refused)
}

/// All pieces in file order, to be named.
fn named<'a>(pieces: &'a mut [DrawnPiece], refused: &'a mut [RefusedPiece]) -> Vec<Named<'a>> {
    let sound = pieces.iter_mut().map(|p| (&p.block, p.line, &mut p.name, &mut p.size));
    let others = refused.iter_mut().map(|p| (&p.block, p.line, &mut p.name, &mut p.size));
    let named = |(block, line, name, size): (&'a String, u64, _, _)| (line, Named { block, line, name, size });
    in_file_order(sound.map(named), others.map(named))
}

/// The sizes of all pieces, each once, in file order.
fn sizes_in_order(pieces: &[DrawnPiece], refused: &[RefusedPiece]) -> Vec<String> {
    let all = in_file_order(pieces.iter().map(|p| (p.line, &p.size)), refused.iter().map(|p| (p.line, &p.size)));
    let mut seen = BTreeSet::new();
    all.into_iter().flatten().filter(|size| seen.insert(*size)).cloned().collect()
}

/// The texts of the style by key. Keys of other programs, and texts without a colon, stand for those of the standard
/// that the file does not have; they are told.
fn style_texts(drawing: &Drawing, findings: &mut Findings) -> BTreeMap<String, String> {
    let mut map = BTreeMap::new();
    let mut foreign = BTreeMap::new();
    for line in drawing.entities.iter().filter_map(text_of).flat_map(str::lines) {
        if let Some((key, value)) = texts::key_value(line) {
            if let Some(own) = texts::foreign_style_key(&key).filter(|_| !value.is_empty()) {
                foreign.entry(own).or_insert((format!("`{key}`"), Some(key.clone()), value.clone()));
            }
            map.entry(key).or_insert(value);
        } else if let Some((own @ ("units" | "sample size"), value)) = texts::without_colon(line) {
            foreign.entry(own).or_insert((format!("`{}`", line.trim()), None, value));
        }
    }
    foreign.retain(|own, _| map.get(*own).is_none_or(String::is_empty));
    let mut read = Vec::new();
    for (own, (name, key, value)) in foreign {
        read.push(format!("{name} as `{own}`"));
        key.and_then(|k| map.remove(&k));
        map.insert(own.to_owned(), value);
    }
    if !read.is_empty() {
        let text = format!("texts of the style are not written as in the standards; read were {}", read.join(", "));
        findings.push(Diagnostic::info(codes::TEXT_KEY_FOREIGN, text).at(findings.place(1)));
    }
    map
}

fn text_of(entity: &Entity) -> Option<&str> {
    match &entity.shape {
        Shape::Text { value, .. } => Some(value.as_str()),
        _ => None,
    }
}

/// The evidence on how large the pieces are in file units.
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
        let rules = options.rule_units.as_deref();
        let evidence = Evidence { asked: options.mm_per_unit, text, other, insunits, rules, tolerance, side: largest };
        units::decide(&evidence, findings)
    }

    /// A second text `Units` that says something else.
    fn other_unit(&self, first: &str) -> Option<String> {
        let lines = self.drawing.entities.iter().filter_map(text_of);
        let is_unit = |key: &str| key == "units" || texts::foreign_style_key(key) == Some("units");
        let units = lines.flat_map(str::lines).filter_map(texts::key_value).filter(|(key, _)| is_unit(key));
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

/// A notch that is cut into the outline in one size is one in all sizes with as many vertices.
fn share_cut_notches(pieces: &mut [DrawnPiece]) {
    fn cut(piece: &mut DrawnPiece) -> Option<&mut Outline> {
        Some(&mut piece.boundary)
    }
    fn sewn(piece: &mut DrawnPiece) -> Option<&mut Outline> {
        piece.sew.as_mut()
    }
    for line in [cut as fn(&mut DrawnPiece) -> Option<&mut Outline>, sewn] {
        let mut known: BTreeMap<(String, usize), BTreeSet<(usize, usize)>> = BTreeMap::new();
        for piece in pieces.iter_mut() {
            let Some(name) = piece.name.clone() else { continue };
            let Some(outline) = line(piece) else { continue };
            let ends = outline.cut.iter().map(|c| (c.from, c.to));
            known.entry((name, outline.drawn.len())).or_default().extend(ends);
        }
        for piece in pieces.iter_mut() {
            let Some(name) = piece.name.clone() else { continue };
            let Some(outline) = line(piece) else { continue };
            if let Some(known) = known.get(&(name, outline.drawn.len())).filter(|k| k.len() > outline.cut.len()) {
                outline.add_cut_notches(known);
            }
        }
    }
}

/// Quantity, material and the like hold for every size that does not say them itself.
fn carry_texts(pieces: &mut [DrawnPiece]) {
    let mut said: BTreeMap<String, PieceTexts> = BTreeMap::new();
    for piece in pieces.iter() {
        let Some(name) = &piece.name else { continue };
        let all = said.entry(name.clone()).or_default();
        if piece.texts.quantity_told && !all.quantity_told {
            (all.quantity, all.quantity_told) = (piece.texts.quantity, true);
        }
        for (key, value) in &piece.texts.keys {
            all.keys.entry(key.clone()).or_insert_with(|| value.clone());
        }
    }
    for piece in pieces {
        let Some(all) = piece.name.as_ref().and_then(|n| said.get(n)) else { continue };
        if all.quantity_told && !piece.texts.quantity_told {
            piece.texts.quantity = all.quantity;
        }
        for (key, value) in &all.keys {
            piece.texts.keys.entry(key.clone()).or_insert_with(|| value.clone());
        }
    }
}

/// Keys of texts that other programs use, and keys without a meaning here.
fn report_keys(pieces: &[DrawnPiece], findings: &mut Findings) {
    let Some(first) = pieces.first() else { return };
    let place = |findings: &Findings| findings.place_in(&first.block, Some("1"), first.line);
    let list = |keys: BTreeSet<String>| keys.iter().map(|k| format!("`{k}`")).collect::<Vec<_>>().join(", ");
    let foreign: BTreeSet<String> = pieces.iter().flat_map(|p| p.texts.foreign.iter().cloned()).collect();
    if !foreign.is_empty() {
        let text = format!(
            "the keys {} of piece texts are those of another standard; they were read, and are written as the standards \
             call them",
            list(foreign)
        );
        let at = place(findings);
        findings.push(Diagnostic::info(codes::TEXT_KEY_FOREIGN, text).at(at));
    }
    let without_colon: BTreeSet<String> =
        pieces.iter().flat_map(|p| p.texts.without_colon.iter().cloned()).take(KEYS).collect();
    if !without_colon.is_empty() {
        let text = format!(
            "the texts {} of pieces have no colon behind their key; they were read as if they had",
            list(without_colon)
        );
        let at = place(findings);
        findings.push(Diagnostic::info(codes::TEXT_KEY_FOREIGN, text).at(at));
    }
    let others = pieces.iter().flat_map(|p| &p.texts.others).filter_map(|(_, _, text)| texts::key_value(text));
    let unknown: BTreeSet<String> = others.map(|(key, _)| key).filter(|key| !texts::is_known(key)).take(KEYS).collect();
    if !unknown.is_empty() {
        let text =
            format!("the keys {} of piece texts have no meaning here; the texts were kept as they are", list(unknown));
        let at = place(findings);
        findings.push(Diagnostic::info(codes::TEXT_KEY_UNKNOWN, text).at(at));
    }
}

/// Lines that other programs draw on layers that hold points here, and what they were read as.
fn report_foreign_lines(ledger: &Ledger, findings: &mut Findings) {
    for ((_, rule), count) in ledger.by_rule() {
        if [FOREIGN_NOTCH, FOREIGN_DRILL, SEW_LINE_ON_8].contains(&rule) {
            let place = findings.place(1);
            let on_14 = if rule == SEW_LINE_ON_8 { "; sew lines are written on layer 14" } else { "" };
            let text = format!("{count} × {rule}, as some programs draw them{on_14}");
            findings.push(Diagnostic::info(codes::LAYER_FOREIGN, text).at(place));
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
            _ => matches!(layers.role(&e.layer), Role::Unknown | Role::Annotation) || ledger.is_without_role(e.id),
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
