//! Moves sines and cosines to the beginning: computed together they take half the time.

use abbe_spec::expr::Function;

use super::{Action, Operand, Program, Step};

impl Program {
    /// Moves all sine and cosine pairs whose angles use no function next to each other at the
    /// beginning, after the operands of their angles.
    pub(super) fn sines_first(&mut self) {
        let mut plain = vec![false; self.registers];
        let mut pairs = vec![false; self.registers];
        for Step { register, action, .. } in &self.steps {
            let known = |operand: Operand| match operand {
                Operand::Register(register) => plain[register],
                Operand::Symbol(_) | Operand::Constant(_) => true,
            };
            let operands = action.operands().all(known);
            match action {
                Action::SinCos(_) => pairs[*register] = operands,
                Action::Call(Function::Sin | Function::Cos, _) => {}
                _ => plain[*register] = operands,
            }
        }
        // Exactly the operands of the angles.
        let mut needed = vec![false; self.registers];
        for step in self.steps.iter().rev() {
            if pairs[step.register] || needed[step.register] {
                for operand in step.action.operands() {
                    if let Operand::Register(register) = operand {
                        needed[register] = true;
                    }
                }
            }
        }
        self.steps.sort_by_key(|step| match (needed[step.register], pairs[step.register]) {
            (true, _) if plain[step.register] => 0,
            (_, true) => 1,
            _ => 2,
        });
    }
}
