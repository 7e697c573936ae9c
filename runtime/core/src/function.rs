//! The functions of a manipulator, with arguments and results as their [`Signature`] says.
//!
//! `table` has one entry per function, from which everything else is derived.

mod signature;
mod table;

pub use signature::{Array, Count, Signature};
pub use table::COMPENSATED;

macro_rules! functions {
    (: $($function:ident = $name:ident($($argument:ident),+) -> ($($result:ident),+) $($oriented:ident)?:
        $documentation:literal $(, $note:literal)?;)+) => {
        /// Function of a manipulator: generated, interpreted, and evaluated in batches.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        pub enum Function {
            $(#[doc = $documentation] $function,)+
        }

        impl Function {
            /// Number of functions, those of loops included.
            pub const COUNT: usize = [$(Self::$function),+].len();

            /// Returns the signature.
            pub const fn signature(self) -> &'static Signature {
                match self {
                    $(Self::$function => &table::signature!(
                        $name($($argument),+) -> ($($result),+) $($oriented)?: $documentation
                    ),)+
                }
            }
        }
    };
}

crate::for_all_functions!(functions);

macro_rules! list {
    ($list:ident, $documentation:literal: $($function:ident = $name:ident $arguments:tt -> $results:tt
        $($oriented:ident)?: $text:literal $(, $note:literal)?;)+) => {
        impl Function {
            #[doc = $documentation]
            pub const $list: [Self; [$(Self::$function),+].len()] = [$(Self::$function),+];
        }
    };
}

macro_rules! all {
    (: $($entries:tt)+) => {
        list!(ALL, "Functions of every manipulator, in the order of generated code.": $($entries)+);
    };
}

macro_rules! of_inverse {
    (: $($entries:tt)+) => {
        list!(OF_INVERSE, "Functions that only manipulators have whose inverse kinematics has a closed form.": $($entries)+);
    };
}

macro_rules! of_loops {
    (: $($entries:tt)+) => {
        list!(OF_LOOPS, "Functions that only manipulators with loops have.": $($entries)+);
    };
}

crate::for_each_function!(all);
crate::for_each_function_of_loops!(of_loops);
crate::for_each_function_of_inverse!(of_inverse);

impl Function {
    /// Iterates over the functions of a manipulator, in the order of generated code: those that
    /// others call come first.
    pub fn all(description: &crate::Description) -> impl Iterator<Item = Self> + use<> {
        let (has_loops, has_inverse) = (description.has_loops(), description.solutions > 0);
        let of_loops = Self::OF_LOOPS.into_iter().filter(move |_| has_loops);
        let of_inverse = Self::OF_INVERSE.into_iter().filter(move |_| has_inverse);
        of_loops.chain(Self::ALL).chain(of_inverse)
    }

    /// Returns the name in generated code.
    pub const fn name(self) -> &'static str {
        self.signature().name
    }
}
