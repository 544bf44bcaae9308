//! Reads an OBJ, as cloth by our own scan and as a body by `tobj`; both must come to the same mesh or the same words.
//! What was read is written again, and must come back.
#![no_main]

use toile_formats::obj;

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    let _ = obj::inspect(data, "f.obj");
    let _ = toile_formats::body::read(data, "f.obj", None);
    let (ours, theirs) = (obj::read(data, "f.obj"), obj::read_geometry(data, "f.obj"));
    match (ours, theirs) {
        (Ok(ours), Ok(theirs)) => {
            assert_eq!((&ours.positions, &ours.triangles), (&theirs.positions, &theirs.triangles));
            if !ours.triangles.is_empty() {
                let text = obj::write_mesh("g", &ours.positions, &ours.triangles);
                let again = obj::read_geometry(text.as_bytes(), "g.obj").expect("what we wrote");
                assert_eq!((ours.positions, ours.triangles), (again.positions, again.triangles));
            }
        }
        (ours, theirs) => assert_eq!(ours.err(), theirs.err()),
    }
});
