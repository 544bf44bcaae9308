//! Runs a chain: files through the gate, outputs whole or not at all, provenance, stopping, the record of the run.

pub(crate) mod codes;
mod earlier;
mod exit;
mod failure;
mod files;
mod foresight;
mod gate;
mod limits;
mod memory;
mod meter;
mod outputs;
mod panics;
mod preflight;
mod preview;
mod record;
mod run;
mod same;
mod stop;
mod whole;

pub use exit::{Exit, of_file_error, of_stage_error};
pub use files::{MAX_INPUT, ReadFiles, RunFiles, read_limited};
pub use foresight::{Foresight, foresee};
pub use gate::{Gate, clean, output_below, project_root};
pub use limits::{Limits, Watchdog};
pub(crate) use meter::reset_peak;
pub use meter::{Meter, peak_mb};
pub use outputs::{Outputs, Plan, RECORD_NAME};
pub use panics::{panic_text, quiet_panics};
pub use preflight::{check_paths, planned_inputs, planned_outputs};
pub use preview::{PREVIEW_NAME, Preview};
pub use record::{GarmentCounts, OutputRecord, RunRecord, StageRun};
pub use run::{Outcome, RunOptions, default_out, run};
pub use same::{is_same, known_inputs, refuse_input};
pub use stop::Stop;
pub(crate) use whole::write_whole;
