//! Copies that are drawn as pieces of their own share the quantity of their piece.

use super::codes;
use std::collections::BTreeSet;
use toile_garment::piece::Quantity;
use toile_garment::{Diagnostic, Garment, Piece, Report};

/// Gives every piece that is drawn with its copies, and the copies, their share of its quantity. A mirrored copy is
/// drawn mirrored, so none of them is cut mirrored.
pub fn share(garment: &Garment, pieces: &mut [Piece], report: &mut Report) {
    // In the order of the plan, each once, wherever its copies stand.
    let mut seen = BTreeSet::new();
    let sources = garment.plan.copies.iter().map(|c| c.piece.as_str());
    for source in sources.filter(|source| seen.insert(*source)) {
        let copies = garment.plan.copies.iter().filter(|c| c.piece == source).map(|c| c.name.as_str());
        let names: Vec<&str> = std::iter::once(source).chain(copies).collect();
        let drawn: Vec<usize> = names.iter().filter_map(|n| pieces.iter().position(|p| p.name == *n)).collect();
        if drawn.len() < 2 {
            continue;
        }
        let whole = pieces[drawn[0]].quantity;
        let (total, count) = (whole.plain.saturating_add(whole.mirrored), drawn.len() as u32);
        let each = (total / count).max(1);
        drawn.iter().for_each(|k| pieces[*k].quantity = Quantity { plain: each, mirrored: 0 });
        report.push(told(&names, total, each));
    }
}

fn told(names: &[&str], total: u32, each: u32) -> Diagnostic {
    let count = names.len() as u32;
    let words = format!("`{}` and its copies {} are drawn as pieces of their own", names[0], names[1..].join(", "));
    let are = if each == 1 { "is" } else { "are" };
    let hint = "texts in the file that tell how often to cut stay as they were";
    if total == each * count {
        Diagnostic::info(codes::QUANTITY_SHARED, format!("{words}: {each} of each {are} cut, {total} in all"))
            .hint(hint)
    } else {
        let now = each * count;
        let message = format!("{words}: {each} of each {are} cut, {now} in all instead of {total}");
        Diagnostic::warning(codes::QUANTITY_SHARED, message).hint(hint)
    }
}
