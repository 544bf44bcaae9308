//! Licences, bans and sources of all dependencies, by the rules of `deny.toml`.
//!
//! `cargo deny` does this and knows advisories, too. It takes minutes to compile, so it is used where it is installed;
//! elsewhere the same rules are asked of `cargo metadata` here, without advisories.

use crate::dependencies::{self, Dependency};
use crate::run::{Done, cargo, root, said};
use toml::{Table, Value};

/// Checks all dependencies.
pub fn check(more: &[String]) -> Done {
    if said("cargo", &["deny", "--version"]).is_ok() {
        return if more.is_empty() {
            cargo(&["deny", "check", "licenses", "bans", "sources"], &[])
        } else {
            cargo(&["deny"], more)
        };
    }
    let rules = rules()?;
    let all = dependencies::all(None)?;
    let mistakes: Vec<String> = all.iter().filter_map(|dependency| mistake(&rules, dependency)).collect();
    if mistakes.is_empty() {
        println!(
            "{} dependencies: licences, bans and sources are as deny.toml says; advisories were not asked",
            all.len()
        );
        return Ok(());
    }
    Err(mistakes.join("\n"))
}

struct Rules {
    licences: Vec<String>,
    banned: Vec<String>,
}

fn rules() -> Result<Rules, String> {
    let text = std::fs::read_to_string(root().join("deny.toml")).map_err(|e| format!("deny.toml: {e}"))?;
    let table: Table = toml::from_str(&text).map_err(|e| format!("deny.toml: {e}"))?;
    let list = |section: &str, key: &str| table.get(section)?.get(key)?.as_array().cloned();
    let licences = list("licenses", "allow").ok_or("deny.toml allows no licence")?;
    let banned = list("bans", "deny").unwrap_or_default();
    Ok(Rules {
        licences: licences.iter().filter_map(Value::as_str).map(str::to_owned).collect(),
        banned: banned.iter().filter_map(|b| b.get("crate")?.as_str()).map(str::to_owned).collect(),
    })
}

fn mistake(rules: &Rules, of: &Dependency) -> Option<String> {
    let who = format!("{} {}", of.name, of.version);
    if rules.banned.contains(&of.name) {
        return Some(format!("{who} is banned"));
    }
    if !of.source.starts_with("registry+https://github.com/rust-lang/crates.io-index") {
        return Some(format!("{who} comes from {}", of.source));
    }
    (!allowed(&rules.licences, &of.licence)).then(|| format!("{who} has the licence `{}`", of.licence))
}

/// Is an expression such as `(MIT OR Apache-2.0) AND Zlib` met by the allowed licences?
fn allowed(licences: &[String], expression: &str) -> bool {
    let expression = spdx::Expression::parse_mode(expression, spdx::ParseMode::LAX);
    expression.is_ok_and(|e| e.evaluate(|licence| licences.contains(&licence.to_string())))
}

#[cfg(test)]
mod tests {
    use super::allowed;

    #[test]
    fn expressions_are_met_or_not() {
        let licences: Vec<String> = ["MIT", "Zlib", "Apache-2.0 WITH LLVM-exception"].map(str::to_owned).into();
        for expression in
            ["MIT", "GPL-3.0 OR MIT", "MIT/Apache-2.0", "(GPL-3.0 OR MIT) AND Zlib", "Apache-2.0 WITH LLVM-exception"]
        {
            assert!(allowed(&licences, expression), "{expression}");
        }
        for expression in ["", "GPL-3.0", "MIT AND GPL-3.0", "(GPL-3.0 OR Apache-2.0) AND Zlib", "(MIT", "MIT Zlib"] {
            assert!(!allowed(&licences, expression), "{expression}");
        }
    }
}
