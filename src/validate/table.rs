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
    let band = |b: &Band| match b.scatter {
        Some(scatter) => format!("{:.1} ± {scatter:.1}", b.mean),
        None => format!("{:.1} ± –", b.mean),
    };
    let judged = |b: Option<Band>, agrees: Option<bool>| {
        b.map_or_else(dash, |b| band(&b) + if agrees == Some(false) { " !" } else { "" })
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
            let held = of(Row::coefficient_is_held);
            (!agree.ends_with("of 0") || !held.ends_with("of 0")).then(|| {
                format!(
                    "{faces}: drape coefficient in band {agree}, mean within the captures {held}, hem height in band {}",
                    of(Row::height_agrees)
                )
            })
        });
        let counts: Vec<String> = counts.into_iter().flatten().collect();
        let counts = if counts.is_empty() { "nothing was judged".to_owned() } else { counts.join("; ") };
        let seconds = cost.cpu_seconds / cost.cloths as f64;
        Some(format!("`{}` ({}): {counts}. {seconds:.1} CPU s for each cloth.", law.name, law.about))
    }));
    if !validation.judges() {
        words.push(
            "Nothing was judged: a face is judged by two captures or more beside the first, which sets the law. A single \
             reading has no scatter."
                .to_owned(),
        );
    }
    words
}

#[cfg(test)]
mod tests {
    use super::super::rows::{Cost, Readings};
    use super::*;

    /// A face with so many captures beside the first.
    fn validation(captures: &[f64]) -> Validation {
        let readings = |all: &[f64]| Band::of(all).map(|coefficient| Readings { coefficient, height: None });
        let row = Row {
            fabric: "lawn".to_owned(),
            face: String::new(),
            law: LAWS[0].name,
            was_set: true,
            bending_length_mm: 20.0,
            bending_un_m: 8.0,
            rest_curvature_per_m: 0.0,
            captured: readings(captures),
            simulated: readings(&[60.0, 62.0]).expect("falls"),
        };
        Validation {
            toile_validate: 1,
            toile: "0".to_owned(),
            captures: "d.csv".to_owned(),
            edge_mm: 8.0,
            falls: 2,
            rows: vec![row],
            costs: vec![Cost { law: LAWS[0].name, cpu_seconds: 1.0, cloths: 1 }],
        }
    }

    #[test]
    fn a_single_reading_judges_nothing() {
        for few in [&[][..], &[90.0]] {
            let text = text(&validation(few));
            assert!(text.contains("nothing was judged.") && text.contains("Nothing was judged: "), "{text}");
            assert!(!text.contains(" !") && !text.contains("± 0.0"), "{text}");
        }
        let text = text(&validation(&[90.0, 91.0]));
        assert!(text.contains("90.5 ± 0.7 !") && text.contains("in band 0 of 1"), "{text}");
    }
}
