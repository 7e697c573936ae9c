//! The interpretations that are tried where nothing is stated.

use super::kinematics::Kinematics;
use crate::interpretations::{Chain, Change, Trial};

/// Differences one by one and in pairs; then every choice of signs and, of up to six joints, every order.
pub(super) fn stages(kinematics: &Kinematics) -> impl Iterator<Item = Vec<Trial>> {
    let (of_joints, of_ends) = (of_joints(kinematics), of_ends(kinematics));
    let pairs = move || {
        let trial = |joints: &Vec<Change>| {
            let ends = of_ends.iter().filter(|ends| are_tried(joints, ends)).cloned().collect();
            Trial { joints: joints.clone(), ends }
        };
        of_joints.iter().map(trial).collect()
    };
    let count = kinematics.kinds().len();
    let further = move || {
        let ends = [vec![], vec![Change::PoseInverted], vec![Change::BaseElsewhere, Change::ToolElsewhere]];
        let trial = |joints| Trial { joints, ends: ends.to_vec() };
        further(count).into_iter().map(trial).collect()
    };
    std::iter::once_with(pairs).chain(std::iter::once_with(further))
}

/// Changes of the joints, one alone and two together, none first.
fn of_joints(kinematics: &Kinematics) -> Vec<Vec<Change>> {
    let kinds = kinematics.kinds();
    let count = kinds.len();
    let mut all: Vec<Change> = (0..count).map(|joint| Change::Reversed(vec![joint])).collect();
    let pairs = (0..count).flat_map(|j| (0..j).map(move |i| (i, j)));
    all.extend(pairs.map(|(i, j)| Change::exchanged(i, j, count)));
    if count > 3 {
        // Two or three of them are swapped then.
        all.push(Change::Order((0..count).rev().collect()));
        all.push(Change::Order((0..count).map(|i| (i + 1) % count).collect()));
        all.push(Change::Order((0..count).map(|i| (i + count - 1) % count).collect()));
    }
    for joint in 1..count {
        if kinds[joint] == kinds[joint - 1] {
            all.extend([1.0, -1.0].map(|by| Change::Coupled { joint, to: joint - 1, by }));
        }
    }
    all.extend((0..count).map(|joint| Change::Zero { joint, offset: 0.0 }));
    if kinematics.has_convention() {
        all.push(Change::Convention);
    }
    up_to_pairs(&all)
}

/// Changes of base, tool and poses, one alone and two together, none first.
fn of_ends(kinematics: &Kinematics) -> Vec<Vec<Change>> {
    let mut all = vec![Change::PoseInverted, Change::BaseElsewhere, Change::ToolElsewhere];
    if kinematics.has_tool {
        all.extend([Change::ToolInverted, Change::ToolLeftOut]);
    }
    if kinematics.has_base() {
        all.extend([Change::BaseInverted, Change::BaseLeftOut]);
    }
    if kinematics.has_tool || kinematics.has_base() {
        all.push(Change::EndsExchanged);
    }
    let mut sets = up_to_pairs(&all);
    sets.retain(|set| !set.iter().any(|one| set.iter().any(|other| excludes(one, other))));
    sets
}

/// Tells whether one makes the other meaningless.
fn excludes(one: &Change, other: &Change) -> bool {
    use Change::{
        BaseElsewhere, BaseInverted, BaseLeftOut, EndsExchanged, ToolElsewhere, ToolInverted, ToolLeftOut,
    };
    matches!(
        (one, other),
        (ToolInverted, ToolLeftOut | ToolElsewhere)
            | (ToolLeftOut, ToolElsewhere)
            | (BaseInverted, BaseLeftOut | BaseElsewhere)
            | (BaseLeftOut, BaseElsewhere)
            | (EndsExchanged, BaseElsewhere | ToolElsewhere | BaseLeftOut | ToolLeftOut)
    )
}

fn up_to_pairs(all: &[Change]) -> Vec<Vec<Change>> {
    let mut sets = vec![Vec::new()];
    sets.extend(all.iter().map(|change| vec![change.clone()]));
    for (i, second) in all.iter().enumerate() {
        sets.extend(all[..i].iter().map(|first| vec![first.clone(), second.clone()]));
    }
    // Two orders, or two signs, are one of each kind.
    sets.retain(|set| match &set[..] {
        [Change::Order(_), Change::Order(_)] => false,
        [Change::Coupled { joint, .. }, Change::Coupled { joint: other, .. }] => joint != other,
        _ => true,
    });
    sets
}

/// Tells whether changes of joints and of ends are tried together: two in all, and one of the joints whatever base and tool are.
fn are_tried(of_joints: &[Change], of_ends: &[Change]) -> bool {
    let is_fitted = |change: &Change| matches!(change, Change::BaseElsewhere | Change::ToolElsewhere);
    let zero = of_joints.iter().any(|change| matches!(change, Change::Zero { .. }));
    if of_ends.iter().any(is_fitted) {
        return !zero && of_joints.len() <= 1;
    }
    of_joints.len() + of_ends.len() <= 2
}

/// Every order of up to six joints, and every choice of signs.
fn further(count: usize) -> Vec<Vec<Change>> {
    let mut sets = Vec::new();
    if count <= 8 {
        for signs in 0..1_u32 << count {
            let joints: Vec<usize> = (0..count).filter(|i| signs >> i & 1 == 1).collect();
            if joints.len() > 2 {
                sets.push(vec![Change::Reversed(joints)]);
            }
        }
    }
    if (4..=6).contains(&count) {
        sets.extend(orders(count).into_iter().map(|order| vec![Change::Order(order)]));
    }
    sets
}

fn orders(count: usize) -> Vec<Vec<usize>> {
    let mut all = vec![Vec::new()];
    for _ in 0..count {
        let longer = |order: &Vec<usize>| {
            let free = (0..count).filter(|i| !order.contains(i));
            free.map(|i| [&order[..], &[i]].concat()).collect::<Vec<_>>()
        };
        all = all.iter().flat_map(longer).collect();
    }
    all
}
