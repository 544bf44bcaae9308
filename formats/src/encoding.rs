//! Text of old files: which code page it is in, and the escapes inside it.

use crate::codes::CODE_PAGE_UNKNOWN;
use encoding_rs::{Encoding, GB18030, GBK, SHIFT_JIS, UTF_8, WINDOWS_1252};
use toile_garment::Diagnostic;

/// The upper half of the DOS code page 850 (Western Europe), from 0x80 on.
const DOS_850: &str = "ÇüéâäàåçêëèïîìÄÅÉæÆôöòûùÿÖÜø£Ø×ƒáíóúñÑªº¿®¬½¼¡«»░▒▓│┤ÁÂÀ©╣║╗╝¢¥┐└┴┬├─┼ãÃ╚╔╩╦╠═╬¤ðÐÊËÈıÍÎÏ┘┌█▄¦Ì▀ÓßÔÒõÕµþÞÚÛÙýÝ¯´\u{AD}±‗¾¶§÷¸°¨·¹³²■\u{A0}";

/// How bytes are letters.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Page {
    Web(&'static Encoding),
    Dos850,
}

/// The code page of a file and why it was chosen.
#[derive(Clone, Copy, Debug)]
pub struct TextEncoding {
    page: Page,
    /// Was it guessed from the bytes alone?
    pub guessed: bool,
}

impl TextEncoding {
    /// Name for people and reports, e.g. `utf-8`, `gbk`, `windows-1252`.
    #[must_use]
    pub fn name(&self) -> String {
        match self.page {
            Page::Web(encoding) => encoding.name().to_ascii_lowercase(),
            Page::Dos850 => "dos850".to_owned(),
        }
    }

    /// Its name in the header of a DXF (`$DWGCODEPAGE`); none for UTF-8, which is told by the release.
    #[must_use]
    pub fn dxf_name(&self) -> Option<String> {
        let Page::Web(encoding) = self.page else { return Some("dos850".to_owned()) };
        let name = encoding.name().to_ascii_lowercase();
        let number = match name.as_str() {
            "utf-8" => return None,
            "gbk" => "936",
            "gb18030" => "54936",
            "shift_jis" => "932",
            "euc-kr" => "949",
            "big5" => "950",
            other => other.strip_prefix("windows-").unwrap_or(other),
        };
        Some(format!("ANSI_{number}"))
    }

    /// The bytes of one letter; none where the code page does not have it.
    #[must_use]
    pub fn encode(&self, letter: char) -> Option<Vec<u8>> {
        let mut buffer = [0_u8; 4];
        match self.page {
            Page::Web(encoding) => {
                let (bytes, _, unmappable) = encoding.encode(letter.encode_utf8(&mut buffer));
                (!unmappable).then(|| bytes.into_owned())
            }
            Page::Dos850 if letter.is_ascii() => Some(vec![letter as u8]),
            Page::Dos850 => {
                let place = DOS_850.chars().position(|c| c == letter)?;
                Some(vec![u8::try_from(place + 0x80).ok()?])
            }
        }
    }

    /// Decodes one value. Control characters become U+FFFD, so that no name can move a terminal's cursor.
    #[must_use]
    pub fn decode(&self, bytes: &[u8]) -> String {
        let text = match self.page {
            Page::Web(encoding) => encoding.decode_without_bom_handling(bytes).0,
            Page::Dos850 => bytes.iter().map(|b| dos_850(*b)).collect::<String>().into(),
        };
        text.chars().map(|c| if c.is_control() && c != '\t' { '\u{FFFD}' } else { c }).collect()
    }
}

fn dos_850(byte: u8) -> char {
    match byte.checked_sub(0x80) {
        None => char::from(byte),
        Some(high) => DOS_850.chars().nth(usize::from(high)).unwrap_or('\u{FFFD}'),
    }
}

/// Chooses the code page. AC1021 and later are UTF-8 where the bytes are valid, and so are older files with valid
/// non-ASCII bytes. Else the declared code page is taken, unless it is Windows-1252 and the bytes are no words in it: many
/// programs declare it whatever they write. Without a page, bytes that read as Japanese or Chinese are Shift-JIS or GBK,
/// and all others Windows-1252.
#[must_use]
pub fn choose(bytes: &[u8], release: Option<&str>, code_page: Option<&str>) -> TextEncoding {
    let sure = |page| TextEncoding { page, guessed: false };
    let utf_8 = Page::Web(UTF_8);
    let named = code_page.and_then(by_code_page);
    if bytes.is_ascii() {
        return sure(utf_8);
    }
    if let Ok(text) = std::str::from_utf8(bytes) {
        if is_unicode(release) {
            return sure(utf_8);
        }
        // A few Chinese words happen to be valid UTF-8; as such they would be letters of no living language.
        let says_nothing = named.is_none_or(|page| page == Page::Web(WINDOWS_1252));
        if says_nothing && looks_like_gbk(bytes) && text.chars().any(|c| ('\u{180}'..'\u{370}').contains(&c)) {
            return TextEncoding { page: Page::Web(GBK), guessed: true };
        }
        if named != Some(Page::Web(GBK)) || !looks_like_gbk(bytes) {
            return TextEncoding { page: utf_8, guessed: named.is_some_and(|page| page != utf_8) };
        }
    }
    match named.filter(|page| *page != utf_8) {
        Some(page) if page != Page::Web(WINDOWS_1252) || reads_as_western(bytes) => return sure(page),
        _ => {}
    }
    let encoding = if looks_like_shift_jis(bytes) {
        SHIFT_JIS
    } else if looks_like_gbk(bytes) {
        GBK
    } else {
        WINDOWS_1252
    };
    TextEncoding { page: Page::Web(encoding), guessed: named != Some(Page::Web(encoding)) }
}

/// Is the text of this release UTF-8?
#[must_use]
pub fn is_unicode(release: Option<&str>) -> bool {
    release.and_then(release_number).is_some_and(|r| r >= 1021)
}

/// A code page by the name people or DXF headers give it.
#[must_use]
pub fn named(name: &str) -> Option<TextEncoding> {
    by_code_page(name).map(|page| TextEncoding { page, guessed: false })
}

/// The code page that a user asks for.
///
/// # Errors
/// It is not known.
pub fn asked(name: &str) -> Result<TextEncoding, Box<Diagnostic>> {
    named(name).ok_or_else(|| {
        let text = format!("`{name}` is no code page this program knows");
        let hint = "e.g. \"utf-8\", \"gbk\", \"shift_jis\", \"windows-1252\", \"ANSI_936\"";
        Box::new(Diagnostic::error(CODE_PAGE_UNKNOWN, text).hint(hint))
    })
}

fn release_number(release: &str) -> Option<u32> {
    release.trim().to_ascii_uppercase().strip_prefix("AC")?.parse().ok()
}

fn by_code_page(name: &str) -> Option<Page> {
    let name = name.trim().to_ascii_lowercase();
    let number = name.trim_start_matches(|c: char| !c.is_ascii_digit());
    let encoding = match number {
        "850" => return Some(Page::Dos850),
        "936" => Some(GBK),
        "54936" => Some(GB18030),
        "932" => Some(SHIFT_JIS),
        "949" => Some(encoding_rs::EUC_KR),
        "950" => Some(encoding_rs::BIG5),
        "874" => Some(encoding_rs::WINDOWS_874),
        "1250" | "1251" | "1252" | "1253" | "1254" | "1255" | "1256" | "1257" | "1258" => {
            Encoding::for_label(format!("windows-{number}").as_bytes())
        }
        _ => Encoding::for_label(name.as_bytes()),
    };
    encoding.map(Page::Web)
}

/// Are these words in Windows-1252? There, letters with accents stand alone or in twos, as in `Größe`, and signs stand
/// alone. Chinese and Japanese words are long rows of both.
fn reads_as_western(bytes: &[u8]) -> bool {
    let is_letter =
        |b: &u8| matches!(b, 0xC0..=0xD6 | 0xD8..=0xF6 | 0xF8..=0xFF | 0x8A | 0x8C | 0x8E | 0x9A | 0x9C | 0x9E | 0x9F);
    let is_none = |b: &u8| matches!(b, 0x81 | 0x8D | 0x8F | 0x90 | 0x9D);
    let is_word =
        |row: &[u8]| row.len() == 1 && !is_none(&row[0]) || row.len() <= WESTERN_ROW && row.iter().all(is_letter);
    // A row of letters stands in a word somewhere: `Größe`, and then `ÄÖ` may stand alone, too.
    let joins = |pair: &[u8]| pair.iter().any(u8::is_ascii_alphabetic) && pair.iter().any(is_letter);
    let rows = || bytes.split(u8::is_ascii).filter(|row| !row.is_empty());
    rows().all(is_word) && (rows().all(|row| row.len() == 1) || bytes.windows(2).any(joins))
}

/// Most letters with accents in a row of a Western word.
const WESTERN_ROW: usize = 3;

/// Valid GBK throughout, and most double bytes from the common Chinese zone, one of them at least from that of usual
/// words: Western accents hardly ever pair up so.
fn looks_like_gbk(bytes: &[u8]) -> bool {
    let (mut pairs, mut common, mut usual, mut i) = (0_u64, 0_u64, false, 0);
    while i < bytes.len() {
        if bytes[i] < 0x80 {
            i += 1;
            continue;
        }
        let Some(second) = bytes.get(i + 1) else { return false };
        if !(0x81..=0xFE).contains(&bytes[i]) || !(0x40..=0xFE).contains(second) || *second == 0x7F {
            return false;
        }
        pairs += 1;
        common += u64::from(bytes[i] >= 0xA1 && *second >= 0xA1);
        usual |= bytes[i] <= 0xD7;
        i += 2;
    }
    usual && common * 10 >= pairs * 8
}

/// Valid Shift-JIS throughout with kana in it: most double bytes begin with 0x82 or 0x83 there, and hardly any does
/// in GBK, where these are rare characters.
fn looks_like_shift_jis(bytes: &[u8]) -> bool {
    let (mut pairs, mut kana, mut i) = (0_u64, 0_u64, 0);
    while i < bytes.len() {
        match (bytes[i], bytes.get(i + 1)) {
            (0..=0x7F, _) => i += 1,
            // Half-width katakana stand alone.
            (0xA1..=0xDF, _) => {
                pairs += 1;
                kana += 1;
                i += 1;
            }
            (0x81..=0x9F | 0xE0..=0xFC, Some(0x40..=0x7E | 0x80..=0xFC)) => {
                pairs += 1;
                kana += u64::from(matches!(bytes[i], 0x82 | 0x83));
                i += 2;
            }
            _ => return false,
        }
    }
    // Bytes of 0xA1 to 0xDF alone may be anything: full-width kana must be there.
    let full = bytes.iter().any(|b| matches!(b, 0x82 | 0x83));
    pairs > 0 && full && kana * 2 >= pairs
}

/// Resolves `\U+XXXX` and the `%%` codes of DXF text.
#[must_use]
pub fn unescape(text: &str) -> String {
    let chars: Vec<char> = text.chars().collect();
    let mut out = String::with_capacity(text.len());
    let mut i = 0;
    while i < chars.len() {
        if let Some((c, used)) = unicode_escape(&chars[i..]) {
            out.push(c);
            i += used;
        } else if let Some((text, used)) = double_byte_escapes(&chars[i..]) {
            out.push_str(&text);
            i += used;
        } else if chars[i] == '%' && chars.get(i + 1) == Some(&'%') {
            let (c, used) = percent_code(&chars[i + 2..]);
            out.extend(c);
            i += 2 + used;
        } else {
            out.push(chars[i]);
            i += 1;
        }
    }
    out
}

/// `\U+XXXX`; two of them where the character lies beyond the first 65,536.
fn unicode_escape(chars: &[char]) -> Option<(char, usize)> {
    let unit = |chars: &[char]| {
        let ['\\', 'U' | 'u', '+', hex @ ..] = chars else { return None };
        hex_value(hex.get(..4)?)
    };
    let disarmed = |c: char| if c.is_control() { '\u{FFFD}' } else { c };
    let first = unit(chars)?;
    if let Some(c) = char::from_u32(first) {
        return Some((disarmed(c), 7));
    }
    let second = unit(chars.get(7..)?).filter(|s| (0xDC00..0xE000).contains(s) && first < 0xDC00)?;
    char::from_u32(0x1_0000 + ((first - 0xD800) << 10) + (second - 0xDC00)).map(|c| (disarmed(c), 14))
}

fn hex_value(digits: &[char]) -> Option<u32> {
    digits
        .iter()
        .all(char::is_ascii_hexdigit)
        .then(|| u32::from_str_radix(&digits.iter().collect::<String>(), 16).ok())?
}

/// A run of `\M+nXXXX`: double bytes of the code page n (1 Shift-JIS, 2 Big5, 3 Korean, 5 GBK).
fn double_byte_escapes(chars: &[char]) -> Option<(String, usize)> {
    let (mut bytes, mut used, mut page) = (Vec::new(), 0, None);
    while let ['\\', 'M' | 'm', '+', n, hex @ ..] = chars.get(used..).unwrap_or_default() {
        let Some(value) = hex.get(..4).and_then(hex_value) else { break };
        if page.is_some_and(|p| p != *n) {
            break;
        }
        page = Some(*n);
        bytes.extend([(value >> 8) as u8, (value & 0xFF) as u8]);
        used += 8;
    }
    let encoding = match page? {
        '1' => SHIFT_JIS,
        '2' => encoding_rs::BIG5,
        '3' => encoding_rs::EUC_KR,
        '5' => GBK,
        _ => return None,
    };
    let (text, _) = encoding.decode_without_bom_handling(&bytes);
    Some((text.chars().map(|c| if c.is_control() { '\u{FFFD}' } else { c }).collect(), used))
}

fn percent_code(rest: &[char]) -> (Option<char>, usize) {
    match rest.first().map(char::to_ascii_lowercase) {
        Some('d') => (Some('°'), 1),
        Some('c') => (Some('Ø'), 1),
        Some('p') => (Some('±'), 1),
        Some('%') => (Some('%'), 1),
        Some('u' | 'o' | 'k') => (None, 1),
        Some(c) if c.is_ascii_digit() && rest.len() >= 3 => {
            let digits: String = rest[..3].iter().collect();
            let c = digits.parse::<u32>().ok().and_then(char::from_u32).filter(|c| !c.is_control());
            (Some(c.unwrap_or('\u{FFFD}')), 3)
        }
        _ => (None, 0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_of_trust() {
        let gbk = b"\xc7\xb0\xc6\xac";
        assert_eq!(choose(gbk, None, None).decode(gbk), "前片");
        assert!(choose(gbk, None, None).guessed);
        assert_eq!(choose(gbk, None, Some("ANSI_936")).decode(gbk), "前片");
        assert_eq!(choose("前片".as_bytes(), None, None).decode("前片".as_bytes()), "前片");
        let west = b"D\xe9coup\xe9 2";
        assert_eq!(choose(west, Some("AC1009"), Some("ANSI_1252")).decode(west), "Découpé 2");
        assert_eq!(choose(west, None, None).decode(west), "Découpé 2");
        assert_eq!(choose(west, Some("AC1021"), Some("ANSI_1252")).decode(west), "Découpé 2");
        assert_eq!(choose(b"\xcf\xf0", None, Some("ANSI_1251")).decode(b"\xcf\xf0"), "Пр");
    }

    #[test]
    fn a_declared_page_wins_unless_its_words_are_none() {
        // Größe, GRÖSSE-ß and 25° are words in Windows-1252, whatever they would be in GBK.
        for west in [b"Gr\xf6\xdfe".as_slice(), b"GR\xd6\xdfE", b"25\xb0", b"Gr\xf6\xdfe \xc4\xd6"] {
            let read = choose(west, Some("AC1009"), Some("ANSI_1252"));
            assert_eq!((read.name().as_str(), read.guessed), ("windows-1252", false), "{west:?}");
        }
        assert_eq!(choose(b"Gr\xf6\xdfe", None, None).decode(b"Gr\xf6\xdfe"), "Größe");
        // Chinese and Japanese words in a file that declares Windows-1252, and a page that is not UTF-8.
        let (gbk, sjis) = (b"\xc7\xb0\xc6\xac".as_slice(), b"\x83t\x83\x8d\x83\x93\x83g \x91O\x90g\x8d\xa0".as_slice());
        for (bytes, page, text) in [(gbk, "gbk", "前片"), (sjis, "shift_jis", "フロント 前身頃")] {
            let read = choose(bytes, Some("AC1009"), Some("ANSI_1252"));
            assert_eq!((read.name().as_str(), read.guessed, read.decode(bytes).as_str()), (page, true, text));
        }
        // A single Chinese letter in no Western word.
        assert_eq!(choose(b"Piece Name: \xd3\xd2", None, Some("ANSI_1252")).name(), "gbk");
        let utf_8 = choose("Größe".as_bytes(), Some("AC1009"), Some("ANSI_1252"));
        assert_eq!((utf_8.name().as_str(), utf_8.guessed), ("utf-8", true));
    }

    #[test]
    fn japanese_without_a_code_page() {
        // "フロント" and "前身頃" (front).
        let sjis = b"\x83t\x83\x8d\x83\x93\x83g \x91O\x90g\x8d\xa0";
        assert_eq!(choose(sjis, None, None).decode(sjis), "フロント 前身頃");
        assert_eq!(named("shift_jis").map(|e| e.decode(sjis)).as_deref(), Some("フロント 前身頃"));
        assert!(named("klingon").is_none());
        assert_eq!(named("dos850").map(|e| e.decode(b"R\x81cken \xff \xe1")).as_deref(), Some("Rücken \u{A0} ß"));
        assert_eq!(DOS_850.chars().count(), 128);
    }

    #[test]
    fn escapes() {
        assert_eq!(unescape(r"\U+524D 20%%d %%p1 %%%"), "前 20° ±1 %");
        assert_eq!(unescape("%%065%%u"), "A");
        assert_eq!(unescape("%%"), "");
        assert_eq!(unescape(r"\U+00zz"), r"\U+00zz");
        assert_eq!(unescape(r"\U+D83D\U+DC57 \U+D83D"), "\u{1F457} \\U+D83D");
        assert_eq!(unescape(r"\M+5C7B0\M+5C6AC 1"), "前片 1");
        assert_eq!(unescape(r"\M+183^"), r"\M+183^");
    }

    #[test]
    fn terminal_escapes_are_disarmed() {
        let bytes = b"a\x1b[31mb";
        assert_eq!(choose(bytes, None, None).decode(bytes), "a\u{FFFD}[31mb");
    }
}
