//! Lists of candidate pairs of the contact energy, kept until the cloth has moved by their slack.

use crate::Vec3;
use crate::collision::body::Body;
use crate::collision::body_candidates::BodyCandidates;
use crate::collision::narrow_phase::candidates::{ClothCandidates, LinearMotion};
use crate::collision::self_candidates::SelfCollision;
use crate::contact::barrier::active_contact::largest_gap;
use crate::contact::barrier::statistics::ContactStatistics;
use crate::contact::list_validity::ListValidity;
use crate::contact::parameters::ContactParameters;
use crate::contact::tuning::{EDGE_GAP_SHARE, LIST_SLACK_MAX, LIST_SLACK_MIN, LIST_SLACK_PER_STEP};
use crate::report::cost::{CpuTimer, Work};

/// State of the candidate pairs of cloth with cloth.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum SelfDetection {
    /// Pairs are listed together with those of the body.
    #[default]
    Current,
    /// Pairs are not looked for.
    Deferred,
    /// Pairs are not listed, and a new list is due.
    Due,
}

/// Candidate pairs of cloth with cloth and of cloth with the body.
pub(crate) struct CandidateLists {
    /// Search for pairs of cloth with cloth; `None` without self-contact.
    pub(super) self_collision: Option<SelfCollision>,
    pub(super) self_detection: SelfDetection,
    /// Pairs of cloth with cloth.
    pub cloth: ClothCandidates,
    /// Pairs of cloth with the body.
    pub body: BodyCandidates,
    /// Distance of each vertex from its position when the body's pairs were listed, m.
    pub(super) displacements: Vec<f64>,
    pub(super) validity: ListValidity,
}

impl CandidateLists {
    pub(super) fn new(self_collision: Option<SelfCollision>) -> Self {
        Self {
            self_collision,
            self_detection: SelfDetection::default(),
            cloth: ClothCandidates::default(),
            body: BodyCandidates::default(),
            displacements: Vec::new(),
            validity: ListValidity::default(),
        }
    }

    /// Makes the lists anew unless they are valid along the step. Returns whether they were made.
    ///
    /// `body_activation_distance` is the least activation distance of vertices at the body, m.
    pub(super) fn update(
        &mut self,
        x: &[Vec3],
        step: &[Vec3],
        parameters: &ContactParameters,
        body: Option<&mut Body>,
        body_activation_distance: f64,
        statistics: &mut ContactStatistics,
    ) -> bool {
        let motion = LinearMotion::new(x, step, &parameters.topology, &parameters.stitch_groups);
        let body_moves = body.as_ref().is_some_and(|b| b.is_moving());
        let is_due = self.self_detection == SelfDetection::Due;
        if self.validity.covers(x, motion.longest) && !body_moves && !is_due {
            return false;
        }
        statistics.lists += 1;
        let mut lap = CpuTimer::start();
        let edge = parameters.mean_edge;
        let [least, most] = [LIST_SLACK_MIN.get() * edge, LIST_SLACK_MAX.get() * edge];
        let slack = (LIST_SLACK_PER_STEP.get() * motion.longest).clamp(least, most);
        if let Some(search) = self.self_collision.as_mut().filter(|_| self.self_detection != SelfDetection::Deferred) {
            search.list(&mut self.cloth, &motion, largest_gap(&parameters.self_gap) + 2.0 * slack);
            self.self_detection = SelfDetection::Current;
            statistics.costs.spend(Work::SelfContact, &mut lap);
        }
        if let Some(body) = body {
            let gap = largest_gap(&parameters.body_gap);
            // Edges and faces push from nearer than vertices do.
            let feature_reach = EDGE_GAP_SHARE.get() * gap + slack;
            let vertex_reach = gap.max(body_activation_distance) + slack;
            if body.motion.is_some() {
                self.body.list_moving(&motion, body, vertex_reach);
            } else {
                self.body.list(&motion, body, [feature_reach, vertex_reach], edge);
                statistics.smallest_body_distance =
                    statistics.smallest_body_distance.min(self.body.smallest_distance());
            }
            self.body.points.sort_unstable_by_key(|p| p.vertices);
            statistics.costs.spend(Work::BodyContact, &mut lap);
        }
        self.validity.record(x, slack);
        true
    }
}
