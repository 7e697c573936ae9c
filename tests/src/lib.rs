//! What crosses crates is tested in `tests/`; there is nothing here.
