//! Jobs as library calls without the command.

use abbe::lanes::{Batches, Tiles};
use abbe::{Description, Error, Function, Manipulator};
use abbe_interpreter::Interpreter;
use abbe_study::analyze::{Agreement, Analyze};
use abbe_study::check::{Check, laws};
use abbe_study::jacobian::Jacobian;
use abbe_study::study_file::{CombinedFigure, Subject};
use abbe_study::{Changes, Machine, Notes, Study};

/// Recorded notes of a job.
#[derive(Default)]
struct RecordedNotes {
    notes: Vec<String>,
    stop: bool,
}

impl Notes for RecordedNotes {
    fn note(&mut self, note: &str) {
        self.notes.push(note.to_owned());
    }

    fn stop(&self) -> bool {
        self.stop
    }
}

fn changed(name: &str, set: &str) -> Machine {
    let mut machine = Machine::find(name).unwrap();
    let changes = Changes::read([&[set.to_owned()], &[], &[], &[]], &machine.spec).unwrap();
    machine.change(&changes);
    machine
}

#[test]
fn the_papers_radius_without_a_process() {
    let machine = Machine::find("pps").unwrap();
    let study = Study::find(None, &machine).unwrap();
    let mut job = Analyze::new(machine, study);
    job.figures = true;
    let report = job.run(&mut ()).unwrap();
    let published = report.published(&Subject::Combined(CombinedFigure::Both)).unwrap();
    assert!(published.figures[3].is_some());
    assert!(matches!(published.agreement, Agreement::Met | Agreement::Missed { .. }));
    assert_eq!(report.figures.as_ref().unwrap().figures.len(), report.study.figures.len());
    let json = serde_json::to_value(&report).unwrap();
    assert_eq!(json["combined"]["radius"], report.budget.combined.radius.value);
    // The ledger is sorted by rank.
    let ranks = json["ledger"]["sources"].as_array().unwrap().iter().map(|entry| entry["rank"].as_u64());
    assert!(ranks.map(Option::unwrap).eq(1..=report.budget.sources.len() as u64));
    let figures = serde_json::to_value(&report.figures).unwrap();
    assert!(figures["figures"][0]["data"].is_object() || figures["figures"][0]["data"].is_string());
}

#[test]
fn the_right_source_is_blamed() {
    let machine = changed("pps", "arm_EI=0");
    let refused = Jacobian { machine: machine.clone(), q: None }.run(&mut ()).unwrap_err().to_string();
    assert!(refused.contains("the source \"arm deflection\" has no finite value"), "{refused}");
    let study = Study::find(None, &machine).unwrap();
    let refused = Analyze::new(machine, study).run(&mut ()).unwrap_err().to_string();
    assert!(refused.contains("the source \"arm deflection\" has no finite value"), "{refused}");
}

#[test]
fn joints_beyond_limits_are_noted_and_a_job_can_be_stopped() {
    let machine = Machine::find("puma560").unwrap();
    let mut heard = RecordedNotes::default();
    let q = Some(vec![100.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    Jacobian { machine: machine.clone(), q }.run(&mut heard).unwrap();
    assert!(heard.notes[0].contains("is outside its limits"), "{:?}", heard.notes);
    let mut heard = RecordedNotes { stop: true, ..RecordedNotes::default() };
    assert!(Check { machine }.run(&mut heard).unwrap_err().to_string().contains("interrupted"));
}

/// Manipulator whose batches return a wrong value for the last configuration.
struct Forgetful(Interpreter);

impl Manipulator for Forgetful {
    fn description(&self) -> &Description {
        self.0.description()
    }

    fn evaluate(
        &self,
        function: Function,
        arguments: &[&[f64]],
        results: &mut [&mut [f64]],
    ) -> Result<(), Error> {
        self.0.evaluate(function, arguments, results)
    }
}

impl Batches for Forgetful {
    fn batch(&self, function: Function, arguments: &Tiles, results: &mut Tiles) -> Result<(), Error> {
        self.0.batch(function, arguments, results)?;
        results.set_value(0, arguments.count() - 1, 1e9);
        Ok(())
    }
}

#[test]
fn a_wrong_batch_fails_only_its_law() {
    let spec = Machine::find("scara").unwrap().spec;
    assert!(laws(&Interpreter::new(spec.clone()), 20, &mut ()).unwrap().iter().all(|law| law.holds));
    let failed = laws(&Forgetful(Interpreter::new(spec)), 20, &mut ()).unwrap();
    let failed = failed.iter().filter(|law| !law.holds).map(|law| law.law).collect::<Vec<_>>();
    assert_eq!(failed, ["batches = single evaluations"]);
}
