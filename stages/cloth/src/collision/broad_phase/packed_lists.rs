//! Many short lists of whole numbers in one.

/// Where in a number stands what it was given, six bits of it.
const TIED: u32 = 26;

/// A number of [`Lists::tied`], and what it was given.
#[inline]
pub(crate) fn untied(item: u32) -> (u32, u8) {
    (item & ((1 << TIED) - 1), (item >> TIED) as u8)
}

/// Lists of whole numbers, one after the other.
#[derive(Debug, Default)]
pub(crate) struct Lists {
    start: Vec<u32>,
    items: Vec<u32>,
}

impl Lists {
    /// So many lists of numbers below `most`, ascending, each number once.
    pub fn new(n: usize, most: usize, mut fill: impl FnMut(u32, &mut dyn FnMut(u32))) -> Self {
        Self::made(n, most, |i, add| fill(i, &mut |item| add(item, 1)), |item, _| item)
    }

    /// The same with what each number was given in its list, bit by bit: [`untied`] tells. Triangles up to 2²⁶, far more than any
    /// factor holds.
    pub fn tied(n: usize, most: usize, fill: impl FnMut(u32, &mut dyn FnMut(u32, u8))) -> Self {
        Self::made(n, most, fill, |item, given| item | u32::from(given) << TIED)
    }

    fn made(
        n: usize,
        most: usize,
        mut fill: impl FnMut(u32, &mut dyn FnMut(u32, u8)),
        told: impl Fn(u32, u8) -> u32,
    ) -> Self {
        let mut lists = Self { start: vec![0], items: Vec::new() };
        let (mut one, mut bits) = (Vec::new(), vec![0u8; most]);
        for i in (0u32..).take(n) {
            fill(i, &mut |item, given| {
                let bits = &mut bits[item as usize];
                if *bits == 0 {
                    one.push(item);
                }
                *bits |= given;
            });
            one.sort_unstable();
            lists.items.extend(one.drain(..).map(|item| told(item, std::mem::take(&mut bits[item as usize]))));
            lists.start.push(u32::try_from(lists.items.len()).unwrap_or(u32::MAX));
        }
        lists.items.shrink_to_fit();
        lists.start.shrink_to_fit();
        lists
    }

    /// Number of lists.
    pub fn len(&self) -> usize {
        self.start.len() - 1
    }

    #[inline]
    pub fn of(&self, i: u32) -> &[u32] {
        &self.items[self.start[i as usize] as usize..self.start[i as usize + 1] as usize]
    }
}

/// The triangles at every vertex.
pub(crate) fn stars(n: usize, faces: &[[u32; 3]]) -> Lists {
    let mut start = vec![0u32; n + 1];
    faces.iter().flatten().for_each(|v| start[*v as usize + 1] += 1);
    (0..n).for_each(|v| start[v + 1] += start[v]);
    let (mut next, mut items) = (start.clone(), vec![0; 3 * faces.len()]);
    for (f, t) in (0u32..).zip(faces) {
        for v in t {
            items[next[*v as usize] as usize] = f;
            next[*v as usize] += 1;
        }
    }
    Lists { start, items }
}
