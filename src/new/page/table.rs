//! The proposed seams as tables, the least sure first.

use super::SURE;
use super::colour::colour;
use crate::new::document::evidence;
use crate::new::pattern::Source;
use crate::new::sewing::LEAST_SURE;
use std::fmt::Write as _;
use toile_formats::sewing::place_text;
use toile_formats::svg::canvas::escape as escaped;
use toile_stages::proposal::{EdgePart, Proposal, ProposedSeam, Run};

/// Writes the tables.
pub fn seams(out: &mut String, source: &Source, proposal: &Proposal) {
    let mut order: Vec<usize> = (0..proposal.seams.len()).collect();
    order.sort_by(|i, j| proposal.seams[*i].confidence.total_cmp(&proposal.seams[*j].confidence));
    let sure = |k: usize| proposal.seams[k].confidence;
    let is_confirmed = |k: usize| proposal.given[k] && sure(k) >= 1.0;
    let groups: [(&str, &dyn Fn(usize) -> bool); 4] = [
        ("Too unsure to be sewn", &|k| sure(k) < LEAST_SURE),
        ("Please look at these", &|k| (LEAST_SURE..SURE).contains(&sure(k))),
        ("Likely right", &|k| sure(k) >= SURE && !is_confirmed(k)),
        ("Yours, from sewing.toml", &is_confirmed),
    ];
    for (heading, holds) in groups {
        let rows: Vec<usize> = order.iter().copied().filter(|k| holds(*k)).collect();
        if rows.is_empty() {
            continue;
        }
        let headings = ["seam", "its sides", "mm", "sure"].map(|h| format!("<th scope=\"col\">{h}</th>"));
        let _ = writeln!(
            out,
            "<h2>{heading}</h2>\n<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{heading}\"><table>\n\
             <tr>{}</tr>",
            headings.concat()
        );
        for k in rows {
            row(out, source, proposal, k);
        }
        out.push_str("</table></div>\n");
    }
}

fn row(out: &mut String, source: &Source, proposal: &Proposal, k: usize) {
    let seam = &proposal.seams[k];
    let class = if seam.confidence < SURE { " class=\"open\"" } else { "" };
    let _ = writeln!(
        out,
        "<tr{class} data-pick=\"seam:{k}\"><td><span class=\"swatch\" style=\"background:{}\"></span>\
         <button class=\"row\" type=\"button\" translate=\"no\">{}</button><small>{}</small></td><td>{}<br>↔ {}</td>\
         <td class=\"n\">{:.0} on {:.0}</td><td class=\"n\">{:.0} %</td></tr>",
        colour(k),
        escaped(&seam.name),
        escaped(&notes(source, proposal, seam)),
        side(source, &seam.a),
        side(source, &seam.b),
        seam.length_a * 1e3,
        seam.length_b * 1e3,
        seam.confidence * 100.0,
    );
}

fn notes(source: &Source, proposal: &Proposal, seam: &ProposedSeam) -> String {
    let mut notes = evidence(seam);
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
