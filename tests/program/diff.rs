//! Two versions of one skirt: a dart moved by 5 mm and another fabric, in mm and in words.

use crate::support;
use serde_json::Value;
use support::project::Project;

/// Moves the left dart of the front in size 38 by 5 mm to the side.
fn move_dart(project: &Project) {
    let text = std::fs::read_to_string(project.path("long-skirt.astm.dxf")).expect("pattern");
    let (before, rest) = text.split_once("FRONT_38").expect("block");
    let (block, after) = rest.split_once("ENDBLK").expect("end");
    let moved = block.split('\n').map(|line| match line.trim() {
        "98.8800" => line.replace("98.8800", "103.8800"),
        "88.8800" => line.replace("88.8800", "93.8800"),
        "78.8800" => line.replace("78.8800", "83.8800"),
        _ => line.to_owned(),
    });
    let moved = moved.collect::<Vec<_>>().join("\n");
    assert_ne!(moved, block);
    project.write("long-skirt.astm.dxf", &format!("{before}FRONT_38{moved}ENDBLK{after}"));
}

fn run(project: &Project, out: &str, more: &str) {
    let (code, _, err) = project.toile(format!("run draped.toml --out {out} --quiet {more}").trim());
    assert!(code == 0 || code == 1, "{code}: {err}");
}

fn changes(project: &Project, words: &str) -> (i32, Vec<Value>) {
    let (code, out, err) = project.toile(&format!("diff {words} --format json"));
    let found: Value = serde_json::from_str(&out).unwrap_or_else(|e| panic!("{e}: {out}{err}"));
    (code, found["changes"].as_array().expect("changes").clone())
}

/// Differences of a group, as name and amount.
fn of<'a>(changes: &'a [Value], group: &str) -> Vec<(&'a str, f64)> {
    let own = changes.iter().filter(|c| c["group"] == group);
    own.map(|c| (c["what"].as_str().expect("what"), c["by"].as_f64().unwrap_or(f64::NAN))).collect()
}

#[test]
fn a_moved_dart_and_another_fabric_are_told_exactly() {
    let project = Project::new();
    run(&project, "a", "");
    run(&project, "same", "");
    assert_eq!(changes(&project, "a same"), (0, Vec::new()), "the same run twice");

    run(&project, "linen", "--set fabric=linen-plain");
    let (code, found) = changes(&project, "a linen");
    assert_eq!(code, 1);
    assert!(of(&found, "pieces").is_empty() && of(&found, "darts").is_empty() && of(&found, "seams").is_empty());
    let names: Vec<&str> = of(&found, "inputs").iter().map(|c| c.0).collect();
    assert_eq!(names, ["wool-suiting.toml", "linen-plain.toml"]);
    assert_eq!(of(&found, "parameters").iter().map(|c| c.0).collect::<Vec<_>>(), ["stitch.fabric"]);
    assert!(of(&found, "fabric").iter().any(|c| c.0 == "fabric.name"));

    move_dart(&project);
    run(&project, "dart", "");
    let (code, found) = changes(&project, "a dart");
    assert_eq!(code, 1);
    assert_eq!(of(&found, "inputs").iter().map(|c| c.0).collect::<Vec<_>>(), ["long-skirt.astm.dxf"]);
    assert!(of(&found, "parameters").is_empty() && of(&found, "fabric").is_empty());
    let darts = of(&found, "darts");
    assert_eq!(darts.len(), 2, "apex and mouth of one dart, whose intake and legs stay: {darts:?}");
    for (what, mm) in &darts {
        assert!(what.starts_with("FRONT, dart") && (mm - 5.0).abs() < 1e-3, "{what} {mm}");
    }
    let pieces = of(&found, "pieces");
    let moved = pieces.iter().find(|c| c.0.contains("outline moved")).expect("outline");
    assert!(moved.1 > 3.0 && moved.1 <= 5.001 && pieces.iter().all(|c| c.0.starts_with("FRONT")), "{pieces:?}");
    let shape = of(&found, "shape");
    let largest = shape.iter().find(|c| c.0 == "distance of the surfaces after alignment, largest").expect("shape");
    assert!(largest.1 > 0.1, "{shape:?}");

    project.write("loose.toml", "darts = \"6 mm\"\npieces = \"6 mm\"\nparameters = \"same\"\n");
    assert_eq!(project.toile("diff a dart --tolerance loose.toml").0, 0);
    project.write("none.toml", "");
    let (code, _, err) = project.toile("diff a dart --tolerance none.toml");
    assert!(code == 0 && err.contains("warning[tolerance-empty]"), "{err}");
    project.write("none.toml", "darts = \"-1 mm\"\n");
    let (code, _, err) = project.toile("diff a dart --tolerance none.toml");
    assert!(code == 2 && err.contains("must be 0 or more"), "{err}");
    project.write("tight.toml", "darts = \"4 mm\"\n");
    let (code, out, _) = project.toile("diff a dart --tolerance tight.toml");
    assert_eq!((code, out.matches("over the tolerance").count()), (1, 2), "{out}");
    let (_, page, _) = project.toile("diff a/skirt.glb dart/run.json --format html");
    assert_eq!(page.matches("data:image/png;base64,").count(), 4, "front and back of both");
    let (code, _, err) = project.toile("diff a nowhere");
    assert!(code == 3 && err.contains("error[diff-no-result]"), "{err}");
}
