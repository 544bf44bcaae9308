//! The cloth solver on plain arrays: energies, integrators, contact, effects
