//! The generated functions of CasADi, SymForce, SymPy and wrenfold, and our own in C.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::row::{Kind, Row, Side};

/// Function `(q, pose, result)`, or `(q, ε, ΔX)` and `(q, σ², covariance)`, which do not write to
/// the second argument.
pub type Function = unsafe extern "C" fn(q: *const f64, second: *mut f64, result: *mut f64);

/// Function of our C code: takes parameters, of which there are none here, and returns 0 if all
/// results are finite.
pub type Ours = unsafe extern "C" fn(q: *const f64, second: *mut f64, result: *mut f64) -> i32;

include!(concat!(env!("OUT_DIR"), "/peers/bindings.rs"));

/// Prefix of each library's functions, and its title.
const LIBRARIES: [(&str, &str); 4] = [
    ("casadi", "CasADi + cse, C"),
    ("symforce", "SymForce, C++"),
    ("sympy", "SymPy cse, C"),
    ("wrenfold", "wrenfold, Rust"),
];

/// Returns the peers' rows for a robot.
pub fn rows(robot: &str) -> Vec<Row> {
    let mut rows = Vec::new();
    for (library, shown) in LIBRARIES {
        for kind in Kind::ALL {
            let name = format!("{library}_{robot}_{}", kind.name());
            let listed = FUNCTIONS.iter().find(|(listed, _)| **listed == name);
            let function = listed.unwrap_or_else(|| panic!("{name} was not generated")).1;
            // Safety: generated for this robot; a row has room for all that it reads and writes.
            rows.push(match kind {
                Kind::Dense | Kind::Distinct => {
                    Row::jacobian(shown, Side::Generator, kind, move |q, pose, result| unsafe {
                        function(q.as_ptr(), pose.as_mut_ptr(), result.as_mut_ptr());
                    })
                }
                Kind::Displacement | Kind::Covariance => {
                    Row::given(shown, Side::Generator, kind, move |q, given, result| unsafe {
                        function(q.as_ptr(), given.as_ptr().cast_mut(), result.as_mut_ptr());
                    })
                }
            });
        }
    }
    rows
}

/// Returns our rows in C for a robot: with the documented flags, which give the bits of the Rust
/// code, and contracted.
pub fn ours(robot: &str) -> Vec<Row> {
    let mut rows = Vec::new();
    for (ending, shown) in [("", "abbe, C"), ("_contracted", "abbe, C, contracted")] {
        for kind in Kind::ALL {
            let name = format!("{robot}{ending}_{}", kind.name());
            let function = OURS.iter().find(|(listed, _)| **listed == name).expect("it was generated").1;
            // Safety: generated for this robot, which has no parameters; a row has room for all
            // that it reads and writes.
            rows.push(match kind {
                Kind::Dense | Kind::Distinct => {
                    Row::jacobian(shown, Side::OurC, kind, move |q, pose, result| unsafe {
                        assert_eq!(function(q.as_ptr(), pose.as_mut_ptr(), result.as_mut_ptr()), 0);
                    })
                }
                Kind::Displacement | Kind::Covariance => {
                    Row::given(shown, Side::OurC, kind, move |q, given, result| unsafe {
                        assert_eq!(function(q.as_ptr(), given.as_ptr().cast_mut(), result.as_mut_ptr()), 0);
                    })
                }
            });
        }
    }
    rows
}

/// Returns the title of a library.
pub fn shown(library: &str) -> &str {
    match LIBRARIES.iter().find(|(name, _)| *name == library) {
        Some((_, shown)) => shown,
        None if library == "abbe" => "abbe, C",
        None => "abbe, C, contracted",
    }
}

/// Returns the sizes in bytes of the dense `J_e` of every library and robot.
pub fn sizes() -> Vec<serde_json::Value> {
    serde_json::from_str(include_str!(concat!(env!("OUT_DIR"), "/sizes.json"))).expect("the build script's")
}

/// Returns operation counts and seconds of every library and robot. Runs the generators again,
/// without other load.
pub fn generated() -> Vec<serde_json::Value> {
    let out = Path::new(concat!(env!("OUT_DIR"), "/timed"));
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("generate/main.py");
    let _ = fs::create_dir(out);
    let tables = fs::read_dir(concat!(env!("OUT_DIR"), "/tables")).expect("the build script's tables");
    let mut run = Command::new(env!("PEERS_PYTHON"));
    run.arg("-B").arg(script).arg(out).arg("5").args(tables.map(|entry| entry.expect("a table").path()));
    assert!(run.status().is_ok_and(|status| status.success()), "{run:?} failed");
    let text = fs::read_to_string(out.join("generated.json")).expect("what the script wrote");
    serde_json::from_str(&text).expect("JSON")
}
