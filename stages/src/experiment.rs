//! Experiments with the solver's tuned numbers and mechanisms, in builds with the feature `experiments` only.

pub use toile_cloth::experiment::{mechanism_names, number_names};

/// Environment variable that names the experiment file.
pub const VARIABLE: &str = "TOILE_EXPERIMENT";

/// Begins the experiment that the environment names, if it names one and none has begun. A file that cannot be used ends the
/// process with exit code 2.
#[allow(clippy::print_stderr)]
pub fn begin_from_environment() {
    static BEGUN: std::sync::Once = std::sync::Once::new();
    BEGUN.call_once(|| {
        let Some(path) = std::env::var_os(VARIABLE) else { return };
        let text = std::fs::read_to_string(&path).map_err(|e| e.to_string());
        if let Err(what) = text.and_then(|text| toile_cloth::experiment::begin(&text)) {
            eprintln!("error: experiment {}: {what}", path.display());
            std::process::exit(2);
        }
    });
}
