//! Integration tests of the reader of specs.

mod bounds;
