//! A buffer for the numbers of a factor, in huge pages where the system has them.
//!
//! A factor is read and written from end to end hundreds of times. With pages of 4 KiB the processor looks up more
//! addresses than it can keep.

use crate::linear::tuning::{HUGE_PAGE_BYTES_MIN, HUGE_PAGES};
use bytemuck::{cast_slice, cast_slice_mut};
use memmap2::MmapMut;
use std::ops::{Deref, DerefMut};

/// Numbers in single precision, all zero at first.
#[derive(Debug)]
pub(crate) enum HugePageBuffer {
    Heap(Vec<f32>),
    Mapped(MmapMut),
}

impl Default for HugePageBuffer {
    fn default() -> Self {
        Self::Heap(Vec::new())
    }
}

impl HugePageBuffer {
    /// A buffer of `length` numbers; `None` when there is no memory for it.
    pub fn new(length: usize) -> Option<Self> {
        let bytes = length.checked_mul(size_of::<f32>())?;
        if bytes < HUGE_PAGE_BYTES_MIN.get() || !HUGE_PAGES.is_on() {
            return Some(Self::Heap(vec![0.0; length]));
        }
        let map = MmapMut::map_anon(bytes).ok()?;
        // The system may refuse; the result is the same, and slower.
        #[cfg(target_os = "linux")]
        map.advise(memmap2::Advice::HugePage).ok();
        Some(Self::Mapped(map))
    }
}

impl Deref for HugePageBuffer {
    type Target = [f32];

    fn deref(&self) -> &[f32] {
        match self {
            Self::Heap(v) => v,
            Self::Mapped(m) => cast_slice(m),
        }
    }
}

impl DerefMut for HugePageBuffer {
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
    fn small_and_large_buffers_are_zero_at_first_and_keep_their_numbers() {
        for length in [0, 5, HUGE_PAGE_BYTES_MIN.get() / size_of::<f32>() + 3] {
            let mut buffer = HugePageBuffer::new(length).expect("memory");
            assert!(buffer.len() == length && buffer.iter().all(|v| *v == 0.0));
            buffer.iter_mut().zip((1..=u16::MAX).cycle()).for_each(|(v, k)| *v = f32::from(k));
            assert!(buffer.iter().zip((1..=u16::MAX).cycle()).all(|(v, k)| *v == f32::from(k)));
        }
        assert!(HugePageBuffer::new(usize::MAX).is_none());
    }
}
