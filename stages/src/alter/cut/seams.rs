//! The seams of a piece that was cut apart: along the line, and along the legs of darts that could not be closed.

use super::Sides;
use super::join::{Group, Wedge};
use crate::alter::motion::Motion;
use crate::alter::params::Cut;
use toile_garment::Vec2;
use toile_garment::sewing::{RunSpec, RunWay, SeamSpec};

impl Sides<'_, '_> {
    /// The seam along the line, and those along legs.
    pub fn seams(&self, p: &Cut, names: &[Vec<String>; 2]) -> Vec<SeamSpec> {
        let name = p.seam.clone().unwrap_or_else(|| format!("{} {}", names[0][0], names[1][0]));
        let line = seam(name, self.runs(0, &names[0]), self.runs(1, &names[1]));
        let legs = self.wedges.iter().filter_map(|w| self.legs(w, names));
        std::iter::once(line).chain(legs).collect()
    }

    /// The runs of a side along the line. At the point of a dart they go on along its legs.
    fn runs(&self, side: usize, names: &[String]) -> Vec<RunSpec> {
        let last = self.paths.len() - 1;
        let mouth = |end: usize| self.ends[end].dart.map(|g| [self.ring.points[g.from], self.ring.points[g.to]]);
        // A walk along the left part comes to the line at its start. There it leaves the old outline by the first leg
        // of the dart, if one lies there, and at the end it goes on along the second leg of the other.
        let place = |path: usize, end: usize| {
            let at = &self.contour.vertices;
            let vertex = if end == 0 { at[self.paths[path].from].at } else { at[self.paths[path].to].at };
            let is_outer = path == if end == 0 { 0 } else { last };
            mouth(end).filter(|_| is_outer).map_or(vertex, |m| m[usize::from(end != side)])
        };
        let run = |(group, name): (&Group, &String)| {
            let [first, last] = group.paths();
            let moved = |path: usize, p: Vec2| group.motion(path).unwrap_or(Motion::NONE).apply(p);
            RunSpec::Points {
                piece: name.clone(),
                from: moved(first, place(first, 0)),
                to: moved(last, place(last, 1)),
                way: if side == 0 { RunWay::Left } else { RunWay::Right },
            }
        };
        self.groups[side].iter().zip(names).map(run).collect()
    }

    /// The seam along the legs of a dart whose mouth could not be closed.
    fn legs(&self, wedge: &Wedge<'_, '_>, names: &[Vec<String>; 2]) -> Option<SeamSpec> {
        let side = usize::from(!wedge.is_left_mouth());
        let dart = wedge.crossing.open.dart;
        let group = |path: usize| {
            let mut groups = self.groups[side].iter().zip(&names[side]);
            groups.find_map(|(g, name)| Some((name, g.motion(path)?, g)))
        };
        let ([a, b], mouths) = (wedge.crossing.ends(), wedge.mouths());
        let run = |path: usize, from: Vec2, to: Vec2, way: RunWay| {
            let (name, motion, _) = group(path)?;
            Some(RunSpec::Points { piece: name.clone(), from: motion.apply(from), to: motion.apply(to), way })
        };
        if group(wedge.path)?.2.closed.contains(&dart) {
            return None;
        }
        let ways = if side == 1 { [RunWay::Left, RunWay::Right] } else { [RunWay::Right, RunWay::Left] };
        let [first, second] = ways;
        let name = format!("{} {}", self.piece.name, self.piece.darts.get(dart)?.name);
        let first = run(wedge.path, mouths[0], a, first)?;
        Some(seam(name, vec![first], vec![run(wedge.path + 1, mouths[1], b, second)?]))
    }
}

fn seam(name: String, a: Vec<RunSpec>, b: Vec<RunSpec>) -> SeamSpec {
    SeamSpec { name, a, b, reverse: None, ease: None, gather: None, proposed: None, source: None }
}
