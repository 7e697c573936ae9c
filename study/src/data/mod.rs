//! Measurements: a CSV file or columns in memory, and a map (TOML) that says what its columns are.
//!
//! `docs/reference/map.md` has every key.

mod above;
mod cells;
mod column;
mod completed;
mod configurations;
mod date;
mod dated;
mod dialect;
mod file;
mod from_rows;
mod instrument;
mod keys;
mod layout;
mod map;
mod missing;
mod numbers;
mod read;
mod read_channels;
mod read_instruments;
mod read_places;
mod read_values;
mod record;
mod rotation;
mod rows;
mod source;
mod station;
mod table;
mod turn;

pub use cells::Cells;
pub use column::{Channel, Column, Scale};
pub use date::Calendar;
pub(crate) use date::{in_name, parse_date};
pub use dated::Dated;
pub use from_rows::FromRows;
pub(crate) use from_rows::in_order;
pub use instrument::{Instrument, Instruments, Kind};
pub use keys::TABLES;
pub use map::{Base, Layout, Map, Target};
pub(crate) use numbers::{Numbers, numbers};
pub use rows::{Data, Summary, Unusable};
pub use source::{Columns, Source};
pub use station::{Placement, StatedStation, Stations};
pub use table::{Csv, Heading, Table};
pub(crate) use turn::EULER_ORDERS;
pub use turn::{Order, Turn};

pub(crate) use rotation::{
    Rotation, from_euler, from_quaternion, from_rotation_vector, is_rotation, quaternion, to_numbers,
};
