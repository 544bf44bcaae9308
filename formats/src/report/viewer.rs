//! The view in 3D of a page: the figure with its tools, the data, and the scripts. It needs no library and no network.
//!
//! Names such as `piece:2`, `seam:7` and `notch:2:0` join the view, drawings and rows of tables: what is picked in one is shown in
//! all (`data-pick`).

use super::words::Language;
use crate::picture::Field;
use crate::svg::canvas::escape;
use serde_json::{Map, Value, json};
use std::fmt::Write as _;

/// The style of a page with a view.
pub const STYLE: &str = include_str!("page/page.css");

const SCRIPTS: [&str; 7] = [
    include_str!("page/glb.js"),
    include_str!("page/unfold.js"),
    include_str!("page/shaders.js"),
    include_str!("page/threads.js"),
    include_str!("page/motion.js"),
    include_str!("page/viewer.js"),
    include_str!("page/page.js"),
];

/// The page may not fetch anything, whatever stands in it.
const POLICY: &str = "default-src 'none'; img-src data: blob:; style-src 'unsafe-inline'; script-src 'unsafe-inline'";

/// The figure of a view.
pub struct Figure<'a> {
    /// Name of the garment.
    pub name: &'a str,
    /// HTML that stands in place of the view where that cannot run, and on paper.
    pub still: &'a str,
    /// Is there a body that can be hidden?
    pub has_body: bool,
    /// Quantities that can be shown as colours: key and name.
    pub maps: &'a [(&'a str, &'a str)],
    /// Names of the colourways, that of the garment itself first; empty where there is one only.
    pub colourways: &'a [&'a str],
    /// Frames of the motion that can be played.
    pub frames: usize,
    /// Can a level plane cut the garment?
    pub has_section: bool,
    /// The ends of the slider: the flat pieces and the worn ones.
    pub ways: [&'a str; 2],
    /// Asks for a click.
    pub invitation: &'a str,
}

/// A stretch of a line, on one piece.
pub enum Stretch {
    /// Vertices of the mesh of a piece.
    Vertices(usize, Vec<u32>),
    /// Points of a piece, in space and in the flat lay, metres.
    Points(usize, Vec<[f64; 5]>),
}

/// A line that can be picked.
pub struct Line {
    /// Its stretches.
    pub stretches: Vec<Stretch>,
    /// Red, green and blue from 0 to 1; `None` is the thin grey of seams that are sewn.
    pub colour: Option<[f64; 3]>,
}

/// A thread between points of two pieces that will be sewn to each other.
pub struct Thread {
    /// The line that it belongs to.
    pub line: usize,
    /// The ends: piece, and the point in space and in the flat lay, metres.
    pub ends: [(usize, [f64; 5]); 2],
}

/// A place that a finding names.
pub struct Mark {
    /// The name that picks it.
    pub pick: String,
    /// Its number; empty where it is seen only when it is picked.
    pub number: String,
    /// The piece or line that it is about, by the name that picks it.
    pub target: Option<String>,
    /// Its piece, and the point in space and in the flat lay, metres. `None` without a place in space.
    pub at: Option<(usize, [f64; 5])>,
}

/// A label of an edge or a notch. It is seen on a piece that is picked.
pub struct Tag {
    /// Its text, as the drawing has it.
    pub text: String,
    /// True for the one of a notch.
    pub is_notch: bool,
    /// Its piece, and the point in space and in the flat lay, metres.
    pub at: (usize, [f64; 5]),
}

/// A motion of the pieces: places as whole numbers of steps from a corner.
pub struct Motion {
    /// Frames in a second.
    pub fps: f64,
    /// Number of frames.
    pub count: usize,
    /// The corner, metres.
    pub low: [f64; 3],
    /// Length of a step, metres.
    pub step: f64,
    /// For each piece all frames, each vertex as three numbers of 16 bits, in base64.
    pub pieces: Vec<String>,
    /// Does the body stand where the model shows it?
    pub body_stands: bool,
}

/// Names, lines, quantities, threads and marks, which a view shows with its model.
#[derive(Default)]
pub struct Scene {
    /// How many pieces there are.
    pub pieces: usize,
    /// Words for people by the names that pick.
    pub names: Map<String, Value>,
    /// Lines, in the order of their numbers.
    pub lines: Vec<Line>,
    /// Quantities on the cloth.
    pub fields: Vec<Value>,
    /// The warp of every piece in its flat lay, where that is what the piece is at rest.
    pub warps: Vec<Option<[f64; 2]>>,
    /// Threads.
    pub threads: Vec<Thread>,
    /// Places that findings name.
    pub marks: Vec<Mark>,
    /// Labels of edges and notches.
    pub tags: Vec<Tag>,
    /// Colours of all materials in each colourway but the first, linear RGB.
    pub colourways: Vec<Vec<[f64; 3]>>,
    /// The motion.
    pub motion: Option<Motion>,
    /// The name that is picked when the page opens.
    pub shown: Option<String>,
}

/// The beginning of a page, up to its content.
pub fn open(out: &mut String, title: &str, language: Language, more_style: &str) {
    let _ = writeln!(
        out,
        "<!DOCTYPE html>\n<html lang=\"{}\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n<title>{}</title>\n\
         <style>\n{STYLE}{more_style}</style>\n</head>\n<body data-toile-page=\"1\">\n<main>",
        language.tag(),
        escape(title)
    );
}

/// The end of a page: the model, what the view knows of it, and the scripts.
pub fn close(out: &mut String, scene: &Scene, model: Option<&str>, more_script: &str) {
    out.push_str("</main>\n");
    let _ = writeln!(out, "<script type=\"application/json\" id=\"toile-data\">{}</script>", data(scene));
    if let Some(model) = model {
        let _ = writeln!(out, "<script type=\"application/octet-stream\" id=\"toile-model\">{model}</script>");
    }
    let _ = writeln!(out, "<script>\n{}{more_script}</script>\n</body>\n</html>", SCRIPTS.concat());
}

/// The data, safe inside a script element.
fn data(scene: &Scene) -> String {
    let stretch = |s: &Stretch| match s {
        Stretch::Vertices(piece, vertices) => json!([piece, vertices]),
        Stretch::Points(piece, points) => json!({ "piece": piece, "points": rounded(points) }),
    };
    let line = |l: &Line| {
        let mut out = json!({ "runs": l.stretches.iter().map(stretch).collect::<Vec<_>>() });
        if let (Some(colour), Some(map)) = (l.colour, out.as_object_mut()) {
            map.insert("colour".to_owned(), json!(colour));
        }
        out
    };
    let mut value = json!({
        "pieces": scene.pieces,
        "names": scene.names,
        "seams": scene.lines.iter().map(line).collect::<Vec<_>>(),
        "fields": scene.fields,
        "warps": scene.warps,
    });
    let end = |(piece, point): &(usize, [f64; 5])| json!([piece, rounded(&[*point])[0]]);
    if let (false, Some(map)) = (scene.marks.is_empty(), value.as_object_mut()) {
        let mark =
            |m: &Mark| json!({ "pick": m.pick, "number": m.number, "target": m.target, "at": m.at.as_ref().map(end) });
        map.insert("marks".to_owned(), scene.marks.iter().map(mark).collect());
        map.insert("shown".to_owned(), json!(scene.shown));
    }
    if let (false, Some(map)) = (scene.tags.is_empty(), value.as_object_mut()) {
        let tag = |t: &Tag| json!([t.text, u8::from(t.is_notch), end(&t.at)]);
        map.insert("tags".to_owned(), scene.tags.iter().map(tag).collect());
    }
    if let (false, Some(map)) = (scene.colourways.is_empty(), value.as_object_mut()) {
        map.insert("colourways".to_owned(), json!(scene.colourways));
    }
    if let (Some(m), Some(map)) = (&scene.motion, value.as_object_mut()) {
        let motion = json!({
            "fps": m.fps, "count": m.count, "low": m.low, "step": m.step, "pieces": m.pieces, "bodyStands": m.body_stands,
        });
        map.insert("motion".to_owned(), motion);
    }
    if let (false, Some(map)) = (scene.threads.is_empty(), value.as_object_mut()) {
        let thread = |t: &Thread| json!([t.line, end(&t.ends[0]), end(&t.ends[1])]);
        map.insert("threads".to_owned(), scene.threads.iter().map(thread).collect());
    }
    // A text that closes the element, or steers a reader, cannot stand in it.
    toile_garment::text::json(&value.to_string()).replace('<', "\\u003c")
}

/// Points to a tenth of a millimetre, which no screen shows.
fn rounded(points: &[[f64; 5]]) -> Vec<[f64; 5]> {
    points.iter().map(|p| p.map(|x| (x * 1e4).round() / 1e4 + 0.0)).collect()
}

/// Writes the figure.
pub fn figure(out: &mut String, figure: &Figure<'_>, language: Language) {
    let say = |words: &str| escape(language.say(words));
    let in_space = "{0} in 3D. Arrow keys turn it, plus and minus change its size, 1 to 5 are fixed views.";
    let _ = writeln!(
        out,
        "<figure class=\"view\">\n<div class=\"stage\">{}\
         <canvas data-view tabindex=\"0\" role=\"img\" aria-label=\"{}\"></canvas>\
         <div id=\"spot\" hidden data-words=\"{}\"></div></div>\n<div class=\"tools\">",
        figure.still,
        escape(&language.fill(in_space, &[figure.name.to_owned()])),
        say("show the place"),
    );
    let looks = [("front", "Front"), ("back", "Back"), ("left", "Left"), ("right", "Right"), ("three-quarter", "¾")];
    for (look, words) in looks {
        let _ = write!(out, "<button type=\"button\" data-look=\"{look}\">{}</button>", say(words));
    }
    if figure.has_body {
        let _ = write!(out, "<label><input type=\"checkbox\" id=\"body\" checked> {}</label>", say("body"));
    }
    if !figure.maps.is_empty() {
        maps(out, figure.maps, language);
    }
    if !figure.colourways.is_empty() {
        colourways(out, figure.colourways, language);
    }
    if figure.frames > 1 {
        player(out, figure.frames, language);
    }
    let [flat, worn] = figure.ways;
    let _ = writeln!(
        out,
        "<label>{} <input type=\"range\" id=\"worn\" min=\"0\" max=\"100\" value=\"100\" aria-label=\"{}\"> {}</label>",
        say(flat),
        say("from the flat pattern to the garment"),
        say(worn)
    );
    if figure.has_section {
        let _ = writeln!(
            out,
            "<label>{} <input type=\"range\" id=\"cut\" min=\"0\" max=\"100\" value=\"100\"></label>",
            say("cut at height")
        );
    }
    out.push_str("</div>\n<div id=\"legend\" hidden></div>\n");
    if figure.has_section {
        section(out, language);
    }
    let asked = say(figure.invitation);
    let way = say("largest strain {value} % at {angle}° to the warp");
    let _ = write!(out, "<p id=\"picked\" role=\"status\" data-empty=\"{asked}\" data-way=\"{way}\"></p>\n</figure>\n");
}

/// The choice of a map, under the headings of what it tells.
fn maps(out: &mut String, maps: &[(&str, &str)], language: Language) {
    let say = |words: &str| escape(language.say(words));
    let _ =
        write!(out, "<label>{} <select id=\"map\"><option value=\"cloth\">{}</option>", say("colours"), say("cloth"));
    for group in maps.chunk_by(|a, b| Field::heading(a.0) == Field::heading(b.0)) {
        let heading = group.first().map_or("", |(key, _)| Field::heading(key));
        let _ = write!(out, "<optgroup label=\"{}\">", say(heading));
        for (key, name) in group {
            let _ = write!(out, "<option value=\"{key}\">{}</option>", say(name));
        }
        out.push_str("</optgroup>");
    }
    out.push_str("</select></label>\n");
}

/// The choice of a colourway; the first is that of the garment itself.
fn colourways(out: &mut String, names: &[&str], language: Language) {
    let _ = write!(out, "<label>{} <select id=\"colourway\">", escape(language.say("colourway")));
    for (k, name) in names.iter().enumerate() {
        let name = if k == 0 { language.say(name) } else { name };
        let _ = write!(out, "<option value=\"{k}\">{}</option>", escape(name));
    }
    out.push_str("</select></label>\n");
}

/// Plays the motion, or goes to a moment of it.
fn player(out: &mut String, frames: usize, language: Language) {
    let [play, pause, moment] = ["play", "pause", "moment of the motion"].map(|words| escape(language.say(words)));
    let last = frames.saturating_sub(1);
    let _ = writeln!(
        out,
        "<span class=\"player\"><button type=\"button\" id=\"play\" data-play=\"{play}\" data-pause=\"{pause}\">{play}</button>\
         <input type=\"range\" id=\"moment\" min=\"0\" max=\"{last}\" step=\"any\" value=\"{last}\" aria-label=\"{moment}\">\
         <output id=\"seconds\"></output></span>"
    );
}

fn section(out: &mut String, language: Language) {
    let say = |words: &str| escape(language.say(words));
    let _ = writeln!(
        out,
        "<figure id=\"section\" hidden data-words=\"{}\">\
         <svg role=\"img\" aria-label=\"{}\"><path class=\"body\"/><path class=\"cloth\"/></svg>\
         <figcaption></figcaption></figure>",
        say("Cross-section at {height} mm, seen from above. All cloth: {length} mm."),
        say("cross-section"),
    );
}
