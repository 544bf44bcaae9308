//! Stages made for tests, and a bench to run pipelines on.

#![allow(dead_code)]

pub mod bench;
pub mod glb;
pub mod stages;
