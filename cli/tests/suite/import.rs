//! `abbe import`: its printed output.

use tempfile::tempdir;

use crate::running::{prints, write};

/// Returns the URDF of a robot with one joint, with or without a mass.
fn robot(name: &str, mass: bool) -> String {
    let inertial = if mass { "<inertial><mass value=\"2\"/></inertial>" } else { "" };
    format!(
        "<robot{name}>\n<link name=\"base\"/>\n<link name=\"hand\">{inertial}</link>\n\
         <joint name=\"q\" type=\"revolute\"><parent link=\"base\"/><child link=\"hand\"/><axis xyz=\"0 0 1\"/>\
         <limit lower=\"-1\" upper=\"1\"/></joint>\n</robot>\n"
    )
}

#[test]
fn one_is_not_many() {
    let folder = tempdir().unwrap();
    let imported = |mass: bool| {
        let file = write(folder.path(), "robot.urdf", &robot(" name=\"Arm\"", mass));
        let spec = folder.path().join("robot.toml");
        prints(&["import", file.to_str().unwrap(), "-o", spec.to_str().unwrap()])
    };
    assert!(
        imported(true).starts_with("arm: from base to hand, 1 frame, 1 of them moved, 1 mass as loads\n")
    );
    assert!(
        imported(false).starts_with("arm: from base to hand, 1 frame, 1 of them moved, 0 masses as loads\n")
    );
}

/// An empty name in the URDF gives neither an empty title nor an empty name.
#[test]
fn a_robot_without_a_name_is_a_robot() {
    let folder = tempdir().unwrap();
    for name in ["", " name=\"\"", " name=\"  \""] {
        let file = write(folder.path(), "robot.urdf", &robot(name, false));
        let spec = prints(&["import", file.to_str().unwrap()]);
        assert!(spec.contains("name = \"robot\"\ntitle = \"robot\"\n"), "{name}\n{spec}");
    }
}
