//! Sewing in order: some pieces are sewn on when all others are sewn, as a collar is.

use crate::prepare::initial_feasibility::free_pieces::free_pieces;
use crate::report::watch::Part;
use crate::scene::elements::Elements;
use crate::scene::weld::{Welded, weld};
use crate::sewing::joining::joinable_stitches;
use crate::{ClothError, Outcome, Scene, Settings, Vec3, Watch};
use std::collections::BTreeSet;

/// Part of all work until the first pieces are sewn, for the progress display.
const FIRST_WORK: f64 = 0.6;
/// Most open stitches that an outcome lists.
const OPEN_STITCHES_MOST: usize = 20;

/// Sews the pieces of the vertices in `last` on when all others are sewn; each time by `sew`. Until then they are not there,
/// so nothing catches on them. Before they are sewn on, they are moved to where they are free.
///
/// # Errors
/// Those of `sew`.
pub(crate) fn sew_in_order(
    scene: &Scene,
    settings: &Settings,
    last: &[bool],
    watch: &mut dyn Watch,
    sew: impl Fn(&Scene, &Settings, &mut dyn Watch) -> Result<Outcome, ClothError>,
) -> Result<Outcome, ClothError> {
    let closed_distance = settings.stitches.closed_distance;
    let rest = Rest::new(scene, last);
    let whole = |x: &[Vec3]| rest.within(scene, x);
    let first = sew(&rest.scene, settings, &mut Part::new(watch, [0.0, FIRST_WORK], &whole))?;
    let mut joined = joined(scene, settings, &whole(&first.positions));
    free_pieces(&mut joined.scene, settings)?;
    let spread = |x: &[Vec3]| joined.spread(x);
    let mut sewn = sew(&joined.scene, settings, &mut Part::new(watch, [FIRST_WORK, 1.0], &spread))?;
    sewn.positions = spread(&sewn.positions);
    sewn.open_stitches = open_stitches(scene, &sewn.positions, closed_distance);
    Ok(sewn.after(&first))
}

/// The pieces that are sewn first.
struct Rest {
    scene: Scene,
    kept: Vec<u32>,
}

impl Rest {
    fn new(scene: &Scene, last: &[bool]) -> Self {
        let kept: Vec<u32> = (0u32..).zip(last).filter(|(_, last)| !**last).map(|(v, _)| v).collect();
        let mut number = vec![u32::MAX; last.len()];
        (0u32..).zip(&kept).for_each(|(new, v)| number[*v as usize] = new);
        let own = scene.triangles.iter().filter(|t| !last[t.vertices[0] as usize]);
        let triangles: Elements = own.map(|t| t.renumbered(|v| number[v as usize])).collect();
        Self { scene: scene.part(&kept, &number, triangles), kept }
    }

    /// All positions, where the first pieces are at `x`.
    fn within(&self, scene: &Scene, x: &[Vec3]) -> Vec<Vec3> {
        let mut all = scene.positions.clone();
        self.kept.iter().zip(x).for_each(|(v, p)| all[*v as usize] = *p);
        all
    }
}

/// The scene at `x` with its closed stitches welded, as far as cloth crosses nothing then. The others are still to be sewn.
fn joined(scene: &Scene, settings: &Settings, x: &[Vec3]) -> Welded {
    let closed = joinable_stitches(scene, settings, x, settings.stitches.closed_distance);
    let known: BTreeSet<[u32; 2]> = closed.iter().copied().collect();
    let mut welded = weld(&Scene { stitches: closed, ..scene.clone() }, x);
    let open = scene.stitches.iter().filter(|s| !known.contains(*s));
    welded.scene.stitches = open.map(|s| s.map(|v| welded.map[v as usize])).collect();
    welded
}

fn gap([a, b]: &[u32; 2], x: &[Vec3]) -> f64 {
    (x[*a as usize] - x[*b as usize]).norm()
}

/// The stitches that are wider than a distance, with their gaps, m: the widest first.
fn open_stitches(scene: &Scene, x: &[Vec3], closed_distance: f64) -> Vec<(u32, f64)> {
    let gaps = (0u32..).zip(scene.stitches.iter().map(|s| gap(s, x)));
    let mut open: Vec<(u32, f64)> = gaps.filter(|(_, gap)| *gap > closed_distance).collect();
    open.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    open.truncate(OPEN_STITCHES_MOST);
    open
}
