//! Tests of workspaces by index, and of parallel sweeps.

use super::*;

#[cfg(feature = "parallel")]
#[test]
fn every_number_of_threads_gives_the_same_to_the_last_bit() {
    let workspace = random_joint_samples(&Pps, &[0, 1, 2, 3, 4, 5], 10_000, 5).unwrap();
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut rows = Vec::new();
            let mut visit = |row: &Row| rows.push((row.index, row.repeatable, row.random));
            let budget =
                error_budget(&OneByOne(Pps), &workspace, BudgetOptions::default(), &mut visit).unwrap();
            let drawn = monte_carlo(&OneByOne(Pps), workspace.home(), 10_000, 5).unwrap();
            (budget, rows, drawn)
        })
    };
    let one = run(1);
    assert_eq!(one.1.len(), 10_000);
    assert!(one.1.iter().enumerate().all(|(i, row)| row.0 == i));
    assert_eq!(one, run(2));
    assert_eq!(one, run(7));
}

#[test]
fn a_random_sample_follows_from_seed_and_index() {
    let samples = |count, seed| random_joint_samples(&Pps, &[0, 3], count, seed).unwrap();
    let (few, many, other) = (samples(10, 1), samples(10_000_000_000_000, 1), samples(10, 2));
    for index in 0..10 {
        let sample = few.configuration(index).unwrap();
        assert_eq!(sample, many.configuration(index).unwrap());
        assert_ne!(sample, other.configuration(index).unwrap());
        assert!((0.0..=2256.0).contains(&sample.q[0]) && sample.q[3].abs() <= FRAC_PI_2);
        assert_eq!(sample.q[1], 280.0);
    }
    let mean = (0..10_000).map(|index| many.configuration(index).unwrap().q[0]).sum::<f64>() / 10_000.0;
    assert!((mean - 1128.0).abs() < 3.0 * 2256.0 / 1_200_f64.sqrt() / 10.0, "{mean}");
}

#[test]
fn a_box_is_reached_point_by_point() {
    let points = [grid([-0.2, 0.2], 2), grid([0.3, 0.4], 2), grid([0.3, 0.5], 2)];
    let home = Puma.pose(&home_of(&Puma).q, &home_of(&Puma).s).unwrap();
    for orientation in [ToolOrientation::Free, ToolOrientation::Home] {
        let orientations = vec![orientation];
        let (solved, approaches) = ((0..6).collect(), Vec::new());
        let region = BaseBox { points: points.clone(), orientations, approaches, solved };
        let workspace = base_box(&Puma, &region).unwrap();
        let mut reached = 0;
        for index in 0..workspace.len() {
            let place = [index / 4, index / 2 % 2, index % 2];
            let point = [0, 1, 2].map(|axis| points[axis][place[axis]]);
            assert_eq!(workspace.point(index), Some(point));
            let Ok(Configuration { q, s, .. }) = workspace.configuration(index) else { continue };
            reached += 1;
            let pose = Puma.pose(&q, &s).unwrap();
            assert!((0..3).all(|i| (pose.position()[i] - point[i]).abs() < 1e-9));
            if orientation == ToolOrientation::Home {
                let turned = pose.0[..3].as_flattened().iter().zip(home.0[..3].as_flattened());
                assert!(turned.into_iter().all(|(a, b)| (a - b).abs() < 1e-9));
            }
        }
        assert!(reached >= 4, "{orientation:?}: {reached}");
    }
}

fn home_of(manipulator: &dyn Manipulator) -> Configuration {
    Configuration::home(manipulator.description())
}

#[test]
fn what_cannot_be_reached_is_counted_by_reason() {
    let at = |d1: f64, d2: f64| Configuration { q: vec![d1, d2, 0.0, 0.0, 0.0, 0.0], ..home() };
    let mut configurations = vec![at(-1.0, 0.0); 1500];
    configurations.extend(vec![at(0.0, 561.0); 2000]);
    let nowhere = listed(&Pps, configurations.clone()).unwrap();
    let budget = error_budget(&OneByOne(Pps), &nowhere, BudgetOptions::default(), &mut |_: &Row| {
        panic!("nothing is reached")
    })
    .unwrap();
    assert_eq!((budget.configurations, budget.unreachable.count), (0, 3500));
    assert_eq!(budget.unreachable.first.len(), 1000);
    let kinds = budget.unreachable.reasons.iter().map(|(reason, count)| match reason {
        ReachError::OutsideLimits { variable, .. } => (*variable, *count),
        other => panic!("{other}"),
    });
    assert_eq!(kinds.collect::<Vec<_>>(), [(1, 2000), (0, 1500)]);

    configurations.push(at(5.0, 5.0));
    let somewhere = listed(&Pps, configurations).unwrap();
    let mut visited = Vec::new();
    let budget = error_budget(&OneByOne(Pps), &somewhere, BudgetOptions::default(), &mut |row: &Row| {
        visited.push(row.index);
    })
    .unwrap();
    assert_eq!((budget.configurations, visited), (1, vec![3500]));
    assert_eq!(budget.sources[0].worst, Some(3500));
    // A single point has no range.
    assert_eq!(budget.sources[0].half_peak_to_peak, Figures::default());
    assert!((budget.sources[0].rms - budget.sources[0].plain_max.norm).abs() < 1e-15);
}
