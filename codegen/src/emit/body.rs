//! The statements of a program.
//!
//! A step that is used once and has no name of its own is written where it is used, as long as the expression
//! stays narrow; the order of the arithmetic, and so every bit of the result, stays the same.

use std::borrow::Cow;

use super::literal::number;
use super::names::Names;
use super::writer::{NARROW, array, fits, pattern, width};
use crate::program::{Action, Operand, Program, Step};

/// How strongly the outermost operator of an expression binds.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Binding {
    Sum,
    Product,
    Sign,
    Atom,
}

#[derive(Clone)]
struct Written {
    text: String,
    binding: Binding,
    /// Whether it is no more than a name.
    is_name: bool,
}

/// The statements of a program, and its outputs as expressions.
pub(super) struct Body {
    pub(super) statements: Vec<String>,
    pub(super) outputs: Vec<Output>,
}

/// A result of a program.
pub(super) struct Output {
    pub(super) expression: String,
    /// After how many statements it is known.
    pub(super) ready: usize,
    /// Whether it is zero in every configuration.
    pub(super) is_zero: bool,
}

/// Writes a program; `indent` says where its statements will stand.
pub(super) fn body(program: &Program, names: &mut Names<'_>, indent: usize) -> Body {
    let mut writer =
        Writer { names, registers: vec![None; program.registers], statements: Vec::new(), indent };
    let mut ready = vec![0; program.registers];
    // Results are written as they are, without arithmetic.
    let mut returned = vec![false; program.registers];
    for output in &program.outputs {
        if let Operand::Register(register) = output {
            returned[*register] = true;
        }
    }
    let mut steps = program.steps.iter().peekable();
    while let Some(step) = steps.next() {
        if let Action::SinCos(angle) = step.action {
            let mut pairs = vec![(step.register, angle)];
            while let Some(Step { register, action: Action::SinCos(angle), .. }) =
                steps.next_if(|step| matches!(step.action, Action::SinCos(_)))
            {
                pairs.push((*register, *angle));
            }
            writer.sines_and_cosines(&pairs, program);
            for (register, _) in pairs {
                ready[register..register + 2].fill(writer.statements.len());
            }
            continue;
        }
        let written = writer.write(step.action);
        let once = program.uses[step.register] == 1 && !returned[step.register];
        if once && step.name.is_none() && width(&written.text) <= NARROW {
            writer.registers[step.register] = Some(written);
        } else {
            writer.registers[step.register] = Some(writer.bind(step.name.as_deref(), &written.text));
            ready[step.register] = writer.statements.len();
        }
    }
    let output = |output: &Operand| Output {
        expression: writer.output(*output),
        ready: if let Operand::Register(register) = output { ready[*register] } else { 0 },
        is_zero: *output == Operand::Constant(0.0),
    };
    let outputs = program.outputs.iter().map(output).collect();
    Body { statements: writer.statements, outputs }
}

struct Writer<'w, 's> {
    names: &'w mut Names<'s>,
    /// How each register is written where it is used: its name, or the whole expression.
    registers: Vec<Option<Written>>,
    statements: Vec<String>,
    indent: usize,
}

impl Writer<'_, '_> {
    /// `let name = text;`, and what stands for it from here on.
    fn bind(&mut self, name: Option<&str>, text: &str) -> Written {
        let name = self.names.step(name);
        self.statements.push(format!("let {name} = {text};"));
        Written::name(name)
    }

    /// `let (s1, c1) = q1.sin_cos();`, or many together.
    fn sines_and_cosines(&mut self, pairs: &[(usize, Operand)], program: &Program) {
        if let [(register, angle)] = *pairs {
            let value = self.write(Action::SinCos(angle)).text;
            let name = self.sine_and_cosine(register, angle, program);
            self.statements.push(format!("let {name} = {value};"));
            return;
        }
        let angles: Vec<String> = pairs.iter().map(|(_, angle)| self.operand(*angle).text).collect();
        let name = |(register, angle): &(usize, Operand)| self.sine_and_cosine(*register, *angle, program);
        let names: Vec<String> = pairs.iter().map(name).collect();
        let names = pattern(self.indent, "let ", &names, " =");
        let last = names.lines().last().map_or(0, width);
        let value = array(self.indent, "T::sin_cos_each(", &angles, ");");
        let first = value.lines().next().map_or(0, width);
        let statement = if fits(self.indent, last + 1 + first) {
            format!("{names} {value}")
        } else {
            format!("{names}\n    {}", value.replace('\n', "\n    "))
        };
        self.statements.push(statement);
    }

    /// `(s1, c1)`.
    fn sine_and_cosine(&mut self, register: usize, angle: Operand, program: &Program) -> String {
        let (sine, cosine) = self.names.sine_and_cosine(angle, program);
        let pair = format!("({sine}, {cosine})");
        self.registers[register] = Some(Written::name(sine));
        self.registers[register + 1] = Some(Written::name(cosine));
        pair
    }

    /// The expression of an action. Of its operands that would make it too wide, the widest get statements of their own.
    fn write(&mut self, action: Action) -> Written {
        let mut operands: Vec<Written> = action.operands().map(|operand| self.operand(operand)).collect();
        loop {
            let (text, binding) = expression(action, &operands);
            if width(&text) > NARROW {
                let expressions = operands.iter_mut().filter(|operand| !operand.is_name);
                if let Some(widest) = expressions.max_by_key(|operand| width(&operand.text)) {
                    *widest = self.bind(None, &widest.text);
                    continue;
                }
            }
            return Written { text, binding, is_name: false };
        }
    }

    fn operand(&self, operand: Operand) -> Written {
        match operand {
            Operand::Constant(value) => Written {
                text: format!("T::constant({})", number(value)),
                binding: Binding::Atom,
                is_name: false,
            },
            Operand::Symbol(symbol) => Written::name(self.names.symbol(symbol).to_owned()),
            // Every step comes after those it uses.
            Operand::Register(register) => self.registers[register].clone().expect("a step that came before"),
        }
    }

    fn output(&self, operand: Operand) -> String {
        match operand {
            Operand::Constant(0.0) => "zero".to_owned(),
            Operand::Constant(1.0) => "one".to_owned(),
            operand => self.operand(operand).text,
        }
    }
}

/// An action on operands that are written already.
fn expression(action: Action, operands: &[Written]) -> (String, Binding) {
    let infix = |sign: &str, own: Binding, right: Binding| {
        // The right operand needs a stronger operator, so that nothing is reassociated.
        let (a, b) = (operands[0].at_least(own), operands[1].at_least(right));
        (format!("{a} {sign} {b}"), own)
    };
    let method = |name: &str, of: &Written, arguments: &[&Written]| {
        let arguments: Vec<&str> = arguments.iter().map(|argument| argument.text.as_str()).collect();
        (format!("{}.{name}({})", of.at_least(Binding::Atom), arguments.join(", ")), Binding::Atom)
    };
    // A number that is constant is the second factor.
    let fused = |name: &str, a: Operand| match (a, operands) {
        (Operand::Constant(_), [a, b, c]) => method(name, b, &[a, c]),
        _ => method(name, &operands[0], &[&operands[1], &operands[2]]),
    };
    match action {
        Action::Neg(_) => (format!("-{}", operands[0].at_least(Binding::Sign)), Binding::Sign),
        Action::Add(..) => infix("+", Binding::Sum, Binding::Product),
        Action::Sub(..) => infix("-", Binding::Sum, Binding::Product),
        Action::Mul(..) => infix("*", Binding::Product, Binding::Sign),
        Action::Div(..) => infix("/", Binding::Product, Binding::Sign),
        Action::MulAdd(a, ..) => fused("mul_add", a),
        Action::MulSub(a, ..) => fused("mul_sub", a),
        Action::NegMulAdd(a, ..) => fused("neg_mul_add", a),
        Action::Pow(..) => method("powf", &operands[0], &[&operands[1]]),
        Action::Atan2(..) => method("atan2", &operands[0], &[&operands[1]]),
        Action::Call(function, _) => method(function.name(), &operands[0], &[]),
        Action::SinCos(_) => method("sin_cos", &operands[0], &[]),
    }
}

impl Written {
    fn name(name: String) -> Self {
        Self { text: name, binding: Binding::Atom, is_name: true }
    }

    /// The expression as an operand of something that needs at least this binding.
    fn at_least(&self, binding: Binding) -> Cow<'_, str> {
        if self.binding >= binding {
            Cow::Borrowed(&self.text)
        } else {
            Cow::Owned(format!("({})", self.text))
        }
    }
}
