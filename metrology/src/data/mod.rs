//! Measurements: a CSV file or columns in memory, and a map (TOML) with the meaning of the columns.
//!
//! `docs/reference/map.md` describes all keys. `read` and `read_…` read the map, `keys` has its
//! keys. `source` opens rows, and reads tables without a map: `file` (by `dialect` and `preamble`)
//! or `cells`; `rows` makes observations of them, by the columns of the map in `layout`;
//! `completed` adds inputs that rows imply. `runs` reads runs of one axis; `table` is written.

mod cells;
mod choices;
mod column;
mod command_pose;
mod completed;
mod configurations;
mod dialect;
mod file;
mod from_rows;
mod instrument;
mod keys;
mod layout;
mod map;
mod missing;
mod preamble;
mod read;
mod read_camera;
mod read_channels;
mod read_instruments;
mod read_places;
mod record;
mod rotation;
mod rows;
mod runs;
mod sight;
mod source;
mod station;
mod table;
mod target_frame;
mod turn;

pub use abbe_spec::csv_writer::{Csv, Heading};
pub use cells::Cells;
pub(crate) use choices::UNKNOWN;
pub use column::{Channel, Column, Scale};
pub use from_rows::FromRows;
pub(crate) use from_rows::{change_with_reference, in_order, set_input, with_references};
pub use instrument::{Instrument, Instruments};
pub use keys::{required_keys, rules, tables};
pub use map::{Base, Layout, Map, Target};
pub(crate) use rows::hash;
pub use rows::{Data, Dated, Summary, Unusable};
pub(crate) use runs::runs;
pub use runs::{Runs, TargetRuns};
pub use sight::Sight;
pub use source::{Columns, Source};
pub(crate) use source::{RawTable, raw_table};
pub use station::{Placement, StatedPlacement, StatedStation, Stations};
pub use table::Table;
pub use target_frame::TargetFrame;
pub(crate) use turn::EULER_ORDERS;
pub use turn::{Order, Turn};

pub(crate) use rotation::{
    Rotation, from_euler, from_numbers, from_quaternion, from_rotation_vector, is_rotation, quaternion,
    to_numbers,
};
