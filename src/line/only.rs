//! The part of a line that a run is asked for: `--only AXIS=CHOICE`.

use super::{Job, codes};
use crate::pipeline::remedy;
use std::collections::BTreeSet;
use toile_garment::Diagnostic;

/// Numbers of the jobs that have all the choices that are asked for.
///
/// # Errors
/// An axis or a choice that no job has, or choices that no job has together.
pub fn only(jobs: &[Job], asked: &[(String, String)]) -> Result<Vec<usize>, Diagnostic> {
    asked.iter().try_for_each(|(axis, choice)| check(jobs, axis, choice))?;
    let is_wanted = |job: &Job| asked.iter().all(|(axis, choice)| word(job, axis) == Some(choice));
    let wanted: Vec<usize> = jobs.iter().enumerate().filter(|(_, job)| is_wanted(job)).map(|(k, _)| k).collect();
    if wanted.is_empty() && !asked.is_empty() {
        let choices: Vec<String> = asked.iter().map(|(axis, choice)| format!("{axis}={choice}")).collect();
        let message = format!("no job has all of `--only {}`", choices.join(" --only "));
        return Err(Diagnostic::error(codes::LINE_CHOICE_UNKNOWN, message).hint("`toile line jobs` lists the jobs"));
    }
    Ok(wanted)
}

/// The choice of a job on an axis. `job` and `style` count as axes.
fn word<'a>(job: &'a Job, axis: &str) -> Option<&'a String> {
    match axis {
        "job" => Some(&job.name),
        "style" => Some(&job.style),
        _ => job.choices.get(axis),
    }
}

/// Axis and choice must be those of some job.
fn check(jobs: &[Job], axis: &str, choice: &str) -> Result<(), Diagnostic> {
    let known: BTreeSet<&str> = jobs.iter().filter_map(|job| word(job, axis)).map(String::as_str).collect();
    if known.contains(choice) {
        return Ok(());
    }
    let (message, hint) = if known.is_empty() {
        let axes = jobs.iter().flat_map(|job| job.choices.keys().map(String::as_str));
        let axes: BTreeSet<&str> = axes.chain(["job", "style"]).collect();
        (format!("`--only {axis}={choice}`: the line has no `{axis}`"), remedy(axis, axes.iter().copied()))
    } else {
        (format!("`--only {axis}={choice}`: `{axis}` has no `{choice}`"), remedy(choice, known.iter().copied()))
    };
    Err(Diagnostic::error(codes::LINE_CHOICE_UNKNOWN, message).hint(hint))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;
    use std::path::PathBuf;

    fn job(style: &str, size: &str) -> Job {
        Job {
            name: format!("{style}_{size}"),
            style: style.to_owned(),
            choices: BTreeMap::from([("size".to_owned(), size.to_owned())]),
            pipeline: PathBuf::new(),
            sets: Vec::new(),
            span: 0..0,
        }
    }

    #[test]
    fn a_part_of_a_line_is_chosen_by_names_that_it_has() {
        let jobs = [job("coat", "36"), job("coat", "38"), job("skirt", "38")];
        let of = |asked: &[(&str, &str)]| {
            let asked: Vec<_> = asked.iter().map(|(a, c)| ((*a).to_owned(), (*c).to_owned())).collect();
            only(&jobs, &asked).map_err(|f| format!("{} {}", f.message, f.hint.unwrap_or_default()))
        };
        assert_eq!(of(&[]), Ok(vec![0, 1, 2]));
        assert_eq!(of(&[("size", "38")]), Ok(vec![1, 2]));
        assert_eq!(of(&[("job", "coat_36")]), Ok(vec![0]));
        let refused = |asked: &[(&str, &str)]| of(asked).expect_err("no such part");
        assert!(refused(&[("sise", "38")]).contains("did you mean `size`?"));
        assert!(refused(&[("size", "39")]).contains("`size` has no `39`"));
        assert!(refused(&[("job", "coat_37")]).contains("did you mean `coat_36`?"));
        assert!(refused(&[("style", "skirt"), ("size", "36")]).contains("no job has all of"));
    }
}
