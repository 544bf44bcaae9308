use super::read;
use std::path::Path;
use toile_garment::fabric::{Fabric, StretchLaw};

const LINEAR: &str = "name = \"t\"\nareal_mass = \"150 g/m2\"\nthickness = \"0.5 mm\"\nfriction = 0.3\n\
    [linear]\nstretch_warp = \"500 N/m\"\nstretch_weft = \"300 N/m\"\npoisson = 0.2\nshear = \"40 N/m/rad\"\n\
    bending = \"1e-5 N.m\"\n";

fn codes(text: &str) -> Vec<String> {
    read(text, "f.toml").expect_err("refused").into_iter().map(|d| d.code).collect()
}

fn sample(name: &str) -> Fabric {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../samples/fabrics").join(name);
    let text = std::fs::read_to_string(&path).expect("sample fabric");
    read(&text, name).unwrap_or_else(|e| panic!("{name}: {e:?}"))
}

#[test]
fn every_sample_reproduces_its_law() {
    // K0 and beta: warp, weft; from EMT and LT by a solver of its own.
    let cases = [
        ("silk-habotai.toml", [6784.19, 51.993], [3113.78, 15.374]),
        ("cotton-shirting.toml", [7117.2, 35.141], [3113.78, 15.374]),
        ("linen-plain.toml", [17857.04, 30.182], [8928.52, 15.091]),
        ("wool-suiting.toml", [1945.33, 53.442], [1215.83, 33.401]),
        ("denim-11oz.toml", [6227.55, 30.748], [3558.6, 17.57]),
        ("cotton-jersey.toml", [543.93, 6.354], [213.05, 3.791]),
    ];
    for (name, warp, weft) in cases {
        let fabric = sample(name);
        for (law, [k, b]) in [(&fabric.stretch_warp, warp), (&fabric.stretch_weft, weft)] {
            let StretchLaw::Exponential { k0, beta } = law else { panic!("{name}: {law:?}") };
            assert!((k0 / k - 1.0).abs() < 1e-3 && (beta / b - 1.0).abs() < 1e-3, "{name}: {k0} {beta}");
        }
        assert!(fabric.sources.values().all(|s| !s.written.is_empty()), "{name}");
        assert_eq!(fabric.sources["stretch_warp"].method, "KES-F");
    }
    let denim = sample("denim-11oz.toml");
    assert_eq!(denim.areal_mass, 0.36);
    assert!((denim.bend_warp - 80e-6).abs() < 1e-18 && (denim.shear - 130.0).abs() < 1e-12);
    assert_eq!((denim.strain_limit_warp, denim.strain_limit_bias), (0.04, None));
    assert!((denim.bend_hysteresis.expect("2HB") - 3e-3).abs() < 1e-15);
    assert!((denim.bend_friction() - 1.5e-3).abs() < 1e-15);
}

#[test]
fn linear_and_isotropic() {
    let f = read(LINEAR, "f.toml").expect("linear");
    // 1 − ν12 ν21 = 1 − 0.2² · 300/500.
    let held = |law: &StretchLaw, free: f64| (law.tangent(0.0) * 0.976 / free - 1.0).abs() < 1e-12;
    assert!(held(&f.stretch_warp, 500.0) && held(&f.stretch_weft, 300.0), "{f:?}");
    assert_eq!((f.poisson, f.shear, f.bend_warp, f.bend_weft, f.bend_bias), (0.2, 40.0, 1e-5, 1e-5, None));
    assert_eq!(f.strain_limit_warp, 0.05);
    let iso = "name = \"i\"\nareal_mass = \"0.15 kg/m^2\"\nthickness = \"0.5 mm\"\nfriction = 0.3\n\
        [isotropic]\nstretch = \"500 N/m\"\npoisson = 0.3\nbending = \"10 uN.m\"\n";
    let limited = iso.replace("friction", "strain_limit_bias = \"6 %\"\nfriction");
    let f = read(&limited, "i.toml").expect("a limit on the bias");
    assert_eq!((f.strain_limit_warp, f.strain_limit_bias), (0.05, Some(0.06)));
    assert_eq!(f.sources["strain_limit_bias"].written, "6 %");
    let f = read(iso, "i.toml").expect("isotropic");
    assert!((f.shear - 500.0 / 2.6).abs() < 1e-9);
    assert!((f.bend_warp - 1e-5).abs() < 1e-18);
    assert_eq!((f.bend_weft, f.bend_bias), (f.bend_warp, Some(f.bend_warp)));
}

/// Slope of tension and contraction per extension of a strip with free sides, from the moduli with the width held.
fn strip(pulled: &StretchLaw, across: &StretchLaw, share: f64, strain: f64) -> (f64, f64) {
    let coupling = share * pulled.tangent(0.0).min(across.tangent(0.0));
    let narrower = coupling * strain / across.tangent(0.0);
    assert!((across.tension(-narrower) + coupling * strain).abs() < 1e-9, "no tension across");
    ((pulled.tension(strain) - coupling * narrower) / strain, narrower / strain)
}

#[test]
fn a_strip_test_gives_the_numbers_of_the_file() {
    let near = |got: (f64, f64), want: (f64, f64)| {
        assert!((got.0 / want.0 - 1.0).abs() < 1e-12 && (got.1 - want.1).abs() < 1e-12, "{got:?} for {want:?}");
    };
    let iso = "name = \"i\"\nareal_mass = \"150 g/m2\"\nthickness = \"0.5 mm\"\nfriction = 0.3\n\
        [isotropic]\nstretch = \"500 N/m\"\npoisson = 0.3\nbending = \"10 uN.m\"\n";
    let f = read(iso, "i.toml").expect("isotropic");
    near(strip(&f.stretch_warp, &f.stretch_weft, f.poisson, 0.02), (500.0, 0.3));
    near(strip(&f.stretch_weft, &f.stretch_warp, f.poisson, 0.02), (500.0, 0.3));
    let sheet = |warp: f64, weft: f64, ratio: f64| {
        let text = LINEAR
            .replace("warp = \"500", &format!("warp = \"{warp}"))
            .replace("weft = \"300", &format!("weft = \"{weft}"))
            .replace("poisson = 0.2", &format!("poisson = {ratio}"));
        read(&text, "f.toml")
    };
    for (warp, weft, ratio) in [(500.0, 300.0, 0.2), (300.0, 500.0, 0.2), (100.0, 200.0, 0.45), (400.0, 400.0, 0.0)] {
        let f = sheet(warp, weft, ratio).expect("linear");
        near(strip(&f.stretch_warp, &f.stretch_weft, f.poisson, 0.02), (warp, ratio));
        near(strip(&f.stretch_weft, &f.stretch_warp, f.poisson, 0.02), (weft, ratio * weft / warp));
    }
    let found = sheet(100.0, 300.0, 0.4).expect_err("no such sheet");
    assert_eq!((found.len(), found[0].code.as_str()), (1, "value-out-of-range"));
    assert!(found[0].message.contains("below 0.333") && found[0].source.as_ref().is_some_and(|s| s.line == Some(8)));

    let curve = "name = \"c\"\nareal_mass = \"200 g/m2\"\nthickness = \"0.4 mm\"\nfriction = 0.3\n[curve]\n\
        warp = [[\"1 %\", \"4 N/m\"], [\"5 %\", \"100 N/m\"]]\nweft = [[\"1 %\", \"3 N/m\"], [\"2 %\", \"20 N/m\"]]\n\
        poisson = 0.3\nshear = \"40 N/m/rad\"\nbending = \"5 uN.m\"\n";
    let f = read(curve, "c.toml").expect("curve");
    near(strip(&f.stretch_warp, &f.stretch_weft, f.poisson, 0.05), (100.0 / 0.05, 0.3));
    near(strip(&f.stretch_weft, &f.stretch_warp, f.poisson, 0.02), (20.0 / 0.02, 0.3 * 300.0 / 400.0));
}

#[test]
fn fast_and_curve() {
    let head = "name = \"f\"\nareal_mass = \"200 g/m2\"\nthickness = \"0.4 mm\"\nfriction = 0.3\n";
    let fast = format!(
        "{head}[fast]\ne5_warp = \"0.3 %\"\ne20_warp = \"0.8 %\"\ne100_warp = \"2.1 %\"\ne5_weft = \"0.5 %\"\n\
         e20_weft = \"1.5 %\"\ne100_weft = \"4 %\"\neb5 = \"2.5 %\"\nbending_length_warp = \"20 mm\"\n\
         bending_weft = \"7 uN.m\"\n"
    );
    let f = read(&fast, "f.toml").expect("fast");
    assert_eq!((f.bend_holds_friction, f.bend_hysteresis), (true, None));
    // Cloth that was measured at 100 gf/cm bears what it showed there.
    let loose = read(&fast.replace("\"4 %\"", "\"6.5 %\""), "f.toml").expect("fast");
    assert_eq!((loose.strain_limit_warp, loose.strain_limit_weft), (0.05, 0.065));
    let work = fast.replace("[fast]", "[fast]\nwt_warp = \"9 %\"");
    let found = read(&work, "f.toml").expect_err("an unknown key");
    assert!(found[0].hint.as_deref().is_some_and(|h| h.contains("follows from EMT and LT")), "{found:?}");
    let both = fast.replace("bending_weft", "bending_hysteresis = \"1 mN\"\nbending_weft");
    let f = read(&both, "f.toml").expect("a cantilever's rigidity holds the friction");
    assert_eq!((f.bend_hysteresis, f.bend_friction()), (Some(1e-3), 0.0));
    assert!((f.shear - 49.2).abs() < 1e-9, "123 / 2.5 %: {}", f.shear);
    assert!((f.bend_warp - 0.2 * 9.81 * 8e-6).abs() < 1e-12);
    assert!((f.stretch_warp.tension(0.021) - 98.0665).abs() < 1e-9);
    assert!((f.stretch_weft.tension(0.01) - (4.903_325 + 0.5 * (19.6133 - 4.903_325))).abs() < 1e-9);

    let curve = |rows: &str| {
        format!(
            "{head}[curve]\nwarp = {rows}\nweft = [[\"1 %\", \"5 N/m\"], [\"2 %\", \"20 N/m\"]]\n\
             shear = \"40 N/m/rad\"\nbending = \"5 uN.m\"\n"
        )
    };
    let good = curve("[[\"0 %\", \"0 N/m\"], [\"2 %\", \"10 N/m\"], [\"5 %\", \"100 N/m\"]]");
    let f = read(&good, "f.toml").expect("curve");
    assert!((f.stretch_warp.tangent(0.03) - 3000.0).abs() < 1e-9);
    for (rows, row) in [
        ("[[\"0 %\", \"1 N/m\"], [\"2 %\", \"10 N/m\"]]", "row 1"),
        ("[[\"4 %\", \"50 N/m\"], [\"6 %\", \"40 N/m\"]]", "row 2"),
        ("[[\"4 %\", \"50 N/m\"], [\"4 %\", \"60 N/m\"]]", "row 2"),
        ("[[\"4 %\", \"50 N/m\"], [\"nan %\", \"60 N/m\"]]", "row 2"),
        ("[[\"4 %\", \"50 N/m\"], [\"3 %\", \"60 N/m\"]]", "row 2"),
        ("[[\"0 %\", \"0 N/m\"]]", "no row beyond the origin"),
        ("[[4, \"50 N/m\"]]", "row 1"),
    ] {
        let found = read(&curve(rows), "f.toml").expect_err("refused");
        assert!(found.iter().any(|d| d.code == "fabric-curve" && d.message.contains(row)), "{rows}: {found:?}");
    }
}

#[test]
fn refuses_by_name_and_range() {
    for (from, to, key) in [
        ("500 N/m", "0 N/m", "stretch_warp"),
        ("500 N/m", "-500 N/m", "stretch_warp"),
        ("500 N/m", "1e12 N/m", "stretch_warp"),
        ("150 g/m2", "0 g/m2", "areal_mass"),
        ("0.5 mm", "-1 mm", "thickness"),
        ("0.3", "-0.1", "friction"),
        ("0.2", "0.5", "poisson"),
        ("0.2", "0.6", "poisson"),
        ("40 N/m/rad", "0 N/m/rad", "shear"),
    ] {
        let text = LINEAR.replacen(from, to, 1);
        let found = read(&text, "f.toml").expect_err("refused");
        assert_eq!(found.len(), 1, "{to}: {found:?}");
        assert_eq!(found[0].code, "value-out-of-range");
        assert!(found[0].message.contains(key) && found[0].message.contains("allowed"), "{}", found[0].message);
        let at = found[0].source.as_ref().expect("place");
        assert!(at.line.is_some() && at.column.is_some());
    }
    for nan in ["nan", "inf", "-inf"] {
        assert!(read(&LINEAR.replace("0.3", nan), "f.toml").is_err());
        assert!(read(&LINEAR.replace("500 N/m", &format!("{nan} N/m")), "f.toml").is_err());
    }
    assert!(read(&LINEAR.replace("1e-5 N.m", "0 N.m"), "f.toml").is_ok(), "no bending is a limit case, not an error");
}

#[test]
fn collects_all_mistakes_with_places_and_remedies() {
    let text = LINEAR
        .replace("\"500 N/m\"", "500")
        .replace("stretch_weft", "strech_weft")
        .replace("\"0.5 mm\"", "\"0.5 furlong\"");
    let found = read(&text, "f.toml").expect_err("refused");
    let codes: Vec<&str> = found.iter().map(|d| d.code.as_str()).collect();
    assert!(codes.contains(&"unit-missing") && codes.contains(&"unknown-key") && codes.contains(&"fabric-value"));
    let bare = found.iter().find(|d| d.code == "unit-missing").expect("bare number");
    assert_eq!(bare.source.as_ref().and_then(|s| s.line), Some(6));
    assert_eq!(bare.hint.as_deref(), Some("write `stretch_warp = \"500 N/m\"`"));
    let typo = found.iter().find(|d| d.code == "unknown-key").expect("typo");
    assert_eq!(typo.hint.as_deref(), Some("did you mean `stretch_weft`?"));
}

#[test]
fn refuses_doubles_gaps_and_broken_files() {
    let twice = format!("{LINEAR}[isotropic]\nstretch = \"500 N/m\"\n");
    assert!(codes(&twice).contains(&"fabric-value-twice".to_owned()));
    let gap = "name = \"g\"\nareal_mass = \"1 g/m2\"\nthickness = \"1 mm\"\nfriction = 0\n[kes]\nemt_warp = \"3 %\"\n";
    assert!(codes(gap).contains(&"fabric-value-missing".to_owned()));
    assert!(codes("a = [").contains(&"fabric-syntax".to_owned()));
    assert!(codes(&format!("a = {}", "[".repeat(20_000))).contains(&"fabric-syntax".to_owned()));
    assert!(codes(&"#".repeat(2 << 20)).contains(&"file-too-large".to_owned()));
    assert!(!codes("").is_empty());
    assert!(codes("kes = 3\nname = \"x\"").contains(&"fabric-value".to_owned()));
}

#[test]
fn origin_of_a_single_value() {
    let text =
        LINEAR.replace("\"500 N/m\"", "{ value = \"500 N/m\", method = \"strip test\", source = \"laboratory\" }");
    let f = read(&text, "f.toml").expect("table form");
    let source = &f.sources["stretch_warp"];
    assert_eq!((source.written.as_str(), source.method.as_str()), ("500 N/m", "strip test"));
}

#[test]
fn constants_of_springs_stand_beside_a_law_and_in_pairs() {
    let with = |springs: &str| format!("{LINEAR}[springs]\n{springs}");
    let fabric = read(&with("yarn = \"450 N/m\"\nbias = \"50 N/m\"\n"), "f.toml").expect("read");
    assert_eq!(fabric.springs.map(|s| [s.yarn, s.bias]), Some([450.0, 50.0]));
    assert_eq!(fabric.sources["springs"].written, "yarn 450 N/m, bias 50 N/m");
    assert_eq!(codes(&with("bias = \"50 N/m\"\n")), ["fabric-value-missing"]);
    assert_eq!(codes(&with("yarn = \"-1 N/m\"\nbias = \"50 N/m\"\n")), ["value-out-of-range"]);
    assert_eq!(codes(&with("yarn = 450\nbias = \"50 N/m\"\n")), ["unit-missing"]);
    assert_eq!(read(LINEAR, "f.toml").expect("read").springs, None);
}

#[test]
fn curves_of_shear_and_bending() {
    let with = |rows: &str| {
        format!(
            "name = \"c\"\nareal_mass = \"200 g/m2\"\nthickness = \"0.4 mm\"\nfriction = 0.3\n[linear]\n\
             stretch_warp = \"900 N/m\"\nstretch_weft = \"700 N/m\"\n[curve]\nmethod = \"KES-F\"\n{rows}\n"
        )
    };
    let good = "shear_force = [[\"0.5 deg\", \"1 N/m\"], [\"5 deg\", \"4 N/m\"]]\n\
                bending_moment_warp = [[\"20 1/m\", \"0.4 mN\"], [\"2.5 1/cm\", \"2.7 mN\"]]\n\
                bending_moment_weft = [[\"250 1/m\", \"2 mN\"]]";
    let f = read(&with(good), "f.toml").expect("curves");
    let degree = std::f64::consts::PI / 180.0;
    assert!((f.shear - 3.0 / (4.5 * degree)).abs() < 1e-9, "the smallest slope: {}", f.shear);
    assert!((f.shear_secant(0.5 * degree) - 2.0 / degree).abs() < 1e-9);
    assert_eq!(f.shear_curve.as_ref().map(Vec::len), Some(3), "the origin goes without saying");
    assert!((f.bend_warp - 1e-5).abs() < 1e-15 && (f.bend_weft - 8e-6).abs() < 1e-15);
    assert_eq!(f.sources["shear"].method, "KES-F");
    for (rows, code, words) in [
        (good.replace("\"5 deg\"", "\"70 deg\""), "fabric-curve", "row 2 of the shear curve"),
        (good.replace("\"2.7 mN\"", "\"0.2 mN\""), "fabric-curve", "the moment falls or stays"),
        (good.replace("\"5 deg\"", "\"5 %\""), "fabric-curve", "row 2 of the shear curve"),
        (good.replace("shear_force = [", "shear_force = \"a\" # ["), "fabric-curve", "must be a list of rows"),
        (format!("{good}\nshear = \"40 N/m/rad\""), "fabric-value-twice", "the shear stiffness"),
        (format!("{good}\nbending_warp = \"4 uN.m\""), "fabric-value-twice", "bending along the warp"),
        (good.replace("bending_moment_weft", "bending_moment_bias"), "unknown-key", "bending_moment_bias"),
    ] {
        let found = read(&with(&rows), "f.toml").expect_err("refused");
        assert!(found.iter().any(|d| d.code == code && d.message.contains(words)), "{rows}: {found:?}");
    }
}
