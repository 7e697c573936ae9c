//! Units and declarations: names are declared once, whatever their case, and are no reserved words.

use std::collections::HashMap;

use super::lexer::{Kind, Token, tokens};
use super::types::{Element, Section, Type, Unit, Variable};

/// Function of two numbers.
type OfTwo = fn(f64, f64) -> f64;

/// A text that is valid in every dialect.
#[derive(Debug)]
pub struct Program {
    pub(super) units: Vec<Unit>,
    /// Functions that are evaluated by Rust instead.
    pub(super) replaced: Vec<(usize, OfTwo)>,
}

impl Program {
    /// Parses a text.
    ///
    /// # Errors
    ///
    /// Returns the first mistake with its line.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut parser = Parser { tokens: tokens(text)?, at: 0, units: Vec::new(), arrays: HashMap::new() };
        while parser.peek() != &Kind::End {
            if parser.take("TYPE") { parser.types()? } else { parser.unit()? }
        }
        Ok(Self { units: parser.units, replaced: Vec::new() })
    }

    /// Evaluates a function of two numbers by Rust from now on.
    pub fn replace(&mut self, name: &str, function: OfTwo) {
        let unit = self.index(name).unwrap_or_else(|| panic!("there is no {name}"));
        self.replaced.push((unit, function));
    }

    pub(super) fn index(&self, name: &str) -> Option<usize> {
        self.units.iter().position(|unit| unit.name.eq_ignore_ascii_case(name))
    }
}

pub(super) struct Parser {
    tokens: Vec<Token>,
    at: usize,
    pub(super) units: Vec<Unit>,
    /// Types of arrays, which all have names: some compilers take each other one for a new type.
    arrays: HashMap<String, Type>,
}

/// Keywords, standard functions and blocks, and operators of the instruction list.
const RESERVED: &str = "ABS ACOS ACTION ADD AND ANDN ANY ARRAY ASIN AT ATAN ATAN2 BOOL BY BYTE CAL CASE CONCAT CONFIGURATION CONSTANT CONTINUE COS \
     CTD CTU CTUD DATE DELETE DINT DIV DO DT DWORD ELSE ELSIF END_CASE END_FOR END_FUNCTION END_FUNCTION_BLOCK END_IF END_PROGRAM \
     END_REPEAT END_STRUCT END_TYPE END_VAR END_WHILE EN ENO EQ EXIT EXP EXPT FALSE FIND FOR FUNCTION FUNCTION_BLOCK F_TRIG GE GT \
     IF INSERT INT INTERFACE JMP LD LE LEFT LEN LIMIT LINT LN LOG LREAL LT LWORD MAX METHOD MID MIN MOD MOVE MUL MUX NE NOT OF ON OR \
     PARAMS PERSISTENT POINTER PROGRAM PROPERTY R REAL REF_TO REFERENCE REPEAT REPLACE RESOURCE RET RETAIN RETURN RIGHT ROL ROR RS \
     R_TRIG S SEL SHL SHR SIN SINT SIZEOF SQRT SR ST STEP STRING STRUCT SUB SUPER TAN TASK THEN THIS TIME TO TOD TOF TON TP \
     TRANSITION TRUE TRUNC TYPE UDINT UINT ULINT UNTIL USINT VAR VAR_CONFIG VAR_EXTERNAL VAR_GLOBAL VAR_INPUT VAR_IN_OUT VAR_OUTPUT \
     VAR_STAT VAR_TEMP WHILE WITH WORD WSTRING XOR";

impl Parser {
    pub(super) fn peek(&self) -> &Kind {
        &self.tokens[self.at].kind
    }

    pub(super) fn fault<T>(&self, what: impl std::fmt::Display) -> Result<T, String> {
        Err(format!("line {}: {what}", self.tokens[self.at].line))
    }

    pub(super) fn next(&mut self) -> Kind {
        let kind = self.peek().clone();
        self.at = (self.at + 1).min(self.tokens.len() - 1);
        kind
    }

    /// Takes a keyword or a sign if it is next.
    pub(super) fn take(&mut self, text: &str) -> bool {
        let is_next = match self.peek() {
            Kind::Word(word) => word == text,
            Kind::Sign(sign) => *sign == text,
            _ => false,
        };
        if is_next {
            self.next();
        }
        is_next
    }

    pub(super) fn expect(&mut self, text: &str) -> Result<(), String> {
        if self.take(text) { Ok(()) } else { self.fault(format!("expected {text}, found {:?}", self.peek())) }
    }

    pub(super) fn word(&mut self) -> Result<String, String> {
        match self.peek() {
            Kind::Word(word) => {
                let word = word.clone();
                self.next();
                Ok(word)
            }
            other => self.fault(format!("expected a name, found {other:?}")),
        }
    }

    /// Takes a name that may be declared.
    fn name(&mut self) -> Result<String, String> {
        let name = self.word()?;
        if RESERVED.split_whitespace().any(|word| word == name) {
            return self.fault(format!("{name} is reserved"));
        }
        if self.units.iter().any(|unit| unit.name == name) || self.arrays.contains_key(&name) {
            return self.fault(format!("{name} is the name of a unit or a type"));
        }
        Ok(name)
    }

    fn types(&mut self) -> Result<(), String> {
        while !self.take("END_TYPE") {
            let name = self.name()?;
            self.expect(":")?;
            self.expect("ARRAY")?;
            self.expect("[")?;
            if self.next() != Kind::Whole(0) {
                return self.fault("arrays begin at 0");
            }
            self.expect("..")?;
            let Kind::Whole(last) = self.next() else { return self.fault("an array has a last index") };
            self.expect("]")?;
            self.expect("OF")?;
            let count = usize::try_from(last).unwrap_or(0) + 1;
            let array = match self.type_name()? {
                Type::Dint => Type::Array(Element::Dint, count),
                Type::Lreal => Type::Array(Element::Lreal, count),
                _ => return self.fault("elements are DINT or LREAL"),
            };
            self.expect(";")?;
            if self.arrays.values().any(|other| *other == array) {
                return self.fault("two names of one type");
            }
            self.arrays.insert(name, array);
        }
        Ok(())
    }

    fn unit(&mut self) -> Result<(), String> {
        let kind = self.word()?;
        if !["FUNCTION", "FUNCTION_BLOCK", "PROGRAM"].contains(&&kind[..]) {
            return self.fault(format!("{kind} is no unit"));
        }
        let mut unit = Unit { name: self.name()?, ..Unit::default() };
        if kind == "FUNCTION" {
            self.expect(":")?;
            let result = match self.type_name()? {
                Type::Array(..) | Type::Block(_) => return self.fault("a result is one value"),
                result => result,
            };
            unit.result = Some(result);
            unit.initial.push(0.0);
            let variable = Variable { section: Section::Output, kind: result, offset: 0 };
            unit.variables.insert(unit.name.clone(), variable);
        }
        while let Kind::Word(word) = self.peek() {
            let section = match &word[..] {
                "VAR_INPUT" => Section::Input,
                "VAR_OUTPUT" if kind != "FUNCTION" => Section::Output,
                "VAR_IN_OUT" => Section::InOut,
                "VAR" => Section::Local,
                _ => break,
            };
            self.next();
            let is_constant = section == Section::Local && self.take("CONSTANT");
            self.section(&mut unit, if is_constant { Section::Constant } else { section })?;
        }
        unit.body = self.statements(&unit)?;
        self.expect(&format!("END_{kind}"))?;
        self.units.push(unit);
        Ok(())
    }

    fn section(&mut self, unit: &mut Unit, section: Section) -> Result<(), String> {
        while !self.take("END_VAR") {
            let mut names = vec![self.name()?];
            while self.take(",") {
                names.push(self.name()?);
            }
            self.expect(":")?;
            let kind = self.type_name()?;
            let values = if self.take(":=") {
                self.initial(kind)?
            } else if section == Section::Constant {
                return self.fault("a constant without a value");
            } else {
                match kind {
                    Type::Array(_, count) => vec![0.0; count],
                    Type::Block(block) => self.units[block].initial.clone(),
                    _ => vec![0.0],
                }
            };
            self.expect(";")?;
            for name in names {
                let offset = unit.initial.len();
                unit.initial.extend(if section == Section::InOut { &[0.0] } else { &values[..] });
                if matches!(section, Section::Input | Section::InOut) {
                    unit.parameters.push(name.clone());
                }
                if unit.variables.insert(name.clone(), Variable { section, kind, offset }).is_some() {
                    return self.fault(format!("{name} is declared twice"));
                }
            }
        }
        Ok(())
    }

    fn type_name(&mut self) -> Result<Type, String> {
        let word = self.word()?;
        Ok(match &word[..] {
            "BOOL" => Type::Bool,
            "INT" => Type::Int,
            "DINT" => Type::Dint,
            "LREAL" => Type::Lreal,
            name if self.arrays.contains_key(name) => self.arrays[name],
            name => match self.units.iter().position(|unit| unit.name == name) {
                Some(block) if self.units[block].result.is_none() => Type::Block(block),
                _ => return self.fault(format!("{name} is no type")),
            },
        })
    }

    /// Reads initial values.
    fn initial(&mut self, kind: Type) -> Result<Vec<f64>, String> {
        let (element, count) = match kind {
            Type::Array(element, count) => (element.as_type(), Some(count)),
            kind => (kind, None),
        };
        let mut values = Vec::new();
        if count.is_some() {
            self.expect("[")?;
        }
        loop {
            let sign = if self.take("-") { -1.0 } else { 1.0 };
            values.push(match (self.next(), element) {
                (Kind::Real(value, _), Type::Lreal) => sign * value,
                (Kind::Whole(value), Type::Int | Type::Dint) => sign * value as f64,
                (Kind::Word(word), Type::Bool) if word == "TRUE" => 1.0,
                (Kind::Word(word), Type::Bool) if word == "FALSE" => 0.0,
                (other, _) => return self.fault(format!("{other:?} is no initial value")),
            });
            if count.is_none() || !self.take(",") {
                break;
            }
        }
        if let Some(count) = count {
            self.expect("]")?;
            if values.len() != count {
                return self.fault(format!("{} values for {count} elements", values.len()));
            }
        }
        Ok(values)
    }
}
