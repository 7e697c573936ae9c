//! The functions of a manipulator, with arguments and results as their [`Signature`] says.
//!
//! `table` has one entry per function, from which everything else is derived.

mod signature;
mod table;

pub use signature::{Array, Count, Signature};
pub use table::{BEGIN, COMPENSATED};

/// Signatures of the functions that are no functions of nodes, but iterations with others.
pub const COMMANDS: [&Signature; 2] = [&COMPENSATED, &BEGIN];

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

crate::for_functions!(loops inverse every: functions);

macro_rules! list {
    ($list:ident: $($function:ident = $name:ident $arguments:tt -> $results:tt
        $($oriented:ident)?: $text:literal $(, $note:literal)?;)+) => {
        const $list: [Function; [$(Function::$function),+].len()] = [$(Function::$function),+];
    };
}

crate::for_functions!(every: list, ALL);
crate::for_functions!(loops: list, OF_LOOPS);
crate::for_functions!(inverse: list, OF_INVERSE);

impl Function {
    /// Functions of every manipulator, in the order of generated code.
    pub const ALL: [Self; ALL.len()] = ALL;

    /// Functions that only manipulators have whose inverse kinematics has a closed form.
    pub const OF_INVERSE: [Self; OF_INVERSE.len()] = OF_INVERSE;

    /// Functions that only manipulators with loops have.
    pub const OF_LOOPS: [Self; OF_LOOPS.len()] = OF_LOOPS;

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
