//! Writes a DXF in every dialect and reads it again: `round_trip_dxf [--out FOLDER] IN.dxf…`. Exit code 1 when anything
//! differs without a finding that says so. Every size goes out alone, once whole and once as halves, and all sizes go
//! out as a size run. With `--out` what is written stays in the folder, for other readers.
#![allow(clippy::print_stdout, clippy::print_stderr)]

mod compare;
mod points;

use compare::Difference;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use toile_formats::dxf::write::{Dialect, Drawing, PieceOptions, Sizes, StyleText, Written, piece_drawing, write};
use toile_formats::dxf::{Pattern, ReadOptions, read};
use toile_formats::rul::{self, RuleTable};
use toile_garment::{Diagnostic, Garment};

/// Trips and differences of all files.
#[derive(Default)]
struct Tally {
    trips: usize,
    told: usize,
    refused: usize,
    kinds: BTreeMap<String, (usize, String)>,
}

impl Tally {
    /// Counts a trip. Differences that a finding tells are no faults.
    fn trip(&mut self, what: &str, differences: Vec<Difference>, findings: &[Diagnostic]) {
        self.trips += 1;
        let (told, faults): (Vec<_>, Vec<_>) = differences.into_iter().partition(|d| d.is_told(findings));
        self.told += usize::from(!told.is_empty() && faults.is_empty());
        for fault in faults {
            println!("{what}: {fault}");
            let entry = self.kinds.entry(fault.kind.to_owned()).or_insert_with(|| (0, format!("{what}: {fault}")));
            entry.0 += 1;
        }
    }
}

/// A file with its rule table.
struct Input {
    name: String,
    pattern: Pattern,
    table: Option<RuleTable>,
}

fn main() -> ExitCode {
    let mut arguments: Vec<String> = std::env::args().skip(1).collect();
    let out = arguments.iter().position(|a| a == "--out").map(|i| {
        arguments.remove(i);
        PathBuf::from(arguments.remove(i))
    });
    let mut tally = Tally::default();
    for name in arguments {
        let Ok(bytes) = std::fs::read(&name) else {
            eprintln!("{name}: cannot be read");
            return ExitCode::from(5);
        };
        let table = rules_beside(Path::new(&name)).and_then(|path| std::fs::read(path).ok());
        let table = table.and_then(|bytes| rul::read(&bytes, &name).ok());
        let options =
            ReadOptions { rule_units: table.as_ref().and_then(|t| t.units.clone()), ..ReadOptions::default() };
        match read(&bytes, &name, &options) {
            Ok(pattern) => all_trips(&Input { name, pattern, table }, out.as_deref(), &mut tally),
            Err(faults) => {
                println!("{name}: refused: {}", faults[0].code.as_str());
                tally.refused += 1;
            }
        }
    }
    for (kind, (count, example)) in &tally.kinds {
        println!("== {count} × {kind}, as {example}");
    }
    let wrong: usize = tally.kinds.values().map(|k| k.0).sum();
    println!(
        "{} trip(s), {wrong} difference(s) that nothing tells, {} trip(s) with told differences alone, {} file(s) refused",
        tally.trips, tally.told, tally.refused
    );
    if wrong == 0 { ExitCode::SUCCESS } else { ExitCode::from(1) }
}

/// The rule table of the same name.
fn rules_beside(path: &Path) -> Option<PathBuf> {
    ["rul", "RUL"].map(|ending| path.with_extension(ending)).into_iter().find(|p| p.is_file())
}

fn all_trips(input: &Input, out: Option<&Path>, tally: &mut Tally) {
    let order = input.pattern.size_order(input.table.as_ref());
    let sizes: Vec<Option<&str>> =
        if order.is_empty() { vec![None] } else { order.iter().map(|s| Some(s.as_str())).collect() };
    for size in &sizes {
        for dialect in Dialect::ALL {
            for half_on_fold in [false, true] {
                one_size(input, *size, dialect, half_on_fold, out, tally);
            }
        }
    }
    if order.len() > 1 {
        size_run(input, out, tally);
    }
}

/// Writes a file into the folder, if there is one.
fn keep(folder: Option<&Path>, input: &str, name: &str, bytes: &[u8]) {
    let Some(folder) = folder else { return };
    let stem = Path::new(input).file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned());
    let name: String = format!("{stem}-{name}").chars().map(|c| if c == '/' { '_' } else { c }).collect();
    if let Err(error) = std::fs::write(folder.join(&name), bytes) {
        eprintln!("{name}: {error}");
    }
}

fn one_size(
    input: &Input,
    size: Option<&str>,
    dialect: Dialect,
    half_on_fold: bool,
    out: Option<&Path>,
    tally: &mut Tally,
) {
    let what = format!("{} {} {dialect:?} half={half_on_fold}", input.name, size.unwrap_or("-"));
    let Ok((first, mut findings)) = input.pattern.to_garment(size, input.table.as_ref()) else { return };
    findings.extend(input.pattern.all_findings());
    let options = PieceOptions { half_on_fold, ..PieceOptions::default() };
    let pieces = first.pieces.iter().map(|p| piece_drawing(p, options, &mut findings)).collect();
    let style = StyleText { name: first.style.clone(), sample_size: first.size.clone(), ..StyleText::default() };
    let (bytes, again) = match written(&Drawing { style, pieces }, dialect, &mut findings) {
        Ok(both) => both,
        Err(fault) => return tally.trip(&what, vec![fault], &findings),
    };
    keep(out, &input.name, &format!("{}-{dialect:?}.dxf", size.unwrap_or("x")), &bytes);
    let differences = match again.to_garment(None, None) {
        Ok((second, _)) => {
            let mut list = compare::garments(&first, &second, dialect, half_on_fold);
            if half_on_fold {
                list.extend(points::lost(&input.pattern, &again, size));
            }
            list.extend(compare::styles(&input.pattern, &again));
            list
        }
        Err(faults) => vec![Difference::refused(&faults)],
    };
    tally.trip(&what, differences, &findings);
}

/// The bytes of a drawing, and the pattern that is read of them.
fn written(
    drawing: &Drawing,
    dialect: Dialect,
    findings: &mut Vec<Diagnostic>,
) -> Result<(Vec<u8>, Pattern), Difference> {
    let Written { bytes, findings: said } = write(drawing, dialect).map_err(|f| Difference::refused(&f))?;
    findings.extend(said);
    let again = read(&bytes, "again.dxf", &ReadOptions::default()).map_err(|f| Difference::refused(&f))?;
    findings.extend(again.all_findings());
    Ok((bytes, again))
}

/// All sizes in one file with its rule table.
fn size_run(input: &Input, out: Option<&Path>, tally: &mut Tally) {
    let options = PieceOptions { half_on_fold: true, ..PieceOptions::default() };
    let sizes = match Sizes::new(&input.pattern, input.table.as_ref()) {
        Ok(sizes) => sizes,
        Err(faults) => return tally.trip(&input.name, vec![Difference::refused(&faults)], &[]),
    };
    let run = sizes.draw(options);
    for dialect in Dialect::ALL {
        let what = format!("{} run {dialect:?}", input.name);
        let mut findings = run.findings.clone();
        findings.extend(input.pattern.all_findings());
        let (bytes, again) = match written(&run.drawing, dialect, &mut findings) {
            Ok(both) => both,
            Err(fault) => {
                tally.trip(&what, vec![fault], &findings);
                continue;
            }
        };
        keep(out, &input.name, &format!("run-{dialect:?}.dxf"), &bytes);
        let rules = run.table.as_ref().map(|t| rul::write(t, dialect.is_astm(), dialect != Dialect::Clo));
        keep(out, &input.name, &format!("run-{dialect:?}.rul"), rules.as_deref().unwrap_or_default());
        let rules = rules.and_then(|bytes| rul::read(&bytes, "again.rul").ok());
        let mut differences = Vec::new();
        for size in input.pattern.size_order(input.table.as_ref()) {
            let garment = |pattern: &Pattern, table: Option<&RuleTable>| -> Result<Garment, Difference> {
                pattern.to_garment(Some(&size), table).map(|g| g.0).map_err(|f| Difference::refused(&f))
            };
            let Ok(first) = garment(&input.pattern, input.table.as_ref()) else { continue };
            match garment(&again, rules.as_ref()) {
                Ok(second) => differences.extend(compare::garments(&first, &second, dialect, true)),
                Err(fault) => differences.push(fault),
            }
        }
        tally.trip(&what, differences, &findings);
    }
}
