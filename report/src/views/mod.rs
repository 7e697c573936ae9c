//! Contents of the report of each job: one file a job, from its numbers to a
//! [`Document`](crate::Document).
//!
//! A view knows no renderer. `shared` has what several of them say.

mod allocation;
mod analysis;
mod bound;
mod check;
mod compensation;
mod doctor;
mod exported;
mod identification;
mod measurement;
mod monitoring;
mod plan;
mod positioning;
mod shared;

pub use allocation::allocation;
pub(crate) use analysis::analysis;
pub use bound::bound;
pub use check::check;
pub use compensation::compensation;
pub use doctor::doctor;
pub use exported::exported;
pub use identification::identification;
pub use measurement::measurement;
pub use monitoring::monitoring;
pub use plan::plan;
pub use positioning::positioning;
