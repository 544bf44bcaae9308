//! A forecast: what a chain will need, told stage by stage before anything works.

use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use toile_garment::Garment;
use toile_garment::garment::EffectRecord;

/// The size of the mesh that drape and exports will work on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeshSize {
    /// Number of triangles; an estimate, so it need not be whole.
    pub triangles: f64,
    /// Length of a mesh edge, metres.
    pub edge: f64,
}

/// Lengths along the edges of all pieces, metres. They tell how loose the cloth is: a wide hem is a long free edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeLengths {
    /// Edges that no seam takes.
    pub free: f64,
    /// The sum of the differences between both sides of all seams.
    pub gathered: f64,
}

impl MeshSize {
    /// Area of the cloth, m²: that of equilateral triangles with these edges.
    #[must_use]
    pub fn area(&self) -> f64 {
        0.25 * 3.0_f64.sqrt() * self.triangles * self.edge * self.edge
    }
}

/// The cost that a stage expects of its own work.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Cost {
    /// CPU seconds of all threads.
    pub seconds: f64,
    /// Memory that the work takes beside the program and the files read before, MB.
    #[serde(default)]
    pub mb: f64,
}

impl Cost {
    /// Work that needs next to nothing, whatever the garment.
    pub const NOTHING: Self = Self { seconds: 0.0, mb: 0.0 };

    /// A cost in seconds, with no memory worth telling.
    #[must_use]
    pub const fn seconds(seconds: f64) -> Self {
        Self { seconds, mb: 0.0 }
    }
}

/// Everything that the stages so far have told about the chain. Each stage reads it and adds what it knows.
#[derive(Clone, Debug, Default)]
pub struct Forecast {
    /// The garment as the files describe it: pieces, fabrics, body. It never holds a result of work.
    pub garment: Garment,
    /// Are the pieces or their plan not those that were asked for, because something in the files is wrong? What is
    /// asked for is looked at all the same, so that all mistakes are told at once; what follows from the whole is not.
    pub in_doubt: bool,
    /// Measures, landmarks and segments of the body whose values cannot be read. That is told already, so they count as
    /// known.
    pub unread: BTreeSet<String>,
    /// Advice on the work to come, a sentence each: `plan` tells it.
    pub advice: Vec<String>,
    /// Size of the mesh, as soon as a stage can tell it.
    pub mesh: Option<MeshSize>,
    /// Lengths along the edges of the pieces, as soon as a stage can tell them.
    pub edges: Option<EdgeLengths>,
    /// Effects that will be simulated or left out, each with its rule and its evidence.
    pub effects: Vec<EffectRecord>,
}

impl Forecast {
    /// The cost of work that grows with the mesh: seconds whatever the size, then seconds and MB for 1000 triangles. It is
    /// `None` while no stage has told the size of the mesh.
    #[must_use]
    pub fn by_triangles(&self, fixed: f64, seconds: f64, mb: f64) -> Option<Cost> {
        let thousands = self.mesh?.triangles * 1e-3;
        Some(Cost { seconds: fixed + seconds * thousands, mb: mb * thousands })
    }

    /// The number of triangles of the body over 1000; 0 without a body.
    #[must_use]
    pub fn body_thousands(&self) -> f64 {
        self.garment.body.as_ref().map_or(0.0, |body| body.triangles.len() as f64 * 1e-3)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cost_grows_with_the_mesh_and_nothing_is_said_without_one() {
        let mut forecast = Forecast::default();
        assert_eq!(forecast.by_triangles(0.25, 0.5, 2.0), None);
        forecast.mesh = Some(MeshSize { triangles: 4000.0, edge: 0.01 });
        assert_eq!(forecast.by_triangles(0.25, 0.5, 2.0), Some(Cost { seconds: 2.25, mb: 8.0 }));
        // A square metre in triangles of 1 cm.
        let square = MeshSize { triangles: 23_094.010_767_585_03, edge: 0.01 };
        assert!((square.area() - 1.0).abs() < 1e-12);
    }
}
