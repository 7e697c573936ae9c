//! Measurements: a CSV file, and a map (TOML) that says what its columns are.
//!
//! ```toml
//! [data]
//! title = "Laser tracker, one target"
//! uncertainty = "0.02 mm"              # one standard deviation of a coordinate
//! # angle_uncertainty = "0.1 mrad"     # of a turn: poses only
//! # base = "unknown"                   # the instrument stands anywhere; "exact": it sees in F_0 itself; if not
//!                                      # given, it sees in F_0 but for small errors of the base
//! # group = "pose"                     # rows with the same text there are visits of one configuration
//! # time = "minute"                    # rows are in the order of that column
//! # station = "setup"                  # the column that says where the instrument stood
//! # placement = "exact"                # the targets are on the tool where the map says
//!
//! [joints]                             # every variable of the spec; sign = -1 turns one round
//! q1 = { column = "joint_1", unit = "deg" }
//! q2 = { value = "90 deg" }            # not in the file: it stays there
//!
//! [inputs]                             # those that are not nominal
//! payload = { column = "load", unit = "kg" }
//!
//! [point]                              # one of: point, difference, target, pose
//! columns = ["x", "y", "z"]
//! unit = "mm"
//!
//! [difference]                         # actual = target − difference
//! target = ["x_t", "y_t", "z_t"]
//! difference = ["x_dif", "y_dif", "z_dif"]
//! unit = "mm"
//!
//! [[target]]                           # on the end effector, three or more
//! columns = ["p1x", "p1y", "p1z"]
//! unit = "mm"
//! position = ["-200 mm", "10 mm", "150 mm"]   # in the frame of the tool, as designed
//!
//! [pose]
//! position = ["x", "y", "z"]
//! unit = "mm"
//! quaternion = { columns = ["a", "b", "c", "d"], order = "wxyz" }       # or "xyzw"
//! # matrix = ["r11", "r12", … "r33"]                                    # row by row
//! # euler = { columns = ["a", "b", "c"], order = "zyx", unit = "deg" }   # Rz(a) Ry(b) Rx(c)
//!
//! [[station]]                          # what `abbe identify --out` writes: from F_0 to the frame of the instrument
//! position = ["1200 mm", "-340 mm", "15 mm"]
//! quaternion = [0.99, 0, 0, 0.141]     # w x y z
//!
//! [placement]                          # … and where the targets are on the tool, or the frame that is seen
//! targets = [["1.2 mm", "0.3 mm", "80 mm"]]
//! ```

mod column;
mod configurations;
mod file;
mod keys;
mod layout;
mod map;
mod missing;
mod outside;
mod read;
mod rotation;
mod rows;
mod station;
mod table;
mod turn;

pub use column::{Channel, Column};
pub use keys::TABLES;
pub use map::{Base, Layout, Map, Target};
pub(crate) use outside::warn_of_extrapolation;
pub use rows::{Data, Summary, Unusable};
pub use station::{Placement, StatedStation, Stations};
pub use table::Table;
pub use turn::{Order, Turn};

pub(crate) use rotation::quaternion;
