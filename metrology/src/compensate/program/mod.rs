//! Programs of robots: their positions and joint targets are read, and written corrected. All other
//! text stays as it is.

mod languages;

use std::f64::consts::TAU;
use std::ops::Range;
use std::path::{Path, PathBuf};

use abbe::analysis::InverseKinematics;
use abbe::analysis::sampling::vectors::{cross, dot, norm, subtract};
use abbe::analysis::sampling::{self, JointAxis};
use abbe::identify::Observation;
use abbe::{Description, LengthUnit, Manipulator, Pose, Variable, VariableKind};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_spec::bounded::{Bounded, UnreadableFile};
use abbe_spec::option::FRAME;
use abbe_study::{Notes, Result, mistake, number};
use regex_lite::Captures;

use super::Row;
use crate::data::{Channel, Data, Map, Scale, Unusable, from_numbers, to_numbers};
use languages::{BORDER, Fact, LANGUAGES, Language};

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
    /// Facts that its configuration states.
    facts: Vec<Fact>,
    /// Places of its numbers.
    stated: Vec<Range<usize>>,
    numbers: Vec<(Range<usize>, f64)>,
}

/// Place of a joint among the numbers of a joint target, and its scale; no place for a constant,
/// the zero of its scale.
type JointChannel = (Option<usize>, Scale);

/// Rotation of a joint by which its axis is found, in rad.
const STEP: f64 = 0.1;
/// Number of lines of a position.
const LINES_OF_A_POSITION: usize = 4;
/// Sine below which an arm is stretched.
const STRETCHED: f64 = 1e-3;

/// Returns on which side of axis 1, and of the lower arm, the center of the wrist is, the latter
/// about axes 2 and 3: sines whose signs change where the arm passes from one configuration into
/// another; `None` unless the first five joints turn.
fn sides(machine: &dyn Manipulator, q: &[f64]) -> Option<[f64; 3]> {
    let s = sampling::nominal_parameters(machine.description());
    let here = machine.pose(q, &s).ok()?.inverse();
    let axis = |i: usize| {
        let mut turned = q.to_vec();
        *turned.get_mut(i)? += STEP;
        let axis = JointAxis::of_motion(&machine.pose(&turned, &s).ok()?.then(&here));
        Some((axis, axis.point?))
    };
    let [(first, foot), (second, shoulder), (third, elbow), (fourth, wrist), (fifth, _)] =
        [axis(0)?, axis(1)?, axis(2)?, axis(3)?, axis(4)?];
    let center = fourth.nearest(fifth.nearest(wrist));
    let (reach, upper, lower) = (subtract(center, foot), subtract(elbow, shoulder), subtract(center, elbow));
    Some([
        dot(cross(first.direction, second.direction), reach) / norm(reach),
        dot(cross(upper, lower), second.direction) / (norm(upper) * norm(lower)),
        dot(cross(upper, lower), third.direction) / (norm(upper) * norm(lower)),
    ])
}

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

/// Warns of lines, if there are any.
fn warn_of(lines: &[usize], text: &str, notes: &mut dyn Notes) {
    let named: Vec<String> = lines.iter().take(NAMED).map(usize::to_string).collect();
    if !named.is_empty() {
        let more = lines.len() - named.len();
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        notes.warn(&format!("{text}: line {}{more}", named.join(", ")));
    }
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
        let Some([pose, joints, elsewhere, relative, frame, configuration]) = patterns else {
            return Ok(None);
        };
        let starts: Vec<usize> =
            std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at + 1)).collect();
        let line = |at: usize| starts.partition_point(|start| *start <= at);
        let before = |at: usize| &text[starts[line(at) - 1]..at];
        // Returns the start of what is not in a comment.
        let start = |found: &Captures<'_>| {
            let at = found.get(0)?.start();
            (!before(at).contains(language.comment)).then_some(at)
        };
        // Returns the places of the configuration of a position: behind it, or before it since its
        // bracket.
        let stated = |found: &Captures<'_>, at: usize| -> Vec<Range<usize>> {
            let since = starts[line(at).saturating_sub(LINES_OF_A_POSITION)];
            let (from, to) = match (language.is_configured_behind(), found.get(0)) {
                (true, Some(all)) => (all.end(), text.len()),
                _ => (text[since..at].rfind('{').map_or(at, |bracket| since + bracket), at),
            };
            let groups = configuration.captures(&text[from..to]);
            let all = groups.iter().flat_map(Captures::iter).skip(1).flatten();
            all.map(|one| from + one.start()..from + one.end()).collect()
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
                let stated = if is_pose { stated(&found, at) } else { Vec::new() };
                let groups: Vec<&str> = stated.iter().map(|range| &text[range.clone()]).collect();
                let facts = if groups.is_empty() { Vec::new() } else { (language.facts)(&groups) };
                let (line, numbers) = (line(at) as u64, numbers.collect());
                points.push(Point { line, is_pose, facts, stated, numbers });
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
    /// nominal joints that have most of the configuration it states, of those the nearest to the
    /// joints before, from home. `frame` is the pose in `F_0` of the frame of positions.
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
        let zero: Vec<f64> = channels.iter().map(|(_, scale)| scale.value(0.0)).collect();
        let (zero, mut others) = (sides(machine, &zero), Vec::new());
        let mut last = sampling::home(description);
        let mut data =
            Data { file: self.path.display().to_string(), files: vec![self.path.clone()], ..Data::default() };
        for (index, point) in self.points.iter().enumerate() {
            let found = match point.is_pose {
                true => self.pose(point, description.length).and_then(|pose| {
                    let pose = frame.map_or(pose, |frame| frame.then(&pose));
                    let inverse = inverse.as_ref().map_err(ToString::to_string)?;
                    let all = inverse.solve(&last, &pose).map_err(|error| error.to_string())?;
                    let count = |q: &Vec<f64>| {
                        let here = if point.facts.is_empty() { None } else { sides(machine, q) };
                        self.disagreements(&point.facts, q, &channels, here.zip(zero))
                    };
                    let (least, q) = all
                        .into_iter()
                        .map(|mut q| {
                            self.turn(&mut q, &point.facts, &channels, description);
                            (count(&q), q)
                        })
                        .min_by_key(|(count, _)| *count)
                        .ok_or_else(|| "out of reach".to_owned())?;
                    if least > 0 {
                        others.push(point.line as usize);
                    }
                    Ok(q)
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
        let text = "no joints of the nominal machine have all of the configuration that stands there; those that \
                    have most of it are taken";
        warn_of(&others, text, notes);
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

    /// Counts the facts that do not hold for joints; `sides` are those of these joints, and where
    /// the joints of the controller are 0.
    fn disagreements(
        &self,
        facts: &[Fact],
        q: &[f64],
        channels: &[JointChannel],
        sides: Option<([f64; 3], [f64; 3])>,
    ) -> usize {
        // Nothing is told apart from an arm that is stretched where its joints are 0.
        let is_other = |i: usize| {
            sides.filter(|(_, zero)| zero[i].abs() > STRETCHED).map(|(here, zero)| here[i] * zero[i] < 0.0)
        };
        let holds = |fact: &Fact| match *fact {
            Fact::Quadrant(joint, _) | Fact::Negative(joint, _) => {
                self.angle(q, channels, joint).map(|angle| fact.holds(angle, BORDER))
            }
            Fact::Behind(is) => is_other(0).map(|other| other == is),
            Fact::Bent(is) => {
                let joint = channels.iter().find(|(place, _)| *place == Some(2));
                sides.zip(joint).map(|((here, _), (_, scale))| (here[2] * scale.one > 0.0) == is)
            }
            Fact::Below(is) => is_other(1).map(|other| other == is),
        };
        facts.iter().filter(|fact| holds(fact) == Some(false)).count()
    }

    /// Returns the angle of a joint of the controller in degrees.
    fn angle(&self, q: &[f64], channels: &[JointChannel], joint: usize) -> Option<f64> {
        let i = channels.iter().position(|(place, _)| *place == Some(joint))?;
        Some(channels[i].1.number(q[i]) * self.language.radians.to_degrees())
    }

    /// Turns joints by a whole turn whose sign is another than that stated, where their limits
    /// permit.
    fn turn(&self, q: &mut [f64], facts: &[Fact], channels: &[JointChannel], description: &Description) {
        for fact in facts {
            let Fact::Negative(joint, is) = *fact else { continue };
            let Some(i) = channels.iter().position(|(place, _)| *place == Some(joint)) else { continue };
            let turn = if (channels[i].1.one < 0.0) == is { TAU } else { -TAU };
            let [lower, upper] = description.variables[i].limits;
            let is_other = self.angle(q, channels, joint).is_some_and(|angle| !fact.holds(angle, BORDER));
            if is_other && (lower..=upper).contains(&(q[i] + turn)) {
                q[i] += turn;
            }
        }
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
        let is_free = |point: &Point| point.is_pose && point.facts.is_empty();
        let first = data.observations.first().filter(|row| is_free(&self.points[row.configuration as usize]));
        if let Some(row) = first {
            notes.note(&format!(
                "line {}: the first position is reached with {}, the joints nearest to `home` of the spec; \
                 those after it with the joints nearest to the ones before",
                row.line,
                number::variables(&row.q, spec)
            ));
        }
        warn_of(&self.left, "left as they are, as steps, frames, tools or incomplete positions", notes);
    }

    /// Returns the program with the numbers of corrected commands, in the bytes of its file. Of
    /// positions that are not among the rows, the numbers stay. A configuration is changed where a
    /// corrected joint is beyond a border of it.
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
            let Point { is_pose, facts, stated, numbers, .. } =
                &self.points[row.corrected.configuration as usize];
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
            let commanded: Vec<f64> = q.iter().zip(&row.changes).map(|(q, change)| q - change).collect();
            let angle = |q: &[f64], joint| self.angle(q, &channels, joint);
            let restated: Vec<Fact> =
                facts.iter().map(|fact| fact.beyond(|j| angle(&commanded, j), |j| angle(q, j))).collect();
            if restated != *facts {
                for (range, new) in stated.iter().zip((self.language.restated)(&restated)) {
                    let Some(new) = new else { continue };
                    text += &self.text[end..range.start];
                    text += &new;
                    end = range.end;
                }
            }
        }
        text += &self.text[end..];
        if self.is_latin { Ok(text.chars().map(|c| c as u8).collect()) } else { Ok(text.into_bytes()) }
    }
}
