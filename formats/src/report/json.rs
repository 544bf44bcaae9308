//! The report as JSON: the same tables, one object per row.

use super::fit::Fit;
use super::tables::{Cell, tables};
use super::verdict::verdict;
use super::words::Language;
use crate::svg::canvas::fixed;
use serde_json::{Map, Value, json};
use toile_garment::{Diagnostic, Garment};

/// The report for programs. Numbers are rounded to the decimals of the tables.
#[must_use]
pub fn json(garment: &Garment, findings: &[Diagnostic], fit: &Fit) -> Value {
    let mut out = Map::new();
    out.insert("kind".into(), json!("toile-report"));
    out.insert("version".into(), json!(1));
    out.insert("style".into(), json!(garment.style));
    out.insert("size".into(), json!(garment.size));
    out.insert("metric".into(), json!(garment.flat.as_ref().map(|f| f.metric)));
    let v = verdict(garment, findings, Language::English);
    out.insert("verdict".into(), json!({ "passed": v.passed, "why": v.why }));
    let measured = [fit.table(), fit.of_house(), fit.ease(), fit.lengths(), fit.standard(), fit.piece_sizes()]
        .into_iter()
        .filter(|t| !t.rows.is_empty());
    let study = fit.accuracy.as_ref().map(|a| a.table(garment));
    for table in tables(garment, findings).into_iter().chain(measured).chain(study) {
        let row = |cells: &Vec<Cell>| {
            let keys = table.columns.iter().map(|(key, _)| (*key).to_owned());
            Value::Object(keys.zip(cells.iter().map(value)).collect())
        };
        out.insert(table.key.into(), table.rows.iter().map(row).collect());
    }
    Value::Object(out)
}

fn value(cell: &Cell) -> Value {
    match cell {
        Cell::Text(t) => json!(t),
        Cell::Phrases(p) => json!(Language::English.phrases(p)),
        Cell::Number(x, decimals) => fixed(*x, *decimals).parse::<f64>().map_or(Value::Null, |x| json!(x)),
        Cell::Count(n) => json!(n),
        Cell::Verdict(v) => json!(v),
        Cell::Empty => Value::Null,
    }
}
