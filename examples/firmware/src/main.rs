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
        wrong[2] = -30.0;
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
}
