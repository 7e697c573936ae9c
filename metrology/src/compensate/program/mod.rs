//! Programs of robots: their positions and joint targets are read, and written corrected. All other
//! text stays as it is.

mod languages;

use std::ops::Range;
use std::path::{Path, PathBuf};

use abbe::analysis::{InverseKinematics, sampling};
use abbe::identify::Observation;
use abbe::{LengthUnit, Manipulator, Pose, Variable, VariableKind};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_spec::bounded::{Bounded, UnreadableFile};
use abbe_spec::option::FRAME;
use abbe_study::{Notes, Result, mistake, number};
use regex_lite::Captures;

use super::Row;
use crate::data::{Channel, Data, Map, Scale, Unusable, from_numbers, to_numbers};
use languages::{LANGUAGES, Language};

/// Number of joints of a joint target.
const JOINTS: usize = 6;
/// Largest size of a program.
const LARGEST: u64 = 1 << 26;
/// Decimals of angles in rad, and of the numbers of quaternions.
const DIGITS_OF_TURNS: f64 = 8.0;
/// Decimals of lengths in m.
const DIGITS_OF_METRES: f64 = 7.0;
/// Number of lines that a note names.
const NAMED: usize = 8;

/// A program of a robot, with its positions and joint targets.
pub struct Program {
    path: PathBuf,
    text: String,
    /// Each byte of the file is a character.
    is_latin: bool,
    language: &'static Language,
    points: Vec<Point>,
    /// Lines of positions that are left as they are: relative and incomplete ones, frames, tools.
    left: Vec<usize>,
    /// Line that sets the frame of positions.
    frame_line: Option<usize>,
}

/// A position or a joint target: its numbers and their places in the text.
struct Point {
    line: u64,
    is_pose: bool,
    numbers: Vec<(Range<usize>, f64)>,
}

/// Place of a joint among the numbers of a joint target, and its scale; no place for a constant,
/// the zero of its scale.
type JointChannel = (Option<usize>, Scale);

/// Returns the decimals of a number in a unit that are those of the coherent unit.
fn decimals(coherent: f64, unit: f64) -> usize {
    (coherent + unit.abs().log10()).round().max(0.0) as usize
}

/// Reads a transform of a spec, such as `Tx(500) Rz(90deg)`: the pose in `F_0` of the frame in
/// which a program states its positions.
///
/// # Errors
///
/// The text is not a transform, or has a variable.
pub fn read_frame(transform: &str, length: LengthUnit) -> Result<Pose> {
    let text = format!(
        "manipulator = {{ name = \"frame\", length = \"{}\" }}\n[[frame]]\nname = \"frame\"\ntransform = {:?}\n",
        length.symbol(),
        transform
    );
    let frame = Interpreter::new(Spec::parse(&FRAME.to_string(), &text)?);
    frame.pose(&[], &[]).map_err(|error| mistake::whole(FRAME, &error))
}

impl Program {
    /// Reads a program; `None` if the ending of the name or the text is not that of one.
    ///
    /// # Errors
    ///
    /// The file cannot be read, or has no positions.
    pub fn read(path: &Path) -> Result<Option<Self>> {
        let ending = path.extension().unwrap_or_default().to_string_lossy();
        let Some(language) = Language::find(&ending) else { return Ok(None) };
        let bytes = Bounded::read_all(path, LARGEST).map_err(|error| {
            UnreadableFile::diagnostics(path.display(), &error, "give the path of a file that can be read")
        })?;
        let (text, is_latin) = match String::from_utf8(bytes) {
            Ok(text) => (text, false),
            Err(error) => (error.into_bytes().into_iter().map(char::from).collect(), true),
        };
        let patterns = language.patterns().filter(|_| language.has_begun(&text));
        let Some([pose, joints, elsewhere, relative, frame]) = patterns else { return Ok(None) };
        let starts: Vec<usize> =
            std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at + 1)).collect();
        let line = |at: usize| starts.partition_point(|start| *start <= at);
        let before = |at: usize| &text[starts[line(at) - 1]..at];
        // Returns the start of what is not in a comment.
        let start = |found: &Captures<'_>| {
            let at = found.get(0)?.start();
            (!before(at).contains(language.comment)).then_some(at)
        };
        let (mut points, mut left) = (Vec::new(), Vec::new());
        for (pattern, is_pose) in [(&pose, true), (&joints, false)] {
            for found in pattern.captures_iter(&text) {
                let Some(at) = start(&found) else { continue };
                if elsewhere.is_match(before(at)) {
                    left.push(line(at));
                    continue;
                }
                let number = |text: &str| text.parse().unwrap_or(f64::NAN);
                let numbers = found.iter().skip(1).flatten().map(|one| (one.range(), number(one.as_str())));
                points.push(Point { line: line(at) as u64, is_pose, numbers: numbers.collect() });
            }
        }
        let place = |point: &Point| point.numbers[0].0.start;
        points.sort_by_key(place);
        if points.is_empty() {
            let names: Vec<&str> = LANGUAGES.iter().map(|language| language.name).collect();
            let message = format!("this program in {} has no positions", language.name);
            let help = format!("positions must be numbers in the file; known are {}", names.join(", "));
            return Err(mistake::with_help(path.display(), message, help));
        }
        let is_read = |found: &Captures<'_>| {
            let number = found.get(1).map(|number| number.start());
            number.is_some_and(|at| points.binary_search_by_key(&at, place).is_ok())
        };
        let relative = relative.captures_iter(&text).filter(|found| !is_read(found));
        left.extend(relative.filter_map(|found| start(&found)).map(line));
        left.sort_unstable();
        left.dedup();
        let frame_line = frame.captures_iter(&text).find_map(|found| start(&found)).map(line);
        Ok(Some(Self { path: path.to_owned(), is_latin, language, points, left, frame_line, text }))
    }

    /// Returns the map of the joints of a machine: its variables are the joints of the program, in
    /// order and in its units.
    pub fn map(&self, spec: &Spec) -> Map {
        let mut map = Map::from_names(&[], spec);
        let scale = |kind| match kind {
            VariableKind::Revolute => self.language.radians,
            VariableKind::Prismatic => self.language.metres / spec.length.in_metres(),
        };
        for (i, (channel, variable)) in map.joints.iter_mut().zip(&spec.variables).enumerate() {
            if let Channel::Column(column, one) = channel {
                column.name = format!("{}{}", self.language.joint, i + 1);
                *one = Scale { one: scale(variable.kind), zero: 0.0 };
            }
        }
        map
    }

    /// Returns the commands of the program: a joint target as `map` has it, and for a position the
    /// nominal joints nearest to those before, from home. `frame` is the pose in `F_0` of the frame
    /// of positions.
    ///
    /// # Errors
    ///
    /// The map has a joint or an input in a column that the program does not have, or no position
    /// can be used.
    pub fn commands(
        &self,
        (machine, spec): (&dyn Manipulator, &Spec),
        map: &Map,
        frame: Option<&Pose>,
        notes: &mut dyn Notes,
    ) -> Result<Data> {
        let description = machine.description();
        let inverse = InverseKinematics::new(machine, &sampling::nominal_parameters(description));
        let u = map.inputs.iter().map(|channel| match channel {
            Channel::Fixed(value) => Ok(*value),
            _ => {
                Err(mistake::with_help(map.path(), "a program has no columns of inputs", "give their values"))
            }
        });
        let u: Vec<f64> = u.collect::<Result<_>>()?;
        let channels = self.channels(map)?;
        let mut last = sampling::home(description);
        let mut data =
            Data { file: self.path.display().to_string(), files: vec![self.path.clone()], ..Data::default() };
        for (index, point) in self.points.iter().enumerate() {
            let found = match point.is_pose {
                true => self.pose(point, description.length).and_then(|pose| {
                    let pose = frame.map_or(pose, |frame| frame.then(&pose));
                    let inverse = inverse.as_ref().map_err(ToString::to_string)?;
                    let all = inverse.solve(&last, &pose).map_err(|error| error.to_string())?;
                    all.into_iter().next().ok_or_else(|| "out of reach".to_owned())
                }),
                false => {
                    let value = |(place, scale): &JointChannel| {
                        scale.value(place.map_or(0.0, |place| point.numbers[place].1))
                    };
                    Ok(channels.iter().map(value).collect())
                }
            };
            match found {
                Ok(q) => {
                    last.clone_from(&q);
                    let row = Observation::new(point.line, q, u.clone(), map.unmeasured(None));
                    data.observations.push(Observation { configuration: index as u32, ..row });
                }
                Err(reason) => {
                    let reason = format!("the nominal machine does not reach this position: {reason}");
                    data.unusable.push(Unusable { line: point.line, reason });
                }
            }
        }
        self.note(&data, spec, frame.is_some(), notes);
        Ok(data)
    }

    /// Finds the numbers of joint targets of which a map makes joints.
    fn channels(&self, map: &Map) -> Result<Vec<JointChannel>> {
        let letter = self.language.joint;
        let channel = |channel: &Channel| match channel {
            Channel::Column(column, scale) => {
                let number = column.name.strip_prefix(letter).and_then(|number| number.parse().ok());
                let place = number.filter(|number| (1..=JOINTS).contains(number)).ok_or_else(|| {
                    let message = format!("a program has no joint `{}`", column.name.escape_debug());
                    let help = format!("its joints are `{letter}1` to `{letter}{JOINTS}`");
                    mistake::with_help(map.path(), message, help)
                })?;
                Ok((Some(place - 1), *scale))
            }
            Channel::Fixed(zero) => Ok((None, Scale { one: 1.0, zero: *zero })),
            Channel::FromRows(_) => Ok((None, Scale::COHERENT)),
        };
        map.joints.iter().map(channel).collect()
    }

    /// Returns the pose that a position states.
    fn pose(&self, point: &Point, length: LengthUnit) -> Result<Pose, String> {
        let mut numbers: Vec<f64> = point.numbers.iter().map(|(_, number)| *number).collect();
        self.language.in_order(&mut numbers[3..]);
        if !numbers.iter().all(|number| number.is_finite()) {
            return Err("its numbers are not finite".to_owned());
        }
        let [x, y, z] = from_numbers(&self.language.turn(), &numbers[3..])?;
        Ok(Pose([x, y, z, [0, 1, 2].map(|i| numbers[i] * self.language.metres / length.in_metres())]))
    }

    /// Returns the places and numbers of a pose, with their decimals; a quaternion has the sign of
    /// the `old` one.
    fn numbers(
        &self,
        pose: &Pose,
        length: LengthUnit,
        old: &[(Range<usize>, f64)],
    ) -> Vec<(usize, f64, usize)> {
        let Language { metres, radians, .. } = *self.language;
        let Pose([x, y, z, position]) = *pose;
        let mut turn = to_numbers(&self.language.turn(), &[x, y, z]);
        self.language.in_order(&mut turn);
        let is_quaternion = turn.len() == 4;
        let product: f64 = turn.iter().zip(&old[3..]).map(|(new, (_, old))| new * old).sum();
        let sign = if is_quaternion && product < 0.0 { -1.0 } else { 1.0 };
        let turn = turn.into_iter().map(|number| {
            (sign * number, decimals(DIGITS_OF_TURNS, if is_quaternion { 1.0 } else { radians }))
        });
        let position =
            position.map(|v| (v * length.in_metres() / metres, decimals(DIGITS_OF_METRES, metres)));
        let all = position.into_iter().chain(turn).enumerate();
        all.map(|(place, (number, decimals))| (place, number, decimals)).collect()
    }

    /// Tells what the program does not say itself, and what is left as it is.
    fn note(&self, data: &Data, spec: &Spec, has_frame: bool, notes: &mut dyn Notes) {
        if let (Some(line), false) = (self.frame_line, has_frame) {
            notes.warn(&format!(
                "line {line} sets a frame of positions; here they are positions in F_0. Give its pose in F_0 \
                 to `{FRAME}`"
            ));
        }
        let first = data.observations.first().filter(|row| self.points[row.configuration as usize].is_pose);
        if let Some(row) = first {
            notes.note(&format!(
                "line {}: the first position is reached with {}, the joints nearest to `home` of the spec; \
                 those after it with the joints nearest to the ones before",
                row.line,
                number::variables(&row.q, spec)
            ));
        }
        let lines: Vec<String> = self.left.iter().take(NAMED).map(usize::to_string).collect();
        if !lines.is_empty() {
            let more = self.left.len() - lines.len();
            let more = if more > 0 { format!(" and {more} more") } else { String::new() };
            notes.warn(&format!(
                "left as they are, as steps, frames, tools or incomplete positions: line {}{more}",
                lines.join(", ")
            ));
        }
    }

    /// Returns the program with the numbers of corrected commands, in the bytes of its file. Of
    /// positions that are not among the rows, the numbers stay.
    ///
    /// # Errors
    ///
    /// A pose cannot be evaluated.
    pub fn corrected(
        &self,
        rows: &[Row],
        machine: &dyn Manipulator,
        map: &Map,
        frame: Option<&Pose>,
    ) -> Result<Vec<u8>> {
        let description = machine.description();
        let s = sampling::nominal_parameters(description);
        let channels = self.channels(map)?;
        let (mut text, mut end) = (String::with_capacity(self.text.len()), 0);
        for row in rows {
            let Point { is_pose, numbers, .. } = &self.points[row.corrected.configuration as usize];
            let q = &row.corrected.q;
            let written: Vec<(usize, f64, usize)> = if *is_pose {
                let pose = machine.pose(q, &s).map_err(|error| mistake::whole(&description.name, &error))?;
                let pose = frame.map_or(pose, |frame| frame.inverse().then(&pose));
                self.numbers(&pose, description.length, numbers)
            } else {
                let joints = channels.iter().zip(q.iter().zip(&*description.variables));
                let number = |((place, scale), (value, variable)): (&JointChannel, (&f64, &Variable))| {
                    let (digits, unit) = match variable.kind {
                        VariableKind::Revolute => (DIGITS_OF_TURNS, 1.0),
                        VariableKind::Prismatic => (DIGITS_OF_METRES, description.length.in_metres()),
                    };
                    Some(((*place)?, scale.number(*value), decimals(digits, scale.one * unit)))
                };
                joints.filter_map(number).collect()
            };
            for (place, number, decimals) in written {
                let (range, old) = &numbers[place];
                // What is the same when rounded stays as it is written.
                if 2.0 * (number - old).abs() * 10_f64.powi(decimals as i32) > 1.0 {
                    text += &self.text[end..range.start];
                    text += &format!("{number:.decimals$}");
                    end = range.end;
                }
            }
        }
        text += &self.text[end..];
        if self.is_latin { Ok(text.chars().map(|c| c as u8).collect()) } else { Ok(text.into_bytes()) }
    }
}
