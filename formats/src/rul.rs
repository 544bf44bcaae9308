//! Grade rule tables (`.rul`), the companion of an AAMA or ASTM DXF file.
//!
//! The reader takes all deviations that were seen in the field. Commas may be missing, and SAMPLE SIZE may stand before
//! or after the size list. All pairs may stand on the RULE line, or one pair a line. The first line may be blank. It
//! takes `ANSI/AAMA` and `ASTM` headers.

use crate::codes::FILE_TOO_LARGE;
use crate::encoding;
use std::collections::BTreeMap;
use toile_garment::{Code, Diagnostic, SourceRef, Vec2};

codes! {
    pub(crate) list CODES;

    /// A growth in the rule table is no number. Exit code 3.
    RULE_BAD_NUMBER = "rule-bad-number";

    /// A rule has not two growths for each size. Exit code 3.
    RULE_COUNT_DIFFERS = "rule-count-differs";

    /// The rule table ends without END. What is there was read, but rules may be missing; make sure that it was copied
    /// completely.
    RULE_END_MISSING = "rule-end-missing";

    /// A rule moves points in the sample size, which should stay as drawn. The growth of other sizes is taken relative
    /// to the table's own sample.
    RULE_SAMPLE_MOVES = "rule-sample-moves";

    /// The sample size is not in the list of sizes. Exit code 3.
    RULE_SAMPLE_UNKNOWN = "rule-sample-unknown";

    /// The number of sizes and the list of sizes differ. Exit code 3.
    RULE_SIZES_DIFFER = "rule-sizes-differ";

    /// The rule table beside the pattern is wrong, as the findings after this one say. The pieces were read without it;
    /// a run that needs it is refused.
    RULE_TABLE_BROKEN = "rule-table-broken";

    /// The rule table is larger than the limit. Exit code 3.
    RULE_TOO_MANY = "rule-too-many";

    /// A rule stands in the table twice; the last one counts.
    RULE_TWICE = "rule-twice";

    /// A line of the rule table is no key, rule or growth. Exit code 3.
    RULE_UNKNOWN = "rule-unknown";

    /// The rule table lists no sizes, so its growths belong to none. Exit code 3.
    RULE_WITHOUT_SIZES = "rule-without-sizes";
}

/// Most sizes of a table.
const SIZES: usize = 500;
/// Most numbers of a table.
const NUMBERS: usize = 2_000_000;
/// Largest file, bytes.
const BYTES: usize = 16 << 20;
/// Largest growth, in the table's unit.
const GROWTH: f64 = 1e5;

/// A grade rule table; growths in millimetres relative to the sample size.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RuleTable {
    /// Name of the table.
    pub name: Option<String>,
    /// `METRIC` or `ENGLISH` as written.
    pub units: Option<String>,
    /// Sizes in order.
    pub sizes: Vec<String>,
    /// The sample size.
    pub sample: Option<String>,
    /// Growth per size by rule number, mm.
    pub rules: BTreeMap<u32, Vec<Vec2>>,
    /// Findings that are no errors.
    pub findings: Vec<Diagnostic>,
}

impl RuleTable {
    /// Index of a size, by its exact name or else without regard to case.
    #[must_use]
    pub fn size_index(&self, size: &str) -> Option<usize> {
        let size = size.trim();
        self.sizes
            .iter()
            .position(|s| s == size)
            .or_else(|| self.sizes.iter().position(|s| s.eq_ignore_ascii_case(size)))
    }
}

struct Open {
    number: u32,
    line: u64,
    values: Vec<f64>,
}

struct Reader<'a> {
    file: &'a str,
    table: RuleTable,
    count: Option<usize>,
    /// Lines of NUMBER OF SIZES, SAMPLE SIZE and the last line.
    lines: [u64; 3],
    rule: Option<Open>,
    in_sizes: bool,
    numbers: usize,
    raw: Vec<Open>,
    errors: Vec<Diagnostic>,
    ended: bool,
}

/// Reads a table. `file` is its name for messages.
///
/// # Errors
/// All mistakes, each with its line.
pub fn read(bytes: &[u8], file: &str) -> Result<RuleTable, Vec<Diagnostic>> {
    let place = SourceRef::file(file);
    if bytes.len() > BYTES {
        return Err(vec![
            Diagnostic::error(FILE_TOO_LARGE, format!("a rule table of {} bytes", bytes.len())).at(place),
        ]);
    }
    let text = encoding::choose(bytes, None, None);
    let mut reader = Reader {
        file,
        table: RuleTable::default(),
        count: None,
        lines: [1; 3],
        rule: None,
        in_sizes: false,
        numbers: 0,
        raw: Vec::new(),
        errors: Vec::new(),
        ended: false,
    };
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    for (i, line) in bytes.split(|b| *b == b'\n').enumerate() {
        reader.line(encoding::unescape(&text.decode(line.trim_ascii())).trim(), i as u64 + 1);
        if reader.ended || reader.errors.len() > 20 {
            break;
        }
    }
    reader.finish()
}

/// The mistakes of a table that nobody asked for, as warnings: the sizes that are drawn can be used without it.
#[must_use]
pub fn broken(mistakes: Vec<Diagnostic>, file: &str) -> Vec<Diagnostic> {
    let text = format!("the rule table `{file}` is wrong; only drawn sizes can be made until it is mended");
    let place = mistakes.first().and_then(|f| f.source.clone());
    let first = Diagnostic::warning(RULE_TABLE_BROKEN, text).at(place);
    std::iter::once(first).chain(mistakes.into_iter().map(Diagnostic::softened)).collect()
}

impl Reader<'_> {
    fn place(&self, line: u64) -> SourceRef {
        SourceRef::file(self.file).at_line(line)
    }

    fn error(&mut self, code: Code, text: String, line: u64) {
        let place = self.place(line);
        self.errors.push(Diagnostic::error(code, text).at(place));
    }

    fn line(&mut self, text: &str, line: u64) {
        let (key, value) = text.split_once(':').map_or((text, ""), |(k, v)| (k, v.trim()));
        let key = key.split_whitespace().collect::<Vec<_>>().join(" ").to_ascii_uppercase();
        let in_sizes = std::mem::take(&mut self.in_sizes);
        if !text.is_empty() {
            self.lines[2] = line;
        }
        match key.as_str() {
            "" => self.in_sizes = in_sizes,
            "END" => self.ended = true,
            "UNITS" => self.table.units = Some(value.to_owned()),
            "GRADE RULE TABLE" => self.table.name = Some(value.to_owned()),
            "SAMPLE SIZE" => {
                self.table.sample = Some(value.to_owned());
                self.lines[1] = line;
            }
            "NUMBER OF SIZES" => {
                self.count = value.parse().ok();
                self.lines[0] = line;
            }
            "SIZE LIST" => {
                self.table.sizes.clear();
                self.add_sizes(value);
            }
            "RULE" => self.open_rule(value, line),
            _ if in_sizes && !text.contains(':') => self.add_sizes(text),
            _ if self.rule.is_some() && starts_number(text) => self.values(text, line),
            _ if self.rule.is_some() && !text.contains(':') => {
                self.error(RULE_BAD_NUMBER, format!("`{}` is no list of growths", short(text)), line);
            }
            _ => {}
        }
    }

    fn add_sizes(&mut self, text: &str) {
        let names = text.split(|c: char| c.is_whitespace() || c == ',').filter(|s| !s.is_empty());
        self.table.sizes.extend(names.map(str::to_owned).take(SIZES));
        self.table.sizes.truncate(SIZES);
        self.in_sizes = self.count.is_some_and(|n| self.table.sizes.len() < n) || self.table.sizes.is_empty();
    }

    fn open_rule(&mut self, value: &str, line: u64) {
        self.close_rule();
        let mut words = value.split_whitespace();
        let delta = words.next().is_some_and(|w| w.eq_ignore_ascii_case("delta"));
        let number = words.next().and_then(|n| n.trim_end_matches(',').parse().ok());
        let Some(number) = number.filter(|_| delta) else {
            self.error(RULE_UNKNOWN, format!("expected `RULE: DELTA n`, found `RULE: {}`", short(value)), line);
            return;
        };
        self.rule = Some(Open { number, line, values: Vec::new() });
        let rest: Vec<&str> = words.collect();
        self.values(&rest.join(" "), line);
    }

    fn values(&mut self, text: &str, line: u64) {
        for word in text.split(|c: char| c.is_whitespace() || c == ',').filter(|w| !w.is_empty()) {
            let plain = word.bytes().all(|b| b.is_ascii_digit() || b"+-.eE".contains(&b));
            match word.parse::<f64>().ok().filter(|v| plain && v.is_finite() && v.abs() <= GROWTH) {
                Some(v) if self.numbers < NUMBERS => {
                    self.numbers += 1;
                    if let Some(rule) = &mut self.rule {
                        rule.values.push(v);
                    }
                }
                Some(_) => {
                    self.error(RULE_TOO_MANY, format!("more than {NUMBERS} numbers"), line);
                    self.ended = true;
                    return;
                }
                None => self.error(RULE_BAD_NUMBER, format!("`{}` is not a finite number", short(word)), line),
            }
        }
    }

    fn close_rule(&mut self) {
        self.raw.extend(self.rule.take());
    }

    fn finish(mut self) -> Result<RuleTable, Vec<Diagnostic>> {
        self.close_rule();
        let n = self.table.sizes.len();
        if n == 0 {
            // Without sizes nothing else can be judged.
            self.error(RULE_WITHOUT_SIZES, "the rule table has no SIZE LIST".into(), 1);
            return Err(self.errors);
        }
        if let Some(count) = self.count.filter(|c| *c != n && n > 0) {
            self.error(RULE_SIZES_DIFFER, format!("NUMBER OF SIZES is {count}, SIZE LIST holds {n}"), self.lines[0]);
        }
        let sample = match self.table.sample.clone().map(|s| self.table.size_index(&s).ok_or(s)) {
            Some(Ok(i)) => Some(i),
            Some(Err(s)) if n > 0 => {
                let list = self.table.sizes.join(" ");
                let text = format!("SAMPLE SIZE `{}` is not in SIZE LIST {list}", short(&s));
                self.error(RULE_SAMPLE_UNKNOWN, text, self.lines[1]);
                None
            }
            _ => None,
        };
        let mm = match self.table.units.as_deref() {
            Some(units) => crate::dxf::unit(units).unwrap_or(1.0),
            None => 1.0,
        };
        for rule in std::mem::take(&mut self.raw) {
            if rule.values.len() != 2 * n {
                let text =
                    format!("rule {} has {} numbers, {} sizes need {}", rule.number, rule.values.len(), n, 2 * n);
                self.error(RULE_COUNT_DIFFERS, text, rule.line);
                continue;
            }
            let growth: Vec<Vec2> = rule.values.chunks_exact(2).map(|p| Vec2::new(p[0], p[1]) * mm).collect();
            if let Some(at_sample) = sample.map(|i| growth[i]).filter(|g| g.norm() > 1e-6) {
                let text =
                    format!("rule {} moves the sample size by ({}, {}) mm", rule.number, at_sample.x, at_sample.y);
                let place = self.place(rule.line);
                self.table.findings.push(Diagnostic::warning(RULE_SAMPLE_MOVES, text).at(place));
            }
            if self.table.rules.insert(rule.number, growth).is_some() {
                let place = self.place(rule.line);
                let text = format!("rule {} stands twice; the last one counts", rule.number);
                self.table.findings.push(Diagnostic::warning(RULE_TWICE, text).at(place));
            }
        }
        if !self.ended {
            let text = "the rule table has no END: rules may be missing at its end";
            let place = self.place(self.lines[2]);
            let finding = Diagnostic::warning(RULE_END_MISSING, text).at(place).hint("get a whole copy of the table");
            self.table.findings.push(finding);
        }
        if self.errors.is_empty() { Ok(self.table) } else { Err(self.errors) }
    }
}

/// Writes a table: ASTM or AAMA by its header, with commas or with blanks alone between numbers.
#[must_use]
pub fn write(table: &RuleTable, astm: bool, commas: bool) -> Vec<u8> {
    write_with(table, astm, commas, false)
}

/// Writes a table as [`write()`] does, in inches or millimetres.
#[must_use]
pub fn write_with(table: &RuleTable, astm: bool, commas: bool, inches: bool) -> Vec<u8> {
    let or = |text: &Option<String>| crate::dxf::write::escaped(text.as_deref().unwrap_or_default());
    let version = if astm { "ASTM/D13Proposal 1 Version: D 6673-04" } else { "ANSI/AAMA VERSION: 1.0.0" };
    let sizes: Vec<String> = table.sizes.iter().map(|s| crate::dxf::write::escaped(&s.replace(' ', "-"))).collect();
    let mut lines = vec![
        version.to_owned(),
        format!("UNITS: {}", if inches { "ENGLISH" } else { "METRIC" }),
        format!("GRADE RULE TABLE: {}", or(&table.name)),
        format!("NUMBER OF SIZES: {}", sizes.len()),
        format!("SIZE LIST: {}", sizes.join(" ")),
        format!("SAMPLE SIZE: {}", or(&table.sample).replace(' ', "-")),
    ];
    let (unit, digits) = if inches { (25.4, 6) } else { (1.0, 4) };
    let number = |v: f64| crate::dxf::write::decimals(v / unit, digits);
    for (rule, growth) in &table.rules {
        lines.push(format!("RULE: DELTA {rule}"));
        for row in growth.chunks(4) {
            let comma = if commas { "," } else { "" };
            let pairs: Vec<String> = row.iter().map(|g| format!("{}{comma} {}", number(g.x), number(g.y))).collect();
            lines.push(format!("  {}", pairs.join("  ")));
        }
    }
    lines.push("END".to_owned());
    lines.iter().flat_map(|l| [l.as_bytes(), b"\r\n"]).flatten().copied().collect()
}

fn starts_number(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_digit() || "+-.,".contains(c))
}

fn short(text: &str) -> String {
    text.chars().take(40).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(text: &str) -> RuleTable {
        read(text.as_bytes(), "t.rul").expect("table")
    }

    #[test]
    fn commas_no_commas_and_one_line() {
        let a = table(
            "\nASTM/D13Proposal 1 Version: D 6673-04\r\nUNITS: METRIC\r\nGRADE RULE TABLE: T\r\nNUMBER OF SIZES: 3\r\nSIZE LIST:  36 38 40\r\nSAMPLE SIZE: 38\r\nRULE: DELTA 1\r\n  -10.0, 0.0  0.0, 0.0\r\n  10.0,  6.0\r\nEND\r\n",
        );
        let b = table(
            "ANSI/AAMA VERSION: 1.0.0\nSAMPLE SIZE: 38\nNUMBER OF SIZES: 3\nSIZE LIST: 36 38\n 40\nRULE: DELTA 1 -10 0 0 0 10 6\n",
        );
        assert_eq!(a.rules, b.rules);
        assert_eq!(a.sizes, ["36", "38", "40"]);
        assert_eq!(a.rules[&1][2], Vec2::new(10.0, 6.0));
        assert_eq!(a.name.as_deref(), Some("T"));
    }

    #[test]
    fn inches_become_millimetres() {
        let t = table(
            "UNITS: ENGLISH\nNUMBER OF SIZES: 2\nSIZE LIST: S M\nSAMPLE SIZE: S\nRULE: DELTA 4\n0 0\n1 -0.5\nEND",
        );
        assert_eq!(t.rules[&4][1], Vec2::new(25.4, -12.7));
    }

    #[test]
    fn mistakes_have_lines() {
        let e = read(
            b"NUMBER OF SIZES: 2\nSIZE LIST: S M\nSAMPLE SIZE: S\nRULE: DELTA 1\n0 0 1\nRULE: DELTA 2\n0 0 nan 1\n",
            "t.rul",
        )
        .expect_err("wrong");
        let codes: Vec<&str> = e.iter().map(|d| d.code.as_str()).collect();
        assert_eq!(codes, ["rule-bad-number", "rule-count-differs", "rule-count-differs"]);
        assert_eq!(e[0].source.as_ref().and_then(|s| s.line), Some(7));
        let e = read(b"NUMBER OF SIZES: 2\nSIZE LIST: S M\nSAMPLE SIZE: L\n", "t.rul").expect_err("wrong");
        assert_eq!(e[0].code, "rule-sample-unknown");
        assert!(read(b"", "t.rul").is_err());
    }

    #[test]
    fn a_sample_that_moves_is_said() {
        let t = table("NUMBER OF SIZES: 2\nSIZE LIST: S M\nSAMPLE SIZE: S\nRULE: DELTA 1\n1 0 2 0\n");
        assert_eq!(t.findings[0].code, "rule-sample-moves");
    }
}
