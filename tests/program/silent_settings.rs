//! What a person writes and nothing acts on: each is told by `check`, and all at once.

use crate::support;
use support::bench::Bench;

/// The sample skirt up to its drape, with more parameters of `stitch` and `drape`.
fn skirt(stitch: &str, drape: &str) -> Bench {
    let bench = Bench::new();
    bench.sample_skirt().sample("bodies/size-38.obj", "body.obj");
    bench.stages(&format!(
        "[[stage]]
use = \"import-dxf\"
with.file = \"skirt.dxf\"
with.sewing = \"skirt.sewing.toml\"
with.size = \"38\"
[[stage]]
use = \"triangulate\"
with.triangles = 150
[[stage]]
use = \"assemble\"
[[stage]]
use = \"stitch\"
with.body = \"body.obj\"
with.fabric = \"fabric.toml\"
{stitch}
[[stage]]
use = \"drape\"
{drape}
"
    ));
    bench
}

/// Replaces a text in a file beside the pipeline.
fn change(bench: &Bench, name: &str, from: &str, to: &str) {
    let file = bench.path(&format!("pipelines/test/{name}"));
    let text = std::fs::read_to_string(&file).expect("text");
    assert!(text.contains(from), "{name} lacks {from}");
    std::fs::write(file, text.replacen(from, to, 1)).expect("written");
}

/// What `check` finds, but for the notes on how the pattern was read.
fn codes(bench: &Bench) -> Vec<String> {
    let all = bench.findings(&[]).into_iter().map(|found| found.0);
    all.filter(|code| !["dxf-profile", "ledger"].contains(&code.as_str())).collect()
}

#[test]
fn a_leg_of_a_dart_is_not_held() {
    let bench = skirt("", "");
    assert_eq!(codes(&bench), [""; 0]);
    change(&bench, "skirt.sewing.toml", "edge = 2\nto = \"waist\"", "edge = 3\nto = \"waist\"");
    assert_eq!(codes(&bench), ["attach-dart-leg"]);
    assert_eq!(bench.run(&[]).code, 2);
}

#[test]
fn faults_of_the_fabric_and_of_the_body_are_told_together() {
    let bench = skirt("", "");
    change(&bench, "fabric.toml", "220 g/m2", "220 g");
    std::fs::write(bench.path("pipelines/test/body.toml"), "unit = 5 5").expect("written");
    let found = codes(&bench);
    assert!(found.len() >= 2 && found.iter().any(|c| c.starts_with("body")), "{found:?}");
    assert!(found.iter().any(|c| c.starts_with("fabric")), "{found:?}");
}

#[test]
fn parameters_that_do_nothing_are_told() {
    let scheme = "with.penalty = \"exponential\"\nwith.correction = \"provot\"\nwith.max_time = \"1 s\"";
    assert_eq!(codes(&skirt("", scheme)), ["setting-unused"; 3]);
    let paper = format!("with.integrator = \"central-difference\"\n{scheme}");
    assert_eq!(codes(&skirt("", &paper)), [""; 0]);
    assert_eq!(codes(&skirt("with.fabrics = { NOPE = \"fabric.toml\" }", "")), ["fabric-unused"]);
}

#[test]
fn a_gate_of_no_figure_is_refused() {
    let bench = skirt("", "with.limits = { strainmax = 1e-7 }");
    assert_eq!(codes(&bench).len(), 1);
    let said = bench.check(&[]);
    assert!(said.code == 2 && said.err.contains("strain_max"), "{said:?}");
    assert_eq!(codes(&skirt("", "with.limits = { strain_max = 1e-7 }")), [""; 0]);
}
