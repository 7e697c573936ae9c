//! Expressions, with their types.

use super::lexer::Kind;
use super::parser::Parser;
use super::types::{Element, Expression, Place, Section, Type, Unit};

/// Standard functions: their names, numbers of arguments, and types of argument and result.
const STANDARD: [(&str, usize, Type, Type); 16] = [
    ("ABS", 1, Type::Lreal, Type::Lreal),
    ("SQRT", 1, Type::Lreal, Type::Lreal),
    ("SIN", 1, Type::Lreal, Type::Lreal),
    ("COS", 1, Type::Lreal, Type::Lreal),
    ("TAN", 1, Type::Lreal, Type::Lreal),
    ("ASIN", 1, Type::Lreal, Type::Lreal),
    ("ACOS", 1, Type::Lreal, Type::Lreal),
    ("ATAN", 1, Type::Lreal, Type::Lreal),
    ("EXP", 1, Type::Lreal, Type::Lreal),
    ("LN", 1, Type::Lreal, Type::Lreal),
    ("EXPT", 2, Type::Lreal, Type::Lreal),
    ("MIN", 2, Type::Lreal, Type::Lreal),
    ("MAX", 2, Type::Lreal, Type::Lreal),
    ("LIMIT", 3, Type::Lreal, Type::Lreal),
    ("LREAL_TO_DINT", 1, Type::Lreal, Type::Dint),
    ("DINT_TO_LREAL", 1, Type::Dint, Type::Lreal),
];

/// Operators by increasing precedence.
const OPERATORS: [&[&str]; 6] =
    [&["OR"], &["AND"], &["=", "<>"], &["<", ">", "<=", ">="], &["+", "-"], &["*", "/", "MOD"]];

impl Parser {
    /// Parses an expression of a type.
    pub(super) fn expression_of(&mut self, unit: &Unit, kind: Type) -> Result<Expression, String> {
        let (expression, found) = self.expression(unit)?;
        if kind.takes(found) {
            Ok(expression)
        } else {
            self.fault(format!("expected {kind:?}, found {found:?}"))
        }
    }

    pub(super) fn expression(&mut self, unit: &Unit) -> Result<(Expression, Type), String> {
        self.binary(unit, 0)
    }

    fn binary(&mut self, unit: &Unit, level: usize) -> Result<(Expression, Type), String> {
        if level == OPERATORS.len() {
            return self.unary(unit);
        }
        let (mut left, mut kind) = self.binary(unit, level + 1)?;
        while let Some(sign) = OPERATORS[level].iter().find(|sign| self.take(sign)) {
            let (right, other) = self.binary(unit, level + 1)?;
            let joined = kind.joined(other);
            let whole = matches!(joined, Some(Type::Int | Type::Dint | Type::Whole));
            let is_number = whole || joined == Some(Type::Lreal);
            let is_valid = match *sign {
                "OR" | "AND" => joined == Some(Type::Bool),
                "MOD" => whole,
                _ => is_number,
            };
            if !is_valid {
                return self.fault(format!("{kind:?} {sign} {other:?}"));
            }
            left = Expression::Binary(sign, whole, Box::new([left, right]));
            kind = if level < 4 { Type::Bool } else { joined.unwrap_or(kind) };
        }
        Ok((left, kind))
    }

    fn unary(&mut self, unit: &Unit) -> Result<(Expression, Type), String> {
        if self.take("NOT") {
            let (inner, kind) = self.unary(unit)?;
            return match kind {
                Type::Bool => Ok((Expression::Not(Box::new(inner)), kind)),
                _ => self.fault(format!("NOT of {kind:?}")),
            };
        }
        if self.take("-") {
            // Two adjacent signs are no number in some dialects.
            let (inner, kind) = self.primary(unit)?;
            return match kind {
                Type::Lreal | Type::Dint | Type::Whole => Ok((Expression::Negative(Box::new(inner)), kind)),
                _ => self.fault(format!("negative {kind:?}")),
            };
        }
        self.primary(unit)
    }

    fn primary(&mut self, unit: &Unit) -> Result<(Expression, Type), String> {
        if self.take("(") {
            let inner = self.expression(unit)?;
            self.expect(")")?;
            return Ok(inner);
        }
        match self.peek().clone() {
            Kind::Whole(value) => {
                self.next();
                Ok((Expression::Number(value as f64), Type::Whole))
            }
            Kind::Real(value, true) => {
                self.next();
                Ok((Expression::Number(value), Type::Lreal))
            }
            Kind::Real(..) => self.fault("a number without its type in an expression"),
            Kind::Word(word) if word == "TRUE" || word == "FALSE" => {
                self.next();
                Ok((Expression::Number(f64::from(u8::from(word == "TRUE"))), Type::Bool))
            }
            Kind::Word(word) => {
                if let Some((name, count, given, result)) = STANDARD.iter().find(|one| one.0 == word) {
                    self.next();
                    return Ok((Expression::Standard(name, self.arguments(unit, *count, *given)?), *result));
                }
                if let Some(function) = self.units.iter().position(|one| one.name == word) {
                    self.next();
                    return self.call(unit, function);
                }
                let (place, kind, section) = self.place(unit)?;
                match kind {
                    Type::Block(_) => self.fault(format!("{word} is an instance")),
                    _ if section == Section::Output && unit.result.is_some() && unit.name == word => {
                        self.fault("reads the result of the function")
                    }
                    _ => Ok((Expression::Load(place), kind)),
                }
            }
            other => self.fault(format!("{other:?} is no operand")),
        }
    }

    fn arguments(&mut self, unit: &Unit, count: usize, kind: Type) -> Result<Vec<Expression>, String> {
        self.expect("(")?;
        let mut arguments = vec![self.expression_of(unit, kind)?];
        for _ in 1..count {
            self.expect(",")?;
            arguments.push(self.expression_of(unit, kind)?);
        }
        self.expect(")")?;
        Ok(arguments)
    }

    /// Parses the arguments of a function of the file.
    fn call(&mut self, unit: &Unit, function: usize) -> Result<(Expression, Type), String> {
        let callee = self.units[function].clone();
        let Some(result) = callee.result else {
            return self.fault(format!("{} is no function", callee.name));
        };
        self.expect("(")?;
        let mut arguments = Vec::new();
        for (k, name) in callee.parameters.iter().enumerate() {
            if k > 0 {
                self.expect(",")?;
            }
            let parameter = &callee.variables[name];
            if parameter.section == Section::InOut {
                let (place, kind, section) = self.place(unit)?;
                if kind != parameter.kind || matches!(section, Section::Input | Section::Constant) {
                    return self.fault(format!("{name} must be a variable of {:?}", parameter.kind));
                }
                arguments.push(Expression::Load(place));
            } else {
                arguments.push(self.expression_of(unit, parameter.kind)?);
            }
        }
        self.expect(")")?;
        Ok((Expression::Call(function, arguments), result))
    }

    /// Parses a variable, an element of an array, or an output of an instance.
    pub(super) fn place(&mut self, unit: &Unit) -> Result<(Place, Type, Section), String> {
        let name = self.word()?;
        let Some(variable) = unit.variables.get(&name) else {
            return self.fault(format!("{name} is not declared"));
        };
        let (mut kind, mut section, mut offset) = (variable.kind, variable.section, variable.offset);
        let is_indirect = section == Section::InOut;
        if let (Type::Block(block), true) = (kind, self.take(".")) {
            let member = self.word()?;
            match self.units[block].variables.get(&member) {
                Some(found) if found.section == Section::Output => {
                    (kind, offset, section) = (found.kind, offset + found.offset, Section::Constant);
                }
                _ => return self.fault(format!("{member} is no output of {name}")),
            }
        }
        let mut index = None;
        if let (Type::Array(element, count), true) = (kind, self.take("[")) {
            index = Some((Box::new(self.expression_of(unit, Type::Dint)?), count));
            self.expect("]")?;
            kind = match element {
                Element::Dint => Type::Dint,
                Element::Lreal => Type::Lreal,
            };
        }
        Ok((Place { offset, is_indirect, index }, kind, section))
    }
}
