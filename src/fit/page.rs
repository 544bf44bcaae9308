//! A fitting as one HTML page: pictures, ease, the new pattern over the old one, changes.

use super::levels::is_reached;
use super::report::word;
use super::{Fitted, Order};
use crate::figure::{figure, one_view};
use std::fmt::Write as _;
use toile_formats::picture::View;
use toile_formats::report::Language;
use toile_formats::svg::canvas::escape;
use toile_formats::svg::flat_sheet;

const STYLE: &str = "\
:root{color-scheme:light}body{font:14px/1.45 'DejaVu Sans',Arial,Helvetica,sans-serif;color:#1b1b1b;background:#fff;max-width:1100px;margin:24px auto;padding:0 20px}\
h1{font-size:22px}h2{font-size:16px;margin:22px 0 4px}h3{font-size:14px;margin:12px 0 2px}table{border-collapse:collapse;font-size:13px}\
th,td{padding:3px 14px 3px 0;border-bottom:1px solid #e6e2d8;text-align:right;font-variant-numeric:tabular-nums}th:first-child,td:first-child{text-align:left}\
.off td{color:#b3402e;font-weight:bold}.pictures{display:grid;grid-template-columns:1fr 1fr 1fr;gap:14px}figure{margin:0}\
figcaption{font-size:12px;color:#555}img,svg{width:100%;height:auto}@media print{body{margin:0;max-width:none}}";

/// Width and height of a picture, pixels.
const SIZE: [u32; 2] = [420, 600];

/// The page.
#[must_use]
pub fn html(fitted: &Fitted, order: &Order, language: Language) -> String {
    let title = format!("Fitted to {}", escape(&order.body.file_name()));
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>{title}</title>\n\
         <style>{STYLE}</style>\n</head>\n<body data-toile-fit=\"1\">\n<h1>{title}</h1>\n"
    );
    // Writing to a String cannot fail.
    verdict(&mut out, fitted, order);
    pictures(&mut out, fitted);
    ease(&mut out, fitted, order);
    if let Some(sheet) = flat_sheet(&fitted.flat, language) {
        let note = "Green: the new pattern. Dashed: the pattern before. Colours: strain of the new pattern on the moved garment.";
        let _ = writeln!(out, "<h2>Pattern</h2>\n<figure>{sheet}<figcaption>{note}</figcaption></figure>");
    }
    changes(&mut out, fitted);
    language.page(&(out + "</body>\n</html>\n"))
}

fn verdict(out: &mut String, fitted: &Fitted, order: &Order) {
    let within = 1e3 * order.within;
    let off = 1e3 * fitted.levels.iter().map(|l| (l.asked - l.ease).abs()).fold(0.0, f64::max);
    let ease = if fitted.levels.iter().all(|l| is_reached(l, order)) {
        format!("The ease is within {off:.1} mm of what was asked for; {within:.1} mm are allowed.")
    } else {
        format!("The ease is not as asked: {off:.1} mm off; {within:.1} mm are allowed.")
    };
    let drape = if fitted.passed { "The drape of the new pattern passed." } else { "See the findings of the run." };
    // Writing to a String cannot fail.
    let _ = writeln!(out, "<p>{ease}</p>\n<p>{drape}</p>\n<p>Rounds: {}</p>", fitted.rounds.len());
}

fn pictures(out: &mut String, fitted: &Fitted) {
    out.push_str("<div class=\"pictures\">\n");
    for view in [View::Front, View::Left, View::Back] {
        let name = view.name();
        out.extend(figure(&fitted.worn, &one_view(view, SIZE), (&format!("the garment, {name}"), name)));
    }
    out.push_str("</div>\n");
}

fn ease(out: &mut String, fitted: &Fitted, order: &Order) {
    out.push_str(
        "<h2>Ease</h2>\n<table><tr><th>mm</th><th>own body</th><th>own ease</th><th>body</th><th>asked</th>\
         <th>reached</th></tr>\n",
    );
    for l in &fitted.levels {
        let class = if is_reached(l, order) { "" } else { " class=\"off\"" };
        let _ = write!(out, "<tr{class}><td>{}</td>", escape(&word(l)));
        for length in [l.own_body, l.own_ease, l.body, l.asked, l.ease] {
            let _ = write!(out, "<td>{:.1}</td>", 1e3 * length);
        }
        out.push_str("</tr>\n");
    }
    out.push_str("</table>\n<h2>Hem above the floor</h2>\n<table>");
    for hem in &fitted.hems {
        let _ = writeln!(out, "<tr><td>{}</td><td>{}</td></tr>", hem.side, hem.words());
    }
    out.push_str("</table>\n");
}

fn changes(out: &mut String, fitted: &Fitted) {
    out.push_str("<h2>Changes of the pattern</h2>\n");
    if fitted.changes.is_empty() {
        out.push_str("<p>Nothing changes.</p>\n");
    }
    for piece in fitted.changes.chunk_by(|a, b| a.piece == b.piece) {
        let _ = writeln!(out, "<h3>{}</h3>\n<table>", escape(&piece[0].piece));
        for change in piece {
            let _ = writeln!(out, "<tr><td>{}</td><td>{}</td></tr>", escape(&change.what), escape(&change.words()));
        }
        out.push_str("</table>\n");
    }
}
