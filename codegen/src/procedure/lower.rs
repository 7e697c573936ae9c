//! Sums as loops, for languages without sums of arrays.

use super::{Counter, Index, Kind, Procedure, Statement, Value, Variable};

impl Procedure {
    /// Replaces sums by loops that add one product after the other.
    #[must_use]
    pub fn with_loops(mut self) -> Self {
        let mut sums = 0;
        self.body = lowered(std::mem::take(&mut self.body), &mut sums);
        self.locals.extend(NAMES[..sums].iter().map(|name| Variable { name, kind: Kind::Real }));
        self
    }
}

/// Names of the sums of one statement.
const NAMES: [&str; 2] = ["total", "other_total"];

/// Returns statements without sums. `most` is the largest number of sums of a statement.
fn lowered(body: Vec<Statement>, most: &mut usize) -> Vec<Statement> {
    let mut list = Vec::new();
    for statement in body {
        match statement {
            Statement::Set(Value::Name(name), Value::Dot { counter, range, factors }) => {
                list.extend(sum(name, counter, range, factors));
            }
            Statement::Set(place, mut value) => {
                let mut count = 0;
                extract(&mut value, &mut list, &mut count);
                *most = count.max(*most);
                list.push(Statement::Set(place, value));
            }
            Statement::For { counter, range, is_descending, body } => {
                list.push(Statement::For { counter, range, is_descending, body: lowered(body, most) });
            }
            Statement::If { condition, body } => {
                list.push(Statement::If { condition, body: lowered(body, most) });
            }
            other => list.push(other),
        }
    }
    list
}

/// Replaces the sums of a value by names, and appends the statements that compute them.
fn extract(value: &mut Value, list: &mut Vec<Statement>, count: &mut usize) {
    if let Value::Dot { counter, range, factors } = value {
        let name = NAMES[*count];
        *count += 1;
        list.extend(sum(name, *counter, range.clone(), factors.clone()));
        *value = Value::Name(name);
        return;
    }
    value.operands_mut().for_each(|operand| extract(operand, list, count));
}

/// Returns the statements that add products one by one.
fn sum(
    name: &'static str,
    counter: Counter,
    range: [Index; 2],
    factors: [(&'static str, Index); 2],
) -> [Statement; 2] {
    let [a, b] = factors.map(|(array, index)| Value::Element(array, index));
    let body = vec![Statement::Set(Value::Name(name), Value::Name(name) + a * b)];
    let begin = Statement::Set(Value::Name(name), Value::Number(0.0));
    [begin, Statement::For { counter, range, is_descending: false, body }]
}
