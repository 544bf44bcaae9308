//! Codes of running a chain.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// Files of the cache are not what was written there. They were removed and not used, so the result is right. Look
    /// at the disk that holds the cache.
    CACHE_DAMAGED = "cache-damaged";

    /// A result could not be put into the cache: the disk is full, or there are no rights. The run itself is whole.
    CACHE_NOT_WRITTEN = "cache-not-written";

    /// The drape was computed and written, but a figure of its certificate is beyond its limit, so the result should
    /// not be relied on. Exit code 1. `certificate` in run.json holds each figure and `limits` what was asked.
    /// Crossings often come from pieces placed inside the body; large strain from a garment too small for the body or a
    /// wrong unit.
    CERTIFICATE_FAILED = "certificate-failed";

    /// With --force the outputs of an earlier run go before the work begins. This one was changed since that run wrote
    /// it, so it stays. It does not belong to the new run.
    EARLIER_OUTPUT_CHANGED = "earlier-output-changed";

    /// A mistake of the program itself, caught before it could damage anything. Exit code 5. Please report it with the
    /// pipeline and the message.
    INTERNAL_ERROR = "internal-error";

    /// Something is larger than the program takes on; the message names the limit. Exit code 3.
    LIMIT = "limit";

    /// The run is foreseen to need more time or memory than it may, or it turned out so and was stopped. The message tells
    /// the forecast and the limit; --max-seconds and --max-memory set them. Exit code 5.
    OVER_LIMIT = "over-limit";

    /// Two outputs of one run have the same name (upper and lower case are not told apart). Give each its own.
    OUTPUTS_COLLIDE = "outputs-collide";

    /// The solver did not converge or became unstable. Exit code 4.
    UNSTABLE = "unstable";

    /// The file is right, but the program cannot do this yet. Exit code 3.
    UNSUPPORTED = "unsupported";
}
