//! The tuned numbers of the proposal. Evidence: `docs/lab/2026-11-27-seam-proposals.md`.

use super::atoms::Mark;
use super::propose::Rim;

/// Stations at which the course of an edge is compared.
pub const STATIONS: usize = 16;
/// An edge that leaves the direction of its chord by less is straight (radians).
pub const STRAIGHT: f64 = 0.035;
/// Two marks nearer than this along the outline are one (metres).
pub const SAME_MARK: f64 = 2.5e-3;
/// Notches that stand nearer to each other are one mark, such as a double notch (metres). Double notches stand 10 to 13 mm
/// apart in factory files.
pub const NOTCH_GROUP: f64 = 20e-3;
/// Corners are measured between chords of this length (metres).
pub const CORNER_REACH: f64 = 4e-3;
/// A corner that turns less is a mark on an edge (radians).
pub const FLAT_CORNER: f64 = 0.17;
/// Stretches are as long as each other where their lengths differ by less: |ln(length / length)|. The
/// proposals of 34 known garments are the same with and without the rule that uses it.
pub const AS_LONG: f64 = 0.01;
/// Stretches are exactly as long as each other where their lengths differ by less: |ln(length / length)|.
pub const EXACTLY: f64 = 0.003;
/// A part of an edge that lies opposite to two pieces, which are sewn to each other, is as long as both together within
/// this (metres). The side of the front of jeans is so long as those of back and yoke.
pub const SIDE_BY_SIDE: f64 = 2.5e-3;
/// Length of the short side of a strip such as a yoke (metres).
pub const STRIP: std::ops::Range<f64> = 15e-3..90e-3;
/// The courses of the two edges of a flat seam complement each other within this (radians).
pub const FLAT_SEAM: f64 = 0.09;
/// A grain line is drawn upwards or downwards where the cosine of its angle to the upright is larger.
pub const UPRIGHT: f64 = 0.5;
/// Two runs with grade points of their own are the sides of a seam only where they are longer (metres). A raglan sleeve
/// has 270 and 330 mm (GMH2446).
pub const GRADED_RUN: f64 = 0.15;
/// Outlines whose lengths differ by less, as a share, are of one piece and its mirror image or copy.
pub const SAME_PIECE: f64 = 1e-3;
/// The outlines of a piece and of its mirror image lie apart by no more (metres).
pub const SAME_OUTLINE: f64 = 0.8e-3;
/// A notch and its mirror image lie apart by no more (metres).
pub const SAME_PLACE: f64 = 3e-3;
/// Corners that turn more serve to find the mirror image of a piece (radians).
pub const CLEAR_CORNER: f64 = 0.3;
/// A panel whose width over length is smaller is a band: 4 × area / perimeter².
pub const BAND: f64 = 0.15;
/// Most maps of mirror images that are tried.
pub const MOST_MAPS: usize = 6;

/// Edges of one piece that are shorter, as a share of its outline, are not sewn to each other across it.
pub const ACROSS_LEAST: f64 = 0.008;

/// A piece of a leg has a larger share of the cloth.
pub const LEG_LEAST: f64 = 0.08;

/// Pairs that score less are not tried.
pub const CANDIDATE_LEAST: f64 = -7.0;
/// Pairs of one atom that are tried, the best ones.
pub const CANDIDATES_OF_ATOM: usize = 24;
/// A sum of corners is 180, 270 or 360 degrees within this (radians).
pub const CORNER_SUM: f64 = 0.35;

/// Corners of more than this together cannot lie flat (radians).
pub const CORNER_SUM_MOST: f64 = 7.2;

/// Edges that are both shorter are not gathered (metres).
pub const GATHERED_LEAST: f64 = 0.04;

/// A piece that is set on an opening is gathered by no more: logarithm of the ratio.
pub const SET_ON_GATHER: f64 = 0.5;
/// Edges of such a seam are no shorter (metres).
pub const SET_ON_LEAST: f64 = 0.03;
/// Score of a pair that is gathered by more.
pub const TOO_GATHERED: f64 = -6.0;
/// No cloth is gathered by more: logarithm of the ratio.
pub const GATHER_MOST: f64 = 1.15;

/// Weights of the properties of a pair of atoms, in natural logarithms of odds.
#[derive(Clone, Debug)]
pub struct PairWeights {
    /// Weights of the lengths of a pair.
    pub lengths: LengthWeights,
    /// Weights of how the edges of a pair run.
    pub courses: CourseWeights,
    /// Weights of the marks and corners at the ends of a pair.
    pub ends: EndWeights,
    /// Weights of mirror images and of edges of one piece.
    pub mirrors: MirrorWeights,
}

/// Weights of the lengths of a pair.
#[derive(Clone, Debug)]
pub struct LengthWeights {
    /// Every pair.
    pub bias: f64,
    /// Per unit of |ln(length / length)|, up to 1.2.
    pub ratio: f64,
    /// Lengths within 10 %.
    pub within_tenth: f64,
    /// Lengths within 1 %.
    pub within_hundredth: f64,
    /// Lengths within 0.3 %.
    pub within_thousandth: f64,
    /// Lengths within 1 %, over the number of others as long.
    pub rare: f64,
    /// One piece lies turned over on the other.
    pub fold_over: f64,
}

/// Weights of how the edges of a pair run.
#[derive(Clone, Debug)]
pub struct CourseWeights {
    /// Per 20 degrees by which the courses of the edges do not complement each other, up to 2.
    pub course_fit: f64,
    /// Per 20 degrees by which they neither complement nor mirror each other, up to 2.
    pub course_alike: f64,
    /// A straight edge to a curved one.
    pub straight_to_curved: f64,
    /// One piece would stand on its head.
    pub same_way: f64,
    /// Lower edge to lower edge.
    pub low_to_low: f64,
    /// Lower or upper edges of two pieces that both lie across the middle of their pieces: an opening of the garment.
    pub level_to_level: f64,
    /// An edge along the warp to one across.
    pub along_to_across: f64,
}

/// Weights of the marks and corners at the ends of a pair.
#[derive(Clone, Debug)]
pub struct EndWeights {
    /// Mouth of a dart to mouth of a dart, per end.
    pub dart_dart: f64,
    /// Mouth of a dart to notch.
    pub dart_notch: f64,
    /// Mouth of a dart to corner.
    pub dart_corner: f64,
    /// Corner to corner.
    pub corner_corner: f64,
    /// Corner to notch.
    pub corner_notch: f64,
    /// Notch to notch.
    pub notch_notch: f64,
    /// Corners that make a straight line together.
    pub sum_180: f64,
    /// Corners of three quarters of a turn together.
    pub sum_270: f64,
    /// Corners of a whole turn together.
    pub sum_360: f64,
    /// Corners that are too much for a flat place.
    pub sum_more: f64,
}

/// Weights of mirror images and of edges of one piece.
#[derive(Clone, Debug)]
pub struct MirrorWeights {
    /// Mirror edges of one piece: a tube.
    pub tube: f64,
    /// Other edges of one piece.
    pub itself: f64,
    /// Short edges of one piece that no band is, apart from each other: a tube that no limb goes through.
    pub short_tube: f64,
    /// A piece to its mirror image, but not at mirror edges.
    pub left_to_right: f64,
    /// A piece to its mirror image, at mirror edges.
    pub images: f64,
    /// Mirror edges that are curved.
    pub images_curved: f64,
    /// Mirror edges that run across the warp.
    pub images_across: f64,
    /// Both edges touch the axes of their pieces.
    pub axis_to_axis: f64,
    /// Only one of them does.
    pub axis_to_none: f64,
}

impl Default for PairWeights {
    fn default() -> Self {
        Self {
            lengths: LengthWeights {
                bias: -1.95,
                ratio: -2.57,
                within_tenth: 0.90,
                within_hundredth: -0.08,
                within_thousandth: 0.41,
                rare: 2.26,
                fold_over: -0.97,
            },
            courses: CourseWeights {
                course_fit: -0.81,
                course_alike: -0.18,
                straight_to_curved: -1.27,
                same_way: -3.40,
                low_to_low: -2.75,
                level_to_level: -6.00,
                along_to_across: 0.25,
            },
            ends: EndWeights {
                dart_dart: -4.60,
                dart_notch: 1.90,
                dart_corner: -2.70,
                corner_corner: 0.80,
                corner_notch: 1.33,
                notch_notch: 0.81,
                sum_180: 0.24,
                sum_270: 0.12,
                sum_360: -0.60,
                sum_more: -3.00,
            },
            mirrors: MirrorWeights {
                tube: -5.00,
                itself: -7.50,
                short_tube: -6.00,
                left_to_right: -3.50,
                images: -1.95,
                images_curved: -0.73,
                images_across: -2.23,
                axis_to_axis: 1.68,
                axis_to_none: -1.20,
            },
        }
    }
}

/// Weights of the properties of a whole garment.
#[derive(Clone, Debug)]
pub struct WholeWeights {
    /// Every part beyond one.
    pub part: f64,
    /// Every handle of the surface.
    pub handle: f64,
    /// A part without an opening.
    pub closed: f64,
    /// Every opening beyond two of a sleeve.
    pub not_a_tube: f64,
    /// Every piece that would have to lie on both sides at once.
    pub one_sided: f64,
    /// Every half of a piece that is joined to its mirror image otherwise than on the middle.
    pub crossed: f64,
    /// Every run of edges beyond the first that sews a piece to its mirror image.
    pub second_middle: f64,
    /// Sides that differ by more are gathered: |ln(length / length)|.
    pub gather_from: f64,
    /// A gather whose ratio occurs once.
    pub single_gather: f64,
    /// A corner between two unsewn atoms.
    pub bare_corner: f64,
    /// A notch within an unsewn edge.
    pub bare_notch: f64,
    /// A dart in an unsewn edge.
    pub bare_dart: f64,
    /// A place where one corner closes on itself.
    pub folded_corner: f64,
    /// Up to this many degrees off a straight edge, and what it adds; the last for all more.
    pub open: [(f64, f64); 5],
    /// Up to this many degrees off a flat place, and what it adds; the last for all more.
    pub shut: [(f64, f64); 6],
    /// Openings shorter than this (metres), and what one adds.
    pub openings: [(f64, f64); 2],
}

impl Default for WholeWeights {
    fn default() -> Self {
        const MORE: f64 = f64::INFINITY;
        Self {
            part: -12.13,
            handle: -12.00,
            closed: -6.00,
            not_a_tube: -6.00,
            one_sided: -12.00,
            crossed: -8.00,
            second_middle: -5.00,
            gather_from: 0.04,
            single_gather: -1.07,
            bare_corner: -1.20,
            bare_notch: -1.24,
            bare_dart: -0.50,
            folded_corner: -8.00,
            open: [(5.0, 0.94), (12.0, 0.29), (25.0, -0.02), (50.0, -0.09), (MORE, -0.47)],
            shut: [(3.0, 2.15), (12.0, 1.80), (30.0, 1.28), (60.0, 1.60), (100.0, -0.45), (MORE, -2.18)],
            openings: [(0.1, -3.04), (0.25, -0.74)],
        }
    }
}

impl WholeWeights {
    /// Weights for a garment with open armholes: corners and marks of open edges say nothing.
    pub fn open_marks() -> Self {
        Self { bare_corner: 0.0, bare_notch: 0.0, ..Self::default() }
    }

    /// The corners round the edge of the garment.
    pub fn open_fan(&self, corners: usize, sum: f64, mark: Mark) -> f64 {
        match (corners, mark) {
            (1, Mark::Corner) => self.bare_corner,
            (1, Mark::Notch) => self.bare_notch,
            (1, Mark::Dart) => self.bare_dart,
            _ => step(&self.open, sum.to_degrees() - 180.0),
        }
    }

    /// The corners round a place inside.
    pub fn closed_fan(&self, corners: usize, sum: f64) -> f64 {
        if corners == 1 { self.folded_corner } else { step(&self.shut, sum.to_degrees() - 360.0) }
    }

    /// An opening of this length, metres.
    pub fn opening(&self, length: f64) -> f64 {
        self.openings.iter().find(|(limit, _)| length < *limit).map_or(0.0, |(_, w)| *w)
    }
}

fn step(table: &[(f64, f64)], off: f64) -> f64 {
    table.iter().find(|(limit, _)| off.abs() < *limit).map_or(0.0, |(_, w)| *w)
}

/// Temperature at which a search starts: most changes are taken.
pub const HOTTEST: f64 = 3.0;
/// Temperature at which it ends: only gains are taken.
pub const COLDEST: f64 = 0.15;
/// Steps of every search.
pub const STEPS_LEAST: f64 = 4_000.0;
/// A pair is tried in proportion to exp(score / this).
pub const TRIAL_SPREAD: f64 = 3.0;
/// Steps for every atom beside those.
pub const STEPS_PER_ATOM: f64 = 400.0;
/// Share of the changes that sew a run of pairs, that free a pair, and that exchange partners; what is left takes a
/// whole panel apart and sews it anew.
pub const CHANGES: [f64; 3] = [0.55, 0.65, 0.8];
/// A run of pairs goes on past a mark with this likelihood.
pub const GO_ON: f64 = 0.7;
/// The same where the next atoms are sewn otherwise.
pub const GO_ON_OVER: f64 = 0.3;
/// Pairs of a run score at least this.
pub const GO_ON_LEAST: f64 = -2.0;
/// Noise on the scores of pairs when a panel is sewn anew.
pub const ANEW_NOISE: f64 = 1.5;
/// Most searches from different seeds.
pub const RESTARTS: u64 = 10;
/// A search ends when so many restarts came to the best score again.
pub const AGREED: u32 = 3;
/// Seed of the first search.
pub const SEED: u64 = 20_261_127;

/// Share of its weight with which the surface counts, after a part of the steps from 0 to 1. It grows, because a
/// garment is in parts while it is put together.
pub fn surface_share(done: f64) -> f64 {
    (0.1 + 1.2 * done).min(1.0)
}

/// Temperature at which the search begins again without a seam.
pub const HOTTEST_AGAIN: f64 = 1.5;
/// Steps of that search.
pub const AGAIN_LEAST: f64 = 1_500.0;
/// Steps of that search for every atom beside those.
pub const AGAIN_PER_ATOM: f64 = 60.0;
/// Most times that all begins again, because a better garment was met.
pub const ROUNDS: u32 = 4;

/// Margins, and the share of seams with that margin that are right.
pub const CALIBRATION: [(f64, f64); 9] = [
    (0.0, 0.4),
    (1.0, 0.6),
    (2.0, 0.72),
    (3.0, 0.79),
    (4.0, 0.85),
    (5.5, 0.9),
    (7.0, 0.95),
    (10.0, 0.98),
    (14.0, 0.99),
];

/// The confidence of a margin: linear between the entries of [`CALIBRATION`].
pub fn confidence(margin: f64) -> f64 {
    let table = &CALIBRATION;
    let after = table.partition_point(|(m, _)| *m <= margin);
    match (after.checked_sub(1).map(|k| table[k]), table.get(after)) {
        (Some((m0, c0)), Some((m1, c1))) => c0 + (c1 - c0) * (margin - m0) / (m1 - m0),
        (Some((_, c)), None) => c,
        (None, _) => table[0].1,
    }
}

/// Edges that score less for themselves are sewn only because the garment would be in parts without the seam.
pub const UNLIKELY_PAIR: f64 = -6.0;
/// Likelihood of such a seam at most.
pub const UNLIKELY_MOST: f64 = 0.5;
/// Sleeves that no name tells are looked for in garments of so few pairs of pieces at most.
pub const FEW_PAIRS: usize = 2;
/// Sleeves that are set in with this likelihood are none that reach up to the neckline. Two T-shirts
/// that the search took for raglans have 0.8 (GMH1006). Four raglans stay raglans (GMH1406, GMX1406, GMX1416).
pub const SURELY_SET_IN: f64 = 0.6;
/// Likelihood at most of a seam between two edges that both are openings, such as two necklines.
pub const LEVEL_MOST: f64 = 0.2;

/// Stitches that follow one another are one seam if their eases differ by less: |ln(length / length)|.
pub const SAME_EASE: f64 = 0.02;
/// And if their confidences differ by less.
pub const AS_SURE: f64 = 0.1;

/// Effort of the short search on every map of mirror images.
pub const SHORT: f64 = 0.3;
/// Garments of more atoms have one short search for sleeves that are set in.
pub const MANY_ATOMS: usize = 150;
/// Maps that are searched at length.
pub const LONG_TRIES: usize = 2;

/// Weights of what a person decided before.
#[derive(Clone, Debug)]
pub struct DecisionWeights {
    /// A pair that is sewn in the sewing file.
    pub given: f64,
    /// A pair that contradicts the sewing file, or that is new between pieces a person decided on.
    pub against: f64,
}

impl DecisionWeights {
    /// A point lies on an edge within this, and no nearer to its ends (metres).
    pub const REACH: f64 = 1e-3;
}

impl Default for DecisionWeights {
    fn default() -> Self {
        Self { given: 20.0, against: -40.0 }
    }
}

/// Weights of what the names of pieces say.
#[derive(Clone, Debug)]
pub struct NameWeights {
    /// Left to right, but at mirror edges on the middle.
    pub left_to_right: f64,
    /// The same part facing the same way, but at mirror edges.
    pub same_part_and_facing: f64,
    /// Another part facing the other way.
    pub other_part_and_facing: f64,
    /// Seams shorter than this may join those (metres).
    pub short: f64,
    /// Parts that are never sewn to each other, such as a collar and a skirt.
    pub never_meet: f64,
}

impl Default for NameWeights {
    fn default() -> Self {
        Self {
            left_to_right: -5.0,
            same_part_and_facing: -1.0,
            other_part_and_facing: -2.0,
            short: 0.02,
            never_meet: -5.0,
        }
    }
}

/// Limits for seams that go on past a mark of one side. They were chosen; one pair of trousers needs them.
#[derive(Clone, Debug)]
pub struct OnwardWeights {
    /// The lengths that are left differ by less: logarithm of their ratio.
    pub even: f64,
    /// They are at least as long (metres).
    pub least: f64,
    /// Likelihood that such a seam is right.
    pub confidence: f64,
}

impl Default for OnwardWeights {
    fn default() -> Self {
        Self { even: 0.01, least: 0.02, confidence: 0.7 }
    }
}

/// Limits for the bands that close openings.
#[derive(Clone, Debug)]
pub struct BandWeights {
    /// Usual length of a band over that of the opening it goes around.
    pub band_usual: f64,
    /// Most that it differs from that.
    pub band_spread: f64,
    /// A waistband differs by less from the waist that it goes around. One that differs by 0.11 went around a chino whose
    /// legs were sewn wrongly without it. What is gathered to a waistband is found by the search.
    pub waist_spread: f64,
    /// The same of a cuff on a sleeve, or a band at a hem. Ribs of sweatshirts have 0.69 to 0.87 (GMH2446), cuffs of shirts
    /// on pleats 0.89.
    pub end_usual: f64,
    /// Most that it differs from that.
    pub end_spread: f64,
    /// Two ends of a band, and a long side and what it is sewn to, differ by less: logarithm of their ratio.
    pub band_ends: f64,
    /// A long side of a band is at least so many times as long as its ends.
    pub band_least: f64,
    /// Two bands, or two openings, whose lengths differ by less are a left and a right one (metres).
    pub twin: f64,
    /// A band of which no name tells that it is a waistband is at least so long (metres).
    pub waist_least: f64,
    /// A band at the neck whose ends are longer, as a share of its long side, is a collar. A rib is narrower.
    pub collar_height: f64,
    /// The middle of an opening is found where the joints of both sides lie alike, within this (metres).
    pub symmetric: f64,
    /// A corner of a band has a smaller angle (radians).
    pub corner_most: f64,
    /// Likelihood that such a seam is right.
    pub confidence: f64,
}

impl BandWeights {
    /// Usual length of a band over that of a rim, and most that it differs.
    pub fn usual(&self, rim: Rim, is_waistband: bool) -> [f64; 2] {
        match rim {
            Rim::Upper if is_waistband => [1.0, self.waist_spread],
            Rim::Upper => [self.band_usual, self.band_spread],
            Rim::Lower => [self.end_usual, self.end_spread],
        }
    }
}

impl Default for BandWeights {
    fn default() -> Self {
        Self {
            band_usual: 0.9,
            band_spread: 0.2,
            waist_spread: 0.1,
            end_usual: 0.85,
            end_spread: 0.3,
            band_ends: 0.1,
            band_least: 3.0,
            twin: 3e-3,
            waist_least: 0.4,
            collar_height: 0.13,
            symmetric: 5e-3,
            corner_most: 2.3,
            confidence: 0.7,
        }
    }
}

/// Limits and weights for trouser legs. Four files of leggings call for them (GLX4802 and ORILEG, as AAMA and ASTM).
/// Without `rise` the crotch of one stayed open. The numbers were not varied.
#[derive(Clone, Debug)]
pub struct LegWeights {
    /// Score of sewing the rise of one leg to that of the other, its mirror image.
    pub rise: f64,
    /// Score of sewing one leg to the other below the crotch or at the waist.
    pub off_rise: f64,
    /// Score of sewing a waistband to another place than the waist, or of gathering it by [`SET_ON_GATHER`] there.
    pub off_waist: f64,
    /// A level edge that lies lower, as a share of the height of the piece, is the hem.
    pub hem: f64,
    /// Score of sewing a hem to another edge of a leg than its top. Culottes sewed the hem to the inseam, which is as long.
    pub hem_closed: f64,
    /// The widest place of a flared leg lies lower, as a share of the height of the piece.
    pub flared: f64,
}

impl Default for LegWeights {
    fn default() -> Self {
        Self { rise: 3.0, off_rise: -12.0, off_waist: -12.0, flared: 0.15, hem: 0.08, hem_closed: -12.0 }
    }
}

/// Limits and weights for sleeves that are sewn around their armholes as a whole.
#[derive(Clone, Debug)]
pub struct SleeveWeights {
    /// Score of a sleeve that is sewn to the trunk, or of a sleeve of one piece that is sewn to itself, where those seams
    /// are found later.
    pub apart: f64,
    /// The two sides of a sleeve of one piece differ by less: logarithm of the ratio.
    pub sides: f64,
    /// Such sides are at least as long (metres).
    pub side_least: f64,
    /// Cost of the square of that logarithm.
    pub sides_uneven: f64,
    /// Cost of the share by which the hem of such a sleeve is longer than its chord.
    pub hem_bent: f64,
    /// A sleeve of one piece whose stretches are eased by more is set in as a whole: logarithm of the ratio.
    pub whole_ease: f64,
    /// Length of a cap over that of an armhole. Caps are eased in, or gathered.
    pub ratio: std::ops::Range<f64>,
    /// Cost of the square of the logarithm of that ratio.
    pub ease: f64,
    /// Cost of a start that is at no seam, for each side.
    pub start_beside_seam: f64,
    /// Height of a cap or an armhole over its length, at least.
    pub least_height: f64,
    /// Mean square of the difference of the heights of both sides, each over its range, that is allowed.
    pub most: f64,
    /// Cost of notches that all meet nothing. It decides where a cap fits with its front and its back exchanged, too.
    pub notches_unmet: f64,
    /// Cost of what the names say against such a seam.
    pub names: f64,
    /// Marks that lie nearer to each other are sewn to each other (metres).
    pub marks_meet: f64,
    /// Stretches between such marks are at least as long (metres).
    pub stretch_least: f64,
    /// Likelihood that such a seam is right.
    pub confidence: f64,
    /// Costs of a fit that is surely right, and of one that is as likely wrong.
    pub doubt: [f64; 2],
    /// Likelihood of the latter.
    pub doubtful: f64,
}

impl SleeveWeights {
    /// Likelihood that a sleeve which fits at a cost is set in rightly.
    pub fn confidence(&self, cost: f64) -> f64 {
        let [sure, doubtful] = self.doubt;
        let share = ((cost - sure) / (doubtful - sure)).clamp(0.0, 1.0);
        self.confidence + (self.doubtful - self.confidence) * share
    }
}

impl Default for SleeveWeights {
    fn default() -> Self {
        Self {
            apart: -40.0,
            sides: 0.1,
            side_least: 0.01,
            sides_uneven: 4.0,
            hem_bent: 0.2,
            whole_ease: 0.08,
            ratio: 0.85..2.6,
            ease: 0.5,
            start_beside_seam: 0.05,
            least_height: 0.12,
            most: 0.06,
            notches_unmet: 0.03,
            names: 0.01,
            marks_meet: 8e-3,
            stretch_least: 0.03,
            confidence: 0.8,
            doubt: [0.035, 0.08],
            doubtful: 0.45,
        }
    }
}

/// Limits for pleats that notches tell. They were chosen by one drawn shirt and one drawn skirt.
#[derive(Clone, Debug)]
pub struct PleatWeights {
    /// Width between the notches of one pleat (metres). Double notches stand nearer, and tucks of cuffs take 15 mm.
    pub width: std::ops::Range<f64>,
    /// Pleats that are wider are none where another piece has a stretch of that length between marks (metres).
    pub narrow: f64,
    /// Lengths are exactly what is missing within this (metres).
    pub exact: f64,
    /// Pleats that no line tells take less of their edge, as a share.
    pub most: f64,
    /// Such an edge leaves the direction of its chord by less (radians).
    pub straight: f64,
    /// Cosine of its angle to the warp.
    pub across: f64,
    /// A line that starts at a notch lies so near to it (metres).
    pub beside: f64,
    /// Such a line is at least as long (metres).
    pub line_least: f64,
    /// The lines of a pleat are as far from each other at both ends, within this share.
    pub parallel: f64,
}

impl Default for PleatWeights {
    fn default() -> Self {
        Self {
            width: 8e-3..0.16,
            narrow: 20e-3,
            exact: 0.6e-3,
            most: 0.35,
            straight: 0.2,
            across: 0.5,
            beside: 3e-3,
            line_least: 30e-3,
            parallel: 0.3,
        }
    }
}

/// Limits for fronts that are closed by buttons. They were chosen by one drawn shirt.
#[derive(Clone, Debug)]
pub struct ButtonWeights {
    /// Buttons at least.
    pub least: usize,
    /// A hole lies on a line within this (metres).
    pub on_line: f64,
    /// The line is at least so long, as a share of the height of the front.
    pub height: f64,
    /// Cosine of its angle to the warp, at least.
    pub upright: f64,
    /// The front goes on beyond the line by so much (metres).
    pub reach: std::ops::Range<f64>,
}

impl Default for ButtonWeights {
    fn default() -> Self {
        Self { least: 3, on_line: 3e-3, height: 0.5, upright: 0.98, reach: 8e-3..0.12 }
    }
}
