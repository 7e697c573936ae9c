//! Converts the specs to one table each, generates the peers' code from these tables, and compiles
//! all of it.

mod bindings;
mod ours;
mod sizes;
mod table;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use abbe_spec::Spec;
use ours::Rounding;
use serde_json::json;

/// Robots that are compared, in the order of the report.
const SPECS: [&str; 4] = [
    "../../manipulators/specs/puma560.toml",
    "specs/puma560_flange.toml",
    "specs/ppprrr.toml",
    "../../manipulators/specs/iiwa.toml",
];

fn main() {
    for path in ["build", "cpp", "generate", "requirements.txt"].into_iter().chain(SPECS) {
        println!("cargo:rerun-if-changed={path}");
    }
    println!("cargo:rerun-if-env-changed=PEERS_PYTHON");
    println!("cargo:rerun-if-env-changed=PEERS_OPTIMIZATION");
    abbe_codegen::compile("specs");

    let root = PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    let (out, tables, own) = (root.join("peers"), root.join("tables"), root.join("ours"));
    for folder in [&out, &tables, &own] {
        let _ = fs::remove_dir_all(folder);
        fs::create_dir_all(folder).expect("a folder for generated code");
    }
    let python = std::env::var("PEERS_PYTHON").expect("PEERS_PYTHON is not set: use benches/peers/run");
    let mut generate = Command::new(&python);
    generate.arg("-B").arg("generate/main.py").arg(&out).arg("1");
    let specs = SPECS.map(|path| Spec::read(Path::new(path)).unwrap_or_else(|mistakes| panic!("{mistakes}")));
    for spec in &specs {
        let table = tables.join(format!("{}.json", spec.name));
        fs::write(&table, table::table(spec).to_string()).expect("a table");
        generate.arg(table);
    }
    said(&mut generate);

    let sources = |ending: &str| -> Vec<PathBuf> {
        let files = fs::read_dir(&out).expect("generated code").map(|entry| entry.expect("a file").path());
        let mut files: Vec<_> = files.filter(|path| path.extension().is_some_and(|e| e == ending)).collect();
        files.sort();
        files
    };
    let written = |rounding| specs.each_ref().map(|spec| ours::write(spec, rounding, &own));
    let (as_written, contracted) = (written(Rounding::AsWritten), written(Rounding::Contracted));
    bindings::write(
        &out,
        &sources("c"),
        &sources("cpp"),
        &sources("rs"),
        [&as_written[..], &contracted].concat().as_slice(),
    );

    let include = include_folder(&python);
    let mut c = cc::Build::new();
    options(&mut c).files(sources("c")).compile("peers_c");
    // Flags from our documentation: the same bits as the Rust code.
    options(&mut cc::Build::new()).flag("-ffp-contract=off").files(as_written).compile("ours_c");
    options(&mut cc::Build::new()).files(contracted).compile("ours_c_contracted");
    let mut cpp = cc::Build::new();
    options(&mut cpp)
        .cpp(true)
        .std("c++17")
        .include(include.join("eigen3"))
        .files(sources("cpp"))
        .compile("peers_cpp");
    let mut pinocchio = cc::Build::new();
    options(&mut pinocchio).cpp(true).std("c++17").include(&include).include(include.join("eigen3"));
    // Definitions from Pinocchio's CMake files.
    pinocchio.define("BOOST_MPL_CFG_NO_PREPROCESSED_HEADERS", None).define("BOOST_MPL_LIMIT_LIST_SIZE", "30");
    pinocchio.define("BOOST_MPL_LIMIT_VECTOR_SIZE", "30").define("BOOST_FUSION_INVOKE_MAX_ARITY", "12");
    pinocchio.file("cpp/pinocchio.cpp").compile("peers_pinocchio");

    let bytes = specs.iter().flat_map(|spec| {
        let name = &spec.name;
        let dense = |library: &str, ending| {
            (
                library.to_owned(),
                out.join(format!("{library}_{name}_dense.{ending}")),
                format!("{library}_{name}_dense"),
            )
        };
        let ours = |ending: &str| {
            (
                format!("abbe{ending}"),
                own.join(format!("{name}{ending}.c")),
                format!("{name}{ending}_error_jacobian"),
            )
        };
        let all = [
            ours(""),
            ours(ours::CONTRACTED),
            dense("casadi", "c"),
            dense("symforce", "cpp"),
            dense("sympy", "c"),
        ];
        all.map(|(library, source, function)| {
            let [fast, small] = ["-O3", "-Os"].map(|level| {
                let mut build = cc::Build::new();
                options(&mut build).opt_level_str(&level[2..]);
                if library == "abbe" {
                    build.flag("-ffp-contract=off");
                }
                if source.extension().is_some_and(|ending| ending == "cpp") {
                    build.cpp(true).std("c++17").include(include.join("eigen3"));
                }
                sizes::bytes(build.get_compiler().to_command(), &source, &function, &root)
            });
            json!({ "robot": name, "library": library, "fast": fast, "small": small })
        })
    });
    let bytes = serde_json::Value::Array(bytes.collect()).to_string();
    fs::write(root.join("sizes.json"), bytes).expect("the sizes");

    let gcc = said(c.get_compiler().to_command().arg("-dumpfullversion"));
    let flags = std::env::var("CARGO_ENCODED_RUSTFLAGS").unwrap_or_default().replace('\u{1f}', " ");
    println!("cargo:rustc-env=PEERS_FLAGS={}", if flags.is_empty() { "no flags" } else { &flags });
    println!("cargo:rustc-env=PEERS_PYTHON={python}");
    println!("cargo:rustc-env=PEERS_GCC=gcc {gcc} {}", optimization());
    println!(
        "cargo:rustc-env=PEERS_RUSTC={}",
        said(Command::new(std::env::var("RUSTC").expect("rustc")).arg("-V"))
    );
}

/// Returns the optimization of C and C++: all for this machine, or as `PEERS_OPTIMIZATION` says.
fn optimization() -> String {
    std::env::var("PEERS_OPTIMIZATION").unwrap_or_else(|_| "-O3 -march=native".to_owned())
}

/// Sets the options of the peers.
fn options(build: &mut cc::Build) -> &mut cc::Build {
    let flags = optimization();
    let (level, others) = flags.split_once(' ').unwrap_or((&flags, ""));
    build.opt_level_str(level.trim_start_matches("-O"));
    others.split_whitespace().for_each(|flag| {
        build.flag(flag);
    });
    build.define("NDEBUG", None).warnings(false).force_frame_pointer(false)
}

/// Returns the folder of the wheels' headers.
fn include_folder(python: &str) -> PathBuf {
    let script = "import sysconfig; print(sysconfig.get_path('purelib'))";
    Path::new(&said(Command::new(python).args(["-c", script]))).join("cmeel.prefix/include")
}

/// Returns the output of a program. Panics if it fails.
fn said(command: &mut Command) -> String {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?} failed:\n{errors}");
    String::from_utf8_lossy(&output.stdout).trim().to_owned()
}
