//! Runs a scene folder (garment.obj with vt as rest where given, body.obj, pins.txt, stitches.txt; y or z up) and
//! writes OUT.obj. Usage: run_scene DIR OUT.obj [model=springs] [fabric=cotton] [up=y] [seconds=8] …
#![allow(clippy::print_stdout, clippy::unwrap_used)]

#[path = "../tests/common/mod.rs"]
mod common;

use common::{flat, jitter};
use std::fmt::Write as _;
use std::path::Path;
use std::time::Instant;
use toile_cloth::{
    Bending, BodyMesh, Curve, Effects, Element, Equilibrium, ExplicitSteps, Integrator, Material, Model, Outcome, Pin,
    Scene, Settings, Switch, Vec3, Watch, certify, drape, sew, weld,
};

/// Since when, and whether every look is told.
struct Print(Instant, bool);

impl Watch for Print {
    fn progress(&mut self, step: u64, words: &str) {
        if self.1 || step.is_multiple_of(1024 * 8) {
            println!("  {:6.1} s  step {step}: {words}", self.0.elapsed().as_secs_f64());
        }
    }
    fn cancelled(&self) -> bool {
        false
    }
}

type Obj = (Vec<Vec3>, Vec<[f64; 2]>, Vec<[[usize; 2]; 3]>);

fn obj(path: &Path) -> Option<Obj> {
    let (mut v, mut vt, mut f) = (Vec::new(), Vec::new(), Vec::new());
    for line in std::fs::read_to_string(path).ok()?.lines() {
        let p: Vec<&str> = line.split_whitespace().collect();
        let n = |i: usize| p[i].parse::<f64>().unwrap();
        match p.first() {
            Some(&"v") => v.push(Vec3::new(n(1), n(2), n(3))),
            Some(&"vt") => vt.push([n(1), n(2)]),
            Some(&"f") => {
                let corner = |s: &str| {
                    let mut i = s.split('/').map(|k| k.parse::<usize>().unwrap_or(1) - 1);
                    let a = i.next().unwrap();
                    [a, i.next().unwrap_or(a)]
                };
                for k in 2..p.len() - 1 {
                    f.push([corner(p[1]), corner(p[k]), corner(p[k + 1])]);
                }
            }
            _ => {}
        }
    }
    Some((v, vt, f))
}

fn numbers(path: &Path) -> Vec<Vec<u32>> {
    let text = std::fs::read_to_string(path).unwrap_or_default();
    text.lines()
        .map(|l| l.split_whitespace().map(|n| n.parse().unwrap()).collect())
        .filter(|l: &Vec<u32>| !l.is_empty())
        .collect()
}

fn cotton() -> Material {
    Material {
        areal_mass: 0.115,
        thickness: 2.8e-4,
        friction: 0.4,
        warp: Curve::Exponential { k0: 7117.2, beta: 35.141 },
        weft: Curve::Exponential { k0: 3113.8, beta: 15.374 },
        shear: 45.0,
        shear_curve: None,
        poisson: 0.1,
        bending: Bending { warp: 8e-6, weft: 5e-6, ..Bending::default() },
        springs: None,
        strain_limit: [0.035, 0.08, f64::INFINITY],
    }
}

fn show(name: &str, o: &Outcome, t: Instant) {
    println!(
        "{name}: {} in {:.1} s, {} steps, {:.2} s simulated, energy {:.5} J, speed {:.2} mm/s, residual {:.2e}, gap {:.4} mm, open {:?}, repaired {:?}",
        o.stop_reason.words(),
        t.elapsed().as_secs_f64(),
        o.steps,
        o.seconds,
        o.energy,
        o.speed_max * 1e3,
        o.residual_rel,
        o.seam_gap_max * 1e3,
        &o.open_stitches[..o.open_stitches.len().min(4)],
        o.repaired
    );
    for e in &o.effects {
        let on = if e.on { "on" } else { "off" };
        println!("   {} {on}, {:.3} s: {} — {}", e.name, e.cpu_seconds, e.rule, e.evidence);
    }
}

/// The words `NAME=VALUE` of the command line.
struct Words(Vec<String>);

impl Words {
    fn text(&self, name: &str) -> Option<&str> {
        self.0.iter().find_map(|a| a.strip_prefix(name)?.strip_prefix('='))
    }

    fn number(&self, name: &str, or: f64) -> f64 {
        self.text(name).map_or(or, |v| v.parse().unwrap())
    }

    fn is(&self, name: &str, value: &str) -> bool {
        self.text(name) == Some(value)
    }

    fn switch(&self, name: &str, or: Switch) -> Switch {
        if self.is(name, "off") { Switch::Off } else { or }
    }
}

fn fabric(words: &Words) -> Material {
    let mut material = if words.is("fabric", "cotton") {
        cotton()
    } else {
        Material { strain_limit: [0.012; 3], ..Material::isotropic(0.15, 500.0, 0.3, 1e-5) }
    };
    material.strain_limit = material.strain_limit.map(|l| words.number("limit", l));
    material.friction = words.number("friction", material.friction);
    material
}

fn scene(dir: &Path, words: &Words) -> Scene {
    let (v, vt, f) = obj(&dir.join("garment.obj")).unwrap();
    let triangles = f
        .iter()
        .map(|t| Element {
            vertices: t.map(|c| u32::try_from(c[0]).unwrap()),
            rest: if vt.is_empty() { flat(t.map(|c| v[c[0]])) } else { t.map(|c| vt[c[1]]) },
            material: 0,
        })
        .collect();
    let mut scene = Scene {
        pins: numbers(&dir.join("pins.txt")).iter().map(|p| Pin { vertex: p[0], at: v[p[0] as usize] }).collect(),
        stitches: numbers(&dir.join("stitches.txt")).iter().map(|p| [p[0], p[1]]).collect(),
        body: obj(&dir.join("body.obj")).map(|(positions, _, f)| {
            let triangles = f.iter().map(|t| t.map(|c| u32::try_from(c[0]).unwrap())).collect();
            BodyMesh { positions, triangles }.into()
        }),
        gravity: if words.is("up", "y") { Vec3::new(0.0, -9.81, 0.0) } else { Vec3::new(0.0, 0.0, -9.81) },
        positions: v,
        triangles,
        materials: vec![fabric(words)],
        ..Scene::default()
    };
    if let Some(seed) = words.text("jitter") {
        jitter(&mut scene, seed.parse().unwrap());
    }
    let (vertices, triangles) = (scene.positions.len(), scene.triangles.len());
    println!(
        "{vertices} vertices, {triangles} triangles, {} stitches, {} pins",
        scene.stitches.len(),
        scene.pins.len()
    );
    scene
}

/// The settings of a run, changed by the words.
fn settings(s: Settings, words: &Words) -> Settings {
    let explicit = words.is("integrator", "explicit");
    Settings {
        model: if words.is("model", "springs") { Model::Springs } else { Model::Coupled },
        integrator: if explicit { Integrator::CentralDifference } else { Integrator::Static },
        explicit: ExplicitSteps {
            stiffness_cap: words.number("cap", s.explicit.stiffness_cap),
            damping: words.number("damping", s.explicit.damping),
            ..s.explicit
        },
        threads: words.number("threads", 1.0) as usize,
        equilibrium: Equilibrium {
            decrement_tolerance: words.number("decrement", s.equilibrium.decrement_tolerance),
            move_tolerance: words.number("move", s.equilibrium.move_tolerance),
            residual_tolerance: words.number("residual", s.equilibrium.residual_tolerance),
            ..s.equilibrium
        },
        effects: Effects {
            self_contact: words.switch("self", s.effects.self_contact),
            body_contact: words.switch("body", s.effects.body_contact),
            ..s.effects
        },
        ..s
    }
}

fn main() {
    let args: Vec<String> = std::env::args().collect();
    let words = Words(args.clone());
    let scene = scene(Path::new(&args[1]), &words);
    let verbose = words.text("verbose").is_some();
    let mut place = scene.positions.clone();
    let mut finish = scene.clone();
    let mut map: Vec<u32> = (0..u32::try_from(place.len()).unwrap()).collect();
    if !scene.stitches.is_empty() {
        let t = Instant::now();
        let mut settings = settings(Settings::sewing(), &words);
        settings.explicit.max_seconds = words.number("sew", 6.0);
        match sew(&scene, &settings, &mut Print(t, verbose)) {
            Ok(o) => {
                show("sew", &o, t);
                place = o.positions;
                save(&format!("{}.sewn.obj", args[2]), &place, &scene);
            }
            Err(e) => return println!("sew failed: {e}"),
        }
        let w = weld(&scene, &place);
        (finish, map) = (w.scene, w.map);
    }
    let t = Instant::now();
    let mut settings = settings(Settings::default(), &words);
    settings.explicit.max_seconds = words.number("seconds", 20.0);
    match drape(&finish, &settings, &mut Print(t, verbose)) {
        Ok(o) => {
            show("drape", &o, t);
            let t = Instant::now();
            let figures = certify(&finish, &settings, &o.positions).unwrap();
            println!("certificate in {:.2} s: {figures:?}", t.elapsed().as_secs_f64());
            place = map.iter().map(|i| o.positions[*i as usize]).collect();
        }
        Err(e) => println!("drape failed: {e}"),
    }
    save(&args[2], &place, &scene);
}

fn save(path: &str, x: &[Vec3], scene: &Scene) {
    let mut text = String::new();
    for p in x {
        // As a GLB would store them.
        #[allow(clippy::cast_possible_truncation)]
        let p = [p.x as f32, p.y as f32, p.z as f32];
        writeln!(text, "v {:.9} {:.9} {:.9}", p[0], p[1], p[2]).unwrap();
    }
    for t in &scene.triangles {
        let [a, b, c] = t.vertices.map(|v| v + 1);
        writeln!(text, "f {a} {b} {c}").unwrap();
    }
    std::fs::write(path, text).unwrap();
}
