//! The garment document packed: its long lists of numbers as bytes, the rest as text, deflated together.
//!
//! Inflated it is: length of the text and number of lists (u32 each, little endian), then kind, width and rows of
//! every list (u32 each), then the lists, then the text. In the text a list is replaced by `{"#": NUMBER}`. A list is
//! stored by columns, and every column by the planes of its bytes. Whole numbers (kind 0) are 32 bits wide and stored
//! as differences; others (kind 1) are `f64`. Nothing is rounded. Equal lists are stored once.

use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// Lists with fewer numbers stay text.
const SHORTEST: usize = 24;
/// Widest row of a list.
const WIDEST: usize = 4;
/// Most bytes of an inflated document.
const MOST_BYTES: usize = 512 << 20;
/// Most numbers of all lists together, each counted as often as it is named.
const MOST_NUMBERS: usize = 32 << 20;
/// Deflate level: the smallest result in good time.
const LEVEL: u8 = 9;

/// Numbers of one list, row by row; `width` 0 is a plain list.
struct List {
    width: usize,
    numbers: Numbers,
}

enum Numbers {
    Whole(Vec<u32>),
    Real(Vec<f64>),
}

/// Packs a document. The same document gives the same bytes.
pub fn pack(mut document: Value) -> Vec<u8> {
    let mut lists = Lists::default();
    lists.take(&mut document);
    let text = document.to_string();
    let mut out = Vec::new();
    let mut word = |n: usize| out.extend_from_slice(&(n as u32).to_le_bytes());
    word(text.len());
    word(lists.stored.len());
    lists.stored.iter().for_each(|(head, _)| head.iter().for_each(|n| word(*n)));
    lists.stored.iter().for_each(|(_, bytes)| out.extend_from_slice(bytes));
    out.extend_from_slice(text.as_bytes());
    miniz_oxide::deflate::compress_to_vec_zlib(&out, LEVEL)
}

/// The stored lists, each once.
#[derive(Default)]
struct Lists {
    stored: Vec<([usize; 3], Vec<u8>)>,
    known: BTreeMap<([usize; 3], Vec<u8>), usize>,
}

impl Lists {
    fn take(&mut self, value: &mut Value) {
        match value {
            Value::Array(items) => match list(items) {
                Some(list) => *value = self.store(&list),
                None => items.iter_mut().for_each(|v| self.take(v)),
            },
            Value::Object(map) => map.values_mut().for_each(|v| self.take(v)),
            _ => {}
        }
    }

    fn store(&mut self, list: &List) -> Value {
        let (head, bytes) = encode(list);
        let next = self.stored.len();
        let number = *self.known.entry((head, bytes.clone())).or_insert(next);
        if number == next {
            self.stored.push((head, bytes));
        }
        Value::Object(Map::from_iter([("#".to_owned(), Value::from(number))]))
    }
}

/// A list of numbers, or of equally long rows of them; `None` for anything else and for short ones.
fn list(items: &[Value]) -> Option<List> {
    let width = match items.first()? {
        Value::Array(row) => Some(row.len()).filter(|n| (1..=WIDEST).contains(n))?,
        _ => 0,
    };
    let mut flat: Vec<&Value> = Vec::with_capacity(items.len() * width.max(1));
    for item in items {
        match item {
            Value::Array(row) if width > 0 && row.len() == width => flat.extend(row),
            Value::Number(_) if width == 0 => flat.push(item),
            _ => return None,
        }
    }
    if flat.len() < SHORTEST || u32::try_from(items.len()).is_err() {
        return None;
    }
    let whole = |v: &&Value| v.as_u64().and_then(|n| u32::try_from(n).ok());
    let real = |v: &&Value| v.as_f64().filter(|_| v.is_f64());
    let numbers = match flat.iter().map(whole).collect() {
        Some(whole) => Numbers::Whole(whole),
        None => Numbers::Real(flat.iter().map(real).collect::<Option<_>>()?),
    };
    Some(List { width, numbers })
}

fn encode(list: &List) -> ([usize; 3], Vec<u8>) {
    let columns = list.width.max(1);
    match &list.numbers {
        Numbers::Whole(n) => {
            let mut before = vec![0; columns];
            let steps =
                n.iter().enumerate().map(|(i, x)| x.wrapping_sub(std::mem::replace(&mut before[i % columns], *x)));
            let bytes: Vec<[u8; 4]> = steps.map(u32::to_le_bytes).collect();
            ([0, list.width, n.len() / columns], planes(&bytes, columns))
        }
        Numbers::Real(n) => {
            let bytes: Vec<[u8; 8]> = n.iter().map(|x| x.to_le_bytes()).collect();
            ([1, list.width, n.len() / columns], planes(&bytes, columns))
        }
    }
}

/// Column by column, and in a column byte by byte.
fn planes<const N: usize>(numbers: &[[u8; N]], columns: usize) -> Vec<u8> {
    let column = |c: usize| (0..N).flat_map(move |b| numbers.iter().skip(c).step_by(columns).map(move |n| n[b]));
    (0..columns).flat_map(column).collect()
}

/// The numbers back from their planes, row by row.
fn numbers<const N: usize>(bytes: &[u8], columns: usize) -> Vec<[u8; N]> {
    let rows = bytes.len() / N / columns;
    let of = |i: usize| std::array::from_fn(|b| bytes[(i % columns * N + b) * rows + i / columns]);
    (0..rows * columns).map(of).collect()
}

/// The document of packed bytes.
///
/// # Errors
/// Bytes that no document was packed into, in words.
pub fn unpack(bytes: &[u8]) -> Result<Value, String> {
    let inflated = miniz_oxide::inflate::decompress_to_vec_zlib_with_limit(bytes, MOST_BYTES)
        .map_err(|e| format!("its packed document cannot be inflated: {e}"))?;
    let broken = || "its packed document is cut off".to_owned();
    let word = |k: usize| {
        let four: [u8; 4] = inflated.get(4 * k..4 * k + 4)?.try_into().ok()?;
        usize::try_from(u32::from_le_bytes(four)).ok()
    };
    let (length, count) = word(0).zip(word(1)).ok_or_else(broken)?;
    let mut at =
        count.checked_mul(12).and_then(|n| n.checked_add(8)).filter(|n| *n <= inflated.len()).ok_or_else(broken)?;
    let mut lists = Vec::with_capacity(count);
    for k in 0..count {
        let [kind, width, rows] = [0, 1, 2].map(|j| word(2 + 3 * k + j).unwrap_or(usize::MAX));
        let size = if kind == 0 { 4 } else { 8 };
        let whole = rows.checked_mul(width.max(1) * size).filter(|_| kind < 2 && width <= WIDEST).ok_or_else(broken)?;
        let part = at.checked_add(whole).and_then(|end| inflated.get(at..end)).ok_or_else(broken)?;
        lists.push((kind, width, part));
        at += whole;
    }
    let text = at.checked_add(length).and_then(|end| inflated.get(at..end)).ok_or_else(broken)?;
    let mut document: Value = serde_json::from_slice(text).map_err(|e| format!("its packed document: {e}"))?;
    fill(&mut document, &lists, &mut MOST_NUMBERS.clone())?;
    Ok(document)
}

type Packed<'b> = (usize, usize, &'b [u8]);

/// Puts the lists back in their places.
fn fill(value: &mut Value, lists: &[Packed<'_>], left: &mut usize) -> Result<(), String> {
    match value {
        Value::Array(items) => items.iter_mut().try_for_each(|v| fill(v, lists, left)),
        Value::Object(map) => match map.get("#").and_then(Value::as_u64).filter(|_| map.len() == 1) {
            Some(number) => {
                let list = usize::try_from(number).ok().and_then(|n| lists.get(n));
                let list =
                    list.ok_or_else(|| format!("its packed document names list {number}, which is not there"))?;
                *left = left.checked_sub(list.2.len() / 4).ok_or("its packed document is too large")?;
                *value = unfold(list);
                Ok(())
            }
            None => map.values_mut().try_for_each(|v| fill(v, lists, left)),
        },
        _ => Ok(()),
    }
}

fn unfold(&(kind, width, bytes): &Packed<'_>) -> Value {
    let columns = width.max(1);
    let flat: Vec<Value> = if kind == 0 {
        let mut sums = vec![0_u32; columns];
        let whole = numbers(bytes, columns).into_iter().enumerate().map(|(i, n)| {
            let sum = &mut sums[i % columns];
            *sum = sum.wrapping_add(u32::from_le_bytes(n));
            Value::from(*sum)
        });
        whole.collect()
    } else {
        numbers(bytes, columns).into_iter().map(|n| Value::from(f64::from_le_bytes(n))).collect()
    };
    if width == 0 {
        return Value::Array(flat);
    }
    Value::Array(flat.chunks(width).map(|row| Value::Array(row.to_vec())).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn sample() -> Value {
        let real: Vec<Value> = (0..40).map(|i| json!([f64::from(i) * 0.1, -0.0, 1e-300 * f64::from(i)])).collect();
        let whole: Vec<u32> = (0..60).map(|i| (i * 7919) % 61 + if i == 3 { u32::MAX - 61 } else { 0 }).collect();
        json!({
            "real": real, "again": real, "whole": whole, "rows": [whole.clone(), whole],
            "short": [1, 2, 3], "mixed": (0..30).map(|i| if i == 7 { json!(0.5) } else { json!(i) }).collect::<Vec<_>>(),
            "uneven": (0..30).map(|i| json!(vec![1.5; 1 + i % 2])).collect::<Vec<_>>(), "name": "#", "no": null,
            "below": (0..30).map(|i| json!(-i - 1)).collect::<Vec<_>>(),
        })
    }

    #[test]
    fn every_bit_comes_back() {
        let packed = pack(sample());
        assert_eq!(packed, pack(sample()));
        let back = unpack(&packed).expect("a document");
        assert_eq!(back.to_string(), sample().to_string());
        assert!(packed.len() < sample().to_string().len() / 4, "{} bytes", packed.len());
    }

    #[test]
    fn bytes_that_were_not_packed_are_refused_in_words() {
        let packed = pack(sample());
        for length in [0, 1, 7, packed.len() / 2, packed.len() - 1] {
            assert!(unpack(&packed[..length]).is_err(), "{length} bytes");
        }
        let deflated = |bytes: &[u8]| miniz_oxide::deflate::compress_to_vec_zlib(bytes, 6);
        let heads = |words: &[u32]| deflated(&words.iter().flat_map(|w| w.to_le_bytes()).collect::<Vec<_>>());
        for words in [&[0, u32::MAX][..], &[4, 1, 0, 1, u32::MAX], &[4, 1, 2, 1, 1], &[4, 1, 0, 99, 1], &[u32::MAX, 0]]
        {
            assert!(unpack(&heads(words)).is_err(), "{words:?}");
        }
        let mut missing = [2_u32.to_le_bytes(), 0_u32.to_le_bytes()].concat();
        missing[0] = 7;
        missing.extend_from_slice(b"{\"#\":0}");
        assert!(unpack(&deflated(&missing)).expect_err("no list").contains("list 0"));
    }
}
