//! A start that crosses nothing: cloth is freed of the body and of itself.

pub(crate) mod free_pieces;
pub(crate) mod repair;
pub(crate) mod resolve_intersections;
