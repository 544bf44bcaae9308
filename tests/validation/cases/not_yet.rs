//! Public cases that the program cannot run yet; they are in no count.

/// Case, and what it waits for.
const LIST: [(&str, &str); 8] = [
    (
        "lattice-equilateral",
        "bare edge springs: the program takes fabrics; `--model springs` shows what springs make of them",
    ),
    ("lattice-square", "the same"),
    ("pressure-tube-0", "an inner pressure"),
    ("penalty-0", "a penalty floor: contact is a barrier, and hits do not rebound (stages/cloth/docs/dynamics.md)"),
    ("leapfrog-0", "central differences in time with a step that is told: `animate` steps implicitly"),
    ("leapfrog-damped-0", "the same"),
    ("axial-0 dt_crit", "the same; its frequencies are among the cases"),
    ("grid-dt-0", "the same"),
];

pub fn text() -> String {
    let lines: Vec<String> = LIST.iter().map(|(case, why)| format!("  {case:<28} {why}")).collect();
    format!("not possible yet, counted nowhere:\n{}", lines.join("\n"))
}
