//! Every key of a sewing file: its table, its form, an example, and what it means.
//!
//! The reader takes no key that does not stand here, and the schema is built from the same tables.

use super::{dart, place, run};

/// The form of a value.
#[derive(Clone, Copy, Debug)]
pub enum Form {
    /// A text in quotes.
    Text,
    /// A list of texts.
    Texts,
    /// A name or a whole number.
    Label,
    /// A length with its unit.
    Length,
    /// An angle with its unit.
    Angle,
    /// A plain number between two limits.
    Number(f64, f64),
    /// A whole number.
    Integer,
    /// `true` or `false`.
    Flag,
    /// One word of a list.
    Word(fn() -> Vec<&'static str>),
    /// Two lengths.
    Point,
    /// Two lengths, or a place on an edge.
    RunEnd,
    /// A list of points.
    Points,
    /// Two points.
    TwoPoints,
    /// Three lengths.
    Vector,
    /// Three rows of three plain numbers.
    Matrix,
    /// One run of outline edges, or a list of runs.
    Side,
    /// A length, or a share.
    BandLength,
    /// A force with its unit.
    Force,
    /// An areal mass with its unit.
    ArealMass,
    /// A bending rigidity with its unit.
    Bending,
    /// `hold`, `while-sewing`, or `elastic` and a number.
    Strength,
    /// A list of tables.
    Tables(&'static Keys),
}

/// One key.
#[derive(Debug)]
pub struct Key {
    pub name: &'static str,
    pub form: Form,
    pub required: bool,
    /// How a value is written.
    pub example: &'static str,
    pub about: &'static str,
}

/// The keys of one table.
#[derive(Debug)]
pub struct Keys {
    /// Name of the table in messages.
    pub name: &'static str,
    /// The table as the file writes it.
    pub heading: &'static str,
    pub about: &'static str,
    pub keys: &'static [Key],
}

impl Keys {
    /// The key of a name.
    pub fn find(&self, name: &str) -> Option<&'static Key> {
        self.keys.iter().find(|k| k.name == name)
    }
}

const fn must(name: &'static str, form: Form, example: &'static str, about: &'static str) -> Key {
    Key { name, form, required: true, example, about }
}

const fn may(name: &'static str, form: Form, example: &'static str, about: &'static str) -> Key {
    Key { name, form, required: false, example, about }
}

const PIECE: &str = "The piece, by its name in the pattern or that of a copy.";

/// The top of the file.
pub static TOP: Keys = Keys {
    name: "table",
    heading: "the sewing file",
    about: "What a pattern file cannot say: seams, darts, places, layers, attachments, bands, folds, interlinings, copies, \
            names of edges.",
    keys: &[
        may("seam", Form::Tables(&SEAM), "[[seam]]", "Seams, in the order in which they are named in reports."),
        may("dart", Form::Tables(&DART), "[[dart]]", "Darts and pleats that the reader cannot see, or must not see."),
        may("place", Form::Tables(&PLACE), "[[place]]", "Where pieces start in 3D."),
        may("layer", Form::Tables(&LAYER), "[[layer]]", "Which pieces lie over which."),
        may("attach", Form::Tables(&ATTACH), "[[attach]]", "Edges that are held on the body."),
        may("elastic", Form::Tables(&ELASTIC), "[[elastic]]", "Elastic bands that are sewn along edges."),
        may("fold", Form::Tables(&FOLD), "[[fold]]", "Folds that are pressed into pieces."),
        may("interlining", Form::Tables(&INTERLINING), "[[interlining]]", "Interlining on whole pieces."),
        may("whole", Form::Tables(&WHOLE), "[[whole]]", "Pieces that were cut apart: their parts start as one."),
        may("copy", Form::Tables(&COPY), "[[copy]]", "Further copies of drawn pieces."),
        may("edge", Form::Tables(&EDGE), "[[edge]]", "Names for edges of pieces."),
        may("leave_out", Form::Texts, "[\"facing\"]", "Pieces that are not sewn."),
    ],
};

/// `[[seam]]`.
pub static SEAM: Keys = Keys {
    name: "seam",
    heading: "[[seam]]",
    about: "A seam: two sides that are sewn to each other.",
    keys: &[
        may("name", Form::Text, "\"side-left\"", "Name of the seam. Default: `seam-1`, `seam-2` and so on."),
        must("a", Form::Side, "\"front.side-left\"", "The first side."),
        must(
            "b",
            Form::Side,
            "\"back.side-left\"",
            "The second side. Where both sides are points, `a.from` meets `b.from`.",
        ),
        may(
            "ease",
            Form::Length,
            "\"4 mm\"",
            "Length of side `a` minus that of side `b`: over 0 where `a` is longer, below 0 where `b` is. The longer side is \
             held in evenly.",
        ),
        may(
            "gather",
            Form::Number(1.0, 100.0),
            "1.6",
            "Length of the longer side over the shorter. Not beside `ease`.",
        ),
        may(
            "proposed",
            Form::Number(0.0, 1.0),
            "0.93",
            "How sure the program is of a seam that it proposed. Remove it from a seam that is right.",
        ),
        may(
            "reverse",
            Form::Flag,
            "true",
            "Whether the start of `a` meets the end of `b`. Default: found from notches and places.",
        ),
    ],
};

/// `[[dart]]`.
pub static DART: Keys = Keys {
    name: "dart",
    heading: "[[dart]]",
    about: "A dart or pleat that is declared, or a wedge that is denied.",
    keys: &[
        must("piece", Form::Text, "\"front\"", PIECE),
        may("name", Form::Text, "\"waist-left\"", "Name of the dart. Default: a number."),
        may(
            "kind",
            Form::Word(dart::kinds),
            "\"wedge\"",
            "Kind of the dart; `none` says that this wedge is no dart. Default: `wedge`.",
        ),
        may("apex", Form::Point, "[\"154 mm\", \"330 mm\"]", "The apex of a wedge, in the coordinates of the piece."),
        may(
            "apexes",
            Form::Points,
            "[[\"154 mm\", \"330 mm\"], [\"154 mm\", \"90 mm\"]]",
            "Both apexes of a fish-eye, or the ends of a pleat's lines.",
        ),
        must(
            "mouth",
            Form::TwoPoints,
            "[[\"140 mm\", \"443 mm\"], [\"168 mm\", \"443 mm\"]]",
            "The two points where the legs begin.",
        ),
        may(
            "press",
            Form::Word(dart::presses),
            "\"knife\"",
            "How a pleat with two `apexes` is pressed. `knife`: folded along the line of the first mouth point. `inverted` \
             and `box`: along both lines, with the depth behind or in front. Default: not pressed.",
        ),
        may(
            "sewn",
            Form::Length,
            "\"80 mm\"",
            "How far from the mouth a pleat is sewn down. Default: to the ends of its lines.",
        ),
    ],
};

const ROTATION: Key = must(
    "rotation",
    Form::Matrix,
    "[[1,0,0],[0,1,0],[0,0,1]]",
    "Rows of the rotation: world = rotation · [x, y, 0] + translation. The right side faces outwards.",
);
const TRANSLATION: Key = must(
    "translation",
    Form::Vector,
    "[\"0 mm\", \"914 mm\", \"250 mm\"]",
    "Where the origin of the piece goes: +x is the wearer's left, +y up, +z front.",
);
const AROUND: Key = must(
    "around",
    Form::Word(place::segments),
    "\"torso\"",
    "The segment of the body that the piece is wrapped around.",
);
const SIDE: Key =
    must("side", Form::Word(place::sides), "\"front\"", "The side of the segment that the middle of the piece faces.");
const HEIGHT: Key = may(
    "height",
    Form::Length,
    "\"914 mm\"",
    "Height of the top of the piece over the floor; on an arm, the way of its top from the joint (default 0). Required \
     elsewhere.",
);
const TURN: Key = may(
    "turn",
    Form::Angle,
    "\"15 deg\"",
    "Turn of the piece in its plane before it is placed, counter-clockwise. Default: 0.",
);
const SHIFT: Key = may(
    "shift",
    Form::Length,
    "\"120 mm\"",
    "Way of the middle of the piece from the middle of that side along the girth, to the right of the piece as it is \
     drawn. Default: 0.",
);

const IGNORES: Key = may(
    "ignores",
    Form::Texts,
    "[\"forearm-left\"]",
    "Parts of the body that the piece does not meet while it is sewn: segments, `forearm-left`, `forearm-right`. The drape \
     ends with all of the body. Default: forearms that stand in the way of cloth which does not lie on the arm.",
);

const MOVE: Key = must(
    "move",
    Form::Vector,
    "[\"0 mm\", \"20 mm\", \"0 mm\"]",
    "How far the piece starts from where the program would put it: to the wearer's left, up, and to the front.",
);

/// `[[place]]`, in any form.
pub static PLACE: Keys = Keys {
    name: "place",
    heading: "[[place]]",
    about: "Where a piece starts: beside the place that the program finds, wrapped around a segment of the body, or by \
            rotation and translation.",
    keys: &[
        must("piece", Form::Text, "\"front\"", PIECE),
        MOVE,
        AROUND,
        SIDE,
        HEIGHT,
        TURN,
        ROTATION,
        TRANSLATION,
        IGNORES,
    ],
};

/// `[[place]]` beside the place that the program finds.
pub static PLACE_MOVED: Keys = Keys {
    name: "place",
    heading: "[[place]]",
    about: "A piece moved from the place that the program finds.",
    keys: &[must("piece", Form::Text, "\"front\"", PIECE), MOVE, IGNORES],
};

/// `[[place]]` around a segment of the body.
pub static PLACE_AROUND: Keys = Keys {
    name: "place",
    heading: "[[place]]",
    about: "A piece wrapped around a segment of the body.",
    keys: &[must("piece", Form::Text, "\"front\"", PIECE), AROUND, SIDE, HEIGHT, TURN, SHIFT, IGNORES],
};

/// `[[place]]` by rotation and translation.
pub static PLACE_EXPLICIT: Keys = Keys {
    name: "place",
    heading: "[[place]]",
    about: "A piece placed by rotation and translation.",
    keys: &[must("piece", Form::Text, "\"front\"", PIECE), ROTATION, TRANSLATION, IGNORES],
};

/// `[[layer]]`.
pub static LAYER: Keys = Keys {
    name: "layer",
    heading: "[[layer]]",
    about: "The order in which pieces lie over each other.",
    keys: &[
        must("pieces", Form::Texts, "[\"lining-front\"]", "The pieces."),
        must(
            "order",
            Form::Integer,
            "-1",
            "Their order: smaller lies nearer to the body. Pieces that no layer names have 0. Only the order of the numbers \
             counts, not their size.",
        ),
    ],
};

/// `[[attach]]`.
pub static ATTACH: Keys = Keys {
    name: "attach",
    heading: "[[attach]]",
    about: "An edge that is held on the body.",
    keys: &[
        must("piece", Form::Text, "\"waistband\"", PIECE),
        must("edge", Form::Label, "\"top\"", "The edge, by name or number."),
        must("to", Form::Text, "\"waist\"", "The landmark or girth of the body file that holds it."),
        may(
            "strength",
            Form::Strength,
            "\"hold\"",
            "`hold`: held for good. `while-sewing`: held until the garment is sewn. `elastic 0.9`: held until then, and \
             afterwards by a band of this share of the body's girth. Default: `hold`.",
        ),
    ],
};

/// `[[elastic]]`.
pub static ELASTIC: Keys = Keys {
    name: "elastic",
    heading: "[[elastic]]",
    about: "An elastic band that is sewn along edges. It pulls once the garment is sewn.",
    keys: &[
        may("name", Form::Text, "\"cuff\"", "Name of the band. Default: `elastic-1`, `elastic-2` and so on."),
        must("along", Form::Side, "[\"front.top\", \"back.top\"]", "The edges that it is sewn to, in order."),
        must(
            "length",
            Form::BandLength,
            "\"60 %\"",
            "Length of the unstretched band: a length, or a share of the cloth along these edges.",
        ),
        may("stretch", Form::Force, "\"30 N\"", "Tension per strain: the tension at twice its length. Default: 30 N."),
    ],
};

/// `[[fold]]`.
pub static FOLD: Keys = Keys {
    name: "fold",
    heading: "[[fold]]",
    about: "A fold that is pressed into a piece along a line: a hem, a facing, a crease.",
    keys: &[
        must("piece", Form::Text, "\"front\"", PIECE),
        may("name", Form::Text, "\"hem\"", "Name of the fold. Default: `fold-1`, `fold-2` and so on."),
        must(
            "line",
            Form::Points,
            "[[\"0 mm\", \"40 mm\"], [\"300 mm\", \"40 mm\"]]",
            "Points of the line, in the coordinates of the piece.",
        ),
        must(
            "angle",
            Form::Angle,
            "\"180 deg\"",
            "Angle by which the cloth is folded back from flat: over 0 where the right side is outside.",
        ),
    ],
};

/// `[[interlining]]`.
pub static INTERLINING: Keys = Keys {
    name: "interlining",
    heading: "[[interlining]]",
    about: "Interlining on whole pieces: it adds its mass and its bending rigidity to those of the fabric.",
    keys: &[
        must("pieces", Form::Texts, "[\"collar\"]", "The pieces."),
        must("areal_mass", Form::ArealMass, "\"60 g/m2\"", "Its areal mass."),
        must("bending", Form::Bending, "\"40 uN.m\"", "Its bending rigidity, the same in all directions."),
    ],
};

/// `[[whole]]`.
pub static WHOLE: Keys = Keys {
    name: "whole",
    heading: "[[whole]]",
    about: "A piece that was cut apart. Its parts start side by side, where the whole piece would start.",
    keys: &[
        must("name", Form::Text, "\"front\"", "Name of the whole piece. It tells the role, as names of pieces do."),
        must("pieces", Form::Texts, "[\"front-middle\", \"front-side\"]", "Its parts, sewn to each other."),
    ],
};

/// `[[copy]]`.
pub static COPY: Keys = Keys {
    name: "copy",
    heading: "[[copy]]",
    about: "A further copy of a drawn piece.",
    keys: &[
        must("piece", Form::Text, "\"sleeve\"", "The drawn piece."),
        must("name", Form::Text, "\"sleeve-right\"", "Name of the copy."),
        may("mirror", Form::Flag, "true", "Whether the copy is mirrored. Default: false."),
    ],
};

const RUN_FROM: Key = may(
    "from",
    Form::RunEnd,
    "\"notch 1\"",
    "One end of the run. Beside `edge` it is a place on it: `start`, `middle`, `end`, `notch 1`, `40 %`, `120 mm` or \
     `120 mm from end`; an edge starts where the picture of the piece has its dot. Without `edge` it is a point within \
     1 mm of a corner or vertex of the outline, such as [\"12 mm\", \"340 mm\"].",
);
const RUN_TO: Key = may("to", Form::RunEnd, "\"end\"", "The other end of the run, in the same form.");
const RUN_WAY: Key =
    may("way", Form::Word(run::ways), "\"short\"", "Which way around the piece from `from` to `to`. Default: `short`.");
const RUN_LINE: Key = may(
    "line",
    Form::Points,
    "[[\"40 mm\", \"120 mm\"], [\"160 mm\", \"120 mm\"]]",
    "Points of a line inside the piece, in sewing order: where a pocket, a band or a button is sewn on. It lies off the \
     outline and off darts.",
);

/// One run of outline edges as a table.
pub static RUN: Keys = Keys {
    name: "run",
    heading: "a run",
    about: "A run of outline edges: an `edge`, a part of one, or two points. A `line` inside the piece is a run as well.",
    keys: &[
        must("piece", Form::Text, "\"front\"", PIECE),
        RUN_FROM,
        RUN_TO,
        RUN_WAY,
        may("edge", Form::Label, "\"side-left\"", "The edge, by name or number."),
        may("number", Form::Label, "3", "The edge, by number; the same as `edge`."),
        RUN_LINE,
    ],
};

/// `[[edge]]`.
pub static EDGE: Keys = Keys {
    name: "edge",
    heading: "[[edge]]",
    about: "A name for a run of outline edges (an edge, a part of one, or two points), or for a line inside the piece.",
    keys: &[
        must("piece", Form::Text, "\"front\"", PIECE),
        must("name", Form::Text, "\"side-left\"", "The name. It is no whole number."),
        may("number", Form::Label, "3", "The edge, by the number that `toile inspect --svg` draws."),
        RUN_FROM,
        RUN_TO,
        RUN_WAY,
        may("edge", Form::Label, "\"3\"", "The edge, by name or number; the same as `number`."),
        RUN_LINE,
    ],
};
