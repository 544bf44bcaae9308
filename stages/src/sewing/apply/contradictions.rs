//! Tables of a sewing file that speak of one thing twice. One would be left out in silence, so they are refused.

use super::darts::is_one_mouth;
use crate::sewing::codes;
use toile_garment::sewing::{DartSpec, SewingPlan};
use toile_garment::{Diagnostic, SourceRef};

/// All tables that say of a piece or dart what another table says already. Names of pieces are those of the pieces.
pub fn check(plan: &SewingPlan) -> Vec<Diagnostic> {
    let places = plan.places.iter().map(|p| (&p.piece, p.source.as_ref()));
    let layers = plan.layers.iter().flat_map(|l| l.pieces.iter().map(|piece| (piece, l.source.as_ref())));
    let mut found = twice("place", &places.collect::<Vec<_>>());
    found.extend(twice("layer", &layers.collect::<Vec<_>>()));
    found.extend(darts(&plan.darts));
    found
}

/// Where another table stands, as words behind its name.
pub fn written(source: Option<&SourceRef>) -> String {
    source.and_then(|s| s.line).map_or_else(String::new, |line| format!(" (line {line})"))
}

/// Pieces that two tables of one kind name.
fn twice(table: &str, said: &[(&String, Option<&SourceRef>)]) -> Vec<Diagnostic> {
    let again = |(k, (piece, source)): (usize, &(&String, Option<&SourceRef>))| {
        let (_, first) = said[..k].iter().find(|(other, _)| other == piece)?;
        let message = format!("piece `{piece}` has a second [[{table}]]; the first one is another{}", written(*first));
        let hint = format!("keep one [[{table}]] for the piece, and remove it from the other");
        Some(Diagnostic::error(codes::TABLES_CONTRADICT, message).at(source.cloned()).hint(hint))
    };
    said.iter().enumerate().filter_map(again).collect()
}

/// Tables of darts that name one mouth, or give one name to two darts of a piece.
fn darts(darts: &[DartSpec]) -> Vec<Diagnostic> {
    let again = |(k, dart): (usize, &DartSpec)| {
        let mut before = darts[..k].iter().filter(|d| d.piece == dart.piece);
        let named = |d: &&DartSpec| d.name.is_some() && d.name == dart.name;
        let first = before.find(|d| is_one_mouth(&d.mouth, &dart.mouth) || named(d))?;
        let line = written(first.source.as_ref());
        let message = match is_one_mouth(&first.mouth, &dart.mouth) {
            true if first.kind.is_some() != dart.kind.is_some() => {
                format!(
                    "piece `{}`: a dart is declared and denied: two [[dart]] tables have its mouth{line}",
                    dart.piece
                )
            }
            true => format!("piece `{}`: two [[dart]] tables have one mouth{line}", dart.piece),
            false => {
                let name = dart.name.as_deref().unwrap_or_default();
                format!("piece `{}` has two darts called `{name}`{line}", dart.piece)
            }
        };
        let hint = "remove one of the tables, or give the second dart a mouth and a name of its own";
        Some(Diagnostic::error(codes::TABLES_CONTRADICT, message).at(dart.source.clone()).hint(hint))
    };
    darts.iter().enumerate().filter_map(again).collect()
}
