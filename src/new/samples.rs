//! The samples that come with the program.

use super::folder::Folder;
use super::stock::{Body, Fabric};
use toile_formats::codes::SIZE_NOT_FOUND;
use toile_garment::Diagnostic;

/// A garment that comes with the program.
#[derive(Debug)]
pub struct Sample {
    /// The word that asks for it.
    pub word: &'static str,
    /// Name of its files.
    name: &'static str,
    /// Fabric, where none is asked for.
    pub fabric: &'static str,
    pattern: &'static [u8],
    sewing: &'static str,
    pipeline: &'static str,
}

/// All samples.
pub const SAMPLES: &[Sample] = &[
    Sample {
        word: "skirt",
        name: "long-skirt",
        fabric: "wool-suiting",
        pattern: include_bytes!("../../samples/patterns/long-skirt.aama.dxf"),
        sewing: include_str!("../../samples/patterns/long-skirt.sewing.toml"),
        pipeline: include_str!("../../pipelines/long-skirt/v1.toml"),
    },
    Sample {
        word: "bodice",
        name: "fitted-bodice",
        fabric: "cotton-shirting",
        pattern: include_bytes!("../../samples/patterns/fitted-bodice.aama.dxf"),
        sewing: include_str!("../../samples/patterns/fitted-bodice.sewing.toml"),
        pipeline: include_str!("../../pipelines/fitted-bodice/v1.toml"),
    },
    Sample {
        word: "t-shirt",
        name: "t-shirt",
        fabric: "cotton-jersey",
        pattern: include_bytes!("../../samples/patterns/t-shirt.aama.dxf"),
        sewing: include_str!("../../samples/patterns/t-shirt.sewing.toml"),
        pipeline: include_str!("../../pipelines/t-shirt/v1.toml"),
    },
];

/// Sizes of the samples, and the one for other bodies.
const SIZES: [&str; 3] = ["36", "38", "40"];
const SIZE: &str = "38";

impl Sample {
    /// The sample of a word.
    #[must_use]
    pub fn of(word: &str) -> Option<&'static Self> {
        SAMPLES.iter().find(|s| s.word == word || s.name == word)
    }

    /// Its folder: the pattern in a size, or in that of the body, with sewing file, fabric and body.
    ///
    /// # Errors
    /// The size, body or fabric is not there.
    pub fn folder(&self, size: Option<&str>, body: &Body, fabric: &Fabric) -> Result<Folder, Vec<Diagnostic>> {
        if let Some(size) = size.filter(|size| !SIZES.contains(size)) {
            let message = format!("size `{size}` is not in this pattern; there are: {}", SIZES.join(", "));
            return Err(vec![Diagnostic::error(SIZE_NOT_FOUND, message)]);
        }
        let mut folder = Folder::default();
        folder.add(&format!("{}.dxf", self.name), self.pattern.to_vec());
        for (name, bytes) in body.open()?.files.into_iter().chain(fabric.files()?) {
            folder.add(&name, bytes);
        }
        folder.add("sewing.toml", self.sewing.as_bytes().to_vec());
        folder.add("pipeline.toml", self.pipeline(size, body, fabric).into_bytes());
        Ok(folder)
    }

    /// The pipeline of the sample with the paths of the folder. Textures stay out, and a plain colour stands in.
    fn pipeline(&self, size: Option<&str>, body: &Body, fabric: &Fabric) -> String {
        let own = match body {
            Body::Size(size) => size.trim_start_matches("women-"),
            Body::File(_) => SIZE,
        };
        // The samples are graded in these sizes.
        let size = size.or(SIZES.into_iter().find(|size| *size == own)).unwrap_or(SIZE);
        let size = format!("size    = {{ kind = \"text\", default = {size:?} }}");
        let line = |text: &str| -> Option<String> {
            let key = text.split('=').next().unwrap_or_default().trim();
            Some(match key {
                "#:schema ../toile.schema.json" | "with.repeat" | "fabric" | "pattern" => return None,
                "size" => size.clone(),
                "with.file" if text.contains("samples") => format!("with.file   = \"{}.dxf\"", self.name),
                "with.sewing" => "with.sewing = \"sewing.toml\"".to_owned(),
                "with.body" => format!("with.body   = {:?}", body.file_name()),
                "with.fabric" => format!("with.fabric = {:?}", fabric.file_name()),
                "with.image" => "with.color  = \"#9aa7c7\"".to_owned(),
                _ => text.to_owned(),
            })
        };
        let lines: Vec<String> =
            self.pipeline.lines().filter(|l| !l.starts_with("#:schema")).filter_map(line).collect();
        let mut text = lines.join("\n");
        while text.contains("\n\n\n") {
            text = text.replace("\n\n\n", "\n\n");
        }
        text + "\n"
    }
}
