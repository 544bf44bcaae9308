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

    /// A U3M archive (.u3ma) is damaged, holds no material or several, or lacks a bitmap of its material. Export it
    /// again, or unpack it, it is a ZIP, and give the .u3m file that lies in it. Exit code 3.
    U3M_ARCHIVE = "u3m-archive";

    /// A U3M material is no JSON, has no front side, or names a bitmap without its size. Export it again. Exit code 3.
    U3M_FILE = "u3m-file";
}
