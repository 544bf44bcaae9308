//! Changed patterns: what is written can be sewn again, lines may be drawn on the drape, and nothing is lost.

use crate::support;
use serde_json::Value;
use support::bench::Bench;

/// The fitted bodice on its body, with the files of the bench.
fn bodice() -> Bench {
    let bench = Bench::new();
    for (from, name) in [
        ("patterns/fitted-bodice.astm.dxf", "bodice.dxf"),
        ("patterns/fitted-bodice.sewing.toml", "bodice.sewing.toml"),
        ("bodies/size-38.obj", "body.obj"),
        ("bodies/size-38.toml", "body.toml"),
        ("fabrics/cotton-shirting.toml", "fabric.toml"),
    ] {
        bench.sample(from, name);
    }
    bench
}

const IMPORT: &str =
    "[[stage]]\nuse = \"import-dxf\"\nwith.file = \"bodice.dxf\"\nwith.sewing = \"bodice.sewing.toml\"\n";
const SEW: &str = "[[stage]]\nuse = \"triangulate\"\nwith.edge_length = \"22 mm\"\n[[stage]]\nuse = \"assemble\"\n\
                   [[stage]]\nuse = \"stitch\"\nwith.body = \"body.obj\"\nwith.fabric = \"fabric.toml\"\n\
                   [[stage]]\nuse = \"drape\"\n";
const WRITE: &str = "[[stage]]\nuse = \"export-dxf\"\nwith.file = \"{out}/new.dxf\"\n\
                     with.sewing = \"{out}/new.sewing.toml\"\nwith.source = \"pattern\"\n";
const PRINCESS: &str = "[[stage]]\nuse = \"alter\"\n\
    [[stage.with.change]]\ndo = \"cut\"\npiece = \"FRONT\"\nalong = [\"dart-1\", \"dart-2\"]\n\
    into = { left = \"FRONT\", right = \"SIDE-LEFT\" }\n\
    [[stage.with.change]]\ndo = \"cut\"\npiece = \"FRONT\"\nalong = [\"dart-4\", \"dart-3\"]\n\
    into = { left = \"SIDE-RIGHT\", right = \"FRONT\" }\n";

fn passed(bench: &Bench) -> bool {
    bench.record()["certificate"]["passed"] == Value::Bool(true)
}

/// The written pattern is read again with its sewing file, sewn and draped.
fn is_sewn_again(bench: &Bench) -> bool {
    let again = bodice();
    for name in ["new.dxf", "new.sewing.toml"] {
        std::fs::copy(bench.out().join(name), again.path("pipelines/test").join(name)).expect("copy");
    }
    let import = IMPORT.replace("bodice.", "new.");
    again.stages(&[import.as_str(), SEW].concat());
    let said = again.run(&[]);
    assert_eq!(said.code, 0, "{said:?}");
    passed(&again)
}

#[test]
fn princess_seams_are_sewn_and_so_is_what_was_written() {
    let bench = bodice();
    bench.stages(&[IMPORT, PRINCESS, WRITE, SEW].concat());
    let said = bench.run(&[]);
    assert_eq!(said.code, 0, "{said:?}");
    assert!(passed(&bench) && is_sewn_again(&bench));
    let sewing = bench.output("new.sewing.toml").expect("sewing file");
    assert!(sewing.contains("name = \"FRONT SIDE-LEFT\"") && sewing.contains("name = \"side-left\""), "{sewing}");
}

#[test]
fn a_line_that_is_drawn_on_the_drape_cuts_the_piece_there() {
    let draped = bodice();
    let glb = "[[stage]]\nuse = \"export-gltf\"\nwith.file = \"{out}/bodice.glb\"\n";
    draped.stages(&[IMPORT, SEW, glb].concat());
    assert_eq!(draped.run(&[]).code, 0);
    let bench = bodice();
    std::fs::copy(draped.out().join("bodice.glb"), bench.path("pipelines/test/bodice.glb")).expect("copy");
    let yoke = "[[stage]]\nuse = \"import-garment\"\nwith.file = \"bodice.glb\"\n[[stage]]\nuse = \"alter\"\n\
                [[stage.with.change]]\ndo = \"cut\"\npiece = \"FRONT\"\nsmooth = true\n\
                along = [[210, 1300, 60], [100, 1290, 150], [0, 1285, 160], [-100, 1290, 150], [-210, 1300, 60]]\n\
                into = { upper = \"YOKE\", lower = \"FRONT\" }\n";
    bench.stages(&[yoke, WRITE, SEW].concat());
    let said = bench.run(&[]);
    assert_eq!(said.code, 0, "{said:?}");
    assert!(passed(&bench) && is_sewn_again(&bench));
    // What was built on the old pieces is gone when nothing is sewn anew.
    bench.stages(&[yoke, "[[stage]]\nuse = \"flatten\"\n"].concat());
    assert_eq!(bench.run(&["--force"]).code, 2);
}

#[test]
fn a_change_that_cannot_be_made_tells_its_number_and_what_there_is() {
    let bench = bodice();
    let wrong = PRINCESS.replace("dart-3", "dart-9");
    bench.stages(&[IMPORT, wrong.as_str()].concat());
    let said = bench.check(&[]);
    assert_eq!(said.code, 2, "{said:?}");
    assert!(said.err.contains("change 2: piece `FRONT` has no dart `dart-9`"), "{}", said.err);
}
