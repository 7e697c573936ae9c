//! Builds the terms of an expression. Names and dimensions are checked and constants folded for
//! each term.

use super::reach::reaches_beyond;
use super::{
    Allowed, Binary, Dimension, Entry, Expression, FUNCTION_NAMES, Function, Kind, LARGEST, Lookup, Scope,
    Term, Unit, unit_meant,
};
use crate::diagnostic::{Diagnostic, Span, first, nearest_after};

/// Functions of two arguments.
pub(super) const FUNCTIONS_OF_TWO: [(&str, Binary); 3] =
    [("atan2", Binary::Atan2), ("min", Binary::Min), ("max", Binary::Max)];

/// Terms under construction. Semantic errors are recorded in `found` and do not stop construction.
pub(super) struct Builder<'b> {
    pub(super) scope: &'b Scope,
    pub(super) found: &'b mut Vec<Diagnostic>,
    pub(super) terms: Vec<Term>,
    allowed: Allowed,
}

impl<'b> Builder<'b> {
    pub(super) fn new(scope: &'b Scope, found: &'b mut Vec<Diagnostic>) -> Self {
        Self { scope, found, terms: Vec::new(), allowed: Allowed::Nothing }
    }

    /// Starts an entry that may use the given names.
    pub(super) fn begin(&mut self, allowed: Allowed) {
        self.terms.clear();
        self.allowed = allowed;
    }

    /// Finishes the entry whose last term is `whole`, and checks its dimension.
    pub(super) fn finish(&mut self, whole: usize, entry: Entry<'_>) -> Expression {
        debug_assert_eq!(whole + 1, self.terms.len(), "the whole is made last");
        let whole = &mut self.terms[whole];
        if let (Some(expected), Some(found)) = (entry.dimension, whole.dimension)
            && expected != found
        {
            if whole.bare && whole.value.is_some_and(|value| expected.takes_bare(value)) {
                // A bare number takes the unit of the entry.
                whole.dimension = Some(expected);
            } else {
                let units = expected.units(self.scope.length.symbol()).join("`, `");
                let message = format!("{} must be {expected}, not {found}", entry.what);
                let mistake = Diagnostic::new(whole.span.clone(), message).label(format!("this is {found}"));
                let help = if Dimension::NONE.over(expected) == Some(found) {
                    "this is the reciprocal of the expected quantity, such as a stiffness instead \
                     of a compliance: write `1/(…)`"
                        .to_owned()
                } else if expected == Dimension::NONE {
                    "angles and slopes are pure numbers: `0.1`, `5 deg`, `d1/(1600 mm)`".to_owned()
                } else {
                    format!("use `{units}` or a compatible unit")
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
            return Ok(self.number(std::f64::consts::PI, Some(Unit::NONE), span));
        }
        let Some(declared) = self.scope.names.get(name) else {
            let mistake = if Unit::named(name).is_some() {
                Diagnostic::new(span, format!("the unit `{name}` must follow a number"))
                    .help(format!("write `1 {name}`"))
            } else if FUNCTION_NAMES.contains(&name) || self.scope.table(name).is_some() {
                Diagnostic::new(span, format!("the function `{name}` needs its argument in parentheses"))
                    .help(format!("write `{name}(…)`"))
            } else if self.allowed == Allowed::Nothing {
                Diagnostic::new(span, format!("expected a number, found `{name}`"))
                    .help("names cannot be used here")
            } else {
                unknown(name, span, self.scope, self.found.len())
            };
            return Err(mistake);
        };
        if let Err(reason) = self.allowed.check(declared.symbol) {
            return Err(Diagnostic::new(span, format!("`{name}` cannot be used here"))
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
                let message = format!("the square root of {found} has no unit");
                self.refuse(operand, &message, "divide by a reference first")
            }),
            _ if found == Dimension::NONE => Some(found),
            _ => {
                let message = format!("`{}` expects a pure number, found {found}", function.name());
                self.refuse(operand, &message, "divide by a length, such as `d1/(1600 mm)`")
            }
        });
        let value = self.terms[operand].value.map(|value| function.evaluate(value));
        self.push_folded(Kind::Call(function, operand), dimension, value, span)
    }

    /// Builds one of [`FUNCTIONS_OF_TWO`].
    pub(super) fn function_of_two(
        &mut self,
        (name, operator): (&str, Binary),
        a: usize,
        b: usize,
        span: Span,
    ) -> usize {
        let common = self.equal(a, b, &format!("the arguments of `{name}` must have the same dimension"));
        let dimension = common.map(|own| if operator == Binary::Atan2 { Dimension::NONE } else { own });
        let value = self.both(a, b).map(|(a, b)| operator.evaluate(a, b));
        self.push_folded(Kind::Binary(operator, a, b), dimension, value, span)
    }

    /// Sets the span of a term, extended to its closing parenthesis.
    pub(super) fn respan(&mut self, term: usize, span: Span) -> usize {
        self.terms[term].span = span;
        term
    }

    /// Builds a table lookup whose argument consists of the terms from `begin` on.
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
            let message = format!("`{name}` expects {expected}, found {found}");
            let help =
                "the argument must have the dimension of the table's x; divide or multiply by a reference";
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
            Binary::Add => self.equal(left, right, "cannot add quantities of different dimensions"),
            Binary::Sub => self.equal(left, right, "cannot subtract quantities of different dimensions"),
            Binary::Mul => both.and_then(|(l, r)| self.or_absurd(l.times(r), &span)),
            Binary::Div => both.and_then(|(l, r)| self.or_absurd(l.over(r), &span)),
            Binary::Pow => self.power(left, right),
            Binary::Atan2 | Binary::Min | Binary::Max => l,
        };
        let value = self.both(left, right).map(|(l, r)| operator.evaluate(l, r));
        if operator == Binary::Div && self.terms[right].value == Some(0.0) {
            self.mistake(right, "division by zero".to_owned(), "divide by a nonzero value");
            return self.push_folded(Kind::Binary(operator, left, right), None, None, span);
        }
        self.push_folded(Kind::Binary(operator, left, right), dimension, value, span)
    }

    fn power(&mut self, base: usize, exponent: usize) -> Option<Dimension> {
        let Some(value) = self.terms[exponent].value else {
            let help = "names can only be used in the base";
            return self.refuse(exponent, "an exponent must be a number", help);
        };
        if self.terms[exponent].dimension? != Dimension::NONE {
            return self.refuse(exponent, "an exponent must be a pure number", "remove its unit");
        }
        let dimension = self.terms[base].dimension?;
        dimension.power(value).or_else(|| {
            let message = format!("{dimension} to the power {value} has no unit");
            self.refuse(exponent, &message, "divide the base by a reference first: `(F/(1 N))^0.7`")
        })
    }

    /// Returns the common dimension of two terms, or records that they differ.
    fn equal(&mut self, left: usize, right: usize, message: &str) -> Option<Dimension> {
        let (l, r) = (self.terms[left].dimension?, self.terms[right].dimension?);
        if l == r {
            return Some(l);
        }
        let unit = self.scope.length.symbol();
        let bare = |term: &Term| matches!(term.kind, Kind::Number(_)) && term.bare;
        let help = match (bare(&self.terms[left]), bare(&self.terms[right])) {
            (true, _) => format!("add a unit to the number, such as `{}`", r.unit(unit)),
            (_, true) => format!("add a unit to the number, such as `{}`", l.unit(unit)),
            _ => "both sides must have compatible units".to_owned(),
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
                Diagnostic::new(span.clone(), "an exponent of the unit of this product is too large")
                    .help("check the units: exponents of units are limited to 50"),
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

    /// Records a diagnostic at a term, and returns none.
    fn refuse<T>(&mut self, term: usize, message: &str, help: &str) -> Option<T> {
        self.mistake(term, message.to_owned(), help);
        None
    }

    /// Appends a term, or records that its constant value is NaN or too large.
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
                    ("has no real value", "the argument of a logarithm must be positive")
                }
                (true, _) => ("has no real value", "the base of a root or power must not be negative"),
                (false, _) => ("is too large to compute with", "the maximum is 1e150; check the unit"),
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

/// Returns the diagnostic of an unknown name, after `found` others.
fn unknown(name: &str, span: Span, scope: &Scope, found: usize) -> Diagnostic {
    let names: Vec<&str> = scope.names.keys().map(String::as_str).collect();
    let mistake = Diagnostic::new(span, format!("unknown name `{name}`"));
    for (superscript, power) in [('²', 2), ('³', 3)] {
        if let Some(base) = name.strip_suffix(superscript) {
            return mistake.help(format!("write powers with `^`: `{base}^{power}`"));
        }
    }
    let tables = scope.tables.iter().map(|table| table.name.as_str());
    let candidates = names.iter().copied().chain(tables).chain(FUNCTION_NAMES);
    let near = nearest_after(found, name, candidates).map(|near| format!("did you mean `{near}`?"));
    // A letter may be anything.
    match near.or_else(|| unit_meant(name).filter(|_| name.len() > 1)) {
        Some(help) => mistake.help(help),
        None if names.is_empty() => mistake.help("this spec declares no variables, parameters or inputs"),
        None => mistake.help(format!("declared names: {}", first(&names))),
    }
}
