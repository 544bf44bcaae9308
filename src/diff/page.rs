//! The differences as one HTML page, with pictures side by side.

use super::change::Change;
use super::side::Side;
use super::tolerance::Tolerance;
use crate::figure::{figure, one_view};
use std::fmt::Write as _;
use toile_formats::picture::View;
use toile_formats::svg::canvas::escape;

const STYLE: &str = "\
:root{color-scheme:light}body{font:14px/1.45 'DejaVu Sans',Arial,Helvetica,sans-serif;color:#1b1b1b;background:#fff;max-width:1100px;margin:24px auto;padding:0 20px}\
h1{font-size:22px}h2{font-size:16px;margin:22px 0 4px}table{border-collapse:collapse;font-size:13px}\
td{padding:3px 12px 3px 0;border-bottom:1px solid #e6e2d8;vertical-align:top}.over td{color:#b3402e;font-weight:bold}\
.pictures{display:grid;grid-template-columns:1fr 1fr;gap:14px}figure{margin:0}figcaption{font-size:12px;color:#555}img{width:100%}";

/// Width and height of a picture, pixels.
const SIZE: [u32; 2] = [480, 640];

/// The page.
#[must_use]
pub fn html(a: &Side, b: &Side, changes: &[Change], tolerance: &Tolerance) -> String {
    let title = format!("{} against {}", escape(&b.name), escape(&a.name));
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{title}</title>\n\
         <style>{STYLE}</style>\n</head>\n<body data-toile-diff=\"1\">\n<h1>{title}</h1>\n<div class=\"pictures\">\n"
    );
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
    for group in changes.chunk_by(|x, y| x.group == y.group) {
        // Writing to a String cannot fail.
        let _ = writeln!(out, "<h2>{}</h2>\n<table>", group[0].group.word());
        for change in group {
            let over = if tolerance.is_over(change) { " class=\"over\"" } else { "" };
            let _ =
                writeln!(out, "<tr{over}><td>{}</td><td>{}</td></tr>", escape(&change.what), escape(&change.words()));
        }
        out.push_str("</table>\n");
    }
    out + "</body>\n</html>\n"
}
