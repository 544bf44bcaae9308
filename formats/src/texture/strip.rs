//! Cuts out what is no picture: PNG chunks and JPEG segments, without decoding.

/// PNG chunks that belong to the picture.
const KEEP: [&[u8; 4]; 11] =
    [b"IHDR", b"PLTE", b"IDAT", b"IEND", b"tRNS", b"gAMA", b"cHRM", b"sRGB", b"pHYs", b"sBIT", b"bKGD"];

/// A PNG with the chunks of [`KEEP`] alone; everything after its end is dropped.
pub fn png(bytes: &[u8]) -> Result<Vec<u8>, &'static str> {
    let mut out = bytes.get(..8).ok_or("it is cut off")?.to_vec();
    let mut at = 8usize;
    loop {
        let head = bytes.get(at..at.saturating_add(8)).ok_or("it is cut off")?;
        let length = head.iter().take(4).fold(0usize, |n, b| n << 8 | usize::from(*b));
        let end = at.checked_add(12).and_then(|n| n.checked_add(length)).ok_or("a chunk is too long")?;
        let chunk = bytes.get(at..end).ok_or("it is cut off")?;
        let kind = &head[4..8];
        if KEEP.iter().any(|k| k.as_slice() == kind) {
            out.extend_from_slice(chunk);
        } else if kind.first().is_some_and(u8::is_ascii_uppercase) {
            return Err("it has an unknown critical chunk");
        }
        if kind == b"IEND" {
            return Ok(out);
        }
        at = end;
    }
}

/// A JPEG without comments and application data other than JFIF (APP0) and Adobe's colour mark (APP14).
pub fn jpeg(bytes: &[u8]) -> Result<Vec<u8>, &'static str> {
    let mut out = bytes.get(..2).ok_or("it is cut off")?.to_vec();
    let mut at = 2usize;
    loop {
        let (Some(0xff), Some(&mark)) = (bytes.get(at), bytes.get(at + 1)) else { return Err("it is cut off") };
        match mark {
            // Fill bytes.
            0xff => at += 1,
            // Start of scan: the picture itself follows, to the end.
            0xda => {
                out.extend_from_slice(bytes.get(at..).unwrap_or_default());
                return Ok(out);
            }
            0xd9 => return Err("it ends before the picture"),
            0x01 | 0xd0..=0xd8 => {
                out.extend_from_slice(&[0xff, mark]);
                at += 2;
            }
            _ => {
                let (Some(hi), Some(lo)) = (bytes.get(at + 2), bytes.get(at + 3)) else { return Err("it is cut off") };
                let length = usize::from(*hi) << 8 | usize::from(*lo);
                let segment = bytes.get(at..at + 2 + length).filter(|_| length >= 2).ok_or("it is cut off")?;
                if !(matches!(mark, 0xe1..=0xed | 0xef) || mark == 0xfe) {
                    out.extend_from_slice(segment);
                }
                at += 2 + length;
            }
        }
    }
}
