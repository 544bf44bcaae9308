//! The rows: a key, another value for it, and the circumstances under which it can act.

/// One key that is given another value.
pub struct Flip {
    /// The project that is run.
    pub project: &'static str,
    /// Changes that hold before and after.
    pub given: &'static [&'static str],
    /// The key.
    pub key: &'static str,
    /// Its other value, TOML.
    pub value: &'static str,
}

const fn row(project: &'static str, key: &'static str, value: &'static str) -> Flip {
    Flip { project, given: &[], key, value }
}

const fn given(project: &'static str, given: &'static [&'static str], key: &'static str, value: &'static str) -> Flip {
    Flip { project, given, key, value }
}

/// Keys that hold a person's own words, and why nothing else changes with them.
pub const NOTES: &[(&str, &str)] = &[
    ("note", "words about the file"),
    ("source", "where a value is from"),
    ("method", "how a value was measured"),
    ("name", "a label; names that others refer to have rows"),
];

const WIDE: &str = "import-dxf.allowance={ width = \"10 mm\" }";
const OUT_WIDE: &str = "export-dxf.allowance={ width = \"10 mm\" }";
const PRINT_WIDE: &str = "export-print.allowance={ width = \"10 mm\" }";
const READ_WIDE: &str = "import-garmentcode.allowance={ width = \"10 mm\" }";
const EXPLICIT: &str = "drape.integrator=\"central-difference\"";
const EXPLICIT_SEWING: &str = "stitch.integrator=\"central-difference\"";
const EXPLICIT_MOTION: &str = "animate.integrator=\"central-difference\"";
const UNCHANGED: &str = "export-dxf.source=\"pattern\"";
const WALK: &str = "animate.body=\"walk-0.obj\"";
const STICK: &str = "import-mesh.body=\"walk-0.obj\"";
const LOOK: &str = "texture.materials=[{ name = \"FRONT\", color = \"#ff0000\" }]";
const IMAGE: &str = "texture.image=\"check.png\"";

/// Parameters of the stages.
pub const STAGES: &[Flip] = &[
    given("pattern", &[UNCHANGED], "import-dxf.allowance.width", "\"10 mm\""),
    given("pattern", &[WIDE, UNCHANGED], "import-dxf.allowance.corners", "\"bevel\""),
    given("pattern", &[WIDE, UNCHANGED], "import-dxf.allowance.edges", "{ \"FRONT.0\" = \"30 mm\" }"),
    given("pattern", &[WIDE, UNCHANGED], "import-dxf.allowance.pieces", "{ FRONT = \"20 mm\" }"),
    given("pattern", &[UNCHANGED], "import-dxf.code_page", "\"windows-1251\""),
    row("pattern", "import-dxf.corner", "\"5 deg\""),
    given("pattern", &[UNCHANGED], "import-dxf.curve", "\"2 mm\""),
    row("pattern", "import-dxf.file", "\"other.dxf\""),
    row("pattern", "import-dxf.gap", "\"0.1 mm\""),
    row("pattern", "import-dxf.inserts", "\"placed\""),
    row("pattern", "import-dxf.layers", "{ 8 = \"ignore\" }"),
    row("pattern", "import-dxf.loops", "\"1 mm\""),
    row("pattern", "import-dxf.pieces", "[\"FRONT\"]"),
    row("pattern", "import-dxf.profile", "\"gerber\""),
    row("pattern", "import-dxf.rules", "\"absent.rul\""),
    row("pattern", "import-dxf.sewing", "\"loose.toml\""),
    row("pattern", "import-dxf.size", "\"40\""),
    row("pattern", "import-dxf.units", "\"cm\""),
    row("specification", "import-garmentcode.allowance.width", "\"10 mm\""),
    given("specification", &[READ_WIDE], "import-garmentcode.allowance.corners", "\"bevel\""),
    given("specification", &[READ_WIDE], "import-garmentcode.allowance.edges", "{ \"front.0\" = \"30 mm\" }"),
    given("specification", &[READ_WIDE], "import-garmentcode.allowance.pieces", "{ front = \"20 mm\" }"),
    row("specification", "import-garmentcode.curve", "\"2 mm\""),
    row("specification", "import-garmentcode.file", "\"absent.json\""),
    row("specification", "import-garmentcode.sewing", "\"tube-sewing.toml\""),
    row("sheet", "import-mesh.body", "\"ball.obj\""),
    row("sheet", "import-mesh.cloth", "\"wide-sheet.obj\""),
    row("sheet", "import-mesh.fabric", "\"heavy.toml\""),
    row("sheet", "import-mesh.loads", "\"loads.txt\""),
    row("sheet", "import-mesh.pins", "\"two-pins.txt\""),
    row("sheet", "import-mesh.rest", "\"uv\""),
    row("sheet", "import-mesh.stitches", "\"stitches.txt\""),
    row("sheet", "import-mesh.up", "\"z\""),
    row("pattern", "triangulate.angle", "\"40 deg\""),
    row("pattern", "triangulate.edge_length", "\"18 mm\""),
    row("pattern", "triangulate.mesher", "\"lyon\""),
    row("pattern", "triangulate.triangles", "500"),
    row("pattern", "assemble.max_ease", "\"0.1 %\""),
    row("pattern", "stitch.body", "\"wide.obj\""),
    row("pattern", "stitch.body_gap", "\"3 mm\""),
    row("pattern", "stitch.clearance", "\"35 mm\""),
    row("pattern", "stitch.fabric", "\"heavy.toml\""),
    row("pattern", "stitch.fabrics", "{ LIN = \"heavy.toml\" }"),
    row("pattern", "stitch.integrator", "\"central-difference\""),
    given("pattern", &[EXPLICIT_SEWING], "stitch.max_time", "\"10 ms\""),
    row("pattern", "stitch.model", "\"springs\""),
    row("pattern", "stitch.self_gap", "\"4 mm\""),
    row("pattern", "stitch.sewing_distance", "\"30 mm\""),
    row("pattern", "drape.accuracy", "\"reference\""),
    row("pattern", "drape.body_gap", "\"3 mm\""),
    given("pattern", &["drape.effects.friction=\"off\""], "drape.effects.bending-hysteresis", "\"on\""),
    row("pattern", "drape.effects.body-contact", "\"off\""),
    row("pattern", "drape.effects.friction", "\"off\""),
    row("pattern", "drape.effects.self-contact", "\"off\""),
    row("pattern", "drape.effects.strain-limit", "\"off\""),
    row("pattern", "drape.gravity", "\"4 m/s2\""),
    row("pattern", "drape.integrator", "\"central-difference\""),
    row("pattern", "drape.limits", "{ strain_max = 1e-9 }"),
    given("pattern", &[EXPLICIT], "drape.max_time", "\"10 ms\""),
    row("pattern", "drape.model", "\"springs\""),
    row("pattern", "drape.pressure", "\"5 Pa\""),
    row("pattern", "drape.repeats", "1"),
    row("pattern", "drape.self_gap", "\"4 mm\""),
    row("sheet", "animate.accuracy", "\"reference\""),
    row("sheet", "animate.air", "\"off\""),
    given("sheet", &[STICK], "animate.body", "\"walk-0.obj\""),
    given("sheet", &[STICK, WALK], "animate.body_gap", "\"4 mm\""),
    row("sheet", "animate.calming", "\"0.1 s\""),
    given("sheet", &[STICK, EXPLICIT_MOTION], "animate.contact_stiffness", "\"5 N/m\""),
    row("sheet", "animate.effects.bending-hysteresis", "\"off\""),
    given("sheet", &[STICK, WALK], "animate.effects.body-contact", "\"off\""),
    given("sheet", &[STICK, WALK], "animate.effects.friction", "\"off\""),
    row("sheet", "animate.effects.self-contact", "\"off\""),
    row("sheet", "animate.effects.strain-limit", "\"off\""),
    given("sheet", &[EXPLICIT_MOTION], "animate.fixed_step", "true"),
    row("sheet", "animate.fps", "20.0"),
    row("sheet", "animate.frames", "3"),
    row("sheet", "animate.gravity", "\"7 m/s2\""),
    row("sheet", "animate.integrator", "\"leapfrog\""),
    given("sheet", &["import-mesh.body=\"ball.obj\"", "animate.body=\"walk-2.obj\""], "animate.lead_in", "\"0.2 s\""),
    row("sheet", "animate.model", "\"springs\""),
    given("sheet", &["animate.until_settled=true"], "animate.rest_speed", "\"10 m/s\""),
    row("sheet", "animate.self_gap", "\"4 mm\""),
    row("sheet", "animate.sequence", "\"{out}/picture-0.obj\""),
    row("sheet", "animate.step", "\"2 ms\""),
    given("sheet", &["animate.rest_speed=\"10 m/s\"", "animate.frames=9"], "animate.until_settled", "true"),
    row("pattern", "texture.color", "\"#336699\""),
    row("pattern", "texture.image", "\"check.png\""),
    row("pattern", "texture.margin", "\"30 mm\""),
    given("pattern", &[LOOK], "texture.materials[0].color", "\"#00ff00\""),
    given("pattern", &[LOOK], "texture.materials[0].image", "\"check.png\""),
    given("pattern", &[LOOK], "texture.materials[0].name", "\"ABSENT\""),
    given("pattern", &[LOOK], "texture.materials[0].pieces", "[\"BACK\"]"),
    given("pattern", &[LOOK, IMAGE], "texture.materials[0].repeat", "[\"20 mm\", \"20 mm\"]"),
    given("pattern", &[LOOK], "texture.materials[0].roughness", "0.1"),
    given("pattern", &[IMAGE], "texture.repeat", "[\"20 mm\", \"20 mm\"]"),
    row("pattern", "texture.roughness", "0.2"),
    row("pattern", "export-gltf.file", "\"{out}/other.glb\""),
    row("pattern", "export-obj.file", "\"{out}/other.obj\""),
    row("pattern", "export-obj.reactions", "\"{out}/forces.json\""),
    row("pattern", "export-obj.up", "\"z\""),
    given("pattern", &["flatten.metric=\"surface\""], "flatten.max_rounds", "1"),
    row("pattern", "flatten.metric", "\"surface\""),
    given("pattern", &["flatten.metric=\"surface\""], "flatten.pair_stiffness", "1.0"),
    given("pattern", &["flatten.metric=\"surface\""], "flatten.smoothing", "5"),
    given("pattern", &["flatten.metric=\"surface\""], "flatten.stop_motion", "\"1 mm\""),
    given("pattern", &["flatten.metric=\"surface\"", "drape.pressure=\"300 Pa\""], "flatten.strain_limit", "\"50 %\""),
    row("pattern", "export-dxf.allowance.width", "\"10 mm\""),
    given("pattern", &[OUT_WIDE], "export-dxf.allowance.corners", "\"bevel\""),
    given("pattern", &[OUT_WIDE], "export-dxf.allowance.edges", "{ \"FRONT.0\" = \"30 mm\" }"),
    given("pattern", &[OUT_WIDE], "export-dxf.allowance.pieces", "{ FRONT = \"20 mm\" }"),
    row("pattern", "export-dxf.author", "\"A. Maker\""),
    given("pattern", &[UNCHANGED], "export-dxf.code_page", "\"windows-1252\""),
    row("pattern", "export-dxf.date", "\"2026-01-01\""),
    row("pattern", "export-dxf.dialect", "\"aama\""),
    row("pattern", "export-dxf.file", "\"{out}/other.dxf\""),
    given("pattern", &[UNCHANGED], "export-dxf.half_on_fold", "true"),
    row("pattern", "export-dxf.mark_darts", "true"),
    row("pattern", "export-dxf.size_run", "\"pattern.dxf\""),
    given("pattern", &["flatten.metric=\"surface\""], "export-dxf.source", "\"pattern\""),
    row("pattern", "export-dxf.units", "\"inch\""),
    row("pattern", "export-print.allowance.width", "\"10 mm\""),
    given("pattern", &[PRINT_WIDE], "export-print.allowance.corners", "\"bevel\""),
    given("pattern", &[PRINT_WIDE], "export-print.allowance.edges", "{ \"FRONT.0\" = \"30 mm\" }"),
    given("pattern", &[PRINT_WIDE], "export-print.allowance.pieces", "{ FRONT = \"20 mm\" }"),
    row("pattern", "export-print.file", "\"{out}/pattern.svg\""),
    row("pattern", "export-print.font", "\"absent.ttf\""),
    row("pattern", "export-print.gap", "\"40 mm\""),
    row("pattern", "export-print.paper", "\"a3\""),
    given("pattern", &["export-print.file=\"{out}/pattern.svg\""], "export-print.width", "\"250 mm\""),
    row("shown", "export-picture.body", "false"),
    row("shown", "export-picture.colours", "\"strain-warp\""),
    row("shown", "export-picture.file", "\"{out}/other.png\""),
    row("shown", "export-picture.height", "96"),
    row("shown", "export-picture.view", "\"left\""),
    row("shown", "export-picture.width", "96"),
    row("shown", "export-report.csv", "\"{out}/other.csv\""),
    row("shown", "export-report.language", "\"zh\""),
    row("shown", "export-report.html", "\"{out}/other.html\""),
    row("shown", "export-report.json", "\"{out}/other.json\""),
    row("shown", "export-report.svg", "\"{out}/other.svg\""),
];

const COPY: &str = "copy=[{ piece = \"FRONT\", name = \"SECOND\" }, { piece = \"FRONT\", name = \"THIRD\" }]";
const COPY_PLACES: [&str; 2] = [
    "place[2]={ piece = \"SECOND\", around = \"torso\", side = \"left\", height = \"1200 mm\" }",
    "place[3]={ piece = \"THIRD\", around = \"torso\", side = \"right\", height = \"1200 mm\" }",
];
const COPIES: &[&str] = &[COPY, COPY_PLACES[0], COPY_PLACES[1]];
const DART: &str = "dart=[{ piece = \"FRONT\", apex = [\"100 mm\", \"90 mm\"], mouth = [[\"94 mm\", \"150 mm\"], [\"106 mm\", \"150 mm\"]] }]";
const NAMED: &str = "edge[2]={ piece = \"BACK\", name = \"hem\", number = 0 }";
const STRETCH: &str =
    "edge[2]={ piece = \"BACK\", name = \"hem\", from = [\"-100 mm\", \"0 mm\"], to = [\"100 mm\", \"0 mm\"] }";
const HELD_HEM: &str = "attach[2]={ piece = \"BACK\", edge = \"hem\", to = \"hip\" }";
const LAYERS: &str = "layer=[{ order = 1, pieces = [\"BACK\"] }]";
const ELASTIC: &str = "elastic=[{ along = \"BACK.0\", length = \"80 %\" }]";
const FOLD: &str =
    "fold=[{ piece = \"BACK\", line = [[\"-100 mm\", \"40 mm\"], [\"100 mm\", \"40 mm\"]], angle = \"40 deg\" }]";
const INTERLINING: &str = "interlining=[{ pieces = [\"BACK\"], areal_mass = \"60 g/m2\", bending = \"100 uN.m\" }]";
const PLEAT: &str = "dart=[{ piece = \"BACK\", kind = \"pleat\", mouth = [[\"-10 mm\", \"151 mm\"], [\"10 mm\", \"151 mm\"]], apexes = [[\"-10 mm\", \"60 mm\"], [\"10 mm\", \"60 mm\"]], press = \"inverted\", sewn = \"30 mm\" }]";
const PUT: &str = "place[0]={ piece = \"FRONT\", rotation = [[1, 0, 0], [0, 1, 0], [0, 0, 1]], translation = [\"-100 mm\", \"850 mm\", \"80 mm\"] }";

/// Keys of the sewing file.
const SEWING: &[Flip] = &[
    row("pattern", "seam[0].name", "\"right\""),
    row("pattern", "seam[0].a", "\"FRONT.0\""),
    row("pattern", "seam[0].b", "\"BACK.0\""),
    row("pattern", "seam[0].ease", "\"20 mm\""),
    row("pattern", "seam[0].gather", "1.3"),
    row("pattern", "seam[0].reverse", "true"),
    row("pattern", "seam[0].proposed", "0.9"),
    row("pattern", "attach[0].piece", "\"BACK\""),
    row("pattern", "attach[0].edge", "\"0\""),
    row("pattern", "attach[0].to", "\"hip\""),
    row("pattern", "attach[0].strength", "\"elastic 0.9\""),
    given("pattern", &[ELASTIC], "elastic[0].along", "[\"FRONT.0\"]"),
    given("pattern", &[ELASTIC], "elastic[0].length", "\"70 mm\""),
    given("pattern", &[ELASTIC], "elastic[0].stretch", "\"2 N\""),
    given("pattern", &[FOLD], "fold[0].piece", "\"FRONT\""),
    given("pattern", &[FOLD], "fold[0].line", "[[\"-100 mm\", \"60 mm\"], [\"100 mm\", \"60 mm\"]]"),
    given("pattern", &[FOLD], "fold[0].angle", "\"-40 deg\""),
    given("pattern", &[INTERLINING], "interlining[0].pieces", "[\"FRONT\"]"),
    given("pattern", &[INTERLINING], "interlining[0].areal_mass", "\"90 g/m2\""),
    given("pattern", &[INTERLINING], "interlining[0].bending", "\"300 uN.m\""),
    given("pattern", &[PLEAT], "dart[0].press", "\"box\""),
    given("pattern", &[PLEAT], "dart[0].sewn", "\"60 mm\""),
    given("pattern", COPIES, "copy[0].mirror", "true"),
    given("pattern", COPIES, "copy[0].name", "\"FOURTH\""),
    given("pattern", COPIES, "copy[0].piece", "\"BACK\""),
    given("pattern", &[DART], "dart[0].piece", "\"BACK\""),
    given("pattern", &[DART], "dart[0].apex", "[\"100 mm\", \"100 mm\"]"),
    given("pattern", &[DART], "dart[0].apexes", "[[\"100 mm\", \"90 mm\"], [\"100 mm\", \"30 mm\"]]"),
    given("pattern", &[DART], "dart[0].mouth", "[[\"90 mm\", \"150 mm\"], [\"106 mm\", \"150 mm\"]]"),
    given("pattern", &[DART], "dart[0].kind", "\"none\""),
    given("pattern", &[NAMED, HELD_HEM], "edge[2].name", "\"lower\""),
    given("pattern", &[NAMED, HELD_HEM], "edge[2].number", "1"),
    given("pattern", &[NAMED, HELD_HEM], "edge[2].edge", "\"2\""),
    given("pattern", &[NAMED, HELD_HEM], "edge[2].piece", "\"FRONT\""),
    given("pattern", &[STRETCH, HELD_HEM], "edge[2].from", "[\"0 mm\", \"0 mm\"]"),
    given("pattern", &[STRETCH, HELD_HEM], "edge[2].to", "[\"0 mm\", \"0 mm\"]"),
    given("pattern", &[STRETCH, HELD_HEM], "edge[2].way", "\"long\""),
    given("pattern", &[LAYERS], "layer[0].order", "-1"),
    given("pattern", &[LAYERS], "layer[0].pieces", "[\"FRONT\"]"),
    row("pattern", "leave_out", "[\"BACK\"]"),
    row("pattern", "place[0].piece", "\"BACK\""),
    row("pattern", "place[0].around", "\"neck\""),
    row("pattern", "place[0].side", "\"left\""),
    row("pattern", "place[0].height", "\"880 mm\""),
    row("pattern", "place[0].turn", "\"20 deg\""),
    row("pattern", "place[0].ignores", "[\"torso\"]"),
    given("pattern", &[PUT], "place[0].rotation", "[[0, 0, 1], [0, 1, 0], [-1, 0, 0]]"),
    given("pattern", &[PUT], "place[0].translation", "[\"-100 mm\", \"870 mm\", \"80 mm\"]"),
];

/// Keys of the fabric file.
const FABRIC: &[Flip] = &[
    row("pattern", "areal_mass", "\"300 g/m2\""),
    row("pattern", "thickness", "\"3 mm\""),
    row("pattern", "friction", "0.6"),
    row("pattern", "strain_limit_warp", "\"4 %\""),
    row("pattern", "strain_limit_weft", "\"4 %\""),
    row("pattern", "strain_limit_bias", "\"4 %\""),
    row("pattern", "linear.stretch_warp", "\"1600 N/m\""),
    row("pattern", "linear.stretch_weft", "\"1600 N/m\""),
    row("pattern", "linear.shear", "\"90 N/m/rad\""),
    row("pattern", "linear.poisson", "0.3"),
    row("pattern", "linear.bending", "\"20 uN.m\""),
    row("pattern", "linear.bending_warp", "\"20 uN.m\""),
    row("pattern", "linear.bending_weft", "\"20 uN.m\""),
    row("pattern", "linear.bending_bias", "\"2 uN.m\""),
    row("pattern", "linear.bending_hysteresis", "\"1 mN\""),
    row("kes", "kes.emt_warp", "\"7 %\""),
    row("kes", "kes.emt_weft", "\"12 %\""),
    row("kes", "kes.lt_warp", "0.8"),
    row("kes", "kes.lt_weft", "0.8"),
    row("kes", "kes.shear", "\"90 N/m/rad\""),
    row("kes", "kes.poisson", "0.3"),
    row("kes", "kes.bending", "\"20 uN.m\""),
    row("kes", "kes.bending_warp", "\"20 uN.m\""),
    row("kes", "kes.bending_weft", "\"20 uN.m\""),
    row("kes", "kes.bending_bias", "\"2 uN.m\""),
    row("kes", "kes.bending_hysteresis", "\"1 mN\""),
    row("fast", "fast.e5_warp", "\"0.9 %\""),
    row("fast", "fast.e5_weft", "\"0.9 %\""),
    row("fast", "fast.e20_warp", "\"3 %\""),
    row("fast", "fast.e20_weft", "\"3 %\""),
    row("fast", "fast.e100_warp", "\"8 %\""),
    row("fast", "fast.e100_weft", "\"8 %\""),
    row("fast", "fast.eb5", "\"6 %\""),
    row("fast", "fast.bending_length_warp", "\"26 mm\""),
    row("fast", "fast.bending_length_weft", "\"26 mm\""),
    row("fast", "fast.bending_length_bias", "\"26 mm\""),
    row("fast", "fast.shear", "\"90 N/m/rad\""),
    row("fast", "fast.poisson", "0.3"),
    row("fast", "fast.bending", "\"20 uN.m\""),
    row("fast", "fast.bending_warp", "\"20 uN.m\""),
    row("fast", "fast.bending_weft", "\"20 uN.m\""),
    row("fast", "fast.bending_bias", "\"2 uN.m\""),
    row("fast", "fast.bending_hysteresis", "\"1 mN\""),
    row("curve", "curve.warp", "[[\"0 %\", \"0 N/m\"], [\"2 %\", \"30 N/m\"]]"),
    row("curve", "curve.weft", "[[\"0 %\", \"0 N/m\"], [\"2 %\", \"30 N/m\"]]"),
    row("curve", "curve.shear", "\"90 N/m/rad\""),
    row("curve", "curve.poisson", "0.3"),
    row("curve", "curve.bending", "\"20 uN.m\""),
    row("curve", "curve.bending_warp", "\"20 uN.m\""),
    row("curve", "curve.bending_weft", "\"20 uN.m\""),
    row("curve", "curve.bending_bias", "\"2 uN.m\""),
    row("curve", "curve.bending_hysteresis", "\"1 mN\""),
    row("isotropic", "isotropic.stretch", "\"1600 N/m\""),
    row("isotropic", "isotropic.poisson", "0.3"),
    row("isotropic", "isotropic.bending", "\"20 uN.m\""),
    row("springs", "springs.yarn", "\"900 N/m\""),
    row("springs", "springs.bias", "\"900 N/m\""),
];

/// Keys of the side file of a body.
const BODY: &[Flip] = &[
    given(
        "pattern",
        &["landmarks={ hip = [\"0 mm\", \"960 mm\", \"60 mm\"] }"],
        "measures",
        "{ waist_height = \"0.98 m\" }",
    ),
    row("pattern", "landmarks", "{ waist = [\"0 mm\", \"980 mm\", \"60 mm\"] }"),
    row("pattern", "segments.torso.from", "[\"0 mm\", \"800 mm\", \"20 mm\"]"),
    row("pattern", "segments.torso.to", "[\"0 mm\", \"1300 mm\", \"20 mm\"]"),
    row("pattern", "segments.torso.half_width", "\"65 mm\""),
    row("pattern", "segments.torso.half_depth", "\"65 mm\""),
    row("around neck", "segments.neck.from", "[\"0 mm\", \"900 mm\", \"10 mm\"]"),
    row("around neck", "segments.neck.to", "[\"0 mm\", \"1400 mm\", \"40 mm\"]"),
    row("around neck", "segments.neck.half_width", "\"65 mm\""),
    row("around neck", "segments.neck.half_depth", "\"65 mm\""),
    row("around arm-left", "segments.arm-left.from", "[\"0 mm\", \"900 mm\", \"10 mm\"]"),
    row("around arm-left", "segments.arm-left.to", "[\"0 mm\", \"1400 mm\", \"40 mm\"]"),
    row("around arm-left", "segments.arm-left.half_width", "\"65 mm\""),
    row("around arm-left", "segments.arm-left.half_depth", "\"65 mm\""),
    row("around arm-right", "segments.arm-right.from", "[\"0 mm\", \"900 mm\", \"10 mm\"]"),
    row("around arm-right", "segments.arm-right.to", "[\"0 mm\", \"1400 mm\", \"40 mm\"]"),
    row("around arm-right", "segments.arm-right.half_width", "\"65 mm\""),
    row("around arm-right", "segments.arm-right.half_depth", "\"65 mm\""),
    row("around leg-left", "segments.leg-left.from", "[\"0 mm\", \"900 mm\", \"10 mm\"]"),
    row("around leg-left", "segments.leg-left.to", "[\"0 mm\", \"1400 mm\", \"40 mm\"]"),
    row("around leg-left", "segments.leg-left.half_width", "\"65 mm\""),
    row("around leg-left", "segments.leg-left.half_depth", "\"65 mm\""),
    row("around leg-right", "segments.leg-right.from", "[\"0 mm\", \"900 mm\", \"10 mm\"]"),
    row("around leg-right", "segments.leg-right.to", "[\"0 mm\", \"1400 mm\", \"40 mm\"]"),
    row("around leg-right", "segments.leg-right.half_width", "\"65 mm\""),
    row("around leg-right", "segments.leg-right.half_depth", "\"65 mm\""),
];

/// The files with keys of their own.
pub const FILES: &[(&str, &[Flip])] = &[("sewing", SEWING), ("fabric", FABRIC), ("body", BODY)];
