//! The keys of a fabric file with their units and allowed ranges.

use toile_garment::units::{
    Angle, ArealMass, Bending, Curvature, Dimension, Hysteresis, Length, LineForce, Share, Shear, UnitError, parse,
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
    Curvature,
    Share,
    Angle,
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
    /// Meaning of the value, for the schema and the book.
    pub about: &'static str,
}

const TOP: &[&str] = &[""];
const LAWS: &[&str] = &["linear", "kes", "fast", "curve"];
const LAWS_ISO: &[&str] = &["linear", "isotropic", "kes", "fast", "curve"];
const LINEAR: &[&str] = &["linear"];
const ISOTROPIC: &[&str] = &["isotropic"];
const KES: &[&str] = &["kes"];
const FAST: &[&str] = &["fast"];
const SPRINGS: &[&str] = &["springs"];
const LOOK: &[&str] = &["look"];

/// Tables of a fabric file.
pub const TABLES: &[&str] = &["linear", "isotropic", "kes", "fast", "curve", "springs", "look"];
/// Texts at the top of a fabric file, and at the head of each table.
pub const TEXTS: &[&str] = &["name", "method", "source", "note"];

const STRETCH: &str = "1 N/m to 1e8 N/m";
const BEND: &str = "0 N.m to 1 N.m";
const STRAIN: &str = "0.05 % to 300 %";
const CURL: &str = "-1000 1/m to 1000 1/m";
const BEND_LENGTH: &str = "1 mm to 200 mm";

macro_rules! fields {
    ($($tables:ident $key:literal $unit:ident $min:literal $max:literal $allowed:tt $about:literal;)*) => {
        /// Every key.
        pub const FIELDS: &[Field] = &[$(Field {
            tables: $tables, key: $key, unit: Unit::$unit, min: $min, max: $max, allowed: $allowed, about: $about,
        }),*];
    };
}

fields! {
    TOP "areal_mass" ArealMass 1e-3 10.0 "1 g/m2 to 10 kg/m2"
        "Mass of one square metre of cloth.";
    TOP "thickness" Length 1e-6 0.05 "0.001 mm to 50 mm"
        "Thickness of the cloth.";
    TOP "friction" Ratio 0.0 10.0 "0 to 10"
        "Coefficient of Coulomb friction of cloth on the body and on itself.";
    TOP "strain_limit_warp" Share 5e-4 3.0 STRAIN
        "Largest stretch along the warp. Default: EMT of `[kes]`, else 5 %, or E100 of `[fast]` if larger.";
    TOP "strain_limit_weft" Share 5e-4 3.0 STRAIN
        "Largest stretch along the weft. Default: EMT of `[kes]`, else 5 %, or E100 of `[fast]` if larger.";
    TOP "strain_limit_bias" Share 5e-4 3.0 STRAIN
        "Largest stretch at 45° to warp and weft. Default: none.";
    TOP "rest_curvature_warp" Curvature -1000.0 1000.0 CURL
        "Curvature of unloaded cloth along the warp; above 0 where its right side is hollow. Default: it lies flat.";
    TOP "rest_curvature_weft" Curvature -1000.0 1000.0 CURL
        "Curvature of unloaded cloth along the weft; above 0 where its right side is hollow. Default: it lies flat.";
    LINEAR "stretch_warp" LineForce 1.0 1e8 STRETCH
        "Slope of tension over strain in a strip test along the warp, with free sides.";
    LINEAR "stretch_weft" LineForce 1.0 1e8 STRETCH
        "Slope of tension over strain in a strip test along the weft, with free sides.";
    ISOTROPIC "stretch" LineForce 1.0 1e8 STRETCH
        "Young's modulus times thickness, the same in all directions. The shear stiffness follows from it.";
    LAWS_ISO "poisson" Ratio 0.0 0.4999 "0 to below 0.5"
        "Contraction along the weft over extension along the warp, in a strip test along the warp. Default: 0.";
    LAWS "shear" Shear 1e-3 1e7 "0.001 N/m/rad to 1e7 N/m/rad"
        "Shear stiffness: shear force per width over the shear angle in radians.";
    LAWS_ISO "bending" Bending 0.0 1.0 BEND
        "Bending rigidity per width, the same along warp and weft.";
    LAWS "bending_warp" Bending 0.0 1.0 BEND
        "Bending rigidity per width of a strip along the warp (B of KES-F).";
    LAWS "bending_weft" Bending 0.0 1.0 BEND
        "Bending rigidity per width of a strip along the weft (B of KES-F).";
    LAWS "bending_bias" Bending 0.0 1.0 BEND
        "Bending rigidity per width of a strip at 45°. Default: derived from warp and weft.";
    LAWS "bending_hysteresis" Hysteresis 0.0 1.0 "0 N to 1 N"
        "Width of the bending hysteresis loop, 2HB of KES-F. Default: none.";
    KES "emt_warp" Share 5e-4 3.0 STRAIN
        "EMT of KES-F: strain along the warp at 500 gf/cm.";
    KES "emt_weft" Share 5e-4 3.0 STRAIN
        "EMT of KES-F: strain along the weft at 500 gf/cm.";
    KES "lt_warp" Ratio 0.05 1.0 "0.05 to 1"
        "LT of KES-F: linearity of the tension curve along the warp; 1 is a straight line.";
    KES "lt_weft" Ratio 0.05 1.0 "0.05 to 1"
        "LT of KES-F: linearity of the tension curve along the weft; 1 is a straight line.";
    FAST "e5_warp" Share 1e-6 3.0 "above 0 % to 300 %"
        "E5 of FAST-1: strain along the warp at 5 gf/cm.";
    FAST "e20_warp" Share 1e-6 3.0 "above 0 % to 300 %"
        "E20 of FAST-1: strain along the warp at 20 gf/cm.";
    FAST "e100_warp" Share 1e-6 3.0 "above 0 % to 300 %"
        "E100 of FAST-1: strain along the warp at 100 gf/cm.";
    FAST "e5_weft" Share 1e-6 3.0 "above 0 % to 300 %"
        "E5 of FAST-1: strain along the weft at 5 gf/cm.";
    FAST "e20_weft" Share 1e-6 3.0 "above 0 % to 300 %"
        "E20 of FAST-1: strain along the weft at 20 gf/cm.";
    FAST "e100_weft" Share 1e-6 3.0 "above 0 % to 300 %"
        "E100 of FAST-1: strain along the weft at 100 gf/cm.";
    FAST "eb5" Share 1e-4 3.0 "0.01 % to 300 %"
        "EB5 of FAST-3: strain of a bias strip at 5 gf/cm. The shear stiffness is 1.23 N/m over this strain.";
    FAST "bending_length_warp" Length 1e-3 0.2 BEND_LENGTH
        "Bending length of FAST-2, along the warp. The rigidity is areal mass · g · length³.";
    FAST "bending_length_weft" Length 1e-3 0.2 BEND_LENGTH
        "Bending length of FAST-2, along the weft. The rigidity is areal mass · g · length³.";
    FAST "bending_length_bias" Length 1e-3 0.2 BEND_LENGTH
        "Bending length of FAST-2, at 45° to the yarns. The rigidity is areal mass · g · length³.";
    SPRINGS "yarn" LineForce 1e-3 1e8 "0.001 N/m to 1e8 N/m"
        "Spring constant of mesh edges within 22.5° of warp or weft, for `model = \"springs\"`.";
    SPRINGS "bias" LineForce 1e-3 1e8 "0.001 N/m to 1e8 N/m"
        "Spring constant of all other mesh edges, for `model = \"springs\"`.";
    LOOK "ends_per_cm" Ratio 1.0 400.0 "1 to 400"
        "Ends (warp yarns) or wales in one centimetre.";
    LOOK "picks_per_cm" Ratio 1.0 400.0 "1 to 400"
        "Picks (weft yarns) or courses in one centimetre.";
    LOOK "sheen" Ratio 0.0 1.0 "0 to 1"
        "Light that fibres throw back at a flat angle: 0 none, 1 velvet.";
    LOOK "roughness" Ratio 0.0 1.0 "0 to 1"
        "Roughness of the surface: 0 a mirror, 1 chalk.";
}

/// The field of a key in a table.
pub fn find(table: &str, key: &str) -> Option<&'static Field> {
    FIELDS.iter().find(|f| f.key == key && f.tables.contains(&table))
}

/// Keys known in a table.
pub fn known(table: &'static str) -> impl Iterator<Item = &'static str> {
    let curves: &[&str] = match table {
        "curve" => super::curve::WORDS,
        "look" => super::look::WORDS,
        _ => &[],
    };
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
        Unit::Curvature => parse::<Curvature>(&text),
        Unit::Share => parse::<Share>(&text),
        Unit::Angle => parse::<Angle>(&text),
        Unit::Ratio => text.trim().parse::<f64>().ok().filter(|v| v.is_finite()).ok_or_else(|| UnitError {
            message: format!("`{text}` is not a finite number; write a plain ratio, e.g. 0.3"),
        }),
    }
}

/// The units of a value with their factors to SI; nothing for a plain number.
pub fn units(unit: Unit) -> Option<&'static [(&'static str, f64)]> {
    match unit {
        Unit::Length => Some(Length::UNITS),
        Unit::ArealMass => Some(ArealMass::UNITS),
        Unit::LineForce => Some(LineForce::UNITS),
        Unit::Shear => Some(Shear::UNITS),
        Unit::Bending => Some(Bending::UNITS),
        Unit::Hysteresis => Some(Hysteresis::UNITS),
        Unit::Curvature => Some(Curvature::UNITS),
        Unit::Share => Some(Share::UNITS),
        Unit::Angle => Some(Angle::UNITS),
        Unit::Ratio => None,
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
        Unit::Curvature => first::<Curvature>(),
        Unit::Share => first::<Share>(),
        Unit::Angle => first::<Angle>(),
        Unit::Ratio => "",
    };
    format!("{number} {name}")
}
