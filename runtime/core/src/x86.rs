//! SSE2, AVX2 and AVX-512 registers: the only `unsafe` code of the project.
//!
//! An instruction may execute only on a CPU that has it. Every x86-64 CPU has SSE2, which evaluates
//! sines and cosines in pairs. The other two types are named only in `lanes::InstructionSet::run`,
//! which has detected the CPU's features; a kernel receives them as a type parameter and cannot
//! exist without them. Values pass in registers. Memory is only read, and only the rows passed to
//! [`Register::columns`], which are borrowed arrays of four: no address is computed from an index.
#![allow(unsafe_code)]

use core::arch::x86_64::*;

use bytemuck::{Pod, Zeroable};

use crate::register::{Register, by_array};

/// Two lanes: SSE2.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(transparent)]
pub(crate) struct Sse2(__m128d);

/// Four lanes: AVX2 and FMA.
#[cfg(feature = "lanes")]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(transparent)]
pub(crate) struct Avx2(__m256d);

/// Eight lanes: AVX-512 F and DQ.
#[cfg(feature = "lanes")]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(transparent)]
pub(crate) struct Avx512(__m512d);

macro_rules! instructions {
    ($($name:ident($($argument:ident),+) $instruction:expr;)+) => {$(
        #[inline(always)]
        fn $name($(Self($argument): Self),+) -> Self {
            // SAFETY: the CPU has the instruction, see the module documentation.
            Self(unsafe { $instruction })
        }
    )+};
}

impl Register for Sse2 {
    by_array!(2, fused: false);

    instructions! {
        add(a, b) _mm_add_pd(a, b);
        sub(a, b) _mm_sub_pd(a, b);
        mul(a, b) _mm_mul_pd(a, b);
        div(a, b) _mm_div_pd(a, b);
        mul_add(a, b, c) _mm_add_pd(_mm_mul_pd(a, b), c);
        mul_sub(a, b, c) _mm_sub_pd(_mm_mul_pd(a, b), c);
        neg_mul_add(a, b, c) _mm_sub_pd(c, _mm_mul_pd(a, b));
        sqrt(a) _mm_sqrt_pd(a);
        min(a, b) _mm_min_pd(a, b);
        max(a, b) _mm_max_pd(a, b);
        xor(a, b) _mm_xor_pd(a, b);
        and(a, b) _mm_and_pd(a, b);
        or(a, b) _mm_or_pd(a, b);
        and_not(a, b) _mm_andnot_pd(b, a);
        more_than(a, b) _mm_cmpgt_pd(a, b);
        odd(a) _mm_castsi128_pd(_mm_sub_epi64(
            _mm_setzero_si128(),
            _mm_and_si128(_mm_castpd_si128(a), _mm_set1_epi64x(1)),
        ));
    }

    #[inline(always)]
    fn shifted<const PLACES: u32>(Self(a): Self) -> Self {
        // SAFETY: the CPU has the instructions, see the module documentation.
        Self(unsafe {
            _mm_castsi128_pd(_mm_sll_epi64(_mm_castpd_si128(a), _mm_cvtsi32_si128(PLACES as i32)))
        })
    }
}

#[cfg(feature = "lanes")]
impl Register for Avx2 {
    by_array!(4, fused: true);

    instructions! {
        add(a, b) _mm256_add_pd(a, b);
        sub(a, b) _mm256_sub_pd(a, b);
        mul(a, b) _mm256_mul_pd(a, b);
        div(a, b) _mm256_div_pd(a, b);
        mul_add(a, b, c) _mm256_fmadd_pd(a, b, c);
        mul_sub(a, b, c) _mm256_fmsub_pd(a, b, c);
        neg_mul_add(a, b, c) _mm256_fnmadd_pd(a, b, c);
        sqrt(a) _mm256_sqrt_pd(a);
        min(a, b) _mm256_min_pd(a, b);
        max(a, b) _mm256_max_pd(a, b);
        xor(a, b) _mm256_xor_pd(a, b);
        and(a, b) _mm256_and_pd(a, b);
        or(a, b) _mm256_or_pd(a, b);
        and_not(a, b) _mm256_andnot_pd(b, a);
        more_than(a, b) _mm256_cmp_pd::<_CMP_GT_OQ>(a, b);
        odd(a) _mm256_castsi256_pd(_mm256_sub_epi64(
            _mm256_setzero_si256(),
            _mm256_and_si256(_mm256_castpd_si256(a), _mm256_set1_epi64x(1)),
        ));
    }

    #[inline(always)]
    fn shifted<const PLACES: u32>(Self(a): Self) -> Self {
        // SAFETY: the CPU has the instruction, see the module documentation.
        Self(unsafe {
            _mm256_castsi256_pd(_mm256_sll_epi64(_mm256_castpd_si256(a), _mm_cvtsi64_si128(PLACES as i64)))
        })
    }

    #[inline(always)]
    fn columns<'r>(row: impl Fn(usize) -> &'r [f64; 4]) -> [Self; 4] {
        let [a, b, c, d] = rows(row);
        let [even, odd] = [pairs(a, c), pairs(b, d)];
        // SAFETY: the CPU has the instructions, see the module documentation.
        unsafe {
            [
                Self(_mm256_unpacklo_pd(even[0], odd[0])),
                Self(_mm256_unpackhi_pd(even[0], odd[0])),
                Self(_mm256_unpacklo_pd(even[1], odd[1])),
                Self(_mm256_unpackhi_pd(even[1], odd[1])),
            ]
        }
    }
}

#[cfg(feature = "lanes")]
impl Register for Avx512 {
    by_array!(8, fused: true);

    instructions! {
        add(a, b) _mm512_add_pd(a, b);
        sub(a, b) _mm512_sub_pd(a, b);
        mul(a, b) _mm512_mul_pd(a, b);
        div(a, b) _mm512_div_pd(a, b);
        mul_add(a, b, c) _mm512_fmadd_pd(a, b, c);
        mul_sub(a, b, c) _mm512_fmsub_pd(a, b, c);
        neg_mul_add(a, b, c) _mm512_fnmadd_pd(a, b, c);
        sqrt(a) _mm512_sqrt_pd(a);
        min(a, b) _mm512_min_pd(a, b);
        max(a, b) _mm512_max_pd(a, b);
        xor(a, b) _mm512_xor_pd(a, b);
        and(a, b) _mm512_and_pd(a, b);
        or(a, b) _mm512_or_pd(a, b);
        and_not(a, b) _mm512_andnot_pd(b, a);
        more_than(a, b) _mm512_castsi512_pd(_mm512_movm_epi64(_mm512_cmp_pd_mask::<_CMP_GT_OQ>(a, b)));
        odd(a) _mm512_castsi512_pd(_mm512_sub_epi64(
            _mm512_setzero_si512(),
            _mm512_and_si512(_mm512_castpd_si512(a), _mm512_set1_epi64(1)),
        ));
    }

    #[inline(always)]
    fn shifted<const PLACES: u32>(Self(a): Self) -> Self {
        // SAFETY: the CPU has the instruction, see the module documentation.
        Self(unsafe { _mm512_castsi512_pd(_mm512_slli_epi64::<PLACES>(_mm512_castpd_si512(a))) })
    }

    #[inline(always)]
    fn columns<'r>(row: impl Fn(usize) -> &'r [f64; 4]) -> [Self; 4] {
        let [a, b, c, d, e, f, g, h] = rows(row);
        // Two rows of four lanes per register.
        let [first, second] = [[two(a, c), two(b, d)], [two(e, g), two(f, h)]];
        // SAFETY: the CPU has the instructions, see the module documentation.
        unsafe {
            // Columns 0 and 2 interleaved, and columns 1 and 3.
            let even = [_mm512_unpacklo_pd(first[0], first[1]), _mm512_unpacklo_pd(second[0], second[1])];
            let odd = [_mm512_unpackhi_pd(first[0], first[1]), _mm512_unpackhi_pd(second[0], second[1])];
            [
                Self(_mm512_shuffle_f64x2::<0b10_00_10_00>(even[0], even[1])),
                Self(_mm512_shuffle_f64x2::<0b10_00_10_00>(odd[0], odd[1])),
                Self(_mm512_shuffle_f64x2::<0b11_01_11_01>(even[0], even[1])),
                Self(_mm512_shuffle_f64x2::<0b11_01_11_01>(odd[0], odd[1])),
            ]
        }
    }
}

/// Returns the row of each lane. Uses functions and a loop instead of closures, which could be
/// compiled without the instruction set.
#[cfg(feature = "lanes")]
#[inline(always)]
fn rows<'r, const LANES: usize>(row: impl Fn(usize) -> &'r [f64; 4]) -> [&'r [f64; 4]; LANES] {
    let mut rows = [&[0.0; 4]; LANES];
    for (lane, place) in rows.iter_mut().enumerate() {
        *place = row(lane);
    }
    rows
}

/// Returns the first halves of two rows in one register, and the second halves in another.
#[cfg(feature = "lanes")]
#[inline(always)]
fn pairs(low: &[f64; 4], high: &[f64; 4]) -> [__m256d; 2] {
    // SAFETY: the CPU has the instructions, see the module documentation; the loads read numbers 0
    // and 1, then 2 and 3, of a row of four.
    unsafe {
        let [a, b] = [_mm_loadu_pd(low.as_ptr()), _mm_loadu_pd(high.as_ptr())];
        let [c, d] = [_mm_loadu_pd(low.as_ptr().add(2)), _mm_loadu_pd(high.as_ptr().add(2))];
        [
            _mm256_insertf128_pd::<1>(_mm256_castpd128_pd256(a), b),
            _mm256_insertf128_pd::<1>(_mm256_castpd128_pd256(c), d),
        ]
    }
}

/// Returns two rows in one register.
#[cfg(feature = "lanes")]
#[inline(always)]
fn two(low: &[f64; 4], high: &[f64; 4]) -> __m512d {
    // SAFETY: the CPU has the instructions, see the module documentation; the loads read the four
    // numbers of each row.
    unsafe {
        let [low, high] = [_mm256_loadu_pd(low.as_ptr()), _mm256_loadu_pd(high.as_ptr())];
        _mm512_insertf64x4::<1>(_mm512_castpd256_pd512(low), high)
    }
}
