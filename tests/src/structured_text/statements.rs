//! Statements: inputs and constants are not assigned, and every block of statements ends.

use super::lexer::Kind;
use super::parser::Parser;
use super::types::{Expression, Section, Statement, Type, Unit};

impl Parser {
    /// Parses statements up to a keyword that ends them.
    pub(super) fn statements(&mut self, unit: &Unit) -> Result<Vec<Statement>, String> {
        let mut list = Vec::new();
        loop {
            match self.peek() {
                Kind::Word(word) if word.starts_with("END_") || word == "ELSE" || word == "ELSIF" => {
                    return Ok(list);
                }
                Kind::End => return self.fault("the text ends in a unit"),
                _ => list.push(self.statement(unit)?),
            }
        }
    }

    fn statement(&mut self, unit: &Unit) -> Result<Statement, String> {
        let statement = if self.take("IF") {
            self.condition(unit)?
        } else if self.take("FOR") {
            self.counted(unit)?
        } else if self.take("WHILE") {
            let condition = self.expression_of(unit, Type::Bool)?;
            self.expect("DO")?;
            let body = self.statements(unit)?;
            self.expect("END_WHILE")?;
            Statement::While(condition, body)
        } else if self.take("RETURN") {
            Statement::Return
        } else if self.take("EXIT") {
            Statement::Exit
        } else {
            self.assignment(unit)?
        };
        self.expect(";")?;
        Ok(statement)
    }

    fn condition(&mut self, unit: &Unit) -> Result<Statement, String> {
        let mut branches = Vec::new();
        loop {
            let condition = self.expression_of(unit, Type::Bool)?;
            self.expect("THEN")?;
            branches.push((condition, self.statements(unit)?));
            if !self.take("ELSIF") {
                break;
            }
        }
        if self.take("ELSE") {
            branches.push((Expression::Number(1.0), self.statements(unit)?));
        }
        self.expect("END_IF")?;
        Ok(Statement::If(branches))
    }

    fn counted(&mut self, unit: &Unit) -> Result<Statement, String> {
        let (counter, kind, section) = self.place(unit)?;
        if kind != Type::Dint || section != Section::Local {
            return self.fault("a counter is a local variable of DINT");
        }
        self.expect(":=")?;
        let first = self.expression_of(unit, Type::Dint)?;
        self.expect("TO")?;
        let last = self.expression_of(unit, Type::Dint)?;
        let by = if self.take("BY") {
            let sign = if self.take("-") { -1 } else { 1 };
            let Kind::Whole(by) = self.next() else { return self.fault("BY is a number") };
            sign * by
        } else {
            1
        };
        self.expect("DO")?;
        if matches!((&first, &last), (Expression::Number(first), Expression::Number(last)) if first == last) {
            return self.fault("some compilers skip a loop from a number to itself");
        }
        let body = self.statements(unit)?;
        self.expect("END_FOR")?;
        Ok(Statement::For { counter, range: [first, last], by, body })
    }

    fn assignment(&mut self, unit: &Unit) -> Result<Statement, String> {
        let (place, kind, section) = self.place(unit)?;
        if let Type::Block(block) = kind {
            return self.call_block(unit, block, place.offset);
        }
        if matches!(section, Section::Input | Section::Constant) {
            return self.fault("assigns to an input or a constant");
        }
        self.expect(":=")?;
        let value = self.expression_of(unit, kind)?;
        Ok(match (kind, value) {
            (Type::Array(_, count), Expression::Load(from)) => Statement::Copy(place, from, count),
            (_, value) => Statement::Assign(place, value),
        })
    }

    /// Parses the call of an instance, with its inputs by name.
    fn call_block(&mut self, unit: &Unit, block: usize, offset: usize) -> Result<Statement, String> {
        let callee = self.units[block].clone();
        self.expect("(")?;
        let (mut assigned, mut list) = (Vec::new(), Vec::new());
        while !self.take(")") {
            if !assigned.is_empty() {
                self.expect(",")?;
            }
            let name = self.word()?;
            let input = match callee.variables.get(&name) {
                Some(input) if input.section == Section::Input && !assigned.contains(&name) => input,
                _ => return self.fault(format!("{name} is no input of {}", callee.name)),
            };
            self.expect(":=")?;
            let to = super::types::Place { offset: offset + input.offset, is_indirect: false, index: None };
            let value = self.expression_of(unit, input.kind)?;
            list.push(match (input.kind, value) {
                (Type::Array(_, count), Expression::Load(from)) => Statement::Copy(to, from, count),
                (_, value) => Statement::Assign(to, value),
            });
            assigned.push(name);
        }
        Ok(Statement::Call(block, offset, list))
    }
}
