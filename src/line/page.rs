//! The page of a line: a contact sheet with filters, tables of two axes and a chart, as one static file.

use super::results::{Results, Row};
use crate::junit::{Case, End};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use toile_formats::report::Language;
use toile_formats::svg::canvas::escape;

const STYLE: &str = include_str!("page/style.css");
const SCRIPT: &str = include_str!("page/script.js");

/// Words of the script.
const SCRIPT_WORDS: [&str; 13] = [
    "verdict",
    "all",
    "passed",
    "failed",
    "figure",
    "rows",
    "columns",
    "Tables",
    "{0} of {1} jobs",
    "style",
    "size",
    "fabric",
    "body",
];

/// The page. Pictures and reports are linked, so it stays small.
#[must_use]
pub fn html(results: &Results, language: Language) -> String {
    let title = escape(&results.line);
    let counts = results.counts();
    let counts: Vec<String> = counts.iter().map(|(status, count)| format!("{count} {}", escape(status))).collect();
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>{title}</title>\n\
         <style>{STYLE}</style>\n</head>\n<body data-toile-line=\"1\">\n<h1>{title}</h1>\n\
         <p class=\"sub\">{} jobs: {}. {:.1} CPU s in all. <a href=\"line.csv\">CSV</a> <a href=\"line.xml\">JUnit</a>\n\
         <a href=\"line.json\">JSON</a></p>\n<form id=\"filters\"></form>\n<p id=\"count\" class=\"sub\"></p>\n\
         <section id=\"sheet\">\n",
        results.jobs.len(),
        counts.join(", "),
        results.jobs.iter().map(|j| j.cpu_seconds).sum::<f64>(),
    );
    for row in in_order(results) {
        card(&mut out, row);
    }
    let data = serde_json::to_string(&data(results)).unwrap_or_default();
    let data = toile_garment::text::json(&data).replace('<', "\\u003c");
    // Writing to a String cannot fail.
    let _ = write!(
        out,
        "</section>\n<section id=\"tables\"></section>\n\
         <script type=\"application/json\" id=\"data\">{data}</script>\n<script>const WORDS = {};</script>\n<script>{SCRIPT}</script>\n</body>\n</html>\n",
        language.script_words(&SCRIPT_WORDS)
    );
    language.page(&out)
}

/// Jobs that failed come first; the worst of them before the rest.
fn in_order(results: &Results) -> Vec<&Row> {
    let mut rows: Vec<&Row> = results.jobs.iter().collect();
    rows.sort_by_key(|r| std::cmp::Reverse(r.exit_code));
    rows
}

fn card(out: &mut String, row: &Row) {
    let job = escape(&row.job);
    let choices: Vec<String> = row.choices.iter().map(|(a, c)| format!("{} {}", escape(a), escape(c))).collect();
    let folder = |name: &str| format!("jobs/{job}/{}", escape(name));
    let page = row.shown.iter().find(|p| p.ends_with(".html")).map_or_else(|| folder("run.json"), |p| folder(p));
    let state = if row.has_passed() { "passed" } else { "failed" };
    // Writing to a String cannot fail.
    let _ = write!(
        out,
        "<article class=\"{state}\" data-job=\"{job}\"><a href=\"{page}\">{}<h2 translate=\"no\">{job}</h2></a>\n<p class=\"verdict\">{}</p>",
        picture(row, &folder),
        escape(if row.has_passed() { "passed" } else { &row.status })
    );
    for why in row.why.iter().take(3) {
        let _ = write!(out, "<p class=\"why\">{}</p>", escape(why));
    }
    let _ = write!(out, "<p class=\"sub\">{}</p><table>", choices.join(", "));
    for (name, value) in key_figures(row) {
        let _ = write!(out, "<tr><td>{}</td><td>{}</td></tr>", escape(name), shown(name, value));
    }
    let _ = writeln!(
        out,
        "</table><p class=\"sub\">{:.1} CPU s, {:.0} MB, {} triangles, {} stages from the cache</p></article>",
        row.cpu_seconds, row.peak_mb, row.triangles, row.cached
    );
}

fn picture(row: &Row, folder: &dyn Fn(&str) -> String) -> String {
    let own = row.shown.iter().find(|p| p.ends_with(".png")).map(|p| folder(p));
    let source = own.or_else(|| row.pictured.then(|| format!("pictures/{}.png", escape(&row.job))));
    source.map_or_else(
        || "<div class=\"none\"></div>".to_owned(),
        |s| format!("<img loading=\"lazy\" alt=\"\" src=\"{s}\">"),
    )
}

/// The figures that a card has room for: girths by the tape, and the strain.
fn key_figures(row: &Row) -> impl Iterator<Item = (&String, f64)> {
    let is_key = |name: &str| name.ends_with(".drape.tape") || name == "strain_max";
    row.figures.iter().filter(move |(name, _)| is_key(name)).map(|(name, value)| (name, *value)).take(5)
}

fn shown(name: &str, value: f64) -> String {
    if name.starts_with("strain") {
        format!("{:.1} %", 1e2 * value)
    } else if name.contains('.') {
        format!("{value:.0} mm")
    } else {
        format!("{value:.3}")
    }
}

/// The data of the filters, tables and charts.
fn data(results: &Results) -> serde_json::Value {
    let mut axes: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for row in &results.jobs {
        axes.entry("style").or_default().insert(&row.style);
        for (axis, choice) in &row.choices {
            axes.entry(axis).or_default().insert(choice);
        }
    }
    let row = |r: &Row| {
        let mut choices: BTreeMap<&str, &str> = r.choices.iter().map(|(a, c)| (a.as_str(), c.as_str())).collect();
        choices.insert("style", &r.style);
        serde_json::json!({ "job": r.job, "at": choices, "passed": r.has_passed(), "status": r.status, "figures": r.figures })
    };
    let figures: BTreeSet<&String> = results.jobs.iter().flat_map(|j| j.figures.keys()).collect();
    serde_json::json!({ "axes": axes, "figures": figures, "jobs": results.jobs.iter().map(row).collect::<Vec<_>>() })
}

/// The figures as comma-separated values: one row for each job.
#[must_use]
pub fn csv(results: &Results) -> String {
    let axes: BTreeSet<&String> = results.jobs.iter().flat_map(|j| j.choices.keys()).collect();
    let figures: BTreeSet<&String> = results.jobs.iter().flat_map(|j| j.figures.keys()).collect();
    let cell = toile_garment::text::csv_cell;
    let mut head: Vec<String> = ["job", "style"].map(cell).to_vec();
    head.extend(axes.iter().map(|a| cell(a)));
    head.extend(["status", "exit_code", "cpu_seconds", "peak_mb", "triangles"].map(cell));
    head.extend(figures.iter().map(|f| cell(f)));
    let mut out = head.join(",") + "\n";
    for row in &results.jobs {
        let mut cells = vec![cell(&row.job), cell(&row.style)];
        cells.extend(axes.iter().map(|a| cell(row.choices.get(*a).map_or("", String::as_str))));
        cells.push(cell(&row.status));
        cells.extend([f64::from(row.exit_code), row.cpu_seconds, row.peak_mb].map(|x| x.to_string()));
        cells.push(row.triangles.to_string());
        cells.extend(figures.iter().map(|f| row.figures.get(*f).map_or_else(String::new, f64::to_string)));
        out.push_str(&(cells.join(",") + "\n"));
    }
    out
}

/// The verdicts in the form of JUnit.
#[must_use]
pub fn junit(results: &Results) -> String {
    let end = |r: &Row| match r.exit_code {
        0 => End::Passed,
        1..=4 => End::Failed(r.status.clone(), r.why.join("\n")),
        _ => End::Broken(r.status.clone(), r.why.join("\n")),
    };
    let case = |r: &Row| Case { class: r.style.clone(), name: r.job.clone(), seconds: Some(r.seconds), end: end(r) };
    crate::junit::xml(&results.line, &results.jobs.iter().map(case).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn results() -> Results {
        let row = |job: &str, size: &str, code: u8, girth: f64| Row {
            job: job.to_owned(),
            style: "skirt".to_owned(),
            choices: [("size".to_owned(), size.to_owned())].into(),
            status: if code == 0 { "good" } else { "gate-failed" }.to_owned(),
            exit_code: code,
            why: if code == 0 { Vec::new() } else { vec!["`a` < 1 & \"b\"".to_owned()] },
            figures: [("hip_girth.drape.tape".to_owned(), girth)].into(),
            ..Row::default()
        };
        let jobs = vec![row("skirt_36", "36", 0, 1010.5), row("skirt_38", "38", 1, 1030.0)];
        Results { toile_line: 1, line: "skirts".to_owned(), jobs }
    }

    #[test]
    fn what_failed_comes_first_and_names_are_escaped() {
        let page = html(&results(), Language::English);
        let at = |text: &str| page.find(text).expect(text);
        assert!(at("data-job=\"skirt_38\"") < at("data-job=\"skirt_36\""));
        assert!(page.contains("`a` &lt; 1 &amp; &quot;b&quot;"));
        assert!(page.contains("<td>hip_girth.drape.tape</td><td>1030 mm</td>"));
        assert!(!page.contains("src=\"http") && !page.contains("href=\"http"), "no outside resource");
    }

    #[test]
    fn the_page_speaks_chinese() {
        let page = html(&results(), Language::Chinese);
        for words in ["2 个任务", "\"verdict\":\"结论\"", "<p class=\"verdict\">合格</p>", "检验未通过"] {
            assert!(page.contains(words), "{words}: {page}");
        }
    }

    #[test]
    fn tables_for_programs_hold_every_job() {
        let csv = csv(&results());
        let lines: Vec<&str> = csv.lines().collect();
        assert_eq!(lines.len(), 3);
        assert!(lines[0].ends_with("\"triangles\",\"hip_girth.drape.tape\""), "{}", lines[0]);
        assert!(
            lines[2].starts_with("\"skirt_38\",\"skirt\",\"38\",\"gate-failed\",1,") && lines[2].ends_with(",1030")
        );
        let xml = junit(&results());
        assert!(xml.contains("tests=\"2\" failures=\"1\" errors=\"0\""));
        assert!(xml.contains("<failure message=\"gate-failed\">`a` &lt; 1 &amp; &quot;b&quot;</failure>"));
    }
}
