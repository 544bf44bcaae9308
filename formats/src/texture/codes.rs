//! Codes of reading images.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// The image is damaged or cut short. Exit code 3.
    IMAGE_BROKEN = "image-broken";

    /// The image is neither PNG nor JPEG. Exit code 3.
    IMAGE_KIND = "image-kind";

    /// The image is larger than the limit. Exit code 3.
    IMAGE_SIZE = "image-size";
}
