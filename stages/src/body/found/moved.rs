//! Heights of a side file that were edited after the file was written: what it says of the old height is measured anew.

use toile_garment::body::Body;

/// Landmarks lie farther from an edited height than this, metres.
const MOVED: f64 = 2e-3;

/// Heights that lead the tape, with the girths that are measured there or at a fixed distance.
pub(super) const LEVELS: [(&str, &[&str]); 4] = [
    ("waist", &["waist_girth"]),
    ("hip", &["hip_girth"]),
    ("bust", &["bust_girth", "under_bust_girth"]),
    ("crotch", &["thigh_girth"]),
];

/// The body without girths and landmarks of heights that were edited, and the names of these heights.
pub(super) fn without_moved(body: &Body, floor: f64) -> (Body, Vec<String>) {
    let mut kept = body.clone();
    let mut moved = Vec::new();
    for (level, girths) in LEVELS {
        let is_there = |name: &String| name == level || name.strip_prefix(level).is_some_and(|r| r.starts_with('-'));
        let name = format!("{level}_height");
        let Some(height) = body.measures.get(&name) else { continue };
        let is_off = |y: f64| (y - floor - height).abs() > MOVED;
        if body.landmarks.iter().any(|(name, p)| is_there(name) && is_off(p.y)) {
            kept.measures.retain(|name, _| !girths.contains(&name.as_str()));
            kept.landmarks.retain(|name, _| !is_there(name));
            moved.push(name);
        }
    }
    (kept, moved)
}
