//! The chart: error against seconds and against memory, both axes logarithmic, the front drawn, presets named.

use super::{Accuracy, Point};
use crate::report::Language;
use crate::svg::canvas::{escape, fixed};
use crate::svg::letters;
use std::fmt::Write as _;

/// Size of one panel and of the whole, in pixels.
const PANEL: [f64; 2] = [520.0, 400.0];
const MARGIN: [f64; 4] = [64.0, 16.0, 52.0, 40.0];
const LEGEND: f64 = 64.0;
/// Errors below this are drawn at it, mm.
const LEAST_ERROR: f64 = 0.05;

const STYLE: &str = "text{font:12px 'DejaVu Sans',Arial,sans-serif;fill:#333}.title{font-size:14px;font-weight:bold}\
.grid{stroke:#e4dfd3;stroke-width:1}.frame{fill:none;stroke:#8b8576}.front{fill:none;stroke:#b3261e;stroke-width:1.5}\
.bound{stroke:#0b6b3a;stroke-width:1.5;stroke-dasharray:4 3}.name{font-weight:bold}.small{font-size:11px}\
.mark{stroke:#fff;stroke-width:1}.open{fill:#fff;stroke-width:2}.chosen{fill:none;stroke:#b3261e;stroke-width:2}.here{fill:none;stroke:#111;stroke-width:2}";

/// Kinds of settings, each with a colour. A point tells its kind by the number.
pub const KINDS: [(&str, &str); 6] = [
    ("own choice", "#1f4e79"),
    ("draft", "#6aa5d8"),
    ("fine, reference", "#7b3fa0"),
    ("springs", "#c77700"),
    ("steps in time", "#5b5b5b"),
    ("no self-contact", "#2e8b57"),
];

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
    point: &'a Point,
    /// True for the drape of the page.
    is_here: bool,
    x: f64,
    y: f64,
}

/// The chart of a study. `here` is the number of the point that a page is about.
#[must_use]
pub fn svg(accuracy: &Accuracy, here: Option<usize>, language: Language) -> String {
    let [width, height] = [2.0 * PANEL[0], PANEL[1] + LEGEND];
    let title = language.fill("{0}: what accuracy costs", std::slice::from_ref(&accuracy.pipeline));
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" role=\"img\">\n<title>{}</title>\n\
         <style>{STYLE}</style>\n<rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n",
        escape(&title)
    );
    let by_time = |p: &Point| Some(p.cpu_seconds);
    let words = ["error against time", "CPU seconds"].map(|w| language.say(w));
    panel(&mut out, (accuracy, here), 0.0, (words, language), &by_time, true);
    let words = ["error against memory", "largest memory, MB"].map(|w| language.say(w));
    panel(&mut out, (accuracy, here), PANEL[0], (words, language), &|p: &Point| p.peak_mb, false);
    legend(&mut out, here.is_some(), language);
    out.push_str("</svg>\n");
    out
}

fn panel(
    out: &mut String,
    (accuracy, here): (&Accuracy, Option<usize>),
    left: f64,
    (words, language): ([&str; 2], Language),
    value: &dyn Fn(&Point) -> Option<f64>,
    with_front: bool,
) {
    let known = || accuracy.points.iter().filter_map(|p| Some((value(p)?, p.error_mm?)));
    let bounds = accuracy.points.iter().filter_map(|p| p.promised_mm);
    let x = Axis::around(known().map(|k| k.0), left + MARGIN[0], left + PANEL[0] - MARGIN[1]);
    let errors = known().map(|k| k.1.max(LEAST_ERROR)).chain(bounds);
    let y = Axis::around(errors, PANEL[1] - MARGIN[2], MARGIN[3]);
    axes(out, &x, &y, words, language);
    let dot = |(number, point): (usize, &'_ Point)| {
        let (x, y) = (x.at(value(point)?), y.at(point.error_mm?.max(LEAST_ERROR)));
        Some((number, x, y))
    };
    let dots: Vec<Dot<'_>> = accuracy
        .points
        .iter()
        .enumerate()
        .filter_map(dot)
        .map(|(number, x, y)| Dot { point: &accuracy.points[number], is_here: here == Some(number), x, y })
        .collect();
    if with_front {
        front_line(out, &dots);
    }
    dots.iter().for_each(|dot| mark(out, dot, &y, language));
}

fn axes(out: &mut String, x: &Axis, y: &Axis, [title, label]: [&str; 2], language: Language) {
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
         transform=\"translate({7} {8}) rotate(-90)\" text-anchor=\"middle\">{9}</text>",
        fixed(x.from, 1),
        fixed(y.to, 1),
        fixed(w, 1),
        fixed(h, 1),
        fixed(y.to - 14.0, 1),
        fixed(x.from + 0.5 * w, 1),
        fixed(y.from + 36.0, 1),
        fixed(x.from - 46.0, 1),
        fixed(y.to + 0.5 * h, 1),
        language.say("error, mm")
    );
}

/// The line through the points of the front.
fn front_line(out: &mut String, dots: &[Dot<'_>]) {
    let mut front: Vec<&Dot<'_>> = dots.iter().filter(|d| d.point.on_front).collect();
    front.sort_by(|a, b| a.x.total_cmp(&b.x));
    let mut path = String::new();
    for (i, dot) in front.iter().enumerate() {
        let letter = if i == 0 { "M" } else { "L" };
        let _ = write!(path, "{letter}{} {}", fixed(dot.x, 1), fixed(dot.y, 1));
    }
    let _ = writeln!(out, "<path class=\"front\" d=\"{path}\"/>");
}

fn mark(out: &mut String, dot: &Dot<'_>, y: &Axis, language: Language) {
    let point = dot.point;
    let colour = KINDS.get(point.kind).map_or("#000", |k| k.1);
    let (cx, cy) = (fixed(dot.x, 1), fixed(dot.y, 1));
    if let (Some(name), Some(bound)) = (&point.preset, point.promised_mm) {
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
    let values = [point.error_mm.unwrap_or(0.0), point.cpu_seconds].map(|x| fixed(x, 1));
    let [error, seconds] = values;
    let values = [point.name.clone(), error, seconds, point.triangles.to_string()];
    let words = language.fill("{0}: {1} mm, {2} CPU s, {3} triangles", &values);
    let class = if point.is_finest { "open" } else { "mark" };
    let paint = if point.is_finest { format!("stroke=\"{colour}\"") } else { format!("fill=\"{colour}\"") };
    let _ = writeln!(
        out,
        "<circle class=\"{class}\" {paint} cx=\"{cx}\" cy=\"{cy}\" r=\"5\"><title>{}</title></circle>",
        escape(&words)
    );
    if point.is_recommended {
        let _ = writeln!(out, "<circle class=\"chosen\" cx=\"{cx}\" cy=\"{cy}\" r=\"9\"/>");
    }
    if dot.is_here {
        let _ = writeln!(out, "<circle class=\"here\" cx=\"{cx}\" cy=\"{cy}\" r=\"13\"/>");
    }
}

fn legend(out: &mut String, has_here: bool, language: Language) {
    let top = PANEL[1] + 14.0;
    let mut x = MARGIN[0];
    for (words, colour) in KINDS {
        let words = language.say(words);
        let _ = writeln!(
            out,
            "<circle class=\"mark\" fill=\"{colour}\" cx=\"{x}\" cy=\"{}\" r=\"5\"/><text x=\"{}\" y=\"{top}\">{words}</text>",
            top - 4.0,
            x + 10.0
        );
        x += (36.0 + 7.6 * letters(words)).round();
    }
    let lines = "Red line: the front, nothing is both cheaper and more exact. Red ring: recommended. Open: the finest, at \
                 its own estimate. Green: what a preset promises.";
    let here = has_here.then_some("Black ring: this garment.");
    for (k, words) in [Some(lines), here].into_iter().flatten().enumerate() {
        let _ = writeln!(
            out,
            "<text class=\"small\" x=\"{}\" y=\"{}\">{}</text>",
            MARGIN[0] - 5.0,
            top + 24.0 + 16.0 * k as f64,
            language.say(words)
        );
    }
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
}
