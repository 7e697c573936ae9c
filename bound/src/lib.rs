//! Certified bounds of the largest value of a nonnegative node over a box of joints and inputs, by
//! branch and bound.
//!
//! [`largest`] bounds a node, or a sum by its parts, and `singular` the least or the largest
//! singular value of a matrix of nodes. `tape` holds the operations of a graph in order. Two
//! methods bound the value within one box (`search_box`):
//!
//! - A norm whose parts are affine or quadratic in the sine and cosine of each angle (`convex`) is
//!   largest at one of the control points (`controls`, `corners`), evaluated by the numbers of
//!   `vertex`.
//! - Any other node, and any node close to a maximum, is enclosed by `affine` forms, and `slopes`
//!   bound how far the value can exceed that at the centre of the box.
//!
//! `search` examines the boxes of a `problem`, the most promising first, and starts with the
//! maximum of a `local_search`. `unknowns` encloses what loops determine. `period` recognizes
//! joints that are periodic.
//!
//! ```
//! use abbe_codegen::chain::Magnitude;
//! use abbe_spec::expr::Symbol;
//! use abbe_codegen::graph::Graph;
//! use abbe_bound::{Effort, Moving, largest};
//!
//! // x (1 − x) is at most 1/4.
//! let mut graph = Graph::new();
//! let x = graph.symbol(Symbol::Variable(0));
//! let one = graph.constant(1.0);
//! let rest = graph.sub(one, x);
//! let node = graph.mul(x, rest);
//! let size = Magnitude { node, squared: false, parts: Vec::new(), largest_of: Vec::new() };
//! let x = Moving { symbol: Symbol::Variable(0), range: [0.0, 1.0], home: 0.0, start: 0.0 };
//! let bound = largest(&mut graph, &size, &[], &[x], &|_| 0.0, &Effort::default(), &mut |_| true);
//! assert!(bound.complete && bound.found <= 0.25 && bound.certified >= 0.25);
//! assert!(bound.certified <= 1.01 * bound.found);
//! ```

mod affine;
mod controls;
mod convex;
mod corners;
mod largest;
mod local_search;
mod period;
mod problem;
mod search;
mod search_box;
mod singular;
mod slopes;
mod tape;
mod unknowns;
mod vertex;

use affine::Affine;
use problem::Problem;
use tape::Tape;
use unknowns::Unknowns;

pub use largest::{Limits, largest, limits};
pub use search::{Bound, Effort, MOST_MOVING, Moving, Progress, Watch};
pub use singular::{Extreme, Singular, singular_value};
