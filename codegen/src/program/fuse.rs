//! Fuses products into sums: one operation on machines with fused multiply-add, and one rounding
//! less.

use super::{Action, Operand, Program, Step};

impl Program {
    /// Makes `a · b ± c` one step wherever nothing else uses the product. Of two products the first
    /// stays separate: `a · b + c · d` becomes `a.mul_add(b, c · d)`.
    pub(super) fn fuse(&mut self) {
        let mut product: Vec<Option<(Operand, Operand)>> = vec![None; self.registers];
        let mut fused = vec![false; self.registers];
        let returned = self.returned();
        for step in &mut self.steps {
            let single = |operand: Operand| match operand {
                Operand::Register(r) => product[r].map(|factors| (r, factors)),
                _ => None,
            };
            let found = match step.action {
                Action::Mul(a, b) => {
                    if self.uses[step.register] == 1 && !returned[step.register] && step.name.is_none() {
                        product[step.register] = Some((a, b));
                    }
                    None
                }
                Action::Add(x, y) => single(x)
                    .map(|(r, (a, b))| (r, Action::MulAdd(a, b, y)))
                    .or_else(|| single(y).map(|(r, (a, b))| (r, Action::MulAdd(a, b, x)))),
                Action::Sub(x, y) => single(x)
                    .map(|(r, (a, b))| (r, Action::MulSub(a, b, y)))
                    .or_else(|| single(y).map(|(r, (a, b))| (r, Action::NegMulAdd(a, b, x)))),
                _ => None,
            };
            if let Some((register, action)) = found {
                fused[register] = true;
                step.action = action;
            }
        }
        if fused.contains(&true) {
            self.steps.retain(|step| !fused[step.register]);
            self.renumber();
            self.count_uses();
        }
    }

    /// Returns which registers are results.
    pub(crate) fn returned(&self) -> Vec<bool> {
        let mut returned = vec![false; self.registers];
        for output in &self.outputs {
            if let Operand::Register(register) = output {
                returned[*register] = true;
            }
        }
        returned
    }

    /// Renumbers the registers of the remaining steps without gaps.
    fn renumber(&mut self) {
        let mut numbers = vec![usize::MAX; self.registers];
        let mut next = 0;
        for step in &mut self.steps {
            let Step { register, action, .. } = step;
            for half in 0..=usize::from(matches!(action, Action::SinCos(_))) {
                numbers[*register + half] = next + half;
            }
            *action = action.map(|operand| operand.renumbered(&numbers));
            *register = numbers[*register];
            next += 1 + usize::from(matches!(action, Action::SinCos(_)));
        }
        for output in &mut self.outputs {
            *output = output.renumbered(&numbers);
        }
        self.registers = next;
    }
}

impl Operand {
    fn renumbered(self, numbers: &[usize]) -> Self {
        match self {
            Self::Register(register) => Self::Register(numbers[register]),
            other => other,
        }
    }
}

impl Action {
    /// Applies `f` to every operand.
    fn map(self, f: impl Fn(Operand) -> Operand) -> Self {
        match self {
            Self::Neg(a) => Self::Neg(f(a)),
            Self::Call(function, a) => Self::Call(function, f(a)),
            Self::SinCos(a) => Self::SinCos(f(a)),
            Self::Add(a, b) => Self::Add(f(a), f(b)),
            Self::Sub(a, b) => Self::Sub(f(a), f(b)),
            Self::Mul(a, b) => Self::Mul(f(a), f(b)),
            Self::Div(a, b) => Self::Div(f(a), f(b)),
            Self::Pow(a, b) => Self::Pow(f(a), f(b)),
            Self::Atan2(a, b) => Self::Atan2(f(a), f(b)),
            Self::Min(a, b) => Self::Min(f(a), f(b)),
            Self::Max(a, b) => Self::Max(f(a), f(b)),
            Self::Lookup(lookup, a) => Self::Lookup(lookup, f(a)),
            Self::MulAdd(a, b, c) => Self::MulAdd(f(a), f(b), f(c)),
            Self::MulSub(a, b, c) => Self::MulSub(f(a), f(b), f(c)),
            Self::NegMulAdd(a, b, c) => Self::NegMulAdd(f(a), f(b), f(c)),
        }
    }
}
