//! The part of a sewing plan that speaks of a body which could be read in part.

use toile_formats::body::Unread;
use toile_garment::sewing::{Placement, SewingPlan};

/// Leaves out what the plan says of names whose values cannot be read: nothing is known of them.
pub(super) fn set_aside(plan: &mut SewingPlan, unread: &Unread) {
    plan.attachments.retain(|a| !unread.has(&[&a.to, &format!("{}-front", a.to), &format!("{}_height", a.to)]));
    plan.places.retain(|place| match &place.placement {
        Placement::Around(around) => !unread.has(&[&around.segment]),
        _ => true,
    });
}
