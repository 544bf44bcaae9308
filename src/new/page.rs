//! `start.html`: all pieces with their numbered edges, and the proposed seams in matching colours.

use super::dress::Dressed;
use super::pattern::Source;
use super::placed;
use super::sewing::LEAST_SURE;
use std::fmt::Write as _;
use toile_formats::sewing::place_text;
use toile_formats::svg::canvas::escape as escaped;
use toile_garment::body::Body;
use toile_garment::{Piece, Vec2};
use toile_stages::proposal::{EdgePart, Proposal, ProposedSeam, Run};

/// From this confidence on a seam needs no second look.
const SURE: f64 = 0.9;
/// Pixels for a metre of cloth.
const SCALE: f64 = 420.0;
/// Room around a piece, pixels.
const EDGE: f64 = 26.0;
/// Length of the arrow on an edge, pixels.
const ARROW: f64 = 8.0;

const STYLE: &str = "body{font:15px/1.45 system-ui,sans-serif;margin:2rem;max-width:75rem;color:#222}\
h1{font-size:1.5rem}h2{font-size:1.15rem;margin-top:2rem}figure{display:inline-block;margin:0 1rem 1rem 0;\
vertical-align:top}figcaption{font-weight:600}td,th{padding:.2rem .7rem;text-align:left;vertical-align:top}\
tr{border-top:1px solid #ddd}.swatch{display:inline-block;width:1.6rem;height:.7rem}\
td:nth-child(2),td:nth-child(5),td:nth-child(6){white-space:nowrap}.open{background:#fff4e0}code{background:#f2f2f2}";

/// The page.
pub fn page(source: &Source, proposal: &Proposal, dressed: &Dressed, body: Option<&Body>) -> String {
    let title = escaped(&source.file_name());
    let mut out = format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{title}</title>\n\
         <style>{STYLE}</style></head>\n<body data-toile-page=\"1\">\n<h1>{title}: what the program proposes</h1>\n\
         <p>Lines of the same colour are sewn to each other. Grey lines stay open. The small numbers are those of the \
         edges, as <code>sewing.toml</code> writes them: <code>PIECE.3</code> is edge 3 of PIECE. The arrow beside a \
         number shows where the edge goes; its notches, the small dots, count from its start. Correct there what is \
         wrong, and remove <code>proposed</code> from what is right. Then <code>toile run pipeline.toml</code> sews and \
         drapes the garment.</p>\n"
    );
    let mut order: Vec<usize> = (0..proposal.seams.len()).collect();
    order.sort_by(|i, j| proposal.seams[*i].confidence.total_cmp(&proposal.seams[*j].confidence));
    if !source.left_out.is_empty() {
        let names = escaped(&source.left_out.join(", "));
        let _ =
            writeln!(out, "<h2>Not sewn</h2>\n<p>{names}. The list <code>leave_out</code> in the file has them.</p>");
    }
    table(&mut out, source, proposal, &order);
    out.push_str(&placed::views(&source.garment, proposal, dressed, body));
    out.push_str("<h2>Pieces</h2>\n");
    for (index, piece) in source.garment.pieces.iter().enumerate() {
        let role = dressed.roles.get(index).map(|r| r.words()).unwrap_or_default();
        figure(&mut out, proposal, index, piece, &role);
    }
    out.push_str("</body></html>\n");
    out
}

/// The seams, the least sure first.
fn table(out: &mut String, source: &Source, proposal: &Proposal, order: &[usize]) {
    let groups: [(&str, &dyn Fn(f64) -> bool); 3] = [
        ("Too unsure to be sewn", &|c| c < LEAST_SURE),
        ("Please look at these", &|c| (LEAST_SURE..SURE).contains(&c)),
        ("Likely right", &|c| c >= SURE),
    ];
    for (heading, holds) in groups {
        let rows: Vec<usize> = order.iter().copied().filter(|k| holds(proposal.seams[*k].confidence)).collect();
        if rows.is_empty() {
            continue;
        }
        let _ = writeln!(
            out,
            "<h2>{heading}</h2>\n<table><tr><th></th><th>seam</th><th>side a</th><th>side b</th><th>lengths</th>\
             <th>sure</th><th>notes</th></tr>"
        );
        for k in rows {
            row(out, source, proposal, k);
        }
        out.push_str("</table>\n");
    }
}

fn row(out: &mut String, source: &Source, proposal: &Proposal, k: usize) {
    let seam = &proposal.seams[k];
    let class = if seam.confidence < SURE { " class=\"open\"" } else { "" };
    let _ = writeln!(
        out,
        "<tr{class}><td><span class=\"swatch\" style=\"background:{}\"></span></td><td>{}</td><td>{}</td><td>{}</td>\
         <td>{:.0} and {:.0} mm</td><td>{:.0} %</td><td>{}</td></tr>",
        colour(k),
        escaped(&seam.name),
        side(source, &seam.a),
        side(source, &seam.b),
        seam.length_a * 1e3,
        seam.length_b * 1e3,
        seam.confidence * 100.0,
        escaped(&notes(source, proposal, seam))
    );
}

fn notes(source: &Source, proposal: &Proposal, seam: &ProposedSeam) -> String {
    let mut notes = super::document::evidence(seam);
    if seam.confidence < SURE {
        for atom in &seam.instead {
            let atom = &proposal.layout.atoms[*atom];
            let piece = &source.garment.pieces[proposal.layout.panels[atom.panel].piece];
            notes.push(format!("or to {} over {:.0} mm", piece.name, atom.length * 1e3));
        }
    }
    notes.join("; ")
}

/// An edge in words, or a part of it.
fn edge(piece: &str, edge: &EdgePart) -> String {
    let part = edge.places.map(|[from, to]| format!(" from {} to {}", place_text(from), place_text(to)));
    format!("{piece}.{}{}", edge.number, part.unwrap_or_default())
}

/// A side in words.
fn side(source: &Source, runs: &[Run]) -> String {
    let word = |r: &Run| {
        let name = &source.garment.pieces[r.piece].name;
        if r.edges.is_empty() {
            format!("part of {name}")
        } else {
            r.edges.iter().map(|e| edge(name, e)).collect::<Vec<_>>().join(", ")
        }
    };
    escaped(&runs.iter().map(word).collect::<Vec<_>>().join(", "))
}

/// Colours that follow one another are far apart on the circle of hues.
pub fn colour(k: usize) -> String {
    format!("hsl({},75%,{}%)", (k * 137) % 360, if k.is_multiple_of(2) { 42 } else { 54 })
}

fn figure(out: &mut String, proposal: &Proposal, index: usize, piece: &Piece, role: &str) {
    let points = piece.outline.positions();
    let (Some(low), Some(high)) = (extreme(&points, f64::min), extreme(&points, f64::max)) else { return };
    let at = |p: Vec2| (EDGE + (p.x - low.x) * SCALE, EDGE + (high.y - p.y) * SCALE);
    let (width, height) = ((high.x - low.x) * SCALE + 2.0 * EDGE, (high.y - low.y) * SCALE + 2.0 * EDGE);
    let path = |list: &[Vec2]| list.iter().map(|p| at(*p)).map(|(x, y)| format!("{x:.1},{y:.1} ")).collect::<String>();
    let role = if role.is_empty() { String::new() } else { format!(" ({role})") };
    let _ = writeln!(
        out,
        "<figure><figcaption>{}{}</figcaption>\n<svg width=\"{width:.0}\" height=\"{height:.0}\" role=\"img\">\n\
         <polygon points=\"{}\" fill=\"#f7f5ef\" stroke=\"#999\" stroke-width=\"1.5\"/>",
        escaped(&piece.name),
        escaped(&role),
        path(&points)
    );
    for (k, seam) in proposal.seams.iter().enumerate() {
        for run in seam.a.iter().chain(&seam.b).filter(|r| r.piece == index) {
            let _ = writeln!(
                out,
                "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"4\"><title>{}</title></polyline>",
                path(&run.points),
                colour(k),
                escaped(&seam.name)
            );
        }
    }
    for notch in piece.notches.iter().filter(|n| n.is_on_edge()) {
        let (x, y) = at(notch.at);
        let _ = writeln!(out, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"#7a1fa2\"/>");
    }
    for edge in &piece.edges {
        let Some((middle, along)) = middle(&points, edge.from as usize, edge.to as usize) else { continue };
        let ((x, y), (dx, dy)) = (at(middle), (along.x * ARROW, -along.y * ARROW));
        let _ = writeln!(
            out,
            "<path d=\"M{:.1} {:.1}L{x:.1} {y:.1}L{:.1} {:.1}\" fill=\"none\" stroke=\"#222\"/>\n\
             <text x=\"{:.1}\" y=\"{:.1}\" font-size=\"12\" text-anchor=\"middle\" paint-order=\"stroke\" \
             stroke=\"#fff\" stroke-width=\"3\">{}</text>",
            x - dx - dy * 0.5,
            y - dy + dx * 0.5,
            x - dx + dy * 0.5,
            y - dy - dx * 0.5,
            x + dy * 1.6,
            y - dx * 1.6 + 4.0,
            edge.index
        );
    }
    out.push_str("</svg></figure>\n");
}

fn extreme(points: &[Vec2], choose: fn(f64, f64) -> f64) -> Option<Vec2> {
    points.iter().copied().reduce(|a, b| Vec2::new(choose(a.x, b.x), choose(a.y, b.y)))
}

/// The middle vertex of an edge, or the middle of its chord where it has no vertex between its ends, and the unit vector
/// of its way there.
fn middle(points: &[Vec2], from: usize, to: usize) -> Option<(Vec2, Vec2)> {
    let n = points.len();
    let steps = (to + n).checked_sub(from)? % n.max(1);
    let point = |k: usize| points.get((from + k) % n).copied();
    let half = steps / 2;
    let (before, after) = match steps {
        0 => return None,
        1 => (point(0)?, point(1)?),
        _ => (point(half - 1)?, point(half + 1)?),
    };
    let middle = if steps == 1 { (before + after) / 2.0 } else { point(half)? };
    (after - before).try_normalize(0.0).map(|along| (middle, along))
}
