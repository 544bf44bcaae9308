//! The gate: nothing unusable gets behind it.

use crate::{ClothError, Integrator, Scene, SceneFault, Settings, Switch};

fn bad(fault: SceneFault, what: String) -> Result<(), ClothError> {
    Err(ClothError::BadScene { fault, what })
}

/// Checks indices, numbers and areas.
pub(crate) fn scene(scene: &Scene) -> Result<(), ClothError> {
    let n = scene.positions.len();
    if scene.triangles.is_empty() {
        return bad(SceneFault::NoCloth, "the scene has no cloth triangle".into());
    }
    if n >= u32::MAX as usize / 4 || scene.triangles.len() >= u32::MAX as usize / 4 {
        return bad(SceneFault::TooLarge, format!("{n} vertices are over the limit of this solver"));
    }
    finite("cloth", &scene.positions)?;
    materials(scene)?;
    triangles(scene)?;
    for (i, p) in scene.pins.iter().enumerate() {
        if p.vertex as usize >= n || !p.at.iter().all(|c| c.is_finite()) {
            return bad(SceneFault::Pin, format!("pin {i} names vertex {} of {n} at {:?}", p.vertex, p.at.as_slice()));
        }
    }
    for (i, l) in scene.loads.iter().enumerate() {
        if l.vertex as usize >= n || !l.force.iter().all(|c| c.is_finite()) {
            return bad(SceneFault::Load, format!("load {i} names vertex {} of {n}", l.vertex));
        }
    }
    for (i, s) in scene.stitches.iter().enumerate() {
        if s.iter().any(|v| *v as usize >= n) {
            return bad(SceneFault::Stitch, format!("stitch {i} names vertices {} and {} of {n}", s[0], s[1]));
        }
    }
    lines(scene)?;
    let filter = &scene.contact_filter.ignored;
    if !filter.is_empty() && filter.len() != n {
        return bad(SceneFault::ContactFilter, format!("a contact filter for {} of {n} vertices", filter.len()));
    }
    if !scene.layers.is_empty() && scene.layers.len() != n {
        return bad(SceneFault::Layers, format!("{} layer numbers for {n} vertices", scene.layers.len()));
    }
    if !scene.gravity.iter().all(|c| c.is_finite() && c.abs() <= 1e6) {
        return bad(SceneFault::Gravity, format!("gravity is {:?} m/s2", scene.gravity.as_slice()));
    }
    body(scene)
}

fn lines(scene: &Scene) -> Result<(), ClothError> {
    let n = scene.positions.len();
    let positive = |v: f64| v.is_finite() && v > 0.0;
    for (i, b) in scene.bands.iter().enumerate() {
        let counts = b.vertices.len() > 1 && [b.rest.len(), b.rest.len() + 1].contains(&b.vertices.len());
        if !counts || b.vertices.iter().any(|v| *v as usize >= n) {
            return bad(
                SceneFault::Band,
                format!("band {i} has {} vertices of {n}, and {} stretches", b.vertices.len(), b.rest.len()),
            );
        }
        if !positive(b.stiffness) || !b.rest.iter().all(|r| positive(*r)) {
            return bad(SceneFault::Band, format!("band {i}: a length or the stiffness {} is not over 0", b.stiffness));
        }
    }
    for (i, f) in scene.folds.iter().enumerate() {
        if f.vertices.iter().any(|v| *v as usize >= n) {
            return bad(SceneFault::Fold, format!("fold {i} names a vertex that is not there, of {n}"));
        }
        if !f.angle.is_finite()
            || f.angle.abs() > std::f64::consts::PI
            || !(f.stiffness.is_finite() && f.stiffness >= 0.0)
        {
            return bad(
                SceneFault::Fold,
                format!("fold {i} has an angle of {} rad and a stiffness of {} N", f.angle, f.stiffness),
            );
        }
    }
    Ok(())
}

fn finite(what: &str, positions: &[crate::Vec3]) -> Result<(), ClothError> {
    match positions.iter().position(|p| !p.iter().all(|c| c.is_finite() && c.abs() < 1e6)) {
        Some(i) => bad(SceneFault::Position, format!("{what} vertex {i} is at {:?} m", positions[i].as_slice())),
        None => Ok(()),
    }
}

fn triangles(scene: &Scene) -> Result<(), ClothError> {
    let n = scene.positions.len();
    for (i, t) in scene.triangles.iter().enumerate() {
        let [a, b, c] = t.vertices;
        if t.vertices.iter().any(|v| *v as usize >= n) || a == b || b == c || a == c {
            return bad(SceneFault::Triangle, format!("triangle {i} names vertices {a}, {b}, {c} of {n}"));
        }
        if t.material as usize >= scene.materials.len() {
            return bad(SceneFault::Material, format!("triangle {i} names material {}", t.material));
        }
        let longest = (0..3).map(|k| t.rest_length(k)).fold(0.0, f64::max);
        let area = t.area().abs();
        if !area.is_finite() || area <= 1e-9 * longest * longest {
            return bad(
                SceneFault::FlatTriangle,
                format!(
                    "rest triangle {i} has an area of {area:.3e} m2 on an edge of {:.3} mm, near {}",
                    longest * 1e3,
                    millimetres(&scene.positions, t.vertices)
                ),
            );
        }
    }
    Ok(())
}

/// The middle of a triangle in words.
fn millimetres(x: &[crate::Vec3], t: [u32; 3]) -> String {
    let middle = t.iter().map(|v| x[*v as usize]).sum::<crate::Vec3>() * (1e3 / 3.0);
    format!("({:.0}, {:.0}, {:.0}) mm", middle.x, middle.y, middle.z)
}

fn materials(scene: &Scene) -> Result<(), ClothError> {
    for (i, m) in scene.materials.iter().enumerate() {
        let positive = [("areal_mass", m.areal_mass), ("shear", m.shear)];
        for (name, v) in positive {
            if !(v.is_finite() && v > 0.0) {
                return bad(SceneFault::Material, format!("material {i}: {name} is {v}, it must be > 0"));
            }
        }
        let not_negative = [
            ("thickness", m.thickness),
            ("friction", m.friction),
            ("bend_warp", m.bending.warp),
            ("bend_weft", m.bending.weft),
            ("bend_bias", m.bending.bias.unwrap_or(0.0)),
            ("bend_friction", m.bending.friction),
            ("springs", m.springs.map_or(0.0, |s| s[0])),
            ("springs", m.springs.map_or(0.0, |s| s[1])),
        ];
        for (name, v) in not_negative {
            if !(v.is_finite() && v >= 0.0) {
                return bad(SceneFault::Material, format!("material {i}: {name} is {v}, it must be ≥ 0"));
            }
        }
        if let Some(k) = m.bending.rest_curvature.iter().find(|k| !k.is_finite()) {
            return bad(SceneFault::Material, format!("material {i}: rest_curvature is {k}, it must be finite"));
        }
        if !(0.0..1.0).contains(&m.poisson) {
            return bad(
                SceneFault::Material,
                format!("material {i}: poisson is {}, it must be in 0 ≤ … < 1", m.poisson),
            );
        }
        let curves = [Some(&m.warp), Some(&m.weft), m.shear_curve.as_ref()];
        if curves.into_iter().chain(m.bending.curve.iter().map(Option::as_ref)).flatten().any(|c| !c.is_sound()) {
            return bad(SceneFault::Material, format!("material {i}: a measured curve does not rise from (0, 0)"));
        }
        if m.strain_limit.iter().any(|l| l.is_nan() || *l <= 0.0) {
            return bad(SceneFault::Material, format!("material {i}: strain limits are {:?}", m.strain_limit));
        }
    }
    Ok(())
}

fn body(scene: &Scene) -> Result<(), ClothError> {
    let Some(b) = &scene.body else { return Ok(()) };
    finite("body", &b.positions)?;
    let n = b.positions.len();
    match b.triangles.iter().position(|t| t.iter().any(|v| *v as usize >= n)) {
        Some(i) => bad(SceneFault::Body, format!("body triangle {i} names vertices {:?} of {n}", b.triangles[i])),
        None => Ok(()),
    }
}

/// Checks the ranges of all numbers.
pub(crate) fn settings(s: &Settings) -> Result<(), ClothError> {
    first(setting_faults(s))
}

/// The first fault of a list.
pub(crate) fn first(faults: Vec<ClothError>) -> Result<(), ClothError> {
    faults.into_iter().next().map_or(Ok(()), Err)
}

/// The values out of their ranges: name, value, least, most.
pub(crate) fn out_of_range(ranges: &[(&'static str, f64, f64, f64)]) -> Vec<ClothError> {
    let wrong = ranges.iter().filter(|(_, value, low, high)| !(low..=high).contains(&value));
    let told = |&(name, value, low, high): &(&'static str, f64, f64, f64)| ClothError::BadSetting {
        name,
        what: format!("{value} is outside {low} … {high}"),
    };
    wrong.map(told).collect()
}

/// All numbers out of their ranges, and what the integrator cannot do.
pub(crate) fn setting_faults(s: &Settings) -> Vec<ClothError> {
    let ranges: [(&'static str, f64, f64, f64); 16] = [
        ("damping", s.explicit.damping, 0.0, 1e6),
        ("stiffness_damping", s.explicit.stiffness_damping, 0.0, 2.0),
        ("gravity_scale", s.gravity_scale, -1e6, 1e6),
        ("pressure", s.pressure, -1e7, 1e7),
        ("body_gap", s.body_gap, 1e-6, 0.1),
        ("self_gap", s.self_gap, 1e-6, 0.1),
        ("contact_stiffness", s.explicit.contact_stiffness, 0.0, 1e9),
        ("sewing_stiffness", s.stitches.stiffness, 0.0, 1.0),
        ("sewing_acceleration", s.stitches.acceleration, 0.0, 1e6),
        ("sewing_distance", s.stitches.closed_distance, 1e-6, 0.1),
        ("sewing_ramp", s.stitches.ramp, 0.0, 1e3),
        ("stiffness_cap", s.explicit.stiffness_cap, 1e-6, f64::INFINITY),
        ("step_fraction", s.explicit.step_fraction, 1e-6, 1e3),
        ("energy_tolerance", s.explicit.energy_tolerance, 0.0, 1.0),
        ("speed_tolerance", s.explicit.speed_tolerance, 0.0, 1e3),
        ("repair_share", s.repair_share, 0.0, 1.0),
    ];
    let mut faults = out_of_range(&ranges);
    let seconds = s.explicit.max_seconds;
    if seconds.is_nan() || seconds <= 0.0 {
        faults.push(ClothError::BadSetting { name: "max_seconds", what: format!("{seconds} is not > 0") });
    }
    faults.extend(excluded(s));
    faults
}

/// Effects that the integrator cannot do are refused where they are asked for.
fn excluded(s: &Settings) -> Vec<ClothError> {
    if s.integrator != Integrator::CentralDifference {
        return Vec::new();
    }
    let friction =
        "central differences do not simulate friction in bending; use the static integrator, or leave it out";
    let pressure = "central differences know no pressure; use the static integrator, or leave it out";
    let asked = [
        ("effects.bending-hysteresis", s.effects.bending_hysteresis == Switch::On, friction),
        ("pressure", s.pressure != 0.0, pressure),
    ];
    let refused = asked.into_iter().filter(|(_, asked, _)| *asked);
    refused.map(|(name, _, what)| ClothError::BadSetting { name, what: what.into() }).collect()
}
