//! The garment document and its words.
//!
//! One [`Garment`] flows through the pipeline; every stage takes it and gives it back richer.
//! Inside, everything is SI `f64`: metres, kilograms, seconds, radians, newtons. This package knows
//! no file format of others and no solver.

pub mod animation;
pub mod body;
pub mod bundle;
pub mod code;
mod code_list;
pub mod dart;
pub mod diagnostic;
pub mod fabric;
pub mod flat;
pub mod garment;
pub mod ids;
pub mod mesh;
pub mod notch;
pub mod outline;
pub mod piece;
pub mod provenance;
pub mod seam;
pub mod sewing;
pub mod source;
pub mod text;
pub mod texture;
pub mod units;

pub use code::Code;
pub use diagnostic::{Diagnostic, Report, Severity, Tally};
pub use garment::{Aspect, Garment};
pub use ids::{DartId, MeshVertex, PieceId, SeamId};
pub use piece::Piece;
pub use source::SourceRef;

/// A point or vector in the plane of a piece, metres.
pub type Vec2 = nalgebra::Vector2<f64>;
/// A point or vector in the world, metres; +y up, +z front, +x the wearer's left.
pub type Vec3 = nalgebra::Vector3<f64>;
