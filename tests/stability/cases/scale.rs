//! F: scale and units.

use crate::case::{Case, case};
use crate::lab::Lab;
use crate::pattern::{Drawn, Pattern, rectangle};
use crate::scenes::{apart, ball, corners, cotton, del, lying, top, unequal, upright};
use crate::support::cloth::{Cloth, Law};
use crate::support::mesh::Mesh;
use crate::support::trial::Trial;
use toile_garment::Vec3;

pub fn cases() -> Vec<Case> {
    let mut list = Vec::new();
    for (name, per_metre) in [("25.4", 1000.0 / 25.4), ("10", 100.0), ("1000", 1.0), ("0.001", 1e6)] {
        list.push(
            case(format!("F1-pattern-{name}-times"), move |lab: &mut Lab| wrong_unit(lab, per_metre)).quick().once(),
        );
    }
    list.extend([
        case("F2-layout-far-away", far_layout).quick().once(),
        case("F2-scene-100m-away", far_scene).quick(),
        case("F4-power-of-two-hung", |lab: &mut Lab| similar(lab, false)).quick().once(),
        case("F4-power-of-two-ball", |lab: &mut Lab| similar(lab, true)).quick().once(),
        case("F4-and-gravity-hung", gravity_too).quick().once(),
        case("F5-double-force-hung", |lab: &mut Lab| stronger(lab, false, 2.0)).quick().once(),
        case("F5-fourfold-force-hung", |lab: &mut Lab| stronger(lab, false, 4.0)).quick().once(),
        case("F5-double-force-ball", |lab: &mut Lab| stronger(lab, true, 2.0)).quick().once(),
        case("F3-sheet-of-4mm", |lab: &mut Lab| sized(lab, 0.004)).quick(),
        case("F3-sheet-of-10m", |lab: &mut Lab| sized(lab, 10.0)).quick(),
        case("F3-sheet-of-100m-refused", hall).quick().once(),
        case("F6-tenfold-hung", |lab: &mut Lab| tenfold(lab, &straight())).quick().once(),
        case("F6-tenfold-corners", |lab: &mut Lab| tenfold(lab, &scene(false))).quick().once(),
        case("F7-doll", doll).quick(),
    ]);
    list
}

/// Pieces whose file says another unit than they were drawn in.
fn wrong_unit(lab: &mut Lab, per_metre: f64) -> Result<(), String> {
    let front = Drawn::at("front", &rectangle(300.0, 400.0), [0.0, 0.0, 100.0]);
    let back = Drawn::at("back", &rectangle(300.0, 400.0), [300.0, 0.0, -100.0]).facing(180.0);
    let seams = vec![[("front", 1), ("back", 3)], [("front", 3), ("back", 1)]];
    let pattern = Pattern { per_metre, ..Pattern::new(vec![front, back], seams, cotton()) };
    let run = lab.program(&[], |folder| pattern.write(folder, None))?;
    lab.expect(run.code == 2 || run.code == 3, format!("exit code {}: {}", run.code, run.said));
    lab.refusal(&run, "piece-size");
    Ok(())
}

fn scene(on_ball: bool) -> Trial {
    if on_ball {
        return Trial::new(lying(del(0.25, 0.03125), 0.127), cotton()).over(ball(0.125, Vec3::zeros(), 3));
    }
    let cloth = upright(del(0.25, 0.03125));
    let held = corners(&cloth);
    Trial::new(cloth, cotton()).hold(held)
}

/// Held by its whole upper edge: it cannot come to rest in two ways.
fn straight() -> Trial {
    let cloth = upright(del(0.25, 0.03125));
    let held = top(&cloth);
    Trial::new(cloth, cotton()).hold(held)
}

/// A layout drawn a kilometre from its origin.
fn far_layout(lab: &mut Lab) -> Result<(), String> {
    let near = scene(false);
    let mut far = near.clone();
    far.cloth.rest.iter_mut().for_each(|r| *r = [r[0] + 1000.0, r[1] - 500.0]);
    let (d, e) = (lab.settles(&near)?, lab.settles(&far)?);
    lab.below("off by m", apart(&d.at, &e.at), 1e-6);
    Ok(())
}

/// The scene itself a hundred metres off: the exported numbers are single precision.
fn far_scene(lab: &mut Lab) -> Result<(), String> {
    let near = lab.shaken(&straight());
    let (d, e) = (lab.settles_as_is(&near)?, lab.settles_as_is(&moved(&near, Vec3::new(64.0, 128.0, 0.0)))?);
    let back: Vec<Vec3> = e.at.iter().map(|p| p - Vec3::new(64.0, 128.0, 0.0)).collect();
    lab.below("off by m", apart(&d.at, &back), 1e-4);
    Ok(())
}

fn moved(t: &Trial, by: Vec3) -> Trial {
    let shift = |m: &Mesh| Mesh { at: m.at.iter().map(|p| p + by).collect(), ..m.clone() };
    let pins = t.pins.iter().map(|(v, p)| (*v, p + by)).collect();
    Trial { cloth: shift(&t.cloth), body: t.body.as_ref().map(shift), pins, ..t.clone() }
}

fn stiffer(law: Law, times: f64) -> Law {
    match law {
        Law::Linear(k) => Law::Linear(k * times),
        law => law,
    }
}

fn larger(m: &Mesh, times: f64) -> Mesh {
    let rest = m.rest.iter().map(|r| [r[0] * times, r[1] * times]).collect();
    Mesh { at: m.at.iter().map(|p| p * times).collect(), rest, triangles: m.triangles.clone() }
}

/// Lengths times `s`, with the cloth that looks the same at that size: the same weight and friction.
fn similarity(t: &Trial, s: f64) -> Trial {
    let f = t.fabric;
    // Force per width goes with the weight below, s; per strain. Moments go with s³ per width.
    let fabric = Cloth {
        thickness: f.thickness * s,
        warp: stiffer(f.warp, s),
        weft: stiffer(f.weft, s),
        shear: f.shear * s,
        bending: f.bending * s * s * s,
        ..f
    };
    let pins = t.pins.iter().map(|(v, p)| (*v, p * s)).collect();
    let body = t.body.as_ref().map(|b| larger(b, s));
    Trial { cloth: larger(&t.cloth, s), body, fabric, pins, ..t.clone() }
}

/// Four times as large with the cloth that fits: the same shape, bit for bit.
fn similar(lab: &mut Lab, on_ball: bool) -> Result<(), String> {
    let mut one = scene(on_ball);
    let mut four = similarity(&one, 4.0);
    let gaps = |m: f64| ["body_gap", "self_gap"].map(|gap| format!("{gap} = \"{m} m\"")).to_vec();
    (one.drape, four.drape) = (gaps(0.001), gaps(0.004));
    let (d, e) = (lab.settles(&one)?, lab.settles(&four)?);
    let wrong = unequal(&d.at, &e.at, |p| p / 4.0);
    let back: Vec<Vec3> = e.at.iter().map(|p| p / 4.0).collect();
    lab.expect(
        wrong == 0,
        format!("{wrong} of {} vertices differ, by up to {:.1e} m", d.at.len(), apart(&d.at, &back)),
    );
    Ok(())
}

/// Four times as large under four times the gravity, so that times stay: the same shape, bit for bit.
fn gravity_too(lab: &mut Lab) -> Result<(), String> {
    let one = scene(false);
    let four = similarity(&one, 4.0);
    let f = four.fabric;
    let fabric = Cloth {
        warp: stiffer(f.warp, 4.0),
        weft: stiffer(f.weft, 4.0),
        shear: 4.0 * f.shear,
        bending: 4.0 * f.bending,
        ..f
    };
    let (d, e) = (lab.settles(&one)?, lab.settles(&Trial { fabric, gravity: 4.0 * one.gravity, ..four })?);
    let back: Vec<Vec3> = e.at.iter().map(|p| p / 4.0).collect();
    let wrong = unequal(&d.at, &back, |p| p);
    lab.expect(
        wrong == 0,
        format!("{wrong} of {} vertices differ, by up to {:.1e} m", d.at.len(), apart(&d.at, &back)),
    );
    Ok(())
}

/// So many times as heavy and stiff: the same shape, bit for bit.
fn stronger(lab: &mut Lab, on_ball: bool, times: f64) -> Result<(), String> {
    let one = scene(on_ball);
    let f = one.fabric;
    let fabric = Cloth {
        mass: times * f.mass,
        warp: stiffer(f.warp, times),
        weft: stiffer(f.weft, times),
        shear: times * f.shear,
        bending: times * f.bending,
        ..f
    };
    let (d, e) = (lab.settles(&one)?, lab.settles(&Trial { fabric, ..one.clone() })?);
    let wrong = unequal(&d.at, &e.at, |p| p);
    lab.expect(
        wrong == 0,
        format!("{wrong} of {} vertices differ, by up to {:.1e} m", d.at.len(), apart(&d.at, &e.at)),
    );
    Ok(())
}

/// A hung sheet of another size, in cloth that fits: nothing but U, and the shape of the sheet of 0.25 m.
fn sized(lab: &mut Lab, side: f64) -> Result<(), String> {
    let one = lab.shaken(&scene(false));
    let s = side / 0.25;
    let (d, e) = (lab.settles_as_is(&one)?, lab.settles_as_is(&similarity(&one, s))?);
    let back: Vec<Vec3> = e.at.iter().map(|p| p / s).collect();
    lab.below("off by, of its side", apart(&d.at, &back) / 0.25, 0.01);
    Ok(())
}

/// Ten times as large with the cloth that fits, which rounds every number anew: the same shape to a millionth of the
/// side. Only from an even start: from a shaken one the two come to rest by other steps.
fn tenfold(lab: &mut Lab, one: &Trial) -> Result<(), String> {
    let (mut one, mut ten) = (one.clone(), similarity(one, 10.0));
    let gaps = |m: f64| ["body_gap", "self_gap"].map(|gap| format!("{gap} = \"{m} m\"")).to_vec();
    (one.drape, ten.drape) = (gaps(0.001), gaps(0.01));
    let (d, e) = (lab.settles(&one)?, lab.settles(&ten)?);
    let back: Vec<Vec3> = e.at.iter().map(|p| p / 10.0).collect();
    lab.below("off by, of its side", apart(&d.at, &back) / 0.25, 1e-6);
    Ok(())
}

/// Cloth that fits a sheet of 100 m is thicker than any.
fn hall(lab: &mut Lab) -> Result<(), String> {
    lab.refuses(&similarity(&scene(false), 400.0), 3, "value-out-of-range")
}

/// A sixth of the size in the cloth of people.
fn doll(lab: &mut Lab) -> Result<(), String> {
    let s = 1.0 / 6.0;
    let one = scene(true);
    let body = one.body.as_ref().map(|b| larger(b, s));
    let small = Trial { cloth: larger(&one.cloth, s), body, ..one };
    let up = Vec3::z() * 2e-3;
    let cloth = Mesh { at: small.cloth.at.iter().map(|p| p + up).collect(), ..small.cloth.clone() };
    // So small, it lies on the ball like a plate and may slide off: its middle is held.
    let far = |v: &usize| libm::hypot(cloth.at[*v].x, cloth.at[*v].y);
    let middle = (0..cloth.at.len()).min_by(|a, b| far(a).total_cmp(&far(b)));
    lab.settles(&Trial { cloth, ..small }.hold(middle))?;
    Ok(())
}
