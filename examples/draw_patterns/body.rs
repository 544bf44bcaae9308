//! Body measures the samples are drafted from, millimetres (ISO 8559-1 names).

/// Measures of one size; heights and shoulders are the same in all three.
#[derive(Clone, Copy, Debug)]
pub struct Measures {
    /// Size label.
    pub size: &'static str,
    /// Bust girth.
    pub bust: f64,
    /// Waist girth.
    pub waist: f64,
    /// Hip girth.
    pub hip: f64,
    /// Neck girth.
    pub neck: f64,
    /// Upper arm girth.
    pub upper_arm: f64,
}

/// Height of the waist above the floor.
pub const WAIST_HEIGHT: f64 = 1050.0;
/// Height of the hip.
pub const HIP_HEIGHT: f64 = 840.0;
/// Slope of the shoulder, degrees.
pub const SHOULDER_SLOPE: f64 = 21.0;

/// Base size of the nests.
pub const SAMPLE_SIZE: &str = "38";

/// The sizes of the committed nests.
pub const SIZES: [Measures; 3] = [RUN[1], RUN[2], RUN[3]];

/// All sizes that can be drawn.
pub const RUN: [Measures; 5] = [
    Measures { size: "34", bust: 800.0, waist: 620.0, hip: 880.0, neck: 340.0, upper_arm: 260.0 },
    Measures { size: "36", bust: 840.0, waist: 660.0, hip: 920.0, neck: 350.0, upper_arm: 270.0 },
    Measures { size: "38", bust: 880.0, waist: 700.0, hip: 960.0, neck: 360.0, upper_arm: 280.0 },
    Measures { size: "40", bust: 920.0, waist: 740.0, hip: 1000.0, neck: 370.0, upper_arm: 290.0 },
    Measures { size: "42", bust: 960.0, waist: 780.0, hip: 1040.0, neck: 378.0, upper_arm: 303.0 },
];
