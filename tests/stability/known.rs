//! Cases that fail, and why: each waits for a change of the program. A case that passes must leave this list.

const WHOLE: &str = "one descent for all parts: its memory, step lengths and goal of rest are common to them";

/// Case, and what is wrong.
const LIST: [(&str, &str); 2] = [
    ("G6-forty-parts", WHOLE),
    ("E30-at-rest-on-a-ball", "cloth creeps by some 0.2 mm/s, three seconds after a drape"),
];

pub fn reason(id: &str) -> Option<&'static str> {
    LIST.iter().find(|(known, _)| *known == id).map(|(_, why)| *why)
}
