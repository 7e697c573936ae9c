//! The manipulators that abbe ships, each as a module generated from its file in `specs/`.
//!
//! ```
//! use abbe_manipulators::pps;
//!
//! let q = [1128.0, 280.0, 0.0, 0.0, 0.0, 0.0]; // home: mm and rad
//! let (pose, error_jacobian) = pps::error_jacobian(&q, &pps::Parameters::NOMINAL)?;
//! assert_eq!(pose.position(), [1128.0, 1626.0, 1568.0]);
//! // A rotation e_s of frame 1 moves the treatment point sideways by its distance from the rail.
//! assert_eq!(error_jacobian[3][0], 1568.0);
//! # Ok::<(), abbe::Error>(())
//! ```

abbe::include_manipulators!();

mod shipped;

pub use shipped::{MAPS, PLANS, SHIPPED, Shipped};
