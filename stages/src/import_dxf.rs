//! `import-dxf`: pieces from an AAMA or ASTM DXF, with its rule table and sewing file.

use crate::allowance::{self, AllowanceParams, Which};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use toile_formats::codes::{DART_UNDECIDED, OUT_OF_RANGE, SIZE_NOT_FOUND};
use toile_formats::dxf::darts::UndecidedDart;
use toile_formats::dxf::layers::Layers;
use toile_formats::dxf::{self, InsertRule, ReadOptions, Tolerances, Vendor};
use toile_formats::rul;
use toile_garment::sewing::SewingPlan;
use toile_garment::units::{Angle, Length};
use toile_garment::{Aspect, Code, Diagnostic, Garment, SourceRef};
use toile_stage_api::{Cost, Forecast, Stage, StageContext, StageError, StageInfo};

codes! {
    pub(crate) list CODES;

    /// Which program wrote the file, and why that is thought. Set `profile` of `import-dxf` to overrule it.
    DXF_PROFILE = "dxf-profile";

    /// `layers` of `import-dxf` lets a layer of the file stand for one that the standard does not have. Exit code 2.
    LAYER_UNKNOWN = "layer-unknown";

    /// How many entities of the file were accepted, interpreted by a rule, and refused. `toile inspect` lists the
    /// rules.
    LEDGER = "ledger";

    /// The `profile` asked for is no writer this program knows; the hint lists them. Exit code 2.
    PROFILE_UNKNOWN = "profile-unknown";

    /// A sewing file belongs to one size, and `size` of `import-dxf` is a list, or `size_run` of `export-dxf` writes all.
    /// Exit code 2.
    SIZES_WITH_SEWING = "sizes-with-sewing";
}

/// Most sizes of a list.
const SIZES: usize = 100;

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
    /// Metres.
    M,
}

impl FileUnit {
    /// Millimetres of a unit.
    #[must_use]
    pub fn mm(self) -> f64 {
        match self {
            Self::Mm => 1.0,
            Self::Cm => 10.0,
            Self::Inch => 25.4,
            Self::M => 1000.0,
        }
    }
}

/// The effect of an INSERT on the piece it places.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Inserts {
    /// Scale and mirroring change the piece; place and turn only lay it out.
    #[default]
    Shape,
    /// All of it: pieces lie as on the drawing.
    Placed,
    /// Nothing: pieces are as drawn in their blocks.
    Ignored,
}

/// One size, or several.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "a size in quotes, e.g. \"38\", or a list of sizes")]
pub enum SizeChoice {
    /// One size.
    One(String),
    /// Several, for printing and writing: each piece in each, called `piece@size`. `["all"]` is the whole run.
    Many(Vec<String>),
}

/// Parameters of `import-dxf`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ImportDxfParams {
    /// The DXF, relative to the pipeline file.
    #[schemars(extend("format" = "input-file"))]
    pub file: PathBuf,
    /// The sewing file: what is sewn to what, declared darts, placements.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("format" = "input-file"))]
    pub sewing: Option<PathBuf>,
    /// Size, or a list of sizes; without it the sample size of the file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size: Option<SizeChoice>,
    /// Names of the pieces to read, e.g. `["FRONT", "BACK"]`; without it all of them. A piece that is drawn wrongly
    /// refuses the file only if it is asked for.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pieces: Vec<String>,
    /// The rule table; without it the file of the same name with `.rul`, if it is there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("format" = "input-file"))]
    pub rules: Option<PathBuf>,
    /// Unit of the coordinates, overruling the file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub units: Option<FileUnit>,
    /// Layers of the file that stand for layers of the standard, e.g. `{ CUT = "1" }`, or are left out:
    /// `{ FRAME = "ignore" }`.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub layers: BTreeMap<String, String>,
    /// Code page of the texts, overruling the file, e.g. `"gbk"`, `"shift_jis"`, `"windows-1252"`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub code_page: Option<String>,
    /// Program that wrote the file, overruling what the file shows, e.g. `"gerber"`, `"browzwear"`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub profile: Option<String>,
    /// Gaps of an outline up to this are closed with a finding (0.5 mm).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gap: Option<Length>,
    /// Without marks in the file a vertex that turns more is a corner (20 deg).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub corner: Option<Angle>,
    /// Chords keep this near a curve (0.05 mm).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub curve: Option<Length>,
    /// Where an outline crosses itself, loops up to this across are cut off with a finding (15 mm).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub loops: Option<Length>,
    /// The effect of INSERTs on pieces (`shape`).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inserts: Option<Inserts>,
    /// Takes the outline of pieces that have no sew line for their sew line, and makes a cut line around it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub allowance: Option<AllowanceParams>,
}

/// The stage.
pub struct ImportDxf;

impl Stage for ImportDxf {
    type Params = ImportDxfParams;

    const INFO: StageInfo =
        StageInfo::new("import-dxf", "reads the pieces of an AAMA or ASTM DXF in one size", &[], &[Aspect::Pieces], 5);

    fn forecast(
        &self,
        params: &Self::Params,
        forecast: &mut Forecast,
        cx: &mut StageContext<'_>,
    ) -> Result<Option<Cost>, StageError> {
        // The sewing file and later stages are looked at, whatever is wrong with the pattern.
        let (read, wrong) = match pattern(params, Garment::default(), cx) {
            Ok(read) => (Some(read), None),
            Err(wrong) => (as_it_is(params, cx), Some(wrong)),
        };
        let sewn = match read {
            Some((garment, undecided)) => {
                forecast.garment = garment;
                sew(params, &mut forecast.garment, undecided, cx)
            }
            None => {
                let plan = params.sewing.as_ref().map_or(Ok(SewingPlan::default()), |p| crate::sewing::file(p, cx));
                plan.map(|plan| forecast.garment.plan = plan)
            }
        };
        forecast.in_doubt = wrong.is_some() || sewn.is_err();
        match (wrong, sewn) {
            (None, sewn) => sewn.map(|()| Some(Cost::seconds(0.01))),
            (Some(wrong), sewn) => {
                if let Err(StageError::Parameter(more)) = sewn {
                    cx.report.findings.extend(more);
                }
                Err(wrong)
            }
        }
    }

    fn run(
        &self,
        params: &ImportDxfParams,
        garment: Garment,
        cx: &mut StageContext<'_>,
    ) -> Result<Garment, StageError> {
        let (mut garment, undecided) = pattern(params, garment, cx)?;
        sew(params, &mut garment, undecided, cx)?;
        Ok(garment)
    }
}

/// All pieces of a pattern file in its sample size, without what is said of it beside its unit and its table. What is
/// wrong with it was told.
fn as_it_is(params: &ImportDxfParams, cx: &mut StageContext<'_>) -> Option<(Garment, Vec<UndecidedDart>)> {
    let kept = if options(params).is_ok() { params.clone() } else { ImportDxfParams::default() };
    let (file, units) = (params.file.clone(), params.units);
    let plain = ImportDxfParams { file, units, rules: None, size: None, pieces: Vec::new(), ..kept };
    let before = cx.report.findings.len();
    let read = pattern(&plain, Garment::default(), cx).ok();
    cx.report.findings.truncate(before);
    read
}

/// The pieces as they are drawn, and the wedges that the drawing leaves undecided.
fn pattern(
    params: &ImportDxfParams,
    garment: Garment,
    cx: &mut StageContext<'_>,
) -> Result<(Garment, Vec<UndecidedDart>), StageError> {
    let (pattern, table) = read(params, cx)?;
    let file = pattern.file.clone();
    // What is undecided is told once the sewing file is known, and of one size alone.
    let is_single = !matches!(params.size, Some(SizeChoice::Many(_)));
    let is_told_now = |f: &Diagnostic| !(is_single && f.code == DART_UNDECIDED);
    let told = pattern.findings_of_size(one_size(params.size.as_ref()));
    cx.report.findings.extend(told.into_iter().filter(is_told_now));
    cx.report.findings.extend(table.iter().flat_map(|t| pattern.check_rules(t)));
    let (mut read, findings) = in_sizes(params, &pattern, table.as_ref())?;
    cx.report.findings.extend(findings);
    report_profile(&pattern, &file, cx);
    report_ledger(&pattern, &file, cx);
    allowance::add(params.allowance.as_ref(), &mut read.pieces, Which::Missing, cx)?;
    let undecided = undecided(params, &pattern, table.as_ref())?;
    Ok((Garment { style: read.style, size: read.size, pieces: read.pieces, ..garment }, undecided))
}

/// The pieces of a pattern file that parameters ask for, in all its sizes, and its rule table.
///
/// # Errors
/// The file or its table cannot be read, or a parameter is wrong.
pub fn read(
    params: &ImportDxfParams,
    cx: &mut StageContext<'_>,
) -> Result<(dxf::Pattern, Option<rul::RuleTable>), StageError> {
    let file = params.file.to_string_lossy().into_owned();
    let bytes = cx.files.read(&params.file)?;
    let table = rule_table(params, cx)?;
    let rule_units = table.as_ref().and_then(|t| t.units.clone());
    let options = ReadOptions { rule_units, ..options(params)? };
    let mut pattern = dxf::read(&bytes, &file, &options).map_err(StageError::Input)?;
    cx.report.findings.extend(pattern.set_aside());
    if !params.pieces.is_empty() {
        pattern.keep_pieces(&params.pieces).map_err(StageError::Parameter)?;
    }
    Ok((pattern, table))
}

/// The parameters by which a garment was made of a pattern file, so that the file is read in the same way again. Another
/// file is read without any.
#[must_use]
pub fn params_of(file: &Path, garment: &Garment) -> ImportDxfParams {
    let stages = garment.provenance.stages.iter().rev().filter(|s| s.stage == ImportDxf::INFO.name);
    let mut all = stages.filter_map(|s| serde_json::from_value::<ImportDxfParams>(s.params.clone()).ok());
    let other = || ImportDxfParams { file: file.to_owned(), ..ImportDxfParams::default() };
    all.find(|p| p.file == file).unwrap_or_else(other)
}

/// The sound tables of the sewing file are looked at beside the wrong ones.
fn sew_sound_tables(
    path: &Path,
    garment: &mut Garment,
    undecided: Vec<UndecidedDart>,
    cx: &mut StageContext<'_>,
) -> Result<(), StageError> {
    let (plan, mut errors) = crate::sewing::sound_tables(path, cx)?;
    let sewn = match plan {
        Some(plan) => crate::sewing::apply_deciding(garment, plan, undecided, cx.report),
        None => {
            // Without their names nothing can be said of the pieces.
            garment.pieces.clear();
            Ok(())
        }
    };
    match sewn {
        sewn if errors.is_empty() => sewn,
        Err(StageError::Parameter(more)) => {
            errors.extend(more);
            Err(StageError::Parameter(errors))
        }
        _ => Err(StageError::Parameter(errors)),
    }
}

/// Adds what the sewing file says. Without it the drawing has the last word.
fn sew(
    params: &ImportDxfParams,
    garment: &mut Garment,
    undecided: Vec<UndecidedDart>,
    cx: &mut StageContext<'_>,
) -> Result<(), StageError> {
    match &params.sewing {
        Some(path) => sew_sound_tables(path, garment, undecided, cx),
        None => {
            cx.report.findings.extend(undecided.into_iter().map(|u| u.finding));
            Ok(())
        }
    }
}

/// The single size that was asked for; `None` is the sample size of the file.
fn one_size(size: Option<&SizeChoice>) -> Option<&str> {
    match size {
        Some(SizeChoice::One(size)) => Some(size.as_str()).filter(|s| !s.trim().is_empty()),
        _ => None,
    }
}

/// The wedges of a single size that the drawing leaves undecided.
fn undecided(
    params: &ImportDxfParams,
    pattern: &dxf::Pattern,
    table: Option<&rul::RuleTable>,
) -> Result<Vec<UndecidedDart>, StageError> {
    match &params.size {
        Some(SizeChoice::Many(_)) => Ok(Vec::new()),
        size => pattern.undecided_darts(one_size(size.as_ref()), table).map_err(by_fault),
    }
}

/// The garment in the size asked for, or in several.
fn in_sizes(
    params: &ImportDxfParams,
    pattern: &dxf::Pattern,
    table: Option<&rul::RuleTable>,
) -> Result<(Garment, Vec<Diagnostic>), StageError> {
    let sizes = match &params.size {
        Some(SizeChoice::Many(sizes)) => sizes,
        size => return pattern.to_garment(one_size(size.as_ref()), table).map_err(by_fault),
    };
    if params.sewing.is_some() {
        let text = "a sewing file belongs to one size, and `size` is a list";
        let hint = "sew one size, or leave `sewing` out to write or print several";
        return Err(StageError::parameter(Diagnostic::error(SIZES_WITH_SEWING, text).hint(hint)));
    }
    let all = sizes.len() == 1 && sizes[0].eq_ignore_ascii_case("all") && !pattern.sizes.contains(&sizes[0]);
    let sizes = if all { pattern.size_order(table) } else { sizes.clone() };
    if sizes.is_empty() || sizes.len() > SIZES {
        let text = format!("`size` names {} sizes; it must be 1 to {SIZES}", sizes.len());
        return Err(StageError::parameter(Diagnostic::error(OUT_OF_RANGE, text)));
    }
    pattern.to_garment_in_sizes(&sizes, table).map_err(by_fault)
}

/// The reader's options, every value in range.
fn options(params: &ImportDxfParams) -> Result<ReadOptions, StageError> {
    let mut faults = Vec::new();
    let mut within = |name: &str, value: Option<f64>, least: f64, most: f64, unit: &str, usual: f64| match value {
        Some(v) if !(least..=most).contains(&v) => {
            let text = format!("`{name}` is {v} {unit}; it must be {least} to {most} {unit}");
            faults.push(Diagnostic::error(OUT_OF_RANGE, text));
            usual
        }
        v => v.unwrap_or(usual),
    };
    let usual = Tolerances::default();
    let mm = |v: Option<Length>| v.map(|v| v.0 * 1e3);
    let tolerances = Tolerances {
        gap: within("gap", mm(params.gap), 0.0, 50.0, "mm", usual.gap),
        corner: within("corner", params.corner.map(|a| a.0.to_degrees()), 1.0, 120.0, "deg", usual.corner),
        curve: within("curve", mm(params.curve), 0.001, 2.0, "mm", usual.curve),
        loops: within("loops", mm(params.loops), 0.0, 100.0, "mm", usual.loops),
    };
    let vendor = params.profile.as_deref().map(|name| Vendor::named(name).ok_or(name)).transpose();
    let vendor = vendor.unwrap_or_else(|name| {
        let text = format!("`profile` is `{name}`, which is no writer this program knows");
        let hint = format!("there are: {}", Vendor::names().join(", "));
        faults.push(Diagnostic::error(PROFILE_UNKNOWN, text).hint(hint));
        None
    });
    for (layer, target) in params.layers.iter().filter(|(_, target)| !Layers::is_target(target)) {
        let text = format!("`layers` says that `{layer}` stands for `{target}`, which is no layer of the standard");
        let hint =
            "write the layer of the file first: `{ CUT = \"1\" }`, and \"ignore\" for one that is to be left out";
        faults.push(Diagnostic::error(LAYER_UNKNOWN, text).hint(hint));
    }
    if !faults.is_empty() {
        return Err(StageError::Parameter(faults));
    }
    let mm_per_unit = params.units.map(FileUnit::mm);
    Ok(ReadOptions {
        mm_per_unit,
        rule_units: None,
        layers: params.layers.clone(),
        code_page: params.code_page.clone(),
        vendor,
        tolerances,
        inserts: match params.inserts.unwrap_or_default() {
            Inserts::Shape => InsertRule::Shape,
            Inserts::Placed => InsertRule::Placed,
            Inserts::Ignored => InsertRule::Ignored,
        },
    })
}

/// A size that is not there is a wrong parameter; all else is a wrong file.
fn by_fault(findings: Vec<Diagnostic>) -> StageError {
    if findings.iter().all(|f| f.code == SIZE_NOT_FOUND) {
        StageError::Parameter(findings)
    } else {
        StageError::Input(findings)
    }
}

/// The rule table: as asked for, else the one beside the pattern. A broken one that was not asked for does not keep the
/// drawn sizes from being read: its mistakes become warnings.
fn rule_table(params: &ImportDxfParams, cx: &mut StageContext<'_>) -> Result<Option<rul::RuleTable>, StageError> {
    let (path, bytes) = match &params.rules {
        Some(path) => (path.clone(), Some(cx.files.read(path)?)),
        None => {
            let mut found = (PathBuf::new(), None);
            for ending in ["rul", "RUL", "Rul"] {
                let beside = Path::new(&params.file).with_extension(ending);
                if let Some(bytes) = cx.files.read_optional(&beside)? {
                    found = (beside, Some(bytes));
                    break;
                }
            }
            found
        }
    };
    let Some(bytes) = bytes else { return Ok(None) };
    match rul::read(&bytes, &path.to_string_lossy()) {
        Ok(table) => {
            cx.report.findings.extend(table.findings.iter().cloned());
            Ok(Some(table))
        }
        Err(list) if params.rules.is_some() => Err(StageError::Input(list)),
        Err(list) => {
            cx.report.findings.extend(rul::broken(list, &path.to_string_lossy()));
            Ok(None)
        }
    }
}

fn report_profile(pattern: &dxf::Pattern, file: &str, cx: &mut StageContext<'_>) {
    let profile = &pattern.profile;
    let effects: String = profile.effects.iter().map(|e| format!("; {e}")).collect();
    let (name, why) = (profile.vendor.name(), profile.reasons.join("; "));
    let sure = profile.confidence * 100.0;
    let text = if sure > 0.0 {
        format!("written by {name} ({sure:.0} %: {why}), as {}{effects}", profile.standard.0)
    } else {
        format!(
            "no program is known that writes as this file does; it is read as plain {}{effects}",
            profile.standard.0
        )
    };
    cx.report.push(Diagnostic::info(DXF_PROFILE, text).at(SourceRef::file(file)));
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
    cx.report.push(Diagnostic::info(LEDGER, text).at(SourceRef::file(file)));
}
