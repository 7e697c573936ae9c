//! Sets of configurations over which errors are analyzed: generated on demand, never stored.
//!
//! A list of configurations.
//!
//! Evenly spread subsets of a workspace.
//!
//! Unreachable configurations of a workspace.

use core::ops::Range;

use abbe_core::{Error, Manipulator, Quantity, checks, lanes::Tiles};

use crate::{Configuration, ReachError, SumLimits};

/// Function that is shown configurations: the position of one in a list, the configuration, and
/// whether it is reachable.
pub type Show<'a> = dyn FnMut(usize, &mut Configuration, Result<(), ReachError>) + 'a;

/// Set of configurations over which errors are analyzed, by index.
///
/// Each configuration depends on its index alone, so that any part of the workspace can be
/// regenerated, on any thread, and none is stored.
pub trait Workspace: Sync {
    /// Returns the number of configurations, including unreachable ones.
    fn len(&self) -> usize;

    /// Returns whether there are no configurations.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the home configuration: the reference of errors relative to home. Its `q`, `s` and
    /// `u` have the lengths of all configurations.
    fn home(&self) -> &Configuration;

    /// Overwrites `configuration`, which must have the lengths of home, with configuration `index`,
    /// less than [`len`](Self::len). If it is unreachable, `configuration` holds the requested
    /// values.
    fn fill(&self, index: usize, configuration: &mut Configuration) -> Result<(), ReachError>;

    /// Calls `show` with each of the configurations in turn, by its position in the list, as
    /// [`fill`](Self::fill) writes it. Overridden by workspaces that generate several faster than
    /// one by one. `show` may modify the configuration.
    fn fill_each(&self, indices: &[usize], show: &mut Show<'_>) {
        let mut configuration = self.home().clone();
        for (place, index) in indices.iter().enumerate() {
            let filled = self.fill(*index, &mut configuration);
            show(place, &mut configuration, filled);
        }
    }

    /// Writes what differs from home in a range of configurations to the rows q, s, u of `rows`,
    /// which hold those of home. Returns `false`, without effect, if some are unreachable or one by
    /// one is as fast.
    fn fill_rows(&self, _range: Range<usize>, _rows: &mut Tiles) -> bool {
        false
    }

    /// Returns the target point in `F_0` of configuration `index`, if targets vary.
    fn point(&self, _index: usize) -> Option<[f64; 3]> {
        None
    }

    /// Returns configuration `index`, or the reason why it is unreachable.
    fn configuration(&self, index: usize) -> Result<Configuration, ReachError> {
        let mut configuration = self.home().clone();
        self.fill(index, &mut configuration)?;
        Ok(configuration)
    }

    /// Returns all reachable configurations, for small workspaces.
    fn reached(&self) -> Vec<Configuration> {
        let indices: Vec<usize> = (0..self.len()).collect();
        let mut reached = Vec::new();
        self.fill_each(&indices, &mut |_, configuration, filled| {
            reached.extend(filled.ok().map(|()| configuration.clone()));
        });
        reached
    }
}

/// Workspace whose configurations a function fills in by index, beginning at home.
pub(super) struct Indexed<F> {
    pub(super) home: Configuration,
    pub(super) count: usize,
    pub(super) fill: F,
}

impl<F: Fn(usize, &mut Configuration) -> Result<(), ReachError> + Sync> Workspace for Indexed<F> {
    fn len(&self) -> usize {
        self.count
    }

    fn home(&self) -> &Configuration {
        &self.home
    }

    fn fill(&self, index: usize, configuration: &mut Configuration) -> Result<(), ReachError> {
        configuration.copy_from(&self.home);
        (self.fill)(index, configuration)
    }
}

/// Creates the workspace of a single configuration.
pub fn one(configuration: &Configuration) -> impl Workspace + use<> {
    let fill = |_: usize, _: &mut Configuration| Ok(());
    Indexed { home: configuration.clone(), count: 1, fill }
}

/// Creates the workspace of a list of configurations. Those with a variable outside its limits
/// count as unreachable.
///
/// Returns [`Error::Count`] if a configuration has a wrong number of variables, parameters or
/// inputs.
pub fn listed(
    manipulator: &dyn Manipulator,
    configurations: Vec<Configuration>,
) -> Result<impl Workspace + use<>, Error> {
    let description = manipulator.description();
    let home = Configuration::home(description);
    for Configuration { q, s, u } in &configurations {
        checks::length(Quantity::Variables, [home.q.len(), 1], q.len())?;
        checks::length(Quantity::Parameters, [home.s.len(), 1], s.len())?;
        checks::length(Quantity::Inputs, [home.u.len(), 1], u.len())?;
    }
    let limits: Vec<[f64; 2]> = description.variables.iter().map(|variable| variable.limits).collect();
    let sums = SumLimits::new(description, &[]);
    let count = configurations.len();
    let fill = move |index: usize, configuration: &mut Configuration| {
        configurations.get(index).into_iter().for_each(|listed| configuration.copy_from(listed));
        let q = &configuration.q;
        let outside = |(value, [lower, upper]): (&f64, &[f64; 2])| value < lower || value > upper;
        match q.iter().zip(&limits).position(outside) {
            Some(variable) => {
                Err(ReachError::OutsideLimits { variable, value: q[variable], limits: limits[variable] })
            }
            None => sums.check(q),
        }
    };
    Ok(Indexed { home, count, fill })
}

/// `1/φ`: its multiples modulo 1 are evenly spread, and align with no grid.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Subset of at most `count` configurations of a workspace, spread over its indices. A smaller
/// workspace is kept whole.
pub struct Subset<'a> {
    /// Original workspace.
    pub workspace: &'a dyn Workspace,
    /// Largest number of configurations.
    pub count: usize,
}

impl Workspace for Subset<'_> {
    fn len(&self) -> usize {
        self.workspace.len().min(self.count)
    }

    fn home(&self) -> &Configuration {
        self.workspace.home()
    }

    fn fill(&self, index: usize, configuration: &mut Configuration) -> Result<(), ReachError> {
        self.workspace.fill(self.place(index), configuration)
    }

    fn fill_each(&self, indices: &[usize], show: &mut Show<'_>) {
        let places: Vec<usize> = indices.iter().map(|index| self.place(*index)).collect();
        self.workspace.fill_each(&places, show);
    }
}

impl Subset<'_> {
    /// Returns the index in the original workspace.
    pub fn place(&self, index: usize) -> usize {
        let all = self.workspace.len();
        if all <= self.count { index } else { ((index as f64 * GOLDEN).fract() * all as f64) as usize }
    }
}

/// Unreachable configuration of a workspace.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Unreachable {
    /// Index in the workspace.
    pub index: usize,
    /// Target point in `F_0`, if targets vary.
    pub point: Option<[f64; 3]>,
    /// Requested configuration. Variables to be solved hold their start values.
    pub requested: Configuration,
    /// Reason.
    pub reason: ReachError,
}
