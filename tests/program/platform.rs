//! The functions that the program takes from the platform's mathematics: its last bits differ from platform to
//! platform, so nothing that reaches an output may come from there. `clippy.toml` forbids it in our sources; this looks
//! into the linked program, where all libraries are.
#![cfg(all(target_os = "linux", target_env = "gnu", not(debug_assertions)))]

use std::collections::BTreeSet;

/// Functions whose results are not prescribed to the last bit, in double precision.
const FUNCTIONS: [&str; 27] = [
    "acos", "acosh", "asin", "asinh", "atan", "atan2", "atanh", "cbrt", "cos", "cosh", "erf", "exp", "exp10", "exp2",
    "expm1", "hypot", "lgamma", "log", "log10", "log1p", "log2", "pow", "sin", "sincos", "sinh", "tan", "tanh",
];

/// Linked, but far from every output: the time left of indicatif's bars.
const HARMLESS: [&str; 1] = ["pow"];

#[test]
fn no_output_depends_on_the_mathematics_of_the_platform() {
    let program = std::fs::read(env!("CARGO_BIN_EXE_toile")).expect("program");
    let both = FUNCTIONS.into_iter().flat_map(|name| [name.to_owned(), format!("{name}f")]);
    let looked_for: BTreeSet<String> = both.collect();
    let words = names(&program).split(|byte| *byte == 0).filter(|word| (3..8).contains(&word.len()));
    let words = words.filter_map(|word| looked_for.get(std::str::from_utf8(word).ok()?));
    let linked: BTreeSet<&String> = words.collect();
    assert_eq!(Vec::from_iter(linked), HARMLESS, "functions of the platform that the program calls");
}

/// The names that the program looks up in libraries, parted by zeros: they stand around the name of the library of
/// mathematics. Elsewhere the bytes of such a name may stand by chance.
fn names(program: &[u8]) -> &[u8] {
    const LIBRARY: &[u8] = b"\0libm.so.6\0";
    let at = program.windows(LIBRARY.len()).position(|w| w == LIBRARY).expect("the library of mathematics is linked");
    let other = |byte: &u8| *byte != 0 && !byte.is_ascii_graphic();
    let from = program[..at].iter().rposition(other).map_or(0, |k| k + 1);
    let to = program[at..].iter().position(other).map_or(program.len(), |k| at + k);
    &program[from..to]
}
