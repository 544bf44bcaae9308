//! The certificate of a motion, through the whole program: garbage does not pass.

use crate::support;
use support::bench::{Bench, HEAD};

/// A level sheet of 1 m that falls for half a second, with more parameters of `animate`.
fn falls(more: &str) -> Bench {
    let bench = Bench::new();
    let folder = bench.pipeline_file().parent().expect("folder").to_path_buf();
    let n = 20;
    let at = |i: usize, j: usize| (i as f64 / n as f64, j as f64 / n as f64);
    let mut text = String::new();
    for (j, i) in (0..=n).flat_map(|j| (0..=n).map(move |i| (j, i))) {
        let (x, z) = at(i, j);
        text.push_str(&format!("v {x} 5 {z}\n"));
    }
    for (j, i) in (0..n).flat_map(|j| (0..n).map(move |i| (j, i))) {
        let v = |i: usize, j: usize| j * (n + 1) + i + 1;
        text.push_str(&format!("f {} {} {}\n", v(i, j), v(i, j + 1), v(i + 1, j)));
        text.push_str(&format!("f {} {} {}\n", v(i + 1, j), v(i, j + 1), v(i + 1, j + 1)));
    }
    std::fs::write(folder.join("cloth.obj"), text).expect("mesh");
    let fabric = "name = \"stiff\"\nareal_mass = \"0.15 kg/m2\"\nthickness = \"0.1 mm\"\nfriction = 0.3\n\
        strain_limit_warp = \"20 %\"\nstrain_limit_weft = \"20 %\"\n[linear]\nstretch_warp = \"8000 N/m\"\n\
        stretch_weft = \"8000 N/m\"\nshear = \"900 N/m/rad\"\nbending = \"1e-5 N.m\"\npoisson = 0.0\n";
    std::fs::write(folder.join("fabric.toml"), fabric).expect("fabric");
    let stages = "[[stage]]\nuse = \"import-mesh\"\nwith.cloth = \"cloth.obj\"\nwith.fabric = \"fabric.toml\"\n\
        [[stage]]\nuse = \"drape\"\nwith.gravity = \"0 m/s2\"\n\
        [[stage]]\nuse = \"animate\"\nwith.frames = 31\nwith.fps = 60.0\nwith.air = \"off\"\nwith.calming = \"0 s\"\n";
    bench.text(&format!("{HEAD}{stages}{more}"));
    bench
}

#[test]
fn a_free_fall_is_certified_by_both_integrators() {
    for more in ["", "with.integrator = \"central-difference\"\n"] {
        let bench = falls(more);
        assert_eq!(bench.run(&[]).code, 0, "{more}: {}", bench.record()["findings"]);
        let motion = &bench.record()["motion"];
        assert_eq!(motion["passed"], true, "{motion}");
        assert!(motion["fall_error"].as_f64().is_some_and(|e| e < 1e-3), "{more}: {motion}");
        assert!(motion["energy_gain"].as_f64().is_some_and(|e| e < 0.02), "{more}: {motion}");
    }
}

#[test]
fn steps_held_beyond_the_stable_one_do_not_pass() {
    let bench = falls("with.integrator = \"central-difference\"\nwith.fixed_step = true\n");
    assert_eq!(bench.run(&[]).code, 1);
    let record = bench.record();
    let told = |f: &serde_json::Value| f["code"] == "motion-gate";
    assert!(record["findings"].as_array().is_some_and(|list| list.iter().any(told)), "{}", record["findings"]);
    let motion = &record["motion"];
    assert_eq!(motion["passed"], false, "{motion}");
    assert!(motion["energy_gain"].as_f64().is_some_and(|gain| gain > 0.9), "{motion}");
    assert!(motion["fall_error"].as_f64().is_some_and(|error| error > 0.9), "{motion}");
}
