//! The results of all runs put side by side.

use super::estimate::{Level, Trend, error_of, surface_to_limit};
use super::front::{Place, front, nearest, recommend};
use super::grid::Setting;
use super::measure::{Error, Lengths, difference, distance, lengths, levels, nearer};
use super::presets::Preset;
use super::runs::{Done, Ran};
use serde::{Deserialize, Serialize};
use toile_formats::report::accuracy::Accuracy;
use toile_garment::Garment;
use toile_garment::garment::{Certificate, Rests};
use toile_stages::fit::Surface;
use toile_stages::flatten::is_symmetric;

/// Version of the form of `study.json`.
pub const VERSION: u32 = 1;

/// One setting with all that is known of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Name of its folder.
    pub name: String,
    /// Its run.
    #[serde(flatten)]
    pub done: Done,
    /// Hem heights and girths.
    pub lengths: Option<Lengths>,
    /// How far apart rests from shaken starts lie on this mesh, where it was measured.
    #[serde(default)]
    pub scatter: Option<Rests>,
    /// How far it is from the finest; all zero for the finest itself.
    pub error: Option<Error>,
    /// How far the finest drape is from itself after it was carried onto this mesh and came to rest there: the same folds
    /// with other elements. The finest came to rest once more on its own mesh, so that both have the same history.
    #[serde(default)]
    pub carried: Option<Error>,
    /// Length error against the limit of fine meshes, estimated from this and coarser meshes, mm.
    pub estimate_mm: Option<f64>,
    /// The same against the finest mesh, mm: what `error.length_mm` should be.
    pub estimate_to_finest_mm: Option<f64>,
    /// Is nothing both cheaper and more exact?
    pub on_front: bool,
    /// Name of the preset at this setting.
    pub preset: Option<String>,
    /// The error that the preset promises, mm.
    pub promised_mm: Option<f64>,
    /// Is the promise held?
    pub promise_held: Option<bool>,
}

impl Row {
    /// Is there a drape that passed its certificate?
    #[must_use]
    pub fn is_good(&self) -> bool {
        self.done.certificate.as_ref().is_some_and(|c| c.passed)
    }
}

/// A study.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Study {
    /// Version of this form.
    pub toile_study: u32,
    /// Program version.
    pub toile: String,
    /// Product line and version.
    pub pipeline: String,
    /// Threads of the runs.
    pub threads: usize,
    /// The error that the recommended setting must reach, mm.
    pub wanted_mm: f64,
    /// Heights of the girths above the floor, mm.
    pub girth_heights_mm: Vec<f64>,
    /// How lengths follow the edge length, where there are three meshes or more.
    pub trend: Option<Trend>,
    /// Settings, cheapest mesh first.
    pub rows: Vec<Row>,
    /// Index of the finest row, by which the others are measured.
    pub finest: usize,
    /// Index of the recommended row; none where no setting reaches the wanted error.
    pub recommended: Option<usize>,
    /// Settings that were left out for lack of budget.
    pub left_out: Vec<String>,
    /// Settings that gave the drape of another one to the last bit, each with that one.
    #[serde(default)]
    pub repeated: Vec<[String; 2]>,
    /// The part of it that a page shows, and the garment that it is of.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shown: Option<Accuracy>,
}

/// Head of a study.
pub struct Head {
    /// Product line and version.
    pub pipeline: String,
    /// Threads.
    pub threads: usize,
    /// The wanted error, mm.
    pub wanted_mm: f64,
    /// Settings that were left out.
    pub left_out: Vec<String>,
}

/// Compares all runs with the finest. `None` when no run gave a drape.
#[must_use]
pub fn report(head: Head, ran: Vec<Ran>) -> Option<Study> {
    let (ran, repeated) = without_repeats(ran);
    let scatter: Vec<Option<Rests>> = ran.iter().map(|r| r.scatter.clone()).collect();
    let carried: Vec<Option<Figures>> = ran.iter().map(|r| figures(r.carried.as_ref()?)).collect();
    let finest = finest(&ran)?;
    let is_symmetric = ran[finest].garment.as_ref().is_some_and(is_symmetric);
    let (runs, surfaces): (Vec<Done>, Vec<Option<Surface>>) =
        ran.into_iter().map(|r| (r.done, r.garment.as_ref().and_then(Surface::of))).unzip();
    let reference = surfaces[finest].as_ref()?;
    let at = levels(reference);
    let measured: Vec<Option<Lengths>> = surfaces.iter().map(|s| Some(lengths(s.as_ref()?, &at))).collect();
    let finest_edge = runs[finest].setting.edge;
    let rows = runs.iter().zip(&surfaces).enumerate().map(|(i, (done, surface))| {
        let mut row = Row { scatter: scatter[i].clone(), ..Row::plain(done, measured[i].clone()) };
        row.error = surface.as_ref().and_then(|s| {
            let lengths = difference(measured[i].as_ref()?, measured[finest].as_ref()?)?;
            let by = [done, &runs[finest]].map(|d| d.certificate.as_ref());
            Some(compare(by, lengths, nearer(s, reference, is_symmetric).1))
        });
        row.carried = carried[i].as_ref().filter(|_| i != finest).and_then(|(s, certificate)| {
            let (again, figures) = carried[finest].as_ref()?;
            let lengths = difference(&lengths(s, &at), &lengths(again, &at))?;
            Some(compare([certificate.as_ref(), figures.as_ref()], lengths, distance(s, again)))
        });
        let ladder = ladder(&runs, &measured, i);
        row.estimate_mm = error_of(&ladder, None);
        row.estimate_to_finest_mm = finest_edge.and_then(|f| error_of(&ladder, Some(f)));
        row
    });
    let mut study = Study {
        toile_study: VERSION,
        toile: env!("CARGO_PKG_VERSION").to_owned(),
        pipeline: head.pipeline,
        threads: head.threads,
        wanted_mm: head.wanted_mm,
        girth_heights_mm: at.iter().map(|y| 1e3 * y[2]).collect(),
        trend: trend(&runs, &measured),
        rows: rows.collect(),
        finest,
        recommended: None,
        left_out: head.left_out,
        repeated,
        shown: None,
    };
    study.judge();
    Some(study)
}

/// The surface and the certificate of a drape.
type Figures = (Surface, Option<Certificate>);

fn figures(garment: &Garment) -> Option<Figures> {
    Some((Surface::of(garment)?, garment.certificate.clone()))
}

/// Runs whose drapes differ, and the names of those that repeat another one. Of equal ones a preset is kept before the
/// program's own choice, and that before others.
fn without_repeats(ran: Vec<Ran>) -> (Vec<Ran>, Vec<[String; 2]>) {
    let shape = |i: usize| ran[i].garment.as_ref()?.drape.as_ref().map(|d| &d.positions);
    let rank = |i: &usize| (Preset::of(&ran[*i].done.setting).is_none(), !ran[*i].done.setting.is_own());
    let mut order: Vec<usize> = (0..ran.len()).collect();
    order.sort_by_key(rank);
    let mut kept: Vec<usize> = Vec::new();
    let mut repeated = Vec::new();
    for i in order {
        let same = |k: &&usize| shape(i).is_some() && shape(i) == shape(**k);
        match kept.iter().find(same) {
            Some(k) => repeated.push([i, *k].map(|i| ran[i].done.setting.name())),
            None => kept.push(i),
        }
    }
    let all = ran.into_iter().enumerate().filter(|(i, _)| kept.contains(i)).map(|(_, r)| r);
    (all.collect(), repeated)
}

/// The index of the drape on the finest mesh; of several, the strictest. One that passed its certificate, if any did.
#[must_use]
pub fn finest(ran: &[Ran]) -> Option<usize> {
    let passed = |i: usize| ran[i].done.certificate.as_ref().is_some_and(|c| c.passed);
    let is_draped = |i: usize| ran[i].garment.as_ref().is_some_and(|g| g.drape.is_some());
    let draped = (0..ran.len()).filter(|i| is_draped(*i) && ran[*i].done.setting.is_own());
    draped.min_by(|a, b| {
        let edge = |i: &usize| ran[*i].done.setting.edge.unwrap_or(0.0);
        let strict = |i: &usize| ran[*i].done.setting.accuracy as u8;
        passed(*b).cmp(&passed(*a)).then(edge(a).total_cmp(&edge(b))).then(strict(b).cmp(&strict(a)))
    })
}

/// A run and all coarser meshes with the same settings, from fine to coarse; where one has none, the one with the program's
/// own tolerance stands in.
fn ladder<'a>(runs: &'a [Done], measured: &'a [Option<Lengths>], i: usize) -> Vec<Level<'a>> {
    let this = &runs[i].setting;
    let own = Setting { accuracy: Setting::plain(None).accuracy, ..*this };
    let mut levels: Vec<Level<'a>> = Level::of(&runs[i], measured[i].as_ref()).into_iter().collect();
    for wanted in [*this, own] {
        let fits = |j: &usize| runs[*j].setting.edge > this.edge && runs[*j].setting.same_but_for_edge(&wanted);
        for level in (0..runs.len()).filter(fits).filter_map(|j| Level::of(&runs[j], measured[j].as_ref())) {
            if levels.iter().all(|l| l.edge != level.edge) {
                levels.push(level);
            }
        }
    }
    levels.sort_by(|a, b| a.edge.total_cmp(&b.edge));
    levels
}

/// The trend over the meshes of the program's own choice.
fn trend(runs: &[Done], measured: &[Option<Lengths>]) -> Option<Trend> {
    let mut levels: Vec<Level<'_>> = Vec::new();
    for (run, lengths) in runs.iter().zip(measured).filter(|(r, _)| r.setting.is_own()) {
        let Some(level) = Level::of(run, lengths.as_ref()) else { continue };
        if levels.iter().all(|l| l.edge != level.edge) {
            levels.push(level);
        }
    }
    Trend::of(&levels)
}

impl<'a> Level<'a> {
    fn of(done: &Done, lengths: Option<&'a Lengths>) -> Option<Self> {
        Some(Self { edge: done.setting.edge?, lengths: lengths? })
    }
}

impl Row {
    fn plain(done: &Done, lengths: Option<Lengths>) -> Self {
        let preset = Preset::of(&done.setting);
        Self {
            name: done.setting.name(),
            done: done.clone(),
            lengths,
            scatter: None,
            error: None,
            carried: None,
            estimate_mm: None,
            estimate_to_finest_mm: None,
            on_front: false,
            preset: preset.map(|p| p.name.to_owned()),
            promised_mm: preset.map(|p| p.bound),
            promise_held: None,
        }
    }
}

/// The figures of a drape and of the finest one, put against each other.
fn compare(
    certificates: [Option<&Certificate>; 2],
    [hem_mm, girth_mm, tape_mm]: [f64; 3],
    [distance_mean_mm, distance_p95_mm, distance_max_mm]: [f64; 3],
) -> Error {
    let of = |c: Option<&Certificate>| c.map_or((0.0, 0.0), |c| (c.strain_p95, c.energy_j));
    let [(strain, energy), (finest_strain, finest_energy)] = certificates.map(of);
    Error {
        length_mm: hem_mm.max(girth_mm),
        hem_mm,
        girth_mm,
        tape_mm,
        distance_mean_mm,
        distance_p95_mm,
        distance_max_mm,
        strain_p95: strain - finest_strain,
        energy_rel: if finest_energy > 0.0 { energy / finest_energy - 1.0 } else { 0.0 },
    }
}

impl Study {
    /// Places of all rows that passed their certificate: seconds, and the error that may be stated.
    #[must_use]
    pub fn places(&self) -> Vec<Option<Place>> {
        let place = |(i, row): (usize, &Row)| {
            let error = self.stated(i).filter(|_| row.is_good())?;
            Some(Place { seconds: row.done.cpu_seconds, error })
        };
        self.rows.iter().enumerate().map(place).collect()
    }

    /// The places of the program's own method, which alone are recommended.
    fn own_places(&self) -> Vec<Option<Place>> {
        let own = |(p, row): (Option<Place>, &Row)| p.filter(|_| row.done.setting.is_own());
        self.places().into_iter().zip(&self.rows).map(own).collect()
    }

    /// The most exact row of the program's own method, with its error, mm.
    #[must_use]
    pub fn nearest(&self) -> Option<(&Row, f64)> {
        let places = self.own_places();
        let at = nearest(&places)?;
        Some((&self.rows[at], places[at]?.error))
    }

    /// The error of a row that may be stated, mm: its difference from the finest, and what the finest itself is off.
    #[must_use]
    pub fn stated(&self, row: usize) -> Option<f64> {
        Some(self.error_mm(row)? + self.own_error()?)
    }

    /// The error that counts, mm. Hem heights and girths along the cloth are those of the row's own drape. Girths by the
    /// tape and the surface are compared in the same folds, where the finest drape was carried over.
    #[must_use]
    pub fn error_mm(&self, row: usize) -> Option<f64> {
        let row = &self.rows[row];
        let own = row.error.as_ref()?;
        Some(row.carried.as_ref().unwrap_or(own).worst_mm().max(own.length_mm))
    }

    /// Distance of the finest result from the limit of fine meshes, mm: the larger of what its lengths and its surface
    /// tell. The trend of all meshes tells it, or two meshes. A single mesh gives none. A mesh from a file is the limit
    /// itself.
    #[must_use]
    pub fn own_error(&self) -> Option<f64> {
        let finest = &self.rows[self.finest];
        let Some(edge) = finest.done.setting.edge else { return Some(0.0) };
        let lengths = self.trend.map(|t| t.error(edge, None)).or(finest.estimate_mm)?;
        let coarser =
            self.rows.iter().filter_map(|r| Some((r.done.setting.edge?, r.carried.as_ref()?.distance_p95_mm)));
        let surface = surface_to_limit(edge, &coarser.collect::<Vec<_>>());
        Some(surface.map_or(lengths, |surface| lengths.max(surface)))
    }

    /// How far apart 95 % of the cloth lies on the mesh of a row after starts that were shaken, mm. Settings on one mesh
    /// share it.
    #[must_use]
    pub fn scatter_mm(&self, row: usize) -> Option<f64> {
        let edge = self.rows[row].done.setting.edge;
        let same = self.rows.iter().filter(|r| r.done.setting.edge == edge);
        same.filter_map(|r| r.scatter.as_ref()).map(|s| s.apart_p95_mm).reduce(f64::max)
    }

    /// Is the surface of a row no farther from the finest than two starts of one of their meshes are from each other?
    #[must_use]
    pub fn is_within_scatter(&self, row: usize) -> bool {
        let scatter = [row, self.finest].into_iter().filter_map(|r| self.scatter_mm(r)).reduce(f64::max);
        let error = self.rows[row].error.as_ref().filter(|_| row != self.finest);
        error.zip(scatter).is_some_and(|(e, scatter)| e.distance_p95_mm <= scatter)
    }

    fn judge(&mut self) {
        let places = self.places();
        let marks = front(&places);
        self.recommended = recommend(&self.own_places(), self.wanted_mm);
        for ((row, mark), place) in self.rows.iter_mut().zip(marks).zip(&places) {
            row.on_front = mark;
            // Nothing is promised for a drape that fails its certificate, and nothing is held either.
            row.promise_held = row.promised_mm.map(|bound| place.is_some_and(|p| p.error <= bound));
        }
    }

    /// How many estimates are within a factor of two of the error, of how many. Only the program's own model counts, which
    /// the finest has too: another model has another limit. What differs by less than a millimetre, as a tape shows it, agrees.
    #[must_use]
    pub fn estimates_within_two(&self) -> (usize, usize) {
        let pairs = self.rows.iter().enumerate().filter(|(i, _)| *i != self.finest).filter_map(|(_, r)| {
            let error = r.error.as_ref()?.length_mm;
            Some((r.estimate_to_finest_mm?, error)).filter(|_| r.done.setting.is_own())
        });
        let agree = |(guess, error): (f64, f64)| (guess - error).abs() < 1.0 || (0.5..=2.0).contains(&(guess / error));
        let all: Vec<bool> = pairs.map(agree).collect();
        (all.iter().filter(|good| **good).count(), all.len())
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use toile_garment::garment::Certificate;
    use toile_stages::drape::ModelName;

    fn row(setting: Setting, seconds: f64, error: f64, estimates: Option<[f64; 2]>) -> Row {
        let done = Done {
            setting,
            key: String::new(),
            inputs: Vec::new(),
            status: "good".to_owned(),
            failure: None,
            seconds,
            cpu_seconds: seconds,
            drape_cpu_seconds: seconds,
            peak_mb: Some(20.0 + seconds),
            triangles: 1000,
            certificate: Some(Certificate { passed: true, ..Certificate::default() }),
        };
        let mut row = Row::plain(&done, Some(Lengths::default()));
        row.error = Some(Error { length_mm: error, ..Error::default() });
        row.estimate_mm = estimates.map(|e| e[0]);
        row.estimate_to_finest_mm = estimates.map(|e| e[1]);
        row
    }

    /// A study whose figures were made up: errors of 4, 2 and 1 mm, a poorer model that is cheap and agrees by luck.
    pub fn sample() -> Study {
        let plain = |mm| Setting::plain(Some(mm));
        let mut study = Study {
            toile_study: VERSION,
            toile: "0".to_owned(),
            pipeline: "test v1".to_owned(),
            threads: 1,
            wanted_mm: 2.5,
            girth_heights_mm: Vec::new(),
            trend: Some(Trend { slope: 0.0, scatter_mm: 0.5 }),
            rows: vec![
                row(plain(32.0), 2.0, 4.0, None),
                row(Setting { model: ModelName::Springs, ..plain(22.0) }, 3.0, 1.0, Some([9.0, 9.0])),
                row(plain(22.0), 4.0, 2.0, Some([4.0, 2.5])),
                row(plain(16.0), 8.0, 1.0, Some([2.0, 0.0])),
                row(plain(8.0), 40.0, 0.0, Some([0.5, 0.0])),
            ],
            finest: 4,
            recommended: None,
            left_out: Vec::new(),
            repeated: Vec::new(),
            shown: None,
        };
        study.judge();
        study
    }

    #[test]
    fn luck_is_not_recommended() {
        let study = sample();
        assert_eq!(study.recommended, Some(2), "the cheapest of the program's own model within 2.5 mm");
        let front: Vec<bool> = study.rows.iter().map(|r| r.on_front).collect();
        assert_eq!(front, [true, true, false, false, true], "but it is shown as it is");
        assert_eq!(study.estimates_within_two(), (1, 2), "0.0 for 1.0 is no estimate");
    }

    #[test]
    fn what_misses_the_wanted_error_is_not_recommended() {
        let mut study = sample();
        study.wanted_mm = 0.1;
        study.judge();
        assert_eq!(study.recommended, None);
        let words = super::super::table::words(&study);
        let told = "None of these settings reaches 0.1 mm. The nearest is `8mm-normal` with 0.5 mm";
        assert!(words.iter().any(|w| w.starts_with(told)), "{words:?}");
        assert!(!super::super::table::text(&study).contains("ecommended"), "{words:?}");
    }

    #[test]
    fn a_stated_error_is_never_below_what_was_found() {
        let study = sample();
        let stated: Vec<Option<f64>> = (0..5).map(|i| study.stated(i)).collect();
        assert_eq!(stated, [Some(4.5), Some(1.5), Some(2.5), Some(1.5), Some(0.5)]);
    }

    #[test]
    fn one_mesh_alone_promises_nothing() {
        let mut study = sample();
        study.rows.drain(..4);
        (study.finest, study.trend, study.rows[0].estimate_mm) = (0, None, None);
        study.rows[0].promised_mm = Some(1e3);
        study.judge();
        assert_eq!((study.stated(0), study.recommended, study.rows[0].promise_held), (None, None, Some(false)));
        let words = super::super::table::words(&study);
        assert!(words.iter().any(|w| w.contains("nothing was compared")), "{words:?}");
        study.rows[0].done.setting.edge = None;
        assert_eq!(study.stated(0), Some(0.0), "a mesh from a file is measured by itself");
    }

    #[test]
    fn promises_are_held_or_not() {
        let study = sample();
        let normal = study.rows.iter().find(|r| r.preset.as_deref() == Some("normal")).expect("a preset");
        assert_eq!(normal.promise_held, Some(normal.promised_mm >= Some(2.5)));
        let mut failed = study.clone();
        failed.rows.iter_mut().for_each(|r| r.done.certificate = None);
        failed.judge();
        assert!(failed.rows.iter().all(|r| r.promise_held != Some(true)), "no certificate, no promise held");
    }

    #[test]
    fn reads_back_what_it_writes() {
        let study = sample();
        let text = serde_json::to_string(&study).expect("JSON");
        assert_eq!(serde_json::from_str::<Study>(&text).expect("study"), study);
    }
}
