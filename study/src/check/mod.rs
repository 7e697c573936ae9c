//! Checks a spec, and reports what follows from it.
//!
//! `facts` holds the content of the spec, `chain` its matrices at home, `tree` what closed loops
//! leave free, `modes` other ways in which they close, `angles` suspicious angles, `axes`
//! unexpected axes of rotation, `unused` inputs and loads without effect, `identifiable` the number
//! of identifiable errors, and `laws` the self-checks of the closed form against the exact chain.

mod angles;
mod axes;
mod chain;
mod facts;
mod identifiable;
mod laws;
mod modes;
mod tree;
mod unused;

use std::sync::Arc;

use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use serde::Serialize;

use crate::{IsoAxis, Machine, Notes, Result, finite};

pub use angles::Warning;
pub use chain::{Chain, Dh, Link};
pub use facts::{Facts, Frame, FunctionOperations, NominalValue, Source, Variable};
use identifiable::Counted;
pub use identifiable::Identifiable;
pub use laws::{Law, laws};
pub use modes::{LoopModes, Mode};
pub use tree::{Free, Home, Loop, Passive, State, Tree};

/// Job of `abbe check`: checks a spec.
#[derive(Clone)]
pub struct Check {
    /// Machine whose spec is checked.
    pub machine: Machine,
}

/// Content of a spec, its chain at home, and the results of the self-checks.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Content of the spec.
    #[serde(flatten)]
    pub facts: Facts,
    /// Names of ISO 230-1 of the errors of each axis, of a machine with slides along X, Y and Z.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub iso_axes: Vec<IsoAxis>,
    /// Freedoms and loops; absent if the frames are a chain.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tree: Option<Tree>,
    /// Nominal chain at home; `None` if its pose is not finite.
    pub home: Option<Chain>,
    /// Suspicious numbers in the spec.
    pub warnings: Vec<Warning>,
    /// Properties of the spec that are easily misunderstood, one sentence each.
    pub notes: Vec<String>,
    /// Identifiability from poses, then from tool points; each with a known and an unknown base
    /// frame. Empty if loops do not close at home.
    pub identifiable: Vec<Identifiable>,
    /// Number of configurations at which the laws were checked.
    pub configurations: usize,
    /// Results of the self-checks, one per law; empty if loops do not close at home.
    pub laws: Vec<Law>,
    /// Number of configurations that the identifiability is based on.
    #[serde(skip)]
    pub identifiability_configurations: usize,
    /// The spec, for further facts.
    #[serde(skip)]
    pub spec: Arc<Spec>,
}

impl Check {
    /// Runs all checks.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report> {
        let spec = &self.machine.spec;
        let interpreter = Interpreter::new(Arc::clone(spec));
        let facts = Facts::new(&interpreter, &self.machine.origin);
        let tree = Tree::new(spec, &interpreter);
        notes.go_on()?;
        // Loops that do not close leave nothing to evaluate.
        let closes = tree.as_ref().is_none_or(Tree::closes);
        let identifiable = match closes {
            true => identifiable::count(&interpreter, notes)?,
            false => Counted::default(),
        };
        notes.go_on()?;
        let configurations = if closes { laws::configurations(spec) } else { 0 };
        let report = Report {
            facts,
            iso_axes: IsoAxis::all(spec, &interpreter),
            tree,
            home: Chain::at_home(spec, &interpreter),
            warnings: angles::warnings(spec, self.machine.text().ok().as_deref()),
            notes: [Vec::from_iter(identifiable.remark), unused::notes(spec), axes::notes(spec)].concat(),
            identifiable: identifiable.list,
            configurations,
            laws: if closes { laws(&interpreter, configurations, notes)? } else { Vec::new() },
            identifiability_configurations: identifiable.configurations,
            spec: Arc::clone(spec),
        };
        finite(&self.machine.origin, report)
    }
}

impl Report {
    /// Returns true if the loops close at home and every law holds.
    pub fn passed(&self) -> bool {
        self.tree.as_ref().is_none_or(Tree::closes) && self.laws.iter().all(|law| law.holds)
    }
}
