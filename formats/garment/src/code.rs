//! Codes of findings: fixed names with their meaning.
//!
//! A room lists the codes that it gives by the macro [`codes!`](crate::codes!), beside the code that gives them.
//! Each package joins the lists of its rooms, and the command joins those of the packages: `toile explain` and the
//! page of findings read that table. The compiler tells what was forgotten. A code that stands in no list cannot be
//! given. A code that is never given and a list that nobody joins are dead code.

/// The fixed name of a kind of finding, with its meaning.
///
/// Codes are constants, which the macro [`codes!`](crate::codes!) lists:
///
/// ```
/// mod codes {
///     use toile_garment::Code;
///
///     toile_garment::codes! {
///         pub(crate) list CODES;
///
///         /// A button lies outside its piece. Move it, or draw the piece larger.
///         BUTTON_OUTSIDE = "button-outside";
///     }
/// }
/// let finding = toile_garment::Diagnostic::warning(codes::BUTTON_OUTSIDE, "the third button is outside");
/// assert_eq!(finding.code, "button-outside");
/// assert_eq!(codes::CODES[0].text(), "A button lies outside its piece. Move it, or draw the piece larger.");
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Code {
    name: &'static str,
    text: &'static str,
}

impl Code {
    /// The code of a constant; [`codes!`](crate::codes!) calls it.
    ///
    /// # Panics
    /// Does not compile if the name is not that of the constant in kebab case.
    #[doc(hidden)]
    #[must_use]
    pub const fn listed(constant: &str, name: &'static str, text: &'static str) -> Self {
        assert!(is_kebab_case_of(name.as_bytes(), constant.as_bytes()), "a code is called as its constant");
        Self { name, text }
    }

    /// The name in kebab case, e.g. `dart-legs-differ`. It reads as what is wrong.
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.name
    }

    /// The mistake, and what to do about it.
    #[must_use]
    pub fn text(self) -> &'static str {
        self.text.trim_start()
    }
}

/// Findings hold the names of codes as text, since programs of others give findings too.
impl PartialEq<Code> for String {
    fn eq(&self, code: &Code) -> bool {
        self == code.name
    }
}

const fn is_kebab_case_of(name: &[u8], constant: &[u8]) -> bool {
    let mut i = 0;
    while i < name.len() && i < constant.len() {
        let expected = if name[i] == b'-' { b'_' } else { name[i].to_ascii_uppercase() };
        if constant[i] != expected || name[i].is_ascii_uppercase() {
            return false;
        }
        i += 1;
    }
    name.len() == constant.len()
}
