//! How far the joints move the tool at least.

use abbe_codegen::chain;
use abbe_interpreter::bound::{Effort, Progress, least_singular_value};

use super::domain::{Domain, home};
use super::report::{Dexterity, Least};

impl Domain {
    /// That of the tool point, and of the tool; none of fewer than three joints.
    pub(super) fn dexterity(
        &self,
        effort: &Effort,
        watch: &mut dyn FnMut(&Progress) -> bool,
    ) -> Option<Dexterity> {
        let chain::Dexterity { graph, point, pose } = chain::Dexterity::new(&self.spec)?;
        let mut least = |rows: &Vec<_>| {
            let still = |symbol| home(symbol, &self.spec);
            let least = least_singular_value(&graph, rows, &self.names(), still, effort, watch);
            let (at, place) = self.place(&least.at);
            Least {
                certified: least.certified,
                found: least.found,
                at,
                boxes: least.boxes,
                complete: least.complete,
                place,
            }
        };
        Some(Dexterity { point: least(&point), pose: pose.as_ref().map(least) })
    }
}
