//! The first screen: the garment, its facts, the verdict, the key measures, and what was found.

use super::fit::Fit;
use super::places::{Place, finding_name};
use super::verdict::verdict;
use super::viewer::{self, Figure};
use super::words::Language;
use super::{live, motion};
use crate::codes::PIECES_LEFT_OUT;
use crate::picture::{self, Openness, View, Wishes};
use crate::svg::canvas::{escape, fixed};
use std::fmt::Write as _;
use toile_garment::fabric::Fabric;
use toile_garment::seam::SeamKind;
use toile_garment::{Diagnostic, Garment, Severity};

/// Width and height of each of the two pictures that stand where there is no 3D view, pixels.
const STILL: [u32; 2] = [420, 525];

/// The content of the first screen.
pub struct Content<'a> {
    /// The garment.
    pub garment: &'a Garment,
    /// All findings.
    pub findings: &'a [Diagnostic],
    /// The places of the findings.
    pub places: &'a [Place],
    /// All measures.
    pub fit: &'a Fit,
    /// The light around the garment; without it there is no picture.
    pub light: Option<&'a Openness>,
}

/// Writes the first screen.
pub fn screen(out: &mut String, content: &Content<'_>, language: Language) {
    let Content { garment, findings, places, fit, light } = *content;
    out.push_str("<div class=\"first\">\n");
    if let Some(png) = light.and_then(|light| still(garment, light)) {
        view(out, garment, &png, fit, language);
    }
    out.push_str("<section>\n");
    let title = if garment.style.is_empty() { "garment" } else { &garment.style };
    let _ = writeln!(out, "<h1>{}</h1>", escape(title));
    let v = verdict(garment, findings, language);
    let class = match v.passed {
        Some(true) => "good",
        Some(false) => "bad",
        None => "",
    };
    let _ = writeln!(out, "<p class=\"verdict {class}\"><b>{}</b>{}</p>", v.word, escape(&v.why));
    facts(out, garment, language);
    key_measures(out, fit, language);
    found(out, findings, places, language);
    out.push_str("</section>\n</div>\n");
}

/// The garment from the front and from the back.
fn still(garment: &Garment, light: &Openness) -> Option<Vec<u8>> {
    let wishes =
        Wishes { views: vec![View::Front, View::Back], width: STILL[0], height: STILL[1], body: true, field: None };
    picture::png_in_light(garment, &wishes, Some(light)).ok()
}

fn view(out: &mut String, garment: &Garment, png: &[u8], fit: &Fit, language: Language) {
    let name = if garment.style.is_empty() { "garment" } else { &garment.style };
    let words = escape(&language.fill("{0}, from the front and from the back", &[name.to_owned()]));
    let [width, height] = [2 * STILL[0], STILL[1]];
    let still = format!("<img alt=\"{words}\" width=\"{width}\" height=\"{height}\" src=\"{}\">", live::image(png));
    let maps: Vec<(&str, &str)> = fit.maps.iter().map(|m| (m.key, m.name)).collect();
    let others = garment.textures.iter().flat_map(|t| &t.colourways).map(|c| c.name.as_str());
    let colourways: Vec<&str> = ["as sewn"].into_iter().chain(others).collect();
    let figure = Figure {
        name,
        still: &still,
        has_body: garment.body.as_ref().is_some_and(|b| !b.triangles.is_empty()),
        maps: &maps,
        colourways: if colourways.len() > 1 { &colourways } else { &[] },
        frames: motion::times(garment).len(),
        has_section: true,
        ways: ["pattern", "garment"],
        invitation: "Click a piece, a seam, a dart or a notch, here, in the drawing or in a table.",
    };
    viewer::figure(out, &figure, language);
}

fn facts(out: &mut String, garment: &Garment, language: Language) {
    out.push_str("<dl class=\"facts\">\n");
    let mut fact = |name: &str, value: &str| {
        if !value.is_empty() {
            let _ = writeln!(out, "<dt>{}</dt><dd>{}</dd>", escape(language.say(name)), escape(value));
        }
    };
    fact("Size", garment.size.as_deref().unwrap_or_default());
    let fabric = |f: &Fabric| {
        let values = [f.name.clone(), fixed(1e3 * f.areal_mass, 0), fixed(1e3 * f.thickness, 2)];
        language.fill("{0}, {1} g/m², {2} mm thick", &values)
    };
    fact("Fabric", &garment.fabrics.values().map(fabric).collect::<Vec<_>>().join("; "));
    fact("Body", garment.body.as_ref().map_or("", |b| b.name.as_str()));
    let darts: usize = garment.pieces.iter().map(|p| p.darts.len()).sum();
    let counts = [garment.pieces.len(), seams(garment), darts].map(|n| n.to_string());
    fact("Pattern", &language.fill("pieces: {0}, seams: {1}, darts: {2}", &counts));
    out.push_str("</dl>\n");
}

/// The seams that are sewn; before they are, those of the sewing file.
fn seams(garment: &Garment) -> usize {
    let sewn = garment.seams.iter().filter(|s| s.kind == SeamKind::Seam).count();
    if garment.seams.is_empty() { garment.plan.seams.len() } else { sewn }
}

fn key_measures(out: &mut String, fit: &Fit, language: Language) {
    let known: Vec<_> = fit.levels.iter().filter_map(|l| Some((l, l.body?, l.ease()?))).collect();
    if !known.is_empty() {
        let head = ["girth, mm", "body", "pattern", "ease"].map(|h| escape(language.say(h)));
        let _ = writeln!(out, "<table><tr><th scope=\"col\">{}</th></tr>", head.join("</th><th scope=\"col\">"));
        for (level, body, ease) in known {
            let sign = if ease >= 0.0005 { "+" } else { "" };
            let [body, pattern, ease] = [body, level.pattern, ease].map(|x| fixed(1e3 * x, 0));
            let name = level.name.replace('_', " ");
            let cells = [body, pattern, format!("{sign}{ease}")].join("</td><td class=\"n\">");
            let _ = writeln!(out, "<tr><td>{}</td><td class=\"n\">{cells}</td></tr>", escape(language.say(&name)));
        }
        out.push_str("</table>\n");
    }
    let mm = |x: f64| fixed(1e3 * x, 0);
    if let Some([low, high]) = fit.range {
        let long = "The garment is {0} mm long and ends {1} mm above the floor.";
        let _ = write!(out, "<p>{}", escape(&language.fill(long, &[mm(high - low), mm(low)])));
        if let Some(hem) = fit.edges.first() {
            let _ = write!(out, " {}", escape(&language.fill("The lowest edge is {0} mm long.", &[mm(hem.length)])));
        }
        out.push_str("</p>\n");
    }
}

fn found(out: &mut String, findings: &[Diagnostic], places: &[Place], language: Language) {
    let all: Vec<Found<'_>> = findings.iter().enumerate().map(|(k, f)| Found::new(k, f, places)).collect();
    let (left_out, others): (Vec<&Found<'_>>, Vec<&Found<'_>>) =
        all.iter().partition(|f| f.finding.code == PIECES_LEFT_OUT);
    let (mut serious, notes): (Vec<&Found<'_>>, Vec<&Found<'_>>) =
        others.into_iter().partition(|f| f.finding.severity > Severity::Info);
    serious.sort_by_key(|f| std::cmp::Reverse(f.finding.severity));
    let _ = writeln!(out, "<h2>{}</h2>", escape(language.say("Findings")));
    // What is not there cannot be seen in any picture, so it is told first.
    list(out, &left_out, language);
    if serious.is_empty() {
        let _ = writeln!(out, "<p>{}</p>", escape(language.say("There are no warnings.")));
    }
    list(out, &serious, language);
    if !notes.is_empty() {
        let count = language.fill("notes: {0}", &[notes.len().to_string()]);
        let _ = writeln!(out, "<details id=\"notes\"><summary>{}</summary>", escape(&count));
        list(out, &notes, language);
        out.push_str("</details>\n");
    }
}

/// A finding, with its place if it has one.
struct Found<'a> {
    finding: &'a Diagnostic,
    place: Option<&'a Place>,
}

impl<'a> Found<'a> {
    fn new(number: usize, finding: &'a Diagnostic, places: &'a [Place]) -> Self {
        let pick = finding_name(number);
        Self { finding, place: places.iter().find(|p| p.pick == pick) }
    }

    /// The element of the list, its number in the drawing, and the button that shows the place.
    fn around(&self, language: Language) -> [String; 3] {
        let Some(place) = self.place else { return ["<li>".to_owned(), String::new(), String::new()] };
        let number = match place.number.as_str() {
            "" => String::new(),
            n => format!("<span class=\"pin\">{n}</span> "),
        };
        let words = escape(language.say("show the place"));
        [
            format!("<li data-pick=\"{}\">", escape(&place.pick)),
            number,
            format!("<button type=\"button\">{words}</button>"),
        ]
    }
}

fn list(out: &mut String, findings: &[&Found<'_>], language: Language) {
    if findings.is_empty() {
        return;
    }
    out.push_str("<ul class=\"findings\">\n");
    for found in findings {
        let f = found.finding;
        let word = match f.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Info => "",
        };
        let word = match word {
            "" => String::new(),
            word => format!("<span class=\"{word}\">{}</span> ", escape(language.say(word))),
        };
        let place = f.source.as_ref().map_or_else(String::new, |s| format!(" ({})", escape(&s.to_string())));
        let (message, hint) = words_of(f, language);
        let [item, number, button] = found.around(language);
        let code = escape(&f.code);
        let _ =
            writeln!(out, "{item}{number}{word}{message}<small><code>{code}</code>{place}</small>{hint}{button}</li>");
    }
    out.push_str("</ul>\n");
}

/// Message and remedy of a finding as HTML. In another language than English its meaning stands first, and the sentence
/// with names and figures follows in English.
fn words_of(finding: &Diagnostic, language: Language) -> (String, String) {
    let remedy = |words: &str| match words {
        "" => String::new(),
        words => format!("<small>{}: {}</small>", escape(language.say("Remedy")), escape(words)),
    };
    let (message, hint) = (escape(&finding.message), finding.hint.as_deref().unwrap_or_default());
    match language.finding(&finding.code) {
        Some([what, help]) => {
            let help = if help.is_empty() { hint } else { help };
            (format!("{}<small lang=\"en\">{message}</small>", escape(what)), remedy(help))
        }
        None => (message, remedy(hint)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use toile_garment::sewing::{SeamSpec, SewingPlan};

    #[test]
    fn seams_of_a_sewing_file_count_before_they_are_sewn() {
        let (reverse, ease, gather, proposed) = Default::default();
        let side =
            SeamSpec { name: "side".into(), a: vec![], b: vec![], reverse, ease, gather, proposed, source: None };
        let plan = SewingPlan { seams: vec![side.clone(), side.clone(), side], ..SewingPlan::default() };
        let mut out = String::new();
        facts(&mut out, &Garment { plan, ..Garment::default() }, Language::English);
        assert!(out.contains("pieces: 0, seams: 3, darts: 0"), "{out}");
    }

    #[test]
    fn pieces_that_are_left_out_are_told_first() {
        let findings = [
            Diagnostic::warning(crate::codes::OUT_OF_RANGE, "too far"),
            Diagnostic::info(PIECES_LEFT_OUT, "pieces are left out: POCKET"),
        ];
        let mut out = String::new();
        found(&mut out, &findings, &[], Language::English);
        assert!(at_of(&out, "POCKET") < at_of(&out, "too far") && !out.contains("<details"), "{out}");
        out.clear();
        found(&mut out, &findings[1..], &[], Language::English);
        assert!(at_of(&out, "POCKET") < at_of(&out, "There are no warnings."), "{out}");
    }

    #[test]
    fn findings_have_their_meaning_in_the_language_of_the_page() {
        let finding = [Diagnostic::warning(crate::codes::OUT_OF_RANGE, "9 is too far").hint("take less")];
        let told = |language| {
            let mut out = String::new();
            found(&mut out, &finding, &[], language);
            out
        };
        let chinese = told(Language::Chinese);
        assert!(chinese.contains("数值超出合理范围。<small lang=\"en\">9 is too far</small>"), "{chinese}");
        assert!(chinese.contains("处理办法: 按说明中的范围改正。") && !chinese.contains("take less"), "{chinese}");
        let english = told(Language::English);
        assert!(english.contains("</span> 9 is too far<small>") && english.contains("Remedy: take less"), "{english}");
    }

    fn at_of(text: &str, words: &str) -> usize {
        text.find(words).expect("told")
    }
}
