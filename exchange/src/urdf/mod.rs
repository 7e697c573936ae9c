//! URDF, the format of ROS: links, and the joints between them.
//!
//! `read` takes the path between two links as a chain. `write` puts the origins of the real robot
//! into the file of the nominal one, whose chain is a `nominal` one, or a file of its own.

mod nominal;
mod read;
mod write;

pub use self::read::{Ends, read};
pub use self::write::{write, write_tree};
