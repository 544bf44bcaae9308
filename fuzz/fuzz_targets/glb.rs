//! Reads a GLB.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    let _ = toile_formats::gltf::inspect(data);
});
