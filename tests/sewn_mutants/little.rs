//! Copies of a text whose numbers are a little wrong: such as a hand or another program writes them.

use super::damage::Dice;
use std::ops::Range;

/// Numbers of a text that stand by themselves: no part of a name.
fn numbers(bytes: &[u8]) -> Vec<Range<usize>> {
    let is_of_number = |b: &u8| b.is_ascii_digit() || matches!(*b, b'.' | b'-');
    let is_of_name = |b: Option<&u8>| b.is_some_and(|b| b.is_ascii_alphabetic() || *b == b'_');
    let (mut found, mut at) = (Vec::new(), 0);
    while at < bytes.len() {
        let end = at + bytes[at..].iter().take_while(|b| is_of_number(b)).count();
        let holds_digit = bytes[at..end].iter().any(u8::is_ascii_digit);
        if holds_digit && !is_of_name(at.checked_sub(1).and_then(|i| bytes.get(i))) && !is_of_name(bytes.get(end)) {
            found.push(at..end);
        }
        at = end.max(at) + 1;
    }
    found
}

fn text_of(bytes: &[u8], range: &Range<usize>) -> String {
    String::from_utf8_lossy(&bytes[range.clone()]).into_owned()
}

/// Another number in the place of one: somewhat larger or smaller, of the other sign, rounded, none, or far too large.
fn another(text: &str, dice: &mut Dice) -> String {
    let Ok(value) = text.parse::<f64>() else { return "1".to_owned() };
    let share = dice.below(2001) as f64 * 1e-3 - 1.0;
    let is_whole = !text.contains('.');
    let other = match dice.below(12) {
        0 => -value,
        1 => 0.0,
        2 => value.round(),
        3 => value * 10.0,
        4 => value * 1e3,
        5 => value * 1e-3,
        6..8 => value * (1.0 + share),
        8 => value + 1.0,
        9 => value - 1.0,
        _ => value * (1.0 + 0.02 * share),
    };
    if is_whole { format!("{}", other.round()) } else { format!("{other}") }
}

/// One copy: a few numbers are others, two change places, or a whole line is there twice or not at all.
pub fn a_little_wrong(seed: &[u8], dice: &mut Dice) -> Vec<u8> {
    let places = numbers(seed);
    if places.is_empty() || dice.below(8) == 0 {
        return another_line(seed, dice);
    }
    let mut changes: Vec<(Range<usize>, String)> = Vec::new();
    if dice.below(6) == 0 {
        let (a, b) = (&places[dice.below(places.len())], &places[dice.below(places.len())]);
        changes.push((a.clone(), text_of(seed, b)));
        changes.push((b.clone(), text_of(seed, a)));
    } else {
        for _ in 0..[1, 1, 1, 2, 8][dice.below(5)] {
            let place = &places[dice.below(places.len())];
            changes.push((place.clone(), another(&text_of(seed, place), dice)));
        }
    }
    changes.sort_by_key(|(range, _)| range.start);
    changes.dedup_by_key(|(range, _)| range.start);
    let mut out = seed.to_vec();
    for (range, text) in changes.into_iter().rev() {
        out.splice(range, text.into_bytes());
    }
    out
}

fn another_line(seed: &[u8], dice: &mut Dice) -> Vec<u8> {
    let mut lines: Vec<&[u8]> = seed.split_inclusive(|b| *b == b'\n').collect();
    let at = dice.below(lines.len());
    if lines.is_empty() || dice.below(2) == 0 {
        lines.drain(at..(at + 1).min(lines.len()));
    } else {
        lines.insert(at, lines[at]);
    }
    lines.concat()
}
