//! A start that crosses nothing: cloth is freed of the body and of itself.

pub(crate) mod pieces_off_body;
pub(crate) mod repair;
pub(crate) mod resolve_intersections;
