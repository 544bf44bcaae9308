//! The pipelines that the comparison with other programs runs (stages/cloth/benches/comparison) do what its table says.

mod support;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use support::bench::command;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("stages/cloth/benches/comparison")
}

/// A square metre, flat, of so many cells along each side.
fn square(cells: u32) -> String {
    let mut text = String::new();
    let at = |i: u32| f64::from(i) / f64::from(cells);
    for k in 0..(cells + 1) * (cells + 1) {
        writeln!(text, "v {:.6} {:.6} 1", at(k % (cells + 1)), at(k / (cells + 1))).expect("text");
    }
    for (i, j) in (0..cells * cells).map(|k| (k % cells, k / cells)) {
        let a = j * (cells + 1) + i + 1;
        let (b, c, d) = (a + 1, a + cells + 2, a + cells + 1);
        let halves = if (i + j) % 2 == 0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
        halves.iter().for_each(|[p, q, r]| writeln!(text, "f {p} {q} {r}").expect("text"));
    }
    text
}

/// Hung by two corners its own weight would stretch single edges there by several percent.
#[test]
fn no_edge_of_a_hanging_square_is_stretched_by_1_5_percent() {
    let dir = tempfile::tempdir().expect("folder");
    let (mesh, pins, out) = (dir.path().join("square.obj"), dir.path().join("pins.txt"), dir.path().join("out"));
    let cells = 24;
    std::fs::write(&mesh, square(cells)).expect("mesh");
    std::fs::write(&pins, format!("0\n{cells}\n")).expect("pins");
    let set = |name: &str, path: &Path| format!("{name}={}", path.display());
    let arguments = ["run".into(), folder().join("held.toml").into(), "--out".into(), out.clone().into()];
    let sets = ["--set".into(), set("mesh", &mesh).into(), "--set".into(), set("pins", &pins).into()];
    let read = ["--allow-read".into(), dir.path().into(), "--quiet".into()];
    let said = command(arguments.into_iter().chain(sets).chain(read).collect());
    assert_eq!(said.code, 0, "{said:?}");
    let draped = std::fs::read_to_string(out.join("final.obj")).expect("final.obj");
    let most = longest(&square(cells), &draped);
    assert!((0.008..0.015).contains(&most), "{most}");
}

/// Largest elongation of an edge of the triangles of one mesh in another of the same vertices.
fn longest(rest: &str, draped: &str) -> f64 {
    let numbers = |text: &str, kind: &str| -> Vec<[f64; 3]> {
        let of_kind = text.lines().filter_map(|l| l.strip_prefix(kind));
        of_kind
            .map(|l| std::array::from_fn(|k| l.split_whitespace().nth(k).expect("three").parse().expect("a number")))
            .collect()
    };
    let (before, after, faces) = (numbers(rest, "v "), numbers(draped, "v "), numbers(rest, "f "));
    assert_eq!(before.len(), after.len());
    let length = |at: &[[f64; 3]], [p, q]: [f64; 2]| {
        let [p, q] = [p, q].map(|v| at[v as usize - 1]);
        (0..3).map(|k| (p[k] - q[k]) * (p[k] - q[k])).sum::<f64>().sqrt()
    };
    let ends = faces.iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]);
    ends.map(|e| length(&after, e) / length(&before, e) - 1.0).fold(0.0, f64::max)
}
