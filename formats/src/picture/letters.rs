//! Letters as strokes, for the words beside a picture: lower case, digits and a few signs.

/// Strokes of a letter on a field 4 wide and 6 high, +y up, with its foot at 0: runs of points, two digits each.
fn strokes(letter: char) -> &'static str {
    match letter {
        '0' => "10 30 41 45 36 16 05 01 10",
        '1' => "05 26 20;10 30",
        '2' => "05 16 36 45 44 00 40",
        '3' => "06 46 23 33 42 41 30 10 01",
        '4' => "30 36 02 42",
        '5' => "46 06 03 33 42 41 30 00",
        '6' => "36 16 04 01 10 30 41 42 33 03",
        '7' => "06 46 10",
        '8' => "13 04 05 16 36 45 44 33 13 02 01 10 30 41 42 33",
        '9' => "10 30 42 45 36 16 05 04 13 43",
        'a' => "04 34 43 40 10 01 12 42",
        'b' => "06 00 30 41 43 34 04",
        'c' => "44 14 03 01 10 40",
        'd' => "46 40 10 01 03 14 44",
        'e' => "02 42 43 34 14 03 01 10 40",
        'f' => "36 26 15 10;04 34",
        'g' => "44 14 03 01 10 40;44 4- 3= 0=",
        'h' => "06 00;04 34 43 40",
        'i' => "24 20;26 26",
        'j' => "24 2- 1= 0=;26 26",
        'k' => "06 00;44 02 40",
        'l' => "26 21 30",
        'm' => "00 04 14 23 20;23 34 43 40",
        'n' => "00 04 34 43 40",
        'o' => "10 30 41 43 34 14 03 01 10",
        'p' => "0= 04 34 43 41 30 00",
        'q' => "4= 44 14 03 01 10 40",
        'r' => "00 04;02 14 34",
        's' => "44 14 03 32 41 30 00",
        't' => "16 11 20 30;04 34",
        'u' => "04 01 10 40;44 40",
        'v' => "04 20 44",
        'w' => "04 10 23 30 44",
        'x' => "04 40;00 44",
        'y' => "04 20;44 0=",
        'z' => "04 44 00 40",
        '%' => "00 46;05 16;35 35;01 01;31 40;05 05 16;31 40",
        '.' => "10 10",
        ',' => "11 0-",
        '-' => "03 43",
        '+' => "03 43;25 21",
        '/' => "00 46",
        '°' => "15 26 35 24 15",
        '≥' => "06 43 02;00 40",
        _ => "",
    }
}

/// Width of a letter with the gap after it, in sixths of its height.
const ADVANCE: f64 = 5.4;

/// Width of a line of words, pixels.
#[must_use]
pub fn width(words: &str, height: f64) -> f64 {
    (words.chars().count() as f64 * ADVANCE - (ADVANCE - 4.0)).max(0.0) * height / 6.0
}

/// The strokes of a line of words: lower left corner at `at`, pixels, +y down.
#[must_use]
pub fn spell(words: &str, at: [f64; 2], height: f64) -> Vec<[[f64; 2]; 2]> {
    let unit = height / 6.0;
    let mut out = Vec::new();
    for (k, letter) in words.chars().enumerate() {
        let left = at[0] + k as f64 * ADVANCE * unit;
        for run in strokes(letter).split(';') {
            let points: Vec<[f64; 2]> =
                run.split(' ').filter_map(point).map(|[x, y]| [left + x * unit, at[1] - y * unit]).collect();
            if let [only] = points.as_slice() {
                out.push([*only, *only]);
            }
            out.extend(points.windows(2).map(|w| [w[0], w[1]]));
        }
    }
    out
}

/// Two digits; `-` and `=` are one and two below the line.
fn point(text: &str) -> Option<[f64; 2]> {
    let digit = |c: char| match c {
        '-' => Some(-1.0),
        '=' => Some(-1.8),
        c => c.to_digit(10).map(f64::from),
    };
    let mut chars = text.chars();
    Some([digit(chars.next()?)?, digit(chars.next()?)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_letter_of_the_alphabet_has_strokes_inside_its_field() {
        for letter in ('a'..='z').chain('0'..='9').chain("%.,-+/°≥".chars()) {
            let lines = spell(&letter.to_string(), [0.0, 0.0], 6.0);
            assert!(!lines.is_empty(), "{letter}");
            let inside = |p: &[f64; 2]| (0.0..=4.0).contains(&p[0]) && (-6.0..=1.8).contains(&p[1]);
            assert!(lines.iter().flatten().all(inside), "{letter}");
        }
        assert!(spell(" ", [0.0, 0.0], 6.0).is_empty());
        assert!((width("ab", 6.0) - 9.4).abs() < 1e-12);
    }
}
