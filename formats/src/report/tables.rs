//! The tables of the report, from whatever the garment holds.

use super::stats::{Spread, areas, spread};
use super::words::Phrase;
use super::{checks, notches};
use toile_garment::flat::{FlatMetric, FlatPiece, StrainMap};
use toile_garment::seam::SeamKind;
use toile_garment::{Diagnostic, Garment, Piece, Severity};

/// One cell.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// Names, and all that stands in no catalogue.
    Text(String),
    /// Words of this program, which are told in the language of the reader.
    Phrases(Vec<Phrase>),
    /// A number with its decimals.
    Number(f64, usize),
    /// A whole number.
    Count(u64),
    /// Good or bad.
    Verdict(bool),
    /// Not known.
    Empty,
}

/// A table with a title, a key for programs and the words that explain it.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Key in the JSON.
    pub key: &'static str,
    /// Title.
    pub title: &'static str,
    /// Remark below the table.
    pub note: String,
    /// Key and heading of each column; units stand in both.
    pub columns: Vec<(&'static str, &'static str)>,
    /// Rows.
    pub rows: Vec<Vec<Cell>>,
}

impl Table {
    pub(super) fn new(
        key: &'static str,
        title: &'static str,
        note: &str,
        columns: &[(&'static str, &'static str)],
    ) -> Self {
        Self { key, title, note: note.to_owned(), columns: columns.to_vec(), rows: Vec::new() }
    }
}

/// All tables that have something to say.
#[must_use]
pub fn tables(garment: &Garment, findings: &[Diagnostic]) -> Vec<Table> {
    all(garment, findings).into_iter().filter(|t| !t.rows.is_empty()).collect()
}

/// All tables, those without a row, too.
pub(super) fn all(garment: &Garment, findings: &[Diagnostic]) -> [Table; 12] {
    [
        self::findings(findings),
        verdicts(garment),
        pieces(garment),
        edges(garment),
        darts(garment),
        seams(garment),
        notches::table(garment),
        strain(garment),
        certificate(garment),
        effects(garment),
        stages(garment),
        inputs(garment),
    ]
}

fn text(t: impl Into<String>) -> Cell {
    Cell::Text(t.into())
}

/// A word of this program.
pub(super) fn word(words: &'static str) -> Cell {
    Cell::Phrases(vec![Phrase::new(words, [])])
}

fn mm(metres: f64) -> Cell {
    Cell::Number(1e3 * metres, 3)
}

fn degrees(radians: f64) -> Cell {
    Cell::Number(radians.to_degrees(), 3)
}

fn percent(share: f64) -> Cell {
    Cell::Number(100.0 * share, 3)
}

fn cm2(area: f64) -> Cell {
    Cell::Number(1e4 * area, 3)
}

fn count(n: usize) -> Cell {
    Cell::Count(n as u64)
}

fn name_of(garment: &Garment, flat: &FlatPiece) -> Cell {
    garment.pieces.get(flat.piece.index()).map_or(Cell::Empty, |p| text(&p.name))
}

fn flat_of<'a>(garment: &'a Garment, piece: &Piece) -> Option<&'a FlatPiece> {
    garment.flat.as_ref()?.pieces.iter().find(|f| f.piece == piece.id)
}

fn findings(findings: &[Diagnostic]) -> Table {
    let mut t = Table::new(
        "findings",
        "Findings",
        "",
        &[("severity", "severity"), ("code", "code"), ("message", "what"), ("place", "where"), ("hint", "remedy")],
    );
    t.rows = findings
        .iter()
        .map(|f| {
            let word = match f.severity {
                Severity::Error => "error",
                Severity::Warning => "warning",
                Severity::Info => "note",
            };
            let place = f.source.as_ref().map_or(Cell::Empty, |s| text(s.to_string()));
            vec![text(word), text(&f.code), text(&f.message), place, f.hint.as_ref().map_or(Cell::Empty, text)]
        })
        .collect();
    t
}

fn pieces(garment: &Garment) -> Table {
    let mut t = Table::new(
        "pieces",
        "Pieces",
        "Areas of cloth inside the sewn line, without the intakes of darts. Grain: turn of the grain line inside the flattened piece. Curvature: what a dart would have to take in.",
        &[
            ("name", "piece"),
            ("triangles", "triangles"),
            ("outline_mm", "outline mm"),
            ("original_cm2", "original cm²"),
            ("flat_cm2", "flat cm²"),
            ("surface_cm2", "worn cm²"),
            ("area_change_pct", "area change %"),
            ("grain_shift_deg", "grain shift °"),
            ("curvature_deg", "curvature °"),
            ("forced_strain_pct", "forced strain %"),
        ],
    );
    for piece in &garment.pieces {
        let triangles = piece.mesh.as_ref().map_or(Cell::Empty, |m| count(m.triangles.len()));
        let mut row = vec![text(&piece.name), triangles, mm(piece.outline.length())];
        match flat_of(garment, piece) {
            Some(f) => {
                row.extend(f.area.map(cm2));
                row.push(if f.area[0] > 0.0 { percent(f.area[1] / f.area[0] - 1.0) } else { Cell::Empty });
                row.extend([degrees(f.grain_shift), degrees(f.curvature), percent(f.forced_strain[1])]);
            }
            None => {
                row.push(cm2(piece.cloth_area()));
                row.extend([Cell::Empty, Cell::Empty, Cell::Empty, Cell::Empty, Cell::Empty, Cell::Empty]);
            }
        }
        t.rows.push(row);
    }
    t
}

fn verdicts(garment: &Garment) -> Table {
    let mut t = Table::new(
        "flat_verdicts",
        "Flattened pieces",
        "One line a piece: what is over its tolerance, and the largest changes of every kind. Sewn edges and notches \
         beside their partner, and the legs of darts, are always judged; all else where a tolerance was given.",
        &[("piece", "piece"), ("passes", "passes"), ("fails", "what fails"), ("changes", "largest changes")],
    );
    for verdict in garment.flat.iter().flat_map(|f| &f.verdicts) {
        let name = garment.pieces.get(verdict.piece.index()).map_or(Cell::Empty, |p| text(&p.name));
        let (changes, fails): (Vec<_>, Vec<_>) = verdict.checks.iter().partition(|c| c.passes());
        let [changes, fails] = [changes, fails].map(|all| all.into_iter().map(checks::phrase).collect::<Vec<_>>());
        let fails = if fails.is_empty() { Cell::Empty } else { Cell::Phrases(fails) };
        t.rows.push(vec![name, Cell::Verdict(verdict.passes()), fails, Cell::Phrases(changes)]);
    }
    t
}

fn edges(garment: &Garment) -> Table {
    let mut t = Table::new(
        "edges",
        "Edges",
        "Lengths between corners along the sewn line; dart legs of marked darts left out.",
        &[
            ("piece", "piece"),
            ("edge", "edge"),
            ("original_mm", "original mm"),
            ("flat_mm", "flat mm"),
            ("change_mm", "change mm"),
            ("surface_mm", "worn mm"),
        ],
    );
    for flat in garment.flat.iter().flat_map(|f| &f.pieces) {
        for e in &flat.edges {
            let name = name_of(garment, flat);
            t.rows.push(vec![name, text(&e.name), mm(e.original), mm(e.flat), mm(e.flat - e.original), mm(e.surface)]);
        }
    }
    t
}

fn darts(garment: &Garment) -> Table {
    let mut t = Table::new(
        "darts",
        "Darts",
        "Angle at the apex, width at the mouth, both legs; first the original, then the flattened piece.",
        &[
            ("piece", "piece"),
            ("dart", "dart"),
            ("angle_original_deg", "angle °"),
            ("angle_flat_deg", "flat °"),
            ("width_original_mm", "width mm"),
            ("width_flat_mm", "flat mm"),
            ("width_change_mm", "change mm"),
            ("leg_a_original_mm", "leg a mm"),
            ("leg_b_original_mm", "leg b mm"),
            ("leg_a_flat_mm", "flat leg a mm"),
            ("leg_b_flat_mm", "flat leg b mm"),
        ],
    );
    for piece in &garment.pieces {
        match flat_of(garment, piece) {
            Some(flat) => t.rows.extend(flat.darts.iter().map(|d| {
                let mut row = vec![text(&piece.name), text(&d.name), degrees(d.angle[0]), degrees(d.angle[1])];
                row.extend([mm(d.width[0]), mm(d.width[1]), mm(d.width[1] - d.width[0])]);
                row.extend(d.legs.map(mm));
                row
            })),
            None => t.rows.extend(piece.darts.iter().map(|d| {
                let mut row = vec![text(&piece.name), text(&d.name), Cell::Empty, Cell::Empty, mm(d.intake())];
                row.extend([
                    Cell::Empty,
                    Cell::Empty,
                    mm(d.leg_length(0)),
                    mm(d.leg_length(1)),
                    Cell::Empty,
                    Cell::Empty,
                ]);
                row
            })),
        }
    }
    t
}

fn seams(garment: &Garment) -> Table {
    let mut t = Table::new(
        "seams",
        "Seams",
        "Both sides of every seam; ease is side a less side b.",
        &[
            ("seam", "seam"),
            ("kind", "kind"),
            ("stitches", "stitches"),
            ("a_original_mm", "a mm"),
            ("b_original_mm", "b mm"),
            ("ease_original_mm", "seam ease mm"),
            ("a_flat_mm", "flat a mm"),
            ("b_flat_mm", "flat b mm"),
            ("ease_flat_mm", "flat ease mm"),
        ],
    );
    let pairs = garment.flat.as_ref().map_or(&[][..], |f| &f.pairs);
    for (k, seam) in garment.seams.iter().enumerate() {
        let kind = if seam.kind == SeamKind::Seam { "seam" } else { "dart" };
        let mut row = vec![text(&seam.name), word(kind), count(seam.stitches.len())];
        match pairs.get(k) {
            Some(p) => {
                row.extend([mm(p.a[0]), mm(p.b[0]), mm(p.a[0] - p.b[0]), mm(p.a[1]), mm(p.b[1]), mm(p.a[1] - p.b[1])]);
            }
            None => {
                row.extend([
                    mm(seam.a.length),
                    mm(seam.b.length),
                    mm(seam.ease),
                    Cell::Empty,
                    Cell::Empty,
                    Cell::Empty,
                ]);
            }
        }
        t.rows.push(row);
    }
    t
}

fn strain(garment: &Garment) -> Table {
    let mut t = Table::new(
        "strain",
        "Strain of the cloth",
        "Worn: from the original piece to the 3D surface, the drape's own strain. Flat: what the flattened piece must do to reach the surface. Weighted by area.",
        &[
            ("piece", "piece"),
            ("from", "from"),
            ("direction", "direction"),
            ("min", "smallest"),
            ("p5", "5 %"),
            ("mean", "mean"),
            ("p95", "95 %"),
            ("max", "largest"),
            ("unit", "unit"),
        ],
    );
    for flat in garment.flat.iter().flat_map(|f| &f.pieces) {
        let area = areas(garment, flat);
        for (from, map) in [("original", &flat.drape_strain), ("flat", &flat.flat_strain)] {
            for (direction, spread, unit, factor) in directions(map, &area) {
                let mut row = vec![name_of(garment, flat), word(from), word(direction)];
                row.extend(
                    [spread.min, spread.p5, spread.mean, spread.p95, spread.max].map(|x| Cell::Number(x * factor, 3)),
                );
                row.push(text(unit));
                t.rows.push(row);
            }
        }
    }
    t
}

fn directions(map: &StrainMap, area: &[f64]) -> Vec<(&'static str, Spread, &'static str, f64)> {
    let degrees = 180.0 / std::f64::consts::PI;
    [("warp", &map.warp, "%", 100.0), ("weft", &map.weft, "%", 100.0), ("shear", &map.shear, "°", degrees)]
        .into_iter()
        .filter_map(|(name, values, unit, factor)| spread(values, area).map(|s| (name, s, unit, factor)))
        .collect()
}

fn certificate(garment: &Garment) -> Table {
    let mut t = Table::new(
        "certificate",
        "Certificate of the drape",
        "",
        &[("figure", ""), ("meaning", "figure"), ("value", "value"), ("limit", "limit"), ("unit", "unit")],
    );
    let Some(c) = &garment.certificate else { return t };
    let limit = |name: &str, factor: f64| c.limits.get(name).map_or(Cell::Empty, |l| Cell::Number(l * factor, 4));
    let mut row = |[name, meaning, unit]: [&'static str; 3], value: Cell, limit: Cell| {
        t.rows.push(vec![text(name), word(meaning), value, limit, word(unit)]);
    };
    row(["passed", "passed", ""], Cell::Verdict(c.passed), Cell::Empty);
    row(["settled", "at rest", ""], Cell::Verdict(c.settled), Cell::Empty);
    let crossings = |n: u64| Cell::Count(n);
    let mm = |x: f64| Cell::Number(x, 4);
    let figures = [
        (
            ["residual_rel", "force that is left on a particle", "particle weights"],
            Cell::Number(c.residual_rel, 7),
            1.0,
        ),
        (["energy_J", "energy of the cloth", "J"], Cell::Number(c.energy_j, 6), 1.0),
        (["strain_p95", "strain that 95 % of the cloth stay below", "%"], percent(c.strain_p95), 100.0),
        (["strain_max", "largest strain of the threads", "%"], percent(c.strain_max), 100.0),
        (
            ["strain_over_limit", "largest strain beside the limit of its fabric", "of the limit"],
            Cell::Number(c.strain_over_limit, 4),
            1.0,
        ),
        (["slip_mm", "how far the garment slid down", "mm"], Cell::Number(c.slip_mm, 1), 1.0),
        (["seam_gap_max_mm", "widest gap of a seam", "mm"], mm(c.seam_gap_max_mm), 1.0),
        (["dart_gap_max_mm", "widest gap of a dart", "mm"], mm(c.dart_gap_max_mm), 1.0),
        (["self_crossings", "crossings of the cloth with itself", ""], crossings(c.self_crossings), 1.0),
        (["body_crossings", "crossings of cloth and body", ""], crossings(c.body_crossings), 1.0),
        (["penetration_max_mm", "depth of the cloth in the body", "mm"], mm(c.penetration_max_mm), 1.0),
    ];
    for (words, value, factor) in figures {
        row(words, value, limit(words[0], factor));
    }
    t
}

fn effects(garment: &Garment) -> Table {
    let mut t = Table::new(
        "effects",
        "Effects",
        "What was simulated, by which rule and on what evidence.",
        &[("name", "effect"), ("on", "on"), ("rule", "rule"), ("evidence", "evidence")],
    );
    let on = |on: bool| word(if on { "on" } else { "off" });
    t.rows = garment.effects.iter().map(|e| vec![text(&e.name), on(e.on), text(&e.rule), text(&e.evidence)]).collect();
    t
}

fn stages(garment: &Garment) -> Table {
    let mut t = Table::new(
        "stages",
        "How it was made",
        "",
        &[("stage", "stage"), ("id", "id"), ("revision", "revision"), ("params", "parameters")],
    );
    let p = &garment.provenance;
    t.note = match (p.toile.as_str(), p.pipeline.as_str()) {
        ("", _) => String::new(),
        (version, line) => format!("toile {version}, pipeline {line}, seed {}", p.seed),
    };
    t.rows = p
        .stages
        .iter()
        .map(|s| vec![text(&s.stage), text(&s.id), Cell::Count(u64::from(s.revision)), text(s.params.to_string())])
        .collect();
    t
}

fn inputs(garment: &Garment) -> Table {
    let mut t = Table::new("inputs", "Inputs", "", &[("path", "file"), ("blake3", "blake3")]);
    t.rows = garment.provenance.inputs.iter().map(|i| vec![text(&i.path), text(&i.blake3)]).collect();
    t
}

/// In words, which lengths the flat pieces were asked to have.
pub(super) fn metric_words(metric: FlatMetric) -> &'static str {
    match metric {
        FlatMetric::Unedited => {
            "The drape was not edited. Its strain is elastic and stays in the cloth, so the flattened pieces are the \
             stored ones by construction; this proves nothing about the flattening."
        }
        FlatMetric::Carried => {
            "The 3D shape was edited after the drape. The stored lengths were changed by what the edit changed; the \
             strain of the drape before it stays in the cloth."
        }
        FlatMetric::Surface => {
            "Nothing is known of the strain of the cloth, so the flattened pieces have the lengths of the 3D surface \
             as it is worn."
        }
    }
}
