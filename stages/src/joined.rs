//! Which of many things hang together.

/// Groups of numbered things, joined pair by pair; the smallest number of a group stands for it.
#[derive(Clone, Debug)]
pub struct Joined(Vec<usize>);

impl Joined {
    /// Nothing joined yet.
    #[must_use]
    pub fn new(count: usize) -> Self {
        Self((0..count).collect())
    }

    /// Smallest number of the group of `i`.
    pub fn root(&mut self, mut i: usize) -> usize {
        while self.0[i] != i {
            self.0[i] = self.0[self.0[i]];
            i = self.0[i];
        }
        i
    }

    /// Joins the groups of two things.
    pub fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b)] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use super::Joined;

    #[test]
    fn the_smallest_stands_for_its_group() {
        let mut joined = Joined::new(6);
        [(4, 2), (5, 4), (3, 1)].into_iter().for_each(|(a, b)| joined.join(a, b));
        let roots: Vec<usize> = (0..6).map(|i| joined.root(i)).collect();
        assert_eq!(roots, [0, 1, 2, 1, 2, 2]);
    }
}
