//! A study as a table: text for the terminal, Markdown for a page.

use super::estimate::ORDER;
use super::report::{Row, Study};
use crate::table::Table;

/// Heads of the columns.
pub const HEADS: [&str; 14] = [
    "setting",
    "triangles",
    "CPU s",
    "MB",
    "error mm",
    "same folds mm, mean/p95/max",
    "own folds mm, mean/p95/max",
    "scatter mm",
    "folds, mean depth mm",
    "hem/girth/tape mm",
    "estimate",
    "strain p95",
    "energy",
    "",
];

/// The cells of a row, one for each head.
#[must_use]
pub fn cells(study: &Study, number: usize) -> [String; HEADS.len()] {
    let row = &study.rows[number];
    let run = &row.done;
    let finest = number == study.finest;
    let error = row.error.as_ref().filter(|_| !finest);
    let lengths = |e: &super::measure::Error| format!("{:.1} / {:.1} / {:.1}", e.hem_mm, e.girth_mm, e.tape_mm);
    let distance = |e: &super::measure::Error| {
        format!("{:.1} / {:.1} / {:.0}", e.distance_mean_mm, e.distance_p95_mm, e.distance_max_mm)
    };
    let dash = || "-".to_owned();
    [
        row.name.clone(),
        if run.triangles == 0 { dash() } else { run.triangles.to_string() },
        format!("{:.1}", run.cpu_seconds),
        run.peak_mb.map_or_else(dash, |mb| format!("{mb:.0}")),
        study.error_mm(number).filter(|_| !finest).map_or_else(dash, |e| format!("{e:.1}")),
        row.carried.as_ref().map_or_else(dash, distance),
        error.map_or_else(dash, distance),
        study.scatter_mm(number).map_or_else(dash, |s| format!("{s:.1}")),
        row.lengths.as_ref().map_or_else(dash, folds),
        error.map_or_else(dash, lengths),
        row.estimate_to_finest_mm.filter(|_| !finest).map_or_else(dash, |g| format!("{g:.1}")),
        error.map_or_else(dash, |e| format!("{:+.2} %", 1e2 * e.strain_p95)),
        error.map_or_else(dash, |e| format!("{:+.1} %", 1e2 * e.energy_rel)),
        remarks(study, row, number),
    ]
}

/// Number of the folds of the free edge that has the most, and their mean depth.
fn folds(lengths: &super::measure::Lengths) -> String {
    let depths = &lengths.folds_mm;
    let mean = depths.iter().sum::<f64>() / depths.len().max(1) as f64;
    if depths.is_empty() { "0".to_owned() } else { format!("{} / {mean:.0}", depths.len()) }
}

/// Remarks on a row, in words.
fn remarks(study: &Study, row: &Row, number: usize) -> String {
    let mut words: Vec<String> = Vec::new();
    if let (Some(name), Some(bound)) = (&row.preset, row.promised_mm) {
        let held = if row.promise_held == Some(true) { "held" } else { "not held" };
        words.push(format!("preset {name}: {bound} mm promised, {held}"));
    }
    if number == study.finest {
        words.push("finest".to_owned());
    }
    if study.recommended == Some(number) {
        words.push("recommended".to_owned());
    }
    if row.on_front {
        words.push("on the front".to_owned());
    }
    if study.is_within_scatter(number) {
        words.push("own folds within the scatter".to_owned());
    }
    match (&row.done.failure, row.is_good()) {
        (Some(why), _) => words.push(format!("no drape: {why}")),
        (None, false) => words.push("certificate failed".to_owned()),
        _ => {}
    }
    words.join("; ")
}

/// The table for a terminal, and what it says.
#[must_use]
pub fn text(study: &Study) -> String {
    let all: Vec<usize> = (0..HEADS.len()).collect();
    let table = shown(study, &all, |t| t.text());
    crate::render::safe(&format!("{}: what accuracy costs\n\n{table}\n{}", study.pipeline, lines(study)))
}

/// The same as Markdown: only the columns that a buyer of accuracy needs.
#[must_use]
pub fn markdown(study: &Study) -> String {
    let table = shown(study, &[0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13], |t| t.markdown());
    crate::render::safe(&format!("{table}\n{}", lines(study)))
}

/// Some columns of the table, written out.
fn shown(study: &Study, columns: &[usize], write: impl Fn(&Table<'_>) -> String) -> String {
    let cells: Vec<[String; HEADS.len()]> = (0..study.rows.len()).map(|i| cells(study, i)).collect();
    let rows = cells.iter().map(|row| columns.iter().map(|i| row[*i].as_str()).collect()).collect();
    let heads = columns.iter().map(|i| HEADS[*i]).collect();
    write(&Table { heads, rows, left: &[0, columns.len() - 1] })
}

fn lines(study: &Study) -> String {
    words(study).into_iter().map(|sentence| sentence + "\n").collect()
}

/// Sentences that explain the figures and the recommendation.
#[must_use]
pub fn words(study: &Study) -> Vec<String> {
    let finest = &study.rows[study.finest];
    let mut words = vec![format!(
        "The error is the largest difference from `{}`: of a hem height, of a girth along the cloth or by the tape, or the \
         distance within which 95 % of the surface lies. Tape and surface are compared in the same folds: the finest drape \
         is carried onto the mesh and comes to rest there. The estimate is of hem heights and girths along the cloth; it \
         comes from this and coarser meshes alone.",
        finest.name
    )];
    words.push(
        "Own folds: the distance of the drape that the mesh found by itself. Where it is far larger than in the same folds, \
         the mesh found other folds, which no setting can promise."
            .to_owned(),
    );
    words.push(
        "Folds are counted along the free edge that has the most of them: hollows between the edge and a taut line around \
         it, 5 mm deep or more."
            .to_owned(),
    );
    if let Some(rests) = study.rows.iter().find_map(|r| r.scatter.as_ref()) {
        words.push(format!(
            "The scatter is the distance within which 95 % of the cloth lies after {} further drapes of one mesh from starts \
             that were moved by up to {} mm. What differs by less says nothing of the settings.",
            rests.repeats, rests.shake_mm
        ));
    }
    if !study.repeated.is_empty() {
        let pairs: Vec<String> = study.repeated.iter().map(|[a, b]| format!("`{a}` as `{b}`")).collect();
        words.push(format!("Not shown, because they gave another drape again: {}.", pairs.join(", ")));
    }
    if let Some(own) = study.own_error().filter(|_| finest.done.setting.edge.is_some()) {
        let scatter = study.trend.map_or_else(String::new, |t| {
            format!(
                "; hem heights and girths follow the edge length to the power of {ORDER} within {:.1} mm",
                t.scatter_mm
            )
        });
        words.push(format!(
            "`{}` itself is estimated to be {own:.1} mm from the limit of fine meshes{scatter}. Promises, chart and \
             recommendation count that in.",
            finest.name
        ));
    }
    let (good, all) = study.estimates_within_two();
    if all > 0 {
        words.push(format!(
            "{good} of {all} estimates are within a factor of two of the error, or less than 1 mm from it."
        ));
    }
    if let Some(row) = study.recommended.map(|i| &study.rows[i]) {
        words.push(format!(
            "Recommended for {} mm: `{}`, {:.1} CPU seconds.",
            study.wanted_mm, row.name, row.done.cpu_seconds
        ));
    } else if let Some((row, error)) = study.nearest() {
        words.push(format!(
            "None of these settings reaches {} mm. The nearest is `{}` with {error:.1} mm; finer meshes are tried with \
             `--edges`.",
            study.wanted_mm, row.name
        ));
    }
    if study.rows.len() == 1 {
        words.push("There is one mesh alone, so nothing was compared: no error is known.".to_owned());
    }
    if !study.left_out.is_empty() {
        words.push(format!("Left out to keep to the budget: {}.", study.left_out.join(", ")));
    }
    words
}
