//! Interpretations to try for data without a map.

use super::kinematics::Kinematics;
use crate::interpretations::{Chain, Change, SIGNS, Trial};

/// Returns the trials in three stages: single changes and pairs; then pairs of changes of the
/// joints with base and tool elsewhere; then all combinations of signs, alone and with one
/// coupling, and, for up to six joints, all permutations.
pub(super) fn stages(kinematics: &Kinematics) -> impl Iterator<Item = Vec<Trial>> {
    let (joint_changes, end_changes) = (joint_changes(kinematics), end_changes(kinematics));
    let two_elsewhere: Vec<Vec<Change>> = joint_changes
        .iter()
        .filter(|set| set.len() == 2 && !set.iter().any(|one| matches!(one, Change::Zero { .. })))
        .cloned()
        .collect();
    let pairs = move || {
        let trial = |joints: &Vec<Change>| {
            let ends = end_changes.iter().filter(|ends| is_tried_together(joints, ends)).cloned().collect();
            Trial { joints: joints.clone(), ends }
        };
        joint_changes.iter().map(trial).collect()
    };
    let (count, couplings) = (kinematics.kinds().len(), couplings(kinematics));
    let signs_and_orders = move || {
        let ends = [vec![], vec![Change::PoseInverted], vec![Change::BaseElsewhere, Change::ToolElsewhere]];
        let trial = |joints| Trial { joints, ends: ends.to_vec() };
        signs_and_orders(count, &couplings).into_iter().map(trial).collect()
    };
    let elsewhere = move || {
        let ends = vec![Change::BaseElsewhere, Change::ToolElsewhere];
        two_elsewhere.into_iter().map(|joints| Trial { joints, ends: vec![ends.clone()] }).collect()
    };
    std::iter::once_with(pairs)
        .chain(std::iter::once_with(elsewhere))
        .chain(std::iter::once_with(signs_and_orders))
}

/// Returns changes of the joints: none, single ones, and pairs.
fn joint_changes(kinematics: &Kinematics) -> Vec<Vec<Change>> {
    let count = kinematics.kinds().len();
    let mut all: Vec<Change> = (0..count).map(|joint| Change::Reversed(vec![joint])).collect();
    let pairs = (0..count).flat_map(|j| (0..j).map(move |i| (i, j)));
    all.extend(pairs.map(|(i, j)| Change::exchanged(i, j, count)));
    if count > 3 {
        // Cyclic and reversed orders; with up to three joints these are the swaps above.
        all.push(Change::Order((0..count).rev().collect()));
        all.push(Change::Order((0..count).map(|i| (i + 1) % count).collect()));
        all.push(Change::Order((0..count).map(|i| (i + count - 1) % count).collect()));
    }
    all.extend(couplings(kinematics));
    all.extend((0..count).map(|joint| Change::Zero { joint, offset: 0.0 }));
    if kinematics.other.is_some() {
        all.push(Change::Convention);
    }
    up_to_pairs(&all)
}

/// Returns the couplings of joints with those before them.
fn couplings(kinematics: &Kinematics) -> Vec<Change> {
    let kinds = kinematics.kinds();
    let alike = (1..kinds.len()).filter(|joint| kinds[*joint] == kinds[joint - 1]);
    alike.flat_map(|joint| [1.0, -1.0].map(|by| Change::Coupled { joint, to: joint - 1, by })).collect()
}

/// Returns changes of base, tool and pose: none, single ones, and pairs.
fn end_changes(kinematics: &Kinematics) -> Vec<Vec<Change>> {
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

/// Returns true if one change makes the other meaningless.
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
    // Two permutations, or two signs of one coupling, cannot be combined.
    sets.retain(|set| match &set[..] {
        [Change::Order(_), Change::Order(_)] => false,
        [Change::Coupled { joint, .. }, Change::Coupled { joint: other, .. }] => joint != other,
        _ => true,
    });
    sets
}

/// Returns true if these changes of joints and ends are tried together: at most two in all, or with
/// a fitted base or tool at most one of the joints.
fn is_tried_together(joint_changes: &[Change], end_changes: &[Change]) -> bool {
    let is_fitted = |change: &Change| matches!(change, Change::BaseElsewhere | Change::ToolElsewhere);
    let zero = joint_changes.iter().any(|change| matches!(change, Change::Zero { .. }));
    if end_changes.iter().any(is_fitted) {
        return !zero && joint_changes.len() <= 1;
    }
    joint_changes.len() + end_changes.len() <= 2
}

/// Returns all combinations of more than two signs, or of more than one with a coupling, and all
/// permutations of four to six joints.
fn signs_and_orders(count: usize, couplings: &[Change]) -> Vec<Vec<Change>> {
    let mut sets = Vec::new();
    if count <= SIGNS {
        let all: Vec<usize> = (0..count).collect();
        let several = |least: usize| Change::reversals(&all).filter(move |signs| signs.cost() >= least);
        sets.extend(several(3).map(|signs| vec![signs]));
        let coupled = couplings.iter().flat_map(|one| several(2).map(|signs| vec![signs, one.clone()]));
        sets.extend(coupled);
    }
    if (4..=6).contains(&count) {
        sets.extend(permutations(count).into_iter().map(|order| vec![Change::Order(order)]));
    }
    sets
}

fn permutations(count: usize) -> Vec<Vec<usize>> {
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
