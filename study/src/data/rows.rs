//! Rows of a data file: what can be used, and what cannot and why.

use std::borrow::Cow;
use std::hash::{BuildHasher, Hash, Hasher, RandomState};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use abbe::identify::{Approach, Configurations, Measurement, Observation};
use abbe_spec::diagnostic::Diagnostics;
use hashbrown::HashTable;
use serde::Serialize;

use super::column::{Channel, Column};
use super::configurations::number_configurations;
use super::instrument::{Instruments, NOTHING_READ};
use super::map::{Layout, Map};
use super::record::Record;
use super::source::Source;
use crate::mistake;

/// A row that cannot be used.
#[derive(Clone, Debug, Serialize)]
pub struct Unusable {
    /// Its line in the file, from 1; of columns in memory its row, from 0.
    pub line: u64,
    /// Why not.
    pub reason: String,
}

/// The rows of a file, or of columns in memory.
#[derive(Clone, Debug, Default)]
pub struct Data {
    /// The file's name, or what the columns are called.
    pub file: String,
    /// The file itself; none if the rows come from elsewhere.
    pub files: Vec<PathBuf>,
    /// How it is written, if not with commas between cells and points in decimals.
    pub written: Option<&'static str>,
    /// Those that can be used, in order.
    pub observations: Vec<Observation>,
    /// Those that cannot.
    pub unusable: Vec<Unusable>,
    /// The names of the stations that rows were measured at; none if that is not said.
    pub stations: Vec<String>,
}

/// Which columns are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Wanted {
    /// What was commanded alone: a plan.
    Commanded,
    /// What was measured, too.
    Measured,
}

impl Data {
    /// The same measurements with configurations drawn with replacement, for the bootstrap: see
    /// [`Configurations::resampled`].
    pub fn resampled(&self, seed: u64, number: usize) -> Self {
        let rows = Configurations::new(&self.observations).resampled(seed, number);
        let observations = rows.into_iter().map(|row| self.observations[row].clone()).collect();
        Self { observations, ..self.clone() }
    }

    /// Reads what was commanded and what was measured. A row that was there before, digit by digit, is not used.
    pub fn read<'a>(source: impl Into<Source<'a>>, map: &Map) -> Result<Self, Diagnostics> {
        Self::rows(source.into(), map, Wanted::Measured, true)
    }

    /// The names of the columns of a file.
    pub fn heading(file: &Path) -> Result<Vec<String>, Diagnostics> {
        Source::File(file).open().map(|file| file.heading.to_vec())
    }

    /// Reads where the tool is wanted: what is measured elsewhere; the same place may be wanted again.
    pub fn read_wanted<'a>(source: impl Into<Source<'a>>, map: &Map) -> Result<Self, Diagnostics> {
        Self::rows(source.into(), map, Wanted::Measured, false)
    }

    /// Reads what was commanded alone: a plan.
    pub fn read_commanded<'a>(source: impl Into<Source<'a>>, map: &Map) -> Result<Self, Diagnostics> {
        Self::rows(source.into(), map, Wanted::Commanded, false)
    }

    fn rows(source: Source<'_>, map: &Map, columns: Wanted, once: bool) -> Result<Self, Diagnostics> {
        let table = source.open()?;
        let header = &Arc::clone(&table.heading);
        // The setup is read with what is measured, if anything is.
        let setup = map.setup().filter(|_| columns == Wanted::Commanded);
        let commanded: Vec<&Column> = map.commanded().chain(setup).collect();
        let measured = if columns == Wanted::Measured { map.measured() } else { Vec::new() };
        let place = |column: &&Column| header.iter().position(|name| *name == column.name);
        // A plan says only if it can where it is for.
        let is_there = |column: &&Column| columns == Wanted::Measured || place(column).is_some();
        let station = map.stations.column.as_ref().filter(is_there);
        let beside = map.group.iter().chain(&map.direction).chain(&map.time).filter(|_| once);
        let wanted = commanded.iter().chain(&measured).copied().chain(beside).chain(station);
        let missing: Vec<&Column> = wanted.filter(|column| place(column).is_none()).collect();
        if !missing.is_empty() {
            return Err(map.missing(&source.name(), &missing, header));
        }
        let wanted = commanded.iter().chain(&measured);
        let twice = |column: &&&Column| header.iter().filter(|name| **name == column.name).count() > 1;
        if let Some(column) = wanted.into_iter().find(twice) {
            let message = format!("two columns are called `{}`", column.name.escape_debug());
            return Err(mistake::with_help(source.name(), message, "rename one of them in the heading"));
        }
        let places = |columns: &[&Column]| columns.iter().filter_map(place).collect::<Vec<_>>();
        let station = station.as_ref().and_then(place);
        let (commanded, measured) = (places(&commanded), places(&measured));
        let mut data = Self {
            file: source.name(),
            files: source.file().map(Path::to_owned).into_iter().collect(),
            written: table.written,
            stations: map.stations.names(),
            ..Self::default()
        };
        let [group, direction, time] =
            [&map.group, &map.direction, &map.time].map(|column| column.as_ref().and_then(|c| place(&c)));
        let (mut groups, mut directions) = (Vec::new(), Vec::new());
        let mut known = Known::default();
        // Where the machine was before, for instruments that tell how far it moved since.
        let from_before = map.instruments().is_some_and(Instruments::count_from_before);
        let mut before: Option<Observation> = None;
        for record in table.records {
            let record = record?;
            let measured = (columns == Wanted::Measured).then_some(&measured[..]);
            let here = from_before.then(|| row(&record, &commanded, None, map).ok()).flatten();
            let row = row(&record, &commanded, measured, map).and_then(|row| {
                if once && known.has(&row, &data.observations) {
                    return Err("the same as a row before it, digit by digit".to_owned());
                }
                if moved_from_nowhere(&row, before.as_ref(), map) {
                    return Err("how far it moved was read, and there is no row before it".to_owned());
                }
                Ok((row, time.map(|place| record.time(place)).transpose()?))
            });
            match row {
                Ok((observation, time)) => {
                    let station = station.map_or(0, |place| data.station(&record.text(place)));
                    let from = before.take().map(|from| Box::new(Observation { station, ..from }));
                    let approach = Approach { time, from, ..Approach::default() };
                    data.observations.push(Observation { station, ..observation }.approached(approach));
                    if once {
                        known.add(&data.observations);
                    }
                    groups.extend(group.map(|place| record.text(place).into_owned()));
                    directions.extend(direction.map(|place| record.text(place).into_owned()));
                }
                // A place to begin from.
                Err(reason) if from_before && reason == NOTHING_READ => {}
                Err(reason) => data.unusable.push(Unusable { line: record.line, reason }),
            }
            before = here;
        }
        drop(known);
        let directions = Configurations::from_keys(directions).number;
        let directions = data.observations.iter_mut().zip(directions).filter(|(_, number)| *number > 0);
        directions.for_each(|(row, number)| row.approach_mut().direction = number);
        match group {
            Some(_) => {
                let numbers = Configurations::from_keys(groups).number;
                data.observations
                    .iter_mut()
                    .zip(numbers)
                    .for_each(|(row, number)| row.configuration = number);
            }
            None => number_configurations(&mut data.observations, &map.resolution),
        }
        if data.observations.is_empty() {
            let why = data.unusable.first().map(|row| format!(": {}: {}", data.place(row.line), row.reason));
            let message = format!("there is no row in it that can be used{}", why.unwrap_or_default());
            let help = match source {
                Source::File(_) => "one row of numbers in every line below the heading",
                Source::Columns(_) => "a column of numbers for each that the map names",
            };
            return Err(mistake::with_help(source.name(), message, help));
        }
        Ok(data)
    }

    /// The index of a station; one of that name is added if there is none.
    fn station(&mut self, name: &str) -> u32 {
        let known = self.stations.iter().position(|station| station == name);
        known.unwrap_or_else(|| {
            self.stations.push(name.to_owned());
            self.stations.len() - 1
        }) as u32
    }

    /// The same rows with their stations numbered as in `other`, or the first name that is not there.
    pub fn at_stations(&self, other: &Self) -> Result<Cow<'_, Self>, String> {
        if self.stations == other.stations {
            return Ok(Cow::Borrowed(self));
        }
        let mut data = Self { stations: other.stations.clone(), ..self.clone() };
        for row in &mut data.observations {
            let name = self.stations.get(row.station as usize).map_or("", |name| name);
            let found = other.stations.iter().position(|station| station == name);
            let found = found.or((other.stations.is_empty() && name.is_empty()).then_some(0));
            row.station = found.ok_or(name)? as u32;
        }
        Ok(Cow::Owned(data))
    }

    /// Notes a row that was left out after all.
    pub fn leave_out(&mut self, line: u64, reason: &str) {
        let place = self.unusable.partition_point(|row| row.line < line);
        self.unusable.insert(place, Unusable { line, reason: reason.to_owned() });
    }

    /// Where a row stands: `line 5` of a file, `row 3` of columns in memory.
    pub fn place(&self, line: u64) -> String {
        place(!self.files.is_empty(), line)
    }

    /// How many rows there are, and what is wrong with the others.
    pub fn summary(&self) -> Summary {
        Summary {
            file: self.file.clone(),
            written: self.written,
            rows: self.observations.len(),
            unusable: self.unusable.clone(),
            of_file: !self.files.is_empty(),
        }
    }
}

/// How many rows of a file can be used, and what is wrong with the others.
#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    /// The file's name.
    pub file: String,
    /// How it is written, if not with commas between cells and points in decimals.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub written: Option<&'static str>,
    /// How many rows can be used.
    pub rows: usize,
    /// Those that cannot.
    pub unusable: Vec<Unusable>,
    /// Whether they have lines, being those of a file.
    #[serde(skip)]
    pub(crate) of_file: bool,
}

/// Where a row stands, in words.
fn place(of_file: bool, line: u64) -> String {
    format!("{} {line}", if of_file { "line" } else { "row" })
}

impl Summary {
    /// In words, one line each and not too many.
    pub fn lines(&self) -> Vec<String> {
        const SHOWN: usize = 10;
        let written = self.written.map(|written| format!(" ({written})")).unwrap_or_default();
        let mut lines = vec![format!("{}: {} rows{written}", self.file, self.rows)];
        if !self.unusable.is_empty() {
            lines[0] += &format!(", {} more that cannot be used:", self.unusable.len());
            let shown = self.unusable.iter().take(SHOWN);
            lines.extend(shown.map(|row| format!("  {}: {}", place(self.of_file, row.line), row.reason)));
            if self.unusable.len() > SHOWN {
                lines.push(format!("  … and {} more", self.unusable.len() - SHOWN));
            }
        }
        lines
    }
}

/// The places of rows, by a hash of their digits: 5 bytes for each.
#[derive(Default)]
struct Known {
    places: HashTable<u32>,
    digits: RandomState,
}

impl Known {
    /// Whether one of the rows says the same.
    fn has(&self, row: &Observation, rows: &[Observation]) -> bool {
        self.places.find(hash(&self.digits, row), |place| is_same(&rows[*place as usize], row)).is_some()
    }

    /// The last of the rows is known from now on.
    fn add(&mut self, rows: &[Observation]) {
        let hash_of = |place: usize| hash(&self.digits, &rows[place]);
        let last = rows.len() - 1;
        self.places.insert_unique(hash_of(last), last as u32, |place| hash_of(*place as usize));
    }
}

fn hash(digits: &RandomState, row: &Observation) -> u64 {
    let mut hasher = digits.build_hasher();
    row.q.iter().chain(row.u.iter()).for_each(|value| value.to_bits().hash(&mut hasher));
    let mut number = |value: Option<f64>| value.map(f64::to_bits).hash(&mut hasher);
    match &row.measured {
        Measurement::Points(points) => {
            points.iter().for_each(|point| (0..3).for_each(|axis| number(point.map(|point| point[axis]))));
        }
        Measurement::Pose(pose) => pose.0.as_flattened().iter().for_each(|value| number(Some(*value))),
        Measurement::Readings(readings) => readings.iter().for_each(|reading| number(*reading)),
    }
    hasher.finish()
}

/// Whether two rows say the same.
fn is_same(a: &Observation, b: &Observation) -> bool {
    a.q == b.q && a.u == b.u && a.measured == b.measured
}

/// What a record says; `measured` are the places of what was measured, none if that is not wanted.
fn row(
    record: &Record,
    commanded: &[usize],
    measured: Option<&[usize]>,
    map: &Map,
) -> Result<Observation, String> {
    if let Some(reason) = record.too_long() {
        return Err(reason);
    }
    let commanded = record.numbers(commanded)?;
    let mut values = commanded.iter().copied();
    let mut channel = |channel: &Channel| match channel {
        Channel::Column(_, scale) => scale.value(values.next().unwrap_or_default()),
        Channel::Fixed(value) => *value,
        // All rows tell it together.
        Channel::FromRows(_) => 0.0,
    };
    let q: Vec<f64> = map.joints.iter().map(&mut channel).collect();
    let u: Vec<f64> = map.inputs.iter().map(&mut channel).collect();
    let Some(places) = measured else {
        return Ok(Observation::new(record.line, q, u, map.unmeasured(values.next())));
    };
    let numbers = measured_numbers(record, places, map)?;
    Ok(Observation::new(record.line, q, u, map.measurement(&numbers)?))
}

/// The numbers of what was measured, none where a target was hidden: its three fields are empty.
fn measured_numbers(record: &Record, places: &[usize], map: &Map) -> Result<Vec<Option<f64>>, String> {
    if matches!(map.layout, Layout::Instruments(_)) {
        let number = |place: &usize| match record.is_empty(*place) {
            true => Ok(None),
            false => record.number(*place).map(Some),
        };
        return places.iter().map(number).collect();
    }
    if !matches!(map.layout, Layout::Targets(_)) {
        return Ok(record.numbers(places)?.into_iter().map(Some).collect());
    }
    let mut numbers = Vec::new();
    for three in places.chunks_exact(3) {
        match three.iter().all(|place| record.is_empty(*place)) {
            true => numbers.extend([None; 3]),
            false => numbers.extend(record.numbers(three)?.into_iter().map(Some)),
        }
    }
    if numbers.iter().all(Option::is_none) {
        return Err("no target was seen".to_owned());
    }
    Ok(numbers)
}

/// Whether a row says how far a target has moved since the one before, and there is none.
fn moved_from_nowhere(row: &Observation, before: Option<&Observation>, map: &Map) -> bool {
    match (map.instruments(), &row.measured, before) {
        (Some(all), Measurement::Readings(readings), None) => all.at_first(readings.clone()) != *readings,
        _ => false,
    }
}
