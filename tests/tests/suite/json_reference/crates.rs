//! Crates whose types are in reports.

/// Folder of each crate, and the name of its modules here.
pub(super) const FOLDERS: [(&str, &str); 10] = [
    ("runtime/core", "core"),
    ("kinematics", "kinematics"),
    ("analysis", "analysis"),
    ("bound", "bound"),
    ("calibration", "calibration"),
    ("spec", "spec"),
    ("codegen", "codegen"),
    ("exchange", "exchange"),
    ("study", "study"),
    ("metrology", "metrology"),
];

/// Returns the crates whose types a path can name that begins with this crate.
pub(super) fn declare(first: &str) -> &'static [&'static str] {
    match first {
        "abbe" => &["core", "kinematics", "analysis", "calibration"],
        "abbe_core" => &["core"],
        "abbe_kinematics" => &["kinematics"],
        "abbe_analysis" => &["analysis"],
        "abbe_bound" => &["bound"],
        "abbe_calibration" => &["calibration"],
        "abbe_spec" => &["spec"],
        "abbe_codegen" => &["codegen"],
        "abbe_exchange" => &["exchange"],
        "abbe_study" => &["study"],
        "abbe_metrology" => &["metrology"],
        _ => &[],
    }
}
