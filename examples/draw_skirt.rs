//! Draws the flared skirt of the book in one fabric: `cargo run --release --example draw_skirt FABRIC.toml FOLDER`
//! writes a mesh and a pipeline, and `toile run FOLDER/skirt.toml` hangs it up and draws its picture.
//!
//! Half a circle of cloth in two panels, a waist of 700 mm, 600 mm long. It hangs from its waist without a body and
//! starts as a cone with small ripples of several lengths, so that no number of folds is preferred.

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Radius of the waist on the flat cloth, m: half a turn of it is the waist.
const WAIST: f64 = 0.7 / PI;
/// Length of the skirt, m.
const LENGTH: f64 = 0.6;
/// Edge of the mesh, m.
const EDGE: f64 = 0.016;
/// Panels.
const PANELS: usize = 2;
/// Ripples of the start at the hem: folds all around, height in m, phase in rad.
const RIPPLES: [[f64; 3]; 4] = [[7.0, 5e-3, 0.0], [9.0, 3.5e-3, 0.0], [12.0, 3.5e-3, 2.0], [5.0, 2.5e-3, 1.0]];

/// The files of a mesh.
#[derive(Default)]
struct Mesh {
    obj: String,
    pins: String,
    stitches: String,
}

fn mesh() -> Mesh {
    let rows = (LENGTH / EDGE).round() as usize;
    let angle = PI / PANELS as f64;
    let columns = (angle * (WAIST + 0.5 * LENGTH) * 1.15 / EDGE).round() as usize;
    let number =
        |panel: usize, row: usize, column: usize| panel * (rows + 1) * (columns + 1) + row * (columns + 1) + column;
    let (mut out, mut flat, mut faces) = (Mesh::default(), String::new(), String::new());
    for panel in 0..PANELS {
        for row in 0..=rows {
            let radius = WAIST + LENGTH * row as f64 / rows as f64;
            for column in 0..=columns {
                let share = column as f64 / columns as f64;
                let (s, c) = libm::sincos(angle * (share - 0.5));
                let _ = writeln!(flat, "vt {:.6} {:.6}", radius * s + 3.0 * panel as f64, -radius * c);
                let turn = TAU * (panel as f64 + share) / PANELS as f64;
                let (s, c) = libm::sincos(turn);
                let ripple: f64 = RIPPLES.iter().map(|[n, height, phase]| height * libm::sin(n * turn + phase)).sum();
                let down = row as f64 / rows as f64;
                let out_by = 0.5 * radius + down * down * ripple;
                let y = 1.04 - (radius - WAIST) * 0.75_f64.sqrt();
                let _ = writeln!(out.obj, "v {:.6} {y:.6} {:.6}", out_by * s, out_by * c);
            }
        }
        for (row, column) in (0..rows).flat_map(|r| (0..columns).map(move |c| (r, c))) {
            let [a, b, c, d] = [(0, 0), (0, 1), (1, 1), (1, 0)].map(|(i, j)| number(panel, row + i, column + j) + 1);
            let two = if (row + column) % 2 == 1 { [[a, d, c], [a, c, b]] } else { [[a, d, b], [b, d, c]] };
            two.iter().for_each(|[p, q, r]| {
                let _ = writeln!(faces, "f {p}/{p} {q}/{q} {r}/{r}");
            });
        }
        let next = (panel + 1) % PANELS;
        for row in 0..=rows {
            let _ = writeln!(out.stitches, "{} {}", number(panel, row, columns), number(next, row, 0));
        }
        for column in 0..=columns {
            let _ = writeln!(out.pins, "{}", number(panel, 0, column));
        }
    }
    out.obj += &flat;
    out.obj += &faces;
    out
}

const PIPELINE: &str = r#"toile = 1

[pipeline]
line    = "flared-skirt"
version = 1

[[stage]]
use = "import-mesh"
with.cloth    = "skirt.obj"
with.rest     = "uv"
with.pins     = "pins.txt"
with.stitches = "stitches.txt"
with.fabric   = "fabric.toml"

[[stage]]
use = "drape"

[[stage]]
use = "export-picture"
with.file = "{out}/skirt.png"
with.view = "three-quarter"
with.width = 200
with.height = 210
"#;

fn main() -> std::io::Result<()> {
    let given: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let [fabric, folder] = given.as_slice() else {
        return Err(std::io::Error::other("usage: draw_skirt FABRIC.toml FOLDER"));
    };
    std::fs::create_dir_all(folder)?;
    let write = |name: &str, text: &str| std::fs::write(Path::new(folder).join(name), text);
    let made = mesh();
    write("skirt.obj", &made.obj)?;
    write("pins.txt", &made.pins)?;
    write("stitches.txt", &made.stitches)?;
    write("fabric.toml", &std::fs::read_to_string(fabric)?)?;
    write("skirt.toml", PIPELINE)
}
