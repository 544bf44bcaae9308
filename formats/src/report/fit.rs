//! Measures of garment and body, as they are told in tables.

use super::accuracy::Accuracy;
use super::tables::{Cell, Table};
use crate::picture::Field;
use toile_garment::text::csv_cell;

/// Girths of body and cloth at one height.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Name of the height: `bust`, `waist`, `hip`.
    pub name: String,
    /// Height above the floor, metres.
    pub height: f64,
    /// Girth of the body by a tape, metres.
    pub body: Option<f64>,
    /// Length of the cloth around it at rest, as the pattern has it, metres.
    pub pattern: f64,
    /// Length of the cloth around it as it is worn, along every fold, metres.
    pub along: f64,
    /// Length of a tape around the cloth as it is worn, metres.
    pub tape: f64,
}

/// A free edge of the worn garment: hem, neckline, opening of a sleeve.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeEdge {
    /// Name, such as `hem`; no two edges of a garment have the same.
    pub name: String,
    /// Names of the pieces it runs along.
    pub pieces: String,
    /// Mean height above the floor, metres.
    pub height: f64,
    /// Length of the cloth at rest, as the pattern has it, metres.
    pub pattern: f64,
    /// Length along the worn cloth, metres.
    pub length: f64,
}

/// A length as pattern makers take it, such as that of a sleeve.
#[derive(Clone, Debug, PartialEq)]
pub struct Length {
    /// Name, such as `sleeve length left`.
    pub name: String,
    /// Length of the cloth at rest, as the pattern has it, metres.
    pub pattern: f64,
    /// Length along the worn cloth, metres.
    pub worn: f64,
    /// The length of the body that it is compared with, metres, and how it is taken: `surface`, `tape` or `straight`.
    pub body: Option<(f64, &'static str)>,
}

/// How far the garment hangs out of its balance somewhere.
#[derive(Clone, Debug, PartialEq)]
pub struct Balance {
    /// Name, such as `hem front above back` and `side seam forward left`.
    pub name: String,
    /// How far, metres; 0 in balance.
    pub value: f64,
}

/// Length along the grain and width across it of a piece, through its middle.
#[derive(Clone, Debug, PartialEq)]
pub struct PieceSize {
    /// Name of the piece.
    pub name: String,
    /// Length along the grain, flat and worn, metres.
    pub length: [f64; 2],
    /// Width across the grain, flat and worn, metres.
    pub width: [f64; 2],
}

/// A point of measure of a house, as it was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Name.
    pub name: String,
    /// The thing that was measured: `pattern`, `drape` or `body`.
    pub on: &'static str,
    /// How: `surface`, `tape` or `straight`.
    pub method: &'static str,
    /// The measure, metres.
    pub length: f64,
    /// Height above the floor, metres; 0 on the pattern.
    pub height: f64,
    /// The length that it should have, metres.
    pub expected: Option<f64>,
    /// How far it may be off, metres.
    pub tolerance: Option<f64>,
    /// True where it is within its tolerance.
    pub passed: Option<bool>,
}

/// All that was measured for a report.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fit {
    /// Quantities on the cloth.
    pub maps: Vec<Field>,
    /// Girths, from above to below.
    pub levels: Vec<Level>,
    /// Free edges, from below to above.
    pub edges: Vec<FreeEdge>,
    /// Lengths as pattern makers take them, where the parts of the garment are known.
    pub lengths: Vec<Length>,
    /// Sizes of the pieces.
    pub pieces: Vec<PieceSize>,
    /// Lowest and highest point of the worn cloth, metres.
    pub range: Option<[f64; 2]>,
    /// How level the hems hang, and how plumb the side seams.
    pub balance: Vec<Balance>,
    /// Points of measure of the house, in the order of their file.
    pub points: Vec<Point>,
    /// The cost of accuracy for this garment, where a study tells.
    pub accuracy: Option<Accuracy>,
}

/// One measure, as programs read it.
#[derive(Clone, Debug, PartialEq)]
pub struct Measure {
    /// Name.
    pub name: String,
    /// The thing that was measured: `pattern`, `drape` or `body`.
    pub on: &'static str,
    /// How: `surface` (along every fold), `tape` or `straight`.
    pub method: &'static str,
    /// The measure, metres.
    pub length: f64,
    /// Height above the floor, metres, where it is taken at one.
    pub height: Option<f64>,
}

impl Measure {
    fn new(name: &str, on: &'static str, method: &'static str, length: f64) -> Self {
        Self { name: name.replace(' ', "_"), on, method, length, height: None }
    }

    fn at(self, height: f64) -> Self {
        Self { height: Some(height), ..self }
    }
}

impl Level {
    /// Ease: what the cloth at rest has more than the body, metres.
    #[must_use]
    pub fn ease(&self) -> Option<f64> {
        self.body.map(|body| self.pattern - body)
    }
}

impl Fit {
    /// All measures one by one.
    #[must_use]
    pub fn measures(&self) -> Vec<Measure> {
        let mut out = Vec::new();
        for l in &self.levels {
            let girth =
                |on, method, length| Measure::new(&format!("{}_girth", l.name), on, method, length).at(l.height);
            out.extend(l.body.map(|body| girth("body", "tape", body)));
            out.push(girth("pattern", "surface", l.pattern));
            out.extend([("surface", l.along), ("tape", l.tape)].map(|(method, x)| girth("drape", method, x)));
        }
        for l in &self.lengths {
            out.extend(l.body.map(|(body, method)| Measure::new(&l.name, "body", method, body)));
            out.push(Measure::new(&l.name, "pattern", "surface", l.pattern));
            out.push(Measure::new(&l.name, "drape", "surface", l.worn));
        }
        for e in &self.edges {
            out.push(Measure::new(&e.name, "pattern", "surface", e.pattern));
            out.push(Measure::new(&e.name, "drape", "surface", e.length).at(e.height));
        }
        if let Some([low, high]) = self.range {
            out.push(Measure::new("total_length", "drape", "straight", high - low).at(low));
        }
        out.extend(self.balance.iter().map(|b| Measure::new(&b.name, "drape", "straight", b.value)));
        out
    }

    /// The sizes of all pieces, one by one.
    fn sizes(&self) -> impl Iterator<Item = Measure> {
        self.pieces.iter().flat_map(|p| {
            [("length", p.length), ("width", p.width)].into_iter().flat_map(move |(what, both)| {
                let name = format!("piece {what} {}", p.name);
                let on = ["pattern", "drape"].into_iter().zip(both);
                on.map(move |(on, length)| Measure::new(&name, on, "surface", length))
            })
        })
    }

    /// All measures and sizes of pieces as one table of comma-separated values after RFC 4180, points of measure of the house last. Cells
    /// that a measure does not have are empty.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut out = String::from("name,on,method,value,unit,height_mm,expected_mm,tolerance_mm,passed\r\n");
        let mm = |x: f64| crate::svg::canvas::fixed(1e3 * x, 1);
        let known = |x: Option<f64>| x.map(mm).unwrap_or_default();
        for m in self.measures().into_iter().chain(self.sizes()) {
            let (name, length) = (csv_cell(&m.name), mm(m.length));
            out.push_str(&format!("{name},{},{},{length},mm,{},,,\r\n", m.on, m.method, known(m.height)));
        }
        for p in &self.points {
            let name = csv_cell(&p.name);
            let passed = p.passed.map(|p| p.to_string()).unwrap_or_default();
            let height = known((p.on != "pattern").then_some(p.height));
            let (length, expected, tolerance) = (mm(p.length), known(p.expected), known(p.tolerance));
            let row = [p.on, p.method, &length, "mm", &height, &expected, &tolerance, &passed].join(",");
            out.push_str(&format!("{name},{row}\r\n"));
        }
        out
    }

    /// The points of measure of the house.
    #[must_use]
    pub fn of_house(&self) -> Table {
        let mut t = Table::new(
            "points_of_measure",
            "Points of measure",
            "As the file of measures asks. Surface: along every fold; tape: bridges hollows.",
            &[
                ("name", "measure"),
                ("on", "on"),
                ("method", "method"),
                ("mm", "mm"),
                ("expected_mm", "expected mm"),
                ("tolerance_mm", "tolerance mm"),
                ("off_mm", "off mm"),
                ("passed", "passed"),
            ],
        );
        let mm = |x: f64| Cell::Number(1e3 * x, 1);
        let row = |p: &Point| {
            let known = |x: Option<f64>| x.map_or(Cell::Empty, mm);
            let [on, method] = [p.on, p.method].map(|x| Cell::Text(x.to_owned()));
            let off = known(p.expected.map(|e| p.length - e));
            let passed = p.passed.map_or(Cell::Empty, Cell::Verdict);
            vec![
                Cell::Text(p.name.clone()),
                on,
                method,
                mm(p.length),
                known(p.expected),
                known(p.tolerance),
                off,
                passed,
            ]
        };
        t.rows = self.points.iter().map(row).collect();
        t
    }

    /// The table of ease.
    #[must_use]
    pub fn ease(&self) -> Table {
        let mut t = Table::new(
            "ease",
            "Measures and ease",
            "Girths in level planes, below the armholes where sleeves hang on the cloth. Pattern: the cloth at rest. \
             Worn: along every fold of the draped cloth; the tape bridges folds. Ease: pattern less body.",
            &[
                ("name", "at"),
                ("height_mm", "height mm"),
                ("body_mm", "body mm"),
                ("pattern_mm", "pattern mm"),
                ("along_mm", "worn mm"),
                ("tape_mm", "tape mm"),
                ("ease_mm", "ease mm"),
                ("ease_pct", "ease %"),
            ],
        );
        let mm = |x: f64| Cell::Number(1e3 * x, 0);
        let row = |l: &Level| {
            let body = l.body.map_or(Cell::Empty, mm);
            let ease = l.ease().map_or(Cell::Empty, mm);
            let share = l.ease().zip(l.body).map_or(Cell::Empty, |(e, b)| Cell::Number(100.0 * e / b, 1));
            vec![
                Cell::Text(l.name.replace('_', " ")),
                mm(l.height),
                body,
                mm(l.pattern),
                mm(l.along),
                mm(l.tape),
                ease,
                share,
            ]
        };
        t.rows = self.levels.iter().map(row).collect();
        t
    }

    /// Lengths of garment and body, free edges, and the length of the whole garment.
    #[must_use]
    pub fn lengths(&self) -> Table {
        let mut t = Table::new(
            "lengths",
            "Lengths",
            "Sleeves and centre lines: along the straight grain from their highest point, without cuffs and bands. Seams: \
             the side that is not eased. Free edges are hems, necklines and openings; their height is a mean.",
            &[
                ("name", "what"),
                ("body_mm", "body mm"),
                ("pattern_mm", "pattern mm"),
                ("length_mm", "worn mm"),
                ("height_mm", "height mm"),
                ("pieces", "pieces"),
            ],
        );
        let mm = |x: f64| Cell::Number(1e3 * x, 0);
        if let Some([low, high]) = self.range {
            let name = Cell::Text("garment, top to bottom".to_owned());
            t.rows.push(vec![name, Cell::Empty, Cell::Empty, mm(high - low), mm(low), Cell::Empty]);
        }
        let of_length = |l: &Length| {
            let body = l.body.map_or(Cell::Empty, |(body, _)| mm(body));
            vec![Cell::Text(l.name.clone()), body, mm(l.pattern), mm(l.worn), Cell::Empty, Cell::Empty]
        };
        t.rows.extend(self.lengths.iter().map(of_length));
        let of_edge = |e: &FreeEdge| {
            let pieces = Cell::Text(e.pieces.clone());
            vec![Cell::Text(e.name.clone()), Cell::Empty, mm(e.pattern), mm(e.length), mm(e.height), pieces]
        };
        t.rows.extend(self.edges.iter().map(of_edge));
        t
    }

    /// How much longer and wider every piece is when it is worn.
    #[must_use]
    pub fn piece_sizes(&self) -> Table {
        let mut t = Table::new(
            "piece_sizes",
            "Pieces, flat and worn",
            "Length along the grain and width across it, through the middle of the piece: what the cloth gives or shrinks \
             when it is worn.",
            &[
                ("name", "piece"),
                ("length_mm", "along mm"),
                ("length_worn_mm", "worn mm"),
                ("length_change_mm", "change mm"),
                ("length_change_pct", "change %"),
                ("width_mm", "across mm"),
                ("width_worn_mm", "worn mm"),
                ("width_change_mm", "change mm"),
                ("width_change_pct", "change %"),
            ],
        );
        let mm = |x: f64| Cell::Number(1e3 * x, 1);
        let both = |[flat, worn]: [f64; 2]| {
            [mm(flat), mm(worn), mm(worn - flat), Cell::Number(100.0 * (worn / flat - 1.0), 2)]
        };
        let row = |p: &PieceSize| {
            let mut row = vec![Cell::Text(p.name.clone())];
            row.extend([p.length, p.width].into_iter().flat_map(both));
            row
        };
        t.rows = self.pieces.iter().map(row).collect();
        t
    }

    /// The measures as a table for programs.
    #[must_use]
    pub fn table(&self) -> Table {
        let columns = [("name", ""), ("on", ""), ("method", ""), ("mm", ""), ("height_mm", "")];
        let mut t = Table::new("measures", "Measures", "", &columns);
        let row = |m: Measure| {
            let [on, method] = [m.on, m.method].map(|x| Cell::Text(x.to_owned()));
            let height = m.height.map_or(Cell::Empty, |h| Cell::Number(1e3 * h, 1));
            vec![Cell::Text(m.name), on, method, Cell::Number(1e3 * m.length, 1), height]
        };
        t.rows = self.measures().into_iter().map(row).collect();
        t
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ease_is_what_the_pattern_has_more_than_the_body() {
        let level = Level { name: "hip".into(), height: 0.84, body: Some(0.96), pattern: 1.0, along: 1.01, tape: 0.99 };
        let fit = Fit { levels: vec![level], range: Some([0.3, 1.0]), ..Fit::default() };
        assert_eq!(fit.ease().rows[0][6], Cell::Number(1e3 * (1.0 - 0.96), 0));
        let csv = fit.csv();
        assert!(csv.contains("\"hip_girth\",body,tape,960.0,mm,840.0,,,\r\n"), "{csv}");
        assert!(csv.ends_with("\"total_length\",drape,straight,700.0,mm,300.0,,,\r\n"), "{csv}");
        assert_eq!(csv.lines().count(), 1 + fit.table().rows.len());
    }

    #[test]
    fn the_measures_are_one_table_whatever_is_in_it() {
        let point = Point {
            name: "a \"b\", c".into(),
            on: "pattern",
            method: "surface",
            length: 1.0,
            height: 0.0,
            expected: Some(1.1),
            tolerance: Some(0.01),
            passed: Some(false),
        };
        let length =
            Length { name: "sleeve length left".into(), pattern: 0.2, worn: 0.201, body: Some((0.58, "straight")) };
        let size = PieceSize { name: "FRONT".into(), length: [0.5, 0.51], width: [0.4, 0.396] };
        let fit = Fit { points: vec![point], lengths: vec![length], pieces: vec![size], ..Fit::default() };
        let csv = fit.csv();
        let commas = |line: &str| line.replace("\"a \"\"b\"\", c\"", "").matches(',').count();
        assert!(csv.ends_with("\r\n") && csv.split_terminator("\r\n").all(|line| commas(line) == 8), "{csv}");
        assert!(csv.contains("\"a \"\"b\"\", c\",pattern,surface,1000.0,mm,,1100.0,10.0,false\r\n"), "{csv}");
        assert!(csv.contains("\"sleeve_length_left\",body,straight,580.0,mm,,,,\r\n"), "{csv}");
        assert_eq!(
            fit.piece_sizes().rows[0][3..5],
            [Cell::Number(1e3 * (0.51 - 0.5), 1), Cell::Number(100.0 * (0.51 / 0.5 - 1.0), 2)]
        );
    }

    #[test]
    fn every_free_edge_has_a_measure_of_its_own() {
        let edge = |name: &str, length| FreeEdge {
            name: name.into(),
            pieces: "A, B".into(),
            height: 1.0,
            pattern: 1.25,
            length,
        };
        let fit = Fit { edges: vec![edge("hem", 1.3508), edge("waist edge", 0.7289)], ..Fit::default() };
        let csv = fit.csv();
        for row in [
            "\"hem\",drape,surface,1350.8,mm,",
            "\"hem\",pattern,surface,1250.0,mm,,",
            "\"waist_edge\",drape,surface,728.9,",
        ] {
            assert!(csv.contains(row), "{csv}");
        }
    }
}
