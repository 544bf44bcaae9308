//! Codes of stages in other processes.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// The program of a plugin has another content than the pipeline (`content`) or `--allow-run NAME=CONTENT` states. See
    /// what changed in it before you write the new content, which the message tells. Exit code 2.
    PLUGIN_CHANGED = "plugin-changed";

    /// The program behind a plugin's stage ended with an error, took too long or wrote too much. What it said on stderr
    /// is in the message.
    PLUGIN_FAILED = "plugin-failed";

    /// The program behind a plugin's stage told more findings than are taken from one stage. The rest was left out.
    PLUGIN_FINDINGS_LEFT_OUT = "plugin-findings-left-out";

    /// A pipeline names a program of its own. It is never run on the word of a file alone: if you trust it, pass
    /// `--allow-run NAME`, or `--allow-run NAME=CONTENT` to trust this content alone. The content is a digest of the
    /// program and of the files that its command names. Exit code 2.
    PLUGIN_NEEDS_CONSENT = "plugin-needs-consent";

    /// The program behind a plugin does not keep to protocol 1. Run it by hand with the argument `describe`; see
    /// `external` in ARCHITECTURE.md.
    PLUGIN_PROTOCOL = "plugin-protocol";

    /// The program behind a plugin's stage did not accept the garment.
    PLUGIN_REJECTED = "plugin-rejected";
}
