//! Texts from files made fit to be shown: what steers a terminal or turns the order of letters is written out.

/// Does a character steer instead of showing something? Control characters do, and so do those that change the
/// direction of the text around them, so that a name can look like another one.
#[must_use]
pub fn steers(c: char) -> bool {
    let turns = matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    c.is_control() || turns || matches!(c, '\u{2028}' | '\u{2029}')
}

/// The text with every steering character written as `\u{…}`; those in `keep` stay.
#[must_use]
pub fn shown(text: &str, keep: &[char]) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if steers(c) && !keep.contains(&c) { out.extend(c.escape_default()) } else { out.push(c) }
    }
    out
}

/// JSON text with every steering character as `\uXXXX`. A reader gets the same values; a person who looks at the file
/// sees what is in it. Line ends and tabs between the values stay.
#[must_use]
pub fn json(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if steers(c) && !matches!(c, '\n' | '\t' | '\r') {
            // All of them lie in the plane that four digits reach.
            out.push_str(&format!("\\u{:04x}", c as u32));
        } else {
            out.push(c);
        }
    }
    out
}

/// The text in double quotes, as TOML and JSON have it, with every steering character as `\uXXXX`.
#[must_use]
pub fn quoted(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 2);
    out.push('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            // All of them lie in the plane that four digits reach.
            c if steers(c) => out.push_str(&format!("\\u{:04x}", c as u32)),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

/// The text as a cell of comma-separated values, fit to be shown.
#[must_use]
pub fn csv_cell(text: &str) -> String {
    format!("\"{}\"", shown(text, &[]).replace('"', "\"\""))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_that_turns_the_text_is_written_out() {
        let name = "F\u{202e}fxd.exe\u{2069}";
        assert_eq!(shown(name, &[]), "F\\u{202e}fxd.exe\\u{2069}");
        assert_eq!(shown("a\nb\u{1b}[2J", &['\n']), "a\nb\\u{1b}[2J");
        assert_eq!(shown("Ärmel, 袖, כתף, نصف", &[]), "Ärmel, 袖, כתף, نصف", "letters of all scripts stay");
        let text = json(&serde_json::to_string(&[name]).expect("JSON"));
        assert!(!text.chars().any(steers), "{text}");
        assert_eq!(serde_json::from_str::<Vec<String>>(&text).expect("JSON"), [name]);
        assert_eq!(csv_cell("a \"b\"\n\u{202e}"), "\"a \"\"b\"\"\\n\\u{202e}\"");
        for name in [name, "a \"b\" \\ c", "line\nend\u{2028}\t"] {
            let text = quoted(name);
            assert!(!text.chars().any(steers), "{text}");
            assert_eq!(serde_json::from_str::<String>(&text).expect("JSON"), name);
        }
    }
}
