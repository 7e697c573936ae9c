//! Links and joints as a tree, and the path from one link to another.

use std::collections::HashMap;

use abbe_spec::{Diagnostic, Document, diagnostic::Span, value::find_name};

use super::robot::{Joint, Link, Named, Robot};
use crate::placement::Placement;

/// Robot with the connections of its links and joints, by index.
pub(super) struct Tree<'r> {
    robot: &'r Robot,
    /// Joint that carries each link, and its parent link.
    carrier: Vec<Option<(usize, usize)>>,
    /// Joints on each link, and their child links.
    carried: Vec<Vec<(usize, usize)>>,
    /// Joints whose links are not declared.
    pub(super) loose: Vec<Diagnostic>,
}

impl<'r> Tree<'r> {
    /// Checks that the robot is one tree; mistakes go to the document.
    pub(super) fn new(robot: &'r Robot, document: &Document) -> Option<Self> {
        let Robot { links, joints, .. } = robot;
        let before = document.mistakes();
        let indices = unique_indices(links.iter().map(|link| (&link.name, &link.span)), "links", document);
        unique_indices(joints.iter().map(|joint| (&joint.name, &joint.span)), "joints", document);
        let names: Vec<&str> = links.iter().map(|link| link.name.as_str()).collect();
        let link = |Named { name, span }: &Named| match indices.get(name.as_str()) {
            Some(&index) => Some(index),
            None => {
                find_name(document, span.clone(), name, &names, "link");
                None
            }
        };
        let begin = document.mistakes();
        let ends: Vec<_> = joints.iter().map(|joint| (link(&joint.parent), link(&joint.child))).collect();
        let loose = document.found.borrow_mut().split_off(begin);
        let mut carrier: Vec<Option<(usize, usize)>> = vec![None; links.len()];
        let mut carried = vec![Vec::new(); links.len()];
        for (j, ends) in ends.into_iter().enumerate() {
            let (Some(parent), Some(child)) = ends else { continue };
            carried[parent].push((j, child));
            match carrier[child] {
                None => carrier[child] = Some((j, parent)),
                Some((first, _)) => document.mistake(
                    Diagnostic::new(
                        joints[j].child.span.clone(),
                        format!("`{}` is the child of two joints", links[child].name),
                    )
                    .context(joints[first].child.span.clone(), "first joint with this child")
                    .help("a URDF robot is a tree: it cannot describe closed chains"),
                ),
            }
        }
        if joints.is_empty() {
            let mistake = Diagnostic::whole_file("this robot has no joints");
            document.mistake(mistake.help("give the file of the whole robot"));
        }
        if document.mistakes() > before {
            return None;
        }
        let tree = Self { robot, carrier, carried, loose };
        if tree.roots().count() > 1 && !tree.loose.is_empty() {
            document.found.borrow_mut().extend(tree.loose);
            return None;
        }
        tree.check_roots(document)?;
        Some(tree)
    }

    /// Iterates over the links without a parent.
    fn roots(&self) -> impl Iterator<Item = usize> {
        (0..self.carrier.len()).filter(|&link| self.carrier[link].is_none())
    }

    /// Checks that there is one root, and that it carries every link.
    fn check_roots(&self, document: &Document) -> Option<()> {
        let Robot { links, joints, .. } = self.robot;
        let mut roots = self.roots();
        if let (Some(first), Some(second)) = (roots.next(), roots.next()) {
            let message = format!(
                "neither `{}` nor `{}` is the child of a joint",
                links[second].name, links[first].name
            );
            return document.fail(
                Diagnostic::new(links[second].span.clone(), message)
                    .context(links[first].span.clone(), "first root link")
                    .label("second root link")
                    .help(
                        "a URDF robot has one root link: connect the two by a fixed joint, or \
                         remove one",
                    ),
            );
        }
        // With at most one root, a link that the root does not carry is part of a cycle.
        let mut above = vec![false; links.len()];
        let mut waiting: Vec<usize> = self.roots().collect();
        while let Some(link) = waiting.pop() {
            above[link] = true;
            waiting.extend(self.carried[link].iter().map(|(_, child)| child));
        }
        let lost = (0..links.len()).find(|&link| !above[link]);
        if let Some((j, _)) = lost.and_then(|link| self.carrier[link]) {
            let message = format!("the joint `{}` is part of a loop of joints", joints[j].name);
            let help = "a URDF robot is a tree: every link descends from one root link";
            return document.refuse(joints[j].span.clone(), message, help);
        }
        Some(())
    }

    /// Returns the root: the only link without a parent.
    pub(super) fn root(&self) -> usize {
        self.roots().next().unwrap_or(0)
    }

    /// Returns the links without a child.
    pub(super) fn tips(&self) -> Vec<usize> {
        (0..self.carried.len()).filter(|&link| self.carried[link].is_empty()).collect()
    }

    /// Returns a link by its index.
    pub(super) fn link(&self, number: usize) -> &'r Link {
        &self.robot.links[number]
    }

    /// Returns the joint that carries a link, and the parent link.
    pub(super) fn above(&self, link: usize) -> Option<(&'r Joint, usize)> {
        let (joint, parent) = self.carrier[link]?;
        Some((&self.robot.joints[joint], parent))
    }

    /// Iterates over the joints at a link, the links that they connect to it, and the poses of
    /// these in the link if the joints are fixed.
    pub(super) fn neighbours(&self, link: usize) -> impl Iterator<Item = (&'r Joint, usize, Placement)> {
        let carried = self.carried[link].iter().map(|&(joint, child)| {
            let joint = &self.robot.joints[joint];
            (joint, child, joint.placement)
        });
        let above = self.above(link).map(|(joint, parent)| (joint, parent, joint.placement.inverse()));
        carried.chain(above)
    }

    /// Returns the steps from `base` to `tip`: up to the link that carries both, then down.
    pub(super) fn path(&self, base: usize, tip: usize) -> Vec<Step<'r>> {
        let mut up = self.to_root(base);
        let mut down = self.to_root(tip);
        while let (Some((one, _)), Some((other, _))) = (up.last(), down.last())
            && std::ptr::eq(*one, *other)
        {
            up.pop();
            down.pop();
        }
        let up = up.into_iter().map(|(joint, [_, parent])| Step { joint, link: parent, upward: true });
        let down = down.into_iter().rev();
        up.chain(down.map(|(joint, [child, _])| Step { joint, link: child, upward: false })).collect()
    }

    /// Returns the joints from a link to the root, with their child and parent links.
    fn to_root(&self, mut link: usize) -> Vec<(&'r Joint, [usize; 2])> {
        let mut joints = Vec::new();
        while let Some((joint, parent)) = self.above(link) {
            joints.push((joint, [link, parent]));
            link = parent;
        }
        joints
    }
}

/// Step of a chain across a joint.
pub(super) struct Step<'r> {
    pub(super) joint: &'r Joint,
    /// Link behind the joint.
    pub(super) link: usize,
    /// `true` from the child link to the parent.
    pub(super) upward: bool,
}

/// Returns indices by name; a repeated name is a mistake.
fn unique_indices<'a>(
    named: impl Iterator<Item = (&'a String, &'a Span)>,
    what: &str,
    document: &Document,
) -> HashMap<&'a str, usize> {
    let mut first: HashMap<&str, (usize, &Span)> = HashMap::new();
    for (number, (name, span)) in named.enumerate() {
        if let Some((_, other)) = first.get(name.as_str()) {
            let message = format!("two {what} are named `{}`", name.escape_debug());
            let mistake = Diagnostic::new(span.clone(), message).context((*other).clone(), "first one");
            document.mistake(mistake.help("give each its own name"));
        } else {
            first.insert(name, (number, span));
        }
    }
    first.into_iter().map(|(name, (number, _))| (name, number)).collect()
}
