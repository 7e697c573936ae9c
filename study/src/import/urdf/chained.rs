//! What lies between two links of a robot.

use abbe::LengthUnit;
use abbe_spec::as_identifier;
use abbe_spec::diagnostic::{Diagnostic, listed};
use abbe_spec::document::Document;

use super::robot::{Joint, JointKind, Link, Robot};
use super::tree::Tree;
use crate::import::almost::Almost;
use crate::import::chain::{Chain, Frame, Mass, Motion, Variable};
use crate::import::geometry::Geometry;
use crate::import::placement::Placement;
use crate::notes::Notes;

/// The links at the ends of a chain, as somebody asks for them.
#[derive(Clone, Debug, Default)]
pub(in crate::import) struct Ends {
    /// The root if not given.
    pub(in crate::import) base: Option<String>,
    /// The only link that carries nothing, if not given.
    pub(in crate::import) tip: Option<String>,
}

/// The chain from base to tip, fixed joints put into what follows them if that is asked for; what is wrong goes to the document,
/// what is left out to the notes.
pub(super) fn chain(
    robot: &Robot,
    tree: &Tree<'_>,
    ends: &Ends,
    fold: bool,
    almost: &mut Almost,
    document: &mut Document,
    notes: &mut dyn Notes,
) -> Option<Chain> {
    let names: Vec<&str> = robot.links.iter().map(|link| link.name.as_str()).collect();
    let base = match &ends.base {
        Some(name) => named("--base", name, &names, document)?,
        None => tree.root(),
    };
    let tip = match &ends.tip {
        Some(name) => named("--tip", name, &names, document)?,
        None => only_tip(tree, &names, document)?,
    };
    let Some(way) = tree.way(base, tip) else {
        let message = format!("`{}` does not hang on `{}`", names[tip], names[base]);
        let mut above = tip;
        while let Some((_, parent)) = tree.above(above) {
            above = parent;
        }
        let help = format!(
            "the chain begins at a link that carries the tip: `--base {}`, or one between",
            names[above]
        );
        let mistake = Diagnostic::new(tree.link(tip).span.clone(), message)
            .context(tree.link(base).span.clone(), "the base")
            .label("the tip");
        document.mistake(mistake.help(help));
        return None;
    };
    let mut builder = Builder::new(robot, tree, fold, almost);
    builder.variables(&way, document)?;
    for (i, (joint, link)) in way.iter().enumerate() {
        builder.add(joint, *link, way.get(i + 1).map(|(_, next)| *next));
    }
    let Builder { variables, frames, masses, waiting, beside, .. } = builder;
    if frames.is_empty() {
        let message = format!("nothing moves between `{}` and `{}`", names[base], names[tip]);
        let help = match way.is_empty() {
            true => "name a tip behind a joint that moves",
            false => "name a tip behind a joint that moves, or leave out `--fold`",
        };
        document.mistake(Diagnostic::new(tree.link(tip).span.clone(), message).help(help));
        return None;
    }
    if robot.meshes > 0 {
        notes.note(&format!("the files of {} shapes are not read: a spec has no shapes", robot.meshes));
    }
    if !beside.is_empty() {
        notes.note(&format!(
            "what moves beside the chain is left out, with its masses: the joints {}",
            listed(&beside)
        ));
    }
    let [base, tip] = [base, tip].map(|link| names[link].to_owned());
    Some(Chain {
        robot: robot.name.clone(),
        origin: format!("From {base} to {tip}"),
        length: LengthUnit::Metre,
        degrees: false,
        base,
        tip,
        variables,
        frames,
        tool: waiting,
        masses,
    })
}

fn named(option: &str, name: &str, names: &[&str], document: &mut Document) -> Option<usize> {
    let found = names.iter().position(|known| *known == name);
    if found.is_none() {
        // The mistake is in the option: it has no place in the file.
        let mut asked = Document::new(option, name);
        abbe_spec::value::find_name(&mut asked, 0..name.len(), name, names, "link");
        let help = asked.found.into_iter().find_map(|mistake| mistake.help).unwrap_or_default();
        let message = format!("`{option}`: there is no link `{}`", name.escape_debug());
        document.mistake(Diagnostic::whole_file(message).help(help));
    }
    found
}

fn only_tip(tree: &Tree<'_>, names: &[&str], document: &mut Document) -> Option<usize> {
    match tree.tips()[..] {
        [tip] => Some(tip),
        ref several => {
            let several: Vec<&str> = several.iter().map(|&tip| names[tip]).collect();
            document.mistake(
                Diagnostic::whole_file("this robot has more than one last link")
                    .help(format!("say where the tool point is: `--tip LINK`, one of {}", listed(&several))),
            );
            None
        }
    }
}

struct Builder<'r> {
    robot: &'r Robot,
    tree: &'r Tree<'r>,
    fold: bool,
    almost: &'r mut Almost,
    variables: Vec<Variable>,
    /// The variable of each joint that moves, by the joint's name, with multiplier and offset.
    driven: Vec<(&'r str, [f64; 2], usize)>,
    frames: Vec<Frame>,
    masses: Vec<Mass>,
    /// Fixed joints since the last frame, in one.
    waiting: Placement,
    /// Joints that move something beside the chain.
    beside: Vec<&'r str>,
}

impl<'r> Builder<'r> {
    fn new(robot: &'r Robot, tree: &'r Tree<'r>, fold: bool, almost: &'r mut Almost) -> Self {
        let (variables, driven, frames, masses, beside) = Default::default();
        let waiting = Placement::default();
        Self { robot, tree, fold, almost, variables, driven, frames, masses, waiting, beside }
    }

    /// The variables of the joints on the way: their own, or that of the joint that they follow.
    fn variables(&mut self, way: &[(&'r Joint, usize)], document: &mut Document) -> Option<()> {
        for (joint, _) in way {
            match joint.kind {
                JointKind::Fixed => continue,
                JointKind::Planar | JointKind::Floating => {
                    let message = format!("the joint `{}` moves in several directions at once", joint.name);
                    document.mistake(
                        Diagnostic::new(joint.span.clone(), message)
                            .help("write it as several joints, or begin the chain behind it: `--base LINK`"),
                    );
                    return None;
                }
                JointKind::Revolute | JointKind::Continuous | JointKind::Prismatic => {}
            }
            let (leader, [multiplier, offset]) = self.leader(joint, document)?;
            let known = self.variables.iter().position(|variable| variable.joint == leader.name);
            let variable = known.unwrap_or_else(|| {
                self.variables.push(Variable {
                    name: self.free_name(&leader.name),
                    joint: leader.name.clone(),
                    prismatic: leader.kind == JointKind::Prismatic,
                    limits: leader.limits,
                    continuous: leader.kind == JointKind::Continuous,
                });
                self.variables.len() - 1
            });
            self.driven.push((&joint.name, [multiplier, offset], variable));
        }
        Some(())
    }

    /// The joint that moves a joint, itself if it follows none, with `multiplier` and `offset`.
    fn leader(&self, joint: &'r Joint, document: &mut Document) -> Option<(&'r Joint, [f64; 2])> {
        let (mut leader, [mut multiplier, mut offset]) = (joint, [1.0, 0.0]);
        for _ in 0..=self.robot.joints.len() {
            let Some(mimic) = &leader.mimic else {
                let moves =
                    !matches!(leader.kind, JointKind::Fixed | JointKind::Planar | JointKind::Floating);
                if !moves {
                    let message =
                        format!("`{}` follows `{}`, which has no value of its own", joint.name, leader.name);
                    document.mistake(
                        Diagnostic::new(joint.span.clone(), message)
                            .help("a joint follows one that turns or slides: `<mimic joint=\"…\"/>`"),
                    );
                }
                return moves.then_some((leader, [multiplier, offset]));
            };
            let names: Vec<&str> = self.robot.joints.iter().map(|joint| joint.name.as_str()).collect();
            let followed = &mimic.joint;
            let next = abbe_spec::value::find_name(
                document,
                followed.span.clone(),
                &followed.name,
                &names,
                "joint",
            )?;
            offset += multiplier * mimic.offset;
            multiplier *= mimic.multiplier;
            leader = &self.robot.joints[next];
        }
        let message = format!("`{}` follows itself over other joints", joint.name);
        document.mistake(
            Diagnostic::new(joint.span.clone(), message)
                .help("one of the joints must move by itself: leave its <mimic> out"),
        );
        None
    }

    /// A name that no other variable has.
    fn free_name(&self, joint: &str) -> String {
        let name = as_identifier(joint);
        let taken = |name: &str| self.variables.iter().any(|variable| variable.name == name);
        let numbered = (2..).map(|number| format!("{name}_{number}"));
        let mut names = std::iter::once(name.clone()).chain(numbered);
        names.find(|name| !taken(name)).unwrap_or(name)
    }

    /// A joint, the link that it carries, and the link that comes then.
    fn add(&mut self, joint: &'r Joint, link: usize, next: Option<usize>) {
        let rpy = joint.placement.rpy.map(|angle| self.almost.angle(angle));
        let placement = Placement { rpy, ..joint.placement };
        let placement = self.waiting.then(&placement);
        let motion = self.driven.iter().find(|(name, ..)| *name == joint.name).map(
            |&(_, [multiplier, offset], variable)| Motion {
                prismatic: joint.kind == JointKind::Prismatic,
                axis: joint.axis,
                variable,
                multiplier,
                offset,
            },
        );
        if motion.is_none() && self.fold {
            self.waiting = placement;
        } else {
            self.waiting = Placement::default();
            let (joint, link) = (joint.name.clone(), self.tree.link(link).name.clone());
            let geometry = Geometry::Origin(placement);
            self.frames.push(Frame { joint, link: Some(link), geometry, motion });
        }
        if let Some(frame) = self.frames.len().checked_sub(1) {
            self.weigh(link, next, frame);
        }
    }

    /// The masses of a link on the chain, and of what is fixed to it beside the chain.
    fn weigh(&mut self, link: usize, next: Option<usize>, frame: usize) {
        let mut rigid = vec![(link, self.waiting)];
        while let Some((link, at)) = rigid.pop() {
            let Link { name, mass, .. } = self.tree.link(link);
            if let Some((kilograms, centre)) = *mass {
                self.masses.push(Mass { link: name.clone(), kilograms, frame, centre: at.point(centre) });
            }
            for (joint, child) in self.tree.carried(link).filter(|(_, child)| Some(*child) != next) {
                match joint.kind {
                    JointKind::Fixed => rigid.push((child, at.then(&joint.placement))),
                    _ => self.beside.push(&joint.name),
                }
            }
        }
    }
}
