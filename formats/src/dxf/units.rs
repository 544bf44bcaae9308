//! Millimetres per file unit: declared, guessed, and checked against the size of the pieces.

use super::codes;
use super::findings::Findings;
use super::texts;
use toile_garment::Diagnostic;

/// A piece's larger side, mm, is expected in this range.
const SIDE: std::ops::RangeInclusive<f64> = 50.0..=2000.0;
/// The largest piece of a file is hardly ever smaller than this, mm.
const LARGEST_LEAST: f64 = 100.0;
/// No file holds nothing but pieces smaller than this, mm.
const SIDE_LEAST: f64 = 5.0;
/// Curve tolerances are 0.006 inch, 0.0152 cm or 0.152 mm: smaller ones are inches, larger ones millimetres.
const INCH_TOLERANCE: f64 = 0.012;
/// See [`INCH_TOLERANCE`].
const MM_TOLERANCE: f64 = 0.05;
/// No piece is larger than this, mm.
const SIDE_MOST: f64 = 5000.0;

/// The unit of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Units {
    /// The word of the style text, e.g. `METRIC`.
    pub declared: Option<String>,
    /// The unit that was used, mm.
    pub mm_per_unit: f64,
    /// Length of the largest piece, mm, where the unit is a guess that gives no garment of a usual size.
    pub unlikely_guess: Option<f64>,
}

impl Units {
    /// The unit has to be confirmed before anything is made of the pieces.
    pub(crate) fn unconfirmed(&self) -> Option<Diagnostic> {
        let largest = self.unlikely_guess?;
        let text = format!(
            "the file names no unit, and in {} its largest piece is {largest:.0} mm long, which no garment is",
            name(self.mm_per_unit)
        );
        let hint = "give the unit: units = \"mm\", \"cm\", \"inch\" or \"m\"";
        Some(Diagnostic::error(codes::UNITS_UNCONFIRMED, text).hint(hint))
    }
}

/// The evidence to judge by.
pub(crate) struct Evidence<'a> {
    /// The user's own word, mm per unit.
    pub asked: Option<f64>,
    /// Value of the text `Units:`.
    pub text: Option<&'a str>,
    /// The word of a second text `Units:`.
    pub other: Option<String>,
    /// `$INSUNITS`.
    pub insunits: Option<i64>,
    /// Unit of the rule table.
    pub rules: Option<&'a str>,
    /// Value of the text `Tolerance:`.
    pub tolerance: Option<f64>,
    /// Larger side of the largest piece, file units.
    pub side: f64,
}

/// Decides on the unit of a file, and tells what was guessed, doubtful or contradicts.
pub(crate) fn decide(evidence: &Evidence<'_>, findings: &mut Findings) -> Units {
    let place = findings.place(1);
    let mut say = |f: Diagnostic| findings.push(f.at(place.clone()));
    let mut unlikely_guess = None;
    let mm_per_unit = match evidence.asked {
        Some(asked) => asked,
        None => match stated(evidence, &mut say) {
            Some(mm) => checked(mm, evidence.side, &mut say),
            None => {
                let guess = guessed(evidence, &mut say);
                let largest = evidence.side * guess;
                let is_usual = (LARGEST_LEAST..=SIDE_MOST).contains(&largest);
                unlikely_guess = Some(largest).filter(|_| evidence.side > 0.0 && !is_usual);
                guess
            }
        },
    };
    Units { declared: evidence.text.map(str::to_owned), mm_per_unit, unlikely_guess }
}

/// Millimetres per unit as the file states it: by its text, else by its header.
fn stated(evidence: &Evidence<'_>, say: &mut impl FnMut(Diagnostic)) -> Option<f64> {
    let from_text = evidence.text.and_then(texts::unit);
    if let (Some(text), None) = (evidence.text, from_text) {
        say(Diagnostic::warning(codes::UNITS_UNKNOWN, format!("the text `Units: {text}` names no known unit")));
    }
    let from_header = match evidence.insunits {
        Some(1) => Some(25.4),
        Some(2) => Some(304.8),
        Some(4) => Some(1.0),
        Some(5) => Some(10.0),
        Some(6) => Some(1000.0),
        _ => None,
    };
    let stated = from_text.zip(evidence.text).into_iter().map(|(mm, t)| (mm, format!("`Units: {t}`")));
    let stated = stated.chain(evidence.other.iter().filter_map(|t| Some((texts::unit(t)?, format!("`Units: {t}`")))));
    let stated: Vec<(f64, String)> =
        stated.chain(from_header.map(|mm| (mm, format!("$INSUNITS ({})", name(mm))))).collect();
    if let [(first, said), others @ ..] = stated.as_slice()
        && let Some((_, other)) = others.iter().find(|(mm, _)| mm != first)
    {
        let text = format!("the file says {said} and also {other}; {said} counts");
        say(Diagnostic::info(codes::UNITS_CONTRADICT, text).hint("give the unit: units = \"mm\" or \"inch\""));
    }
    from_text.or(from_header).or_else(|| from_rules(evidence, say))
}

/// The unit of the rule table, where the pattern itself names none.
fn from_rules(evidence: &Evidence<'_>, say: &mut impl FnMut(Diagnostic)) -> Option<f64> {
    let (mm, text) = evidence.rules.and_then(|t| Some((texts::unit(t)?, t)))?;
    let text = format!("the pattern names no unit; its rule table says `UNITS: {text}`, which was taken for both");
    say(Diagnostic::info(codes::UNITS_FROM_RULES, text));
    Some(mm)
}

/// The unit that makes the pieces as large as pieces are.
fn guessed(evidence: &Evidence<'_>, say: &mut impl FnMut(Diagnostic)) -> f64 {
    let guess = guess(evidence.side, evidence.tolerance);
    let text = format!(
        "the file names no unit; {} was taken because the largest piece is then {:.0} mm long",
        name(guess),
        evidence.side * guess
    );
    let others: Vec<String> = [1.0, 10.0, 25.4, 1000.0]
        .into_iter()
        .filter(|u| *u != guess && SIDE.contains(&(evidence.side * u)))
        .map(|u| format!("{:.0} mm in {}", evidence.side * u, name(u)))
        .collect();
    let or = if others.is_empty() { String::new() } else { format!("; it would be {}", others.join(", ")) };
    let finding = Diagnostic::warning(codes::UNITS_GUESSED, format!("{text}{or}"));
    say(finding.hint("give the unit: units = \"mm\", \"cm\", \"inch\" or \"m\""));
    guess
}

/// A stated unit, or a better one where it makes the pieces impossibly large or small.
fn checked(mm: f64, side: f64, say: &mut impl FnMut(Diagnostic)) -> f64 {
    if side * mm > SIDE_MOST {
        let better = [1.0, 10.0, 25.4].into_iter().filter(|u| *u < mm).rev().find(|u| SIDE.contains(&(side * u)));
        if let Some(better) = better {
            let text = format!(
                "the file says {}, but a piece would be {:.1} m long; {} was used instead ({:.0} mm)",
                name(mm),
                side * mm / 1000.0,
                name(better),
                side * better
            );
            say(Diagnostic::warning(codes::UNITS_DOUBTFUL, text).hint("give the unit: units = \"mm\" or \"inch\""));
            return better;
        }
    }
    if side > 0.0 && side * mm < SIDE_LEAST && SIDE.contains(&(side * 1000.0)) {
        let text = format!(
            "the file says {}, but its largest piece would be {:.2} mm long; metres were used instead ({:.0} mm)",
            name(mm),
            side * mm,
            side * 1000.0
        );
        say(Diagnostic::warning(codes::UNITS_DOUBTFUL, text).hint("give the unit: units = \"mm\" or \"m\""));
        return 1000.0;
    }
    if side > 0.0 && (side * mm > SIDE_MOST || side * mm < LARGEST_LEAST) {
        let text = format!(
            "the file says {}, which makes its largest piece {:.1} mm long; that was obeyed, but it is unlikely",
            name(mm),
            side * mm
        );
        say(Diagnostic::warning(codes::UNITS_DOUBTFUL, text).hint("give the unit: units = \"mm\", \"cm\" or \"inch\""));
    }
    mm
}

/// The largest piece of a file in inches or centimetres measures 50 to 100 units, in millimetres hardly ever. The
/// tolerance of the curves tells the three apart; without one it is centimetres. In metres it measures less than 2.
fn guess(side: f64, tolerance: Option<f64>) -> f64 {
    let inch = |t: f64| t > 0.0 && t < INCH_TOLERANCE;
    let small = side < LARGEST_LEAST && SIDE.contains(&side);
    match tolerance {
        // 50 to 79 units could be inches of a coat.
        Some(t) if small && side < 79.0 && inch(t) => 25.4,
        Some(t) if small && t >= MM_TOLERANCE => 1.0,
        _ if small => 10.0,
        _ if SIDE.contains(&side) => 1.0,
        _ if SIDE.contains(&(side * 25.4)) => 25.4,
        _ if SIDE.contains(&(side * 1000.0)) => 1000.0,
        _ => 1.0,
    }
}

fn name(mm: f64) -> &'static str {
    match mm {
        25.4 => "inches",
        10.0 => "centimetres",
        1000.0 => "metres",
        304.8 => "feet",
        _ => "millimetres",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mm(text: Option<&str>, insunits: Option<i64>, side: f64) -> (f64, usize) {
        let mut findings = Findings::new("t.dxf");
        let e = Evidence { asked: None, text, other: None, insunits, rules: None, tolerance: None, side };
        let units = decide(&e, &mut findings);
        (units.mm_per_unit, findings.finish().len())
    }

    #[test]
    fn tolerance_and_rule_table_tell_the_unit() {
        let decided = |rules: Option<&str>, tolerance: Option<f64>, side: f64| {
            let mut findings = Findings::new("t.dxf");
            let e = Evidence { asked: None, text: None, other: None, insunits: None, rules, tolerance, side };
            (decide(&e, &mut findings).mm_per_unit, findings.finish().remove(0).code)
        };
        assert_eq!(decided(None, Some(0.006), 60.0), (25.4, "units-guessed".into()));
        assert_eq!(decided(None, Some(0.0152), 60.0), (10.0, "units-guessed".into()));
        assert_eq!(decided(None, Some(0.152), 60.0), (1.0, "units-guessed".into()));
        assert_eq!(decided(Some("ENGLISH"), None, 26.0), (25.4, "units-from-rules".into()));
        assert_eq!(decided(Some("METRIC"), None, 600.0), (1.0, "units-from-rules".into()));
        assert_eq!(decided(Some("CM"), None, 66.0), (10.0, "units-from-rules".into()));
    }

    #[test]
    fn a_guess_that_gives_no_garment_must_be_confirmed() {
        let decided = |asked: Option<f64>, text: Option<&str>, tolerance: Option<f64>, side: f64| {
            let e = Evidence { asked, text, other: None, insunits: None, rules: None, tolerance, side };
            decide(&e, &mut Findings::new("t.dxf"))
        };
        // Metres are as likely as any unit.
        for side in [0.3, 0.66, 1.08] {
            let units = decided(None, None, None, side);
            assert_eq!((units.mm_per_unit, units.unlikely_guess), (1000.0, None), "{side}");
        }
        // A tolerance in millimetres makes a garment 66 mm long; feet are too rare to be guessed.
        let small = decided(None, None, Some(0.152), 66.0);
        assert_eq!((small.mm_per_unit, small.unlikely_guess), (1.0, Some(66.0)));
        let finding = small.unconfirmed().expect("an error");
        assert_eq!((finding.code.as_str(), finding.severity), ("units-unconfirmed", toile_garment::Severity::Error));
        for side in [3.5, 0.01, 8000.0] {
            assert!(decided(None, None, None, side).unconfirmed().is_some(), "{side}");
        }
        // The user's word and that of the file are taken.
        assert!(decided(Some(1.0), None, Some(0.152), 66.0).unconfirmed().is_none());
        assert!(decided(None, Some("METRIC"), Some(0.152), 66.0).unconfirmed().is_none());
    }

    #[test]
    fn trust_in_order() {
        assert_eq!(mm(Some("METRIC"), Some(4), 600.0), (1.0, 0));
        assert_eq!(mm(Some("METRIC"), Some(1), 600.0), (1.0, 1));
        assert_eq!(mm(None, Some(2), 2.0), (304.8, 0));
        assert_eq!(mm(Some("METRIC"), None, 0.6), (1000.0, 1));
        assert_eq!(mm(Some("ENGLISH"), None, 24.0), (25.4, 0));
        assert_eq!(mm(None, Some(5), 60.0), (10.0, 0));
        assert_eq!(mm(None, None, 600.0), (1.0, 1));
        assert_eq!(mm(None, None, 24.0), (25.4, 1));
        for side in [58.0, 66.0, 99.0] {
            assert_eq!(mm(None, None, side), (10.0, 1), "no garment is {side} mm long");
        }
        assert_eq!(mm(None, None, 105.0), (1.0, 1));
        assert_eq!(mm(Some("ENGLISH"), None, 600.0), (1.0, 1));
        assert_eq!(mm(Some("METRIC"), None, 24.0), (1.0, 1));
    }
}
