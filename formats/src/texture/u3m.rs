//! A material as U3M (Unified 3D Material, `.u3m`): its front side, with bitmaps that lie beside it.
//!
//! Read are the base colour with its bitmap and size, the normal map, roughness and sheen. Colours are linear, sizes
//! millimetres. Back and side, other maps, and the curves of measuring devices are not used. An archive (`.u3ma`) holds
//! the material with its bitmaps.

use super::codes::{U3M_ARCHIVE, U3M_FILE};
use super::zip::{ARCHIVE, Archive};
use serde_json::Value;
use toile_garment::{Diagnostic, SourceRef};

/// Sizes of bitmaps that are one, as a share.
const SAME_SIZE: f64 = 0.01;

/// The front side of a material.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct U3m {
    /// Name.
    pub name: String,
    /// Colour of the cloth, or the tint of its bitmap, linear RGB 0–1.
    pub color: Option<[f64; 3]>,
    /// Bitmap of the base colour.
    pub image: Option<Bitmap>,
    /// Normal map of the same size.
    pub normal: Option<Bitmap>,
    /// Roughness 0–1.
    pub roughness: Option<f64>,
    /// Strength of the sheen 0–1.
    pub sheen: Option<f64>,
    /// Words for the parts of the file that are not used.
    pub unused: Vec<String>,
}

/// A bitmap that a material names.
#[derive(Clone, Debug, PartialEq)]
pub struct Bitmap {
    /// Path from the folder of the material.
    pub path: String,
    /// Size on the cloth, weft × warp, metres.
    pub repeat: [f64; 2],
}

/// A material in an archive, with the files beside it.
#[derive(Clone, Debug)]
pub struct U3ma {
    archive: Archive,
    material: String,
    file: String,
}

impl U3ma {
    /// Opens an archive. `None`: these are the bytes of something else. `file` is its name for messages.
    ///
    /// # Errors
    /// A damaged archive, or one without a material or with several.
    pub fn open(bytes: &[u8], file: &str) -> Option<Result<Self, Box<Diagnostic>>> {
        let opened = |bytes: &[u8]| {
            let archive = Archive::open(bytes.to_vec())?;
            let material = material_of(&archive)?;
            Ok(Self { archive, material, file: file.to_owned() })
        };
        bytes.starts_with(ARCHIVE).then(|| opened(bytes).map_err(|what| bad_archive(file, what)))
    }

    /// The material.
    ///
    /// # Errors
    /// As [`read_u3m`], and a damaged archive.
    pub fn material(&self) -> Result<U3m, Box<Diagnostic>> {
        read_u3m(&self.archive.read(&self.material).map_err(|what| bad_archive(&self.file, what))?, &self.file)
    }

    /// The bytes of a file by its path from the folder of the material.
    ///
    /// # Errors
    /// A file that is not there or is damaged.
    pub fn beside(&self, path: &str) -> Result<Vec<u8>, Box<Diagnostic>> {
        let folder = self.material.rsplit_once('/').map_or("", |(folder, _)| folder);
        let mut parts = Vec::new();
        for part in folder.split('/').chain(path.split(['/', '\\'])) {
            match part {
                "" | "." => {}
                ".." => drop(parts.pop()),
                name => parts.push(name),
            }
        }
        self.archive.read(&parts.join("/")).map_err(|what| bad_archive(&self.file, what))
    }
}

fn bad_archive(file: &str, what: String) -> Box<Diagnostic> {
    let finding = Diagnostic::error(U3M_ARCHIVE, format!("of the archive `{file}` {what}")).at(SourceRef::file(file));
    Box::new(finding.hint("export it again, or unpack it and give the .u3m file that lies in it"))
}

/// The material of an archive: the one that lies least deep in folders.
fn material_of(archive: &Archive) -> Result<String, String> {
    let is_material = |name: &&str| name.to_ascii_lowercase().ends_with(".u3m") && !name.starts_with("__MACOSX/");
    let deep = |name: &str| name.matches('/').count();
    let all: Vec<&str> = archive.names().filter(is_material).collect();
    let least = all.iter().map(|n| deep(n)).min().ok_or_else(|| "no file is a material (.u3m)".to_owned())?;
    let mut first = all.into_iter().filter(|n| deep(n) == least);
    match (first.next(), first.next()) {
        (Some(name), None) => Ok(name.to_owned()),
        _ => Err("several files are materials (.u3m), and one is needed".to_owned()),
    }
}

/// Reads a material. `file` is its name for messages.
///
/// # Errors
/// Text that is no JSON, or a material without a front side.
pub fn read_u3m(bytes: &[u8], file: &str) -> Result<U3m, Box<Diagnostic>> {
    let place = || SourceRef::file(file);
    let bad = |what: String| Box::new(Diagnostic::error(U3M_FILE, format!("`{file}`: {what}")).at(place()));
    let value: Value = serde_json::from_slice(bytes).map_err(|e| bad(format!("this is no JSON: {e}")))?;
    let material = value.get("material").filter(|m| m.is_object());
    let material = material.ok_or_else(|| bad("there is no `material`".to_owned()))?;
    let front = material.get("front").filter(|f| f.is_object());
    let front = front.ok_or_else(|| bad("the material has no front side that could be shown".to_owned()))?;
    let mut out =
        U3m { name: material.get("name").and_then(Value::as_str).unwrap_or_default().to_owned(), ..U3m::default() };
    let mut refused = Vec::new();
    base(&mut out, front, &mut refused);
    normal(&mut out, front, &mut refused);
    out.roughness = constant(front, "roughness");
    out.sheen = constant(front, "sheen_value");
    for key in ["physics", "back", "side"] {
        if material.get(key).is_some_and(|v| !v.is_null()) {
            out.unused.push(format!("`{key}`"));
        }
    }
    match refused.into_iter().next() {
        Some(what) => Err(bad(what)),
        None => Ok(out),
    }
}

/// The base colour. The factor of its bitmap is a tint where both are multiplied, as the format has it by default.
fn base(out: &mut U3m, front: &Value, refused: &mut Vec<String>) {
    let Some(base) = front.get("basecolor") else { return };
    match base.get("texture").filter(|t| t.is_object()) {
        None => out.color = base.get("constant").and_then(rgb),
        Some(texture) => {
            let mode = texture.get("mode").and_then(Value::as_str).unwrap_or("multiply");
            if mode == "multiply" {
                out.color = texture.get("factor").and_then(rgb);
            } else {
                out.unused.push(format!("the factor of the base colour, which is to `{mode}`"));
            }
            out.image = bitmap(texture, "basecolor", &mut out.unused, refused);
        }
    }
}

/// The normal map, where it is as large as the bitmap of the base colour.
fn normal(out: &mut U3m, front: &Value, refused: &mut Vec<String>) {
    let texture = front.get("normal").and_then(|n| n.get("texture")).filter(|t| t.is_object());
    let Some(found) = texture.and_then(|t| bitmap(t, "normal", &mut out.unused, refused)) else { return };
    let is_same = |image: &Bitmap| (0..2).all(|k| (image.repeat[k] / found.repeat[k] - 1.0).abs() <= SAME_SIZE);
    if out.image.as_ref().is_none_or(is_same) {
        out.normal = Some(found);
    } else {
        out.unused.push("the normal map, which has another size than the base colour".to_owned());
    }
}

/// The bitmap of a texture; one without a path or a size is refused.
fn bitmap(texture: &Value, name: &str, unused: &mut Vec<String>, refused: &mut Vec<String>) -> Option<Bitmap> {
    let image = texture.get("image").filter(|i| i.is_object())?;
    let size = |key: &str| image.get(key).and_then(Value::as_f64).filter(|x| x.is_finite() && *x > 0.0);
    let path = image.get("path").and_then(Value::as_str).filter(|p| !p.is_empty());
    let (Some(path), Some(width), Some(height)) = (path, size("width"), size("height")) else {
        refused.push(format!("the bitmap of `{name}` has no path, width or height"));
        return None;
    };
    let repeat = image.get("repeat");
    let mode = repeat.and_then(|r| r.get("mode")).and_then(Value::as_str).unwrap_or("normal");
    let turn = repeat.and_then(|r| r.get("rotation")).and_then(Value::as_f64).unwrap_or(0.0);
    if mode != "normal" || turn != 0.0 {
        unused.push(format!("the repeat of `{name}`, which is to be `{mode}` and turned by {turn}"));
    }
    Some(Bitmap { path: path.to_owned(), repeat: [1e-3 * width, 1e-3 * height] })
}

/// A number from 0 to 1 that stands for a whole property.
fn constant(front: &Value, key: &str) -> Option<f64> {
    front.get(key)?.get("constant")?.as_f64().filter(|x| (0.0..=1.0).contains(x))
}

fn rgb(value: &Value) -> Option<[f64; 3]> {
    let channel = |key: &str| value.get(key).and_then(Value::as_f64).filter(|x| (0.0..=1.0).contains(x));
    Some([channel("r")?, channel("g")?, channel("b")?])
}

#[cfg(test)]
mod tests {
    use super::super::zip::tests::archive;
    use super::*;

    const IMAGE: &str = r#"{"path":"maps/base.png","width":24.5,"height":12,"dpi":{"x":300,"y":300},
        "repeat":{"mode":"normal","rotation":0}}"#;

    fn read(front: &str) -> Result<U3m, Box<Diagnostic>> {
        let text = format!(r#"{{"schema":"1.1","material":{{"name":"twill","front":{front},"physics":{{}}}}}}"#);
        read_u3m(text.as_bytes(), "twill.u3m")
    }

    #[test]
    fn the_front_of_a_material_is_read_with_its_size() {
        let front = format!(
            r#"{{"basecolor":{{"constant":{{"r":0,"g":0,"b":0}},"texture":{{"mode":"multiply","factor":{{"r":1,"g":0.5,"b":0.25}},
            "image":{IMAGE}}}}},"normal":{{"texture":{{"scale":1,"image":{IMAGE}}}}},"roughness":{{"constant":0.7,"texture":null}},
            "sheen_value":{{"constant":0.2}}}}"#
        );
        let found = read(&front).expect("a material");
        let image = Bitmap { path: "maps/base.png".into(), repeat: [0.0245, 0.012] };
        assert_eq!((found.name.as_str(), found.color), ("twill", Some([1.0, 0.5, 0.25])));
        assert_eq!((found.image.as_ref(), found.normal.as_ref()), (Some(&image), Some(&image)));
        assert_eq!((found.roughness, found.sheen), (Some(0.7), Some(0.2)));
        assert_eq!(found.unused, ["`physics`"]);
    }

    #[test]
    fn a_plain_colour_and_what_is_not_used_are_told() {
        let plain = read(r#"{"basecolor":{"constant":{"r":0.1,"g":0.2,"b":0.3},"texture":null}}"#).expect("a material");
        assert_eq!((plain.color, plain.image), (Some([0.1, 0.2, 0.3]), None));
        let mirrored = IMAGE.replace("normal", "mirror_x");
        let other = IMAGE.replace("24.5", "30");
        let front = format!(
            r#"{{"basecolor":{{"texture":{{"mode":"add","image":{mirrored}}}}},"normal":{{"texture":{{"image":{other}}}}}}}"#
        );
        let found = read(&front).expect("a material");
        assert_eq!((found.color, found.normal, found.unused.len()), (None, None, 4));
    }

    #[test]
    fn an_archive_gives_its_material_and_the_bitmaps_beside_it() {
        let front = format!(r#"{{"basecolor":{{"texture":{{"image":{IMAGE}}}}}}}"#);
        let text = format!(r#"{{"material":{{"name":"twill","front":{front}}}}}"#);
        let files =
            [("readme.txt", b"".as_slice()), ("Twill/twill.u3m", text.as_bytes()), ("Twill/maps/base.png", b"PNG")];
        let open = |files: &[(&str, &[u8])]| U3ma::open(&archive(files), "twill.u3ma").expect("an archive");
        let found = open(&files).expect("a material");
        let image = found.material().expect("a material").image.expect("a bitmap");
        assert_eq!(found.beside(&image.path).expect("a bitmap"), b"PNG");
        assert_eq!(found.beside("./x/../maps/base.png").expect("a bitmap"), b"PNG");
        assert!(U3ma::open(text.as_bytes(), "twill.u3m").is_none());
        let missing = found.beside("maps/normal.png").expect_err("missing");
        assert!(missing.code == "u3m-archive" && missing.message.contains("`Twill/maps/normal.png`"), "{missing:?}");
        assert!(open(&files[..1]).expect_err("none").message.contains("no file is a material"));
        let twice = open(&[files[1], ("Other/wool.u3m", b"{}")]).expect_err("two");
        assert!(twice.message.contains("several files"), "{twice:?}");
    }

    #[test]
    fn a_damaged_file_is_refused_with_a_remedy() {
        let archive = U3ma::open(b"PK\x03\x04rest", "twill.u3ma").expect("an archive").expect_err("damaged");
        assert!(archive.code == "u3m-archive" && archive.hint.is_some_and(|h| h.contains("unpack it")));
        for (text, why) in [
            ("{", "no JSON"),
            ("[]", "no `material`"),
            (r#"{"material":{"front":null}}"#, "no front side"),
            (r#"{"material":{"front":{"basecolor":{"texture":{"image":{"path":"a.png"}}}}}}"#, "width or height"),
        ] {
            let found = read_u3m(text.as_bytes(), "a.u3m").expect_err(text);
            assert!(found.code == "u3m-file" && found.message.contains(why), "{}", found.message);
        }
    }
}
