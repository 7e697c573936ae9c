//! Runs the controller on a host: two seconds at 1 kHz along a path, against the machine's model.

use std::f64::consts::TAU;
use std::time::{Duration, Instant};

use abbe::compensator::{Status, norms};
use abbe::{Orientation, deviation};
use firmware::pps::{self, DESCRIPTION, Inputs, Parameters};
use firmware::{Controller, Fault, Joints};

const PERIOD: Duration = Duration::from_millis(1);
const CYCLES: u32 = 2000;

/// Returns the path at a share of its duration: every variable oscillates over 60 % of its travel,
/// at its own frequency.
fn command(share: f64) -> Joints {
    std::array::from_fn(|j| {
        let [lower, upper] = DESCRIPTION.variables[j].limits;
        (lower + upper) / 2.0 + 0.3 * (upper - lower) * (TAU * share * (j + 1) as f64).sin()
    })
}

/// Returns the position error of the tool for a command, in mm, with the drives at `drives`.
fn off(command: &Joints, drives: &Joints) -> Result<f64, abbe::Error> {
    let ideal = pps::pose(command, &Parameters::NOMINAL)?;
    let real = pps::real_pose(drives, &Parameters::NOMINAL, &Inputs::NOMINAL)?;
    Ok(norms(&deviation(Orientation::RotationVector, &ideal, &real)).0)
}

fn main() -> Result<(), Fault> {
    let mut controller = Controller::new(Parameters::NOMINAL, Inputs::NOMINAL, command(0.0));
    // The correction moves in before the path begins.
    let mut moving_in = 1;
    while controller.cycle(&command(0.0))?.status != Status::Reached {
        moving_in += 1;
    }
    println!("the first correction took {moving_in} cycles");
    let (mut without, mut with, mut slowest) = (0.0_f64, 0.0_f64, Duration::ZERO);
    let begin = Instant::now();
    for cycle in 0..CYCLES {
        let command = command(f64::from(cycle) / f64::from(CYCLES));
        let started = Instant::now();
        let drives = controller.cycle(&command)?.q;
        slowest = slowest.max(started.elapsed());
        without = without.max(off(&command, &command).map_err(Fault::Model)?);
        with = with.max(off(&command, &drives).map_err(Fault::Model)?);
        std::thread::sleep((begin + PERIOD * (cycle + 1)).saturating_duration_since(Instant::now()));
    }
    println!("{CYCLES} cycles of {PERIOD:?}, the slowest correction took {slowest:?}");
    println!("the tool was off by up to {without:.3} mm without correction, {with:.0e} mm with it");
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a controller whose correction has moved in.
    fn begun() -> Controller {
        let mut controller = Controller::new(Parameters::NOMINAL, Inputs::NOMINAL, command(0.0));
        let cycles = (0..20).find(|_| controller.cycle(&command(0.0)).unwrap().status == Status::Reached);
        assert!((1..10).contains(&cycles.unwrap()), "it moves in by 1 mm and 2 mrad a cycle");
        controller
    }

    #[test]
    fn the_tool_is_where_it_should_be() {
        let mut controller = begun();
        for cycle in 0..200 {
            let command = command(f64::from(cycle) / 2000.0);
            let before = *controller.drives();
            let done = controller.cycle(&command).unwrap();
            let [without, with] = [&command, &done.q].map(|drives| off(&command, drives).unwrap());
            assert!(without > 1.0 && with < 1e-6, "{without} mm became {with} mm");
            assert_eq!((done.status, controller.drives()), (Status::Reached, &done.q));
            let moved = (0..3).map(|j| (done.q[j] - before[j]).abs()).fold(0.0, f64::max);
            assert!(moved < 10.0, "{moved} mm in a cycle");
        }
    }

    #[test]
    fn a_fault_holds_the_drives() {
        let mut controller = begun();
        let drives = controller.cycle(&command(0.0)).unwrap().q;
        let mut wrong = command(0.0);
        wrong[2] = f64::NAN;
        assert!(matches!(controller.cycle(&wrong), Err(Fault::Model(_))));
        controller.reset(drives);
        wrong[2] = -30.0;
        assert_eq!(controller.cycle(&wrong), Err(Fault::Elsewhere));
        controller.reset(drives);
        let drives = controller.cycle(&command(0.0)).unwrap().q;
        assert_eq!(controller.cycle(&wrong), Err(Fault::OutsideLimits));
        // A wrong model: an arm a thousand times as soft.
        let soft = Parameters { arm_EI: Parameters::NOMINAL.arm_EI / 1000.0, ..Parameters::NOMINAL };
        let mut soft = Controller::new(soft, Inputs::NOMINAL, drives);
        let faults = (0..60).filter(|_| matches!(soft.cycle(&command(0.0)), Err(Fault::OffTarget(_))));
        assert_eq!(faults.count(), 10);
        assert_eq!(controller.drives(), &drives);
        let far = soft.drives().iter().zip(&command(0.0)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(far <= 20.0 + 1e-9, "{far} mm");
    }

    /// Largest move of a drive in a cycle, beyond that of its command, in bounds of the change.
    fn moved(from: &Joints, to: &Joints, commanded: &Joints, before: &Joints) -> f64 {
        let bounds = pps::first_cycle().change;
        let beyond = |j: usize| (to[j] - from[j]).abs() - (commanded[j] - before[j]).abs();
        (0..from.len()).map(|j| beyond(j) / bounds[j]).fold(0.0, f64::max)
    }

    #[test]
    fn faults_stay_and_paths_resume_where_the_drives_stand() {
        let mut controller = begun();
        for stop in 0..200_u32 {
            // Along the path, until something stops it.
            let mut before = command(f64::from(stop) / 200.0);
            for k in 0..30 {
                let now = command(f64::from(stop) / 200.0 + f64::from(k) / 2000.0);
                let from = *controller.drives();
                let done = controller.cycle(&now).unwrap();
                let beyond = if k == 0 { &now } else { &before };
                assert!(moved(&from, &done.q, &now, beyond) <= 1.0 + 1e-9, "{stop} {k}");
                before = now;
            }
            let standing = *controller.drives();
            let mut wrong = before;
            wrong[(stop % 6) as usize] = [f64::NAN, -1e4, f64::INFINITY][(stop % 3) as usize];
            let fault = controller.cycle(&wrong).unwrap_err();
            for _ in 0..20 {
                // Nothing but a reset ends the fault, whatever the command is.
                assert_eq!(controller.cycle(&before), Err(fault));
                assert_eq!(controller.drives(), &standing);
            }
            // A path elsewhere is refused, and one that begins at the drives moves none of them.
            controller.reset(standing);
            let mut elsewhere = before;
            elsewhere[1] = if before[1] < 280.0 { before[1] + 100.0 } else { before[1] - 100.0 };
            assert_eq!(controller.cycle(&elsewhere), Err(Fault::Elsewhere));
            controller.reset(standing);
            let begin = controller.command().unwrap();
            let done = controller.cycle(&begin).unwrap();
            assert_eq!(done.status, Status::Reached);
            assert!(moved(&standing, &done.q, &begin, &begin) < 1e-6);
            // The next path begins beside the drives, which are pushed while they stand.
            controller.hold();
            let next = command(f64::from(stop + 1) / 200.0);
            let share = f64::from(stop % 7) / 7.0;
            let far = [20.0, 20.0, 20.0, 0.05, 0.01, 0.01];
            controller.reset(std::array::from_fn(|j| next[j] + share * far[j]));
        }
    }
}
