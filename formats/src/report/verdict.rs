//! Passed or not, and why, in one sentence.

use super::words::Language;
use crate::svg::canvas::fixed;
use toile_garment::garment::Certificate;
use toile_garment::seam::SeamKind;
use toile_garment::{Diagnostic, Garment, Severity};

/// The sentence and its kind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Verdict {
    /// `Some(true)`: the drape passed. `None`: nothing was draped, and nothing failed.
    pub passed: Option<bool>,
    /// One word.
    pub word: String,
    /// Why.
    pub why: String,
}

/// The verdict on a garment with the findings of its run.
#[must_use]
pub fn verdict(garment: &Garment, findings: &[Diagnostic], language: Language) -> Verdict {
    let error = findings.iter().find(|f| f.severity == Severity::Error);
    let (passed, word, why) = match (&garment.certificate, error) {
        (Some(c), _) if !c.passed => {
            (Some(false), "Not passed.", format!("{}.", reasons(c, garment, language).join("; ")))
        }
        (_, Some(error)) => {
            let what = language.finding(&error.code).map(|[what, _]| what);
            (Some(false), "Failed.", what.unwrap_or(&error.message).to_owned())
        }
        (Some(c), None) => {
            let allowed = c.limits.get("strain_over_limit").copied().unwrap_or(1.0);
            let [strain, allowed] = [c.strain_over_limit, allowed].map(|x| fixed(100.0 * x, 0));
            (Some(true), "Passed.", language.fill(SOUND, &[strain, allowed]))
        }
        (None, None) => match origin(garment) {
            Some(origin) => (None, "Not certified.", uncertified(garment, origin, language)),
            None => (None, "Not draped.", language.say(NOTHING).to_owned()),
        },
    };
    Verdict { passed, word: language.say(word).to_owned(), why }
}

const SOUND: &str = "The garment came to rest, its seams and darts are closed, nothing crosses, and the largest strain \
                     is {0} % of what the fabric bears ({1} % are allowed).";

const NOTHING: &str = "There is no drape and so no certificate; this page shows the garment as far as it was made.";

const EDITED: &str =
    "This shape was edited or moved after its drape and was not draped again, so nothing certifies it.";

const READ: &str = "This shape was read from a file and was not draped here, so nothing certifies it.";

/// How a shape came about that no drape made.
fn origin(garment: &Garment) -> Option<&'static str> {
    let shape = if garment.drape_before_edit.is_some() { EDITED } else { READ };
    garment.drape.as_ref().map(|_| shape)
}

/// Why there is no certificate, and what the flattening of the shape came to.
fn uncertified(garment: &Garment, origin: &str, language: Language) -> String {
    let flattened = garment.flat.as_ref().map(|flat| match flat.over_tolerance {
        Some(0) => language.say("Its flattened pieces are within all tolerances that were asked for.").to_owned(),
        Some(n) => language.fill("Its flattened pieces have {0} changes over their tolerance.", &[n.to_string()]),
        None => language.say("Its pieces were flattened; no tolerance was asked for.").to_owned(),
    });
    let space = if language == Language::Chinese { "" } else { " " };
    [Some(language.say(origin).to_owned()), flattened].into_iter().flatten().collect::<Vec<_>>().join(space)
}

/// A figure, the name of its limit, the words for both, what they are multiplied by, and their decimals.
type Gate = (f64, &'static str, &'static str, f64, usize);

/// The words for each gate of a motion. Its crossings are counted with those of the drape.
const MOTION_GATES: [(&str, &str); 3] = [
    ("stretch_max", "in motion the largest strain is {0} %, {1} % are allowed"),
    ("energy_gain", "in motion {0} % of the energy come from nothing, {1} % are allowed"),
    ("fall_error", "a free fall is off by {0} % of its length, {1} % are allowed"),
];

/// The gates of the garment's motion that did not hold, in words.
fn reasons_of_motion(garment: &Garment, language: Language) -> Vec<String> {
    let certificate = garment.animation.as_ref().and_then(|a| a.certificate.as_ref());
    let failures = certificate.map(|c| c.failures()).unwrap_or_default();
    let in_words = |(name, value, limit): (&str, f64, f64)| {
        let words = MOTION_GATES.iter().find(|(gate, _)| *gate == name)?.1;
        Some(language.fill(words, &[value, limit].map(|v| fixed(100.0 * v, 0))))
    };
    failures.into_iter().filter_map(in_words).collect()
}

/// So many times its limit is as much as is told of a figure.
const WILD: f64 = 1e4;

/// The name of the seam that is open widest in the drape.
fn widest_seam(garment: &Garment) -> String {
    let positions = garment.drape.as_ref().map_or(&[][..], |shape| &shape.positions);
    let widest = garment.widest_gap(positions, |s| s.kind == SeamKind::Seam);
    widest.map_or_else(String::new, |(seam, _)| toile_garment::text::quoted(&seam.name))
}

/// The gates of the drape and of the motion that did not hold, in words.
fn reasons(c: &Certificate, garment: &Garment, language: Language) -> Vec<String> {
    let widest = widest_seam(garment);
    let [crossings, body] = [c.self_crossings, c.body_crossings].map(|n| n as f64);
    let gates: [Gate; 9] = [
        (
            c.residual_rel,
            "residual_rel",
            "forces of {0} times the weight of the cloth are left, {1} are allowed",
            1.0,
            3,
        ),
        (
            c.strain_over_limit,
            "strain_over_limit",
            "the cloth is stretched to {0} % of what the fabric bears, {1} % are allowed",
            100.0,
            0,
        ),
        (c.strain_max, "strain_max", "the largest strain is {0} %, {1} % are allowed", 100.0, 2),
        (c.slip_mm, "slip_mm", "the garment slid down by {0} mm, {1} mm are allowed", 1.0, 0),
        (c.seam_gap_max_mm, "seam_gap_max_mm", "the seam {2} is open by {0} mm, {1} mm are allowed", 1.0, 2),
        (c.dart_gap_max_mm, "dart_gap_max_mm", "a dart is open by {0} mm, {1} mm are allowed", 1.0, 2),
        (crossings, "self_crossings", "the cloth crosses itself at {0} places", 1.0, 0),
        (body, "body_crossings", "cloth and body cross at {0} places", 1.0, 0),
        (c.penetration_max_mm, "penetration_max_mm", "cloth lies {0} mm deep in the body", 1.0, 2),
    ];
    let broken = |(x, name, words, times, decimals): &Gate| {
        let limit = c.limits.get(*name).filter(|l| *x > **l)?;
        // A wild figure says no more than that.
        let most = limit * WILD;
        let told =
            if most > 0.0 && *x > most { format!("> {}", fixed(most * times, 0)) } else { fixed(x * times, *decimals) };
        Some(language.fill(words, &[told, fixed(limit * times, *decimals), widest.clone()]))
    };
    let mut out: Vec<String> = gates.iter().filter_map(broken).collect();
    out.extend(reasons_of_motion(garment, language));
    if !c.unheld.is_empty() {
        out.insert(0, language.fill("nothing holds {0}", &[c.unheld.join(", ")]));
    }
    if !c.settled {
        out.insert(0, language.say("the garment did not come to rest").to_owned());
    }
    if out.is_empty() {
        out.push(language.say("a gate of the certificate did not hold").to_owned());
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::codes::OUT_OF_RANGE;
    use toile_garment::animation::{Animation, MotionCertificate};

    #[test]
    fn a_verdict_names_what_failed() {
        let limits = [("self_crossings".to_owned(), 0.0), ("slip_mm".to_owned(), 100.0)].into();
        let c = Certificate { settled: true, self_crossings: 3, slip_mm: 20.0, limits, ..Certificate::default() };
        let garment = Garment { certificate: Some(c.clone()), ..Garment::default() };
        assert_eq!(verdict(&garment, &[], Language::English).why, "the cloth crosses itself at 3 places.");
        let limits = [("residual_rel".to_owned(), 0.1)].into();
        let wild = Certificate { settled: true, residual_rel: 127_288_814.563, limits, ..Certificate::default() };
        let why = verdict(&Garment { certificate: Some(wild), ..Garment::default() }, &[], Language::English).why;
        assert_eq!(why, "forces of > 1000 times the weight of the cloth are left, 0.100 are allowed.");
        let good = Garment { certificate: Some(Certificate { passed: true, ..c }), ..Garment::default() };
        assert_eq!(verdict(&good, &[], Language::English).passed, Some(true));
        let error = [Diagnostic::error(OUT_OF_RANGE, "no start was found")];
        assert_eq!(verdict(&Garment::default(), &error, Language::English).why, "no start was found");
        assert_eq!(verdict(&Garment::default(), &[], Language::English).passed, None);
    }

    #[test]
    fn a_verdict_names_the_seam_that_is_open_widest() {
        use toile_garment::garment::Shape;
        use toile_garment::seam::{Seam, SeamSide, Stitch};
        use toile_garment::{MeshVertex, PieceId, SeamId, Vec3};
        let vertex = |vertex: u32| MeshVertex { piece: PieceId::from(0), vertex };
        let seam = |id: usize, name: &str, [a, b]: [u32; 2]| Seam {
            id: SeamId::from(id),
            name: name.to_owned(),
            kind: SeamKind::Seam,
            a: SeamSide::default(),
            b: SeamSide::default(),
            ease: 0.0,
            gather: None,
            stitches: vec![Stitch { a: vertex(a), b: vertex(b) }],
            source: None,
        };
        let at = |x: f64| Vec3::new(x, 0.0, 0.0);
        let drape = Shape { positions: vec![vec![at(0.0), at(0.001), at(0.25)]], ..Shape::default() };
        let limits = [("seam_gap_max_mm".to_owned(), 0.1)].into();
        let c = Certificate { settled: true, seam_gap_max_mm: 249.0, limits, ..Certificate::default() };
        let garment = Garment {
            seams: vec![seam(0, "hem", [0, 1]), seam(1, "side seam", [1, 2])],
            drape: Some(drape),
            certificate: Some(c),
            ..Garment::default()
        };
        let why = verdict(&garment, &[], Language::English).why;
        assert_eq!(why, "the seam \"side seam\" is open by 249.00 mm, 0.10 mm are allowed.");
    }

    #[test]
    fn a_shape_that_was_edited_is_not_certified_and_its_flattening_is_told() {
        use toile_garment::flat::Flat;
        use toile_garment::garment::Shape;
        let drape = Some(Shape::default());
        let certificate = Some(Certificate { passed: true, ..Certificate::default() });
        let mut garment = Garment { drape, certificate, ..Garment::default() };
        garment.reshape(Shape::default());
        let told = |garment: &Garment| verdict(garment, &[], Language::English);
        assert_eq!((told(&garment).passed, told(&garment).word.as_str()), (None, "Not certified."));
        assert_eq!(told(&garment).why, EDITED);
        garment.flat = Some(Flat { over_tolerance: Some(2), ..Flat::default() });
        assert!(told(&garment).why.ends_with("have 2 changes over their tolerance."));
        garment.drape_before_edit = None;
        assert!(told(&garment).why.starts_with(READ));
    }

    #[test]
    fn a_verdict_names_the_gate_of_a_motion() {
        let limits = [("stretch_max".to_owned(), 0.42)].into();
        let motion = MotionCertificate { stretch_max: 1.83, limits, ..MotionCertificate::default() };
        let animation = Animation { certificate: Some(motion), ..Animation::default() };
        let drape = Certificate { settled: true, ..Certificate::default() };
        let garment = Garment { certificate: Some(drape), animation: Some(animation), ..Garment::default() };
        let why = verdict(&garment, &[], Language::English).why;
        assert_eq!(why, "in motion the largest strain is 183 %, 42 % are allowed.");
    }
}
