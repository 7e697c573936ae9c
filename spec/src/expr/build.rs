//! Makes the terms of an expression: names and dimensions are checked and constants folded as each is made.

use super::function::FUNCTION_NAMES;
use super::reach::reaches_beyond;
use super::scope::Allowed;
use super::unit::LARGEST;
use super::{Binary, Dimension, Entry, Expression, Function, Kind, Lookup, Scope, Term, UNIT_NAMES, Unit};
use crate::diagnostic::{Diagnostic, Span, first, nearest_after};

/// Terms under construction. Mistakes of meaning go to `found` and do not stop the construction.
pub(super) struct Builder<'b> {
    scope: &'b Scope,
    found: &'b mut Vec<Diagnostic>,
    terms: Vec<Term>,
    allowed: Allowed,
}

impl<'b> Builder<'b> {
    pub(super) fn new(scope: &'b Scope, found: &'b mut Vec<Diagnostic>) -> Self {
        Self { scope, found, terms: Vec::new(), allowed: Allowed::Nothing }
    }

    pub(super) fn scope(&self) -> &'b Scope {
        self.scope
    }

    /// How many mistakes there are so far.
    pub(super) fn mistakes(&self) -> usize {
        self.found.len()
    }

    /// How many terms there are.
    pub(super) fn len(&self) -> usize {
        self.terms.len()
    }

    /// Begins an entry that may use the given names.
    pub(super) fn begin(&mut self, allowed: Allowed) {
        self.terms.clear();
        self.allowed = allowed;
    }

    /// Ends the entry whose last term is `whole`, and checks its dimension.
    pub(super) fn finish(&mut self, whole: usize, entry: Entry<'_>) -> Expression {
        debug_assert_eq!(whole + 1, self.terms.len(), "the whole is made last");
        let whole = &mut self.terms[whole];
        if let (Some(expected), Some(found)) = (entry.dimension, whole.dimension)
            && expected != found
        {
            if whole.bare && whole.value.is_some_and(|value| expected.takes_bare(value)) {
                // A bare number that is a whole entry takes the entry's unit.
                whole.dimension = Some(expected);
            } else {
                let unit = expected.unit(self.scope.length.symbol());
                let message = format!("{} must be {expected}, not {found}", entry.what);
                let mistake = Diagnostic::new(whole.span.clone(), message).label(format!("this is {found}"));
                let help = if expected == Dimension::NONE {
                    "angles and slopes are pure numbers: `0.1`, `5 deg`, `d1/(1600 mm)`".to_owned()
                } else {
                    format!("give it in {unit} or a unit that converts to it")
                };
                self.found.push(mistake.help(help));
            }
        }
        Expression::new(std::mem::take(&mut self.terms))
    }

    pub(super) fn number(&mut self, value: f64, unit: Option<Unit>, span: Span) -> usize {
        let bare = unit.is_none();
        let unit = unit.unwrap_or(Unit::NONE);
        let value = unit.convert(value, self.scope.length);
        let term = self.push_folded(Kind::Number(value), Some(unit.dimension), Some(value), span);
        self.terms[term].bare = bare;
        term
    }

    pub(super) fn name(&mut self, name: &str, span: Span) -> Result<usize, Diagnostic> {
        if name == "pi" {
            let value = Some(std::f64::consts::PI);
            let kind = Kind::Number(std::f64::consts::PI);
            return Ok(self.push(Term { kind, dimension: Some(Dimension::NONE), value, span, bare: false }));
        }
        let Some(declared) = self.scope.names.get(name) else {
            let mistake = if Unit::named(name).is_some() {
                Diagnostic::new(span, format!("the unit `{name}` must follow a number"))
                    .help(format!("write `1 {name}`"))
            } else if FUNCTION_NAMES.contains(&name) || self.scope.table(name).is_some() {
                Diagnostic::new(span, format!("the function `{name}` needs its argument in parentheses"))
                    .help(format!("write `{name}(…)`"))
            } else if self.allowed == Allowed::Nothing {
                Diagnostic::new(span, format!("`{name}` is not a number")).help("only numbers may stand here")
            } else {
                unknown(name, span, self.scope, self.mistakes())
            };
            return Err(mistake);
        };
        if let Err(reason) = self.allowed.check(declared.symbol) {
            return Err(Diagnostic::new(span, format!("`{name}` may not be used here"))
                .context(declared.span.clone(), "declared here")
                .help(reason));
        }
        let kind = Kind::Symbol(declared.symbol);
        Ok(self.push(Term { kind, dimension: declared.dimension, value: None, span, bare: false }))
    }

    pub(super) fn neg(&mut self, operand: usize, sign: &Span) -> usize {
        let term = &self.terms[operand];
        let (dimension, bare) = (term.dimension, term.bare);
        let span = sign.start..term.span.end.max(sign.end);
        let value = term.value.map(|value| -value);
        self.push(Term { kind: Kind::Neg(operand), dimension, value, span, bare })
    }

    pub(super) fn call(&mut self, function: Function, operand: usize, span: Span) -> usize {
        let found = self.terms[operand].dimension;
        let dimension = found.and_then(|found| match function {
            Function::Abs => Some(found),
            Function::Sign => Some(Dimension::NONE),
            Function::Sqrt => found.power(0.5).or_else(|| {
                self.mistake(
                    operand,
                    format!("the square root of {found} has no unit"),
                    "divide by a reference first",
                );
                None
            }),
            _ if found == Dimension::NONE => Some(found),
            _ => {
                let message = format!("`{}` takes a pure number, not {found}", function.name());
                self.mistake(operand, message, "divide by a length, such as `d1/(1600 mm)`");
                None
            }
        });
        let value = self.terms[operand].value.map(|value| function.of(value));
        self.push_folded(Kind::Call(function, operand), dimension, value, span)
    }

    /// `atan2`, `min` or `max`.
    pub(super) fn function_of_two(&mut self, operator: Binary, a: usize, b: usize, span: Span) -> usize {
        let dimension = match operator {
            Binary::Atan2 => {
                self.equal(a, b, "the two arguments of `atan2` must be of one kind").map(|_| Dimension::NONE)
            }
            Binary::Min => self.equal(a, b, "the arguments of `min` must be of one kind"),
            _ => self.equal(a, b, "the arguments of `max` must be of one kind"),
        };
        let value = self.both(a, b).map(|(a, b)| operator.of(a, b));
        self.push_folded(Kind::Binary(operator, a, b), dimension, value, span)
    }

    /// The same term, which reaches as far as its closing parenthesis.
    pub(super) fn respan(&mut self, term: usize, span: Span) -> usize {
        self.terms[term].span = span;
        term
    }

    /// The value of a table, whose argument are the terms from `begin` on.
    pub(super) fn look_up(&mut self, name: &str, begin: usize, span: Span) -> usize {
        let argument = self.terms.len() - 1;
        let (index, table) = self.scope.table(name).expect("the parser has found it");
        let [expected, dimension] = table.dimensions;
        let own: Vec<Term> = self.terms[begin..]
            .iter()
            .map(|term| Term { kind: term.kind.map(|operand| operand - begin), ..term.clone() })
            .collect();
        let found = self.terms[argument].dimension;
        if let Some(found) = found.filter(|found| *found != expected) {
            let message = format!("`{name}` takes {expected}, not {found}");
            let help = "the unit of its x says what it takes; divide or multiply to get there";
            self.mistake(argument, message, help);
        }
        let beyond = reaches_beyond(&own, table, self.scope);
        let value = self.terms[argument].value.filter(|_| beyond.is_none()).map(|x| table.derivative(0, x));
        self.found.extend(beyond);
        let kind = Kind::Lookup(Lookup { table: index, order: 0 }, argument);
        let dimension = found.filter(|found| *found == expected).map(|_| dimension);
        self.push(Term { kind, dimension, value, span, bare: false })
    }

    pub(super) fn binary(&mut self, operator: Binary, left: usize, right: usize) -> usize {
        let span = self.terms[left].span.start..self.terms[right].span.end;
        let (l, r) = (self.terms[left].dimension, self.terms[right].dimension);
        let both = l.zip(r);
        let dimension = match operator {
            Binary::Add => self.equal(left, right, "only quantities of one kind can be added"),
            Binary::Sub => self.equal(left, right, "only quantities of one kind can be subtracted"),
            Binary::Mul => both.and_then(|(l, r)| self.or_absurd(l.times(r), &span)),
            Binary::Div => both.and_then(|(l, r)| self.or_absurd(l.over(r), &span)),
            Binary::Pow => self.power(left, right),
            Binary::Atan2 | Binary::Min | Binary::Max => l,
        };
        let value = self.both(left, right).map(|(l, r)| operator.of(l, r));
        if operator == Binary::Div && self.terms[right].value == Some(0.0) {
            self.mistake(
                right,
                "division by zero".to_owned(),
                "divide by something else, or leave the division out",
            );
            return self.push(Term {
                kind: Kind::Binary(operator, left, right),
                dimension: None,
                value: None,
                span,
                bare: false,
            });
        }
        self.push_folded(Kind::Binary(operator, left, right), dimension, value, span)
    }

    fn power(&mut self, base: usize, exponent: usize) -> Option<Dimension> {
        let Some(value) = self.terms[exponent].value else {
            self.mistake(
                exponent,
                "an exponent must be a number".to_owned(),
                "names may stand in the base only",
            );
            return None;
        };
        if self.terms[exponent].dimension? != Dimension::NONE {
            self.mistake(exponent, "an exponent must be a pure number".to_owned(), "leave its unit out");
            return None;
        }
        let dimension = self.terms[base].dimension?;
        dimension.power(value).or_else(|| {
            let message = format!("{dimension} to the power {value} has no unit");
            self.mistake(exponent, message, "divide the base by a reference first: `(F/(1 N))^0.7`");
            None
        })
    }

    /// The dimension of two terms that must have the same.
    fn equal(&mut self, left: usize, right: usize, message: &str) -> Option<Dimension> {
        let (l, r) = (self.terms[left].dimension?, self.terms[right].dimension?);
        if l == r {
            return Some(l);
        }
        let unit = self.scope.length.symbol();
        let bare = |term: &Term| matches!(term.kind, Kind::Number(_)) && term.bare;
        let help = match (bare(&self.terms[left]), bare(&self.terms[right])) {
            (true, _) => format!("give the number its unit, such as `{}`", r.unit(unit)),
            (_, true) => format!("give the number its unit, such as `{}`", l.unit(unit)),
            _ => "both sides must have the same unit, up to its prefix".to_owned(),
        };
        let mistake = Diagnostic::new(self.terms[right].span.clone(), message)
            .label(format!("this is {r}"))
            .context(self.terms[left].span.clone(), format!("this is {l}"))
            .help(help);
        self.found.push(mistake);
        None
    }

    fn or_absurd(&mut self, dimension: Option<Dimension>, span: &Span) -> Option<Dimension> {
        if dimension.is_none() {
            self.found.push(
                Diagnostic::new(span.clone(), "the unit of this product is absurd")
                    .help("check the units: no exponent goes beyond 50"),
            );
        }
        dimension
    }

    fn both(&self, left: usize, right: usize) -> Option<(f64, f64)> {
        self.terms[left].value.zip(self.terms[right].value)
    }

    fn mistake(&mut self, term: usize, message: String, help: &str) {
        self.found.push(Diagnostic::new(self.terms[term].span.clone(), message).help(help));
    }

    /// Pushes a term, unless its constant value is not a number one can compute with.
    fn push_folded(
        &mut self,
        kind: Kind,
        dimension: Option<Dimension>,
        value: Option<f64>,
        span: Span,
    ) -> usize {
        if let Some(value) = value.filter(|value| value.is_nan() || value.abs() > LARGEST) {
            let (what, help) = match (value.is_nan(), kind) {
                (true, Kind::Call(Function::Asin | Function::Acos, _)) => {
                    ("has no real value", "the argument must be between -1 and 1")
                }
                (_, Kind::Call(Function::Log, _)) => {
                    ("has no real value", "a logarithm needs more than zero")
                }
                (true, _) => ("has no real value", "roots and powers need a base that is not negative"),
                (false, _) => ("is too large to compute with", "numbers go up to 1e150; is the unit right?"),
            };
            self.found.push(Diagnostic::new(span.clone(), format!("this {what}")).help(help));
            return self.push(Term { kind, dimension: None, value: None, span, bare: false });
        }
        self.push(Term { kind, dimension, value, span, bare: false })
    }

    fn push(&mut self, term: Term) -> usize {
        self.terms.push(term);
        self.terms.len() - 1
    }
}

/// A name that nothing has, as the mistake that comes after `found` others.
fn unknown(name: &str, span: Span, scope: &Scope, found: usize) -> Diagnostic {
    let names: Vec<&str> = scope.names.keys().map(String::as_str).collect();
    let mistake = Diagnostic::new(span, format!("there is no variable, parameter or input `{name}`"));
    let tables = scope.tables.iter().map(|table| table.name.as_str());
    let candidates = names.iter().copied().chain(tables).chain(FUNCTION_NAMES).chain(UNIT_NAMES);
    match nearest_after(found, name, candidates) {
        Some(near) => mistake.help(format!("did you mean `{near}`?")),
        None if names.is_empty() => mistake.help("this spec declares no names"),
        None => mistake.help(format!("declared names: {}", first(&names))),
    }
}
