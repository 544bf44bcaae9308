//! A toile with stages of your own, without a fork: one type, one line in `main`.
//!
//! `cargo run --example own_stages -- stages acme.annotate`

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use toile_garment::{Aspect, Code, Diagnostic, Garment};
use toile_stage_api::{Stage, StageContext, StageError, StageInfo};

toile_garment::codes! {
    pub(crate) list CODES;

    /// The text was written on every piece.
    ANNOTATED = "annotated";
}

/// Writes a text on every piece.
struct Annotate;

/// Parameters of `acme.annotate`; these comments become the manual and the schema.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct AnnotateParams {
    /// The text that is written.
    text: String,
}

impl Stage for Annotate {
    type Params = AnnotateParams;
    const INFO: StageInfo = StageInfo::new("acme.annotate", "writes a text on every piece", &[Aspect::Pieces], &[], 1);

    fn run(
        &self,
        params: &AnnotateParams,
        mut garment: Garment,
        cx: &mut StageContext<'_>,
    ) -> Result<Garment, StageError> {
        for piece in &mut garment.pieces {
            piece.annotation = Some(params.text.clone());
        }
        let message = format!("{} pieces annotated", garment.pieces.len());
        cx.report.push(Diagnostic::info(ANNOTATED, message));
        Ok(garment)
    }
}

fn main() -> std::process::ExitCode {
    toile::cli::main(toile_stages::builtin().with(Annotate))
}
