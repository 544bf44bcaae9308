//! The report as one HTML page: no outside resource, no script, readable on paper.

use super::tables::{Cell, Table, metric_words, tables};
use crate::svg;
use crate::svg::canvas::{escape, fixed};
use std::fmt::Write as _;
use toile_garment::flat::FlatMetric;
use toile_garment::{Diagnostic, Garment, Severity};

const STYLE: &str = "\
:root{color-scheme:light}body{font:14px/1.45 'DejaVu Sans',Arial,Helvetica,sans-serif;color:#1b1b1b;background:#fff;max-width:1180px;margin:24px auto;padding:0 20px}\
h1{font-size:24px;margin:0 0 4px}h2{font-size:17px;margin:28px 0 6px;border-bottom:2px solid #d8d2c4;padding-bottom:3px}\
p{margin:6px 0;max-width:80ch}.sub{color:#555}.note{color:#555;font-size:13px}\
.scroll{overflow-x:auto}table{border-collapse:collapse;font-size:12.5px;margin:6px 0}\
th,td{padding:3px 9px;border-bottom:1px solid #e6e2d8;text-align:left;vertical-align:top}th{background:#f5f1e7;white-space:nowrap}\
td.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}td.code{font-family:'DejaVu Sans Mono',monospace;font-size:11px;overflow-wrap:anywhere}\
.good{color:#0b6b3a;font-weight:bold}.bad{color:#b3261e;font-weight:bold}.warning{color:#8a5300;font-weight:bold}.error{color:#b3261e;font-weight:bold}\
.tile{display:inline-block;border:1px solid #d8d2c4;border-radius:6px;padding:6px 14px;margin:6px 8px 6px 0}.tile b{display:block;font-size:18px}\
.drawings{display:flex;flex-wrap:wrap;gap:18px}figure{margin:6px 0;flex:1 1 420px;max-width:100%}figcaption{font-size:13px;color:#333}\
svg{width:100%;height:auto;max-height:640px;border:1px solid #e6e2d8;background:#fff}@media print{body{margin:0;max-width:none}h2{break-after:avoid}tr,figure{break-inside:avoid}}";

/// The report for people.
#[must_use]
pub fn html(garment: &Garment, findings: &[Diagnostic]) -> String {
    let title = if garment.style.is_empty() { "garment" } else { &garment.style };
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>{0}</title>\n\
         <style>{STYLE}</style>\n</head>\n<body>\n<h1>{0}</h1>\n",
        escape(title)
    );
    let size = garment.size.as_ref().map_or_else(String::new, |s| format!("size {}, ", escape(s)));
    let pieces =
        if garment.pieces.len() == 1 { "1 piece".to_owned() } else { format!("{} pieces", garment.pieces.len()) };
    let _ = writeln!(out, "<p class=\"sub\">{size}{pieces}. Lengths in millimetres.</p>");
    tiles(&mut out, garment, findings);
    if let Some(flat) = &garment.flat {
        let _ = writeln!(out, "<p>{}</p>", metric_words(flat.metric));
    }
    let all = tables(garment, findings);
    let (first, rest): (Vec<_>, Vec<_>) = all.iter().partition(|t| t.key == "findings");
    first.iter().for_each(|t| table(&mut out, t));
    drawings(&mut out, garment);
    rest.iter().for_each(|t| table(&mut out, t));
    out.push_str("</body>\n</html>\n");
    out
}

fn tiles(out: &mut String, garment: &Garment, findings: &[Diagnostic]) {
    let mut tile = |value: String, words: &str, class: &str| {
        let _ = writeln!(out, "<span class=\"tile\"><b class=\"{class}\">{value}</b>{words}</span>");
    };
    if let Some(c) = &garment.certificate {
        let (word, class) = if c.passed { ("passed", "good") } else { ("failed", "bad") };
        tile(word.to_owned(), "certificate of the drape", class);
    }
    if let Some(flat) = &garment.flat {
        let edges = flat.pieces.iter().flat_map(|p| &p.edges).map(|e| (e.flat - e.original).abs());
        tile(format!("{} mm", fixed(1e3 * edges.fold(0.0, f64::max), 3)), "largest change of an edge", "");
        let darts = flat.pieces.iter().flat_map(|p| &p.darts).map(|d| (d.angle[1] - d.angle[0]).abs().to_degrees());
        tile(format!("{}°", fixed(darts.fold(0.0, f64::max), 3)), "largest change of a dart", "");
        let pairs = flat.pairs.iter().map(|p| ((p.a[1] - p.b[1]) - (p.a[0] - p.b[0])).abs());
        tile(format!("{} mm", fixed(1e3 * pairs.fold(0.0, f64::max), 3)), "largest change of ease", "");
    }
    let serious = findings.iter().filter(|f| f.severity > Severity::Info).count();
    tile(serious.to_string(), "warnings and errors", if serious == 0 { "good" } else { "warning" });
}

fn drawings(out: &mut String, garment: &Garment) {
    out.push_str("<h2>Drawings</h2>\n<div class=\"drawings\">\n");
    let mut figure = |drawing: &str, words: &str| {
        let _ = writeln!(out, "<figure>{drawing}<figcaption>{words}</figcaption></figure>");
    };
    if let Some(flat) = &garment.flat {
        for piece in &flat.pieces {
            let name = garment.pieces.get(piece.piece.index()).map_or_else(String::new, |p| escape(&p.name));
            if let Some(drawing) = svg::flat_piece(garment, piece, &piece.flat_strain) {
                figure(
                    &drawing,
                    &format!("<b>{name}</b>: flattened over the original; strain of the flat cut when worn"),
                );
            }
            if flat.metric == FlatMetric::Carried
                && let Some(drawing) = svg::flat_piece(garment, piece, &piece.drape_strain)
            {
                figure(&drawing, &format!("<b>{name}</b>: strain from the original piece to the edited shape"));
            }
        }
    } else {
        figure(&svg::pattern(&garment.pieces, &garment.style), "the pattern");
    }
    out.push_str("</div>\n");
}

fn table(out: &mut String, table: &Table) {
    let _ = writeln!(out, "<h2>{}</h2>", escape(table.title));
    if !table.note.is_empty() {
        let _ = writeln!(out, "<p class=\"note\">{}</p>", escape(&table.note));
    }
    out.push_str("<div class=\"scroll\"><table>\n<tr>");
    for (_, heading) in &table.columns {
        let _ = write!(out, "<th>{}</th>", escape(heading));
    }
    out.push_str("</tr>\n");
    for row in &table.rows {
        out.push_str("<tr>");
        for ((key, _), cell) in table.columns.iter().zip(row) {
            out.push_str(&html_cell(key, cell));
        }
        out.push_str("</tr>\n");
    }
    out.push_str("</table></div>\n");
}

fn html_cell(key: &str, cell: &Cell) -> String {
    match cell {
        Cell::Text(t) if matches!(key, "params" | "blake3" | "code") => {
            format!("<td class=\"code\">{}</td>", escape(t))
        }
        Cell::Text(t) if key == "severity" => format!("<td class=\"{0}\">{0}</td>", escape(t)),
        Cell::Text(t) => format!("<td>{}</td>", escape(t)),
        Cell::Number(x, decimals) => format!("<td class=\"n\">{}</td>", fixed(*x, *decimals)),
        Cell::Count(n) => format!("<td class=\"n\">{n}</td>"),
        Cell::Verdict(true) => "<td class=\"good\">yes</td>".to_owned(),
        Cell::Verdict(false) => "<td class=\"bad\">no</td>".to_owned(),
        Cell::Empty => "<td></td>".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::codes::OUT_OF_RANGE;
    use crate::report::json;
    use toile_garment::Piece;

    fn garment() -> Garment {
        let piece = Piece { name: "<script>alert(1)</script>".into(), ..Piece::default() };
        Garment { style: "A & \"B\"".into(), pieces: vec![piece], ..Garment::default() }
    }

    #[test]
    fn names_cannot_become_markup_and_nothing_is_fetched() {
        let findings = [Diagnostic::warning(OUT_OF_RANGE, "a <b> & c").hint("do 'this'")];
        let page = html(&garment(), &findings);
        assert!(!page.contains("<script") && page.contains("&lt;script&gt;") && page.contains("a &lt;b&gt; &amp; c"));
        for outside in ["src=", "href=", "@import", "url("] {
            assert!(!page.contains(outside), "{outside}");
        }
        let links = page.replace("http://www.w3.org/2000/svg", "");
        assert!(!links.contains("http"));
        assert_eq!(page, html(&garment(), &findings));
    }

    #[test]
    fn json_holds_the_same_rows() {
        let value = json(&garment(), &[Diagnostic::error(OUT_OF_RANGE, "words")]);
        assert_eq!(value["findings"][0]["code"], "out-of-range");
        assert_eq!(value["pieces"][0]["name"], "<script>alert(1)</script>");
        assert!(value["pieces"][0]["flat_cm2"].is_null());
    }
}
