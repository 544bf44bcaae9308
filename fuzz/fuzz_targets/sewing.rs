//! Reads a sewing file.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &str| {
    let _ = toile_formats::sewing::read(data, "f.toml");
});
