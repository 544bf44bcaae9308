//! Reads a GarmentCode specification.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    let _ = toile_formats::garmentcode::read(data, "f.json", 5e-5);
});
