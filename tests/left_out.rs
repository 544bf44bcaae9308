//! Effects that a build may leave out: what calls for one that is not there is refused by name, and what calls for none
//! comes to the same bytes in every build. Run it for a build without them, too: `cargo test --no-default-features
//! --test left_out`.

mod support;

use support::cloth::Cloth;
use support::mesh::Family;
use support::mesh::sheet::sheet;
use support::program::{Ended, run};
use support::trial::Trial;
use toile_garment::Vec3;

/// CPU time for a run, s.
const CAP: f64 = 60.0;
/// All that a scene can do without.
const NONE: [&str; 2] = ["effects.self-contact = \"off\"", "effects.bending-hysteresis = \"off\""];
/// Every effect, a key that calls for it, and is it in this build?
const ALL: [(&str, &str, bool); 3] = [
    ("self-contact", "effects.self-contact = \"on\"", cfg!(feature = "self-contact")),
    ("bending-hysteresis", "effects.bending-hysteresis = \"on\"", cfg!(feature = "bending-hysteresis")),
    ("pressure", "pressure = \"1 Pa\"", cfg!(feature = "pressure")),
];
/// Digest of the shape that a sheet comes to without any of them.
const SHAPE: &str = "2bd064acd258d27878f625b2340d3726ce2fcea87a6dee5728b20b552c55f1e4";

/// A sheet of 100 mm that hangs from two corners.
fn hung(keys: &[&str]) -> Ended {
    let level = sheet([0.1, 0.1], 8, 8, Family::Regular, |_| true).place(|[u, v]| Vec3::new(u, v, 0.0));
    let corners = level.pick(|[u, v]| v < 1e-4 && !(1e-4..0.0999).contains(&u));
    let cloth = Cloth::linear(0.15, 500.0, 190.0, 1e-5);
    let trial = keys.iter().fold(Trial::new(level, cloth).hold(corners), |trial, key| trial.set(key));
    let folder = tempfile::tempdir().expect("folder");
    trial.write(folder.path(), &[]).expect("project");
    run(folder.path(), CAP, &[])
}

/// The wanted effect, with the other effects off.
fn with(effect: &str, key: &str) -> Ended {
    let keys: Vec<&str> = NONE.into_iter().filter(|off| !off.contains(effect)).chain([key]).collect();
    hung(&keys)
}

#[test]
fn what_is_left_out_is_refused_by_name() {
    for (effect, key, there) in ALL {
        let ended = with(effect, key);
        if there {
            assert!(ended.output("final.obj").is_some(), "{effect}: {}", ended.said);
            continue;
        }
        assert_eq!(ended.code, 2, "{effect}: {}", ended.said);
        let finding = ended.findings().next().expect("a finding");
        assert_eq!((&finding["code"], &finding["severity"]), (&"effect-not-built".into(), &"error".into()));
        assert_eq!(finding["message"], format!("this build has no {effect}"));
        assert_eq!(ended.outputs().count(), 0, "{effect}: nothing is written");
    }
}

#[test]
fn without_them_every_build_comes_to_the_same_bytes() {
    let ended = hung(&NONE);
    assert_eq!(ended.code, 0, "{}", ended.said);
    let shape = ended.output("final.obj").expect("a shape");
    assert_eq!(blake3::hash(shape).to_hex().as_str(), SHAPE);
}
