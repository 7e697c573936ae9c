//! Completion of inputs that are computed from the rows, and rows at which loops do not close.

use std::borrow::Cow;

use abbe::{Manipulator, analysis::sampling::nominal_parameters, identify::Observation};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_study::{Result, mistake, open_loops::open_loops};

use super::rows::{Data, SHOWN};
use super::{Channel, Map, in_order, set_input, with_references};

impl Map {
    /// Returns whether an input is computed from the rows.
    pub(crate) fn follows_from_rows(&self) -> bool {
        self.inputs.iter().any(|channel| matches!(channel, Channel::FromRows(_)))
    }
}

impl Data {
    /// Returns the rows with computed inputs; `manipulator` is that of the spec.
    pub(crate) fn completed(&self, map: &Map, manipulator: &dyn Manipulator, spec: &Spec) -> Cow<'_, Self> {
        Self::complete(Cow::Borrowed(self), map, manipulator, spec)
    }

    /// Completes rows without copying owned ones.
    pub(crate) fn complete<'d>(
        data: Cow<'d, Self>,
        map: &Map,
        manipulator: &dyn Manipulator,
        spec: &Spec,
    ) -> Cow<'d, Self> {
        if !map.follows_from_rows() {
            return data;
        }
        let mut data = data.into_owned();
        let order = in_order(&data.observations);
        for (input, channel) in map.inputs.iter().enumerate() {
            let Channel::FromRows(follows) = channel else { continue };
            let values = follows.values(manipulator, spec, &with_references(&data.observations, &order));
            set_input(&mut data.observations, &order, input, values);
        }
        Cow::Owned(data)
    }

    /// Moves the rows at which the loops of the nominal machine, or of that with the repeatable
    /// sources of the spec, do not close to the unusable ones.
    ///
    /// Returns an error if no row is left.
    pub(crate) fn closed<'d>(data: Cow<'d, Self>, machine: &Interpreter) -> Result<Cow<'d, Self>> {
        let s = nominal_parameters(machine.description());
        let error = |row: &Observation| {
            let nominal = machine.pose(&row.q, &s).err();
            nominal.or_else(|| machine.real_pose(&row.q, &s, &row.u).err()).filter(abbe::Error::is_open)
        };
        let open: Vec<Option<abbe::Error>> = match machine.spec().loops.is_empty() {
            true => Vec::new(),
            false => data.observations.iter().map(error).collect(),
        };
        if open.iter().all(Option::is_none) {
            return Ok(data);
        }
        let mut data = data.into_owned();
        let rows = std::mem::take(&mut data.observations).into_iter().zip(open);
        let mut explained = 0..SHOWN;
        for (row, error) in rows {
            match error {
                Some(error) => {
                    let further = explained.next().and_then(|_| open_loops(machine.spec(), &row.q, &s));
                    data.leave_out(row.line, &further.unwrap_or_else(|| error.to_string()));
                }
                None => data.observations.push(row),
            }
        }
        if data.observations.is_empty() {
            let why = data.unusable.iter().map(|row| format!("{}: {}", data.place(row.line), row.reason));
            let message = format!("the loops close at none of the rows: {}", why.take(1).collect::<String>());
            let help = "check the units and signs of the joints in the map, and the lengths of the loops";
            Err(mistake::with_help(&data.file, message, help))
        } else {
            Ok(Cow::Owned(data))
        }
    }
}
