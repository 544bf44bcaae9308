//! Codes of bundles.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// The run of a bundle was done again, and it ended otherwise or wrote other bytes. Exit code 1. Look first at the
    /// version of the program, which the message names.
    BUNDLE_DIFFERS = "bundle-differs";

    /// A bundle is not what its list of files says: bytes have changed, or a file is missing. Exit code 3. Ask for it
    /// again.
    BUNDLE_DAMAGED = "bundle-damaged";

    /// A file has changed since the run that is to be packed, or is gone, so the bundle would not reproduce it. Run the
    /// pipeline again, and pack that run.
    BUNDLE_INPUT_CHANGED = "bundle-input-changed";

    /// `toile bundle` was given something that is no run: the folder of a run, or its run.json. Exit code 3.
    BUNDLE_NO_RUN = "bundle-no-run";

    /// A file of the run cannot stand in a bundle under the name that the pipeline gives it, such as an absolute path.
    /// Let the pipeline take it as an input of kind path.
    BUNDLE_PATH = "bundle-path";

    /// A bundle holds something that no bundle has: a link, a path that leads out of its folder, an entry that is not
    /// in its list or larger than it says. Nothing of it was used. Exit code 3.
    BUNDLE_REFUSED = "bundle-refused";
}
