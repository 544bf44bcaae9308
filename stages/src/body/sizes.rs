//! Tables of sizes: women, men and children.

use super::measures::BodyMeasures;

/// A size: its label and its measures in millimetres, in the order of [`BodyMeasures::entries`]. A girth under the bust
/// of 0 is that of a usual cup.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    label: &'static str,
    mm: [u16; 17],
}

/// The sizes of one kind of person.
#[derive(Clone, Copy, Debug)]
pub struct SizeTable {
    /// Its first word in names of sizes, such as `men` in `men-50`.
    pub word: &'static str,
    /// A few words about it.
    pub about: &'static str,
    /// Its sizes, smallest first.
    pub sizes: &'static [Size],
}

/// All tables.
///
/// Women: bust and hip after EN 13402-3; the waist is the lower end of the interval of the standard, 20 mm under its
/// middle. Men: chest, waist and neck after EN 13402-3, stature and hip after published charts of body measures. Children:
/// sizes are statures in steps of 60 mm after EN 13402-3, girths within 20 mm of published charts. Heights are shares of
/// the stature; the other measures go on at the steps of usual charts.
pub const SIZE_TABLES: [SizeTable; 3] = [
    SizeTable { word: "women", about: "by European size", sizes: &WOMEN },
    SizeTable { word: "men", about: "by half the chest in centimetres", sizes: &MEN },
    SizeTable { word: "child", about: "by stature in centimetres", sizes: &CHILDREN },
];

/// The table of sizes without a first word.
const PLAIN: &str = "women";

// Stature; heights of neck, shoulder, bust, waist, hip, crotch; shoulder width, arm length; then girths: bust, under
// bust, waist, hip, neck, upper arm, wrist, thigh.
#[rustfmt::skip]
const WOMEN: [Size; 13] = [
    Size { label: "32", mm: [1680, 1440, 1385, 1220, 1050, 840, 770, 380, 580, 760, 0, 580, 840, 330, 250, 148, 490] },
    Size { label: "34", mm: [1680, 1440, 1385, 1220, 1050, 840, 770, 380, 580, 800, 0, 620, 880, 340, 260, 151, 510] },
    Size { label: "36", mm: [1680, 1440, 1385, 1220, 1050, 840, 770, 380, 580, 840, 0, 660, 920, 350, 270, 155, 530] },
    Size { label: "38", mm: [1680, 1440, 1385, 1220, 1050, 840, 770, 380, 580, 880, 0, 700, 960, 360, 280, 160, 550] },
    Size { label: "40", mm: [1680, 1440, 1385, 1220, 1050, 840, 770, 380, 580, 920, 0, 740, 1000, 370, 290, 165, 570] },
    Size { label: "42", mm: [1680, 1440, 1385, 1215, 1050, 840, 770, 385, 580, 960, 0, 780, 1040, 378, 303, 168, 590] },
    Size { label: "44", mm: [1680, 1440, 1385, 1210, 1050, 840, 770, 391, 580, 1000, 0, 820, 1080, 387, 317, 172, 610] },
    Size { label: "46", mm: [1680, 1440, 1385, 1205, 1050, 840, 770, 396, 580, 1040, 0, 860, 1120, 395, 330, 175, 630] },
    Size { label: "48", mm: [1680, 1440, 1385, 1202, 1050, 840, 770, 400, 580, 1100, 0, 920, 1170, 404, 350, 180, 653] },
    Size { label: "50", mm: [1680, 1440, 1385, 1199, 1050, 840, 770, 404, 580, 1160, 0, 980, 1220, 413, 370, 185, 675] },
    Size { label: "52", mm: [1680, 1440, 1385, 1195, 1050, 840, 770, 410, 580, 1220, 0, 1040, 1270, 422, 390, 190, 698] },
    Size { label: "54", mm: [1680, 1440, 1385, 1190, 1050, 840, 770, 416, 580, 1280, 0, 1100, 1320, 430, 410, 195, 720] },
    Size { label: "56", mm: [1680, 1440, 1385, 1185, 1050, 840, 770, 422, 580, 1340, 0, 1160, 1370, 438, 430, 200, 742] },
];

#[rustfmt::skip]
const MEN: [Size; 9] = [
    Size { label: "44", mm: [1680, 1450, 1385, 1220, 1040, 850, 780, 385, 580, 880, 836, 760, 900, 370, 280, 163, 520] },
    Size { label: "46", mm: [1710, 1475, 1410, 1240, 1060, 865, 795, 390, 590, 920, 874, 800, 940, 380, 290, 167, 540] },
    Size { label: "48", mm: [1740, 1500, 1435, 1260, 1080, 880, 810, 395, 600, 960, 912, 840, 980, 390, 300, 171, 560] },
    Size { label: "50", mm: [1770, 1525, 1460, 1285, 1095, 895, 825, 400, 610, 1000, 950, 880, 1020, 400, 310, 175, 580] },
    Size { label: "52", mm: [1800, 1550, 1485, 1305, 1115, 910, 835, 405, 620, 1040, 988, 920, 1060, 410, 320, 179, 600] },
    Size { label: "54", mm: [1820, 1570, 1500, 1320, 1130, 920, 845, 410, 630, 1080, 1026, 960, 1100, 420, 332, 183, 620] },
    Size { label: "56", mm: [1840, 1585, 1520, 1335, 1140, 930, 855, 415, 635, 1120, 1064, 1000, 1160, 430, 344, 187, 645] },
    Size { label: "58", mm: [1860, 1605, 1535, 1350, 1155, 940, 865, 420, 640, 1160, 1102, 1040, 1200, 440, 356, 191, 665] },
    Size { label: "60", mm: [1880, 1620, 1550, 1365, 1165, 950, 875, 425, 650, 1200, 1140, 1080, 1240, 450, 368, 195, 685] },
];

#[rustfmt::skip]
const CHILDREN: [Size; 17] = [
    Size { label: "80", mm: [800, 638, 610, 528, 436, 342, 310, 196, 276, 500, 480, 490, 520, 250, 158, 115, 290] },
    Size { label: "86", mm: [860, 691, 661, 582, 476, 378, 344, 204, 297, 520, 499, 500, 540, 255, 168, 118, 302] },
    Size { label: "92", mm: [920, 746, 714, 627, 517, 416, 380, 218, 317, 540, 518, 510, 560, 260, 174, 122, 315] },
    Size { label: "98", mm: [980, 799, 765, 672, 557, 452, 414, 230, 338, 550, 528, 520, 580, 265, 178, 124, 328] },
    Size { label: "104", mm: [1040, 853, 816, 718, 598, 489, 449, 243, 359, 560, 538, 530, 600, 270, 182, 127, 340] },
    Size { label: "110", mm: [1100, 906, 867, 763, 639, 522, 480, 255, 379, 580, 557, 540, 620, 276, 188, 130, 354] },
    Size { label: "116", mm: [1160, 959, 918, 809, 680, 557, 512, 266, 400, 610, 586, 560, 640, 282, 193, 132, 368] },
    Size { label: "122", mm: [1220, 1012, 970, 855, 722, 592, 544, 278, 421, 630, 605, 570, 660, 289, 198, 135, 381] },
    Size { label: "128", mm: [1280, 1066, 1021, 901, 764, 627, 576, 290, 442, 640, 614, 580, 680, 295, 204, 138, 395] },
    Size { label: "134", mm: [1340, 1121, 1074, 947, 804, 660, 606, 302, 462, 670, 643, 600, 710, 303, 212, 141, 414] },
    Size { label: "140", mm: [1400, 1175, 1126, 993, 845, 693, 637, 315, 483, 700, 672, 610, 750, 310, 221, 144, 432] },
    Size { label: "146", mm: [1460, 1230, 1179, 1039, 886, 726, 668, 328, 504, 730, 701, 630, 780, 318, 230, 148, 451] },
    Size { label: "152", mm: [1520, 1286, 1233, 1085, 927, 760, 699, 340, 524, 760, 730, 650, 810, 326, 238, 151, 470] },
    Size { label: "158", mm: [1580, 1341, 1286, 1131, 967, 792, 729, 352, 545, 790, 758, 670, 840, 335, 246, 155, 489] },
    Size { label: "164", mm: [1640, 1396, 1339, 1178, 1007, 824, 759, 364, 566, 820, 787, 690, 870, 344, 255, 158, 508] },
    Size { label: "170", mm: [1700, 1452, 1393, 1224, 1047, 856, 788, 376, 586, 860, 826, 710, 910, 353, 264, 162, 526] },
    Size { label: "176", mm: [1760, 1508, 1447, 1271, 1088, 889, 818, 388, 607, 900, 864, 740, 940, 362, 272, 166, 545] },
];

impl Size {
    /// Its label within its table, such as `50`.
    #[must_use]
    pub fn label(&self) -> &'static str {
        self.label
    }
}

impl SizeTable {
    /// Full name of one of its sizes, such as `men-50`.
    #[must_use]
    pub fn name(&self, size: &Size) -> String {
        format!("{}-{}", self.word, size.label)
    }

    /// Measures of one of its sizes.
    #[must_use]
    pub fn measures(&self, size: &Size) -> BodyMeasures {
        let name = if self.word == PLAIN { format!("size-{}", size.label) } else { self.name(size) };
        let mut measures = BodyMeasures { name, ..BodyMeasures::default() };
        for ((entry, _), mm) in BodyMeasures::default().entries().into_iter().zip(size.mm).filter(|(_, mm)| *mm > 0) {
            measures.set(entry, f64::from(mm) / 1000.0);
        }
        measures
    }
}

impl BodyMeasures {
    /// A size by its name, such as `men-50` or `child-128`; `38` and `women-38` are the same.
    #[must_use]
    pub fn size(name: &str) -> Option<Self> {
        let (word, label) = name.split_once('-').unwrap_or((PLAIN, name));
        let table = SIZE_TABLES.iter().find(|t| t.word == word)?;
        let size = table.sizes.iter().find(|s| s.label == label)?;
        Some(table.measures(size))
    }
}

/// The names of sizes that are most like a text: those of the same label or table, else all tables with their ends.
#[must_use]
pub fn like(text: &str) -> Vec<String> {
    let label = text.trim_start_matches(|c: char| !c.is_ascii_digit());
    let number: Option<i32> = label.chars().take_while(char::is_ascii_digit).collect::<String>().parse().ok();
    let word =
        text.get(..text.len() - label.len()).unwrap_or_default().trim_end_matches(['-', ' ', '_']).to_lowercase();
    let of = |t: &SizeTable| {
        let off = |s: &Size| (s.label.parse::<i32>().unwrap_or(0) - number.unwrap_or(0)).abs();
        let mut sizes: Vec<&Size> = t.sizes.iter().collect();
        sizes.sort_by_key(|s| off(s));
        let near = sizes.into_iter().take(2).filter(|s| number.is_some_and(|n| 10 * off(s) <= n));
        near.map(|s| t.name(s)).collect::<Vec<_>>()
    };
    let is_named = |t: &&SizeTable| word.starts_with(t.word) || strsim::normalized_levenshtein(t.word, &word) > 0.6;
    let named = SIZE_TABLES.iter().find(is_named).map(of).unwrap_or_default();
    if named.is_empty() { SIZE_TABLES.iter().flat_map(of).collect() } else { named }
}

/// All sizes in few words.
#[must_use]
pub fn range() -> String {
    let of = |t: &SizeTable| {
        let ends = [t.sizes.first(), t.sizes.last()].map(|s| s.map_or_else(String::new, |s| t.name(s)));
        format!("{} to {}", ends[0], ends[1])
    };
    SIZE_TABLES.iter().map(of).collect::<Vec<_>>().join(", ")
}
