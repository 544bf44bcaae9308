//! Small projects in which every key has something to act on.

use crate::support::bench::{Bench, HEAD};
use std::fmt::Write as _;

/// A tube of two pieces round a cylinder, held at its waist.
const DRAPED: &str = r#"
[[stage]]
use = "import-dxf"
with.file = "pattern.dxf"
with.sewing = "sewing.toml"
[[stage]]
use = "triangulate"
with.edge_length = "20 mm"
[[stage]]
use = "assemble"
[[stage]]
use = "stitch"
with.body = "body.obj"
with.fabric = "fabric.toml"
[[stage]]
use = "drape"
"#;

/// Every stage that follows the drape of a pattern.
const PATTERN: &str = r#"
[[stage]]
use = "texture"
[[stage]]
use = "flatten"
[[stage]]
use = "export-gltf"
[[stage]]
use = "export-obj"
[[stage]]
use = "export-dxf"
[[stage]]
use = "export-print"
"#;

/// Changes of the pattern: a half of the dart of the front goes to the side, and a yoke is cut off the back.
const ALTERED: &str = r#"
[[stage]]
use = "import-dxf"
with.file = "pattern.dxf"
with.sewing = "sewing.toml"
[[stage]]
use = "alter"
[[stage.with.change]]
do = "pivot"
piece = "FRONT"
dart = "dart-1"
to = [0, 60]
share = "50 %"
back = "10 mm"
[[stage.with.change]]
do = "cut"
piece = "BACK"
along = [[-100, 60], [0, 50], [100, 60]]
into = { upper = "YOKE", lower = "BACK" }
seam = "yoke seam"
[[stage]]
use = "export-dxf"
with.source = "pattern"
with.sewing = "{out}/new.toml"
"#;

/// The tube on a wider body.
const MOVED: &str = r#"
[[stage]]
use = "transfer"
with.body = "wide.obj"
[[stage]]
use = "flatten"
[[stage]]
use = "export-dxf"
"#;

/// What shows the garment of a pattern: drawn in a project of its own, because pictures take most of the time.
const SHOWN: &str = r#"
[[stage]]
use = "export-report"
[[stage]]
use = "export-picture"
with.width = 64
with.height = 64
"#;

/// A specification of another program.
const SPECIFICATION: &str = r#"
[[stage]]
use = "import-garmentcode"
with.file = "tube.json"
[[stage]]
use = "triangulate"
with.edge_length = "60 mm"
[[stage]]
use = "assemble"
[[stage]]
use = "export-dxf"
with.source = "pattern"
"#;

/// A garment in 3D, laid flat.
const GARMENT: &str = r#"
[[stage]]
use = "import-garment"
with.file = "garment.json"
[[stage]]
use = "flatten"
"#;

/// A triangle of cloth that was draped flat.
const TRIANGLE: &str = r#"{"kind":"toile-garment","version":1,"garment":{"pieces":[{"id":0,"name":"front","block":"FRONT",
"outline":{"closed":true,"points":[{"at":[0.0,0.0],"kind":"turn"},{"at":[0.1,0.0],"kind":"turn"},{"at":[0.0,0.1],"kind":"turn"}]},
"mesh":{"rest":[[0.0,0.0],[0.1,0.0],[0.0,0.1]],"triangles":[[0,1,2]],"outline_vertex":[0,1,2],
"chains":[{"kind":"outline","index":0,"vertices":[0,1,2],"closed":true}]}}],
"drape":{"positions":[[[0.0,0.0,0.0],[0.1,0.0,0.0],[0.0,0.1,0.0]]],"sewn":true,"welded":true}}}"#;

/// A sheet that hangs by two edges, and moves.
const SHEET: &str = r#"
[[stage]]
use = "import-mesh"
with.cloth = "sheet.obj"
with.fabric = "fabric.toml"
with.pins = "pins.txt"
[[stage]]
use = "drape"
[[stage]]
use = "export-obj"
with.file = "{out}/rest.obj"
with.reactions = "{out}/reactions.json"
[[stage]]
use = "animate"
with.frames = 4
with.sequence = "{out}/frame-0.obj"
with.gravity = "5 m/s2"
[[stage]]
use = "export-gltf"
"#;

const SEWING: &str = r#"
[[seam]]
name = "left"
a = { piece = "FRONT", from = ["200 mm", "0 mm"], to = ["200 mm", "150 mm"] }
b = { piece = "BACK", from = ["-100 mm", "0 mm"], to = ["-100 mm", "151 mm"] }
[[seam]]
name = "right"
a = { piece = "FRONT", from = ["0 mm", "0 mm"], to = ["0 mm", "150 mm"] }
b = { piece = "BACK", from = ["100 mm", "0 mm"], to = ["100 mm", "151 mm"] }
[[place]]
piece = "FRONT"
around = "torso"
side = "front"
height = "850 mm"
[[place]]
piece = "BACK"
around = "torso"
side = "back"
height = "850 mm"
[[edge]]
piece = "FRONT"
name = "top"
from = ["200 mm", "150 mm"]
to = ["0 mm", "150 mm"]
[[edge]]
piece = "BACK"
name = "top"
from = ["100 mm", "151 mm"]
to = ["-100 mm", "151 mm"]
[[attach]]
piece = "FRONT"
edge = "top"
to = "waist"
[[attach]]
piece = "BACK"
edge = "top"
to = "waist"
"#;

const BODY: &str = r#"
name = "cylinder"
[measures]
waist_height = "1000 mm"
[landmarks]
waist = ["0 mm", "1000 mm", "60 mm"]
hip = ["0 mm", "960 mm", "60 mm"]
[segments.torso]
from = ["0 mm", "800 mm", "0 mm"]
to = ["0 mm", "1300 mm", "0 mm"]
half_width = "60 mm"
half_depth = "60 mm"
[segments.neck]
from = ["0 mm", "800 mm", "0 mm"]
to = ["0 mm", "1300 mm", "0 mm"]
half_width = "62 mm"
half_depth = "62 mm"
[segments.arm-left]
from = ["0 mm", "800 mm", "0 mm"]
to = ["0 mm", "1300 mm", "0 mm"]
half_width = "62 mm"
half_depth = "62 mm"
[segments.arm-right]
from = ["0 mm", "800 mm", "0 mm"]
to = ["0 mm", "1300 mm", "0 mm"]
half_width = "62 mm"
half_depth = "62 mm"
[segments.leg-left]
from = ["0 mm", "800 mm", "0 mm"]
to = ["0 mm", "1300 mm", "0 mm"]
half_width = "62 mm"
half_depth = "62 mm"
[segments.leg-right]
from = ["0 mm", "800 mm", "0 mm"]
to = ["0 mm", "1300 mm", "0 mm"]
half_width = "62 mm"
half_depth = "62 mm"
"#;

const FABRIC: &str = r#"
name = "cloth"
areal_mass = "200 g/m2"
thickness = "0.5 mm"
friction = 0.3
strain_limit_warp = "8 %"
strain_limit_weft = "8 %"
strain_limit_bias = "12 %"
"#;

/// The laws of a fabric, one way of giving them for each project.
fn laws(project: &str) -> &'static str {
    match project {
        "kes" => {
            "[kes]\nemt_warp = \"5 %\"\nlt_warp = 0.6\nemt_weft = \"8 %\"\nlt_weft = 0.6\nshear = \"30 N/m/rad\"\n\
             bending_warp = \"12 uN.m\"\nbending_weft = \"7 uN.m\"\nbending_hysteresis = \"0.3 mN\"\n"
        }
        "fast" => {
            "[fast]\ne5_warp = \"0.5 %\"\ne20_warp = \"1.5 %\"\ne100_warp = \"4 %\"\ne5_weft = \"1 %\"\n\
             e20_weft = \"2.5 %\"\ne100_weft = \"6 %\"\neb5 = \"3 %\"\nbending_length_warp = \"18 mm\"\n\
             bending_length_weft = \"16 mm\"\n"
        }
        "curve" => {
            "[curve]\nwarp = [[\"0 %\", \"0 N/m\"], [\"4 %\", \"30 N/m\"]]\n\
             weft = [[\"0 %\", \"0 N/m\"], [\"6 %\", \"30 N/m\"]]\nshear = \"30 N/m/rad\"\nbending = \"9 uN.m\"\n"
        }
        "curves" => {
            "[curve]\nwarp = [[\"0 %\", \"0 N/m\"], [\"4 %\", \"30 N/m\"]]\n\
             weft = [[\"0 %\", \"0 N/m\"], [\"6 %\", \"30 N/m\"]]\n\
             shear_force = [[\"2 deg\", \"2 N/m\"], [\"8 deg\", \"6 N/m\"]]\n\
             bending_moment_warp = [[\"10 1/m\", \"0.2 mN\"], [\"200 1/m\", \"2 mN\"]]\n\
             bending_moment_weft = [[\"10 1/m\", \"0.2 mN\"], [\"200 1/m\", \"2 mN\"]]\n"
        }
        "isotropic" => "[isotropic]\nstretch = \"700 N/m\"\npoisson = 0.2\nbending = \"9 uN.m\"\n",
        _ => {
            "[linear]\nstretch_warp = \"800 N/m\"\nstretch_weft = \"600 N/m\"\nshear = \"40 N/m/rad\"\npoisson = 0.2\n\
             bending_warp = \"9 uN.m\"\nbending_weft = \"7 uN.m\"\nbending_hysteresis = \"0.3 mN\"\n"
        }
    }
}

/// Writes the files of a project beside its pipeline.
pub fn write(bench: &Bench, name: &str) {
    let folder = bench.pipeline_file().parent().expect("folder").to_path_buf();
    let put = |file: &str, text: &[u8]| std::fs::write(folder.join(file), text).expect("file");
    let stages = match name {
        "specification" => SPECIFICATION.to_owned(),
        "altered" => ALTERED.to_owned(),
        "moved" => [DRAPED, MOVED].concat(),
        "garment" => GARMENT.to_owned(),
        "sheet" => SHEET.to_owned(),
        _ => [DRAPED, PATTERN].concat(),
    };
    let springs = if name == "springs" { "[springs]\nyarn = \"500 N/m\"\nbias = \"300 N/m\"\n" } else { "" };
    let look = if name == "look" { "[look]\nweave = \"twill\"\nends_per_cm = 20\nsheen = 0.1\n" } else { "" };
    let fabric = format!("{FABRIC}{}{springs}{look}", laws(name));
    let model = if name == "springs" { "use = \"drape\"\nwith.model = \"springs\"" } else { "use = \"drape\"" };
    let shown = if name == "shown" { SHOWN } else { "" };
    let texture = if name == "look" { "use = \"texture\"\nwith.weave = true" } else { "use = \"texture\"" };
    let stages = stages.replace("use = \"drape\"", model).replace("use = \"texture\"", texture) + shown;
    let sewing = name.strip_prefix("around ").map_or_else(
        || SEWING.to_owned(),
        |segment| SEWING.replacen("around = \"torso\"", &format!("around = \"{segment}\""), 1),
    );
    bench.text(&format!("{HEAD}{stages}"));
    put("pattern.dxf", &dxf(200.0));
    put("other.dxf", &dxf(206.0));
    put("sewing.toml", sewing.as_bytes());
    put(
        "loose.toml",
        SEWING
            .replace("[[attach]]", "[[layer]]\norder = 1\npieces = []\n[[attach]]")
            .replace("to = \"waist\"", "to = \"hip\"")
            .as_bytes(),
    );
    put("tube.json", include_bytes!("../golden/garmentcode/tube.json"));
    put("garment.json", TRIANGLE.as_bytes());
    put("tube-sewing.toml", b"leave_out = [\"back\"]\n");
    for (file, radius) in [("body.obj", 0.06), ("wide.obj", 0.061)] {
        put(file, cylinder(radius).as_bytes());
    }
    put("body.toml", BODY.as_bytes());
    put("cone.obj", cone().as_bytes());
    put("cone.toml", BODY.as_bytes());
    put("wide.toml", BODY.replace("60 mm", "61 mm").as_bytes());
    put("fabric.toml", fabric.as_bytes());
    put("heavy.toml", fabric.replace("200 g/m2", "300 g/m2").as_bytes());
    put("sheet.obj", sheet(0.05).as_bytes());
    put("wide-sheet.obj", sheet(0.06).as_bytes());
    put("pins.txt", b"0\n1\n2\n3\n28\n29\n30\n31\n");
    put("two-pins.txt", b"0\n3\n28\n31\n");
    put("loads.txt", b"12 0 0 0.01\n");
    put("stitches.txt", b"12 15\n");
    for frame in 0..3 {
        put(&format!("walk-{frame}.obj"), cylinder_at(0.03, 0.005 * f64::from(frame)).as_bytes());
    }
    put("ball.obj", cylinder_at(0.03, 0.0).as_bytes());
    put("check.png", include_bytes!("../../samples/textures/plain-weave.png"));
}

/// Vertices and faces of an upright cylinder that is closed above and below.
fn cylinder(radius: f64) -> String {
    upright([radius, radius], 0.0, [0.0, 1.7], 12)
}

/// A cone on its tip, so steep that no right angle of cloth around it stays right.
fn cone() -> String {
    upright([0.01, 0.26], 0.0, [0.0, 1.7], 12)
}

/// A short lying stick for the sheet, moved forward.
fn cylinder_at(radius: f64, forward: f64) -> String {
    upright([radius, radius], forward, [0.75, 0.8], 1)
}

fn upright(radii: [f64; 2], forward: f64, ends: [f64; 2], levels: u32) -> String {
    const ROUND: u32 = 32;
    let mut text = String::new();
    for level in 0..=levels {
        let share = f64::from(level) / f64::from(levels);
        let y = ends[0] + (ends[1] - ends[0]) * share;
        let radius = radii[0] + (radii[1] - radii[0]) * share;
        for k in 0..ROUND {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(k) / f64::from(ROUND));
            writeln!(text, "v {:.6} {y:.6} {:.6}", radius * sin, radius * cos + forward).expect("text");
        }
    }
    writeln!(text, "v 0 {:.6} {forward:.6}\nv 0 {:.6} {forward:.6}", ends[0], ends[1]).expect("text");
    let [low, high] = [(levels + 1) * ROUND + 1, (levels + 1) * ROUND + 2];
    for k in 0..ROUND {
        let next = (k + 1) % ROUND;
        for level in 0..levels {
            let [a, b] = [level * ROUND + 1, (level + 1) * ROUND + 1];
            writeln!(text, "f {} {} {}\nf {} {} {}", a + k, a + next, b + next, a + k, b + next, b + k).expect("text");
        }
        let top = levels * ROUND + 1;
        writeln!(text, "f {low} {} {}\nf {high} {} {}", 1 + next, 1 + k, top + k, top + next).expect("text");
    }
    text
}

/// A sheet of 4 × 8 vertices, folded back over itself 3 mm higher, that hangs from its first and last row as a loop. Its cloth
/// coordinates are 4 % larger.
fn sheet(step: f64) -> String {
    const ROWS: u32 = 8;
    let mut text = String::new();
    for (row, column) in (0..ROWS).flat_map(|r| (0..4u32).map(move |c| (r, c))) {
        let [x, along] = [f64::from(column) * step - 0.075, f64::from(row) * step];
        let (y, z) =
            if row < ROWS / 2 { (0.85, along - 0.02) } else { (0.853, step * f64::from(ROWS - 1) - along - 0.02) };
        writeln!(text, "v {x:.4} {y:.4} {z:.4}\nvt {:.4} {:.4}", 1.04 * x + 0.1, 1.04 * along + 0.1).expect("text");
    }
    for (row, column) in (0..ROWS - 1).flat_map(|r| (0..3u32).map(move |c| (r, c))) {
        let v = |r: u32, c: u32| 4 * r + c + 1;
        let [a, b, c, d] = [v(row, column), v(row + 1, column), v(row + 1, column + 1), v(row, column + 1)];
        writeln!(text, "f {a}/{a} {b}/{b} {c}/{c}\nf {a}/{a} {c}/{c} {d}/{d}").expect("text");
    }
    text
}

/// The pattern of the tube. The front has a dart, a bend of 15° in its hem, an overshot corner and a small gap; the back
/// is drawn as a half. One letter is not of 7 bits.
fn dxf(width: f64) -> Vec<u8> {
    let front = |w: f64| {
        vec![
            (0.0, 0.0),
            (0.5 * w, -13.0),
            (w + 4.0, 0.5),
            (w, -4.0),
            (w, 150.0),
            (0.5 * w + 6.0, 150.0),
            (0.5 * w, 90.0),
            (0.5 * w - 6.0, 150.0),
            (0.0, 150.0),
            (0.0, 0.3),
        ]
    };
    let back = vec![(0.0, 0.0), (100.0, 0.0), (100.0, 151.0), (0.0, 151.0)];
    let mut text = Dxf::default().pairs(&[(0, "SECTION"), (2, "BLOCKS")]);
    for (size, width) in [("38", width), ("40", width + 2.0)] {
        text = text.block(&format!("FRONT_{size}")).text("Piece Name: FRONT").text(&format!("Size: {size}"));
        text = text.text("Annotation: \u{e4}").text("Quantity: 1").polyline("1", false, &front(width));
        text = text.line("7", (20.0, 20.0), (20.0, 120.0)).arc("8", (60.0, 60.0), 25.0).end();
        text = text.block(&format!("BACK_{size}")).text("Piece Name: BACK").text(&format!("Size: {size}"));
        text = text.text("Material: LIN").polyline("1", true, &back).line("6", (0.0, 0.0), (0.0, 151.0));
        text = text.line("7", (20.0, 20.0), (20.0, 120.0)).end();
    }
    text = text.pairs(&[(0, "ENDSEC"), (0, "SECTION"), (2, "ENTITIES")]);
    for (k, name) in ["FRONT_38", "BACK_38", "FRONT_40", "BACK_40"].into_iter().enumerate() {
        text = text.pairs(&[(0, "INSERT"), (8, "1"), (2, name)]).point(500.0 * k as f64, 10.0);
    }
    let text = text.text("Style Name: TUBE").text("Sample Size: 38").text("Units: METRIC");
    let text = text.pairs(&[(0, "ENDSEC"), (0, "EOF")]).0;
    // Latin letters of 8 bits, as old programs write them.
    text.chars().map(|c| u8::try_from(u32::from(c)).expect("a letter of 8 bits")).collect()
}

/// A DXF as text, pair by pair.
#[derive(Default)]
struct Dxf(String);

impl Dxf {
    fn pairs(mut self, pairs: &[(i32, &str)]) -> Self {
        pairs.iter().for_each(|(code, value)| writeln!(self.0, "{code:>3}\n{value}").expect("text"));
        self
    }

    fn point(self, x: f64, y: f64) -> Self {
        self.pairs(&[(10, &x.to_string()), (20, &y.to_string())])
    }

    fn block(self, name: &str) -> Self {
        self.pairs(&[(0, "BLOCK"), (8, "0"), (2, name), (70, "64")]).point(0.0, 0.0)
    }

    fn end(self) -> Self {
        self.pairs(&[(0, "ENDBLK")])
    }

    fn text(self, text: &str) -> Self {
        self.pairs(&[(0, "TEXT"), (8, "1")]).point(50.0, 50.0).pairs(&[(40, "3"), (1, text)])
    }

    fn line(self, layer: &str, a: (f64, f64), b: (f64, f64)) -> Self {
        let text = self.pairs(&[(0, "LINE"), (8, layer)]).point(a.0, a.1);
        text.pairs(&[(11, &b.0.to_string()), (21, &b.1.to_string())])
    }

    fn arc(self, layer: &str, centre: (f64, f64), radius: f64) -> Self {
        let text = self.pairs(&[(0, "ARC"), (8, layer)]).point(centre.0, centre.1);
        text.pairs(&[(40, &radius.to_string()), (50, "0"), (51, "120")])
    }

    fn polyline(self, layer: &str, closed: bool, points: &[(f64, f64)]) -> Self {
        let mut text = self.pairs(&[(0, "POLYLINE"), (8, layer), (66, "1"), (70, if closed { "1" } else { "0" })]);
        for (x, y) in points {
            text = text.pairs(&[(0, "VERTEX"), (8, layer)]).point(*x, *y);
        }
        text.pairs(&[(0, "SEQEND")])
    }
}
