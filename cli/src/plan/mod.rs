//! `abbe plan`: where to measure, and how well the errors of the machine will then be known where it is used.

mod sets;

use abbe::analysis::{Workspace, joint_samples};
use abbe::identify::{
    Design, Figures, Known, Model, Observation, Seen, Unknown, d_optimal, groups, predicted,
    what_can_be_known, whole,
};
use abbe::{Description, Manipulator};
use abbe_interpreter::Interpreter;
use serde::Serialize;

use crate::arguments::Plan;
use crate::data::Map;
use crate::failure::Failure;
use crate::identify::{Counts, Setup, alike_table};
use crate::output::{Outcome, json};
use crate::simulate::{csv, write};
use crate::table::wrapped;
use abbe_study::Machine;
use abbe_study::Study;
use abbe_study::number::{self, digits};

use sets::{Counted, Sets};

/// The most configurations of the workspace of use that are looked at.
const USED: usize = 1000;

/// What is printed.
#[derive(Serialize)]
struct Report {
    name: String,
    length: &'static str,
    title: String,
    rows: usize,
    sets: Vec<Counted>,
    rank: usize,
    unknowns: usize,
    /// Of base and frames alone, without the targets on the tool.
    machine: Counts,
    condition: f64,
    /// `ln det` of the information of columns of unit length.
    log_det: f64,
    exchanges: usize,
    /// How many configurations of use were looked at.
    used: usize,
    /// Standard deviation of the identified tool point there, the length unit.
    predicted: Predicted,
}

#[derive(Serialize)]
struct Predicted {
    mean: f64,
    rms: f64,
    max: f64,
    p95: f64,
}

pub(crate) fn run(arguments: &Plan) -> Result<Outcome, Failure> {
    let mut found = Machine::find(&arguments.spec)?;
    found.change(&arguments.changes.read(&found.spec)?);
    let map = Map::find(&arguments.map, &found.spec)?;
    let interpreter = Interpreter::new(found.spec.clone());
    let description = interpreter.description();
    let setup = Setup::at_home(&interpreter, &map)?;
    let model = setup.ideal.with(setup.constants());
    let fail = |error: abbe::identify::Failure| Failure::of(&arguments.spec, error);
    let known_from = |rows: &[Observation]| {
        what_can_be_known(&model, rows, &vec![0.0; model.unknowns.len()]).map_err(fail)
    };
    let (title, rows, counts, known, design) = match &arguments.sets {
        Some(file) => {
            let sets = Sets::find(file, &found.spec)?;
            let (asked, counts) = sets.rows(&interpreter, description)?;
            let rows: Vec<Observation> = asked
                .into_iter()
                .map(|asked| Observation { u: asked.u, ..map.asked(asked.q, description) })
                .collect();
            let known = known_from(&rows)?;
            let design = whole(&model, &rows, &known).map_err(fail)?;
            (sets.title, rows, counts, known, design)
        }
        None => {
            let count = usize::from(arguments.optimal.unwrap_or(50));
            let moved: Vec<usize> = map.moved().collect();
            let samples = joint_samples(&interpreter, &moved, usize::from(arguments.candidates));
            let samples = samples.map_err(|error| Failure::of(&arguments.spec, error))?.reached();
            let list: Vec<Observation> = samples.into_iter().map(|s| map.asked(s.q, description)).collect();
            let known = known_from(&list)?;
            let design = d_optimal(&model, &list, &known, count).map_err(fail)?;
            let chosen = design.as_ref().map_or(Vec::new(), |design| design.chosen.clone());
            let rows: Vec<Observation> = chosen.iter().map(|i| list[*i].clone()).collect();
            let title = format!("D-optimal: {count} of {} samples", list.len());
            (title, rows, Vec::new(), known, design)
        }
    };
    let Some(design) = design else {
        let message = format!("so few configurations cannot determine {} combinations of errors", known.rank);
        return Err(Failure::of(&arguments.spec, message).help("plan more of them"));
    };
    let used = used(&found, &interpreter, description, arguments)?;
    let spread = at_the_tool(&model, &known, &design, &used).map_err(fail)?;
    let spread = Figures::of(spread);
    let observed = known_from(&rows)?;
    let report = Report {
        name: found.spec.name.clone(),
        length: found.spec.length.symbol(),
        title,
        rows: rows.len(),
        sets: counts,
        rank: known.rank,
        unknowns: model.unknowns.len(),
        machine: Counts::of(&model, &known),
        condition: observed.observability.condition,
        log_det: design.log_det,
        exchanges: design.exchanges,
        used: used.len(),
        predicted: Predicted { mean: spread.mean, rms: spread.rms, max: spread.max, p95: spread.p95 },
    };
    if let Some(file) = &arguments.out {
        let numbers: Vec<_> = rows.iter().map(|row| map.numbers(row, [0.0; 3], false)).collect();
        write(file, &csv(&map.heading(false), &numbers))?;
    }
    let moved = setup.moved(&rows);
    let alike = rows.first().map_or(Ok(Vec::new()), |row| groups(&model, &row.q, &moved, setup.pose));
    let alike = alike.map_err(|error| Failure::of(&arguments.spec, error))?;
    let alike = alike_table(&alike, &model, description);
    let text = if arguments.json { json(&report)? } else { text(&found, &map, &report, &alike, arguments) };
    Ok(Outcome::passed(text))
}

/// Where the machine is to be used.
fn used(
    found: &Machine,
    manipulator: &dyn Manipulator,
    description: &Description,
    arguments: &Plan,
) -> Result<Vec<Observation>, Failure> {
    let study = Study::find(arguments.study.as_deref(), found)?;
    let fail = |error: abbe::Error| Failure::of(&arguments.spec, error);
    let workspace = study.region.workspace(manipulator, None).map_err(fail)?;
    let step = workspace.len().div_ceil(USED).max(1);
    let rows = (0..workspace.len()).step_by(step).filter_map(|i| workspace.configuration(i).ok());
    let u: Vec<f64> = description.inputs.iter().map(|input| input.nominal).collect();
    let rows: Vec<Observation> =
        rows.map(|c| Observation { q: c.q, u: u.clone(), seen: Seen::Points(Vec::new()) }).collect();
    if rows.is_empty() {
        let every: Vec<usize> = (0..description.variables.len()).collect();
        let samples = joint_samples(manipulator, &every, 100).map_err(fail)?.reached();
        return Ok(samples
            .into_iter()
            .map(|c| Observation { q: c.q, u: u.clone(), seen: Seen::Points(Vec::new()) })
            .collect());
    }
    Ok(rows)
}

/// The standard deviation of the tool point: a target of its own, which nothing was measured with.
fn at_the_tool(
    model: &Model,
    known: &Known,
    design: &Design,
    used: &[Observation],
) -> Result<Vec<f64>, abbe::identify::Failure> {
    let mut model = model.clone();
    // A single target at zero is the tool point; where it is on the tool has been measured with the rest.
    let single =
        model.targets.len() == 1 && !model.unknowns.iter().any(|unknown| matches!(unknown, Unknown::Tool(_)));
    let place = if single { 0 } else { model.targets.len() };
    if !single {
        model.targets.push([0.0; 3]);
    }
    let mut points = vec![None; model.targets.len()];
    points[place] = Some([0.0; 3]);
    let list: Vec<Observation> =
        used.iter().map(|row| Observation { seen: Seen::Points(points.clone()), ..row.clone() }).collect();
    predicted(&model, known, &design.covariance, &list)
}

fn text(found: &Machine, map: &Map, report: &Report, alike: &str, arguments: &Plan) -> String {
    let unit = found.spec.length.symbol();
    let mut text = format!("{}: where to measure\n\n{}\n", found.spec.title, wrapped(&report.title, 0));
    text += &format!("{} rows", report.rows);
    let sets: Vec<String> = report.sets.iter().map(|set| format!("{} {}", set.rows, set.name)).collect();
    text += &if sets.is_empty() { ".\n".to_owned() } else { format!(": {}.\n", sets.join(", ")) };
    let sentence = format!(
        "They determine {} combinations of {} unknowns ({}), with a condition number of {}.",
        report.rank,
        report.unknowns,
        report.machine,
        digits(report.condition, 3)
    );
    text += &format!("{}\n", wrapped(&sentence, 0));
    text += &format!("\n{alike}\n");
    let fine = |value: f64| format!("{} {unit}", number::digits(value, 3));
    let sentence = format!(
        "With an instrument of {} {unit} the tool point of the identified machine will then have a standard deviation of \
         {} on average over {} configurations of its use, of {} at most.",
        number::short(map.uncertainty.length),
        fine(report.predicted.mean),
        report.used,
        fine(report.predicted.max)
    );
    text += &format!("{}\n", wrapped(&sentence, 0));
    if let Some(file) = &arguments.out {
        text += &format!("Written to {}.\n", file.display());
    }
    text
}
