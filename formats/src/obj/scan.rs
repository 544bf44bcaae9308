//! Our own scan of an OBJ file: every line counted, every number and index checked.

use super::codes;
use super::{MAX_COORDINATE, MAX_ITEMS, MAX_POLYGON};
use std::collections::BTreeMap;
use toile_garment::{Code, Diagnostic, SourceRef, Vec3};

/// Findings that are written out; the rest is counted.
const MAX_FINDINGS: usize = 20;
/// Longest line, bytes.
pub(super) const MAX_LINE: usize = 1 << 20;
/// Numbers nearer to zero than this are zero.
const TINY: f64 = 1e-300;

/// One corner of a face, counted from 0.
#[derive(Clone, Copy, Debug)]
pub struct Corner {
    pub v: u32,
    pub vt: Option<u32>,
}

/// One `f` line: a range of `Scan::corners`.
#[derive(Clone, Debug)]
pub struct Face {
    pub corners: std::ops::Range<usize>,
    pub line: u64,
}

/// How many lines of each kind stand before a face.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counts {
    pub positions: usize,
    pub texcoords: usize,
    pub normals: usize,
}

impl Counts {
    /// A corner of a face by its words, e.g. `3/1/2`.
    ///
    /// # Errors
    /// What is wrong with it, in words.
    pub fn corner(&self, word: &str) -> Result<Corner, String> {
        let mut parts = word.split('/');
        let v = index(parts.next().unwrap_or_default(), self.positions, "vertex")?
            .ok_or_else(|| format!("`{}` names no vertex", word.escape_debug()))?;
        let vt = index(parts.next().unwrap_or_default(), self.texcoords, "texture vertex")?;
        index(parts.next().unwrap_or_default(), self.normals, "normal")?;
        if parts.next().is_some() {
            return Err(format!("`{}` has more than three parts", word.escape_debug()));
        }
        Ok(Corner { v, vt })
    }
}

/// The content of a file.
#[derive(Default)]
pub struct Scan {
    pub positions: Vec<Vec3>,
    pub texcoords: Vec<[f64; 2]>,
    pub corners: Vec<Corner>,
    pub faces: Vec<Face>,
    /// Name and number of faces before it.
    pub groups: Vec<(String, usize)>,
    pub materials: Vec<String>,
    pub ignored: BTreeMap<String, u64>,
    /// `vn` lines; only their number matters for relative indices.
    pub normals: usize,
}

struct Scanner<'a> {
    out: Scan,
    file: &'a str,
    findings: Vec<Diagnostic>,
    more: usize,
}

/// Scans a file.
pub fn scan(bytes: &[u8], file: &str) -> Result<Scan, Vec<Diagnostic>> {
    let mut s = Scanner { out: Scan::default(), file, findings: Vec::new(), more: 0 };
    for (number, line) in logical_lines(bytes) {
        if line.len() > MAX_LINE {
            s.fail(number, codes::OBJ_LINE, format!("the line has {} bytes, over the limit of {MAX_LINE}", line.len()));
            continue;
        }
        let text = String::from_utf8_lossy(&line);
        s.line(number, &text);
        if s.out.positions.len() > MAX_ITEMS || s.out.texcoords.len() > MAX_ITEMS || s.out.corners.len() > 4 * MAX_ITEMS
        {
            s.fail(number, codes::OBJ_TOO_MANY, format!("more than {MAX_ITEMS} vertices or triangles"));
            break;
        }
    }
    s.finish()
}

/// Lines with `\` continuations joined, and the number of their first line.
pub(super) fn logical_lines(bytes: &[u8]) -> impl Iterator<Item = (u64, std::borrow::Cow<'_, [u8]>)> {
    let mut lines = bytes.split(|b| *b == b'\n').enumerate();
    std::iter::from_fn(move || {
        let (number, line) = lines.next()?;
        let number = number as u64 + 1;
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        let Some(start) = line.strip_suffix(b"\\") else { return Some((number, line.into())) };
        let mut joined = start.to_vec();
        for (_, next) in lines.by_ref() {
            let next = next.strip_suffix(b"\r").unwrap_or(next);
            joined.push(b' ');
            match next.strip_suffix(b"\\") {
                Some(part) if joined.len() <= MAX_LINE => joined.extend_from_slice(part),
                _ => {
                    joined.extend_from_slice(next);
                    break;
                }
            }
        }
        Some((number, joined.into()))
    })
}

impl Scanner<'_> {
    fn fail(&mut self, line: u64, code: Code, message: String) -> &mut Self {
        if self.findings.len() < MAX_FINDINGS {
            self.findings.push(Diagnostic::error(code, message).at(SourceRef::file(self.file).at_line(line)));
        } else {
            self.more = self.more.saturating_add(1);
        }
        self
    }

    fn line(&mut self, number: u64, text: &str) {
        let text = text.split('#').next().unwrap_or_default();
        let mut words = text.split_whitespace();
        let Some(keyword) = words.next() else { return };
        match keyword {
            "v" => self.vertex(number, words),
            "vt" => self.texture_vertex(number, words),
            "f" => self.face(number, words),
            "g" | "o" => {
                let name = words.collect::<Vec<_>>().join(" ");
                let faces = self.out.faces.len();
                self.out.groups.push((name, faces));
            }
            "usemtl" => {
                let name = words.collect::<Vec<_>>().join(" ");
                if !self.out.materials.contains(&name) && self.out.materials.len() < 10_000 {
                    self.out.materials.push(name);
                }
            }
            other => {
                self.out.normals += usize::from(other == "vn");
                let known = ["vn", "vp", "l", "p", "s", "mtllib"].contains(&other) || self.out.ignored.len() < 30;
                let word = if known { other.chars().take(20).collect() } else { "others".to_owned() };
                let count = self.out.ignored.entry(word).or_insert(0);
                *count = count.saturating_add(1);
            }
        }
    }

    fn number(&mut self, line: u64, word: &str) -> Option<f64> {
        match word.parse::<f64>() {
            Ok(x) if x.is_finite() && x.abs() <= MAX_COORDINATE => Some(tidy(x)),
            Ok(x) if x.is_finite() => {
                self.fail(line, codes::OBJ_NUMBER, format!("the coordinate {x} is over {MAX_COORDINATE} m"));
                None
            }
            _ => {
                let word: String = word.chars().take(40).collect();
                self.fail(line, codes::OBJ_NUMBER, format!("`{}` is not a finite number", word.escape_debug()));
                if word.contains(',') {
                    self.hint("write a decimal point, not a comma");
                }
                None
            }
        }
    }

    fn empty(&mut self, message: String) {
        self.fail(1, codes::OBJ_EMPTY, message);
        self.hint("export a mesh of triangles, with its faces");
    }

    fn hint(&mut self, text: &str) {
        if self.more == 0
            && let Some(last) = self.findings.last_mut()
        {
            last.hint = Some(text.to_owned());
        }
    }

    fn numbers<'w>(&mut self, line: u64, words: impl Iterator<Item = &'w str>, most: usize) -> Option<Vec<f64>> {
        let mut out = Vec::with_capacity(most.min(8));
        for word in words {
            if out.len() == most {
                self.fail(line, codes::OBJ_LINE, format!("more than {most} numbers in a vertex line"));
                return None;
            }
            out.push(self.number(line, word)?);
        }
        Some(out)
    }

    fn vertex<'w>(&mut self, line: u64, words: impl Iterator<Item = &'w str>) {
        // Three coordinates; a weight of 1 or a colour may follow (x y z [w] or x y z r g b).
        let Some(n) = self.numbers(line, words, 7) else {
            // Keep the count right, so that later indices are judged by what the file meant.
            self.out.positions.push(Vec3::zeros());
            return;
        };
        match n.as_slice() {
            [x, y, z] | [x, y, z, _, _, _] | [x, y, z, _, _, _, _] => self.out.positions.push(Vec3::new(*x, *y, *z)),
            [x, y, z, w] => {
                if (*w - 1.0).abs() > 1e-9 {
                    self.fail(line, codes::OBJ_LINE, format!("a vertex weight of {w} is not supported"));
                }
                self.out.positions.push(Vec3::new(*x, *y, *z));
            }
            other => {
                self.fail(line, codes::OBJ_LINE, format!("a vertex line with {} numbers; it has three", other.len()));
                self.out.positions.push(Vec3::zeros());
            }
        }
    }

    fn texture_vertex<'w>(&mut self, line: u64, words: impl Iterator<Item = &'w str>) {
        let uv = match self.numbers(line, words, 3) {
            Some(n) if n.len() >= 2 => [n[0], n[1]],
            Some(n) => {
                self.fail(line, codes::OBJ_LINE, format!("a vt line with {} numbers; it has two", n.len()));
                [0.0; 2]
            }
            None => [0.0; 2],
        };
        self.out.texcoords.push(uv);
    }

    fn face<'w>(&mut self, line: u64, words: impl Iterator<Item = &'w str>) {
        let start = self.out.corners.len();
        let out = &self.out;
        let counts = Counts { positions: out.positions.len(), texcoords: out.texcoords.len(), normals: out.normals };
        for word in words {
            if self.out.corners.len() - start == MAX_POLYGON {
                self.fail(line, codes::OBJ_POLYGON, format!("a face with more than {MAX_POLYGON} corners"));
                self.out.corners.truncate(start);
                return;
            }
            match counts.corner(word) {
                Ok(corner) => self.out.corners.push(corner),
                Err(why) => {
                    self.fail(line, codes::OBJ_INDEX, why);
                    self.out.corners.truncate(start);
                    return;
                }
            }
        }
        if self.out.corners.len() - start < 3 {
            let n = self.out.corners.len() - start;
            self.fail(line, codes::OBJ_LINE, format!("a face with {n} corners; it has three or more"));
            self.out.corners.truncate(start);
            return;
        }
        self.out.faces.push(Face { corners: start..self.out.corners.len(), line });
    }

    fn finish(mut self) -> Result<Scan, Vec<Diagnostic>> {
        if self.findings.is_empty() {
            if self.out.positions.is_empty() {
                self.empty("the file has no vertices".to_owned());
            } else if self.out.faces.is_empty() {
                self.empty(format!("the file has {} vertices but no faces", self.out.positions.len()));
            }
        }
        if self.more > 0 {
            let message = format!("and {} more mistakes of this kind", self.more);
            self.findings.push(Diagnostic::error(codes::OBJ_MORE, message).at(SourceRef::file(self.file)));
        }
        if self.findings.is_empty() { Ok(self.out) } else { Err(self.findings) }
    }
}

/// A number with what is too near to zero made zero.
pub(super) fn tidy(x: f64) -> f64 {
    if x.abs() < TINY { 0.0 } else { x }
}

/// A finite number within the limit of coordinates.
pub(super) fn finite(word: &str) -> Option<f64> {
    word.parse().ok().filter(|x: &f64| x.is_finite() && x.abs() <= MAX_COORDINATE)
}

/// An index counted from 0: absolute from 1, or relative to the end when negative. Empty means absent.
fn index(text: &str, count: usize, what: &str) -> Result<Option<u32>, String> {
    if text.is_empty() {
        return Ok(None);
    }
    let shown = || text.chars().take(24).collect::<String>();
    let n: i64 = text.parse().map_err(|_| format!("`{}` is not a {what} number", shown().escape_debug()))?;
    let count = i64::try_from(count).unwrap_or(i64::MAX);
    let at = if n > 0 { n.checked_sub(1) } else { n.checked_add(count) };
    match at.filter(|i| n != 0 && *i >= 0 && *i < count) {
        Some(i) => u32::try_from(i).map(Some).map_err(|_| format!("{what} {n} is over the limit")),
        None => Err(format!("{what} {n} does not exist; there are {count} before this line")),
    }
}
