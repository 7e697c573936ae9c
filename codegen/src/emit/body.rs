//! The statements of a program.
//!
//! A step that is used once and has no name of its own is written where it is used, as long as the expression
//! stays short; the order of the arithmetic, and so every bit of the result, stays the same.

use proc_macro2::{Ident, TokenStream};
use quote::{ToTokens, format_ident, quote};

use super::literal::number;
use super::names::Names;
use crate::expr::Function;
use crate::program::{Action, Operand, Program, Step};

/// How many operations one expression may hold.
const LONGEST: usize = 6;

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
    tokens: TokenStream,
    binding: Binding,
    operations: usize,
}

/// The statements of a program, and its outputs as expressions.
pub(super) struct Body {
    pub(super) statements: Vec<TokenStream>,
    pub(super) outputs: Vec<Output>,
}

/// A result of a program.
pub(super) struct Output {
    expression: TokenStream,
    /// After how many statements it is known.
    pub(super) ready: usize,
    zero: bool,
}

impl Output {
    /// Whether it is zero in every configuration.
    pub(super) fn is_zero(&self) -> bool {
        self.zero
    }
}

impl ToTokens for Output {
    fn to_tokens(&self, tokens: &mut TokenStream) {
        self.expression.to_tokens(tokens);
    }
}

pub(super) fn body(program: &Program, names: &mut Names<'_>) -> Body {
    let mut writer = Writer { names, registers: vec![None; program.registers] };
    let mut statements = Vec::new();
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
            statements.push(writer.sines_and_cosines(&pairs, program));
            for (register, _) in pairs {
                ready[register..register + 2].fill(statements.len());
            }
            continue;
        }
        let written = writer.write(step);
        let once = program.uses[step.register] == 1 && !returned[step.register];
        if once && step.name.is_none() && written.operations < LONGEST {
            writer.registers[step.register] = Some(written);
        } else {
            let (name, tokens) = (writer.names.step(step.name.as_deref()), written.tokens);
            statements.push(quote!(let #name = #tokens;));
            ready[step.register] = statements.len();
            writer.registers[step.register] = Some(Written::name(&name));
        }
    }
    let output = |output: &Operand| Output {
        expression: writer.output(*output),
        ready: if let Operand::Register(register) = output { ready[*register] } else { 0 },
        zero: *output == Operand::Constant(0.0),
    };
    let outputs = program.outputs.iter().map(output).collect();
    Body { statements, outputs }
}

struct Writer<'w, 's> {
    names: &'w mut Names<'s>,
    /// How each register is written where it is used: its name, or the whole expression.
    registers: Vec<Option<Written>>,
}

impl Writer<'_, '_> {
    /// `let (s1, c1) = q1.sin_cos();`, or many together.
    fn sines_and_cosines(&mut self, pairs: &[(usize, Operand)], program: &Program) -> TokenStream {
        let angles: Vec<Written> = pairs.iter().map(|(_, angle)| self.operand(*angle)).collect();
        let names: Vec<TokenStream> = pairs
            .iter()
            .map(|(register, angle)| {
                let (sine, cosine) = self.names.sine_and_cosine(*angle, program);
                self.registers[*register] = Some(Written::name(&sine));
                self.registers[register + 1] = Some(Written::name(&cosine));
                quote!((#sine, #cosine))
            })
            .collect();
        if let ([name], [angle]) = (&names[..], &angles[..]) {
            let angle = angle.clone().at_least(Binding::Atom);
            return quote!(let #name = #angle.sin_cos(););
        }
        let angles = angles.into_iter().map(|angle| angle.tokens);
        quote!(let [#(#names),*] = T::sin_cos_each([#(#angles),*]);)
    }

    fn write(&self, step: &Step) -> Written {
        match step.action {
            Action::Neg(a) => {
                let a = self.operand(a);
                let operations = a.operations + 1;
                let a = a.at_least(Binding::Sign);
                Written { tokens: quote!(-#a), binding: Binding::Sign, operations }
            }
            Action::Add(a, b) => self.infix(a, b, &quote!(+), Binding::Sum, Binding::Product),
            Action::Sub(a, b) => self.infix(a, b, &quote!(-), Binding::Sum, Binding::Product),
            Action::Mul(a, b) => self.infix(a, b, &quote!(*), Binding::Product, Binding::Sign),
            Action::Div(a, b) => self.infix(a, b, &quote!(/), Binding::Product, Binding::Sign),
            Action::MulAdd(a, b, c) => self.fused(a, b, c, "mul_add"),
            Action::MulSub(a, b, c) => self.fused(a, b, c, "mul_sub"),
            Action::NegMulAdd(a, b, c) => self.fused(a, b, c, "neg_mul_add"),
            Action::Pow(a, b) => self.method(a, "powf", &[b]),
            Action::Atan2(a, b) => self.method(a, "atan2", &[b]),
            Action::Call(function, a) => self.method(a, function.name(), &[]),
            Action::SinCos(a) => self.method(a, Function::Sin.name(), &[]),
        }
    }

    /// `a op b`; the right operand needs a stronger operator, so that nothing is reassociated.
    fn infix(&self, a: Operand, b: Operand, sign: &TokenStream, own: Binding, right: Binding) -> Written {
        let (a, b) = (self.operand(a), self.operand(b));
        let operations = a.operations + b.operations + 1;
        let (a, b) = (a.at_least(own), b.at_least(right));
        Written { tokens: quote!(#a #sign #b), binding: own, operations }
    }

    /// `a · b ± c`, a number that is constant as the second factor.
    fn fused(&self, a: Operand, b: Operand, c: Operand, name: &str) -> Written {
        let (a, b) = if matches!(a, Operand::Constant(_)) { (b, a) } else { (a, b) };
        let mut written = self.method(a, name, &[b, c]);
        written.operations += 1;
        written
    }

    fn method(&self, a: Operand, name: &str, arguments: &[Operand]) -> Written {
        let name = format_ident!("{name}");
        let a = self.operand(a);
        let arguments = arguments.iter().map(|argument| self.operand(*argument)).collect::<Vec<_>>();
        let operations = a.operations + arguments.iter().map(|b| b.operations).sum::<usize>() + 1;
        let (a, arguments) = (a.at_least(Binding::Atom), arguments.into_iter().map(|b| b.tokens));
        Written { tokens: quote!(#a.#name(#(#arguments),*)), binding: Binding::Atom, operations }
    }

    fn operand(&self, operand: Operand) -> Written {
        match operand {
            Operand::Constant(value) => {
                let value = number(value);
                Written { tokens: quote!(T::constant(#value)), binding: Binding::Atom, operations: 0 }
            }
            Operand::Symbol(symbol) => Written::name(self.names.symbol(symbol)),
            // Every step comes after those it uses.
            Operand::Register(register) => self.registers[register].clone().expect("a step that came before"),
        }
    }

    fn output(&self, operand: Operand) -> TokenStream {
        match operand {
            Operand::Constant(0.0) => quote!(zero),
            Operand::Constant(1.0) => quote!(one),
            operand => self.operand(operand).tokens,
        }
    }
}

impl Written {
    fn name(name: &Ident) -> Self {
        Self { tokens: quote!(#name), binding: Binding::Atom, operations: 0 }
    }

    /// The expression as an operand of something that needs at least this binding.
    fn at_least(self, binding: Binding) -> TokenStream {
        let tokens = self.tokens;
        if self.binding >= binding { tokens } else { quote!((#tokens)) }
    }
}
