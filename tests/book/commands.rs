//! The commands of the first chapter are run as they stand there, and end as the chapter says.

use crate::root;
use std::path::Path;
use std::process::Command;

/// The first chapter is text for a person: its blocks of `console` hold a command a line, each after `$ `.
#[test]
fn the_commands_of_the_first_chapter_run() {
    let chapter = std::fs::read_to_string(root().join("docs/book/src/first-garment.md")).expect("chapter");
    let folder = tempfile::tempdir().expect("folder");
    for name in ["pipelines", "samples"] {
        copy(&root().join(name), &folder.path().join(name));
    }
    std::fs::write(folder.path().join("toile.root"), "").expect("root");
    let commands = commands(&chapter);
    assert!(commands.len() >= 5, "the chapter shows {} commands", commands.len());
    for (command, expected) in &commands {
        let words = words(command);
        let (first, arguments) = words.split_first().expect("a command");
        assert_eq!(first, "toile", "`{command}` is no command of this program");
        let program = env!("CARGO_BIN_EXE_toile");
        let output = Command::new(program).args(arguments).current_dir(folder.path()).output().expect("program");
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(*expected), "`{command}`: {said}");
    }
    for file in files(&chapter) {
        assert!(folder.path().join(&file).is_file(), "the chapter names `{file}`, which no command wrote");
    }
}

/// Commands with their exit codes; a comment `# exit code N` behind a command says one that is not 0.
fn commands(chapter: &str) -> Vec<(String, i32)> {
    let mut fenced = false;
    let mut found = Vec::new();
    for line in chapter.lines() {
        if line.starts_with("```") {
            fenced = line == "```console";
        } else if let Some(command) = line.strip_prefix("$ ").filter(|_| fenced) {
            let (command, comment) = command.split_once('#').unwrap_or((command, ""));
            let code = comment.trim().strip_prefix("exit code ").and_then(|n| n.trim().parse().ok()).unwrap_or(0);
            found.push((command.trim().to_owned(), code));
        }
    }
    found
}

/// The words of a command; blanks between quotes belong to a word.
fn words(command: &str) -> Vec<String> {
    let outside_and_inside = command.split('"').enumerate();
    let words = outside_and_inside.flat_map(|(i, part)| match i % 2 {
        0 => part.split_whitespace().map(str::to_owned).collect(),
        _ => vec![part.to_owned()],
    });
    words.collect()
}

/// Files below `out/` that the chapter names.
fn files(chapter: &str) -> Vec<String> {
    let quoted = chapter.split('`').filter(|text| text.starts_with("out/") && !text.contains([' ', '\n']));
    quoted.filter(|text| text.rsplit('/').next().is_some_and(|name| name.contains('.'))).map(str::to_owned).collect()
}

fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).expect("folder");
    for entry in std::fs::read_dir(from).expect("folder") {
        let path = entry.expect("entry").path();
        let target = to.join(path.file_name().expect("name"));
        if path.is_dir() {
            copy(&path, &target);
        } else {
            std::fs::copy(&path, &target).expect("file");
        }
    }
}
