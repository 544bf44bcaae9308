//! Wedges that the reader leaves undecided, decided by the sewing file: by its `[[dart]]` tables, and by its seams.
//!
//! A seam that sews both legs to each other, or seams that bring both mouth points together, make it a dart. A seam
//! that sews a leg to something else makes it none. What is still undecided is told.

use super::darts::{declare_one, is_declared};
use crate::sewing::codes;
use crate::sewing::lookup::{self, RawRun};
use crate::sewing::shapes::{Shapes, mm, shapes};
use toile_formats::dxf::darts::UndecidedDart;
use toile_garment::sewing::DartSpec;
use toile_garment::{Diagnostic, Garment, PieceId, Report, Vec2};

/// An end of a run is a mouth point or an apex within this, metres: points of the sewing file are snapped so far.
const AT_POINT: f64 = 1e-3;
/// Two runs meet where their ends lie within this, metres.
const MEETS: f64 = 1e-4;

/// The verdict of the seams on a wedge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Verdict {
    /// Its legs or its mouth are sewn together.
    Dart,
    /// A leg is sewn to something else.
    Taken,
    /// Nothing.
    Silent,
}

/// Decides by the sewing file, and tells what nothing decides.
pub fn decide(garment: &mut Garment, undecided: Vec<UndecidedDart>, report: &mut Report, errors: &mut Vec<Diagnostic>) {
    if undecided.is_empty() {
        return;
    }
    let declared = garment.plan.darts.clone();
    let open: Vec<_> = undecided.into_iter().filter(|u| !declared.iter().any(|d| is_declared(&u.spec, d))).collect();
    // Bad outlines are for the stage that needs them.
    let rings = shapes(garment).unwrap_or_default();
    let seams = seams(garment, &rings);
    for one in open {
        let Some(id) = garment.piece_named(&one.spec.piece) else { continue };
        let verdict = rings.get(id.index()).map_or(Verdict::Silent, |_| verdict(id, &one.spec, &rings, &seams));
        match verdict {
            Verdict::Dart => {
                let piece = &mut garment.pieces[id.index()];
                let message = format!(
                    "piece `{}`: the wedge at {} is a dart, for the seams close it",
                    piece.name,
                    one.spec.apexes.first().map_or(String::new(), |a| mm(*a))
                );
                report.push(Diagnostic::info(codes::DART_BY_SEAMS, message).at(one.finding.source));
                declare_one(piece, &one.spec, report, errors);
            }
            Verdict::Taken => {}
            Verdict::Silent => report.push(one.finding),
        }
    }
}

/// A side of a seam; runs that are not found (on copies, which are made later) are none.
type Side = Vec<Option<RawRun>>;

fn seams(garment: &Garment, rings: &Shapes) -> Vec<[Side; 2]> {
    if rings.is_empty() {
        return Vec::new();
    }
    let find = |runs: &[toile_garment::sewing::RunSpec]| -> Side {
        runs.iter().map(|r| lookup::run(garment, rings, r, None).ok()).collect()
    };
    garment.plan.seams.iter().map(|s| [find(&s.a), find(&s.b)]).collect()
}

fn verdict(id: PieceId, spec: &DartSpec, rings: &Shapes, seams: &[[Side; 2]]) -> Verdict {
    let Some(apex) = spec.apexes.first() else { return Verdict::Silent };
    let wedge = Wedge { id, apex: *apex, mouth: spec.mouth, rings };
    if seams.iter().any(|s| wedge.has_legs_in(s)) || wedge.mouth_is_closed(seams) {
        Verdict::Dart
    } else if seams.iter().flatten().flatten().flatten().any(|run| wedge.has_leg_in(run)) {
        Verdict::Taken
    } else {
        Verdict::Silent
    }
}

struct Wedge<'a> {
    id: PieceId,
    apex: Vec2,
    mouth: [Vec2; 2],
    rings: &'a Shapes,
}

impl Wedge<'_> {
    fn end(&self, run: &RawRun, s: f64) -> Vec2 {
        self.rings[run.piece.index()].rings[run.ring].at(s)
    }

    fn ends(&self, run: &RawRun) -> [Vec2; 2] {
        [self.end(run, run.from), self.end(run, run.to)]
    }

    /// Does a run of this piece end at a point?
    fn ends_at(&self, run: &RawRun, p: Vec2) -> bool {
        run.piece == self.id && run.ring == 0 && self.ends(run).iter().any(|e| (e - p).norm() <= AT_POINT)
    }

    fn is_leg(&self, run: &RawRun, k: usize) -> bool {
        self.ends_at(run, self.mouth[k]) && self.ends_at(run, self.apex)
    }

    /// Does a seam sew one leg to the other?
    fn has_legs_in(&self, [a, b]: &[Side; 2]) -> bool {
        match (a.as_slice(), b.as_slice()) {
            ([Some(a), ..], [Some(b), ..]) if a.piece == self.id && b.piece == self.id => {
                (self.is_leg(a, 0) && self.is_leg(b, 1)) || (self.is_leg(a, 1) && self.is_leg(b, 0))
            }
            _ => false,
        }
    }

    /// Does a run take a leg: end at the apex, or run from one mouth point round it to the other?
    fn has_leg_in(&self, run: &RawRun) -> bool {
        let both = self.ends_at(run, self.mouth[0]) && self.ends_at(run, self.mouth[1]);
        let round = || {
            let ring = &self.rings[run.piece.index()].rings[run.ring];
            let (from, to) = run.span();
            let (s, off) = ring.project(self.apex);
            off <= AT_POINT && ring.ahead(from, s) < ring.ahead(from, to) && ring.ahead(from, to) < 0.5 * ring.total()
        };
        self.ends_at(run, self.apex) || both && round()
    }

    /// Do seams bring both mouth points to one place? Either two runs that follow one another on a side end there, or
    /// two seams end there whose other sides meet.
    fn mouth_is_closed(&self, seams: &[[Side; 2]]) -> bool {
        let [m, n] = self.mouth;
        let joint = |pair: &[Option<RawRun>]| match pair {
            [Some(x), Some(y)] => {
                (self.ends_at(x, m) && self.ends_at(y, n)) || (self.ends_at(x, n) && self.ends_at(y, m))
            }
            _ => false,
        };
        if seams.iter().flatten().any(|side| side.windows(2).any(joint)) {
            return true;
        }
        let [at_m, at_n] = [m, n].map(|p| seams.iter().enumerate().flat_map(move |(i, s)| self.across(i, s, p)));
        let at_n: Vec<Meeting> = at_n.collect();
        at_m.into_iter().any(|x| {
            at_n.iter()
                .any(|y| x.seam != y.seam && x.piece == y.piece && x.ring == y.ring && (x.at - y.at).norm() <= MEETS)
        })
    }

    /// Where the other side of a seam can meet a point at which one side starts or ends.
    fn across(&self, seam: usize, [a, b]: &[Side; 2], p: Vec2) -> Vec<Meeting> {
        let mut out = Vec::new();
        for (own, other) in [(a, b), (b, a)] {
            let outer = |side: &Side| [side.first(), side.last()].map(|r| r.and_then(Option::as_ref).cloned());
            let here = outer(own).iter().flatten().any(|r| self.ends_at(r, p));
            let there = outer(other).into_iter().flatten().filter(|_| here);
            for run in there {
                out.extend(self.ends(&run).map(|at| Meeting { seam, piece: run.piece, ring: run.ring, at }));
            }
        }
        out
    }
}

/// A place on the other side of a seam.
struct Meeting {
    seam: usize,
    piece: PieceId,
    ring: usize,
    at: Vec2,
}
