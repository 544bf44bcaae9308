//! The explicit scheme of Liu, Chen and Shi 2003, complete: central differences with contact, friction, sewing forces
//! and a correction of over-elongation of their own.
//!
//! The paper is *Simulation of 3D Garment Based on Improved Spring-Mass Model*, Journal of Software 14(3), 619–627.
//! Equation numbers in this folder are those of the paper:
//!
//! - Equation 1, motion of a particle under internal and external forces: [`problem`].
//! - Equations 2 and 3, force and energy of a spring: `energy/structural.rs`, `energy/shear.rs`.
//! - Equation 4, weight of a particle: `energy/weight.rs`.
//! - Equation 5, sewing force linear in the gap: [`sewing_force`].
//! - Equation 6, anti-collision penalty: [`contact`].
//! - Equation 7, damping against the velocity: [`central_difference`].
//! - Equations 8 to 14, central differences started at rest, with an adaptive step: [`central_difference`], [`run`].
//! - Equation 15, draping as the same system without sewing forces: [`run`].
//! - §2.2, correction of over-elongated springs: [`over_elongation`].

pub(crate) mod central_difference;
pub(crate) mod contact;
pub(crate) mod friction;
pub(crate) mod motion;
pub(crate) mod over_elongation;
pub(crate) mod problem;
pub(crate) mod report;
pub(crate) mod rest;
pub(crate) mod run;
pub(crate) mod sewing_force;
pub(crate) mod tuning;
