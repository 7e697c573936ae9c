//! Chain between two links of a robot.

use std::f64::consts::TAU;

use abbe::LengthUnit;
use abbe_spec::diagnostic::{listed, nearest};
use abbe_spec::option::{BASE, BASE_LINK, FOLD, NamedOption, TIP, TIP_LINK};
use abbe_spec::value::find_name;
use abbe_spec::{Diagnostic, Document, Notes, as_identifier};

use super::robot::{Joint, JointKind, Link, Robot};
use super::tree::{Step, Tree};
use crate::import::AngleRounding;
use crate::import::chain::{Chain, Frame, Geometry, Mass, Motion, Variable};
use crate::placement::Placement;

/// Names of the links at the ends of a chain.
#[derive(Clone, Debug, Default)]
pub struct Ends {
    /// Link that is `F_0`; the root if not given.
    pub base: Option<String>,
    /// Link whose frame is the tool point; the only link without a child if not given.
    pub tip: Option<String>,
}

/// Returns the chain from base to tip; see [`read`](super::read).
pub(super) fn chain(
    robot: &Robot,
    tree: &Tree<'_>,
    ends: &Ends,
    fold: bool,
    angles: &mut AngleRounding,
    document: &Document,
    notes: &mut dyn Notes,
) -> Option<Chain> {
    let names: Vec<&str> = robot.links.iter().map(|link| link.name.as_str()).collect();
    let base = match &ends.base {
        Some(name) => find_link(&BASE, name, &names, document)?,
        None => tree.root(),
    };
    let tip = match &ends.tip {
        Some(name) => find_link(&TIP, name, &names, document)?,
        None => only_tip(tree, &names, document)?,
    };
    let path = tree.path(base, tip);
    let chain_links = || std::iter::once(base).chain(path.iter().map(|step| step.link));
    let faults =
        path.iter().map(|step| &step.joint.faults).chain(chain_links().map(|link| &tree.link(link).faults));
    let faults: Vec<&Diagnostic> = faults.flatten().collect();
    if !faults.is_empty() {
        document.found.borrow_mut().extend(faults.into_iter().cloned());
        return None;
    }
    let mut builder = Builder::new(robot, tree, fold, angles);
    builder.variables(&path, document, notes)?;
    builder.links = chain_links().collect();
    path.iter().for_each(|step| builder.add(step));
    let Builder { variables, frames, mut masses, pending, branches, .. } = builder;
    if frames.is_empty() {
        let message = format!("there is no moving joint between `{}` and `{}`", names[base], names[tip]);
        let help = match path.is_empty() {
            true => "choose a tip after a moving joint".to_owned(),
            false => format!("choose a tip after a moving joint, or leave out `{FOLD}`"),
        };
        return document.refuse(tree.link(tip).span.clone(), message, help);
    }
    robot.notes.iter().for_each(|note| notes.note(note));
    let joints = robot.joints.iter().map(|joint| &joint.faults);
    let beside = joints.chain(robot.links.iter().map(|link| &link.faults)).flatten().chain(&tree.loose);
    for Diagnostic { message, span, .. } in beside {
        let line = document.line(span.as_ref().map_or(0, |span| span.start));
        notes.note(&format!("line {line}, beside the chain and left out: {message}"));
    }
    let moves = |step: &Step<'_>| step.joint.kind != JointKind::Fixed;
    if !masses.is_empty() && tree.path(tree.root(), base).iter().any(moves) {
        masses.clear();
        notes.note(&format!(
            "the base `{}` moves against `{}`, the root: gravity has no fixed direction in it, and no loads are written",
            names[base],
            names[tree.root()]
        ));
    }
    if robot.meshes > 0 {
        notes.note(&format!("{} mesh files are ignored: a spec has no shapes", robot.meshes));
    }
    if !branches.is_empty() {
        notes.note(&format!(
            "moving joints beside the chain are left out, together with their masses: {}",
            listed(&branches)
        ));
    }
    let [base, tip] = [base, tip].map(|link| names[link].to_owned());
    Some(Chain {
        robot: robot.name.clone(),
        description: format!("From {base} to {tip}"),
        length: LengthUnit::Metre,
        degrees: false,
        base,
        tip,
        variables,
        frames,
        tool: pending,
        masses,
    })
}

/// Returns the index of the link that an option names; another name is a mistake.
fn find_link(option: &NamedOption, name: &str, names: &[&str], document: &Document) -> Option<usize> {
    let found = names.iter().position(|link| *link == name);
    if found.is_none() {
        // The mistake is in the option, and has no span in the file.
        let argument = Document::new(option.to_string(), name);
        find_name(&argument, 0..name.len(), name, names, "link");
        let help =
            argument.found.into_inner().into_iter().find_map(|mistake| mistake.help).unwrap_or_default();
        let message = format!("`{option}`: there is no link `{}`", name.escape_debug());
        document.mistake(Diagnostic::whole_file(message).help(help));
    }
    found
}

/// Returns the only link without a child; several are a mistake.
fn only_tip(tree: &Tree<'_>, names: &[&str], document: &Document) -> Option<usize> {
    match tree.tips()[..] {
        [tip] => Some(tip),
        ref several => {
            let several: Vec<&str> = several.iter().map(|&tip| names[tip]).collect();
            document.fail(Diagnostic::whole_file("this robot has more than one tip link").help(format!(
                "choose the link of the tool point: `{TIP_LINK}`, one of {}",
                listed(&several)
            )))
        }
    }
}

/// Size of limits, in turns or metres, from which they stand for none.
const NONE: f64 = 1000.0;

/// Returns the limits of a joint. Asks about those that may be in degrees.
fn limits(joint: &Joint, notes: &mut dyn Notes) -> Option<[f64; 2]> {
    let [lower, upper] = joint.limits?;
    let (largest, is_slide) = (lower.abs().max(upper.abs()), joint.kind == JointKind::Prismatic);
    let (turns, name) = (largest / TAU, joint.name.escape_debug());
    let unit = if is_slide { "m" } else { "rad" };
    if largest >= if is_slide { NONE } else { NONE * TAU } {
        notes.note(&format!("the limits of `{name}`, {lower} to {upper} {unit}, count as none"));
        return None;
    }
    let is_round = [lower, upper].iter().all(|limit| limit % 5.0 == 0.0);
    if !is_slide && (turns > 2.0 || turns > 1.0 && is_round) {
        notes.warn(&format!(
            "the limits of `{name}` are {lower} to {upper} rad, up to {turns:.1} turns: if they are degrees, write `limits = \
             [\"{lower} deg\", \"{upper} deg\"]` in the spec"
        ));
    }
    Some([lower, upper])
}

/// Builds a chain, joint by joint.
struct Builder<'r> {
    robot: &'r Robot,
    tree: &'r Tree<'r>,
    fold: bool,
    angles: &'r mut AngleRounding,
    variables: Vec<Variable>,
    /// Name of each joint that moves, its multiplier and offset, and the index of its variable.
    driven: Vec<(&'r str, [f64; 2], usize)>,
    frames: Vec<Frame>,
    masses: Vec<Mass>,
    /// Links from base to tip.
    links: Vec<usize>,
    /// Pose of the last link in the last frame, or in the base.
    pending: Placement,
    /// Names of the joints that move branches beside the chain.
    branches: Vec<&'r str>,
}

impl<'r> Builder<'r> {
    fn new(robot: &'r Robot, tree: &'r Tree<'r>, fold: bool, angles: &'r mut AngleRounding) -> Self {
        let (variables, driven, frames, masses, links, branches) = Default::default();
        let pending = Placement::default();
        Self { robot, tree, fold, angles, variables, driven, frames, masses, links, pending, branches }
    }

    /// Collects the variables of the joints on the path: their own, or that of the joint that they
    /// follow.
    fn variables(&mut self, path: &[Step<'r>], document: &Document, notes: &mut dyn Notes) -> Option<()> {
        for Step { joint, .. } in path {
            match joint.kind {
                JointKind::Fixed => continue,
                JointKind::Planar | JointKind::Floating => {
                    let message = format!("the joint `{}` moves in several directions", joint.name);
                    let help =
                        format!("write it as several joints, or begin the chain after it: `{BASE_LINK}`");
                    return document.refuse(joint.span.clone(), message, help);
                }
                JointKind::Revolute | JointKind::Continuous | JointKind::Prismatic => {}
            }
            let (leader, [multiplier, offset]) = self.leader(joint, document, notes)?;
            let existing = self.variables.iter().position(|variable| variable.joint == leader.name);
            let variable = existing.unwrap_or_else(|| {
                let limits = limits(leader, notes);
                let is_endless = leader.limits.is_some() && limits.is_none();
                self.variables.push(Variable {
                    name: self.free_name(&leader.name),
                    joint: leader.name.clone(),
                    prismatic: leader.kind == JointKind::Prismatic,
                    limits,
                    continuous: leader.kind == JointKind::Continuous
                        || is_endless && leader.kind == JointKind::Revolute,
                });
                self.variables.len() - 1
            });
            self.driven.push((&joint.name, [multiplier, offset], variable));
        }
        Some(())
    }

    /// Returns the joint whose variable moves a joint, itself if it follows none, with multiplier
    /// and offset.
    fn leader(
        &self,
        joint: &'r Joint,
        document: &Document,
        notes: &mut dyn Notes,
    ) -> Option<(&'r Joint, [f64; 2])> {
        let (mut leader, [mut multiplier, mut offset]) = (joint, [1.0, 0.0]);
        for _ in 0..=self.robot.joints.len() {
            let Some(mimic) = &leader.mimic else {
                let moves =
                    !matches!(leader.kind, JointKind::Fixed | JointKind::Planar | JointKind::Floating);
                if !moves {
                    let message =
                        format!("`{}` mimics `{}`, which has no value of its own", joint.name, leader.name);
                    document.mistake(Diagnostic::new(joint.span.clone(), message).help(
                        "a joint can only mimic a revolute, continuous or prismatic \
                                joint: `<mimic joint=\"…\"/>`",
                    ));
                }
                return moves.then_some((leader, [multiplier, offset]));
            };
            let followed = &mimic.joint.name;
            let names = || self.robot.joints.iter().map(|joint| joint.name.as_str());
            let Some(next) = names().position(|name| name == followed) else {
                let [name, other] = [&leader.name, followed].map(|name| name.escape_debug());
                let meant = nearest(followed, names());
                let meant = meant.map_or(String::new(), |meant| format!(" (is `{meant}` meant?)"));
                notes.warn(&format!(
                    "`{name}` mimics `{other}`, which is no joint{meant}: it was given a variable of its own"
                ));
                return Some((leader, [multiplier, offset]));
            };
            offset += multiplier * mimic.offset;
            multiplier *= mimic.multiplier;
            leader = &self.robot.joints[next];
        }
        let message = format!("`{}` mimics itself through other joints", joint.name);
        document.refuse(joint.span.clone(), message, "remove <mimic> from one of these joints")
    }

    /// Returns an identifier that no other variable has.
    fn free_name(&self, joint: &str) -> String {
        let name = as_identifier(joint);
        let taken = |name: &str| self.variables.iter().any(|variable| variable.name == name);
        let numbered = (2..).map(|number| format!("{name}_{number}"));
        let mut names = std::iter::once(name.clone()).chain(numbered);
        names.find(|name| !taken(name)).unwrap_or(name)
    }

    /// Adds a joint and the link behind it. With the pose `P` of the child link in the parent and
    /// the motion `M(q)` of the joint, the step downward is `P M(q)`, upward `M(−q) P⁻¹`.
    fn add(&mut self, step: &Step<'r>) {
        let Step { joint, link, upward } = *step;
        let rpy = joint.placement.rpy.map(|angle| self.angles.angle(angle));
        let placement = Placement { rpy, ..joint.placement };
        let sign = if upward { -1.0 } else { 1.0 };
        let motion = self.driven.iter().find(|(name, ..)| *name == joint.name).map(
            |&(_, [multiplier, offset], variable)| Motion {
                prismatic: joint.kind == JointKind::Prismatic,
                axis: joint.axis,
                variable,
                multiplier: sign * multiplier,
                with: None,
                offset: sign * offset,
            },
        );
        let (before, after) = match (upward, motion) {
            (false, _) => (self.pending.then(&placement), Placement::default()),
            (true, Some(_)) => (self.pending, placement.inverse()),
            (true, None) => (self.pending.then(&placement.inverse()), Placement::default()),
        };
        if motion.is_none() && self.fold {
            self.pending = before;
        } else {
            self.pending = after;
            let (joint, name) = (joint.name.clone(), self.tree.link(link).name.clone());
            let geometry = Geometry::Origin(before);
            self.frames.push(Frame { joint, link: Some(name), geometry, motion, upward });
        }
        if let Some(frame) = self.frames.len().checked_sub(1) {
            self.add_masses(link, frame);
        }
    }

    /// Adds the masses of a link on the path, and of the links that are fixed to it beside the
    /// path.
    fn add_masses(&mut self, link: usize, frame: usize) {
        let mut rigid = vec![(link, link, self.pending)];
        while let Some((link, from, at)) = rigid.pop() {
            let Link { name, mass, .. } = self.tree.link(link);
            if let Some((kilograms, centre)) = *mass {
                self.masses.push(Mass { link: name.clone(), kilograms, frame, centre: at.point(centre) });
            }
            for (joint, other, placement) in self.tree.neighbours(link) {
                match joint.kind {
                    _ if other == from || self.links.contains(&other) || !joint.faults.is_empty() => {}
                    JointKind::Fixed => rigid.push((other, link, at.then(&placement))),
                    _ => self.branches.push(&joint.name),
                }
            }
        }
    }
}
