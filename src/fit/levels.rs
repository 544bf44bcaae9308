//! Heights at which ease is asked for and measured.

use super::Order;
use super::codes::{FIT_EASE, FIT_NO_MEASURE, FIT_NOT_REACHED};
use crate::halt::Halt;
use std::collections::BTreeMap;
use toile_garment::body::Body;
use toile_garment::{Diagnostic, Garment};
use toile_stages::fit::measure;
use toile_stages::transfer::LEVELS;

/// Largest negative ease, as a share of the body's girth. Knitted bands have about a tenth.
const LARGEST_NEGATIVE_EASE: f64 = 0.25;

/// An ease that is further from what is asked was measured on other cloth: a transfer is never so far off, metres.
const JUMP: f64 = 0.06;

/// The reason why heights cannot have each its own ease.
const HELD: &str =
    "; straight edges and right angles are held, and `--lock seams,grain,pleats` lets them follow the body";

/// Ease at one height, metres.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Name.
    pub name: String,
    /// Girth of the body that the garment was made for.
    pub own_body: f64,
    /// Ease on that body.
    pub own_ease: f64,
    /// Girth of the new body.
    pub body: f64,
    /// Ease that is asked for.
    pub asked: f64,
    /// Ease of the pattern that is written.
    pub ease: f64,
    /// False where the measure jumped to other cloth, such as the bag of a pocket, so that nothing is corrected by it.
    pub is_followed: bool,
}

/// Ease by height after one round, metres.
pub type Round = BTreeMap<String, f64>;

/// Is the ease of a level as asked?
pub fn is_reached(level: &Level, order: &Order) -> bool {
    level.is_followed && (level.asked - level.ease).abs() <= order.within
}

/// The ease that each height shall have.
///
/// # Errors
/// When the garment has no ease that can be measured, or cannot have the one that is asked for.
pub fn asked(order: &Order, own: &Garment, body: &Body) -> Result<Vec<Level>, Halt> {
    let measured = measure(own).levels;
    let level = |l: &toile_formats::report::Level| {
        let (name, own_body, own_ease) = (l.name.clone(), l.body?, l.ease()?);
        let asked = order.ease.get(&name).copied().unwrap_or(own_ease);
        let at = toile_stages::fit::level_height(&name, body)?;
        let girth = toile_stages::body::girth_at(body, at);
        LEVELS.contains(&name.as_str()).then_some(Level {
            name,
            own_body,
            own_ease,
            body: girth,
            asked,
            ease: f64::NAN,
            is_followed: true,
        })
    };
    let levels: Vec<Level> = measured.iter().filter_map(level).collect();
    let slim = levels.iter().find(|l| l.asked < -LARGEST_NEGATIVE_EASE * l.body);
    if let Some(l) = slim {
        let message =
            format!("an ease of {:.0} mm at the {} is asked, of {:.0} mm of body", 1e3 * l.asked, l.name, 1e3 * l.body);
        let hint =
            "cloth is stretched by a fourth of its length at most; write how much wider than the body it shall be";
        return Err(Halt::usage(Diagnostic::error(FIT_EASE, message).hint(hint)));
    }
    let lost = order.ease.keys().find(|name| !levels.iter().any(|l| l.name == **name));
    if levels.is_empty() || lost.is_some() {
        let names: Vec<&str> = levels.iter().map(|l| l.name.as_str()).collect();
        let message = match lost {
            Some(name) => format!("the garment has no ease at `{name}` that can be measured"),
            None => "the garment has no height at which its ease can be measured".to_owned(),
        };
        let hint = if names.is_empty() {
            "a garment around the trunk is needed, and a body that names bust, waist or hip".to_owned()
        } else {
            format!("heights of this garment are {}", names.join(", "))
        };
        return Err(Halt::usage(Diagnostic::error(FIT_NO_MEASURE, message).hint(hint)));
    }
    Ok(levels)
}

/// Takes ease and girth of the body at every level, where the cloth is measured.
pub fn take(garment: &Garment, levels: &mut [Level]) {
    let measured = measure(garment).levels;
    for level in levels {
        let found = measured.iter().find(|l| l.name == level.name);
        level.ease = found.and_then(toile_formats::report::Level::ease).unwrap_or(f64::NAN);
        level.body = found.and_then(|l| l.body).unwrap_or(level.body);
        level.is_followed &= (level.ease - level.asked).abs() <= JUMP;
    }
}

/// Tells what is not as asked.
pub fn unreached(levels: &[Level], order: &Order, rounds: usize) -> Option<Diagnostic> {
    let off: Vec<&Level> = levels.iter().filter(|l| !is_reached(l, order)).collect();
    let words = |l: &&Level| {
        let why = if l.is_followed { "" } else { ", where other cloth was measured" };
        format!("{} {:.1} mm instead of {:.1} mm{why}", l.name, 1e3 * l.ease, 1e3 * l.asked)
    };
    let words: Vec<String> = off.iter().map(words).collect();
    let message = format!("after {rounds} rounds the ease is not as asked: {}", words.join(", "));
    let finding = Diagnostic::error(FIT_NOT_REACHED, message);
    (!off.is_empty()).then(|| {
        finding.hint(format!("measure the page of the run there, or ask for an ease that the garment can have{HELD}"))
    })
}
