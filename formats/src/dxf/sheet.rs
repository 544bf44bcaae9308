//! A block sorted by layer, in millimetres: lines flattened, points, strokes and texts by their role.

use super::chain::Path;
use super::codes;
use super::curve;
use super::findings::Findings;
use super::geom;
use super::layers::{Layers, Role};
use super::ledger::{Ledger, NO_ROLE, Verdict};
use super::limits;
use super::model::{Block, Entity, Shape, Vertex};
use super::texts;
use std::collections::{BTreeMap, BTreeSet};
use toile_garment::notch::NotchKind;
use toile_garment::{Diagnostic, Vec2};

/// A notch point.
#[derive(Clone, Debug)]
pub struct Mark {
    pub id: u32,
    pub line: u64,
    pub at: Vec2,
    pub depth: Option<f64>,
    pub width: Option<f64>,
    pub angle: Option<f64>,
    pub kind: Option<NotchKind>,
}

/// A straight stroke.
#[derive(Clone, Copy, Debug)]
pub struct Stroke {
    pub id: u32,
    pub line: u64,
    pub ends: [Vec2; 2],
}

/// A drill hole.
#[derive(Clone, Copy, Debug)]
pub struct Drill {
    pub line: u64,
    pub at: Vec2,
    /// Diameter, mm.
    pub diameter: Option<f64>,
}

/// A text with its place.
#[derive(Clone, Debug)]
pub struct Note {
    pub at: Vec2,
    pub layer: String,
    pub text: String,
}

/// Straight strokes that turn or mirror a piece.
#[derive(Clone, Debug, Default)]
pub struct SheetAxes {
    pub reference: Vec<Stroke>,
    pub mirror: Vec<Stroke>,
    pub grain: Vec<Stroke>,
}

/// A block by layers.
#[derive(Clone, Debug, Default)]
pub struct Sheet {
    pub boundary: Vec<Path>,
    pub dense: Vec<Path>,
    pub sew: Vec<Path>,
    pub dense_sew: Vec<Path>,
    /// Dense copies of other lines (layers 85 and 86), each with its layer.
    pub dense_other: Vec<(String, Path)>,
    pub internal: Vec<Path>,
    pub cutouts: Vec<Path>,
    pub turn: Vec<Vec2>,
    pub curve: Vec<Vec2>,
    pub marks: Vec<Mark>,
    pub notch_strokes: Vec<Stroke>,
    pub axes: SheetAxes,
    pub drills: Vec<Drill>,
    /// Stripe and plaid lines with their layer.
    pub stripes: Vec<(String, Path)>,
    pub notes: Vec<Note>,
    /// How often it is inserted as drawn and mirrored, where that says anything.
    pub inserted: Option<[u32; 2]>,
}

/// Placement of an inserted block.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placing {
    /// Base point of the block.
    pub base: Vec2,
    pub scale: [f64; 2],
    /// Radians.
    pub angle: f64,
    pub at: Vec2,
}

/// The state of sorting entities into sheets.
pub(crate) struct Sorter<'a> {
    pub layers: &'a Layers,
    pub mm: f64,
    pub blocks: &'a [Block],
    pub by_name: &'a BTreeMap<String, Vec<usize>>,
    pub ledger: &'a mut Ledger,
    pub findings: &'a mut Findings,
    /// Chords keep this near the curve, mm.
    pub flatness: f64,
    expanded: usize,
    /// INSERTs inside blocks whose scale and turn were said.
    told: BTreeSet<u32>,
}

/// An INSERT that scales, mirrors or turns the outline of the piece it stands in. Marks are inserted in every way.
fn transformed(outer: &str, inner: &str, scale: [f64; 2], rotation: f64) -> Option<Diagnostic> {
    let plain = scale.iter().all(|s| (s - 1.0).abs() <= 1e-6) && libm::fmod(rotation, 360.0).abs() <= 1e-6;
    let [x, y] = scale;
    let text = format!(
        "the INSERT of `{inner}` inside block `{outer}` scales by {x} × {y} and turns by {rotation}°; all of it was applied"
    );
    let hint = "compare the size of the piece; insert blocks at their own size if it is not meant";
    (!plain).then(|| {
        let code = if x * y < 0.0 { codes::INSERT_MIRRORED } else { codes::INSERT_TRANSFORMED };
        Diagnostic::warning(code, text).hint(hint)
    })
}

/// Does the block hold a line on layer 1 itself?
pub(crate) fn has_boundary(layers: &Layers, block: &Block) -> bool {
    block.entities.iter().any(|e| layers.role(&e.layer) == Role::Boundary && !e.shape.extent().is_empty())
}

/// The ledger's word on lines of notches on layers 2 and 3, which hold points.
pub(crate) const FOREIGN_NOTCH: &str = "short line on layer 2 or 3 read as a stroke of a notch";
/// The ledger's word on circles of drill holes on layer 2, which holds points.
pub(crate) const FOREIGN_DRILL: &str = "circle on layer 2 read as a drill hole";
/// A line whose layer does not say so is a stroke of a notch only if it is no longer than this, mm.
pub(crate) const STROKE: f64 = 20.0;
/// A drill hole on layer 2 has no larger radius than this, mm.
const DRILL: f64 = 10.0;
/// Vertices of a polyline that is the strokes of one notch.
const STROKES_OF_NOTCH: std::ops::RangeInclusive<usize> = 2..=16;

impl<'a> Sorter<'a> {
    pub(crate) fn new(
        layers: &'a Layers,
        mm: f64,
        flatness: f64,
        blocks: &'a [Block],
        by_name: &'a BTreeMap<String, Vec<usize>>,
        ledger: &'a mut Ledger,
        findings: &'a mut Findings,
    ) -> Self {
        Self { layers, mm, blocks, by_name, ledger, findings, flatness, expanded: 0, told: BTreeSet::new() }
    }

    /// Sorts one block. `placings`, in file units, are applied to all of it.
    pub(crate) fn block(&mut self, index: usize, placings: &[Placing]) -> Sheet {
        let mut sheet = Sheet::default();
        let mm = self.mm;
        let placings: Vec<Placing> =
            placings.iter().map(|p| Placing { base: p.base * mm, at: p.at * mm, ..*p }).collect();
        let own = has_boundary(self.layers, &self.blocks[index]);
        self.fill(&mut sheet, index, &placings, own, None, &mut vec![index]);
        sheet
    }

    /// Sorts loose entities.
    pub(crate) fn loose<'e>(&mut self, entities: impl Iterator<Item = &'e Entity>) -> Sheet {
        let mut sheet = Sheet::default();
        for entity in entities {
            self.entity(&mut sheet, entity, self.layers.role(&entity.layer), &[]);
        }
        sheet
    }

    /// `own`: the piece has its outline already. `inherited`: what entities on layer 0 of an inserted block are.
    fn fill(
        &mut self,
        sheet: &mut Sheet,
        index: usize,
        placings: &[Placing],
        own: bool,
        inherited: Option<Role>,
        path: &mut Vec<usize>,
    ) {
        let blocks = self.blocks;
        for entity in &blocks[index].entities {
            if !self.count_expanded(&blocks[index].name, entity.line) {
                return;
            }
            let Shape::Insert { block, at, scale, rotation } = &entity.shape else {
                let role = inherited.filter(|_| entity.layer == "0").unwrap_or_else(|| self.layers.role(&entity.layer));
                self.entity(sheet, entity, role, placings);
                continue;
            };
            let Some(target) = self.insertable(index, entity, block, own, path) else { continue };
            if !own
                && self.told.insert(entity.id)
                && let Some(finding) = transformed(&blocks[index].name, block, *scale, *rotation)
            {
                let place = self.findings.place_in(&blocks[index].name, Some(&entity.layer), entity.line);
                self.findings.push(finding.at(place));
            }
            let angle = rotation.to_radians();
            let mut inner =
                vec![Placing { base: blocks[target].base * self.mm, scale: *scale, angle, at: at * self.mm }];
            inner.extend_from_slice(placings);
            path.push(target);
            let role = match self.layers.role(&entity.layer) {
                Role::Unknown => inherited.or(Some(Role::Unknown)),
                role => Some(role),
            };
            self.fill(sheet, target, &inner, own, role, path);
            path.pop();
        }
    }

    /// Counts an entity of a block; tells whether the limit still holds.
    fn count_expanded(&mut self, block: &str, line: u64) -> bool {
        const MOST: usize = limits::ENTITIES + limits::EXPANDED;
        self.expanded = self.expanded.saturating_add(1);
        // Said once; the error ends the reading, so nothing is lost in silence.
        if self.expanded == MOST + 1 {
            let text = format!("the INSERTs of this file expand to more than {MOST} entities");
            let place = self.findings.place_in(block, None, line);
            self.findings.push(Diagnostic::error(codes::INSERT_TOO_MANY, text).at(place));
        }
        self.expanded <= MOST
    }

    /// The block that an INSERT inside block `index` places, unless it cannot be expanded, which is then told.
    fn insertable(&mut self, index: usize, entity: &Entity, block: &str, own: bool, path: &[usize]) -> Option<usize> {
        let blocks = self.blocks;
        let outer = &blocks[index].name;
        let target = self.by_name.get(block).and_then(|list| list.first()).copied();
        let problem = match target {
            None => Some((codes::BLOCK_MISSING, "there is no such block")),
            Some(t) if path.contains(&t) => Some((codes::INSERT_RECURSIVE, "it would insert itself")),
            Some(t) if own && has_boundary(self.layers, &blocks[t]) => {
                Some((codes::INSERT_NOT_EXPANDED, "both blocks have an outline of their own"))
            }
            Some(_) if path.len() >= limits::INSERT_DEPTH => {
                Some((codes::INSERT_TOO_DEEP, "blocks are nested too deeply"))
            }
            Some(_) => None,
        };
        if let Some((code, why)) = problem {
            let text = format!("the INSERT of `{block}` inside block `{outer}` was left out: {why}");
            let place = self.findings.place_in(outer, Some(&entity.layer), entity.line);
            self.findings.push(Diagnostic::warning(code, text).at(place));
            self.ledger.note(entity.id, Verdict::Refused, "INSERT inside a block, not expanded");
            return None;
        }
        self.ledger.note(entity.id, Verdict::Interpreted, "INSERT inside a block, expanded");
        target
    }

    /// Sorts one entity by what it is, and by the role of its layer.
    fn entity(&mut self, sheet: &mut Sheet, entity: &Entity, role: Role, placings: &[Placing]) {
        let mm = self.mm;
        let place = |p: Vec2| placings.iter().fold(p * mm, |p, placing| placing.apply(p));
        let sorted = match &entity.shape {
            Shape::Text { at, value, .. } => {
                self.ledger.note(entity.id, Verdict::Accepted, "text");
                let note = |text: &str| Note { at: place(*at), layer: entity.layer.clone(), text: text.to_owned() };
                sheet.notes.extend(value.split('\n').map(note));
                true
            }
            Shape::Attribute { at, tag, value } => {
                self.attribute(sheet, entity, place(*at), tag, value);
                true
            }
            Shape::Point { .. } => self.point(sheet, entity, role, placings, &place),
            Shape::Circle { center, radius } if role == Role::Drill || (role == Role::Turn && radius * mm <= DRILL) => {
                let own = "circle on layer 13 read as a drill hole";
                let rule = if role == Role::Drill { own } else { FOREIGN_DRILL };
                self.ledger.note(entity.id, Verdict::Interpreted, rule);
                let diameter = Some(2.0 * radius * mm * growth(placings));
                sheet.drills.push(Drill { line: entity.line, at: place(*center), diameter });
                true
            }
            Shape::Polyline { vertices, .. } => self.polyline_as_stroke(sheet, entity, role, vertices, &place),
            Shape::Line(ends) => self.line_as_stroke(sheet, entity, role, ends.map(place)),
            _ => false,
        };
        if !sorted {
            self.line(sheet, entity, role, growth(placings), &place);
        }
    }

    /// An attribute is a text of the piece where it has a name and a value of one.
    fn attribute(&mut self, sheet: &mut Sheet, entity: &Entity, at: Vec2, tag: &str, value: &str) {
        let rule = match texts::attribute(tag, value) {
            Some(text) => {
                sheet.notes.push(Note { at, layer: entity.layer.clone(), text });
                "attribute with a value: read as a text of the piece"
            }
            None => "attribute: notch link or without a value, not needed",
        };
        self.ledger.note(entity.id, Verdict::Interpreted, rule);
    }

    /// Sorts a point; tells whether its layer gives it a meaning.
    fn point(
        &mut self,
        sheet: &mut Sheet,
        entity: &Entity,
        role: Role,
        placings: &[Placing],
        place: &dyn Fn(Vec2) -> Vec2,
    ) -> bool {
        let Shape::Point { at, depth, width, angle } = entity.shape else { return false };
        let (id, line, at) = (entity.id, entity.line, place(at));
        let scale = self.mm * growth(placings);
        let mut verdict = Verdict::Accepted;
        let rule = match role {
            Role::Turn => {
                sheet.turn.push(at);
                "turn point (layer 2)"
            }
            Role::Curve => {
                sheet.curve.push(at);
                "curve point (layer 3)"
            }
            Role::Notch(kind) => {
                let (depth, width) = (depth.map(|d| d * scale), width.map(|w| w * scale));
                let angle = angle.map(|a| turn_angle(a.to_radians(), placings));
                sheet.marks.push(Mark { id, line, at, depth, width, angle, kind });
                "notch point (layers 4, 80 to 83)"
            }
            Role::Drill => {
                let diameter = depth.map(|d| d.abs() * self.mm * growth(placings)).filter(|d| *d > 0.0);
                sheet.drills.push(Drill { line, at, diameter });
                "drill hole (layer 13)"
            }
            Role::Match => {
                let path = Path { ids: vec![id], line, points: vec![(at, true)], closed: false };
                sheet.stripes.push((entity.layer.clone(), path));
                "stripe or plaid mark (layers 9 and 10)"
            }
            Role::Boundary => {
                verdict = Verdict::Interpreted;
                "point on layer 1 beside a notch, not needed"
            }
            _ => return false,
        };
        self.ledger.note(id, verdict, rule);
        true
    }

    /// A polyline on a layer of straight lines or notches: the line between its ends, or strokes. Tells whether it is.
    fn polyline_as_stroke(
        &mut self,
        sheet: &mut Sheet,
        entity: &Entity,
        role: Role,
        vertices: &[Vertex],
        place: &dyn Fn(Vec2) -> Vec2,
    ) -> bool {
        let (id, line) = (entity.id, entity.line);
        match role {
            Role::GradeReference | Role::Mirror | Role::Grain if vertices.len() >= 2 => {
                let rule = "polyline on layer 5, 6 or 7: the line between its ends";
                self.ledger.note(id, Verdict::Interpreted, rule);
                let ends = [vertices[0].at, vertices[vertices.len() - 1].at].map(place);
                sheet.strokes(role).push(Stroke { id, line, ends });
            }
            Role::Notch(_) | Role::Turn | Role::Curve if STROKES_OF_NOTCH.contains(&vertices.len()) => {
                let rule = match role {
                    Role::Notch(_) => "polyline on a notch layer: strokes of a notch",
                    _ if self.is_short(vertices) => FOREIGN_NOTCH,
                    _ => return false,
                };
                self.ledger.note(id, Verdict::Interpreted, rule);
                let strokes = vertices.windows(2).map(|w| Stroke { id, line, ends: [w[0].at, w[1].at].map(place) });
                sheet.notch_strokes.extend(strokes);
            }
            _ => return false,
        }
        true
    }

    /// Do vertices, in file units, lie as near to each other as those of a notch?
    fn is_short(&self, vertices: &[Vertex]) -> bool {
        geom::bounds(vertices.iter().map(|v| v.at)).is_some_and(|(lo, hi)| (hi - lo).norm() * self.mm <= STROKE)
    }

    /// A straight line on a layer of straight lines or notches; tells whether it is on one.
    fn line_as_stroke(&mut self, sheet: &mut Sheet, entity: &Entity, role: Role, ends: [Vec2; 2]) -> bool {
        let (verdict, rule) = match role {
            Role::GradeReference => (Verdict::Accepted, "grade reference line (layer 5)"),
            Role::Mirror => (Verdict::Accepted, "mirror line (layer 6)"),
            Role::Grain => (Verdict::Accepted, "grain line (layer 7)"),
            Role::Notch(_) => (Verdict::Interpreted, "line on a notch layer: stroke of a notch"),
            Role::Turn | Role::Curve if (ends[1] - ends[0]).norm() <= STROKE => (Verdict::Interpreted, FOREIGN_NOTCH),
            _ => return false,
        };
        self.ledger.note(entity.id, verdict, rule);
        sheet.strokes(role).push(Stroke { id: entity.id, line: entity.line, ends });
        true
    }

    /// Sorts a line or curve into the list of its layer, flattened.
    fn line(&mut self, sheet: &mut Sheet, entity: &Entity, role: Role, growth: f64, place: &dyn Fn(Vec2) -> Vec2) {
        let tol = self.flatness / (self.mm * growth).max(1e-9);
        let Some((points, closed, rule)) = flattened(&entity.shape, tol) else {
            if matches!(entity.shape, Shape::Other(_)) {
                self.ledger.note(entity.id, Verdict::Refused, "entity type not used in patterns");
            }
            return;
        };
        let points = || points.iter().map(|(p, own)| (place(*p), *own)).collect();
        let path = |points| Path { ids: vec![entity.id], line: entity.line, points, closed };
        match sheet.list(role) {
            Some((list, meaning)) => {
                let (verdict, rule) = rule.map_or((Verdict::Accepted, meaning), |rule| (Verdict::Interpreted, rule));
                self.ledger.note(entity.id, verdict, rule);
                list.push(path(points()));
            }
            None => match role {
                Role::DenseOther => {
                    let rule = "dense copy of internal lines, not needed";
                    self.ledger.note(entity.id, Verdict::Interpreted, rule);
                    sheet.dense_other.push((entity.layer.clone(), path(points())));
                }
                Role::Match => {
                    self.ledger.note(entity.id, Verdict::Accepted, "stripe or plaid line (layers 9 and 10)");
                    sheet.stripes.push((entity.layer.clone(), path(points())));
                }
                _ => self.ledger.note(entity.id, Verdict::Refused, NO_ROLE),
            },
        }
    }
}

impl Sheet {
    /// The list of straight lines for the role of a layer.
    fn strokes(&mut self, role: Role) -> &mut Vec<Stroke> {
        match role {
            Role::GradeReference => &mut self.axes.reference,
            Role::Mirror => &mut self.axes.mirror,
            Role::Grain => &mut self.axes.grain,
            _ => &mut self.notch_strokes,
        }
    }

    /// The list of lines for the role of a layer, and what the ledger calls them.
    fn list(&mut self, role: Role) -> Option<(&mut Vec<Path>, &'static str)> {
        Some(match role {
            Role::Boundary => (&mut self.boundary, "outline (layer 1)"),
            Role::DenseBoundary => (&mut self.dense, "dense copy of the outline (layer 84)"),
            Role::Sew => (&mut self.sew, "sew line (layer 14)"),
            Role::DenseSew => (&mut self.dense_sew, "dense copy of the sew line (layer 87)"),
            Role::Internal => (&mut self.internal, "internal line (layer 8)"),
            Role::Cutout => (&mut self.cutouts, "cutout (layer 11)"),
            _ => return None,
        })
    }
}

/// Points of a line, each with whether it is a vertex of the drawing.
type Flat = Vec<(Vec2, bool)>;

/// A line or curve as points, whether it is closed, and the ledger's word where it was a curve. `tol` is in file units.
fn flattened(shape: &Shape, tol: f64) -> Option<(Flat, bool, Option<&'static str>)> {
    let drawn = |points: Vec<Vec2>| {
        let n = points.len();
        points.into_iter().enumerate().map(move |(i, p)| (p, i == 0 || i + 1 == n)).collect::<Vec<_>>()
    };
    Some(match shape {
        Shape::Polyline { vertices, closed, .. } => (curve::polyline(vertices, *closed, tol), *closed, None),
        Shape::Line(ends) => (ends.iter().map(|p| (*p, true)).collect(), false, None),
        Shape::Arc { center, radius, start, end } => {
            let axis = Vec2::new(*radius, 0.0);
            let points = curve::ellipse(*center, axis, 1.0, start.to_radians(), end.to_radians(), tol);
            (drawn(points), false, Some("ARC flattened"))
        }
        Shape::Circle { center, radius } => {
            let points = curve::ellipse(*center, Vec2::new(*radius, 0.0), 1.0, 0.0, 0.0, tol);
            (drawn(points), true, Some("CIRCLE flattened"))
        }
        Shape::Ellipse { center, major, ratio, start, end } => {
            let whole = (end - start).abs() < 1e-9 || (end - start - std::f64::consts::TAU).abs() < 1e-6;
            let points = curve::ellipse(*center, *major, *ratio, *start, *end, tol);
            (drawn(points), whole, Some("ELLIPSE flattened"))
        }
        Shape::Spline(s) => (drawn(s.flatten(tol)), s.flags & 1 != 0, Some("SPLINE flattened")),
        _ => return None,
    })
}

impl Placing {
    fn apply(&self, p: Vec2) -> Vec2 {
        let local = p - self.base;
        self.at + geom::rotate(Vec2::new(local.x * self.scale[0], local.y * self.scale[1]), self.angle)
    }
}

/// By how much placings enlarge, on average over both axes.
fn growth(placings: &[Placing]) -> f64 {
    placings.iter().map(|p| libm::sqrt((p.scale[0] * p.scale[1]).abs())).product()
}

fn turn_angle(angle: f64, placings: &[Placing]) -> f64 {
    placings.iter().fold(angle, |a, placing| {
        let (s, c) = libm::sincos(a);
        libm::atan2(s * placing.scale[1], c * placing.scale[0]) + placing.angle
    })
}
