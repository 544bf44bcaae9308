//! Curves, read by the `dxf` crate: LWPOLYLINE, ARC, CIRCLE, ELLIPSE and SPLINE.
//!
//! The crate reads these well, but loses data on whole pattern files. One bad number or unknown group code costs the
//! file. A date of no calendar is a panic. A point of a spline counts only with all three coordinates.
//!
//! So our own tags look first: [`super::entity`] tells line and remedy of what is wrong. The tags that give a curve its
//! shape are handed over as they stand in the file. Afterwards kind and counts are looked at again.

use super::codes;
use super::entity;
use super::findings::Findings;
use super::groups::Group;
use super::model::{Entity, Shape, Spline, Vertex};
use dxf::entities::EntityType;
use std::panic::{AssertUnwindSafe, catch_unwind};
use toile_garment::{Diagnostic, Vec2};

/// Numbers that are handed over at once. More need more memory, about thirteen times their text; fewer take more time.
const NUMBERS_OF_BATCH: usize = 500_000;
/// The crate wants to see this before the first entity.
const HEAD: &str = "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
/// The crate wants to see this behind the last entity.
const TAIL: &str = "0\nENDSEC\n0\nEOF\n";

/// How many curves were handed over and read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Census {
    /// Curve entities handed to the crate.
    pub sent: usize,
    /// Entities that came back whole.
    pub agreed: usize,
}

/// Group codes that give each kind of curve its shape; whole numbers are told apart.
const KINDS: [(&str, &[i32], &[i32]); 5] = [
    ("LWPOLYLINE", &[10, 20, 42], &[70]),
    ("ARC", &[10, 20, 40, 50, 51], &[]),
    ("CIRCLE", &[10, 20, 40], &[]),
    ("ELLIPSE", &[10, 20, 11, 21, 40, 41, 42], &[]),
    ("SPLINE", &[10, 20, 11, 21, 40, 41], &[70, 71]),
];

/// A curve that is to be read.
struct Curve {
    id: u32,
    line: u64,
    /// Drawn looking from behind.
    mirror: bool,
    /// Its place in [`KINDS`].
    kind: usize,
    /// Vertices of a polyline, numbers of any other curve.
    size: usize,
}

/// Curves of a file, to be read by the crate when all of them are known.
#[derive(Default)]
pub(super) struct Curves {
    /// Tags as text, in batches, with the number of curves in each.
    batches: Vec<(String, usize)>,
    /// Numbers in the last batch.
    numbers: usize,
    /// All curves in file order.
    waiting: Vec<Curve>,
}

impl Curves {
    /// The kind of a curve that the crate reads, by its DXF name.
    pub fn kind(name: &[u8]) -> Option<usize> {
        KINDS.iter().position(|k| name.eq_ignore_ascii_case(k.0.as_bytes()))
    }

    /// Takes a curve whose numbers were looked at. Gives the number of its vertices.
    pub fn take(&mut self, id: u32, kind: usize, group: &Group<'_>) -> usize {
        let (name, reals, wholes) = KINDS[kind];
        if self.batches.is_empty() || self.numbers > NUMBERS_OF_BATCH {
            self.batches.push((HEAD.to_owned(), 0));
            self.numbers = 0;
        }
        let Some((text, count)) = self.batches.last_mut() else { return 0 };
        *count += 1;
        let mut pair = |code: i32, value: &str| {
            text.push_str(&code.to_string());
            text.push('\n');
            text.push_str(value);
            text.push('\n');
        };
        pair(0, name);
        pair(8, "1");
        let (mut vertices, mut numbers) = (0, 0);
        let has = |code: i32| group.tags.iter().any(|t| t.code == code);
        for tag in &group.tags {
            let Ok(value) = std::str::from_utf8(tag.value) else { continue };
            if reals.contains(&tag.code) {
                pair(tag.code, value);
                numbers += 1;
                vertices += usize::from(tag.code == 10);
                // Points of splines count only with a third coordinate.
                if matches!(tag.code, 20 | 21) && name != "LWPOLYLINE" {
                    pair(tag.code + 10, "0");
                }
            }
        }
        for code in wholes {
            pair(*code, &entity::whole(group, *code).to_string());
        }
        // A whole ellipse need not say so.
        for (code, value) in [(41, "0"), (42, "6.283185307179586")] {
            if name == "ELLIPSE" && !has(code) {
                pair(code, value);
            }
        }
        self.numbers += numbers;
        let size = if name == "LWPOLYLINE" { vertices } else { numbers };
        self.waiting.push(Curve { id, line: group.head.line, mirror: entity::mirrored(group), kind, size });
        vertices
    }

    /// Reads all curves and gives them to their entities, which may stand in any order.
    pub fn read<'e>(self, entities: impl Iterator<Item = &'e mut Entity>, findings: &mut Findings) -> Census {
        let mut census = Census { sent: self.waiting.len(), agreed: 0 };
        let mut shapes: Vec<Option<Shape>> = Vec::with_capacity(self.waiting.len());
        for (text, count) in self.batches {
            let first = shapes.len();
            shapes.extend(load(text + TAIL).into_iter().take(count));
            shapes.resize(first + count, None);
        }
        let mut read: Vec<(&Curve, Option<Shape>)> = self.waiting.iter().zip(shapes).collect();
        for entity in entities {
            let Ok(at) = read.binary_search_by_key(&entity.id, |(curve, _)| curve.id) else { continue };
            let (curve, shape) = &mut read[at];
            match shape.take().filter(|s| curve.is_whole(s)) {
                Some(shape) => {
                    entity.shape = if curve.mirror { mirrored(shape) } else { shape };
                    census.agreed += 1;
                }
                None => {
                    let text = format!("the library reader lost part of a {}", KINDS[curve.kind].0);
                    let place = findings.place(curve.line);
                    findings.push(Diagnostic::error(codes::LIBRARY_CENSUS_DIFFERS, text).at(place));
                }
            }
        }
        census
    }
}

impl Curve {
    /// Tells whether a shape is of the kind that was handed over and holds as many numbers.
    fn is_whole(&self, shape: &Shape) -> bool {
        let size = match shape {
            Shape::Polyline { vertices, .. } => vertices.len(),
            Shape::Spline(s) => s.knots.len() + s.weights.len() + 2 * (s.control.len() + s.fit.len()),
            _ => self.size,
        };
        shape.name() == KINDS[self.kind].0 && size == self.size
    }
}

/// The shapes of a batch; none when the crate cannot read it.
fn load(text: String) -> Vec<Option<Shape>> {
    let loaded = catch_unwind(AssertUnwindSafe(|| dxf::Drawing::load(&mut text.as_bytes())));
    loaded.ok().and_then(Result::ok).map(|d| d.entities().map(|e| shape(&e.specific)).collect()).unwrap_or_default()
}

fn shape(entity: &EntityType) -> Option<Shape> {
    let plane = |p: &dxf::Point| Vec2::new(p.x, p.y);
    Some(match entity {
        EntityType::LwPolyline(l) => Shape::Polyline {
            vertices: l.vertices.iter().map(|v| Vertex { at: Vec2::new(v.x, v.y), bulge: v.bulge }).collect(),
            closed: l.is_closed(),
            light: true,
        },
        EntityType::Arc(a) => {
            Shape::Arc { center: plane(&a.center), radius: a.radius, start: a.start_angle, end: a.end_angle }
        }
        EntityType::Circle(c) => Shape::Circle { center: plane(&c.center), radius: c.radius },
        EntityType::Ellipse(e) => Shape::Ellipse {
            center: plane(&e.center),
            major: Vec2::new(e.major_axis.x, e.major_axis.y),
            ratio: e.minor_axis_ratio,
            start: e.start_parameter,
            end: e.end_parameter,
        },
        EntityType::Spline(s) => Shape::Spline(Spline {
            degree: usize::try_from(s.degree_of_curve).ok()?,
            flags: i64::from(s.flags),
            knots: s.knot_values.clone(),
            weights: s.weight_values.clone(),
            control: s.control_points.iter().map(plane).collect(),
            fit: s.fit_points.iter().map(plane).collect(),
        }),
        _ => return None,
    })
}

/// A curve seen from behind, where x runs the other way. Splines stand in world coordinates, and ellipses but for the
/// sense of their parameter.
fn mirrored(shape: Shape) -> Shape {
    let flip = |p: Vec2| Vec2::new(-p.x, p.y);
    match shape {
        Shape::Polyline { vertices, closed, light } => {
            let vertices = vertices.into_iter().map(|v| Vertex { at: flip(v.at), bulge: -v.bulge }).collect();
            Shape::Polyline { vertices, closed, light }
        }
        Shape::Arc { center, radius, start, end } => {
            Shape::Arc { center: flip(center), radius, start: 180.0 - end, end: 180.0 - start }
        }
        Shape::Circle { center, radius } => Shape::Circle { center: flip(center), radius },
        // The minor axis points the other way: the parameter runs backwards.
        Shape::Ellipse { center, major, ratio, start, end } => {
            Shape::Ellipse { center, major, ratio, start: -end, end: -start }
        }
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::super::parse;
    use super::*;

    /// A file with these tags in its ENTITIES.
    fn file(tags: &str) -> String {
        format!("0\nSECTION\n2\nENTITIES\n{tags}0\nENDSEC\n0\nEOF\n")
    }

    fn tags(list: &[(i32, &str)]) -> String {
        list.iter().map(|(code, value)| format!("{code}\n{value}\n")).collect()
    }

    fn p(x: f64, y: f64) -> Vec2 {
        Vec2::new(x, y)
    }

    fn all_kinds() -> String {
        let light = [(0, "LWPOLYLINE"), (8, "1"), (90, "2"), (70, "1"), (10, "0.1"), (20, "-2"), (10, "1e-7")];
        let light = tags(&light) + &tags(&[(20, "0.3333333333333333"), (42, "1")]);
        let arc = tags(&[(0, "ARC"), (8, "1"), (10, "1"), (20, "2"), (40, "3.5"), (50, "-10"), (51, "350.25")]);
        let circle = tags(&[(0, "CIRCLE"), (8, "1"), (10, "-1"), (20, "2"), (40, "0.3")]);
        let ellipse = tags(&[(0, "ELLIPSE"), (8, "1"), (10, "0"), (20, "0"), (11, "3"), (21, "1"), (40, "0.4")]);
        light + &arc + &circle + &ellipse
    }

    /// A spline as some programs write it: without the third coordinate.
    fn flat_spline() -> String {
        let knots: String = [0, 0, 0, 1, 1, 1].map(|k| format!("40\n{k}\n")).concat();
        let weights: String = ["1", "0.625", "1"].map(|w| format!("41\n{w}\n")).concat();
        let points: String = [(0, 0), (1, 0), (1, 1)].map(|(x, y)| format!("10\n{x}\n20\n{y}\n")).concat();
        tags(&[(0, "SPLINE"), (8, "1"), (70, "12"), (71, "2")]) + &knots + &weights + &points
    }

    fn shapes(text: &str) -> (Vec<Shape>, Census) {
        let mut findings = Findings::new("f.dxf");
        let drawing = parse::parse(text.as_bytes(), None, &mut findings).expect("read");
        assert!(!findings.has_errors());
        (drawing.entities.into_iter().map(|e| e.shape).collect(), drawing.census)
    }

    #[test]
    fn every_kind_is_read_to_the_last_bit() {
        let (read, census) = shapes(&file(&(all_kinds() + &flat_spline())));
        let vertices = vec![Vertex { at: p(0.1, -2.0), bulge: 0.0 }, Vertex { at: p(1e-7, 1.0 / 3.0), bulge: 1.0 }];
        let expected = [
            Shape::Polyline { vertices, closed: true, light: true },
            Shape::Arc { center: p(1.0, 2.0), radius: 3.5, start: -10.0, end: 350.25 },
            Shape::Circle { center: p(-1.0, 2.0), radius: 0.3 },
            Shape::Ellipse {
                center: p(0.0, 0.0),
                major: p(3.0, 1.0),
                ratio: 0.4,
                start: 0.0,
                end: std::f64::consts::TAU,
            },
            Shape::Spline(Spline {
                degree: 2,
                flags: 12,
                knots: vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0],
                weights: vec![1.0, 0.625, 1.0],
                control: vec![p(0.0, 0.0), p(1.0, 0.0), p(1.0, 1.0)],
                fit: vec![],
            }),
        ];
        assert_eq!(read, expected);
        assert_eq!(census, Census { sent: 5, agreed: 5 });
    }

    #[test]
    fn curves_seen_from_behind_are_turned_round() {
        let behind = tags(&[(0, "ARC"), (8, "1"), (10, "1"), (20, "2"), (40, "3"), (50, "0"), (51, "30"), (230, "-1")]);
        let arc = Shape::Arc { center: p(-1.0, 2.0), radius: 3.0, start: 150.0, end: 180.0 };
        assert_eq!(shapes(&file(&behind)).0, [arc]);
    }

    /// Why the crate does not read whole files: what it loses is held here.
    #[test]
    fn the_crate_alone_loses_points_and_files() {
        let load = |text: &str| dxf::Drawing::load(&mut text.as_bytes());
        let flat = load(&file(&flat_spline())).expect("read");
        let control = flat.entities().map(|e| match &e.specific {
            EntityType::Spline(s) => s.control_points.len(),
            _ => 9,
        });
        assert_eq!(control.collect::<Vec<_>>(), [0], "points without z are gone");
        let circle = tags(&[(0, "CIRCLE"), (10, "1"), (20, "2"), (40, "0,3")]);
        assert!(load(&file(&(circle.clone() + &all_kinds()))).is_err(), "one bad number costs the file");
        assert_eq!(load(&file(&circle)).expect("read").entities().count(), 0, "the last one goes in silence");
        assert!(load(&file(&(tags(&[(0, "CIRCLE"), (1200, "a"), (40, "1")]) + &all_kinds()))).is_err(), "unknown code");
        assert_eq!(load(&file("0\ncircle\n40\n1\n")).expect("read").entities().count(), 0, "small letters");
        let date = "0\nSECTION\n2\nHEADER\n9\n$TDCREATE\n40\n1e30\n0\nENDSEC\n".to_owned() + &file("");
        assert!(catch_unwind(|| load(&date).is_ok()).is_err(), "a date of no calendar is a panic");
    }
}
