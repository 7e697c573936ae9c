//! Result of jobs, and of reading their input.

use abbe_spec::Diagnostics;

/// A result whose error, unless another one is named, is [`Diagnostics`]: it names the file or
/// option, and the place.
pub type Result<T, E = Diagnostics> = std::result::Result<T, E>;
