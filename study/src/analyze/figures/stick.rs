//! Stick figure of the manipulator at home.

use abbe::analysis::Configuration;
use abbe::analysis::sampling::{range_of, vectors::distance};
use abbe::{Error, Manipulator, Pose, tool_pose};
use abbe_spec::{Closure, Spec};
use serde::Serialize;

/// Origins of the frames, base to tip.
#[derive(Clone, Debug, Serialize)]
pub struct Stick {
    /// Distinct origins; several frames may share one.
    pub origins: Vec<FrameOrigin>,
    /// Lines through the origins: one for a chain; one per frame and per leg for a tree.
    #[serde(skip)]
    pub links: Vec<Vec<[f64; 3]>>,
    /// Longest side of the bounding box, in the length unit; 1 if all origins coincide.
    pub size: f64,
}

/// An origin with its frames.
#[derive(Clone, Debug, Serialize)]
pub struct FrameOrigin {
    /// Names of the frames at this origin.
    pub label: String,
    /// Position in `F_0`, in the length unit.
    pub origin: [f64; 3],
    /// Axes of the last frame at this origin, unit vectors in `F_0`.
    pub axes: [[f64; 3]; 3],
}

impl Stick {
    /// Evaluates the frames at the home configuration.
    pub(super) fn at_home(
        manipulator: &dyn Manipulator,
        home: &Configuration,
        spec: &Spec,
    ) -> Result<Self, Error> {
        let description = manipulator.description();
        let frames = &description.frames;
        let mut transforms = vec![Pose::IDENTITY; frames.len() + 1];
        manipulator.transforms(&home.q, &home.s, &mut transforms)?;
        let named = frames.iter().enumerate().map(|(i, frame)| format!("F{} {}", i + 1, frame.name));
        let pose = |frame: Option<usize>| description.frame_pose(&transforms, frame);
        let mut all = vec![("F0".to_owned(), Pose::IDENTITY)];
        all.extend(named.enumerate().map(|(i, name)| (name, pose(Some(i)))));
        let tool = tool_pose(description, &transforms, &[]);
        all.push(("tool point".to_owned(), tool));
        let size = (0..3).map(|axis| {
            let [least, largest] = range_of(all.iter().map(|(_, pose)| pose.position()[axis]));
            largest - least
        });
        let size = size.fold(0.0, f64::max);
        let size = if size > 0.0 { size } else { 1.0 };
        let mut origins: Vec<FrameOrigin> = Vec::new();
        for (label, Pose([x, y, z, origin])) in all {
            let near = |shared: &&mut FrameOrigin| distance(shared.origin, origin) < 1e-6 * size;
            match origins.iter_mut().find(near) {
                Some(shared) => {
                    shared.label += &format!(" · {label}");
                    shared.axes = [x, y, z];
                }
                None => origins.push(FrameOrigin { label, origin, axes: [x, y, z] }),
            }
        }
        let links = if spec.is_serial() {
            vec![origins.iter().map(|place| place.origin).collect()]
        } else {
            let origin = |frame: Option<usize>| pose(frame).position();
            let links = (0..frames.len()).map(|i| vec![origin(description.parent(i)), origin(Some(i))]);
            let legs = spec.loops.iter().filter(|closed| matches!(closed.closure, Closure::Distance(_)));
            let legs = legs.map(|leg| leg.frames.map(origin).to_vec());
            let tool = vec![origin(description.tool_frame()), tool.position()];
            links.chain(legs).chain([tool]).filter(|link| distance(link[0], link[1]) > 1e-6 * size).collect()
        };
        Ok(Self { origins, links, size })
    }
}
