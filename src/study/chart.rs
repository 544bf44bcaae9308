//! A study as a page shows it: its points for the chart, and what its garment is made of.

use super::grid::Setting;
use super::report::{Row, Study};
use toile_formats::report::accuracy::{Accuracy, Origin, Point};
use toile_formats::report::{Language, accuracy};
use toile_stages::drape::{AccuracyName, IntegratorName, ModelName, SwitchName};

/// The kind of a setting, as the chart numbers them.
fn kind(setting: &Setting) -> usize {
    let own = Setting::plain(setting.edge);
    match setting {
        s if s.integrator != IntegratorName::Static => 4,
        s if s.model == ModelName::Springs => 3,
        s if s.self_contact == SwitchName::Off => 5,
        s if s.accuracy == AccuracyName::Draft => 1,
        s if s.accuracy != own.accuracy => 2,
        _ => 0,
    }
}

/// The study with the garment that it is of.
#[must_use]
pub fn accuracy(study: &Study, made_of: Origin) -> Accuracy {
    let places = study.places();
    let point = |(number, row): (usize, &Row)| Point {
        name: row.name.clone(),
        kind: kind(&row.done.setting),
        triangles: row.done.triangles,
        cpu_seconds: row.done.cpu_seconds,
        peak_mb: row.done.peak_mb,
        error_mm: places[number].as_ref().map(|p| p.error),
        on_front: row.on_front,
        preset: row.preset.clone(),
        promised_mm: row.promised_mm,
        is_finest: number == study.finest,
        is_recommended: study.recommended == Some(number),
        energy_j: row.done.certificate.as_ref().map(|c| c.energy_j),
    };
    let points = study.rows.iter().enumerate().map(point).collect();
    Accuracy { pipeline: study.pipeline.clone(), wanted_mm: study.wanted_mm, points, made_of }
}

/// The chart.
#[must_use]
pub fn svg(study: &Study, language: Language) -> String {
    accuracy::svg(&accuracy(study, Origin::default()), None, language)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_is_a_point_and_presets_have_names() {
        let study = super::super::report::tests::sample();
        let text = svg(&study, Language::English);
        assert_eq!(text.matches("<circle class=\"mark\" fill").count(), 2 * 4 + accuracy::KINDS.len());
        assert_eq!(text.matches("<circle class=\"open\"").count(), 2, "the finest, in both panels");
        assert_eq!(text.matches("<circle class=\"chosen\"").count(), 2, "the recommended one, in both panels");
        let named = study.rows.iter().filter(|r| r.preset.is_some()).count();
        assert_eq!(text.matches("<text class=\"name\"").count(), 2 * named);
        assert!(named > 0 && !text.contains("NaN") && !text.contains("<script"));
        let chinese = svg(&study, Language::Chinese);
        assert!(chinese.contains("误差与时间") && !chinese.contains("error against time"));
    }
}
