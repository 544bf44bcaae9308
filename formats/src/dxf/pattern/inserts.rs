//! The INSERTs: how often, how large and on which side each piece is laid out.
//!
//! An INSERT's scale and mirroring change the shape of the piece and are applied. Its place and its turn only lay the
//! piece on the table, so the piece keeps the coordinates of its block. [`InsertRule`] can say otherwise.

use super::codes;
use super::is_model_space;
use crate::dxf::codes::{
    BLOCK_MISSING, INSERT_MIRRORED, INSERT_RECURSIVE, INSERT_TOO_DEEP, INSERT_TOO_MANY, INSERT_TRANSFORMED,
};
use crate::dxf::findings::Findings;
use crate::dxf::ledger::{Ledger, Verdict};
use crate::dxf::limits;
use crate::dxf::model::{Block, Drawing, Entity, Shape};
use crate::dxf::sheet::Placing;
use std::collections::{BTreeMap, BTreeSet};
use toile_garment::Diagnostic;

/// The parts of an INSERT that are applied to the piece it places.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum InsertRule {
    /// Scale and mirroring are applied, place and turn are not.
    #[default]
    Shape,
    /// Everything is applied: the pieces lie as on the drawing.
    Placed,
    /// Pieces are read as drawn in their blocks.
    Ignored,
}

/// How a block is inserted.
#[derive(Clone, Debug, Default)]
pub(super) struct Inserted {
    /// Placings of its first INSERT, the innermost first.
    pub chain: Vec<Placing>,
    /// How often as drawn.
    pub plain: u32,
    /// How often mirrored.
    pub mirrored: u32,
    /// True where it is only a part of other blocks.
    pub part: bool,
    /// True where it only holds INSERTs of pieces.
    pub assembly: bool,
    /// Later INSERTs whose scale is not that of the first, and the line of the first of them.
    pub other_scale: (u32, u64),
    /// INSERTs that mirror, and their entities.
    pub mirroring: Vec<u32>,
}

impl Inserted {
    /// Scale of the first INSERT, through all levels; both positive.
    fn scale(&self) -> [f64; 2] {
        scale_of(&self.chain)
    }

    /// Larger factor of the first INSERT.
    pub fn growth(&self, rule: InsertRule) -> f64 {
        let [x, y] = self.scale();
        if rule == InsertRule::Ignored { 1.0 } else { x.max(y) }
    }

    /// The placings to be applied to the points of the block, file units.
    pub fn placings(&self, block: &Block, rule: InsertRule) -> Vec<Placing> {
        match rule {
            InsertRule::Ignored => Vec::new(),
            InsertRule::Placed => self.chain.clone(),
            InsertRule::Shape => {
                let [x, y] = self.scale();
                let side = if self.mirrored > 0 && self.plain == 0 { -1.0 } else { 1.0 };
                let scale = [side * x, y];
                if scale == [1.0, 1.0] {
                    return Vec::new();
                }
                vec![Placing { base: block.base, scale, angle: 0.0, at: block.base }]
            }
        }
    }
}

/// Scale of an INSERT through all levels; both positive.
fn scale_of(chain: &[Placing]) -> [f64; 2] {
    // A quarter turn swaps the axes of what is scaled after it.
    let quarter = |p: &Placing| {
        let off = libm::fmod(p.angle.abs(), std::f64::consts::PI) - std::f64::consts::FRAC_PI_2;
        off.abs() < std::f64::consts::FRAC_PI_4
    };
    let mut scale = [1.0_f64, 1.0];
    for placing in chain {
        scale = [scale[0] * placing.scale[0].abs(), scale[1] * placing.scale[1].abs()];
        if quarter(placing) {
            scale.swap(0, 1);
        }
    }
    if chain.iter().filter(|p| quarter(p)).count() % 2 == 1 {
        scale.swap(0, 1);
    }
    scale
}

/// Refuses blocks in blocks that would place too many entities, before any is expanded.
pub(super) fn check_expansion(
    blocks: &[Block],
    by_name: &BTreeMap<String, Vec<usize>>,
    findings: &Findings,
) -> Result<(), Diagnostic> {
    let target = |e: &Entity| match &e.shape {
        Shape::Insert { block, .. } => by_name.get(block).and_then(|list| list.first()).copied(),
        _ => None,
    };
    let inside: Vec<Vec<usize>> = blocks.iter().map(|b| b.entities.iter().filter_map(target).collect()).collect();
    let mut placed = vec![0_usize; blocks.len()];
    for _ in 0..limits::INSERT_DEPTH {
        let one = |t: &usize| placed[*t].saturating_add(blocks[*t].entities.len());
        placed = inside.iter().map(|list| list.iter().map(one).fold(0, usize::saturating_add)).collect();
    }
    let Some(worst) = (0..blocks.len()).find(|i| placed[*i] > limits::EXPANDED) else { return Ok(()) };
    let text = format!(
        "the INSERTs inside block `{}` place more than {} entities, over the limit",
        blocks[worst].name,
        limits::EXPANDED
    );
    let place = findings.place_in(&blocks[worst].name, None, blocks[worst].line);
    let hint = "export the pieces as blocks of their own, without blocks in blocks";
    Err(Diagnostic::error(INSERT_TOO_MANY, text).at(place).hint(hint))
}

/// Counts the INSERTs of ENTITIES by name, to tell the block of each where several blocks have its name. The n-th
/// INSERT of a name places the n-th block of this name; all later ones place the last.
#[derive(Debug, Default)]
pub(super) struct Turns(BTreeMap<String, usize>);

impl Turns {
    /// The block of the next INSERT of a name, of those called so, and whether no INSERT placed it before.
    pub fn next(&mut self, name: &str, named: &[usize]) -> (usize, bool) {
        let turn = self.0.entry(name.to_owned()).or_insert(0);
        *turn += 1;
        (named[(*turn).min(named.len()) - 1], *turn <= named.len())
    }
}

/// The blocks and which are inserted where.
struct Walk<'a, 'f> {
    blocks: &'a [Block],
    by_name: &'a BTreeMap<String, Vec<usize>>,
    /// Does the block hold an outline itself?
    own: &'a dyn Fn(&Block) -> bool,
    out: Vec<Inserted>,
    turns: Turns,
    steps: usize,
    findings: &'f mut Findings,
}

/// Looks at all INSERTs; one entry per block.
pub(super) fn inserts(
    drawing: &Drawing,
    blocks: &[Block],
    by_name: &BTreeMap<String, Vec<usize>>,
    own: &dyn Fn(&Block) -> bool,
    findings: &mut Findings,
    ledger: &mut Ledger,
) -> Vec<Inserted> {
    let mut walk = Walk {
        blocks,
        by_name,
        own,
        out: vec![Inserted::default(); blocks.len()],
        turns: Turns::default(),
        steps: 0,
        findings,
    };
    walk.mark_parts(drawing);
    for entity in &drawing.entities {
        walk.top(entity, ledger);
    }
    // Blocks of pieces that nothing inserts stand for a table of their own.
    for index in 0..blocks.len() {
        if walk.out[index].assembly && !walk.out[index].part && walk.out[index].plain + walk.out[index].mirrored == 0 {
            walk.inside(index, &[], &mut vec![index], ledger);
        }
    }
    // A piece that is also inserted as drawn is not mirrored: its mirrored INSERTs only count.
    for inserted in walk.out.iter().filter(|i| i.plain > 0) {
        for id in &inserted.mirroring {
            ledger.overrule(*id, Verdict::Interpreted, "mirrored INSERT of a piece also inserted as drawn: counted");
        }
    }
    walk.say();
    walk.out
}

/// Says what is lost of a block that is inserted several times, each time otherwise.
fn repeated(block: &Block, inserted: &Inserted) -> Option<Diagnostic> {
    let n = inserted.plain + inserted.mirrored;
    let text = if inserted.other_scale.0 > 0 {
        format!(
            "block `{}` is inserted {n} times, and {} of the INSERTs have another scale (line {}) than the first; the piece has the scale of the first only",
            block.name, inserted.other_scale.0, inserted.other_scale.1
        )
    } else if inserted.plain > 0 && inserted.mirrored > 0 && !inserted.assembly {
        format!(
            "block `{}` is inserted {} times as drawn and {} times mirrored; it was read as one piece, as drawn, and the INSERTs were only counted",
            block.name, inserted.plain, inserted.mirrored
        )
    } else {
        return None;
    };
    let hint = "give each shape a block of its own, or the text `Quantity: 1,1` for a piece and its mirror image";
    Some(Diagnostic::warning(codes::INSERT_REPEATED, text).hint(hint))
}

impl<'a> Walk<'a, '_> {
    fn named(&self, block: &str) -> Option<usize> {
        self.by_name.get(block).and_then(|list| list.first()).copied()
    }

    /// Which blocks are parts of others, and which only hold several pieces.
    fn mark_parts(&mut self, drawing: &Drawing) {
        let from_table: BTreeSet<usize> = drawing.entities.iter().filter_map(|e| self.target(e)).collect();
        let mut outlines: Vec<Option<u32>> = vec![None; self.blocks.len()];
        for i in 0..self.blocks.len() {
            self.count(i, &mut outlines, 0);
        }
        for (i, block) in self.blocks.iter().enumerate() {
            let own = (self.own)(block);
            self.out[i].assembly = !own && outlines[i].unwrap_or(0) > 1 && !is_model_space(&block.name);
        }
        for (i, block) in self.blocks.iter().enumerate() {
            let targets: Vec<usize> =
                block.entities.iter().filter_map(|e| self.target(e)).filter(|t| *t != i).collect();
            for target in targets {
                let taken = !self.out[i].assembly && !is_model_space(&block.name);
                let piece = (self.own)(&self.blocks[target]) && (self.own)(block);
                self.out[target].part |= taken && !piece && !from_table.contains(&target);
            }
        }
    }

    fn target(&self, entity: &Entity) -> Option<usize> {
        if let Shape::Insert { block, .. } = &entity.shape { self.named(block) } else { None }
    }

    /// Number of outlines in a block and in what it inserts, at most 2.
    fn count(&self, index: usize, memo: &mut Vec<Option<u32>>, depth: usize) -> u32 {
        if let Some(known) = memo[index] {
            return known;
        }
        // Against loops: while a block is being counted it counts as nothing.
        memo[index] = Some(0);
        let mut n = u32::from((self.own)(&self.blocks[index]));
        if n == 0 && depth < limits::INSERT_DEPTH {
            for entity in &self.blocks[index].entities {
                n += self.target(entity).map_or(0, |t| self.count(t, memo, depth + 1));
                if n > 1 {
                    break;
                }
            }
        }
        memo[index] = Some(n.min(2));
        n.min(2)
    }

    /// An INSERT of ENTITIES.
    fn top(&mut self, entity: &'a Entity, ledger: &mut Ledger) {
        let Shape::Insert { block, .. } = &entity.shape else { return };
        let Some(named) = self.by_name.get(block) else {
            let text = format!("an INSERT names block `{block}`, which is not in the file");
            let place = self.findings.place_in(block, Some(&entity.layer), entity.line);
            self.findings.push(Diagnostic::warning(BLOCK_MISSING, text).at(place));
            ledger.note(entity.id, Verdict::Refused, "INSERT of a block that is missing");
            return;
        };
        let (index, _) = self.turns.next(block, named);
        self.place(entity, index, &[], &mut vec![index], ledger);
    }

    /// Notes one INSERT; goes on into blocks that only hold pieces.
    fn place(
        &mut self,
        entity: &'a Entity,
        index: usize,
        outer: &[Placing],
        path: &mut Vec<usize>,
        ledger: &mut Ledger,
    ) {
        self.steps += 1;
        let Shape::Insert { at, scale, rotation, .. } = &entity.shape else { return };
        let angle = rotation.to_radians();
        let mut chain = vec![Placing { base: self.blocks[index].base, scale: *scale, angle, at: *at }];
        chain.extend_from_slice(outer);
        if self.out[index].assembly {
            ledger.note(entity.id, Verdict::Interpreted, "INSERT of a block of several pieces");
            self.out[index].plain += 1;
            return self.inside(index, &chain, path, ledger);
        }
        let mirrored = chain.iter().filter(|p| p.scale[0] * p.scale[1] < 0.0).count() % 2 == 1;
        let entry = &mut self.out[index];
        if entry.plain + entry.mirrored == 0 {
            entry.chain = chain;
        } else {
            let ([x, y], [u, v]) = (entry.scale(), scale_of(&chain));
            if (x - u).abs() > 1e-6 || (y - v).abs() > 1e-6 {
                let first = if entry.other_scale.0 == 0 { entity.line } else { entry.other_scale.1 };
                entry.other_scale = (entry.other_scale.0 + 1, first);
                entry.plain += u32::from(!mirrored);
                entry.mirrored += u32::from(mirrored);
                ledger.note(entity.id, Verdict::Interpreted, "INSERT of a piece again: counted, its scale left out");
                return;
            }
        }
        if mirrored {
            entry.mirrored += 1;
            entry.mirroring.push(entity.id);
            ledger.note(entity.id, Verdict::Interpreted, "mirrored INSERT: the piece is mirrored");
        } else {
            entry.plain += 1;
            ledger.note(entity.id, Verdict::Accepted, "INSERT of a piece");
        }
    }

    /// The INSERTs inside a block of pieces.
    fn inside(&mut self, index: usize, chain: &[Placing], path: &mut Vec<usize>, ledger: &mut Ledger) {
        let blocks = self.blocks;
        for entity in &blocks[index].entities {
            let Some(target) = self.target(entity) else { continue };
            let place = self.findings.place_in(&blocks[index].name, Some(&entity.layer), entity.line);
            if self.steps > limits::EXPANDED {
                if self.steps == limits::EXPANDED + 1 {
                    self.steps += 1;
                    let text = format!("the INSERTs of this file expand to more than {} entities", limits::EXPANDED);
                    self.findings.push(Diagnostic::error(INSERT_TOO_MANY, text).at(place));
                }
                return;
            }
            let loops = path.contains(&target);
            if loops || path.len() >= limits::INSERT_DEPTH {
                let (code, why) = if loops {
                    (INSERT_RECURSIVE, "it would insert itself")
                } else {
                    (INSERT_TOO_DEEP, "blocks are nested too deeply")
                };
                let text = format!("the INSERT inside block `{}` was left out: {why}", blocks[index].name);
                self.findings.push(Diagnostic::warning(code, text).at(place));
                ledger.note(entity.id, Verdict::Refused, "INSERT inside a block, not expanded");
                continue;
            }
            path.push(target);
            self.place(entity, target, chain, path, ledger);
            path.pop();
        }
    }

    /// Says which pieces no INSERT places, where others have one. They are read all the same.
    fn say_not_inserted(&mut self) {
        let is_placed = |i: &Inserted| i.plain + i.mirrored > 0;
        if !self.out.iter().any(is_placed) {
            return;
        }
        let has_none = |(block, i): &(&Block, &Inserted)| !is_placed(i) && !i.part && !i.assembly && (self.own)(block);
        let without: Vec<&Block> = self.blocks.iter().zip(&self.out).filter(has_none).map(|(block, _)| block).collect();
        let Some(first) = without.first() else { return };
        let text = format!(
            "{} block(s) with an outline are not placed by an INSERT, as `{}`; they were read as pieces all the same",
            without.len(),
            first.name
        );
        let place = self.findings.place_in(&first.name, None, first.line);
        let finding = Diagnostic::info(codes::BLOCK_NOT_INSERTED, text).at(place);
        self.findings.push(finding.hint("leave pieces that are not meant out with `pieces` of `import-dxf`"));
    }

    /// Says how INSERTs changed pieces, which pieces have none, and which names repeat.
    fn say(&mut self) {
        self.say_not_inserted();
        for (block, inserted) in self.blocks.iter().zip(&self.out) {
            let place = self.findings.place_in(&block.name, None, block.line);
            let turned = inserted.chain.iter().any(|p| libm::fmod(p.angle.abs(), std::f64::consts::TAU) > 1e-8);
            let [x, y] = inserted.scale();
            let scaled = (x - 1.0).abs() > 1e-6 || (y - 1.0).abs() > 1e-6;
            if scaled || turned {
                let degrees = inserted.chain.iter().map(|p| p.angle.to_degrees()).sum::<f64>();
                let text = format!(
                    "block `{}` is inserted with scale {x} × {y} and turned by {degrees}°; the scale was applied, the turn only lays the piece out",
                    block.name
                );
                let hint = "`inserts = \"placed\"` applies both, `inserts = \"ignored\"` neither";
                self.findings.push(Diagnostic::warning(INSERT_TRANSFORMED, text).at(place.clone()).hint(hint));
            }
            if let Some(finding) = repeated(block, inserted) {
                self.findings.push(finding.at(place.clone()));
            }
            if inserted.mirrored > 0 && inserted.plain == 0 {
                let text = format!("block `{}` is inserted mirrored; the piece was mirrored", block.name);
                self.findings.push(Diagnostic::warning(INSERT_MIRRORED, text).at(place));
            }
        }
        for (name, list) in self.by_name {
            if list.len() > 1 && !is_model_space(name) {
                let text = format!("{} blocks are called `{name}`; all were read", list.len());
                let place = self.findings.place_in(name, None, self.blocks[list[1]].line);
                self.findings.push(Diagnostic::warning(codes::BLOCK_NAME_REPEATS, text).at(place));
            }
        }
    }
}
