//! The chapters about energies and contact: each includes a page of `stages/cloth/docs/`.

use crate::{current, root};

/// Every page of the solver has a chapter that includes it and a line in the summary. Both are written with the other
/// generated files; a new line goes below the others and may be moved.
#[test]
fn every_page_of_the_solver_is_a_chapter() {
    chapters();
}

/// Compares the chapters with the pages, or writes them.
pub fn chapters() {
    let book = root().join("docs/book/src");
    let mut pages: Vec<_> = std::fs::read_dir(root().join("stages/cloth/docs")).expect("folder").flatten().collect();
    pages.sort_by_key(std::fs::DirEntry::file_name);
    let mut summary = std::fs::read_to_string(book.join("SUMMARY.md")).expect("summary");
    for page in pages {
        let name = page.file_name().to_string_lossy().into_owned();
        let include = format!("{{{{#include ../../../../stages/cloth/docs/{name}}}}}\n");
        current(&book.join("energies").join(&name), &include);
        if !summary.contains(&format!("(energies/{name})")) {
            let text = std::fs::read_to_string(page.path()).expect("page");
            let title = text.lines().next().expect("a title").trim_start_matches("# ");
            let last = summary.rfind("(energies/").expect("chapters about energies");
            let end = summary[last..].find('\n').map_or(summary.len(), |n| last + n + 1);
            summary.insert_str(end, &format!("- [{title}](energies/{name})\n"));
        }
    }
    current(&book.join("SUMMARY.md"), &summary);
}
