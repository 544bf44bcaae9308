//! From the file's values to the fabric: one source for each property, laws fitted, defaults stated.

use super::codes;
use super::reader::{Entries, Entry};
use super::{kes, poisson};
use std::collections::BTreeMap;
use toile_garment::fabric::{Fabric, SpringConstants, StretchLaw, ValueSource};
use toile_garment::{Diagnostic, SourceRef};

/// Gravity in Peirce's bending length.
const GRAVITY: f64 = 9.81;
/// Tensions at which FAST reads the strain: 5, 20, 100 gf/cm in N/m.
const FAST_TENSIONS: [f64; 3] = [4.903_325, 19.613_3, 98.066_5];
/// `G = 123 / EB5` with EB5 in per cent at 5 gf/cm.
const FAST_SHEAR: f64 = 1.23;
/// Strain limit where none was measured.
const DEFAULT_LIMIT: f64 = 0.05;

type Sources = BTreeMap<String, ValueSource>;

/// The fabric; `None` when a property is missing. Findings stand in the entries.
pub fn fabric(e: &mut Entries) -> Option<Fabric> {
    let mut sources = Sources::new();
    let areal_mass = top(e, "areal_mass", &mut sources);
    let thickness = top(e, "thickness", &mut sources);
    let friction = top(e, "friction", &mut sources);
    let warp = stretch(e, "warp", &mut sources);
    let weft = stretch(e, "weft", &mut sources);
    let ratio = common(e, "poisson", &mut sources).unwrap_or(0.0);
    let shear = shear(e, ratio, &mut sources);
    let (warp, weft, poisson) = match (warp, weft) {
        (Some(warp), Some(weft)) => {
            let coupled = poisson::couple(e, warp, weft, ratio);
            (Some(coupled.warp), Some(coupled.weft), coupled.share)
        }
        (warp, weft) => (warp, weft, ratio),
    };
    let bend_warp = bending(e, "warp", areal_mass, &mut sources);
    let bend_weft = bending(e, "weft", areal_mass, &mut sources);
    let bend_bias = bending(e, "bias", areal_mass, &mut sources);
    let [shear_curve, bend_curve_warp, bend_curve_weft] = ["shear_force", "bending_moment_warp", "bending_moment_weft"]
        .map(|key| e.curves.get(key).map(|c| c.points.clone()));
    let bend_hysteresis = common(e, "bending_hysteresis", &mut sources);
    let [rest_curvature_warp, rest_curvature_weft] =
        ["rest_curvature_warp", "rest_curvature_weft"].map(|key| given(e, key, &mut sources));
    let springs = springs(e, &mut sources);
    let lengths = ["warp", "weft"].iter().any(|d| entry(e, "fast", &format!("bending_length_{d}")).is_some());
    Some(Fabric {
        name: e.name.clone(),
        areal_mass: areal_mass?,
        thickness: thickness?,
        friction: friction?,
        strain_limit_warp: limit(e, "warp", &mut sources),
        strain_limit_weft: limit(e, "weft", &mut sources),
        strain_limit_bias: given(e, "strain_limit_bias", &mut sources),
        stretch_warp: warp?,
        stretch_weft: weft?,
        poisson,
        shear: shear?,
        shear_curve,
        bend_warp: bend_warp?,
        bend_weft: bend_weft?,
        bend_bias,
        bend_curve_warp,
        bend_curve_weft,
        bend_hysteresis,
        bend_holds_friction: lengths,
        rest_curvature_warp,
        rest_curvature_weft,
        springs,
        look: super::look::look(e),
        sources,
    })
}

fn missing(e: &mut Entries, what: &str, hint: &str) {
    let finding = Diagnostic::error(codes::FABRIC_VALUE_MISSING, format!("`{}` gives no {what}", e.whole.file));
    e.findings.push(finding.at(e.whole.clone()).hint(hint));
}

fn top(e: &mut Entries, key: &'static str, sources: &mut Sources) -> Option<f64> {
    match e.values.get(&("", key)) {
        Some(entry) => {
            sources.insert(key.to_owned(), entry.source.clone());
            Some(entry.value)
        }
        None => {
            let already = e.findings.iter().any(|f| f.message.contains(&format!("`{key}")));
            if !already {
                let hint = super::fields::find("", key).map_or("", |f| f.allowed);
                missing(e, key, &format!("write `{key} = …`, allowed is {hint}"));
            }
            None
        }
    }
}

/// A key that may stand in any table of laws, at most once.
fn common(e: &mut Entries, key: &'static str, sources: &mut Sources) -> Option<f64> {
    let found: Vec<(&'static str, Entry)> =
        e.values.iter().filter(|((_, k), _)| *k == key).map(|((t, _), v)| (*t, v.clone())).collect();
    let places: Vec<(String, SourceRef)> = found.iter().map(|(t, v)| (format!("{t}.{key}"), v.at.clone())).collect();
    once(e, key, &places);
    let (_, entry) = found.into_iter().next()?;
    let name = match key {
        "bending_hysteresis" => "bend_hysteresis",
        other => other,
    };
    sources.insert(name.to_owned(), entry.source);
    Some(entry.value)
}

/// A finding when a property is given more than once.
fn once(e: &mut Entries, what: &str, places: &[(String, SourceRef)]) {
    if let [(first, _), (second, at), ..] = places {
        let message = format!("{what} is given twice, as `{first}` and as `{second}`");
        let finding = Diagnostic::error(codes::FABRIC_VALUE_TWICE, message).at(at.clone());
        e.findings.push(finding.hint("keep the one that was measured"));
    }
}

fn entry(e: &Entries, table: &'static str, key: &str) -> Option<Entry> {
    e.values.iter().find(|((t, k), _)| *t == table && *k == key).map(|(_, v)| v.clone())
}

fn stretch(e: &mut Entries, direction: &'static str, sources: &mut Sources) -> Option<StretchLaw> {
    let mut found: Vec<(String, SourceRef, StretchLaw, ValueSource)> = Vec::new();
    let linear_key = format!("stretch_{direction}");
    for (table, key) in [("linear", linear_key.as_str()), ("isotropic", "stretch")] {
        if let Some(v) = entry(e, table, key) {
            found.push((format!("{table}.{key}"), v.at, StretchLaw::Linear { stiffness: v.value }, v.source));
        }
    }
    if let Some(curve) = e.curves.get(direction).cloned() {
        let law = StretchLaw::Samples { points: curve.points };
        found.push((format!("curve.{direction}"), curve.at, law, curve.source));
    }
    found.extend(from_kes(e, direction));
    found.extend(from_fast(e, direction));
    let places: Vec<_> = found.iter().map(|(name, at, ..)| (name.clone(), at.clone())).collect();
    once(e, &format!("stretch along the {direction}"), &places);
    let Some((_, _, law, source)) = found.into_iter().next() else {
        if e.findings.is_empty() {
            let hint = format!(
                "give `[linear] stretch_{direction}`, `[isotropic] stretch`, `[kes] emt_{direction}` and \
                 `lt_{direction}`, `[fast] e5_{direction}` …, or `[curve] {direction}`"
            );
            missing(e, &format!("stretch along the {direction}"), &hint);
        }
        return None;
    };
    sources.insert(format!("stretch_{direction}"), source);
    Some(law)
}

type Found = (String, SourceRef, StretchLaw, ValueSource);

fn from_kes(e: &mut Entries, direction: &str) -> Option<Found> {
    let (emt_key, lt_key) = (format!("emt_{direction}"), format!("lt_{direction}"));
    match (entry(e, "kes", &emt_key), entry(e, "kes", &lt_key)) {
        (Some(emt), Some(lt)) => {
            let law = kes::fit(emt.value, lt.value)?;
            let written = format!("EMT {}, LT {}", emt.source.written, lt.source.written);
            Some((format!("kes.{emt_key}"), emt.at, law, ValueSource { written, ..emt.source }))
        }
        (Some(emt), None) => incomplete(e, &emt_key, &lt_key, emt.at),
        (None, Some(lt)) => incomplete(e, &lt_key, &emt_key, lt.at),
        (None, None) => None,
    }
}

fn incomplete(e: &mut Entries, given: &str, wanted: &str, at: SourceRef) -> Option<Found> {
    let message = format!("`{given}` is given without `{wanted}`");
    // A value that was refused has its own finding already.
    if !e.findings.iter().any(|f| f.message.contains(&format!("`{wanted}"))) {
        e.findings.push(Diagnostic::error(codes::FABRIC_VALUE_MISSING, message).at(at));
    }
    None
}

fn from_fast(e: &mut Entries, direction: &str) -> Option<Found> {
    let keys = ["e5", "e20", "e100"].map(|k| format!("{k}_{direction}"));
    let given: Vec<Option<Entry>> = keys.iter().map(|k| entry(e, "fast", k)).collect();
    let first = given.iter().flatten().next()?.clone();
    let mut points = vec![[0.0, 0.0]];
    for ((key, value), tension) in keys.iter().zip(&given).zip(FAST_TENSIONS) {
        let Some(value) = value else {
            return incomplete(e, keys.iter().find(|k| *k != key)?, key, first.at);
        };
        if points.last().is_some_and(|p: &[f64; 2]| value.value <= p[0]) {
            let message = format!("`{key} = {}` is not above the strain at the lower tension", value.source.written);
            e.findings.push(Diagnostic::error(codes::FABRIC_CURVE, message).at(value.at.clone()));
            return None;
        }
        points.push([value.value, tension]);
    }
    let written = keys.iter().zip(given.iter().flatten()).map(|(k, v)| format!("{k} {}", v.source.written));
    let source = ValueSource { written: written.collect::<Vec<_>>().join(", "), ..first.source };
    Some((format!("fast.{}", keys[0]), first.at, StretchLaw::Samples { points }, source))
}

fn shear(e: &mut Entries, poisson: f64, sources: &mut Sources) -> Option<f64> {
    let plain = common(e, "shear", sources);
    let mut ways: Vec<(f64, Entry, &str)> = Vec::new();
    if let Some(eb5) = entry(e, "fast", "eb5") {
        ways.push((FAST_SHEAR / eb5.value, eb5, "fast.eb5"));
    }
    if let Some(stretch) = entry(e, "isotropic", "stretch") {
        ways.push((stretch.value / (2.0 * (1.0 + poisson)), stretch, "isotropic.stretch"));
    }
    if let Some(curve) = least_slope(e, "shear_force") {
        ways.push((curve.value, curve, "curve.shear_force"));
    }
    let mut places: Vec<_> = ways.iter().map(|(_, v, name)| ((*name).to_owned(), v.at.clone())).collect();
    if plain.is_some() {
        places.insert(0, ("shear".to_owned(), e.whole.clone()));
    }
    once(e, "the shear stiffness", &places);
    if plain.is_some() {
        return plain;
    }
    let Some((value, entry, _)) = ways.into_iter().next() else {
        if e.findings.is_empty() {
            missing(
                e,
                "shear stiffness",
                "give `shear` in N/m/rad in the table of the laws, `[fast] eb5` or `[curve] shear_force`",
            );
        }
        return None;
    };
    sources.insert("shear".to_owned(), entry.source);
    Some(value)
}

fn bending(e: &mut Entries, direction: &str, areal_mass: Option<f64>, sources: &mut Sources) -> Option<f64> {
    let own = format!("bending_{direction}");
    let mut found: Vec<(String, Entry)> = Vec::new();
    for ((table, key), value) in &e.values {
        // One value for all directions also holds on the bias of an isotropic sheet; elsewhere the bias is unknown.
        let all = *key == "bending" && (direction != "bias" || *table == "isotropic");
        if *key == own || all {
            found.push((format!("{table}.{key}"), value.clone()));
        }
    }
    if let Some(curve) = least_slope(e, &format!("bending_moment_{direction}")) {
        found.push((format!("curve.bending_moment_{direction}"), curve));
    }
    if let Some(length) = entry(e, "fast", &format!("bending_length_{direction}")) {
        let c = length.value;
        let value = areal_mass.unwrap_or(0.0) * GRAVITY * c * c * c;
        found.push((format!("fast.bending_length_{direction}"), Entry { value, ..length }));
    }
    let places: Vec<_> = found.iter().map(|(name, v)| (name.clone(), v.at.clone())).collect();
    once(e, &format!("bending along the {direction}"), &places);
    let Some((_, entry)) = found.into_iter().next() else {
        if direction != "bias" && e.findings.is_empty() {
            let hint = format!("give `bending` or `bending_{direction}` in N.m in the table of the laws");
            missing(e, &format!("bending rigidity along the {direction}"), &hint);
        }
        return None;
    };
    sources.insert(format!("bend_{direction}"), entry.source);
    Some(entry.value)
}

/// The smallest slope of a measured curve.
fn least_slope(e: &Entries, key: &str) -> Option<Entry> {
    let curve = e.curves.get(key)?;
    let slopes = curve.points.windows(2).map(|w| (w[1][1] - w[0][1]) / (w[1][0] - w[0][0]));
    let value = slopes.fold(f64::INFINITY, f64::min);
    Some(Entry { value, source: curve.source.clone(), at: curve.at.clone() })
}

/// Constants of the springs, both or none.
fn springs(e: &mut Entries, sources: &mut Sources) -> Option<SpringConstants> {
    match (entry(e, "springs", "yarn"), entry(e, "springs", "bias")) {
        (Some(yarn), Some(bias)) => {
            let written = format!("yarn {}, bias {}", yarn.source.written, bias.source.written);
            sources.insert("springs".to_owned(), ValueSource { written, ..yarn.source });
            Some(SpringConstants { yarn: yarn.value, bias: bias.value })
        }
        (yarn, bias) => {
            let (given, wanted) = if yarn.is_some() { ("yarn", "bias") } else { ("bias", "yarn") };
            incomplete(e, given, wanted, yarn.or(bias)?.at);
            None
        }
    }
}

/// A key at the top of the file that may be missing.
fn given(e: &Entries, key: &str, sources: &mut Sources) -> Option<f64> {
    let given = entry(e, "", key)?;
    sources.insert(key.to_owned(), given.source);
    Some(given.value)
}

fn limit(e: &Entries, direction: &str, sources: &mut Sources) -> f64 {
    let key = format!("strain_limit_{direction}");
    if let Some(given) = given(e, &key, sources) {
        return given;
    }
    if let Some(emt) = entry(e, "kes", &format!("emt_{direction}")) {
        sources.insert(key, ValueSource { method: "EMT of KES-F".to_owned(), ..emt.source });
        return emt.value;
    }
    // Cloth that was measured at 100 gf/cm bears what it showed there.
    let fast = entry(e, "fast", &format!("e100_{direction}")).filter(|e100| e100.value > DEFAULT_LIMIT);
    if let Some(e100) = fast {
        sources.insert(key, ValueSource { method: "E100 of FAST-1".to_owned(), ..e100.source });
        return e100.value;
    }
    let written = format!("{} %", DEFAULT_LIMIT * 100.0);
    sources.insert(key, ValueSource { written, method: "default".to_owned(), source: String::new() });
    DEFAULT_LIMIT
}
