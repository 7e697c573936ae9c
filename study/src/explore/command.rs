//! Options of the commands that give the figures of a page.

use super::Explore;

impl Explore<'_> {
    /// Returns the options of `abbe analyze`, in the order of a command line: the study, its
    /// tolerances, then the changes, as they were given.
    pub(super) fn analyze_options(&self) -> Vec<String> {
        let study = self.study.iter().map(|study| ("study", study.clone()));
        let tolerances = self.analysis.study().stated_tolerances.iter();
        let tolerances = tolerances.map(|tolerance| ("tolerance", tolerance.clone()));
        options(study.chain(tolerances).chain(self.analysis.machine().options_with([])))
    }

    /// Returns the options of `abbe jacobian`, which has no study: the study's own changes, then
    /// those that were given.
    pub(super) fn jacobian_options(&self) -> Vec<String> {
        let machine = self.analysis.machine();
        let changes = self.analysis.study().changes.options(&machine.spec);
        options(changes.into_iter().chain(machine.options_with([])))
    }
}

fn options(named: impl IntoIterator<Item = (&'static str, String)>) -> Vec<String> {
    named.into_iter().flat_map(|(name, value)| [format!("--{name}"), value]).collect()
}
