//! MTEXT: text with formatting codes, made plain lines.

use crate::encoding;

/// The text without its formatting, its paragraphs as lines.
pub(crate) fn plain(text: &str) -> String {
    let chars: Vec<char> = text.chars().collect();
    let mut out = String::with_capacity(text.len());
    let mut i = 0;
    while i < chars.len() {
        match (chars[i], chars.get(i + 1)) {
            ('{' | '}', _) => i += 1,
            ('\\', Some('P' | 'X' | 'N')) => {
                out.push('\n');
                i += 2;
            }
            ('\\', Some('~')) => {
                out.push(' ');
                i += 2;
            }
            ('\\', Some(c @ ('\\' | '{' | '}'))) => {
                out.push(*c);
                i += 2;
            }
            ('\\', Some('L' | 'l' | 'O' | 'o' | 'K' | 'k')) => i += 2,
            ('\\', Some('S')) => i = stacked(&chars, i + 2, &mut out),
            ('\\', Some('f' | 'F' | 'H' | 'W' | 'Q' | 'T' | 'A' | 'C' | 'c' | 'p')) => i = after_code(&chars, i + 2),
            (c, _) => {
                out.push(c);
                i += 1;
            }
        }
    }
    let lines = out.lines().map(|line| encoding::unescape(line).trim().to_owned());
    lines.collect::<Vec<_>>().join("\n").trim().to_owned()
}

/// Past the semicolon that ends a formatting code; at most 200 characters on.
fn after_code(chars: &[char], from: usize) -> usize {
    let end = chars.iter().skip(from).take(200).position(|c| *c == ';');
    end.map_or(from, |n| from + n + 1)
}

/// A fraction `\S1^2;` as `1/2`.
fn stacked(chars: &[char], from: usize, out: &mut String) -> usize {
    let to = after_code(chars, from);
    for c in &chars[from..to.saturating_sub(1).max(from)] {
        out.push(if matches!(c, '^' | '#') { '/' } else { *c });
    }
    to
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn formatting_goes_and_paragraphs_are_lines() {
        assert_eq!(plain(r"{\fArial|b0;Piece Name: FRONT\PQuantity: 2}"), "Piece Name: FRONT\nQuantity: 2");
        assert_eq!(plain(r"\A1;\H2.5x;Size: \S1/2; \{a\} %%d"), "Size: 1/2 {a} °");
        assert_eq!(plain(r"\U+524D a\~b"), "前 a b");
        assert_eq!(plain(r"no code \fat all"), r"no code at all");
    }
}
