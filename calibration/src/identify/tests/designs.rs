//! Designs against exhaustive search, and predicted variances against Monte Carlo.

use super::*;
use crate::by_hand::Puma;
use abbe_core::Component;

/// Compares designs with exhaustive search.
fn brute_force(criterion: Criterion, model_error: f64, targets: Vec<[f64; 3]>) {
    let points = targets.len();
    let model = Model::ideal(&Puma, targets, Uncertainty { length: 1e-4, angle: 1e-3 });
    let unknowns = [
        (1, Component::Roll),
        (2, Component::X),
        (3, Component::Spin),
        (4, Component::Pitch),
        (0, Component::X),
    ];
    let model = model.with(unknowns.map(|(frame, component)| Unknown::Error(frame, component)).to_vec());
    let used = sampled(&Puma, &[0, 1, 2, 3, 4, 5], 20, points);
    let used = model.tool_points(&used).unwrap();
    let objective = Objective { criterion, used: &used, model_error };
    let list = sampled(&Puma, &[1, 2, 3, 4], 13, points);
    let known = identifiable(&model, &list, &[0.0; 5]).unwrap();
    assert_eq!(known.rank, 5);
    let value = |design: &Design| match criterion {
        Criterion::Determinant => -design.log_det,
        Criterion::Variance => design.variance,
    };
    let mut best = f64::INFINITY;
    for set in 0..1_u32 << 13 {
        if set.count_ones() == 4 {
            let part: Vec<Observation> =
                (0..13).filter(|i| set >> i & 1 == 1).map(|i| list[i].clone()).collect();
            if let Some(design) = whole(&model, &part, &known, &objective, &mut |_, _| {}).unwrap() {
                // The library scales columns by the whole list.
                best = best.min(match criterion {
                    Criterion::Determinant => -by_hand(&model, &part, &known, model_error),
                    Criterion::Variance => value(&design),
                });
            }
        }
    }
    let found = optimal(&model, &list, &known, 4, &objective, &mut |_, _| {}).unwrap().unwrap();
    let chosen: Vec<Observation> = found.chosen.iter().map(|i| list[*i].clone()).collect();
    let reached = match criterion {
        Criterion::Determinant => -by_hand(&model, &chosen, &known, model_error),
        Criterion::Variance => value(&found),
    };
    assert!(reached <= best + 1e-9 * best.abs(), "{criterion:?} {reached} but {best} can be had");
}

/// Computes `ln det M` from the inverse of the covariance of the measurements.
fn by_hand(model: &Model, part: &[Observation], known: &Identifiable, model_error: f64) -> f64 {
    let p = known.kept.len();
    let Uncertainty { length, angle } = model.uncertainty;
    let arm = abbe_analysis::sampling::arm_length(&Puma, &model.s).unwrap();
    let mut information = nalgebra::DMatrix::zeros(p, p);
    for seen in part {
        let seen = model.at(&vec![0.0; model.unknowns.len()]).nominally_seen(seen).unwrap();
        let (_, rows) = residuals(model, &seen, &vec![0.0; model.unknowns.len()]);
        let n = rows.len();
        let pose = matches!(seen.measured, Measurement::Pose(_));
        let sigma = |i: usize| if pose && i >= 3 { angle } else { length };
        let jacobian = nalgebra::DMatrix::from_fn(n, p, |i, j| rows[i][known.kept[j]] * sigma(i));
        let covariance = nalgebra::DMatrix::from_fn(n, n, |i, j| {
            let common = if pose && i >= 3 { model_error / arm } else { model_error };
            let noise = if i == j { sigma(i).powi(2) } else { 0.0 };
            let together = if pose { i == j } else { i % 3 == j % 3 };
            noise + if together { common.powi(2) } else { 0.0 }
        });
        information += jacobian.transpose() * covariance.try_inverse().unwrap() * &jacobian;
    }
    information.determinant().ln()
}

#[test]
fn small_designs_are_the_best_of_all() {
    for criterion in [Criterion::Variance, Criterion::Determinant] {
        brute_force(criterion, 0.0, vec![[0.0; 3]]);
        brute_force(criterion, 3e-4, vec![[0.0; 3], [0.1, 0.0, 0.05], [0.0, 0.08, 0.0]]);
        brute_force(criterion, 3e-4, Vec::new());
    }
}

/// The predicted σ of the tool point is that of repeated measurements and fits, also for poses of
/// any orientation.
#[test]
fn the_predicted_deviation_is_found() {
    for points in [1, 0] {
        let model = Model::ideal(&Puma, vec![[0.0; 3]], Uncertainty { length: 1e-4, angle: 2e-4 });
        let model = model.with(model.constants(points == 0));
        let list = sampled(&Puma, &[0, 1, 2, 3, 4, 5], 200, points);
        let zero = vec![0.0; model.unknowns.len()];
        let expect = |list: &[Observation]| -> Vec<Observation> {
            list.iter()
                .map(|seen| model.at(&vec![0.0; model.unknowns.len()]).nominally_seen(seen).unwrap())
                .collect()
        };
        let list = expect(&list);
        let known = identifiable(&model, &list, &zero).unwrap();
        let places: Vec<Observation> = list.iter().skip(3).step_by(20).cloned().collect();
        let used = model.tool_points(&places).unwrap();
        let objective = Objective { criterion: Criterion::Variance, used: &used, model_error: 0.0 };
        let found = optimal(&model, &list, &known, 25, &objective, &mut |_, _| {}).unwrap().unwrap();
        let chosen: Vec<Observation> = found.chosen.iter().map(|i| list[*i].clone()).collect();
        let deviations = used.deviations(&known, &found.covariance);
        let mean_square = deviations.iter().map(|d| d * d).sum::<f64>() / deviations.len() as f64;
        assert!((mean_square / found.variance - 1.0).abs() < 1e-6);
        let mut square = 0.0;
        let runs = 60;
        for run in 0..runs {
            let noise = model.uncertainty;
            let chance = Chance {
                noise,
                outliers: 0.0,
                outlier_size: 0.0,
                random_sources: false,
                one_machine: true,
                seed: run,
            };
            let data = simulate(&model.with(Vec::new()), &chosen, &chance).unwrap();
            let fit = fit(&model, &data, &Options::default()).unwrap();
            for place in &places {
                let mut at = model.at(&zero);
                let wanted = at.pose(place).unwrap().position();
                let pose = model.at(&fit.x).pose(place).unwrap();
                // The unknown position of a single target belongs to the tool point.
                let target = |axis: usize| {
                    let at = |unknown: &Unknown| *unknown == Unknown::Target(0, axis);
                    model.unknowns.iter().position(at).map_or(0.0, |k| fit.x[k])
                };
                let found = pose.apply([target(0), target(1), target(2)]);
                square += (0..3).map(|k| (found[k] - wanted[k]).powi(2)).sum::<f64>() / places.len() as f64;
            }
        }
        // Some 30 unknowns, 60 times: a standard error of about 2 % of σ.
        let ratio = (square / runs as f64 / found.variance).sqrt();
        assert!((ratio - 1.0).abs() < 0.1, "{points}: {ratio}");
    }
}

/// Exchange of many candidates, then of single ones, is hardly worse than of single ones alone, and
/// better than chance.
#[test]
fn exchange_beats_an_even_spread() {
    let model = Model::ideal(&Puma, vec![[0.0; 3]], Uncertainty { length: 1e-4, angle: 1.0 });
    let model = model.with(model.constants(false));
    let list = sampled(&Puma, &[0, 1, 2, 3, 4, 5], 2001, 1);
    let known = identifiable(&model, &list, &vec![0.0; model.unknowns.len()]).unwrap();
    let used = model.tool_points(&list[..200]).unwrap();
    for criterion in [Criterion::Variance, Criterion::Determinant] {
        let objective = Objective { criterion, used: &used, model_error: 0.0 };
        let found = optimal(&model, &list, &known, 40, &objective, &mut |_, _| {}).unwrap().unwrap();
        assert!(found.chosen.len() == 40 && found.chosen.windows(2).all(|pair| pair[0] < pair[1]));
        let even: Vec<Observation> = (0..40).map(|i| list[50 * i].clone()).collect();
        let even = whole(&model, &even, &known, &objective, &mut |_, _| {}).unwrap().unwrap();
        assert!(found.variance < 0.8 * even.variance, "{} {}", found.variance, even.variance);
        assert!(optimal(&model, &list, &known, 3, &objective, &mut |_, _| {}).unwrap().is_none());
        assert!(optimal(&model, &list[..9], &known, 10, &objective, &mut |_, _| {}).unwrap().is_none());
    }
}

/// Errors that move the tool point in use but not in the rows are named; errors equivalent
/// everywhere are not.
#[test]
fn what_a_list_cannot_see_is_named() {
    let model = Model::ideal(&Puma, vec![[0.0; 3]], Uncertainty { length: 1e-4, angle: 1.0 });
    let model = model.with(model.constants(false));
    let everywhere = sampled(&Puma, &[0, 1, 2, 3, 4, 5], 60, 1);
    let used = model.tool_points(&everywhere).unwrap();
    let zero = vec![0.0; model.unknowns.len()];
    let unseen = |list: &[Observation]| used.unseen(&identifiable(&model, list, &zero).unwrap(), |_| 1.0);
    assert_eq!(unseen(&everywhere), []);
    // The elbow does not move: its error translates the rest at home, and rotates it elsewhere.
    let still = sampled(&Puma, &[0, 1, 3, 4, 5], 60, 1);
    assert!(!unseen(&still).is_empty());
}
