//! Public cases that the program cannot run yet; they are in no count.

/// Case, and what it waits for.
const LIST: [(&str, &str); 5] = [
    (
        "lattice-equilateral",
        "bare edge springs: the program takes fabrics; `--model springs` shows what springs make of them",
    ),
    ("lattice-square", "the same"),
    ("penalty-0", "a penalty floor: contact is a barrier, and hits do not rebound (stages/cloth/docs/dynamics.md)"),
    (
        "leapfrog-damped-0",
        "damping that lags: that of the central differences here is centred and leaves the step its length",
    ),
    (
        "axial-0 dt_crit",
        "a chain: the corners of a free end of triangles are lighter and bear 0.91 of its step; grid-dt-0 is among the cases",
    ),
];

pub fn text() -> String {
    let lines: Vec<String> = LIST.iter().map(|(case, why)| format!("  {case:<28} {why}")).collect();
    format!("not possible yet, counted nowhere:\n{}", lines.join("\n"))
}
