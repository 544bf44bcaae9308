//! Undecided darts as findings, with the lines of the sewing file that decide them.

use super::dart::DrawnDart;
use crate::codes::DART_UNDECIDED;
use crate::dxf::garment::M;
use crate::dxf::pattern::Pattern;
use crate::dxf::piece::{DrawnPiece, mm};
use crate::dxf::unfold::Fold;
use crate::rul::RuleTable;
use toile_garment::dart::DartKind;
use toile_garment::sewing::DartSpec;
use toile_garment::{Diagnostic, SourceRef, Vec2};

/// A wedge that may be a dart: its evidence does not decide it.
#[derive(Clone, Debug, PartialEq)]
pub struct UndecidedDart {
    /// The dart as the sewing file would declare it, metres.
    pub spec: DartSpec,
    /// The warning, with the lines of the sewing file that decide it.
    pub finding: Diagnostic,
}

impl Pattern {
    /// The undecided darts of one size, by the names that its pieces have in [`Pattern::to_garment`].
    /// Those of a half piece come with their mirror images.
    ///
    /// # Errors
    /// As [`Pattern::to_garment`].
    pub fn undecided_darts(
        &self,
        size: Option<&str>,
        rul: Option<&RuleTable>,
    ) -> Result<Vec<UndecidedDart>, Vec<Diagnostic>> {
        if self.pieces.iter().all(|p| p.doubts.undecided.is_empty()) {
            return Ok(Vec::new());
        }
        let chosen = self.choose(size, rul)?;
        let mut out = Vec::new();
        for (drawn, name) in chosen.pieces.iter().zip(crate::dxf::garment::names(&chosen.pieces)) {
            for dart in &drawn.doubts.undecided {
                let place = SourceRef { block: Some(drawn.block.clone()), ..SourceRef::file(self.file.clone()) };
                let image = drawn.axes.fold.map(|f| Fold(f).dart(dart));
                for dart in std::iter::once(dart).chain(&image) {
                    let finding = drawn.undecided(&name, dart).at(place.clone().at_line(dart.line));
                    out.push(UndecidedDart { spec: spec(&name, dart), finding });
                }
            }
        }
        Ok(out)
    }
}

fn spec(piece: &str, dart: &DrawnDart) -> DartSpec {
    DartSpec {
        piece: piece.to_owned(),
        name: None,
        apexes: dart.apexes.iter().map(|p| p * M).collect(),
        mouth: dart.mouth.map(|p| p * M),
        kind: Some(DartKind::Wedge),
        press: None,
        sewn: None,
        source: None,
    }
}

impl DrawnPiece {
    /// The warning on a dart that is undecided; `name` is that of the piece in the sewing file.
    pub(super) fn undecided(&self, name: &str, dart: &DrawnDart) -> Diagnostic {
        let text = format!(
            "the wedge at {} of `{name}`, {:.1} mm wide and {:.0} mm long, may be a dart; it was not made one ({})",
            mm(dart.apexes[0]),
            dart.width(),
            dart.leg_chord(0).max(dart.leg_chord(1)),
            if dart.evidence.is_empty() { "nothing marks it".to_owned() } else { dart.reasons().join("; ") },
        );
        let hint = format!(
            "if it is one, write in the sewing file:\n{}\nif it is none, add: kind = \"none\"",
            declaration(name, dart)
        );
        Diagnostic::warning(DART_UNDECIDED, text).hint(hint)
    }
}

/// The lines of the sewing file that declare a dart by its apex and mouth, mm.
pub(super) fn table(piece: &str, apex: Vec2, mouth: [Vec2; 2]) -> String {
    let point = |p: Vec2| format!("[\"{:.3} mm\", \"{:.3} mm\"]", p.x, p.y);
    let name = piece.replace('\\', "\\\\").replace('"', "\\\"");
    let [a, b] = mouth.map(point);
    format!("[[dart]]\npiece = \"{name}\"\napex = {}\nmouth = [{a}, {b}]", point(apex))
}

/// The lines of the sewing file that declare a dart.
pub(super) fn declaration(piece: &str, dart: &DrawnDart) -> String {
    table(piece, dart.apexes[0], dart.mouth)
}
