//! Random mechanisms.

use abbe::{Error, Manipulator, laws};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_tests::mechanisms::{Mechanism, is_regular};
use abbe_tests::sample_size;

use super::{interpreter, samples};

/// Mechanisms with one to three loops obey the laws, 50 in a thorough run: `J_e` is the derivative
/// of the machine that closes with errors. Mechanisms that are singular at home, or nearly so, do
/// not count.
#[test]
fn laws_hold_for_random_mechanisms() {
    let (mut held, mut singular) = ([0; 3], 0);
    for seed in 0.. {
        let Mechanism { text, .. } = Mechanism::new(seed);
        let spec = Spec::parse("mechanism.toml", &text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let loops = spec.loops.len();
        let machine = Interpreter::new(spec);
        if !is_regular(&machine) {
            singular += 1;
            continue;
        }
        laws::all(&machine, 4).unwrap_or_else(|failure| panic!("{seed}: {failure}\n{text}"));
        held[loops - 1] += 1;
        if held.iter().sum::<usize>() == 2 * sample_size(25).max(5) {
            break;
        }
    }
    assert!(held.iter().all(|held| *held > 0) && singular < 100, "{held:?} {singular}");
}

/// A mechanism whose passive joints can move by themselves at home has no mode there, and is
/// refused everywhere; its determinant is a rounding error of either sign.
#[test]
fn mechanisms_that_are_singular_at_home_are_refused() {
    let machine = interpreter(&Mechanism::in_millimetres(25).text);
    for q in samples(&machine, 20) {
        assert_eq!(machine.pose(&q, &[]), Err(Error::NotClosed));
    }
}
