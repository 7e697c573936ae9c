//! Smallest singular value of the joint Jacobian, and smallest stiffness of the machine.

use abbe_bound::{Effort, Extreme, Singular, Watch, singular_value};
use abbe_codegen::chain;

use super::domain::Domain;
use super::report::{Dexterity, LowerBound};

impl Domain {
    /// Returns the dexterity of the tool point and of the tool; `None` for fewer than three joints.
    pub(super) fn dexterity(&self, effort: &Effort, watch: &mut Watch<'_>) -> Option<Dexterity> {
        let chain::Dexterity { graph, point, pose } = chain::Dexterity::new(&self.spec)?;
        let mut least = |rows: &Vec<_>| {
            let still = |symbol| self.home(symbol);
            let least = singular_value(Extreme::Least, &graph, rows, &self.names(), &still, effort, watch);
            self.least(&least)
        };
        Some(Dexterity { point: least(&point), pose: pose.as_ref().map(least) })
    }

    /// Returns the smallest stiffness at the tool point, in N/m: the inverse of the largest
    /// compliance. `None` if no force deflects the tool point.
    pub(super) fn stiffness(&self, effort: &Effort, watch: &mut Watch<'_>) -> Option<LowerBound> {
        let chain::ToolCompliance { graph, rows } = chain::ToolCompliance::new(&self.spec)?;
        let still = |symbol| self.home(symbol);
        let largest = singular_value(Extreme::Largest, &graph, &rows, &self.names(), &still, effort, watch);
        let certified = (1.0 / largest.certified).next_down().max(0.0);
        Some(self.least(&Singular { certified, found: largest.found.map(f64::recip), ..largest }))
    }

    fn least(&self, least: &Singular) -> LowerBound {
        let (at, label) = self.describe(&least.at);
        let Singular { certified, found, boxes, complete, .. } = *least;
        LowerBound { certified, found: found.filter(|found| found.is_finite()), at, boxes, complete, label }
    }
}
