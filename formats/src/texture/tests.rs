use super::*;
use crate::sample;

fn jpeg() -> Vec<u8> {
    let mut bytes = Vec::new();
    let pixels = image::RgbImage::from_fn(16, 8, |x, y| image::Rgb([(x * 15) as u8, (y * 30) as u8, 90]));
    pixels.write_to(&mut Cursor::new(&mut bytes), ImageFormat::Jpeg).expect("encode");
    bytes
}

/// Puts a chunk after the header of a PNG; its check sum is not looked at by the stripper.
fn with_chunk(png: &[u8], kind: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let mut out = png[..33].to_vec();
    out.extend_from_slice(&(data.len() as u32).to_be_bytes());
    out.extend_from_slice(kind);
    out.extend_from_slice(data);
    out.extend_from_slice(&[0; 4]);
    out.extend_from_slice(&png[33..]);
    out
}

#[test]
fn keeps_the_encoded_picture() {
    let png = sample::png();
    let read = read_image(&png.bytes, "check.png").expect("PNG");
    assert_eq!((read.width, read.height, read.mime.as_str()), (8, 8, "image/png"));
    assert_eq!(read.bytes, png.bytes);
    let read = read_image(&jpeg(), "check.jpg").expect("JPEG");
    assert_eq!((read.width, read.height, read.mime.as_str()), (16, 8, "image/jpeg"));
}

#[test]
fn cuts_out_texts_times_and_profiles() {
    let png = sample::png();
    for kind in [b"tEXt", b"zTXt", b"iTXt", b"tIME", b"iCCP", b"eXIf"] {
        let read = read_image(&with_chunk(&png.bytes, kind, b"Author\0anna 2024-01-01"), "c.png").expect("PNG");
        assert_eq!(read.bytes, png.bytes);
    }
    let plain = jpeg();
    let mut camera = plain[..2].to_vec();
    camera.extend_from_slice(&[0xff, 0xe1, 0, 6, b'E', b'x', b'i', b'f', 0xff, 0xfe, 0, 4, b'h', b'i']);
    camera.extend_from_slice(&plain[2..]);
    assert_eq!(read_image(&camera, "c.jpg").expect("JPEG").bytes, plain);
}

/// The checksum of a PNG's chunk.
fn checksum(bytes: &[u8]) -> u32 {
    let bit = |sum: u32| if sum & 1 == 1 { (sum >> 1) ^ 0xedb8_8320 } else { sum >> 1 };
    !bytes.iter().fold(u32::MAX, |sum, byte| (0..8).fold(sum ^ u32::from(*byte), |sum, _| bit(sum)))
}

/// A sound header of many pixels is refused by its number of pixels, before any is decoded.
#[test]
fn a_small_file_of_many_pixels_is_refused() {
    for side in [8193_u32, 16_384] {
        let mut huge = sample::png().bytes;
        huge[16..20].copy_from_slice(&side.to_be_bytes());
        huge[20..24].copy_from_slice(&side.to_be_bytes());
        let sum = checksum(&huge[12..29]);
        huge[29..33].copy_from_slice(&sum.to_be_bytes());
        let refused = read_image(&huge, "c.png").expect_err("refused");
        assert_eq!(refused.code.as_str(), "image-size", "{}", refused.message);
        assert!(refused.message.contains("at most 64"), "{}", refused.message);
    }
}

#[test]
fn refuses_bombs_and_broken_files() {
    let png = sample::png().bytes;
    for (side, code) in [(100_000u32, "image"), (0, "image"), (0x7fff_ffff, "image")] {
        let mut huge = png.clone();
        huge[16..20].copy_from_slice(&side.to_be_bytes());
        huge[20..24].copy_from_slice(&side.to_be_bytes());
        assert!(read_image(&huge, "c.png").expect_err("refused").code.starts_with(code));
    }
    for bytes in [&b"GIF89a"[..], b"", b"\x89PNG\r\n\x1a\n", &[0xff, 0xd8, 0xff], &[0xff, 0xd8, 0xff, 0xff, 0xff]] {
        assert!(read_image(bytes, "c").is_err());
    }
    for whole in [&png, &jpeg()] {
        for n in 0..whole.len() - 2 {
            if let Ok(read) = read_image(&whole[..n], "c") {
                // A JPEG may miss its last rows and still be a picture for the decoder.
                assert_eq!(read.mime, "image/jpeg");
            }
        }
    }
}
