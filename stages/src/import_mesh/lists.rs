//! Text lists of vertices: pins, stitches, loads. `#` starts a comment; indices count from 0.

use super::codes;
use std::collections::BTreeSet;
use toile_garment::{Diagnostic, SourceRef, Vec3};

/// Mistakes that are written out.
const MAX_FINDINGS: usize = 20;
const HINT: &str = "a line names vertices of the cloth's OBJ, counted from 0: `v [x y z]` for a pin, `v w` for a stitch, `v fx fy fz` for a load";
/// Largest coordinate, metres, and force, N.
const MAX_NUMBER: f64 = 1e9;

type Read<T> = Result<Vec<T>, Vec<Diagnostic>>;

/// `index [x y z]`.
pub fn pins(text: &str, file: &str, count: usize) -> Read<(u32, Option<Vec3>)> {
    let mut seen = BTreeSet::new();
    lines(text, file, |words| {
        let (v, point) = match words {
            [v] => (index(v, count)?, None),
            [v, x, y, z] => (index(v, count)?, Some(point([x, y, z])?)),
            _ => return Err(format!("{} words; a pin is `index` or `index x y z`", words.len())),
        };
        if seen.insert(v) { Ok((v, point)) } else { Err(format!("vertex {v} is pinned twice")) }
    })
}

/// `index index`.
pub fn stitches(text: &str, file: &str, count: usize) -> Read<(u32, u32)> {
    lines(text, file, |words| match words {
        [a, b] => match (index(a, count)?, index(b, count)?) {
            (a, b) if a == b => Err(format!("vertex {a} is sewn to itself")),
            pair => Ok(pair),
        },
        _ => Err(format!("{} words; a stitch is `index index`", words.len())),
    })
}

/// `index fx fy fz`.
pub fn loads(text: &str, file: &str, count: usize) -> Read<(u32, Vec3)> {
    lines(text, file, |words| match words {
        [v, x, y, z] => Ok((index(v, count)?, point([x, y, z])?)),
        _ => Err(format!("{} words; a load is `index fx fy fz`", words.len())),
    })
}

fn lines<T>(text: &str, file: &str, mut read: impl FnMut(&[&str]) -> Result<T, String>) -> Read<T> {
    let (mut out, mut findings, mut more) = (Vec::new(), Vec::new(), 0usize);
    for (number, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or_default();
        // One word too many is enough to see that the line is wrong.
        let words: Vec<&str> = line.split([' ', '\t', ',', ';', '\r']).filter(|w| !w.is_empty()).take(6).collect();
        if words.is_empty() {
            continue;
        }
        match read(&words) {
            Ok(item) => out.push(item),
            Err(why) if findings.len() < MAX_FINDINGS => {
                let place = SourceRef::file(file).at_line(number as u64 + 1);
                findings.push(Diagnostic::error(codes::VERTEX_LIST, why).at(place).hint(HINT));
            }
            Err(_) => more += 1,
        }
    }
    if more > 0 {
        findings
            .push(Diagnostic::error(codes::VERTEX_LIST, format!("and {more} more lines")).at(SourceRef::file(file)));
    }
    if findings.is_empty() { Ok(out) } else { Err(findings) }
}

fn index(word: &str, count: usize) -> Result<u32, String> {
    let shown: String = word.chars().take(24).collect();
    let v: u32 = word.parse().map_err(|_| format!("`{}` is no vertex index", shown.escape_debug()))?;
    if (v as usize) < count { Ok(v) } else { Err(format!("vertex {v} does not exist; the mesh has {count}, from 0")) }
}

fn point(words: [&&str; 3]) -> Result<Vec3, String> {
    let mut out = Vec3::zeros();
    for (k, word) in words.iter().enumerate() {
        let x = word.parse::<f64>().ok().filter(|x| x.is_finite() && x.abs() <= MAX_NUMBER);
        let shown: String = word.chars().take(24).collect();
        out[k] = x.ok_or_else(|| format!("`{}` is not a finite number", shown.escape_debug()))? + 0.0;
    }
    Ok(out)
}
