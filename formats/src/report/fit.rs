//! Measures of garment and body, as they are told in tables.

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
    /// Length along the cloth, metres.
    pub length: f64,
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
    /// Lowest and highest point of the worn cloth, metres.
    pub range: Option<[f64; 2]>,
    /// Points of measure of the house, in the order of their file.
    pub points: Vec<Point>,
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
    /// Height above the floor, metres.
    pub height: f64,
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
            let name = format!("{}_girth", l.name);
            let mut add = |on, method, length| {
                out.push(Measure { name: name.clone(), on, method, length, height: l.height });
            };
            l.body.into_iter().for_each(|girth| add("body", "tape", girth));
            add("pattern", "surface", l.pattern);
            add("drape", "surface", l.along);
            add("drape", "tape", l.tape);
        }
        for e in &self.edges {
            let name = e.name.replace(' ', "_");
            out.push(Measure { name, on: "drape", method: "surface", length: e.length, height: e.height });
        }
        if let Some([low, high]) = self.range {
            let name = "total_length".to_owned();
            out.push(Measure { name, on: "drape", method: "straight", length: high - low, height: low });
        }
        out
    }

    /// All measures as comma-separated values, lengths in millimetres. Points of measure of the house follow, with the
    /// lengths that they should have, in a table of their own after an empty line.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut out = String::from("name,on,method,length_mm,height_mm\n");
        let mm = |x: f64| crate::svg::canvas::fixed(1e3 * x, 1);
        for m in self.measures() {
            let name = csv_cell(&m.name);
            let [length, height] = [m.length, m.height].map(mm);
            out.push_str(&format!("{name},{},{},{length},{height}\n", m.on, m.method));
        }
        if !self.points.is_empty() {
            out.push_str("\nname,on,method,length_mm,height_mm,expected_mm,tolerance_mm,passed\n");
        }
        for p in &self.points {
            let name = csv_cell(&p.name);
            let known = |x: Option<f64>| x.map(mm).unwrap_or_default();
            let passed = p.passed.map(|p| p.to_string()).unwrap_or_default();
            let (length, height) = (mm(p.length), mm(p.height));
            let (expected, tolerance) = (known(p.expected), known(p.tolerance));
            let row = [p.on, p.method, &length, &height, &expected, &tolerance, &passed].join(",");
            out.push_str(&format!("{name},{row}\n"));
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

    /// Free edges and the length of the whole garment.
    #[must_use]
    pub fn lengths(&self) -> Table {
        let mut t = Table::new(
            "lengths",
            "Lengths of the worn garment",
            "Free edges are hems, necklines and openings; their height is a mean.",
            &[("name", "what"), ("length_mm", "length mm"), ("height_mm", "height mm"), ("pieces", "pieces")],
        );
        let mm = |x: f64| Cell::Number(1e3 * x, 0);
        if let Some([low, high]) = self.range {
            let name = Cell::Text("garment, top to bottom".to_owned());
            t.rows.push(vec![name, mm(high - low), mm(low), Cell::Empty]);
        }
        let row =
            |e: &FreeEdge| vec![Cell::Text(e.name.clone()), mm(e.length), mm(e.height), Cell::Text(e.pieces.clone())];
        t.rows.extend(self.edges.iter().map(row));
        t
    }

    /// The measures as a table for programs.
    #[must_use]
    pub fn table(&self) -> Table {
        let columns = [("name", ""), ("on", ""), ("method", ""), ("mm", ""), ("height_mm", "")];
        let mut t = Table::new("measures", "Measures", "", &columns);
        let row = |m: Measure| {
            let [on, method] = [m.on, m.method].map(|x| Cell::Text(x.to_owned()));
            vec![Cell::Text(m.name), on, method, Cell::Number(1e3 * m.length, 1), Cell::Number(1e3 * m.height, 1)]
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
        assert!(csv.contains("\"hip_girth\",body,tape,960.0,840.0\n"), "{csv}");
        assert!(csv.ends_with("\"total_length\",drape,straight,700.0,300.0\n"), "{csv}");
        assert_eq!(csv.lines().count(), 1 + fit.table().rows.len());
    }

    #[test]
    fn every_free_edge_has_a_measure_of_its_own() {
        let edge = |name: &str, length| FreeEdge { name: name.into(), pieces: "A, B".into(), height: 1.0, length };
        let fit = Fit { edges: vec![edge("hem", 1.3508), edge("waist edge", 0.7289)], ..Fit::default() };
        let csv = fit.csv();
        assert!(csv.contains("\"hem\",drape,surface,1350.8,") && csv.contains("\"waist_edge\",drape,surface,728.9,"));
    }
}
