//! The sewing file with proposed seams.

use super::buttons;
use super::pattern::Source;
use std::fmt::Write as _;
use toile_formats::sewing::place_text;
use toile_garment::Vec2;
use toile_garment::sewing::DartSpec;
use toile_garment::text::{quoted, shown};
use toile_stages::proposal::{EdgePart, Proposal, ProposedSeam, Run};

/// A seam less sure than this is written as a comment, and a person decides.
pub const LEAST_SURE: f64 = 0.3;
/// Sides that differ by less are equal, metres.
const EQUAL: f64 = 5e-4;
/// A longer side over a shorter one from here on is gathered, and eased below.
const GATHERED: f64 = 1.1;

/// A sewing file that a person has, and the seams that it lacks. Its own lines stay as they are.
pub fn filled(source: &Source, proposal: &Proposal, text: &str) -> String {
    let new: Vec<&ProposedSeam> = missing(proposal).filter(|s| s.confidence >= LEAST_SURE).collect();
    let mut out = text.to_owned();
    if !new.is_empty() {
        if !out.is_empty() && !out.ends_with('\n') {
            out.push('\n');
        }
        out.push_str("\n# Proposed by `toile new` for edges that no seam above has.\n");
    }
    new.into_iter().for_each(|seam| out.push_str(&table(source, seam)));
    out
}

/// The proposed seams that a person does not have.
pub fn missing(proposal: &Proposal) -> impl Iterator<Item = &ProposedSeam> {
    proposal.seams.iter().zip(&proposal.given).filter(|(_, given)| !**given).map(|(seam, _)| seam)
}

/// Text of the sewing file.
pub fn text(source: &Source, proposal: &Proposal) -> String {
    let mut out = head(source);
    for copy in &source.copies {
        let _ = write!(
            out,
            "\n[[copy]]\npiece = {}\nname = {}\nmirror = {}\n",
            quoted(&copy.piece),
            quoted(&copy.name),
            copy.mirror
        );
    }
    source.pleats.iter().for_each(|pleat| out.push_str(&pleat_table(pleat)));
    out.push_str(&buttons::text(&source.garment));
    let (sure, open): (Vec<_>, Vec<_>) = proposal.seams.iter().partition(|s| s.confidence >= LEAST_SURE);
    for seam in sure {
        out.push_str(&table(source, seam));
    }
    if !open.is_empty() {
        out.push_str("\n# These seams are too unsure. Remove the # of those that are right.\n");
    }
    for seam in open {
        let commented: String = table(source, seam).trim_start().lines().map(|l| format!("# {l}\n")).collect();
        let _ = write!(out, "\n{commented}");
        for other in &seam.instead {
            let _ = writeln!(out, "# It may be sewn to {} instead.", atom(source, proposal, *other));
        }
    }
    out
}

fn head(source: &Source) -> String {
    let file = shown(&source.file_name(), &[]);
    let list: Vec<String> = source.left_out.iter().map(String::as_str).map(quoted).collect();
    let left_out = if list.is_empty() {
        String::new()
    } else {
        format!(
            "\n# These pieces are not sewn: layers, pieces with the quantity 0, and alternatives.\n{}\
             leave_out = [{}]\n",
            reasons(source),
            list.join(", ")
        )
    };
    format!(
        "# The seams of {file}, proposed by `toile new`.\n#\n\
         # `toile inspect {file} --svg pieces.svg` draws the numbers of the edges. `proposed` says how sure the program\n\
         # is: 1 is certain. Correct what is wrong, and remove `proposed` from what is right.\n{left_out}"
    )
}

/// The pieces that are left out, as comments by reason.
fn reasons(source: &Source) -> String {
    let line = |names: &[String], before: &str, after: &str| match names {
        [] => String::new(),
        names => format!("# {before} {}. {after}\n", shown(&names.join(", "), &[])),
    };
    let take = "Take what you want sewn out of the list, and write its seams.";
    [
        line(&source.inner, "On or under other pieces lie", take),
        line(&source.not_cut, "The quantity is 0 of", "Take one out of the list to have it sewn."),
        line(&source.stood_for, "Another piece stands for", "To sew one of these, exchange the two in the list."),
        line(&source.without_seam, "No sure seam was found for", take),
    ]
    .concat()
}

/// One pleat.
fn pleat_table(pleat: &DartSpec) -> String {
    let list = |points: &[Vec2]| points.iter().map(|p| point(*p)).collect::<Vec<_>>().join(", ");
    let name = pleat.name.as_deref().map_or_else(String::new, |name| format!("name = {}\n", quoted(name)));
    let piece = quoted(&pleat.piece);
    let mut out = format!("\n[[dart]]\npiece = {piece}\n{name}kind = \"pleat\"\nmouth = [{}]\n", list(&pleat.mouth));
    if pleat.press.is_some() {
        let _ = writeln!(out, "apexes = [{}]\npress = \"knife\"\nsewn = \"0 mm\"", list(&pleat.apexes));
    }
    out
}

/// One seam.
fn table(source: &Source, seam: &ProposedSeam) -> String {
    let mut out = format!(
        "\n[[seam]]\nname = {}\na = {}\nb = {}\n",
        quoted(&seam.name),
        side(source, &seam.a),
        side(source, &seam.b)
    );
    let by_edge = seam.a.iter().chain(&seam.b).any(|r| !r.edges.is_empty());
    if seam.fold_over || (by_edge && seam.a.len() + seam.b.len() > 2) || edges_of(seam) > 2 {
        let _ = writeln!(out, "reverse = {}", !seam.fold_over);
    }
    let (long, short) = (seam.length_a.max(seam.length_b), seam.length_a.min(seam.length_b));
    if long / short > GATHERED {
        let _ = writeln!(out, "gather = {:.3}", long / short);
    } else if long - short > EQUAL {
        let _ = writeln!(out, "ease = \"{:.1} mm\"", seam.ease() * 1e3);
    }
    let _ = writeln!(out, "proposed = {:.2}", seam.confidence);
    out
}

fn edges_of(seam: &ProposedSeam) -> usize {
    seam.a.iter().chain(&seam.b).map(|r| r.edges.len()).sum()
}

/// One side: an edge, a run, or a list of those.
fn side(source: &Source, runs: &[Run]) -> String {
    let parts: Vec<String> = joined(runs).iter().flat_map(|r| run(source, r)).collect();
    match parts.as_slice() {
        [only] => only.clone(),
        many => format!("[{}]", many.join(", ")),
    }
}

/// Runs whose edges go on in the next one are one: those on both sides of a pleat.
fn joined(runs: &[Run]) -> Vec<Run> {
    let mut out: Vec<Run> = Vec::new();
    for run in runs {
        let last = out.last_mut().filter(|last| last.piece == run.piece);
        let both = last.and_then(|last| Some((last.edges.last()?.with(run.edges.first()?)?, last)));
        match both {
            Some((edge, last)) => {
                last.edges.pop();
                last.edges.push(edge);
                last.edges.extend(run.edges.iter().skip(1).cloned());
            }
            None => out.push(run.clone()),
        }
    }
    out
}

fn run(source: &Source, run: &Run) -> Vec<String> {
    let piece = &source.garment.pieces[run.piece].name;
    if !run.edges.is_empty() {
        return run.edges.iter().map(|e| edge(piece, e)).collect();
    }
    let way = if run.forward { "left" } else { "right" };
    vec![format!(
        "{{ piece = {}, from = {}, to = {}, way = \"{way}\" }}",
        quoted(piece),
        point(run.ends[0]),
        point(run.ends[1])
    )]
}

fn edge(piece: &str, edge: &EdgePart) -> String {
    let Some(places) = edge.places else { return quoted(&format!("{piece}.{}", edge.number)) };
    let [from, to] = places.map(|p| quoted(&place_text(p)));
    format!("{{ piece = {}, edge = {}, from = {from}, to = {to} }}", quoted(piece), edge.number)
}

pub(super) fn point(p: Vec2) -> String {
    format!("[\"{:.4} mm\", \"{:.4} mm\"]", p.x * 1e3, p.y * 1e3)
}

/// An atom in words.
fn atom(source: &Source, proposal: &Proposal, atom: usize) -> String {
    let atom = &proposal.layout.atoms[atom];
    let piece = &source.garment.pieces[proposal.layout.panels[atom.panel].piece].name;
    let (from, to) = (atom.points[0], atom.points[atom.points.len() - 1]);
    format!("{} from {} to {}, {:.0} mm", shown(piece, &[]), mm(from), mm(to), atom.length * 1e3)
}

fn mm(p: Vec2) -> String {
    format!("({:.0}, {:.0}) mm", p.x * 1e3, p.y * 1e3)
}
