//! Damaged copies of bytes: cuts, stretches lost or doubled, nasty words for numbers.

/// A fixed sequence of numbers (xorshift).
pub struct Dice(pub u64);

impl Dice {
    pub fn below(&mut self, n: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % n.max(1) as u64) as usize
    }
}

const NASTY: [&str; 16] = [
    "0",
    "-0",
    "-1",
    "1e308",
    "1e999",
    "1e-320",
    "nan",
    "inf",
    "2147483648",
    "-9223372036854775809",
    "1,5",
    "",
    "7e7",
    "99999999",
    "SECTION",
    "INSERT",
];

fn lines(bytes: &[u8]) -> Vec<&[u8]> {
    bytes.split_inclusive(|b| *b == b'\n').collect()
}

/// One damaged copy: bits, cuts, stretches and pairs lost, doubled or swapped, nasty words for numbers.
pub fn mutant(seed: &[u8], dice: &mut Dice) -> Vec<u8> {
    let mut out = seed.to_vec();
    if out.is_empty() {
        return out;
    }
    let n = out.len();
    match dice.below(9) {
        0 => {
            for _ in 0..=dice.below(16) {
                let at = dice.below(n);
                out[at] ^= 1 << dice.below(8);
            }
        }
        1 => out.truncate(dice.below(n)),
        2 => {
            let (a, len) = (dice.below(n), dice.below(400));
            out.drain(a..(a + len).min(n));
        }
        3 => {
            let (a, len) = (dice.below(n), dice.below(400));
            let copy = seed[a..(a + len).min(n)].to_vec();
            let at = dice.below(n);
            out.splice(at..at, copy);
        }
        4 => {
            let mut list = lines(seed);
            let (a, b) = (dice.below(list.len()), dice.below(list.len()));
            list.swap(a, b);
            return list.concat();
        }
        5 => {
            let mut list = lines(seed);
            let (a, len) = (dice.below(list.len()), 2 * dice.below(20));
            let end = (a + len).min(list.len());
            if dice.below(2) == 0 {
                list.drain(a..end);
            } else {
                let copy = list[a..end].to_vec();
                list.splice(a..a, copy);
            }
            return list.concat();
        }
        _ => {
            for _ in 0..=dice.below(3) {
                let n = out.len();
                let start = dice.below(n);
                let Some(a) = (start..n).find(|i| out[*i].is_ascii_digit()) else { break };
                let b = (a..n).find(|i| !out[*i].is_ascii_digit() && out[*i] != b'.').unwrap_or(n);
                out.splice(a..b, NASTY[dice.below(NASTY.len())].bytes());
            }
        }
    }
    out
}
