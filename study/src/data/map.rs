//! What the columns of a data file are.

use std::path::PathBuf;
use std::sync::Arc;

use abbe::Pose;
use abbe::analysis::Configuration;
use abbe::identify::{Measurement, Observation, Uncertainty};
use abbe_spec::Spec;

use super::column::{Channel, Column, Scale};
use super::configurations::resolution;
use super::instrument::Instruments;
use super::station::{Placement, Stations};
use super::turn::Turn;
use crate::workspace::has_range;
use crate::{Acceptance, Machine};

/// A target on the end effector.
#[derive(Clone, Debug)]
pub struct Target {
    /// The columns of its coordinates.
    pub columns: [Column; 3],
    /// What makes them coherent.
    pub factor: f64,
    /// Where it is in the frame of the tool, as designed.
    pub position: [f64; 3],
}

/// Where the instrument stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Base {
    /// It sees in `F_0` but for small errors of the base.
    Known,
    /// Anywhere.
    Unknown,
    /// It sees in `F_0` itself: nothing of the base is unknown.
    Exact,
}

/// What was measured; columns of lengths with the factor that makes them coherent.
#[derive(Clone, Debug)]
pub enum Layout {
    /// The tool point.
    Point([Column; 3], f64),
    /// The commanded tool point, and commanded minus actual.
    Difference([Column; 3], [Column; 3], f64),
    /// Targets on the end effector.
    Targets(Vec<Target>),
    /// Position and orientation.
    Pose([Column; 3], f64, Turn),
    /// Instruments that are read one by one.
    Instruments(Box<Instruments>),
}

/// A map, read and checked.
#[derive(Clone, Debug)]
pub struct Map {
    /// What it is called.
    pub title: String,
    /// One standard deviation of the instrument.
    pub uncertainty: Uncertainty,
    /// Where the instrument stands.
    pub base: Base,
    /// Where the machine stands before it.
    pub stations: Stations,
    /// What is mounted on the tool.
    pub placement: Placement,
    /// Limits for rows that nothing is fitted to.
    pub accept: Acceptance,
    /// By variable of the spec.
    pub joints: Vec<Channel>,
    /// By input of the spec.
    pub inputs: Vec<Channel>,
    /// What was measured.
    pub layout: Layout,
    /// The column that says which rows are visits of one configuration; joints and inputs say it otherwise.
    pub group: Option<Column>,
    /// The column of the direction from which a configuration was approached.
    pub direction: Option<Column>,
    /// The column of the time; rows are in its order otherwise.
    pub time: Option<Column>,
    /// By variable and then by input: values that differ by no more are the same; for an input without a range, none.
    pub(super) resolution: Vec<Option<f64>>,
    pub(super) path: String,
    pub(super) text: Arc<str>,
    /// The file it was read from; none if it is shipped.
    pub(crate) files: Vec<PathBuf>,
}

impl Map {
    /// The map of a file whose columns are named as the spec names its variables and inputs: in its coherent units. What has
    /// no column among the inputs is nominal.
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
            uncertainty: Uncertainty { length: 1.0, angle: 1.0 },
            base: Base::Known,
            stations: Stations::default(),
            placement: Placement::default(),
            accept: Acceptance::default(),
            joints: joints.collect(),
            inputs: inputs.collect(),
            layout: Layout::Point([(); 3].map(|()| column("")), 1.0),
            group: None,
            direction: None,
            time: None,
            resolution: resolution(spec),
            path: "the names of the spec".to_owned(),
            text: Arc::from(""),
            files: Vec::new(),
        }
    }

    /// What messages call it: the path of its file.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// The SHA-256 of its text.
    pub fn hash(&self) -> String {
        crate::hash::of_text(&self.text)
    }

    /// Whether whole poses are measured.
    pub fn is_pose(&self) -> bool {
        matches!(self.layout, Layout::Pose(..))
    }

    /// The targets in the frame of the tool: the tool point itself if there are no others.
    pub fn targets(&self) -> Vec<[f64; 3]> {
        match (&self.placement.targets, &self.layout) {
            (Some(targets), _) => targets.clone(),
            (None, Layout::Targets(targets)) => targets.iter().map(|target| target.position).collect(),
            (None, Layout::Instruments(all)) => all.targets.clone(),
            _ => vec![[0.0; 3]],
        }
    }

    /// From the frame that is seen to that of the tool: identity unless poses are measured and it is known.
    pub fn mounting(&self) -> Pose {
        self.placement.mounting.unwrap_or(Pose::IDENTITY)
    }

    /// The names of the stations that it states, or a single one without a name.
    pub fn station_names(&self) -> Vec<String> {
        let names = self.stations.names();
        if names.is_empty() { vec![String::new()] } else { names }
    }

    /// The names of all columns that it names.
    pub fn columns(&self) -> Vec<&str> {
        let beside = [&self.group, &self.direction, &self.time, &self.stations.column];
        let beside = beside.into_iter().flatten().chain(self.setup());
        self.commanded().chain(self.measured()).chain(beside).map(|column| &*column.name).collect()
    }

    /// The same for instruments that stand elsewhere, and look at something else: where, the data are to tell.
    pub fn newly_stationed(self) -> Self {
        let stations = Stations { stated: Vec::new(), ..self.stations };
        let layout = match self.layout {
            Layout::Instruments(all) => {
                Layout::Instruments(Box::new(Instruments { found: Vec::new(), ..*all }))
            }
            other => other,
        };
        let base = if sees_the_base(&layout) { Base::Unknown } else { self.base };
        Self { base, stations, layout, ..self }
    }

    /// The text of its file.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The variables that have a column.
    pub fn moved(&self) -> impl Iterator<Item = usize> {
        let columns = self.joints.iter().enumerate();
        columns.filter(|(_, channel)| matches!(channel, Channel::Column(..))).map(|(i, _)| i)
    }

    /// The inputs that have a column and a range to go through, apart from those that are fixed.
    pub fn moved_inputs(&self, machine: &Machine) -> Vec<usize> {
        let columns = self.inputs.iter().zip(&machine.spec.inputs).enumerate();
        let moved = columns.filter(|(i, (channel, input))| {
            let free = !machine.fixed_inputs().contains(i);
            free && matches!(channel, Channel::Column(..)) && has_range(input)
        });
        moved.map(|(i, _)| i).collect()
    }

    /// An observation that is to be made; what the map holds fixed is so.
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

    /// Rows in their order, each with the one before it if an instrument tells how far a target has moved since.
    pub(crate) fn in_sequence(&self, mut rows: Vec<Observation>) -> Vec<Observation> {
        let Some(all) = self.instruments().filter(|all| all.count_from_before()) else { return rows };
        let mut before: Option<Observation> = None;
        for row in &mut rows {
            row.approach_mut().from = None;
            let from = before.replace(row.clone());
            if let (None, Measurement::Readings(readings)) = (&from, &mut row.measured) {
                *readings = all.at_first(std::mem::take(readings));
            }
            row.approach_mut().from = from.map(Box::new);
        }
        rows
    }

    /// What stands for a measurement before there is one, in a setup if the map has a column for those.
    pub(super) fn unmeasured(&self, setup: Option<f64>) -> Measurement {
        match &self.layout {
            Layout::Pose(..) => Measurement::Pose(Box::new(Pose::IDENTITY)),
            Layout::Instruments(all) => Measurement::Readings(all.unread(&all.read_in(setup))),
            _ => Measurement::Points(vec![Some([0.0; 3]); self.targets().len()].into()),
        }
    }

    /// The instruments that are read one by one, if the map has any.
    pub fn instruments(&self) -> Option<&Instruments> {
        match &self.layout {
            Layout::Instruments(all) => Some(all),
            _ => None,
        }
    }

    /// The column of the setup, if there is one.
    pub(super) fn setup(&self) -> Option<&Column> {
        self.instruments().and_then(|all| all.setup.as_ref())
    }

    /// The columns of joints and inputs.
    pub(super) fn commanded(&self) -> impl Iterator<Item = &Column> {
        self.joints.iter().chain(&self.inputs).filter_map(|channel| match channel {
            Channel::Column(column, _) => Some(column),
            Channel::Fixed(_) | Channel::FromRows(_) => None,
        })
    }

    /// The columns of what was measured.
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

/// Whether where `F_0` stands can be seen.
fn sees_the_base(layout: &Layout) -> bool {
    match layout {
        Layout::Instruments(all) => all.see_the_base(),
        _ => true,
    }
}
