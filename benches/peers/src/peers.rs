//! The generated functions of CasADi, SymForce, SymPy and wrenfold.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::row::{Kind, Row, Side};

/// `(q, pose, result)`; or `(q, ε, ΔX)` and `(q, σ², covariance)`, where the second is not written to.
pub type Function = unsafe extern "C" fn(q: *const f64, second: *mut f64, result: *mut f64);

include!(concat!(env!("OUT_DIR"), "/peers/bindings.rs"));

/// Every library by the name of its functions and as it is shown.
const LIBRARIES: [(&str, &str); 4] = [
    ("casadi", "CasADi + cse, C"),
    ("symforce", "SymForce, C++"),
    ("sympy", "SymPy cse, C"),
    ("wrenfold", "wrenfold, Rust"),
];

/// The peers' rows for a robot.
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

/// Operation counts and seconds of every library and robot: the generators run once more, now that nothing else does.
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
