//! The openings that the sewn garment would have, from above to below. One that should not be there is a seam that is
//! missing.

use crate::new::dress::Dressed;
use crate::new::pattern::Source;
use std::fmt::Write as _;
use toile_formats::svg::canvas::escape as escaped;
use toile_stages::proposal::{Bare, Proposal};

/// Writes the list.
pub fn list(out: &mut String, source: &Source, proposal: &Proposal, dressed: &Dressed) {
    if proposal.openings.is_empty() {
        return;
    }
    let mut openings: Vec<(Option<f64>, &Vec<Bare>)> =
        proposal.openings.iter().map(|o| (height(o, dressed), o)).collect();
    openings.sort_by(|a, b| b.0.unwrap_or_default().total_cmp(&a.0.unwrap_or_default()));
    out.push_str(
        "<h2>Openings</h2>\n<p>These edges stay open. One that should be closed is a seam that is missing.</p>\n\
         <div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Openings\"><table>\n\
         <tr><th scope=\"col\">its edges</th><th scope=\"col\">mm around</th><th scope=\"col\">mm above the floor</th></tr>\n",
    );
    for (height, opening) in openings {
        let around: f64 = opening.iter().map(|b| b.length).sum();
        let above = height.map_or_else(String::new, |y| format!("{:.0}", 1e3 * y));
        // Writing to a String cannot fail.
        let _ = writeln!(
            out,
            "<tr><td>{}</td><td class=\"n\">{:.0}</td><td class=\"n\">{above}</td></tr>",
            escaped(&edges(source, opening)),
            1e3 * around
        );
    }
    out.push_str("</table></div>\n");
}

/// The edges around an opening, each named once.
fn edges(source: &Source, opening: &[Bare]) -> String {
    let mut names: Vec<String> = Vec::new();
    for bare in opening {
        let name = format!("{}.{}", source.garment.pieces[bare.piece].name, bare.edge);
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names.join(", ")
}

/// Mean height of an opening where its pieces lie around the body, metres.
fn height(opening: &[Bare], dressed: &Dressed) -> Option<f64> {
    let (mut sum, mut length) = (0.0, 0.0);
    for bare in opening {
        let place = dressed.arrangement.places.get(bare.piece)?.as_ref()?;
        sum += bare.length * place.sheet.at(bare.middle).y;
        length += bare.length;
    }
    (length > 0.0).then(|| sum / length)
}
