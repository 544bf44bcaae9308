//! Draws the sample patterns from body measures: `cargo run --release --example draw_patterns [folder]`.
//!
//! Every garment is drafted in code for three sizes and written as AAMA and as ASTM; the folder is
//! `samples/patterns` when none is given. The same program gives the same bytes.

mod body;
mod circle_skirt;
mod draft;
mod fitted_bodice;
mod long_skirt;
mod plain_skirts;
mod pocket_skirt;
mod sheet;
mod t_shirt;
#[cfg(test)]
mod tests;
mod upper;

use body::{Measures, SAMPLE_SIZE, SIZES};
use sheet::Draft;
use std::path::PathBuf;
use toile_formats::dxf::write::{Dialect, Drawing, StyleText, write};

/// A garment: its file name and its drafter.
struct Style {
    file: &'static str,
    pieces: fn(&Measures) -> Vec<Draft>,
}

const STYLES: &[Style] = &[
    Style { file: "long-skirt", pieces: long_skirt::pieces },
    Style { file: "fitted-bodice", pieces: fitted_bodice::pieces },
    Style { file: "t-shirt", pieces: t_shirt::pieces },
    Style { file: "gathered-skirt", pieces: plain_skirts::gathered },
    Style { file: "pleated-skirt", pieces: plain_skirts::pleated },
    Style { file: "circle-skirt", pieces: circle_skirt::pieces },
    Style { file: "pocket-skirt", pieces: pocket_skirt::pieces },
];

/// File names and bytes of all samples.
fn files() -> Result<Vec<(String, Vec<u8>)>, String> {
    let mut out = Vec::new();
    for style in STYLES {
        let drawing = Drawing {
            style: StyleText {
                name: style.file.to_ascii_uppercase(),
                sample_size: Some(SAMPLE_SIZE.to_owned()),
                author: "toile".to_owned(),
                ..StyleText::default()
            },
            pieces: SIZES.iter().flat_map(|m| (style.pieces)(m).into_iter().map(|p| p.drawing(m.size))).collect(),
        };
        for (word, dialect) in [("aama", Dialect::Aama), ("astm", Dialect::Astm)] {
            let name = format!("{}.{word}.dxf", style.file);
            let written = write(&drawing, dialect).map_err(|f| format!("{name}: {f:?}"))?;
            out.push((name, written.bytes));
        }
    }
    Ok(out)
}

fn main() -> Result<(), String> {
    let folder = std::env::args_os()
        .nth(1)
        .map_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("samples").join("patterns"), PathBuf::from);
    for (name, bytes) in files()? {
        let path = folder.join(name);
        std::fs::write(&path, bytes).map_err(|e| format!("cannot write {}: {e}", path.display()))?;
    }
    Ok(())
}
