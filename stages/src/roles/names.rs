//! Names of pieces, read for their roles.

use super::words::{Meaning, WORDS};
use super::{Facing, Lateral, Part, Role};
use toile_garment::Piece;

/// Shortest name of a style before the names of all pieces, bytes.
const STYLE_LEAST: usize = 3;
/// Longest word that must be a whole word of a name, characters.
const CODE_MOST: usize = 3;
/// Longest category in some systems, characters.
const CATEGORY_MOST: usize = 20;
/// Words after which a text speaks of what a piece has besides.
const WITH: [&str; 6] = ["with", "w/", "mit", "avec", "con", "com"];
/// Confidence that a word gives.
const WORD: f64 = 0.9;
/// Confidence that a code of two or three letters gives.
const CODE: f64 = 0.75;
/// Confidence that a single letter gives.
const LETTER: f64 = 0.65;

/// Roles as names, categories and annotations tell them.
#[must_use]
pub fn roles_of_names(pieces: &[Piece]) -> Vec<Role> {
    let style = style_end(pieces);
    let role = |piece: &Piece| {
        let category = piece.category.as_deref().map(role_of_category).unwrap_or_default();
        let role = role_after_style(&piece.name, style).filled_by(&category);
        // An annotation speaks of other pieces, too: which side the front lies on, what is sewn where.
        let silent = role == Role::default();
        if silent { piece.annotation.as_deref().map(role_of_text).unwrap_or_default() } else { role }
    };
    let mut roles: Vec<Role> = pieces.iter().map(role).collect();
    find_tops(&mut roles);
    roles
}

/// The role that a category tells. Some systems cut categories after 20 characters, within the word `interlining`.
fn role_of_category(text: &str) -> Role {
    let text = text.trim();
    let last = text.rsplit(' ').next().unwrap_or_default().to_lowercase();
    let is_cut = (CATEGORY_MOST - 1..=CATEGORY_MOST).contains(&text.chars().count());
    let is_interlining = is_cut && last.len() >= CODE_MOST && "interlining".starts_with(&last);
    let role = role_of_text(text);
    if is_interlining { Role { part: Some(Part::Interlining), confidence: WORD, ..role } } else { role }
}

/// Fronts and backs are of a bodice in a garment with sleeves, a collar, a hood, straps, a binding or a yoke, and without a
/// skirt or legs. A waistband of such a garment is a band at its hem.
fn find_tops(roles: &mut [Role]) {
    let has = |parts: &[Part]| roles.iter().any(|r| r.part.is_some_and(|p| parts.contains(&p)));
    // A yoke over a waistband is that of a skirt or of trousers.
    let is_top = has(&[Part::Sleeve, Part::Collar, Part::Stand, Part::Hood, Part::Strap, Part::Binding])
        || has(&[Part::Yoke]) && !has(&[Part::Waistband]);
    if !is_top || has(&[Part::Skirt, Part::Leg, Part::Tier]) {
        return;
    }
    let is_top = |r: &&mut Role| r.part.is_none() && matches!(r.facing, Some(Facing::Front | Facing::Back));
    for role in roles.iter_mut().filter(is_top) {
        role.part = Some(Part::Bodice);
        role.evidence.push("it is a front or a back of a garment with sleeves or a collar".to_owned());
    }
}

/// Length of the name of the style at the start of all names, bytes.
///
/// Names of a file often begin alike: `GX1006FBK`, `REGULAR TEEFR`. The name of the style ends after its last whole
/// word, or within a word where more names tell a role so.
fn style_end(pieces: &[Piece]) -> usize {
    let Some(first) = pieces.first().filter(|_| pieces.len() > 1).map(|p| p.name.as_str()) else { return 0 };
    let is_shared = |at: &usize| pieces.iter().all(|p| p.name.get(..*at) == first.get(..*at));
    let shared = first.char_indices().map(|(at, _)| at).take_while(is_shared).last().unwrap_or(0);
    let word = first[..shared].char_indices().rev().find(|(_, c)| !c.is_alphabetic());
    let after_word = word.map_or(0, |(at, c)| at + c.len_utf8());
    let told = |at: usize| pieces.iter().filter(|p| role_after_style(&p.name, at) != Role::default()).count();
    let cuts = [after_word, shared].map(|at| if at < STYLE_LEAST { 0 } else { at });
    if told(cuts[1]) > told(cuts[0]) { cuts[1] } else { cuts[0] }
}

/// The role that a name tells after the name of the style. Codes in the name of the style say nothing, but whole words
/// do: all pieces of `skirt front` and `skirt back` are of a skirt.
fn role_after_style(name: &str, style: usize) -> Role {
    let (style, rest) = name.split_at_checked(style).unwrap_or(("", name));
    let own = role_of_text(rest);
    let own = if own == Role::default() { role_of_ending(rest) } else { own };
    own.filled_by(&role_of_words(style, |word| !word.is_ascii() || word.len() > CODE_MOST))
}

/// Front or back, where a name in capitals ends so: `RACERBK`.
fn role_of_ending(name: &str) -> Role {
    let letters = name.trim_end_matches(|c: char| !c.is_alphabetic());
    let is_code = letters.chars().all(|c| !c.is_lowercase());
    let ending = [("FR", Facing::Front), ("BK", Facing::Back)].into_iter().find(|(end, _)| letters.ends_with(end));
    ending.filter(|_| is_code).map_or_else(Role::default, |(word, facing)| {
        role_of_word(Meaning::Facing(facing), &word.to_lowercase(), LETTER)
    })
}

/// The role that one text tells.
#[must_use]
pub fn role_of_text(text: &str) -> Role {
    let all = |_: &str| true;
    let own = role_of_words(before_addition(text), all);
    if own == Role::default() { role_of_words(text, all) } else { own }
}

/// The part of a text that speaks of the piece itself: a `sleeve with cuff` is a sleeve.
fn before_addition(text: &str) -> &str {
    let is_with = |word: &str| WITH.iter().any(|with| word.eq_ignore_ascii_case(with));
    let mut starts = text.char_indices().filter(|(at, _)| *at > 0 && text[..*at].ends_with(' ')).map(|(at, _)| at);
    let added = starts.find(|at| text[*at..].split(' ').next().is_some_and(is_with));
    added.map_or(text, |at| &text[..at])
}

/// The role that a text tells by the words of the table for which `counts` is true.
fn role_of_words(text: &str, counts: impl Fn(&str) -> bool) -> Role {
    let mut rest = format!(" {} ", folded(text));
    let mut role = Role::default();
    // Longer words first: `under collar` is no `collar` alone, and `kragensteg` is a stand.
    for (meaning, word) in by_length().into_iter().filter(|(_, word)| counts(word)) {
        while let Some(at) = find(&rest, word) {
            let end = at + word.len();
            rest.replace_range(at..end, &" ".repeat(word.len()));
            if let Some(from) = text_word(word) {
                role = role.or(&role_of_word(meaning, word, from));
            }
        }
    }
    role
}

/// Confidence of a word by its length; `None` for an empty one.
fn text_word(word: &str) -> Option<f64> {
    let length = word.chars().count();
    let wide = !word.is_ascii();
    match length {
        0 => None,
        _ if wide => Some(WORD),
        1 => Some(LETTER),
        2..=CODE_MOST => Some(CODE),
        _ => Some(WORD),
    }
}

fn role_of_word(meaning: Meaning, word: &str, confidence: f64) -> Role {
    let evidence = vec![format!("the name says `{word}`")];
    let role = Role { evidence, confidence, ..Role::default() };
    match meaning {
        Meaning::Part(part) => Role { part: Some(part), ..role },
        Meaning::Facing(facing) => Role { facing: Some(facing), ..role },
        Meaning::Lateral(lateral) => Role { lateral: Some(lateral), ..role },
    }
}

/// All words with their meanings, the longest first; words of one length in the order of the table.
fn by_length() -> Vec<(Meaning, &'static str)> {
    let each =
        WORDS.iter().flat_map(|(m, languages)| languages.iter().flat_map(move |w| w.iter().map(move |w| (*m, *w))));
    let mut all: Vec<_> = each.collect();
    all.sort_by_key(|(_, word)| std::cmp::Reverse(word.chars().count()));
    all
}

/// Where a word stands in a folded text. Short Latin and Cyrillic words stand alone; long ones and Chinese anywhere.
fn find(text: &str, word: &str) -> Option<usize> {
    let is_chinese = word.chars().any(|c| c >= '\u{2e80}');
    let anywhere = is_chinese || word.chars().count() > CODE_MOST + 1;
    let starts = || text.match_indices(word).map(|(at, _)| at);
    if anywhere {
        return starts().next();
    }
    let is_start = |at: &usize| text[..*at].ends_with(' ');
    // A word of four letters may go on: `lack` is no `lac`, but `hosen` is `hose`.
    let is_end = |at: usize| text[at + word.len()..].starts_with(' ') || word.chars().count() > CODE_MOST;
    starts().find(|at| is_start(at) && is_end(*at))
}

/// A text in lower case, without accents; everything but letters is a space, and so is a change from small to capital.
#[must_use]
pub fn folded(text: &str) -> String {
    let mut out = String::new();
    let mut was_small = false;
    for c in text.chars() {
        if was_small && c.is_uppercase() {
            out.push(' ');
        }
        was_small = c.is_lowercase();
        for c in c.to_lowercase() {
            match plain(c) {
                c if c.is_alphabetic() => out.push(c),
                // The dot of a capital İ in lower case, and other marks that stand alone.
                '\u{300}'..='\u{36f}' => {}
                _ if out.ends_with(' ') => {}
                _ => out.push(' '),
            }
        }
    }
    out.trim().to_owned()
}

/// Letters with accents, each row with the letter it becomes.
const ACCENTS: &[(char, &str)] = &[
    ('a', "àáâãäåāăąạảấầẩẫậắằẳẵặ"),
    ('c', "çćč"),
    ('d', "đð"),
    ('e', "èéêëēęěẹẻẽếềểễệ"),
    ('g', "ğ"),
    ('i', "ìíîïīıịỉĩ"),
    ('n', "ñńň"),
    ('o', "òóôõöøōőọỏốồổỗộơớờởỡợ"),
    ('s', "śşš"),
    ('u', "ùúûüūůűụủũưứừửữự"),
    ('y', "ýÿỳỵỷỹ"),
    ('z', "źżž"),
    ('е', "ё"),
];

fn plain(c: char) -> char {
    ACCENTS.iter().find(|(_, marked)| marked.contains(c)).map_or(c, |(letter, _)| *letter)
}

impl Role {
    /// This role, completed by what the category of the piece says. A category makes a lining of a front, and no body
    /// of a waistband. Its word for a part outweighs a code in the name: `YP` with `PLACKET` is no yoke, and `LS` with
    /// `LEG SHORT` no long sleeve.
    fn filled_by(&self, other: &Self) -> Self {
        let is_layer = other.part.is_some_and(|p| matches!(p, Part::Lining | Part::Interlining | Part::Facing));
        let is_other = self.part.is_some() && other.part.is_some_and(|p| p != Part::Bodice);
        let is_code = is_other && self.confidence <= CODE.min(other.confidence);
        let part = other.part.filter(|_| is_layer || is_code || self.part.is_none());
        let facing = other.facing.filter(|_| self.facing.is_none());
        let lateral = other.lateral.filter(|_| self.lateral.is_none());
        if part.is_none() && facing.is_none() && lateral.is_none() {
            return self.clone();
        }
        let own = if is_code { Self { part: None, ..self.clone() } } else { self.clone() };
        own.or(&Self { part, facing, lateral, ..other.clone() })
    }

    /// This role, and where it says nothing what another says. Of two parts the more special one holds.
    #[must_use]
    pub fn or(&self, other: &Self) -> Self {
        let special = |part: &Part| Part::ALL.iter().position(|p| p == part);
        let part = [self.part, other.part].into_iter().flatten().min_by_key(special);
        let facing: Option<Facing> = self.facing.or(other.facing);
        let lateral: Option<Lateral> = self.lateral.or(other.lateral);
        let known = [self, other].into_iter().filter(|r| r.confidence > 0.0).map(|r| r.confidence);
        let confidence = known.fold(f64::INFINITY, f64::min);
        let mut evidence = self.evidence.clone();
        evidence.extend(other.evidence.iter().filter(|e| !self.evidence.contains(e)).cloned());
        Self { part, facing, lateral, confidence: if confidence.is_finite() { confidence } else { 0.0 }, evidence }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(text: &str) -> (Option<Part>, Option<Facing>, Option<Lateral>) {
        let role = role_of_text(text);
        (role.part, role.facing, role.lateral)
    }

    #[test]
    fn a_word_of_the_category_outweighs_a_code_and_is_known_where_it_is_cut_off() {
        let piece = |name: &str, category: &str| Piece {
            name: name.to_owned(),
            category: Some(category.to_owned()),
            ..Piece::default()
        };
        let told = |category: &str| roles_of_names(&[piece("X17YP", category), piece("X17FR", "FRONT")])[0].part;
        assert_eq!(told("PLACKET"), Some(Part::Placket));
        assert_eq!(told("BACK"), Some(Part::Yoke));
        let legs = [piece("X48LS", "TIGHT LEG SHORT"), piece("X48S19LL", "TIGHT LEG LONG")];
        assert!(roles_of_names(&legs).iter().all(|r| r.part == Some(Part::Leg)));
        assert_eq!(told("COLLAR STAND UP INTE"), Some(Part::Interlining));
        assert_eq!(told("INTE"), Some(Part::Yoke));
    }

    #[test]
    fn what_a_piece_has_besides_is_not_its_role() {
        for text in ["SLEEVE WITH CUFF", "Ärmel mit Manschette", "MANCHE AVEC POIGNET", "manica con polsino"] {
            assert_eq!(told(text).0, Some(Part::Sleeve), "{text}");
        }
        assert_eq!(told("SLEEVE CUFF").0, Some(Part::Cuff));
        // The word stands alone.
        assert_eq!(told("with collar").0, Some(Part::Collar));
    }

    #[test]
    fn names_of_ten_languages_are_read() {
        let (front, back) = (Some(Facing::Front), Some(Facing::Back));
        for (text, part, facing, lateral) in [
            ("Left sleeve cuff", Some(Part::Cuff), None, Some(Lateral::Left)),
            ("UNDER COLLAR", Some(Part::Collar), Some(Facing::Under), None),
            ("FTORSO_RIGHT", Some(Part::Bodice), front, Some(Lateral::Right)),
            ("PANT_B_L", Some(Part::Leg), back, Some(Lateral::Left)),
            ("前片", None, front, None),
            ("后片 左", None, back, Some(Lateral::Left)),
            ("Vorderhose rechts", Some(Part::Leg), front, Some(Lateral::Right)),
            ("Rückenteil", None, back, None),
            ("Kragensteg", Some(Part::Stand), None, None),
            ("Manche gauche", Some(Part::Sleeve), None, Some(Lateral::Left)),
            ("Falda delantero", Some(Part::Skirt), front, None),
            ("Manica", Some(Part::Sleeve), None, None),
            ("Saia costas", Some(Part::Skirt), back, None),
            ("ÖN BEDEN", Some(Part::Bodice), front, None),
            ("Kol sağ", Some(Part::Sleeve), None, Some(Lateral::Right)),
            ("Рукав левый", Some(Part::Sleeve), None, Some(Lateral::Left)),
            ("Полочка", None, front, None),
            ("Tay áo trái", Some(Part::Sleeve), None, Some(Lateral::Left)),
            ("Thân trước", Some(Part::Bodice), front, None),
            ("下摆罗纹", Some(Part::Waistband), None, None),
            ("AERMELSCHLITZ", Some(Part::Placket), None, None),
            ("Paspel", Some(Part::Binding), None, None),
            ("BINDING NECKHOLE", Some(Part::Binding), None, None),
            ("BackYoke", Some(Part::Yoke), back, None),
            ("COLLOR", Some(Part::Collar), None, None),
            ("FRONTR", None, front, Some(Lateral::Right)),
        ] {
            assert_eq!(told(text), (part, facing, lateral), "{text}");
        }
    }

    #[test]
    fn a_number_of_the_style_before_all_names_says_nothing() {
        let piece = |name: &str| Piece { name: name.into(), ..Piece::default() };
        let roles = roles_of_names(&["GX1006FBK", "GX1006FFR", "GX1006FSL"].map(piece));
        assert_eq!(roles[0].facing, Some(Facing::Back));
        assert_eq!(roles[1].facing, Some(Facing::Front));
        assert_eq!(roles[2].part, Some(Part::Sleeve));
    }

    #[test]
    fn a_style_before_all_names_says_nothing_but_by_its_words() {
        let piece = |name: &str| Piece { name: name.into(), ..Piece::default() };
        let told = |names: &[&str]| -> Vec<String> {
            roles_of_names(&names.iter().map(|n| piece(n)).collect::<Vec<_>>()).iter().map(Role::words).collect()
        };
        assert_eq!(told(&["PLAIN TEEFR", "PLAIN TEEBK", "PLAIN TEESL1"]), ["front bodice", "back bodice", "sleeve"]);
        assert_eq!(told(&["SS CL FR", "SS CL BK", "SS CL NB"]), ["front bodice", "back bodice", "collar"]);
        assert_eq!(told(&["SS17 REG FR", "SS17 REG IX", "SS17 REG BK"]), ["front", "", "back"]);
        assert_eq!(told(&["DEEP RACE FR", "DEEP RACERBK"]), ["front", "back"]);
        assert_eq!(told(&["skirt_front", "skirt_back"]), ["front skirt", "back skirt"]);
        assert_eq!(told(&["bodice", "body lining"]), ["bodice", "lining"]);
        assert_eq!(told(&["front_l", "front_r"]), ["front left", "front right"]);
        assert_eq!(told(&["sleeve_1", "sleeve_2"]), ["sleeve", "sleeve"]);
    }

    #[test]
    fn a_name_without_a_word_has_no_role() {
        assert_eq!(role_of_text("P17"), Role::default());
    }
}
