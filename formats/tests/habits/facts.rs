//! The facts that must come out of a file.

use serde_json::Value;
use toile_formats::dxf::{ReadOptions, inspect_with};

/// A file and its facts.
#[derive(Clone)]
pub struct Case {
    pub name: &'static str,
    pub bytes: Vec<u8>,
    pub rul: Option<Vec<u8>>,
    pub options: ReadOptions,
    /// Millimetres per unit.
    pub unit: f64,
    /// Codes of findings that must be there.
    pub codes: Vec<&'static str>,
    /// Writer, where the file shows it.
    pub vendor: Option<&'static str>,
    pub pieces: Vec<Facts>,
    /// Corners of one piece in one size.
    pub graded: Option<Graded>,
}

/// A piece, a size and the corners it then has.
pub type Graded = (&'static str, &'static str, Vec<(f64, f64)>);

/// Facts of a piece, mm and cm².
#[derive(Clone)]
pub struct Facts {
    pub name: Option<&'static str>,
    pub size: Option<&'static str>,
    pub area: f64,
    pub net_area: f64,
    pub perimeter: f64,
    pub darts: Vec<(&'static str, (f64, f64))>,
    pub marks: usize,
    pub strokes: usize,
    pub drills: usize,
    pub internal: usize,
    pub cutouts: usize,
    pub half: bool,
    pub quantity: [u64; 2],
}

/// √(15² + 100²), twice, and what remains of 1800 mm.
pub const ROUND: f64 = 1972.2375;

impl Case {
    pub fn new(name: &'static str, bytes: Vec<u8>, pieces: Vec<Facts>) -> Self {
        Self {
            name,
            bytes,
            rul: None,
            options: ReadOptions::default(),
            unit: 1.0,
            codes: Vec::new(),
            vendor: None,
            pieces,
            graded: None,
        }
    }

    pub fn by(self, vendor: &'static str) -> Self {
        Self { vendor: Some(vendor), ..self }
    }

    pub fn unit(self, unit: f64) -> Self {
        Self { unit, ..self }
    }

    pub fn tells(self, codes: &[&'static str]) -> Self {
        Self { codes: codes.to_vec(), ..self }
    }

    pub fn layers(mut self, map: &[(&str, &str)]) -> Self {
        self.options.layers = map.iter().map(|(a, b)| ((*a).to_owned(), (*b).to_owned())).collect();
        self
    }

    pub fn graded(self, rul: &str, piece: &'static str, size: &'static str, corners: &[(f64, f64)]) -> Self {
        Self { rul: Some(rul.as_bytes().to_vec()), graded: Some((piece, size, corners.to_vec())), ..self }
    }
}

/// The rectangle.
pub fn plain(name: &'static str) -> Facts {
    Facts {
        name: Some(name),
        size: None,
        area: 1800.0,
        net_area: 1800.0,
        perimeter: 1800.0,
        darts: Vec::new(),
        marks: 0,
        strokes: 0,
        drills: 0,
        internal: 0,
        cutouts: 0,
        half: false,
        quantity: [1, 0],
    }
}

/// The rectangle with its wedge.
pub fn wedge(name: &'static str) -> Facts {
    let darts = vec![("boundary_wedge", (150.0, 500.0))];
    Facts { area: 1785.0, net_area: 1785.0, perimeter: ROUND, darts, ..plain(name) }
}

/// The differences from those facts.
pub fn check(case: &Case) -> Vec<String> {
    let inspection = match inspect_with(&case.bytes, "t.dxf", case.rul.as_deref(), &case.options) {
        Ok(inspection) => inspection,
        Err(errors) => return vec![format!("refused: {:?}", errors[0])],
    };
    let json = &inspection.json;
    let mut faults = Vec::new();
    let mut same = |what: &str, a: &Value, b: Value| {
        let near = |a: &Value, b: &Value| a.as_f64().zip(b.as_f64()).is_some_and(|(a, b)| (a - b).abs() <= 0.011);
        if *a != b && !near(a, &b) {
            faults.push(format!("{what} is {a}, not {b}"));
        }
    };
    same("unit", &json["mm_per_unit"], case.unit.into());
    if let Some(vendor) = case.vendor {
        same("vendor", &json["profile"]["vendor"], vendor.into());
    }
    let l = &json["ledger"];
    let sum = ["accepted", "interpreted", "refused"].map(|k| l[k].as_u64().unwrap_or(0)).iter().sum::<u64>();
    same("ledger", &l["entities"], sum.into());
    same("pieces", &json["pieces"].as_array().map_or(0, Vec::len).into(), case.pieces.len().into());
    for (i, facts) in case.pieces.iter().enumerate() {
        let p = &json["pieces"][i];
        same("name", &p["name"], facts.name.map_or(Value::Null, Value::from));
        same("size", &p["size"], facts.size.map_or(Value::Null, Value::from));
        same("area", &p["area_cm2"], facts.area.into());
        same("net area", &p["net_area_cm2"], facts.net_area.into());
        same("perimeter", &p["perimeter_mm"], facts.perimeter.into());
        same("marks", &p["notch_count"], facts.marks.into());
        same("strokes", &p["stroke_notch_count"], facts.strokes.into());
        same("drills", &p["drill_count"], facts.drills.into());
        same("internal", &p["internal_line_count"], facts.internal.into());
        same("cutouts", &p["cutout_count"], facts.cutouts.into());
        same("half", &p["half_piece_on_fold"], facts.half.into());
        same("quantity", &p["quantity_pair"], facts.quantity.to_vec().into());
        same("darts", &p["dart_count"], facts.darts.len().into());
        for (d, (kind, apex)) in facts.darts.iter().enumerate() {
            same("dart kind", &p["darts"][d]["kind"], (*kind).into());
            same("apex x", &p["darts"][d]["apex_mm"][0], apex.0.into());
            same("apex y", &p["darts"][d]["apex_mm"][1], apex.1.into());
        }
    }
    let told: Vec<&str> = inspection.pattern.findings.iter().map(|f| f.code.as_str()).collect();
    for code in case.codes.iter().filter(|c| !told.contains(c)) {
        faults.push(format!("`{code}` is not told; told is {told:?}"));
    }
    if let Some((piece, size, corners)) = &case.graded {
        let list = json["graded_turn_points_mm"][*piece][*size].as_array().cloned().unwrap_or_default();
        for c in corners {
            let at = |v: &Value| (v[0].as_f64().unwrap_or(1e9) - c.0, v[1].as_f64().unwrap_or(1e9) - c.1);
            if !list.iter().any(|v| libm::hypot(at(v).0, at(v).1) <= 0.01) {
                faults.push(format!("{size}: no corner at {c:?} but {list:?}"));
            }
        }
    }
    faults
}
