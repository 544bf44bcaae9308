//! The report as one HTML page: no outside resource; readable on paper and without its script.

use super::first;
use super::fit::Fit;
use super::places::{Place, places};
use super::tables::{Cell, Table, metric_words, tables, word};
use super::viewer;
use super::words::Language;
use super::{live, notches};
use crate::picture::openness;
use crate::svg;
use crate::svg::canvas::{escape, fixed};
use std::fmt::Write as _;
use toile_garment::flat::FlatMetric;
use toile_garment::seam::SeamKind;
use toile_garment::{Diagnostic, Garment};

/// Tables that stand open in the page; the others are folded.
const OPEN: [&str; 3] = ["ease", "lengths", "flat_verdicts"];

/// Columns of flattened pieces; they say nothing where nothing was edited.
const FLATTENED: [&str; 7] =
    ["flat", "area_change", "grain_shift", "curvature_deg", "forced_strain", "change_mm", "surface_cm2"];

/// The report for people.
#[must_use]
pub fn html(garment: &Garment, findings: &[Diagnostic], fit: &Fit, language: Language) -> String {
    let title = if garment.style.is_empty() { "garment" } else { &garment.style };
    // The view and the pictures are in the same light.
    let light = openness(garment);
    let model = light.as_ref().and_then(|light| live::model_in_light(garment, fit, light));
    let mut out = String::new();
    viewer::open(&mut out, title, language, "");
    let marked = places(garment, findings);
    let content = first::Content { garment, findings, places: &marked, fit, light: light.as_ref() };
    first::screen(&mut out, &content, language);
    let all = shown_tables(garment, findings, fit);
    let (open, folded): (Vec<_>, Vec<_>) = all.iter().partition(|t| OPEN.contains(&t.key));
    let study = |out: &mut String, key: &str| {
        if let Some(accuracy) = fit.accuracy.as_ref().filter(|_| key == "accuracy") {
            accuracy.html(out, garment, language);
        }
    };
    open.iter().for_each(|t| table(&mut out, t, garment, language, &study));
    drawings(&mut out, garment, &marked, language);
    folded.iter().for_each(|t| table(&mut out, t, garment, language, &study));
    let scene = live::scene(garment, findings, &marked, fit, language);
    viewer::close(&mut out, &scene, model.as_deref(), "");
    out
}

/// Was the flattening asked to give other pieces than those that are stored?
fn is_flattened(garment: &Garment) -> bool {
    garment.flat.as_ref().is_some_and(|f| f.metric != FlatMetric::Unedited)
}

fn shown_tables(garment: &Garment, findings: &[Diagnostic], fit: &Fit) -> Vec<Table> {
    let measured = [fit.of_house(), fit.ease(), fit.lengths(), fit.standard(), fit.piece_sizes()];
    let study = fit.accuracy.as_ref().map(|a| a.table(garment));
    let measured = measured.into_iter().chain(study).filter(|t| !t.rows.is_empty());
    let rest = tables(garment, findings).into_iter().filter(|t| t.key != "findings");
    let all = measured.chain(rest);
    if is_flattened(garment) { all.collect() } else { all.map(without_flattening).collect() }
}

/// A table without columns and rows of flattened pieces.
fn without_flattening(mut table: Table) -> Table {
    let kept = |key: &str| !FLATTENED.iter().any(|f| key.contains(f));
    let keep: Vec<bool> = table.columns.iter().map(|(key, _)| kept(key)).collect();
    let from = table.columns.iter().position(|(key, _)| *key == "from");
    if let Some(from) = from {
        table.rows.retain(|row| row[from] != word("flat"));
    }
    let mut columns = keep.iter();
    table.columns.retain(|_| *columns.next().unwrap_or(&true));
    for row in &mut table.rows {
        let mut cells = keep.iter();
        row.retain(|_| *cells.next().unwrap_or(&true));
    }
    table
}

fn drawings(out: &mut String, garment: &Garment, places: &[Place], language: Language) {
    if garment.pieces.is_empty() {
        return;
    }
    let _ = writeln!(out, "<h2>{}</h2>\n<div class=\"drawings\">", escape(language.say("Pattern")));
    let mut figure = |drawing: &str, words: &str| {
        let _ = writeln!(out, "<figure>{drawing}<figcaption>{words}</figcaption></figure>");
    };
    let words = "Pieces with the numbers of their edges and notches. A click picks a piece, a seam, a dart or a notch.";
    let spots: Vec<_> = places.iter().map(Place::spot).collect();
    figure(&svg::pickable(garment, &spots, language), &escape(language.say(words)));
    for flat in garment.flat.iter().filter(|_| is_flattened(garment)).flat_map(|f| &f.pieces) {
        let name = garment.pieces.get(flat.piece.index()).map_or_else(String::new, |p| p.name.clone());
        let words = |english: &str| escape(&language.fill(english, std::slice::from_ref(&name)));
        if let Some(drawing) = svg::flat_piece(garment, flat, &flat.flat_strain, language) {
            figure(&drawing, &words("{0}: flattened over the original; strain of the flat cut when worn"));
        }
        if garment.flat.as_ref().is_some_and(|f| f.metric == FlatMetric::Carried)
            && let Some(drawing) = svg::flat_piece(garment, flat, &flat.drape_strain, language)
        {
            figure(&drawing, &words("{0}: strain from the original piece to the edited shape"));
        }
    }
    out.push_str("</div>\n");
    if let Some(flat) = garment.flat.as_ref().filter(|f| f.metric != FlatMetric::Unedited) {
        let _ = writeln!(out, "<p>{}</p>", escape(language.say(metric_words(flat.metric))));
    }
}

/// A table; `before` writes what stands before the table of a key.
fn table(out: &mut String, table: &Table, garment: &Garment, language: Language, before: &dyn Fn(&mut String, &str)) {
    let open = OPEN.contains(&table.key);
    let title = escape(language.say(table.title));
    let _ = match open {
        true => writeln!(out, "<h2 id=\"{}\">{title}</h2>", table.key),
        false => writeln!(out, "<details id=\"{}\"><summary>{title}</summary>", table.key),
    };
    before(out, table.key);
    if !table.note.is_empty() {
        let _ = writeln!(out, "<p class=\"note\">{}</p>", escape(language.say(&table.note)));
    }
    let _ = write!(out, "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{title}\"><table>\n<tr>");
    // Columns without a heading are for programs.
    for (_, heading) in table.columns.iter().filter(|(_, heading)| !heading.is_empty()) {
        let _ = write!(out, "<th scope=\"col\">{}</th>", escape(language.say(heading)));
    }
    out.push_str("</tr>\n");
    let notched = if table.key == "notches" { notches::rows(garment) } else { Vec::new() };
    for (k, row) in table.rows.iter().enumerate() {
        let picks = picks(table.key, k, row, garment, &notched);
        let _ = match &picks {
            Some(name) => write!(out, "<tr data-pick=\"{name}\">"),
            None => write!(out, "<tr>"),
        };
        let shown = table.columns.iter().zip(row).enumerate().filter(|(_, ((_, heading), _))| !heading.is_empty());
        for (i, ((key, _), cell)) in shown {
            // The cell with the name can be reached and pressed by the keyboard.
            let named = usize::from(table.key == "darts" || table.key == "edges");
            let cell = in_words(table.key, key, cell, language);
            out.push_str(&html_cell(key, &cell, picks.is_some() && i == named, language));
        }
        out.push_str("</tr>\n");
    }
    out.push_str(if open { "</table></div>\n" } else { "</table></div></details>\n" });
}

/// A cell in the language of the page. Names of measures, edges and effects are words of this program.
fn in_words(table: &str, column: &str, cell: &Cell, language: Language) -> Cell {
    match (table, column, cell) {
        (_, _, Cell::Phrases(phrases)) => Cell::Text(language.phrases(phrases)),
        ("ease" | "lengths", "name", Cell::Text(t)) | ("fit_standard", "what", Cell::Text(t)) => {
            Cell::Text(language.measure(t))
        }
        ("edges" | "notches", "edge", Cell::Text(t)) => Cell::Text(language.edge(t)),
        ("effects", "name" | "rule", Cell::Text(t)) => Cell::Text(language.say(t).to_owned()),
        ("points_of_measure", "on" | "method", Cell::Text(t)) => Cell::Text(language.say(t).to_owned()),
        (_, _, other) => other.clone(),
    }
}

/// The piece, seam, dart or notch that a row is about. `notched` are the rows of all notches.
fn picks(table: &str, number: usize, row: &[Cell], garment: &Garment, notched: &[notches::Row]) -> Option<String> {
    let text = |k: usize| match row.get(k) {
        Some(Cell::Text(t)) => Some(t.as_str()),
        _ => None,
    };
    let piece = || garment.pieces.iter().position(|p| Some(p.name.as_str()) == text(0));
    match table {
        "pieces" => Some(format!("piece:{number}")),
        "seams" => Some(format!("seam:{number}")),
        "notches" => notched.get(number).map(|r| notches::pick_name(r.at)),
        "edges" | "strain" | "piece_sizes" | "flat_verdicts" => piece().map(|p| format!("piece:{p}")),
        "darts" => {
            let p = piece()?;
            let dart = garment.pieces[p].darts.iter().position(|d| Some(d.name.as_str()) == text(1))?;
            let is_it = |kind: &SeamKind| matches!(kind, SeamKind::Dart { piece, dart: d } if piece.index() == p && d.index() == dart);
            garment.seams.iter().position(|s| is_it(&s.kind)).map(|k| format!("seam:{k}"))
        }
        _ => None,
    }
}

fn html_cell(key: &str, cell: &Cell, pressed: bool, language: Language) -> String {
    match cell {
        Cell::Text(t) if pressed => format!("<td><button class=\"row\" type=\"button\">{}</button></td>", escape(t)),
        Cell::Text(t) if matches!(key, "params" | "blake3" | "code") => {
            format!("<td class=\"code\">{}</td>", escape(t))
        }
        Cell::Text(t) => format!("<td>{}</td>", escape(t)),
        Cell::Number(x, decimals) => format!("<td class=\"n\">{}</td>", fixed(*x, *decimals)),
        Cell::Count(n) => format!("<td class=\"n\">{n}</td>"),
        Cell::Phrases(phrases) => format!("<td>{}</td>", escape(&language.phrases(phrases))),
        Cell::Verdict(true) => format!("<td class=\"good\">{}</td>", language.say("yes")),
        Cell::Verdict(false) => format!("<td class=\"bad\">{}</td>", language.say("no")),
        Cell::Empty => "<td></td>".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::codes::OUT_OF_RANGE;
    use crate::report::json;
    use crate::report::tables::all;
    use toile_garment::Piece;
    use toile_garment::garment::Certificate;

    fn garment() -> Garment {
        let piece = Piece { name: "<script>alert(1)</script>".into(), ..Piece::default() };
        Garment { style: "A & \"B\"".into(), pieces: vec![piece], ..Garment::default() }
    }

    #[test]
    fn names_cannot_become_markup_and_nothing_is_fetched() {
        let findings = [Diagnostic::warning(OUT_OF_RANGE, "a <b> & c").hint("do 'this'")];
        let page = html(&garment(), &findings, &Fit::default(), Language::English);
        assert!(!page.contains("<script>alert") && page.contains("&lt;script&gt;"));
        assert!(page.contains("a &lt;b&gt; &amp; c") && page.contains("\\u003cscript>alert(1)"));
        assert_eq!(page.matches("<script").count(), 2, "data and program; there is no model");
        for outside in ["href=", "@import", "url(", "import(", "fetch(", "XMLHttp"] {
            assert!(!page.contains(outside), "{outside}");
        }
        assert_eq!(page.matches("src=").count(), page.matches("src=\"data:image/png;base64,").count());
        let links = page.replace("http://www.w3.org/2000/svg", "");
        assert!(!links.contains("http:") && !links.contains("https:"));
        assert_eq!(page, html(&garment(), &findings, &Fit::default(), Language::English));
    }

    #[test]
    fn the_page_speaks_the_language_that_is_asked_for() {
        let page = html(&garment(), &[], &Fit::default(), Language::Chinese);
        assert!(
            page.contains("<html lang=\"zh-Hans\">") && page.contains("<b>未模拟。</b>") && page.contains("检查结果")
        );
        assert!(!page.contains("There are no warnings."));
    }

    /// Titles, notes and headings are in the catalogue, and so are the words on the drawing and in the cells.
    #[test]
    fn every_word_of_the_tables_can_be_told_in_chinese() {
        let fit = Fit::default();
        let measured = [fit.of_house(), fit.ease(), fit.lengths(), fit.standard(), fit.piece_sizes()];
        let deep = all(&garment(), &[]).into_iter().filter(|t| t.key != "findings");
        for table in deep.chain(measured) {
            let words = [table.title, &table.note].into_iter().chain(table.columns.iter().map(|c| c.1));
            // Units are the same everywhere.
            for english in words.filter(|w| !w.is_empty() && *w != "mm") {
                assert_ne!(Language::Chinese.say(english), english, "table `{}`", table.key);
            }
        }
        let mut draped = garment();
        draped.certificate = Some(Certificate { passed: true, ..Certificate::default() });
        let page = html(&draped, &[], &Fit::default(), Language::Chinese);
        for words in ["<td>布料自身穿插</td>", "<td class=\"good\">是</td>", ">净线<"] {
            assert!(page.contains(words), "{words}");
        }
        for words in ["self_crossings", "sew line", ">yes<"] {
            assert!(!page.contains(words), "{words}");
        }
    }

    #[test]
    fn json_holds_the_same_rows() {
        let value = json(&garment(), &[Diagnostic::error(OUT_OF_RANGE, "words")], &Fit::default());
        assert_eq!(value["findings"][0]["code"], "out-of-range");
        assert_eq!(value["pieces"][0]["name"], "<script>alert(1)</script>");
        assert!(value["pieces"][0]["flat_cm2"].is_null());
    }

    #[test]
    fn columns_of_flattened_pieces_are_left_out_where_nothing_was_edited() {
        let shown = shown_tables(&garment(), &[], &Fit::default());
        let pieces = shown.iter().find(|t| t.key == "pieces").expect("pieces");
        let keys: Vec<&str> = pieces.columns.iter().map(|c| c.0).collect();
        assert_eq!(keys, ["name", "triangles", "outline_mm", "original_cm2"]);
        assert_eq!(pieces.rows[0].len(), 4);
    }
}
