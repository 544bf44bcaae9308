//! Where a thing came from, so that a late finding can point into the input file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A place in an input file. The file is the name as the user gave it, never an absolute path.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct SourceRef {
    /// File as named in the pipeline.
    pub file: String,
    /// DXF block, or table of a TOML file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub block: Option<String>,
    /// DXF layer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub layer: Option<String>,
    /// Line, counted from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub line: Option<u64>,
    /// Column, counted from 1 (text files only).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub column: Option<u64>,
}

impl SourceRef {
    /// A place known only by its file.
    #[must_use]
    pub fn file(file: impl Into<String>) -> Self {
        Self { file: file.into(), ..Self::default() }
    }

    /// The same place with a line number.
    #[must_use]
    pub fn at_line(mut self, line: u64) -> Self {
        self.line = Some(line);
        self
    }
}

impl std::fmt::Display for SourceRef {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.file)?;
        if let Some(line) = self.line {
            write!(f, ":{line}")?;
        }
        if let Some(column) = self.column {
            write!(f, ":{column}")?;
        }
        if let Some(block) = &self.block {
            write!(f, " block {block}")?;
        }
        if let Some(layer) = &self.layer {
            write!(f, " layer {layer}")?;
        }
        Ok(())
    }
}
