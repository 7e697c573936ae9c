//! Completion of inputs that are computed from the rows.

use std::borrow::Cow;

use abbe::Manipulator;
use abbe_spec::Spec;

use super::column::Channel;
use super::from_rows::{in_order, set_input, with_references};
use super::map::Map;
use super::rows::Data;

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
}
