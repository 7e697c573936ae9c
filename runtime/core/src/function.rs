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
        pub enum Function {
            $(#[doc = $documentation] $function,)+
        }

        impl Function {
            /// The functions, in the order of generated code.
            pub const ALL: [Self; [$(Self::$function),+].len()] = [$(Self::$function),+];

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

crate::for_each_function!(functions);

impl Function {
    /// Returns the name in generated code.
    pub const fn name(self) -> &'static str {
        self.signature().name
    }
}
