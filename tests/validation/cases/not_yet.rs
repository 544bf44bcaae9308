//! Public cases that the program cannot run; they are in no count.

/// Case, and why.
const LIST: [(&str, &str); 2] = [
    (
        "lattice-square",
        "springs of 450 and 50 N/m are no fabric: diagonals bear at least half of the sides; other figures are among the cases",
    ),
    ("penalty-0", "a penalty floor: contact is a barrier, and hits do not rebound (stages/cloth/docs/dynamics.md)"),
];

pub fn text() -> String {
    let lines: Vec<String> = LIST.iter().map(|(case, why)| format!("  {case:<28} {why}")).collect();
    format!("not possible, counted nowhere:\n{}", lines.join("\n"))
}
