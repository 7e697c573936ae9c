//! Configurations of a study or a plan: `[workspace]`.
//!
//! `region` is the definition of a workspace. `forms` reads its forms, also legs from poses, `axis`
//! the values of a variable or parameter, and `path` a file of configurations. `span` computes the
//! enclosing box.

mod axis;
mod forms;
mod keys;
mod orientation;
mod path;
mod region;
mod span;

pub use axis::{Candidates, constant, count, positive, whole};
pub use forms::read_region;
pub use keys::{rules, tables};
pub use path::Path;
pub(crate) use region::in_one_run;
pub use region::{Form, Region, has_range};
pub use span::Span;
