//! Maps: the meaning of the columns of a data file.

use std::{path::PathBuf, sync::Arc};

use abbe::Pose;
use abbe::analysis::Configuration;
use abbe::identify::{Measurement, Observation, Uncertainty};
use abbe_spec::Spec;

use super::command_pose::CommandPose;
use super::configurations::resolution;
use super::{Channel, Column, Instruments, Placement, Scale, Sight, Stations, TargetFrame, Turn};
use crate::Acceptance;
use abbe_study::{Machine, Result, RunRecord, mistake, number::short, workspace::has_range};

/// A target on the end effector.
#[derive(Clone, Debug)]
pub struct Target {
    /// Columns of its coordinates.
    pub columns: [Column; 3],
    /// Factor of its coordinates to coherent units.
    pub factor: f64,
    /// Nominal position in the frame of the tool; none if it is to be found from the data.
    pub position: Option<[f64; 3]>,
}

/// Knowledge of the pose of `F_0` in the frame of the instrument.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Base {
    /// The instrument measures in `F_0`, up to small errors of the base.
    Known,
    /// Any pose.
    Unknown,
    /// The instrument measures in `F_0`: the base has no unknowns.
    Exact,
}

/// Measured quantity, with the factors of its columns to coherent units.
#[derive(Clone, Debug)]
pub enum Layout {
    /// The tool point.
    Point([Column; 3], f64),
    /// The commanded tool point, and commanded minus actual.
    Difference([Column; 3], [Column; 3], f64),
    /// Targets on the end effector.
    Targets(Vec<Target>),
    /// Position and orientation of the tool.
    Pose([Column; 3], f64, Turn),
    /// Readings of several instruments.
    Instruments(Box<Instruments>),
}

impl Layout {
    /// Returns whether whole poses are measured, by a camera or as such.
    pub(super) fn is_pose(&self) -> bool {
        match self {
            Self::Pose(..) => true,
            Self::Instruments(all) => all.camera.is_some(),
            _ => false,
        }
    }
}

/// A map, read and checked.
#[derive(Clone, Debug)]
pub struct Map {
    /// Title.
    pub title: String,
    /// Names of the columns of a file without a heading; empty if it has one.
    pub(super) given_columns: Vec<String>,
    /// Standard deviations of the instrument.
    pub uncertainty: Uncertainty,
    /// The standard deviation of positions, and of rotations, is estimated from the data;
    /// `uncertainty` is then an initial value.
    pub is_estimated: [bool; 2],
    /// Knowledge of the pose of the base.
    pub base: Base,
    /// Stations of the machine.
    pub stations: Stations,
    /// Frame in which the map states the positions of targets.
    pub target_frame: TargetFrame,
    /// Mounting of the targets on the tool.
    pub placement: Placement,
    /// Rows hold corrected commands: their poses are those that the machine should then have.
    pub is_corrected: bool,
    /// Limits for rows that were not used in a fit.
    pub accept: Acceptance,
    /// Line of sight to the targets that are planned or simulated.
    pub sight: Option<Sight>,
    /// Date, operator, machine and instrument as stated for the page.
    pub record: RunRecord,
    /// Indicates that the stated stations and fixtures are ignored.
    pub is_newly_stationed: bool,
    /// Channel of each variable of the spec.
    pub joints: Vec<Channel>,
    /// Pose of the tool from which the joints follow, in place of their columns.
    pub(crate) command_pose: Option<CommandPose>,
    /// Channel of each input of the spec.
    pub inputs: Vec<Channel>,
    /// Measured quantity.
    pub layout: Layout,
    /// Column that identifies visits of one configuration; otherwise joints and inputs do.
    pub group: Option<Column>,
    /// Column of the direction of approach.
    pub direction: Option<Column>,
    /// Column of the time; otherwise the rows are in order of time.
    pub time: Option<Column>,
    /// Resolution of each variable and then of each input; none for an input without a range.
    pub(super) resolution: Vec<Option<f64>>,
    pub(super) path: String,
    pub(super) text: Arc<str>,
    /// The files that it was read from; empty for a shipped map.
    pub(crate) files: Vec<PathBuf>,
}

impl Map {
    /// Reads the limits given to `option`; without any, returns those of the map.
    pub fn limits(&self, option: &str, text: Option<&str>, spec: &Spec) -> Result<Acceptance> {
        text.map_or_else(|| Ok(self.accept.clone()), |text| Acceptance::read(option, text, spec.length))
    }

    /// Creates the map of a file whose columns have the names of variables and inputs of the spec,
    /// in coherent units. Inputs without a column are nominal.
    pub fn from_names(header: &[String], spec: &Spec) -> Self {
        let column = |name: &str| Column { name: name.to_owned(), span: None };
        let joints =
            spec.variables.iter().map(|variable| Channel::Column(column(&variable.name), Scale::COHERENT));
        let inputs = spec.inputs.iter().map(|input| match header.contains(&input.name) {
            true => Channel::Column(column(&input.name), Scale::COHERENT),
            false => Channel::Fixed(input.value),
        });
        Self {
            title: String::new(),
            given_columns: Vec::new(),
            uncertainty: Uncertainty { length: 1.0, angle: 1.0 },
            is_estimated: [false; 2],
            base: Base::Known,
            stations: Stations::default(),
            target_frame: TargetFrame::default(),
            placement: Placement::default(),
            is_corrected: false,
            accept: Acceptance::default(),
            sight: None,
            record: RunRecord::default(),
            is_newly_stationed: false,
            joints: joints.collect(),
            command_pose: None,
            inputs: inputs.collect(),
            layout: Layout::Point(*Column::unnamed(), 1.0),
            group: None,
            direction: None,
            time: None,
            resolution: resolution(spec),
            path: "the names of the spec".to_owned(),
            text: Arc::from(""),
            files: Vec::new(),
        }
    }

    /// Returns the path of its file, for messages.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// Returns the SHA-256 of its text.
    pub fn hash(&self) -> String {
        abbe_study::hash::text(&self.text)
    }

    /// Returns whether whole poses are measured, by a camera or as such.
    pub fn is_pose(&self) -> bool {
        self.layout.is_pose()
    }

    /// Returns the positions of the targets in the frame of the tool, unless each station has its
    /// own; the tool point if there are no others.
    pub fn targets(&self) -> Vec<[f64; 3]> {
        self.targets_at("")
    }

    /// Returns the positions of the targets at a station in the frame of the tool.
    pub(crate) fn targets_at(&self, station: &str) -> Vec<[f64; 3]> {
        let stated = self.placement.at(station).and_then(|placement| placement.targets.as_ref());
        match (stated, &self.layout) {
            (Some(targets), _) => targets.clone(),
            (None, Layout::Targets(targets)) => {
                targets.iter().map(|target| target.position.unwrap_or_default()).collect()
            }
            (None, Layout::Instruments(all)) => {
                all.targets.iter().map(|target| target.unwrap_or_default()).collect()
            }
            _ => vec![[0.0; 3]],
        }
    }

    /// Returns a warning if parameters of the tool are set and targets in its frame move along,
    /// unless the map says that they do.
    pub(crate) fn carried_targets(&self, machine: &Machine) -> Option<String> {
        let set = machine.set_tool_parameters();
        let has_targets = match &self.layout {
            Layout::Targets(_) => true,
            Layout::Instruments(all) => all.targets.iter().any(|target| *target != Some([0.0; 3])),
            _ => false,
        };
        (has_targets && !set.is_empty() && !self.target_frame.is_stated).then(|| {
            format!(
                "setting {} moves the targets with the tool, because the map states their positions in its \
                 frame: if they stay where they are on the machine, state them in the last frame before the \
                 tool and write `target_frame = \"flange\"` in [data]; if they move, `target_frame = \"tool\"`",
                set.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", "),
            )
        })
    }

    /// Returns for each target whether its position at a station is to be found from the data.
    pub(crate) fn unknown_targets_at(&self, station: &str) -> Vec<bool> {
        match &self.layout {
            _ if self.placement.at(station).is_some() => vec![false; self.targets_at(station).len()],
            Layout::Targets(targets) => targets.iter().map(|target| target.position.is_none()).collect(),
            Layout::Instruments(all) => all.targets.iter().map(Option::is_none).collect(),
            _ => vec![false],
        }
    }

    /// Returns the transform from the measured frame to the frame of the tool at a station;
    /// identity unless poses are measured and it is known.
    pub(crate) fn mounting_at(&self, station: &str) -> Pose {
        self.stated_mounting(station).unwrap_or(Pose::IDENTITY)
    }

    /// Returns the transform from the measured frame to the frame of the tool at a station, if it
    /// is stated.
    pub(crate) fn stated_mounting(&self, station: &str) -> Option<Pose> {
        self.placement.at(station).and_then(|placement| placement.mounting)
    }

    /// Returns whether it states the pose of the base and of the measured frame on the tool, or
    /// that they are as designed.
    pub(crate) fn is_placed(&self) -> bool {
        let is_base_placed = self.base != Base::Unknown || !self.stations.stated.is_empty();
        is_base_placed && (self.placement.exact || self.stated_mounting("").is_some())
    }

    /// Returns the uncertainty of its instrument with its unit: pixels of a camera, otherwise a
    /// length in `unit`, of which the length unit has `factor`.
    pub fn noise(&self, factor: f64, unit: &str) -> String {
        let camera = self.instruments().filter(|all| all.camera.is_some());
        match camera.and_then(|all| all.observables.first()) {
            Some(pixel) => format!("{} px", short(pixel.uncertainty)),
            None => format!("{} {unit}", short(factor * self.uncertainty.length)),
        }
    }

    /// Returns the names of the stated stations, or a single empty one.
    pub fn station_names(&self) -> Vec<String> {
        let names = self.stations.names();
        if names.is_empty() { vec![String::new()] } else { names }
    }

    /// Returns the names of all columns of the map.
    pub fn columns(&self) -> Vec<&str> {
        let beside = [&self.group, &self.direction, &self.time, &self.stations.column];
        let beside = beside.into_iter().flatten().chain(self.setup());
        self.commanded().chain(self.measured()).chain(beside).map(|column| &*column.name).collect()
    }

    /// Returns the map for instruments at new, unknown stations, with new fixtures.
    pub fn newly_stationed(self) -> Self {
        let stations = Stations { stated: Vec::new(), ..self.stations };
        let layout = match self.layout {
            Layout::Instruments(all) => {
                Layout::Instruments(Box::new(Instruments { found: Vec::new(), ..*all }))
            }
            other => other,
        };
        let base = if sees_the_base(&layout) { Base::Unknown } else { self.base };
        Self { base, stations, layout, is_newly_stationed: true, ..self }
    }

    /// Returns the part of the measurements whose uncertainty the map does not state, if there is
    /// one.
    fn without_uncertainty(&self) -> Option<String> {
        let [length, angle] = self.is_estimated;
        let unknown =
            self.instruments().and_then(|all| all.list.iter().find(|one| one.uncertainty.is_none()));
        match unknown {
            Some(instrument) => Some(format!("the instrument `{}`", instrument.name.escape_debug())),
            None if length => Some("positions".to_owned()),
            None => angle.then(|| "rotations".to_owned()),
        }
    }

    /// Returns whether the map states the uncertainty of all measurements.
    pub(crate) fn states_uncertainty(&self) -> bool {
        self.without_uncertainty().is_none()
    }

    /// Returns an error if the map states no uncertainty for a part of the measurements, which
    /// `task` needs.
    pub(crate) fn require_uncertainty(&self, task: &str) -> Result<()> {
        let Some(part) = self.without_uncertainty() else { return Ok(()) };
        let message = format!("{task} needs the uncertainty of {part}, which this map calls unknown");
        let help = "state it as the data sheet of the instrument does, or use the map that `abbe identify` \
             writes: it has the estimate";
        Err(mistake::with_help(&self.path, message, help))
    }

    /// Returns an error if rows have poses in place of the joints, which `task` needs.
    pub(crate) fn require_joints(&self, task: &str) -> Result<()> {
        if self.command_pose.is_none() {
            return Ok(());
        }
        let message = format!("{task} needs joints, and this map has `[command_pose]` in place of them");
        Err(mistake::with_help(&self.path, message, "name columns for the joints in `[joints]`"))
    }

    /// Returns the text of its file.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Returns the indices of the variables with a column.
    pub fn moved(&self) -> impl Iterator<Item = usize> {
        let columns = self.joints.iter().enumerate();
        columns.filter(|(_, channel)| matches!(channel, Channel::Column(..))).map(|(i, _)| i)
    }

    /// Returns the indices of the inputs with a column and a range, without fixed ones.
    pub fn moved_inputs(&self, machine: &Machine) -> Vec<usize> {
        let columns = self.inputs.iter().zip(&machine.spec.inputs).enumerate();
        let moved = columns.filter(|(i, (channel, input))| {
            let free = !machine.fixed_inputs().contains(i);
            free && matches!(channel, Channel::Column(..)) && has_range(input)
        });
        moved.map(|(i, _)| i).collect()
    }

    /// Creates an observation to be measured, with the constants of the map.
    pub fn planned(&self, line: u64, place: Configuration) -> Observation {
        let Configuration { mut q, mut u, .. } = place;
        let values = q.iter_mut().chain(&mut u);
        for (value, channel) in values.zip(self.joints.iter().chain(&self.inputs)) {
            if let Channel::Fixed(fixed) = channel {
                *value = *fixed;
            }
        }
        Observation::new(line, q, u, self.unmeasured(None))
    }

    /// Links each row to the previous one, if an instrument refers to it: the instruments of
    /// another setup begin anew.
    pub(crate) fn in_sequence(&self, mut rows: Vec<Observation>) -> Vec<Observation> {
        let Some(all) = self.instruments().filter(|all| all.depend_on_previous_row()) else { return rows };
        let mut before: Option<Observation> = None;
        for row in &mut rows {
            row.approach_mut().from = None;
            let setup = |row: &Observation| match &row.measured {
                Measurement::Readings(readings) => all.setup_of(readings),
                _ => None,
            };
            let from = before.replace(row.clone());
            let is_same = from.as_ref().is_some_and(|from| setup(from) == setup(row));
            if let (false, Measurement::Readings(readings)) = (is_same, &mut row.measured) {
                *readings = all.at_first(std::mem::take(readings), from.is_some());
            }
            row.approach_mut().from = from.map(Box::new);
        }
        rows
    }

    /// Returns the placeholder of a measurement, in a setup if the map has a column for it.
    pub(crate) fn unmeasured(&self, setup: Option<f64>) -> Measurement {
        match &self.layout {
            Layout::Pose(..) => Measurement::Pose(Box::new(Pose::IDENTITY)),
            Layout::Instruments(all) => Measurement::Readings(all.unread(&all.read_in(setup))),
            _ => Measurement::Points(vec![Some([0.0; 3]); self.targets().len()].into()),
        }
    }

    /// Returns the instruments that are read one number at a time, if the map has any.
    pub fn instruments(&self) -> Option<&Instruments> {
        match &self.layout {
            Layout::Instruments(all) => Some(all),
            _ => None,
        }
    }

    /// Returns the column of the setup, if there is one.
    pub(super) fn setup(&self) -> Option<&Column> {
        self.instruments().and_then(|all| all.setup.as_ref())
    }

    /// Returns the columns of joints, or of the pose in place of them, and inputs.
    pub(super) fn commanded(&self) -> impl Iterator<Item = &Column> {
        let poses = self.command_pose.iter().flat_map(CommandPose::columns);
        let channels = self.joints.iter().chain(&self.inputs).filter_map(|channel| match channel {
            Channel::Column(column, _) => Some(column),
            Channel::Fixed(_) | Channel::FromRows(_) => None,
        });
        poses.chain(channels)
    }

    /// Returns the columns of the measurement.
    pub(super) fn measured(&self) -> Vec<&Column> {
        match &self.layout {
            Layout::Point(columns, _) => columns.iter().collect(),
            Layout::Difference(target, difference, _) => target.iter().chain(difference).collect(),
            Layout::Targets(targets) => targets.iter().flat_map(|target| &target.columns).collect(),
            Layout::Pose(position, _, turn) => position.iter().chain(turn.columns()).collect(),
            Layout::Instruments(all) => all.columns(),
        }
    }
}

/// Returns whether the measurement depends on the pose of `F_0`.
fn sees_the_base(layout: &Layout) -> bool {
    match layout {
        Layout::Instruments(all) => all.see_the_base(),
        _ => true,
    }
}
