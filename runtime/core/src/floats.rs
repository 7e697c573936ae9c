//! [`Scalar`] for `f64` and `f32`.

use crate::{LookupTable, Scalar, sin_cos};

/// Register with two lanes that every machine of this architecture has.
#[cfg(target_arch = "x86_64")]
pub(crate) type Two = crate::x86::Sse2;
#[cfg(not(target_arch = "x86_64"))]
pub(crate) type Two = [f64; 2];

macro_rules! scalar {
    ($float:ident, $sin_cos:expr $(, $each:ident)?; $($function:ident: $libm:ident),+;
        $($of_two:ident: $libm_of_two:ident),+) => {
        impl Scalar for $float {
            #[inline]
            fn constant(value: f64) -> Self {
                value as $float
            }
            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                $sin_cos(self)
            }
            $(
                #[inline(always)]
                fn sin_cos_each<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
                    sin_cos::$each::<Two, N>(angles)
                }
            )?
            $(
                #[inline]
                fn $function(self) -> Self {
                    #[cfg(feature = "std")]
                    { $float::$function(self) }
                    #[cfg(not(feature = "std"))]
                    { libm::$libm(self) }
                }
            )+
            $(
                #[inline]
                fn $of_two(self, other: Self) -> Self {
                    #[cfg(feature = "std")]
                    { $float::$of_two(self, other) }
                    #[cfg(not(feature = "std"))]
                    { libm::$libm_of_two(self, other) }
                }
            )+
            #[inline]
            fn sign(self) -> Self {
                if self > 0.0 { 1.0 } else if self < 0.0 { -1.0 } else { self * 0.0 }
            }
            #[inline]
            fn side(self) -> Self {
                if self >= 0.0 { 1.0 } else if self < 0.0 { -1.0 } else { self }
            }
            #[inline]
            fn is_positive(self) -> bool {
                self > 0.0
            }
            #[inline]
            fn min(self, other: Self) -> Self {
                if self < other || self.is_nan() { self } else { other }
            }
            #[inline]
            fn max(self, other: Self) -> Self {
                if self > other || self.is_nan() { self } else { other }
            }
            #[inline]
            fn piece(self, table: &LookupTable<'_>) -> (Self, [Self; 4]) {
                let (t, coefficients) = table.find(f64::from(self));
                (t as $float, coefficients.map(|coefficient| coefficient as $float))
            }
        }
    };
}

scalar!(f64, sin_cos::scalar, each; tan: tan, asin: asin, acos: acos, atan: atan, sqrt: sqrt, abs: fabs, exp: exp, ln: log;
    atan2: atan2, powf: pow);
#[cfg(feature = "std")]
scalar!(f32, f32::sin_cos; tan: tanf, asin: asinf, acos: acosf, atan: atanf, sqrt: sqrtf, abs: fabsf, exp: expf, ln: logf;
    atan2: atan2f, powf: powf);
#[cfg(not(feature = "std"))]
scalar!(f32, libm::sincosf; tan: tanf, asin: asinf, acos: acosf, atan: atanf, sqrt: sqrtf, abs: fabsf, exp: expf, ln: logf;
    atan2: atan2f, powf: powf);
