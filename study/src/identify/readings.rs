//! Whether the data are read as they were meant: units, signs, the order of a quaternion.

use abbe::identify::{Measurement, Model, Observation, Options, Station, Uncertainty, fit};
use abbe::{Pose, VariableKind};
use abbe_codegen::diagnostic::Diagnostics;

use super::setup::{Setup, registered};
use crate::data::{Data, Layout, Map, Order, Turn};
use crate::{mistake, number};

/// The most rows that are looked at.
const ROWS: usize = 150;

/// Refuses data that the nominal machine misses by far, if they would fit read otherwise.
pub(crate) fn check_readings(setup: &Setup, map: &Map, data: &Data) -> Result<(), Diagnostics> {
    let step = data.observations.len().div_ceil(ROWS).max(1);
    let rows: Vec<Observation> = data.observations.iter().step_by(step).cloned().collect();
    let Some(here) = missed(setup, &rows) else { return Ok(()) };
    if here < 2e-3 * setup.arm {
        return Ok(());
    }
    let mut best: Option<(f64, String)> = None;
    for (help, change) in alternatives(setup, map) {
        let changed: Vec<Observation> = rows.iter().map(|row| change(row.clone())).collect();
        if let Some(there) = missed(setup, &changed)
            && there < here / 5.0
            && best.as_ref().is_none_or(|(least, _)| there < *least)
        {
            best = Some((there, help));
        }
    }
    let Some((there, help)) = best else { return Ok(()) };
    let unit = setup.description.length;
    let message = format!(
        "read as the map says, the machine misses these data by {} (root mean square), base and tool fitted; read \
         otherwise, by {}",
        number::length(here, unit),
        number::length(there, unit)
    );
    Err(mistake::with_help(&data.file, message, help))
}

/// By how much the nominal machine misses, base and tool fitted: root mean square of a point.
fn missed(setup: &Setup, rows: &[Observation]) -> Option<f64> {
    // Poses as four points: one number says how well position and orientation fit.
    let reach = setup.arm / 4.0;
    let corners = [[0.0; 3], [reach, 0.0, 0.0], [0.0, reach, 0.0], [0.0, 0.0, reach]];
    let points = |row: &Observation| match &row.measured {
        Measurement::Pose(pose) => {
            let measured =
                Measurement::Points(corners.iter().map(|corner| Some(pose.apply(*corner))).collect());
            Observation { measured, ..row.clone() }
        }
        Measurement::Points(_) | Measurement::Readings(_) => row.clone(),
    };
    let rows: Vec<Observation> = rows.iter().map(points).collect();
    let mut model = Model { uncertainty: Uncertainty { length: 1.0, angle: 1.0 }, ..setup.ideal.clone() };
    if setup.pose {
        model.targets = corners.to_vec();
    }
    for i in 0..model.stations.len() {
        // Of few rows at a station nothing is told.
        let pose = registered(&model, &rows, i).ok()??;
        model.stations[i] = Station { pose, exact: false, ..model.stations[i].clone() };
    }
    let model = model.with(model.base_and_tool(false));
    let found = fit(&model, &rows, &Options::default()).ok()?;
    model.figures(&rows, &found.x).ok().map(|figures| figures.rms)
}

/// Another way to read a row.
type Reading = Box<dyn Fn(Observation) -> Observation>;

/// What may have been meant, each with what to change in the map.
fn alternatives(setup: &Setup, map: &Map) -> Vec<(String, Reading)> {
    let mut all: Vec<(String, Reading)> = Vec::new();
    let variables: Vec<(String, VariableKind)> = setup
        .description
        .variables
        .iter()
        .map(|variable| (variable.name.to_string(), variable.kind))
        .collect();
    for (factor, help) in [
        (1e3, "are the measured lengths in m, not mm? set `unit` accordingly"),
        (1e-3, "are the measured lengths in mm, not m? set `unit` accordingly"),
    ] {
        all.push((
            help.to_owned(),
            Box::new(move |row| Observation { measured: scaled(row.measured, factor), ..row }),
        ));
    }
    let of = |kind: VariableKind| {
        variables.iter().enumerate().filter(move |(_, v)| v.1 == kind).map(|(i, _)| i).collect::<Vec<_>>()
    };
    let degree = std::f64::consts::PI / 180.0;
    for (kind, factor, help) in [
        (VariableKind::Revolute, degree, "are the joint angles in deg, not rad? set `unit = \"deg\"`"),
        (VariableKind::Revolute, 1.0 / degree, "are the joint angles in rad, not deg? set `unit = \"rad\"`"),
        (VariableKind::Prismatic, 1e3, "are the joint travels in m, not mm? set `unit` accordingly"),
        (VariableKind::Prismatic, 1e-3, "are the joint travels in mm, not m? set `unit` accordingly"),
    ] {
        let which = of(kind);
        if !which.is_empty() {
            all.push((help.to_owned(), Box::new(move |row| times(row, &which, factor))));
        }
    }
    for (i, (name, _)) in variables.iter().enumerate() {
        let help = format!("does `{name}` count the other way round? set `sign = -1` there");
        all.push((help, Box::new(move |row| times(row, &[i], -1.0))));
    }
    if let Layout::Pose(_, _, Turn::Quaternion(_, order)) = &map.layout {
        let (other, order) = match order {
            Order::Wxyz => ("xyzw", Order::Wxyz),
            Order::Xyzw => ("wxyz", Order::Xyzw),
        };
        let help = format!("is the quaternion in the order `{other}`?");
        all.push((
            help,
            Box::new(move |row| Observation { measured: reordered(row.measured, order), ..row }),
        ));
    }
    if setup.pose {
        let help = "are the orientations the other way round, of F_0 as the tool sees it? turn them round in the file";
        all.push((
            help.to_owned(),
            Box::new(|row| Observation { measured: transposed(row.measured), ..row }),
        ));
    }
    all
}

fn scaled(measured: Measurement, factor: f64) -> Measurement {
    let larger = |point: [f64; 3]| point.map(|coordinate| coordinate * factor);
    match measured {
        Measurement::Points(points) => {
            Measurement::Points(points.into_iter().map(|point| point.map(larger)).collect())
        }
        Measurement::Pose(Pose([x, y, z, position])) => Measurement::Pose(Pose([x, y, z, larger(position)])),
        Measurement::Readings(_) => measured,
    }
}

fn times(mut row: Observation, which: &[usize], factor: f64) -> Observation {
    which.iter().for_each(|i| row.q[*i] *= factor);
    row
}

/// What the pose is if its quaternion was read in the wrong order.
fn reordered(measured: Measurement, order: Order) -> Measurement {
    let Measurement::Pose(pose) = measured else { return measured };
    let q = pose.isometry().rotation;
    let (w, [x, y, z]) = (q.w, [q.i, q.j, q.k]);
    // As they stand in the file, and then as the other order has them.
    let [w, x, y, z] = match order {
        Order::Wxyz => [z, w, x, y],
        Order::Xyzw => [x, y, z, w],
    };
    let column = [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)],
        [2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)],
        [2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)],
    ];
    Measurement::Pose(Pose([column[0], column[1], column[2], pose.position()]))
}

fn transposed(measured: Measurement) -> Measurement {
    let Measurement::Pose(mut pose) = measured else { return measured };
    let position = pose.position();
    pose.0[3] = [0.0; 3];
    let mut back = pose.inverse();
    back.0[3] = position;
    Measurement::Pose(back)
}
