//! Two lanes in an array, for machines without a register type here: the compiler finds their
//! instructions for pairs (NEON).

use super::{Register, by_array};
use crate::Scalar;

macro_rules! lane_by_lane {
    ($($name:ident($($argument:ident),+) $value:expr;)+) => {$(
        #[inline(always)]
        fn $name($($argument: Self),+) -> Self {
            core::array::from_fn(|lane| {
                $(let $argument = $argument[lane];)+
                $value
            })
        }
    )+};
}

impl Register for [f64; 2] {
    by_array!(2, fused: false);

    lane_by_lane! {
        add(a, b) a + b;
        sub(a, b) a - b;
        mul(a, b) a * b;
        div(a, b) a / b;
        mul_add(a, b, c) a * b + c;
        mul_sub(a, b, c) a * b - c;
        neg_mul_add(a, b, c) c - a * b;
        sqrt(a) Scalar::sqrt(a);
        min(a, b) if a < b { a } else { b };
        max(a, b) if a > b { a } else { b };
        xor(a, b) f64::from_bits(a.to_bits() ^ b.to_bits());
        and(a, b) f64::from_bits(a.to_bits() & b.to_bits());
        or(a, b) f64::from_bits(a.to_bits() | b.to_bits());
        and_not(a, b) f64::from_bits(a.to_bits() & !b.to_bits());
        more_than(a, b) f64::from_bits(if a > b { u64::MAX } else { 0 });
        odd(a) f64::from_bits(0_u64.wrapping_sub(a.to_bits() & 1));
    }

    #[inline(always)]
    fn shifted<const PLACES: u32>(a: Self) -> Self {
        a.map(|a| f64::from_bits(a.to_bits() << PLACES))
    }
}
