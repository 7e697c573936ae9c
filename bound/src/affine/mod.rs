//! Affine forms: enclosures of a number while names move within their ranges, including all
//! rounding errors.
//!
//! `form` has the form with sums and products; `functions` and `tables` have other operations.

mod form;
mod functions;
mod tables;

pub(crate) use form::{Affine, UNIT, above};
