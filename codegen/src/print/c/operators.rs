//! Operators and numbers of C99.

use std::borrow::Cow;

use abbe_core::Function;
use abbe_spec::{Function as Operator, Lookup, Spec};

use super::Real;
use crate::print::expression::Called;
use crate::print::{Binding, Expression, Syntax, arithmetic, function_of};
use crate::program::Action;

/// The syntax of C for a spec, whose names and tables occur in the file.
pub(super) struct C<'s> {
    pub(super) spec: &'s Spec,
    pub(super) real: Real,
}

const WORDS: &str = "HUGE_VAL HUGE_VALF INFINITY NAN NULL _Bool _Complex _Imaginary abs acos acosf acosh alignas alignof and and_eq angles are_below asin \
         asinf asinh asm atan atan2 atan2f atanf atanh auto bitand bitor bool break case catch cbrt ceil char class compl concept const \
         const_cast constexpr continue copysign cos cosf cosh cosine decltype default delete do double dynamic_cast else enum \
         erf erfc exp exp2 expf explicit export expm1 extern fabs fabsf false fdim float floor fma fmax fmin fmod for friend frexp \
         goto greatest hypot i if ilogb inline inputs_are_in_range int is_within isfinite isinf isnan j j0 j1 jn k ldexp least lgamma llrint \
         llround log log10 log1p log2 logb logf long lrint lround margin modf mutable namespace nan nearbyint new \
         nextafter nexttoward noexcept not not_eq nullptr operator or or_eq pow powf private protected public real register \
         reinterpret_cast remainder remquo requires restrict return rint round scalbln scalbn short side sign signbit sine sines cosine cosines \
         signed sin sin_cos sin_cos_2 sin_cos_4 sinf sinh sizeof sqrt sqrtf static static_assert static_cast status struct switch tan tanf tanh template \
         tgamma this thread_local throw true trunc try typedef typeid typename union unsigned using virtual void \
         volatile wchar_t while xor xor_eq y0 y1 yn";

/// Headers of the language, which would include a file of the same name instead of their own.
pub(super) const HEADERS: &str = "assert complex ctype errno fenv float inttypes iso646 limits locale math setjmp signal stdalign stdarg \
     stdatomic stdbool stddef stdint stdio stdlib stdnoreturn string tgmath threads time uchar wchar wctype";

impl Syntax for C<'_> {
    /// Keywords of C and C++, names of `math.h`, and the functions, values and status codes of the
    /// file.
    fn reserved(&self) -> Cow<'static, str> {
        let (name, upper) = (&self.spec.name, self.spec.name.to_ascii_uppercase());
        let own = Function::ALL.map(|function| format!(" {name}_{}", function.name())).concat();
        let values = ["limits", "home", "parameters", "inputs", "ranges"]
            .map(|what| format!(" {name}_{what}"))
            .concat();
        let codes = ["OK", "NOT_FINITE", "NOT_CLOSED", "SINGULAR", "OUT_OF_RANGE"]
            .map(|code| format!(" {upper}_{code}"))
            .concat();
        Cow::Owned([WORDS, &own, &values, &codes].concat())
    }

    fn number(&self, value: f64) -> Expression {
        Expression::number(self.real.number(value), value)
    }

    fn action(&self, action: Action, operands: &[Expression]) -> Expression {
        let own = |name: &str| Expression::call(name, operands);
        let call = |name: &str| own(&self.real.function(name));
        arithmetic(action, operands).unwrap_or_else(|called| match called {
            Called::Power => call("pow"),
            Called::Atan2 => call("atan2"),
            Called::Least => own("least"),
            Called::Greatest => own("greatest"),
            Called::Function(Operator::Abs) => call("fabs"),
            Called::Function(Operator::Sin) => own("sine"),
            Called::Function(Operator::Cos) => own("cosine"),
            Called::Function(function @ (Operator::Sign | Operator::Side)) => own(function.name()),
            Called::Function(function) => call(function.name()),
            Called::Lookup(Lookup { table, order }) => {
                let name = function_of(&self.spec.tables[usize::from(table)].constant_name());
                Expression::new(format!("{name}({order}, {})", operands[0].text), Binding::Atom)
            }
        })
    }
}
