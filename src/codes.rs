//! The meaning of each code of a finding: the text of `toile explain CODE`. A code stands here as soon as it can
//! appear.

mod engine;
mod inputs;

/// One code.
#[derive(Clone, Copy, Debug)]
pub struct Code {
    /// Kebab case, reads as what is wrong.
    pub code: &'static str,
    /// The mistake, and what to do about it.
    pub text: &'static str,
}

const fn code(code: &'static str, text: &'static str) -> Code {
    Code { code, text }
}

/// The tables, one for each part of the program; each is in alphabetical order.
const TABLES: [&[Code]; 2] = [engine::CODES, inputs::CODES];

/// All codes, in alphabetical order.
#[must_use]
pub fn all() -> Vec<Code> {
    let joined = [toile_formats::codes::CODES, toile_stages::codes::CODES]
        .into_iter()
        .flatten()
        .copied()
        .flatten()
        .map(|c| code(c.name(), c.text()));
    let mut all: Vec<Code> = TABLES.iter().copied().flatten().copied().chain(joined).collect();
    all.sort_by_key(|c| c.code);
    all
}

/// A code by its name.
#[must_use]
pub fn find(name: &str) -> Option<Code> {
    all().into_iter().find(|c| c.code == name)
}
