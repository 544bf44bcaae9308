//! Many short lists of whole numbers in one.

/// Lists of whole numbers, one after the other.
#[derive(Debug, Default)]
pub(super) struct Lists {
    start: Vec<u32>,
    items: Vec<u32>,
}

impl Lists {
    /// So many lists of numbers below `most`, with what each number was given in its list, bit by bit.
    pub fn new(n: usize, most: usize, mut fill: impl FnMut(u32, &mut dyn FnMut(u32, u8))) -> (Self, Vec<u8>) {
        let (mut lists, mut all) = (Self { start: vec![0], items: Vec::new() }, Vec::new());
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
            all.extend(one.iter().map(|item| std::mem::take(&mut bits[*item as usize])));
            lists.items.append(&mut one);
            lists.start.push(u32::try_from(lists.items.len()).unwrap_or(u32::MAX));
        }
        lists.items.shrink_to_fit();
        lists.start.shrink_to_fit();
        all.shrink_to_fit();
        (lists, all)
    }

    /// Where the items of a list begin.
    #[inline]
    pub fn place(&self, i: u32) -> usize {
        self.start[i as usize] as usize
    }

    #[inline]
    pub fn of(&self, i: u32) -> &[u32] {
        &self.items[self.place(i)..self.place(i + 1)]
    }
}

/// The triangles at every vertex.
pub(super) fn stars(n: usize, faces: &[[u32; 3]]) -> Lists {
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
