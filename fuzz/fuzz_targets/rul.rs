//! Reads a rule table, writes it and reads that again.
#![no_main]

use libfuzzer_sys::fuzz_target;
use toile_formats::rul;

fuzz_target!(|data: &[u8]| {
    if let Ok(table) = rul::read(data, "f.rul") {
        let _ = rul::read(&rul::write(&table, true, true), "g.rul");
    }
});
