//! Quantities in text: always a number with a unit; a bare number is refused with a hint.
//!
//! Inside, everything is SI. Conversions stand here and nowhere else.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;

/// Why a quantity was refused.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct UnitError {
    /// The mistake, and the text to write instead.
    pub message: String,
}

/// A physical dimension: its units with their factors to SI. The first unit is the one values are written in.
pub trait Dimension {
    /// Name for messages, e.g. `length`.
    const NAME: &'static str;
    /// An example for hints.
    const EXAMPLE: &'static str;
    /// Units and factors to SI.
    const UNITS: &'static [(&'static str, f64)];
}

/// Reads `"8 mm"` as metres, and so on.
///
/// # Errors
/// When the text has no number, no unit, an unknown unit, or a number that is not finite.
pub fn parse<D: Dimension>(text: &str) -> Result<f64, UnitError> {
    let text = text.trim();
    let split = text
        .char_indices()
        .find(|(i, c)| !(c.is_ascii_digit() || "+-.".contains(*c) || is_exponent(text, *i)))
        .map_or(text.len(), |(i, _)| i);
    let (number, unit) = (text[..split].trim(), text[split..].trim());
    let value: f64 = number.parse().map_err(|_| UnitError {
        message: format!("`{text}` is no {}; write a number and a unit, e.g. \"{}\"", D::NAME, D::EXAMPLE),
    })?;
    if !value.is_finite() {
        return Err(UnitError { message: format!("`{text}` is no finite {}", D::NAME) });
    }
    if unit.is_empty() {
        let hint = D::UNITS.iter().map(|(u, _)| *u).collect::<Vec<_>>().join(", ");
        return Err(UnitError { message: format!("a {} needs a unit ({hint}), e.g. \"{}\"", D::NAME, D::EXAMPLE) });
    }
    D::UNITS.iter().find(|(u, _)| *u == unit).map(|(_, factor)| value * factor).ok_or_else(|| UnitError {
        message: format!(
            "unknown unit `{unit}` of a {}; use one of {}",
            D::NAME,
            D::UNITS.iter().map(|(u, _)| *u).collect::<Vec<_>>().join(", ")
        ),
    })
}

fn is_exponent(text: &str, at: usize) -> bool {
    let bytes = text.as_bytes();
    matches!(bytes[at], b'e' | b'E')
        && at > 0
        && bytes[at - 1].is_ascii_digit()
        && bytes.get(at + 1).is_some_and(|c| {
            c.is_ascii_digit() || ((*c == b'-' || *c == b'+') && bytes.get(at + 2).is_some_and(u8::is_ascii_digit))
        })
}

macro_rules! quantity {
    ($(#[$doc:meta])* $name:ident, $label:literal, $example:literal, [$(($unit:literal, $factor:expr)),+ $(,)?]) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
        pub struct $name(pub f64);

        impl Dimension for $name {
            const NAME: &'static str = $label;
            const EXAMPLE: &'static str = $example;
            const UNITS: &'static [(&'static str, f64)] = &[$(($unit, $factor)),+];
        }

        quantity_as_text!($name, $label, $example);
    };
}

/// Makes a quantity readable from text with a unit, and writable as such, in every place where texts stand.
macro_rules! quantity_as_text {
    ($name:ident, $label:literal, $example:literal) => {
        impl std::str::FromStr for $name {
            type Err = UnitError;
            fn from_str(text: &str) -> Result<Self, UnitError> {
                parse::<Self>(text).map(Self)
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                let (unit, factor) = Self::UNITS[0];
                write!(f, "{} {unit}", crate::units::tidy(self.0 / factor))
            }
        }

        impl Serialize for $name {
            fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
                s.collect_str(self)
            }
        }

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
                d.deserialize_any(TextVisitor::<Self>::new())
            }
        }

        impl JsonSchema for $name {
            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }
            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                json_schema!({
                    "type": "string",
                    "description": concat!("a ", $label, " with its unit, e.g. ", $example),
                    "examples": [$example]
                })
            }
        }
    };
}

quantity!(
    /// Length, metres inside.
    Length, "length", "8 mm", [("mm", 1e-3), ("cm", 1e-2), ("m", 1.0), ("in", 0.0254), ("um", 1e-6), ("µm", 1e-6)]
);
quantity!(
    /// Angle, radians inside.
    Angle, "angle", "15 deg", [("deg", std::f64::consts::PI / 180.0), ("°", std::f64::consts::PI / 180.0), ("rad", 1.0)]
);
quantity!(
    /// Share, a plain ratio inside.
    Share, "share", "3 %", [("%", 1e-2)]
);
quantity!(
    /// Areal mass, kg/m² inside.
    ArealMass, "areal mass", "120 g/m2", [("g/m2", 1e-3), ("g/m²", 1e-3), ("kg/m2", 1.0), ("kg/m²", 1.0), ("mg/cm2", 1e-2), ("oz/yd2", 0.033_905_75)]
);
quantity!(
    /// Tension or stretch stiffness per width, N/m inside.
    LineForce, "tension per width", "500 N/m", [("N/m", 1.0), ("N/mm", 1e3), ("N/cm", 1e2), ("gf/cm", 0.980_665)]
);
quantity!(
    /// Shear stiffness, N/m per radian inside.
    Shear, "shear stiffness", "45 N/m/rad", [("N/m/rad", 1.0), ("N/(m rad)", 1.0), ("N/m", 1.0), ("gf/cm/deg", 56.188), ("gf/(cm deg)", 56.188)]
);
quantity!(
    /// Bending rigidity per width, N·m inside.
    Bending, "bending rigidity", "8 uN.m", [("uN.m", 1e-6), ("µN·m", 1e-6), ("µN.m", 1e-6), ("N.m", 1.0), ("N·m", 1.0), ("N m", 1.0), ("gf.cm2/cm", 9.806_65e-5)]
);
quantity!(
    /// Bending hysteresis 2HB, N inside.
    Hysteresis, "bending hysteresis", "0.4 mN", [("mN", 1e-3), ("N", 1.0), ("gf.cm/cm", 9.806_65e-3)]
);
quantity!(
    /// Curvature, 1/m inside.
    Curvature, "curvature", "20 1/m", [("1/m", 1.0), ("/m", 1.0), ("1/cm", 100.0), ("/cm", 100.0)]
);
quantity!(
    /// Time, seconds inside.
    Duration, "duration", "2 s", [("s", 1.0), ("ms", 1e-3), ("min", 60.0)]
);
quantity!(
    /// Memory of a program, MB inside.
    Memory, "memory", "800 MB", [("MB", 1.0), ("GB", 1e3)]
);
quantity!(
    /// Speed, m/s inside.
    Speed, "speed", "2 mm/s", [("mm/s", 1e-3), ("m/s", 1.0)]
);
quantity!(
    /// Acceleration, m/s² inside.
    Acceleration, "acceleration", "9.81 m/s2", [("m/s2", 1.0), ("m/s²", 1.0)]
);
quantity!(
    /// Pressure, Pa inside.
    Pressure, "pressure", "50 Pa", [("Pa", 1.0), ("hPa", 100.0), ("kPa", 1e3), ("mbar", 100.0), ("mmHg", 133.322_387_415)]
);
quantity!(
    /// Force, N inside.
    Force, "force", "1 N", [("N", 1.0), ("mN", 1e-3), ("gf", 9.806_65e-3)]
);

/// Shortest decimal that is equal to the value to twelve digits: `0.012 / 0.001` prints as 12.
#[must_use]
pub fn tidy(value: f64) -> f64 {
    format!("{value:.12e}").parse().unwrap_or(value)
}

struct TextVisitor<T>(std::marker::PhantomData<T>);

impl<T> TextVisitor<T> {
    fn new() -> Self {
        Self(std::marker::PhantomData)
    }
}

impl<T: Dimension + std::str::FromStr<Err = UnitError>> serde::de::Visitor<'_> for TextVisitor<T> {
    type Value = T;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "a {} with its unit, e.g. \"{}\"", T::NAME, T::EXAMPLE)
    }

    fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<T, E> {
        text.parse().map_err(E::custom)
    }

    fn visit_i64<E: serde::de::Error>(self, n: i64) -> Result<T, E> {
        Err(E::custom(bare::<T>(&n.to_string())))
    }

    fn visit_u64<E: serde::de::Error>(self, n: u64) -> Result<T, E> {
        Err(E::custom(bare::<T>(&n.to_string())))
    }

    fn visit_f64<E: serde::de::Error>(self, n: f64) -> Result<T, E> {
        Err(E::custom(bare::<T>(&n.to_string())))
    }
}

fn bare<T: Dimension>(number: &str) -> String {
    format!("a {} needs a unit: write \"{number} {}\", not a bare {number}", T::NAME, T::UNITS[0].0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_numbers_with_units() {
        assert_eq!("8 mm".parse::<Length>().expect("length").0, 0.008);
        assert_eq!("1e-2 m".parse::<Length>().expect("length").0, 0.01);
        assert_eq!("120 g/m2".parse::<ArealMass>().expect("mass").0, 0.12);
        assert!(
            ("1 gf/cm/deg".parse::<Shear>().expect("shear").0 - 0.980_665 * 180.0 / std::f64::consts::PI).abs() < 1e-3
        );
    }

    #[test]
    fn refuses_bare_numbers_and_foreign_units() {
        assert!("8".parse::<Length>().expect_err("bare").message.contains("needs a unit"));
        assert!("8 kg".parse::<Length>().expect_err("unit").message.contains("unknown unit"));
        assert!("nan mm".parse::<Length>().is_err());
        assert!("1e999 mm".parse::<Length>().is_err());
    }

    #[test]
    fn writes_what_it_read() {
        assert_eq!("12 mm".parse::<Length>().expect("length").to_string(), "12 mm");
    }
}
