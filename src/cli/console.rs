//! stdout and stderr that may be closed at any time, as `| head` does.

use crate::engine::Exit;
use crate::halt::Halt;
use std::io::Write;
use toile_garment::Diagnostic;

/// Where a verb speaks.
pub struct Console<'a> {
    out: &'a mut dyn Write,
    err: &'a mut dyn Write,
}

impl<'a> Console<'a> {
    /// A console on two writers.
    pub fn new(out: &'a mut dyn Write, err: &'a mut dyn Write) -> Self {
        Self { out, err }
    }

    /// A result, to stdout. Nobody reading it any more is a quiet end, not an error.
    pub fn result(&mut self, text: &str) {
        drop(self.out.write_all(text.as_bytes()).and_then(|()| self.out.flush()));
    }

    /// A JSON result.
    pub fn json(&mut self, value: &serde_json::Value) {
        let mut text = toile_garment::text::json(&serde_json::to_string_pretty(value).unwrap_or_default());
        text.push('\n');
        self.result(&text);
    }

    /// Words to the user, to stderr.
    pub fn say(&mut self, text: &str) {
        drop(self.err.write_all(text.as_bytes()).and_then(|()| self.err.flush()));
    }

    /// Findings, to stderr.
    pub fn findings(&mut self, findings: &[Diagnostic], source: Option<(&str, &str)>) {
        self.say(&crate::render::findings_text(findings, source));
    }

    /// Why a verb halted, to stderr, and how the program ends.
    pub fn halted(&mut self, halt: &Halt) -> Exit {
        self.findings(&halt.findings, halt.source.as_ref().map(|(file, text)| (file.as_str(), text.as_str())));
        halt.exit
    }
}
