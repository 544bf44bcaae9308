//! Many short lists of whole numbers in one array.

/// First bit of the tag in an item of [`PackedLists::tagged`]; the tag has six bits.
const TAG_SHIFT: u32 = 26;

/// An item of [`PackedLists::tagged`] and its tag.
#[inline]
pub(crate) fn untagged(item: u32) -> (u32, u8) {
    (item & ((1 << TAG_SHIFT) - 1), (item >> TAG_SHIFT) as u8)
}

/// Lists of whole numbers, one after the other.
#[derive(Debug, Default)]
pub(crate) struct PackedLists {
    /// First item of every list, and the end of the last.
    start: Vec<u32>,
    items: Vec<u32>,
}

impl PackedLists {
    /// Makes `n` lists of numbers below `most`, each in ascending order without repetition.
    pub fn new(n: usize, most: usize, mut fill: impl FnMut(u32, &mut dyn FnMut(u32))) -> Self {
        Self::build(n, most, |i, add| fill(i, &mut |item| add(item, 1)), |item, _| item)
    }

    /// Makes such lists with a tag at each number: the bits given with it, joined by "or". [`untagged`] reads it.
    /// Numbers stay below 2²⁶, far more than any factorisation holds.
    pub fn tagged(n: usize, most: usize, fill: impl FnMut(u32, &mut dyn FnMut(u32, u8))) -> Self {
        Self::build(n, most, fill, |item, tag| item | u32::from(tag) << TAG_SHIFT)
    }

    /// Makes the lists; `pack` joins a number and its tag in one item.
    fn build(
        n: usize,
        most: usize,
        mut fill: impl FnMut(u32, &mut dyn FnMut(u32, u8)),
        pack: impl Fn(u32, u8) -> u32,
    ) -> Self {
        let mut lists = Self { start: vec![0], items: Vec::new() };
        let (mut one, mut bits) = (Vec::new(), vec![0u8; most]);
        for i in (0u32..).take(n) {
            fill(i, &mut |item, tag| {
                let bits = &mut bits[item as usize];
                if *bits == 0 {
                    one.push(item);
                }
                *bits |= tag;
            });
            one.sort_unstable();
            lists.items.extend(one.drain(..).map(|item| pack(item, std::mem::take(&mut bits[item as usize]))));
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

    /// Items of list `i`.
    #[inline]
    pub fn of(&self, i: u32) -> &[u32] {
        &self.items[self.start[i as usize] as usize..self.start[i as usize + 1] as usize]
    }
}

/// The triangles at every vertex.
pub(crate) fn faces_at_vertices(n: usize, faces: &[[u32; 3]]) -> PackedLists {
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
    PackedLists { start, items }
}
