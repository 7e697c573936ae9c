//! Poses of the frames below one of them, and motions of these frames.

use abbe_core::Component;
use abbe_spec::{Motion as Kind, Spec, Symbol, motion};

use crate::chain::FrameTwist;
use crate::chain::symbol_jacobian::{Steps, twist};
use crate::chain::walk::walk;
use crate::graph::{Frame, Graph, Six, Vector};

/// Frames that hang on one of them, relative to it. The tool is the frame after the last.
pub(super) struct View<'s> {
    spec: &'s Spec,
    /// The frame that all hang on; `None` for `F_0`.
    root: Option<usize>,
    identity: Frame,
    /// Poses of the frames and the tool; the identity for those that do not hang on the root.
    poses: Vec<Frame>,
    /// Steps of the transform of each frame and of the tool, in the axes of the root.
    steps: Vec<Steps>,
}

/// Motion of a frame, or of the tool, together with all that hang on it, in the axes of the root.
pub(super) type Motion = FrameTwist;

impl<'s> View<'s> {
    /// Follows the frames that hang on a root.
    pub(super) fn new(graph: &mut Graph, spec: &'s Spec, root: Option<usize>) -> Self {
        let identity = graph.identity();
        let (poses, steps) = (Vec::new(), Vec::new());
        let mut view = Self { spec, root, identity, poses, steps };
        for (index, frame) in spec.frames.iter().enumerate() {
            let mut steps = Vec::new();
            let pose = match view.is_below(index) {
                true => walk(graph, *view.pose(frame.parent), &frame.factors, &mut steps),
                false => identity,
            };
            view.poses.push(pose);
            view.steps.push(Steps::new(graph, steps));
        }
        let mut steps = Vec::new();
        let tool = walk(graph, *view.pose(Some(spec.tool_frame)), &spec.tool, &mut steps);
        view.poses.push(tool);
        view.steps.push(Steps::new(graph, steps));
        view
    }

    /// Returns the index of the tool.
    pub(super) fn tool(&self) -> usize {
        self.spec.frames.len()
    }

    /// Returns the poses of all frames.
    pub(super) fn frames(&self) -> &[Frame] {
        &self.poses[..self.tool()]
    }

    /// Returns the pose of a frame or the tool; `None` is `F_0`, or whatever the root hangs on.
    pub(super) fn pose(&self, frame: Option<usize>) -> &Frame {
        frame.map_or(&self.identity, |frame| &self.poses[frame])
    }

    /// Returns `true` if a frame hangs on the root.
    pub(super) fn is_below(&self, frame: usize) -> bool {
        self.root.is_none_or(|root| root != frame && self.spec.carries(root, frame))
    }

    /// Returns `true` if a motion of `frame` moves `other` as well; `None` is `F_0`.
    pub(super) fn moves(&self, frame: usize, other: Option<usize>) -> bool {
        match other {
            None => false,
            Some(other) if other == self.tool() => {
                frame == other || self.spec.carries(frame, self.spec.tool_frame)
            }
            Some(other) => frame < self.tool() && self.spec.carries(frame, other),
        }
    }

    /// Returns the motions of all frames and the tool per unit of a symbol.
    pub(super) fn by_symbol(&self, graph: &mut Graph, symbol: Symbol) -> Vec<Motion> {
        let at_rest = [[graph.zero(); 3]; 2];
        let mut motions = Vec::new();
        for (frame, steps) in self.steps.iter().enumerate() {
            let found = twist(graph, steps, symbol, self.poses[frame].position);
            if found != at_rest {
                let [velocity, rotation] = found;
                motions.push(Motion { frame, velocity, rotation });
            }
        }
        motions
    }

    /// Returns the motion of a frame per unit of one of its errors.
    pub(super) fn by_error(&self, graph: &mut Graph, frame: usize, component: Component) -> Motion {
        let (kind, axis) = motion(component);
        let (along, zero) = (self.poses[frame].axes[axis], [graph.zero(); 3]);
        match kind {
            Kind::Translation => Motion { frame, velocity: along, rotation: zero },
            Kind::Rotation => Motion { frame, velocity: zero, rotation: along },
        }
    }

    /// Returns the motions of all frames below the root due to their errors.
    pub(super) fn by_errors(&self, graph: &mut Graph, errors: &[Six]) -> Vec<Motion> {
        let none = [graph.zero(); 6];
        let mut motions = Vec::new();
        for (frame, errors) in errors.iter().enumerate() {
            if *errors != none && self.is_below(frame) {
                let (shift, turn) = crate::chain::accumulate::vectors(*errors);
                let axes = &self.poses[frame].axes;
                let (velocity, rotation) = (graph.turn(axes, shift), graph.turn(axes, turn));
                motions.push(Motion { frame, velocity, rotation });
            }
        }
        motions
    }

    /// Returns the velocity of the origin of a frame, or of the tool point, and its rotation, under
    /// the motions of some frames; `None` is `F_0`.
    pub(super) fn twist<'m>(
        &self,
        graph: &mut Graph,
        motions: impl IntoIterator<Item = &'m Motion>,
        frame: Option<usize>,
    ) -> [Vector; 2] {
        let point = self.pose(frame).position;
        let mut sum = [[graph.zero(); 3]; 2];
        for motion in motions.into_iter().filter(|motion| self.moves(motion.frame, frame)) {
            let mut velocity = motion.velocity;
            if frame != Some(motion.frame) {
                let lever = graph.sub_vectors(point, self.poses[motion.frame].position);
                velocity = graph.add_cross(velocity, motion.rotation, lever);
            }
            sum = [graph.add_vectors(sum[0], velocity), graph.add_vectors(sum[1], motion.rotation)];
        }
        sum
    }
}
