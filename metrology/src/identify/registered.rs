//! Placements in closed form: the rigid motion of a station, and that of the tool, that explains
//! the data best given the other.

use abbe::Pose;
use abbe::identify::{
    Failure, Measurement, Model, Observable, Observation, Unknown, register, register_pairs,
};

/// Largest number of alternating registrations of stations and tool.
const ROUNDS: usize = 50;

/// Places that may be changed to explain the data.
#[derive(Clone, Debug, Default)]
pub(super) struct OpenPlaces {
    /// Stations, by their index.
    pub(super) stations: Vec<bool>,
    /// Targets of the model, by their index.
    pub(super) targets: Vec<bool>,
    /// Mountings of the model, by their index.
    pub(super) mountings: Vec<bool>,
}

impl OpenPlaces {
    /// Returns whether an unknown belongs to one of these places.
    pub(super) fn has(&self, unknown: Unknown) -> bool {
        let (places, i) = match unknown {
            Unknown::Base(station, _) => (&self.stations, station),
            Unknown::Target(target, _) => (&self.targets, target),
            Unknown::Tool(placement, _) => (&self.mountings, placement),
            _ => return false,
        };
        places.get(i) == Some(&true)
    }
}

/// Registers open stations and open places on the tool in turn, until `is_near`.
pub(super) fn register_in_turn(
    model: &mut Model,
    rows: &[Observation],
    arm: f64,
    open: &OpenPlaces,
    is_near: impl Fn(&Model) -> Result<bool, Failure>,
) -> Result<(), Failure> {
    let corners = [[0.0; 3], [arm, 0.0, 0.0], [0.0, arm, 0.0], [0.0, 0.0, arm]];
    for _ in 0..ROUNDS {
        for i in (0..model.stations.len()).filter(|i| open.stations[*i]) {
            if let Some(pose) = registered(model, rows, i)? {
                model.stations[i].pose = pose;
            }
        }
        register_tool(model, rows, corners, open)?;
        if is_near(model)? {
            break;
        }
    }
    Ok(())
}

/// Registers the placements on the tool that are open: targets at their mean position, or the pose
/// of the measured frame. `corners` represent a pose.
fn register_tool(
    model: &mut Model,
    rows: &[Observation],
    corners: [[f64; 3]; 4],
    open: &OpenPlaces,
) -> Result<(), Failure> {
    let bare = Model { mountings: vec![Pose::IDENTITY; model.mountings.len()], ..model.clone() };
    let mut bare = bare.at(&[]);
    let mut frames = vec![(Vec::new(), Vec::new()); model.mountings.len()];
    let mut sums = vec![([0.0; 3], 0.0); model.targets.len()];
    for row in rows {
        let back = bare.pose(row)?.inverse();
        let own = model.targets_at(row.station as usize);
        for ((sum, count), point) in sums[own].iter_mut().zip(points(model, row)) {
            let Some(point) = point else { continue };
            let place = back.apply(point);
            *sum = std::array::from_fn(|i| sum[i] + place[i]);
            *count += 1.0;
        }
        if let Measurement::Pose(pose) = &row.measured {
            let seen = back.then(pose);
            let (from, to) = &mut frames[model.stations[row.station as usize].placement];
            from.extend(corners);
            to.extend(corners.map(|corner| seen.apply(corner)));
        }
    }
    let targets = model.targets.iter_mut().zip(sums).zip(&open.targets);
    for ((target, (sum, count)), _) in targets.filter(|((_, (_, count)), open)| **open && *count > 0.0) {
        *target = sum.map(|v| v / count);
    }
    for ((mounting, (from, to)), _) in
        model.mountings.iter_mut().zip(frames).zip(&open.mountings).filter(|(_, open)| **open)
    {
        if let Some(found) = register(&from, &to) {
            *mounting = found.pose;
        }
    }
    Ok(())
}

/// Registers a station: returns the pose of `F_0` in the frame of the instrument that maps the
/// predicted points onto all points measured there. None if the points are collinear.
pub(super) fn registered(
    model: &Model,
    data: &[Observation],
    station: usize,
) -> Result<Option<Pose>, Failure> {
    let mut model = model.clone();
    model.stations[station].pose = Pose::IDENTITY;
    let mut at = model.at(&vec![0.0; model.unknowns.len()]);
    let first = model.targets_at(station).start;
    let rows = data.iter().filter(|row| row.station as usize == station);
    // The measured points stay in the rows; only the predicted ones are stored.
    let mut from = Vec::new();
    for observation in rows.clone() {
        let pose = at.pose(observation)?;
        let place = |target: Option<usize>| {
            target.map_or_else(|| pose.position(), |target| pose.apply(model.targets[first + target]))
        };
        for_each_point(&model, observation, |target, _| from.push(place(target)));
    }
    let to = rows.flat_map(|observation| {
        let mut to = Vec::new();
        for_each_point(&model, observation, |_, point| to.push(point));
        to
    });
    Ok(register_pairs(from.iter().copied().zip(to))
        .filter(|found| found.breadth > 1e-6)
        .map(|found| found.pose))
}

/// Calls `take` with every measured point and its target; the target is none for the position of a
/// pose.
pub(super) fn for_each_point(
    model: &Model,
    observation: &Observation,
    mut take: impl FnMut(Option<usize>, [f64; 3]),
) {
    if let Measurement::Pose(measured) = &observation.measured {
        take(None, measured.position());
    }
    for (target, point) in points(model, observation).into_iter().enumerate().take(model.targets.len()) {
        if let Some(point) = point {
            take(Some(target), point);
        }
    }
}

/// Returns the measured point of every target, in the frame of the instrument; none for targets
/// that were not measured.
fn points(model: &Model, observation: &Observation) -> Vec<Option<[f64; 3]>> {
    match &observation.measured {
        Measurement::Points(points) => points.to_vec(),
        Measurement::Pose(_) => Vec::new(),
        Measurement::Readings(values) => {
            let coordinate = |j: usize, k: usize| {
                let is_it = |o: &Observable| o.kind.sees_base && (o.targets[0], o.axis) == (j, k);
                let mut own =
                    model.observables.iter().zip(values).filter(|(observable, _)| is_it(observable));
                own.find_map(|(_, value)| *value)
            };
            let point = |j: usize| Some([coordinate(j, 0)?, coordinate(j, 1)?, coordinate(j, 2)?]);
            (0..model.targets.len()).map(point).collect()
        }
    }
}
