//! The grammar of expressions, by recursive descent of bounded depth.
//!
//! ```text
//! sum     = product { ("+" | "-") product }
//! product = signed { ("*" | "/") signed }
//! signed  = ("+" | "-") signed | power
//! power   = atom [ "^" signed ]
//! atom    = number [unit] | name | "pi" | (function | table) "(" sum { "," sum } ")" | "(" sum ")"
//! unit    = [factor] { ("*" | "/") factor }      factor = unit-name ["^" ["-"] digits] | "(" unit ")"
//! ```
//!
//! Products of elementary motions: `Tx(d1) Ry(q4) Tz(300 mm)`.

use abbe_core::Component;

use super::build::{Builder, FUNCTIONS_OF_TWO};
use super::{
    Allowed, Binary, Dimension, Entry, Expression, FUNCTION_NAMES, Function, LocatedText, Scope,
    TextLocation, Token, Unit, tokens, unit_help,
};
use crate::diagnostic::{Diagnostic, Span, decimal, suggestion};

/// Maximum nesting depth of parentheses, functions, signs and powers.
const DEPTH: usize = 100;

/// Parses and checks a text that is a whole entry. Mistakes are recorded in `found`, and the result
/// is then `None`.
pub(crate) fn parse_expression(
    text: &LocatedText<'_>,
    scope: &Scope,
    entry: Entry<'_>,
    found: &mut Vec<Diagnostic>,
) -> Option<Expression> {
    parsed(text, scope, found, |parser| {
        let expression = parser.entry(entry)?;
        parser.expect_end()?;
        Ok(expression)
    })
}

/// Parses a text. Mistakes are recorded in `found`, and the result is then `None`.
pub(super) fn parsed<T>(
    text: &LocatedText<'_>,
    scope: &Scope,
    found: &mut Vec<Diagnostic>,
    parse: impl FnOnce(&mut Parser<'_>) -> Parsed<T>,
) -> Option<T> {
    let before = found.len();
    let result = Parser::new(text, scope, found).and_then(|mut parser| parse(&mut parser));
    match result {
        Ok(result) => (found.len() == before).then_some(result),
        Err(diagnostic) => {
            found.push(diagnostic);
            None
        }
    }
}

/// Parses a unit; an empty text is no unit. A mistake is recorded in `found`, and the result is
/// then `None`.
pub(crate) fn parse_unit(text: &LocatedText<'_>, scope: &Scope, found: &mut Vec<Diagnostic>) -> Option<Unit> {
    let unit = Parser::new(text, scope, &mut Vec::new()).and_then(|mut parser| {
        let mut span = parser.here();
        let unit = parser.unit(&mut span)?;
        match parser.peek() {
            Token::End => Ok(unit.unwrap_or(Unit::NONE)),
            Token::Word(word) => Err(unknown_unit(word, parser.here())),
            _ => Err(parser.unexpected("a unit")),
        }
    });
    unit.map_err(|mistake| found.push(mistake)).ok()
}

/// Position in the tokens of a text, and the terms of the expression being parsed.
pub(super) struct Parser<'p> {
    tokens: Vec<(Token<'p>, Span)>,
    at: usize,
    depth: usize,
    text: &'p str,
    place: &'p TextLocation,
    builder: Builder<'p>,
}

pub(super) type Parsed<T> = Result<T, Diagnostic>;

impl<'p> Parser<'p> {
    fn new(text: &'p LocatedText<'p>, scope: &'p Scope, found: &'p mut Vec<Diagnostic>) -> Parsed<Self> {
        let tokens = tokens(text)?;
        let builder = Builder::new(scope, found);
        Ok(Self { tokens, at: 0, depth: 0, text: text.text, place: &text.place, builder })
    }

    /// Parses a sum that is a whole entry. The parser can then parse another one.
    pub(crate) fn entry(&mut self, entry: Entry<'_>) -> Parsed<Expression> {
        self.builder.begin(entry.names);
        let whole = self.sum()?;
        Ok(self.builder.finish(whole, entry))
    }

    pub(crate) fn peek(&self) -> Token<'p> {
        self.tokens[self.at].0
    }

    /// Returns the location of the next token in the file.
    pub(crate) fn here(&self) -> Span {
        self.place.span(self.tokens[self.at].1.clone())
    }

    pub(crate) fn advance(&mut self) -> (Token<'p>, Span) {
        let taken = (self.peek(), self.here());
        self.at = (self.at + 1).min(self.tokens.len() - 1);
        taken
    }

    pub(crate) fn accept(&mut self, sign: char) -> bool {
        let found = self.peek() == Token::Sign(sign);
        if found {
            self.advance();
        }
        found
    }

    pub(crate) fn expect(&mut self, sign: char) -> Parsed<Span> {
        let here = self.here();
        if self.accept(sign) { Ok(here) } else { Err(self.unexpected(&format!("`{sign}`"))) }
    }

    fn expect_end(&mut self) -> Parsed<()> {
        match self.peek() {
            Token::End => Ok(()),
            Token::Word(name) if Unit::named(name).is_some() => {
                let mistake = Diagnostic::new(self.here(), format!("the unit `{name}` must follow a number"));
                Err(match self.at.checked_sub(1).map(|before| &self.tokens[before]) {
                    Some((Token::Word(unit), span)) if Unit::named(unit).is_some() => {
                        let span = self.place.span(span.start..self.tokens[self.at].1.end);
                        let help = format!("write the product of units with `*`: `{unit}*{name}`");
                        Diagnostic { span: Some(span), ..mistake }.help(help)
                    }
                    _ => mistake.help("only numbers take a unit; names already have theirs"),
                })
            }
            _ => {
                let mistake = self.unexpected("an operator or the end");
                Err(match self.with_point().filter(|_| self.peek() == Token::Sign(',')) {
                    Some((span, help)) => Diagnostic { span: Some(span), ..mistake }.help(help),
                    None => mistake,
                })
            }
        }
    }

    /// Returns the location of the number around a comma, and what to write for it.
    fn with_point(&self) -> Option<(Span, String)> {
        let token = |at: usize| self.tokens.get(at).map(|token| token.0);
        let before = self.at.checked_sub(1)?;
        let are_numbers = [before, self.at + 1].iter().all(|at| matches!(token(*at), Some(Token::Number(_))));
        let part = |at: usize| self.text.get(self.tokens[at].1.clone()).unwrap_or_default();
        let whole = self.tokens[before].1.start..self.tokens.get(self.at + 1)?.1.end;
        are_numbers.then(|| (self.place.span(whole), decimal(part(before), part(self.at + 1))))
    }

    pub(crate) fn unexpected(&self, expected: &str) -> Diagnostic {
        let found = match self.peek() {
            Token::End => "the end of the expression".to_owned(),
            Token::Number(_) => "a number".to_owned(),
            Token::Word(word) => format!("`{word}`"),
            Token::Sign(sign) => format!("`{sign}`"),
        };
        Diagnostic::new(self.here(), format!("expected {expected}, found {found}"))
            .label(format!("expected {expected}"))
            .help("an expression is written as `0.5*d1 + 3 mm * sin(q2)`")
    }

    /// Parses one level of nesting deeper.
    fn nested<T>(&mut self, inner: impl FnOnce(&mut Self) -> Parsed<T>) -> Parsed<T> {
        if self.depth == DEPTH {
            return Err(Diagnostic::new(self.here(), "this expression nests too deeply")
                .label(format!("more than {DEPTH} levels"))
                .help("split it into several frames or sources"));
        }
        self.depth += 1;
        let result = inner(self);
        self.depth -= 1;
        result
    }

    fn sum(&mut self) -> Parsed<usize> {
        self.left_to_right([('+', Binary::Add), ('-', Binary::Sub)], Self::product)
    }

    fn product(&mut self) -> Parsed<usize> {
        self.left_to_right([('*', Binary::Mul), ('/', Binary::Div)], Self::signed)
    }

    /// Parses operands with operators of the same precedence between them.
    fn left_to_right(
        &mut self,
        operators: [(char, Binary); 2],
        operand: fn(&mut Self) -> Parsed<usize>,
    ) -> Parsed<usize> {
        let mut left = operand(self)?;
        while let Some((_, operator)) = operators.into_iter().find(|(sign, _)| self.accept(*sign)) {
            let right = operand(self)?;
            left = self.builder.binary(operator, left, right);
        }
        Ok(left)
    }

    fn signed(&mut self) -> Parsed<usize> {
        let start = self.here();
        if self.accept('-') {
            let operand = self.nested(Self::signed)?;
            Ok(self.builder.neg(operand, &start))
        } else if self.accept('+') {
            self.nested(Self::signed)
        } else {
            self.power()
        }
    }

    fn power(&mut self) -> Parsed<usize> {
        let base = self.atom()?;
        if self.accept('^') {
            let exponent = self.nested(Self::signed)?;
            return Ok(self.builder.binary(Binary::Pow, base, exponent));
        }
        Ok(base)
    }

    fn atom(&mut self) -> Parsed<usize> {
        match self.peek() {
            Token::Number(value) => {
                let (_, mut span) = self.advance();
                let unit = self.unit(&mut span)?;
                match self.peek() {
                    Token::Word(word) if unit.is_none() && !self.is_known(word) => {
                        Err(unknown_unit(word, self.here()))
                    }
                    _ => Ok(self.builder.number(value, unit, span)),
                }
            }
            Token::Word(word) => {
                let (_, span) = self.advance();
                if self.peek() == Token::Sign('(') {
                    self.call(word, span)
                } else {
                    self.builder.name(word, span)
                }
            }
            Token::Sign('(') => {
                self.advance();
                let inner = self.nested(Self::sum)?;
                self.expect(')')?;
                Ok(inner)
            }
            _ => Err(self.unexpected("a number, a name or `(`")),
        }
    }

    fn call(&mut self, word: &str, start: Span) -> Parsed<usize> {
        let two = FUNCTIONS_OF_TWO.into_iter().find(|(name, _)| *name == word);
        let function = Function::named(word);
        let is_table = self.builder.scope.table(word).is_some();
        if two.is_none() && function.is_none() && !is_table {
            let tables = self.builder.scope.tables.iter().map(|table| table.name.as_str());
            let known: Vec<&str> = FUNCTION_NAMES.into_iter().chain(tables).collect();
            let help = suggestion(self.builder.found.len(), word, &known, "functions");
            return Err(Diagnostic::new(start, format!("unknown function `{word}`")).help(help));
        }
        self.expect('(')?;
        let begin = self.builder.terms.len();
        let first = self.nested(Self::sum)?;
        let mut whole = first;
        if let Some(two) = two {
            let mut more = true;
            while more {
                self.expect(',')?;
                let next = self.nested(Self::sum)?;
                whole = self.builder.function_of_two(two, whole, next, start.start..self.here().end);
                // `min` and `max` take any number of arguments, `atan2` takes two.
                more = two.1 != Binary::Atan2 && self.peek() == Token::Sign(',');
            }
        }
        let end = self.expect(')')?;
        let span = start.start..end.end;
        Ok(match function {
            Some(function) => self.builder.call(function, first, span),
            None if is_table => self.builder.look_up(word, begin, span),
            None => self.builder.respan(whole, span),
        })
    }

    /// Returns `true` if a word after a number is known, so that an operator is missing.
    fn is_known(&self, word: &str) -> bool {
        let scope = self.builder.scope;
        let is_name = scope.names.contains_key(word) || scope.table(word).is_some() || word == "pi";
        is_name || FUNCTION_NAMES.contains(&word) || Unit::named(word).is_some()
    }

    /// Parses the unit that follows a number, if there is one; `span` is extended over it.
    fn unit(&mut self, span: &mut Span) -> Parsed<Option<Unit>> {
        let starts =
            self.unit_factor_ahead(0) || (self.peek() == Token::Sign('/') && self.unit_factor_ahead(1));
        if !starts {
            return Ok(None);
        }
        let unit = self.nested(Self::unit_product)?;
        let last = self.tokens[self.at - 1].1.clone();
        span.end = self.place.span(last).end;
        Ok(Some(unit))
    }

    /// Returns `true` if a unit name, possibly in parentheses, is `ahead` tokens away.
    fn unit_factor_ahead(&self, ahead: usize) -> bool {
        let mut tokens = self.tokens[self.at..].iter().skip(ahead).map(|token| token.0);
        let first = tokens.find(|token| *token != Token::Sign('(') || ahead == 0);
        // `min(` is the function, not minutes.
        let mut is_function =
            |name: &str| FUNCTION_NAMES.contains(&name) && tokens.next() == Some(Token::Sign('('));
        matches!(first, Some(Token::Word(name)) if Unit::named(name).is_some() && !is_function(name))
    }

    fn unit_product(&mut self) -> Parsed<Unit> {
        let mut unit = Unit::NONE;
        if self.peek() != Token::Sign('/') {
            unit = self.unit_factor(unit, 1)?;
        }
        while self.unit_factor_ahead(1) {
            let power = match self.peek() {
                Token::Sign('*') => 1,
                Token::Sign('/') => -1,
                _ => break,
            };
            self.advance();
            unit = self.unit_factor(unit, power)?;
        }
        Ok(unit)
    }

    /// Multiplies `unit` by the next factor, raised to `sign`.
    fn unit_factor(&mut self, unit: Unit, sign: i32) -> Parsed<Unit> {
        let start = self.here();
        let factor = if self.accept('(') {
            let inner = self.nested(Self::unit_product)?;
            self.expect(')')?;
            inner
        } else {
            match self.advance() {
                (Token::Word(name), _) if Unit::named(name).is_some() => {
                    Unit::named(name).unwrap_or(Unit::NONE)
                }
                (_, span) => return Err(Diagnostic::new(span, "expected a unit").help(unit_help(""))),
            }
        };
        let power = if self.accept('^') { self.unit_power()? } else { 1 };
        unit.times(factor, sign * power).ok_or_else(|| {
            Diagnostic::new(start, "this exponent of a unit is too large")
                .help("write a small integer exponent, as in `mm^2`")
        })
    }

    fn unit_power(&mut self) -> Parsed<i32> {
        let negative = self.accept('-');
        match self.advance() {
            (Token::Number(power), _) if power.fract() == 0.0 && power.abs() <= 12.0 => {
                Ok(if negative { -(power as i32) } else { power as i32 })
            }
            (_, span) => Err(Diagnostic::new(span, "the exponent of a unit must be a small integer")
                .help("write `mm^2` or `s^-1`; for a power of a whole quantity use parentheses: `(2 mm)^x`")),
        }
    }
}

fn unknown_unit(word: &str, span: Span) -> Diagnostic {
    let mistake =
        Diagnostic::new(span, format!("unknown unit `{}`", word.escape_debug())).label("not a unit");
    mistake.help(unit_help(word))
}

/// Kind of an elementary motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// Translation along its axis.
    Translation,
    /// Rotation about its axis.
    Rotation,
}

/// Returns the motion of a generalized error and its axis: 0 = x, 1 = y, 2 = z.
pub fn motion(component: Component) -> (Motion, usize) {
    let motion = if component.is_rotation() { Motion::Rotation } else { Motion::Translation };
    (motion, component.axis())
}

/// One factor of a transform.
#[derive(Clone, Debug, PartialEq)]
pub struct Elementary {
    /// Translation or rotation.
    pub motion: Motion,
    /// Axis: 0 = x, 1 = y, 2 = z.
    pub axis: usize,
    /// Distance in the spec's length unit, or angle in rad.
    pub amount: Expression,
}

const NAMES: [&str; 6] = ["Tx", "Ty", "Tz", "Rx", "Ry", "Rz"];

/// Parses and checks a product of elementary motions. Mistakes are recorded in `found`, and the
/// result is then `None`.
pub(crate) fn parse_transform(
    text: &LocatedText<'_>,
    scope: &Scope,
    found: &mut Vec<Diagnostic>,
) -> Option<Vec<Elementary>> {
    parsed(text, scope, found, |parser| {
        let mut factors = Vec::new();
        while parser.peek() != Token::End {
            factors.push(factor(parser)?);
            parser.accept('*');
        }
        Ok(factors)
    })
}

fn factor(parser: &mut Parser<'_>) -> Parsed<Elementary> {
    let expected = "Tx, Ty, Tz, Rx, Ry or Rz";
    let Token::Word(name) = parser.peek() else { return Err(parser.unexpected(expected)) };
    let Some(index) = NAMES.iter().position(|known| *known == name) else {
        return Err(Diagnostic::new(parser.here(), format!("unknown motion `{name}`"))
            .label(format!("expected {expected}"))
            .help(suggestion(0, name, &NAMES, "motions")));
    };
    parser.advance();
    let axis = index % 3;
    let (motion, dimension, verb) = if index < 3 {
        (Motion::Translation, Dimension::LENGTH, "translation along")
    } else {
        (Motion::Rotation, Dimension::NONE, "rotation about")
    };
    let what = format!("the {verb} {}", ["x", "y", "z"][axis]);
    parser.expect('(')?;
    let amount = parser.entry(Entry { dimension: Some(dimension), what: &what, names: Allowed::Geometry })?;
    parser.expect(')')?;
    Ok(Elementary { motion, axis, amount })
}
