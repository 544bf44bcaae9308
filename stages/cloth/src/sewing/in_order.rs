//! Sewing in order: some pieces are sewn on when all others are sewn, as a collar is.

use crate::prepare::initial_feasibility::free_pieces::{PieceMove, free_pieces};
use crate::report::watch::Part;
use crate::scene::measures::{gaps, open_stitches};
use crate::scene::weld::{Welded, weld};
use crate::sewing::joining::joinable_stitches;
use crate::{ClothError, Outcome, Scene, Settings, Vec3, Watch};
use std::collections::BTreeSet;

/// Part of all work until the first pieces are sewn, for the progress display.
const FIRST_WORK: f64 = 0.6;

/// Sews the pieces of the vertices in `last` on when all others are sewn; each time by `sew`. Until then they are not there,
/// so nothing catches on them. Before they are sewn on, they are moved to where they are free. Gives these moves, too.
///
/// # Errors
/// Those of `sew`.
pub(crate) fn sew_in_order(
    scene: &Scene,
    settings: &Settings,
    last: &[bool],
    watch: &mut dyn Watch,
    sew: impl Fn(&Scene, &Settings, &mut dyn Watch) -> Result<Outcome, ClothError>,
) -> Result<(Outcome, Vec<PieceMove>), ClothError> {
    let (rest, kept) = scene.only(|v| !last[v as usize]);
    let whole = |x: &[Vec3]| {
        let mut all = scene.positions.clone();
        kept.iter().zip(x).for_each(|(v, p)| all[*v as usize] = *p);
        all
    };
    let first = sew(&rest, settings, &mut Part::new(watch, [0.0, FIRST_WORK], &whole))?;
    let mut joined = joined(scene, settings, &whole(&first.positions));
    let moved = free_pieces(&mut joined.scene, settings)?;
    let spread = |x: &[Vec3]| joined.spread(x);
    let mut sewn = sew(&joined.scene, settings, &mut Part::new(watch, [FIRST_WORK, 1.0], &spread))?;
    sewn.positions = spread(&sewn.positions);
    // Both starts are told as one.
    sewn.repaired = (first.repaired.0 + sewn.repaired.0, first.repaired.1.max(sewn.repaired.1));
    sewn.open_stitches = open_stitches(gaps(scene, &sewn.positions), settings.stitches.closed_distance);
    Ok((sewn.after(&first), moved.into_iter().filter_map(|m| unwelded(m, &joined)).collect()))
}

/// A move of welded cloth, with the first vertex as it was before it was welded.
fn unwelded(moved: PieceMove, welded: &Welded) -> Option<PieceMove> {
    let first = welded.map.iter().position(|v| *v == moved.vertex)?;
    Some(PieceMove { vertex: first as u32, ..moved })
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
