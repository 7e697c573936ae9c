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
//! # … or every combination: [workspace.grid]  q4 = { from = "-90 deg", to = "90 deg", step = "5 deg" }
//! # … or tool points brought to a point of the room: [workspace.presented], as in studies/pps.toml
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
//! `read` reads a file from top to bottom, `axis` and `region` its workspace, `published` the figures that
//! somebody printed, `figure` those to draw. Everything is checked against the spec, and mistakes are shown as those of a spec.

mod axis;
mod figure;
mod published;
mod read;
mod region;

use std::path::Path;

use abbe_codegen::diagnostic::Diagnostics;
use abbe_codegen::document::Document;
use abbe_codegen::spec::Spec;

use crate::changes::Changes;
use crate::manipulator::Found;

pub(crate) use figure::{Content, Figure, Over};
pub(crate) use published::{CombinedFigure, Compensated, Metric, Published, Subject};
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
    pub(crate) compensated: Option<Compensated>,
    pub(crate) not_reproducible: Vec<String>,
    pub(crate) figures: Vec<Figure>,
    /// Its file and the SHA-256 of the text; none if there is no study.
    pub(crate) file: Option<(String, String)>,
}

impl Study {
    /// The study of that file, or else the one shipped with the manipulator, or else joint samples.
    pub(crate) fn find(file: Option<&Path>, found: &Found) -> Result<Self, Diagnostics> {
        match (file, found.study) {
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
            not_reproducible: Vec::new(),
            file: None,
        }
    }
}
