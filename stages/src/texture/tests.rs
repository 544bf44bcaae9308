use super::*;
use toile_garment::units::Length;
use toile_garment::{Vec2, mesh::PieceMesh};
use toile_stage_api::FileError;

fn rect(name: &str, w: f64, h: f64) -> Piece {
    let rest = vec![Vec2::new(0.0, 0.0), Vec2::new(w, 0.0), Vec2::new(w, h), Vec2::new(0.0, h)];
    let mesh = PieceMesh { rest, triangles: vec![[0, 1, 2], [0, 2, 3]], ..PieceMesh::default() };
    Piece { name: name.into(), mesh: Some(mesh), ..Piece::default() }
}

#[test]
fn packed_boxes_fit_keep_their_scale_and_do_not_meet() {
    let sizes = [(0.5, 0.8), (0.5, 0.8), (0.2, 0.6), (0.9, 0.05), (0.3, 0.3), (0.01, 0.01), (0.35, 0.62)];
    let pieces: Vec<Vec<[f64; 2]>> = sizes.iter().map(|(w, h)| cloth_coordinates(&rect("p", *w, *h))).collect();
    let margin = 0.01;
    let packed = pack::pack(&pieces, margin);
    assert_eq!(packed, pack::pack(&pieces, margin));
    let scale = (packed[0][1][0] - packed[0][0][0]) / 0.5;
    let boxes: Vec<[f64; 4]> = packed.iter().map(|p| [p[0][0], p[0][1], p[2][0], p[2][1]]).collect();
    for (i, (b, (w, h))) in boxes.iter().zip(sizes).enumerate() {
        assert!(b.iter().all(|x| (0.0..=1.0).contains(x)), "{b:?}");
        assert!((b[2] - b[0] - w * scale).abs() < 1e-12 && (b[3] - b[1] - h * scale).abs() < 1e-12);
        for c in &boxes[..i] {
            let gap = (b[0] - c[2]).max(c[0] - b[2]).max((b[1] - c[3]).max(c[1] - b[3]));
            assert!(gap > 0.99 * margin * scale, "boxes {gap} apart");
        }
    }
    let used: f64 = sizes.iter().map(|(w, h)| w * h * scale * scale).sum();
    assert!(used > 0.5, "only {used} of the square is used");
}

#[test]
fn nothing_and_points_still_give_numbers() {
    assert!(pack::pack(&[], 0.01).is_empty());
    let point = pack::pack(&[vec![[3.0, 3.0]; 3]], 0.0);
    assert!(point.iter().flatten().flatten().all(|x| x.is_finite()));
}

#[test]
fn cloth_coordinates_follow_the_grain_in_metres() {
    let mut piece = rect("front", 0.4, 0.7);
    assert_eq!(cloth_coordinates(&piece)[2], [0.4, 0.7], "without a grain line the warp is +y");
    // The warp runs along +x: the weft then runs along -y.
    piece.grain = Some([Vec2::new(0.0, 0.0), Vec2::new(0.2, 0.0)]);
    assert_eq!(cloth_coordinates(&piece)[2], [-0.7, 0.4]);
    let skew = Vec2::new(3.0, 4.0);
    piece.grain = Some([Vec2::zeros(), skew]);
    let uv = cloth_coordinates(&piece);
    let (a, b) = (uv[0], uv[2]);
    let length = ((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1])).sqrt();
    assert!((length - Vec2::new(0.4, 0.7).norm()).abs() < 1e-12, "real size");
}

#[test]
fn colours_become_linear() {
    assert_eq!(color::linear("#ffffff").expect("white"), [1.0, 1.0, 1.0]);
    assert_eq!(color::linear("#000000").expect("black"), [0.0, 0.0, 0.0]);
    let grey = color::linear("#808080").expect("grey")[0];
    assert!((grey - 0.215_860_5).abs() < 1e-6, "{grey}");
    for bad in ["", "red", "#fff", "#gggggg", "#ffffff0", "ffffff", "#+1+1+1"] {
        assert!(color::linear(bad).is_err(), "{bad}");
    }
}

#[test]
fn looks_are_chosen_by_piece_then_by_material() {
    let params: TextureParams = toml::from_str(
        "color = \"#102030\"\n[[materials]]\nname = \"lining\"\ncolor = \"#ff0000\"\n\
         [[materials]]\nname = \"collar\"\npieces = [\"front\"]\nroughness = 0.5",
    )
    .expect("parameters");
    let mut piece = rect("back", 1.0, 1.0);
    assert_eq!(params.material_of(&piece), 0);
    piece.material = Some("lining".into());
    assert_eq!(params.material_of(&piece), 1);
    piece.name = "front".into();
    assert_eq!(params.material_of(&piece), 2);
    let looks = params.looks();
    let told = (looks[1].color, looks[1].roughness, looks[2].color);
    assert_eq!(told, (Some("#ff0000"), 0.9, Some("#102030")));
}

#[test]
fn wrong_numbers_and_names_are_collected() {
    let mut params: TextureParams = toml::from_str(
        "roughness = 2.0\nrepeat = [\"0 mm\", \"10 mm\"]\n[[materials]]\nname = \"a\"\npieces = [\"frnt\"]\n\
         [[materials]]\nname = \"a\"",
    )
    .expect("parameters");
    params.margin = Length(-1.0);
    let garment = Garment { pieces: vec![rect("front", 1.0, 1.0)], ..Garment::default() };
    let found = params.check(&garment);
    let codes: Vec<&str> = found.iter().map(|d| d.code.as_str()).collect();
    for code in ["value-out-of-range", "piece-unknown", "material-name", "material-unused"] {
        assert!(codes.contains(&code), "{code} in {codes:?}");
    }
    assert!(found.iter().any(|d| d.hint.as_deref() == Some("did you mean `front`?")));
    assert!(toml::from_str::<TextureParams>("repeat = [10, 10]").is_err(), "a bare number has no unit");
}

/// A black pixel as PNG.
const PIXEL: &[u8] =
    b"\x89\x50\x4e\x47\x0d\x0a\x1a\x0a\x00\x00\x00\x0d\x49\x48\x44\x52\x00\x00\x00\x01\x00\x00\x00\x01\x08\x02\x00\x00\
    \x00\x90\x77\x53\xde\x00\x00\x00\x0c\x49\x44\x41\x54\x78\xda\x63\x60\x60\x60\x00\x00\x00\x04\x00\x01\xc8\xea\xeb\
    \xf9\x00\x00\x00\x00\x49\x45\x4e\x44\xae\x42\x60\x82";

/// Files in memory.
struct Memory(Vec<(&'static str, Vec<u8>)>);

impl toile_stage_api::Files for Memory {
    fn read(&mut self, path: &Path) -> Result<Vec<u8>, FileError> {
        let found = self.0.iter().find(|(name, _)| Path::new(name) == path).map(|(_, bytes)| bytes.clone());
        let missing = || FileError::Missing { path: path.display().to_string(), reason: "no file".to_owned() };
        found.ok_or_else(missing)
    }

    fn read_optional(&mut self, _: &Path) -> Result<Option<Vec<u8>>, FileError> {
        Ok(None)
    }

    fn write(&mut self, _: &Path, _: &[u8]) -> Result<(), FileError> {
        Ok(())
    }
}

#[test]
fn a_unified_material_gives_the_look_and_a_colour_that_is_asked_for_stays() {
    let image = r#""image":{"path":"maps/base.png","width":20,"height":30}"#;
    let text = format!(
        r#"{{"schema":"1.1","material":{{"name":"twill","front":{{"basecolor":{{"texture":{{"mode":"multiply",
        "factor":{{"r":0.5,"g":0.5,"b":0.5}},{image}}}}},"roughness":{{"constant":0.3}}}},"physics":{{}}}}}}"#
    );
    let mut files = Memory(vec![("cloth/twill.u3m", text.into_bytes()), ("cloth/maps/base.png", PIXEL.to_vec())]);
    let mut looked = |color: Option<&str>| {
        let params = TextureParams {
            image: Some("cloth/twill.u3m".into()),
            color: color.map(str::to_owned),
            ..TextureParams::default()
        };
        let garment = Garment { pieces: vec![rect("front", 0.4, 0.7)], ..Garment::default() };
        let (done, report) = crate::testing::lend(|cx| {
            let mut cx = StageContext {
                report: cx.report,
                progress: &mut (),
                files: &mut files,
                cancel: cx.cancel,
                seed: 0,
                threads: 1,
            };
            Texture.run(&params, garment, &mut cx)
        });
        let garment = done.expect("a look");
        (garment.textures.expect("textures").materials.remove(0), report)
    };
    let (material, report) = looked(None);
    assert_eq!((material.color, material.repeat, material.roughness), ([0.5; 3], [0.02, 0.03], 0.3));
    assert!(material.image.is_some() && report.findings.iter().any(|f| f.code == "u3m-parts-unused"));
    assert_eq!(looked(Some("#ffffff")).0.color, [1.0; 3]);
}
