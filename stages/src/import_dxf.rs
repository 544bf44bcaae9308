//! `import-dxf`: pieces from an AAMA or ASTM DXF, with its rule table and sewing file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use toile_formats::dxf::{self, ReadOptions};
use toile_formats::rul;
use toile_garment::{Aspect, Diagnostic, Garment, SourceRef};
use toile_stage_api::{Stage, StageContext, StageError, StageInfo};

/// The unit of a file, when the file is wrong or silent about it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum FileUnit {
    /// Millimetres.
    Mm,
    /// Centimetres.
    Cm,
    /// Inches.
    Inch,
}

impl FileUnit {
    fn mm(self) -> f64 {
        match self {
            Self::Mm => 1.0,
            Self::Cm => 10.0,
            Self::Inch => 25.4,
        }
    }
}

/// Parameters of `import-dxf`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ImportDxfParams {
    /// The DXF, relative to the pipeline file.
    pub file: PathBuf,
    /// The sewing file: what is sewn to what, declared darts, placements.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sewing: Option<PathBuf>,
    /// Size; without it the sample size of the file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size: Option<String>,
    /// The rule table; without it the file of the same name with `.rul`, if it is there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rules: Option<PathBuf>,
    /// Unit of the coordinates, overruling the file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub units: Option<FileUnit>,
    /// Layers of the file that stand for other layers of the standard, e.g. `{ CUT = "1" }`.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub layers: BTreeMap<String, String>,
}

/// The stage.
pub struct ImportDxf;

impl Stage for ImportDxf {
    type Params = ImportDxfParams;

    const INFO: StageInfo =
        StageInfo::new("import-dxf", "reads the pieces of an AAMA or ASTM DXF in one size", &[], &[Aspect::Pieces], 1);

    fn run(
        &self,
        params: &ImportDxfParams,
        garment: Garment,
        cx: &mut StageContext<'_>,
    ) -> Result<Garment, StageError> {
        let file = params.file.to_string_lossy().into_owned();
        let bytes = cx.files.read(&params.file)?;
        let options = ReadOptions { mm_per_unit: params.units.map(FileUnit::mm), layers: params.layers.clone() };
        let pattern = dxf::read(&bytes, &file, &options).map_err(StageError::Input)?;
        cx.report.findings.extend(pattern.findings.iter().cloned());
        let table = rule_table(params, cx)?;
        let size = params.size.as_deref().filter(|s| !s.trim().is_empty());
        let (read, findings) = pattern.to_garment(size, table.as_ref()).map_err(by_fault)?;
        cx.report.findings.extend(findings);
        report_ledger(&pattern, &file, cx);
        let mut garment = Garment { style: read.style, size: read.size, pieces: read.pieces, ..garment };
        if let Some(path) = &params.sewing {
            let name = path.to_string_lossy().into_owned();
            let bytes = cx.files.read(path)?;
            let text = String::from_utf8(bytes).map_err(|_| {
                let text = format!("the sewing file `{name}` is not UTF-8 text");
                StageError::parameter(Diagnostic::error("sewing-file", text).at(SourceRef::file(name.clone())))
            })?;
            let plan = toile_formats::sewing::read(&text, &name).map_err(StageError::Parameter)?;
            crate::sewing::apply(&mut garment, plan, cx.report)?;
        }
        Ok(garment)
    }
}

/// A size that is not there is a wrong parameter; all else is a wrong file.
fn by_fault(findings: Vec<Diagnostic>) -> StageError {
    if findings.iter().all(|f| f.code == "size-not-found") {
        StageError::Parameter(findings)
    } else {
        StageError::Input(findings)
    }
}

fn rule_table(params: &ImportDxfParams, cx: &mut StageContext<'_>) -> Result<Option<rul::RuleTable>, StageError> {
    let (path, bytes) = match &params.rules {
        Some(path) => (path.clone(), Some(cx.files.read(path)?)),
        None => {
            let beside: PathBuf = Path::new(&params.file).with_extension("rul");
            let bytes = cx.files.read_optional(&beside)?;
            (beside, bytes)
        }
    };
    let Some(bytes) = bytes else { return Ok(None) };
    let table = rul::read(&bytes, &path.to_string_lossy()).map_err(StageError::Input)?;
    cx.report.findings.extend(table.findings.iter().cloned());
    Ok(Some(table))
}

fn report_ledger(pattern: &dxf::Pattern, file: &str, cx: &mut StageContext<'_>) {
    use dxf::ledger::Verdict;
    let l = &pattern.ledger;
    let count = |v| l.count(v);
    let text = format!(
        "{} entities: {} accepted, {} interpreted, {} refused",
        l.entities(),
        count(Verdict::Accepted),
        count(Verdict::Interpreted),
        count(Verdict::Refused)
    );
    cx.report.push(Diagnostic::info("ledger", text).at(SourceRef::file(file)));
}
