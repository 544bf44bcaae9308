//! Reads an OBJ, also as a body.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    let _ = toile_formats::obj::inspect(data, "f.obj");
    let _ = toile_formats::body::read(data, "f.obj", None);
});
