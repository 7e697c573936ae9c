//! Configurations of a study or a plan: `[workspace]`.
//!
//! `region` is the definition of a workspace. `forms` reads its forms, `axis` the values of a
//! variable or parameter, `path` a file of configurations, `platform` legs from poses, and
//! `constant` single values. `span` computes the enclosing box.

mod axis;
mod choices;
mod constant;
mod forms;
mod keys;
mod orientation;
mod path;
mod platform;
mod region;
mod span;

pub use axis::Candidates;
pub use constant::{constant, count, positive, positive_length, whole};
pub use forms::read_region;
pub use keys::AXIS;
pub use keys::{TABLES, rules};
pub use path::Path;
pub use region::{Form, Region, has_range};
pub use span::Span;
