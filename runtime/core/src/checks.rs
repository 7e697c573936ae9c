//! Checks of arguments and results that every manipulator makes, generated or interpreted.

use crate::{Description, Error, Input, MINIMUM_MARGIN, Quantity, Scalar};

/// Returns the values of an argument as an array. Fails unless there are exactly `N`, all finite,
/// and inputs within their ranges.
pub fn argument<'v, const N: usize>(
    description: &Description,
    quantity: Quantity,
    values: &'v [f64],
) -> Result<&'v [f64; N], Error> {
    let array = values.try_into().map_err(|_| count(quantity, N, values.len()))?;
    given(description, quantity, values)?;
    Ok(array)
}

/// Returns a result slice as an array. Fails unless it holds exactly `N` values.
pub fn result<T, const N: usize>(quantity: Quantity, values: &mut [T]) -> Result<&mut [T; N], Error> {
    let found = values.len();
    values.try_into().map_err(|_| count(quantity, N, found))
}

/// Returns the errors of the frames as an array. Fails unless there are exactly `N` frames.
pub fn frames<const N: usize>(errors: &[[f64; 6]]) -> Result<&[[f64; 6]; N], Error> {
    errors.try_into().map_err(|_| count(Quantity::Errors, N, errors.len()))
}

/// Checks that the values of an argument are finite, and inputs within their ranges.
pub fn given(description: &Description, quantity: Quantity, values: &[f64]) -> Result<(), Error> {
    finite(quantity, values)?;
    if quantity == Quantity::Inputs { inputs(&description.inputs, values) } else { Ok(()) }
}

/// Array that a function takes or fills.
pub trait FlatArray {
    /// Array of zeros.
    const ZERO: Self;

    /// Returns its numbers in memory order.
    fn as_flat(&self) -> &[f64];
}

impl<const N: usize> FlatArray for [f64; N] {
    const ZERO: Self = [0.0; N];

    fn as_flat(&self) -> &[f64] {
        self
    }
}

impl<const M: usize, const N: usize> FlatArray for [[f64; M]; N] {
    const ZERO: Self = [[0.0; M]; N];

    fn as_flat(&self) -> &[f64] {
        self.as_flattened()
    }
}

impl<const L: usize, const M: usize, const N: usize> FlatArray for [[[f64; L]; M]; N] {
    const ZERO: Self = [[[0.0; L]; M]; N];

    fn as_flat(&self) -> &[f64] {
        self.as_flattened().as_flattened()
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
/// finite mean that these do not close.
pub fn result_is_finite(description: &Description, quantity: Quantity, values: &[f64]) -> Result<(), Error> {
    finite(quantity, values).map_err(|error| if description.has_loops() { Error::NotClosed } else { error })
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

fn count(quantity: Quantity, expected: usize, found: usize) -> Error {
    Error::Count { quantity, expected, found }
}
