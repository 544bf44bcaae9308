//! A block sorted by layer, in millimetres: lines flattened, points, strokes and texts by their role.

use super::chain::Path;
use super::curve;
use super::findings::Findings;
use super::geom;
use super::layers::{Layers, Role};
use super::ledger::{Ledger, Verdict};
use super::limits;
use super::model::{Block, Entity, Shape};
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

/// A block by layers.
#[derive(Clone, Debug, Default)]
pub struct Sheet {
    pub boundary: Vec<Path>,
    pub dense: Vec<Path>,
    pub sew: Vec<Path>,
    pub dense_sew: Vec<Path>,
    pub internal: Vec<Path>,
    pub cutouts: Vec<Path>,
    pub turn: Vec<Vec2>,
    pub curve: Vec<Vec2>,
    pub marks: Vec<Mark>,
    pub notch_strokes: Vec<Stroke>,
    pub reference: Vec<Stroke>,
    pub mirror: Vec<Stroke>,
    pub grain: Vec<Stroke>,
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

/// What sorting needs.
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
        let code = if x * y < 0.0 { "insert-mirrored" } else { "insert-transformed" };
        Diagnostic::warning(code, text).hint(hint)
    })
}

/// Does the block hold a line on layer 1 itself?
pub(crate) fn has_boundary(layers: &Layers, block: &Block) -> bool {
    block.entities.iter().any(|e| layers.role(&e.layer) == Role::Boundary && !e.shape.extent().is_empty())
}

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
            self.expanded = self.expanded.saturating_add(1);
            const MOST: usize = limits::ENTITIES + limits::EXPANDED;
            if self.expanded > MOST {
                // Said once; the error ends the reading, so nothing is lost in silence.
                if self.expanded == MOST + 1 {
                    let text = format!("the INSERTs of this file expand to more than {MOST} entities");
                    let place = self.findings.place_in(&blocks[index].name, None, entity.line);
                    self.findings.push(Diagnostic::error("insert-too-many", text).at(place));
                }
                return;
            }
            let Shape::Insert { block, at, scale, rotation } = &entity.shape else {
                let role = inherited.filter(|_| entity.layer == "0").unwrap_or_else(|| self.layers.role(&entity.layer));
                self.entity(sheet, entity, role, placings);
                continue;
            };
            let place = self.findings.place_in(&blocks[index].name, Some(&entity.layer), entity.line);
            let target = self.by_name.get(block).and_then(|list| list.first()).copied();
            let problem = match target {
                None => Some(("block-missing", "there is no such block")),
                Some(t) if path.contains(&t) => Some(("insert-recursive", "it would insert itself")),
                Some(t) if own && has_boundary(self.layers, &blocks[t]) => {
                    Some(("insert-not-expanded", "both blocks have an outline of their own"))
                }
                Some(_) if path.len() >= limits::INSERT_DEPTH => {
                    Some(("insert-too-deep", "blocks are nested too deeply"))
                }
                Some(_) => None,
            };
            if let Some((code, why)) = problem {
                let text = format!("the INSERT of `{block}` inside block `{}` was left out: {why}", blocks[index].name);
                self.findings.push(Diagnostic::warning(code, text).at(place));
                self.ledger.note(entity.id, Verdict::Refused, "INSERT inside a block, not expanded");
                continue;
            }
            let Some(target) = target else { continue };
            self.ledger.note(entity.id, Verdict::Interpreted, "INSERT inside a block, expanded");
            if !own
                && self.told.insert(entity.id)
                && let Some(finding) = transformed(&blocks[index].name, block, *scale, *rotation)
            {
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

    fn entity(&mut self, sheet: &mut Sheet, entity: &Entity, role: Role, placings: &[Placing]) {
        let mm = self.mm;
        let place = |p: Vec2| placings.iter().fold(p * mm, |p, placing| placing.apply(p));
        let (id, line) = (entity.id, entity.line);
        let accepted = |ledger: &mut Ledger, rule| ledger.note(id, Verdict::Accepted, rule);
        match (&entity.shape, role) {
            (Shape::Text { at, value, .. }, _) => {
                accepted(self.ledger, "text");
                let note = |text: &str| Note { at: place(*at), layer: entity.layer.clone(), text: text.to_owned() };
                sheet.notes.extend(value.split('\n').map(note));
            }
            (Shape::Attribute { at, tag, value }, _) => match texts::attribute(tag, value) {
                Some(text) => {
                    self.ledger.note(id, Verdict::Interpreted, "attribute with a value: read as a text of the piece");
                    sheet.notes.push(Note { at: place(*at), layer: entity.layer.clone(), text });
                }
                None => {
                    self.ledger.note(id, Verdict::Interpreted, "attribute: notch link or without a value, not needed")
                }
            },
            (Shape::Point { at, .. }, Role::Turn) => {
                accepted(self.ledger, "turn point (layer 2)");
                sheet.turn.push(place(*at));
            }
            (Shape::Point { at, .. }, Role::Curve) => {
                accepted(self.ledger, "curve point (layer 3)");
                sheet.curve.push(place(*at));
            }
            (Shape::Point { at, depth, width, angle }, Role::Notch(kind)) => {
                accepted(self.ledger, "notch point (layers 4, 80 to 83)");
                let turned = |a: f64| turn_angle(a.to_radians(), placings);
                let k = mm * growth(placings);
                let (depth, width) = (depth.map(|d| d * k), width.map(|w| w * k));
                let angle = angle.map(turned);
                sheet.marks.push(Mark { id, line, at: place(*at), depth, width, angle, kind });
            }
            (Shape::Point { at, depth, .. }, Role::Drill) => {
                accepted(self.ledger, "drill hole (layer 13)");
                let diameter = depth.map(|d| d.abs() * mm * growth(placings)).filter(|d| *d > 0.0);
                sheet.drills.push(Drill { line, at: place(*at), diameter });
            }
            (Shape::Circle { center, radius }, Role::Drill) => {
                self.ledger.note(id, Verdict::Interpreted, "circle on layer 13 read as a drill hole");
                sheet.drills.push(Drill {
                    line,
                    at: place(*center),
                    diameter: Some(2.0 * radius * mm * growth(placings)),
                });
            }
            (Shape::Point { at, .. }, Role::Match) => {
                accepted(self.ledger, "stripe or plaid mark (layers 9 and 10)");
                let points = vec![(place(*at), true)];
                sheet.stripes.push((entity.layer.clone(), Path { ids: vec![id], line, points, closed: false }));
            }
            (Shape::Polyline { vertices, .. }, Role::GradeReference | Role::Mirror | Role::Grain)
                if vertices.len() >= 2 =>
            {
                self.ledger.note(id, Verdict::Interpreted, "polyline on layer 5, 6 or 7: the line between its ends");
                let ends = [vertices[0].at, vertices[vertices.len() - 1].at].map(place);
                let stroke = Stroke { id, line, ends };
                match role {
                    Role::GradeReference => sheet.reference.push(stroke),
                    Role::Mirror => sheet.mirror.push(stroke),
                    _ => sheet.grain.push(stroke),
                }
            }
            (Shape::Polyline { vertices, .. }, Role::Notch(_)) if (2..=16).contains(&vertices.len()) => {
                self.ledger.note(id, Verdict::Interpreted, "polyline on a notch layer: strokes of a notch");
                let strokes = vertices.windows(2).map(|w| Stroke { id, line, ends: [w[0].at, w[1].at].map(place) });
                sheet.notch_strokes.extend(strokes);
            }
            (Shape::Point { .. }, Role::Boundary) => {
                self.ledger.note(id, Verdict::Interpreted, "point on layer 1 beside a notch, not needed");
            }
            (Shape::Line(ends), Role::Notch(_) | Role::GradeReference | Role::Mirror | Role::Grain) => {
                let stroke = Stroke { id, line, ends: ends.map(place) };
                match role {
                    Role::GradeReference => {
                        accepted(self.ledger, "grade reference line (layer 5)");
                        sheet.reference.push(stroke);
                    }
                    Role::Mirror => {
                        accepted(self.ledger, "mirror line (layer 6)");
                        sheet.mirror.push(stroke);
                    }
                    Role::Grain => {
                        accepted(self.ledger, "grain line (layer 7)");
                        sheet.grain.push(stroke);
                    }
                    _ => {
                        self.ledger.note(id, Verdict::Interpreted, "line on a notch layer: stroke of a notch");
                        sheet.notch_strokes.push(stroke);
                    }
                }
            }
            _ => self.line(sheet, entity, role, growth(placings), &place),
        }
    }

    fn line(&mut self, sheet: &mut Sheet, entity: &Entity, role: Role, growth: f64, place: &dyn Fn(Vec2) -> Vec2) {
        let tol = self.flatness / (self.mm * growth).max(1e-9);
        let drawn = |points: Vec<Vec2>| {
            let n = points.len();
            points.into_iter().enumerate().map(move |(i, p)| (p, i == 0 || i + 1 == n)).collect::<Vec<_>>()
        };
        let (points, closed, rule) = match &entity.shape {
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
            Shape::Insert { .. } => return,
            Shape::Other(_) => {
                self.ledger.note(entity.id, Verdict::Refused, "entity type not used in patterns");
                return;
            }
            _ => return,
        };
        let list = match role {
            Role::Boundary => (&mut sheet.boundary, "outline (layer 1)"),
            Role::DenseBoundary => (&mut sheet.dense, "dense copy of the outline (layer 84)"),
            Role::Sew => (&mut sheet.sew, "sew line (layer 14)"),
            Role::DenseSew => (&mut sheet.dense_sew, "dense copy of the sew line (layer 87)"),
            Role::Internal => (&mut sheet.internal, "internal line (layer 8)"),
            Role::Cutout => (&mut sheet.cutouts, "cutout (layer 11)"),
            Role::DenseOther => {
                self.ledger.note(entity.id, Verdict::Interpreted, "dense copy of internal lines, not needed");
                return;
            }
            Role::Match => {
                self.ledger.note(entity.id, Verdict::Accepted, "stripe or plaid line (layers 9 and 10)");
                let points = points.into_iter().map(|(p, own)| (place(p), own)).collect();
                let path = Path { ids: vec![entity.id], line: entity.line, points, closed };
                sheet.stripes.push((entity.layer.clone(), path));
                return;
            }
            _ => {
                self.ledger.note(entity.id, Verdict::Refused, "line on a layer without meaning for lines");
                return;
            }
        };
        match rule {
            Some(rule) => self.ledger.note(entity.id, Verdict::Interpreted, rule),
            None => self.ledger.note(entity.id, Verdict::Accepted, list.1),
        }
        let points = points.into_iter().map(|(p, own)| (place(p), own)).collect();
        list.0.push(Path { ids: vec![entity.id], line: entity.line, points, closed });
    }
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
