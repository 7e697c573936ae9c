//! Runs blocks, and stops where a controller may stop: at an invalid operation, a number that is
//! not finite, or an index that does not exist.

use super::parser::Program;
use super::types::{Expression, Place, Section, Statement, Type, Unit};

/// Instance of a block with its memory.
#[derive(Clone)]
pub struct Instance<'p> {
    program: &'p Program,
    unit: &'p Unit,
    memory: Vec<f64>,
    /// `false` on a controller whose floating-point exceptions are disabled.
    pub has_exceptions: bool,
    /// Conversion of a number to a whole one, which differs among controllers.
    pub to_whole: fn(f64) -> f64,
}

/// End of the statements of a loop or a unit.
enum Flow {
    Next,
    Exit,
    Return,
}

impl Program {
    /// Creates an instance of a block.
    ///
    /// # Panics
    ///
    /// Panics if there is no such block.
    pub fn instance(&self, name: &str) -> Instance<'_> {
        let unit = self.index(name).unwrap_or_else(|| panic!("there is no {name}"));
        let unit = &self.units[unit];
        Instance {
            program: self,
            unit,
            memory: unit.initial.clone(),
            has_exceptions: true,
            to_whole: f64::round_ties_even,
        }
    }
}

impl Instance<'_> {
    /// Returns `true` if the block has a variable of this name.
    pub fn has(&self, name: &str) -> bool {
        self.unit.variables.contains_key(&name.to_ascii_uppercase())
    }

    /// Sets an input.
    ///
    /// # Panics
    ///
    /// Panics if there is no such input, or if it has another number of elements.
    pub fn set(&mut self, name: &str, values: &[f64]) {
        let variable = &self.unit.variables[&name.to_ascii_uppercase()];
        let count = if let Type::Array(_, count) = variable.kind { count } else { 1 };
        assert!(variable.section == Section::Input && count == values.len(), "{name}");
        self.memory[variable.offset..][..count].copy_from_slice(values);
    }

    /// Returns a variable.
    ///
    /// # Panics
    ///
    /// Panics if there is none of this name.
    pub fn get(&self, name: &str) -> Vec<f64> {
        let variable = &self.unit.variables[&name.to_ascii_uppercase()];
        let count = if let Type::Array(_, count) = variable.kind { count } else { 1 };
        self.memory[variable.offset..][..count].to_vec()
    }

    /// Executes the block once.
    ///
    /// # Errors
    ///
    /// Returns the reason why the controller stops.
    pub fn call(&mut self) -> Result<(), String> {
        self.statements(&self.unit.body, 0).map(|_| ())
    }

    fn statements(&mut self, list: &[Statement], base: usize) -> Result<Flow, String> {
        for statement in list {
            match statement {
                Statement::Assign(place, value) => {
                    let value = self.value(value, base)?;
                    let address = self.address(place, base)?;
                    self.memory[address] = value;
                }
                Statement::Copy(to, from, count) => {
                    let [to, from] = [self.address(to, base)?, self.address(from, base)?];
                    self.memory.copy_within(from..from + count, to);
                }
                Statement::If(branches) => {
                    for (condition, body) in branches {
                        if self.value(condition, base)? != 0.0 {
                            match self.statements(body, base)? {
                                Flow::Next => break,
                                other => return Ok(other),
                            }
                        }
                    }
                }
                Statement::While(condition, body) => {
                    while self.value(condition, base)? != 0.0 {
                        match self.statements(body, base)? {
                            Flow::Next => {}
                            Flow::Exit => break,
                            Flow::Return => return Ok(Flow::Return),
                        }
                    }
                }
                Statement::For { counter, range: [first, last], by, body } => {
                    let (mut at, last) = (self.value(first, base)?, self.value(last, base)?);
                    let counter = self.address(counter, base)?;
                    while if *by > 0 { at <= last } else { at >= last } {
                        self.memory[counter] = at;
                        match self.statements(body, base)? {
                            Flow::Next => {}
                            Flow::Exit => break,
                            Flow::Return => return Ok(Flow::Return),
                        }
                        at += *by as f64;
                    }
                }
                Statement::Call(unit, offset, inputs) => {
                    self.statements(inputs, base)?;
                    let program = self.program;
                    self.statements(&program.units[*unit].body, base + offset)?;
                }
                Statement::Exit => return Ok(Flow::Exit),
                Statement::Return => return Ok(Flow::Return),
            }
        }
        Ok(Flow::Next)
    }

    fn address(&mut self, place: &Place, base: usize) -> Result<usize, String> {
        let mut address = base + place.offset;
        if place.is_indirect {
            address = self.memory[address] as usize;
        }
        if let Some((index, count)) = &place.index {
            let index = self.value(index, base)?;
            if !(0.0..*count as f64).contains(&index) {
                return Err(format!("index {index} of {count} elements"));
            }
            address += index as usize;
        }
        Ok(address)
    }

    fn value(&mut self, expression: &Expression, base: usize) -> Result<f64, String> {
        Ok(match expression {
            Expression::Number(value) => *value,
            Expression::Load(place) => {
                let address = self.address(place, base)?;
                self.memory[address]
            }
            Expression::Negative(inner) => -self.value(inner, base)?,
            Expression::Not(inner) => 1.0 - self.value(inner, base)?,
            Expression::Binary(sign, whole, operands) => {
                let [a, b] = [self.value(&operands[0], base)?, self.value(&operands[1], base)?];
                return self.binary(sign, *whole, a, b);
            }
            Expression::Standard(name, arguments) => {
                let mut given = [0.0; 3];
                for (value, argument) in given.iter_mut().zip(arguments) {
                    *value = self.value(argument, base)?;
                }
                return self.standard(name, given);
            }
            Expression::Call(unit, arguments) => return self.function(*unit, arguments, base),
        })
    }

    /// Calls a function in memory of its own behind all other.
    fn function(&mut self, index: usize, arguments: &[Expression], base: usize) -> Result<f64, String> {
        let program = self.program;
        let unit = &program.units[index];
        let mut given = Vec::with_capacity(arguments.len());
        for (name, argument) in unit.parameters.iter().zip(arguments) {
            given.push(match (unit.variables[name].section, argument) {
                (Section::InOut, Expression::Load(place)) => self.address(place, base)? as f64,
                _ => self.value(argument, base)?,
            });
        }
        if let Some((_, function)) = program.replaced.iter().find(|(replaced, _)| *replaced == index) {
            return Ok(function(given[0], given[1]));
        }
        let frame = self.memory.len();
        self.memory.extend(&unit.initial);
        for (name, value) in unit.parameters.iter().zip(given) {
            self.memory[frame + unit.variables[name].offset] = value;
        }
        self.statements(&unit.body, frame)?;
        let result = self.memory[frame];
        self.memory.truncate(frame);
        Ok(result)
    }

    fn binary(&self, sign: &str, whole: bool, a: f64, b: f64) -> Result<f64, String> {
        let truth = |value: bool| f64::from(u8::from(value));
        if self.has_exceptions && (a.is_nan() || b.is_nan()) {
            return Err(format!("{a} {sign} {b}"));
        }
        let value = match sign {
            "OR" => a.max(b),
            "AND" => a.min(b),
            "=" => truth(a == b),
            "<>" => truth(a != b),
            "<" => truth(a < b),
            ">" => truth(a > b),
            "<=" => truth(a <= b),
            ">=" => truth(a >= b),
            "+" => a + b,
            "-" => a - b,
            "*" => a * b,
            "MOD" => a % b,
            _ if whole => (a / b).trunc(),
            _ => a / b,
        };
        self.checked(value, || format!("{a} {sign} {b}"))
    }

    fn standard(&self, name: &str, [a, b, c]: [f64; 3]) -> Result<f64, String> {
        let value = match name {
            "ABS" => a.abs(),
            "SQRT" => a.sqrt(),
            "SIN" => a.sin(),
            "COS" => a.cos(),
            "TAN" => a.tan(),
            "ASIN" => a.asin(),
            "ACOS" => a.acos(),
            "ATAN" => a.atan(),
            "EXP" => a.exp(),
            "LN" => a.ln(),
            "EXPT" => a.powf(b),
            "MIN" if a < b => a,
            "MAX" if a > b => a,
            "MIN" | "MAX" => b,
            "LIMIT" => {
                let above = if b > a { b } else { a };
                if above < c { above } else { c }
            }
            "LREAL_TO_DINT" if a.abs() < 2147483647.0 => (self.to_whole)(a),
            "LREAL_TO_DINT" => return Err(format!("{a} is no DINT")),
            _ => a,
        };
        self.checked(value, || format!("{name} of {a}, {b}, {c}"))
    }

    /// Returns an error for a number that is not finite.
    fn checked(&self, value: f64, what: impl Fn() -> String) -> Result<f64, String> {
        if self.has_exceptions && !value.is_finite() { Err(what()) } else { Ok(value) }
    }
}
