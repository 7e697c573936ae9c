//! Tests of `circle.rs`.

use super::*;

/// Readings at angles: `shape` of the angle in rad, for each side.
fn targets(count: usize, shape: impl Fn(f64, usize) -> Vec<f64>) -> Vec<TargetRuns> {
    let target = |k: usize| {
        let angle = 360.0 * k as f64 / count as f64;
        TargetRuns { position: angle, deviations: [0, 1].map(|side| shape(angle.to_radians(), side)) }
    };
    (0..count).map(target).collect()
}

fn near(found: f64, expected: f64) -> bool {
    (found - expected).abs() < 1e-9
}

/// A circle 2 um too large whose centre is elsewhere, an ellipse by a squareness of ± 3 um, and a
/// lag of ± 0.5 um of the two directions.
#[test]
fn a_shifted_ellipse_with_a_lag() {
    let shape = |angle: f64, side: usize| {
        let lag = [0.5, -0.5][side];
        vec![2.0 + 7.0 * angle.cos() - 4.0 * angle.sin() + 3.0 * (2.0 * angle).sin() + lag]
    };
    let found = CircularResult::new(&targets(72, shape), None).unwrap();
    let [up, down] = [found.forward.unwrap(), found.reverse.unwrap()];
    for (path, lag) in [(up, 0.5), (down, -0.5)] {
        assert!(near(path.center[0], 7.0) && near(path.center[1], -4.0), "{path:?}");
        assert!(near(path.circularity.value, 6.0), "{path:?}");
        assert!(near(path.largest.value, 5.0 + lag) && near(path.smallest.value, -1.0 + lag), "{path:?}");
        assert!(path.asynchronous.is_none() && path.total.is_none());
    }
    assert!(near(found.circularity.unwrap().value, 7.0));
    assert!(near(found.hysteresis.unwrap().value, 1.0));
    assert!(near(found.mean.unwrap().value, 2.0));
}

/// An axis of rotation: the mean path is the synchronous error motion, each angle is read 4 times.
#[test]
fn error_motion_of_an_axis_of_rotation() {
    let shape = |angle: f64, side: usize| match side {
        0 => [-1.5, -0.5, 0.5, 1.5].map(|off| 10.0 * angle.cos() + 2.0 * (3.0 * angle).cos() + off).to_vec(),
        _ => vec![],
    };
    let found = CircularResult::new(&targets(60, shape), None).unwrap();
    let path = found.forward.unwrap();
    assert!(near(path.circularity.value, 4.0) && near(path.asynchronous.unwrap(), 3.0), "{path:?}");
    assert!(near(path.total.unwrap(), 7.0), "{path:?}");
    assert!(found.reverse.is_none() && found.circularity.is_none() && found.hysteresis.is_none());
}

/// The uncertainty is that of finite differences of each reading.
#[test]
fn uncertainties_follow_from_every_reading() {
    let shape = |angle: f64, side: usize| {
        let own = 3.0 * (2.0 * angle).sin() + 0.3 * (5.0 * angle + side as f64).cos();
        if side == 0 { vec![own, own + 0.1] } else { vec![own + 0.4 + 0.2 * angle] }
    };
    let readings = targets(40, shape);
    let all = |targets: &[TargetRuns]| {
        let found = CircularResult::new(targets, Some(0.05)).unwrap();
        let [up, down] = [found.forward.unwrap(), found.reverse.unwrap()];
        let both = [found.circularity, found.hysteresis, found.mean].map(Option::unwrap);
        let one = [up, down].map(|path| [path.circularity, path.largest, path.smallest]);
        both.into_iter().chain(one.into_iter().flatten()).collect::<Vec<_>>()
    };
    let found = all(&readings);
    let mut variances = vec![0.0; found.len()];
    for i in 0..readings.len() {
        for side in 0..2 {
            for k in 0..readings[i].deviations[side].len() {
                let mut changed = readings.clone();
                changed[i].deviations[side][k] += 1e-6;
                for (variance, (new, old)) in variances.iter_mut().zip(all(&changed).iter().zip(&found)) {
                    *variance += ((new.value - old.value) / 1e-6 * 0.05).powi(2);
                }
            }
        }
    }
    for (characteristic, variance) in found.iter().zip(variances) {
        let expected = 2.0 * f64::sqrt(variance);
        assert!(
            (characteristic.uncertainty.unwrap() - expected).abs() < 1e-6 * expected,
            "{characteristic:?}"
        );
    }
}

/// A ballbar swings over 220° in the planes of the spindle; less than half of a circle has none.
#[test]
fn arcs() {
    let arc = |degrees: f64| {
        let shape = |angle: f64, _| vec![1.0 + 2.0 * angle.cos()];
        let mut all = targets(72, shape);
        all.retain(|target| target.position <= degrees);
        CircularResult::new(&all, None)
    };
    let found = arc(220.0).unwrap().forward.unwrap();
    assert!(near(found.center[0], 2.0) && found.circularity.value.abs() < 1e-9);
    assert!(arc(170.0).is_none() && arc(175.0).is_none());
    // Three different angles always lie on a circle, however often they are read.
    let few = |count: usize| {
        let mut all = targets(count, |angle, _| vec![angle.cos(), 1.0]);
        all.push(TargetRuns { position: 360.0, ..all[0].clone() });
        CircularResult::new(&all, None)
    };
    assert!(few(3).is_none() && few(4).is_some());
}

/// Extremes are those of every sum of weighted means, whatever the angles are, and a circle of many
/// angles takes time in proportion to them.
#[test]
fn extremes_are_those_of_all_angles() {
    for count in [5, 36, 200_000] {
        let shape = |angle: f64, _| vec![3.0 * (2.0 * angle + 0.3).sin() + (7.0 * angle).cos()];
        let all = targets(count, shape);
        let found = CircularResult::new(&all, None).unwrap().forward.unwrap();
        let of = |target: &TargetRuns| {
            let (sine, cosine) = target.position.to_radians().sin_cos();
            target.deviations[0][0] - found.center[0] * cosine - found.center[1] * sine
        };
        let [least, most] = range_of(all.iter().map(of));
        assert!(near(found.largest.value, most) && near(found.smallest.value, least), "{count}: {found:?}");
        assert!(near(found.circularity.value, most - least), "{count}: {found:?}");
    }
}
