//! The one document that flows through the pipeline.

use crate::Vec3;
use crate::animation::Animation;
use crate::body::Body;
use crate::fabric::Fabric;
use crate::flat::Flat;
use crate::ids::{MeshVertex, PieceId};
use crate::piece::Piece;
use crate::provenance::Provenance;
use crate::seam::{Seam, Stitch};
use crate::sewing::SewingPlan;
use crate::texture::Textures;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A kind of content of a garment; stages declare which kinds they need and give.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Aspect {
    /// Pieces in 2D.
    Pieces,
    /// Meshes of all pieces.
    Mesh,
    /// Seams with stitches.
    Seams,
    /// Positions in 3D, placed and sewn.
    Stitched,
    /// Positions in 3D at rest, with a certificate.
    Drape,
    /// Positions in 3D, at rest or as they were sewn. No stage gives it by itself.
    Shape,
    /// Frames of a motion.
    Animation,
    /// Texture coordinates and materials.
    Texture,
    /// Flattened pieces.
    Flat,
    /// Fabric.
    Fabric,
    /// Body.
    Body,
}

impl Aspect {
    /// The aspects that this one is made from, the nearest last. A change of one of them outdates it.
    #[must_use]
    pub fn bases(self) -> &'static [Self] {
        const ORDER: [Aspect; 5] = [Aspect::Pieces, Aspect::Mesh, Aspect::Seams, Aspect::Stitched, Aspect::Drape];
        let count = match self {
            Self::Pieces | Self::Fabric | Self::Body => 0,
            Self::Mesh => 1,
            Self::Seams | Self::Texture => 2,
            Self::Stitched | Self::Shape => 3,
            Self::Drape => 4,
            Self::Animation | Self::Flat => 5,
        };
        &ORDER[..count]
    }

    /// The aspects any of which is enough where this one is needed.
    #[must_use]
    pub fn any_of(self) -> &'static [Self] {
        match self {
            Self::Shape => &[Self::Stitched, Self::Drape],
            _ => &[],
        }
    }

    /// Returns `true` if making these aspects anew outdates this one.
    #[must_use]
    pub fn is_outdated_by(self, renewed: &[Self]) -> bool {
        self.bases().iter().any(|base| renewed.contains(base))
    }
}

/// The figures of a drape with their limits, as `run.json` holds them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Certificate {
    /// All gates held?
    pub passed: bool,
    /// Did the solve reach its stop, and not a cap?
    pub settled: bool,
    /// Largest net force on a free particle over the mean particle weight.
    pub residual_rel: f64,
    /// Elastic energy, J.
    #[serde(rename = "energy_J")]
    pub energy_j: f64,
    /// 95th percentile of the edge strain.
    pub strain_p95: f64,
    /// Largest strain along warp or weft.
    pub strain_max: f64,
    /// Largest strain along warp, weft or bias over the fabric's limit of that direction (1 = at the limit).
    #[serde(default)]
    pub strain_over_limit: f64,
    /// Strain that a garment may have along warp or weft: the fabric's limit and the margin of the gate.
    #[serde(default)]
    pub strain_gate: f64,
    /// How far the top of a sewn garment that nothing holds sank while it came to rest on its body, mm.
    #[serde(default)]
    pub slip_mm: f64,
    /// Pieces that nothing holds. They stay where they were sewn, and the certificate does not pass.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub unheld: Vec<String>,
    /// Largest gap of a sewn pair, mm.
    pub seam_gap_max_mm: f64,
    /// Largest gap of a dart pair, mm.
    pub dart_gap_max_mm: f64,
    /// Intersecting triangle pairs of the cloth, exact.
    pub self_crossings: u64,
    /// Intersecting pairs of cloth and body triangles, exact.
    pub body_crossings: u64,
    /// Deepest cloth vertex inside the body, mm.
    pub penetration_max_mm: f64,
    /// Limits by figure name.
    pub limits: std::collections::BTreeMap<String, f64>,
    /// Elastic bands as they came to rest.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub bands: Vec<BandAtRest>,
    /// Pressed folds as they came to rest.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub folds: Vec<FoldAtRest>,
    /// How far apart the rests from shaken starts lie, where it was asked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rests: Option<Rests>,
}

impl Certificate {
    /// The certificate of a garment of which nothing holds some pieces.
    #[must_use]
    pub fn with_unheld(self, unheld: Vec<String>) -> Self {
        Self { passed: self.passed && unheld.is_empty(), unheld, ..self }
    }
}

/// An elastic band at rest.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BandAtRest {
    /// Name.
    pub name: String,
    /// Its length before it is stretched, mm.
    pub unstretched_mm: f64,
    /// Its length on the garment, mm.
    pub length_mm: f64,
    /// Mean tension, N.
    #[serde(rename = "tension_N")]
    pub tension_n: f64,
}

/// A pressed fold at rest. The angles are those by which the cloth is folded back from flat.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FoldAtRest {
    /// Piece and name of the fold.
    pub name: String,
    /// Pressed angle, degrees.
    pub pressed_deg: f64,
    /// Mean angle on the garment, degrees.
    pub mean_deg: f64,
    /// Least angle on the garment, as a share of the pressed one.
    pub least_share: f64,
}

/// Rests of the same cloth from starts that differ by next to nothing, measured against the first.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Rests {
    /// How many further rests there are.
    pub repeats: u32,
    /// How many of them reached their stop.
    pub settled: u32,
    /// Largest move of a start along each axis, mm.
    pub shake_mm: f64,
    /// Median distance of a vertex from its first rest, mm.
    pub apart_median_mm: f64,
    /// 95th percentile of the distance, mm.
    pub apart_p95_mm: f64,
    /// Largest distance, mm.
    pub apart_max_mm: f64,
}

/// An effect of the simulation and why it was on or off.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct EffectRecord {
    /// Name, e.g. `self-collision`.
    pub name: String,
    /// Was it on?
    pub on: bool,
    /// The rule that decided.
    pub rule: String,
    /// The evidence.
    pub evidence: String,
    /// CPU seconds it cost; only ever written to `run.json`.
    #[serde(default)]
    pub cpu_seconds: f64,
}

/// Positions in 3D.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Shape {
    /// Per piece, per mesh vertex, metres. Sewn vertices that were welded hold bit-equal positions.
    #[schemars(with = "Vec<Vec<[f64; 3]>>")]
    pub positions: Vec<Vec<Vec3>>,
    /// Were the stitches closed as far as they would?
    #[serde(default)]
    pub sewn: bool,
    /// Are all stitches closed and welded?
    pub welded: bool,
    /// Parts of the body that pieces did not meet on the way to this shape, by the names of the pieces.
    #[serde(default, skip_serializing_if = "std::collections::BTreeMap::is_empty")]
    pub ignores: std::collections::BTreeMap<String, Vec<String>>,
}

/// Pieces, seams, fabric, body and everything the stages add.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Garment {
    /// Style name.
    #[serde(default)]
    pub style: String,
    /// Size label that was chosen.
    #[serde(default)]
    pub size: Option<String>,
    /// Pieces; `pieces[i].id == i`.
    pub pieces: Vec<Piece>,
    /// The declarations of the sewing file.
    #[serde(default)]
    pub plan: SewingPlan,
    /// Seams and darts as sewn; filled by `assemble`.
    #[serde(default)]
    pub seams: Vec<Seam>,
    /// Fabric, by material name; the entry `""` is the default.
    #[serde(default)]
    pub fabrics: std::collections::BTreeMap<String, Fabric>,
    /// Body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body: Option<Body>,
    /// Particles held in place (import-mesh, attachments): vertex and where it is held.
    #[serde(default)]
    pub pins: Vec<Pin>,
    /// Elastic bands on the meshes; filled by `assemble` and `stitch`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub bands: Vec<ElasticBand>,
    /// Forces on particles (import-mesh).
    #[serde(default)]
    pub loads: Vec<Load>,
    /// Placed and sewn shape; filled by `stitch`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stitched: Option<Shape>,
    /// Shape at rest; filled by `drape`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drape: Option<Shape>,
    /// Shape before a 3D edit, when the drape was edited afterwards: the flattening carries its metric.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drape_before_edit: Option<Shape>,
    /// Reaction force on every pin, N; filled by `drape`.
    #[serde(default)]
    #[schemars(with = "Vec<[f64; 3]>")]
    pub reactions: Vec<Vec3>,
    /// Certificate of the drape.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub certificate: Option<Certificate>,
    /// Effects of the drape.
    #[serde(default)]
    pub effects: Vec<EffectRecord>,
    /// The garment in motion; filled by `animate`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub animation: Option<Animation>,
    /// Textures; filled by `texture`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub textures: Option<Textures>,
    /// Flattened pieces; filled by `flatten`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub flat: Option<Flat>,
    /// Vertical axis of the mesh files the garment came from (import-mesh); mesh exports turn back to it.
    #[serde(default, skip_serializing_if = "UpAxis::is_y")]
    pub file_up: UpAxis,
    /// History; filled by the engine.
    #[serde(default)]
    pub provenance: Provenance,
}

/// Vertical axis of a mesh file. Inside, +y is up, always.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum UpAxis {
    /// +y up, +z front.
    #[default]
    Y,
    /// +z up, −y front.
    Z,
}

impl UpAxis {
    /// True for +y.
    #[must_use]
    pub fn is_y(&self) -> bool {
        *self == Self::Y
    }

    /// A point or vector of such a file in the world of the program.
    #[must_use]
    pub fn from_file(self, p: Vec3) -> Vec3 {
        match self {
            Self::Y => p,
            Self::Z => Vec3::new(p.x, p.z, -p.y),
        }
    }

    /// A point or vector of the world as such a file holds it; the exact reverse of [`Self::from_file`].
    #[must_use]
    pub fn to_file(self, p: Vec3) -> Vec3 {
        match self {
            Self::Y => p,
            Self::Z => Vec3::new(p.x, -p.z, p.y),
        }
    }
}

/// A held particle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Pin {
    /// Which.
    pub vertex: MeshVertex,
    /// Where, metres.
    #[schemars(with = "[f64; 3]")]
    pub at: Vec3,
}

/// An elastic band on the meshes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ElasticBand {
    /// Name.
    pub name: String,
    /// Vertices along it, one for each point that is sewn.
    pub vertices: Vec<MeshVertex>,
    /// Length of the unstretched band from each vertex to the next, metres. A closed band has as many as vertices.
    pub rest: Vec<f64>,
    /// Tension per strain, N.
    pub stretch: f64,
}

impl ElasticBand {
    /// A band without vertices, as strong as elastic of a waist.
    #[must_use]
    pub fn named(name: &str) -> Self {
        Self { name: name.to_owned(), vertices: Vec::new(), rest: Vec::new(), stretch: crate::sewing::BAND_STRETCH }
    }
}

/// A force on a particle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Load {
    /// Which.
    pub vertex: MeshVertex,
    /// Force, N.
    #[schemars(with = "[f64; 3]")]
    pub force: Vec3,
}

impl Garment {
    /// The seam with the widest stitch among those for which `is_meant` is true, and its gap: the vertices lie at
    /// `positions`, piece by piece.
    pub fn widest_gap(&self, positions: &[Vec<Vec3>], is_meant: impl Fn(&Seam) -> bool) -> Option<(&Seam, f64)> {
        let at = |v: MeshVertex| positions.get(v.piece.index())?.get(v.vertex as usize).copied();
        let gap = |s: &Stitch| Some((at(s.a)? - at(s.b)?).norm());
        let widest = |seam: &Seam| seam.stitches.iter().filter_map(gap).fold(0.0, f64::max);
        let seams = self.seams.iter().filter(|seam| is_meant(seam)).map(|seam| (seam, widest(seam)));
        seams.max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Does the garment hold this aspect?
    #[must_use]
    pub fn has(&self, aspect: Aspect) -> bool {
        match aspect {
            Aspect::Pieces => !self.pieces.is_empty(),
            Aspect::Mesh => !self.pieces.is_empty() && self.pieces.iter().all(|p| p.mesh.is_some()),
            Aspect::Seams => !self.seams.is_empty(),
            Aspect::Stitched => self.stitched.is_some(),
            Aspect::Drape => self.drape.is_some(),
            Aspect::Shape => aspect.any_of().iter().any(|a| self.has(*a)),
            Aspect::Animation => self.animation.is_some(),
            Aspect::Texture => self.textures.is_some(),
            Aspect::Flat => self.flat.is_some(),
            Aspect::Fabric => !self.fabrics.is_empty(),
            Aspect::Body => self.body.is_some(),
        }
    }

    /// Removes what becomes outdated when these aspects are made anew. Its vertices would be those of another mesh.
    pub fn forget_outdated(&mut self, renewed: &[Aspect]) {
        let gone = |aspect: Aspect| aspect.is_outdated_by(renewed);
        if gone(Aspect::Mesh) {
            self.pieces.iter_mut().for_each(|piece| piece.mesh = None);
        }
        if gone(Aspect::Seams) {
            (self.seams, self.bands, self.pins, self.loads) = Default::default();
        }
        if gone(Aspect::Stitched) {
            self.stitched = None;
        }
        if gone(Aspect::Drape) {
            (self.drape, self.drape_before_edit, self.certificate) = Default::default();
            (self.reactions, self.effects) = Default::default();
        }
        if gone(Aspect::Animation) {
            (self.animation, self.flat) = Default::default();
        }
        if gone(Aspect::Texture) {
            self.textures = None;
        }
    }

    /// Takes a drape that no solver made: an edited shape, or one that was moved. The first shape before all such
    /// changes stays known. What was measured on the shape before is gone, its certificate above all.
    pub fn reshape(&mut self, drape: Shape) {
        let before = self.drape.replace(drape).or_else(|| self.stitched.clone());
        self.drape_before_edit = self.drape_before_edit.take().or(before);
        (self.certificate, self.reactions, self.flat) = Default::default();
    }

    /// Removes a certificate that was given for another shape: the drape differs from `before`, and its certificate
    /// does not.
    pub fn forget_stale_certificate(&mut self, before: Option<&Shape>, certificate: Option<&Certificate>) {
        let is_same = self.certificate.as_ref() == certificate;
        let is_moved = self.drape.as_ref().map(|s| &s.positions) != before.map(|s| &s.positions);
        if certificate.is_some() && is_same && is_moved {
            self.certificate = None;
        }
    }

    /// A piece by its name.
    #[must_use]
    pub fn piece_named(&self, name: &str) -> Option<PieceId> {
        self.pieces.iter().position(|p| p.name == name).map(PieceId::from)
    }

    /// Fabric of a piece: by its name, by its material, else the default.
    #[must_use]
    pub fn fabric_of(&self, piece: &Piece) -> Option<&Fabric> {
        let names = [Some(piece.name.as_str()), piece.material.as_deref(), Some("")];
        names.into_iter().flatten().find_map(|name| self.fabrics.get(name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f64) -> Shape {
        Shape { positions: vec![vec![Vec3::new(x, 0.0, 0.0)]], ..Shape::default() }
    }

    fn certified() -> Garment {
        let certificate = Certificate { passed: true, ..Certificate::default() };
        Garment { drape: Some(at(0.0)), certificate: Some(certificate), ..Garment::default() }
    }

    #[test]
    fn a_changed_shape_has_no_certificate_and_knows_the_first_shape() {
        let mut garment = certified();
        garment.reshape(at(1.0));
        garment.reshape(at(2.0));
        assert_eq!((garment.certificate, garment.drape), (None, Some(at(2.0))));
        assert_eq!(garment.drape_before_edit, Some(at(0.0)));
    }

    #[test]
    fn a_certificate_of_another_shape_is_stale_and_one_that_was_renewed_is_not() {
        let old = certified();
        let forget = |mut garment: Garment| {
            garment.forget_stale_certificate(old.drape.as_ref(), old.certificate.as_ref());
            garment.certificate.is_some()
        };
        assert!(forget(old.clone()));
        assert!(!forget(Garment { drape: Some(at(1.0)), ..old.clone() }));
        let renewed = Certificate { energy_j: 1.0, ..Certificate::default() };
        assert!(forget(Garment { drape: Some(at(1.0)), certificate: Some(renewed), ..old.clone() }));
    }
}
