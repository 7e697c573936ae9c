//! The specs as one table each, the peers' code from these tables, and all of it compiled.

mod bindings;
mod table;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use abbe_codegen::spec::Spec;

/// The robots that are compared, in the order in which they are shown.
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
    abbe_codegen::compile("specs");

    let root = PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    let (out, tables) = (root.join("peers"), root.join("tables"));
    for folder in [&out, &tables] {
        let _ = fs::remove_dir_all(folder);
        fs::create_dir_all(folder).expect("a folder for generated code");
    }
    let python = std::env::var("PEERS_PYTHON").expect("PEERS_PYTHON is not set: use benches/peers/run");
    let mut generate = Command::new(&python);
    generate.arg("-B").arg("generate/main.py").arg(&out).arg("1");
    for path in SPECS {
        let spec = Spec::read(Path::new(path)).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let table = tables.join(format!("{}.json", spec.name));
        fs::write(&table, table::table(&spec).to_string()).expect("a table");
        generate.arg(table);
    }
    said(&mut generate);

    let sources = |ending: &str| -> Vec<PathBuf> {
        let files = fs::read_dir(&out).expect("generated code").map(|entry| entry.expect("a file").path());
        let mut files: Vec<_> = files.filter(|path| path.extension().is_some_and(|e| e == ending)).collect();
        files.sort();
        files
    };
    bindings::write(&out, &sources("c"), &sources("cpp"), &sources("rs"));

    let include = include_folder(&python);
    let mut c = cc::Build::new();
    options(&mut c).files(sources("c")).compile("peers_c");
    let mut cpp = cc::Build::new();
    options(&mut cpp)
        .cpp(true)
        .std("c++17")
        .include(include.join("eigen3"))
        .files(sources("cpp"))
        .compile("peers_cpp");
    let mut pinocchio = cc::Build::new();
    options(&mut pinocchio).cpp(true).std("c++17").include(&include).include(include.join("eigen3"));
    // As Pinocchio's CMake files ask for.
    pinocchio.define("BOOST_MPL_CFG_NO_PREPROCESSED_HEADERS", None).define("BOOST_MPL_LIMIT_LIST_SIZE", "30");
    pinocchio.define("BOOST_MPL_LIMIT_VECTOR_SIZE", "30").define("BOOST_FUSION_INVOKE_MAX_ARITY", "12");
    pinocchio.file("cpp/pinocchio.cpp").compile("peers_pinocchio");

    let gcc = said(c.get_compiler().to_command().arg("-dumpfullversion"));
    let flags = std::env::var("CARGO_ENCODED_RUSTFLAGS").unwrap_or_default().replace('\u{1f}', " ");
    println!("cargo:rustc-env=PEERS_FLAGS={}", if flags.is_empty() { "no flags" } else { &flags });
    println!("cargo:rustc-env=PEERS_PYTHON={python}");
    println!("cargo:rustc-env=PEERS_GCC=gcc {gcc}");
    println!(
        "cargo:rustc-env=PEERS_RUSTC={}",
        said(Command::new(std::env::var("RUSTC").expect("rustc")).arg("-V"))
    );
}

/// The peers get everything that the compiler has for this machine.
fn options(build: &mut cc::Build) -> &mut cc::Build {
    build.opt_level(3).flag("-march=native").define("NDEBUG", None).warnings(false).force_frame_pointer(false)
}

/// Where the wheels put their headers.
fn include_folder(python: &str) -> PathBuf {
    let script = "import sysconfig; print(sysconfig.get_path('purelib'))";
    Path::new(&said(Command::new(python).args(["-c", script]))).join("cmeel.prefix/include")
}

/// What a program prints; if it fails, so does the build.
fn said(command: &mut Command) -> String {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?} failed:\n{errors}");
    String::from_utf8_lossy(&output.stdout).trim().to_owned()
}
