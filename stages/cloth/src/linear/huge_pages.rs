//! Room for a factor's numbers, in large pages where the system has them: a factor is read and written from end to end hundreds
//! of times, and with pages of 4 KiB the processor looks up more places than it can remember.

use bytemuck::{cast_slice, cast_slice_mut};
use memmap2::MmapMut;
use std::ops::{Deref, DerefMut};

/// Bytes from which on large pages are of use: some of those of 2 MiB.
const LARGE: usize = 8 << 20;

/// Numbers, all zero at first.
#[derive(Debug)]
pub(crate) enum Pages {
    Heap(Vec<f32>),
    Mapped(MmapMut),
}

impl Default for Pages {
    fn default() -> Self {
        Self::Heap(Vec::new())
    }
}

impl Pages {
    /// Room for so many; `None` when the memory is not there.
    pub fn new(length: usize) -> Option<Self> {
        let bytes = length.checked_mul(size_of::<f32>())?;
        if bytes < LARGE {
            return Some(Self::Heap(vec![0.0; length]));
        }
        let map = MmapMut::map_anon(bytes).ok()?;
        // A wish: without it all is as right, and slower.
        #[cfg(target_os = "linux")]
        map.advise(memmap2::Advice::HugePage).ok();
        Some(Self::Mapped(map))
    }
}

impl Deref for Pages {
    type Target = [f32];

    fn deref(&self) -> &[f32] {
        match self {
            Self::Heap(v) => v,
            Self::Mapped(m) => cast_slice(m),
        }
    }
}

impl DerefMut for Pages {
    fn deref_mut(&mut self) -> &mut [f32] {
        match self {
            Self::Heap(v) => v,
            Self::Mapped(m) => cast_slice_mut(m),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_and_large_rooms_are_zero_at_first_and_keep_what_is_put_there() {
        for length in [0, 5, LARGE / size_of::<f32>() + 3] {
            let mut room = Pages::new(length).expect("memory");
            assert!(room.len() == length && room.iter().all(|v| *v == 0.0));
            room.iter_mut().zip((1..=u16::MAX).cycle()).for_each(|(v, k)| *v = f32::from(k));
            assert!(room.iter().zip((1..=u16::MAX).cycle()).all(|(v, k)| *v == f32::from(k)));
        }
        assert!(Pages::new(usize::MAX).is_none());
    }
}
