//! Tags into the faithful model: sections, blocks, polylines with their vertices.

use super::codes;
use super::entity;
use super::findings::Findings;
use super::groups::{Group, Groups};
use super::header::{read_header, say_encoding, text_encoding};
use super::library::Curves;
use super::limits;
use super::model::{Block, Drawing, Entity, Shape, Vertex};
use super::tags::{Tag, Tags, number};
use crate::encoding::{self, TextEncoding};
use toile_garment::{Code, Diagnostic, Vec2};

#[derive(Clone, Copy, PartialEq)]
enum Section {
    None,
    Blocks,
    Entities,
    Skipped,
}

struct OpenPolyline {
    entity: Entity,
    vertices: Vec<Vertex>,
    closed: bool,
    mirror: bool,
    mesh: bool,
    /// Lowest and highest z of its vertices.
    depth: Option<[f64; 2]>,
}

struct Parser<'f> {
    findings: &'f mut Findings,
    encoding: TextEncoding,
    blocks: Vec<Block>,
    entities: Vec<Entity>,
    section: Section,
    block: Option<Block>,
    polyline: Option<OpenPolyline>,
    count: u32,
    vertex_count: u64,
    curves: Curves,
    sections: u32,
    /// Line of the group that is read.
    line: u64,
    ended: bool,
    after_end: bool,
    tables: bool,
}

/// Reads a file into the faithful model. `code_page` overrules what the file says.
///
/// # Errors
/// The first mistake that makes the rest unsafe to read; mistakes inside entities are collected in `findings`.
pub fn parse(bytes: &[u8], code_page: Option<&str>, findings: &mut Findings) -> Result<Drawing, Diagnostic> {
    let bytes = super::tags::sniff(bytes, findings)?;
    let bytes: &[u8] = &bytes;
    let header = read_header(bytes, findings)?;
    let encoding = text_encoding(bytes, code_page, &header, findings)?;
    if code_page.is_none() {
        say_encoding(bytes, &header, encoding, findings);
    }
    let mut groups = Groups::new(bytes);
    let mut parser = Parser {
        findings,
        encoding,
        blocks: Vec::new(),
        entities: Vec::new(),
        section: Section::None,
        block: None,
        polyline: None,
        count: 0,
        vertex_count: 0,
        curves: Curves::default(),
        sections: 0,
        line: 0,
        ended: false,
        after_end: false,
        tables: false,
    };
    while let Some(group) = groups.next(parser.findings)? {
        parser.group(group)?;
    }
    let comments = groups.tags.comments().iter().map(|c| parser.text(c)).collect();
    parser.end(groups.tags)?;
    let in_blocks = parser.blocks.iter_mut().flat_map(|b| &mut b.entities);
    let census = parser.curves.read(in_blocks.chain(&mut parser.entities), parser.findings);
    Ok(Drawing {
        release: header.release,
        insunits: header.insunits,
        encoding,
        blocks: parser.blocks,
        entities: parser.entities,
        entity_count: parser.count,
        comments,
        header_variables: header.variables,
        tables: parser.tables,
        vertex_count: parser.vertex_count,
        census,
    })
}

impl Parser<'_> {
    fn error(&mut self, code: Code, text: String, line: u64) {
        let place = self.findings.place(line);
        self.findings.push(Diagnostic::error(code, text).at(place));
    }

    fn warn(&mut self, code: Code, text: String, line: u64) {
        let place = self.findings.place(line);
        self.findings.push(Diagnostic::warning(code, text).at(place));
    }

    fn text(&self, value: &[u8]) -> String {
        encoding::unescape(&self.encoding.decode(value))
    }

    fn group(&mut self, group: &Group<'_>) -> Result<(), Diagnostic> {
        let head = group.head;
        self.line = head.line;
        if self.ended {
            if !self.after_end {
                self.after_end = true;
                self.warn(codes::DATA_AFTER_EOF, "there are entities after EOF; they were not read".into(), head.line);
            }
            return Ok(());
        }
        if head.is("SECTION") {
            return self.open_section(group);
        }
        if head.is("ENDSEC") || head.is("EOF") {
            return self.close_section(&head);
        }
        match self.section {
            Section::None => {
                let name = self.text(head.value);
                let text = format!("`{name}` stands outside any SECTION");
                return Err(Diagnostic::error(codes::OUTSIDE_SECTION, text)
                    .at(self.findings.place(head.line))
                    .hint("a SECTION or ENDSEC line is damaged"));
            }
            Section::Skipped => {}
            Section::Blocks if head.is("BLOCK") => self.open_block(group),
            Section::Blocks if head.is("ENDBLK") => self.close_block(Some(head.line)),
            _ => self.entity(group)?,
        }
        if self.findings.errors_full() {
            return Err(Diagnostic::error(codes::TOO_MANY_ERRORS, "too many errors; reading stopped here")
                .at(self.findings.place(head.line)));
        }
        Ok(())
    }

    fn open_section(&mut self, group: &Group<'_>) -> Result<(), Diagnostic> {
        let line = group.head.line;
        if self.section != Section::None {
            self.close_polyline(None);
            self.close_block(None);
            self.warn(codes::SECTION_NOT_CLOSED, "a SECTION begins before the one above has ended".into(), line);
        }
        let Some(name) = group.tags.first().filter(|t| t.code == 2) else {
            return Err(Diagnostic::error(codes::SECTION_WITHOUT_NAME, "a SECTION without a name")
                .at(self.findings.place(line)));
        };
        self.sections += 1;
        const KNOWN: [&str; 6] = ["HEADER", "CLASSES", "TABLES", "OBJECTS", "THUMBNAILIMAGE", "ACDSDATA"];
        self.section = if name.is("BLOCKS") {
            Section::Blocks
        } else if name.is("ENTITIES") {
            Section::Entities
        } else {
            self.tables |= name.is("TABLES");
            if !KNOWN.iter().any(|k| name.is(k)) {
                let shown = self.text(name.value);
                self.error(codes::UNKNOWN_SECTION, format!("unknown section `{shown}`"), name.line);
            }
            Section::Skipped
        };
        Ok(())
    }

    fn close_section(&mut self, head: &Tag<'_>) -> Result<(), Diagnostic> {
        let open = self.polyline.is_some();
        self.close_polyline(if open { Some(head.line) } else { None });
        if self.block.is_some() {
            self.warn(codes::BLOCK_NOT_CLOSED, "a BLOCK ends without ENDBLK".into(), head.line);
            self.close_block(None);
        }
        if head.is("EOF") {
            if self.section != Section::None {
                self.warn(codes::SECTION_NOT_CLOSED, "the last SECTION ends without ENDSEC".into(), head.line);
            }
            self.ended = true;
        } else if self.section == Section::None {
            self.warn(codes::ENDSEC_WITHOUT_SECTION, "ENDSEC without a SECTION".into(), head.line);
        }
        self.section = Section::None;
        Ok(())
    }

    fn open_block(&mut self, group: &Group<'_>) {
        self.close_polyline(Some(group.head.line));
        if self.block.is_some() {
            self.warn(codes::BLOCK_NOT_CLOSED, "a BLOCK begins before the one above has ended".into(), group.head.line);
            self.close_block(None);
        }
        let mut block = Block {
            name: String::new(),
            base: Vec2::zeros(),
            line: group.head.line,
            end: group.head.line,
            entities: Vec::new(),
        };
        let mut named = false;
        for tag in &group.tags {
            match tag.code {
                2 => {
                    block.name = self.text(tag.value);
                    named = true;
                }
                10 | 20 => match number(tag, self.findings) {
                    Ok(v) if tag.code == 10 => block.base.x = v,
                    Ok(v) => block.base.y = v,
                    Err(e) => self.findings.push(e),
                },
                _ => {}
            }
        }
        if !named {
            self.warn(codes::BLOCK_WITHOUT_NAME, "a BLOCK without a name".into(), block.line);
            block.name = format!("BLOCK_{}", self.blocks.len() + 1);
        }
        self.block = Some(block);
    }

    fn close_block(&mut self, endblk: Option<u64>) {
        self.close_polyline(endblk);
        match (self.block.take(), endblk) {
            (Some(block), _) => self.blocks.push(Block { end: self.line, ..block }),
            (None, Some(line)) => self.error(codes::ENDBLK_WITHOUT_BLOCK, "ENDBLK without a BLOCK".into(), line),
            (None, None) => {}
        }
    }

    fn entity(&mut self, group: &Group<'_>) -> Result<(), Diagnostic> {
        let head = group.head;
        if head.is("VERTEX") {
            self.vertex(group);
            return Ok(());
        }
        if head.is("SEQEND") {
            if self.polyline.is_none() && !self.last_takes_seqend() {
                self.warn(codes::STRAY_SEQEND, "SEQEND without a POLYLINE".into(), head.line);
            }
            self.close_polyline(None);
            return Ok(());
        }
        self.close_polyline(Some(head.line));
        if self.section == Section::Blocks && self.block.is_none() {
            let name = self.text(head.value);
            self.error(codes::ENTITY_OUTSIDE_BLOCK, format!("`{name}` stands in BLOCKS but in no BLOCK"), head.line);
            return Ok(());
        }
        let id = self.count;
        self.count += 1;
        if self.count as usize > limits::ENTITIES {
            let text = format!("more than {} entities", limits::ENTITIES);
            return Err(Diagnostic::error(codes::TOO_MANY_ENTITIES, text).at(self.findings.place(head.line)));
        }
        if head.is("POLYLINE") {
            self.open_polyline(id, group);
            return Ok(());
        }
        let encoding = self.encoding;
        let entity = entity::read(id, group, encoding, self.findings);
        if let Some(entity) = entity {
            if let Some(kind) = Curves::kind(head.value) {
                let vertices = self.curves.take(id, kind, group);
                self.vertex_count += if head.is("LWPOLYLINE") { vertices as u64 } else { 0 };
            }
            self.store(entity);
        }
        Ok(())
    }

    /// ATTRIBs after an INSERT are closed by a SEQEND too.
    fn last_takes_seqend(&self) -> bool {
        let list = self.block.as_ref().map_or(&self.entities, |b| &b.entities);
        list.last().is_some_and(|e| matches!(e.shape, Shape::Attribute { .. } | Shape::Insert { .. }))
    }

    fn store(&mut self, entity: Entity) {
        match &mut self.block {
            Some(block) if self.section == Section::Blocks => block.entities.push(entity),
            _ => self.entities.push(entity),
        }
    }

    fn open_polyline(&mut self, id: u32, group: &Group<'_>) {
        let flags = entity::integer(group, 70).unwrap_or(0);
        let entity = entity::shell(id, group, self.encoding, Shape::Other("POLYLINE".into()));
        self.polyline = Some(OpenPolyline {
            entity,
            vertices: Vec::new(),
            closed: flags & 1 != 0,
            mirror: entity::mirrored(group),
            mesh: flags & (16 | 64) != 0,
            depth: None,
        });
    }

    fn vertex(&mut self, group: &Group<'_>) {
        let line = group.head.line;
        if self.polyline.is_none() {
            self.error(codes::STRAY_VERTEX, "a VERTEX outside a POLYLINE: an outline here is incomplete".into(), line);
            return;
        }
        self.vertex_count += 1;
        // Bit 16: a control point of a curve whose fitted vertices also stand in the file.
        let frame = entity::integer(group, 70).unwrap_or(0) & 16 != 0;
        let vertex = entity::vertex(group, self.findings);
        let (Some(polyline), Some((mut vertex, z))) = (self.polyline.as_mut(), vertex) else { return };
        let [low, high] = polyline.depth.unwrap_or([z, z]);
        polyline.depth = Some([low.min(z), high.max(z)]);
        if polyline.mirror {
            vertex.at.x = -vertex.at.x;
            vertex.bulge = -vertex.bulge;
        }
        if !frame {
            polyline.vertices.push(vertex);
        }
        if polyline.vertices.len() > limits::OUTLINE_POINTS {
            polyline.vertices.clear();
            let text = format!("a POLYLINE of more than {} vertices", limits::OUTLINE_POINTS);
            self.error(codes::POLYLINE_TOO_LONG, text, line);
        }
    }

    fn close_polyline(&mut self, without_seqend: Option<u64>) {
        let Some(open) = self.polyline.take() else { return };
        if let Some(line) = without_seqend {
            self.warn(codes::POLYLINE_WITHOUT_SEQEND, "a POLYLINE ends without SEQEND".into(), line);
        }
        let mut entity = open.entity;
        if let Some([low, high]) = open.depth.filter(|[low, high]| high - low > 0.01 && !open.mesh) {
            let text = format!(
                "a POLYLINE on layer `{}` lies in space, z from {low} to {high}; it was read as seen from above",
                entity.layer
            );
            let place =
                self.findings.place_in(self.block.as_ref().map_or("", |b| &b.name), Some(&entity.layer), entity.line);
            let hint = "lay the pattern flat before the export: lengths are lost otherwise";
            self.findings.push(Diagnostic::warning(codes::LINE_NOT_FLAT, text).at(place).hint(hint));
        }
        if !open.mesh {
            entity.shape = Shape::Polyline { vertices: open.vertices, closed: open.closed, light: false };
        }
        self.store(entity);
    }

    fn end(&mut self, tags: Tags<'_>) -> Result<(), Diagnostic> {
        tags.report(self.findings);
        let line = tags.line();
        if self.ended && self.sections > 0 {
            return Ok(());
        }
        if self.section != Section::None || self.polyline.is_some() || self.block.is_some() {
            let place = self.findings.place(line);
            return Err(Diagnostic::error(
                codes::FILE_TRUNCATED,
                "the file ends in the middle of a section: it is cut off",
            )
            .at(place)
            .hint("get a whole copy of the file"));
        }
        if self.sections == 0 {
            return Err(
                Diagnostic::error(codes::NOT_DXF, "there is no SECTION in this file").at(self.findings.place(1))
            );
        }
        self.warn(codes::EOF_MISSING, "the end mark EOF is missing".into(), line);
        Ok(())
    }
}
