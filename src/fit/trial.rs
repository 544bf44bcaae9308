//! One round: a pattern is made, written, sewn and measured.

use super::folder::put;
use super::levels::{Level, Round, take};
use super::wearing::{Means, Worn};
use super::{Order, PATTERN_NAME, PIPELINE_NAME, SEWING_NAME};
use crate::engine::{Memory, of_stage_error, run_alone};
use crate::halt::Halt;
use crate::load::Request;
use toile_garment::body::Body;
use toile_garment::{Diagnostic, Garment, Report, Severity};
use toile_stage_api::{Registry, StageError};
use toile_stages::transfer::transferred;

/// Folder of the last drape, on the new body.
const RUN_NAME: &str = "run";

/// Names and contents of files.
type Files = Vec<(&'static str, Vec<u8>)>;

/// A pattern that was tried.
pub struct Tried {
    /// Girth that was added for it.
    pub add: Round,
    /// The garment on its own body, moved and laid flat.
    pub flat: Garment,
    /// The pattern on the new body.
    pub worn: Garment,
    /// Did its certificate pass?
    pub passed: bool,
    /// Largest difference of an ease from what is asked, metres.
    pub off: f64,
    /// Findings of the flattening and of the run.
    pub findings: Vec<Diagnostic>,
}

/// Makes patterns and tries them.
pub struct Bench<'a> {
    /// The wishes.
    pub order: &'a Order,
    /// How runs are done.
    pub means: &'a Means<'a>,
}

impl Bench<'_> {
    /// Writes a pattern, sews it and measures.
    ///
    /// # Errors
    /// When the garment cannot be laid flat, or its pattern cannot be sewn.
    pub fn tried(
        &self,
        own: &Garment,
        body: &Body,
        add: &Round,
        levels: &mut [Level],
        registry: &mut Registry,
    ) -> Result<Tried, Halt> {
        let (flat, mut findings) = self.pattern(own, body, add, registry)?;
        let request = Request { file: self.order.out.join(PIPELINE_NAME), ..Request::default() };
        let Worn { garment: worn, passed, findings: told } =
            self.means.wear(&request, self.order.out.join(RUN_NAME), registry, |_| Ok(()))?;
        findings.extend(told);
        take(&worn, levels);
        let followed = levels.iter().filter(|l| l.is_followed).map(|l| (l.asked - l.ease).abs());
        let off = followed.fold(None, |most: Option<f64>, off| Some(most.map_or(off, |m| m.max(off))));
        Ok(Tried { add: add.clone(), flat, worn, passed, off: off.unwrap_or(f64::INFINITY), findings })
    }

    /// Moves the garment to the body, lays it flat and writes its pattern into the folder.
    fn pattern(
        &self,
        own: &Garment,
        body: &Body,
        add: &Round,
        registry: &Registry,
    ) -> Result<(Garment, Vec<Diagnostic>), Halt> {
        let mut report = Report::default();
        let written = self.written(own, body, add, registry, &mut report);
        let (garment, files) = written.map_err(|error| {
            let (findings, exit) = of_stage_error(error);
            Halt::new(report.findings.iter().cloned().chain(findings).collect(), exit)
        })?;
        for (name, bytes) in files {
            put(&self.order.out.join(name), &bytes)?;
        }
        let told = report.findings.into_iter().filter(|f| f.severity != Severity::Info);
        Ok((garment, told.collect()))
    }

    /// The garment laid flat, with names and contents of the files of its pattern.
    fn written(
        &self,
        own: &Garment,
        body: &Body,
        add: &Round,
        registry: &Registry,
        report: &mut Report,
    ) -> Result<(Garment, Files), StageError> {
        let worn_by = own.body.clone().unwrap_or_default();
        let mut moved = transferred(own.clone(), &worn_by, body.clone(), add)?;
        label(&mut moved, &label_of(self.order));
        let mut files = Memory::default();
        let flatten = ("flatten", self.order.flatten.as_str());
        let flat = run_alone(registry, flatten, moved, self.means.stop, report, &mut files)?;
        let params = format!("{{ file = \"{{out}}/{PATTERN_NAME}\", sewing = \"{{out}}/{SEWING_NAME}\" }}");
        run_alone(registry, ("export-dxf", &params), flat.clone(), self.means.stop, report, &mut files)?;
        let taken = [PATTERN_NAME, SEWING_NAME].map(|name| Ok((name, files.take(name)?)));
        Ok((flat, taken.into_iter().collect::<Result<_, StageError>>()?))
    }
}

/// The size label of the pattern: the name of the body.
fn label_of(order: &Order) -> String {
    let name = order.body.file_name();
    let stem = name.strip_suffix(".obj").unwrap_or(&name);
    let kept = stem.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_uppercase() } else { '-' });
    kept.collect::<String>().trim_matches('-').to_owned()
}

/// Puts another size label on a garment, and on its blocks that end with the one it had.
fn label(garment: &mut Garment, size: &str) {
    let old = garment.size.replace(size.to_owned());
    let Some(old) = old.filter(|o| !o.is_empty()) else { return };
    for piece in &mut garment.pieces {
        piece.size = Some(size.to_owned());
        if let Some(name) = piece.block.strip_suffix(&old) {
            piece.block = format!("{name}{size}");
        }
    }
}
