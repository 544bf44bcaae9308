//! The certificate of a result, computed afresh from the positions.

use crate::collision::body::Body;
use crate::collision::crossings::count;
use crate::energy::coupled::Coupled;
use crate::energy::elastic;
use crate::energy::model::model;
use crate::prepare::canonical_frame::CanonicalScene;
use crate::prepare::initial_feasibility::repair;
use crate::scene::measures::masses;
use crate::scene::topology::Topology;
use crate::scene::validate;
use crate::{ClothError, ContactFilter, Place, Scene, Settings, Vec3};

/// Largest distance to the body that is measured, m.
const BODY_DISTANCE_REACH: f64 = 0.05;
/// Largest depth inside the body that is measured, m.
const DEPTH_REACH: f64 = 1.0;

/// Figures of a state.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figures {
    /// Elastic energy, J.
    pub energy: f64,
    /// Strain along warp and weft that 95 % of the triangles do not exceed.
    pub strain_p95: f64,
    /// Largest strain along warp or weft.
    pub strain_max: f64,
    /// Largest strain along warp, weft or bias over the strain limit of that direction (1 = at the limit).
    pub strain_over_limit: f64,
    /// The triangle with the largest strain over its limit, and its strains; `None` where nothing is stretched.
    pub tightest: Option<Tightest>,
    /// Largest elongation of a mesh edge.
    pub edge_strain_max: f64,
    /// Largest shear angle, rad.
    pub shear_max: f64,
    /// Intersecting pairs of cloth triangles, by exact predicates.
    pub self_crossings: usize,
    /// Intersecting pairs of a cloth and a body triangle.
    pub body_crossings: usize,
    /// A triangle of the first crossing, if any.
    pub first_crossing: Option<u32>,
    /// Deepest cloth point inside the body, m.
    pub penetration_max: f64,
    /// Smallest distance of a cloth vertex to the body, m (infinite without a body).
    pub body_distance_min: f64,
}

/// Strains of one triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tightest {
    /// Where it is.
    pub place: Place,
    /// Strain along the warp.
    pub warp: f64,
    /// Strain along the weft.
    pub weft: f64,
    /// Strain along the bias direction that is stretched more.
    pub bias: f64,
}

/// Computes the figures of `positions`. Crossings are counted on the numbers given: round them to `f32` first when that
/// is what will be stored. Net forces are not among them, because a rounding of 0.1 µm changes them; the outcome has
/// them.
///
/// # Errors
/// When the scene or a setting is unusable.
pub fn certify(scene: &Scene, settings: &Settings, positions: &[Vec3]) -> Result<Figures, ClothError> {
    validate::scene(scene)?;
    // The frame is that of the drape: the trees over the body are the same, and so are the figures of a turned scene.
    let mut canonical = CanonicalScene::of(scene);
    canonical.scene.positions = canonical.told(positions);
    canonical.scene.contact_filter = ContactFilter::default();
    let mut figures = figures(&canonical.scene, settings)?;
    if let Some(t) = &mut figures.tightest {
        t.place.at = canonical.there(t.place.at);
    }
    Ok(figures)
}

fn figures(scene: &Scene, settings: &Settings) -> Result<Figures, ClothError> {
    validate::scene(scene)?;
    validate::settings(settings)?;
    let x = &scene.positions;
    let topology = Topology::of_elements(x.len(), &scene.triangles);
    let mut figures = strains(scene, settings);
    let own = count::self_crossings(x, &topology.faces);
    figures.self_crossings = own.count;
    figures.first_crossing = own.pairs.first().map(|p| p[0]);
    let body = Body::of_scene(scene);
    figures.body_distance_min = f64::INFINITY;
    if let Some(b) = &body {
        against_body(&mut figures, x, &topology, b);
    }
    figures.energy = elastic(&model(scene, settings, &topology, &masses(scene)), x);
    Ok(figures)
}

/// Figures against the body.
fn against_body(figures: &mut Figures, x: &[Vec3], topology: &Topology, body: &Body) {
    let found = count::body_crossings(x, &topology.faces, body);
    figures.body_crossings = found.count;
    figures.first_crossing = figures.first_crossing.or(found.pairs.first().map(|p| p[0]));
    let used: std::collections::BTreeSet<u32> = topology.faces.iter().flatten().copied().collect();
    let within = repair::inside(x, &topology.faces, &found.pairs, body);
    for v in used {
        let p = &x[v as usize];
        if within[v as usize] {
            let depth = body.nearest(p, DEPTH_REACH, 0).map_or(DEPTH_REACH, |(_, d)| d);
            figures.penetration_max = figures.penetration_max.max(depth);
            figures.body_distance_min = 0.0;
        } else if let Some((_, d)) = body.nearest(p, figures.body_distance_min.min(BODY_DISTANCE_REACH), 0) {
            figures.body_distance_min = figures.body_distance_min.min(d);
        }
    }
}

/// Largest strain of the scene's positions along warp, weft or bias over the strain limit of that direction.
pub(crate) fn strain_over_limit(scene: &Scene, settings: &Settings) -> f64 {
    strains(scene, settings).strain_over_limit
}

/// Figures of strain.
fn strains(scene: &Scene, settings: &Settings) -> Figures {
    let x = &scene.positions;
    let mut figures = Figures::default();
    let mut largest = Vec::with_capacity(scene.triangles.len());
    for (i, (t, s)) in (0u32..).zip(scene.triangles.iter().zip(Coupled::new(scene, settings).strains(x))) {
        let [warp_limit, weft_limit, bias_limit] = scene.materials[t.material as usize].strain_limit;
        let [weft, warp] = s.stretch.map(|a| a - 1.0);
        largest.push(weft.max(warp));
        let bias = (1.0 + 2.0 * s.bias).max(0.0).sqrt() - 1.0;
        let over = (weft / weft_limit).max(warp / warp_limit).max(bias / bias_limit);
        if over > figures.strain_over_limit {
            figures.strain_over_limit = over;
            let at = t.vertices.iter().map(|v| x[*v as usize]).sum::<Vec3>() / 3.0;
            figures.tightest = Some(Tightest { place: Place { triangle: i, at }, warp, weft, bias });
        }
        figures.shear_max = figures.shear_max.max(libm::asin(s.sine.abs().min(1.0)));
        for k in 0..3 {
            let l = (x[t.vertices[k] as usize] - x[t.vertices[(k + 1) % 3] as usize]).norm();
            figures.edge_strain_max = figures.edge_strain_max.max(l / t.rest_length(k) - 1.0);
        }
    }
    largest.sort_by(f64::total_cmp);
    let n = largest.len();
    figures.strain_max = largest.last().copied().unwrap_or(0.0);
    figures.strain_p95 = largest.get((n * 95).div_ceil(100).saturating_sub(1)).copied().unwrap_or(0.0);
    figures
}
