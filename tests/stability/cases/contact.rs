//! E: contact. Cloth against blades, tips, rods, balls, boxes, and against itself.

use crate::case::{Case, case};
use crate::lab::Lab;
use crate::scenes::{
    apart, ball, blade, block, body, cotton, del, even, lying, quarter_turns, rod, rolled, sag, spike, top, turned,
    upright,
};
use crate::support::cloth::Cloth;
use crate::support::draped::Draped;
use crate::support::mesh::Mesh;
use crate::support::trial::Trial;
use toile_garment::Vec3;

/// Start above what is met, m: outside of every gap.
const OVER: f64 = 2e-3;
/// Rays that look at the order of layers.
const RAYS: u32 = 10_000;

pub fn cases() -> Vec<Case> {
    let mut list = vec![
        case("E1-knife", |lab: &mut Lab| rests(lab, blade(0.02, 0.6))).quick(),
        case("E1-fin", |lab: &mut Lab| rests(lab, fin())).quick(),
        case("E2-cone-2deg", |lab: &mut Lab| rests(lab, spike(Vec3::zeros(), f64::to_radians(2.0), 0.4, 12))).quick(),
        case("E3-rod-1mm", |lab: &mut Lab| rests(lab, rod(5e-4, 0.6, 12))).quick(),
        case("E3-polyline", polyline).quick().once(),
        case("E4-needles", needles),
        case("E6-start-5mm-inside", |lab: &mut Lab| sunk(lab, -5e-3)).quick(),
        case("E6-start-fully-inside", |lab: &mut Lab| sunk(lab, -0.1)).quick().once(),
        case("E7-two-crossed", |lab: &mut Lab| crossed(lab, 2)).quick(),
        case("E7-ten-crossed", |lab: &mut Lab| crossed(lab, 10)).quick(),
        case("E7-sheet-through-itself", through_itself).quick().once(),
        case("E8-touching-body", touching_body).quick(),
        case("E8-coincident-sheets", coincident).quick(),
        case("E9-open-body", open_body).quick(),
        case("E10-inside-out-body", inside_out).quick().once(),
        case("E12-body-through-itself", |lab: &mut Lab| rests(lab, arm_in_trunk())).quick(),
        case("E14-tight-tube", tight_tube),
        case("E15-five-sheets", stack),
        case("E16-folded", folded),
        case("E31-led-edge-pulls-the-sheet-along", led_from_flat),
        case("E31-led-edge-of-a-folded-sheet", led_when_folded).quick(),
    ];
    list.extend(erleben());
    for (name, angle) in [("0", 0.0), ("1e-12", 1e-12), ("1e-8", 1e-8), ("1e-4", 1e-4)] {
        list.push(case(format!("E26-parallel-{name}"), move |lab: &mut Lab| beside(lab, angle)).quick());
    }
    list
}

/// A sheet falls on the highest point of the body and stays there.
fn rests(lab: &mut Lab, obstacle: Mesh) -> Result<(), String> {
    let high = obstacle.at.iter().map(|p| p.z).fold(f64::NEG_INFINITY, f64::max);
    let d = lab.settles(&Trial::new(lying(del(0.3, 0.015), high + OVER), cotton()).over(obstacle))?;
    let highest = d.at.iter().map(|p| p.z).fold(f64::NEG_INFINITY, f64::max);
    lab.expect(highest > high, format!("nothing of it is above the body: {highest:.4} m"));
    Ok(())
}

/// Two triangles without thickness, upright.
fn fin() -> Mesh {
    let at = [(-0.3, -0.3), (0.3, -0.3), (0.3, 0.0), (-0.3, 0.0)].map(|(y, z)| Vec3::new(0.0, y, z));
    body(at.to_vec(), vec![[0, 1, 2], [0, 2, 3]])
}

/// A body that is a line has no surface.
fn polyline(lab: &mut Lab) -> Result<(), String> {
    let trial = Trial::new(lying(del(0.2, 0.02), OVER), cotton()).over(fin());
    lab.refuses(&trial.text("body.obj", "v 0 -1 0\nv 0 1 0\nl 1 2\n".to_owned()), 3, "obj-empty")
}

/// Over a bed of needles, two corners drawn aside.
fn needles(lab: &mut Lab) -> Result<(), String> {
    let mut bed = Mesh::default();
    for (i, j) in (0..6).flat_map(|i| (0..6).map(move |j| (i, j))) {
        let at = Vec3::new(0.06 * (f64::from(i) - 2.5), 0.06 * (f64::from(j) - 2.5), 0.0);
        bed.join(&spike(at, f64::to_radians(4.0), 0.15, 6));
    }
    let cloth = lying(del(0.3, 0.012), OVER);
    let held = cloth.pick(|[u, v]| u < 1e-9 && !(1e-9..=0.3 - 1e-9).contains(&v));
    let away = Vec3::new(-0.08, 0.0, 0.01);
    lab.settles(&Trial::new(cloth, cotton()).over(bed).lead(held, |p| p + away))?;
    Ok(())
}

/// The start dips into a ball: it is pushed out, or refused.
fn sunk(lab: &mut Lab, depth: f64) -> Result<(), String> {
    let cloth = lying(del(0.2, 0.015), 0.2 + depth);
    let trial = Trial::new(cloth, cotton()).over(ball(0.2, Vec3::zeros(), 3));
    lab.settles_or_refuses(&trial, "start-crosses").map(drop)
}

/// Upright strips through a level sheet, held by their upper edges: refused or freed.
fn crossed(lab: &mut Lab, strips: usize) -> Result<(), String> {
    let mut cloth = lying(even(0.2, 0.2, 0.02), -0.05);
    let mut held = cloth.pick(|[u, _]| u < 1e-9);
    for i in 0..strips {
        let strip = upright(even(0.1, 0.1, 0.02));
        let shift = Vec3::new(0.003, -0.08 + 0.016 * i as f64, 0.001);
        let first = cloth.join(&Mesh { at: strip.at.iter().map(|p| p + shift).collect(), ..strip.clone() });
        held.extend(top(&strip).into_iter().map(|v| v + first));
    }
    lab.settles_or_refuses(&Trial::new(cloth, cotton()).hold(held), "start-crosses").map(drop)
}

/// A strip rolled up so far that its end goes through its beginning.
fn through_itself(lab: &mut Lab) -> Result<(), String> {
    let strip = even(0.3, 0.1, 0.01);
    let knot = |[u, v]: [f64; 2]| {
        let a = 7.5 * u / 0.3;
        let r = 0.04 + 0.01 * libm::sin(2.0 * a);
        Vec3::new(r * libm::cos(a), r * libm::sin(a), v)
    };
    let cloth = strip.place(knot);
    let held = top(&cloth);
    lab.refuses(&Trial::new(cloth, cotton()).hold(held), 3, "start-crosses")
}

/// Laid on a box to the bit.
fn touching_body(lab: &mut Lab) -> Result<(), String> {
    let table = block(Vec3::new(-0.5, -0.5, -0.25), Vec3::new(0.5, 0.5, 0.0));
    let d = lab.settles_or_refuses(&Trial::new(lying(del(0.2, 0.02), 0.0), cotton()).over(table), "start-crosses")?;
    if let Some(d) = d {
        let lowest = d.at.iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
        lab.expect(
            lowest > 0.0 && sag(&d.at) < 1e-3,
            format!("lies {lowest:.6} m over the box, {:.6} m high", sag(&d.at)),
        );
    }
    Ok(())
}

/// Two sheets at bit-equal places over a box.
fn coincident(lab: &mut Lab) -> Result<(), String> {
    let mut cloth = lying(even(0.2, 0.2, 0.02), 0.003);
    // Laid out side by side: no cut through one cloth.
    let rest = cloth.rest.iter().map(|[u, v]| [u + 1.0, *v]).collect();
    let other = Mesh { rest, ..cloth.clone() };
    cloth.join(&other);
    let table = block(Vec3::new(-0.5, -0.5, -0.25), Vec3::new(0.5, 0.5, 0.0));
    lab.settles_or_refuses(&Trial::new(cloth, cotton()).over(table), "start-crosses").map(drop)
}

/// A ball with a hole on its underside.
fn open_body(lab: &mut Lab) -> Result<(), String> {
    let mut b = ball(0.1, Vec3::zeros(), 3);
    b.triangles.retain(|t| t.iter().any(|v| b.at[*v].z > -0.095));
    let trial = lab.shaken(&Trial::new(lying(del(0.3, 0.015), 0.1 + OVER), cotton()).over(b));
    let run = lab.run(&trial, &[])?;
    lab.expect(run.findings().any(|f| f["code"] == "body-open"), "no word about the open body");
    rests(lab, trial.body.ok_or("a body")?)
}

/// Faces that look inwards: the same drape, and a word about it.
fn inside_out(lab: &mut Lab) -> Result<(), String> {
    let scene = |b: Mesh| Trial::new(lying(del(0.3, 0.02), 0.1 + OVER), cotton()).over(b);
    let right = ball(0.1, Vec3::zeros(), 3);
    let mut wrong = right.clone();
    wrong.triangles.iter_mut().for_each(|t| t.swap(1, 2));
    let d = lab.settles(&scene(right.clone()))?;
    // The checks ask for the right way round.
    let run = lab.run(&scene(wrong), &[])?;
    let e = Draped::read(&run)?;
    lab.below("off by m", apart(&d.at, &e.at), 1e-6);
    lab.expect(run.findings().any(|f| f["code"] == "body-inside-out"), "no word about the faces");
    let mut half = right;
    half.triangles.iter_mut().step_by(2).for_each(|t| t.swap(1, 2));
    lab.refuses(&scene(half), 3, "body-faces-mixed")
}

/// A box with an arm that begins 10 mm inside it.
fn arm_in_trunk() -> Mesh {
    let mut trunk = block(Vec3::new(-0.06, -0.06, -0.3), Vec3::new(0.06, 0.06, 0.0));
    trunk.join(&block(Vec3::new(0.05, -0.02, -0.1), Vec3::new(0.15, 0.02, -0.06)));
    trunk
}

/// A tube of cloth a fifth too small, let on to a cylinder from a stretched start: the ring carries `k ε / R`.
fn tight_tube(lab: &mut Lab) -> Result<(), String> {
    let (radius, length) = (0.1, 0.2);
    let girth = std::f64::consts::TAU * (radius + 1e-3 + 5e-5) / 1.25;
    let cloth = even(girth, length, girth / 36.0);
    let on = rolled(cloth, 1.27);
    let stitches = on.round(girth);
    let at = on.at.iter().map(|p| p - Vec3::z() * (0.5 * length)).collect();
    let fabric = Cloth { limit: 0.6, ..cotton() };
    let mut trial = Trial::new(Mesh { at, ..on }, fabric).weightless();
    trial.stitches = stitches;
    trial.body = Some(turned(&[[radius, -0.3], [radius, 0.3]], 144));
    let d = lab.settles(&trial)?;
    let mean = d.at.iter().map(|p| libm::hypot(p.x, p.y)).sum::<f64>() / d.at.len() as f64;
    // Along the hem the tube gets narrower by nothing; its strain is that of the ring.
    lab.near("radius m", mean, radius + 1e-3 + 5e-5, 0.01);
    Ok(())
}

/// Five sheets on a ball keep their order.
fn stack(lab: &mut Lab) -> Result<(), String> {
    let mut cloth = Mesh::default();
    let layer = del(0.24, 0.024);
    let n = layer.rest.len();
    for k in 0..5 {
        cloth.join(&lying(layer.clone(), 0.1 + OVER + 0.003 * f64::from(k)));
    }
    let trial = Trial::new(cloth, cotton()).over(ball(0.1, Vec3::zeros(), 3));
    let d = lab.settles(&trial)?;
    // Seen from the ball's middle, within 30° of the top, where nothing folds.
    let layer_of = |t: &[usize; 3]| t[0] / n;
    let mut wrong = 0;
    for k in 0..RAYS {
        let (a, c) = (2.4 * f64::from(k), 1.0 - 0.13 * f64::from(k) / f64::from(RAYS));
        let s = (1.0 - c * c).sqrt();
        let ray = Vec3::new(s * libm::cos(a), s * libm::sin(a), c);
        let mut hits: Vec<(f64, usize)> =
            trial.cloth.triangles.iter().filter_map(|t| Some((hit(&ray, t.map(|v| d.at[v]))?, layer_of(t)))).collect();
        hits.sort_by(|p, q| p.0.total_cmp(&q.0));
        wrong += usize::from(hits.iter().map(|h| h.1).ne(0..5));
    }
    lab.expect(wrong == 0, format!("{wrong} of {RAYS} rays meet the layers in another order"));
    Ok(())
}

/// How far along a ray from the origin it meets a triangle.
pub fn hit(ray: &Vec3, [a, b, c]: [Vec3; 3]) -> Option<f64> {
    let inside = |p: &Vec3, q: &Vec3| ray.dot(&p.cross(q));
    let s = [inside(&a, &b), inside(&b, &c), inside(&c, &a)];
    let through = s.iter().all(|v| *v > 0.0) || s.iter().all(|v| *v < 0.0);
    let normal = (b - a).cross(&(c - a));
    (through && ray.dot(&normal) != 0.0).then(|| a.dot(&normal) / ray.dot(&normal)).filter(|t| *t > 0.0)
}

/// Folded flat twice and let go on a table: the layers stay apart.
fn folded(lab: &mut Lab) -> Result<(), String> {
    let (w, gap) = (0.24, 1.2e-3);
    // Three folds along u, half circles of the gap between the layers.
    let leg = w / 3.0;
    let place = move |[u, v]: [f64; 2]| {
        let k = (u / leg).min(2.999_999).floor();
        let s = u - k * leg;
        let x = if k == 1.0 { leg - s } else { s };
        Vec3::new(x, v, 0.002 + gap * k + gap * libm::pow(s / leg, 8.0))
    };
    let cloth = even(w, 0.16, 0.01).place(place);
    let table = block(Vec3::new(-0.5, -0.5, -0.25), Vec3::new(0.5, 0.5, 0.0));
    lab.settles(&Trial::new(cloth, cotton()).over(table))?;
    Ok(())
}

/// A stiff sheet of 0.28 m on a table; one edge is led over the other along a straight line. Its bending length is 73 mm.
fn led(lab: &mut Lab, start: impl Fn(f64) -> [f64; 2]) -> Result<Draped, String> {
    let (length, width) = (0.28, 0.21);
    let place = |[u, v]: [f64; 2]| {
        let [y, z] = start(v);
        Vec3::new(u - 0.5 * width, y, z)
    };
    let cloth = even(width, length, 0.014).place(place);
    let edge = cloth.pick(|[_, v]| v > length - 1e-9);
    let table = block(Vec3::new(-0.6, -0.6, -0.02), Vec3::new(0.6, 0.6, 0.0));
    let to = |p: Vec3| Vec3::new(p.x, -0.12, 0.012);
    lab.settles(&Trial::new(cloth, Cloth::linear(0.08, 20_000.0, 8_000.0, 3e-4)).over(table).lead(edge, to))
}

/// Friction holds μ w L = 0.07 N/m. To push a sheet out of its plane takes more: about 2 π² B/λ² = 0.6 N/m. An edge at
/// h = 12 mm lifts λ = (24 B h/w)^(1/4) = 0.1 m of it. So it is pulled along and stays flat.
fn led_from_flat(lab: &mut Lab) -> Result<(), String> {
    let rest = led(lab, |v| [v - 0.14, 1.2e-3])?;
    let farthest = rest.at.iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
    lab.near("place of the free edge", farthest, -0.12 - 0.28, 0.01);
    let highest = rest.at.iter().map(|p| p.z).fold(0.0, f64::max);
    lab.below("height of the sheet", highest, 0.013);
    Ok(())
}

/// Folded over by hand, the same sheet stays folded, smoothly: its fold pushes with less than friction holds.
fn led_when_folded(lab: &mut Lab) -> Result<(), String> {
    let (flat, r) = (0.14, 0.03);
    let turn = std::f64::consts::PI * r;
    let rest = led(lab, |v| match v - flat {
        s if s <= 0.0 => [s, 1.2e-3],
        s if s <= turn => [r * libm::sin(s / r), 1.2e-3 + r - r * libm::cos(s / r)],
        s => [turn - s, 1.2e-3 + 2.0 * r],
    })?;
    let free = rest.at.iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
    lab.near("place of the free edge", free, -0.14, 0.02);
    // An unloaded loop of 0.18 m between edges 12 mm apart is a third as high; weight presses it down by less than half.
    let highest = rest.at.iter().map(|p| p.z).fold(0.0, f64::max);
    lab.expect((0.03..0.075).contains(&highest), format!("the fold is {highest:.3} m high"));
    let push = rest.reactions.values().map(|f| f.y).sum::<f64>().abs();
    lab.below("push of the fold, N", push, 0.3 * 0.08 * 9.81 * 0.28 * 0.21);
    lab.below("largest strain", rest.figure("strain_max"), 2e-3);
    Ok(())
}

/// The obstacles of Erleben against a corner and an edge of cloth, soft and stiff.
fn erleben() -> Vec<Case> {
    let tip = || spike(Vec3::zeros(), f64::to_radians(10.0), 0.3, 8);
    let crack = || {
        let mut b = block(Vec3::new(-0.2, -0.2, -0.2), Vec3::new(-2e-3, 0.2, 0.0));
        b.join(&block(Vec3::new(2e-3, -0.2, -0.2), Vec3::new(0.2, 0.2, 0.0)));
        b
    };
    let hole = || {
        let (o, i) = (0.2, 0.01);
        let mut b = block(Vec3::new(-o, -o, -0.2), Vec3::new(-i, o, 0.0));
        b.join(&block(Vec3::new(i, -o, -0.2), Vec3::new(o, o, 0.0)));
        b.join(&block(Vec3::new(-i, i, -0.2), Vec3::new(i, o, 0.0)));
        b.join(&block(Vec3::new(-i, -o, -0.2), Vec3::new(i, -i, 0.0)));
        b
    };
    type Scene = (&'static str, Mesh, fn() -> Mesh);
    let scenes: [Scene; 7] = [
        ("E18-spike-spike", tip(), corner_down),
        ("E19-spike-wedge", blade(0.1, 0.4), corner_down),
        ("E20-wedge-wedge", blade(0.1, 0.4), edge_down),
        ("E21-spike-hole", hole(), corner_down),
        ("E22-spike-crack", crack(), corner_down),
        ("E23-wedge-crack", crack(), edge_along),
        ("E24-cliff", block(Vec3::new(-0.3, -0.3, -0.2), Vec3::new(0.0, 0.3, 0.0)), half_over),
    ];
    let mut list = Vec::new();
    for (name, obstacle, cloth) in scenes {
        for (kind, bending) in [("soft", 1e-5), ("stiff", 1e-2)] {
            let obstacle = obstacle.clone();
            let run = move |lab: &mut Lab| meets(lab, obstacle.clone(), cloth(), bending);
            list.push(case(format!("{name}-{kind}"), run).quick());
        }
    }
    list
}

/// Hanging cloth is held at its highest vertices and lowered by 30 mm; lying cloth is let go.
fn meets(lab: &mut Lab, obstacle: Mesh, cloth: Mesh, bending: f64) -> Result<(), String> {
    let high = cloth.at.iter().map(|p| p.z).fold(f64::NEG_INFINITY, f64::max);
    let hangs = sag(&cloth.at) > 0.01;
    let held: Vec<usize> = (0..cloth.at.len()).filter(|v| hangs && cloth.at[*v].z > high - 1e-6).collect();
    let trial = Trial::new(cloth, Cloth { bending, ..cotton() }).over(obstacle).lead(held, |p| p - Vec3::z() * 0.03);
    lab.settles(&trial)?;
    Ok(())
}

/// A square held by one corner over the opposite one.
fn corner_down() -> Mesh {
    let s = std::f64::consts::FRAC_1_SQRT_2;
    del(0.15, 0.012).place(|[u, v]| Vec3::new(s * (u - v), 0.0, s * (u + v) + OVER))
}

/// Upright, its lower edge across a blade.
fn edge_down() -> Mesh {
    let m = upright(del(0.15, 0.012));
    Mesh { at: m.at.iter().map(|p| p + Vec3::z() * (0.15 + OVER)).collect(), ..m }
}

/// Upright, its lower edge along y.
fn edge_along() -> Mesh {
    let m = edge_down();
    Mesh { at: m.at.iter().map(|p| quarter_turns(*p, 1)).collect(), ..m }
}

/// A third of it stands out over the edge at x = 0.
fn half_over() -> Mesh {
    let m = lying(del(0.15, 0.012), OVER);
    Mesh { at: m.at.iter().map(|p| p - Vec3::x() * 0.025).collect(), ..m }
}

/// Two upright sheets side by side, half a thickness apart, one of them turned by `angle`.
fn beside(lab: &mut Lab, angle: f64) -> Result<(), String> {
    let mut cloth = upright(even(0.1, 0.1, 0.0125));
    let (t, n) = (cotton().thickness, cloth.at.len());
    let mut held = top(&cloth);
    let (s, c) = (libm::sin(angle), libm::cos(angle));
    let shift = |p: &Vec3| {
        let (x, z) = (p.x + 0.05, p.z);
        Vec3::new(0.05 + 0.5 * t + c * x, s * x, z)
    };
    let other = Mesh { at: cloth.at.iter().map(shift).collect(), ..cloth.clone() };
    cloth.join(&other);
    held.extend(held.clone().into_iter().map(|v| v + n));
    let trial = Trial::new(cloth, cotton()).hold(held);
    let start = trial.cloth.at.clone();
    let d = lab.settles(&trial)?;
    // The gap of half a thickness opens to the distance of cloth from cloth; nobody is thrown aside.
    lab.below("moved m", apart(&start, &d.at), 0.02);
    Ok(())
}
