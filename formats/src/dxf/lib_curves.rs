//! Curves through the `dxf` crate, with a census.
//!
//! The crate loses data on real pattern files (unknown codes, bad numbers, panics on dates). So it never sees the
//! file: it reads a minimal stream of the curve entities alone, written from numbers that have passed our gate. What
//! comes back must agree entity by entity and vertex by vertex with what was written; else our own reading stays and
//! a finding says so.

use super::findings::Findings;
use super::model::{Drawing, Entity, Shape, Spline, Vertex};
use dxf::entities::EntityType;
use std::fmt::Write as _;
use std::panic::{AssertUnwindSafe, catch_unwind};
use toile_garment::{Diagnostic, Vec2};

/// Above this many vertices our own reading is used alone: the crate needs about thirteen times the bytes it reads.
const MOST_VERTICES: usize = 500_000;

/// What the census says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Census {
    /// Curve entities written to the crate.
    pub sent: usize,
    /// Entities that came back equal.
    pub agreed: usize,
}

/// Reads all curves of the drawing again through the crate and takes its numbers where they agree.
pub fn cross_read(drawing: &mut Drawing, findings: &mut Findings) -> Census {
    let mut curves: Vec<&mut Entity> = Vec::new();
    for block in &mut drawing.blocks {
        curves.extend(block.entities.iter_mut().filter(|e| is_curve(&e.shape)));
    }
    curves.extend(drawing.entities.iter_mut().filter(|e| is_curve(&e.shape)));
    let vertices: usize = curves.iter().map(|e| size(&e.shape)).sum();
    let mut census = Census { sent: curves.len(), agreed: 0 };
    if curves.is_empty() || vertices > MOST_VERTICES {
        return census;
    }
    let stream = write(curves.iter().map(|e| &e.shape));
    let loaded =
        catch_unwind(AssertUnwindSafe(|| dxf::Drawing::load(&mut stream.as_bytes()))).ok().and_then(Result::ok);
    let shapes: Vec<Option<Shape>> =
        loaded.map(|d| d.entities().map(|e| shape(&e.specific)).collect()).unwrap_or_default();
    if shapes.len() != curves.len() {
        let text = format!("{} curves were written to the library reader and {} came back", curves.len(), shapes.len());
        findings.push(Diagnostic::warning("library-census-differs", text).hint("this program's own reading was used"));
        return census;
    }
    for (entity, back) in curves.iter_mut().zip(shapes) {
        match back {
            Some(back) if agree(&entity.shape, &back) => {
                entity.shape = back;
                census.agreed += 1;
            }
            _ => {
                let text =
                    format!("the library reader lost part of a {}; our own reading was used", entity.shape.name());
                findings.push(Diagnostic::warning("library-census-differs", text).at(findings.place(entity.line)));
            }
        }
    }
    census
}

fn is_curve(shape: &Shape) -> bool {
    matches!(
        shape,
        Shape::Polyline { light: true, .. }
            | Shape::Arc { .. }
            | Shape::Circle { .. }
            | Shape::Ellipse { .. }
            | Shape::Spline(_)
    )
}

fn size(shape: &Shape) -> usize {
    match shape {
        Shape::Polyline { vertices, .. } => vertices.len(),
        Shape::Spline(s) => s.control.len() + s.fit.len() + s.knots.len(),
        _ => 1,
    }
}

struct Stream(String);

impl Stream {
    fn text(&mut self, code: i32, value: &str) {
        let _ = write!(self.0, "{code}\n{value}\n");
    }

    fn number(&mut self, code: i32, value: f64) {
        let _ = write!(self.0, "{code}\n{value:?}\n");
    }

    fn point(&mut self, code: i32, p: Vec2) {
        self.number(code, p.x);
        self.number(code + 10, p.y);
        // The crate keeps spline points only when all three coordinates are there.
        self.number(code + 20, 0.0);
    }
}

fn write<'a>(shapes: impl Iterator<Item = &'a Shape>) -> String {
    let mut s = Stream(String::new());
    s.0.push_str("0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n");
    for shape in shapes {
        s.text(0, shape.name());
        s.text(8, "1");
        match shape {
            Shape::Polyline { vertices, closed, .. } => {
                s.text(90, &vertices.len().to_string());
                s.text(70, if *closed { "1" } else { "0" });
                for v in vertices {
                    s.number(10, v.at.x);
                    s.number(20, v.at.y);
                    s.number(42, v.bulge);
                }
            }
            Shape::Arc { center, radius, start, end } => {
                s.point(10, *center);
                s.number(40, *radius);
                s.number(50, *start);
                s.number(51, *end);
            }
            Shape::Circle { center, radius } => {
                s.point(10, *center);
                s.number(40, *radius);
            }
            Shape::Ellipse { center, major, ratio, start, end } => {
                s.point(10, *center);
                s.point(11, *major);
                s.number(40, *ratio);
                s.number(41, *start);
                s.number(42, *end);
            }
            Shape::Spline(spline) => write_spline(&mut s, spline),
            _ => {}
        }
    }
    s.0.push_str("0\nENDSEC\n0\nEOF\n");
    s.0
}

fn write_spline(s: &mut Stream, spline: &Spline) {
    s.text(70, &spline.flags.to_string());
    s.text(71, &spline.degree.to_string());
    s.text(72, &spline.knots.len().to_string());
    s.text(73, &spline.control.len().to_string());
    s.text(74, &spline.fit.len().to_string());
    spline.knots.iter().for_each(|k| s.number(40, *k));
    spline.weights.iter().for_each(|w| s.number(41, *w));
    spline.control.iter().for_each(|p| s.point(10, *p));
    spline.fit.iter().for_each(|p| s.point(11, *p));
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

/// Equal kind, equal counts, equal numbers (the stream carries them to the last digit).
fn agree(ours: &Shape, theirs: &Shape) -> bool {
    ours == theirs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_curve_comes_back_bit_equal() {
        let p = |x, y| Vec2::new(x, y);
        let shapes = [
            Shape::Polyline {
                vertices: vec![Vertex { at: p(0.1, -2.0), bulge: 0.0 }, Vertex { at: p(1e-7, 1.0 / 3.0), bulge: 1.0 }],
                closed: true,
                light: true,
            },
            Shape::Arc { center: p(1.0, 2.0), radius: 3.5, start: -10.0, end: 350.25 },
            Shape::Circle { center: p(-1.0, 2.0), radius: 0.3 },
            Shape::Ellipse { center: p(0.0, 0.0), major: p(3.0, 1.0), ratio: 0.4, start: 0.1, end: 6.0 },
            Shape::Spline(Spline {
                degree: 2,
                flags: 12,
                knots: vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0],
                weights: vec![1.0, 0.625, 1.0],
                control: vec![p(0.0, 0.0), p(1.0, 0.0), p(1.0, 1.0)],
                fit: vec![],
            }),
        ];
        let stream = write(shapes.iter());
        let loaded = dxf::Drawing::load(&mut stream.as_bytes()).expect("stream");
        let back: Vec<Shape> = loaded.entities().filter_map(|e| shape(&e.specific)).collect();
        assert_eq!(back, shapes);
    }
}
