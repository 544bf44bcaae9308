//! `toile body measure`: figures of the mesh, beside what the side file says.

use crate::support::project::Project;

fn figure(out: &str, name: &str) -> String {
    let line = out.lines().find(|l| l.split_whitespace().next() == Some(name));
    line.unwrap_or_else(|| panic!("no {name} in {out}")).to_owned()
}

#[test]
fn figures_are_those_of_the_mesh_and_told_every_time() {
    let project = Project::new();
    std::fs::remove_file(project.path("size-38.toml")).expect("side file");
    let (code, first, err) = project.toile("body measure size-38.obj");
    assert!(code == 0 && first.ends_with("size-38.toml\n"), "{first}{err}");
    let (code, again, err) = project.toile("body measure size-38.obj");
    assert_eq!(code, 0, "{err}");
    assert_eq!(figure(&again, "waist_girth"), figure(&first, "waist_girth"));
    // A wrong figure in the side file is told beside that of the mesh, and kept.
    let side = std::fs::read_to_string(project.path("size-38.toml")).expect("side file");
    let line = |name: &str| side.lines().find(|l| l.starts_with(name)).expect("a measure").to_owned();
    let wrong = side.replace(&line("hip_girth"), "hip_girth = \"870 mm\"");
    project.write("size-38.toml", &wrong);
    let (code, out, err) = project.toile("body measure size-38.obj");
    assert_eq!((code, std::fs::read_to_string(project.path("size-38.toml")).expect("side file")), (0, wrong), "{err}");
    assert!(figure(&out, "hip_girth").ends_with("870.0 in the side file"), "{out}");
    assert!(err.contains("warning[body-side-file-differs]") && err.contains("hip_girth 870 mm"), "{err}");
    // An edited height takes its girth with it. Without --force the figures are told, and nothing is written.
    let edited = side.replace(&line("waist_height"), "waist_height = \"1100 mm\"");
    project.write("size-38.toml", &edited);
    let (code, out, err) = project.toile("body measure size-38.obj");
    assert!(code == 2 && err.contains("--force") && err.contains("waist_height was edited"), "{err}");
    assert_ne!(figure(&out, "waist_girth"), figure(&first, "waist_girth"));
    assert!(figure(&out, "waist_height").contains("1100.0  by the side file"), "{out}");
    let (code, _, err) = project.toile("body measure size-38.obj --force");
    assert_eq!(code, 0, "{err}");
    let now = std::fs::read_to_string(project.path("size-38.toml")).expect("side file");
    assert!(!now.contains(&line("waist_girth")) && now.contains("waist_height = \"1100 mm\""), "{now}");
}

#[test]
fn a_unit_that_makes_no_person_is_refused() {
    let project = Project::new();
    let (code, out, err) = project.toile("body measure size-38.obj --units mm --out new.obj");
    assert!(code == 3 && out.is_empty() && err.contains("error[body-size]"), "{out}{err}");
    assert!(err.contains("--units m") && !project.path("new.obj").exists(), "{err}");
}
