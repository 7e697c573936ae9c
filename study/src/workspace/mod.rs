//! The configurations that a study or a plan asks for: `[workspace]`.
//!
//! `region` is what is asked for; `forms` reads its forms, `axis` the values of a variable or parameter, `path` a file of
//! configurations, `constant` single values; `span` is the box that contains them all.

mod axis;
mod constant;
mod forms;
mod keys;
mod path;
mod region;
mod span;

pub use axis::Candidates;
pub use constant::{constant, count, positive_length, whole};
pub use forms::read_region;
pub use keys::TABLES;
pub use path::Path;
pub use region::{Form, Region, has_range};
pub use span::{Span, name};
