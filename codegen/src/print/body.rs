//! Prints the statements of a program.
//!
//! A step without a name that is used once is written inline, as long as the expression stays
//! narrow. The order of the arithmetic, and so every bit of the result, stays the same.

use super::{Binding, Expression, NARROW, Names, Statement, Syntax, Value, width};
use crate::program::{Action, Operand, Program, Step};

/// Returns the statements of a program and its outputs.
pub(super) fn body(
    program: &Program,
    names: &mut Names<'_>,
    syntax: &dyn Syntax,
) -> (Vec<Statement>, Vec<Value>) {
    let registers = vec![None; program.registers];
    let mut writer = Writer { names, syntax, numbers: vec![], registers, statements: vec![] };
    for (value, name) in &program.numbers {
        let named = writer.bind(Some(name), syntax.number(*value).text);
        writer.numbers.push((*value, named));
    }
    let mut ready = vec![0; program.registers];
    // Outputs are names or constants, without arithmetic.
    let returned = program.returned();
    let mut steps = program.steps.iter().peekable();
    while let Some(step) = steps.next() {
        if let Action::SinCos(angle) = step.action {
            let mut pairs = vec![(step.register, angle)];
            // An angle may depend on the sine of another angle.
            let is_written = |angle: &Operand| match angle {
                Operand::Register(register) => writer.registers[*register].is_some(),
                _ => true,
            };
            while let Some(Step { register, action: Action::SinCos(angle), .. }) =
                steps.next_if(|step| matches!(&step.action, Action::SinCos(angle) if is_written(angle)))
            {
                pairs.push((*register, *angle));
            }
            writer.sines_and_cosines(&pairs, program);
            for (register, _) in pairs {
                ready[register..register + 2].fill(writer.statements.len());
            }
            continue;
        }
        let expression = writer.write(step.action);
        let once = program.uses[step.register] == 1 && !returned[step.register];
        if once && step.name.is_none() && width(&expression.text) <= NARROW {
            writer.registers[step.register] = Some(expression);
        } else {
            writer.registers[step.register] = Some(writer.bind(step.name.as_deref(), expression.text));
            ready[step.register] = writer.statements.len();
        }
    }
    let value = |output: &Operand| Value {
        text: writer.output(*output),
        ready: match output {
            Operand::Register(register) => ready[*register],
            // Named numbers are bound before everything else.
            Operand::Constant(value) if program.numbers.iter().any(|(named, _)| named == value) => {
                writer.numbers.len()
            }
            Operand::Constant(_) | Operand::Symbol(_) => 0,
        },
        is_zero: *output == Operand::Constant(0.0),
    };
    let values = program.outputs.iter().map(value).collect();
    (writer.statements, values)
}

struct Writer<'w, 's> {
    names: &'w mut Names<'s>,
    syntax: &'w dyn Syntax,
    /// Numbers that have names.
    numbers: Vec<(f64, Expression)>,
    /// Expression that stands for each register: its name, or the whole operation.
    registers: Vec<Option<Expression>>,
    statements: Vec<Statement>,
}

impl Writer<'_, '_> {
    /// Binds a value to a name and returns the expression for it.
    fn bind(&mut self, name: Option<&str>, value: String) -> Expression {
        let name = self.names.step(name);
        self.statements.push(Statement::Let { name: name.clone(), value });
        Expression::name(name)
    }

    fn sines_and_cosines(&mut self, pairs: &[(usize, Operand)], program: &Program) {
        let mut angles: Vec<Expression> = pairs.iter().map(|(_, angle)| self.operand(*angle)).collect();
        if let [angle] = &mut angles[..]
            && !angle.is_name
            && width(&angle.at_least(Binding::Atom)) + ".sin_cos()".len() > NARROW
        {
            *angle = self.bind(None, angle.text.clone());
        }
        let mut written = Vec::with_capacity(pairs.len());
        for ((register, angle), expression) in pairs.iter().zip(angles) {
            let (sine, cosine) = self.names.sine_and_cosine(*angle, program);
            self.registers[*register] = Some(Expression::name(sine.clone()));
            self.registers[*register + 1] = Some(Expression::name(cosine.clone()));
            written.push(([sine, cosine], expression));
        }
        self.statements.push(Statement::SinCos(written));
    }

    /// Returns the expression of an action. If it is too wide, the widest operands get statements
    /// of their own.
    fn write(&mut self, action: Action) -> Expression {
        let mut operands: Vec<Expression> = action.operands().map(|operand| self.operand(operand)).collect();
        loop {
            let expression = self.syntax.action(action, &operands);
            if width(&expression.text) > NARROW {
                let compound = operands.iter_mut().filter(|operand| !operand.is_name);
                if let Some(widest) = compound.max_by_key(|operand| width(&operand.text)) {
                    *widest = self.bind(None, widest.text.clone());
                    continue;
                }
            }
            return expression;
        }
    }

    fn operand(&self, operand: Operand) -> Expression {
        match operand {
            Operand::Constant(value) => {
                let named = self.numbers.iter().find(|(number, _)| number.to_bits() == value.to_bits());
                named.map_or_else(|| self.syntax.number(value), |(_, name)| name.clone())
            }
            Operand::Symbol(symbol) => Expression::name(self.names.symbol(symbol).to_owned()),
            // Every step comes after its operands.
            Operand::Register(register) => self.registers[register].clone().expect("a step that came before"),
        }
    }

    fn output(&self, operand: Operand) -> String {
        match operand {
            Operand::Constant(value @ (0.0 | 1.0)) => self.syntax.zero_or_one(value.abs()),
            operand => self.operand(operand).text,
        }
    }
}
