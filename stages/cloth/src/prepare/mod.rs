//! Makes a scene ready: canonical frame, degenerate edges, islands, and a start free of crossings.

pub(crate) mod canonical_frame;
pub(crate) mod degenerate_edges;
pub(crate) mod initial_feasibility;
pub(crate) mod islands;
pub(crate) mod start;
pub(crate) mod tuning;
