//! Stages that make pieces or meshes anew: what was built on the old ones is gone, and nothing mixes the two.

use crate::support;
use support::bench::Bench;

const IMPORT: &str = "[[stage]]
use = \"import-dxf\"
with.file = \"skirt.dxf\"
with.sewing = \"skirt.sewing.toml\"
with.size = \"38\"
";
const STITCH: &str = "[[stage]]
use = \"stitch\"
with.body = \"body.obj\"
with.fabric = \"fabric.toml\"
";
const REPORT: &str = "[[stage]]\nuse = \"export-report\"\n";
const ASSEMBLE: &str = "[[stage]]\nuse = \"assemble\"\n";

fn mesh(triangles: usize) -> String {
    format!("[[stage]]\nuse = \"triangulate\"\nwith.triangles = {triangles}\n")
}

fn project(stages: &[&str]) -> Bench {
    let bench = Bench::new();
    bench.sample_skirt().sample("bodies/size-38.obj", "body.obj");
    bench.stages(&stages.concat());
    bench
}

/// Stitches of the first mesh are no stitches of the second one.
#[test]
fn what_is_outdated_does_not_count_as_given() {
    let (coarse, fine) = (mesh(150), mesh(260));
    let again = |last: &str| [IMPORT, &coarse, ASSEMBLE, STITCH, &fine, last].map(str::to_owned);
    for (last, lacks) in [(STITCH, "seams"), ("[[stage]]\nuse = \"drape\"\n", "stitched")] {
        let stages = again(last);
        let bench = project(&stages.each_ref().map(String::as_str));
        let said = bench.check(&[]);
        assert_eq!(said.code, 2, "{said:?}");
        let words = format!("needs {lacks}, and what was there is outdated by the stage `triangulate`");
        assert!(said.err.contains("needs-not-given") && said.err.contains(&words), "{}", said.err);
    }
    let pieces_anew = project(&[IMPORT, &coarse, IMPORT, ASSEMBLE]);
    let said = pieces_anew.check(&[]);
    assert_eq!(said.code, 2, "{said:?}");
    assert!(said.err.contains("`assemble` needs mesh, and what was there is outdated by the stage `import-dxf`"));
}

/// The page of a garment that was meshed anew tells of the mesh that is there, and of no shape.
#[test]
fn stages_see_nothing_outdated() {
    let (coarse, fine) = (mesh(150), mesh(260));
    let bench = project(&[IMPORT, &coarse, ASSEMBLE, STITCH, &fine, ASSEMBLE, REPORT]);
    let said = bench.run(&[]);
    assert_eq!(said.code, 0, "{said:?}");
    let sewn_again = project(&[IMPORT, &coarse, ASSEMBLE, STITCH, &fine, ASSEMBLE, STITCH, REPORT]);
    assert_eq!(sewn_again.run(&[]).code, 0);
    let once = project(&[IMPORT, &fine, ASSEMBLE, STITCH, REPORT]);
    assert_eq!(once.run(&[]).code, 0);
    let shape = |bench: &Bench| bench.record()["garment"].clone();
    assert!(shape(&once)["triangles"].as_u64().expect("count") > 200);
    assert_eq!(shape(&sewn_again), shape(&once));
}
