//! The broad phase: trees, lists and bounds that find the primitives that may be near.

pub(crate) mod aabb;
#[cfg(feature = "self-contact")]
pub(crate) mod block_search;
pub(crate) mod blocks;
pub(crate) mod bvh;
pub(crate) mod packed_lists;
pub(crate) mod proximity_list;
#[cfg(feature = "self-contact")]
pub(crate) mod self_search;
pub(crate) mod swept_box;
