//! Short vectors of a row, stored without an allocation.

use std::ops::{Deref, DerefMut};

use smallvec::SmallVec;

/// Values of the joints, stored inline up to six.
pub type Values = SmallVec<[f64; 6]>;

/// Values of the inputs. Most machines have none.
pub type Inputs = Box<[f64]>;

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
