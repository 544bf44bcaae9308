//! Binary DXF into its text form: the same pairs, two lines each.
//!
//! Codes are one byte before release 13 and two bytes since; which of the two shows in the first pair. Some writers get
//! it wrong: they give two-byte codes in old releases, or a date as a string. So reading passes over a damaged pair
//! outside the geometry, to the next SECTION, with a warning. A damaged pair in BLOCKS or ENTITIES ends the reading.

use super::codes;
use super::findings::Findings;
use super::limits;
use toile_garment::Diagnostic;

/// The first bytes of every binary DXF.
pub(crate) const SENTINEL: &[u8] = b"AutoCAD Binary DXF\r\n\x1a\0";
/// Doubles nearer to zero than this, made of digits, are a text read as a number.
const LEAST: f64 = 1e-20;

/// The kind of value that follows a group code.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Text,
    Double,
    Int16,
    Int32,
    Int64,
    Bool,
    Chunk,
}

fn kind(code: i32) -> Option<Kind> {
    Some(match code {
        310..=319 | 1004 => Kind::Chunk,
        0..=9 | 100..=109 | 300..=369 | 390..=399 | 410..=419 | 430..=439 | 470..=481 | 999..=1009 => Kind::Text,
        10..=59 | 110..=149 | 210..=239 | 460..=469 | 1010..=1059 => Kind::Double,
        60..=79 | 170..=179 | 270..=289 | 370..=389 | 400..=409 | 1060..=1070 => Kind::Int16,
        90..=99 | 420..=429 | 440..=459 | 1071 => Kind::Int32,
        160..=169 => Kind::Int64,
        290..=299 => Kind::Bool,
        _ => return None,
    })
}

struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
    wide: bool,
}

impl<'a> Reader<'a> {
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let part = self.bytes.get(self.at..self.at.checked_add(N)?)?;
        self.at += N;
        part.try_into().ok()
    }

    fn code(&mut self) -> Option<i32> {
        if self.wide {
            return self.take().map(|b| i32::from(i16::from_le_bytes(b)));
        }
        match self.take::<1>()? {
            [255] => self.take().map(|b| i32::from(i16::from_le_bytes(b))),
            [b] => Some(i32::from(b)),
        }
    }

    fn text(&mut self) -> Option<&'a [u8]> {
        let rest = self.bytes.get(self.at..)?;
        let end = rest.iter().take(limits::LINE_BYTES + 1).position(|b| *b == 0)?;
        self.at += end + 1;
        Some(&rest[..end])
    }

    /// The value as its text form.
    fn value(&mut self, kind: Kind) -> Option<Vec<u8>> {
        Some(match kind {
            Kind::Text => self.text()?.iter().map(|b| if matches!(b, b'\r' | b'\n') { b' ' } else { *b }).collect(),
            Kind::Double => {
                let raw = self.take::<8>()?;
                let v = f64::from_le_bytes(raw);
                let digits = raw.iter().filter(|b| b.is_ascii_digit() || b".-+".contains(b)).count();
                if v.abs() < LEAST && digits >= 4 {
                    return None;
                }
                format!("{v:?}").into_bytes()
            }
            Kind::Int16 => i16::from_le_bytes(self.take()?).to_string().into_bytes(),
            Kind::Int32 => i32::from_le_bytes(self.take()?).to_string().into_bytes(),
            Kind::Int64 => i64::from_le_bytes(self.take()?).to_string().into_bytes(),
            Kind::Bool => u8::from_le_bytes(self.take()?).to_string().into_bytes(),
            Kind::Chunk => {
                let [n] = self.take::<1>()?;
                self.at = self.at.checked_add(usize::from(n)).filter(|at| *at <= self.bytes.len())?;
                Vec::new()
            }
        })
    }

    fn pair(&mut self) -> Option<(i32, Vec<u8>)> {
        let code = self.code()?;
        Some((code, self.value(kind(code)?)?))
    }

    /// Goes to the next `0 SECTION 2 …`.
    fn next_section(&mut self) -> bool {
        let mark: &[u8] = if self.wide { b"\0\0SECTION\0\x02\0" } else { b"\0SECTION\0\x02" };
        let rest = self.bytes.get(self.at..).unwrap_or_default();
        match rest.windows(mark.len()).position(|w| w == mark) {
            Some(i) => {
                self.at += i;
                true
            }
            None => false,
        }
    }
}

/// The text form.
///
/// # Errors
/// Geometry that cannot be read, or nothing at all; with the byte.
pub(crate) fn to_text(bytes: &[u8], findings: &mut Findings) -> Result<Vec<u8>, Diagnostic> {
    let refuse = |text: String, findings: &Findings| {
        Err(Diagnostic::error(codes::BINARY_DXF, text)
            .at(findings.place(1))
            .hint("the writer of this file is at fault; export it as ASCII (text) DXF"))
    };
    let Some(body) = bytes.strip_prefix(SENTINEL) else {
        return refuse("the mark at the beginning of this binary DXF is damaged".into(), findings);
    };
    // The first pair is `0 SECTION`, or a comment.
    let wide = body.get(1) == Some(&0) || body.starts_with(&[0xE7, 0x03]);
    let mut reader = Reader { bytes: body, at: 0, wide };
    let mut out = Vec::with_capacity(bytes.len().saturating_mul(2));
    let (mut section, mut opens) = (Vec::new(), false);
    while reader.at < body.len() {
        let start = reader.at;
        let Some((code, value)) = reader.pair() else {
            let place = start + SENTINEL.len();
            let geometry = section == b"BLOCKS" || section == b"ENTITIES";
            let name = if section.is_empty() { "no section".into() } else { String::from_utf8_lossy(&section) };
            reader.at = start;
            if geometry || !reader.next_section() {
                let text =
                    format!("this binary DXF cannot be read at byte {place} ({name}): the data there are no pair");
                return refuse(text, findings);
            }
            let text =
                format!("this binary DXF is damaged at byte {place} ({name}); it was read on from the next section");
            findings.push(Diagnostic::warning(codes::BINARY_DXF_DAMAGED, text).at(findings.place(1)));
            if !section.is_empty() {
                out.extend_from_slice(b"0\nENDSEC\n");
            }
            section.clear();
            continue;
        };
        if opens && code == 2 {
            section = value.to_ascii_uppercase();
        }
        opens = code == 0 && value.eq_ignore_ascii_case(b"SECTION");
        if code == 0 && value.eq_ignore_ascii_case(b"ENDSEC") {
            section.clear();
        }
        out.extend_from_slice(code.to_string().as_bytes());
        out.push(b'\n');
        out.extend_from_slice(&value);
        out.push(b'\n');
        if code == 0 && value.eq_ignore_ascii_case(b"EOF") {
            break;
        }
    }
    let text = "this is a binary DXF; lines are counted as in its text form, two for each pair";
    findings.push(Diagnostic::info(codes::BINARY_DXF_READ, text).at(findings.place(1)));
    Ok(out)
}
