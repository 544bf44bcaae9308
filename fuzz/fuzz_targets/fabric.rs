//! Reads a fabric file.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &str| {
    let _ = toile_formats::fabric::read(data, "f.toml");
});
