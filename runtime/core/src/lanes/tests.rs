//! Every instruction of every register against the same with plain numbers, bit for bit.

use super::{InstructionSet, Kernel, Lanes, Register, Tiles};
use crate::Scalar;

/// Returns triples of numbers of all kinds.
fn numbers() -> Vec<[f64; 3]> {
    let some =
        [0.0, -0.0, 1.0, -2.5, 1e-310, f64::MAX, f64::INFINITY, f64::NAN, 0.1, -1e17, 3.0, f64::MIN_POSITIVE];
    let count = some.len();
    (0..count * count * 3)
        .map(|i| [some[i % count], some[i / count % count], some[(i * 7 + i / 5) % count]])
        .collect()
}

/// Returns whether two numbers have the same bits. All NaNs are equal.
fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

struct Check;

/// Operation on three registers, and the same on plain numbers.
type Arithmetic<R> = (&'static str, fn(R, R, R) -> R, fn(f64, f64, f64) -> f64);

/// Operation on the bits of two registers, and the same on plain bits.
type Bits<R> = (&'static str, fn(R, R) -> R, fn(u64, u64) -> u64);

impl Kernel for Check {
    type Output = ();

    fn run<R: Register>(self) {
        let fused = |a: f64, b: f64, c: f64| if R::FUSED { a.mul_add(b, c) } else { a * b + c };
        let arithmetic: [Arithmetic<R>; 7] = [
            ("add", |a, b, _| R::add(a, b), |a, b, _| a + b),
            ("sub", |a, b, _| R::sub(a, b), |a, b, _| a - b),
            ("mul", |a, b, _| R::mul(a, b), |a, b, _| a * b),
            ("div", |a, b, _| R::div(a, b), |a, b, _| a / b),
            ("sqrt", |a, _, _| R::sqrt(a), |a, _, _| a.sqrt()),
            ("min", |a, b, _| R::min(a, b), |a, b, _| if a < b { a } else { b }),
            ("max", |a, b, _| R::max(a, b), |a, b, _| if a > b { a } else { b }),
        ];
        let bits: [Bits<R>; 8] = [
            ("xor", R::xor, |a, b| a ^ b),
            ("and", R::and, |a, b| a & b),
            ("or", R::or, |a, b| a | b),
            ("and_not", R::and_not, |a, b| a & !b),
            ("odd", |a, _| R::odd(a), |a, _| 0_u64.wrapping_sub(a & 1)),
            ("shifted by 62", |a, _| R::shifted::<62>(a), |a, _| a << 62),
            ("shifted by 63", |a, _| R::shifted::<63>(a), |a, _| a << 63),
            (
                "more_than",
                R::more_than,
                |a, b| if f64::from_bits(a) > f64::from_bits(b) { u64::MAX } else { 0 },
            ),
        ];
        let all = &numbers();
        for first in 0..all.len() - R::WIDTH {
            let at = |k: usize| move |lane: usize| all[first + lane][k];
            let [a, b, c] = [R::from_fn(at(0)), R::from_fn(at(1)), R::from_fn(at(2))];
            let check = |name: &str, found: R, expected: &dyn Fn([f64; 3]) -> f64| {
                for (lane, found) in found.lanes().iter().enumerate() {
                    let expected = expected(all[first + lane]);
                    assert!(
                        same(*found, expected),
                        "{name} {:?}: {found}, not {expected}",
                        all[first + lane]
                    );
                }
            };
            for (name, lanes, number) in arithmetic {
                check(name, lanes(a, b, c), &|[a, b, c]| number(a, b, c));
            }
            for (name, lanes, number) in bits {
                check(name, lanes(a, b), &|[a, b, _]| f64::from_bits(number(a.to_bits(), b.to_bits())));
            }
            check("mul_add", R::mul_add(a, b, c), &|[a, b, c]| fused(a, b, c));
            check("mul_sub", R::mul_sub(a, b, c), &|[a, b, c]| fused(a, b, -c));
            check("neg_mul_add", R::neg_mul_add(a, b, c), &|[a, b, c]| fused(-a, b, c));
            check("splat", R::splat(0.3), &|_| 0.3);
        }
    }
}

#[test]
fn registers_compute_what_numbers_do() {
    InstructionSet::all().for_each(|set| set.run(Check));
    // The register of other architectures.
    Check.run::<[f64; 2]>();
}

struct CheckFunctions;

/// Function of two lanes, and the same of plain numbers.
type Binary<R> = (&'static str, fn(Lanes<R>, Lanes<R>) -> Lanes<R>, fn(f64, f64) -> f64);

impl Kernel for CheckFunctions {
    type Output = ();

    fn run<R: Register>(self) {
        let functions: [Binary<R>; 4] = [
            ("min", Scalar::min, Scalar::min),
            ("max", Scalar::max, Scalar::max),
            ("side", |a, _| a.side(), |a, _| a.side()),
            ("atan2", Scalar::atan2, Scalar::atan2),
        ];
        let all = &numbers();
        for first in 0..all.len() - R::WIDTH {
            let [a, b] = [0, 1].map(|k| Lanes::<R>::from_fn(|lane| all[first + lane][k]));
            for (name, of_lanes, of_numbers) in functions {
                for (lane, found) in of_lanes(a, b).as_slice().iter().enumerate() {
                    let [a, b, _] = all[first + lane];
                    let expected = of_numbers(a, b);
                    let is_near = name == "atan2" && (found - expected).abs() <= 4e-16 * expected.abs();
                    assert!(is_near || same(*found, expected), "{name} {a} {b}: {found}, not {expected}");
                }
            }
        }
    }
}

#[test]
fn functions_of_lanes_are_those_of_numbers() {
    InstructionSet::all().for_each(|set| set.run(CheckFunctions));
    CheckFunctions.run::<[f64; 2]>();
}

struct CheckAngles;

impl Kernel for CheckAngles {
    type Output = f64;

    /// Returns the largest error of an angle in units of its last place.
    fn run<R: Register>(self) -> f64 {
        let mut worst: f64 = 0.0;
        for index in 0..200_000 {
            let number = |i: usize| 2.0 * crate::sampling::halton(index + 1, i) - 1.0;
            let size = f64::powi(10.0, (8.0 * number(2)) as i32);
            let (y, x) = (number(0) * size, number(1));
            let (y, x) = if index % 3 == 0 { (y / size, x) } else { (y, x) };
            let found = Scalar::atan2(Lanes::<R>::constant(y), Lanes::<R>::constant(x)).as_slice()[0];
            let exact = y.atan2(x);
            let place = f64::from_bits(exact.abs().to_bits() + 1) - exact.abs();
            worst = worst.max((found - exact).abs() / place);
        }
        worst
    }
}

/// Library functions are within one unit of the last place.
#[test]
fn angles_are_accurate() {
    for set in InstructionSet::all() {
        let worst = set.run(CheckAngles);
        assert!(worst <= 3.0, "{}: {worst} units of the last place", set.name());
    }
}

#[test]
fn a_number_is_where_it_was_put() {
    for set in InstructionSet::all() {
        for count in [0, 1, 7, 8, 9, 33] {
            let mut tiles = Tiles::new(set, 3, count);
            let value = |row: usize, i: usize| (100 * row + i) as f64;
            for i in 0..count {
                (0..3).for_each(|row| tiles.set_value(row, i, value(row, i)));
            }
            tiles.pad();
            let mut rows = [0.0; 2];
            for i in 0..count {
                tiles.copy_rows(1..3, i, &mut rows);
                assert_eq!([tiles.get(0, i), rows[0], rows[1]], [0, 1, 2].map(|row| value(row, i)));
            }
            tiles.set_each(&[2, 0], 0, count, |which| which as f64);
            assert!((0..count).all(|i| tiles.get(2, i) == 0.0 && tiles.get(0, i) == 1.0));
        }
    }
}

#[test]
#[should_panic(expected = "row 3 of 3")]
fn there_is_no_row_behind_the_last() {
    Tiles::new(InstructionSet::BASELINE, 3, 1).fill_row(3, 1.0);
}

#[test]
fn what_is_set_is_copied() {
    for set in InstructionSet::all() {
        let (rows, mut tiles) = ([2, 0], Tiles::new(set, 3, 11));
        let values: Vec<f64> = (0..2 * 9).map(f64::from).collect();
        let mut next = values.iter();
        tiles.set_each(&rows, 2, 9, |_| *next.next().unwrap());
        let mut copied = [0.0; 2 * 9];
        tiles.copy_each(&rows, 2, &mut copied);
        assert_eq!((&copied[..], tiles.get(2, 3), tiles.get(1, 3)), (&values[..], 2.0, 0.0));
        tiles.copy_each(&[1], 0, &mut copied[..11]);
        assert!(copied[..11].iter().all(|value| *value == 0.0));
    }
}
