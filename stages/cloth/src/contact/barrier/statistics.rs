//! Counts of contact detection and of contacts, for the report.

use crate::report::cost::Costs;

/// Counts of contact detection and of contacts during a solve.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ContactStatistics {
    /// Times that candidate lists were made.
    pub lists: u64,
    /// Largest number of cloth–cloth contacts in one evaluation.
    pub most_self_contacts: usize,
    /// Largest number of cloth–body contacts in one evaluation.
    pub most_body_contacts: usize,
    /// Smallest distance of a cloth vertex from the body so far, m; infinite where none was near.
    pub smallest_body_distance: f64,
    /// Steps that were shortened.
    pub shortened_steps: u64,
    /// Evaluations of the contact energy.
    pub evaluations: u64,
    /// Evaluations with cloth–cloth contacts.
    pub evaluations_with_self_contact: u64,
    /// Evaluations with cloth–body contacts.
    pub evaluations_with_body_contact: u64,
    /// Blocks of steps that deferred the detection of self-contact.
    pub deferred_blocks: u64,
    /// Deferred blocks that were rolled back.
    pub rolled_back_blocks: u64,
    /// Computing costs, which are not part of any result.
    pub costs: Costs,
}

impl ContactStatistics {
    /// Statistics before the first evaluation.
    pub fn new() -> Self {
        Self { smallest_body_distance: f64::INFINITY, ..Self::default() }
    }

    /// Counts the contacts of one evaluation.
    pub fn count_contacts(&mut self, cloth: usize, body: usize) {
        self.most_self_contacts = self.most_self_contacts.max(cloth);
        self.most_body_contacts = self.most_body_contacts.max(body);
        self.evaluations += 1;
        self.evaluations_with_self_contact += u64::from(cloth > 0);
        self.evaluations_with_body_contact += u64::from(body > 0);
    }
}
