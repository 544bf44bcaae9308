//! Settings that a person writes and nothing acts on: each is told by `check`, and all at once.

use crate::support;
use support::bench::{Bench, SKIRT_STAGES};
use support::project::Project;

/// The sample skirt up to its drape, with more parameters of `stitch` and `drape`.
fn skirt(stitch: &str, drape: &str) -> Bench {
    let bench = Bench::new();
    bench.sample_skirt().sample("bodies/size-38.obj", "body.obj");
    bench.stages(&format!(
        "{SKIRT_STAGES}{stitch}
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

/// The findings of `check`, but for the notes on how the pattern was read.
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

#[test]
fn what_a_set_overrules_is_told_and_promises_nothing() {
    let project = Project::new();
    let (code, _, err) = project.toile("check draped.toml --accuracy draft");
    assert!(code == 0 && err.contains("accuracy-chosen") && !err.contains("choice-overruled"), "{err}");
    let (code, _, err) = project.toile("check draped.toml --accuracy draft --set triangulate.edge_length=60mm");
    assert!(code == 0 && err.contains("warning[choice-overruled]") && !err.contains("[accuracy-chosen]"), "{err}");
    assert!(err.contains("`triangulate.edge_length` is 60 mm"), "{err}");
    let (_, _, err) = project.toile("check draped.toml --accuracy draft --set triangulate.triangles=300");
    assert!(err.contains("`triangulate.edge_length` is not set"), "{err}");
    let (_, _, err) = project.toile("check draped.toml --repeats 2 --set drape.repeats=5");
    assert!(err.contains("--repeats is overruled: `drape.repeats` is 5, not 2"), "{err}");
    let (_, _, err) = project.toile("check draped.toml --repeats 5 --set drape.repeats=5");
    assert!(!err.contains("overruled"), "{err}");
}

#[test]
fn settings_of_a_motion_that_do_nothing_are_told_and_no_frame_is_refused() {
    let project = Project::new();
    let animated = |with: &str| {
        let chain = support::project::DRAPED.split("[[stage]]\nuse = \"texture\"").next().expect("a drape");
        project.write("moved.toml", &format!("{chain}[[stage]]\nuse = \"animate\"\nwith.frames = 3\n{with}"));
        project.toile("check moved.toml")
    };
    let (code, _, err) = animated("with.fixed_step = true\nwith.contact_stiffness = \"5 N/m\"\n");
    assert_eq!((code, err.matches("setting-unused").count()), (0, 2), "{err}");
    let (_, _, err) = animated("with.fixed_step = true\nwith.integrator = \"leapfrog\"\n");
    assert!(!err.contains("setting-unused"), "{err}");
    project.change("moved.toml", "with.frames = 3", "with.frames = 0");
    let (code, out, err) = project.toile("check moved.toml");
    assert!(code == 2 && err.contains("`frames` is 0"), "{out}{err}");
}
