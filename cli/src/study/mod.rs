//! Study files: what to do with a manipulator.
//!
//! ```toml
//! [study]
//! title = "Spin and reach"
//! tolerance = "0.5 mm"                     # the rest of [study] is optional
//! set = { tip_load = "1 kN" }              # parameters and inputs
//! disable = ["assembly"]                   # sources; `enable` likewise
//!
//! [workspace.joints]                       # samples within the limits …
//! samples = 1000
//! # … random ones: [workspace.random]  samples = 1000, seed = 7
//! # … or every combination: [workspace.grid]  q4 = { from = "-90 deg", to = "90 deg", step = "5 deg" }
//! # … or tool points brought to a point of the room: [workspace.presented], as in studies/pps.toml
//! # … or a box of points in F_0, by inverse kinematics from home: [workspace.box]
//! #     x = { from = "400 mm", to = "600 mm", count = 5 }, y and z likewise
//! #     orientation = "free" (or "home": that of home is kept), solve = ["q1", …] (all variables if not given)
//! # … or a CSV file beside the study: [workspace.path]  file = "path.csv", with columns `d1 (mm)`, `q4 (deg)`, …
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
//! `read` reads a file from top to bottom, `region`, `forms`, `axis` and `path` its workspace, `published` the figures
//! that somebody printed, `figure` those to draw. Everything is checked against the spec, and mistakes are shown as
//! those of a spec.

mod axis;
mod compensation;
mod figure;
mod forms;
mod path;
mod published;
mod read;
mod region;

use std::path::Path;

use abbe_codegen::diagnostic::Diagnostics;
use abbe_codegen::document::Document;
use abbe_codegen::spec::Spec;

use crate::changes::Changes;
use crate::manipulator::Found;

pub(crate) use axis::{Candidates, count};
pub(crate) use compensation::Compensated;
pub(crate) use figure::{Content, Figure, Over};
pub(crate) use published::{CombinedFigure, Metric, Published, PublishedResidual, Subject};
pub(crate) use region::Region;

/// What to do with a manipulator.
#[derive(Debug)]
pub(crate) struct Study {
    pub(crate) title: String,
    /// Who printed the published figures.
    pub(crate) publisher: String,
    /// How large the error of the tool point may be.
    pub(crate) tolerance: Option<f64>,
    pub(crate) changes: Changes,
    pub(crate) region: Region,
    pub(crate) published: Vec<Published>,
    /// What somebody printed of the errors after compensation.
    pub(crate) compensated: Option<PublishedResidual>,
    pub(crate) compensation: Option<Compensated>,
    pub(crate) not_reproducible: Vec<String>,
    pub(crate) figures: Vec<Figure>,
    /// Its file and the SHA-256 of the text; none if there is no study.
    pub(crate) file: Option<(String, String)>,
}

impl Study {
    /// Leaves out what others printed: the machine is not theirs any more. Whether there was anything.
    pub(crate) fn forget_published(&mut self) -> bool {
        let any = !self.published.is_empty() || self.compensated.is_some();
        self.published.clear();
        self.compensated = None;
        self.not_reproducible.clear();
        any
    }

    /// The study of that file, or else the one shipped with the manipulator, or else joint samples.
    pub(crate) fn find(file: Option<&Path>, found: &Found) -> Result<Self, Diagnostics> {
        match (file, found.shipped.and_then(|shipped| shipped.study)) {
            (Some(path), _) => Self::read(Document::read(path)?, &found.spec),
            (None, Some(text)) => {
                Self::read(Document::new(format!("studies/{}.toml", found.origin), text), &found.spec)
            }
            (None, None) => Ok(Self::joint_samples(&found.spec)),
        }
    }

    fn joint_samples(spec: &Spec) -> Self {
        let region = Region::samples(spec);
        Self {
            title: "No study: the limits of the joints are the workspace".to_owned(),
            publisher: String::new(),
            tolerance: None,
            changes: Changes::default(),
            figures: Figure::defaults(&region),
            region,
            published: Vec::new(),
            compensated: None,
            compensation: None,
            not_reproducible: Vec::new(),
            file: None,
        }
    }
}
