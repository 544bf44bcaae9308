//! Which program wrote a file, told by its texts and habits, with the reasons.
//!
//! Only a few habits change how a file is read ([`Profile::notch_scale`]); the rest is for people, who can overrule it.

use super::layers::{Layers, Role};
use super::model::{Drawing, Entity, Shape};
use std::collections::BTreeMap;

/// A pattern system.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Vendor {
    /// Gerber AccuMark.
    Gerber,
    /// CLO and Marvelous Designer.
    Clo,
    /// Browzwear VStitcher and Lotta.
    Browzwear,
    /// Richpeace.
    Richpeace,
    /// Optitex PDS.
    Optitex,
    /// Lectra Modaris.
    Lectra,
    /// Valentina.
    Valentina,
    /// Seamly2D.
    Seamly,
    /// PolyPattern.
    PolyPattern,
    /// Grafis.
    Grafis,
    /// Assyst.
    Assyst,
    /// `TUKAcad`.
    Tuka,
    /// This program.
    Toile,
    /// A drawing program, not a pattern system.
    Plain,
    /// None of these.
    Unknown,
}

/// Names as they stand in reports and parameters.
const NAMES: [(Vendor, &str); 15] = [
    (Vendor::Gerber, "gerber"),
    (Vendor::Clo, "clo"),
    (Vendor::Browzwear, "browzwear"),
    (Vendor::Richpeace, "richpeace"),
    (Vendor::Optitex, "optitex"),
    (Vendor::Lectra, "lectra"),
    (Vendor::Valentina, "valentina"),
    (Vendor::Seamly, "seamly"),
    (Vendor::PolyPattern, "polypattern"),
    (Vendor::Grafis, "grafis"),
    (Vendor::Assyst, "assyst"),
    (Vendor::Tuka, "tuka"),
    (Vendor::Toile, "toile"),
    (Vendor::Plain, "plain"),
    (Vendor::Unknown, "unknown"),
];

/// Words of style texts and comments, each the name or a product of its vendor.
const WORDS: [(&str, Vendor); 25] = [
    ("accumark", Vendor::Gerber),
    ("gerber", Vendor::Gerber),
    ("clo", Vendor::Clo),
    ("clo3d", Vendor::Clo),
    ("marvelous", Vendor::Clo),
    ("browzwear", Vendor::Browzwear),
    ("vstitcher", Vendor::Browzwear),
    ("v-stitcher", Vendor::Browzwear),
    ("richpeace", Vendor::Richpeace),
    ("optitex", Vendor::Optitex),
    ("pds", Vendor::Optitex),
    ("lectra", Vendor::Lectra),
    ("modaris", Vendor::Lectra),
    ("diamino", Vendor::Lectra),
    ("valentina", Vendor::Valentina),
    ("seamly", Vendor::Seamly),
    ("seamly2d", Vendor::Seamly),
    ("seamlyme", Vendor::Seamly),
    ("polypattern", Vendor::PolyPattern),
    ("grafis", Vendor::Grafis),
    ("assyst", Vendor::Assyst),
    ("tukacad", Vendor::Tuka),
    ("tukatech", Vendor::Tuka),
    ("toile", Vendor::Toile),
    ("freesewing", Vendor::Plain),
];

/// Least weight of evidence for a verdict, and least lead over the next.
const ENOUGH: u32 = 5;
const LEAD: u32 = 2;

impl Vendor {
    /// Name in reports and parameters.
    #[must_use]
    pub fn name(self) -> &'static str {
        NAMES.iter().find(|n| n.0 == self).map_or("unknown", |n| n.1)
    }

    /// By its name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        NAMES.iter().find(|n| n.1.eq_ignore_ascii_case(name.trim())).map(|n| n.0)
    }

    /// All names.
    #[must_use]
    pub fn names() -> Vec<&'static str> {
        NAMES.iter().map(|n| n.1).collect()
    }
}

/// The writer of a file and why it is thought to be it.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// Writer.
    pub vendor: Vendor,
    /// Share of its evidence in all evidence, 0 to 1; 1 only when the user says so.
    pub confidence: f64,
    /// Evidence for it.
    pub reasons: Vec<String>,
    /// Evidence for others.
    pub others: Vec<(Vendor, Vec<String>)>,
    /// `ASTM`, `AAMA` or `plain`, and why.
    pub standard: (&'static str, String),
    /// Readings that differ because of it.
    pub effects: Vec<String>,
    /// Depths and widths of notches times this.
    pub notch_scale: f64,
}

#[derive(Default)]
struct Evidence(BTreeMap<Vendor, (u32, Vec<String>)>);

impl Evidence {
    fn add(&mut self, vendor: Vendor, weight: u32, reason: impl Into<String>) {
        let entry = self.0.entry(vendor).or_default();
        entry.0 = entry.0.saturating_add(weight);
        entry.1.push(reason.into());
    }
}

/// Everything of the drawing that the tests look at.
struct Traits<'a> {
    drawing: &'a Drawing,
    layers: &'a Layers,
}

/// Looks at a drawing. `asked` overrules the evidence.
pub(crate) fn detect(
    drawing: &Drawing,
    layers: &Layers,
    style: &BTreeMap<String, String>,
    asked: Option<Vendor>,
) -> Profile {
    let traits = Traits { drawing, layers };
    let mut evidence = Evidence::default();
    words(drawing, style, &mut evidence);
    traits.texts(&mut evidence);
    traits.names(&mut evidence);
    traits.lines(&mut evidence);
    traits.notches(&mut evidence);
    traits.file(&mut evidence);
    let mut ranked: Vec<(Vendor, (u32, Vec<String>))> = evidence.0.into_iter().collect();
    ranked.sort_by(|a, b| b.1.0.cmp(&a.1.0).then(a.0.cmp(&b.0)));
    let total: u32 = ranked.iter().map(|r| r.1.0).sum();
    let best = ranked.first().map_or(0, |r| r.1.0);
    let next = ranked.get(1).map_or(0, |r| r.1.0);
    let found = best >= ENOUGH && best >= next.saturating_add(LEAD);
    let vendor = asked.unwrap_or_else(|| if found { ranked[0].0 } else { Vendor::Unknown });
    let mut reasons = Vec::new();
    let mut weight = 0;
    ranked.retain(|(v, (w, list))| {
        if *v == vendor {
            reasons.clone_from(list);
            weight = *w;
        }
        *v != vendor
    });
    if asked.is_some() {
        reasons.insert(0, "set by the user".into());
    } else if vendor == Vendor::Unknown {
        reasons.push("no writer shows enough of its habits".into());
    }
    let confidence = match (asked, total) {
        (Some(_), _) => 1.0,
        (None, 0) => 0.0,
        // One weak habit alone is no certainty.
        (None, total) => f64::from(weight) / (f64::from(total) + 3.0),
    };
    let mut profile = Profile {
        vendor,
        confidence,
        reasons,
        others: ranked.into_iter().map(|(v, (_, list))| (v, list)).collect(),
        standard: traits.standard(),
        effects: Vec::new(),
        notch_scale: 1.0,
    };
    traits.effects(&mut profile);
    profile
}

fn words(drawing: &Drawing, style: &BTreeMap<String, String>, evidence: &mut Evidence) {
    // The style name is the designer's: `CLO-TEST` is no CLO file.
    let texts = style.iter().filter(|(k, _)| *k != "style name").map(|(k, v)| format!("{k}: {v}"));
    for text in texts.chain(drawing.comments.iter().map(|c| format!("comment: {c}"))) {
        let lower = text.to_lowercase();
        let mut parts = lower.split(|c: char| !(c.is_alphanumeric() || c == '-')).collect::<Vec<_>>();
        parts.sort_unstable();
        for (word, vendor) in WORDS {
            if parts.binary_search(&word).is_ok() {
                evidence.add(vendor, 10, format!("`{text}` names it"));
            }
        }
        if lower.contains("dxfrw") {
            let reason = "the comment names the library dxfrw, which it writes with";
            evidence.add(Vendor::Valentina, 4, reason);
            evidence.add(Vendor::Seamly, 3, reason);
        }
    }
}

fn share(part: usize, whole: usize) -> f64 {
    if whole == 0 { 0.0 } else { part as f64 / whole as f64 }
}

impl<'a> Traits<'a> {
    fn entities(&self) -> impl Iterator<Item = &'a Entity> {
        self.drawing.blocks.iter().flat_map(|b| &b.entities).chain(&self.drawing.entities)
    }

    fn in_blocks(&self) -> impl Iterator<Item = &'a Entity> {
        self.drawing.blocks.iter().flat_map(|b| &b.entities)
    }

    fn texts(&self, evidence: &mut Evidence) {
        let (mut all, mut keyed, mut small, mut tight, mut upper, mut empty) = (0, 0, 0, 0, 0, 0);
        for entity in self.entities() {
            let Shape::Text { value, height, .. } = &entity.shape else { continue };
            all += 1;
            empty += usize::from(value.is_empty());
            small += usize::from(height.is_some_and(|h| (h - 0.25).abs() < 1e-9));
            if let Some((key, rest)) = value.split_once(':').filter(|(k, r)| k.len() > 3 && !r.is_empty()) {
                keyed += 1;
                tight += usize::from(!rest.starts_with(' '));
                upper += usize::from(!key.chars().any(char::is_lowercase));
            }
        }
        if all >= 4 && share(small, all) > 0.8 && self.drawing.header_variables == 0 {
            evidence.add(Vendor::Gerber, 5, "texts are 0.25 units high and the HEADER is empty");
        }
        if keyed >= 3 && share(tight, keyed) > 0.8 {
            evidence.add(Vendor::Richpeace, 4, "there is no blank after the colon of `Key:value`");
        }
        if keyed >= 3 && share(upper, keyed) > 0.9 {
            evidence.add(Vendor::Clo, 2, "all keys are in capitals");
        }
        if empty >= 3 {
            evidence.add(Vendor::Browzwear, 2, format!("{empty} TEXTs hold no text"));
        }
    }

    fn names(&self, evidence: &mut Evidence) {
        let pieces: Vec<&str> =
            self.drawing.blocks.iter().map(|b| b.name.trim()).filter(|n| !n.starts_with(['$', '*'])).collect();
        let count = |test: &dyn Fn(&str) -> bool| pieces.iter().filter(|n| test(n)).count();
        let digits = |s: &str| !s.is_empty() && s.bytes().all(|b| b.is_ascii_digit());
        let machine = |n: &str| n.split('_').any(digits) && n.to_lowercase().starts_with("pattern");
        if count(&machine) > 0 {
            evidence.add(Vendor::Clo, 4, "blocks are called `Pattern…_<number>`");
        }
        if pieces.len() >= 2 && count(&digits) == pieces.len() {
            evidence.add(Vendor::Optitex, 5, "all block names are bare numbers");
        }
        // Size and running number: `BACK_M1`, `BACK_L2`.
        let counted = |n: &str| {
            n.rsplit_once('_').is_some_and(|(_, tail)| {
                let letters = tail.trim_end_matches(|c: char| c.is_ascii_digit());
                letters.len() < tail.len() && !letters.is_empty() && letters.bytes().all(|b| b"SMLX".contains(&b))
            })
        };
        if pieces.len() >= 2 && share(count(&counted), pieces.len()) > 0.8 {
            evidence.add(Vendor::Richpeace, 3, "block names end in size and running number");
        }
        if self.drawing.blocks.iter().any(|b| b.name.eq_ignore_ascii_case("$MODEL_SPACE")) {
            evidence.add(Vendor::Valentina, 3, "there is a block `$MODEL_SPACE`");
            evidence.add(Vendor::Seamly, 3, "there is a block `$MODEL_SPACE`");
        }
        let slashes = count(&|n| n.contains('/'));
        if slashes > 0 {
            evidence.add(Vendor::Valentina, 1, format!("{slashes} block name(s) hold a slash"));
        }
    }

    fn lines(&self, evidence: &mut Evidence) {
        let (mut grouped, mut open, mut repeated) = (0, 0, 0);
        let (mut outlines, mut blocks, mut split) = (0, 0, 0);
        for block in &self.drawing.blocks {
            let mut runs = 0;
            for entity in &block.entities {
                let Shape::Polyline { vertices, closed, .. } = &entity.shape else { continue };
                grouped += usize::from(entity.other.iter().any(|(code, _)| *code == 250));
                if self.layers.role(&entity.layer) != Role::Boundary {
                    continue;
                }
                outlines += 1;
                runs += 1;
                let again = vertices.len() > 3
                    && vertices.first().zip(vertices.last()).is_some_and(|(a, b)| (a.at - b.at).norm() < 1e-6);
                open += usize::from(!closed && !again);
                repeated += usize::from(!closed && again);
            }
            blocks += usize::from(runs > 0);
            split += usize::from(runs > 1);
        }
        if grouped > 0 {
            evidence.add(Vendor::Clo, 8, format!("{grouped} POLYLINEs carry group code 250"));
        }
        if share(split, blocks) > 0.7 && share(open, outlines) > 0.7 {
            evidence.add(Vendor::Gerber, 3, "outlines are split into open runs between turn points");
        }
        if blocks > 0 && repeated == outlines && split == 0 {
            evidence.add(Vendor::PolyPattern, 5, "outlines repeat their first vertex and have no closed flag");
        }
    }

    fn notches(&self, evidence: &mut Evidence) {
        let (mut raised, mut strokes, mut teeth, mut ends) = (0, 0, 0, 0);
        for entity in self.in_blocks() {
            let role = self.layers.role(&entity.layer);
            let Role::Notch(kind) = role else {
                ends += usize::from(matches!(role, Role::Drill | Role::Mirror));
                continue;
            };
            raised += usize::from(entity.other.iter().any(|(code, _)| *code == 38));
            strokes += usize::from(matches!(entity.shape, Shape::Line(_)));
            teeth += usize::from(kind == Some(toile_garment::notch::NotchKind::T));
        }
        if raised > 0 {
            evidence.add(Vendor::Browzwear, 7, format!("{raised} notches repeat their depth as code 38"));
        }
        if strokes > 0 {
            evidence.add(Vendor::Seamly, 2, format!("notches are drawn with {strokes} LINEs"));
            evidence.add(Vendor::Valentina, 2, format!("notches are drawn with {strokes} LINEs"));
        }
        if strokes > 0 && ends > 0 {
            evidence.add(Vendor::Valentina, 2, "there are drill holes or fold lines, which Seamly2D does not write");
        }
        let newer = self
            .in_blocks()
            .any(|e| matches!(self.layers.role(&e.layer), Role::Sew | Role::DenseBoundary | Role::Notch(Some(_))));
        if newer && evidence.0.contains_key(&Vendor::Seamly) {
            evidence.add(Vendor::Valentina, 2, "layers 14 and above are in use, which Seamly2D does not write");
        }
        if teeth > 0 {
            evidence.add(Vendor::Richpeace, 1, format!("{teeth} T notches"));
        }
    }

    fn file(&self, evidence: &mut Evidence) {
        let release = self.drawing.release.as_deref().map(str::trim);
        if release == Some("AC1006") {
            evidence.add(Vendor::Clo, 3, "the release is AC1006");
        }
        let known = self.in_blocks().any(|e| self.layers.role(&e.layer) == Role::Boundary);
        if !known && !self.drawing.entities.is_empty() {
            evidence.add(Vendor::Plain, 6, "no block has a line on layer 1");
        }
    }

    fn standard(&self) -> (&'static str, String) {
        let texts = || {
            self.drawing.entities.iter().filter_map(|e| match &e.shape {
                Shape::Text { value, .. } => Some(value.as_str()),
                _ => None,
            })
        };
        for text in texts() {
            let upper = text.to_uppercase();
            if upper.contains("ASTM") || upper.contains("D13 PROPOSAL") || upper.contains("D13PROPOSAL") {
                return ("ASTM", format!("the style text `{text}`"));
            }
            if upper.contains("AAMA") {
                return ("AAMA", format!("the style text `{text}`"));
            }
        }
        let newer = self.in_blocks().find(|e| {
            matches!(
                self.layers.role(&e.layer),
                Role::DenseBoundary | Role::DenseSew | Role::DenseOther | Role::Notch(Some(_))
            )
        });
        if let Some(entity) = newer {
            return ("ASTM", format!("layer {} is in use", entity.layer));
        }
        if self.in_blocks().any(|e| self.layers.role(&e.layer) == Role::Boundary) {
            return ("AAMA", "layer 1 is in use and none of the layers 80 to 87".into());
        }
        ("plain", "no block has a line on layer 1".into())
    }

    /// Browzwear writes the depth of notches in centimetres.
    fn effects(&self, profile: &mut Profile) {
        if profile.vendor != Vendor::Browzwear {
            return;
        }
        let depths: Vec<f64> = self
            .in_blocks()
            .filter(|e| matches!(self.layers.role(&e.layer), Role::Notch(_)))
            .filter_map(|e| if let Shape::Point { depth, .. } = e.shape { depth.map(f64::abs) } else { None })
            .filter(|d| *d > 0.0)
            .collect();
        if !depths.is_empty() && depths.iter().all(|d| *d < 1.5) {
            profile.notch_scale = 10.0;
            profile.effects.push("depths and widths of notches were read as centimetres".into());
        }
    }
}
