//! The real machine with unknown errors: residuals of measurements, and their exact derivatives.
//!
//! `B E_0 · A_1 E_1 … A_n E_n · T M E_T`: `B` is where `F_0` stands as the instrument sees it from a station, `E_0` what is unknown of
//! that, `E_T` what is unknown of the tool where whole poses are measured; where points are, a target is at `d_j` in
//! the frame of the tool. [Fixtures](Fixture) stand in `F_0`, before `B E_0`. ε is the sum of the sources that are known, of the unknown constants, and of the sources
//! whose magnitude is unknown.

use super::{Failure, Fixture, Place, Reading, Role, Station, Uncertainty, Unknown};
use abbe_analysis::sampling;
use abbe_core::{Class, Component, Manipulator, Pose};

/// How well the direction of a fixture is known before, one standard deviation of a tilt: rad.
const DIRECTION: f64 = 0.02;

/// A manipulator with unknown errors, seen by an instrument.
#[derive(Clone)]
pub struct Model<'a> {
    /// The nominal manipulator, with all its sources.
    pub manipulator: &'a dyn Manipulator,
    /// Where the machine stands: one station for each that observations name.
    pub stations: Vec<Station>,
    /// The targets in the frame of the tool; a single one at zero is the tool point itself.
    pub targets: Vec<[f64; 3]>,
    /// What stands still, seen in `F_0`.
    pub fixtures: Vec<Fixture>,
    /// What the numbers of an observation are that has [readings](super::Measurement::Readings).
    pub readings: Vec<Reading>,
    /// `M`: where whole poses are measured, from the frame that is seen to that of the tool, before any unknown.
    pub mounting: Pose,
    /// What the instrument's numbers are worth; readings have their own.
    pub uncertainty: Uncertainty,
    /// The unknowns, in order.
    pub unknowns: Vec<Unknown>,
    /// The part of every source of the description; random ones have none.
    pub roles: Vec<Role>,
    /// The structural parameters.
    pub s: Vec<f64>,
}

impl<'a> Model<'a> {
    /// Nothing unknown: the ideal chain, equation (2), without any source.
    pub fn ideal(manipulator: &'a dyn Manipulator, targets: Vec<[f64; 3]>, uncertainty: Uncertainty) -> Self {
        let description = manipulator.description();
        Self {
            manipulator,
            stations: vec![Station::at(Pose::IDENTITY)],
            targets,
            fixtures: Vec::new(),
            readings: Vec::new(),
            mounting: Pose::IDENTITY,
            uncertainty,
            unknowns: Vec::new(),
            roles: vec![Role::Off; description.sources.len()],
            s: sampling::nominal_parameters(description),
        }
    }

    /// The same with these unknowns.
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

    /// The same without those sources that are there as the spec has them.
    pub(super) fn without_known_sources(&self) -> Self {
        let off = |role: &Role| if *role == Role::Known { Role::Off } else { *role };
        Self { roles: self.roles.iter().map(off).collect(), ..self.clone() }
    }

    /// The unknowns of stations, fixtures, zeros and tool alone; `pose` where whole poses are measured.
    pub fn base_and_tool(&self, pose: bool) -> Vec<Unknown> {
        self.base_unknowns().chain(self.fixture_unknowns()).chain(self.tool_unknowns(pose)).collect()
    }

    /// The stations, all six errors of every frame, fixtures and zeros, and the tool, in this order.
    pub fn constants(&self, pose: bool) -> Vec<Unknown> {
        let frames = 0..self.manipulator.description().frames.len();
        let errors =
            frames.flat_map(|frame| Component::ALL.map(|component| Unknown::Error(frame, component)));
        self.base_unknowns()
            .chain(errors)
            .chain(self.fixture_unknowns())
            .chain(self.tool_unknowns(pose))
            .collect()
    }

    /// All six of every station that is not exact.
    fn base_unknowns(&self) -> impl Iterator<Item = Unknown> {
        let unknown = self.stations.iter().enumerate().filter(|(_, station)| !station.exact);
        unknown.flat_map(|(i, _)| Component::ALL.map(|component| Unknown::Base(i, component)))
    }

    fn fixture_unknowns(&self) -> impl Iterator<Item = Unknown> {
        let places = self.fixtures.iter().enumerate();
        let places = places.flat_map(|(i, fixture)| {
            (0..fixture.place.unknowns()).map(move |coordinate| Unknown::Fixture(i, coordinate))
        });
        let zeros = self.readings.iter().enumerate().filter(|(_, reading)| !reading.zero_known);
        places.chain(zeros.map(|(i, _)| Unknown::Zero(i)))
    }

    fn tool_unknowns(&self, pose: bool) -> Vec<Unknown> {
        if pose {
            return Component::ALL.map(Unknown::Tool).to_vec();
        }
        (0..self.targets.len()).flat_map(|j| [0, 1, 2].map(|axis| Unknown::Target(j, axis))).collect()
    }

    /// What is known of any machine: its errors are some `share` of its size, turns some `share` of a radian.
    ///
    /// As standard deviations about zero for [`Options::priors`](super::Options::priors); none for base, tool and
    /// magnitudes, which may be anything. Directions of fixtures are about where they are stated, to one degree. What data
    /// tell weighs far more; this holds what they hardly tell.
    pub fn priors(&self, share: f64) -> Result<Vec<Option<f64>>, Failure> {
        let length = sampling::arm_length(self.manipulator, &self.s).map_err(Failure::Machine)?;
        let prior = |unknown: &Unknown| match unknown {
            Unknown::Error(_, component) if component.is_rotation() => Some(share),
            Unknown::Error(..) => Some(share * length),
            Unknown::Fixture(fixture, _) => self.direction_uncertainty(*fixture),
            _ => None,
        };
        Ok(self.unknowns.iter().map(prior).collect())
    }

    /// What is expected of the unknowns before anything is measured, by index: against this it is held what data tell.
    ///
    /// A prior where there is one. Where there is none, an error of the machine may be as large as the machine, and what is
    /// told of base and tool to no better than a hundredth of it is not worth having. Magnitudes may be anything.
    pub fn expected(&self, priors: &[Option<f64>]) -> Result<Vec<Option<f64>>, Failure> {
        let length = sampling::arm_length(self.manipulator, &self.s).map_err(Failure::Machine)?;
        let expected = |(k, unknown): (usize, &Unknown)| {
            let of = |share: f64, rotation: bool| Some(if rotation { share } else { share * length });
            priors.get(k).copied().flatten().or(match unknown {
                Unknown::Error(_, component) => of(1.0, component.is_rotation()),
                Unknown::Base(_, component) | Unknown::Tool(component) => of(0.01, component.is_rotation()),
                Unknown::Target(..) => of(0.01, false),
                Unknown::Fixture(fixture, _) => self.direction_uncertainty(*fixture),
                Unknown::Magnitude(_) | Unknown::Zero(_) => None,
            })
        };
        Ok(self.unknowns.iter().enumerate().map(expected).collect())
    }

    /// What is expected of the tilts of a fixture that is a direction.
    fn direction_uncertainty(&self, fixture: usize) -> Option<f64> {
        matches!(self.fixtures[fixture].place, Place::Direction(_)).then_some(DIRECTION)
    }

    /// Repeatable sources of the manipulator.
    pub fn repeatable(&self) -> Vec<usize> {
        let description = self.manipulator.description();
        let all = description.sources.iter().enumerate();
        all.filter(|(_, source)| source.class == Class::Repeatable).map(|(i, _)| i).collect()
    }

    /// What an unknown is called: `e_x1`, of the base `e_x0`, of a named station `e_x0 NAME`, a source by its name.
    pub fn name(&self, unknown: Unknown) -> String {
        match unknown {
            Unknown::Base(station, component) => match &self.stations[station].name[..] {
                "" => format!("{}0", component.name()),
                station => format!("{}0 {station}", component.name()),
            },
            Unknown::Error(frame, component) => format!("{}{}", component.name(), frame + 1),
            Unknown::Magnitude(source) => self.manipulator.description().sources[source].name.to_string(),
            Unknown::Target(target, axis) => {
                let axis = ["x", "y", "z"][axis];
                if self.targets.len() == 1 {
                    format!("tool_{axis}")
                } else {
                    format!("target{}_{axis}", target + 1)
                }
            }
            Unknown::Tool(component) => format!("tool_{}", component.name()),
            Unknown::Fixture(fixture, coordinate) => {
                let Fixture { name, place } = &self.fixtures[fixture];
                let coordinates = match place {
                    Place::Point(_) => ["x", "y", "z"],
                    Place::Direction(_) => ["tilt1", "tilt2", ""],
                };
                format!("{name}_{}", coordinates[coordinate])
            }
            Unknown::Zero(reading) => format!("{}_zero", self.readings[reading].name),
        }
    }
}
