//! `monitor` detects simulated drifts in time and names them; an unchanged machine raises no more
//! alarms than stated.

use std::path::PathBuf;
use std::sync::Arc;

use abbe::control::normal_quantile;
use abbe::identify::{
    Chance, Measurement, Model, Observation, Uncertainty, Unknown, simulate, student_beyond,
};
use abbe::{Class, Component, Pose};
use abbe_interpreter::Interpreter;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::monitor::{Check, Checks, Monitor, Report, Settings};
use abbe_study::Machine;
use abbe_study::date::Calendar;

/// Standard deviation of a coordinate in mm, as for a laser tracker.
const NOISE: f64 = 0.01;

/// Number of points in a check.
const POINTS: usize = 8;

fn map(base: &str, machine: &Machine) -> Map {
    let joints: String =
        (1..=6).map(|i| format!("q{i} = {{ column = \"j{i}\", unit = \"deg\" }}\n")).collect();
    let text = format!(
        "[data]\nuncertainty = \"{NOISE} mm\"\nbase = \"{base}\"\n\n[joints]\n{joints}\n[point]\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n"
    );
    Map::parse("map.toml", &text, &machine.spec).unwrap()
}

/// Machine with daily checks.
struct Watched {
    machine: Machine,
    interpreter: Interpreter,
    places: Vec<Observation>,
}

impl Watched {
    fn new(name: &str) -> Self {
        let machine = Machine::find(name).unwrap();
        let interpreter = Interpreter::new(machine.spec.clone());
        let place = |i: usize| {
            let q = (0..6)
                .map(|j| 1.2 * (1.7 * (i + 1) as f64 * (j + 2) as f64).sin() - 0.3 * j as f64)
                .collect::<Vec<f64>>();
            Observation::new(i as u64 + 2, q, Vec::new(), Measurement::Points(vec![Some([0.0; 3])].into()))
        };
        Self { machine, interpreter, places: (0..POINTS).map(place).collect() }
    }

    /// Returns the machine without its random sources.
    fn without_random_sources(mut self) -> Self {
        let sources = Arc::make_mut(&mut self.machine.spec).sources.iter_mut();
        sources.filter(|source| source.class != Class::Repeatable).for_each(|source| source.enabled = false);
        self.interpreter = Interpreter::new(self.machine.spec.clone());
        self
    }

    fn model(&self, error: Unknown) -> Model<'_> {
        let uncertainty = Uncertainty { length: NOISE, angle: 1.0 };
        Model::ideal(&self.interpreter, vec![[0.0; 3]], uncertainty).with(vec![error])
    }

    /// Returns the largest displacement of the tool point per unit of an error.
    fn effect(&self, error: Unknown) -> f64 {
        self.effects(error).into_iter().fold(0.0, f64::max)
    }

    /// Returns the displacement of the tool point per unit of an error at every configuration.
    fn effects(&self, error: Unknown) -> Vec<f64> {
        let model = self.model(error);
        let mut at = model.at(&[0.0]);
        let moved = self.places.iter().map(|place| {
            let (_, moves) = at.tool(place).unwrap();
            moves[0].iter().map(|v| v * v).sum::<f64>().sqrt()
        });
        moved.collect()
    }

    /// Simulates daily checks: on day `t` the error is `size(t)`, and the pose of the instrument is
    /// `station(t)`.
    fn checks(
        &self,
        days: usize,
        error: Unknown,
        size: impl Fn(f64) -> f64,
        station: impl Fn(f64) -> Pose,
        seed: u64,
    ) -> Checks {
        let model = self.model(error);
        let list = (0..days).map(|day| {
            let time = day as f64;
            let noise = Uncertainty { length: NOISE, angle: 0.0 };
            let seed = seed * 1000 + day as u64;
            let chance = Chance {
                noise,
                outliers: 0.0,
                outlier_size: 0.0,
                random_sources: false,
                one_machine: true,
                seed,
            };
            let mut rows = simulate(&model, &self.places, &chance).unwrap();
            for row in &mut rows {
                let [before, after] = [0.0, size(time)].map(|x| model.at(&[x]).pose(row).unwrap().position());
                let Measurement::Points(points) = &mut row.measured else { unreachable!() };
                for point in points.iter_mut().flatten() {
                    *point = station(time).apply(std::array::from_fn(|k| point[k] + after[k] - before[k]));
                }
            }
            let data = Data { file: format!("check-{day}.csv"), observations: rows, ..Data::default() };
            Check { time, data }
        });
        Checks { calendar: Calendar::Dates, list: list.collect(), since: None }
    }

    fn report(&self, base: &str, checks: Checks, tolerance: Option<f64>) -> Report {
        let settings = Settings { tolerance, ..Settings::default() };
        let map = map(base, &self.machine);
        Monitor { machine: self.machine.clone(), map, checks, settings }.run(&mut ()).unwrap()
    }
}

fn here(_: f64) -> Pose {
    Pose::IDENTITY
}

/// Returns a different pose for every day.
fn anywhere(day: f64) -> Pose {
    let (sine, cosine) = (0.1 * day).sin_cos();
    Pose([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0], [20.0 * sine, 5.0 * day, -3.0]])
}

/// A drift of 1 µm per day is detected before it reaches 20 µm, with at most one false alarm per
/// year, as the documentation promises. 36 machines, each with a different error, are checked for
/// 60 days before the drift begins. Rates are those of the point that moves most. An alarm before
/// the drift is false; 60 days are 0.16 years.
#[test]
fn a_drift_of_1_um_per_day_is_detected_before_20_um() {
    let watched = Watched::new("ur5");
    let errors = (0..6).flat_map(|frame| Component::ALL.map(|component| Unknown::Error(frame, component)));
    // Some rotational errors do not move the tool point.
    let errors: Vec<Unknown> = errors.filter(|error| watched.effect(*error) > 1e-6).collect();
    let (runs, quiet) = (36, 60.0);
    let (mut false_alarms, mut caught, mut sum, mut last) = (0, 0, 0.0, 0.0_f64);
    for run in 0..runs {
        let error = errors[run % errors.len()];
        let speed = 1e-3 / watched.effect(error);
        let checks = watched.checks(80, error, |day| speed * (day - quiet).max(0.0), here, run as u64 + 1);
        let alarm = watched.report("exact", checks, None).alarm;
        let micrometres = alarm.map_or(f64::INFINITY, |alarm| alarm.check as f64 - quiet);
        if micrometres < 0.0 {
            false_alarms += 1;
        } else {
            caught += u32::from(micrometres < 20.0);
            (sum, last) = (sum + micrometres, last.max(micrometres));
        }
    }
    let drifting = runs as u32 - false_alarms;
    let mean = sum / f64::from(drifting);
    println!(
        "{caught} of {drifting} caught, at {mean:.1} µm on average and {last} µm at most; {false_alarms} false alarms"
    );
    assert_eq!(caught, drifting);
    // Poisson distribution with a mean of at most 36 · 60/365 = 5.9.
    assert!(false_alarms <= 13, "{false_alarms}");
}

/// A station that changes every day hides a part of every error, but not the drift.
#[test]
fn changing_stations_raise_no_alarm_and_hide_no_drift() {
    let watched = Watched::new("ur5");
    let error = Unknown::Error(2, Component::Roll);
    let speed = 1e-3 / watched.effect(error);
    for seed in 1..=5 {
        let checks = watched.checks(110, error, |day| speed * (day - 60.0).max(0.0), anywhere, seed);
        let report = watched.report("unknown", checks, None);
        let alarm = report.alarm.expect("it drifts");
        assert!((60..100).contains(&alarm.check), "{alarm:?}");
        assert!(report.charts.iter().all(|chart| !chart.name.starts_with("station")));
    }
}

/// The share of machine-years without change and without alarm is at least 1/e.
#[test]
fn an_unchanged_machine_raises_at_most_one_alarm_a_year() {
    let watched = Watched::new("ur5");
    let error = Unknown::Error(0, Component::X);
    let (years, mut quiet) = (24, 0);
    for year in 0..years {
        let checks = watched.checks(365, error, |_| 0.0, here, 500 + year);
        quiet += u64::from(watched.report("exact", checks, None).alarm.is_none());
    }
    println!("{quiet} of {years} machine-years without an alarm");
    // 1/e = 0.368; three standard errors are 3 √(0.368 · 0.632/24) = 0.295.
    assert!(quiet as f64 / years as f64 > 0.368 - 0.295, "{quiet}");
}

/// A drift is identified with time, rate and date of exceeding the tolerance, within the stated
/// uncertainties.
#[test]
fn the_drifting_error_is_identified() {
    let watched = Watched::new("ur5");
    // The zero of q3 is the spin error of its joint's frame, whose axis is z.
    let error = Unknown::Error(2, Component::Spin);
    let speed = 2e-3 / watched.effect(error);
    let (mut named, mut dated, mut fast, mut leaves) = (0, 0, 0, 0);
    let runs = 20;
    for run in 0..runs {
        let checks = watched.checks(95, error, |day| speed * (day - 60.0).max(0.0), here, 900 + run);
        let report = watched.report("exact", checks, Some(0.1));
        let finding = report.finding.expect("it drifts");
        let name = "e_s3 (elbow)";
        let alike = report
            .charts
            .iter()
            .filter(|chart| chart.name == finding.name || finding.as_well.contains(&chart.name));
        named += u64::from(
            finding.name == name
                || finding.as_well.iter().any(|other| other == name)
                || alike.flat_map(|chart| &chart.indistinguishable).any(|other| other == name),
        );
        assert_eq!(finding.kind, "drift");
        let is_zero = |name: &String| name.starts_with("zero of");
        assert!(is_zero(&finding.name) || !finding.as_well.iter().any(is_zero), "{finding:?}");
        let [first, last] = finding.between;
        dated += u64::from(first.is_none_or(|first| first <= 60.0) && last.is_some_and(|last| last >= 60.0));
        let micrometres = finding.size.abs() * finding.effect * 1e3;
        fast +=
            u64::from((micrometres - 2.0).abs() < 3.0 * finding.standard_deviation * finding.effect * 1e3);
        let leaving = finding.leaves.expect("it drifts");
        leaves += u64::from((leaving.time - 110.0).abs() < 3.0 * leaving.standard_deviation);
    }
    println!("named {named}, dated {dated}, speed {fast}, leaving {leaves} of {runs}");
    assert!(named >= 19 && dated >= 17 && fast >= 18 && leaves >= 18, "{named} {dated} {fast} {leaves}");
}

/// Jumps of 6 σ, of errors as the points of one check determine them, are found on the day on which
/// they happen as often as theory says, and machines that do not change raise no more alarms in 90
/// days than stated: 100 machines without random sources of their own.
#[test]
fn a_jump_of_six_standard_deviations_is_found_on_its_day() {
    let watched = Watched::new("ur5").without_random_sources();
    let errors = (1..4).flat_map(|frame| Component::ALL.map(|component| Unknown::Error(frame, component)));
    let errors: Vec<Unknown> = errors.filter(|error| watched.effect(*error) > 1e-6).collect();
    let (runs, days, day) = (100, 90, 60.0);
    let (mut found, mut early, mut expected) = (0, 0, 0.0);
    for run in 0..runs {
        let error = errors[run % errors.len()];
        let norm = watched.effects(error).into_iter().map(|moved| moved * moved).sum::<f64>().sqrt();
        let size = 6.0 * NOISE / norm;
        let checks =
            watched.checks(days, error, |at| if at < day { 0.0 } else { size }, here, 3000 + run as u64);
        let report = watched.report("exact", checks, None);
        let alarm = report.alarm.as_ref().map_or(usize::MAX, |alarm| alarm.check);
        (found, early) = (found + u32::from(alarm == 60), early + u32::from(alarm < 60));
        // One of two sides.
        let limit = -normal_quantile(0.5 * report.limit.chance);
        let shift = 6.0 * (day / (day + 1.0)).sqrt();
        let beyond = 0.5 * student_beyond((shift - limit).abs(), 1e6);
        expected += if shift > limit { 1.0 - beyond } else { beyond };
    }
    println!("{found} found on their day, {expected:.1} expected; {early} earlier");
    let quiet = f64::from(runs as u32 - early);
    let expected = expected / runs as f64 * quiet;
    assert!(
        f64::from(found) > expected - 3.0 * (expected * (1.0 - expected / quiet)).sqrt() - 1.0,
        "{found}"
    );
    // 100 (1 − exp(−60/365)) = 15.2, with a standard error of 3.6.
    assert!(early <= 26, "{early}");
}

/// A jump of a hundred standard deviations on the third day, for two days, is an alarm on that day;
/// afterwards all is as before.
#[test]
fn an_early_jump_is_seen_at_once_and_goes_back() {
    let watched = Watched::new("ur5");
    let error = Unknown::Error(1, Component::Spin);
    let size = 1.0 / watched.effect(error);
    for (first, days) in [(2.0, 2.0), (20.0, 1.0), (13.0, 4.0)] {
        let is_away = move |day: f64| (first..first + days).contains(&day);
        let checks = watched.checks(28, error, |day| if is_away(day) { size } else { 0.0 }, here, 5);
        let report = watched.report("exact", checks, Some(0.5));
        assert_eq!(
            report.alarm.as_ref().map(|alarm| alarm.check),
            Some(first as usize),
            "{:?}",
            report.alarm
        );
        let away: Vec<usize> = (0..28).filter(|check| report.left.single[*check] > 1.0).collect();
        assert_eq!(away, (0..28).filter(|day| is_away(f64::from(*day as u32))).collect::<Vec<_>>());
        let finding = report.finding.expect("it jumped");
        assert_eq!((finding.kind, finding.since), ("excursion", first), "{finding:?}");
        assert!((finding.farthest - 1.0).abs() < 0.1 && finding.moved < 1e-9, "{finding:?}");
    }
}

/// An uncertainty that is stated five times too small is an alarm at the second check, and none
/// afterwards.
#[test]
fn an_uncertainty_that_is_too_small_does_not_set_every_check_apart() {
    let watched = Watched::new("ur5").without_random_sources();
    let checks = watched.checks(40, Unknown::Error(0, Component::X), |_| 0.0, here, 8);
    let mut map = map("exact", &watched.machine);
    map.uncertainty.length = NOISE / 5.0;
    let settings = Settings::default();
    let report = Monitor { machine: watched.machine.clone(), map, checks, settings }.run(&mut ()).unwrap();
    let apart: Vec<usize> = (0..40).filter(|check| report.left.single[*check] > 1.0).collect();
    assert_eq!(apart, [1], "{:?}", report.left.single);
}

#[test]
fn a_jump_and_a_moving_station_are_identified() {
    let watched = Watched::new("ur5");
    let error = Unknown::Error(2, Component::Spin);
    let size = 0.05 / watched.effect(error);
    let jumped = watched.checks(60, error, |day| if day < 40.0 { 0.0 } else { size }, here, 3);
    let report = watched.report("exact", jumped, Some(0.02));
    let finding = report.finding.as_ref().expect("it jumped");
    assert_eq!((finding.kind, finding.since, finding.between), ("jump", 40.0, [Some(39.0), Some(40.0)]));
    assert!((finding.moved - 0.05).abs() < 0.01, "{finding:?}");
    assert!(report.tolerance.is_some_and(|tolerance| finding.moved > tolerance), "{report:?}");

    let sinking = |day: f64| {
        let mut pose = Pose::IDENTITY;
        pose.0[3][2] = -2e-3 * (day - 30.0).max(0.0);
        pose
    };
    let moved = watched.checks(60, error, |_| 0.0, sinking, 4);
    let finding = watched.report("exact", moved, None).finding.expect("it sinks");
    let names = finding.as_well.iter().chain([&finding.name]);
    assert!(
        finding.may_be_outside && names.into_iter().any(|name| name == "station e_z"),
        "{}",
        finding.name
    );
}

#[test]
fn checks_that_cannot_be_read_are_refused() {
    let watched = Watched::new("ur5");
    let folder = tempfile::tempdir().unwrap();
    let row = "0,-90,90,0,0,0,500,200,300\n10,-80,70,0,10,0,510,210,310\n";
    let heading = "j1,j2,j3,j4,j5,j6,x,y,z";
    let file = |name: &str, text: String| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    };
    let plain = map("exact", &watched.machine);
    let mistake = |files: &[PathBuf], map: &Map| Checks::read(files, map).unwrap_err().to_string();
    let empty = file("empty.csv", format!("{heading}\n"));
    assert!(mistake(&[empty], &plain).contains("no row can be used"));
    let first = file("a-2026-03-02.csv", format!("{heading}\n{row}"));
    let second = file("b-2026-03-01.csv", format!("{heading}\n{row}"));
    let said = mistake(&[first.clone(), second.clone()], &plain);
    assert!(said.contains("not in chronological order: 2026-03-01 comes after 2026-03-02"), "{said}");
    let other = file("c-2026-03-03.csv", format!("{}\n{row}", heading.replace('x', "east")));
    let said = mistake(&[first.clone(), other], &plain);
    assert!(said.contains("no column `x`"), "{said}");
    let checks = Checks::read(&[second, first.clone()], &plain).unwrap();
    assert_eq!((checks.calendar, checks.list.len(), checks.list[1].time), (Calendar::Dates, 2, 20_514.0));

    let mut dated = plain.clone();
    dated.time = Map::parse("map.toml", &MAP_WITH_TIME.replace("JOINTS", &joints()), &watched.machine.spec)
        .unwrap()
        .time;
    let dates = file(
        "long.csv",
        format!(
            "date,{heading}\n2026-03-01,{}2026-03-02 08:00,{}",
            "0,-90,90,0,0,0,500,200,300\n", "0,-90,90,0,0,0,500,200,300\n"
        ),
    );
    let checks = Checks::read(&[dates], &dated).unwrap();
    assert_eq!(checks.list.iter().map(|check| check.data.observations.len()).collect::<Vec<_>>(), [1, 1]);
    let wrong = file("wrong.csv", format!("date,{heading}\n1.3.2026,{row}"));
    assert!(mistake(&[wrong], &dated).contains("line 2: `date` is `1.3.2026`, neither a date nor a number"));
    assert!(mistake(std::slice::from_ref(&first), &dated).contains("there is no column `date`"));
    let mut checks = Checks::read(&[first], &plain).unwrap();
    assert!(
        checks
            .since("--since", "2027-01-01")
            .unwrap_err()
            .to_string()
            .contains("there is no check after this date")
    );
}

fn joints() -> String {
    (1..=6).map(|i| format!("q{i} = {{ column = \"j{i}\", unit = \"deg\" }}\n")).collect()
}

const MAP_WITH_TIME: &str = "[data]\nuncertainty = \"0.01 mm\"\ntime = \"date\"\n[joints]\nJOINTS\n[point]\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n";
