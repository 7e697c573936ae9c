//! Integration tests of the public interface.

mod any_input;
mod graph_laws;
mod readable_rust;
