//! The text beside a body's mesh: measures, landmarks and segments with units.

use std::fmt::Write as _;
use toile_garment::Vec3;
use toile_garment::body::Body;

/// The side file of a body (TOML), lengths in millimetres to the micrometre.
#[must_use]
pub fn side_text(body: &Body) -> String {
    // A JSON string is a TOML string.
    let mut text = format!("name = {}\n\n[measures]\n", serde_json::Value::from(body.name.as_str()));
    // Writing to a String cannot fail.
    for (name, value) in &body.measures {
        let _ = writeln!(text, "{name} = \"{}\"", length(*value));
    }
    text.push_str("\n[landmarks]\n");
    for (name, p) in &body.landmarks {
        let _ = writeln!(text, "{name} = {}", point(p));
    }
    for (name, s) in &body.segments {
        let _ = writeln!(text, "\n[segments.{name}]\nfrom = {}\nto = {}", point(&s.from), point(&s.to));
        let _ = writeln!(text, "half_width = \"{}\"\nhalf_depth = \"{}\"", length(s.half_width), length(s.half_depth));
    }
    text
}

fn point(p: &Vec3) -> String {
    format!("[\"{}\", \"{}\", \"{}\"]", length(p.x), length(p.y), length(p.z))
}

fn length(metres: f64) -> String {
    let text = format!("{:.3}", metres * 1000.0 + 0.0);
    let short = text.trim_end_matches('0').trim_end_matches('.');
    format!("{} mm", if short == "-0" { "0" } else { short })
}
