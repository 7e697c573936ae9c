//! Short vectors of a row, stored without an allocation.

use std::ops::{Deref, DerefMut};

/// Capacity of the inline storage.
const FEW: usize = 7;

/// Values of the joints: a slice of numbers, stored inline up to seven.
#[derive(Clone, Debug, PartialEq)]
pub struct Values(Kept);

#[derive(Clone, Debug, PartialEq)]
enum Kept {
    Few(u8, [f64; FEW]),
    Many(Box<[f64]>),
}

impl Deref for Values {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        match &self.0 {
            Kept::Few(count, values) => &values[..usize::from(*count)],
            Kept::Many(values) => values,
        }
    }
}

impl DerefMut for Values {
    fn deref_mut(&mut self) -> &mut [f64] {
        match &mut self.0 {
            Kept::Few(count, values) => &mut values[..usize::from(*count)],
            Kept::Many(values) => values,
        }
    }
}

impl From<&[f64]> for Values {
    fn from(values: &[f64]) -> Self {
        if values.len() > FEW {
            return Self(Kept::Many(values.into()));
        }
        let mut few = [0.0; FEW];
        few[..values.len()].copy_from_slice(values);
        Self(Kept::Few(values.len() as u8, few))
    }
}

impl From<Vec<f64>> for Values {
    fn from(values: Vec<f64>) -> Self {
        Self::from(&values[..])
    }
}

/// Values of the inputs: a slice of numbers. Most machines have none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Inputs(Option<Box<Box<[f64]>>>);

impl Deref for Inputs {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        self.0.as_ref().map_or(&[], |values| values)
    }
}

impl DerefMut for Inputs {
    fn deref_mut(&mut self) -> &mut [f64] {
        self.0.as_mut().map_or(&mut [], |values| values)
    }
}

impl From<Vec<f64>> for Inputs {
    fn from(values: Vec<f64>) -> Self {
        Self((!values.is_empty()).then(|| Box::new(values.into())))
    }
}

/// Positions of the targets, none where one was hidden: a slice of points, a single one stored
/// inline.
#[derive(Clone, Debug, PartialEq)]
pub struct Points(Seen);

#[derive(Clone, Debug, PartialEq)]
enum Seen {
    One(Option<[f64; 3]>),
    Many(Box<[Option<[f64; 3]>]>),
}

impl Deref for Points {
    type Target = [Option<[f64; 3]>];

    fn deref(&self) -> &[Option<[f64; 3]>] {
        match &self.0 {
            Seen::One(point) => std::slice::from_ref(point),
            Seen::Many(points) => points,
        }
    }
}

impl DerefMut for Points {
    fn deref_mut(&mut self) -> &mut [Option<[f64; 3]>] {
        match &mut self.0 {
            Seen::One(point) => std::slice::from_mut(point),
            Seen::Many(points) => points,
        }
    }
}

impl From<Vec<Option<[f64; 3]>>> for Points {
    fn from(points: Vec<Option<[f64; 3]>>) -> Self {
        match points[..] {
            [point] => Self(Seen::One(point)),
            _ => Self(Seen::Many(points.into())),
        }
    }
}

impl FromIterator<Option<[f64; 3]>> for Points {
    fn from_iter<I: IntoIterator<Item = Option<[f64; 3]>>>(points: I) -> Self {
        points.into_iter().collect::<Vec<_>>().into()
    }
}

#[cfg(test)]
mod tests;
