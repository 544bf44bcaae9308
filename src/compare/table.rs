//! A comparison as a table: text for the terminal, Markdown for a page.

use super::rows::{Comparison, Distance, Row};
use crate::table::Table;

/// Heads of the columns.
pub const HEADS: [&str; 11] = [
    "method",
    "sewing CPU s",
    "drape CPU s",
    "open seam mm",
    "at rest",
    "net force",
    "energy above, mJ",
    "strain, of limit",
    "crossings, self/body",
    "same folds mm, mean/p95",
    "own folds mm, mean/p95",
];

/// The cells of a row, one for each head.
#[must_use]
pub fn cells(row: &Row) -> [String; HEADS.len()] {
    let dash = || "-".to_owned();
    let apart = |d: &Distance| format!("{:.1} / {:.1}", d.mean_mm, d.p95_mm);
    let figures = row.figures.as_ref();
    let rest = match (&row.failure, row.net_force) {
        (Some(_), _) => "failed".to_owned(),
        (None, None) => dash(),
        (None, Some(_)) => if row.at_rest { "yes" } else { "no" }.to_owned(),
    };
    [
        row.name.clone(),
        format!("{:.1}", row.sewing_cpu_seconds),
        if row.drape_cpu_seconds > 0.0 { format!("{:.1}", row.drape_cpu_seconds) } else { dash() },
        row.open_seam_mm.map_or_else(dash, |g| format!("{g:.1}")),
        rest,
        row.net_force.map_or_else(dash, |f| format!("{f:.3}")),
        figures.map_or_else(dash, |f| format!("{:+.1}", f.energy_above_mj)),
        figures.map_or_else(dash, |f| format!("{:.1} %, {:.2}", 1e2 * f.strain_max, f.strain_over_limit)),
        figures.map_or_else(dash, |f| format!("{} / {}", f.self_crossings, f.body_crossings)),
        row.same_folds.as_ref().map_or_else(dash, apart),
        row.own_folds.as_ref().map_or_else(dash, apart),
    ]
}

/// The table for a terminal, and what it says.
#[must_use]
pub fn text(comparison: &Comparison) -> String {
    let table = shown(comparison, |t| t.text());
    crate::render::safe(&format!("{}\n\n{table}\n{}", title(comparison), lines(comparison)))
}

/// The same as Markdown.
#[must_use]
pub fn markdown(comparison: &Comparison) -> String {
    crate::render::safe(&format!("{}\n{}", shown(comparison, |t| t.markdown()), lines(comparison)))
}

/// The table, written out.
fn shown(comparison: &Comparison, write: impl Fn(&Table<'_>) -> String) -> String {
    let cells: Vec<[String; HEADS.len()]> = comparison.rows.iter().map(cells).collect();
    let rows = cells.iter().map(|row| row.iter().map(String::as_str).collect()).collect();
    write(&Table { heads: HEADS.to_vec(), rows, left: &[0] })
}

fn lines(comparison: &Comparison) -> String {
    words(comparison).into_iter().map(|sentence| sentence + "\n").collect()
}

/// Its title.
#[must_use]
pub fn title(comparison: &Comparison) -> String {
    format!("{}: one garment by several methods, {} triangles", comparison.pipeline, comparison.triangles)
}

/// Sentences that explain the figures.
#[must_use]
pub fn words(comparison: &Comparison) -> Vec<String> {
    let mut words = vec![
        "The reference is the drape of `toile`, twenty times nearer to rest, on the same mesh. Own folds: the distance of a \
         method's shape from it. Same folds: the method begins at the reference, and the reference itself comes to rest once \
         more; the distance between both tells what the method itself changes. Net forces are those of the method's own law, over the mean weight of a vertex. Energy, strain and \
         crossings are those of its shape by one law for all: coupled triangles."
            .to_owned(),
    ];
    words.extend(comparison.rows.iter().map(|r| format!("`{}` ({}): {}", r.name, r.source, r.about)));
    words.extend(comparison.rows.iter().filter_map(|r| {
        let why = r.failure.as_ref()?;
        Some(format!("`{}` gave no drape: {why}", r.name))
    }));
    words
}
