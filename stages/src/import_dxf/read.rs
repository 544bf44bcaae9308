//! Reading a pattern file as its parameters ask for it. None of their mistakes hides another: what is wrong is left out,
//! and the rest is read.

use super::{DXF_PROFILE, LEDGER};
use super::{FileUnit, ImportDxfParams, Inserts, LAYER_UNKNOWN, PROFILE_UNKNOWN, SIZES_WITH_SEWING, SizeChoice};
use crate::allowance::{self, Which};
use std::path::{Path, PathBuf};
use toile_formats::codes::{DART_UNDECIDED, OUT_OF_RANGE, SIZE_NOT_FOUND};
use toile_formats::dxf::darts::UndecidedDart;
use toile_formats::dxf::layers::Layers;
use toile_formats::dxf::{self, InsertRule, ReadOptions, Tolerances, Vendor};
use toile_formats::{encoding, rul};
use toile_garment::units::Length;
use toile_garment::{Diagnostic, Garment, SourceRef};
use toile_stage_api::{Errors, StageContext, StageError};

/// Most sizes of a list.
const SIZES: usize = 100;

/// The pieces in the size asked for, and the wedges that the drawing leaves undecided. A size that is not there gives them
/// in the sample size.
pub(super) fn pieces(
    params: &ImportDxfParams,
    errors: &mut Errors,
    cx: &mut StageContext<'_>,
) -> Option<(Garment, Vec<UndecidedDart>)> {
    let (pattern, table) = pattern(params, errors, cx)?;
    // What is undecided is told once the sewing file is known, and of one size alone.
    let is_single = !matches!(params.size, Some(SizeChoice::Many(_)));
    let is_told_now = |f: &Diagnostic| !(is_single && f.code == DART_UNDECIDED);
    let told = pattern.findings_of_size(one_size(params.size.as_ref()));
    cx.report.findings.extend(told.into_iter().filter(is_told_now));
    cx.report.findings.extend(table.iter().flat_map(|t| pattern.check_rules(t)));
    let asked = errors.keep(in_sizes(params, &pattern, table.as_ref()));
    let (garment, findings, undecided) =
        asked.or_else(|| one_of(None, &pattern, table.as_ref()).or_else(|_| one_of(None, &pattern, None)).ok())?;
    let mut garment = garment;
    cx.report.findings.extend(findings);
    report_profile(&pattern, &pattern.file, cx);
    report_ledger(&pattern, &pattern.file, cx);
    errors.keep(allowance::add(params.allowance.as_ref(), &mut garment.pieces, Which::Missing, cx));
    Some((garment, undecided))
}

/// The pieces of a pattern file that parameters ask for, in all its sizes, and its rule table.
///
/// # Errors
/// The file or its table cannot be read, or a parameter is wrong.
pub fn read(
    params: &ImportDxfParams,
    cx: &mut StageContext<'_>,
) -> Result<(dxf::Pattern, Option<rul::RuleTable>), StageError> {
    let mut errors = Errors::default();
    let read = pattern(params, &mut errors, cx);
    errors.finish()?;
    read.ok_or_else(|| StageError::Internal("a pattern that cannot be read has no fault".to_owned()))
}

/// The same as far as it can be read, and what is wrong.
fn pattern(
    params: &ImportDxfParams,
    errors: &mut Errors,
    cx: &mut StageContext<'_>,
) -> Option<(dxf::Pattern, Option<rul::RuleTable>)> {
    let bytes = errors.keep(cx.files.read(&params.file));
    let table = errors.keep(rule_table(params, cx)).flatten();
    let (options, faults) = options(params);
    errors.parameters(faults);
    let options = ReadOptions { rule_units: table.as_ref().and_then(|t| t.units.clone()), ..options };
    let read = dxf::read(&bytes?, &params.file.to_string_lossy(), &options);
    let mut pattern = errors.keep(read.map_err(StageError::Input))?;
    cx.report.findings.extend(pattern.set_aside());
    if !params.pieces.is_empty() {
        errors.keep(pattern.keep_pieces(&params.pieces).map_err(StageError::Parameter));
    }
    Some((pattern, table))
}

/// The single size that was asked for; `None` is the sample size of the file.
fn one_size(size: Option<&SizeChoice>) -> Option<&str> {
    match size {
        Some(SizeChoice::One(size)) => Some(size.as_str()).filter(|s| !s.trim().is_empty()),
        _ => None,
    }
}

/// The garment in a size or in several, what was found on the way, and the wedges of a single size that the drawing leaves
/// undecided.
type Sized = (Garment, Vec<Diagnostic>, Vec<UndecidedDart>);

/// The garment in one size.
fn one_of(size: Option<&str>, pattern: &dxf::Pattern, table: Option<&rul::RuleTable>) -> Result<Sized, StageError> {
    let (garment, findings) = pattern.to_garment(size, table).map_err(by_fault)?;
    Ok((garment, findings, pattern.undecided_darts(size, table).map_err(by_fault)?))
}

/// The garment in the size asked for, or in several.
fn in_sizes(
    params: &ImportDxfParams,
    pattern: &dxf::Pattern,
    table: Option<&rul::RuleTable>,
) -> Result<Sized, StageError> {
    let Some(SizeChoice::Many(sizes)) = &params.size else {
        return one_of(one_size(params.size.as_ref()), pattern, table);
    };
    let mut errors = Errors::default();
    if params.sewing.is_some() {
        let text = "a sewing file belongs to one size, and `size` is a list";
        let hint = "sew one size, or leave `sewing` out to write or print several";
        errors.parameters(vec![Diagnostic::error(SIZES_WITH_SEWING, text).hint(hint)]);
    }
    let all = sizes.len() == 1 && sizes[0].eq_ignore_ascii_case("all") && !pattern.sizes.contains(&sizes[0]);
    let sizes = if all { pattern.size_order(table) } else { sizes.clone() };
    if sizes.is_empty() || sizes.len() > SIZES {
        let text = format!("`size` names {} sizes; it must be 1 to {SIZES}", sizes.len());
        return errors.finish_with(Err(StageError::parameter(Diagnostic::error(OUT_OF_RANGE, text))));
    }
    let made = pattern.to_garment_in_sizes(&sizes, table).map_err(by_fault);
    errors.finish_with(made.map(|(garment, findings)| (garment, findings, Vec::new())))
}

/// The reader's options, and what is wrong with them. A value out of range becomes the nearest one in range, and a layer
/// or a profile that is not known is left out.
fn options(params: &ImportDxfParams) -> (ReadOptions, Vec<Diagnostic>) {
    let mut faults = Vec::new();
    let mut within = |name: &str, value: Option<f64>, least: f64, most: f64, unit: &str, usual: f64| match value {
        Some(v) if !(least..=most).contains(&v) => {
            let text = format!("`{name}` is {v} {unit}; it must be {least} to {most} {unit}");
            faults.push(Diagnostic::error(OUT_OF_RANGE, text));
            if v > least { most } else { least }
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
    let (layers, unknown): (Vec<_>, Vec<_>) = params.layers.iter().partition(|(_, target)| Layers::is_target(target));
    faults.extend(unknown.into_iter().map(|(layer, target)| layer_unknown(layer, target)));
    let page = params.code_page.as_deref().filter(|name| match encoding::asked(name) {
        Ok(_) => true,
        Err(unknown) => {
            faults.push(*unknown);
            false
        }
    });
    let mm_per_unit = params.units.map(FileUnit::mm);
    let options = ReadOptions {
        mm_per_unit,
        rule_units: None,
        layers: layers.into_iter().map(|(layer, target)| (layer.clone(), target.clone())).collect(),
        code_page: page.map(str::to_owned),
        vendor,
        tolerances,
        inserts: match params.inserts.unwrap_or_default() {
            Inserts::Shape => InsertRule::Shape,
            Inserts::Placed => InsertRule::Placed,
            Inserts::Ignored => InsertRule::Ignored,
        },
    };
    (options, faults)
}

fn layer_unknown(layer: &str, target: &str) -> Diagnostic {
    let text = format!("`layers` says that `{layer}` stands for `{target}`, which is no layer of the standard");
    let hint = "write the layer of the file first: `{ CUT = \"1\" }`, and \"ignore\" for one that is to be left out";
    Diagnostic::error(LAYER_UNKNOWN, text).hint(hint)
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
