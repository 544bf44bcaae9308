//! `import-dxf`: pieces from an AAMA or ASTM DXF, with its rule table and sewing file.

mod read;

use crate::allowance::AllowanceParams;
pub use read::read;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use toile_garment::sewing::SewingPlan;
use toile_garment::units::{Angle, Length};
use toile_garment::{Aspect, Code, Garment};
use toile_stage_api::{Cost, Errors, Forecast, Stage, StageContext, StageError, StageInfo};

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
        let (garment, errors) = sewn(params, Garment::default(), cx);
        forecast.garment = garment;
        forecast.in_doubt = !errors.is_empty();
        errors.finish().map(|()| Some(Cost::seconds(0.01)))
    }

    fn run(
        &self,
        params: &ImportDxfParams,
        garment: Garment,
        cx: &mut StageContext<'_>,
    ) -> Result<Garment, StageError> {
        let (garment, errors) = sewn(params, garment, cx);
        errors.finish().map(|()| garment)
    }
}

/// The pieces with what the sewing file says, as far as both can be read, and all that is wrong with them.
fn sewn(params: &ImportDxfParams, garment: Garment, cx: &mut StageContext<'_>) -> (Garment, Errors) {
    let mut errors = Errors::default();
    let drawn = read::pieces(params, &mut errors, cx);
    let plan = plan(params, &mut errors, cx);
    let Some((drawn, undecided)) = drawn else {
        return (Garment { plan: plan.unwrap_or_default(), ..garment }, errors);
    };
    let mut garment = Garment { style: drawn.style, size: drawn.size, pieces: drawn.pieces, ..garment };
    match plan {
        Some(plan) => {
            errors.keep(crate::sewing::apply_deciding(&mut garment, plan, undecided, cx.report));
        }
        // Copies have their names there: without it nothing can be said of the pieces.
        None if params.sewing.is_some() => garment.pieces.clear(),
        // Without a sewing file the drawing has the last word.
        None => cx.report.findings.extend(undecided.into_iter().map(|u| u.finding)),
    }
    (garment, errors)
}

/// The plan of the sound tables of the sewing file.
fn plan(params: &ImportDxfParams, errors: &mut Errors, cx: &mut StageContext<'_>) -> Option<SewingPlan> {
    let (plan, wrong) = errors.keep(crate::sewing::sound_tables(params.sewing.as_ref()?, cx))?;
    errors.parameters(wrong);
    plan
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
