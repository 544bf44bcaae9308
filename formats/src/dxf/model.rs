//! The faithful model: what the file holds, before any pattern meaning. Numbers are in file units.

use super::library::Census;
use crate::encoding::TextEncoding;
use toile_garment::Vec2;

/// A whole file.
#[derive(Clone, Debug)]
pub struct Drawing {
    /// `$ACADVER`, e.g. `AC1009`.
    pub release: Option<String>,
    /// `$INSUNITS`.
    pub insunits: Option<i64>,
    /// Code page of its text.
    pub encoding: TextEncoding,
    /// Blocks in file order; names may repeat.
    pub blocks: Vec<Block>,
    /// Entities of the section ENTITIES.
    pub entities: Vec<Entity>,
    /// Number of entities, numbered from 0 in file order over blocks and ENTITIES.
    pub entity_count: u32,
    /// The first comments (999).
    pub comments: Vec<String>,
    /// Number of header variables.
    pub header_variables: usize,
    /// Is there a section TABLES?
    pub tables: bool,
    /// Number of vertices of all polylines.
    pub vertex_count: u64,
    /// How many curves the library read.
    pub census: Census,
}

/// A block: one piece in one size.
#[derive(Clone, Debug)]
pub struct Block {
    /// Name as decoded.
    pub name: String,
    /// Base point.
    pub base: Vec2,
    /// Line of `BLOCK`.
    pub line: u64,
    /// Line of what ends it.
    pub end: u64,
    /// Entities of the block.
    pub entities: Vec<Entity>,
}

impl Block {
    /// Does a line of the file stand in this block?
    #[must_use]
    pub fn holds(&self, line: u64) -> bool {
        (self.line..=self.end).contains(&line)
    }
}

/// An entity with its place.
#[derive(Clone, Debug)]
pub struct Entity {
    /// Number in file order.
    pub id: u32,
    /// Layer, trimmed.
    pub layer: String,
    /// Line of its group code 0.
    pub line: u64,
    /// Kind and geometry.
    pub shape: Shape,
    /// Codes this reader has no use for, kept with their text.
    pub other: Vec<(i32, String)>,
}

/// A polyline vertex; `bulge` bends the segment that follows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Position.
    pub at: Vec2,
    /// Tangent of a quarter of the arc's angle, counter-clockwise positive.
    pub bulge: f64,
}

/// A B-spline or a list of points to pass through.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spline {
    /// Degree.
    pub degree: usize,
    /// Flags (1 closed, 2 periodic, 4 rational).
    pub flags: i64,
    /// Knots.
    pub knots: Vec<f64>,
    /// Weights; empty when all are 1.
    pub weights: Vec<f64>,
    /// Control points.
    pub control: Vec<Vec2>,
    /// Fit points.
    pub fit: Vec<Vec2>,
}

/// Kind and geometry of an entity.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// POLYLINE with its VERTEXes, or LWPOLYLINE.
    Polyline {
        /// Vertices.
        vertices: Vec<Vertex>,
        /// Closed by flag.
        closed: bool,
        /// True for an LWPOLYLINE.
        light: bool,
    },
    /// LINE.
    Line([Vec2; 2]),
    /// POINT.
    Point {
        /// Position.
        at: Vec2,
        /// Code 30, else 38 (notch depth, drill diameter), `None` when absent.
        depth: Option<f64>,
        /// Code 39 (notch width).
        width: Option<f64>,
        /// Code 50, degrees.
        angle: Option<f64>,
    },
    /// TEXT or MTEXT.
    Text {
        /// Insertion point.
        at: Vec2,
        /// Text, escapes resolved; empty when there was no code 1.
        value: String,
        /// Height, file units, `None` when absent.
        height: Option<f64>,
    },
    /// INSERT.
    Insert {
        /// Name of the block.
        block: String,
        /// Position.
        at: Vec2,
        /// Scale in x and y.
        scale: [f64; 2],
        /// Degrees.
        rotation: f64,
    },
    /// ARC, degrees counter-clockwise.
    Arc {
        /// Centre.
        center: Vec2,
        /// Radius.
        radius: f64,
        /// Start.
        start: f64,
        /// End.
        end: f64,
    },
    /// CIRCLE.
    Circle {
        /// Centre.
        center: Vec2,
        /// Radius.
        radius: f64,
    },
    /// ELLIPSE, parameters in radians.
    Ellipse {
        /// Centre.
        center: Vec2,
        /// Half major axis.
        major: Vec2,
        /// Minor over major.
        ratio: f64,
        /// Start parameter.
        start: f64,
        /// End parameter.
        end: f64,
    },
    /// SPLINE.
    Spline(Spline),
    /// ATTDEF or ATTRIB: links of notches and the like, or a text under a name.
    Attribute {
        /// Position.
        at: Vec2,
        /// Its name.
        tag: String,
        /// Its text.
        value: String,
    },
    /// Anything else, by its DXF name.
    Other(String),
}

impl Shape {
    /// DXF name.
    #[must_use]
    pub fn name(&self) -> &str {
        match self {
            Self::Polyline { light: true, .. } => "LWPOLYLINE",
            Self::Polyline { .. } => "POLYLINE",
            Self::Line(_) => "LINE",
            Self::Point { .. } => "POINT",
            Self::Text { .. } => "TEXT",
            Self::Insert { .. } => "INSERT",
            Self::Arc { .. } => "ARC",
            Self::Circle { .. } => "CIRCLE",
            Self::Ellipse { .. } => "ELLIPSE",
            Self::Spline(_) => "SPLINE",
            Self::Attribute { .. } => "ATTDEF",
            Self::Other(name) => name,
        }
    }

    /// Points that bound the shape well enough to judge its size.
    #[must_use]
    pub fn extent(&self) -> Vec<Vec2> {
        match self {
            Self::Polyline { vertices, .. } => vertices.iter().map(|v| v.at).collect(),
            Self::Line(ends) => ends.to_vec(),
            Self::Arc { center, radius, .. } | Self::Circle { center, radius } => {
                vec![*center - Vec2::new(*radius, *radius), *center + Vec2::new(*radius, *radius)]
            }
            Self::Ellipse { center, major, .. } => vec![*center - *major, *center + *major],
            Self::Spline(s) => s.control.iter().chain(&s.fit).copied().collect(),
            _ => Vec::new(),
        }
    }
}
