//! Public cases that the program cannot run yet; they are in no count.

/// Case, and what it waits for.
const LIST: [(&str, &str); 15] = [
    (
        "lattice-equilateral",
        "bare edge springs: the program takes fabrics; `--model springs` shows what springs make of them",
    ),
    ("lattice-square", "the same"),
    ("pressure-tube-0", "an inner pressure"),
    ("penalty-0", "animate (contact time); contact here is no penalty floor, see stages/cloth/docs/contact.md"),
    ("pendulum-0", "animate"),
    ("pendulum-1", "animate"),
    ("chain-0", "animate"),
    ("axial-0", "animate"),
    ("cantilever-vibration-0", "animate"),
    ("leapfrog-0", "animate with a fixed step"),
    ("leapfrog-damped-0", "animate with a fixed step"),
    ("damping-0", "animate"),
    ("fall-0", "animate, and a drag of the air"),
    ("grid-dt-0", "animate with a fixed step"),
    ("incline-0 distance, creep", "animate; the critical angle is among the cases"),
];

pub fn text() -> String {
    let lines: Vec<String> = LIST.iter().map(|(case, why)| format!("  {case:<28} {why}")).collect();
    format!("not possible yet, counted nowhere:\n{}", lines.join("\n"))
}
