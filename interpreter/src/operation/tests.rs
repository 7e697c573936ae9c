//! Tests of `operation.rs`.

use abbe_codegen::chain::Model;
use abbe_codegen::program::Routines;
use abbe_spec::Spec;

use super::*;

/// Checks that every step runs once, and after everything that it reads: the results of other
/// chains, and of the step before it.
#[test]
fn nothing_is_read_before_it_is_made() {
    let frame = |i: usize| {
        format!(
            "[[frame]]\nname = \"{i}\"\nvariable = {{ name = \"q{i}\", kind = \"revolute\" }}\n\
             dh = {{ theta = \"q{i}\", d = 0.1, a = 0.3, alpha = 0.{i} }}\n"
        )
    };
    let frames: String = (1..=5).map(frame).collect();
    let text = format!("[manipulator]\nname = \"arm\"\nlength = \"m\"\n{frames}");
    let spec = Spec::parse("arm.toml", &text).unwrap();
    let routines = Routines::new(&spec, &Model::new(&spec));
    let (mut all_steps, mut all_chains) = (0, 0);
    for program in routines.programs() {
        let chains = chains(program);
        let mut made = vec![false; program.registers];
        let mut run = vec![false; program.steps.len()];
        for chain in &chains {
            let mut between = None;
            for at in chain {
                let step = &program.steps[*at];
                let reads = |register: usize| {
                    step.action.operands().any(|operand| operand == Operand::Register(register))
                };
                assert!(between.is_none_or(reads));
                for operand in step.action.operands() {
                    let Operand::Register(register) = operand else { continue };
                    assert!(made[register] || between == Some(register));
                }
                between = Some(step.register);
                assert!(!std::mem::replace(&mut run[*at], true));
            }
            let last = &program.steps[chain[chain.len() - 1]];
            made[last.register] = true;
            if matches!(last.action, Action::SinCos(_)) {
                made[last.register + 1] = true;
            }
        }
        assert!(run.iter().all(|run| *run));
        all_steps += program.steps.len();
        all_chains += chains.len();
    }
    assert!(10 * all_chains < 9 * all_steps, "{all_chains} chains of {all_steps} steps");
}
