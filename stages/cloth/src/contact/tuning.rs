//! Tuned numbers and mechanisms of the contact energy.

use crate::tuning::{mechanisms, tuned};

tuned! {
    room "contact";

    /// Stiffness of contacts times activation distance, over the pressure that the cloth exerts.
    /// Scaling by that pressure keeps similar scenes similar.
    STIFFNESS_OF_CONTACT: f64 = 8.0, {
        unit: "1",
        larger: "Cloth under load stays closer to its gap, and the Hessian is worse conditioned.",
        smaller: "Gaps close further under load: at 8, a skirt's gap of 1.25 mm is half closed by 300 Pa.",
        tried: "not recorded",
        evidence: "With stiffness from weight alone, light tense strips lost their friction (docs/lab/2026-11-27-rest-without-time.md).",
    }
    /// Largest second derivative of a contact in the preconditioner, over pressure times activation distance.
    HESSIAN_LIMIT_OF_CONTACT: f64 = 2e6, {
        unit: "1",
        larger: "Single precision loses the cloth behind the contact, and steps become worse.",
        smaller: "The preconditioner underestimates stiff contacts, and steps towards them are too long.",
        tried: "not recorded",
        evidence: "It is 1e5 N/m in a skirt; beyond that single precision loses the cloth behind it (docs/lab/2026-11-27-rest-without-time.md).",
    }
    /// Largest gap of self-contact over the smallest altitude of the triangles at a vertex.
    SELF_GAP_PER_ALTITUDE: f64 = 0.3, {
        unit: "share of an altitude",
        larger: "A flat sheet is pushed apart from itself once the gap exceeds what neighbours keep.",
        smaller: "Thick cloth on a fine mesh lies closer to itself than it is thick.",
        tried: "not recorded",
        evidence: "No measurement is kept. Culling by normal cones relies on less than 0.4 of an altitude.",
    }
    /// Strain at which the stretch stiffness of the cloth is measured for the contact pressure.
    STRAIN_OF_CONTACT_PRESSURE: f64 = 0.01, {
        unit: "1",
        larger: "Cloth that stiffens when stretched gets stiffer contacts.",
        smaller: "Contacts follow the slope of the stress curve at rest.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Share of the vertex gap at which edges and faces are held off the body, and edges off edges.
    EDGE_GAP_SHARE: f64 = 0.5, {
        unit: "share of the gap",
        larger: "Edges and faces carry load beside the vertices, and cloth over a curved body stands higher.",
        smaller: "Edges come closer to the body before anything stops them.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// A contact nearer than this share of its gap is stiffened.
    STIFFENING_TRIGGER: f64 = 0.1, {
        unit: "share of the gap",
        larger: "More contacts become stiff, and the Hessian is worse conditioned.",
        smaller: "Contacts close further before they are stiffened, and steps get shorter.",
        tried: "not recorded",
        evidence: "Tens of kPa would close a gap of 0.5 mm to a micrometre without it (docs/lab/2026-11-27-rest-without-time.md).",
    }
    /// Share of its gap at which a stiffened contact holds the load that it had.
    STIFFENING_TARGET: f64 = 0.4, {
        unit: "share of the gap",
        larger: "Stiffened contacts stand further off and become stiffer.",
        smaller: "Stiffened contacts stay closer, and may have to be stiffened again.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest factor by which one call stiffens a contact.
    STIFFENING_PER_CALL: f64 = 16.0, {
        unit: "1",
        larger: "Contacts reach their stiffness in fewer rounds, and the cloth may jump off the body.",
        smaller: "More rounds are needed until a contact is stiff enough.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest stiffening of a contact in all.
    STIFFENING_LIMIT: f64 = 1e4, {
        unit: "1",
        larger: "Higher loads are held off the body, with a worse conditioned Hessian.",
        smaller: "Very high loads close their gaps.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Slack of the candidate lists over the longest move of a step, between the two limits below.
    LIST_SLACK_PER_STEP: f64 = 3.0, {
        unit: "1",
        larger: "Lists last longer and hold more pairs.",
        smaller: "Lists are shorter and are made more often.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Smallest slack of the candidate lists over the mean edge.
    LIST_SLACK_MIN: f64 = 0.02, {
        unit: "mean edges",
        larger: "Lists of slow cloth last longer and hold more pairs.",
        smaller: "Lists of slow cloth are made more often.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest slack of the candidate lists over the mean edge.
    LIST_SLACK_MAX: f64 = 0.1, {
        unit: "mean edges",
        larger: "Lists hold neighbours of neighbours, which never touch.",
        smaller: "Lists of fast cloth are made more often.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// At rest, the body's contact of a vertex nearer than this share of its gap acts from farther off.
    GAP_UPDATE_SHARE: f64 = 0.8, {
        unit: "share of the gap",
        larger: "More contacts move out, and more rounds follow each other.",
        smaller: "Tight cloth lies deeper in its gap, and its girth is too small.",
        tried: "not recorded",
        evidence: "A tight sleeve shows its tension within 1 %; without it, 19 % too little (docs/lab/2026-11-27-rest-without-time.md).",
    }
    /// The same share for a vertex that began with the load under which it rests.
    GAP_UPDATE_SHARE_WARM: f64 = 0.6, {
        unit: "share of the gap",
        larger: "A strip pulled round a cylinder is stretched, and slips at each pull.",
        smaller: "Cloth that is draped anew from rest lies deeper in its gap.",
        tried: "0.6 and 0.8",
        evidence: "The strip round a cylinder lost up to 7 % of its tension at 0.8 (docs/lab/2026-11-27-rest-without-time.md).",
    }
    /// Largest increase of a gap to the body.
    GAP_INCREASE_LIMIT: f64 = 1.5, {
        unit: "gaps",
        larger: "Contacts under very high loads act from farther off.",
        smaller: "Cloth under high loads stays inside its gap.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Cloth that starts nearer to the body than this many gaps lies on it.
    RESTING_GAP_LIMIT: f64 = 1.02, {
        unit: "gaps",
        larger: "Cloth that only passes near the body starts with a load.",
        smaller: "Cloth that was draped before starts without the loads of some contacts.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Tangential motion over the gap before a contact slides, at most.
    STICK_REACH: f64 = 0.03, {
        unit: "share of the gap",
        larger: "Contacts give way along the body before they slide.",
        smaller: "Tangential springs are stiffer, and the Hessian is worse conditioned.",
        tried: "not recorded",
        evidence: "Strips on a rough floor slipped 4 to 15 % too early without it (docs/lab/2026-11-27-rest-without-time.md).",
    }
    /// Share of its slip that a refresh of friction moves the anchor of a contact.
    SLIP_SHARE_PER_REFRESH: f64 = 0.5, {
        unit: "share of the slip",
        larger: "Steps on the way overshoot, and slip that is kept stays.",
        smaller: "Sliding cloth needs more refreshes to come to rest.",
        tried: "0.5 and 1",
        evidence: "At 1, one of fifteen pulls round a cylinder came to no rest (docs/lab/2026-11-27-rest-without-time.md).",
    }
    /// Largest number of Gauss-Seidel sweeps that share out the friction forces of a start in balance.
    FRICTION_BALANCE_SWEEPS: usize = 2000, {
        unit: "sweeps",
        larger: "Large starts in balance are solved more exactly, and may take longer.",
        smaller: "Some forces along the body remain at the start.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Largest change of a friction force in the last of those sweeps, over the largest friction limit.
    FRICTION_BALANCE_TOLERANCE: f64 = 1e-5, {
        unit: "share of the largest friction limit",
        larger: "The sweeps end earlier, and some forces along the body remain.",
        smaller: "More sweeps are made.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
    /// Rounds in which single vertices are truncated before the whole step is shortened.
    VERTEX_TRUNCATION_ROUNDS: usize = 5, {
        unit: "rounds",
        larger: "More vertices are truncated, and the direction of the step is spoilt further.",
        smaller: "The whole step is shortened more often.",
        tried: "not recorded",
        evidence: "No measurement is kept.",
    }
}

mechanisms! {
    room "contact";

    /// Strains the friction springs of cloth that starts in balance, so that it does not slip in its first steps.
    FRICTION_WARM_START = "friction-warm-start";
    /// Shortens the moves of single vertices before the whole step is shortened.
    VERTEX_TRUNCATION = "vertex-truncation";
    /// Limits the second derivative of a contact in the preconditioner.
    CONTACT_HESSIAN_LIMIT = "contact-hessian-limit";
}
