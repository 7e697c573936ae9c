//! Rows of a data file: usable observations, and the reasons of the others.
//!
//! Rows with the calendar of their times.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use abbe::Manipulator;
use abbe::analysis::sampling;
use abbe::identify::{Approach, Configurations, Measurement, Observation};
use abbe_study::date::{Calendar, parse_date};
use abbe_study::{Result, mistake, number};
use serde::Serialize;

use super::command_pose::{CommandPose, inverse};
use super::configurations::number_configurations;
use super::instrument::{Instruments, NOTHING_READ};
use super::record::Record;
use super::{Channel, Column, Layout, Map, Source};

/// A row that cannot be used.
#[derive(Clone, Debug, Serialize)]
pub struct Unusable {
    /// Line in the file, from 1; index of the row for columns in memory.
    pub line: u64,
    /// Reason.
    pub reason: String,
}

/// Rows of a file, or of columns in memory.
#[derive(Clone, Debug, Default)]
pub struct Data {
    /// Name of the data in messages: the path of the file, or the name of the table.
    pub file: String,
    /// The file; empty if the rows come from elsewhere.
    pub files: Vec<PathBuf>,
    /// Description of the dialect, if it is not the usual one.
    pub dialect: Option<&'static str>,
    /// Usable rows, in order.
    pub observations: Vec<Observation>,
    /// Unusable rows.
    pub unusable: Vec<Unusable>,
    /// Names of the stations; empty if there is no column for them.
    pub stations: Vec<String>,
}

/// Columns to be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Wanted {
    /// Commands alone: a plan.
    Commanded,
    /// Commands and measurements.
    Measured,
}

/// Number of unusable rows that are listed.
pub(super) const SHOWN: usize = 10;

impl Data {
    /// Draws configurations with replacement, for the bootstrap; see [`Configurations::resampled`].
    pub fn resampled(&self, seed: u64, number: usize) -> Self {
        let rows = Configurations::new(&self.observations).resampled(seed, number);
        let observations = rows.into_iter().map(|row| self.observations[row].clone()).collect();
        Self { observations, ..self.clone() }
    }

    /// Reads commands and measurements. Exact repetitions of a row are unusable: copies, unless
    /// their times differ, or fewer than three readings were rounded to the same numbers.
    pub fn read<'a>(source: impl Into<Source<'a>>, map: &Map) -> Result<Self> {
        Self::rows(source.into(), map, Wanted::Measured, true)
    }

    /// Returns the names of the columns of a file.
    pub fn heading(file: &Path) -> Result<Vec<String>> {
        Source::File(file).open(&[]).map(|file| file.heading.to_vec())
    }

    /// Reads wanted poses of the tool, which other columns of the map measure; repetitions are
    /// kept.
    pub fn read_wanted<'a>(source: impl Into<Source<'a>>, map: &Map) -> Result<Self> {
        Self::rows(source.into(), map, Wanted::Measured, false)
    }

    /// Reads commands alone: a plan.
    pub fn read_commanded<'a>(source: impl Into<Source<'a>>, map: &Map) -> Result<Self> {
        Self::rows(source.into(), map, Wanted::Commanded, false)
    }

    fn rows(source: Source<'_>, map: &Map, columns: Wanted, once: bool) -> Result<Self> {
        let table = source.open(&map.given_columns)?;
        let header = &Arc::clone(&table.heading);
        // With measurements, their columns include the setup.
        let setup = map.setup().filter(|_| columns == Wanted::Commanded);
        let commanded: Vec<&Column> = map.commanded().chain(setup).collect();
        let measured = if columns == Wanted::Measured { map.measured() } else { Vec::new() };
        let mut by_name = HashMap::new();
        for (place, name) in header.iter().enumerate() {
            by_name.entry(name).or_insert((place, 0)).1 += 1;
        }
        let place = |column: &&Column| by_name.get(&column.name).map(|(place, _)| *place);
        // A plan does not need a column of stations.
        let is_there = |column: &&Column| columns == Wanted::Measured || place(column).is_some();
        let station = map.stations.column.as_ref().filter(is_there);
        let beside = map.group.iter().chain(&map.direction).chain(&map.time).filter(|_| once);
        let wanted = commanded.iter().chain(&measured).copied().chain(beside).chain(station);
        let missing: Vec<&Column> = wanted.filter(|column| place(column).is_none()).collect();
        if !missing.is_empty() {
            return Err(map.missing(&source.name(), &missing, header));
        }
        let wanted = commanded.iter().chain(&measured);
        let twice = |column: &&&Column| by_name.get(&column.name).is_some_and(|(_, count)| *count > 1);
        if let Some(column) = wanted.into_iter().find(twice) {
            let message = format!("duplicate column `{}`", column.name.escape_debug());
            return Err(mistake::with_help(source.name(), message, "rename one of them in the heading"));
        }
        let places = |columns: &[&Column]| columns.iter().filter_map(place).collect::<Vec<_>>();
        let station = station.as_ref().and_then(place);
        let (commanded, measured) = (places(&commanded), places(&measured));
        let mut data = Self {
            file: source.name(),
            files: source.file().map(Path::to_owned).into_iter().collect(),
            dialect: table.dialect,
            stations: map.stations.names(),
            ..Self::default()
        };
        let [group, direction, time] =
            [&map.group, &map.direction, &map.time].map(|column| column.as_ref().and_then(|c| place(&c)));
        let (mut groups, mut directions) = (Vec::new(), Vec::new());
        let mut known = HashSet::new();
        let nominal = map.command_pose.as_ref().map(CommandPose::machine);
        let inverse = nominal.as_ref().map(inverse).transpose()?;
        let mut last = nominal.as_ref().map_or(Vec::new(), |machine| sampling::home(machine.description()));
        // Previous row, for readings that refer to it.
        let from_before = map.instruments().is_some_and(Instruments::depend_on_previous_row);
        let mut before: Option<Observation> = None;
        for record in table.records {
            let record = record?;
            let measured = (columns == Wanted::Measured).then_some(&measured[..]);
            let joints = |numbers: &[f64]| match (&map.command_pose, &inverse) {
                (Some(pose), Some(inverse)) => pose.joints_at(inverse, &last, numbers).map(Some),
                _ => Ok(None),
            };
            let here = from_before.then(|| row(&record, &commanded, None, map, joints).ok()).flatten();
            let row = row(&record, &commanded, measured, map, joints).and_then(|row| {
                // A plan begins where nothing is read yet.
                if measured.is_some() && moved_from_nowhere(&row, before.as_ref(), map) {
                    return Err("this relative reading has no row before it".to_owned());
                }
                let time = time.map(|place| record.time(place)).transpose()?;
                if once && row.count() > 2 && !known.insert((hash(&row), time.map(f64::to_bits))) {
                    return Err("identical to an earlier row".to_owned());
                }
                Ok((row, time))
            });
            match row {
                Ok((observation, time)) => {
                    last.iter_mut().zip(observation.q.iter()).for_each(|(last, now)| *last = *now);
                    let station = station.map_or(0, |place| data.station(&record.text(place)));
                    let from = before.take().map(|from| Box::new(Observation { station, ..from }));
                    let approach = Approach { time, from, ..Approach::default() };
                    data.observations.push(Observation { station, ..observation }.approached(approach));
                    groups.extend(group.map(|place| record.text(place).into_owned()));
                    directions.extend(direction.map(|place| record.text(place).into_owned()));
                }
                // The row is a reference for the next one.
                Err(reason) if from_before && reason == NOTHING_READ => {}
                Err(reason) => data.unusable.push(Unusable { line: record.line, reason }),
            }
            before = here;
        }
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
            let message = format!("no row can be used{}", why.unwrap_or_default());
            let help = match source {
                Source::File(_) => "write one row of numbers in every line below the heading",
                Source::Columns(_) => "give a column of numbers for each name in the map",
            };
            return Err(mistake::with_help(source.name(), message, help));
        }
        Ok(data)
    }

    /// Returns the index of a station; adds it if it is new.
    fn station(&mut self, name: &str) -> u32 {
        let known = self.stations.iter().position(|station| station == name);
        known.unwrap_or_else(|| {
            self.stations.push(name.to_owned());
            self.stations.len() - 1
        }) as u32
    }

    /// Numbers the stations of the rows as in `other`; returns the first name that is missing
    /// there.
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

    /// Adds a row to the unusable ones.
    pub fn leave_out(&mut self, line: u64, reason: &str) {
        let place = self.unusable.partition_point(|row| row.line < line);
        self.unusable.insert(place, Unusable { line, reason: reason.to_owned() });
    }

    /// Names a row: `line 5` of a file, `row 3` of columns in memory.
    pub fn place(&self, line: u64) -> String {
        place(!self.files.is_empty(), line)
    }

    /// Returns a note if all rows have one time, so that drift cannot be tested.
    pub(crate) fn note_on_time(&self) -> Option<String> {
        let first = self.observations.first()?.time()?;
        let is_single =
            self.observations.len() > 1 && self.observations.iter().all(|row| row.time() == Some(first));
        is_single.then(|| {
            "all rows have the same time: drift was not tested; give the time of each row, or remove \
             `time` from the map if the rows are in order"
                .to_owned()
        })
    }

    /// Summarizes the rows and the reasons of unusable ones.
    pub fn summary(&self) -> Summary {
        Summary {
            file: self.file.clone(),
            dialect: self.dialect,
            rows: self.observations.len(),
            unusable: self.unusable.clone(),
            of_file: !self.files.is_empty(),
        }
    }
}

/// Number of usable rows, and the reasons of the others.
#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    /// Name of the file.
    pub file: String,
    /// Description of the dialect, if it is not the usual one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dialect: Option<&'static str>,
    /// Number of usable rows.
    pub rows: usize,
    /// Unusable rows.
    pub unusable: Vec<Unusable>,
    /// Rows are lines of a file.
    #[serde(skip)]
    pub(crate) of_file: bool,
}

/// Names a row.
fn place(of_file: bool, line: u64) -> String {
    format!("{} {line}", if of_file { "line" } else { "row" })
}

impl Summary {
    /// Formats the summary with a limited number of lines.
    pub fn lines(&self) -> Vec<String> {
        let dialect = self.dialect.map(|dialect| format!(" ({dialect})")).unwrap_or_default();
        let mut lines =
            vec![format!("{}: {}{dialect}", self.file, number::counted(self.rows, "row", "rows"))];
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

/// Returns the hash of joints, inputs and measurement of a row.
pub(crate) fn hash(row: &Observation) -> u64 {
    let mut hasher = DefaultHasher::new();
    // Adding 0 turns −0 into +0, so that both have the same hash.
    let mut take = |number: Option<f64>| number.map(|number| (number + 0.0).to_bits()).hash(&mut hasher);
    row.q.iter().chain(row.u.iter()).for_each(|value| take(Some(*value)));
    match &row.measured {
        Measurement::Points(points) => {
            points.iter().for_each(|point| (0..3).for_each(|axis| take(point.map(|point| point[axis]))));
        }
        Measurement::Pose(pose) => pose.0.as_flattened().iter().for_each(|value| take(Some(*value))),
        Measurement::Readings(readings) => readings.iter().for_each(|reading| take(*reading)),
    }
    hasher.finish()
}

/// Converts a record to an observation; `measured` are the columns of the measurement, none for a
/// plan.
fn row(
    record: &Record,
    commanded: &[usize],
    measured: Option<&[usize]>,
    map: &Map,
    joints: impl Fn(&[f64]) -> Result<Option<Vec<f64>>, String>,
) -> Result<Observation, String> {
    if let Some(reason) = record.too_long() {
        return Err(reason);
    }
    let commanded = record.numbers(commanded)?;
    let (pose, rest) = commanded.split_at(map.command_pose.iter().flat_map(CommandPose::columns).count());
    let mut values = rest.iter().copied();
    let mut channel = |channel: &Channel| match channel {
        Channel::Column(_, scale) => scale.value(values.next().unwrap_or_default()),
        Channel::Fixed(value) => *value,
        // Computed later, from all rows.
        Channel::FromRows(_) => 0.0,
    };
    let q: Vec<f64> = map.joints.iter().map(&mut channel).collect();
    let q = joints(pose)?.unwrap_or(q);
    let u: Vec<f64> = map.inputs.iter().map(&mut channel).collect();
    let Some(places) = measured else {
        return Ok(Observation::new(record.line, q, u, map.unmeasured(values.next())));
    };
    let numbers = measured_numbers(record, places, map)?;
    Ok(Observation::new(record.line, q, u, map.measurement(&numbers)?))
}

/// Returns the numbers of the measurement; none for the three empty cells of a hidden target.
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
        return Err("no target was measured".to_owned());
    }
    Ok(numbers)
}

/// Returns whether a row has readings that refer to a previous row, without there being one.
fn moved_from_nowhere(row: &Observation, before: Option<&Observation>, map: &Map) -> bool {
    match (map.instruments(), &row.measured, before) {
        (Some(all), Measurement::Readings(readings), None) => {
            all.at_first(readings.clone(), false) != *readings
        }
        _ => false,
    }
}

/// Rows of a file, and the calendar of its column of times.
#[derive(Clone, Debug)]
pub struct Dated {
    /// The rows.
    pub data: Data,
    /// Calendar of each row; none if the map names no column of times.
    pub calendars: Option<Vec<Calendar>>,
}

impl Dated {
    /// Reads commands, measurements and times. Repeated rows are kept.
    pub fn read<'a>(source: impl Into<Source<'a>>, map: &Map) -> Result<Self> {
        let source = source.into();
        let data = Data::read_wanted(source, map)?;
        let Some(column) = &map.time else { return Ok(Self { data, calendars: None }) };
        let table = source.open(&map.given_columns)?;
        let place = table.heading.iter().position(|name| *name == column.name);
        let place = place.ok_or_else(|| map.missing(&source.name(), &[column], &table.heading))?;
        let mut calendars = Vec::with_capacity(data.observations.len());
        let mut rows = data.observations.iter().map(|row| row.line).peekable();
        for record in table.records {
            let record = record?;
            if rows.next_if_eq(&record.line).is_some() {
                let date = parse_date(&record.text(place));
                calendars.push(date.map_or(Calendar::Days, |(calendar, _)| calendar));
            }
        }
        Ok(Self { data, calendars: Some(calendars) })
    }
}
