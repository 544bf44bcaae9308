//! Draws the sample patterns from body measures: `cargo run --release --example draw_patterns [folder [sizes]]`.
//!
//! Every garment is drafted in code and written as AAMA and as ASTM. The folder is `samples/patterns` when none is given,
//! and the sizes are 36, 38 and 40; `34,36,38,40,42` are all there are. The same program gives the same bytes.

mod body;
mod circle_skirt;
mod curved_band;
mod draft;
mod fitted_bodice;
mod hoodie;
mod jacket;
mod long_skirt;
mod loose;
mod plain_skirts;
mod pocket_skirt;
mod princess_dress;
mod puff_blouse;
mod sheet;
mod shirt;
mod sleeve;
mod t_shirt;
#[cfg(test)]
mod tests;
mod trousers;
mod upper;

use body::{Measures, RUN, SAMPLE_SIZE, SIZES};
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
    Style { file: "puff-blouse", pieces: puff_blouse::pieces },
    Style { file: "princess-dress", pieces: princess_dress::pieces },
    Style { file: "hoodie", pieces: hoodie::pieces },
    Style { file: "trousers", pieces: trousers::pieces },
    Style { file: "shirt", pieces: shirt::pieces },
    Style { file: "jacket", pieces: jacket::pieces },
];

/// File names and bytes of all samples in these sizes.
fn files(sizes: &[Measures]) -> Result<Vec<(String, Vec<u8>)>, String> {
    let mut out = Vec::new();
    for style in STYLES {
        let drawing = Drawing {
            style: StyleText {
                name: style.file.to_ascii_uppercase(),
                sample_size: Some(SAMPLE_SIZE.to_owned()),
                author: "toile".to_owned(),
                ..StyleText::default()
            },
            pieces: sizes.iter().flat_map(|m| (style.pieces)(m).into_iter().map(|p| p.drawing(m.size))).collect(),
        };
        for (word, dialect) in [("aama", Dialect::Aama), ("astm", Dialect::Astm)] {
            let name = format!("{}.{word}.dxf", style.file);
            let written = write(&drawing, dialect).map_err(|f| format!("{name}: {f:?}"))?;
            out.push((name, written.bytes));
        }
    }
    Ok(out)
}

fn size(label: &str) -> Result<Measures, String> {
    RUN.iter().find(|m| m.size == label).copied().ok_or_else(|| format!("no size {label}"))
}

fn main() -> Result<(), String> {
    let folder = std::env::args_os()
        .nth(1)
        .map_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("samples").join("patterns"), PathBuf::from);
    let sizes = match std::env::args().nth(2) {
        None => SIZES.to_vec(),
        Some(wanted) => wanted.split(',').map(size).collect::<Result<_, _>>()?,
    };
    for (name, bytes) in files(&sizes)? {
        let path = folder.join(name);
        std::fs::write(&path, bytes).map_err(|e| format!("cannot write {}: {e}", path.display()))?;
    }
    Ok(())
}
