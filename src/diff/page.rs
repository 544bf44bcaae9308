//! The differences as one HTML page, with pictures side by side.

use super::change::{Change, Line};
use super::lines::{JobDiff, LineSide, shown, told};
use super::side::Side;
use super::tolerance::Tolerance;
use crate::figure::{figure, one_view, png_figure};
use std::fmt::Write as _;
use toile_formats::picture::View;
use toile_formats::report::Language;
use toile_formats::svg::canvas::escape;

const STYLE: &str = "\
:root{color-scheme:light}body{font:14px/1.45 'DejaVu Sans',Arial,Helvetica,sans-serif;color:#1b1b1b;background:#fff;max-width:1100px;margin:24px auto;padding:0 20px}\
h1{font-size:22px}h2{font-size:16px;margin:22px 0 4px}table{border-collapse:collapse;font-size:13px}\
td{padding:3px 12px 3px 0;border-bottom:1px solid #e6e2d8;vertical-align:top}.over td{color:#b3402e;font-weight:bold}\
.pictures{display:grid;grid-template-columns:1fr 1fr;gap:14px}figure{margin:0}figcaption{font-size:12px;color:#555}img{width:100%}";

/// Width and height of a picture, pixels.
const SIZE: [u32; 2] = [480, 640];

/// The head of a page, up to its title.
fn head(a: &str, b: &str) -> String {
    let title = format!("{} against {}", escape(b), escape(a));
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{title}</title>\n\
         <style>{STYLE}</style>\n</head>\n<body data-toile-diff=\"1\">\n<h1>{title}</h1>\n"
    )
}

/// The page of two results.
#[must_use]
pub fn html([a, b]: [&Side; 2], changes: &[Change], tolerance: &Tolerance, language: Language) -> String {
    let mut out = head(&a.name, &b.name) + "<div class=\"pictures\">\n";
    for view in [View::Front, View::Back] {
        for side in [a, b] {
            let caption = format!("{}, {}", escape(&side.name), view.name());
            out.extend(side.garment.as_ref().and_then(|g| figure(g, &one_view(view, SIZE), ("", &caption))));
        }
    }
    out.push_str("</div>\n");
    if changes.is_empty() {
        out.push_str("<p>Nothing differs.</p>\n");
    }
    let line =
        |c: &Change| Line { group: c.group, what: c.what.clone(), words: c.words(), is_over: tolerance.is_over(c) };
    tables(&mut out, &changes.iter().map(line).collect::<Vec<_>>());
    language.page(&(out + "</body>\n</html>\n"))
}

/// A table for each group of lines.
fn tables(out: &mut String, lines: &[Line]) {
    for group in lines.chunk_by(|x, y| x.group == y.group) {
        // Writing to a String cannot fail.
        let _ = writeln!(out, "<h2>{}</h2>\n<table>", group[0].group.word());
        for line in group {
            let over = if line.is_over { " class=\"over\"" } else { "" };
            let _ = writeln!(out, "<tr{over}><td>{}</td><td>{}</td></tr>", escape(&line.what), escape(&line.words));
        }
        out.push_str("</table>\n");
    }
}

/// The page of two versions of a line: what differs over all jobs, then the jobs with their pictures side by side.
#[must_use]
pub fn lines_html(sides: [&LineSide; 2], jobs: &[JobDiff], tolerance: &Tolerance, language: Language) -> String {
    let [a, b] = sides.map(LineSide::name);
    let mut out = head(&a, &b);
    let shown = shown(sides, jobs, tolerance);
    let over = shown.iter().filter(|j| j.is_over).count();
    // Writing to a String cannot fail.
    let _ = writeln!(out, "<p>{} jobs: {} differ, {over} over the tolerance.</p>", jobs.len(), shown.len());
    tables(&mut out, &told(jobs, tolerance));
    for job in shown {
        let over = if job.is_over { " class=\"over\"" } else { "" };
        let _ = writeln!(
            out,
            "<h2>{}</h2>\n<table><tr{over}><td>{}</td></tr></table>\n<div class=\"pictures\">",
            escape(&job.job),
            escape(&job.words)
        );
        for (name, png) in [&a, &b].into_iter().zip(job.pictures) {
            out.extend(png.map(|png| png_figure(&png, ("", &escape(name)))));
        }
        out.push_str("</div>\n");
    }
    language.page(&(out + "</body>\n</html>\n"))
}
