//! The pipeline of a folder.

use super::pattern::Source;
use super::stock::{Body, Fabric};

/// The input for a size of the file and the line that uses it, where the file holds more than one.
fn sizes(source: &Source) -> (String, &'static str) {
    let Some(size) = source.garment.size.as_deref().filter(|_| source.sizes.len() > 1) else {
        return (String::new(), "");
    };
    let known = toile_garment::text::shown(&source.sizes.join(", "), &[]);
    let size = toile_garment::text::quoted(size);
    let about = "the body stays; `toile new --size` makes a folder with the body of a size, too";
    let input = format!(
        "\n# Sizes of the file: {known}. `toile run --set size=…` sews another one;\n# {about}.\n[input]\n\
         size = {{ kind = \"text\", default = {size} }}\n"
    );
    (input, "\nwith.size   = \"{size}\"")
}

/// Text of the pipeline.
pub fn text(source: &Source, body: &Body, fabric: &Fabric) -> String {
    let line = line(&source.stem);
    let q = toile_garment::text::quoted;
    let (file, body, fabric) = (q(&source.file_name()), q(&body.file_name()), q(&fabric.file_name()));
    let (glb, flat) = (q(&format!("{{out}}/{line}.glb")), q(&format!("{{out}}/{line}-flat.dxf")));
    let unit = source.unit.and_then(|u| serde_json::to_string(&u).ok());
    let units = unit.map_or(String::new(), |u| format!("\nwith.units  = {u}"));
    let layers: Vec<String> = source.layers.iter().map(|(own, target)| format!("{} = {}", q(own), q(target))).collect();
    let layers = if layers.is_empty() { String::new() } else { format!("\nwith.layers = {{ {} }}", layers.join(", ")) };
    let (input, size) = sizes(source);
    format!(
        r##"# The garment of {file}: `toile run` sews and drapes it.
toile = 1

[pipeline]
line    = "{line}"
version = 1
{input}
[[stage]]
use = "import-dxf"
with.file   = {file}
with.sewing = "sewing.toml"{size}{units}{layers}

[[stage]]
use = "triangulate"
with.edge_length = "16 mm"

[[stage]]
use = "assemble"

[[stage]]
use = "stitch"
with.body   = {body}
with.fabric = {fabric}

[[stage]]
use = "drape"

[[stage]]
use = "texture"
with.color = "#9aa7c7"

[[stage]]
use = "export-gltf"
with.file = {glb}

[[stage]]
use = "flatten"

[[stage]]
use = "export-dxf"
with.file = {flat}

[[stage]]
use = "export-report"
"##
    )
}

/// A name of a line: lower-case letters, digits and hyphens.
fn line(stem: &str) -> String {
    let plain: String = stem.to_lowercase().chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
    let words: Vec<&str> = plain.split('-').filter(|w| !w.is_empty()).collect();
    let name = words.join("-");
    if name.starts_with(|c: char| c.is_ascii_lowercase()) { name } else { format!("garment-{name}") }
}
