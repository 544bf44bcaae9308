//! The faithful model of a specification: what the JSON holds, every number checked.

use super::codes;
use super::{EDGES, PANELS, STITCHES};
use serde_json::{Map, Value};
use toile_garment::{Diagnostic, Vec2};

/// Largest number, file units.
const LARGEST: f64 = 1e6;
/// Most mistakes told.
const MISTAKES: usize = 40;

/// A whole specification.
#[derive(Debug)]
pub struct Spec {
    /// Metres per file unit.
    pub unit: f64,
    /// Are control points relative to their edge?
    pub relative: bool,
    pub panels: Vec<Panel>,
    pub stitches: Vec<Stitch>,
}

#[derive(Debug)]
pub struct Panel {
    pub name: String,
    pub vertices: Vec<Vec2>,
    pub edges: Vec<Edge>,
    pub rotation: [f64; 3],
    pub translation: [f64; 3],
    pub label: Option<String>,
}

#[derive(Debug, Clone)]
pub struct Edge {
    pub ends: [usize; 2],
    pub curve: Curve,
    pub label: Option<String>,
}

/// Shape of an edge; control points as in the file.
#[derive(Debug, Clone, PartialEq)]
pub enum Curve {
    Straight,
    Quadratic(Vec2),
    Cubic(Vec2, Vec2),
    Arc { radius: f64, large: bool, right: bool },
}

#[derive(Debug)]
pub struct Stitch {
    /// Panel and edge of both sides.
    pub sides: [(usize, usize); 2],
    /// Do the panels lie face to face, so that start meets start?
    pub same: bool,
}

/// Collects mistakes with the place in the document.
struct Reader {
    errors: Vec<Diagnostic>,
}

impl Reader {
    fn fail<T>(&mut self, place: &str, what: &str) -> Option<T> {
        if self.errors.len() < MISTAKES {
            self.errors.push(super::wrong(format!("{place}: {what}")));
        }
        None
    }

    fn number(&mut self, value: &Value, place: &str) -> Option<f64> {
        match value.as_f64() {
            Some(v) if v.abs() <= LARGEST => Some(v),
            Some(v) => self.fail(place, &format!("{v} is out of range")),
            None => self.fail(place, "this is no number"),
        }
    }

    fn numbers<const N: usize>(&mut self, value: Option<&Value>, place: &str) -> Option<[f64; N]> {
        let list = value.and_then(Value::as_array).filter(|l| l.len() == N);
        let Some(list) = list else { return self.fail(place, &format!("{N} numbers are needed here")) };
        let mut out = [0.0; N];
        for (o, v) in out.iter_mut().zip(list) {
            *o = self.number(v, place)?;
        }
        Some(out)
    }

    fn point(&mut self, value: &Value, place: &str) -> Option<Vec2> {
        self.numbers::<2>(Some(value), place).map(|[x, y]| Vec2::new(x, y))
    }
}

/// Parses and checks.
pub fn parse(bytes: &[u8]) -> Result<Spec, Vec<Diagnostic>> {
    let value: Value = serde_json::from_slice(bytes).map_err(|e| {
        let text = format!("this is not JSON: {e}");
        vec![Diagnostic::error(codes::GARMENTCODE_NOT_JSON, text).hint("give a GarmentCode `…_specification.json`")]
    })?;
    let mut r = Reader { errors: Vec::new() };
    let spec = spec(&value, &mut r);
    match spec {
        Some(spec) if r.errors.is_empty() => Ok(spec),
        _ => {
            if r.errors.is_empty() {
                r.fail::<()>("the document", "this is no specification");
            }
            Err(r.errors)
        }
    }
}

fn spec(value: &Value, r: &mut Reader) -> Option<Spec> {
    let pattern = value.get("pattern").unwrap_or(value);
    let Some(list) = pattern.get("panels").and_then(Value::as_object) else {
        return r.fail("the document", "there is no `pattern.panels`: this is no GarmentCode specification");
    };
    if list.is_empty() || list.len() > PANELS {
        return r.fail("pattern.panels", &format!("{} panels; 1 to {PANELS} can be read", list.len()));
    }
    let properties = value.get("properties");
    let per_metre = properties.and_then(|p| p.get("units_in_meter"));
    let per_metre = per_metre.map_or(Some(100.0), |v| r.number(v, "properties.units_in_meter"))?;
    if !(1e-3..=1e6).contains(&per_metre) {
        return r.fail("properties.units_in_meter", "it must be above 0, and 0.001 to 1,000,000");
    }
    let relative = properties.and_then(|p| p.get("curvature_coords")).and_then(Value::as_str) != Some("absolute");
    let names = order(pattern, list);
    let panels: Vec<Panel> = names.iter().filter_map(|n| panel(n, &list[n.as_str()], r)).collect();
    if panels.len() != names.len() {
        return None;
    }
    let stitches = stitches(pattern, &panels, r)?;
    Some(Spec { unit: 1.0 / per_metre, relative, panels, stitches })
}

/// Names in the order of `panel_order`, then the rest by name.
fn order(pattern: &Value, list: &Map<String, Value>) -> Vec<String> {
    let said = pattern.get("panel_order").and_then(Value::as_array);
    let mut names: Vec<String> = Vec::new();
    for name in said.into_iter().flatten().filter_map(Value::as_str) {
        if list.contains_key(name) && !names.iter().any(|n| n == name) && names.len() < PANELS {
            names.push(name.to_owned());
        }
    }
    let rest: Vec<String> = list.keys().filter(|k| !names.contains(k)).cloned().collect();
    names.extend(rest);
    names
}

fn panel(name: &str, value: &Value, r: &mut Reader) -> Option<Panel> {
    let place = |what: &str| format!("panel `{name}`, {what}");
    let vertices = value.get("vertices").and_then(Value::as_array);
    let edges = value.get("edges").and_then(Value::as_array);
    let (Some(vertices), Some(edges)) = (vertices, edges) else {
        return r.fail(&place("its lists"), "`vertices` or `edges` is missing");
    };
    if !(2..=EDGES).contains(&edges.len()) || vertices.len() > EDGES {
        return r.fail(&place("edges"), &format!("{} edges; 2 to {EDGES} can be read", edges.len()));
    }
    let vertices: Vec<Vec2> =
        vertices.iter().enumerate().filter_map(|(i, v)| r.point(v, &place(&format!("vertex {i}")))).collect();
    let count = vertices.len();
    let edges: Vec<Edge> =
        edges.iter().enumerate().filter_map(|(i, e)| edge(e, count, &place(&format!("edge {i}")), r)).collect();
    let three = |key: &str, r: &mut Reader| match value.get(key) {
        None => Some([0.0; 3]),
        v => r.numbers::<3>(v, &place(key)),
    };
    let (rotation, translation) = (three("rotation", r)?, three("translation", r)?);
    let label = value.get("label").and_then(Value::as_str).filter(|l| !l.is_empty()).map(str::to_owned);
    r.errors.is_empty().then(|| Panel { name: name.to_owned(), vertices, edges, rotation, translation, label })
}

fn edge(value: &Value, count: usize, place: &str, r: &mut Reader) -> Option<Edge> {
    let ends = value.get("endpoints").and_then(Value::as_array).filter(|l| l.len() == 2);
    let ends = ends.and_then(|l| Some([l[0].as_u64()? as usize, l[1].as_u64()? as usize]));
    let Some(ends) = ends.filter(|e| e.iter().all(|i| *i < count) && e[0] != e[1]) else {
        return r.fail(place, "`endpoints` must be two different vertices of the panel");
    };
    let curve = match value.get("curvature") {
        None | Some(Value::Null) => Curve::Straight,
        Some(c) => curve(c, place, r)?,
    };
    let label = value.get("label").and_then(Value::as_str).filter(|l| !l.is_empty()).map(str::to_owned);
    Some(Edge { ends, curve, label })
}

/// `[x, y]` of the older form, or `{type, params}`.
fn curve(value: &Value, place: &str, r: &mut Reader) -> Option<Curve> {
    if value.is_array() {
        return Some(Curve::Quadratic(r.point(value, place)?));
    }
    let params = value.get("params").and_then(Value::as_array).map_or(&[] as &[Value], Vec::as_slice);
    match (value.get("type").and_then(Value::as_str), params) {
        (Some("quadratic"), [p]) => Some(Curve::Quadratic(r.point(p, place)?)),
        (Some("cubic"), [p, q]) => Some(Curve::Cubic(r.point(p, place)?, r.point(q, place)?)),
        (Some("circle"), [radius, large, right]) => {
            let truth = |v: &Value| v.as_bool().unwrap_or_else(|| v.as_f64().is_some_and(|n| n != 0.0));
            let radius = r.number(radius, place)?;
            if radius <= 0.0 {
                return r.fail(place, "the radius of an arc must be above 0");
            }
            Some(Curve::Arc { radius, large: truth(large), right: truth(right) })
        }
        (kind, _) => {
            let kind = kind.unwrap_or("none");
            r.fail(place, &format!("curvature `{kind}` with {} parameters cannot be read", params.len()))
        }
    }
}

fn stitches(pattern: &Value, panels: &[Panel], r: &mut Reader) -> Option<Vec<Stitch>> {
    let Some(list) = pattern.get("stitches") else { return Some(Vec::new()) };
    let Some(list) = list.as_array().filter(|l| l.len() <= STITCHES) else {
        return r.fail("the stitches", &format!("a list of at most {STITCHES} stitches is needed"));
    };
    let side = |v: &Value| {
        let name = v.get("panel")?.as_str()?;
        let panel = panels.iter().position(|p| p.name == name)?;
        let edge = usize::try_from(v.get("edge")?.as_u64()?).ok()?;
        (edge < panels[panel].edges.len()).then_some((panel, edge))
    };
    let mut out = Vec::new();
    for (i, stitch) in list.iter().enumerate() {
        let parts = stitch.as_array().map_or(&[] as &[Value], Vec::as_slice);
        let sides = parts.first().and_then(side).zip(parts.get(1).and_then(side));
        match sides {
            // A third entry says that right side meets wrong side.
            Some((a, b)) => {
                let same = parts.get(2).is_some_and(|v| v.as_bool().unwrap_or(v.is_string()));
                out.push(Stitch { sides: [a, b], same });
            }
            None => {
                r.fail::<()>(&format!("stitch {i}"), "it does not name two edges of panels that are there");
            }
        }
    }
    Some(out)
}
