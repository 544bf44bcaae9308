//! Document → checked chain: stages looked up, parameters parsed, needs and gives matched.

use super::codes;
use super::document::{Document, Reader, StageEntry};
use super::fill::fill_table;
use super::inputs::{Values, settle};
use super::nearest::remedy;
use super::overrides::{self, Overrides};
use super::params::configure;
use super::plugins::ProgramContent;
use super::schema_walk::{FileRole, SchemaTree};
use crate::codes::NEEDS_NOT_GIVEN;
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use toile_garment::provenance::StageRecord;
use toile_garment::{Aspect, Diagnostic, Report, SourceRef};
use toile_stage_api::{AnyStage, ReadyStage, Registry};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A pipeline that can run.
pub struct Pipeline<'r> {
    /// Product line.
    pub line: String,
    /// Version.
    pub version: u64,
    /// Seed.
    pub seed: u64,
    /// The chain.
    pub steps: Vec<Step<'r>>,
    /// Files that the commands of plugins may name: every word of them, as a path.
    pub programs: Vec<PathBuf>,
    /// The programs that the chain uses, as they are now.
    pub contents: Vec<ProgramContent>,
    /// Folders behind `{name}/…`, for paths given on the command line.
    pub mounts: BTreeMap<String, PathBuf>,
    /// Files beside the pipeline that choose its settings; they may be absent.
    pub beside: Vec<PathBuf>,
}

/// One stage of the chain.
pub struct Step<'r> {
    /// Id.
    pub id: String,
    /// Place of its name in the pipeline file.
    pub place: SourceRef,
    /// The stage with its parameters.
    pub ready: Box<dyn ReadyStage + 'r>,
    /// Those of its parameters that are files.
    pub paths: Vec<PathText>,
}

impl Step<'_> {
    /// The record that the garment keeps of this stage: its name, revision and parameters.
    #[must_use]
    pub fn record(&self) -> StageRecord {
        let info = self.ready.info();
        let (stage, id) = (info.name.to_string(), self.id.clone());
        StageRecord { stage, id, revision: info.revision, params: self.ready.params() }
    }
}

/// A parameter that is a file.
#[derive(Clone, Debug)]
pub struct PathText {
    /// After filling in.
    pub text: String,
    /// Read or written.
    pub role: FileRole,
    /// Where it stands.
    pub place: SourceRef,
}

impl PathText {
    /// True for an output.
    #[must_use]
    pub fn is_output(&self) -> bool {
        self.role == FileRole::Output
    }
}

/// Looks up and checks everything. The chain is whole only when the report has no error.
pub fn link<'r>(document: &Document<'_>, registry: &'r Registry, report: &mut Report) -> Pipeline<'r> {
    let mut cx = Reader { source: document.source, report };
    let overrides = overrides::sort(&mut cx, document, registry);
    let values = settle(&mut cx, &document.inputs, &overrides.inputs, &document.line, document.version);
    let mut chain = Chain::new(registry);
    let mut schemas: BTreeMap<&str, SchemaTree> = BTreeMap::new();
    let mut steps = Vec::new();
    for entry in &document.stages {
        let Some(stage) = chain.find(&mut cx, entry) else { continue };
        chain.check(&mut cx, entry, stage);
        let schema = schemas.entry(entry.name.get_ref()).or_insert_with(|| SchemaTree::of(stage));
        steps.extend(make_step(&mut cx, entry, stage, schema, &overrides, &values));
    }
    unused_inputs(&mut cx, document);
    Pipeline {
        line: document.line.clone(),
        version: document.version,
        seed: document.seed,
        steps,
        programs: document.plugins.iter().flat_map(|p| &p.command).map(PathBuf::from).collect(),
        contents: Vec::new(),
        mounts: values.mounts,
        beside: Vec::new(),
    }
}

/// Tells of inputs that no text of a sound pipeline names: setting one would do nothing.
fn unused_inputs(cx: &mut Reader<'_>, document: &Document<'_>) {
    if cx.report.has_errors() {
        return;
    }
    let texts = || std::iter::once(cx.source.text()).chain(cx.source.sets().iter().map(String::as_str));
    let is_unused = |name: &str| !texts().any(|text| text.contains(&format!("{{{name}}}")));
    for (name, input) in document.inputs.iter().filter(|(name, _)| is_unused(name)) {
        let message = format!("the input `{name}` is used nowhere: setting it does nothing");
        let hint = format!("write {{{name}}} where its value belongs, or leave the input out");
        let finding = Diagnostic::warning(codes::INPUT_UNUSED, message).at(cx.source.place(&input.span));
        cx.report.push(finding.hint(hint));
    }
}

fn make_step<'r>(
    cx: &mut Reader<'_>,
    entry: &StageEntry<'_>,
    stage: &'r dyn AnyStage,
    schema: &SchemaTree,
    overrides: &Overrides<'_>,
    values: &Values,
) -> Option<Step<'r>> {
    let mut table = entry.with.get_ref().clone();
    overrides::make_way(entry, &overrides.params, stage.knobs(), &mut table);
    overrides::apply(cx, entry, &overrides.params, schema, &mut table);
    let unfilled = fill_table(cx, values, &mut table);
    // What could not be filled is left out, so that what the others say is looked at, too.
    let can_do_without = unfilled.iter().all(|key| !schema.means_file(key) && !schema.requires(key));
    if can_do_without {
        unfilled.iter().for_each(|key| drop(table.remove(key.as_str())));
    }
    let ready = configure(cx, stage, schema, table.clone(), &entry.with.span(), entry.name.get_ref())?;
    let place = cx.source.place(&entry.name.span());
    let paths = paths(cx, schema, &ready.params(), &table, &place);
    can_do_without.then(|| Step { id: entry.id.clone(), place, ready, paths })
}

/// The paths among the parameters, defaults included. Their schema says which of them are files; their looks do not.
fn paths(
    cx: &Reader<'_>,
    schema: &SchemaTree,
    params: &serde_json::Value,
    table: &DeTable<'_>,
    place: &SourceRef,
) -> Vec<PathText> {
    let given = |keys: &[String]| value_at(table, keys).map(|value| cx.source.place(&value.span()));
    let files = schema.files(params).into_iter();
    files
        // An output without a name is not written; an input without one is a mistake.
        .filter(|file| file.role == FileRole::Input || !file.text.is_empty())
        .map(|file| PathText {
            place: given(&file.keys).unwrap_or_else(|| place.clone()),
            text: file.text,
            role: file.role,
        })
        .collect()
}

/// The value at a way of keys and numbers.
fn value_at<'t>(table: &'t DeTable<'t>, keys: &[String]) -> Option<&'t Spanned<DeValue<'t>>> {
    let (key, rest) = keys.split_first()?;
    rest.iter().try_fold(table.get(key.as_str())?, |at, key| match at.get_ref() {
        DeValue::Table(inner) => inner.get(key.as_str()),
        DeValue::Array(items) => items.get(key.parse::<usize>().ok()?),
        _ => None,
    })
}

/// The aspects that the stages so far give.
struct Chain<'r> {
    registry: &'r Registry,
    given: BTreeSet<Aspect>,
    /// The outdated aspects, with the stage that made its base anew.
    outdated: BTreeMap<Aspect, String>,
    /// After an unknown stage nobody knows what is there: later needs are not reported.
    unsure: bool,
}

impl<'r> Chain<'r> {
    fn new(registry: &'r Registry) -> Self {
        Self { registry, given: BTreeSet::new(), outdated: BTreeMap::new(), unsure: false }
    }

    fn find(&mut self, cx: &mut Reader<'_>, entry: &StageEntry<'_>) -> Option<&'r dyn AnyStage> {
        let name = entry.name.get_ref();
        let found = self.registry.get(name);
        if found.is_none() {
            self.unsure = true;
            let names: Vec<String> = self.registry.iter().map(|s| s.info().name.into_owned()).collect();
            let hint = if name.contains('.') {
                format!("a stage of another program needs [plugin.{}]", name.split('.').next().unwrap_or(name))
            } else {
                remedy(name, names.iter().map(String::as_str))
            };
            cx.push(codes::UNKNOWN_STAGE, &entry.name.span(), format!("unknown stage `{name}`"), hint);
        }
        found
    }

    fn check(&mut self, cx: &mut Reader<'_>, entry: &StageEntry<'_>, stage: &dyn AnyStage) {
        let info = stage.info();
        for need in info.needs.iter().filter(|n| !self.is_given(**n)) {
            if !self.unsure {
                let renewer = ways(*need).find_map(|aspect| self.outdated.get(&aspect));
                let lacking = match renewer {
                    Some(renewer) => format!("and what was there is outdated by the stage `{renewer}`"),
                    None => "which no earlier stage gives".to_owned(),
                };
                let message = format!("`{}` needs {}, {lacking}", info.name, word(*need));
                cx.push(NEEDS_NOT_GIVEN, &entry.name.span(), message, self.givers(*need));
            }
        }
        let outdated: Vec<Aspect> = self.given.iter().copied().filter(|a| a.is_outdated_by(&info.gives)).collect();
        for aspect in outdated {
            self.given.remove(&aspect);
            self.outdated.insert(aspect, info.name.to_string());
        }
        self.given.extend(info.gives.iter());
    }

    fn is_given(&self, aspect: Aspect) -> bool {
        ways(aspect).any(|a| self.given.contains(&a))
    }

    fn givers(&self, aspect: Aspect) -> String {
        let givers: Vec<String> = self
            .registry
            .iter()
            .map(AnyStage::info)
            .filter(|i| ways(aspect).any(|a| i.gives.contains(&a)))
            .map(|i| format!("`{}`", i.name))
            .collect();
        if givers.is_empty() {
            "no known stage gives it".to_owned()
        } else {
            format!("put {} before it", givers.join(" or "))
        }
    }
}

/// The aspects that are enough where this one is needed.
fn ways(aspect: Aspect) -> impl Iterator<Item = Aspect> {
    std::iter::once(aspect).chain(aspect.any_of().iter().copied())
}

/// The aspect as the stages' manual writes it.
#[must_use]
pub fn word(aspect: Aspect) -> String {
    format!("{aspect:?}").to_lowercase()
}
