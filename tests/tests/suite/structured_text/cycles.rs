//! Corrected commands cycle after cycle: the block keeps what the cycle before corrected, and has
//! the bits and the statuses of Rust along paths through singular poses.

use abbe::Manipulator;
use abbe_tests::structured_text::Program;
use abbe_tests::thorough;
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;

use super::{program, set, text};
use crate::compensate::cycles::{Machine, Path, cases};

/// Runs a path through a singular pose at 1 kHz. The thorough run has 1,000 cycles of each machine.
#[test]
fn cycles_have_the_bits_of_rust() {
    for case in cases() {
        let spec = case.robot.spec();
        let program = program(spec);
        let machine = Machine::new(&case.robot);
        let mut random = Xoshiro256PlusPlus::seed_from_u64(7);
        let path = Path::new(&case, &machine, 0, &mut random);
        let mut cycle = machine.first(case.rotations);
        let mut block = program.instance(&format!("{}_compensated", spec.name));
        set(&mut block, "s", &machine.s);
        set(&mut block, "u", &machine.u);
        block.set("rotations", &case.rotations);
        let mut statuses = [0; 8];
        // The singular pose is at the middle.
        let (first, last) = if thorough() { (0, 1000) } else { (485, 515) };
        for k in first..last {
            let q = path.at(f64::from(k) / 1000.0);
            let done = machine.corrected(&q, &cycle).unwrap();
            block.set("q", &q);
            block.call().unwrap_or_else(|fault| panic!("{} stops the controller: {fault}", spec.name));
            let found = ["corrected", "correction", "before", "after"].map(|name| block.get(name));
            let expected = [&done.q[..], &done.correction, &done.before, &done.after];
            assert_eq!(found, expected, "{} in cycle {k}", spec.name);
            let status = block.get("status")[0];
            assert_eq!(status, f64::from(done.status.code()), "{} in cycle {k}", spec.name);
            statuses[status as usize] += 1;
            cycle.last = done.correction;
        }
        println!("{}: {statuses:?}", spec.name);
    }
}

/// Checks the arctangent of the text, which differs from Rust's in the last place: commands agree
/// to 1e-9 rad or m where the pose is reached.
#[test]
fn arctangents_of_the_standard_are_exact_enough() {
    for case in cases() {
        let spec = case.robot.spec();
        let program = Program::parse(&text(spec)).unwrap();
        let machine = Machine::new(&case.robot);
        let mut random = Xoshiro256PlusPlus::seed_from_u64(7);
        let path = Path::new(&case, &machine, 1, &mut random);
        let mut cycle = machine.first(case.rotations);
        let mut block = program.instance(&format!("{}_compensated", spec.name));
        set(&mut block, "s", &machine.s);
        set(&mut block, "u", &machine.u);
        block.set("rotations", &case.rotations);
        let metre = 1.0 / case.robot.description().length.in_metres();
        for k in 0..40 {
            let q = path.at(0.2 + f64::from(k) / 1000.0);
            let done = machine.corrected(&q, &cycle).unwrap();
            block.set("q", &q);
            block.call().unwrap();
            if done.status.code() == 0 {
                for (found, expected) in block.get("corrected").iter().zip(&done.q) {
                    assert!((found - expected).abs() <= 1e-9 * metre, "{}: {found}, {expected}", spec.name);
                }
            }
            cycle.last = done.correction;
        }
    }
}

/// `resume` begins where the drives stand, however far away; without it, a failed cycle changes
/// nothing.
#[test]
fn drives_that_stand_resume_within_the_bound() {
    let program = program(&super::shipped("pps"));
    let mut block = program.instance("pps_compensated");
    block.set("q", &[9.0, 80.0, 987.0, 1.2, 0.02, 0.01]);
    block.call().unwrap();
    let first = block.get("correction");
    assert_eq!(block.get("status"), [5.0], "the bound of the first cycle holds it");
    block.call().unwrap();
    assert_ne!(block.get("correction"), first);
    block.set("inputs", &[1e9, 0.0, 850.0]);
    block.call().unwrap();
    assert_eq!(block.get("status"), [3.0]);
    block.set("inputs", &[70.0, 0.0, 850.0]);
    block.set("resume", &[1.0]);
    let change = block.get("change");
    for standing in [[9.0, 80.0, 987.0, 1.2, 0.02, 0.01], [90.0, 100.0, 900.0, -1.2, -0.05, 0.05]] {
        block.set("standing", &standing);
        block.call().unwrap();
        assert_eq!(block.get("status"), [5.0]);
        for ((drive, standing), most) in block.get("corrected").iter().zip(standing).zip(&change) {
            assert!((drive - standing).abs() <= most + 1e-12 * standing.abs(), "{standing} to {drive}");
        }
    }
    block.set("standing", &[1e31, 0.0, 0.0, 0.0, 0.0, 0.0]);
    block.call().unwrap();
    assert_eq!(block.get("status"), [1.0]);
}
