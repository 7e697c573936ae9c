//! Cycles of a directed graph: its strongly connected components of more than one node.

/// Returns the nodes of each cycle, sorted. `arrows` lists the successors of each node.
pub(crate) fn circles(arrows: &[Vec<usize>]) -> Vec<Vec<usize>> {
    let reached: Vec<Vec<bool>> = (0..arrows.len()).map(|node| reached(arrows, node)).collect();
    let mut circles: Vec<Vec<usize>> = (0..arrows.len())
        .map(|node| {
            (0..arrows.len()).filter(|other| reached[node][*other] && reached[*other][node]).collect()
        })
        .filter(|circle: &Vec<usize>| circle.len() > 1)
        .collect();
    circles.sort();
    circles.dedup();
    circles
}

/// Returns which nodes are reachable from a node.
fn reached(arrows: &[Vec<usize>], node: usize) -> Vec<bool> {
    let (mut reached, mut open) = (vec![false; arrows.len()], arrows[node].clone());
    while let Some(next) = open.pop() {
        if !std::mem::replace(&mut reached[next], true) {
            open.extend(&arrows[next]);
        }
    }
    reached
}

#[test]
fn a_circle_is_found() {
    assert_eq!(circles(&[vec![1], vec![2], vec![0, 3], vec![4], vec![]]), [[0, 1, 2]]);
    assert!(circles(&[vec![1, 2], vec![2], vec![]]).is_empty());
}
