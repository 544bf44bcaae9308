//! `start.html`: the pieces on the body in 3D, the proposed seams, the least sure first, and all pieces with numbered
//! edges. Edges that are clicked become the lines of a seam for the sewing file.

mod colour;
mod drawings;
mod on_body;
mod openings;
mod still;
mod table;

use super::dress::Dressed;
use super::pattern::Source;
use super::sewing::LEAST_SURE;
use drawings::Drawn;
use on_body::{OnBody, on_body};
use std::fmt::Write as _;
use toile_formats::report::Language;
use toile_formats::report::viewer::{self, Figure};
use toile_formats::svg::canvas::escape as escaped;
use toile_garment::body::Body;
use toile_stages::proposal::Proposal;
use toile_stages::sewing::edges::edges;
use toile_stages::sewing::shapes::shapes;

/// From this confidence on a seam needs no second look.
const SURE: f64 = 0.9;

const STYLE: &str = include_str!("start.css");
const SCRIPT: &str = include_str!("start.js");

/// Words of the script.
const SCRIPT_WORDS: [&str; 10] = [
    "{0} mm on {1} mm.",
    "The longer side is gathered.",
    "These seams of the file are on the same edges; remove those that are wrong: {0}.",
    "If `toile check` says that the order contradicts, list the edges of one side the other way round.",
    "{0} from {1} to {2}",
    "start",
    "end",
    "notch {0}",
    "Copied",
    "Copy the lines",
];

/// The page.
pub fn page(
    source: &Source,
    proposal: &Proposal,
    dressed: &Dressed,
    body: Option<&Body>,
    language: Language,
) -> String {
    let piece_words = |k: usize| piece_words(source, dressed, k, language);
    let seam_words = |k: usize| seam_words(proposal, k, language);
    let view = on_body(&source.garment, proposal, dressed, body, [&piece_words, &seam_words]);
    let title = source.file_name();
    let mut out = String::new();
    viewer::open(&mut out, &title, language, STYLE);
    out.push_str("<div class=\"first\">\n");
    figure(&mut out, source, proposal, (dressed, body), language);
    let _ = writeln!(out, "<section>\n<h1>{}: what the program proposes</h1>", escaped(&title));
    left_out(&mut out, source);
    verdict(&mut out, source, proposal);
    table::seams(&mut out, source, proposal);
    openings::list(&mut out, source, proposal, dressed);
    out.push_str("</section>\n</div>\n");
    pieces(&mut out, source, proposal, dressed, &view, language);
    let script = format!("const WORDS = {};\n{SCRIPT}", language.script_words(&SCRIPT_WORDS));
    viewer::close(&mut out, &view.scene, view.model.as_deref(), &script);
    language.page(&out)
}

/// A piece with its role, for people.
fn piece_words(source: &Source, dressed: &Dressed, k: usize, language: Language) -> String {
    let told = |words: String| words.split(' ').map(|w| language.say(w).to_owned()).collect::<Vec<_>>().join(" ");
    let role = dressed.roles.get(k).map(|r| told(r.words())).filter(|w| !w.is_empty());
    let name = &source.garment.pieces[k].name;
    role.map_or_else(|| name.clone(), |role| format!("{name} ({role})"))
}

/// A seam with its lengths, for people.
fn seam_words(proposal: &Proposal, k: usize, language: Language) -> String {
    let seam = &proposal.seams[k];
    let [a, b, sure] = [1e3 * seam.length_a, 1e3 * seam.length_b, 100.0 * seam.confidence].map(|x| format!("{x:.0}"));
    language.fill("{0}: {1} mm on {2} mm, {3} % sure", &[seam.name.clone(), a, b, sure])
}

fn figure(
    out: &mut String,
    source: &Source,
    proposal: &Proposal,
    (dressed, body): (&Dressed, Option<&Body>),
    language: Language,
) {
    let still = still::views(&source.garment, proposal, dressed, body);
    if still.is_empty() {
        out.push_str("<p>No piece has a place on the body yet.</p>\n");
        return;
    }
    let figure = Figure {
        name: &source.stem,
        still: &format!("<div class=\"stills\">{still}</div>"),
        has_body: body.is_some_and(|b| !b.triangles.is_empty()),
        maps: &[],
        colourways: &[],
        frames: 0,
        has_section: false,
        ways: ["flat pieces", "on the body"],
        invitation: "Click a piece or a seam, here, in the table or in a drawing. Drag turns the view.",
    };
    viewer::figure(out, &figure, language);
}

/// The next steps of a person.
fn verdict(out: &mut String, source: &Source, proposal: &Proposal) {
    let count = |holds: &dyn Fn(f64) -> bool| proposal.seams.iter().filter(|s| holds(s.confidence)).count();
    let (open, look) = (count(&|c| c < LEAST_SURE), count(&|c| (LEAST_SURE..SURE).contains(&c)));
    let class = match (open, look) {
        (0, 0) if source.left_out.is_empty() => "good",
        (0, _) => "look",
        _ => "bad",
    };
    let _ = write!(out, "<p class=\"verdict {class}\"><b>Seams: {}.</b>", proposal.seams.len());
    let _ = match (open, look) {
        (0, 0) => write!(out, "All are likely right."),
        (0, look) => write!(out, "Please look at {look} of them."),
        (open, 0) => write!(out, "{open} of them are too unsure to be sewn; a person decides."),
        (open, look) => write!(out, "{open} of them are too unsure to be sewn; please look at {look} others."),
    };
    out.push_str(
        "</p>\n<p>Lines of one colour are sewn to each other, grey lines stay open. Correct what is wrong in \
         <code>sewing.toml</code>, and remove <code>proposed</code> from what is right. Then <code>toile run \
         pipeline.toml</code> sews and drapes the garment.</p>\n",
    );
}

/// Names the pieces that are not sewn. No picture shows what is not there.
fn left_out(out: &mut String, source: &Source) {
    if source.left_out.is_empty() {
        return;
    }
    let names = escaped(&source.left_out.join(", "));
    let _ = writeln!(
        out,
        "<p class=\"verdict look\"><b>Not sewn: {}.</b>{names}. The list <code>leave_out</code> in \
         <code>sewing.toml</code> has them. Take out of it what belongs to the garment, and write its seams.</p>",
        source.left_out.len()
    );
}

fn pieces(
    out: &mut String,
    source: &Source,
    proposal: &Proposal,
    dressed: &Dressed,
    view: &OnBody,
    language: Language,
) {
    out.push_str(
        "<h2>Pieces</h2>\n<p>The small numbers are those of the edges: <code>PIECE.3</code> is edge 3 of PIECE. The \
         arrow beside a number shows where the edge goes. The purple dots are notches: <code>PIECE.n1</code> is notch 1 of \
         PIECE, along the whole outline, and in the file <code>notch 1</code> is the first one on an edge, from its start. A \
         <code>[[place]]</code> with <code>piece</code> and <code>move = [\"0 mm\", \"30 mm\", \"0 mm\"]</code> in the \
         file moves a piece to the wearer's left, up and to the front.</p>\n",
    );
    out.push_str(include_str!("composer.html"));
    out.push_str("<div class=\"pieces\">\n");
    let garment = &source.garment;
    let edges = shapes(garment).map(|s| edges(garment, &s)).unwrap_or_default();
    for (index, piece) in garment.pieces.iter().enumerate() {
        let words = piece_words(source, dressed, index, language);
        let number = view.numbers.get(index).copied().flatten();
        drawings::figure(out, &Drawn { proposal, piece, edges: &edges, words, number });
    }
    out.push_str("</div>\n");
}
