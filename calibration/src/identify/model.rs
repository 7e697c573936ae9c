//! Model of the real machine with unknown errors, and its stations.
//!
//! The chain is `B E_0 · A_1 E_1 … A_n E_n · T M E_T`. `B` is the nominal pose of `F_0` in the
//! frame of the instrument at a station, and `E_0` its unknown error. `E_T` is the unknown error of
//! the tool where whole poses are measured, or a camera sees a board; where points are measured,
//! target j is at `d_j` in the frame of the tool. Stations share one placement on the tool, `M E_T`
//! and `d_j`, or each has its own. [Fixtures](Fixture) stand in `F_0`, before `B E_0`. ε is the sum
//! of known sources, unknown constants, and sources of unknown magnitude.

use std::ops::Range;

use super::{
    Camera, Failure, Fixture, FixtureGeometry, INTRINSICS, KnownDistance, Observable, Result, Uncertainty,
};
use abbe_analysis::sampling;
use abbe_core::{Class, Component, Manipulator, Pose};

/// Prior standard deviation of the tilts of a direction, in rad.
const DIRECTION: f64 = 0.02;

/// Prior standard deviation of stated places, in lengths of the arm and in rad.
const STATED_PLACE: f64 = 0.01;

/// Degrees of freedom of a stated uncertainty: it is trusted to about a factor of 2.
const STATED: f64 = 2.0;

/// A number to be identified.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unknown {
    /// An error of `E_0` at a station, in `F_0`: placement of the machine.
    Base(usize, Component),
    /// A constant generalized error of a frame, numbered from 0.
    Error(usize, Component),
    /// Magnitude of a repeatable source; 1 is its size in the spec.
    Magnitude(usize),
    /// Deviation of coordinate 0, 1 or 2 of a target from its nominal position, in the frame of the
    /// tool. The index is that of [`Model::targets`](super::Model::targets).
    Target(usize, usize),
    /// An error of the tool in a placement, where whole poses are measured.
    Tool(usize, Component),
    /// Deviation of a fixture from its nominal geometry: coordinate 0, 1 or 2 of a point, tilt 0 or
    /// 1 of a direction.
    Fixture(usize, usize),
    /// Deviation of the zero of an observable from its nominal value.
    Zero(usize),
    /// Deviation of an intrinsic parameter of the camera from its nominal value, in the order of
    /// [`Camera::intrinsics`](super::Camera::intrinsics).
    Intrinsic(usize),
}

impl Unknown {
    /// Returns whether it describes the placement of machine, fixtures or targets, or the
    /// instrument, instead of an error of the machine.
    pub fn is_placement(self) -> bool {
        matches!(self, Self::Base(..) | Self::Fixture(..) | Self::Zero(_) | Self::Intrinsic(_))
            || self.is_tool()
    }

    /// Returns whether it is a rotation of the base, of a frame or of the tool.
    pub fn is_rotation(self) -> bool {
        matches!(self, Self::Base(_, component) | Self::Error(_, component) | Self::Tool(_, component)
            if component.is_rotation())
    }

    /// Returns whether it describes the mounting on the tool.
    pub fn is_tool(self) -> bool {
        matches!(self, Self::Target(..) | Self::Tool(..))
    }
}

/// Role of a source in a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// The source is present as in the spec.
    Known,
    /// The magnitude of the source is an unknown.
    Unknown,
    /// The source is omitted.
    Off,
}

/// Length of the machine that represents its size where readings do not depend on the size.
///
/// The residual `r` of a [blind](Observable::is_blind_to_size) reading shrinks with the machine, so
/// that least squares would fit a point. `r / (1 + e/l)` does not, with the nominal length `l` and
/// its error `e`, because both scale alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReferenceLength {
    /// The error of that length.
    pub error: Unknown,
    /// Nominal length, signed; the length unit.
    pub length: f64,
}

/// Pose of `F_0` in the frame of the instrument. It is not an error of the machine.
#[derive(Clone, Debug, PartialEq)]
pub struct Station {
    /// Name; empty for a single station.
    pub name: String,
    /// `B`: transform from `F_0` to the frame of the instrument, before any unknown.
    pub pose: Pose,
    /// The pose is exact: it has no unknowns.
    pub exact: bool,
    /// Index of the placement on the tool: of its targets and of its mounting.
    pub placement: usize,
}

impl Station {
    /// Creates a nameless station with unknown errors.
    pub fn at(pose: Pose) -> Self {
        Self { name: String::new(), pose, exact: false, placement: 0 }
    }
}

/// A manipulator with unknown errors, as seen by an instrument.
#[derive(Clone)]
pub struct Model<'a> {
    /// Nominal manipulator with all its sources.
    pub manipulator: &'a dyn Manipulator,
    /// Stations of the machine, indexed by [`Observation::station`](super::Observation::station).
    pub stations: Vec<Station>,
    /// Positions of the targets in the frame of the tool, one placement after the other; a single
    /// one at zero is the tool point.
    pub targets: Vec<[f64; 3]>,
    /// Fixtures, in the axes of `F_0`.
    pub fixtures: Vec<Fixture>,
    /// Known distances of fixtures from each other, which every fit takes into account.
    pub known_distances: Vec<KnownDistance>,
    /// Observables of the [readings](super::Measurement::Readings) of an observation.
    pub observables: Vec<Observable>,
    /// Camera on the tool, or in the room with a board on the tool; its pixels are the observables.
    pub camera: Option<Camera>,
    /// `M` of each placement, at least one: transform from the measured frame to the frame of the
    /// tool where whole poses are measured, before any unknown. The measured frame is that of the
    /// camera or board on the tool, if there is a camera.
    pub mountings: Vec<Pose>,
    /// Uncertainty of points and poses; observables have their own.
    pub uncertainty: Uncertainty,
    /// Degrees of freedom of the stated uncertainties, which are prior information on σ; 0 if they
    /// were estimated from the data.
    pub stated_freedom: f64,
    /// Unknowns, in order.
    pub unknowns: Vec<Unknown>,
    /// Role of each source of the description; random sources have none.
    pub roles: Vec<Role>,
    /// Structural parameters.
    pub s: Vec<f64>,
    /// Ranges of the joint variables in the data, the travel of slides without limits; or empty.
    pub ranges: Vec<[f64; 2]>,
    /// Length to which residuals of readings that are blind to size are relative, if there are any.
    pub reference_length: Option<ReferenceLength>,
}

impl<'a> Model<'a> {
    /// Creates the ideal chain, equation (2): without sources and unknowns.
    pub fn ideal(manipulator: &'a dyn Manipulator, targets: Vec<[f64; 3]>, uncertainty: Uncertainty) -> Self {
        let description = manipulator.description();
        Self {
            manipulator,
            stations: vec![Station::at(Pose::IDENTITY)],
            targets,
            fixtures: Vec::new(),
            known_distances: Vec::new(),
            observables: Vec::new(),
            camera: None,
            mountings: vec![Pose::IDENTITY],
            uncertainty,
            stated_freedom: STATED,
            unknowns: Vec::new(),
            roles: vec![Role::Off; description.sources.len()],
            s: sampling::nominal_parameters(description),
            ranges: Vec::new(),
            reference_length: None,
        }
    }

    /// Returns the size of the machine in its length unit.
    pub fn arm_length(&self) -> Result<f64> {
        sampling::arm_length_within(self.manipulator, &self.s, &self.ranges).map_err(Failure::Machine)
    }

    /// Returns a copy with these unknowns.
    pub fn with(&self, unknowns: Vec<Unknown>) -> Self {
        let mut roles = self.roles.clone();
        roles.iter_mut().filter(|role| **role == Role::Unknown).for_each(|role| *role = Role::Off);
        for unknown in &unknowns {
            if let Unknown::Magnitude(source) = unknown {
                roles[*source] = Role::Unknown;
            }
        }
        Self { unknowns, roles, ..self.clone() }
    }

    /// Returns the indices of the targets of a placement on the tool; each has the same number.
    pub fn targets_of(&self, placement: usize) -> Range<usize> {
        let count = self.targets.len() / self.mountings.len().max(1);
        placement * count..(placement + 1) * count
    }

    /// Returns these positions of the targets in the frame of the tool without its
    /// [mounting](Self::mountings).
    pub fn mounted(&self, targets: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let placements = self.mountings.iter().enumerate();
        placements
            .flat_map(|(i, mounting)| {
                targets[self.targets_of(i)].iter().map(|target| mounting.apply(*target))
            })
            .collect()
    }

    /// Returns the indices of the targets on the tool at a station.
    pub fn targets_at(&self, station: usize) -> Range<usize> {
        self.targets_of(self.stations[station].placement)
    }

    /// Returns a copy without the sources of known magnitude.
    pub(super) fn without_known_sources(&self) -> Self {
        let off = |role: &Role| if *role == Role::Known { Role::Off } else { *role };
        Self { roles: self.roles.iter().map(off).collect(), ..self.clone() }
    }

    /// Returns the unknowns of stations, fixtures, zeros, tool and camera; `pose` where whole poses
    /// are measured.
    pub fn base_and_tool(&self, pose: bool) -> Vec<Unknown> {
        let unknowns = self.base_unknowns().chain(self.fixture_unknowns()).chain(self.tool_unknowns(pose));
        unknowns.chain(self.intrinsic_unknowns()).collect()
    }

    /// Returns the unknowns of stations, all six errors of each frame, fixtures, zeros, tool and
    /// camera, in this order.
    pub fn constants(&self, pose: bool) -> Vec<Unknown> {
        let frames = 0..self.manipulator.description().frames.len();
        let errors =
            frames.flat_map(|frame| Component::ALL.map(|component| Unknown::Error(frame, component)));
        self.base_unknowns()
            .chain(errors)
            .chain(self.fixture_unknowns())
            .chain(self.tool_unknowns(pose))
            .chain(self.intrinsic_unknowns())
            .collect()
    }

    fn intrinsic_unknowns(&self) -> impl Iterator<Item = Unknown> {
        let camera = self.camera.filter(|camera| !camera.is_known);
        camera.into_iter().flat_map(|_| (0..INTRINSICS).map(Unknown::Intrinsic))
    }

    /// Returns all six errors of each station that is not exact.
    fn base_unknowns(&self) -> impl Iterator<Item = Unknown> {
        let unknown = self.stations.iter().enumerate().filter(|(_, station)| !station.exact);
        unknown.flat_map(|(i, _)| Component::ALL.map(|component| Unknown::Base(i, component)))
    }

    fn fixture_unknowns(&self) -> impl Iterator<Item = Unknown> {
        let places = self.fixtures.iter().enumerate().flat_map(|(i, fixture)| {
            (0..fixture.geometry.unknowns()).map(move |coordinate| Unknown::Fixture(i, coordinate))
        });
        let zeros = self.observables.iter().enumerate().filter(|(_, reading)| !reading.zero_known);
        places.chain(zeros.map(|(i, _)| Unknown::Zero(i)))
    }

    fn tool_unknowns(&self, pose: bool) -> Vec<Unknown> {
        if pose {
            let placements = 0..self.mountings.len();
            return placements.flat_map(|i| Component::ALL.map(|c| Unknown::Tool(i, c))).collect();
        }
        (0..self.targets.len()).flat_map(|j| [0, 1, 2].map(|axis| Unknown::Target(j, axis))).collect()
    }

    /// Returns whether an unknown is an angle, in rad.
    pub fn is_angle(&self, unknown: Unknown) -> bool {
        match unknown {
            Unknown::Fixture(fixture, _) => {
                matches!(self.fixtures[fixture].geometry, FixtureGeometry::Direction(_))
            }
            Unknown::Zero(reading) => self.observables[reading].kind.is_angle,
            unknown => unknown.is_rotation(),
        }
    }

    /// Returns weak priors: errors of frames are some `share` of the length of the arm, rotations
    /// some `share` of a radian.
    ///
    /// They are standard deviations about zero for [`Options::priors`](super::Options::priors).
    /// Places of base and tool are known to a hundredth of the length of the arm and of a radian,
    /// those of fixtures to a tenth of that length, their directions to about one degree, and
    /// intrinsic parameters to what lenses have; zeros and magnitudes have none.
    pub fn priors(&self, share: f64) -> Result<Vec<Option<f64>>> {
        let length = self.arm_length()?;
        let prior = |unknown: &Unknown| match unknown {
            Unknown::Error(_, component) if component.is_rotation() => Some(share),
            Unknown::Error(..) => Some(share * length),
            Unknown::Fixture(fixture, _) => self.direction_uncertainty(*fixture).or(Some(0.1 * length)),
            Unknown::Intrinsic(parameter) => self.camera.map(|camera| camera.expected(*parameter)),
            unknown @ (Unknown::Base(..) | Unknown::Tool(..)) if unknown.is_rotation() => Some(STATED_PLACE),
            Unknown::Base(..) | Unknown::Tool(..) | Unknown::Target(..) => Some(STATED_PLACE * length),
            Unknown::Zero(_) | Unknown::Magnitude(_) => None,
        };
        Ok(self.unknowns.iter().map(prior).collect())
    }

    /// Returns the prior of the tilts of a fixture that is a direction.
    fn direction_uncertainty(&self, fixture: usize) -> Option<f64> {
        matches!(self.fixtures[fixture].geometry, FixtureGeometry::Direction(_)).then_some(DIRECTION)
    }

    /// Returns the indices of the repeatable sources.
    pub fn repeatable(&self) -> Vec<usize> {
        let all = self.manipulator.description().sources.iter().enumerate();
        all.filter(|(_, source)| source.class == Class::Repeatable).map(|(i, _)| i).collect()
    }

    /// Returns the name of the station with a placement; none for the only placement.
    pub fn station_of(&self, placement: usize) -> Option<&str> {
        let mut stations = self.stations.iter().filter(|_| self.mountings.len() > 1);
        stations.find(|station| station.placement == placement).map(|station| &*station.name)
    }

    /// Returns the name of an unknown: `e_x1`; `e_x0` for the base, `e_x0 NAME` at a named station;
    /// `tool_x NAME` if each station has its own placement; a source by its name.
    pub fn name(&self, unknown: Unknown) -> String {
        let at = |placement| self.station_of(placement).map_or(String::new(), |name| format!(" {name}"));
        match unknown {
            Unknown::Base(station, component) => match &self.stations[station].name[..] {
                "" => format!("{}0", component.name()),
                station => format!("{}0 {station}", component.name()),
            },
            Unknown::Error(frame, component) => format!("{}{}", component.name(), frame + 1),
            Unknown::Magnitude(source) => self.manipulator.description().sources[source].name.to_string(),
            Unknown::Target(target, axis) => {
                let axis = ["x", "y", "z"][axis];
                let count = self.targets_of(0).len();
                let at = at(target / count);
                match count {
                    1 => format!("tool_{axis}{at}"),
                    _ => format!("target{}_{axis}{at}", target % count + 1),
                }
            }
            Unknown::Tool(placement, component) => format!("tool_{}{}", component.name(), at(placement)),
            Unknown::Fixture(fixture, coordinate) => {
                let Fixture { name, geometry } = &self.fixtures[fixture];
                let coordinates = match geometry {
                    FixtureGeometry::Point(_) => ["x", "y", "z"],
                    FixtureGeometry::Direction(_) => ["tilt1", "tilt2", ""],
                };
                format!("{name}_{}", coordinates[coordinate])
            }
            Unknown::Zero(reading) => format!("{}_zero", self.observables[reading].name),
            Unknown::Intrinsic(parameter) => {
                let camera = self.observables.first().map_or("camera", |reading| &reading.name);
                format!("{camera}_{}", Camera::NAMES[parameter])
            }
        }
    }
}
