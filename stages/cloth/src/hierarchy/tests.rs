use crate::hierarchy::*;
use crate::{Material, Vec3};

/// A strip of cells, n × m, each 10 mm; `shift` moves it in the cloth's plane and in space.
fn sheet(n: u32, m: u32, first: u32, shift: f64) -> Scene {
    let mut scene = Scene { materials: vec![Material::isotropic(0.2, 500.0, 0.2, 1e-5)], ..Scene::default() };
    for j in 0..=m {
        for i in 0..=n {
            scene.positions.push(Vec3::new(f64::from(i) * 0.01 + shift, f64::from(j) * 0.01, 0.0));
        }
    }
    for j in 0..m {
        for i in 0..n {
            let a = j * (n + 1) + i;
            for t in [[a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1]] {
                let rest = t.map(|v| [scene.positions[v as usize].x, scene.positions[v as usize].y]);
                scene.triangles.push(Element { vertices: t.map(|v| v + first), rest, material: 0 });
            }
        }
    }
    scene
}

fn area(scene: &Scene) -> f64 {
    scene.triangles.iter().map(Element::area).sum()
}

#[test]
fn a_sheet_keeps_its_area_and_every_place_its_place() {
    let fine = sheet(60, 50, 0, 0.0);
    let level = Level::below(&fine).expect("a sheet of 6,000 triangles has a level");
    assert!((area(&level.scene) - area(&fine)).abs() < 1e-12);
    let share = level.scene.triangles.len() as f64 / fine.triangles.len() as f64;
    assert!((0.15..0.4).contains(&share), "{share}");
    // The level lies in the plane as the sheet does, so what is spread from it is the sheet itself.
    for (p, q) in level.spread(&level.scene.positions).iter().zip(&fine.positions) {
        assert!((p - q).norm() < 1e-12, "{p} {q}");
    }
    // So does a linear map of space.
    let bent = |p: &Vec3| Vec3::new(p.x + 0.3 * p.y, p.y, 0.5 * p.x);
    let x: Vec<Vec3> = level.scene.positions.iter().map(bent).collect();
    for (p, q) in level.spread(&x).iter().zip(&fine.positions) {
        assert!((p - bent(q)).norm() < 1e-12);
    }
}

#[test]
fn both_sides_of_a_seam_collapse_together() {
    let (n, m) = (36, 42);
    let mut scene = sheet(n, m, 0, 0.0);
    let count = u32::try_from(scene.positions.len()).unwrap();
    let right = sheet(n, m, count, 1.0);
    scene.positions.extend(right.positions);
    scene.triangles.extend(right.triangles.iter());
    scene.stitches = (0..=m).map(|j| [j * (n + 1) + n, count + j * (n + 1)]).collect();
    let level = Level::below(&scene).expect("level");
    let stitches = &level.scene.stitches;
    assert!((14..34).contains(&stitches.len()), "{}", stitches.len());
    // On both sides the stitched vertices stand at the same heights, so the seam has the same parts on both.
    for s in stitches {
        let [p, q] = s.map(|v| level.scene.positions[v as usize]);
        assert!((p.y - q.y).abs() < 1e-12 && (q.x - p.x - 0.64).abs() < 1e-12, "{p} {q}");
    }
    let border = level.scene.positions.iter().filter(|p| (p.x - 0.36).abs() < 1e-9).count();
    assert_eq!(border, stitches.len());
    assert!((area(&level.scene) - area(&scene)).abs() < 1e-12);
}

#[test]
fn held_corners_stay_and_a_coarse_sheet_has_no_level() {
    let mut scene = sheet(60, 50, 0, 0.0);
    let corner = 60u32;
    scene.pins = vec![crate::Pin { vertex: corner, at: Vec3::zeros() }];
    let level = Level::below(&scene).expect("level");
    assert_eq!(level.scene.pins.len(), 1);
    let held = level.scene.positions[level.scene.pins[0].vertex as usize];
    assert_eq!(held, scene.positions[corner as usize]);
    assert!(Level::below(&sheet(40, 30, 0, 0.0)).is_none());
}

/// A skirt as an importer gives it: a cone whose triangles each have axes of their own.
fn cone(around: u32, rows: u32) -> Scene {
    let mut scene = Scene { materials: vec![Material::isotropic(0.2, 500.0, 0.2, 1e-5)], ..Scene::default() };
    for j in 0..=rows {
        for i in 0..around {
            let turn = std::f64::consts::TAU * (f64::from(i) + 0.5 * f64::from(j % 2)) / f64::from(around);
            let r = 0.12 + 0.003 * f64::from(j);
            scene.positions.push(Vec3::new(r * libm::cos(turn), r * libm::sin(turn), -0.008 * f64::from(j)));
        }
    }
    let at = |i: u32, j: u32| j * around + i % around;
    for j in 0..rows {
        for i in 0..around {
            let o = j % 2;
            let up = [at(i, j), at(i + 1, j), at(i + o, j + 1)];
            let down = [at(i + 1 - o, j), at(i + 1, j + 1), at(i, j + 1)];
            for t in [up, down] {
                let [p, q, r] = t.map(|v| scene.positions[v as usize]);
                let (e, d) = (q - p, r - p);
                let along = d.dot(&e) / e.norm();
                let rest = [[0.0, 0.0], [e.norm(), 0.0], [along, (d.norm_squared() - along * along).sqrt()]];
                scene.triangles.push(Element { vertices: t, rest, material: 0 });
            }
        }
    }
    scene
}

#[test]
fn a_curved_rest_shape_keeps_its_lengths() {
    let fine = cone(100, 40);
    let level = Level::below(&fine).expect("level");
    let share = level.scene.triangles.len() as f64 / fine.triangles.len() as f64;
    assert!((0.15..0.4).contains(&share), "{share}");
    assert!((area(&level.scene) / area(&fine) - 1.0).abs() < 5e-3);
    for t in &level.scene.triangles {
        for k in 0..3 {
            let [p, q] = [k, (k + 1) % 3].map(|k| level.scene.positions[t.vertices[k] as usize]);
            let strain = (p - q).norm() / t.rest_length(k) - 1.0;
            assert!(strain.abs() < 1e-12, "{strain} {p} {q}");
        }
    }
}

/// A start that is strained a little everywhere, as a perturbed one is, still has a level.
#[test]
fn a_curved_rest_shape_is_found_in_a_perturbed_start() {
    let mut perturbed = cone(100, 40);
    let noise = |k: usize| f64::from((k as u32).wrapping_mul(2_654_435_761)) / f64::from(u32::MAX) - 0.5;
    for (v, p) in perturbed.positions.iter_mut().enumerate() {
        *p += Vec3::new(noise(3 * v), noise(3 * v + 1), noise(3 * v + 2)) * 4e-4;
    }
    let level = Level::below(&perturbed).expect("level");
    let share = level.scene.triangles.len() as f64 / perturbed.triangles.len() as f64;
    assert!((0.15..0.4).contains(&share), "{share}");
    assert!((area(&level.scene) / area(&cone(100, 40)) - 1.0).abs() < 5e-3);
}

/// Its weight stretches it by 0.2 kg/m² · 9.81 m/s² · 0.55 m / 500 N/m = 0.2 %: four times as much is allowed.
#[test]
fn a_level_of_a_drape_is_as_much_softer_as_its_edges_are_longer_squared() {
    let gravity = Vec3::new(0.0, 0.0, -9.81);
    let materials = vec![Material::isotropic(0.2, 500.0, 0.2, 2e-5)];
    let fine = Scene { gravity, materials, ..sheet(60, 50, 0, 0.0) };
    let level = Level::below_folds(&fine).expect("bending length 22 mm, edges of 11 and 23 mm");
    let stiffness = |s: &Scene| s.materials[0].warp.tangent(0.0);
    let longer = mean_edge(&level.scene) / mean_edge(&fine);
    assert!((stiffness(&level.scene) / stiffness(&fine) * longer * longer - 1.0).abs() < 1e-12);
    let [soft, hard] = [&level.scene, &fine].map(|s| s.materials[0].shear);
    assert!((soft / hard * longer * longer - 1.0).abs() < 1e-12);
    assert_eq!(level.scene.materials[0].bending.warp, fine.materials[0].bending.warp);
    assert_eq!(stiffness(&Level::below(&fine).expect("level").scene), stiffness(&fine), "sewn as it is");
}

#[test]
fn soft_heavy_cloth_is_not_made_softer_than_its_weight_allows() {
    let gravity = Vec3::new(0.0, 0.0, -9.81);
    let mut scene = Scene { gravity, ..sheet(60, 50, 0, 0.0) };
    membrane_softening::soften_membrane(&mut scene, 10.0);
    // A square of as much cloth hangs down by 2 % of its side.
    let load = 0.2 * 9.81 * area(&scene).sqrt();
    assert!((scene.materials[0].warp.tangent(0.01) * 0.02 / load - 1.0).abs() < 1e-9);
    let softest = scene.materials[0].clone();
    membrane_softening::soften_membrane(&mut scene, 10.0);
    assert!((scene.materials[0].shear / softest.shear - 1.0).abs() < 1e-12, "as soft as it may be");
}
