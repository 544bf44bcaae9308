//! Cases of the catalogue that the program cannot run yet, or that this harness does not ask yet; they are in no count.

/// Cases, and what they wait for.
const LIST: [(&str, &str); 7] = [
    ("B12", "a drape has no damping of its own; animate: stages/cloth/tests/dynamics.rs"),
    ("C3 cap of 1", "the drape's steps are no parameter; C3 is asked with the time of central differences"),
    ("C5", "runs keep no checkpoints"),
    (
        "E17 in wide rings",
        "the drape stops with cloth stretched at what is held: no ring was found that lets it through",
    ),
    ("F6 on a body, shaken", "there are several rests; which one is taken, and how near, hangs on the last digit"),
    ("G3 sideways", "gravity is along the vertical only"),
    ("H2", "other processors and systems: this machine is one"),
];

pub fn text() -> String {
    let lines: Vec<String> = LIST.iter().map(|(case, why)| format!("  {case:<26} {why}")).collect();
    format!("\nnot possible or not asked yet, counted nowhere:\n{}", lines.join("\n"))
}
