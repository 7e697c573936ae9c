//! What every manipulator checks, generated or interpreted, before and after its arithmetic.

use crate::{Description, Error, Input, MINIMUM_MARGIN, Quantity, Scalar};

/// The values of an argument as an array, if there are exactly `N` and a function can be given them.
pub fn argument<'v, const N: usize>(
    description: &Description,
    quantity: Quantity,
    values: &'v [f64],
) -> Result<&'v [f64; N], Error> {
    let array = values.try_into().map_err(|_| count(quantity, N, values.len()))?;
    given(description, quantity, values)?;
    Ok(array)
}

/// A result slice as an array to be filled, if it holds exactly `N`.
pub fn result<T, const N: usize>(quantity: Quantity, values: &mut [T]) -> Result<&mut [T; N], Error> {
    let found = values.len();
    values.try_into().map_err(|_| count(quantity, N, found))
}

/// Whether the numbers of an argument are finite, and, if they are inputs, within their ranges.
pub fn given(description: &Description, quantity: Quantity, values: &[f64]) -> Result<(), Error> {
    finite(quantity, values)?;
    if quantity == Quantity::Inputs { inputs(&description.inputs, values) } else { Ok(()) }
}

/// An array that a function takes or fills.
pub trait Numbers {
    /// Zeros.
    const ZERO: Self;

    /// Its numbers, one after the other.
    fn numbers(&self) -> &[f64];
}

impl<const N: usize> Numbers for [f64; N] {
    const ZERO: Self = [0.0; N];

    fn numbers(&self) -> &[f64] {
        self
    }
}

impl<const M: usize, const N: usize> Numbers for [[f64; M]; N] {
    const ZERO: Self = [[0.0; M]; N];

    fn numbers(&self) -> &[f64] {
        self.as_flattened()
    }
}

impl<const L: usize, const M: usize, const N: usize> Numbers for [[[f64; L]; M]; N] {
    const ZERO: Self = [[[0.0; L]; M]; N];

    fn numbers(&self) -> &[f64] {
        self.as_flattened().as_flattened()
    }
}

/// Whether all values are finite; if not, which is the first that is not.
pub fn finite(quantity: Quantity, values: &[f64]) -> Result<(), Error> {
    // Without branches; taken apart only where something is wrong.
    if values.iter().fold(true, |all, value| all & value.is_finite()) {
        return Ok(());
    }
    let index = values.iter().position(|value| !value.is_finite()).unwrap_or(0);
    Err(Error::NotFinite { quantity, index })
}

/// Whether Euler rows exist at the margin `cos ρ` that a generated function returned.
pub fn margin(margin: impl Margin<f64>) -> Result<(), Error> {
    match margin.cosine() {
        None => Ok(()),
        Some(margin) if margin >= MINIMUM_MARGIN => Ok(()),
        Some(margin) => Err(Error::EulerSingularity { margin }),
    }
}

/// How far rows 4–6 are from a singularity: generated functions return `cos ρ`, or nothing where there is none.
pub trait Margin<T> {
    /// `cos ρ`, where there is one.
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

/// Whether every input is within its range.
pub fn inputs(description: &[Input], u: &[f64]) -> Result<(), Error> {
    for (input, (declared, &value)) in description.iter().zip(u).enumerate() {
        let [lower, upper] = declared.range;
        if !(lower..=upper).contains(&value) {
            return Err(Error::OutOfRange { input, value, range: declared.range });
        }
    }
    Ok(())
}

/// Whether every joint variable, structural parameter and input is finite, and every input within its range.
pub fn use_case(description: &Description, q: &[f64], s: &[f64], u: &[f64]) -> Result<(), Error> {
    finite(Quantity::Variables, q)?;
    finite(Quantity::Parameters, s)?;
    given(description, Quantity::Inputs, u)
}

fn count(quantity: Quantity, expected: usize, found: usize) -> Error {
    Error::Count { quantity, expected, found }
}
