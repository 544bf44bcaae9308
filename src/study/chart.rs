//! The chart: error against seconds and against memory, both axes logarithmic, the front drawn, presets named.

use super::grid::Setting;
use super::report::{Row, Study};
use std::fmt::Write as _;
use toile_formats::svg::canvas::{escape, fixed};
use toile_stages::drape::{AccuracyName, IntegratorName, ModelName, SwitchName};

/// Size of one panel and of the whole, in pixels.
const PANEL: [f64; 2] = [520.0, 400.0];
const MARGIN: [f64; 4] = [64.0, 16.0, 52.0, 40.0];
const LEGEND: f64 = 64.0;
/// Errors below this are drawn at it, mm.
const LEAST_ERROR: f64 = 0.05;

const STYLE: &str = "text{font:12px 'DejaVu Sans',Arial,sans-serif;fill:#333}.title{font-size:14px;font-weight:bold}\
.grid{stroke:#e4dfd3;stroke-width:1}.frame{fill:none;stroke:#8b8576}.front{fill:none;stroke:#b3261e;stroke-width:1.5}\
.bound{stroke:#0b6b3a;stroke-width:1.5;stroke-dasharray:4 3}.name{font-weight:bold}.small{font-size:11px}\
.mark{stroke:#fff;stroke-width:1}.open{fill:#fff;stroke-width:2}.chosen{fill:none;stroke:#b3261e;stroke-width:2}";

/// Kinds of settings, each with a colour.
const KINDS: [(&str, &str); 6] = [
    ("own choice", "#1f4e79"),
    ("draft", "#6aa5d8"),
    ("fine, reference", "#7b3fa0"),
    ("springs", "#c77700"),
    ("steps in time", "#5b5b5b"),
    ("no self-contact", "#2e8b57"),
];

fn kind(setting: &Setting) -> usize {
    let own = Setting::plain(setting.edge);
    match setting {
        s if s.integrator != IntegratorName::Static => 4,
        s if s.model == ModelName::Springs => 3,
        s if s.self_contact == SwitchName::Off => 5,
        s if s.accuracy == AccuracyName::Draft => 1,
        s if s.accuracy != own.accuracy => 2,
        _ => 0,
    }
}

/// A logarithmic axis from values to pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Axis {
    /// An axis that holds all values, a little wider, from pixel `from` to pixel `to`.
    #[must_use]
    pub fn around(values: impl Iterator<Item = f64>, from: f64, to: f64) -> Self {
        let good = values.filter(|v| v.is_finite() && *v > 0.0);
        let (low, high) = good.fold((f64::INFINITY, 0.0_f64), |(low, high), v| (low.min(v), high.max(v)));
        let (low, high) = if low <= high { (low, high) } else { (1.0, 10.0) };
        Self { low: low / 1.4, high: high * 1.4, from, to }
    }

    /// The pixel of a value.
    #[must_use]
    pub fn at(&self, value: f64) -> f64 {
        let share = libm::log(value / self.low) / libm::log(self.high / self.low);
        self.from + share.clamp(0.0, 1.0) * (self.to - self.from)
    }

    /// 1, 2 and 5 of every decade within.
    #[must_use]
    pub fn ticks(&self) -> Vec<f64> {
        let decades = (-6..9).map(|n| libm::pow(10.0, f64::from(n)));
        let all = decades.flat_map(|d| [d, 2.0 * d, 5.0 * d]);
        all.filter(|v| *v >= self.low && *v <= self.high).collect()
    }
}

/// One point of a panel.
struct Dot<'a> {
    row: &'a Row,
    number: usize,
    x: f64,
    y: f64,
}

/// The chart of a study.
#[must_use]
pub fn svg(study: &Study) -> String {
    let [width, height] = [2.0 * PANEL[0], PANEL[1] + LEGEND];
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" role=\"img\">\n<title>{0}: what accuracy \
         costs</title>\n<style>{STYLE}</style>\n<rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n",
        escape(&study.pipeline)
    );
    let by_time = |row: &Row| Some(row.done.cpu_seconds);
    panel(&mut out, study, 0.0, "error against time", "CPU seconds", &by_time, true);
    let by_memory = |row: &Row| row.done.peak_mb;
    panel(&mut out, study, PANEL[0], "error against memory", "largest memory, MB", &by_memory, false);
    legend(&mut out);
    out.push_str("</svg>\n");
    out
}

fn panel(
    out: &mut String,
    study: &Study,
    left: f64,
    title: &str,
    label: &str,
    value: &dyn Fn(&Row) -> Option<f64>,
    with_front: bool,
) {
    let places = study.places();
    let known = || study.rows.iter().zip(&places).filter_map(|(row, p)| Some((value(row)?, p.as_ref()?.error)));
    let bounds = study.rows.iter().filter_map(|r| r.promised_mm);
    let x = Axis::around(known().map(|k| k.0), left + MARGIN[0], left + PANEL[0] - MARGIN[1]);
    let errors = known().map(|k| k.1.max(LEAST_ERROR)).chain(bounds);
    let y = Axis::around(errors, PANEL[1] - MARGIN[2], MARGIN[3]);
    axes(out, &x, &y, title, label);
    let dots: Vec<Dot<'_>> = study
        .rows
        .iter()
        .zip(&places)
        .enumerate()
        .filter_map(|(number, (row, p))| {
            Some(Dot { row, number, x: x.at(value(row)?), y: y.at(p.as_ref()?.error.max(LEAST_ERROR)) })
        })
        .collect();
    if with_front {
        front_line(out, &dots);
    }
    dots.iter().for_each(|dot| mark(out, study, dot, &y));
}

fn axes(out: &mut String, x: &Axis, y: &Axis, title: &str, label: &str) {
    // Writing to a String cannot fail.
    for tick in x.ticks() {
        let at = fixed(x.at(tick), 1);
        let _ = writeln!(
            out,
            "<path class=\"grid\" d=\"M{at} {}V{}\"/><text x=\"{at}\" y=\"{}\" text-anchor=\"middle\">{tick}</text>",
            fixed(y.from, 1),
            fixed(y.to, 1),
            fixed(y.from + 16.0, 1)
        );
    }
    for tick in y.ticks() {
        let at = fixed(y.at(tick), 1);
        let _ = writeln!(
            out,
            "<path class=\"grid\" d=\"M{} {at}H{}\"/><text x=\"{}\" y=\"{}\" text-anchor=\"end\">{tick}</text>",
            fixed(x.from, 1),
            fixed(x.to, 1),
            fixed(x.from - 6.0, 1),
            fixed(y.at(tick) + 4.0, 1)
        );
    }
    let (w, h) = (x.to - x.from, y.from - y.to);
    let _ = writeln!(
        out,
        "<rect class=\"frame\" x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\"/>\n<text class=\"title\" x=\"{0}\" \
         y=\"{4}\">{title}</text>\n<text x=\"{5}\" y=\"{6}\" text-anchor=\"middle\">{label}</text>\n<text \
         transform=\"translate({7} {8}) rotate(-90)\" text-anchor=\"middle\">error, mm</text>",
        fixed(x.from, 1),
        fixed(y.to, 1),
        fixed(w, 1),
        fixed(h, 1),
        fixed(y.to - 14.0, 1),
        fixed(x.from + 0.5 * w, 1),
        fixed(y.from + 36.0, 1),
        fixed(x.from - 46.0, 1),
        fixed(y.to + 0.5 * h, 1)
    );
}

fn front_line(out: &mut String, dots: &[Dot<'_>]) {
    let mut front: Vec<&Dot<'_>> = dots.iter().filter(|d| d.row.on_front).collect();
    front.sort_by(|a, b| a.x.total_cmp(&b.x));
    let mut path = String::new();
    for (i, dot) in front.iter().enumerate() {
        let letter = if i == 0 { "M" } else { "L" };
        let _ = write!(path, "{letter}{} {}", fixed(dot.x, 1), fixed(dot.y, 1));
    }
    let _ = writeln!(out, "<path class=\"front\" d=\"{path}\"/>");
}

fn mark(out: &mut String, study: &Study, dot: &Dot<'_>, y: &Axis) {
    let colour = KINDS[kind(&dot.row.done.setting)].1;
    let (cx, cy) = (fixed(dot.x, 1), fixed(dot.y, 1));
    if let (Some(name), Some(bound)) = (&dot.row.preset, dot.row.promised_mm) {
        let top = y.at(bound);
        let _ = writeln!(
            out,
            "<path class=\"bound\" d=\"M{cx} {cy}V{0}M{1} {0}h12\"/>\n<text class=\"name\" x=\"{cx}\" y=\"{2}\" \
             text-anchor=\"middle\">{3}</text>",
            fixed(top, 1),
            fixed(dot.x - 6.0, 1),
            fixed(top - 6.0, 1),
            escape(name)
        );
    }
    let words = format!(
        "{}: {} mm, {} CPU s, {} triangles",
        dot.row.name,
        fixed(study.stated(dot.number).unwrap_or(0.0), 1),
        fixed(dot.row.done.cpu_seconds, 1),
        dot.row.done.triangles
    );
    let finest = dot.number == study.finest;
    let class = if finest { "open" } else { "mark" };
    let paint = if finest { format!("stroke=\"{colour}\"") } else { format!("fill=\"{colour}\"") };
    let _ = writeln!(
        out,
        "<circle class=\"{class}\" {paint} cx=\"{cx}\" cy=\"{cy}\" r=\"5\"><title>{}</title></circle>",
        escape(&words)
    );
    if study.recommended == Some(dot.number) {
        let _ = writeln!(out, "<circle class=\"chosen\" cx=\"{cx}\" cy=\"{cy}\" r=\"9\"/>");
    }
}

fn legend(out: &mut String) {
    let top = PANEL[1] + 14.0;
    let mut x = MARGIN[0];
    for (words, colour) in KINDS {
        let _ = writeln!(
            out,
            "<circle class=\"mark\" fill=\"{colour}\" cx=\"{x}\" cy=\"{}\" r=\"5\"/><text x=\"{}\" y=\"{top}\">{words}</text>",
            top - 4.0,
            x + 10.0
        );
        x += 36.0 + 7.6 * words.len() as f64;
    }
    let _ = writeln!(
        out,
        "<text class=\"small\" x=\"{}\" y=\"{}\">Red line: the front, nothing is both cheaper and more exact. Red ring: \
         recommended. Open: the finest, at its own estimate. Green: what a preset promises.</text>",
        MARGIN[0] - 5.0,
        top + 24.0
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_keeps_ratios() {
        let axis = Axis::around([1.0, 100.0].into_iter(), 0.0, 200.0);
        let steps = [axis.at(1.0), axis.at(10.0), axis.at(100.0)];
        assert!((steps[1] - steps[0] - (steps[2] - steps[1])).abs() < 1e-9);
        assert!(steps[0] > 0.0 && steps[2] < 200.0, "room at the ends");
        assert_eq!(axis.ticks(), [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0]);
        let up = Axis::around([1.0, 100.0].into_iter(), 300.0, 0.0);
        assert!(up.at(1.0) > up.at(100.0), "more error stands higher");
    }

    #[test]
    fn nothing_to_show_is_no_reason_to_fail() {
        let axis = Axis::around([f64::NAN, 0.0].into_iter(), 0.0, 100.0);
        assert!(axis.at(3.0).is_finite());
    }

    #[test]
    fn every_row_is_a_point_and_presets_have_names() {
        let study = super::super::report::tests::sample();
        let text = svg(&study);
        assert_eq!(text.matches("<circle class=\"mark\" fill").count(), 2 * 4 + KINDS.len());
        assert_eq!(text.matches("<circle class=\"open\"").count(), 2, "the finest, in both panels");
        assert_eq!(text.matches("<circle class=\"chosen\"").count(), 2, "the recommended one, in both panels");
        let named = study.rows.iter().filter(|r| r.preset.is_some()).count();
        assert_eq!(text.matches("<text class=\"name\"").count(), 2 * named);
        assert!(named > 0 && !text.contains("NaN") && !text.contains("<script"));
    }
}
