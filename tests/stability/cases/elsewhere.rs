//! Cases of the catalogue that another harness holds; they are in no count here.

/// Cases, and where they are asked.
const LIST: [(&str, &str); 29] = [
    ("A9", "formats/src/dxf/tests (mirrored inserts)"),
    ("A11", "stages/src/triangulate/tests.rs (holes)"),
    ("A10 open, bow-tie", "tests/bad/dxf-open, tests/bad/dxf-self-crossing"),
    ("B4", "tests/validation, cantilever; formats of fabrics: formats/src/fabric/tests.rs"),
    ("B5 shear of the grain", "tests/validation, off_axis"),
    ("B10", "tests/bad/fabric-unit"),
    ("C1, C4", "toile study, tests/program/study.rs"),
    ("D8, D18", "tests/bad: piece-missing, sewing-unknown-edge, seam-lengths"),
    ("D9 cone angle", "tests/validation, cones; stages/cloth/tests/sewing.rs"),
    ("D10, D12, D14, D16", "formats/src/dxf/tests/dart_forms.rs, stages/src/sewing/apply/tests.rs"),
    ("D13", "pipelines/fitted-bodice, tests/golden/fitted-bodice"),
    ("E14 hoop tension", "tests/validation, sleeve"),
    ("E25", "stages/cloth/tests/physics.rs (slope of triangles)"),
    ("E28", "tests/validation, incline; stages/cloth/tests/dynamics.rs (Coulomb's law)"),
    ("F1 in a DXF", "formats/src/dxf/units.rs, formats/tests/habits"),
    ("G1", "tests/bad/dxf-nan, formats/tests/hostile.rs, formats/src/obj/tests.rs"),
    ("G7", "tests/bad/dxf-decimal-comma"),
    ("G8", "tests/program/cli.rs"),
    ("H1 in sewing and motion", "stages/cloth/tests/sewing.rs, stages/cloth/tests/dynamics.rs"),
    ("H9", "the program keeps no cache between runs"),
    ("H11", "tests/golden"),
    ("I1, I2, I4, I10", "stages/cloth/tests/effects.rs"),
    ("I5", "tests/left_out.rs, in a build without these effects, too (.ci/run)"),
    ("I7", "stages/cloth/tests/effects.rs, tests/program/engine.rs (effects of run.json)"),
    ("I8", "stages/cloth/tests/dynamics.rs (a contact that is needed late)"),
    ("J1, J2", "formats/tests/hostile.rs, formats/tests/mutants.rs, fuzz/"),
    ("J3", "tests/program/faults.rs"),
    ("J4", "tests/program/truncated.rs"),
    ("J6, J7", "formats/tests/dxf_round_trip.rs, formats/src/gltf/tests.rs"),
];

pub fn text() -> String {
    let lines: Vec<String> = LIST.iter().map(|(case, place)| format!("  {case:<26} {place}")).collect();
    format!("\nheld elsewhere, counted nowhere here:\n{}", lines.join("\n"))
}
