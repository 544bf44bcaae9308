//! The scene that the solver is given, as plain arrays.

pub mod bending;
pub mod contact_filter;
pub mod curve;
pub(crate) mod elements;
pub mod lines;
pub(crate) mod measures;
pub mod settings;
pub(crate) mod shared_body;
pub(crate) mod topology;
pub(crate) mod validate;
pub mod weld;

use crate::{Band, Bending, ContactFilter, Curve, Elements, FoldLine, SharedBody, Vec3};

/// A fabric as the solver needs it.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Areal mass, kg/m².
    pub areal_mass: f64,
    /// Thickness, m.
    pub thickness: f64,
    /// Coulomb coefficient of friction, on the body and on itself.
    pub friction: f64,
    /// Tension along the warp.
    pub warp: Curve,
    /// Tension along the weft.
    pub weft: Curve,
    /// Shear stiffness G, N/m per radian: the smallest slope of `shear_curve`, where there is one.
    pub shear: f64,
    /// Measured shear force per width (N/m) over the shear angle (rad); `None`: the straight line of `shear`.
    pub shear_curve: Option<Curve>,
    /// Coupling of warp and weft: tension in one direction per strain in the other, as a fraction of the softer
    /// stiffness at rest; 0 ≤ poisson < 1.
    pub poisson: f64,
    /// Resistance to bending.
    pub bending: Bending,
    /// Constants of the bare springs of `Model::Springs`, N/m, in place of those that the laws give.
    ///
    /// The first is for edges within 22.5° of a yarn, the second for all others.
    pub springs: Option<[f64; 2]>,
    /// Largest strain allowed along [warp, weft, both bias directions]; infinite for none.
    pub strain_limit: [f64; 3],
}

/// Gravity of the Earth, m/s², under which bending lengths are given.
pub const EARTH: f64 = 9.81;
/// Peirce's bending length of a rigidity (N·m) under an areal mass (kg/m²) and gravity (m/s²), m: (B/(σ g))^⅓.
#[must_use]
pub fn bending_length(bending: f64, areal_mass: f64, gravity: f64) -> f64 {
    libm::cbrt(bending / (areal_mass * gravity))
}

impl Material {
    /// A linear fabric that is isotropic in its plane: Young modulus per width `young` (N/m), Poisson ratio, bending
    /// rigidity (N·m).
    #[must_use]
    pub fn isotropic(areal_mass: f64, young: f64, poisson: f64, bending: f64) -> Self {
        let k = young / (1.0 - poisson * poisson);
        Self {
            areal_mass,
            thickness: 5e-4,
            friction: 0.3,
            warp: Curve::Linear { stiffness: k },
            weft: Curve::Linear { stiffness: k },
            shear: young / (2.0 * (1.0 + poisson)),
            shear_curve: None,
            poisson,
            bending: Bending::isotropic(bending),
            springs: None,
            strain_limit: [f64::INFINITY; 3],
        }
    }

    /// Bending length of the softer direction, m.
    #[must_use]
    pub fn bending_length(&self) -> f64 {
        bending_length(self.bending.softer(), self.areal_mass, EARTH)
    }

    /// Share of friction in the moment of a fold of the size of the bending length, HB c/B.
    ///
    /// It is 0 for cloth that does not resist bending.
    #[must_use]
    pub fn bend_friction_share(&self) -> f64 {
        let least = self.bending.softer();
        if least > 0.0 { self.bending.friction / least * self.bending_length() } else { 0.0 }
    }

    /// Returns `true` for cloth that does not lie flat without load.
    #[must_use]
    pub fn curls(&self) -> bool {
        self.bending.rest_curvature != [0.0; 2]
    }

    /// Number of measured curves of shear and bending.
    #[must_use]
    pub fn measured_curves(&self) -> usize {
        self.bending.curve.iter().chain([&self.shear_curve]).flatten().count()
    }

    /// The same cloth without bending stiffness, for tests in which it stays flat.
    #[must_use]
    pub fn limp(self) -> Self {
        let bending = Bending { rest_curvature: self.bending.rest_curvature, ..Bending::default() };
        Self { bending, ..self }
    }
}

/// A vertex held at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pin {
    /// Vertex.
    pub vertex: u32,
    /// Place where it is held, m. A vertex that starts elsewhere is led there as fast as contact allows.
    pub at: Vec3,
}

/// A dead load on a vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    /// Vertex.
    pub vertex: u32,
    /// Force, N.
    pub force: Vec3,
}

/// A whole scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Start positions, m.
    pub positions: Vec<Vec3>,
    /// Cloth triangles.
    pub triangles: Elements,
    /// Fabrics.
    pub materials: Vec<Material>,
    /// Held vertices.
    pub pins: Vec<Pin>,
    /// Dead loads.
    pub loads: Vec<Load>,
    /// Vertex pairs to be sewn together (seams, darts, pleats).
    pub stitches: Vec<[u32; 2]>,
    /// The body, if any.
    pub body: Option<SharedBody>,
    /// Gravity, m/s².
    pub gravity: Vec3,
    /// Layer of every vertex (0 next to the body, 1 over it …); may be empty. Order is kept by the contact itself;
    /// the number only says how many thicknesses further from the body the vertex is held.
    pub layers: Vec<i32>,
    /// Parts of the body that some vertices do not meet. Sewing goes on without them. A drape ends with all of the body.
    pub contact_filter: ContactFilter,
    /// Elastic bands sewn along the cloth.
    pub bands: Vec<Band>,
    /// Folds pressed into the cloth.
    pub folds: Vec<FoldLine>,
}

impl Scene {
    /// For every vertex the first vertex of the connected cloth that it belongs to. Stitches connect nothing.
    #[must_use]
    pub fn parts(&self) -> Vec<u32> {
        topology::components(self.positions.len(), self.triangles.iter().map(|t| &t.vertices))
    }

    /// Bears the weight of some vertices by loads, so that they do not fall.
    pub fn bear_weight(&mut self, vertices: &[u32]) {
        let masses = measures::masses(self);
        let load = |v: &u32| Load { vertex: *v, force: self.gravity * -masses[*v as usize] };
        self.loads.extend(vertices.iter().map(load));
    }

    /// A scene of the vertices that `is_kept` names alone, and their numbers here. Each triangle has all of its vertices kept
    /// or none.
    pub(crate) fn only(&self, is_kept: impl Fn(u32) -> bool) -> (Self, Vec<u32>) {
        let kept: Vec<u32> = (0u32..).take(self.positions.len()).filter(|v| is_kept(*v)).collect();
        let mut number = vec![u32::MAX; self.positions.len()];
        (0u32..).zip(&kept).for_each(|(new, v)| number[*v as usize] = new);
        let own = self.triangles.iter().filter(|t| is_kept(t.vertices[0]));
        let triangles = own.map(|t| t.renumbered(|v| number[v as usize])).collect();
        (self.part(&kept, &number, triangles), kept)
    }

    /// A scene of the vertices `kept` alone, with its own triangles.
    ///
    /// `number` gives the new numbers of all vertices, `u32::MAX` for those left out. Pins, loads and stitches of these
    /// are left out, too. Bands and folds go straight over them.
    pub(crate) fn part(&self, kept: &[u32], number: &[u32], triangles: Elements) -> Self {
        let to = |v: u32| number[v as usize];
        let stays = |v: u32| to(v) != u32::MAX;
        let pins = self.pins.iter().filter(|p| stays(p.vertex)).map(|p| Pin { vertex: to(p.vertex), ..*p });
        let loads = self.loads.iter().filter(|l| stays(l.vertex)).map(|l| Load { vertex: to(l.vertex), ..*l });
        let kept_number = |v: u32| Some(to(v)).filter(|v| *v != u32::MAX);
        let layer = |v: &u32| self.layers.get(*v as usize).copied();
        Self {
            positions: kept.iter().map(|v| self.positions[*v as usize]).collect(),
            triangles,
            materials: self.materials.clone(),
            pins: pins.collect(),
            loads: loads.collect(),
            stitches: self.stitches.iter().filter(|s| s.iter().all(|v| stays(*v))).map(|s| s.map(to)).collect(),
            body: self.body.clone(),
            gravity: self.gravity,
            layers: kept.iter().filter_map(layer).collect(),
            contact_filter: self.contact_filter.part(kept),
            bands: self.bands.iter().filter_map(|b| b.renumbered(kept_number)).collect(),
            folds: self.folds.iter().filter_map(|f| f.renumbered(kept_number)).collect(),
        }
    }
}
