//! The side file of a body, held against its mesh.

use super::codes;
use super::found::measured;
use super::measures::range_of;
use toile_garment::body::Body;
use toile_garment::{Diagnostic, SourceRef, Vec3};

/// Height of a usual person, m: the ranges of measures are those of adults.
const ADULT: f64 = 1.68;
/// A measure under half of the smallest adult's, or over twice the largest's, is none.
const BEYOND: f64 = 2.0;
/// Places may lie so far outside the mesh, as a share of its height: it may lack a head, hands or feet.
const OUTSIDE: f64 = 0.05;
/// A girth that differs from that of the mesh by more than this share of either is doubtful.
const DIFFERS: f64 = 0.25;

/// The errors on measures that no body has.
#[must_use]
pub fn impossible(body: &Body) -> Vec<Diagnostic> {
    let frame = Frame::around(body);
    body.measures.iter().filter_map(|(name, x)| frame.no_measure(name, *x)).collect()
}

/// The measures, landmarks and segments that cannot be those of this mesh. `side` is the name of the side file.
pub fn check(body: &Body, side: &str) -> Vec<Diagnostic> {
    let frame = Frame::around(body);
    let mut found = impossible(body);
    if found.is_empty() {
        found.extend(body.measures.iter().filter_map(|(name, x)| frame.too_high(name, *x)));
        found.extend(frame.beside(body));
        found.extend(other_girths(body));
    }
    found.into_iter().map(|finding| finding.at(SourceRef::file(side))).collect()
}

/// The box around a mesh.
struct Frame {
    low: Vec3,
    high: Vec3,
    slack: f64,
}

impl Frame {
    fn around(body: &Body) -> Self {
        let far = Vec3::repeat(f64::INFINITY);
        let (low, high) = body.positions.iter().fold((far, -far), |(l, h), p| (l.inf(p), h.sup(p)));
        Self { low, high, slack: OUTSIDE * (high - low).max() }
    }

    /// The error on a measure that no body of this height has.
    fn no_measure(&self, name: &str, x: f64) -> Option<Diagnostic> {
        let (least, most) = range_of(name)?;
        let height = self.high.y - self.low.y;
        let range = least / BEYOND * (height / ADULT).min(1.0)..=most * BEYOND;
        let message =
            || format!("`{name}` is {:.0} mm, which no body has whose mesh is {:.0} mm high", x * 1e3, height * 1e3);
        let hint = || format!("it can be {:.0} mm to {:.0} mm", range.start() * 1e3, range.end() * 1e3);
        (!range.contains(&x)).then(|| Diagnostic::error(codes::BODY_MEASURE_OUT_OF_RANGE, message()).hint(hint()))
    }

    /// The warning on a height over the top of the mesh.
    fn too_high(&self, name: &str, x: f64) -> Option<Diagnostic> {
        let height = self.high.y - self.low.y;
        let is_height = name == "stature" || name.ends_with("_height");
        let message = || {
            format!(
                "`{name}` is {:.0} mm, and the mesh is {:.0} mm high: it is not on this body",
                x * 1e3,
                height * 1e3
            )
        };
        (is_height && x > height + self.slack).then(|| off_the_mesh(message()))
    }

    fn holds(&self, p: Vec3) -> bool {
        let margin = Vec3::repeat(self.slack);
        let (low, high) = (self.low - margin, self.high + margin);
        (0..3).all(|i| (low[i]..=high[i]).contains(&p[i]))
    }

    /// The warning on landmarks and segments that lie beside the mesh.
    fn beside(&self, body: &Body) -> Option<Diagnostic> {
        let landmarks = body.landmarks.iter().filter(|(_, p)| !self.holds(**p)).map(|(name, _)| name);
        let segments = body.segments.iter().filter(|(_, s)| !self.holds(s.from) || !self.holds(s.to));
        let names: Vec<String> = landmarks.chain(segments.map(|(name, _)| name)).map(|n| format!("`{n}`")).collect();
        (!names.is_empty())
            .then(|| off_the_mesh(format!("places of the side file lie beside the mesh: {}", names.join(", "))))
    }
}

fn off_the_mesh(message: String) -> Diagnostic {
    let hint = "correct the side file, or leave its values out: what it does not say is found on the mesh";
    Diagnostic::warning(codes::BODY_NOT_AS_SAID, message).hint(hint)
}

/// The warnings on girths that are not those of the mesh. Heights are looked at as the side file says them.
fn other_girths(body: &Body) -> Vec<Diagnostic> {
    let is_girth = |name: &str| name.ends_with("_girth");
    if !body.measures.keys().any(|name| is_girth(name)) {
        return Vec::new();
    }
    let found = measured(body);
    let differs = |name: &str, x: f64| {
        let mesh = *found.mesh.get(name).filter(|_| is_girth(name))?;
        let is_other = (x - mesh).abs() > DIFFERS * x.max(mesh);
        is_other.then(|| off_the_mesh(format!("`{name}` is {:.0} mm, and {:.0} mm on the mesh", x * 1e3, mesh * 1e3)))
    };
    body.measures.iter().filter_map(|(name, x)| differs(name, *x)).collect()
}

#[cfg(test)]
mod tests {
    use super::check;
    use crate::body::{BodyMeasures, parametric};
    use toile_garment::body::Body;
    use toile_garment::{Severity, Vec3};

    fn said(change: impl FnOnce(&mut Body)) -> Vec<(Severity, String)> {
        let mut body = parametric(&BodyMeasures::default()).expect("body");
        change(&mut body);
        check(&body, "body.toml").into_iter().map(|f| (f.severity, f.message)).collect()
    }

    #[test]
    fn what_the_mesh_has_passes_and_what_it_has_not_is_told() {
        assert_eq!(said(|_| {}), []);
        for (name, value) in
            [("waist_girth", 0.088), ("hip_girth", 7.0), ("waist_height", 9.05), ("waist_height", 0.105)]
        {
            let found = said(|b| {
                b.measures.insert(name.to_owned(), value);
            });
            assert_eq!(found.len(), 1, "{found:?}");
            assert!(found[0].0 == Severity::Error && found[0].1.contains(name), "{found:?}");
        }
        let wide = said(|b| {
            b.measures.insert("waist_girth".to_owned(), 1.2);
        });
        assert!(wide.len() == 1 && wide[0].0 == Severity::Warning && wide[0].1.contains("on the mesh"), "{wide:?}");
        let high = said(|b| {
            b.measures.insert("neck_height".to_owned(), 1.95);
        });
        assert!(high.iter().any(|f| f.1.contains("is not on this body")), "{high:?}");
        let beside = said(|b| {
            b.landmarks.insert("waist-front".to_owned(), Vec3::new(0.0, 0.0, 3.0));
        });
        assert!(beside.len() == 1 && beside[0].1.contains("`waist-front`"), "{beside:?}");
    }
}
