//! Affine forms: what a number can be while names move within their ranges, with all roundings covered.
//!
//! `form` has the form itself, with sums and products; `functions` and `tables` what is done to it.

mod form;
mod functions;
mod tables;

pub(crate) use form::{Affine, UNIT, above};
