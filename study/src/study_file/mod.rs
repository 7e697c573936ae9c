//! Study files: what to do with a manipulator.
//!
//! ```toml
//! [study]
//! title = "Spin and reach"
//! tolerance = "0.5 mm"                     # the rest of [study] is optional
//! # … or { position = "0.5 mm", orientation = "0.5 mrad", probability = 0.99 }, of which 0.95 is the default
//! set = { tip_load = "1 kN" }              # parameters and inputs
//! disable = ["assembly"]                   # sources; `enable` likewise
//!
//! [workspace.joints]                       # samples within the limits …
//! samples = 1000
//! # … random ones: [workspace.random]  samples = 1000, seed = 7
//! # … or every combination: [workspace.grid]  q4 = { from = "-90 deg", to = "90 deg", step = "5 deg" }
//! #     inputs may stand there, too: payload = ["0 kg", "2 kg", "5 kg"]
//! # … or tool points brought to a point of the room: [workspace.presented], as in studies/pps.toml
//! # … or a box of points in F_0, by inverse kinematics from home: [workspace.box]
//! #     x = { from = "400 mm", to = "600 mm", count = 5 }, y and z likewise
//! #     orientation = "free" (or "home": that of home is kept), solve = ["q1", …] (all variables if not given)
//! # … or a CSV file beside the study: [workspace.path]  file = "path.csv", with columns `d1 (mm)`, `q4 (deg)`, …
//!
//! [workspace.inputs]                       # beside any form: everything again with each of these
//! payload = ["0 kg", "2 kg", "5 kg"]       # not named, an input with a range is sampled with the joints, or both its
//!                                          # ends are taken where nothing is sampled; `set` keeps it where it is
//!
//! [compensation]                           # what is left of the repeatable sources
//! default = 0.05                           # a share of the error
//! "arm deflection" = "0.02 mm"             # or a bound
//!
//! [[published]]                            # a printed figure, to stand beside ours
//! source = "spin encoder"
//! metric = "plain maximum"                 # or "half peak-to-peak", "relative to home"
//! x = "0.074 mm"
//! within = "0.0005 mm"                     # how near is equal: half of the last printed digit
//!
//! [[figure]]                               # a picture of the report; see `figure`
//! kind = "travel"
//! over = "q4"
//! ```
//!
//! `study` is what a study says, `read` reads a file from top to bottom, `published` the figures that somebody printed,
//! `figure` those to draw, `compensation` what compensation leaves,
//! `tolerance` how large errors may be. Everything is checked against the spec, and mistakes are
//! shown as those of a spec.

mod compensation;
mod figure;
mod keys;
mod published;
mod read;
mod study;
mod tolerance;

pub use compensation::Compensated;
pub use figure::{Content, Figure, Over};
pub use keys::TABLES;
pub use published::{CombinedFigure, Metric, Published, PublishedResidual, Subject};
pub use study::Study;
