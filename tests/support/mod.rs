//! Stages made for tests, and a bench to run pipelines on.

#![allow(dead_code, clippy::expect_used, clippy::unwrap_used)]

pub mod bench;
pub mod cloth;
pub mod draped;
pub mod facts;
pub mod film;
pub mod glb;
pub mod mesh;
pub mod parallel;
pub mod program;
pub mod project;
pub mod stages;
pub mod switches;
pub mod trial;
