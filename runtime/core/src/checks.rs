//! Checks of arguments and results that every manipulator makes, generated or interpreted.

#[doc(hidden)]
pub use bytemuck::Zeroable;

use crate::{Description, Error, Input, MINIMUM_MARGIN, Quantity, Scalar};

/// Returns the values of an argument as an array. Fails unless there are exactly as many, all
/// finite, and inputs within their ranges.
pub fn argument<'v, A: FlatArray<f64>>(
    description: &Description,
    quantity: Quantity,
    values: Option<&&'v [f64]>,
) -> Result<&'v A, Error> {
    let values = values.copied().unwrap_or_default();
    let array = A::from_flat(values).ok_or_else(|| count::<A>(quantity, values.len()))?;
    given(description, quantity, values)?;
    Ok(array)
}

/// Returns a result slice as an array. Fails unless it has exactly as many values.
pub fn result<'v, A: FlatArray<f64>>(
    quantity: Quantity,
    values: Option<&'v mut &mut [f64]>,
) -> Result<&'v mut A, Error> {
    let values = values.map(|values| &mut **values).unwrap_or_default();
    let found = values.len();
    A::from_flat_mut(values).ok_or_else(|| count::<A>(quantity, found))
}

/// Checks that the values of an argument are finite, and inputs within their ranges.
pub fn given(description: &Description, quantity: Quantity, values: &[f64]) -> Result<(), Error> {
    finite(quantity, values)?;
    if quantity == Quantity::Inputs { inputs(&description.inputs, values) } else { Ok(()) }
}

/// Array of numbers that a function takes or fills. In a batch it has one row per number.
pub trait FlatArray<T>: Sized {
    /// Number of rows, and of values in each: 6 in a column, 12 in a pose.
    const SHAPE: [usize; 2];

    /// Returns its numbers in memory order.
    fn as_flat(&self) -> &[T];

    /// Returns numbers in memory order as an array, if there are as many.
    fn from_flat(values: &[T]) -> Option<&Self>;

    /// Returns numbers in memory order as an array, if there are as many.
    fn from_flat_mut(values: &mut [T]) -> Option<&mut Self>;

    /// Splits the array off the first numbers of `rest`. Returns `None` if there are too few.
    #[inline(always)]
    fn take<'t>(rest: &mut &'t [T]) -> Option<&'t Self> {
        let (values, others) = rest.split_at_checked(Self::SHAPE[0] * Self::SHAPE[1])?;
        *rest = others;
        Self::from_flat(values)
    }

    /// Splits a mutable array off the first numbers of `rest`. Returns `None` if there are too few.
    #[inline(always)]
    fn fill<'t>(rest: &mut &'t mut [T]) -> Option<&'t mut Self> {
        let (values, others) = core::mem::take(rest).split_at_mut_checked(Self::SHAPE[0] * Self::SHAPE[1])?;
        *rest = others;
        Self::from_flat_mut(values)
    }
}

impl<T: Scalar, const N: usize> FlatArray<T> for [T; N] {
    const SHAPE: [usize; 2] = [N, 1];

    fn as_flat(&self) -> &[T] {
        self
    }

    #[inline(always)]
    fn from_flat(values: &[T]) -> Option<&Self> {
        values.try_into().ok()
    }

    #[inline(always)]
    fn from_flat_mut(values: &mut [T]) -> Option<&mut Self> {
        values.try_into().ok()
    }
}

impl<T: Scalar, const M: usize, const N: usize> FlatArray<T> for [[T; M]; N] {
    const SHAPE: [usize; 2] = [N, M];

    fn as_flat(&self) -> &[T] {
        self.as_flattened()
    }

    #[inline(always)]
    fn from_flat(values: &[T]) -> Option<&Self> {
        let (rows, rest) = values.as_chunks();
        rows.try_into().ok().filter(|_| rest.is_empty())
    }

    #[inline(always)]
    fn from_flat_mut(values: &mut [T]) -> Option<&mut Self> {
        let (rows, rest) = values.as_chunks_mut();
        rows.try_into().ok().filter(|_| rest.is_empty())
    }
}

impl<T: Scalar, const L: usize, const M: usize, const N: usize> FlatArray<T> for [[[T; L]; M]; N] {
    const SHAPE: [usize; 2] = [N, L * M];

    fn as_flat(&self) -> &[T] {
        self.as_flattened().as_flattened()
    }

    #[inline(always)]
    fn from_flat(values: &[T]) -> Option<&Self> {
        let (rows, rest) = values.as_chunks();
        let (planes, others) = rows.as_chunks();
        planes.try_into().ok().filter(|_| rest.is_empty() && others.is_empty())
    }

    #[inline(always)]
    fn from_flat_mut(values: &mut [T]) -> Option<&mut Self> {
        let (rows, rest) = values.as_chunks_mut();
        let (planes, others) = rows.as_chunks_mut();
        planes.try_into().ok().filter(|_| rest.is_empty() && others.is_empty())
    }
}

/// Checks that all values are finite. The error names the first that is not.
pub fn finite(quantity: Quantity, values: &[f64]) -> Result<(), Error> {
    // Branch-free; the search runs only on failure.
    if values.iter().fold(true, |all, value| all & value.is_finite()) {
        return Ok(());
    }
    let index = values.iter().position(|value| !value.is_finite()).unwrap_or(0);
    Err(Error::NotFinite { quantity, index })
}

/// Checks that all values of a result are finite. If the manipulator has loops, values that are not
/// finite mean that these do not close, and infinite passive variables that they exceed a limit.
pub fn result_is_finite(description: &Description, quantity: Quantity, values: &[f64]) -> Result<(), Error> {
    finite(quantity, values).map_err(|error| match values.iter().position(|value| value.is_infinite()) {
        Some(passive) if quantity == Quantity::Passive => Error::PassiveLimit { passive },
        _ if description.has_loops() => Error::NotClosed,
        _ => error,
    })
}

/// Checks that Euler rows exist at the margin `cos ρ` that a generated function returned.
pub fn margin(margin: impl Margin<f64>) -> Result<(), Error> {
    match margin.cosine() {
        None => Ok(()),
        Some(margin) if margin >= MINIMUM_MARGIN => Ok(()),
        Some(margin) => Err(Error::EulerSingularity { margin }),
    }
}

/// Distance of rows 4–6 from a singularity: generated functions return `cos ρ`, or `()` if they
/// have no singularity.
pub trait Margin<T> {
    /// Returns `cos ρ`, or `None` without a singularity.
    fn cosine(self) -> Option<T>;
}

impl<T: Scalar> Margin<T> for T {
    #[inline(always)]
    fn cosine(self) -> Option<T> {
        Some(self)
    }
}

impl<T> Margin<T> for () {
    #[inline(always)]
    fn cosine(self) -> Option<T> {
        None
    }
}

/// Checks that every input is within its range.
pub fn inputs(description: &[Input], u: &[f64]) -> Result<(), Error> {
    for (input, (declared, &value)) in description.iter().zip(u).enumerate() {
        let [lower, upper] = declared.range;
        if !(lower..=upper).contains(&value) {
            return Err(Error::OutOfRange { input, value, range: declared.range });
        }
    }
    Ok(())
}

/// Checks that every joint variable, structural parameter and input is finite, and every input
/// within its range.
pub fn use_case(description: &Description, q: &[f64], s: &[f64], u: &[f64]) -> Result<(), Error> {
    finite(Quantity::Variables, q)?;
    finite(Quantity::Parameters, s)?;
    given(description, Quantity::Inputs, u)
}

/// Returns the error of an array with another number of values.
fn count<A: FlatArray<f64>>(quantity: Quantity, found: usize) -> Error {
    wrong_length(quantity, A::SHAPE, found)
}

/// Checks the number of values of an array, given its number of rows and of values in each.
pub fn length(quantity: Quantity, shape: [usize; 2], found: usize) -> Result<(), Error> {
    if found == shape[0] * shape[1] { Ok(()) } else { Err(wrong_length(quantity, shape, found)) }
}

/// Counts rows where these are whole, and values otherwise.
fn wrong_length(quantity: Quantity, [rows, row]: [usize; 2], found: usize) -> Error {
    let of_one = if row > 0 && found.is_multiple_of(row) { row } else { 1 };
    Error::Count { quantity, expected: rows * row / of_one, found: found / of_one }
}
