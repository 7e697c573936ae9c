//! Functions that an expression may call.

use abbe_core::Scalar;

/// A function of one argument; `atan2`, `min` and `max` are operators of two.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Function {
    /// Sine.
    Sin,
    /// Cosine.
    Cos,
    /// Tangent.
    Tan,
    /// Inverse sine.
    Asin,
    /// Inverse cosine.
    Acos,
    /// Inverse tangent.
    Atan,
    /// Square root.
    Sqrt,
    /// Absolute value.
    Abs,
    /// Exponential function.
    Exp,
    /// Natural logarithm.
    Log,
    /// Sign: −1, 0 or 1.
    Sign,
    /// −1 for negative numbers, else 1: the derivative of the absolute value. Not available in spec
    /// files.
    Side,
}

/// Names of the functions in a spec, including those of several arguments.
pub const FUNCTION_NAMES: [&str; 14] =
    ["sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sqrt", "abs", "min", "max", "sign", "exp", "log"];

impl Function {
    /// Returns the function with this name in a spec file.
    pub fn named(name: &str) -> Option<Self> {
        use Function::{Abs, Acos, Asin, Atan, Cos, Exp, Log, Sign, Sin, Sqrt, Tan};
        let all = [Sin, Cos, Tan, Asin, Acos, Atan, Sqrt, Abs, Exp, Log, Sign];
        all.into_iter().find(|function| function.name() == name)
    }

    /// Returns the name in spec files.
    pub fn name(self) -> &'static str {
        const NAMES: [&str; 12] =
            ["sin", "cos", "tan", "asin", "acos", "atan", "sqrt", "abs", "exp", "log", "sign", "side"];
        NAMES[self as usize]
    }

    /// Returns the value of the function.
    pub fn evaluate(self, x: f64) -> f64 {
        match self {
            Self::Sin => x.sin(),
            Self::Cos => x.cos(),
            Self::Tan => x.tan(),
            Self::Asin => x.asin(),
            Self::Acos => x.acos(),
            Self::Atan => x.atan(),
            Self::Sqrt => x.sqrt(),
            Self::Abs => x.abs(),
            Self::Exp => x.exp(),
            Self::Log => x.ln(),
            Self::Sign => x.sign(),
            Self::Side => x.side(),
        }
    }
}
