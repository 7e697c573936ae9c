//! Reads the written spec back: its position errors on the rows of the fit.

use std::{borrow::Cow, path::Path};

use abbe::identify::Figures;
use abbe_interpreter::Interpreter;
use abbe_spec::{Diagnostics, Spec};

use super::{Derived, FoundModel, Setup};
use crate::data::{Data, Map, change_with_reference};
use abbe_study::{About, Machine, Result, number};

/// Relative difference of two root mean squares that are the same: written values are rounded, and
/// numbers of the chain replace errors of frames to first order.
const SAME: f64 = 0.01;

/// The written spec, and its errors.
pub(super) struct ReadBack {
    /// Machine of the written spec.
    pub(super) machine: Interpreter,
    /// Position errors that it leaves on the rows of the fit, without outliers.
    pub(super) figures: Figures,
}

/// Reads the written spec and map back, and compares them with the rows of the fit that `is_kept`
/// accepts. Returns none if the text of the nominal spec is not at hand or the placement cannot be
/// written.
pub(super) fn read_back(
    found: &FoundModel,
    machine: &Machine,
    map: &Map,
    data: &Data,
    is_kept: impl Fn(usize) -> bool + Sync,
) -> Result<Option<ReadBack>> {
    // Changes of the machine are not part of its text.
    let text = machine.text().ok().filter(|_| !machine.is_changed());
    let Some(text) = text else { return Ok(None) };
    let path = machine.file.as_deref().unwrap_or(Path::new(&machine.origin));
    let name = path.display().to_string();
    let spec = &machine.spec;
    // What cannot be written is an error where it is written.
    let Ok(written) = found.identified_spec(spec, &text, &name) else { return Ok(None) };
    let written = Spec::parse_in(path.parent().unwrap_or(Path::new("")), &name, &written.text)?;
    let Ok(map) = found.identified_map(map, spec, &name) else { return Ok(None) };
    let map = Map::parse(&name, &map, &written)?;
    let data = found.as_written(spec, data);
    let machine = Interpreter::new(written);
    let setup = Setup::new(&machine, &map, &data, 0)?;
    let left = setup.real.distances_where(&data.observations, |i| is_kept(i).then_some(&[][..]));
    let figures = left.about(&data.file)?.into_figures();
    Ok(Some(ReadBack { machine, figures }))
}

impl ReadBack {
    /// Returns whether the errors differ from those that the fit leaves, by more than the
    /// uncertainty of the instrument resolves.
    pub(super) fn differs(&self, [fit, uncertainty]: [f64; 2]) -> bool {
        (self.figures.rms - fit).abs() > SAME * fit.max(uncertainty)
    }
}

/// Returns the note that the written spec could not be read back.
pub(super) fn not_read_back(mistake: &Diagnostics) -> String {
    let reason = mistake.list.first().map_or("", |first| &first.message);
    format!("note: the written spec was not read back on the rows of the fit: {reason}")
}

impl FoundModel {
    /// Returns the rows with the inputs of the written spec: those of the spec and the derived ones
    /// that its terms need.
    pub(super) fn as_written<'d>(&self, spec: &Spec, data: &'d Data) -> Cow<'d, Data> {
        if self.derived.is_empty() {
            return Cow::Borrowed(data);
        }
        let index = |one: &Derived| self.derived.iter().position(|other| other == one);
        let derived = self.needed(spec).into_iter().filter_map(index).map(|i| spec.inputs.len() + i);
        let inputs: Vec<usize> = (0..spec.inputs.len()).chain(derived).collect();
        let mut data = data.clone();
        for row in &mut data.observations {
            change_with_reference(row, |row| {
                row.u = inputs.iter().filter_map(|i| row.u.get(*i)).copied().collect::<Vec<f64>>().into();
            });
        }
        Cow::Owned(data)
    }

    /// Returns a note if the written spec leaves other errors on the rows of the fit than the fit
    /// does, by more than the uncertainty of the instrument resolves.
    pub(super) fn read_back_note(
        &self,
        spec: &Spec,
        written: &ReadBack,
        [fit, uncertainty]: [f64; 2],
    ) -> Option<String> {
        if !written.differs([fit, uncertainty]) {
            return None;
        }
        let length = |value| number::length(value, spec.length);
        let reason = match self.terms.iter().all(|one| self.is_expressible(spec, one)) {
            true => "",
            false => ", because terms that depend on the order of these rows are not written",
        };
        Some(format!(
            "note: on the rows of the fit, the written spec leaves a root mean square error of {}, the \
             fit one of {}{reason}",
            length(written.figures.rms),
            length(fit)
        ))
    }
}
