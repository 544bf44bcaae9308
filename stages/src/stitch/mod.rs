//! 2D to 3D: pieces placed around the body and sewn (Liu, Chen, Shi 2003, §1.3.2).

pub mod around;
pub mod place;
