//! Measured drapes: a CSV table with a line for each capture of a specimen of 30 cm on a disc of 18 cm.
//!
//! | column | meaning |
//! |---|---|
//! | `fabric` | name of the cloth |
//! | `face` | which side lay upwards, in any words; one face where the column is missing |
//! | `dc_percent` | drape coefficient, % |
//! | `rim_z_mean_mm` | mean height of the hem over the disc, mm: below 0 where it hangs; may be missing |
//! | `areal_mass_gsm` | g/m²; may be missing |

use super::codes::{CAPTURES, CAPTURES_COLUMN};
use csv::StringRecord;
use toile_garment::{Diagnostic, SourceRef};

/// The columns.
const COLUMNS: [&str; 5] = ["fabric", "face", "dc_percent", "rim_z_mean_mm", "areal_mass_gsm"];
/// Heads of a capture that the table has to have.
const NEEDED: [&str; 2] = ["fabric", "dc_percent"];
/// Range of areal masses, g/m², as in fabric files.
const MASSES: std::ops::RangeInclusive<f64> = 1.0..=10_000.0;
/// Range of drape coefficients, %.
const COEFFICIENTS: std::ops::RangeInclusive<f64> = 0.0..=100.0;
/// Range of heights of the hem, mm: it hangs at most as far as the specimen reaches over the disc. Stiff cloth that curls
/// stands a little over it.
const HEIGHTS: std::ops::RangeInclusive<f64> = -61.0..=10.0;
/// Coefficients that all lie under this are shares, and not percent.
const SHARE: f64 = 0.01;

/// Sides of a cloth.
const FACES: usize = 2;

/// One capture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capture {
    /// Drape coefficient, 0 to 1.
    pub coefficient: f64,
    /// Mean height of the hem over the disc, m.
    pub height: Option<f64>,
}

/// One side of a cloth.
#[derive(Clone, Debug, PartialEq)]
pub struct Face {
    /// Its name; empty where the table tells none.
    pub name: String,
    /// Captures in the order of the table; at least one.
    pub captures: Vec<Capture>,
}

/// A cloth that was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Captured {
    /// Its name.
    pub fabric: String,
    /// Areal mass, kg/m².
    pub areal_mass: Option<f64>,
    /// Its sides in the order of the table; at least one.
    pub faces: Vec<Face>,
}

/// Reads a table. `file` is its name for messages.
///
/// Columns that are not used give a warning each.
///
/// # Errors
/// All lines that cannot be read, each with its number.
pub fn captured(text: &str, file: &str) -> Result<(Vec<Captured>, Vec<Diagnostic>), Vec<Diagnostic>> {
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
    let heads = reader.headers().map_err(|e| vec![refused(file, &e)])?.clone();
    let columns = COLUMNS.map(|name| heads.iter().position(|h| h == name));
    if let Some(missing) = NEEDED.iter().find(|n| !heads.iter().any(|h| h == **n)) {
        let finding = Diagnostic::error(CAPTURES, format!("the table has no column `{missing}`"));
        return Err(vec![finding.at(SourceRef::file(file).at_line(1)).hint("the first line names the columns")]);
    }
    let unused = heads.iter().filter(|h| !COLUMNS.contains(h)).map(|h| {
        let finding = Diagnostic::warning(CAPTURES_COLUMN, format!("the column `{h}` is not used"));
        finding.at(SourceRef::file(file).at_line(1))
    });
    let (warnings, mut errors) = (unused.collect(), Vec::new());
    let mut table = Vec::new();
    for record in reader.records() {
        match record.map_err(|e| refused(file, &e)).and_then(|r| add(&r, &columns, file, &mut table)) {
            Ok(()) => {}
            Err(finding) => errors.push(finding),
        }
    }
    if table.is_empty() && errors.is_empty() {
        let finding = Diagnostic::error(CAPTURES, "the table has no captures");
        errors.push(
            finding.at(SourceRef::file(file)).hint("write a line for each of them below the names of the columns"),
        );
    }
    let captures = || table.iter().flat_map(|c: &Captured| &c.faces).flat_map(|f| &f.captures);
    if errors.is_empty() && captures().all(|c| c.coefficient <= SHARE) {
        let finding = Diagnostic::error(CAPTURES, "no `dc_percent` is above 1: they look like shares");
        errors.push(finding.at(SourceRef::file(file)).hint("write percent, e.g. 62 for a coefficient of 0.62"));
    }
    if errors.is_empty() { Ok((table, warnings)) } else { Err(errors) }
}

fn refused(file: &str, error: &csv::Error) -> Diagnostic {
    let place = SourceRef::file(file);
    let line = error.position().map(csv::Position::line);
    let place = line.map_or_else(|| place.clone(), |line| place.clone().at_line(line));
    Diagnostic::error(CAPTURES, format!("the table cannot be read: {error}")).at(place)
}

/// Adds a line to the table.
fn add(
    record: &StringRecord,
    columns: &[Option<usize>; COLUMNS.len()],
    file: &str,
    table: &mut Vec<Captured>,
) -> Result<(), Diagnostic> {
    let line = record.position().map_or(0, csv::Position::line);
    let cell = |k: usize| columns[k].and_then(|c| record.get(c)).filter(|cell| !cell.is_empty());
    let wrong = |message: String| Diagnostic::error(CAPTURES, message).at(SourceRef::file(file).at_line(line));
    let number = |k: usize, range: std::ops::RangeInclusive<f64>| {
        let Some(cell) = cell(k) else { return Ok(None) };
        let value = cell.parse::<f64>().ok().filter(|v| range.contains(v));
        value.map(Some).ok_or_else(|| {
            wrong(format!("`{}` is `{cell}`; allowed is {} to {}", COLUMNS[k], range.start(), range.end()))
        })
    };
    let fabric = cell(0).ok_or_else(|| wrong("the line names no fabric".to_owned()))?;
    let coefficient = number(2, COEFFICIENTS)?.ok_or_else(|| wrong("the line has no drape coefficient".to_owned()))?;
    let capture = Capture { coefficient: 0.01 * coefficient, height: number(3, HEIGHTS)?.map(|mm| 1e-3 * mm) };
    let mass = number(4, MASSES)?.map(|gsm| 1e-3 * gsm);
    let cloth = found(
        table,
        |c| c.fabric == fabric,
        || Captured { fabric: fabric.to_owned(), areal_mass: mass, faces: Vec::new() },
    );
    if mass.is_some() && mass != cloth.areal_mass {
        return Err(wrong(format!("`{fabric}` has another areal mass above")));
    }
    let name = cell(1).unwrap_or_default();
    if cloth.faces.len() == FACES && cloth.faces.iter().all(|f| f.name != name) {
        let known = cloth.faces.iter().map(|f| format!("`{}`", f.name)).collect::<Vec<_>>().join(" and ");
        return Err(wrong(format!("`{name}` would be a third face of `{fabric}`, beside {known}")));
    }
    let face = found(&mut cloth.faces, |f| f.name == name, || Face { name: name.to_owned(), captures: Vec::new() });
    face.captures.push(capture);
    Ok(())
}

/// The thing that is the one, made and added where there is none.
fn found<T>(all: &mut Vec<T>, is: impl Fn(&T) -> bool, make: impl FnOnce() -> T) -> &mut T {
    let at = all.iter().position(is).unwrap_or(all.len());
    if at == all.len() {
        all.push(make());
    }
    &mut all[at]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn captures_are_gathered_by_fabric_and_face() {
        let text = "fabric,face,dc_percent,rim_z_mean_mm,areal_mass_gsm,folds\n\
                    denim,up,71.5,-40.5,250,7\ndenim, down ,65,,250,6\nlawn,,30,-50,,8\ndenim,up,70,-41,,7\n";
        let (table, warnings) = captured(text, "d.csv").expect("a table");
        assert_eq!(warnings.len(), 1);
        assert!(warnings[0].message.contains("`folds`"));
        let [denim, lawn] = &table[..] else { panic!("{table:?}") };
        assert_eq!((denim.fabric.as_str(), denim.areal_mass), ("denim", Some(0.25)));
        let counts: Vec<(&str, usize)> = denim.faces.iter().map(|f| (f.name.as_str(), f.captures.len())).collect();
        assert_eq!(counts, [("up", 2), ("down", 1)]);
        assert_eq!(denim.faces[0].captures[0], Capture { coefficient: 0.715, height: Some(-0.0405) });
        assert_eq!((denim.faces[1].captures[0].height, lawn.areal_mass), (None, None));
    }

    #[test]
    fn all_wrong_lines_are_told_with_their_numbers() {
        let text = "fabric,dc_percent,rim_z_mean_mm\nlawn,120,-50\n,30,-50\nlawn,30,-90\nlawn,\nlawn,30,-50\n";
        let errors = captured(text, "d.csv").expect_err("wrong");
        let told: Vec<String> = errors.iter().map(|e| e.to_string()).collect();
        assert_eq!(errors.len(), 4, "{told:?}");
        for (error, line) in told.iter().zip([2, 3, 4, 5]) {
            assert!(error.contains(&format!("d.csv:{line}")), "{error}");
        }
        for empty in ["fabric,dc_percent\n", "fabric,dc_percent"] {
            let errors = captured(empty, "d.csv").expect_err("empty");
            assert!(errors.len() == 1 && errors[0].message.contains("no captures"), "{errors:?}");
        }
        let errors = captured("fabric,face,dc_percent\nlawn,up,30\nlawn,down,31\nlawn,u p,30\n", "d.csv");
        let errors = errors.expect_err("three faces");
        assert!(errors[0].to_string().contains("d.csv:4") && errors[0].message.contains("third face"), "{errors:?}");
        let errors = captured("fabric,dc_percent\nlawn,0.62\nlawn,0.6\n", "d.csv").expect_err("shares");
        assert!(errors.len() == 1 && errors[0].message.contains("look like shares"), "{errors:?}");
        let errors = captured("fabric,dc_percent,rim_z_mean_mm\nlawn,30,50\n", "d.csv").expect_err("upwards");
        assert!(errors[0].to_string().contains("d.csv:2"), "{errors:?}");
        let errors = captured("fabric,folds\nlawn,3\n", "d.csv").expect_err("no coefficient");
        assert!(errors[0].message.contains("`dc_percent`"));
    }
}
