//! Checks a spec, and reports what follows from it.
//!
//! `facts` holds the content of the spec, `chain` its matrices at home, `angles` suspicious angles,
//! `axes` unexpected axes of rotation, `unused` inputs and loads without effect, `identifiable` the
//! number of identifiable errors, and `laws` the self-checks of the closed form against the exact
//! chain.

mod angles;
mod axes;
mod chain;
mod facts;
mod identifiable;
mod laws;
mod unused;

use std::sync::Arc;

use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;
use serde::Serialize;

use crate::finite;
use crate::iso230::IsoAxis;
use crate::machine::Machine;
use crate::notes::Notes;

pub use angles::Warning;
pub use chain::{Chain, Dh, Link};
pub use facts::{Facts, Frame, FunctionOperations, NominalValue, Source, Variable};
pub use identifiable::Identifiable;
pub use laws::{Law, laws};

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
    /// Nominal chain at home; `None` if its pose is not finite.
    pub home: Option<Chain>,
    /// Suspicious numbers in the spec.
    pub warnings: Vec<Warning>,
    /// Properties of the spec that are easily misunderstood, one sentence each.
    pub notes: Vec<String>,
    /// Identifiability from poses, then from tool points; each with a known and an unknown base
    /// frame.
    pub identifiable: Vec<Identifiable>,
    /// Number of configurations at which the laws were checked.
    pub configurations: usize,
    /// Results of the self-checks, one per law.
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
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
        let spec = &self.machine.spec;
        let interpreter = Interpreter::new(Arc::clone(spec));
        let facts = Facts::new(&interpreter, &self.machine.origin);
        notes.go_on()?;
        let (identifiable, identifiability_configurations) = identifiable::count(&interpreter, notes)?;
        notes.go_on()?;
        let configurations = laws::configurations(spec);
        let report = Report {
            facts,
            iso_axes: IsoAxis::all(spec, &interpreter),
            home: Chain::at_home(spec, &interpreter),
            warnings: angles::warnings(spec, self.machine.text().ok().as_deref()),
            notes: [unused::notes(spec), axes::notes(spec)].concat(),
            identifiable,
            configurations,
            laws: laws(&interpreter, configurations, notes)?,
            identifiability_configurations,
            spec: Arc::clone(spec),
        };
        finite(&self.machine.origin, report)
    }
}

impl Report {
    /// Returns true if every law holds.
    pub fn passed(&self) -> bool {
        self.laws.iter().all(|law| law.holds)
    }
}
