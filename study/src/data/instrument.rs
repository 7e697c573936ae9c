//! Instruments that are read one by one, several of them in one file.

use abbe::identify::{Fixture, Gauge, Place, Reading};

use super::column::Column;

/// What kind of instrument it is, and what it looks at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The coordinates of a target, in the instrument's frame.
    Point,
    /// How far a target is from a point: a ballbar, a wire.
    Distance,
    /// A target is held at a point: nothing is read.
    Contact,
    /// A target touches a plane: nothing is read.
    Plane,
    /// A target touches a sphere: nothing is read.
    Sphere,
    /// How far a target is along a direction: a dial indicator with a flat tip.
    Indicator,
    /// How far two targets are apart.
    Between,
    /// How far a target has moved since the row before: a laser interferometer, a scale.
    Displacement,
    /// By how much a mirror on the tool leans towards a direction: an autocollimator.
    Angle,
}

/// What is said of a row in which no instrument was read.
pub(super) const NOTHING_READ: &str = "nothing was read";

/// One instrument of a map.
#[derive(Clone, Debug)]
pub struct Instrument {
    /// What it is called.
    pub name: String,
    /// What it is.
    pub kind: Kind,
    /// The columns of its numbers: none if it is touched.
    pub columns: Vec<Column>,
    /// What makes them coherent.
    pub factor: f64,
    /// The unit of its numbers, as the map has it; that of lengths if it is touched.
    pub unit: String,
    /// In which rows it is read: those with this number in the map's column `setup`; all if there is none.
    pub setup: Option<f64>,
    /// Between which readings it can be used: the length unit or rad.
    pub range: Option<[f64; 2]>,
    /// One standard deviation: none if the data are to tell it.
    pub uncertainty: Option<f64>,
    /// About where it looks, in `F_0`.
    pub at: Option<[f64; 3]>,
    /// Its readings, by index.
    pub readings: std::ops::Range<usize>,
}

/// All instruments of a map, and what they look at.
#[derive(Clone, Debug, Default)]
pub struct Instruments {
    /// One by one.
    pub list: Vec<Instrument>,
    /// Targets in the frame of the tool, about there.
    pub targets: Vec<[f64; 3]>,
    /// What stands still, in `F_0`.
    pub fixtures: Vec<Fixture>,
    /// All their readings.
    pub readings: Vec<Reading>,
    /// Those whose place and zero were found, by index: what they look at is where it is said to be.
    pub found: Vec<usize>,
    /// The column that says in which setup a row was measured.
    pub setup: Option<Column>,
}

/// What an instrument looks at, and how good it is.
pub(super) struct Look {
    /// Its targets, by index.
    pub(super) targets: Vec<usize>,
    /// A point in `F_0`, the length unit.
    pub(super) at: [f64; 3],
    /// A direction in `F_0`.
    pub(super) direction: [f64; 3],
    /// The normal of a mirror, in the frame of the tool.
    pub(super) mirror: [f64; 3],
    /// What the instrument adds, or about what.
    pub(super) zero: f64,
    /// Whether that is known.
    pub(super) zero_known: bool,
    /// One standard deviation, or what stands for one that is unknown.
    pub(super) uncertainty: f64,
}

impl Kind {
    /// Whether the machine is moved until it touches: nothing but its joints is read.
    pub fn is_touched(self) -> bool {
        matches!(self, Self::Contact | Self::Plane | Self::Sphere)
    }

    /// How many columns it has.
    pub fn columns(self) -> usize {
        match self {
            Self::Point => 3,
            _ if self.is_touched() => 0,
            _ => 1,
        }
    }
}

impl Instruments {
    /// Adds the fixture and the readings of an instrument, and says which readings those are.
    pub(super) fn add(&mut self, name: &str, kind: Kind, look: &Look) -> std::ops::Range<usize> {
        let fixture = self.fixtures.len();
        let place = match kind {
            Kind::Distance | Kind::Contact | Kind::Sphere => Some(Place::Point(look.at)),
            Kind::Plane | Kind::Indicator | Kind::Angle => Some(Place::Direction(look.direction)),
            Kind::Point | Kind::Between | Kind::Displacement => None,
        };
        self.fixtures.extend(place.map(|place| Fixture { name: name.to_owned(), place }));
        let target = look.targets[0];
        let gauges = match kind {
            Kind::Point => (0..3).map(|axis| Gauge::Coordinate { target, axis }).collect(),
            Kind::Distance | Kind::Sphere => vec![Gauge::Distance { target, from: fixture }],
            Kind::Contact => (0..3).map(|axis| Gauge::Apart { target, from: fixture, axis }).collect(),
            Kind::Plane | Kind::Indicator => {
                vec![Gauge::Along { target, about: look.at, direction: fixture }]
            }
            Kind::Between => vec![Gauge::Between { targets: [target, *look.targets.last().unwrap_or(&0)] }],
            Kind::Displacement => vec![Gauge::Moved { target }],
            Kind::Angle => vec![Gauge::Lean { mirror: look.mirror, direction: fixture }],
        };
        let first = self.readings.len();
        let (zero, zero_known) = match kind {
            Kind::Point | Kind::Contact | Kind::Displacement => (0.0, true),
            Kind::Distance | Kind::Between | Kind::Sphere => (look.zero, look.zero_known),
            Kind::Plane | Kind::Indicator | Kind::Angle => (0.0, false),
        };
        self.readings.extend(gauges.into_iter().map(|gauge| Reading {
            name: name.to_owned(),
            gauge,
            zero,
            zero_known,
            uncertainty: look.uncertainty,
            touched: kind.is_touched(),
            instrument: self.list.len(),
        }));
        first..self.readings.len()
    }

    /// What all readings are called, in order: by their instrument, and by the axis if it has three.
    pub(crate) fn names(&self) -> Vec<String> {
        let of = |instrument: &Instrument| match instrument.readings.len() {
            3 => ["x", "y", "z"].map(|axis| format!("{}_{axis}", instrument.name)).to_vec(),
            _ => vec![instrument.name.clone()],
        };
        self.list.iter().flat_map(of).collect()
    }

    /// The fixture that an instrument looks at, if it looks at one.
    pub fn fixture_of(&self, instrument: usize) -> Option<usize> {
        self.readings[self.list[instrument].readings.start].gauge.fixture()
    }

    /// Whether any of them sees where `F_0` is: the fixtures of all others stand in `F_0`.
    pub(super) fn see_the_base(&self) -> bool {
        self.list.iter().any(|instrument| instrument.kind == Kind::Point)
    }

    /// Whether any of them tells how far a target has moved since the row before.
    pub(crate) fn count_from_before(&self) -> bool {
        self.list.iter().any(|instrument| instrument.kind == Kind::Displacement)
    }

    /// The readings of a row before which there is none: nothing has moved yet.
    pub(super) fn at_first(&self, mut readings: Vec<Option<f64>>) -> Vec<Option<f64>> {
        let moved = self.list.iter().filter(|instrument| instrument.kind == Kind::Displacement);
        moved.for_each(|instrument| readings[instrument.readings.clone()].fill(None));
        readings
    }

    /// One standard deviation of the first that tells lengths.
    pub(super) fn uncertainty(&self) -> f64 {
        let lengths = self.readings.iter().find(|reading| !reading.gauge.is_angle());
        lengths.map_or(1.0, |reading| reading.uncertainty)
    }

    /// Every setup, and the instruments that are read in it, by index; a single one if the map has no column for them.
    pub fn setups(&self) -> Vec<(Option<f64>, Vec<usize>)> {
        let mut numbers: Vec<f64> = self.list.iter().filter_map(|instrument| instrument.setup).collect();
        numbers.sort_by(f64::total_cmp);
        numbers.dedup();
        let all = match numbers.is_empty() {
            true => vec![None],
            false => numbers.into_iter().map(Some).collect(),
        };
        all.into_iter().map(|setup| (setup, self.read_in(setup))).collect()
    }

    /// The instruments that are read in a setup.
    pub(super) fn read_in(&self, setup: Option<f64>) -> Vec<usize> {
        let read = |i: &usize| self.list[*i].setup.is_none() || self.list[*i].setup == setup;
        (0..self.list.len()).filter(read).collect()
    }

    /// Readings that are still to come, of these instruments.
    pub fn unread(&self, instruments: &[usize]) -> Vec<Option<f64>> {
        let mut readings = vec![None; self.readings.len()];
        for i in instruments {
            readings[self.list[*i].readings.clone()].fill(Some(0.0));
        }
        readings
    }

    /// The setup in which these were read.
    pub(super) fn setup_of(&self, readings: &[Option<f64>]) -> Option<f64> {
        let read = |instrument: &&Instrument| {
            instrument.setup.is_some() && readings[instrument.readings.clone()].iter().any(Option::is_some)
        };
        self.list.iter().find(read).and_then(|instrument| instrument.setup)
    }

    /// The readings that the numbers of a row are: first its setup, if there is a column for it, then the columns of all
    /// instruments; none where a cell is empty. Or why they are none.
    pub(super) fn read(&self, numbers: &[Option<f64>]) -> Result<Vec<Option<f64>>, String> {
        let skipped = usize::from(self.setup.is_some());
        let setup = numbers[..skipped].first().copied().flatten();
        let names = self.distinct_columns();
        let told = |column: &Column| {
            let place = names.iter().position(|other| other.name == column.name)?;
            numbers.get(skipped + place).copied().flatten()
        };
        let mut readings = vec![None; self.readings.len()];
        let read = self.read_in(setup);
        if read.is_empty() {
            return Err("no instrument of the map is read in this setup".to_owned());
        }
        for instrument in read.into_iter().map(|i| &self.list[i]) {
            for (place, reading) in instrument.readings.clone().enumerate() {
                readings[reading] = match instrument.kind.is_touched() {
                    true => Some(0.0),
                    false => told(&instrument.columns[place]).map(|number| number * instrument.factor),
                };
            }
        }
        if readings.iter().all(Option::is_none) {
            return Err(NOTHING_READ.to_owned());
        }
        Ok(readings)
    }

    /// The numbers of readings, as [`read`](Self::read) takes them.
    pub(super) fn numbers(&self, readings: &[Option<f64>]) -> Vec<Option<f64>> {
        let mut numbers: Vec<Option<f64>> = self.setup.iter().map(|_| self.setup_of(readings)).collect();
        for column in self.distinct_columns() {
            let told = self.list.iter().find_map(|instrument| {
                let place = instrument.columns.iter().position(|own| own.name == column.name)?;
                readings[instrument.readings.start + place].map(|value| value / instrument.factor)
            });
            numbers.push(told);
        }
        numbers
    }

    /// The columns of what is read.
    pub(super) fn columns(&self) -> Vec<&Column> {
        self.setup.iter().chain(self.distinct_columns()).collect()
    }

    /// The columns of all instruments, each once: an instrument that is used in several setups has one column.
    fn distinct_columns(&self) -> Vec<&Column> {
        let mut distinct: Vec<&Column> = Vec::new();
        for column in self.list.iter().flat_map(|instrument| &instrument.columns) {
            if distinct.iter().all(|other| other.name != column.name) {
                distinct.push(column);
            }
        }
        distinct
    }
}

pub(super) fn norm(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}
