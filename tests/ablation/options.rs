//! The command line of the suite.

use std::path::PathBuf;

pub struct Options {
    /// Folders with projects.
    pub projects: Vec<PathBuf>,
    /// Are tuned numbers scaled, too?
    pub numbers: bool,
    /// Names of mechanisms and numbers; all where it is empty.
    pub only: Vec<String>,
    /// Word in the names of the cases.
    pub cases: String,
    /// Do the physics and the stability harness run, too?
    pub harnesses: bool,
    /// Longest time of a case, s.
    pub limit: f64,
    /// Cases that run side by side.
    pub jobs: usize,
}

impl Options {
    pub fn read(mut arguments: impl Iterator<Item = String>) -> Result<Self, String> {
        let mut options = Self {
            projects: Vec::new(),
            numbers: false,
            only: Vec::new(),
            cases: String::new(),
            harnesses: false,
            limit: 120.0,
            jobs: 1,
        };
        while let Some(switch) = arguments.next() {
            let mut value = || arguments.next().ok_or(format!("{switch} needs a value"));
            match switch.as_str() {
                "--projects" => options.projects.push(value()?.into()),
                "--numbers" => options.numbers = true,
                "--only" => options.only.push(value()?),
                "--cases" => options.cases = value()?,
                "--harnesses" => options.harnesses = true,
                "--limit" => options.limit = value()?.parse().map_err(|_| "--limit takes seconds".to_owned())?,
                "--jobs" => options.jobs = value()?.parse().map_err(|_| "--jobs takes a number".to_owned())?,
                other => return Err(format!("unknown switch {other}; the head of tests/ablation/main.rs lists all")),
            }
        }
        Ok(options)
    }
}
