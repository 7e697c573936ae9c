//! Which operations of a program are run as one: each reads what the one before it makes, which nothing else reads and which therefore
//! never leaves the registers.

use abbe_codegen::program::{Action, Operand, Program};

/// The steps of a program in the order in which they are run, in chains: each step but the first of its chain reads what the one before it
/// makes, and nothing else does.
pub(crate) fn chains(program: &Program) -> Vec<Vec<usize>> {
    let uses = uses(program);
    let mut maker = vec![None; program.registers];
    // The chain that ends at a step, until another goes on with it.
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
        // What goes on takes the place of the last step: all that the others read is there by then.
        maker[step.register] = is_link(step.action).then_some(at);
    }
    ending.retain(|chain| !chain.is_empty());
    ending
}

/// Whether it can stand in a chain: quick operations, whose numbers leave registers free.
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

/// How often each register is read.
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

    /// Every step is run once, and after all that it reads: what other chains make at their ends, and what the step before it makes.
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
