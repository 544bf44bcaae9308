//! The study as one HTML page: no outside resource, no script, readable on paper.

use super::chart;
use super::report::Study;
use super::table::{HEADS, cells, words};
use crate::render;
use std::fmt::Write as _;
use toile_formats::report::Language;
use toile_formats::svg::canvas::escape;

const STYLE: &str = "\
:root{color-scheme:light}body{font:14px/1.45 'DejaVu Sans',Arial,Helvetica,sans-serif;color:#1b1b1b;background:#fff;max-width:1180px;margin:24px auto;padding:0 20px}\
h1{font-size:24px;margin:0 0 4px}h2{font-size:16px}p{margin:6px 0;max-width:90ch}svg{width:100%;height:auto;border:1px solid #e6e2d8}\
.scroll{overflow-x:auto}table{border-collapse:collapse;font-size:12.5px;margin:12px 0}\
th,td{padding:3px 9px;border-bottom:1px solid #e6e2d8;text-align:right;white-space:nowrap;font-variant-numeric:tabular-nums}\
th{background:#f5f1e7}th:first-child,td:first-child,th:last-child,td:last-child{text-align:left}td:last-child{white-space:normal}\
tr.front td:first-child{font-weight:bold}tr.chosen{background:#fbeeea}.sub{color:#555}\
.pictures{display:grid;grid-template-columns:repeat(5,1fr);gap:14px}figure{margin:0}figcaption{font-size:12px;color:#555}img{width:100%;height:auto}@media print{body{margin:0;max-width:none}tr{break-inside:avoid}}";

/// The page. `pictures` are figures of drapes, HTML.
#[must_use]
pub fn html(study: &Study, pictures: &[String], language: Language) -> String {
    let title = escape(&study.pipeline);
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>{title}: what accuracy costs</title>\n\
         <style>{STYLE}</style>\n</head>\n<body>\n<h1>{title}: what accuracy costs</h1>\n\
         <p class=\"sub\">toile {}, {} threads. Lengths in millimetres.</p>\n",
        escape(&study.toile),
        study.threads
    );
    out.push_str(&chart::svg(study, language));
    for sentence in words(study) {
        // Writing to a String cannot fail.
        let _ = writeln!(out, "<p>{}</p>", render::html(&sentence));
    }
    if !pictures.is_empty() {
        let _ = writeln!(
            out,
            "<h2>Distance from the finest drape</h2>\n<div class=\"pictures\">{}</div>",
            pictures.concat()
        );
    }
    table(&mut out, study);
    out.push_str("</body>\n</html>\n");
    language.page(&out)
}

fn table(out: &mut String, study: &Study) {
    out.push_str("<div class=\"scroll\"><table>\n<tr>");
    for head in HEADS {
        let _ = write!(out, "<th>{}</th>", escape(head));
    }
    out.push_str("</tr>\n");
    for (number, row) in study.rows.iter().enumerate() {
        let chosen = if study.recommended == Some(number) { " chosen" } else { "" };
        let front = if row.on_front { "front" } else { "" };
        let _ = write!(out, "<tr class=\"{front}{chosen}\">");
        for cell in cells(study, number) {
            let _ = write!(out, "<td>{}</td>", escape(&cell));
        }
        out.push_str("</tr>\n");
    }
    out.push_str("</table></div>\n");
}
