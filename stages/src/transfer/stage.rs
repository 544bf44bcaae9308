//! `transfer` as a stage.

use super::BodyMap;
use super::heights::LEVELS;
use crate::stitch::load;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::PathBuf;
use toile_garment::body::Body;
use toile_garment::garment::Shape;
use toile_garment::units::Length;
use toile_garment::{Aspect, Code, Diagnostic, Garment};
use toile_stage_api::{Cost, Errors, Forecast, Stage, StageContext, StageError, StageInfo};

codes! {
    pub(crate) list CODES;

    /// The garment does not carry the mesh of the body that it is on. Name its file as `from`. Exit code 3.
    TRANSFER_NO_BODY = "transfer-no-body";

    /// A body cannot be measured: it has no trunk, or is not in metres with +y up. `toile body measure` says what is
    /// found on it. Exit code 3.
    TRANSFER_BODY_UNKNOWN = "transfer-body-unknown";

    /// Girth is to be added at a height that has no name. The names are bust, under_bust, waist and hip. Exit code 2.
    TRANSFER_LEVEL = "transfer-level";
}

/// Most girth that may be added or taken away, metres.
const MOST_ADDED: f64 = 0.5;

/// Parameters of `transfer`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TransferParams {
    /// The body that the garment shall fit (OBJ in metres), with its side file beside it.
    #[schemars(extend("format" = "input-file"))]
    pub body: PathBuf,
    /// The body that the garment is on, where the garment does not carry it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("format" = "input-file"))]
    pub from: Option<PathBuf>,
    /// Girth that the garment gets beside that of the body, by height: `bust`, `under_bust`, `waist`, `hip`. Between them
    /// it changes evenly.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub add: BTreeMap<String, Length>,
}

/// The stage.
pub struct Transfer;

impl Stage for Transfer {
    type Params = TransferParams;
    const INFO: StageInfo = StageInfo::new(
        "transfer",
        "moves a draped garment to another body with its ease, so that `flatten` gives the pattern for it",
        &[Aspect::Mesh, Aspect::Drape],
        &[Aspect::Drape, Aspect::Body],
        1,
    );

    fn forecast(
        &self,
        params: &Self::Params,
        forecast: &mut Forecast,
        cx: &mut StageContext<'_>,
    ) -> Result<Option<Cost>, StageError> {
        let mut errors = Errors::default();
        errors.keep(girths(params));
        forecast.garment.body = errors.keep(load::body(&params.body, cx));
        if let Some(from) = &params.from {
            errors.keep(load::body(from, cx));
        }
        errors.finish()?;
        Ok(Some(Cost::seconds(0.3)))
    }

    fn run(&self, params: &Self::Params, garment: Garment, cx: &mut StageContext<'_>) -> Result<Garment, StageError> {
        let add = girths(params)?;
        let to = load::body(&params.body, cx)?;
        let from = match &params.from {
            Some(path) => load::body(path, cx)?,
            None => carried(&garment)?,
        };
        transferred(garment, &from, to, &add)
    }
}

fn carried(garment: &Garment) -> Result<Body, StageError> {
    garment.body.clone().filter(|b| !b.triangles.is_empty()).ok_or_else(|| {
        let finding = Diagnostic::error(TRANSFER_NO_BODY, "the garment does not carry the body that it is on");
        StageError::input(finding.hint("name its file: `from = \"body.obj\"`"))
    })
}

fn girths(params: &TransferParams) -> Result<BTreeMap<String, f64>, StageError> {
    let wrong = |name: &String, length: &Length| {
        let known = LEVELS.contains(&name.as_str());
        let why = match (known, length.0.abs() <= MOST_ADDED) {
            (false, _) => format!("`{name}` is no height at which girth can be added"),
            (true, false) => format!("{} mm at the {name} are more than {} mm", 1e3 * length.0, 1e3 * MOST_ADDED),
            (true, true) => return None,
        };
        Some(Diagnostic::error(TRANSFER_LEVEL, why).hint(format!("heights are {}", LEVELS.join(", "))))
    };
    let wrong: Vec<Diagnostic> = params.add.iter().filter_map(|(name, length)| wrong(name, length)).collect();
    if wrong.is_empty() {
        Ok(params.add.iter().map(|(name, length)| (name.clone(), length.0)).collect())
    } else {
        Err(StageError::Parameter(wrong))
    }
}

/// The garment on another body. What was measured on its drape is gone; the drape itself is kept as the shape before
/// the edit.
///
/// # Errors
/// When the garment is not draped, or a body cannot be measured.
pub fn transferred(
    garment: Garment,
    from: &Body,
    to: Body,
    add: &BTreeMap<String, f64>,
) -> Result<Garment, StageError> {
    let map = BodyMap::new(from, &to, add).map_err(|why| {
        let finding = Diagnostic::error(TRANSFER_BODY_UNKNOWN, why);
        StageError::input(finding.hint("`toile body measure BODY.obj` says what is found on it"))
    })?;
    let Some(before) = garment.drape.clone() else {
        return Err(StageError::Internal("a transfer without a drape".to_owned()));
    };
    let moved = |piece: &Vec<_>| piece.iter().map(|p| map.at(*p)).collect();
    let drape = Shape { positions: before.positions.iter().map(moved).collect(), ..before };
    let mut garment = Garment { body: Some(to), ..garment };
    garment.reshape(drape);
    Ok(garment)
}
