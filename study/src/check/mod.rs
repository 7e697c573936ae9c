//! Whether a spec is right, and what follows from it.
//!
//! `facts` is what the spec says, `chain` its matrices at home, `angles` which of its angles are hardly meant, `axes` what
//! its rotations turn about, `identifiable` what measurements could tell, `laws` whether the closed form agrees with the
//! exact chain.

mod angles;
mod axes;
mod chain;
mod facts;
mod identifiable;
mod laws;

use std::sync::Arc;

use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;
use serde::Serialize;

use crate::finite;
use crate::machine::Machine;
use crate::notes::Notes;

pub use angles::Warning;
pub use chain::{Chain, Dh, Link};
pub use facts::{Facts, Frame, Function, Source, Value, Variable};
pub use identifiable::Identifiable;
pub use laws::{Law, laws};

/// Is this spec right?
#[derive(Clone)]
pub struct Check {
    /// Whose spec.
    pub machine: Machine,
}

/// What [`Check`] finds.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// What the spec says.
    #[serde(flatten)]
    pub facts: Facts,
    /// The nominal chain at home; none if it has no finite pose there.
    pub home: Option<Chain>,
    /// Numbers that are hardly meant as they stand.
    pub warnings: Vec<Warning>,
    /// What a reader might take for something else.
    pub notes: Vec<String>,
    /// What measurements could tell: poses, then tool points; each without and with an unknown base frame.
    pub identifiable: Vec<Identifiable>,
    /// At how many configurations the laws were checked.
    pub configurations: usize,
    /// How well each law holds.
    pub laws: Vec<Law>,
    /// Over how many configurations was counted what can be identified.
    #[serde(skip)]
    pub moved: usize,
    /// The spec, for what else it says.
    #[serde(skip)]
    pub spec: Arc<Spec>,
}

impl Check {
    /// Checks everything.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
        let spec = &self.machine.spec;
        let interpreter = Interpreter::new(Arc::clone(spec));
        let facts = Facts::new(&interpreter, &self.machine.origin);
        notes.go_on()?;
        let (identifiable, moved) = identifiable::count(&interpreter, notes)?;
        notes.go_on()?;
        let configurations = laws::configurations(spec);
        let report = Report {
            facts,
            home: Chain::at_home(spec, &interpreter),
            warnings: angles::warnings(spec, self.machine.text().ok().as_deref()),
            notes: axes::notes(spec),
            identifiable,
            configurations,
            laws: laws(&interpreter, configurations, notes)?,
            moved,
            spec: Arc::clone(spec),
        };
        finite(&self.machine.origin, report)
    }
}

impl Report {
    /// Whether every law holds.
    pub fn passed(&self) -> bool {
        self.laws.iter().all(|law| law.holds)
    }
}
