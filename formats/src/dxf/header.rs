//! The header of a file: release, unit, and the code page of its text.

use super::codes;
use super::findings::Findings;
use super::groups::Groups;
use crate::encoding::{self, TextEncoding};
use toile_garment::{Diagnostic, Severity};

#[derive(Default)]
pub(crate) struct Header {
    pub release: Option<String>,
    pub code_page: Option<String>,
    pub insunits: Option<i64>,
    pub variables: usize,
}

/// The variables that matter, without the rest of the file.
pub(crate) fn read_header(bytes: &[u8], findings: &mut Findings) -> Result<Header, Diagnostic> {
    let mut groups = Groups::new(bytes);
    let mut header = Header::default();
    while let Some(group) = groups.next(findings)? {
        if group.head.is("SECTION") && group.tags.first().is_some_and(|t| t.code == 2 && t.is("HEADER")) {
            let text = |v: &[u8]| String::from_utf8_lossy(v).into_owned();
            for pair in group.tags.windows(2) {
                if pair[0].code != 9 {
                    continue;
                }
                header.variables += 1;
                if pair[0].is("$ACADVER") {
                    header.release = Some(text(pair[1].value));
                } else if pair[0].is("$DWGCODEPAGE") {
                    header.code_page = Some(text(pair[1].value));
                } else if pair[0].is("$INSUNITS") {
                    header.insunits = text(pair[1].value).parse().ok();
                }
            }
            break;
        }
        if group.head.is("BLOCK") || group.head.is("EOF") {
            break;
        }
    }
    Ok(header)
}

/// The code page asked for, else the best choice.
pub(crate) fn text_encoding(
    bytes: &[u8],
    asked: Option<&str>,
    header: &Header,
    findings: &Findings,
) -> Result<TextEncoding, Diagnostic> {
    let Some(asked) = asked else {
        return Ok(encoding::choose(bytes, header.release.as_deref(), header.code_page.as_deref()));
    };
    encoding::asked(asked).map_err(|unknown| unknown.at(findings.place(1)))
}

/// Says where the code page that was chosen is doubtful.
pub(crate) fn say_encoding(bytes: &[u8], header: &Header, encoding: TextEncoding, findings: &mut Findings) {
    let read = format!("its text was read as {}", encoding.name());
    let release = header.release.as_deref();
    let text = match header.code_page.as_deref() {
        Some(page) if encoding.guessed && encoding::named(page).is_none() => {
            format!("the file names the code page `{page}`, which is not known here; {read}")
        }
        Some(page) if encoding.guessed => {
            format!("the text is not in the code page `{page}` that the file names; {read}")
        }
        None if encoding.guessed => format!("the file names no code page; {read}"),
        _ if encoding::is_unicode(release) && std::str::from_utf8(bytes).is_err() => {
            format!("the text of release {} is UTF-8, and this one is not; {read}", release.unwrap_or_default())
        }
        _ => return,
    };
    let hint = "if names look wrong, give the code page: code_page = \"…\"";
    // Valid UTF-8 is hardly ever anything else.
    let severity = if encoding.name() == "utf-8" { Severity::Info } else { Severity::Warning };
    findings.push(Diagnostic::new(severity, codes::ENCODING_GUESSED, text).at(findings.place(1)).hint(hint));
}
