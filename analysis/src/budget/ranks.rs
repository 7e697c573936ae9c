//! Ranks of the sources.

use super::Budget;
use crate::Measurand;

impl Budget {
    /// Returns the rank of each source by its largest position error, 1 for the largest. Equal
    /// errors are ranked in the order of the sources.
    pub fn ranks(&self) -> Vec<usize> {
        self.ranks_for(Measurand::Position)
    }

    /// Returns the rank of each source by its largest error of a measurand.
    pub fn ranks_for(&self, measurand: Measurand) -> Vec<usize> {
        let (sources, _) = self.errors(measurand);
        let norm = |i: usize| sources[i].plain_max.norm;
        let mut order = (0..sources.len()).collect::<Vec<_>>();
        order.sort_by(|&i, &j| norm(j).total_cmp(&norm(i)));
        let mut ranks = vec![0; order.len()];
        for (rank, source) in order.into_iter().enumerate() {
            ranks[source] = rank + 1;
        }
        ranks
    }
}
