//! `toile bundle`: one file that does a run again elsewhere, and hostile ones that are refused.

use crate::support;
use serde_json::Value;
use support::project::Project;

/// A printed skirt whose pattern lies in another folder and is named by `--set`, and its bundle.
fn bundled() -> Project {
    let project = Project::new();
    std::fs::create_dir(project.path("season")).expect("folder");
    let pattern = project.path("long-skirt.astm.dxf");
    std::fs::rename(pattern, project.path("season/skirt.dxf")).expect("moved");
    good(&project, "run printed.toml --set pattern=season/skirt.dxf --set size=36 --out out --quiet");
    good(&project, "bundle out --out skirt.tar");
    project
}

fn good(project: &Project, words: &str) -> String {
    let (code, out, err) = project.toile(words);
    assert_eq!(code, 0, "{words}: {err}");
    out
}

/// Verifies a bundle of these bytes; gives exit code and messages.
fn verify(project: &Project, bytes: &[u8]) -> (i32, String) {
    std::fs::write(project.path("changed.tar"), bytes).expect("written");
    let (code, _, err) = project.toile("bundle verify changed.tar --run");
    (code, err)
}

/// A tar archive of entries: path, type, bytes.
fn archive(entries: &[(&str, tar::EntryType, &[u8])]) -> Vec<u8> {
    let mut builder = tar::Builder::new(Vec::new());
    for (path, kind, bytes) in entries {
        let mut header = tar::Header::new_ustar();
        // As somebody who means harm would: past the checks of the library.
        header.as_mut_bytes()[..path.len()].copy_from_slice(path.as_bytes());
        header.set_mode(0o644);
        header.set_size(bytes.len() as u64);
        header.set_entry_type(*kind);
        header.set_cksum();
        builder.append(&header, *bytes).expect("entry");
    }
    builder.into_inner().expect("archive")
}

/// A list that is right for these files.
fn list(files: &[(&str, &[u8])], set: &[&str]) -> Vec<u8> {
    let file = |(path, bytes): &(&str, &[u8])| serde_json::json!({ "path": path, "bytes": bytes.len(), "blake3": blake3::hash(bytes).to_hex().to_string() });
    let list = serde_json::json!({
        "toile_bundle": 1, "program": "0.1.0", "key": null, "pipeline": files[0].0, "set": set,
        "files": files.iter().map(file).collect::<Vec<_>>(), "exit_code": 0, "outputs": [],
    });
    serde_json::to_vec(&list).expect("JSON")
}

const FILE: tar::EntryType = tar::EntryType::Regular;

#[test]
fn a_bundle_runs_again_to_the_same_bytes_elsewhere() {
    let project = bundled();
    let bytes = std::fs::read(project.path("skirt.tar")).expect("bundle");
    good(&project, "run printed.toml --set pattern=season/skirt.dxf --set size=36 --out again --quiet");
    good(&project, "bundle again/run.json --out again.tar");
    assert!(std::fs::read(project.path("again.tar")).expect("bundle") == bytes, "the same run gives the same bundle");
    let (code, _, err) = project.toile("bundle out --out skirt.tar");
    assert!(code == 2 && err.contains("replace it with --force"), "{err}");

    let elsewhere = tempfile::tempdir().expect("folder");
    std::fs::write(elsewhere.path().join("skirt.tar"), &bytes).expect("copied");
    let mut command = project.command("bundle verify skirt.tar --run --json");
    let output = command.current_dir(elsewhere.path()).output().expect("program");
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let found: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let bundle = &found["bundle"];
    let paths: Vec<&str> =
        bundle["files"].as_array().expect("files").iter().filter_map(|f| f["path"].as_str()).collect();
    assert_eq!(paths, ["given/pattern/skirt.dxf", "long-skirt.sewing.toml", "printed.toml", "toile.root"]);
    assert_eq!(bundle["set"], serde_json::json!(["pattern=given/pattern/skirt.dxf", "size=36"]));
    let svg = std::fs::read(project.path("out/pieces.svg")).expect("output");
    assert_eq!(bundle["outputs"][0]["blake3"], blake3::hash(&svg).to_hex().as_str());
    assert_eq!(found["blake3"], blake3::hash(&bytes).to_hex().as_str());
    let left: Vec<_> = std::fs::read_dir(elsewhere.path()).expect("folder").collect();
    assert_eq!(left.len(), 1, "nothing is left beside it");

    // Unpacked by any program, the pipeline runs from its folder.
    tar::Archive::new(&bytes[..]).unpack(elsewhere.path().join("by-hand")).expect("unpacked");
    let mut command = project.command("run printed.toml --set pattern=given/pattern/skirt.dxf --set size=36 --quiet");
    let output = command.current_dir(elsewhere.path().join("by-hand")).output().expect("program");
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(std::fs::read(elsewhere.path().join("by-hand/out/printed-v1/pieces.svg")).expect("output") == svg);
}

#[test]
fn a_pipeline_keeps_its_way_to_files_beside_its_folder() {
    let project = Project::new();
    std::fs::create_dir_all(project.path("lines/skirts")).expect("folder");
    let text = support::project::PRINTED.replace("long-skirt.sewing", "../../long-skirt.sewing");
    project.write("lines/skirts/v1.toml", &text.replace("\"long-skirt.astm.dxf\"", "\"../../long-skirt.astm.dxf\""));
    good(&project, "run lines/skirts/v1.toml --out out --quiet");
    good(&project, "bundle out --out skirt.tar");
    let out = good(&project, "bundle verify skirt.tar --run");
    assert!(out.contains("pipeline lines/skirts/v1.toml\n") && out.ends_with("1 outputs, all the same\n"), "{out}");
}

#[test]
fn what_has_changed_since_the_run_is_not_packed() {
    let project = bundled();
    project.change("long-skirt.sewing.toml", "FRONT", "FRONT ");
    let (code, _, err) = project.toile("bundle out --out new.tar");
    assert!(
        code == 3 && err.contains("error[bundle-input-changed] `long-skirt.sewing.toml` has changed"),
        "{code} {err}"
    );
    project.change("printed.toml", "version = 1", "version = 2");
    let (code, _, err) = project.toile("bundle out --out new.tar");
    assert!(code == 3 && err.contains("`printed.toml` has changed since the run") && !project.path("new.tar").exists());
    let (code, _, err) = project.toile("bundle season --out new.tar");
    assert!(code == 3 && err.contains("error[bundle-no-run]"), "{err}");
}

#[test]
fn one_changed_byte_is_found() {
    let project = bundled();
    let bytes = std::fs::read(project.path("skirt.tar")).expect("bundle");
    let at = bytes.windows(7).position(|w| w == b"SECTION").expect("the pattern");
    let mut changed = bytes.clone();
    changed[at] ^= 1;
    let (code, err) = verify(&project, &changed);
    assert_eq!(code, 3);
    assert!(err.contains("error[bundle-damaged] `given/pattern/skirt.dxf` has changed"), "{err}");
    let (code, err) = verify(&project, &bytes[..bytes.len() / 2]);
    assert!(code == 3 && err.contains("error[bundle-damaged]"), "{err}");
    // Another run than the one that is listed.
    let digest = blake3::hash(&std::fs::read(project.path("out/pieces.svg")).expect("output")).to_hex().to_string();
    let start = bytes.windows(64).position(|w| w == digest.as_bytes()).expect("listed");
    let mut other = bytes.clone();
    other[start] = if other[start] == b'0' { b'1' } else { b'0' };
    let (code, err) = verify(&project, &other);
    assert!(code == 1 && err.contains("error[bundle-differs] `pieces.svg` has other bytes"), "{code} {err}");
}

#[test]
fn hostile_entries_are_refused_and_nothing_is_written() {
    let project = bundled();
    let pipeline = support::project::PRINTED.as_bytes();
    let head = |files: &[(&str, &[u8])]| list(files, &[]);
    let listed = head(&[("p.toml", pipeline)]);
    let refused = |name: &str, bytes: Vec<u8>, why: &str| {
        let (code, err) = verify(&project, &bytes);
        assert!(code == 3 && err.contains("error[bundle-refused]") && err.contains(why), "{name}: {code} {err}");
    };
    let plain = |more: (&'static str, tar::EntryType, &'static [u8])| {
        archive(&[("toile-bundle.json", FILE, &listed), ("p.toml", FILE, pipeline), more])
    };
    refused("out of the folder", plain(("../evil.toml", FILE, b"x")), "`../evil.toml` leads out of the folder");
    refused("absolute", plain(("/tmp/evil.toml", FILE, b"x")), "leads out of the folder");
    refused("within", plain(("a/../../evil", FILE, b"x")), "leads out of the folder");
    refused("link", plain(("link", tar::EntryType::Symlink, b"")), "`link` is a link");
    refused("hard link", plain(("link", tar::EntryType::Link, b"")), "`link` is a link");
    refused("long name", plain(("name", tar::EntryType::GNULongName, b"../evil")), "no plain file");
    refused("not listed", plain(("more.toml", FILE, b"x")), "`more.toml` is not in the list");
    refused("twice", plain(("p.toml", FILE, b"")), "`p.toml` is in the bundle twice");
    let small = head(&[("p.toml", &pipeline[..10])]);
    let large = archive(&[("toile-bundle.json", FILE, &small), ("p.toml", FILE, pipeline)]);
    refused("larger than stated", large, "bytes, the list says 10");
    let up = head(&[("../p.toml", pipeline)]);
    refused(
        "listed",
        archive(&[("toile-bundle.json", FILE, &up), ("../p.toml", FILE, pipeline)]),
        "`../p.toml` cannot stand",
    );
    refused("no list", archive(&[("p.toml", FILE, pipeline)]), "does not begin with toile-bundle.json");
    let sewing = std::fs::read(project.path("long-skirt.sewing.toml")).expect("sewing");
    let files: [(&str, &[u8]); 2] = [("p.toml", pipeline), ("long-skirt.sewing.toml", &sewing)];
    let outside = project.path("season/skirt.dxf");
    let set = list(&files, &[&format!("pattern={}", outside.display())]);
    let bytes = archive(&[("toile-bundle.json", FILE, &set), ("p.toml", FILE, pipeline), (files[1].0, FILE, &sewing)]);
    refused("an override", bytes, "the override of `pattern` leads out of the bundle");
    let missing = archive(&[("toile-bundle.json", FILE, &listed)]);
    let (code, err) = verify(&project, &missing);
    assert!(code == 3 && err.contains("error[bundle-damaged] `p.toml` is in the list and not in the bundle"), "{err}");
}

#[test]
fn a_draped_skirt_comes_back_to_the_same_bytes() {
    let project = Project::new();
    // A study beside the pipeline chooses the mesh, so it is an input as all others.
    project.write("draped.study.json", "{}");
    let (code, _, err) = project.toile("run draped.toml --out out --quiet --set fabric=linen-plain --accuracy draft");
    assert!(code == 0 || code == 1, "{err}");
    let record = project.json("out/run.json");
    assert!(record["inputs"].to_string().contains("draped.study.json") && record["key"].is_string(), "{record}");
    let (_, out, err) = project.toile("deps draped.toml --set fabric=linen-plain --accuracy draft --json");
    let deps: Value = serde_json::from_str(&out).expect(&err);
    assert!(deps["key"] == record["key"] && deps["inputs"].to_string().contains("draped.study.json"), "{deps}");
    good(&project, "bundle out --out skirt.tar");
    let out = good(&project, "bundle verify skirt.tar --run");
    assert!(out.contains("set      fabric=linen-plain\n") && out.ends_with("all the same\n"), "{out}");
    project.write("draped.study.json", "{ }");
    let (code, _, err) = project.toile("bundle out --out other.tar");
    assert!(code == 3 && err.contains("`draped.study.json` has changed since the run"), "{err}");
}
