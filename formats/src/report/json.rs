//! The report as JSON: the same tables, one object per row.

use super::tables::{Cell, tables};
use crate::svg::canvas::fixed;
use serde_json::{Map, Value, json};
use toile_garment::{Diagnostic, Garment};

/// The report for programs. Numbers are rounded to the decimals of the tables.
#[must_use]
pub fn json(garment: &Garment, findings: &[Diagnostic]) -> Value {
    let mut out = Map::new();
    out.insert("kind".into(), json!("toile-report"));
    out.insert("version".into(), json!(1));
    out.insert("style".into(), json!(garment.style));
    out.insert("size".into(), json!(garment.size));
    out.insert("metric".into(), json!(garment.flat.as_ref().map(|f| f.metric)));
    for table in tables(garment, findings) {
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
        Cell::Number(x, decimals) => fixed(*x, *decimals).parse::<f64>().map_or(Value::Null, |x| json!(x)),
        Cell::Count(n) => json!(n),
        Cell::Verdict(v) => json!(v),
        Cell::Empty => Value::Null,
    }
}
