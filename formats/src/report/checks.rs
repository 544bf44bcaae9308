//! Checks of a flattened piece are told here in words that exist in every language of the page.

use super::words::Phrase;
use toile_garment::flat::{Check, CheckKind};

/// The change as [`Check::words`] tells it.
pub fn phrase(check: &Check) -> Phrase {
    let (place, mm) = (check.place.clone(), 1e3 * check.value);
    let [change, size] = [format!("{mm:+.2}"), format!("{:.2}", mm.abs())];
    let turn = format!("{:+.2}", check.value.to_degrees());
    let along = check.along.map(|s| format!("{:.0}", 1e3 * s));
    // With its way from the start where that is known.
    let from_start = |[plain, along_words]: [&'static str; 2], change: String| match along.clone() {
        Some(along) => Phrase::new(along_words, [place.clone(), change, along]),
        None => Phrase::new(plain, [place.clone(), change]),
    };
    // A notch with its label.
    let named = |words: &'static str, change: &String| {
        let along = along.clone().filter(|_| !check.notch.is_empty())?;
        Some(Phrase::new(words, [check.place.clone(), change.clone(), along, check.notch.clone()]))
    };
    match check.kind {
        CheckKind::Area => Phrase::new("area {0} %", [format!("{:+.2}", 100.0 * check.value)]),
        CheckKind::Edge => Phrase::new("{0} {1} mm", [place, change]),
        CheckKind::Seam => from_start(SEAM, size),
        CheckKind::DartIntake => Phrase::new("intake of dart `{0}` {1} mm", [place, change]),
        CheckKind::DartLegs => Phrase::new("legs of dart `{0}` differ by {1} mm", [place, size]),
        CheckKind::Notch => named(NAMED_NOTCH, &change).unwrap_or_else(|| from_start(NOTCH, change)),
        CheckKind::NotchPartner => named(NAMED_PARTNER, &size).unwrap_or_else(|| from_start(NOTCH_PARTNER, size)),
        CheckKind::Corner => Phrase::new("{0} turned by {1}°", [place, turn]),
        CheckKind::Bow => Phrase::new("{0}, once straight, bows by {1} mm", [place, size]),
        CheckKind::Symmetry if place.is_empty() => Phrase::new("{0} mm off its own mirror image", [size]),
        CheckKind::Symmetry => Phrase::new("{1} mm off the mirror image of `{0}`", [place, size]),
        CheckKind::Grain => Phrase::new("grain turned by {0}°", [turn]),
        CheckKind::Overlap => Phrase::new("its outline crosses itself at {0} places", [format!("{:.0}", check.value)]),
        CheckKind::Strain => {
            Phrase::new("laid flat it is strained by {0} %", [format!("{:.0}", 100.0 * check.value.abs())])
        }
    }
}

const SEAM: [&str; 2] =
    ["seam `{0}` {1} mm off its partner", "seam `{0}` {1} mm off its partner, {2} mm from its start"];
const NOTCH: [&str; 2] = ["a notch on {0} moved by {1} mm", "a notch on {0} moved by {1} mm, {2} mm from its start"];
const NOTCH_PARTNER: [&str; 2] = [
    "a notch of seam `{0}` {1} mm off its partner",
    "a notch of seam `{0}` {1} mm off its partner, {2} mm from its start",
];
const NAMED_NOTCH: &str = "notch `{3}` on {0} moved by {1} mm, {2} mm from its start";
const NAMED_PARTNER: &str = "notch `{3}` of seam `{0}` {1} mm off its partner, {2} mm from its start";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::Language;

    #[test]
    fn a_phrase_says_in_english_what_the_check_says() {
        use CheckKind as K;
        let kinds =
            [K::Area, K::Edge, K::Seam, K::DartIntake, K::DartLegs, K::Notch, K::NotchPartner, K::Corner, K::Bow];
        for kind in kinds.into_iter().chain([K::Symmetry, K::Grain, K::Overlap, K::Strain]) {
            for (place, along, notch) in [("side", Some(0.212), ""), ("", None, ""), ("edge 4", Some(0.1), "FRONT.n3")]
            {
                let notch = if matches!(kind, K::Notch | K::NotchPartner) { notch.to_owned() } else { String::new() };
                let check = Check { kind, place: place.into(), notch, along, value: -0.0018, limit: None };
                let phrase = phrase(&check);
                assert_eq!(Language::English.phrases(std::slice::from_ref(&phrase)), check.words());
                let chinese = Language::Chinese.say(phrase.words);
                assert!(kind == K::Edge || chinese != phrase.words, "{}", phrase.words);
            }
        }
    }
}
