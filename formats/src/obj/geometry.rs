//! Vertices and faces alone, read by `tobj`: the way bodies come in.
//!
//! A guard stands before `tobj` and keeps away all that it would misread. It passes on the `v` and `f` lines of the
//! file, word by word as they stand, and looks at every index before. Afterwards every number and index is looked at
//! again.
//!
//! `tobj` numbers vertices by first use and forgets unused ones. So one more face over all vertices stands behind the
//! last line, and tells where each of them went. A file that does not pass is read by our own scanner, which tells line
//! and remedy.

use super::codes;
use super::polygon;
use super::scan::{self, Corner, Counts, Face, MAX_LINE, Scan, logical_lines};
use super::{MAX_BYTES, MAX_COORDINATE, MAX_ITEMS, MAX_POLYGON, ObjMesh, read};
use std::borrow::Cow;
use std::io::{BufRead, Read, Write as _};
use toile_garment::{Diagnostic, SourceRef, Vec3};

/// A weight of a vertex may miss 1 by this.
const ROUNDING_OF_WEIGHT: f64 = 1e-9;

/// Reads the vertices and triangles of an OBJ file: [`ObjMesh::positions`], `triangles`, `faces` and `polygons`. All
/// other fields stay empty. The mesh is the same as that of [`read`], vertex by vertex.
///
/// # Errors
/// As [`read`].
pub fn read_geometry(bytes: &[u8], file: &str) -> Result<ObjMesh, Vec<Diagnostic>> {
    if bytes.len() > MAX_BYTES {
        return read(bytes, file);
    }
    let mesh = by_tobj(bytes).and_then(|scan| polygon::mesh(scan, file).ok());
    mesh.map_or_else(|| Err(explain(bytes, file)), Ok)
}

/// Tells in the words of our own scanner why the file cannot be read.
fn explain(bytes: &[u8], file: &str) -> Vec<Diagnostic> {
    read(bytes, file).err().unwrap_or_else(|| {
        let message = "two readings of the file differ: the library finds a mistake where this program finds none";
        vec![Diagnostic::error(codes::OBJ_READERS_DIFFER, message).at(SourceRef::file(file))]
    })
}

/// The file as `tobj` reads it, vertices in the order of the file; `None` when anything in it is wrong.
fn by_tobj(bytes: &[u8]) -> Option<Scan> {
    let mut guarded = Guarded::new(bytes);
    let options = tobj::LoadOptions::default();
    let loaded = tobj::load_obj_buf(&mut guarded, &options, |_| Err(tobj::LoadError::GenericFailure));
    let (vertices, faces) = (guarded.counts.positions, guarded.faces);
    let (mut models, _) = loaded.ok().filter(|_| guarded.is_sound())?;
    let mesh = models.pop().filter(|_| models.is_empty())?.mesh;
    scan_of(&mesh, vertices, faces)
}

/// Puts vertices and faces into the order of the file. The last face of the mesh holds all vertices in that order.
fn scan_of(mesh: &tobj::Mesh, vertices: usize, faces: usize) -> Option<Scan> {
    let (corners, order) = mesh.indices.split_at_checked(mesh.indices.len().checked_sub(vertices)?)?;
    let mut place = vec![u32::MAX; vertices];
    let mut scan = Scan { positions: Vec::with_capacity(vertices), ..Scan::default() };
    for (at, theirs) in (0u32..).zip(order) {
        let theirs = *theirs as usize;
        let p = mesh.positions.get(3 * theirs..3 * theirs + 3)?;
        if !p.iter().all(|x| x.is_finite() && x.abs() <= MAX_COORDINATE) {
            return None;
        }
        scan.positions.push(Vec3::new(scan::tidy(p[0]), scan::tidy(p[1]), scan::tidy(p[2])));
        *place.get_mut(theirs)? = at;
    }
    let corner = |i: &u32| place.get(*i as usize).filter(|v| **v != u32::MAX).map(|v| Corner { v: *v, vt: None });
    scan.corners = corners.iter().map(corner).collect::<Option<_>>()?;
    let mut start = 0;
    for face in 0..faces {
        let end = start + mesh.face_arities.get(face).map_or(3, |n| *n as usize);
        scan.faces.push(Face { corners: start..end, line: 0 });
        start = end;
    }
    (start == scan.corners.len()).then_some(scan)
}

/// The lines of a file that `tobj` may see, one at a time: coordinates of vertices, and vertices of faces.
struct Guarded<'a> {
    lines: Box<dyn Iterator<Item = (u64, Cow<'a, [u8]>)> + 'a>,
    /// The line being read, and how far it is.
    line: Vec<u8>,
    at: usize,
    counts: Counts,
    corners: usize,
    faces: usize,
    /// Something is wrong with the file; nothing more is given out.
    failed: bool,
    /// The face over all vertices was given out.
    ended: bool,
}

impl<'a> Guarded<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        Self {
            lines: Box::new(logical_lines(bytes)),
            line: Vec::new(),
            at: 0,
            counts: Counts::default(),
            corners: 0,
            faces: 0,
            failed: false,
            ended: false,
        }
    }

    fn is_sound(&self) -> bool {
        self.ended && !self.failed
    }

    /// Fills `self.line` with the next line that `tobj` may see.
    fn next(&mut self) {
        self.line.clear();
        self.at = 0;
        while self.line.is_empty() && !self.failed && !self.ended {
            match self.lines.next() {
                Some((_, line)) => self.failed = self.pass(&line).is_none(),
                None => self.end(),
            }
        }
        if self.failed {
            self.line.clear();
        }
    }

    /// One line of the file; `None` when it is wrong or beyond a limit.
    fn pass(&mut self, line: &[u8]) -> Option<()> {
        if line.len() > MAX_LINE {
            return None;
        }
        let text = String::from_utf8_lossy(line);
        let mut words = text.split('#').next().unwrap_or_default().split_whitespace();
        match words.next() {
            Some("v") => self.vertex(words)?,
            Some("vt") => {
                self.counts.texcoords += 1;
                let count = words.by_ref().map(scan::finite).try_fold(0, |n, x| x.map(|_| n + 1))?;
                (2..=3).contains(&count).then_some(())?;
            }
            Some("vn") => self.counts.normals += 1,
            Some("f") => self.face(words)?,
            _ => {}
        }
        let counts = &self.counts;
        let few = counts.positions <= MAX_ITEMS && counts.texcoords <= MAX_ITEMS && self.corners <= 4 * MAX_ITEMS;
        few.then_some(())
    }

    /// Three coordinates are passed on as they stand. A weight of 1 or a colour may follow, and goes no further.
    fn vertex<'w>(&mut self, mut words: impl Iterator<Item = &'w str>) -> Option<()> {
        self.counts.positions += 1;
        self.line.push(b'v');
        for _ in 0..3 {
            self.line.push(b' ');
            self.line.extend_from_slice(words.next()?.as_bytes());
        }
        self.line.push(b'\n');
        let mut more = [0.0; 4];
        let mut count = 0;
        for word in words {
            *more.get_mut(count)? = scan::finite(word)?;
            count += 1;
        }
        let sound = match count {
            0 | 3 | 4 => true,
            1 => (more[0] - 1.0).abs() <= ROUNDING_OF_WEIGHT,
            _ => false,
        };
        sound.then_some(())
    }

    /// The vertices of a face are passed on as they stand.
    fn face<'w>(&mut self, words: impl Iterator<Item = &'w str>) -> Option<()> {
        self.faces += 1;
        self.line.push(b'f');
        let before = self.corners;
        for word in words {
            self.counts.corner(word).ok()?;
            self.corners += 1;
            if self.corners - before > MAX_POLYGON {
                return None;
            }
            self.line.push(b' ');
            self.line.extend_from_slice(word.split('/').next().unwrap_or_default().as_bytes());
        }
        self.line.push(b'\n');
        (self.corners - before >= 3).then_some(())
    }

    /// The face over all vertices.
    fn end(&mut self) {
        self.ended = true;
        self.failed = self.counts.positions == 0 || self.faces == 0;
        self.line.push(b'f');
        for number in 1..=self.counts.positions {
            // Writing to memory cannot fail.
            let _ = write!(self.line, " {number}");
        }
        self.line.push(b'\n');
    }
}

impl Read for Guarded<'_> {
    fn read(&mut self, into: &mut [u8]) -> std::io::Result<usize> {
        let some = self.fill_buf()?;
        let n = some.len().min(into.len());
        into[..n].copy_from_slice(&some[..n]);
        self.consume(n);
        Ok(n)
    }
}

impl BufRead for Guarded<'_> {
    fn fill_buf(&mut self) -> std::io::Result<&[u8]> {
        if self.at >= self.line.len() {
            self.next();
        }
        Ok(&self.line[self.at..])
    }

    fn consume(&mut self, n: usize) {
        self.at = (self.at + n).min(self.line.len());
    }
}
