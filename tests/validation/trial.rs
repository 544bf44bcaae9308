//! One run of the program on files of our own making.

use crate::case::{Row, Tolerance, judge};
use crate::cloth::Cloth;
use crate::mesh::Mesh;
use crate::options::Options;
use serde_json::Value;
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use toile::engine::Stop;
use toile_garment::Vec3;

/// A scene: everything that the program reads.
#[derive(Clone)]
pub struct Trial {
    pub cloth: Mesh,
    pub fabric: Cloth,
    pub pins: Vec<(usize, Vec3)>,
    pub loads: Vec<(usize, Vec3)>,
    pub stitches: Vec<[usize; 2]>,
    pub body: Option<Mesh>,
    /// m/s².
    pub gravity: f64,
    /// More keys of the stage `drape`, as TOML: `effects.friction = "off"`.
    pub drape: Vec<String>,
}

impl Trial {
    pub fn new(cloth: Mesh, fabric: Cloth) -> Self {
        let (pins, loads, stitches, drape) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Self { cloth, fabric, pins, loads, stitches, body: None, gravity: crate::closed::G, drape }
    }

    pub fn weightless(mut self) -> Self {
        self.gravity = 0.0;
        self
    }

    /// Holds vertices where they are.
    pub fn hold(mut self, vertices: impl IntoIterator<Item = usize>) -> Self {
        self.pins.extend(vertices.into_iter().map(|v| (v, self.cloth.at[v])));
        self
    }

    /// Leads vertices to places.
    pub fn lead(mut self, vertices: impl IntoIterator<Item = usize>, to: impl Fn(Vec3) -> Vec3) -> Self {
        self.pins.extend(vertices.into_iter().map(|v| (v, to(self.cloth.at[v]))));
        self
    }

    pub fn set(mut self, key: &str) -> Self {
        self.drape.push(key.to_owned());
        self
    }
}

/// What came out.
pub struct Draped {
    pub at: Vec<Vec3>,
    /// Force on every pin, N.
    pub reactions: BTreeMap<usize, Vec3>,
    pub settled: bool,
    pub certificate: Value,
}

impl Draped {
    /// Sum of the forces on these pins.
    pub fn reaction(&self, pins: impl IntoIterator<Item = usize>) -> Vec3 {
        pins.into_iter().filter_map(|v| self.reactions.get(&v)).sum()
    }

    pub fn energy(&self) -> f64 {
        self.certificate["energy_J"].as_f64().unwrap_or(f64::NAN)
    }

    pub fn mean(&self, vertices: impl IntoIterator<Item = usize>) -> Vec3 {
        let (sum, n) = vertices.into_iter().fold((Vec3::zeros(), 0.0), |(s, n), v| (s + self.at[v], n + 1.0));
        sum / n
    }
}

/// Runs the trials of one case and takes down its figures.
pub struct Lab<'a> {
    name: String,
    options: &'a Options,
    pub rows: Vec<Row>,
    used: f64,
    since_row: f64,
    notes: Vec<String>,
    /// Largest of the runs behind the next figure.
    residual: f64,
    runs: usize,
}

impl<'a> Lab<'a> {
    pub fn new(name: &str, options: &'a Options) -> Self {
        let name = name.to_owned();
        Self { name, options, rows: Vec::new(), used: 0.0, since_row: 0.0, notes: Vec::new(), residual: 0.0, runs: 0 }
    }

    /// A figure of this case.
    pub fn figure(&mut self, target: impl Into<String>, measured: f64, expected: f64, tolerance: Tolerance) {
        let (error, verdict) = judge(measured, expected, tolerance);
        if self.residual > 0.1 {
            self.note(format!("residual {:.1e}", self.residual));
        }
        let (cpu, note) = (self.take_cpu(), self.notes.join("; "));
        self.notes.clear();
        self.residual = 0.0;
        let (case, target) = (self.name.clone(), target.into());
        self.rows.push(Row { case, target, measured: Some(measured), expected, error, tolerance, verdict, cpu, note });
    }

    pub fn note(&mut self, words: impl Into<String>) {
        let words = words.into();
        if !self.notes.contains(&words) {
            self.notes.push(words);
        }
    }

    pub fn take_cpu(&mut self) -> f64 {
        std::mem::take(&mut self.since_row)
    }

    /// `import-mesh` → `drape` → `export-obj`.
    pub fn drape(&mut self, trial: &Trial) -> Result<Draped, String> {
        self.runs += 1;
        let temporary = tempfile::tempdir().map_err(|e| e.to_string())?;
        let folder: PathBuf = match &self.options.keep {
            Some(folder) => folder.join(&self.name).join(self.runs.to_string()),
            None => temporary.path().to_path_buf(),
        };
        write(&folder, trial, &self.options.drape).map_err(|e| e.to_string())?;
        let left = self.options.cap - self.used;
        let before = cpu_seconds();
        let (code, said) = run(&folder, left);
        let cpu = cpu_seconds() - before;
        self.used += cpu;
        self.since_row += cpu;
        let record: Value = std::fs::read(folder.join("out/run.json"))
            .ok()
            .and_then(|b| serde_json::from_slice(&b).ok())
            .unwrap_or(Value::Null);
        if code == 130 {
            return Err(format!("did not settle within {:.0} CPU s", self.options.cap));
        }
        if code > 1 {
            let finding = record["findings"].as_array().and_then(|f| f.last()).map(|f| f["message"].to_string());
            return Err(format!("exit code {code}: {}", finding.unwrap_or(said)));
        }
        let certificate = record["certificate"].clone();
        let settled = certificate["settled"].as_bool().unwrap_or(false);
        if !settled {
            self.note("not settled");
        }
        self.residual = self.residual.max(certificate["residual_rel"].as_f64().unwrap_or(0.0));
        Ok(Draped { at: positions(&folder)?, reactions: reactions(&folder)?, settled, certificate })
    }
}

/// Runs the pipeline in this process; asks it to stop when the CPU time is used up.
fn run(folder: &Path, cap: f64) -> (u8, String) {
    let arguments: [OsString; 7] = [
        "toile".into(),
        "run".into(),
        folder.join("pipeline.toml").into(),
        "--out".into(),
        folder.join("out").into(),
        "--quiet".into(),
        "--force".into(),
    ];
    let (stop, done) = (Stop::new(), AtomicBool::new(false));
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let start = cpu_seconds();
    let code = std::thread::scope(|scope| {
        scope.spawn(|| {
            while !done.load(Ordering::Relaxed) {
                if cpu_seconds() - start > cap {
                    stop.ask();
                }
                std::thread::park_timeout(Duration::from_millis(100));
            }
        });
        let code = toile::cli::run_from(arguments, toile_stages::builtin(), &stop, &mut out, &mut err);
        done.store(true, Ordering::Relaxed);
        code
    });
    (code, String::from_utf8_lossy(&err).trim().replace('\n', " "))
}

fn write(folder: &Path, t: &Trial, more: &[String]) -> std::io::Result<()> {
    std::fs::create_dir_all(folder)?;
    std::fs::write(folder.join("toile.root"), "")?;
    std::fs::write(folder.join("cloth.obj"), t.cloth.obj())?;
    std::fs::write(folder.join("fabric.toml"), t.fabric.text())?;
    let mut import =
        "with.cloth = \"cloth.obj\"\nwith.rest = \"uv\"\nwith.fabric = \"fabric.toml\"\nwith.up = \"z\"\n".to_owned();
    let mut list = |name: &str, text: String| {
        if text.is_empty() {
            return Ok(());
        }
        let _ = writeln!(import, "with.{name} = \"{name}.txt\"");
        std::fs::write(folder.join(format!("{name}.txt")), text)
    };
    let point = |v: &usize, p: &Vec3| format!("{v} {} {} {}\n", p.x, p.y, p.z);
    list("pins", t.pins.iter().map(|(v, p)| point(v, p)).collect())?;
    list("loads", t.loads.iter().map(|(v, f)| point(v, f)).collect())?;
    list("stitches", t.stitches.iter().map(|[a, b]| format!("{a} {b}\n")).collect())?;
    if let Some(body) = &t.body {
        std::fs::write(folder.join("body.obj"), body.obj())?;
        import += "with.body = \"body.obj\"\n";
    }
    let mut drape = format!("with.gravity = \"{} m/s2\"\n", t.gravity);
    more.iter().chain(&t.drape).for_each(|key| drape += &format!("with.{key}\n"));
    let export = "with.file = \"{out}/final.obj\"\nwith.reactions = \"{out}/reactions.json\"\n";
    let text = format!(
        "toile = 1\n[pipeline]\nline = \"validation\"\nversion = 1\n[[stage]]\nuse = \"import-mesh\"\n{import}\
         [[stage]]\nuse = \"drape\"\n{drape}[[stage]]\nuse = \"export-obj\"\n{export}"
    );
    std::fs::write(folder.join("pipeline.toml"), text)
}

fn positions(folder: &Path) -> Result<Vec<Vec3>, String> {
    let text = std::fs::read_to_string(folder.join("out/final.obj")).map_err(|e| e.to_string())?;
    let point = |line: &str| -> Option<Vec3> {
        let mut c = line.strip_prefix("v ")?.split_whitespace().map(|w| w.parse::<f64>().expect("a number"));
        Some(Vec3::new(c.next()?, c.next()?, c.next()?))
    };
    Ok(text.lines().filter_map(point).collect())
}

fn reactions(folder: &Path) -> Result<BTreeMap<usize, Vec3>, String> {
    let bytes = std::fs::read(folder.join("out/reactions.json")).map_err(|e| e.to_string())?;
    let json: Value = serde_json::from_slice(&bytes).map_err(|e| e.to_string())?;
    let number = |v: &Value| v.as_f64().unwrap_or(f64::NAN);
    let pin = |p: &Value| {
        let f = &p["force_N"];
        Some((p["index"].as_u64()? as usize, Vec3::new(number(&f[0]), number(&f[1]), number(&f[2]))))
    };
    Ok(json["pins"].as_array().into_iter().flatten().filter_map(pin).collect())
}

/// CPU time of this process, s; wall time where the system does not tell.
fn cpu_seconds() -> f64 {
    let read = || {
        let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
        let fields: Vec<&str> = stat.rsplit(')').next()?.split_whitespace().collect();
        let ticks = |i: usize| fields.get(i)?.parse::<f64>().ok();
        Some((ticks(11)? + ticks(12)?) / 100.0)
    };
    static START: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
    read().unwrap_or_else(|| START.get_or_init(std::time::Instant::now).elapsed().as_secs_f64())
}
