//! Public cases that the program cannot run; they are in no count.

/// Case, and why.
const LIST: [(&str, &str); 1] = [(
    "lattice-square",
    "springs of 450 and 50 N/m are no fabric: diagonals bear at least half of the sides; other figures are among the cases",
)];

pub fn text() -> String {
    let lines: Vec<String> = LIST.iter().map(|(case, why)| format!("  {case:<28} {why}")).collect();
    format!("not possible, counted nowhere:\n{}", lines.join("\n"))
}
