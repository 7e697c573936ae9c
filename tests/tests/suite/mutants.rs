//! The laws find every mutant of generated code: of each function, one operation after the other is
//! replaced by a wrong one, by a scalar type that counts the operations of a call.

use std::cell::RefCell;
use std::ops::{Add, Div, Mul, Neg, Sub};

use abbe::lanes::{self, Batches, Evaluate, OneByOne, Tiles};
use abbe::{Description, Error, Function, LookupTable, Manipulator, Scalar, laws};
use abbe_tests::golden::measured::Measured;
use abbe_tests::languages::{arguments, configurations};
use abbe_tests::thorough;

/// Kind of an operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Sum,
    Difference,
    Product,
    Quotient,
    Negation,
    Constant,
    SineAndCosine,
    Unary,
    Sign,
    Extremum,
    Table,
}

impl Kind {
    const ALL: [Self; 11] = [
        Self::Sum,
        Self::Difference,
        Self::Product,
        Self::Quotient,
        Self::Negation,
        Self::Constant,
        Self::SineAndCosine,
        Self::Unary,
        Self::Sign,
        Self::Extremum,
        Self::Table,
    ];
}

/// Operations of a call: how many of each kind there were, and the one that is wrong.
#[derive(Default)]
struct Call {
    counts: [usize; Kind::ALL.len()],
    wrong: Option<(Kind, usize)>,
}

thread_local! {
    static CALL: RefCell<Call> = RefCell::default();
}

/// Scalar whose operations are counted, one of which is wrong.
#[derive(Clone, Copy, Debug)]
struct Counted(f64);

/// Returns the result of an operation, or the wrong one if this is the mutated operation.
fn result<R>(kind: Kind, right: R, wrong: R) -> R {
    CALL.with_borrow_mut(|call| {
        let count = &mut call.counts[kind as usize];
        *count += 1;
        if call.wrong == Some((kind, *count - 1)) { wrong } else { right }
    })
}

fn scalar(kind: Kind, right: f64, wrong: f64) -> Counted {
    Counted(result(kind, right, wrong))
}

impl Add for Counted {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        scalar(Kind::Sum, self.0 + b.0, self.0 - b.0)
    }
}

impl Sub for Counted {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        scalar(Kind::Difference, self.0 - b.0, self.0 + b.0)
    }
}

impl Mul for Counted {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        scalar(Kind::Product, self.0 * b.0, self.0 + b.0)
    }
}

impl Div for Counted {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        scalar(Kind::Quotient, self.0 / b.0, self.0 * b.0)
    }
}

impl Neg for Counted {
    type Output = Self;
    fn neg(self) -> Self {
        scalar(Kind::Negation, -self.0, self.0)
    }
}

impl Scalar for Counted {
    fn constant(value: f64) -> Self {
        scalar(Kind::Constant, value, if value == 0.0 { 0.5 } else { 1.5 * value })
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = Scalar::sin_cos(self.0);
        let [sine, cosine] = result(Kind::SineAndCosine, [sine, cosine], [cosine, sine]);
        (Self(sine), Self(cosine))
    }
    fn tan(self) -> Self {
        scalar(Kind::Unary, self.0.tan(), self.0)
    }
    fn asin(self) -> Self {
        scalar(Kind::Unary, self.0.asin(), self.0)
    }
    fn acos(self) -> Self {
        scalar(Kind::Unary, self.0.acos(), self.0)
    }
    fn atan(self) -> Self {
        scalar(Kind::Unary, self.0.atan(), self.0)
    }
    fn atan2(self, x: Self) -> Self {
        scalar(Kind::Unary, self.0.atan2(x.0), x.0.atan2(self.0))
    }
    fn sqrt(self) -> Self {
        scalar(Kind::Unary, self.0.sqrt(), self.0)
    }
    fn abs(self) -> Self {
        scalar(Kind::Unary, self.0.abs(), self.0)
    }
    fn exp(self) -> Self {
        scalar(Kind::Unary, self.0.exp(), self.0)
    }
    fn ln(self) -> Self {
        scalar(Kind::Unary, self.0.ln(), self.0)
    }
    fn sign(self) -> Self {
        scalar(Kind::Sign, Scalar::sign(self.0), -Scalar::sign(self.0))
    }
    fn side(self) -> Self {
        scalar(Kind::Sign, Scalar::side(self.0), -Scalar::side(self.0))
    }
    fn is_positive(self) -> bool {
        self.0 > 0.0
    }
    fn min(self, other: Self) -> Self {
        scalar(Kind::Extremum, Scalar::min(self.0, other.0), Scalar::max(self.0, other.0))
    }
    fn max(self, other: Self) -> Self {
        scalar(Kind::Extremum, Scalar::max(self.0, other.0), Scalar::min(self.0, other.0))
    }
    fn piece(self, table: &LookupTable<'_>) -> (Self, [Self; 4]) {
        let (t, coefficients) = self.0.piece(table);
        let coefficients = result(Kind::Table, coefficients, coefficients.map(|value| 1.5 * value));
        (Self(t), coefficients.map(Self))
    }
    fn powf(self, exponent: Self) -> Self {
        scalar(Kind::Unary, self.0.powf(exponent.0), self.0)
    }
}

macro_rules! functions {
    (: $($function:ident = $name:ident($($argument:ident),+) -> ($($result:ident),+) $($oriented:ident)?:
        $documentation:literal $(, $note:literal)?;)+) => {
        /// Fills the results of a function.
        fn generated(function: Function, given: &[Counted], results: &mut [Counted]) -> Option<()> {
            match function {
                $(Function::$function => Evaluate::<lanes::$function>::evaluate_lanes(&Measured, given, results),)+
                Function::Passive | Function::DisplacedPose | Function::LegForces | Function::Inverse => None,
            }
        }
    };
}
abbe::for_functions!(every: functions);

/// Generated manipulator with one wrong operation in one function.
#[derive(Clone, Copy, Debug)]
struct Mutant {
    function: Function,
    wrong: Option<(Kind, usize)>,
}

impl Mutant {
    /// Returns the results of a function, and the number of operations of each kind.
    fn mutated(&self, function: Function, given: &[f64]) -> (Vec<f64>, [usize; Kind::ALL.len()]) {
        let given: Vec<Counted> = given.iter().copied().map(Counted).collect();
        let wrong = self.wrong.filter(|_| function == self.function);
        CALL.set(Call { counts: [0; Kind::ALL.len()], wrong });
        let mut results = vec![Counted(0.0); function.signature().results_len(self.description())];
        generated(function, &given, &mut results).unwrap();
        (results.into_iter().map(|value| value.0).collect(), CALL.take().counts)
    }

    /// Fills the results of a table of configurations, by the wrong code of the function that is
    /// mutated.
    fn batch(&self, function: Function, arguments: &Tiles, results: &mut Tiles) -> Result<(), Error> {
        if function != self.function {
            return Measured.batch(function, arguments, results);
        }
        let mut given = vec![0.0; arguments.rows()];
        for configuration in 0..arguments.count() {
            arguments.copy_rows(0..arguments.rows(), configuration, &mut given);
            for (row, value) in self.mutated(function, &given).0.into_iter().enumerate() {
                results.set_value(row, configuration, value);
            }
        }
        Ok(())
    }

    /// Returns the largest change of a result by the mutation, relative to the largest result.
    fn effect(&self, given: &[Vec<f64>]) -> f64 {
        let right = Self { wrong: None, ..*self };
        let change = |given: &Vec<f64>| {
            let given = arguments(self, self.function.signature(), given);
            let [(right, _), (wrong, _)] = [right, *self].map(|robot| robot.mutated(self.function, &given));
            let largest = right.iter().fold(0.0, |largest: f64, number| largest.max(number.abs()));
            let changes = right.iter().zip(&wrong).map(|(right, wrong)| (right - wrong).abs());
            // Not a number is a change.
            changes.fold(0.0, |most: f64, change| if change <= most { most } else { change }) / largest
        };
        given.iter().map(change).fold(0.0, |most, change| if change <= most { most } else { change })
    }

    /// Returns whether a law of `test_manipulator!` fails.
    fn is_found(&self, samples: usize) -> bool {
        let batch =
            |function, arguments: &Tiles, results: &mut Tiles| self.batch(function, arguments, results);
        laws::all(&OneByOne(*self), samples)
            .and_then(|()| laws::evaluations(self, &Function::ALL, samples, &batch))
            .and_then(|found| found.within("batches", laws::ROUNDING_TOLERANCE))
            .is_err()
    }
}

impl Manipulator for Mutant {
    fn description(&self) -> &Description {
        Measured.description()
    }
    fn evaluate(
        &self,
        function: Function,
        arguments: &[&[f64]],
        results: &mut [&mut [f64]],
    ) -> Result<(), Error> {
        Measured.evaluate(function, arguments, results)?;
        let (values, _) = self.mutated(function, &arguments.concat());
        results
            .iter_mut()
            .flat_map(|result| &mut **result)
            .zip(values)
            .for_each(|(into, value)| *into = value);
        Ok(())
    }
}

/// Smallest relative change of a result that makes an operation wrong.
const EFFECT: f64 = 1e-9;

/// An ordinary run mutates one operation of each kind in each function, a thorough one all of them.
/// Operations without effect are left out, such as a sum of the zeros of a linear table.
#[test]
fn are_all_found() {
    let mut survivors = Vec::new();
    let mut mutants = [0; Kind::ALL.len()];
    let mut ineffective = 0;
    let given = configurations(&Measured, 100);
    for function in Function::ALL {
        let right = Mutant { function, wrong: None };
        assert!(!right.is_found(20), "{}", function.name());
        let (_, counts) = right.mutated(function, &arguments(&right, function.signature(), &given[0]));
        for (kind, count) in Kind::ALL.into_iter().zip(counts) {
            let indices = (count / 2..count).chain(0..count / 2);
            let all = indices.map(|index| (index, Mutant { function, wrong: Some((kind, index)) }));
            let effective = all.filter(|(_, mutant)| {
                // A change that is not a number has an effect.
                let has_none = mutant.effect(&given) < EFFECT;
                ineffective += usize::from(has_none);
                !has_none
            });
            for (index, mutant) in effective.take(if thorough() { count } else { 1 }) {
                mutants[kind as usize] += 1;
                if !mutant.is_found(5) && !mutant.is_found(laws::SAMPLES) {
                    survivors.push(format!("{}: {kind:?} {index} of {count}", function.name()));
                }
            }
        }
    }
    println!("{} mutants, {ineffective} others without effect", mutants.iter().sum::<usize>());
    assert!(mutants.iter().all(|count| *count > 0), "{mutants:?}");
    assert!(survivors.is_empty(), "{survivors:#?}");
}
