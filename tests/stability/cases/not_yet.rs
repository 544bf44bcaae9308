//! Cases of the catalogue that the program cannot run yet, or that this harness does not ask yet; they are in no count.

/// Cases, and what they wait for.
const LIST: [(&str, &str); 15] = [
    ("B8", "import-mesh takes one fabric; pieces of two fabrics need a pattern with materials"),
    ("B12", "a drape has no damping of its own; animate: stages/cloth/tests/dynamics.rs"),
    ("C3 cap of 1", "the drape's steps are no parameter; C3 is asked with the time of central differences"),
    ("C5", "runs keep no checkpoints"),
    ("D15", "cloth coordinates over a dart: no figure in the outputs says so"),
    ("D17", "layers of a mesh: pieces only"),
    ("E11", "a body of a million triangles takes longer than a test may; the bench scenes have large bodies"),
    ("E17", "a sheet drawn through a ring: minutes"),
    ("E29", "a cape between two bodies in motion: minutes"),
    ("F6", "lengths times 10 are no power of two: F3 asks 1.6 % and 40 times within 1 %"),
    ("G3 sideways", "gravity is along the vertical only"),
    ("G9", "100,000 bad triangles: findings are counts already (A3, A6)"),
    ("H2", "other processors and systems: this machine is one"),
    ("I5", "effects are no features of the build"),
    ("I8", "the static drape has no steps in time"),
];

pub fn text() -> String {
    let lines: Vec<String> = LIST.iter().map(|(case, why)| format!("  {case:<26} {why}")).collect();
    format!("\nnot possible or not asked yet, counted nowhere:\n{}", lines.join("\n"))
}
