//! The library as its users call it.

mod any_input;
mod graph_laws;
