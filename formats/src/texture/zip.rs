//! Files of a ZIP archive, as a material comes in (`.u3ma`): stored or deflated, neither encrypted nor split.
//!
//! An archive is read as hostile. Every place is looked up in bounds, a file is inflated to the size that it states and
//! no further, and its sum is checked.

use super::MAX_BYTES;

/// The beginning of an archive that holds a file.
pub const ARCHIVE: &[u8] = b"PK\x03\x04";
/// The beginnings of the end of the list of files, of a file in the list, and of a file.
const END: &[u8] = b"PK\x05\x06";
const LISTED: &[u8] = b"PK\x01\x02";
/// Bytes of the end without its remark, and of a file in the list and before its data without their texts.
const END_BYTES: usize = 22;
const LISTED_BYTES: usize = 46;
const LOCAL_BYTES: usize = 30;
/// Longest remark at the end of an archive.
const REMARK: usize = 0xffff;
/// Most files of an archive.
const MOST_FILES: usize = 4096;
/// Ways in which a file may lie in the archive.
const STORED: usize = 0;
const DEFLATED: usize = 8;
/// A file of this flag is encrypted.
const ENCRYPTED: usize = 1;

/// An archive.
#[derive(Clone, Debug)]
pub struct Archive {
    bytes: Vec<u8>,
    files: Vec<Listed>,
}

/// A file as the list at the end tells it.
#[derive(Clone, Debug)]
struct Listed {
    name: String,
    flags: usize,
    method: usize,
    sum: u32,
    packed: usize,
    size: usize,
    at: usize,
}

impl Archive {
    /// Reads the list of files.
    ///
    /// # Errors
    /// Words for what is wrong.
    pub fn open(bytes: Vec<u8>) -> Result<Self, String> {
        let cut_short = || "the list of its files is missing or cut short".to_owned();
        let first = bytes.len().saturating_sub(END_BYTES + REMARK);
        let last = bytes.len().saturating_sub(END_BYTES);
        let end = (first..=last).rev().find(|at| bytes.get(*at..).is_some_and(|b| b.starts_with(END)));
        let end = end.ok_or_else(cut_short)?;
        let (count, mut at) = word(&bytes, end + 10, 2).zip(word(&bytes, end + 16, 4)).ok_or_else(cut_short)?;
        if count > MOST_FILES {
            return Err(format!("it holds {count} files, over the limit of {MOST_FILES}"));
        }
        let mut files = Vec::new();
        for _ in 0..count {
            let (file, next) = listed(&bytes, at).ok_or_else(cut_short)?;
            files.push(file);
            at = next;
        }
        Ok(Self { bytes, files })
    }

    /// The names of all files, with `/` between folders.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.files.iter().map(|f| f.name.as_str())
    }

    /// The bytes of a file.
    ///
    /// # Errors
    /// Words for what is wrong.
    pub fn read(&self, name: &str) -> Result<Vec<u8>, String> {
        let file = self.files.iter().find(|f| f.name == name).ok_or_else(|| format!("it does not hold `{name}`"))?;
        let damaged = || format!("`{name}` in it is damaged");
        if file.flags & ENCRYPTED != 0 {
            return Err(format!("`{name}` in it is encrypted"));
        }
        if file.size > MAX_BYTES {
            return Err(format!("`{name}` in it has {} bytes, over the limit of {MAX_BYTES}", file.size));
        }
        let data = self.data(file).ok_or_else(damaged)?;
        let out = match file.method {
            STORED => data.to_vec(),
            DEFLATED => miniz_oxide::inflate::decompress_to_vec_with_limit(data, file.size).map_err(|_| damaged())?,
            method => return Err(format!("`{name}` in it is packed in a way that is not read (method {method})")),
        };
        (out.len() == file.size && sum(&out) == file.sum).then_some(out).ok_or_else(damaged)
    }

    /// The data of a file, which follow its own head.
    fn data(&self, file: &Listed) -> Option<&[u8]> {
        let head = self.bytes.get(file.at..).filter(|b| b.starts_with(ARCHIVE))?;
        let texts = word(head, 26, 2)? + word(head, 28, 2)?;
        head.get(LOCAL_BYTES + texts..)?.get(..file.packed)
    }
}

/// A file in the list, and the place of the next one.
fn listed(bytes: &[u8], at: usize) -> Option<(Listed, usize)> {
    let head = bytes.get(at..).filter(|b| b.starts_with(LISTED))?;
    let [name, more, remark] = [word(head, 28, 2)?, word(head, 30, 2)?, word(head, 32, 2)?];
    let text = head.get(LISTED_BYTES..LISTED_BYTES + name)?;
    let file = Listed {
        name: String::from_utf8_lossy(text).replace('\\', "/"),
        flags: word(head, 8, 2)?,
        method: word(head, 10, 2)?,
        sum: u32::try_from(word(head, 16, 4)?).ok()?,
        packed: word(head, 20, 4)?,
        size: word(head, 24, 4)?,
        at: word(head, 42, 4)?,
    };
    Some((file, at + LISTED_BYTES + name + more + remark))
}

/// A whole number of 2 or 4 bytes, the lowest first.
fn word(bytes: &[u8], at: usize, count: usize) -> Option<usize> {
    let bytes = bytes.get(at..at.checked_add(count)?)?;
    Some(bytes.iter().rev().fold(0, |sum, b| sum << 8 | usize::from(*b)))
}

/// The sum of a file (CRC-32).
fn sum(bytes: &[u8]) -> u32 {
    let step = |crc: u32, byte: &u8| {
        let index = usize::from((crc ^ u32::from(*byte)) as u8);
        crc >> 8 ^ TABLE.get(index).copied().unwrap_or_default()
    };
    !bytes.iter().fold(!0, step)
}

const TABLE: [u32; 256] = table();

#[allow(clippy::indexing_slicing)]
const fn table() -> [u32; 256] {
    let mut table = [0; 256];
    let mut k = 0;
    while k < 256 {
        let (mut crc, mut bit) = (k as u32, 0);
        while bit < 8 {
            crc = if crc & 1 == 1 { crc >> 1 ^ 0xedb8_8320 } else { crc >> 1 };
            bit += 1;
        }
        table[k] = crc;
        k += 1;
    }
    table
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// An archive of these files; every second one is deflated.
    pub fn archive(files: &[(&str, &[u8])]) -> Vec<u8> {
        let (mut out, mut list) = (Vec::new(), Vec::new());
        for (k, (name, data)) in files.iter().enumerate() {
            let packed = if k % 2 == 0 { data.to_vec() } else { miniz_oxide::deflate::compress_to_vec(data, 6) };
            let method = if k % 2 == 0 { STORED } else { DEFLATED };
            let mut head = Vec::new();
            let mut put = |n: usize, count: usize| head.extend_from_slice(&n.to_le_bytes()[..count]);
            let first = [(20, 2), (0, 2), (method, 2), (0, 4), (sum(data) as usize, 4)];
            let second = [(packed.len(), 4), (data.len(), 4), (name.len(), 2), (0, 2)];
            first.into_iter().chain(second).for_each(|(n, count)| put(n, count));
            list.extend_from_slice(&[LISTED, &[20, 0], &head, &[0; 10], &(out.len() as u32).to_le_bytes()].concat());
            list.extend_from_slice(name.as_bytes());
            out.extend_from_slice(&[ARCHIVE, &head, name.as_bytes(), &packed].concat());
        }
        let (at, count) = (out.len() as u32, files.len() as u16);
        out.extend_from_slice(&list);
        out.extend_from_slice(END);
        out.extend_from_slice(&[[0; 4].as_slice(), &count.to_le_bytes(), &count.to_le_bytes()].concat());
        out.extend_from_slice(&[&(list.len() as u32).to_le_bytes(), &at.to_le_bytes(), [0; 2].as_slice()].concat());
        out
    }

    #[test]
    fn files_are_read_whether_they_are_stored_or_deflated() {
        assert_eq!(sum(b"123456789"), 0xcbf4_3926);
        let long = b"warp and weft ".repeat(200);
        let archive = Archive::open(archive(&[("a.u3m", b"{}"), ("maps/base.png", &long)])).expect("an archive");
        assert_eq!(archive.names().collect::<Vec<_>>(), ["a.u3m", "maps/base.png"]);
        assert_eq!((archive.read("a.u3m"), archive.read("maps/base.png")), (Ok(b"{}".to_vec()), Ok(long)));
        assert!(archive.read("b").is_err_and(|why| why.contains("does not hold `b`")));
    }

    #[test]
    fn damaged_archives_are_refused_and_nothing_panics() {
        let long = b"warp and weft ".repeat(20);
        let whole = archive(&[("a.u3m", b"{}"), ("base.png", &long)]);
        for cut in 0..whole.len() {
            assert!(Archive::open(whole[..cut].to_vec()).is_err(), "cut at {cut}");
        }
        let mut read = 0;
        for at in 0..whole.len() {
            let mut changed = whole.clone();
            changed[at] ^= 0x5a;
            let names = ["a.u3m", "base.png"];
            let all = Archive::open(changed).is_ok_and(|a| names.iter().all(|n| a.read(n).is_ok()));
            read += usize::from(all);
        }
        // What stands twice, times and other fields that nothing depends on.
        assert!(read < whole.len() / 2, "{read} of {}", whole.len());
    }
}
