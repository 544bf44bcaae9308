//! Codes of pattern files: DXF and grade rule tables.

use super::{Code, code};

/// Codes of pattern files: DXF and grade rule tables.
pub(super) const CODES: &[Code] = &[
    code(
        "dxf-profile",
        "Which program wrote the file, and why that is thought. Set `profile` of `import-dxf` to overrule it.",
    ),
    code(
        "ledger",
        "How many entities of the file were accepted, interpreted by a rule, and refused. `toile inspect` lists the rules.",
    ),
    code(
        "profile-unknown",
        "The `profile` asked for is no writer this program knows; the hint lists them. Exit code 2.",
    ),
    code("sizes-with-sewing", "A sewing file belongs to one size, and `size` of `import-dxf` is a list. Exit code 2."),
];
