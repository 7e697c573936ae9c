//! Loops along the frames, and the helper routines that several functions share.

use abbe_core::function::Count;

use super::{Body, FrameLoops, POSE, RoutineBuilder};
use crate::chain::displaced;
use crate::graph::Six;
use crate::program::{Array, ArrayRows, Block, Operations, Program, Role, Routine, Row, Stage};

/// Dimensions of the poses of the base, of all frames and of the tool.
const CHAIN: [Count; 3] = [Count::BaseToTool, POSE[0], POSE[1]];

/// Returns the helper routines: terms, links and frames.
pub(super) fn helpers(loops: &FrameLoops<'_>) -> Vec<Routine> {
    let array = |name, shape: &[Count], role| Array { name, shape: shape.to_vec(), role };
    let terms = |role| array("terms", &[Count::Exactly(loops.terms.len())], role);
    let routine = |name, documentation, arrays, stages| Routine {
        function: None,
        name,
        documentation,
        arrays,
        stages,
        operations: Operations::default(),
    };

    let [q, s] = [("q", Count::Variables), ("s", Count::Parameters)]
        .map(|(name, count)| array(name, &[count], Role::Argument));
    let program = Program::new(&loops.model.graph, &loops.terms);
    let writes = vec![ArrayRows::all(2)];
    let once = Stage::Block(Block { reads: vec![], program, writes, repeated: None });
    let arrays = vec![q, s, terms(Role::Result)];
    let terms_of_q =
        routine("chain_terms", "Terms of which the entries of all transforms are sums.", arrays, vec![once]);

    let sums = Stage::Sums { sums: loops.motions, terms: 0, entries: 1 };
    let arrays = vec![terms(Role::Argument), array("links", &CHAIN, Role::Result)];
    let links = routine("chain_links", "Identity, `A_1 … A_n` and the tool transform.", arrays, vec![sums]);

    let mut arrays = vec![terms(Role::Argument), array("frames", &CHAIN, Role::Result)];
    let mut draft = RoutineBuilder::new(loops, &mut arrays);
    draft.walk();
    let stages = draft.stages;
    let frames = routine("chain_frames", "Poses of `F_0 … F_n` and the tool in `F_0`.", arrays, stages);
    vec![terms_of_q, links, frames]
}

impl RoutineBuilder<'_, '_> {
    /// Computes the terms that the entries of all transforms are sums of.
    pub(super) fn terms(&mut self) -> usize {
        let (q, s) = (self.array("q"), self.array("s"));
        let terms = self.zeros("terms", &[Count::Exactly(self.loops.terms.len())]);
        self.call("chain_terms", &[q, s, terms]);
        terms
    }

    /// Computes the identity, `A_1 … A_n` and the tool transform.
    pub(super) fn links(&mut self) -> usize {
        let terms = self.terms();
        let links = self.zeros("links", &CHAIN);
        self.call("chain_links", &[terms, links]);
        links
    }

    /// Computes `F_0 … F_n` and the tool in `F_0` from the terms.
    pub(super) fn frames(&mut self, terms: usize) -> usize {
        let frames = self.zeros("frames", &CHAIN);
        self.call("chain_frames", &[terms, frames]);
        frames
    }

    /// Computes `F_i = F_{i-1} A_i` from the base to the tip. Each frame overwrites the link to it.
    fn walk(&mut self) {
        let [terms, frames] = ["terms", "frames"].map(|name| self.array(name));
        self.call("chain_links", &[terms, frames]);
        let mut body = Body::default();
        let (at, link) = (body.frame(frames, Row::EACH), body.frame(frames, Row::NEXT));
        let next = body.graph.then(&at, &link);
        body.write(frames, Row::NEXT, &next.entries());
        self.each(Count::FramesAndTool, body);
    }

    /// Computes `A_1 … A_n` and the tool transform.
    pub(super) fn transforms(&mut self) {
        let links = self.links();
        let transforms = self.array("transforms");
        self.copy(links, Row::AllButFirst, transforms);
    }

    /// Computes equation (2) from the tip to the base: `X ← A_i X`, starting with the tool.
    pub(super) fn pose(&mut self) {
        let links = self.links();
        let pose = self.array("pose");
        self.copy(links, Row::Last, pose);
        let mut body = Body::default();
        let (link, behind) = (body.frame(links, Row::NEXT), body.frame(pose, Row::All));
        let next = body.graph.then(&link, &behind);
        body.write(pose, Row::All, &next.entries());
        self.backwards(body);
    }

    /// Computes equation (6) from the base to the tip: `X ← X A_i E_i`, where the tool has no
    /// error. The errors are the given ones, or ε.
    pub(super) fn real_pose(&mut self, errors: Option<&[Six]>) {
        let errors = match errors {
            Some(errors) => self.errors(errors),
            None => self.generalized_errors(),
        };
        let links = self.links();
        let pose = self.array("pose");
        self.copy(links, Row::First, pose);
        let mut body = Body::default();
        let (at, link) = (body.frame(pose, Row::All), body.frame(links, Row::NEXT));
        let errors = body.six(errors, Row::EACH);
        let nominal = body.graph.then(&at, &link);
        let real = displaced(&mut body.graph, nominal, &errors);
        body.write(pose, Row::All, &real.entries());
        self.each(Count::Frames, body);
        let mut body = Body::default();
        let (at, tool) = (body.frame(pose, Row::All), body.frame(links, Row::Last));
        let next = body.graph.then(&at, &tool);
        body.write(pose, Row::All, &next.entries());
        self.once(body);
    }

    /// Computes six errors for every frame, one by one.
    fn errors(&mut self, errors: &[Six]) -> usize {
        let array = self.zeros("errors", &[Count::Frames, Count::Exactly(6)]);
        let program = Program::new(&self.loops.model.graph, errors.as_flattened());
        let writes = vec![ArrayRows::all(array)];
        self.stages.push(Stage::Block(Block { reads: vec![], program, writes, repeated: None }));
        array
    }

    /// Computes ε of the repeatable sources.
    pub(super) fn generalized_errors(&mut self) -> usize {
        let [q, s, u] = ["q", "s", "u"].map(|name| self.array(name));
        let errors = self.zeros("errors", &[Count::Frames, Count::Exactly(6)]);
        self.call("generalized_errors", &[q, s, u, errors]);
        errors
    }
}
