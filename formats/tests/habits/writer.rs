//! Writes DXF pair by pair.

/// Text of a DXF.
#[derive(Clone, Default)]
pub struct Writer(pub String);

pub const RECTANGLE: [(f64, f64); 4] = [(0.0, 0.0), (300.0, 0.0), (300.0, 600.0), (0.0, 600.0)];
pub const WEDGE: [(f64, f64); 7] =
    [(0.0, 0.0), (300.0, 0.0), (300.0, 600.0), (165.0, 600.0), (150.0, 500.0), (135.0, 600.0), (0.0, 600.0)];

impl Writer {
    pub fn pair(mut self, code: i32, value: &str) -> Self {
        self.0.push_str(&format!("{code:>3}\r\n{value}\r\n"));
        self
    }

    pub fn xy(self, code: i32, (x, y): (f64, f64)) -> Self {
        self.pair(code, &format!("{x}")).pair(code + 10, &format!("{y}"))
    }

    pub fn text(self, layer: &str, text: &str) -> Self {
        self.text_at(layer, text, (100.0, 300.0))
    }

    pub fn text_at(self, layer: &str, text: &str, at: (f64, f64)) -> Self {
        self.pair(0, "TEXT").pair(8, layer).xy(10, at).pair(40, "2.5").pair(1, text)
    }

    pub fn polyline(self, layer: &str, closed: bool, points: &[(f64, f64)]) -> Self {
        let w = self.pair(0, "POLYLINE").pair(8, layer).pair(66, "1").pair(70, if closed { "1" } else { "0" });
        points.iter().fold(w, |w, p| w.pair(0, "VERTEX").pair(8, layer).xy(10, *p)).pair(0, "SEQEND")
    }

    pub fn light(self, layer: &str, closed: bool, points: &[(f64, f64)]) -> Self {
        let w = self.pair(0, "LWPOLYLINE").pair(100, "AcDbEntity").pair(8, layer).pair(100, "AcDbPolyline");
        let w = w.pair(90, &points.len().to_string()).pair(70, if closed { "1" } else { "0" });
        points.iter().fold(w, |w, p| w.xy(10, *p))
    }

    /// Open, with its first vertex once more at its end.
    pub fn repeated(self, layer: &str, points: &[(f64, f64)]) -> Self {
        let mut points = points.to_vec();
        points.push(points[0]);
        self.polyline(layer, false, &points)
    }

    /// One open run per segment.
    pub fn runs(self, layer: &str, points: &[(f64, f64)]) -> Self {
        let n = points.len();
        (0..n).fold(self, |w, i| w.polyline(layer, false, &[points[i], points[(i + 1) % n]]))
    }

    pub fn line(self, layer: &str, a: (f64, f64), b: (f64, f64)) -> Self {
        self.pair(0, "LINE").pair(8, layer).xy(10, a).xy(11, b)
    }

    pub fn point(self, layer: &str, at: (f64, f64)) -> Self {
        self.pair(0, "POINT").pair(8, layer).xy(10, at)
    }

    pub fn points(self, layer: &str, list: &[(f64, f64)]) -> Self {
        list.iter().fold(self, |w, p| w.point(layer, *p))
    }

    /// Depth, width and direction of the point before.
    pub fn notch(self, depth: &str, width: &str, angle: &str) -> Self {
        self.pair(30, depth).pair(39, width).pair(50, angle)
    }

    pub fn grain(self) -> Self {
        self.line("7", (60.0, 150.0), (60.0, 450.0))
    }

    pub fn block(self, name: &str, body: impl Fn(Self) -> Self) -> Self {
        body(self.pair(0, "BLOCK").pair(8, "0").pair(2, name).pair(70, "64").xy(10, (0.0, 0.0))).pair(0, "ENDBLK")
    }

    pub fn insert(self, name: &str) -> Self {
        self.pair(0, "INSERT").pair(8, "1").pair(2, name).xy(10, (0.0, 0.0))
    }
}

/// A file of blocks and of entities, with what stands before them.
pub fn file(head: &str, blocks: impl Fn(Writer) -> Writer, entities: impl Fn(Writer) -> Writer) -> Vec<u8> {
    let w = Writer(head.to_owned()).pair(0, "SECTION").pair(2, "BLOCKS");
    let w = blocks(w).pair(0, "ENDSEC").pair(0, "SECTION").pair(2, "ENTITIES");
    entities(w).pair(0, "ENDSEC").pair(0, "EOF").0.into_bytes()
}

/// A HEADER with these variables: name, code, value.
pub fn header(variables: &[(&str, i32, &str)]) -> String {
    let w = Writer::default().pair(0, "SECTION").pair(2, "HEADER");
    variables.iter().fold(w, |w, (name, code, value)| w.pair(9, name).pair(*code, value)).pair(0, "ENDSEC").0
}

/// Every letter replaced by code points of one byte.
pub fn bytes_of(text: &[u8], from: &str, to: &[u8]) -> Vec<u8> {
    let at = text.windows(from.len()).position(|w| w == from.as_bytes()).expect("place");
    [&text[..at], to, &text[at + from.len()..]].concat()
}

/// Every coordinate times `k`.
pub fn scaled(points: &[(f64, f64)], k: f64) -> Vec<(f64, f64)> {
    points.iter().map(|(x, y)| (x * k, y * k)).collect()
}

/// Every coordinate moved.
pub fn moved(points: &[(f64, f64)], dx: f64, dy: f64) -> Vec<(f64, f64)> {
    points.iter().map(|(x, y)| (x + dx, y + dy)).collect()
}
