//! What may stand in a fabric file: keys, units and allowed ranges.

use toile_garment::units::{
    ArealMass, Bending, Dimension, Hysteresis, Length, LineForce, Share, Shear, UnitError, parse,
};

/// Unit of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    Length,
    ArealMass,
    LineForce,
    Shear,
    Bending,
    Hysteresis,
    Share,
    /// A plain number without dimension.
    Ratio,
}

/// One key: where it may stand, its unit and its range in SI.
#[derive(Debug)]
pub struct Field {
    /// Tables it may stand in; `""` is the top of the file.
    pub tables: &'static [&'static str],
    pub key: &'static str,
    pub unit: Unit,
    /// Smallest allowed value.
    pub min: f64,
    /// Largest allowed value.
    pub max: f64,
    /// The range in words.
    pub allowed: &'static str,
}

const TOP: &[&str] = &[""];
const LAWS: &[&str] = &["linear", "kes", "fast", "curve"];
const LAWS_ISO: &[&str] = &["linear", "isotropic", "kes", "fast", "curve"];
const LINEAR: &[&str] = &["linear"];
const ISOTROPIC: &[&str] = &["isotropic"];
const KES: &[&str] = &["kes"];
const FAST: &[&str] = &["fast"];
const SPRINGS: &[&str] = &["springs"];

/// Tables of a fabric file.
pub const TABLES: &[&str] = &["linear", "isotropic", "kes", "fast", "curve", "springs"];
/// Texts at the top of a fabric file, and at the head of each table.
pub const TEXTS: &[&str] = &["name", "method", "source", "note"];

const STRETCH: &str = "1 N/m to 1e8 N/m";
const BEND: &str = "0 N.m to 1 N.m";
const STRAIN: &str = "0.05 % to 300 %";
const BEND_LENGTH: &str = "1 mm to 200 mm";

macro_rules! fields {
    ($($tables:ident $key:literal $unit:ident $min:literal $max:literal $allowed:expr;)*) => {
        /// Every key.
        pub const FIELDS: &[Field] = &[$(Field {
            tables: $tables, key: $key, unit: Unit::$unit, min: $min, max: $max, allowed: $allowed,
        }),*];
    };
}

fields! {
    TOP "areal_mass" ArealMass 1e-3 10.0 "1 g/m2 to 10 kg/m2";
    TOP "thickness" Length 1e-6 0.05 "0.001 mm to 50 mm";
    TOP "friction" Ratio 0.0 10.0 "0 to 10";
    TOP "strain_limit_warp" Share 5e-4 3.0 STRAIN;
    TOP "strain_limit_weft" Share 5e-4 3.0 STRAIN;
    TOP "strain_limit_bias" Share 5e-4 3.0 STRAIN;
    LINEAR "stretch_warp" LineForce 1.0 1e8 STRETCH;
    LINEAR "stretch_weft" LineForce 1.0 1e8 STRETCH;
    ISOTROPIC "stretch" LineForce 1.0 1e8 STRETCH;
    LAWS_ISO "poisson" Ratio 0.0 0.4999 "0 to below 0.5";
    LAWS "shear" Shear 1e-3 1e7 "0.001 N/m/rad to 1e7 N/m/rad";
    LAWS_ISO "bending" Bending 0.0 1.0 BEND;
    LAWS "bending_warp" Bending 0.0 1.0 BEND;
    LAWS "bending_weft" Bending 0.0 1.0 BEND;
    LAWS "bending_bias" Bending 0.0 1.0 BEND;
    LAWS "bending_hysteresis" Hysteresis 0.0 1.0 "0 N to 1 N";
    KES "emt_warp" Share 5e-4 3.0 STRAIN;
    KES "emt_weft" Share 5e-4 3.0 STRAIN;
    KES "lt_warp" Ratio 0.05 1.0 "0.05 to 1";
    KES "lt_weft" Ratio 0.05 1.0 "0.05 to 1";
    FAST "e5_warp" Share 1e-6 3.0 "above 0 % to 300 %";
    FAST "e20_warp" Share 1e-6 3.0 "above 0 % to 300 %";
    FAST "e100_warp" Share 1e-6 3.0 "above 0 % to 300 %";
    FAST "e5_weft" Share 1e-6 3.0 "above 0 % to 300 %";
    FAST "e20_weft" Share 1e-6 3.0 "above 0 % to 300 %";
    FAST "e100_weft" Share 1e-6 3.0 "above 0 % to 300 %";
    FAST "eb5" Share 1e-4 3.0 "0.01 % to 300 %";
    FAST "bending_length_warp" Length 1e-3 0.2 BEND_LENGTH;
    FAST "bending_length_weft" Length 1e-3 0.2 BEND_LENGTH;
    FAST "bending_length_bias" Length 1e-3 0.2 BEND_LENGTH;
    SPRINGS "yarn" LineForce 1e-3 1e8 "0.001 N/m to 1e8 N/m";
    SPRINGS "bias" LineForce 1e-3 1e8 "0.001 N/m to 1e8 N/m";
}

/// The field of a key in a table.
pub fn find(table: &str, key: &str) -> Option<&'static Field> {
    FIELDS.iter().find(|f| f.key == key && f.tables.contains(&table))
}

/// Keys known in a table.
pub fn known(table: &'static str) -> impl Iterator<Item = &'static str> {
    let curves: &[&str] = if table == "curve" { &["warp", "weft"] } else { &[] };
    let tables: &[&str] = if table.is_empty() { TABLES } else { &[] };
    FIELDS
        .iter()
        .filter(move |f| f.tables.contains(&table))
        .map(|f| f.key)
        .chain(TEXTS.iter().copied())
        .chain(curves.iter().copied())
        .chain(tables.iter().copied())
}

/// The value of a text in SI.
pub fn value(unit: Unit, text: &str) -> Result<f64, UnitError> {
    // Spellings of the same unit that people and other programs write.
    let text = text.replace(" per ", "/").replace("^2", "2").replace("Nm", "N.m").replace("N*m", "N.m");
    let text = text.replace("/ ", "/").replace(" /", "/");
    match unit {
        Unit::Length => parse::<Length>(&text),
        Unit::ArealMass => parse::<ArealMass>(&text),
        Unit::LineForce => parse::<LineForce>(&text),
        Unit::Shear => parse::<Shear>(&text),
        Unit::Bending => parse::<Bending>(&text),
        Unit::Hysteresis => parse::<Hysteresis>(&text),
        Unit::Share => parse::<Share>(&text),
        Unit::Ratio => text.trim().parse::<f64>().ok().filter(|v| v.is_finite()).ok_or_else(|| UnitError {
            message: format!("`{text}` is not a finite number; write a plain ratio, e.g. 0.3"),
        }),
    }
}

/// How a bare number should have been written.
pub fn with_unit(unit: Unit, number: &str) -> String {
    fn first<D: Dimension>() -> &'static str {
        D::UNITS[0].0
    }
    let name = match unit {
        Unit::Length => first::<Length>(),
        Unit::ArealMass => first::<ArealMass>(),
        Unit::LineForce => first::<LineForce>(),
        Unit::Shear => first::<Shear>(),
        Unit::Bending => "N.m",
        Unit::Hysteresis => "N",
        Unit::Share => first::<Share>(),
        Unit::Ratio => "",
    };
    format!("{number} {name}")
}
