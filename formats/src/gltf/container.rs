//! The GLB container: header and chunks, all lengths checked.

use super::{MAX_BYTES, ReadError};

const JSON: [u8; 4] = *b"JSON";
const BIN: [u8; 4] = *b"BIN\0";

/// The chunks of a GLB.
pub struct Chunks<'a> {
    pub json: &'a [u8],
    pub bin: Option<&'a [u8]>,
}

/// Splits a GLB.
pub fn split(bytes: &[u8]) -> Result<Chunks<'_>, ReadError> {
    let bad = |what: String| Err(ReadError::Container(what));
    if bytes.len() > MAX_BYTES {
        return bad(format!("{} bytes, over the limit of {MAX_BYTES}", bytes.len()));
    }
    if bytes.get(..4) != Some(b"glTF".as_slice()) {
        return bad("it does not start with `glTF`".to_owned());
    }
    let (Some(version), Some(length)) = (word(bytes, 4), word(bytes, 8)) else {
        return bad(format!("only {} bytes", bytes.len()));
    };
    if version != 2 {
        return bad(format!("container version {version}, expected 2"));
    }
    if length != bytes.len() {
        return bad(format!("the header says {length} bytes, the file has {}", bytes.len()));
    }
    let (mut at, mut json, mut bin) = (12, None, None);
    while at < bytes.len() {
        let (Some(n), Some(kind)) = (word(bytes, at), bytes.get(at + 4..at + 8)) else {
            return bad(format!("a chunk header at byte {at} is cut off"));
        };
        let Some(body) = at.checked_add(8).and_then(|s| bytes.get(s..s.checked_add(n)?)) else {
            return bad(format!("the chunk at byte {at} of {n} bytes runs past the end"));
        };
        match (kind == JSON, kind == BIN, json, bin) {
            (true, _, None, None) if at == 12 => json = Some(body),
            (_, true, Some(_), None) => bin = Some(body),
            (true, ..) => return bad("the JSON chunk stands twice or not first".to_owned()),
            (_, true, ..) => return bad("the binary chunk stands twice or before the JSON".to_owned()),
            // Chunks of other kinds are allowed and skipped.
            _ => {}
        }
        at += 8 + n;
    }
    match json {
        Some(json) => Ok(Chunks { json, bin }),
        None => bad("it has no JSON chunk".to_owned()),
    }
}

fn word(bytes: &[u8], at: usize) -> Option<usize> {
    let four: [u8; 4] = bytes.get(at..at.checked_add(4)?)?.try_into().ok()?;
    usize::try_from(u32::from_le_bytes(four)).ok()
}

/// Joins chunks into a GLB; `None` when it would pass 4 GiB.
pub fn join(json: &[u8], bin: &[u8]) -> Option<Vec<u8>> {
    let padded = |n: usize| n.checked_next_multiple_of(4);
    let (nj, nb) = (padded(json.len())?, padded(bin.len())?);
    let total = 12usize.checked_add(8)?.checked_add(nj)?.checked_add(8)?.checked_add(nb)?;
    let mut out = Vec::with_capacity(total);
    out.extend_from_slice(b"glTF");
    for n in [2, u32::try_from(total).ok()?, u32::try_from(nj).ok()?] {
        out.extend_from_slice(&n.to_le_bytes());
    }
    out.extend_from_slice(&JSON);
    out.extend_from_slice(json);
    out.resize(20 + nj, b' ');
    out.extend_from_slice(&u32::try_from(nb).ok()?.to_le_bytes());
    out.extend_from_slice(&BIN);
    out.extend_from_slice(bin);
    out.resize(total, 0);
    Some(out)
}
