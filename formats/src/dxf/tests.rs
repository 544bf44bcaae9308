//! Fixtures of each deviation.
