//! The fit in one table under the headings of ISO 20947-2: surface strain, gap, tension, cross-section, wrinkles, balance.

use super::fit::Fit;
use super::tables::{Cell, Table, word};
use crate::picture::Field;

/// The headings, in the order of the standard.
const HEADINGS: [&str; 6] = ["surface strain", "gap", "tension", "cross-section", "wrinkles", "balance"];

impl Fit {
    /// The table. It has no row where nothing is worn.
    #[must_use]
    pub fn standard(&self) -> Table {
        let mut t = Table::new(
            "fit_standard",
            "Fit under the headings of ISO 20947-2",
            "Surface strain, gap, tension and wrinkles: over all vertices of the cloth. Cross-section: the worn cloth less \
             the body, around each girth. Balance: how far the hem is off the level, and how far the lower end of a side \
             seam hangs before its upper end; minus is the other way.",
            &[
                ("heading", "heading"),
                ("what", "what"),
                ("smallest", "smallest"),
                ("value", "value or mean"),
                ("largest", "largest"),
                ("unit", "unit"),
            ],
        );
        t.rows = HEADINGS.iter().flat_map(|heading| self.under(heading)).collect();
        t
    }

    /// The rows under a heading.
    fn under(&self, heading: &'static str) -> Vec<Vec<Cell>> {
        let one = |name: &str, metres: f64| {
            let value = Cell::Number(1e3 * metres, 1);
            vec![word(heading), Cell::Text(name.to_owned()), Cell::Empty, value, Cell::Empty, word("mm")]
        };
        match heading {
            "cross-section" => {
                let known = self.levels.iter().filter_map(|l| Some((l, l.body?)));
                known.map(|(level, body)| one(&level.name.replace('_', " "), level.along - body)).collect()
            }
            "balance" => self.balance.iter().map(|b| one(&b.name, b.value)).collect(),
            _ => self.maps.iter().filter(|m| Field::heading(m.key) == heading).filter_map(of_map).collect(),
        }
    }
}

/// Smallest, mean and largest value of a map. `None` where nothing is known.
fn of_map(map: &Field) -> Option<Vec<Cell>> {
    let known: Vec<f64> = map.values.iter().flatten().copied().filter(|x| x.is_finite()).collect();
    let low = known.iter().copied().min_by(f64::total_cmp)?;
    let high = known.iter().copied().max_by(f64::total_cmp)?;
    let mean = known.iter().sum::<f64>() / known.len() as f64;
    let mut row = vec![word(Field::heading(map.key)), Cell::Text(map.name.to_owned())];
    row.extend([low, mean, high].map(|x| Cell::Number(x, 2)));
    row.push(word(map.unit));
    Some(row)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::Scale;
    use crate::report::{Balance, Language, Level};

    #[test]
    fn every_heading_of_the_standard_has_its_rows() {
        let map = |key, name| {
            let values = vec![vec![1.0, 3.0], vec![f64::NAN, 5.0]];
            Field { key, name, unit: "%", scale: Scale::Signed, values, limit: 5.0 }
        };
        let maps = vec![map("strain-warp", "strain along warp"), map("ease", "gap"), map("bending", "bending")];
        let level = Level { name: "hip".into(), height: 0.84, body: Some(0.96), pattern: 1.0, along: 1.01, tape: 0.99 };
        let balance = vec![Balance { name: "hem front above back".into(), value: -0.012 }];
        let fit = Fit { maps, levels: vec![level], balance, ..Fit::default() };
        let table = fit.standard();
        let headings: Vec<&Cell> = table.rows.iter().map(|r| &r[0]).collect();
        let [strain, gap, _, cross, wrinkles, hangs] = HEADINGS.map(word);
        assert_eq!(headings, [&strain, &gap, &cross, &wrinkles, &hangs]);
        assert_eq!(table.rows[0][2..5], [Cell::Number(1.0, 2), Cell::Number(3.0, 2), Cell::Number(5.0, 2)]);
        assert_eq!(
            (&table.rows[2][3], &table.rows[4][3]),
            (&Cell::Number(1e3 * (1.01 - 0.96), 1), &Cell::Number(-12.0, 1))
        );
        assert!(fit.csv().contains("\"hem_front_above_back\",drape,straight,-12.0,mm,,,,\r\n"), "{}", fit.csv());
        assert!(Fit::default().standard().rows.is_empty());
        for words in HEADINGS {
            assert_ne!(Language::Chinese.say(words), words);
        }
        assert_eq!(Language::Chinese.measure("side seam forward left"), "侧缝下端前移左");
    }
}
