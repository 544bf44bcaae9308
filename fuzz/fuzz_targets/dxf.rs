//! Reads a DXF, makes the garment of it, writes it and its size run in every dialect and reads that again.
#![no_main]

use libfuzzer_sys::fuzz_target;
use toile_formats::dxf::write::{Dialect, Drawing, PieceOptions, Sizes, StyleText, piece_drawing, write};
use toile_formats::dxf::{ReadOptions, inspect, read};

fuzz_target!(|data: &[u8]| {
    let _ = inspect(data, "f.dxf", None);
    let Ok(pattern) = read(data, "f.dxf", &ReadOptions::default()) else { return };
    let run = Sizes::new(&pattern, None).ok().map(|s| s.draw(PieceOptions::default()));
    let Ok((garment, _)) = pattern.to_garment(None, None) else { return };
    for dialect in Dialect::ALL {
        let mut findings = Vec::new();
        let pieces = garment.pieces.iter().map(|p| piece_drawing(p, PieceOptions::default(), &mut findings)).collect();
        let drawing = Drawing { style: StyleText::default(), pieces };
        for drawing in std::iter::once(&drawing).chain(run.as_ref().map(|r| &r.drawing)) {
            if let Ok(written) = write(drawing, dialect) {
                let _ = read(&written.bytes, "g.dxf", &ReadOptions::default());
            }
        }
    }
});
