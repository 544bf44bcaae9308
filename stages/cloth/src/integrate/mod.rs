//! Ways to advance the problem. Each takes a [`crate::problem::Problem`] and knows no single energy or contact.

pub(crate) mod central;
