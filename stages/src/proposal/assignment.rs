//! Partners of atoms: each has at most one, to which it is sewn.

use super::mirror::Mirror;
use super::pairs::Pair;

/// No partner.
pub const FREE: u32 = u32::MAX;

/// An assignment of partners.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Assignment {
    partner: Vec<u32>,
    opposite: Vec<bool>,
}

impl Assignment {
    /// Nothing is sewn.
    pub fn empty(atoms: usize) -> Self {
        Self { partner: vec![FREE; atoms], opposite: vec![true; atoms] }
    }

    /// The partner of an atom.
    pub fn partner(&self, atom: usize) -> Option<usize> {
        Some(self.partner[atom]).filter(|p| *p != FREE).map(|p| p as usize)
    }

    /// Does the start of the atom meet the end of its partner?
    pub fn is_opposite(&self, atom: usize) -> bool {
        self.opposite[atom]
    }

    /// All pairs, with `a < b`.
    pub fn pairs(&self) -> impl Iterator<Item = Pair> + '_ {
        (0..self.partner.len()).filter_map(|a| {
            let b = self.partner(a).filter(|b| *b > a)?;
            Some(Pair { a, b, opposite: self.opposite[a] })
        })
    }

    /// The same without the seams of some atoms.
    pub fn without(&self, atoms: std::ops::Range<usize>) -> Self {
        let mut left = self.clone();
        atoms.for_each(|a| left.free(a));
        left
    }

    /// Sews some atoms as another assignment does, where both atoms of a seam are free and not barred.
    pub fn restore(&mut self, of: &Self, atoms: std::ops::Range<usize>, is_barred: impl Fn(usize) -> bool) {
        for a in atoms {
            let Some(b) = of.partner(a) else { continue };
            if [a, b].iter().all(|atom| self.partner(*atom).is_none() && !is_barred(*atom)) {
                (self.partner[a], self.partner[b]) = (b as u32, a as u32);
                (self.opposite[a], self.opposite[b]) = (of.opposite[a], of.opposite[b]);
            }
        }
    }

    fn free(&mut self, atom: usize) {
        if let Some(other) = self.partner(atom) {
            self.partner[other] = FREE;
        }
        self.partner[atom] = FREE;
    }

    /// Takes a seam of an atom apart, and the mirror image of that seam.
    pub fn remove(&mut self, atom: usize, mirror: &Mirror) {
        let Some(other) = self.partner(atom) else { return };
        if let Some(image) = image(Pair { a: atom, b: other, opposite: true }, mirror)
            && self.partner(image.a) == Some(image.b)
        {
            self.free(image.a);
        }
        self.free(atom);
    }

    /// Sews a pair, and its mirror image. False if the two clash; nothing is changed then.
    pub fn sew(&mut self, pair: Pair, mirror: &Mirror) -> bool {
        let Some(image) = image(pair, mirror) else { return false };
        for p in [pair, image] {
            for atom in [p.a, p.b] {
                self.remove(atom, mirror);
            }
        }
        for p in [pair, image] {
            (self.partner[p.a], self.partner[p.b]) = (p.b as u32, p.a as u32);
            (self.opposite[p.a], self.opposite[p.b]) = (p.opposite, p.opposite);
        }
        true
    }
}

/// The mirror image of a pair, the pair itself where it has none. `None` if the image uses one of its atoms otherwise.
pub fn image(pair: Pair, mirror: &Mirror) -> Option<Pair> {
    let (Some(x), Some(y)) = (mirror.of(pair.a), mirror.of(pair.b)) else {
        // A seam with an image on one side only cannot be mirrored; it stands alone.
        return (mirror.of(pair.a) != Some(pair.a) && mirror.of(pair.b) != Some(pair.b)
            || mirror.of(pair.a).is_none() && mirror.of(pair.b).is_none())
        .then_some(pair);
    };
    let own = (x == pair.a && y == pair.b) || (x == pair.b && y == pair.a);
    let clashes = !own && (x == pair.a || y == pair.b || x == pair.b || y == pair.a);
    (!clashes).then_some(Pair { a: x, b: y, opposite: pair.opposite })
}
