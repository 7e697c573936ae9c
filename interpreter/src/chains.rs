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
mod tests;
