//! Fabric files.

/// Tension law of one direction.
#[derive(Clone, Copy, Debug)]
pub enum Law {
    /// N/m.
    Linear(f64),
    /// `T = k0/beta (exp(beta ε) − 1)`, written as the KES figures that give it.
    Exponential { k0: f64, beta: f64 },
}

/// A fabric, SI units.
#[derive(Clone, Copy, Debug)]
pub struct Cloth {
    pub mass: f64,
    pub thickness: f64,
    pub friction: f64,
    pub warp: Law,
    pub weft: Law,
    pub poisson: f64,
    pub shear: f64,
    pub bending: f64,
    /// 2HB, N.
    pub hysteresis: f64,
    /// Angle (rad) and force (N/m) by which shear is stiffer up to there, written as a measured curve.
    pub shear_knee: Option<[f64; 2]>,
    /// Curvature (1/m) and moment per width (N) by which bending along the warp is stiffer up to there, in the same way.
    pub bend_knee: Option<[f64; 2]>,
    /// Curvature without load along the warp, 1/m.
    pub curl: f64,
    /// Constants of bare springs along the yarns and off them, N/m.
    pub springs: Option<[f64; 2]>,
    pub limit: f64,
}

/// Tension at which KES reads its strain, N/m.
const KES_TENSION: f64 = 490.332_5;

impl Cloth {
    /// The same linear law along warp and weft.
    pub fn linear(mass: f64, stretch: f64, shear: f64, bending: f64) -> Self {
        let law = Law::Linear(stretch);
        Self {
            mass,
            thickness: 1e-4,
            friction: 0.3,
            warp: law,
            weft: law,
            poisson: 0.0,
            shear,
            bending,
            hysteresis: 0.0,
            shear_knee: None,
            bend_knee: None,
            curl: 0.0,
            springs: None,
            // Far from any strain met, and no farther: the law may be tabulated up to here.
            limit: 0.2,
        }
    }

    pub fn text(&self) -> String {
        let mut text = format!(
            "name = \"trial\"\nareal_mass = \"{} kg/m2\"\nthickness = \"{} m\"\nfriction = {:?}\n\
             strain_limit_warp = \"{} %\"\nstrain_limit_weft = \"{} %\"\n",
            self.mass,
            self.thickness,
            self.friction,
            100.0 * self.limit,
            100.0 * self.limit
        );
        if self.curl != 0.0 {
            text += &format!("rest_curvature_warp = \"{} 1/m\"\n", self.curl);
        }
        let (mut linear, mut kes) = (String::new(), String::new());
        for (direction, law) in [("warp", self.warp), ("weft", self.weft)] {
            match law {
                Law::Linear(k) => linear += &format!("stretch_{direction} = \"{k} N/m\"\n"),
                Law::Exponential { k0, beta } => {
                    let (emt, lt) = kes_figures(k0, beta);
                    kes += &format!("emt_{direction} = \"{} %\"\nlt_{direction} = {lt:?}\n", 100.0 * emt);
                }
            }
        }
        text += &format!("[linear]\n{linear}");
        if self.shear_knee.is_none() {
            text += &format!("shear = \"{} N/m/rad\"\n", self.shear);
        }
        let yarns: &[&str] = if self.bend_knee.is_none() { &["warp", "weft"] } else { &["weft"] };
        yarns.iter().for_each(|yarn| text += &format!("bending_{yarn} = \"{} N.m\"\n", self.bending));
        if self.hysteresis > 0.0 {
            text += &format!("bending_hysteresis = \"{} N\"\n", self.hysteresis);
        }
        text += &format!("poisson = {:?}\n", self.poisson);
        if !kes.is_empty() {
            text += &format!("[kes]\n{kes}");
        }
        let rows = |[at, more]: [f64; 2], slope: f64, far: f64, [x, y]: [&str; 2]| {
            let row = |p: f64| format!("[\"{p} {x}\", \"{} {y}\"]", slope * p + more);
            format!("[{}, {}]\n", row(at), row(far))
        };
        if self.shear_knee.is_some() || self.bend_knee.is_some() {
            text += "[curve]\n";
        }
        if let Some(knee) = self.shear_knee {
            text += &format!("shear_force = {}", rows(knee, self.shear, 1.0, ["rad", "N/m"]));
        }
        if let Some(knee) = self.bend_knee {
            text += &format!("bending_moment_warp = {}", rows(knee, self.bending, 1000.0, ["1/m", "N"]));
        }
        if let Some([yarn, bias]) = self.springs {
            text += &format!("[springs]\nyarn = \"{yarn} N/m\"\nbias = \"{bias} N/m\"\n");
        }
        text
    }
}

/// EMT and LT of an exponential law: `T(EMT) = 500 gf/cm`, `LT = 2 (1/x − 1/(eˣ − 1))` with `x = beta EMT`.
pub fn kes_figures(k0: f64, beta: f64) -> (f64, f64) {
    let emt = libm::log1p(beta * KES_TENSION / k0) / beta;
    let x = beta * emt;
    (emt, 2.0 * (1.0 / x - 1.0 / libm::expm1(x)))
}
