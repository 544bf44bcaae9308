//! Seams that twist the cloth between two pieces. `reverse = false` sews both outlines in the same sense, as of pieces that
//! lie face to face. Where the same two pieces are sewn right side out elsewhere, the cloth between both seams is twisted.
//! A pressed fold may turn one of the pieces over, as the roll line of a lapel does. Then nothing is told.

use super::super::codes;
use toile_garment::sewing::{RunSpec, SeamSpec};
use toile_garment::{Diagnostic, Piece};

/// Findings on the seams that say `reverse = false` between two pieces that another seam joins right side out.
pub fn twisted(seams: &[SeamSpec], all: &[Piece]) -> Vec<Diagnostic> {
    let is_folded = |name: &str| all.iter().any(|p| p.name == name && !p.folds.is_empty());
    let in_one_sense = seams.iter().filter(|s| s.reverse == Some(false));
    let told = in_one_sense.filter_map(|seam| {
        let pieces = pieces(seam).filter(|pieces| !pieces.iter().any(|name| is_folded(name)))?;
        let is_plain = |s: &&SeamSpec| s.reverse != Some(false) && self::pieces(s) == Some(pieces);
        Some(finding(seam, pieces, &seams.iter().find(is_plain)?.name))
    });
    told.collect()
}

fn finding(seam: &SeamSpec, [a, b]: [&str; 2], plain: &str) -> Diagnostic {
    let message = format!(
        "seam `{}` is sewn with `reverse = false`, as if `{a}` and `{b}` lay face to face, and seam `{plain}` sews them right \
         side out: the cloth between both is twisted",
        seam.name
    );
    Diagnostic::warning(codes::SEAM_REVERSED, message)
        .at(seam.source.clone())
        .hint("take `reverse = false` out, unless the twist is meant")
}

/// The two pieces of a seam between whole edges or parts of edges, in the order of their names.
fn pieces(seam: &SeamSpec) -> Option<[&str; 2]> {
    let of = |runs: &'_ [RunSpec]| match runs {
        [RunSpec::Edge { .. } | RunSpec::Part { .. }] => Some(()),
        _ => None,
    };
    of(&seam.a).and(of(&seam.b))?;
    let (a, b) = (seam.a[0].piece(), seam.b[0].piece());
    (a != b).then(|| if a < b { [a, b] } else { [b, a] })
}

#[cfg(test)]
mod tests {
    use super::*;
    use toile_garment::piece::PressedFold;

    fn seam(name: &str, [a, b]: [&str; 2], reverse: Option<bool>) -> SeamSpec {
        let edge = |piece: &str| vec![RunSpec::Edge { piece: piece.into(), edge: "1".into() }];
        SeamSpec {
            name: name.into(),
            a: edge(a),
            b: edge(b),
            ease: None,
            gather: None,
            reverse,
            proposed: None,
            source: None,
        }
    }

    #[test]
    fn one_seam_of_two_that_is_sewn_in_the_same_sense_is_told() {
        let side = seam("side", ["front", "back"], None);
        let turned = seam("shoulder", ["back", "front"], Some(false));
        let both = [side.clone(), turned.clone()];
        let found = twisted(&both, &[]);
        assert!(found.len() == 1 && found[0].message.contains("`shoulder`") && found[0].message.contains("`side`"));
        // A facing lies face to face along all its seams, and another piece tells nothing.
        let facing = seam("facing", ["back", "front"], Some(false));
        assert!(twisted(&[turned, facing], &[]).is_empty());
        assert!(twisted(&[side, seam("yoke", ["back", "yoke"], Some(false))], &[]).is_empty());
        // A lapel rolls over.
        let roll = PressedFold { name: "roll".into(), line: Vec::new(), angle: -3.0, pleat: None };
        let front = Piece { name: "front".into(), folds: vec![roll], ..Piece::default() };
        assert!(twisted(&both, &[front]).is_empty());
    }
}
