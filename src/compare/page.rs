//! A comparison as one HTML page with a picture of every method: no outside resource, no script.

use super::rows::{Comparison, Row, Shown};
use super::table::{HEADS, cells, title, words};
use crate::figure::{figure, one_view};
use crate::render;
use crate::study::pictures::coloured;
use std::fmt::Write as _;
use toile_formats::picture::View;
use toile_formats::report::Language;
use toile_formats::svg::canvas::escape;

const STYLE: &str = "\
:root{color-scheme:light}body{font:14px/1.45 'DejaVu Sans',Arial,Helvetica,sans-serif;color:#1b1b1b;background:#fff;max-width:1180px;margin:24px auto;padding:0 20px}\
h1{font-size:22px;margin:0 0 4px}h2{font-size:16px}p{margin:6px 0;max-width:90ch}.sub{color:#555}.scroll{overflow-x:auto}\
table{border-collapse:collapse;font-size:12.5px;margin:12px 0}th,td{padding:3px 9px;border-bottom:1px solid #e6e2d8;text-align:right;font-variant-numeric:tabular-nums}\
th{background:#f5f1e7}th:first-child,td:first-child{text-align:left}\
.pictures{display:grid;grid-template-columns:repeat(4,1fr);gap:14px}figure{margin:0}figcaption{font-size:12px;color:#555}img{width:100%;height:auto}\
@media print{body{margin:0;max-width:none}tr,figure{break-inside:avoid}}";

/// Width and height of a picture, pixels.
const SIZE: [u32; 2] = [360, 540];

/// The page.
#[must_use]
pub fn html(comparison: &Comparison, shown: &[Shown], language: Language) -> String {
    let title = escape(&title(comparison));
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>{title}</title>\n\
         <style>{STYLE}</style>\n</head>\n<body data-toile-compare=\"1\">\n<h1>{title}</h1>\n\
         <p class=\"sub\">toile {}, {} threads</p>\n",
        escape(&comparison.toile),
        comparison.threads
    );
    let worn = shown.iter().filter_map(|s| {
        let row = &s.row;
        figure(s.garment.as_ref()?, &one_view(View::Front, SIZE), (&row.name, &caption(row)))
    });
    let _ = writeln!(out, "<div class=\"pictures\">\n{}</div>", worn.collect::<String>());
    table(&mut out, comparison);
    for sentence in words(comparison) {
        // Writing to a String cannot fail.
        let _ = writeln!(out, "<p>{}</p>", render::html(&sentence));
    }
    let apart = shown.iter().filter_map(|s| Some((s.garment.as_ref()?, s.distances.clone()?, escape(&s.row.name))));
    let apart = coloured(&apart.collect::<Vec<_>>()).concat();
    let _ = writeln!(out, "<h2>Distance from the reference</h2>\n<div class=\"pictures\">\n{apart}</div>");
    language.page(&(out + "</body>\n</html>\n"))
}

fn caption(row: &Row) -> String {
    let seconds = row.sewing_cpu_seconds + row.drape_cpu_seconds;
    format!("<b>{}</b>, {}, {seconds:.1} CPU s", escape(&row.name), escape(&row.source))
}

fn table(out: &mut String, comparison: &Comparison) {
    out.push_str("<div class=\"scroll\"><table>\n<tr>");
    for head in HEADS {
        let _ = write!(out, "<th>{}</th>", escape(head));
    }
    out.push_str("</tr>\n");
    for row in &comparison.rows {
        out.push_str("<tr>");
        for cell in cells(row) {
            let _ = write!(out, "<td>{}</td>", escape(&cell));
        }
        out.push_str("</tr>\n");
    }
    out.push_str("</table></div>\n");
}
