//! The largest value of a node that is never negative, over a box of joints and inputs, with a proof: branch and bound.
//!
//! [`largest`] asks it of a node, and `singular` of the least or the largest singular value of a matrix of nodes. `tape` are the
//! operations of a graph, one after the other. Two ways lead from them to what is known within one box (`search_box`):
//!
//! - a norm that is `convex` in the sine and cosine of each angle is largest at `corners`, where `vertex` has its numbers;
//! - of anything else, and close to a maximum, there are forms that are `affine` in the names, and `slopes` say how far the value can
//!   be above that at the box's centre.
//!
//! `search` goes from box to box of a `problem`, the one that may hold most first, from where a `local_search` led; `period` says
//! whether a joint comes round, and `apart` what sums cannot exceed because of their parts.
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
//! let size = Magnitude { node, squared: false, parts: Vec::new() };
//! let x = Moving { symbol: Symbol::Variable(0), range: [0.0, 1.0], home: 0.0, start: 0.0 };
//! let bound = largest(&mut graph, &size, &[x], |_| 0.0, &Effort::default(), &mut |_| true);
//! assert!(bound.complete && bound.found <= 0.25 && bound.certified >= 0.25);
//! assert!(bound.certified <= 1.01 * bound.found);
//! ```

mod affine;
mod apart;
mod convex;
mod corners;
mod effort;
mod largest;
mod local_search;
mod moving;
mod period;
mod problem;
mod search;
mod search_box;
mod singular;
mod slopes;
mod tape;
mod vertex;

pub use apart::{Limits, limits};
pub use effort::{Effort, Progress};
pub use largest::largest;
pub use moving::{MOST_MOVING, Moving};
pub use search::Bound;
pub use singular::{Extreme, Singular, singular_value};
