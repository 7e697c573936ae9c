//! Tests against the exact sine and cosine to 100 bits.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use dashu_float::{ConstCache, Context, FBig, round::mode::HalfEven};

use super::{REACH, Real, beyond, each, near, scalar};

type Exact = FBig<HalfEven, 2>;
type Function = fn(f64) -> (f64, f64);

const VARIANTS: [Function; 3] = [scalar, near, fused];

/// Returns [`near`] with `a · b + c` rounded once, as in lanes with FMA.
fn fused(x: f64) -> (f64, f64) {
    let (Fused(sine), Fused(cosine)) = near(Fused(x));
    (sine, cosine)
}

#[derive(Clone, Copy)]
struct Fused(f64);

macro_rules! fused {
    ($($operator:ident $function:ident),+) => {$(
        impl core::ops::$operator for Fused {
            type Output = Self;
            fn $function(self, other: Self) -> Self {
                Self(core::ops::$operator::$function(self.0, other.0))
            }
        }
    )+};
}

fused!(Add add, Sub sub, Mul mul);

impl Real for Fused {
    const FUSED: bool = true;
    fn splat(value: f64) -> Self {
        Self(value)
    }
    fn times_plus(self, b: Self, c: Self) -> Self {
        Self(f64::mul_add(self.0, b.0, c.0))
    }
    fn times_from(self, b: Self, c: Self) -> Self {
        Self(f64::mul_add(-self.0, b.0, c.0))
    }
    fn xor(self, other: Self) -> Self {
        Self(Real::xor(self.0, other.0))
    }
    fn and(self, other: Self) -> Self {
        Self(Real::and(self.0, other.0))
    }
    fn odd(self) -> Self {
        Self(Real::odd(self.0))
    }
    fn shifted<const PLACES: u32>(self) -> Self {
        Self(Real::shifted::<PLACES>(self.0))
    }
}

/// Measures errors in units in the last place of the correctly rounded result.
struct Reference {
    context: Context<HalfEven>,
    constants: ConstCache,
}

impl Reference {
    fn new() -> Self {
        Self { context: Context::new(100), constants: ConstCache::new() }
    }

    /// Returns the larger error of sine and cosine.
    fn error(&mut self, function: Function, x: f64) -> f64 {
        self.errors(&[function], x)[0]
    }

    fn errors(&mut self, functions: &[Function], x: f64) -> Vec<f64> {
        let angle = Exact::try_from(x).unwrap();
        let (sine, cosine) = self.context.sin_cos(angle.repr(), Some(&mut self.constants));
        let (sine, cosine) = (split(sine.unwrap().value()), split(cosine.unwrap().value()));
        functions
            .iter()
            .map(|function| {
                let (s, c) = function(x);
                ulps(s, sine).max(ulps(c, cosine))
            })
            .collect()
    }

    /// Returns the largest error of each variant over the angles, and its angle.
    fn worst(&mut self, angles: impl Iterator<Item = f64>) -> [(f64, f64); 3] {
        let mut worst = [(0.0, 0.0); 3];
        for x in angles {
            assert!(x.abs() <= REACH, "{x} is beyond the reach");
            for (worst, error) in worst.iter_mut().zip(self.errors(&VARIANTS, x)) {
                if error > worst.0 || error.is_nan() {
                    *worst = (error, x);
                }
            }
        }
        worst
    }
}

/// Splits a number into the nearest `f64` and the remainder.
fn split(exact: Exact) -> (f64, f64) {
    let nearest = exact.to_f64().value();
    let rest = exact - Exact::try_from(nearest).unwrap();
    (nearest, rest.to_f64().value())
}

fn ulps(value: f64, (nearest, rest): (f64, f64)) -> f64 {
    let size = nearest.abs();
    (((value - nearest) - rest) / (size.next_up() - size)).abs()
}

/// Returns an evenly spread sequence in `[0, 1)` for any count: multiples of the golden ratio.
fn spread(count: usize) -> impl Iterator<Item = f64> {
    (0..count).map(|i| (i as f64 * 0.618_033_988_749_894_9).fract())
}

fn signed(u: f64) -> f64 {
    2.0 * u - 1.0
}

/// Returns an angle of any size from subnormal numbers to the reach, uniform in its logarithm.
fn of_any_size(u: f64) -> f64 {
    let x = REACH * 10_f64.powf(-u * 328.0);
    if (u * 1e6).fract() < 0.5 { x } else { -x }
}

/// Returns the `f64` nearest to kπ/2 and its neighbors.
fn near_quarter_turns(k: u32) -> impl Iterator<Item = f64> {
    let middle = f64::from(k) * FRAC_PI_2;
    (-4..=4).map(move |places| f64::from_bits(middle.to_bits().wrapping_add_signed(places)))
}

/// Returns an angle with a large error: `r` just above a power of two, so that its sine has a
/// smaller last place.
fn above_powers_of_two(u: f64) -> f64 {
    let power = 2_f64.powi(-1 - (u * 64.0) as i32 % 12);
    let turns = (signed((u * 4096.0).fract()) * 63_000.0).round();
    turns * FRAC_PI_2 + power * (1.0 + power * power / 6.0 * (u * 262_144.0).fract())
}

fn assert_within(worst: [(f64, f64); 3]) {
    for (error, x) in worst {
        assert!(error < 1.7, "{error} ulp at {x:e}");
    }
}

#[test]
fn within_ulps_of_the_exact_values() {
    let mut reference = Reference::new();
    assert_within(reference.worst(spread(1500).map(|u| REACH * signed(u))));
    assert_within(reference.worst(spread(500).map(|u| 10.0 * signed(u))));
    assert_within(reference.worst(spread(500).map(|u| FRAC_PI_4 * signed(u))));
    assert_within(reference.worst(spread(500).map(of_any_size)));
    assert_within(reference.worst(spread(1500).map(above_powers_of_two)));
}

#[test]
fn within_ulps_beside_multiples_of_a_quarter_turn() {
    let mut reference = Reference::new();
    // The `f64` nearest to a multiple of π/2 within the reach is the one at 29 · 2^j.
    let nearest = (0..12).map(|j| 29 << j);
    let multiples = (1..64).chain(nearest).chain((64..63_662).step_by(331)).chain([63_661]);
    assert_within(reference.worst(multiples.flat_map(near_quarter_turns)));
}

/// Runs for minutes: `cargo test --release -p abbe -- --ignored widely`.
#[test]
#[ignore = "minutes, and only in a release build"]
fn widely_within_ulps_of_the_exact_values() {
    let mut reference = Reference::new();
    let widely: [(&str, Box<dyn Iterator<Item = f64>>); 5] = [
        ("uniform", Box::new(spread(1_000_000).map(|u| REACH * signed(u)))),
        ("a few turns", Box::new(spread(300_000).map(|u| 10.0 * signed(u)))),
        ("any size", Box::new(spread(300_000).map(of_any_size))),
        ("above powers of two", Box::new(spread(1_000_000).map(above_powers_of_two))),
        ("quarter turns", Box::new((1..63_662).flat_map(near_quarter_turns))),
    ];
    for (which, angles) in widely {
        let worst = reference.worst(angles);
        println!("{which}: {worst:?}");
        assert_within(worst);
    }
}

#[test]
fn zeros_are_exact_and_keep_their_sign() {
    for function in VARIANTS {
        for zero in [0.0, -0.0] {
            let (sine, cosine) = function(zero);
            assert_eq!(sine.to_bits(), f64::to_bits(zero));
            assert_eq!(cosine.to_bits(), 1_f64.to_bits());
        }
    }
}

#[test]
fn sine_is_odd_and_cosine_even_to_the_last_bit() {
    for function in VARIANTS {
        for x in spread(20_000).flat_map(|u| [REACH * u, of_any_size(u), above_powers_of_two(u)]) {
            let ((s, c), (minus_s, minus_c)) = (function(x), function(-x));
            assert_eq!((s.to_bits(), c.to_bits()), ((-minus_s).to_bits(), minus_c.to_bits()), "at {x:e}");
        }
    }
}

#[test]
fn squares_add_to_one() {
    for function in VARIANTS {
        for x in spread(20_000).map(|u| REACH * signed(u)) {
            let (s, c) = function(x);
            // Twice the relative error of 1.7 ulp of each, and three roundings.
            assert!((s * s + c * c - 1.0).abs() <= 5.0 * f64::EPSILON, "at {x:e}");
        }
    }
}

#[test]
fn the_scalar_form_has_the_bits_of_the_lanes() {
    for x in spread(20_000).flat_map(|u| [REACH * signed(u), of_any_size(u)]) {
        let ((s, c), (lane_s, lane_c)) = (scalar(x), near(x));
        assert_eq!((s.to_bits(), c.to_bits()), (lane_s.to_bits(), lane_c.to_bits()), "at {x:e}");
    }
}

#[test]
fn many_together_have_the_bits_of_one_by_one() {
    for x in spread(2_000).map(|u| 2.0 * REACH * signed(u)) {
        let angles = [x, x / 3.0, -0.0, x / 1e5];
        let bits = |(s, c): (f64, f64)| (s.to_bits(), c.to_bits());
        let expected = angles.map(scalar).map(bits);
        assert_eq!(<f64 as crate::Scalar>::sin_cos_each(angles).map(bits), expected, "at {x:e}");
        assert_eq!(each::<[f64; 2], 4>(angles).map(bits), expected, "at {x:e}");
    }
}

#[test]
fn beyond_the_reach_the_library_takes_over_without_a_step() {
    let mut reference = Reference::new();
    assert!(reference.error(scalar, REACH) < 1.7);
    for x in [REACH.next_up(), -REACH.next_up(), 1e9, -1e22, f64::MAX] {
        let ((s, c), (library_s, library_c)) = (scalar(x), beyond(x));
        assert_eq!((s.to_bits(), c.to_bits()), (library_s.to_bits(), library_c.to_bits()));
        assert!(reference.error(scalar, x) < 1.0, "at {x:e}");
    }
    for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let (s, c) = scalar(x);
        assert!(s.is_nan() && c.is_nan(), "at {x}");
    }
}
