//! Generated code has `rustfmt`'s default format, so that it is stable when checked in.

use std::process::Command;

use abbe_codegen::print;
use abbe_manipulators::{MECHANISMS, SHIPPED};
use abbe_spec::Spec;
use abbe_tests::chains::{coupled_joints, long_chain};
use abbe_tests::needs::{Missing, Tests, tool};

pub(crate) const TESTS: Tests = &[("rustfmt_changes_nothing", rustfmt_changes_nothing)];

/// Checks freshly generated shipped manipulators, long chains and coupled joints, and checked-in
/// goldens of hostile names and the smallest spec.
fn rustfmt_changes_nothing() -> Result<(), Missing> {
    tool("rustfmt", "")?;
    // A folder elsewhere: the folder of the goldens sets another width.
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = folder.path().join(format!("{name}.rs"));
        std::fs::write(&path, text).unwrap();
        path
    };
    let (long, coupled) = (long_chain(), coupled_joints());
    let specs = SHIPPED.iter().map(|shipped| (shipped.name, shipped.spec));
    let generated = specs
        .chain(MECHANISMS.iter().copied())
        .chain([("long", &*long), ("coupled", coupled)])
        .map(|(name, text)| write(name, &print::rust(&Spec::parse(name, text).unwrap())));
    let checked_in = [
        ("measured", include_str!("../../golden/measured.rs")),
        ("self_", include_str!("../../golden/self_.rs")),
        ("slide", include_str!("../../golden/slide.rs")),
    ];
    let checked_in = checked_in.map(|(name, text)| write(name, text));
    let arguments = ["--check", "--edition", "2024"];
    let output = Command::new("rustfmt").args(arguments).args(generated.chain(checked_in)).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
    Ok(())
}
