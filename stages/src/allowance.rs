//! Seam allowances as parameters of the stages that read and write patterns.

use crate::codes::PIECE_UNKNOWN;
use crate::drape::SETTING_UNUSED;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use toile_formats::allowance::{self, Allowance, CornerKind};
use toile_formats::codes::{EDGE_UNKNOWN, OUT_OF_RANGE};
use toile_formats::dxf::geom;
use toile_garment::units::Length;
use toile_garment::{Diagnostic, Piece, Vec2};
use toile_stage_api::{StageContext, StageError};

/// How cut lines meet at a corner.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Corners {
    /// They run on until they meet.
    #[default]
    Miter,
    /// Cut straight across.
    Bevel,
    /// An arc.
    Round,
}

/// Seam allowances: the cut line is made from the sew line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AllowanceParams {
    /// Width for all edges that have none of their own, e.g. `"10 mm"`.
    pub width: Length,
    /// Widths for all edges of single pieces, e.g. `{ facing = "6 mm" }`.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub pieces: BTreeMap<String, Length>,
    /// Widths of single edges by piece and number or name, e.g. `{ "front.0" = "40 mm" }`.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub edges: BTreeMap<String, Length>,
    /// Corners.
    #[serde(default)]
    pub corners: Corners,
}

/// Which pieces get a cut line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Which {
    /// Those without one.
    Missing,
    /// All: what is there is replaced.
    All,
}

/// Makes the cut lines where a stage is asked to, and reports what was found.
///
/// # Errors
/// Pieces and edges that are not there, and cut lines that cannot be made.
pub fn add(
    params: Option<&AllowanceParams>,
    pieces: &mut [Piece],
    which: Which,
    cx: &mut StageContext<'_>,
) -> Result<(), StageError> {
    if let Some(params) = params {
        cx.report.findings.extend(apply(params, pieces, which).map_err(StageError::Parameter)?);
    }
    Ok(())
}

/// The faults of the parameters, before a cut line is made. Names are looked for as soon as there are pieces.
pub fn faults(params: Option<&AllowanceParams>, pieces: &[Piece]) -> Vec<Diagnostic> {
    let Some(params) = params else { return Vec::new() };
    let names = if pieces.is_empty() { Vec::new() } else { unknown(params, pieces) };
    names.into_iter().chain(too_wide(params)).collect()
}

/// Makes the cut lines. Notches of lines that are replaced go out to the new one.
fn apply(params: &AllowanceParams, pieces: &mut [Piece], which: Which) -> Result<Vec<Diagnostic>, Vec<Diagnostic>> {
    let mut errors = faults(Some(params), pieces);
    if !errors.is_empty() {
        return Err(errors);
    }
    let (mut findings, mut made) = (Vec::new(), Vec::new());
    let wanted = |p: &Piece| which == Which::All || p.cut_line.is_none();
    for (i, piece) in pieces.iter_mut().enumerate().filter(|(_, p)| wanted(p)) {
        match allowance::cut_line(piece, &of(params, piece)) {
            Ok((line, mut told)) => {
                findings.append(&mut told);
                if which == Which::All {
                    let (sew, cut) = (piece.outline.positions(), line.positions());
                    piece.notches.iter_mut().filter(|n| n.is_on_edge()).for_each(|n| n.at = outward(n.at, &sew, &cut));
                }
                piece.cut_line = Some(line);
                made.push(i);
            }
            Err(error) => errors.push(error),
        }
    }
    allowance::even_sizes(pieces, &made);
    if made.is_empty() && errors.is_empty() && !pieces.is_empty() {
        let text = "`allowance` does nothing: every piece has a sew line of its own";
        let hint = "leave it out; `allowance` of `export-dxf` makes all cut lines anew";
        findings.push(Diagnostic::warning(SETTING_UNUSED, text).hint(hint));
    }
    if errors.is_empty() { Ok(findings) } else { Err(errors) }
}

/// Widths that are none, also of pieces that need no cut line.
fn too_wide(params: &AllowanceParams) -> Option<Diagnostic> {
    let widths = std::iter::once(&params.width).chain(params.pieces.values()).chain(params.edges.values());
    let wrong = widths.map(|w| w.0).find(|w| !(0.0..=allowance::WIDEST).contains(w))?;
    let text = format!("an allowance of {} mm; it must be 0 to {} mm", wrong * 1e3, allowance::WIDEST * 1e3);
    Some(Diagnostic::error(OUT_OF_RANGE, text))
}

fn of(params: &AllowanceParams, piece: &Piece) -> Allowance {
    let width = params.pieces.get(&piece.name).or_else(|| params.pieces.get(piece.base_name()));
    let width = width.unwrap_or(&params.width).0;
    let edges = params.edges.iter().filter_map(|(key, width)| Some((edge(key, piece)?, width.0))).collect();
    let corners = match params.corners {
        Corners::Miter => CornerKind::Miter,
        Corners::Bevel => CornerKind::Bevel,
        Corners::Round => CornerKind::Round,
    };
    Allowance { width, edges, corners }
}

/// The edge of this piece that a key names.
fn edge(key: &str, piece: &Piece) -> Option<u32> {
    let of = |name: &str| key.strip_prefix(name)?.strip_prefix('.');
    let word = of(&piece.name).or_else(|| of(piece.base_name()))?;
    let named = piece.edges.iter().find(|e| e.name.as_deref() == Some(word)).map(|e| e.index);
    named.or_else(|| word.parse().ok().filter(|n| piece.edges.iter().any(|e| e.index == *n)))
}

fn unknown(params: &AllowanceParams, pieces: &[Piece]) -> Vec<Diagnostic> {
    let names: Vec<&str> = pieces.iter().map(|p| p.name.as_str()).collect();
    let is_there = |name: &str| pieces.iter().any(|p| p.name == name || p.base_name() == name);
    let lost_piece = params.pieces.keys().filter(|k| !is_there(k)).map(|k| {
        let text = format!("`allowance.pieces`: there is no piece `{k}`; there are {}", names.join(", "));
        Diagnostic::error(PIECE_UNKNOWN, text)
    });
    let lost_edge = params.edges.keys().filter(|k| pieces.iter().all(|p| edge(k, p).is_none())).map(|k| {
        let hint = "write `piece.number` or `piece.name`; `toile inspect FILE --svg OUT` draws the numbers";
        Diagnostic::error(EDGE_UNKNOWN, format!("`allowance.edges`: there is no edge `{k}`")).hint(hint)
    });
    lost_piece.chain(lost_edge).collect()
}

/// A mark on the sew line, or on a cut line there was, carried to the nearest place of the new cut line.
fn outward(at: Vec2, sew: &[Vec2], cut: &[Vec2]) -> Vec2 {
    let on_sew = nearest(at, sew);
    nearest(on_sew, cut)
}

fn nearest(p: Vec2, ring: &[Vec2]) -> Vec2 {
    let Some(foot) = geom::nearest(p, ring, true) else { return p };
    let (a, b) = (ring[foot.segment], ring[(foot.segment + 1) % ring.len()]);
    a + (b - a) * foot.t
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{rectangle, v};
    use toile_garment::notch::{Notch, NotchKind};

    fn params(edges: &[(&str, f64)]) -> AllowanceParams {
        let edges = edges.iter().map(|(k, w)| ((*k).to_owned(), Length(w * 1e-3))).collect();
        AllowanceParams { width: Length(0.01), pieces: BTreeMap::new(), edges, corners: Corners::Miter }
    }

    #[test]
    fn a_hem_and_a_notch_that_follows() {
        let mut piece = rectangle(0, "front", 300.0, 600.0);
        let notch = Notch {
            kind: NotchKind::Slit,
            at: v(300.0, 200.0),
            depth: 0.005,
            width: 0.0,
            angle: None,
            on: "cut".into(),
            name: None,
            source: None,
        };
        piece.notches.push(notch);
        let mut pieces = [piece];
        apply(&params(&[("front.0", 40.0)]), &mut pieces, Which::All).expect("cut line");
        let cut = pieces[0].cut_line.as_ref().expect("cut line");
        assert!((cut.signed_area() - 0.32 * 0.65).abs() < 1e-9);
        assert!((pieces[0].notches[0].at - v(310.0, 200.0)).norm() < 1e-9);
    }

    #[test]
    fn names_that_are_not_there_are_told() {
        let mut pieces = [rectangle(0, "front", 300.0, 600.0)];
        let mut wrong = params(&[("front.9", 40.0)]);
        wrong.pieces.insert("back".into(), Length(0.01));
        let errors = apply(&wrong, &mut pieces, Which::Missing).expect_err("unknown");
        let codes: Vec<&str> = errors.iter().map(|e| e.code.as_str()).collect();
        assert_eq!(codes, ["piece-unknown", "edge-unknown"]);
    }
}
