//! The drawing of a measured body: its outline from the front and from its left, with girths, heights and landmarks.

use toile_formats::svg::canvas::{Bounds, Canvas};
use toile_garment::{Vec2, Vec3};
use toile_stages::body::{Found, Slices};

/// Distance of the rows of which an outline consists, share of the height.
const ROW: f64 = 1.0 / 600.0;
/// Distance of lines of text and their height, shares of the height.
const LINE: f64 = 0.022;
const LETTERS: f64 = 0.0145;

const STYLE: &str = "path{fill:none;stroke-linejoin:round}.body{stroke:#d9dde6}.girth{stroke:#b3261e;stroke-width:2;}\
.height{stroke:#5a6475;stroke-width:1;stroke-dasharray:8 6}.lead{stroke:#9aa3b2;stroke-width:1}\
.scale{stroke:#222;stroke-width:2}.label{text-anchor:middle}.point{fill:#1f4e9e}text{font-family:system-ui,sans-serif;fill:#222}.start{text-anchor:start}.end{text-anchor:end}\
.middle{text-anchor:middle;font-weight:600}";

/// A way to look at the body, and where it is drawn, millimetres.
struct View {
    shift: f64,
    from_front: bool,
}

impl View {
    fn at(&self, p: Vec3) -> Vec2 {
        // From its left the wearer looks to the left of the page.
        let across = if self.from_front { p.x } else { -p.z };
        Vec2::new(1e3 * across + self.shift, 1e3 * p.y)
    }
}

/// Draws a body.
pub fn draw(found: &Found) -> String {
    let slices = Slices::new(&found.body);
    let height = 1e3 * slices.height;
    let mut canvas = Canvas::default();
    let wide = |of: &dyn Fn(&Vec3) -> f64| 1e3 * found.body.positions.iter().map(of).fold(0.0, f64::max);
    let half = wide(&|p| p.x.abs());
    let deep = wide(&|p| p.z.abs());
    let text = 0.32 * height;
    let front = View { shift: 0.0, from_front: true };
    let side = View { shift: half + text + 0.1 * height + deep, from_front: false };
    for view in [&front, &side] {
        outline(&mut canvas, &slices, view);
        for girth in &found.girths {
            let points: Vec<Vec2> = girth.points.iter().map(|p| view.at(*p)).collect();
            canvas.line("girth", &points, true);
        }
    }
    let named = format!("{}, {}", found.body.name, found.pose.words());
    canvas.text("middle", Vec2::new(0.0, 1.05 * height), 1.3 * LETTERS * height, &format!("{named}: front"));
    canvas.text("middle", Vec2::new(side.shift, 1.05 * height), 1.3 * LETTERS * height, "from the left");
    let size = LETTERS * height;
    column(&mut canvas, girths(found, &front), -half - 0.03 * height, "end", size, height);
    column(&mut canvas, landmarks(found, &front), half + 0.03 * height, "start", size, height);
    dots(&mut canvas, found, &front, 0.2 * size);
    dots(&mut canvas, found, &side, 0.2 * size);
    let right = side.shift + deep + 0.03 * height;
    for (y, _) in heights(found, &slices) {
        canvas.line("height", &[Vec2::new(side.shift - deep, y), Vec2::new(side.shift + deep, y)], false);
    }
    let ends = heights(found, &slices).into_iter().map(|(y, words)| (Vec2::new(side.shift + deep, y), words)).collect();
    column(&mut canvas, ends, right, "start", size, height);
    let low = Vec2::new(-half - text, -0.05 * height);
    let bounds = Bounds { min: low, max: Vec2::new(right + text, 1.09 * height) };
    canvas.scale_bar(Vec2::new(low.x + 0.03 * height, -0.03 * height), 0.2 * height, size);
    canvas.finish(bounds, &named, STYLE)
}

/// Rows of the body as wide as it is seen.
fn outline(canvas: &mut Canvas, slices: &Slices<'_>, view: &View) {
    let step = ROW * slices.height;
    canvas.open(if view.from_front { "front" } else { "side" });
    let mut rows: Vec<[Vec2; 3]> = Vec::new();
    let mut y = slices.low + 0.5 * step;
    while y < slices.low + slices.height {
        let mut spans: Vec<[f64; 2]> = slices
            .cut(y)
            .iter()
            .map(|s| {
                let (low, high) = s.bounds();
                let ends = [view.at(low).x, view.at(high).x];
                [ends[0].min(ends[1]), ends[0].max(ends[1])]
            })
            .collect();
        spans.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut joined: Vec<[f64; 2]> = Vec::new();
        for span in spans {
            match joined.last_mut().filter(|last| span[0] <= last[1]) {
                Some(last) => last[1] = last[1].max(span[1]),
                None => joined.push(span),
            }
        }
        let (under, over) = (1e3 * (y - 0.6 * step), 1e3 * (y + 0.6 * step));
        for [a, b] in joined {
            rows.push([Vec2::new(a, under), Vec2::new(b, under), Vec2::new(b, over)]);
            rows.push([Vec2::new(a, under), Vec2::new(b, over), Vec2::new(a, over)]);
        }
        y += step;
    }
    canvas.shapes("body", "#d9dde6", &rows);
    canvas.close();
}

/// Texts beside places, apart from each other, with lines that lead to them.
fn column(canvas: &mut Canvas, mut texts: Vec<(Vec2, String)>, x: f64, class: &str, size: f64, height: f64) {
    texts.sort_by(|a, b| b.0.y.total_cmp(&a.0.y));
    let step = LINE * height;
    // As near to their places as the lines of text allow: groups that touch are centred on the mean of their places.
    let mut groups: Vec<(f64, usize)> = Vec::new();
    for (at, _) in &texts {
        groups.push((at.y, 1));
        while let [.., (upper, n), (lower, m)] = groups[..] {
            if upper - lower >= 0.5 * step * (n + m) as f64 {
                break;
            }
            groups.pop();
            groups.pop();
            groups.push(((upper * n as f64 + lower * m as f64) / (n + m) as f64, n + m));
        }
    }
    let places = groups.iter().flat_map(|(y, n)| (0..*n).map(move |k| y + step * (0.5 * (n - 1) as f64 - k as f64)));
    for ((at, words), y) in texts.iter().zip(places) {
        let gap = if class == "end" { 0.3 * size } else { -0.3 * size };
        canvas.line("lead", &[*at, Vec2::new(x + gap, y)], false);
        canvas.text(class, Vec2::new(x, y), size, words);
    }
}

fn words(name: &str) -> String {
    name.replace(['_', '-'], " ")
}

/// The girths of the trunk and of the wearer's right, where the column of their names is.
fn girths(found: &Found, view: &View) -> Vec<(Vec2, String)> {
    let mut out: Vec<(Vec2, &str, String)> = Vec::new();
    for girth in &found.girths {
        let points = girth.points.iter().map(|p| view.at(*p));
        let Some(end) = points.min_by(|a, b| a.x.total_cmp(&b.x)) else { continue };
        // The right limb comes last.
        out.retain(|(_, name, _)| *name != girth.name);
        let length = found.mesh.get(girth.name).copied().unwrap_or(girth.length);
        out.push((end, girth.name, format!("{} {:.0}", words(girth.name), 1e3 * length)));
    }
    out.into_iter().map(|(at, _, words)| (at, words)).collect()
}

fn landmarks(found: &Found, view: &View) -> Vec<(Vec2, String)> {
    let seen = found.body.landmarks.iter().filter(|(name, _)| !name.ends_with("-right") && !name.ends_with("-back"));
    seen.map(|(name, p)| (view.at(*p), words(name))).collect()
}

fn dots(canvas: &mut Canvas, found: &Found, view: &View, size: f64) {
    let hidden = if view.from_front { "-back" } else { "-right" };
    for (_, p) in found.body.landmarks.iter().filter(|(name, _)| !name.ends_with(hidden)) {
        canvas.dot("point", view.at(*p), size);
    }
}

/// Heights and lengths that are no girths, with where they are drawn.
fn heights(found: &Found, slices: &Slices<'_>) -> Vec<(f64, String)> {
    let measures = found.body.measures.iter().filter(|(name, _)| name.ends_with("_height") || *name == "stature");
    measures.map(|(name, h)| (1e3 * (h + slices.low), format!("{} {:.0}", words(name), 1e3 * h))).collect()
}
