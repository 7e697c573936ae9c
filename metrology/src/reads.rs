//! Input files of the jobs on measurements.

use std::path::{Path, PathBuf};

use abbe_study::Reads;

use crate::compensate::Compensate;
use crate::data::{Data, Map};
use crate::doctor::Doctor;
use crate::identify::Identify;
use crate::measure::Measure;
use crate::monitor::{Checks, Monitor};
use crate::plan::{Choice, Plan, Sets};
use crate::positioning::Positioning;
use crate::simulate::{Places, Simulate};

impl Reads for Map {
    fn files(&self) -> Vec<PathBuf> {
        self.files.clone()
    }
}

impl Reads for Data {
    fn files(&self) -> Vec<PathBuf> {
        self.files.clone()
    }
}

impl Reads for Sets {
    fn files(&self) -> Vec<PathBuf> {
        self.files.clone()
    }
}

impl Reads for Checks {
    fn files(&self) -> Vec<PathBuf> {
        self.list.iter().flat_map(|check| check.data.files()).collect()
    }
}

impl Reads for Choice {
    fn files(&self) -> Vec<PathBuf> {
        match self {
            Self::Sets(sets) => sets.files(),
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

// The patterns name every field, so that a new field does not compile until its files are
// considered.

impl Reads for Positioning<'_> {
    fn files(&self) -> Vec<PathBuf> {
        let Self { data, reading: _, scale: _ } = self;
        data.file().map(Path::to_owned).into_iter().collect()
    }
}

impl Reads for Compensate {
    fn files(&self) -> Vec<PathBuf> {
        let Self { machine, map, data, poses: _, tolerance: _ } = self;
        [machine.files(), map.files(), data.files()].concat()
    }
}

impl Reads for Doctor<'_> {
    fn files(&self) -> Vec<PathBuf> {
        let Self { machine, data, within: _ } = self;
        let data = data.file().map(Path::to_owned).into_iter().collect();
        [machine.files(), data].concat()
    }
}

impl Reads for Identify {
    fn files(&self) -> Vec<PathBuf> {
        let Self { machine, map, data, test, terms: _, harmonics: _, settings: _, accept: _ } = self;
        let test = test.iter().flat_map(Data::files).collect();
        [machine.files(), map.files(), data.files(), test].concat()
    }
}

impl Reads for Measure {
    fn files(&self) -> Vec<PathBuf> {
        let Self { machine, map, data, accept: _ } = self;
        [machine.files(), map.files(), data.files()].concat()
    }
}

impl Reads for Monitor {
    fn files(&self) -> Vec<PathBuf> {
        let Self { machine, map, checks, settings: _ } = self;
        [machine.files(), map.files(), checks.files()].concat()
    }
}

impl Reads for Plan {
    fn files(&self) -> Vec<PathBuf> {
        let Self { machine, map, choice, study, model_error: _, seed: _ } = self;
        [machine.files(), map.files(), choice.files(), study.files()].concat()
    }
}

impl Reads for Simulate {
    fn files(&self) -> Vec<PathBuf> {
        let Self { machine, map, at, noise: _, outliers: _, random: _, seed: _ } = self;
        [machine.files(), map.files(), at.files()].concat()
    }
}
