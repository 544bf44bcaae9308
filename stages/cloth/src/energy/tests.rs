//! Every energy's force is minus its gradient, and the coupled springs pass the patch test.

use crate::energy::Energy;
use crate::energy::bending::Flexion;
use crate::energy::bending_curve::BendingCurve;
use crate::energy::coupled::Coupled;
use crate::energy::elastic_band::Bands;
use crate::energy::fold_line::Creases;
use crate::energy::rest_curvature::RestCurvature;
use crate::energy::shear::Shear;
use crate::energy::shear_curve::ShearCurve;
use crate::energy::structural::Structural;
use crate::energy::weight::Weight;
use crate::linear::hessian::Hessian;
use crate::scene::lines::{Band, FoldLine};
use crate::scene::topology::Topology;
use crate::{Bending, Curve, Element, Material, Scene, Settings, Vec3};

fn noise(seed: u32) -> f64 {
    let h = seed.wrapping_mul(0x9E37_79B9) ^ (seed.wrapping_mul(0x85EB_CA6B) >> 13);
    f64::from(h.wrapping_mul(0x2C1B_3C6D)) / f64::from(u32::MAX) * 2.0 - 1.0
}

/// An uneven mesh: a jittered grid.
fn scene(material: Material) -> Scene {
    let n = 5u32;
    let mut scene = Scene { materials: vec![material], gravity: Vec3::new(0.0, -9.81, 0.0), ..Scene::default() };
    let mut rest = Vec::new();
    for j in 0..n {
        for i in 0..n {
            let inside = i > 0 && j > 0 && i + 1 < n && j + 1 < n;
            let jitter = if inside { 0.003 } else { 0.0 };
            let k = 2 * (j * n + i);
            rest.push([0.01 * f64::from(i) + jitter * noise(k), 0.01 * f64::from(j) + jitter * noise(k + 1)]);
        }
    }
    for j in 0..n - 1 {
        for i in 0..n - 1 {
            let q = [j * n + i, j * n + i + 1, (j + 1) * n + i + 1, (j + 1) * n + i];
            for c in [[0, 1, 2], [0, 2, 3]] {
                let v = c.map(|k: usize| q[k]);
                scene.triangles.push(Element { vertices: v, rest: v.map(|i| rest[i as usize]), material: 0 });
            }
        }
    }
    scene.positions = rest.iter().map(|p| Vec3::new(p[0], p[1], 0.0)).collect();
    scene
}

pub(crate) fn fabric() -> Material {
    Material {
        warp: Curve::Exponential { k0: 700.0, beta: 20.0 },
        weft: Curve::Samples(vec![[0.0, 0.0], [0.05, 10.0], [0.2, 100.0]]),
        poisson: 0.2,
        shear: 40.0,
        bending: Bending { warp: 2e-5, weft: 1e-5, bias: Some(1.2e-5), ..Bending::default() },
        ..Material::isotropic(0.15, 500.0, 0.0, 1e-5)
    }
}

fn energies(scene: &Scene, s: &Settings) -> Vec<Box<dyn Energy>> {
    let t = Topology::of_elements(scene.positions.len(), &scene.triangles);
    let mut bare = scene.clone();
    bare.materials.iter_mut().for_each(|m| m.springs = Some([450.0, 50.0]));
    let mut locked = scene.clone();
    locked.materials.iter_mut().for_each(|m| m.strain_limit = [0.1, f64::INFINITY, 0.12]);
    let ring: Vec<u32> = vec![0, 1, 2, 3, 8, 13, 18, 17, 16, 15, 10, 5];
    let lined = Scene {
        bands: vec![
            Band { rest: vec![0.008; 12], vertices: ring, stiffness: 30.0 },
            Band { vertices: vec![20, 21, 22, 23, 24], rest: vec![0.007, 0.008, 0.009, 0.008], stiffness: 20.0 },
        ],
        folds: vec![
            FoldLine { vertices: vec![2, 7, 12, 17, 22], angle: 2.5, stiffness: 0.01 },
            FoldLine { vertices: vec![5, 6], angle: -1.0, stiffness: 0.02 },
        ],
        ..scene.clone()
    };
    vec![
        Box::new(Bands::new(&lined)),
        Box::new(Creases::new(&lined, &t)),
        Box::new(Flexion::new(&lined, &t)),
        Box::new(Coupled::new(scene, s)),
        Box::new(Coupled::new(&locked, s)),
        Box::new(Structural::new(scene, &t, s)),
        Box::new(Structural::new(&bare, &t, s)),
        Box::new(Shear::new(scene, &t)),
        Box::new(Flexion::new(scene, &t)),
        Box::new(Weight::new(scene, &vec![1e-4; scene.positions.len()], 1.0)),
    ]
}

/// Cloth that is hollow along one yarn and round along the other.
fn curled(scene: &Scene) -> Box<dyn Energy> {
    let t = Topology::of_elements(scene.positions.len(), &scene.triangles);
    let mut curled = scene.clone();
    curled.materials.iter_mut().for_each(|m| m.bending.rest_curvature = [30.0, -12.0]);
    Box::new(RestCurvature::new(&curled, &t).expect("a fabric that curls"))
}

/// Curves that are steep first, as of yarns that rub.
fn measured(curl: [f64; 2]) -> Material {
    let curve = |slope: f64, reach: f64| {
        Some(Curve::Samples(
            [[0.0, 0.0], [0.2, 0.5], [0.5, 0.9], [1.0, 1.4]].map(|[x, y]| [x * reach, y * slope * reach]).into(),
        ))
    };
    Material {
        shear: 40.0,
        shear_curve: curve(40.0, 0.3),
        bending: Bending { curve: [curve(2e-5, 60.0), curve(1e-5, 90.0)], rest_curvature: curl, ..fabric().bending },
        ..fabric()
    }
}

fn measured_energies(scene: &Scene) -> Vec<Box<dyn Energy>> {
    let (t, s) = (Topology::of_elements(scene.positions.len(), &scene.triangles), Settings::default());
    vec![
        Box::new(ShearCurve::new(scene, &s).expect("a curve of shear")),
        Box::new(BendingCurve::new(scene, &t, &s).expect("curves of bending")),
    ]
}

/// The Hessians hold the part that is never negative: all of the work of the slopes, at places without force.
#[test]
fn hessians_of_measured_curves_are_those_of_cloth_at_rest() {
    let scene = scene(measured([0.0; 2]));
    let n = scene.positions.len();
    for e in measured_energies(&scene) {
        let mut pairs = Vec::new();
        e.add_pairs(&mut pairs);
        let mut h = Hessian::new((0u32..).take(n).collect(), n, pairs, |add| e.springs(add));
        h.reset();
        e.add_hessian(&scene.positions, true, &mut h);
        assert!(h.extra.is_empty());
        let d: Vec<Vec3> = (0u32..).take(n).map(|i| Vec3::new(noise(7 * i), noise(5 * i + 1), noise(i + 9))).collect();
        let pull = |s: f64| {
            let mut f = vec![Vec3::zeros(); n];
            e.add_forces(&scene.positions.iter().zip(&d).map(|(p, d)| p + d * s).collect::<Vec<_>>(), &mut f);
            f
        };
        let (ahead, behind) = (pull(1e-8), pull(-1e-8));
        let slope: Vec<Vec3> = ahead.iter().zip(behind).map(|(p, q)| (q - p) / 2e-8).collect();
        let size = slope.iter().map(|f| f.norm()).fold(0.0, f64::max);
        for (got, slope) in h.merged().times(&d).iter().zip(&slope) {
            assert!((got - slope).norm() <= 1e-3 * size, "{got} and {slope}");
        }
        let mut rows = vec![0.0; n];
        e.add_stiffness(&scene.positions, &mut rows);
        let work: f64 = slope.iter().zip(&d).map(|(f, d)| f.dot(d)).sum();
        assert!(work > 0.0 && work <= 1.0001 * rows.iter().zip(&d).map(|(k, d)| k * d.norm_squared()).sum::<f64>());
    }
}

#[test]
fn a_measured_curve_stores_what_was_measured() {
    let cloth = measured([0.0; 2]);
    let scene = scene(cloth.clone());
    let [shear, bend] = &measured_energies(&scene)[..] else { panic!("two energies") };
    let stored = |curve: &Option<Curve>, at: f64| curve.as_ref().map_or(0.0, |c| c.energy(at));
    // Yarns that keep their lengths, and one lattice of them turns.
    let angle = 0.1_f64;
    let turned: Vec<Vec3> =
        scene.positions.iter().map(|p| Vec3::new(p.x + p.y * libm::sin(angle), p.y * libm::cos(angle), 0.0)).collect();
    let sheared = shear.energy(&turned) / (0.04 * 0.04) + 0.5 * cloth.shear * angle * angle;
    assert!((sheared / stored(&cloth.shear_curve, angle) - 1.0).abs() < 1e-3, "{sheared} J/m2");
    // A roll about the weft, against the straight line on the same mesh.
    let k = 30.0_f64;
    let rolled: Vec<Vec3> = scene
        .positions
        .iter()
        .map(|p| Vec3::new(p.x, libm::sin(k * p.y) / k, (1.0 - libm::cos(k * p.y)) / k))
        .collect();
    let t = Topology::of_elements(scene.positions.len(), &scene.triangles);
    let line = Flexion::new(&scene, &t).energy(&rolled);
    let ratio = (bend.energy(&rolled) + line) / line;
    let expected = stored(&cloth.bending.curve[0], k) / (0.5 * cloth.bending.warp * k * k);
    assert!((ratio / expected - 1.0).abs() < 0.03, "{ratio} times the straight line, not {expected}");
}

#[test]
fn forces_are_minus_the_gradient() {
    let scene = scene(fabric());
    let all = energies(&scene, &Settings::default());
    let curves = [[0.0; 2], [20.0, -9.0]].map(|curl| measured_energies(&self::scene(measured(curl))));
    for (k, e) in all.iter().chain([&curled(&scene)]).chain(curves.iter().flatten()).enumerate() {
        let mut x = scene.positions.clone();
        for (i, p) in (0u32..).zip(&mut x) {
            // Stretched, sheared and buckled.
            *p = Vec3::new(1.03 * p.x + 0.3 * p.y, 1.02 * p.y, 0.0)
                + Vec3::new(noise(3 * i), noise(3 * i + 1), noise(3 * i + 2)) * 1e-3;
        }
        let mut f = vec![Vec3::zeros(); x.len()];
        e.add_forces(&x, &mut f);
        let size = f.iter().map(|f| f.amax()).fold(0.0, f64::max);
        for i in 0..x.len() {
            for c in 0..3 {
                let h = 1e-8;
                let mut moved = |d: f64| {
                    let keep = x[i][c];
                    x[i][c] += d;
                    let value = e.energy(&x);
                    x[i][c] = keep;
                    value
                };
                let slope = (moved(h) - moved(-h)) / (2.0 * h);
                assert!((f[i][c] + slope).abs() < 2e-5 * size, "energy {k}, vertex {i}: {} and {slope}", f[i][c]);
            }
        }
    }
}

#[test]
fn hessians_are_the_derivative_of_the_forces_and_convex_ones_are_never_negative() {
    let scene = scene(fabric());
    let n = scene.positions.len();
    for (k, e) in energies(&scene, &Settings::default()).iter().enumerate() {
        let mut pairs = Vec::new();
        e.add_pairs(&mut pairs);
        let unknown: Vec<u32> = (0..n as u32).collect();
        let mut h = Hessian::new(unknown, n, pairs, |add| e.springs(add));
        // Once pulled, once squeezed and buckled.
        for (trial, (u, v)) in [(1.03, 1.02), (0.97, 0.95)].into_iter().enumerate() {
            let mut x = scene.positions.clone();
            for (i, p) in (0u32..).zip(&mut x) {
                *p = Vec3::new(u * p.x + 0.3 * p.y, v * p.y, 0.0)
                    + Vec3::new(noise(3 * i), noise(3 * i + 1), noise(3 * i + 2)) * 1e-3;
            }
            let d: Vec<Vec3> = (0..n as u32).map(|i| Vec3::new(noise(7 * i), noise(5 * i + 1), noise(i + 9))).collect();
            let forces = |s: f64| {
                let y: Vec<Vec3> = x.iter().zip(&d).map(|(p, d)| p + d * s).collect();
                let mut f = vec![Vec3::zeros(); n];
                e.add_forces(&y, &mut f);
                f
            };
            let step = 1e-8;
            let slope: Vec<Vec3> =
                forces(step).iter().zip(forces(-step)).map(|(p, q)| (q - p) / (2.0 * step)).collect();
            h.reset();
            e.add_hessian(&x, false, &mut h);
            assert!(h.extra.is_empty());
            let got = h.merged().times(&d);
            let size = slope.iter().map(|f| f.norm()).fold(0.0, f64::max);
            for i in 0..n {
                assert!(
                    (got[i] - slope[i]).norm() <= 1e-4 * size,
                    "energy {k}, trial {trial}, vertex {i}: {} and {}",
                    got[i],
                    slope[i]
                );
            }
            h.reset();
            e.add_hessian(&x, true, &mut h);
            let system = h.merged();
            for probe in 0..200u32 {
                let d: Vec<Vec3> = (0..n as u32)
                    .map(|i| Vec3::new(noise(31 * i + probe), noise(17 * i + 3 * probe), noise(13 * i + 7 * probe)))
                    .collect();
                let work: f64 = system.times(&d).iter().zip(&d).map(|(p, q)| p.dot(q)).sum();
                assert!(work >= -1e-9 * size, "energy {k}: {work}");
            }
        }
    }
}

#[test]
fn coupled_springs_pass_the_patch_test_off_the_axes() {
    // A uniform strain of an uneven mesh leaves the inner vertices without force, and stores W(E) per area.
    let (k1, k2, g) = (500.0, 300.0, 25.0);
    let m = Material {
        warp: Curve::Linear { stiffness: k1 },
        weft: Curve::Linear { stiffness: k2 },
        shear: g,
        poisson: 0.0,
        ..Material::isotropic(0.15, 500.0, 0.0, 0.0)
    };
    let scene = scene(m);
    let coupled = Coupled::new(&scene, &Settings::default());
    let (weft, warp, shear) = (2e-3, 3e-3, 4e-3);
    let x: Vec<Vec3> =
        scene.positions.iter().map(|p| Vec3::new((1.0 + weft) * p.x + shear * p.y, (1.0 + warp) * p.y, 0.0)).collect();
    let mut f = vec![Vec3::zeros(); x.len()];
    coupled.add_forces(&x, &mut f);
    let scale = k1 * warp * 0.01;
    for j in 1..4 {
        for i in 1..4 {
            assert!(f[j * 5 + i].norm() < 1e-9 * scale, "{:?}", f[j * 5 + i]);
        }
    }
    // Exact yarn stretches and shear angle of that map.
    let b = libm::hypot(shear, 1.0 + warp);
    let gamma = libm::asin((1.0 + weft) * shear / ((1.0 + weft) * b));
    let density = 0.5 * k2 * weft * weft + 0.5 * k1 * (b - 1.0) * (b - 1.0) + 0.5 * g * gamma * gamma;
    assert!((coupled.energy(&x) / (density * 0.04 * 0.04) - 1.0).abs() < 1e-9);
}

#[test]
fn the_stiffness_bound_holds_for_random_motions() {
    // xᵀ K x ≤ Σ k_i |x_i|², by differences of the forces.
    let scene = scene(fabric());
    for (k, e) in energies(&scene, &Settings::default()).iter().take(4).enumerate() {
        let x = &scene.positions;
        let mut rows = vec![0.0; x.len()];
        e.add_stiffness(x, &mut rows);
        for trial in 0..50u32 {
            let d: Vec<Vec3> = (0..x.len() as u32)
                .map(|i| Vec3::new(noise(97 * trial + 3 * i), noise(97 * trial + 3 * i + 1), noise(31 * trial + i)))
                .collect();
            let at = |s: f64| {
                let y: Vec<Vec3> = x.iter().zip(&d).map(|(p, d)| p + d * s).collect();
                let mut f = vec![Vec3::zeros(); y.len()];
                e.add_forces(&y, &mut f);
                f.iter().zip(&d).map(|(f, d)| f.dot(d)).sum::<f64>()
            };
            let quadratic = -(at(1e-7) - at(-1e-7)) / 2e-7;
            let bound: f64 = rows.iter().zip(&d).map(|(k, d)| k * d.norm_squared()).sum();
            assert!(quadratic <= bound * 1.0001, "energy {k}: {quadratic} over {bound}");
        }
    }
}

#[test]
fn tables_follow_their_curves() {
    let law =
        crate::energy::law::Law::new(&Curve::Exponential { k0: 700.0, beta: 20.0 }, f64::INFINITY, 0.15, f64::INFINITY);
    let curve = Curve::Exponential { k0: 700.0, beta: 20.0 };
    for i in -10..30 {
        let e = 0.005 * f64::from(i);
        assert!((law.tension(e) - curve.tension(e)).abs() <= 1e-4 * curve.tension(e).abs() + 1e-12, "{e}");
        assert!((law.energy(e) - curve.energy(e)).abs() <= 2e-4 * curve.energy(e).abs() + 1e-12, "{e}");
    }
    let capped = crate::energy::law::Law::new(&curve, 1000.0, 0.15, f64::INFINITY);
    assert!((capped.tangent(0.1) - 1000.0).abs() < 1e-9);
}

/// Tension is the slope of the energy, and stiffness that of the tension, below, at and far beyond the lock.
///
/// At its limit the cloth carries twenty times as much as its curve.
#[test]
fn a_lock_is_one_energy_throughout() {
    let (curve, limit) = (Curve::Linear { stiffness: 500.0 }, 0.08);
    let law = crate::energy::law::Law::new(&curve, f64::INFINITY, 0.12, limit);
    for strain in [0.02, 0.0793, 0.0796, 0.07985, 0.0799, 0.0801, 0.085, 0.2] {
        let h = 1e-8;
        let slope = |f: &dyn Fn(f64) -> f64| (f(strain + h) - f(strain - h)) / (2.0 * h);
        let (tension, stiffness) = (slope(&|e| law.energy(e)), slope(&|e| law.tension(e)));
        assert!((tension / law.tension(strain) - 1.0).abs() < 1e-5, "{strain}: {tension}, not {}", law.tension(strain));
        assert!((stiffness / law.slope(strain) - 1.0).abs() < 1e-5, "{strain}: {stiffness}, not {}", law.slope(strain));
    }
    assert!(law.tension(limit) > 20.0 * curve.tension(limit), "{} N/m", law.tension(limit));
}

/// Cloth on a cylinder, one column of its cells far narrower than the others.
#[test]
fn narrow_cells_bend_like_their_neighbours() {
    let (radius, b) = (0.05, 1e-5);
    for narrow in [5e-3, 1e-4, 2e-6] {
        let columns = [0.0, 0.02, 0.04, 0.04 + narrow, 0.06, 0.08];
        let rest: Vec<[f64; 2]> = (0..5).flat_map(|r| columns.map(|u| [u, 0.02 * f64::from(r)])).collect();
        let mut scene = Scene { materials: vec![Material::isotropic(0.1, 500.0, 0.0, b)], ..Scene::default() };
        let at = |r: &[f64; 2]| {
            Vec3::new(radius * libm::sin(r[0] / radius), r[1], radius * (1.0 - libm::cos(r[0] / radius)))
        };
        scene.positions = rest.iter().map(at).collect();
        for i in (0..24u32).filter(|i| i % 6 < 5) {
            for v in [[i, i + 1, i + 7], [i, i + 7, i + 6]] {
                scene.triangles.push(Element { vertices: v, rest: v.map(|i| rest[i as usize]), material: 0 });
            }
        }
        let topology = Topology::of_elements(scene.positions.len(), &scene.triangles);
        let stored = Flexion::new(&scene, &topology).evaluate(&scene.positions, &mut vec![Vec3::zeros(); 30]);
        // At most the whole sheet bent to that radius, and a little for the uneven cells; the two ends bend freely.
        let whole = 0.5 * b / (radius * radius) * 0.08 * 0.08;
        assert!((0.5..1.3).contains(&(stored / whole)), "{narrow} m: {stored:e} J of {whole:e} J");
    }
}

/// Surrogate springs stand for bending only where triangles are wide against the bending length.
///
/// They couple neighbours only, and a common move of all vertices has no force.
#[test]
fn surrogate_bending_is_for_wide_triangles() {
    // Cells of about 10 mm: bending lengths of 4 and of 40 mm.
    let bending = |length: f64| Material::isotropic(0.15, 500.0, 0.3, 0.15 * 9.81 * length * length * length);
    let of = |length: f64| {
        let scene = scene(bending(length));
        let t = Topology::of_elements(scene.positions.len(), &scene.triangles);
        (Flexion::new(&scene, &t), t, scene)
    };
    assert!(!of(0.04).0.has_surrogate());
    let (flexion, topology, scene) = of(0.004);
    assert!(flexion.has_surrogate());
    let mut pairs = Vec::new();
    flexion.surrogate_springs(&mut |ends, _| pairs.push(ends));
    let neighbours = |p: &[u32; 2]| topology.edges.contains(&[p[0].min(p[1]), p[0].max(p[1])]);
    assert!(!pairs.is_empty() && pairs.iter().all(neighbours));
    let n = scene.positions.len();
    let mut h = Hessian::new((0u32..).take(n).collect(), n, Vec::new(), |add| flexion.surrogate_springs(add));
    h.reset();
    let system = h.merged();
    let along = system.times(&vec![Vec3::new(1.0, 2.0, 3.0); n]);
    let up: Vec<Vec3> = (0u32..).take(n).map(|i| Vec3::new(0.0, 0.0, noise(i))).collect();
    let pushed = system.times(&up);
    let work: f64 = pushed.iter().zip(&up).map(|(f, d)| f.dot(d)).sum();
    assert!(work > 0.0 && along.iter().all(|f| f.norm() < 1e-9 * work), "{work}");
}

/// The bending energy of triangles on the edge from vertex 0 to vertex 1, whose third corners lie at an angle about it. An
/// angle of 0 is to the left. `pieces` says which are cut in one piece.
fn bending_at_edge(triangles: &[([u32; 3], f64, usize)]) -> f64 {
    let mut scene = Scene { materials: vec![fabric()], gravity: Vec3::new(0.0, -9.81, 0.0), ..Scene::default() };
    scene.positions = vec![Vec3::zeros(), Vec3::new(0.0, 0.01, 0.0)];
    for (vertices, degrees, piece) in triangles {
        let (s, c) = libm::sincos(degrees.to_radians());
        scene.positions.push(Vec3::new(-0.01 * c, 0.005, 0.01 * s));
        // The corner lies on the side of the edge that its sense tells.
        let side = if vertices[0] == 0 { -0.01 } else { 0.01 };
        let place = |v: u32| [[0.0, 0.0], [0.0, 0.01], [side, 0.005]][v.min(2) as usize];
        let rest = vertices.map(place).map(|[x, y]| [x + *piece as f64, y]);
        scene.triangles.push(Element { vertices: *vertices, rest, material: 0 });
    }
    let topology = Topology::of_elements(scene.positions.len(), &scene.triangles);
    Flexion::new(&scene, &topology).energy(&scene.positions)
}

#[test]
fn cloth_resists_bending_where_it_goes_on() {
    let (left, right) = (|v| [0, 1, v], |v| [1, 0, v]);
    let least = 1e-9;
    // Two pieces that are sewn edge to edge: flat, and folded onto each other.
    assert!(bending_at_edge(&[(left(2), 0.0, 0), (right(3), 180.0, 1)]) < least);
    assert!(bending_at_edge(&[(left(2), 0.0, 0), (right(3), 0.0, 1)]) > 1e3 * least);
    // Two pieces that are sewn face to face bend freely at their seam.
    assert!(bending_at_edge(&[(left(2), 0.0, 0), (left(3), 0.0, 1)]) < least);
    assert!(bending_at_edge(&[(left(2), 0.0, 0), (left(3), 120.0, 1)]) < least);
    // A pocket on a front: the front resists where it is folded under the edge of the pocket, and the pocket does not.
    let front_and_pocket =
        |front: f64, pocket: f64| bending_at_edge(&[(left(2), 0.0, 0), (right(3), front, 0), (right(4), pocket, 1)]);
    assert!(front_and_pocket(180.0, 180.0) < least && front_and_pocket(180.0, 60.0) < least);
    let alone = bending_at_edge(&[(left(2), 0.0, 0), (right(3), 90.0, 0)]);
    assert!(alone > 1e3 * least && (front_and_pocket(90.0, 170.0) - alone).abs() < 1e-9 * alone);
}
