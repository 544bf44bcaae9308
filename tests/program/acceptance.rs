//! `toile test`: golden cases of a house, with a file of their own and the program alone.

use crate::support;
use serde_json::Value;
use support::project::Project;

/// A case that prints, and one that must fail.
const CASES: &str = "toile = 1\n# Cases of the print.\n[[case]]\nname = \"print-38\"\npipeline = \"printed.toml\"\n\
    set = { size = \"38\" }\n[case.figures]\ngarment.pieces = { within = 0 } # both pieces\n\
    [case.hashes]\n\"pieces.svg\" = \"\"\n\n\
    [[case]]\nname = \"no-size\"\npipeline = \"printed.toml\"\nset = { size = \"99\" }\nexit = 2\n\
    findings = [\"size-not-found\"]\n";

fn project() -> Project {
    let project = Project::new();
    project.write("toile-test.toml", CASES);
    project
}

fn read(project: &Project, name: &str) -> String {
    std::fs::read_to_string(project.path(name)).expect(name)
}

/// Gives the cases their golden values.
fn bless(project: &Project) {
    let mut command = project.command("test --bless --quiet --reason");
    let output = command.arg("first values").output().expect("program");
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn blessed_cases_pass_and_all_else_in_the_file_stays() {
    let project = project();
    let (code, out, _) = project.toile("test");
    assert_eq!(code, 1, "{out}");
    assert!(out.contains("`garment.pieces` is 2 and has no golden value yet"), "{out}");
    bless(&project);
    let digest = {
        assert_eq!(project.toile("run printed.toml --out out --quiet").0, 0);
        blake3::hash(&std::fs::read(project.path("out/pieces.svg")).expect("print")).to_hex().to_string()
    };
    let history = format!(
        "\n[[history]]\nreason = \"first values\"\ntoile = \"{}\"\nchanged = [\n    \
         \"print-38: garment.pieces none → 2\",\n    \"print-38: pieces.svg none → {}\",\n]\n",
        env!("CARGO_PKG_VERSION"),
        &digest[..12]
    );
    let wanted = CASES.replace("within = 0 }", "within = 0, value = 2 }").replace("\"\"\n", &format!("\"{digest}\"\n"));
    assert_eq!(read(&project, "toile-test.toml"), wanted + &history);
    let (code, out, err) = project.toile("test");
    assert_eq!((code, err.as_str()), (0, "print-38 …\nno-size …\n"));
    assert_eq!(out, "toile-test.toml\n  print-38: passed\n  no-size: passed\n2 cases: 2 passed, 0 failed\n");
    let before = read(&project, "toile-test.toml");
    bless(&project);
    assert_eq!(read(&project, "toile-test.toml"), before, "nothing changed: no history");
}

#[test]
fn golden_values_are_not_written_without_a_reason_nor_for_runs_that_fail() {
    let project = project();
    for words in ["test --bless", "test --bless --reason= "] {
        let (code, _, err) = project.toile(words.trim_end());
        assert!(code == 2 && err.contains("error[test-no-reason]"), "{words}: {code} {err}");
    }
    project.change("toile-test.toml", "exit = 2", "exit = 0");
    let (code, _, err) = project.toile("test --bless --reason another --quiet");
    assert!(
        code == 1 && err.contains("error[test-not-blessed] `no-size`: the exit code is 2 (usage), expected 0"),
        "{err}"
    );
    assert!(!read(&project, "toile-test.toml").contains("history"), "all files or none");
    project.change("toile-test.toml", "within = 0 }", "within = 0, max = 1 }");
    let (code, _, err) = project.toile("test --bless --reason another --quiet --only print-38");
    assert!(code == 1 && err.contains("`garment.pieces` is 2, at most 1 is allowed"), "{err}");
}

#[test]
fn a_case_that_judges_nothing_says_so() {
    let project = Project::new();
    project.write("toile-test.toml", "toile = 1\n[[case]]\nname = \"a\"\npipeline = \"printed.toml\"\n");
    let (code, out, err) = project.toile("test --quiet");
    assert!(code == 0 && out.contains("  a: passed, but it judges nothing"), "{out}{err}");
    let like = "like = \"a.glb\"\ntolerance = {}\n";
    project
        .write("toile-test.toml", &format!("toile = 1\n[[case]]\nname = \"a\"\npipeline = \"printed.toml\"\n{like}"));
    let (code, _, err) = project.toile("test --quiet");
    assert!(code == 2 && err.contains("the tolerance states nothing"), "{err}");
}

#[test]
fn what_differs_is_told_with_both_values_in_every_form() {
    let project = project();
    bless(&project);
    project.change("toile-test.toml", "value = 2", "value = 3");
    project.change("printed.toml", "{out}/pieces.svg\"", "{out}/pieces.svg\"\nwith.width = \"600 mm\"");
    let (code, out, _) = project.toile("test --junit verdicts.xml --quiet");
    assert_eq!(code, 1);
    assert!(out.contains("  print-38: failed\n    `garment.pieces` is 2, expected 3 ± 0 (-1)\n"), "{out}");
    assert!(out.contains("    `pieces.svg` has other bytes: its hash is "), "{out}");
    assert!(out.ends_with("2 cases: 1 passed, 1 failed\n"), "{out}");

    let xml = read(&project, "verdicts.xml");
    let suite = parse(&xml);
    assert_eq!(suite.attribute("tests"), "2");
    assert_eq!((suite.attribute("failures"), suite.attribute("errors")), ("1", "0"));
    let names: Vec<&str> = suite.children.iter().map(|c| c.attribute("name")).collect();
    assert_eq!(names, ["print-38", "no-size"]);
    let failure = &suite.children[0].children[0];
    assert!(failure.name == "failure" && failure.text.contains("`garment.pieces` is 2, expected 3 ± 0 (-1)"));
    assert!(suite.children[1].children.is_empty() && !xml.contains("time="), "a clock has no place in it: {xml}");
    let (code, _, _) = project.toile("test --junit verdicts.xml --quiet");
    assert_eq!((code, read(&project, "verdicts.xml")), (1, xml), "the same again, over the report that is there");
    let (code, _, err) = project.toile("test --junit long-skirt.astm.dxf");
    assert!(code == 2 && err.contains("error[path-refused]"), "{err}");

    let (_, out, _) = project.toile("test --format json --quiet");
    let found: Value = serde_json::from_str(&out).expect("JSON");
    assert_eq!((&found["passed"], &found["failed"]), (&1.into(), &1.into()));
    let difference = &found["cases"][0]["differences"][0];
    assert_eq!(
        ["what", "expected", "found", "tolerance"].map(|k| difference[k].as_str().expect(k)),
        ["garment.pieces", "3", "2", "0"]
    );
    let mut told = found["cases"][1]["findings"].as_array().expect("findings").iter();
    assert_eq!(told.find(|f| f["severity"] == "error").expect("an error")["code"], "size-not-found");
    let (_, out, _) = project.toile("test --format github --quiet");
    let first = out.lines().next().expect("a line");
    let line = CASES.lines().position(|l| l.starts_with("garment.pieces")).expect("line") + 1;
    let wanted =
        format!("::error file=toile-test.toml,line={line},title=print-38::`garment.pieces` is 2, expected 3 ± 0 (-1)");
    assert_eq!(first, wanted);
}

#[test]
fn all_mistakes_of_a_file_are_told_at_once_with_their_places() {
    let project = project();
    let bad = "toile = 1\n[[case]]\nname = \"Print 38\"\npipeline = \"printed.toml\"\nset = { sise = \"38\" }\nexitt = 1\n\
        [case.figures]\nstrain_max = { value = 0.1 }\nslack = { within = \"2 m m\" }\n\
        [[case]]\nname = \"a\"\npipeline = \"nowhere.toml\"\nexit = 9\nlike = \"../a.glb\"\n\
        tolerance = { shap = \"1 mm\" }\n[[case]]\nname = \"a\"\npipeline = \"printed.toml\"\nhashes = { a = \"12\" }\n";
    project.write("toile-test.toml", bad);
    let (code, out, _) = project.toile("test --format json");
    assert_eq!(code, 2);
    let found: Value = serde_json::from_str(&out).expect("JSON");
    let told = |code: &str, text: &str| {
        let line = bad.lines().position(|l| l.contains(text)).expect(text) as u64 + 1;
        let all = found["findings"].as_array().expect("findings");
        assert!(all.iter().any(|f| f["code"] == code && f["source"]["line"] == line), "{code} at `{text}`: {out}");
        assert!(all.iter().all(|f| f["hint"].is_string()), "each has its remedy: {out}");
    };
    for (code, text) in [
        ("bad-name", "Print 38"),
        ("unknown-set", "sise"),
        ("unknown-key", "exitt"),
        ("missing-key", "strain_max"),
        ("wrong-type", "2 m m"),
        ("file-missing", "nowhere"),
        ("wrong-value", "exit = 9"),
        ("wrong-value", "shap"),
        ("wrong-value", "\"12\""),
    ] {
        told(code, text);
    }
    assert!(out.contains("test-case-twice"), "{out}");
    let (code, out, _) = project.toile("test --format github");
    assert!(code == 2 && out.lines().all(|l| l.starts_with("::error file=toile-test.toml,line=")), "{out}");
    std::fs::create_dir(project.path("empty")).expect("folder");
    let (code, _, err) = project.toile("test empty --only b");
    assert!(code == 2 && err.contains("error[test-empty]"), "{err}");
}

#[test]
fn a_draped_garment_is_held_to_figures_with_units_and_to_a_golden_garment() {
    let project = Project::new();
    // A mesh as coarse as this one does not pass its certificate.
    project.write(
        "toile-test.toml",
        "toile = 1\n[[case]]\nname = \"skirt\"\npipeline = \"draped.toml\"\nexit = 1\nlike = \"golden/skirt.glb\"\n\
         tolerance = { shape = \"1 mm\", darts = \"1 mm\", parameters = \"any\" }\n[case.figures]\n\
         strain_max = { within = 0.01, max = 0.5 }\n\"hip_girth.drape.tape\" = { within = \"2 mm\" }\n",
    );
    let (code, out, _) = project.toile("test --quiet --cache cache");
    assert!(code == 1 && out.contains("there is no golden garment `golden/skirt.glb` yet"), "{out}");
    bless(&project);
    let text = read(&project, "toile-test.toml");
    let girth = text.split("hip_girth.drape.tape\" = { within = \"2 mm\", value = \"").nth(1).expect("girth");
    let girth: f64 = girth.split(" mm").next().and_then(|n| n.parse().ok()).expect("a length");
    assert!((900.0..1200.0).contains(&girth) && project.path("golden/skirt.glb").is_file(), "{text}");
    let (code, out, err) = project.toile("test --quiet --cache cache --out kept");
    assert_eq!(code, 0, "{out}{err}");
    assert!(project.path("kept/skirt/run.json").is_file());
    project.change("toile-test.toml", "pipeline = ", "set = { fabric = \"linen-plain\" }\npipeline = ");
    let (code, out, _) = project.toile("test --quiet --cache cache");
    assert!(code == 1 && out.contains("shape, distance of the surfaces after alignment, largest: "), "{out}");
    assert!(!out.contains("parameters"), "what may differ is not told: {out}");
}

#[test]
fn the_sample_passes() {
    let cases = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/tests");
    let output = Project::new().command("test --quiet").arg(cases).output().expect("program");
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stdout));
}

/// An element of XML.
#[derive(Debug, Default)]
struct Element {
    name: String,
    attributes: Vec<(String, String)>,
    children: Vec<Element>,
    text: String,
}

impl Element {
    fn attribute(&self, name: &str) -> &str {
        self.attributes.iter().find(|(n, _)| n == name).map_or("", |(_, value)| value)
    }
}

/// Reads XML without anything that a report does not have.
fn parse(text: &str) -> Element {
    let text = text.strip_prefix("<?xml version=\"1.0\" encoding=\"UTF-8\"?>").expect("declaration");
    let mut open = vec![Element::default()];
    let mut rest = text.trim();
    while let Some(at) = rest.find('<') {
        open.last_mut().expect("element").text += &plain(&rest[..at]);
        let (tag, after) = rest[at + 1..].split_once('>').expect("an end");
        rest = after;
        if let Some(name) = tag.strip_prefix('/') {
            let done = open.pop().expect("element");
            assert_eq!(done.name, name);
            open.last_mut().expect("parent").children.push(done);
        } else {
            let (name, attributes) = tag.split_once(' ').unwrap_or((tag, ""));
            let attributes = attributes.split_terminator("\" ").filter(|a| !a.is_empty());
            let attributes = attributes.map(|a| a.trim_end_matches('"').split_once("=\"").expect("attribute"));
            let attributes = attributes.map(|(n, v)| (n.to_owned(), plain(v))).collect();
            open.push(Element { name: name.to_owned(), attributes, ..Element::default() });
        }
    }
    open.pop().expect("root").children.pop().expect("suite")
}

fn plain(text: &str) -> String {
    let named = [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&#39;", "'"), ("&amp;", "&")];
    named.iter().fold(text.to_owned(), |text, (from, to)| text.replace(from, to))
}
