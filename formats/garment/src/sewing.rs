//! The declarations of the sewing file: facts of the style that a DXF cannot hold.

use crate::dart::DartKind;
use crate::source::SourceRef;
use crate::{Vec2, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A run of outline edges of one piece, or a line inside it, as written in the sewing file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RunSpec {
    /// An outline edge by its name or number: `"front.side-left"`, `"front.3"`.
    Edge {
        /// Piece name.
        piece: String,
        /// Edge name, or its number in decimal.
        edge: String,
    },
    /// A part of an outline edge, between two places on it.
    Part {
        /// Piece name.
        piece: String,
        /// Edge name, or its number in decimal.
        edge: String,
        /// One end of the part.
        from: EdgePlace,
        /// The other end.
        to: EdgePlace,
    },
    /// Two points in piece coordinates, snapped to the nearest corner or vertex within 1 mm.
    Points {
        /// Piece name.
        piece: String,
        /// Start, metres.
        #[schemars(with = "[f64; 2]")]
        from: Vec2,
        /// End, metres.
        #[schemars(with = "[f64; 2]")]
        to: Vec2,
        /// Which way along the outline.
        way: RunWay,
    },
    /// A line inside the piece, to which another piece is sewn: the place of a pocket, of a band, of a button.
    Line {
        /// Piece name.
        piece: String,
        /// Points of the line in sewing order, metres.
        #[schemars(with = "Vec<[f64; 2]>")]
        line: Vec<Vec2>,
    },
}

impl RunSpec {
    /// Name of the piece.
    #[must_use]
    pub fn piece(&self) -> &str {
        match self {
            Self::Edge { piece, .. }
            | Self::Part { piece, .. }
            | Self::Points { piece, .. }
            | Self::Line { piece, .. } => piece,
        }
    }

    /// Name of the piece, to be changed.
    pub fn piece_mut(&mut self) -> &mut String {
        match self {
            Self::Edge { piece, .. }
            | Self::Part { piece, .. }
            | Self::Points { piece, .. }
            | Self::Line { piece, .. } => piece,
        }
    }
}

/// A place on an outline edge. An edge starts where a walk round the outline, with the cloth on the left, comes to it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct EdgePlace {
    /// The way from the start of the edge.
    pub way: EdgeWay,
    /// True where the way is counted from the end of the edge.
    #[serde(default)]
    pub from_end: bool,
}

/// A way along an outline edge.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum EdgeWay {
    /// A share of its length, from 0 to 1.
    Share(f64),
    /// A length, metres.
    Length(f64),
    /// Up to its n-th notch, counted from 1.
    Notch(u32),
}

impl EdgePlace {
    /// The same place on the mirrored edge, which is walked the other way.
    #[must_use]
    pub fn mirrored(self) -> Self {
        Self { from_end: !self.from_end, ..self }
    }
}

/// Which way along the outline a run of two points goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RunWay {
    /// The shorter way (the default).
    #[default]
    Short,
    /// The longer way.
    Long,
    /// Counter-clockwise: the cloth lies to the left of the walk.
    Left,
    /// Clockwise: the cloth lies to the right of the walk.
    Right,
}

/// A declared seam.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SeamSpec {
    /// Name; `seam-<n>` when the file gives none.
    pub name: String,
    /// Side a: runs in order.
    pub a: Vec<RunSpec>,
    /// Side b: runs in order.
    pub b: Vec<RunSpec>,
    /// Does the file state the direction of b against a? Two-point runs state it; edges by name or number do not,
    /// unless `reverse` is given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reverse: Option<bool>,
    /// Declared ease, metres: length a minus length b, so over 0 where `a` is longer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ease: Option<f64>,
    /// Declared gather ratio, longer over shorter.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gather: Option<f64>,
    /// Confidence from 0 to 1 of a seam that the program proposed and nobody confirmed yet.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub proposed: Option<f64>,
    /// Origin.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<SourceRef>,
}

/// A declared dart or pleat; `kind = None` says that the wedge found there is no dart.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DartSpec {
    /// Piece name.
    pub piece: String,
    /// Dart name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Apexes, metres (two for a fish-eye).
    #[schemars(with = "Vec<[f64; 2]>")]
    pub apexes: Vec<Vec2>,
    /// Mouth points, metres.
    #[schemars(with = "[[f64; 2]; 2]")]
    pub mouth: [Vec2; 2],
    /// Kind, or `None` for "this wedge is not a dart".
    pub kind: Option<DartKind>,
    /// How a pleat is pressed, if it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub press: Option<PleatPress>,
    /// How far from the mouth a pleat is sewn down, metres; the whole of its lines where nothing is said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sewn: Option<f64>,
    /// Origin.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<SourceRef>,
}

/// How a pleat is pressed: where its folds lie between its two lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PleatPress {
    /// Folded outwards along the line of the first mouth point, and back along the middle.
    Knife,
    /// Both lines meet on the right side; the depth lies behind, folded back half-way from each line to the middle.
    Inverted,
    /// Both lines meet on the wrong side; the depth lies in front.
    Box,
}

/// A fold that is pressed into a piece along a line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FoldSpec {
    /// Piece name.
    pub piece: String,
    /// Name; `fold-<n>` when the file gives none.
    pub name: String,
    /// Points of the line, metres.
    #[schemars(with = "Vec<[f64; 2]>")]
    pub line: Vec<Vec2>,
    /// Angle by which the cloth is folded back from flat, radians, over 0 where the right side is outside.
    pub angle: f64,
    /// Origin.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<SourceRef>,
}

/// Length of an unstretched band.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum BandLength {
    /// A length, metres.
    Length(f64),
    /// A share of the cloth that it is sewn to.
    Share(f64),
}

/// Tension of a band at twice its length where nothing is said, N: elastic 20 to 30 mm wide, as waists have.
pub const BAND_STRETCH: f64 = 30.0;

/// An elastic band that is sewn along edges.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ElasticSpec {
    /// Name; `elastic-<n>` when the file gives none.
    pub name: String,
    /// Runs of outline edges in order.
    pub along: Vec<RunSpec>,
    /// Its length before it is stretched.
    pub length: BandLength,
    /// Tension per strain, N.
    pub stretch: f64,
    /// Origin.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<SourceRef>,
}

/// Where a piece starts in 3D.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Placement {
    /// `world = rotation · [x, y, 0] + translation`, right side outwards (along rotation · z).
    Explicit {
        /// Rows of a rotation matrix.
        rotation: [[f64; 3]; 3],
        /// Translation, metres.
        #[schemars(with = "[f64; 3]")]
        translation: Vec3,
    },
    /// Beside the place that the program finds.
    Moved {
        /// Way from that place, metres: to the wearer's left, up, to the front.
        #[schemars(with = "[f64; 3]")]
        by: Vec3,
    },
    /// Wrapped around a segment of the body.
    Around(Around),
}

/// A place around a segment of the body.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Around {
    /// `torso`, `arm-left`, `arm-right`, `leg-left`, `leg-right`, `neck`.
    pub segment: String,
    /// `front`, `back`, `left`, `right`: where the middle of the piece sits.
    pub side: String,
    /// Height of the piece's top edge above the floor (torso, legs) or distance of its top from the joint (arms), metres.
    pub height: f64,
    /// Turn in the piece plane before placing, radians, counter-clockwise.
    pub turn: f64,
    /// Way of the middle of the piece from there along the girth, metres, to the right of the piece as it is drawn.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub shift: f64,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde calls it with a reference")]
fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

/// A declared placement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PlaceSpec {
    /// Piece name.
    pub piece: String,
    /// Where.
    pub placement: Placement,
    /// Parts of the body that the piece does not meet while it is sewn; `None` where the program is to decide.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ignores: Option<Vec<String>>,
    /// Origin.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<SourceRef>,
}

/// Layer order of pieces, inner to outer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LayerSpec {
    /// Piece names.
    pub pieces: Vec<String>,
    /// Order: 0 is the default, smaller lies nearer to the body. Only the order of the numbers counts.
    pub order: i32,
    /// Origin, for findings while the file is read.
    #[serde(skip)]
    pub source: Option<SourceRef>,
}

/// Interlining that is fused or sewn to whole pieces.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct InterliningSpec {
    /// Piece names.
    pub pieces: Vec<String>,
    /// Its areal mass, kg/m².
    pub areal_mass: f64,
    /// Its bending rigidity in every direction, N·m.
    pub bending: f64,
    /// Origin.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<SourceRef>,
}

/// A piece that was cut apart, and whose parts are pieces now.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WholeSpec {
    /// Name of the whole piece.
    pub name: String,
    /// Names of its parts.
    pub pieces: Vec<String>,
    /// Origin.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<SourceRef>,
}

/// How strongly an edge is held.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum AttachStrength {
    /// Held at the place it has after sewing.
    Hold,
    /// Held there until the garment is sewn.
    WhileSewing,
    /// Held there until the garment is sewn, and then by an elastic band of this share of the body's girth.
    Elastic(f64),
}

/// An edge that is tied to the body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AttachSpec {
    /// Piece name.
    pub piece: String,
    /// Edge name or number.
    pub edge: String,
    /// Landmark or girth of the body, e.g. `waist`.
    pub to: String,
    /// How.
    pub strength: AttachStrength,
    /// Origin.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<SourceRef>,
}

/// A second copy of a drawn piece, e.g. the right sleeve of a left one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CopySpec {
    /// Name of the drawn piece.
    pub piece: String,
    /// Name of the copy.
    pub name: String,
    /// Mirrored (x → −x in the piece plane)?
    pub mirror: bool,
    /// Origin.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<SourceRef>,
}

/// A name for an outline edge, given by number or two points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct EdgeNameSpec {
    /// The edge.
    pub run: RunSpec,
    /// Its name.
    pub name: String,
    /// Origin, for findings while the file is read.
    #[serde(skip)]
    pub source: Option<SourceRef>,
}

/// Everything the sewing file says.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SewingPlan {
    /// Seams.
    #[serde(default)]
    pub seams: Vec<SeamSpec>,
    /// Darts and pleats, declared or denied.
    #[serde(default)]
    pub darts: Vec<DartSpec>,
    /// Placements.
    #[serde(default)]
    pub places: Vec<PlaceSpec>,
    /// Layers.
    #[serde(default)]
    pub layers: Vec<LayerSpec>,
    /// Attachments.
    #[serde(default)]
    pub attachments: Vec<AttachSpec>,
    /// Copies of drawn pieces.
    #[serde(default)]
    pub copies: Vec<CopySpec>,
    /// Names of edges.
    #[serde(default)]
    pub edge_names: Vec<EdgeNameSpec>,
    /// Elastic bands.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub elastics: Vec<ElasticSpec>,
    /// Pressed folds.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub folds: Vec<FoldSpec>,
    /// Interlinings.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub interlinings: Vec<InterliningSpec>,
    /// Pieces that were cut apart.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub wholes: Vec<WholeSpec>,
    /// Pieces of the DXF that are not part of this garment (linings, fusings).
    #[serde(default)]
    pub leave_out: Vec<String>,
    /// Origin of `leave_out`, for findings while the file is read.
    #[serde(skip)]
    pub leave_out_source: Option<SourceRef>,
}

impl SewingPlan {
    /// The lines inside a piece to which other pieces or elastic bands are sewn, each once, in the order of the file.
    #[must_use]
    pub fn seam_lines(&self, piece: &str) -> Vec<&[Vec2]> {
        let sides = self.seams.iter().flat_map(|s| s.a.iter().chain(&s.b));
        let bands = self.elastics.iter().flat_map(|e| &e.along);
        let runs = sides.chain(bands).chain(self.edge_names.iter().map(|n| &n.run));
        let mut lines: Vec<&[Vec2]> = Vec::new();
        for run in runs.filter(|r| r.piece().eq_ignore_ascii_case(piece)) {
            if let RunSpec::Line { line, .. } = run
                && !lines.contains(&line.as_slice())
            {
                lines.push(line);
            }
        }
        lines
    }

    /// Adds what another plan says; its places win over those of the same piece here.
    pub fn extend(&mut self, more: Self) {
        let Self {
            seams,
            darts,
            places,
            layers,
            attachments,
            copies,
            edge_names,
            elastics,
            folds,
            interlinings,
            wholes,
            leave_out,
            leave_out_source,
        } = more;
        self.seams.extend(seams);
        self.darts.extend(darts);
        self.places.retain(|p| !places.iter().any(|m| m.piece.eq_ignore_ascii_case(&p.piece)));
        self.places.extend(places);
        self.layers.extend(layers);
        self.attachments.extend(attachments);
        self.copies.extend(copies);
        self.edge_names.extend(edge_names);
        self.elastics.extend(elastics);
        self.folds.extend(folds);
        self.interlinings.extend(interlinings);
        self.wholes.extend(wholes);
        self.leave_out.extend(leave_out);
        self.leave_out_source = leave_out_source.or(self.leave_out_source.take());
    }
}
