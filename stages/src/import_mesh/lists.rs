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

/// A line of a list of stitches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sewn {
    /// Number of the line, from 1.
    pub line: u64,
    /// The two vertices.
    pub pair: (u32, u32),
}

/// `index index`.
pub fn stitches(text: &str, file: &str, count: usize) -> Read<Sewn> {
    numbered(text, file, |line, words| match words {
        [a, b] => match (index(a, count)?, index(b, count)?) {
            (a, b) if a == b => Err(format!("vertex {a} is sewn to itself")),
            pair => Ok(Sewn { line, pair }),
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

/// The mistake of stitches that sew both ends of an edge of the cloth to one point, at the first of their lines.
pub fn collapsed(stitches: &[Sewn], mut ends: [u32; 2], file: &str) -> Diagnostic {
    ends.sort_unstable();
    let touches = |s: &&Sewn| ends.iter().any(|v| s.pair.0 == *v || s.pair.1 == *v);
    let lines: Vec<u64> = stitches.iter().filter(touches).map(|s| s.line).collect();
    let told: Vec<String> = lines.iter().take(4).map(u64::to_string).collect();
    let message = format!(
        "vertices {} and {} are the ends of one edge of the cloth and are sewn to one point (lines {} of `{file}`)",
        ends[0],
        ends[1],
        told.join(", ")
    );
    let hint = "sew one of them only, or join them in the mesh: the cloth between them would have no width";
    let place = SourceRef::file(file).at_line(lines.first().copied().unwrap_or(1));
    Diagnostic::error(codes::VERTEX_LIST, message).at(place).hint(hint)
}

fn lines<T>(text: &str, file: &str, mut read: impl FnMut(&[&str]) -> Result<T, String>) -> Read<T> {
    numbered(text, file, |_, words| read(words))
}

fn numbered<T>(text: &str, file: &str, mut read: impl FnMut(u64, &[&str]) -> Result<T, String>) -> Read<T> {
    let (mut out, mut findings, mut more) = (Vec::new(), Vec::new(), 0usize);
    for (number, line) in (1..).zip(text.lines()) {
        let line = line.split('#').next().unwrap_or_default();
        // One word too many is enough to see that the line is wrong.
        let words: Vec<&str> = line.split([' ', '\t', ',', ';', '\r']).filter(|w| !w.is_empty()).take(6).collect();
        if words.is_empty() {
            continue;
        }
        match read(number, &words) {
            Ok(item) => out.push(item),
            Err(why) if findings.len() < MAX_FINDINGS => {
                let place = SourceRef::file(file).at_line(number);
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
