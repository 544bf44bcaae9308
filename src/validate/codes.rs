//! Codes of the findings of validations.

use toile_garment::Code;

codes! {
    pub(crate) list CODES;

    /// A line of a table of measured drapes cannot be read. The table is a CSV file with a head; it needs the columns
    /// `fabric` and `dc_percent`.
    CAPTURES = "captures";

    /// A column of a table of measured drapes is not used. Columns that are used: `fabric`, `face`, `dc_percent`,
    /// `rim_z_mean_mm`, `areal_mass_gsm`.
    CAPTURES_COLUMN = "captures-column";
}
