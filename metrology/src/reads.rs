//! Input files of the jobs on measurements.

use std::path::{Path, PathBuf};

use abbe_study::Reads;

use crate::compensate::Compensate;
use crate::data::{Data, Map, Source};
use crate::doctor::Doctor;
use crate::identify::Identify;
use crate::measure::Measure;
use crate::monitor::{Checks, Monitor};
use crate::plan::{Choice, Plan, Sets};
use crate::positioning::Positioning;
use crate::simulate::{Places, Simulate};

abbe_study::reads!(files of Map, Data, Sets);

impl Reads for Checks {
    fn files(&self) -> Vec<PathBuf> {
        self.list.iter().flat_map(|check| check.data.files()).collect()
    }
}

impl Reads for Choice {
    fn files(&self) -> Vec<PathBuf> {
        match self {
            Self::Sets(sets) | Self::Among { sets, .. } => sets.files(),
            Self::Optimal { .. } => Vec::new(),
        }
    }
}

impl Reads for Places {
    fn files(&self) -> Vec<PathBuf> {
        match self {
            Self::Rows(data) => data.files(),
            Self::Samples(_) => Vec::new(),
        }
    }
}

impl Reads for Source<'_> {
    fn files(&self) -> Vec<PathBuf> {
        self.file().map(Path::to_owned).into_iter().collect()
    }
}

abbe_study::reads! {
    Positioning<'_>: data, without reading scale accept;
    Compensate: machine map data, without poses tolerance weight;
    Doctor<'_>: machine data, without within;
    Identify: machine map data test, without terms harmonics settings accept;
    Measure: machine map data, without accept;
    Monitor: machine map checks, without settings;
    Plan: machine map choice study, without model_error seed;
    Simulate: machine map at, without noise outliers random seed;
}
