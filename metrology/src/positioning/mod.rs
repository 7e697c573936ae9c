//! `abbe positioning`: evaluates runs of one axis by ISO 230-2, of body diagonals by ISO 230-6, or
//! of circles by ISO 230-4.
//!
//! `evaluation` has the formulas of lines, `circle` those of circles.

mod circle;
mod evaluation;

use abbe_spec::option::{ACCEPT, NamedOption, READING_UNCERTAINTY, SCALE_UNCERTAINTY};
use std::path::Path;

use abbe::LengthUnit;
use abbe_spec::expr::Dimension;
use serde::Serialize;

use crate::acceptance::{AcceptanceVerdict, Judged, LimitCheck, ONE_SIDED_95, read_limits};
use crate::data::{Runs, Source, Table, TargetRuns, runs};
use abbe_study::{Notes, Result, finite, mistake, options::quantity};

pub use circle::{CircularPath, CircularResult};
pub use evaluation::{
    ApproachResult, Bidirectional, Characteristic, Evaluation, InstrumentUncertainty, PositionResult,
    Unidirectional,
};

/// Number of approaches in each direction that ISO 230-2 evaluates.
const APPROACHES: usize = 5;

/// Job that evaluates runs.
pub struct Positioning<'a> {
    /// Runs: a CSV file, or its columns.
    pub data: Source<'a>,
    /// Standard uncertainty of one reading, such as `0.1 um`.
    pub reading: Option<String>,
    /// Standard uncertainty of the scale of the instrument, such as `1 um/m`.
    pub scale: Option<String>,
    /// Limits of characteristics, such as `A 10 um, B 3 um`.
    pub accept: Option<String>,
}

/// Results of one axis, or of several diagonals. Positions are in mm or deg, deviations in um or
/// arcsec.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Name of the file, or of columns in memory.
    pub file: String,
    /// Unit of deviations and characteristics: `um` or `arcsec`.
    pub unit: &'static str,
    /// Unit of positions: `mm` or `deg`.
    pub position_unit: &'static str,
    /// Smallest and largest number of approaches of a position in one direction.
    pub approaches: [usize; 2],
    /// Standard uncertainties of the instrument: of a reading in `unit`, of the scale in `unit` by
    /// `position_unit`; none if they are not stated.
    pub instrument: Option<[f64; 2]>,
    /// Results of the axis, or of each diagonal.
    pub lines: Vec<PositioningLine>,
    /// Results of all diagonals together; none for an axis.
    pub diagonals: Option<DiagonalResult>,
    /// Results of a circular test; none for positions.
    pub circle: Option<CircularResult>,
    /// Verdict by the limits, in `unit`; none without limits.
    pub accepted: Option<AcceptanceVerdict>,
}

/// Results of an axis or a diagonal.
#[derive(Clone, Debug, Serialize)]
pub struct PositioningLine {
    /// Name of the diagonal; empty for an axis.
    pub name: String,
    /// Results.
    #[serde(flatten)]
    pub evaluation: Evaluation,
}

/// Largest characteristics of all body diagonals.
#[derive(Clone, Debug, Serialize)]
pub struct DiagonalResult {
    /// Diagonal systematic deviation of positioning `E_d`: the largest `E`; none unless all
    /// diagonals have both directions.
    pub systematic: Option<Characteristic>,
    /// Diagonal reversal error `B_d`: the largest `B`.
    pub reversal: Option<Characteristic>,
}

impl Positioning<'_> {
    /// Reads and evaluates the runs.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report> {
        let Runs { is_rotary, is_circle, lines } = runs(self.data)?;
        if is_circle && self.scale.is_some() {
            let message = format!("`{SCALE_UNCERTAINTY}` is not used for circles");
            return Err(mistake::with_help(SCALE_UNCERTAINTY, message, "leave it out"));
        }
        let instrument = self.instrument(is_rotary)?;
        let counts = lines.iter().flat_map(|(_, targets)| targets).flat_map(|target| &target.deviations);
        let counts = counts.map(Vec::len).filter(|count| *count > 0);
        let approaches =
            counts.fold([usize::MAX, 0], |[least, most], count| [least.min(count), most.max(count)]);
        let is_axis = lines.iter().all(|(name, _)| name.is_empty());
        if is_axis && !is_circle && approaches[0] < APPROACHES {
            notes.warn(&format!(
                "ISO 230-2 evaluates {APPROACHES} approaches of each position in each direction; here \
                 there are {}",
                match approaches {
                    [least, most] if least == most => least.to_string(),
                    [least, most] => format!("{least} to {most}"),
                }
            ));
        }
        let circle = |(_, targets): &(String, Vec<TargetRuns>)| {
            let found = CircularResult::new(targets, instrument.map(|own| own.reading));
            found.ok_or_else(|| {
                let message = "a direction has fewer than four angles, or none in half of the circle or more";
                let help = "measure at angles all around, or at 220° and more";
                mistake::with_help(self.data.name(), message.to_owned(), help)
            })
        };
        let circle = lines.first().filter(|_| is_circle).map(circle).transpose()?;
        let line = |(name, targets): (String, Vec<TargetRuns>)| PositioningLine {
            name,
            evaluation: match is_circle {
                true => Evaluation::of_positions(&targets),
                false => Evaluation::new(&targets, instrument),
            },
        };
        let lines: Vec<PositioningLine> = lines.into_iter().map(line).collect();
        let mut report = Report {
            file: match self.data.file().and_then(Path::file_name) {
                Some(name) => name.to_string_lossy().into_owned(),
                None => self.data.name(),
            },
            unit: if is_rotary { "arcsec" } else { "um" },
            position_unit: if is_rotary || is_circle { "deg" } else { "mm" },
            approaches,
            instrument: instrument.map(|InstrumentUncertainty { reading, scale }| [reading, scale]),
            diagonals: (!is_axis).then(|| DiagonalResult::new(&lines)),
            lines,
            circle,
            accepted: None,
        };
        if let Some(limits) = &self.accept {
            report.accepted = report.verdict(limits, is_rotary)?;
        }
        finite(self.data.name(), report)
    }

    /// Reads the uncertainties of the instrument, in um or arcsec and in these by mm or deg.
    fn instrument(&self, is_rotary: bool) -> Result<Option<InstrumentUncertainty>> {
        if self.reading.is_none() && self.scale.is_none() {
            return Ok(None);
        }
        let value = |option: &NamedOption, text: &Option<String>, dimension: Dimension| {
            let Some(text) = text else { return Ok(0.0) };
            let name = format!("`{option}`");
            let value = quantity(option, text, LengthUnit::Millimetre, dimension, &name)?;
            if value < 0.0 {
                let help = "give a standard uncertainty: 0 or more";
                return Err(mistake::with_help(option, format!("{name} is negative"), help));
            }
            Ok(value)
        };
        let dimension = if is_rotary { Dimension::NONE } else { Dimension::LENGTH };
        let reading = value(&READING_UNCERTAINTY, &self.reading, dimension)?;
        let scale = value(&SCALE_UNCERTAINTY, &self.scale, Dimension::NONE)?;
        Ok(Some(match is_rotary {
            true => InstrumentUncertainty { reading: 3600.0 * reading.to_degrees(), scale: 3600.0 * scale },
            false => InstrumentUncertainty { reading: 1e3 * reading, scale: 1e3 * scale },
        }))
    }
}

impl DiagonalResult {
    fn new(lines: &[PositioningLine]) -> Self {
        let largest = |one: fn(&Bidirectional) -> Characteristic| {
            let all: Option<Vec<Characteristic>> =
                lines.iter().map(|line| line.evaluation.bidirectional.as_ref().map(one)).collect();
            all?.into_iter().max_by(|a, b| a.value.total_cmp(&b.value))
        };
        Self { systematic: largest(|both| both.systematic), reversal: largest(|both| both.reversal) }
    }
}

impl Report {
    /// Returns the characteristics by their letters: of an axis in both directions or, if the runs
    /// have one, in that; of diagonals the largest. `None` for one that is not known.
    pub fn figures(&self) -> Vec<(&'static str, Option<Characteristic>)> {
        if let Some(circle) = &self.circle {
            let one = circle.forward.or(circle.reverse).map(|path| path.circularity);
            return vec![("G", circle.circularity.or(one)), ("H", circle.hysteresis)];
        }
        let first = self.lines.first().map(|line| &line.evaluation);
        let both = first.and_then(|evaluation| evaluation.bidirectional.as_ref());
        match (&self.diagonals, both, first.and_then(|first| first.forward.or(first.reverse))) {
            (Some(all), ..) => vec![("E_d", all.systematic), ("B_d", all.reversal)],
            (None, Some(both), _) => vec![
                ("A", both.accuracy),
                ("E", Some(both.systematic)),
                ("M", Some(both.mean)),
                ("R", both.repeatability),
                ("B", Some(both.reversal)),
            ],
            (None, None, Some(one)) => {
                vec![("A", one.accuracy), ("E", Some(one.systematic)), ("R", one.repeatability)]
            }
            (None, None, None) => Vec::new(),
        }
    }

    /// Compares characteristics with limits such as `A 10 um, B 3 um`.
    fn verdict(&self, text: &str, is_rotary: bool) -> Result<Option<AcceptanceVerdict>> {
        let figures = self.figures();
        let names: Vec<&str> = figures.iter().map(|(name, _)| *name).collect();
        let (dimension, factor, example) = match is_rotary {
            true => (Dimension::NONE, 3600.0_f64.to_degrees(), "E 10 arcsec, B 3 arcsec"),
            false if self.circle.is_some() => (Dimension::LENGTH, 1e3, "G 10 um, H 3 um"),
            false => (Dimension::LENGTH, 1e3, "E 10 um, B 3 um"),
        };
        let option = ACCEPT.to_string();
        let unit = (LengthUnit::Millimetre, dimension);
        let limits = read_limits(&option, text, |_| false, &names, unit, (example, ""))?;
        let check = |(name, limit): (&'static str, f64)| {
            let found = figures.iter().find(|(figure, _)| *figure == name).and_then(|(_, value)| *value);
            let Some(Characteristic { value, uncertainty }) = found else {
                let help = "approach each position twice or more, or read each angle in both directions";
                return Err(mistake::with_help(
                    &option,
                    format!("{name} is not known: readings are missing"),
                    help,
                ));
            };
            // The expanded uncertainty has k = 2 on both sides.
            let uncertainty = ONE_SIDED_95 * uncertainty.unwrap_or_default() / 2.0;
            Ok(LimitCheck::new(name, factor * limit, value, uncertainty))
        };
        let limits = limits.into_iter().map(check).collect::<Result<_>>()?;
        Ok(AcceptanceVerdict::new((Judged::Machine, "the runs"), limits))
    }

    /// Returns the mean deviations of an axis at its positions, for a table of a spec: of both
    /// directions together and of each; `None` for diagonals and circles.
    pub fn table(&self) -> Option<Table> {
        let ([line], None) = (&self.lines[..], &self.circle) else { return None };
        let rows = line.evaluation.positions.iter().map(|one| {
            let [up, down] = [one.forward, one.reverse].map(|own| own.map(|own| own.mean));
            vec![Some(one.position), one.mean.or(up).or(down), up, down]
        });
        let units = [self.position_unit, self.unit, self.unit, self.unit];
        Some(Table {
            heading: ["position", "deviation", "forward", "reverse"].map(str::to_owned).to_vec(),
            units: units.map(str::to_owned).to_vec(),
            rows: rows.collect(),
            ..Table::default()
        })
    }
}
