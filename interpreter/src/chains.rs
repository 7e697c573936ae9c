//! Chains of operations: each operation reads the result of the one before it. Nothing else reads
//! that result, so it never leaves the registers.

use abbe_codegen::program::{Action, Operand, Program};

/// Returns the steps of a program in execution order, grouped in chains. Within a chain each step
/// reads the result of the step before it, and no other step does.
pub(crate) fn chains(program: &Program) -> Vec<Vec<usize>> {
    let uses = uses(program);
    let mut maker = vec![None; program.registers];
    // The chain that ends at a step, until another step extends it.
    let mut ending: Vec<Vec<usize>> = Vec::with_capacity(program.steps.len());
    for (at, step) in program.steps.iter().enumerate() {
        let mut longest: Option<usize> = None;
        for operand in step.action.operands().filter(|_| is_link(step.action)) {
            let Operand::Register(register) = operand else { continue };
            let Some(before) = maker[register].filter(|_| uses[register] == 1) else { continue };
            let length = |step: usize| ending[step].len();
            if longest.is_none_or(|longest| length(before) > length(longest)) {
                longest = Some(before);
            }
        }
        let mut chain = longest.map_or_else(Vec::new, |before| std::mem::take(&mut ending[before]));
        chain.push(at);
        ending.push(chain);
        // A chain runs at the position of its last step, where all other operands are available.
        maker[step.register] = is_link(step.action).then_some(at);
    }
    ending.retain(|chain| !chain.is_empty());
    ending
}

/// Returns `true` if an action may be part of a chain: fast operations that leave registers free.
fn is_link(action: Action) -> bool {
    matches!(
        action,
        Action::Neg(_)
            | Action::Add(..)
            | Action::Sub(..)
            | Action::Mul(..)
            | Action::MulAdd(..)
            | Action::MulSub(..)
            | Action::NegMulAdd(..)
    )
}

/// Returns the number of reads of each register.
fn uses(program: &Program) -> Vec<usize> {
    let mut uses = vec![0; program.registers];
    let read = program.steps.iter().flat_map(|step| step.action.operands());
    for operand in read.chain(program.outputs.iter().copied()) {
        if let Operand::Register(register) = operand {
            uses[register] += 1;
        }
    }
    uses
}

#[cfg(test)]
mod tests {
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
}
