//! The reader of specs as its users call it.

mod bounds;
