//! The stage `export-picture`: a PNG of the garment, drawn by the program itself.

use crate::codes::BODY_MISSING;
use crate::fit;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use toile_formats::codes::OUT_OF_RANGE;
use toile_formats::picture::{self, Field, PictureError, SIDES, View, Wishes};
use toile_garment::{Aspect, Diagnostic, Garment};
use toile_stage_api::{Cost, Forecast, Stage, StageContext, StageError, StageInfo};

/// A side from which the garment is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ViewParam {
    /// From the front.
    Front,
    /// From the back.
    Back,
    /// From the wearer's left.
    Left,
    /// From the wearer's right.
    Right,
    /// From the front and the wearer's left, a little from above.
    ThreeQuarter,
    /// The pieces, laid flat side by side.
    Flat,
}

/// One view, or several side by side.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum ViewsParam {
    /// One view.
    One(ViewParam),
    /// Several, side by side: the worn ones at one scale, the flat lay at its own.
    Many(Vec<ViewParam>),
}

/// The meaning of the colours of the cloth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ColoursParam {
    /// The cloth itself.
    #[default]
    Cloth,
    /// Strain along the warp.
    StrainWarp,
    /// Strain along the weft.
    StrainWeft,
    /// The larger strain of both bias directions.
    StrainBias,
    /// The larger strain of warp and weft, each beside the limit of its fabric.
    StrainLimit,
    /// Distance from the cloth to the body.
    Ease,
    /// How sharply the cloth is bent, as 1 over the radius.
    Bending,
    /// Pressure on the body, averaged over a pad of 20 mm as a sensor has it.
    Pressure,
    /// The larger tension of warp and weft.
    Tension,
}

/// Parameters of `export-picture`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ExportPictureParams {
    /// The PNG to write.
    #[schemars(extend("format" = "output-file"))]
    pub file: PathBuf,
    /// A view, or a list of views side by side: `front`, `back`, `left`, `right`, `three-quarter`, `flat`.
    pub view: ViewsParam,
    /// Width of one view, pixels (64 to 4096).
    pub width: u32,
    /// Height, pixels (64 to 4096). The legend of a map stands below it.
    pub height: u32,
    /// Draws the body, where there is one.
    pub body: bool,
    /// Meaning of the colours: `cloth`, `strain-warp`, `strain-weft`, `strain-bias`, `strain-limit`, `ease`, `tension`,
    /// `pressure` or `bending`.
    pub colours: ColoursParam,
}

impl Default for ExportPictureParams {
    fn default() -> Self {
        Self {
            file: "{out}/picture.png".into(),
            view: ViewsParam::One(ViewParam::Front),
            width: 800,
            height: 1000,
            body: true,
            colours: ColoursParam::Cloth,
        }
    }
}

/// Writes a picture; the garment stays as it is.
pub struct ExportPicture;

impl Stage for ExportPicture {
    type Params = ExportPictureParams;
    const INFO: StageInfo = StageInfo::new(
        "export-picture",
        "writes a picture of the garment as PNG: cloth, strain, tension, pressure, bending or distance to the body",
        &[Aspect::Mesh, Aspect::Shape],
        &[],
        1,
    );

    fn forecast(
        &self,
        params: &Self::Params,
        _: &mut Forecast,
        _: &mut StageContext<'_>,
    ) -> Result<Option<Cost>, StageError> {
        params.range()?;
        let pixels = f64::from(params.width) * f64::from(params.height) * params.views().len() as f64;
        Ok(Some(Cost { seconds: 0.3 + 1.5e-6 * pixels, mb: 20.0 + 6e-5 * pixels }))
    }

    fn run(&self, params: &Self::Params, garment: Garment, cx: &mut StageContext<'_>) -> Result<Garment, StageError> {
        params.range()?;
        let field = params.colours.field(&garment)?;
        let wishes = Wishes {
            views: params.views(),
            width: params.width,
            height: params.height,
            body: params.body,
            field: field.as_ref(),
        };
        let png = picture::png(&garment, &wishes).map_err(failure)?;
        cx.files.write(&params.file, &png)?;
        Ok(garment)
    }
}

impl ExportPictureParams {
    fn views(&self) -> Vec<View> {
        let view = |v: &ViewParam| match v {
            ViewParam::Front => View::Front,
            ViewParam::Back => View::Back,
            ViewParam::Left => View::Left,
            ViewParam::Right => View::Right,
            ViewParam::ThreeQuarter => View::ThreeQuarter,
            ViewParam::Flat => View::Flat,
        };
        match &self.view {
            ViewsParam::One(one) => vec![view(one)],
            ViewsParam::Many(many) => many.iter().map(view).collect(),
        }
    }

    fn range(&self) -> Result<(), StageError> {
        let [low, high] = SIDES;
        let sides = [self.width, self.height].iter().all(|s| (low..=high).contains(s));
        let count = self.views().len();
        if sides && (1..=6).contains(&count) {
            return Ok(());
        }
        let message = format!(
            "a picture has 1 to 6 views of {low} to {high} pixels a side, not {count} of {} × {}",
            self.width, self.height
        );
        Err(StageError::parameter(Diagnostic::error(OUT_OF_RANGE, message)))
    }
}

impl ColoursParam {
    /// The quantity that the colours show; `None` for the cloth itself.
    ///
    /// # Errors
    /// The quantity needs a body, and there is none.
    pub fn field(self, garment: &Garment) -> Result<Option<Field>, StageError> {
        let strain = |k: usize| fit::strain(garment).and_then(|all| all.into_iter().nth(k));
        Ok(match self {
            Self::Cloth => None,
            Self::StrainWarp => strain(0),
            Self::StrainWeft => strain(1),
            Self::StrainBias => strain(2),
            Self::StrainLimit => fit::strain_beside_limit(garment),
            Self::Ease => Some(fit::ease(garment).ok_or_else(no_body)?),
            Self::Bending => fit::bending(garment),
            Self::Tension => fit::tension(garment),
            Self::Pressure => Some(fit::pressure(garment, fit::PAD).ok_or_else(no_body)?),
        })
    }
}

fn no_body() -> StageError {
    let message = "these `colours` show how the cloth meets the body, but the garment was sewn without one";
    StageError::parameter(Diagnostic::error(BODY_MISSING, message).hint("give `with.body` to `stitch`"))
}

fn failure(error: PictureError) -> StageError {
    StageError::Internal(error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::run;
    use toile_garment::garment::Shape;

    #[test]
    fn a_map_of_ease_needs_a_body_and_sizes_have_a_range() {
        let garment = Garment { stitched: Some(Shape::default()), ..Garment::default() };
        let ease = ExportPictureParams { colours: ColoursParam::Ease, ..ExportPictureParams::default() };
        let Err(StageError::Parameter(found)) = run(&ExportPicture, &ease, garment.clone()) else { panic!("no body") };
        assert_eq!(found[0].code, "body-missing");
        for params in [
            ExportPictureParams { width: 63, ..ExportPictureParams::default() },
            ExportPictureParams { view: ViewsParam::Many(Vec::new()), ..ExportPictureParams::default() },
        ] {
            let Err(StageError::Parameter(found)) = run(&ExportPicture, &params, garment.clone()) else { panic!() };
            assert_eq!(found[0].code, "out-of-range");
        }
    }
}
