//! A validation as a table: text for the terminal, Markdown for a page.

use super::band::Band;
use super::laws::LAWS;
use super::rows::{Row, Validation};
use crate::table::Table;

/// Heads of the columns.
const HEADS: [&str; 9] = [
    "fabric",
    "face",
    "law",
    "bending length mm",
    "curvature 1/m",
    "drape coefficient %",
    "captured",
    "hem height mm",
    "captured",
];
/// Columns that hold texts.
const LEFT: &[usize] = &[0, 1, 2];

/// The table for a terminal, and what it says.
#[must_use]
pub fn text(validation: &Validation) -> String {
    crate::render::safe(&format!("{}\n\n{}\n{}", title(validation), shown(validation, |t| t.text()), lines(validation)))
}

/// The same as Markdown.
#[must_use]
pub fn markdown(validation: &Validation) -> String {
    crate::render::safe(&format!("{}\n{}", shown(validation, |t| t.markdown()), lines(validation)))
}

/// Its title.
#[must_use]
pub fn title(validation: &Validation) -> String {
    format!(
        "{}: Cusick drapes predicted, {} falls each, edge {} mm",
        validation.captures, validation.falls, validation.edge_mm
    )
}

fn shown(validation: &Validation, write: impl Fn(&Table<'_>) -> String) -> String {
    let cells: Vec<[String; HEADS.len()]> = validation.rows.iter().map(cells).collect();
    let rows = cells.iter().map(|row| row.iter().map(String::as_str).collect()).collect();
    write(&Table { heads: HEADS.to_vec(), rows, left: LEFT })
}

fn cells(row: &Row) -> [String; HEADS.len()] {
    let dash = || "-".to_owned();
    let band = |b: &Band| format!("{:.1} ± {:.1}", b.mean, b.scatter);
    let judged = |b: Option<Band>, agrees: Option<bool>| {
        b.map_or_else(dash, |b| band(&b) + if agrees == Some(true) { "" } else { " !" })
    };
    let captured = row.captured.as_ref();
    [
        row.fabric.clone(),
        if row.was_set { format!("{} *", row.face) } else { row.face.clone() }.trim().to_owned(),
        row.law.to_owned(),
        format!("{:.1}", row.bending_length_mm),
        if row.rest_curvature_per_m == 0.0 { dash() } else { format!("{:+.1}", row.rest_curvature_per_m) },
        band(&row.simulated.coefficient),
        judged(captured.map(|c| c.coefficient), row.coefficient_agrees()),
        row.simulated.height.as_ref().map_or_else(dash, band),
        judged(captured.and_then(|c| c.height), row.height_agrees()),
    ]
}

fn lines(validation: &Validation) -> String {
    words(validation).into_iter().map(|sentence| sentence + "\n").collect()
}

/// Sentences that explain the figures and count them.
#[must_use]
pub fn words(validation: &Validation) -> Vec<String> {
    let mut words = vec![
        "Mean ± scatter of falls and of captures. A star marks a face whose first capture set the law. That capture is not \
         among the others, by which all laws are judged. An exclamation mark says that the bands do not overlap."
            .to_owned(),
    ];
    words.extend(LAWS.iter().filter_map(|law| {
        let cost = validation.costs.iter().find(|c| c.law == law.name && c.cloths > 0)?;
        let counts = [true, false].map(|was_set| {
            let rows = || validation.rows.iter().filter(move |r| r.law == law.name && r.was_set == was_set);
            let of = |judge: fn(&Row) -> Option<bool>| {
                let all: Vec<bool> = rows().filter_map(judge).collect();
                format!("{} of {}", all.iter().filter(|a| **a).count(), all.len())
            };
            let faces = if was_set { "faces that set it" } else { "other faces" };
            let agree = of(Row::coefficient_agrees);
            (!agree.ends_with("of 0")).then(|| {
                format!(
                    "{faces}: drape coefficient in band {agree}, mean within the captures {}, hem height in band {}",
                    of(Row::coefficient_is_held),
                    of(Row::height_agrees)
                )
            })
        });
        let counts = counts.into_iter().flatten().collect::<Vec<_>>().join("; ");
        let seconds = cost.cpu_seconds / cost.cloths as f64;
        Some(format!("`{}` ({}): {counts}. {seconds:.1} CPU s for each cloth.", law.name, law.about))
    }));
    words
}
