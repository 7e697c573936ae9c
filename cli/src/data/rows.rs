//! Rows of a data file: what can be used, and what cannot and why.

use std::collections::HashSet;
use std::fs::File;
use std::path::Path;

use abbe::Pose;
use abbe::identify::{Observation, Seen};
use csv::{Reader, ReaderBuilder, StringRecord, Trim};
use serde::Serialize;

use super::map::{Channel, Column, Layout, Map};
use super::rotation;
use crate::failure::Failure;

/// A row that cannot be used.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Unusable {
    pub(crate) line: u64,
    pub(crate) reason: String,
}

/// The rows of a file.
#[derive(Clone, Debug, Default)]
pub(crate) struct Data {
    pub(crate) file: String,
    pub(crate) observations: Vec<Observation>,
    /// The line of each.
    pub(crate) lines: Vec<u64>,
    pub(crate) unusable: Vec<Unusable>,
}

impl Data {
    /// Reads what was commanded and what was measured.
    pub(crate) fn read(file: &Path, map: &Map) -> Result<Self, Failure> {
        Self::rows(file, map, true, true)
    }

    /// The names of the columns of a file.
    pub(crate) fn heading(file: &Path) -> Result<Vec<String>, Failure> {
        open(file).map(|(_, header)| header)
    }

    /// Reads where the tool is wanted: what is measured elsewhere; the same place may be wanted again.
    pub(crate) fn read_wanted(file: &Path, map: &Map) -> Result<Self, Failure> {
        Self::rows(file, map, true, false)
    }

    /// Reads what was commanded alone: a plan.
    pub(crate) fn read_commanded(file: &Path, map: &Map) -> Result<Self, Failure> {
        Self::rows(file, map, false, false)
    }

    fn rows(file: &Path, map: &Map, measured: bool, once: bool) -> Result<Self, Failure> {
        let (mut reader, header) = open(file)?;
        let fail = |error| unreadable(file, &error);
        let commanded: Vec<&Column> = map.commanded().collect();
        let seen = if measured { map.measured() } else { Vec::new() };
        let place = |column: &&Column| header.iter().position(|name| *name == column.name);
        let missing: Vec<&Column> =
            commanded.iter().chain(&seen).filter(|column| place(column).is_none()).copied().collect();
        if !missing.is_empty() {
            return Err(map.missing(file, &missing, &header).into());
        }
        let places = |columns: &[&Column]| columns.iter().filter_map(place).collect::<Vec<_>>();
        let (commanded, seen) = (places(&commanded), places(&seen));
        let mut data = Self { file: file.display().to_string(), ..Self::default() };
        let mut known = HashSet::new();
        for (i, record) in reader.records().enumerate() {
            let record = record.map_err(fail)?;
            let line = record.position().map_or(i as u64 + 2, csv::Position::line);
            let row = row(&record, &header, &commanded, &seen, map, measured).and_then(|(bits, row)| {
                if !once || known.insert(bits) {
                    Ok(row)
                } else {
                    Err("the same as a row before it, digit by digit".to_owned())
                }
            });
            match row {
                Ok(observation) => {
                    data.observations.push(observation);
                    data.lines.push(line);
                }
                Err(reason) => data.unusable.push(Unusable { line, reason }),
            }
        }
        if data.observations.is_empty() {
            let why = data.unusable.first().map(|row| format!(": line {}: {}", row.line, row.reason));
            let message = format!("there is no row in it that can be used{}", why.unwrap_or_default());
            return Err(Failure::of(file.display(), message)
                .help("one row of numbers in every line below the heading"));
        }
        Ok(data)
    }

    /// The rows but those, by index.
    pub(crate) fn without(&self, leave: impl Fn(usize) -> bool) -> Self {
        let kept = |i: &usize| !leave(*i);
        let rows = (0..self.lines.len()).filter(kept);
        let (observations, lines) = rows.map(|i| (self.observations[i].clone(), self.lines[i])).unzip();
        Self { file: self.file.clone(), observations, lines, unusable: self.unusable.clone() }
    }

    /// Notes a row that was left out after all.
    pub(crate) fn leave_out(&mut self, line: u64, reason: &str) {
        let place = self.unusable.partition_point(|row| row.line < line);
        self.unusable.insert(place, Unusable { line, reason: reason.to_owned() });
    }

    /// How many rows there are, and what is wrong with the others, one line each and not too many.
    pub(crate) fn describe(&self) -> Vec<String> {
        const SHOWN: usize = 10;
        let mut lines = vec![format!("{}: {} rows", self.file, self.observations.len())];
        if !self.unusable.is_empty() {
            lines[0] += &format!(", {} more that cannot be used:", self.unusable.len());
            lines.extend(
                self.unusable.iter().take(SHOWN).map(|row| format!("  line {}: {}", row.line, row.reason)),
            );
            if self.unusable.len() > SHOWN {
                lines.push(format!("  … and {} more", self.unusable.len() - SHOWN));
            }
        }
        lines
    }
}

/// A CSV file and its heading.
fn open(file: &Path) -> Result<(Reader<File>, Vec<String>), Failure> {
    let fail = |error| unreadable(file, &error);
    let reader = ReaderBuilder::new().trim(Trim::All).comment(Some(b'#')).flexible(true).from_path(file);
    let mut reader = reader.map_err(fail)?;
    let header: Vec<String> = reader.headers().map_err(fail)?.iter().map(str::to_owned).collect();
    if header.is_empty() {
        return Err(Failure::of(file.display(), "this file is empty").help(WANTED));
    }
    Ok((reader, header))
}

const WANTED: &str = "give a CSV file with a heading in its first line";

fn unreadable(file: &Path, error: &csv::Error) -> Failure {
    Failure::of(file.display(), format!("cannot read this file: {error}")).help(WANTED)
}

/// The digits of a row, by which it is known again.
type Bits = Vec<u64>;

fn row(
    record: &StringRecord,
    header: &[String],
    commanded: &[usize],
    seen: &[usize],
    map: &Map,
    measured: bool,
) -> Result<(Bits, Observation), String> {
    let number = |place: &usize| {
        let name = &header[*place];
        match record.get(*place) {
            None => Err(format!("it ends before `{name}`")),
            Some("") => Err(format!("`{name}` is missing")),
            Some(text) => match text.parse::<f64>() {
                Ok(value) if value.is_finite() => Ok(value),
                Ok(_) => Err(format!("`{name}` is `{}`", text.escape_debug())),
                Err(_) => Err(format!("`{name}` is `{}`, not a number", text.escape_debug())),
            },
        }
    };
    let commanded = commanded.iter().map(number).collect::<Result<Vec<f64>, _>>()?;
    let mut values = commanded.iter().copied();
    let mut channel = |channel: &Channel| match channel {
        Channel::Column(_, factor) => values.next().unwrap_or_default() * factor,
        Channel::Fixed(value) => *value,
    };
    let q = map.joints.iter().map(&mut channel).collect();
    let u = map.inputs.iter().map(&mut channel).collect();
    let mut bits: Bits = commanded.iter().map(|value| value.to_bits()).collect();
    if !measured {
        return Ok((bits, Observation { q, u, seen: map.unseen() }));
    }
    let seen = if let Layout::Targets(targets) = &map.layout {
        // A target may be hidden: its fields are empty.
        let hidden = |three: &[usize]| three.iter().all(|place| record.get(*place).is_none_or(str::is_empty));
        let mut points = Vec::new();
        for (three, target) in seen.chunks_exact(3).zip(targets) {
            if hidden(three) {
                points.push(None);
                continue;
            }
            let point = three.iter().map(number).collect::<Result<Vec<f64>, _>>()?;
            bits.extend(point.iter().map(|value| value.to_bits()));
            points.push(Some(std::array::from_fn(|i| point[i] * target.factor)));
        }
        if points.iter().all(Option::is_none) {
            return Err("no target was seen".to_owned());
        }
        Seen::Points(points)
    } else {
        let numbers = seen.iter().map(number).collect::<Result<Vec<f64>, _>>()?;
        bits.extend(numbers.iter().map(|value| value.to_bits()));
        let point = |factor: f64| std::array::from_fn(|i| numbers[i] * factor);
        match &map.layout {
            Layout::Difference(_, _, factor) => {
                Seen::Points(vec![Some(std::array::from_fn(|i| (numbers[i] - numbers[3 + i]) * factor))])
            }
            Layout::Pose(_, factor, turn) => {
                let [x, y, z] = rotation::from_numbers(turn, &numbers[3..])?;
                Seen::Pose(Pose([x, y, z, point(*factor)]))
            }
            Layout::Point(_, factor) => Seen::Points(vec![Some(point(*factor))]),
            Layout::Targets(_) => Seen::Points(Vec::new()),
        }
    };
    Ok((bits, Observation { q, u, seen }))
}
