//! Names the format can carry: 7-bit ASCII, at most 20 characters, no blanks in block names, each block once.

use super::codes;
use super::model::{Dialect, Drawing};
use crate::encoding::TextEncoding;
use std::collections::{BTreeMap, BTreeSet};
use toile_garment::text::steers;
use toile_garment::{Code, Diagnostic};

/// Longest name that all readers keep.
pub const LONGEST: usize = 20;

/// Names of one piece drawing as written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PieceName {
    /// `Piece Name` text, the same for all sizes of a piece.
    pub piece: String,
    /// `Size` text.
    pub size: Option<String>,
    /// Block name.
    pub block: String,
}

/// Names of all pieces, in the order of the drawing.
pub struct Names {
    /// One per piece drawing.
    pub pieces: Vec<PieceName>,
}

impl Names {
    /// Finds names; every change is a finding.
    pub fn of(drawing: &Drawing, dialect: Dialect, findings: &mut Vec<Diagnostic>) -> Self {
        let mut short: BTreeMap<&str, String> = BTreeMap::new();
        let mut taken = BTreeSet::new();
        for piece in &drawing.pieces {
            if !short.contains_key(piece.name.as_str()) {
                let name = if dialect.is_narrow() {
                    unique(&clean(&piece.name, "PIECE"), LONGEST, &mut taken)
                } else {
                    one_line(&piece.name, "PIECE")
                };
                if name != piece.name {
                    findings.push(renamed(codes::PIECE_NAME_CHANGED, &piece.name, &name));
                }
                short.insert(&piece.name, name);
            }
        }
        let mut blocks = BTreeSet::new();
        let mut pieces = Vec::with_capacity(drawing.pieces.len());
        for piece in &drawing.pieces {
            let name = short.get(piece.name.as_str()).cloned().unwrap_or_default();
            let narrow = dialect.is_narrow();
            let size = piece.size.as_deref().map(|s| if narrow { clean(s, "SIZE") } else { one_line(s, "SIZE") });
            if let (Some(was), Some(now)) = (piece.size.as_deref(), size.as_deref())
                && was != now
            {
                findings.push(renamed(codes::SIZE_NAME_CHANGED, was, now));
            }
            let bare = |s: &str, empty| clean(s, empty).replace(' ', "-");
            let tail = size.as_deref().map(|s| format!("_{}", bare(s, "SIZE"))).unwrap_or_default();
            let head: String = bare(&name, "PIECE").chars().take(LONGEST.saturating_sub(tail.len())).collect();
            let block = match dialect {
                Dialect::Optitex => (pieces.len() + 1).to_string(),
                _ => unique(&format!("{head}{tail}"), LONGEST, &mut blocks),
            };
            pieces.push(PieceName { piece: name, size, block });
        }
        Self { pieces }
    }
}

fn renamed(code: Code, was: &str, now: &str) -> Diagnostic {
    Diagnostic::warning(
        code,
        format!(
            "`{was}` is written as `{now}`: what reads it holds {LONGEST} ASCII characters on one line, each name once"
        ),
    )
    .hint("shorten the name in the pattern to choose it yourself")
}

/// Without line breaks and blanks at its ends, which the format cannot hold.
fn one_line(name: &str, empty: &str) -> String {
    let line: String = name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    let line = line.trim();
    if line.is_empty() { empty.to_owned() } else { line.to_owned() }
}

/// Printable ASCII; all else as `\U+XXXX`.
pub fn escaped(text: &str) -> String {
    escaped_in(None, text)
}

/// Must a letter be escaped in a code page, or in ASCII without one? Letters that turn the order of others always are.
pub fn is_escaped_in(page: Option<TextEncoding>, letter: char) -> bool {
    let is_held = || page.is_some_and(|p| p.encode(letter).is_some()) && !steers(letter);
    !(' '..='~').contains(&letter) && !letter.is_control() && !is_held()
}

/// A text with the letters of a code page, or of ASCII without one; all else as `\U+XXXX`.
pub fn escaped_in(page: Option<TextEncoding>, text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut units = [0_u16; 2];
    for c in text.chars() {
        match c {
            _ if c.is_control() => out.push(' '),
            _ if !is_escaped_in(page, c) => out.push(c),
            _ => c.encode_utf16(&mut units).iter().for_each(|u| out.push_str(&format!("\\U+{u:04X}"))),
        }
    }
    out
}

/// ASCII with at least one letter or digit, at most [`LONGEST`] characters.
fn clean(name: &str, empty: &str) -> String {
    let kept: String = ascii(name).chars().map(|c| if "/\\:;,*?\"<>|=`".contains(c) { '-' } else { c }).collect();
    let kept: String = kept.trim().chars().take(LONGEST).collect();
    let kept = kept.trim_end();
    if !kept.contains(|c: char| c.is_ascii_alphanumeric()) { empty.to_owned() } else { kept.to_owned() }
}

/// The name, or the name with a number, such that it is new (readers may fold case).
fn unique(name: &str, longest: usize, taken: &mut BTreeSet<String>) -> String {
    let mut candidate: String = name.chars().take(longest).collect();
    let mut n = 2_u32;
    while !taken.insert(candidate.to_ascii_uppercase()) {
        let tail = format!("-{n}");
        let head: String = name.chars().take(longest.saturating_sub(tail.len())).collect();
        candidate = format!("{head}{tail}");
        n += 1;
    }
    candidate
}

/// Folds a text to printable 7-bit ASCII: Latin letters lose their accents, anything else becomes `?`.
pub fn ascii(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            ' '..='~' => out.push(c),
            _ if c.is_whitespace() || c.is_control() => out.push(' '),
            _ => out.push_str(fold(c)),
        }
    }
    out
}

fn fold(c: char) -> &'static str {
    match c {
        'À'..='Ã' | 'Å' | 'Ā' | 'Ą' => "A",
        'Ä' | 'Æ' => "Ae",
        'à'..='ã' | 'å' | 'ā' | 'ą' => "a",
        'ä' | 'æ' => "ae",
        'Ç' | 'Ć' | 'Č' => "C",
        'ç' | 'ć' | 'č' => "c",
        'È'..='Ë' | 'Ē' | 'Ę' | 'Ě' => "E",
        'è'..='ë' | 'ē' | 'ę' | 'ě' => "e",
        'Ì'..='Ï' | 'İ' => "I",
        'ì'..='ï' | 'ı' => "i",
        'Ł' => "L",
        'ł' => "l",
        'Ñ' | 'Ń' => "N",
        'ñ' | 'ń' => "n",
        'Ò'..='Õ' | 'Ø' | 'Ő' => "O",
        'Ö' | 'Œ' => "Oe",
        'ò'..='õ' | 'ø' | 'ő' => "o",
        'ö' | 'œ' => "oe",
        'Ś' | 'Š' | 'Ş' => "S",
        'ś' | 'š' | 'ş' => "s",
        'ß' => "ss",
        'Ù'..='Û' | 'Ű' => "U",
        'Ü' => "Ue",
        'ù'..='û' | 'ű' => "u",
        'ü' => "ue",
        'Ý' => "Y",
        'ý' | 'ÿ' => "y",
        'Ź' | 'Ż' | 'Ž' => "Z",
        'ź' | 'ż' | 'ž' => "z",
        '–' | '—' => "-",
        '’' | '‘' => "'",
        _ => "?",
    }
}
