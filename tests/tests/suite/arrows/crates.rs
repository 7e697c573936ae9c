//! The crates of the workspace, their allowed dependencies, and the remaining cycles between files.

/// Folder of each crate, its package, and its allowed dependencies, which all precede it.
pub(crate) const CRATES: &[(&str, &str, &[&str])] = &[
    ("runtime/core", "abbe-core", &[]),
    ("spec", "abbe-spec", &["abbe-core"]),
    ("codegen", "abbe-codegen", &["abbe-core", "abbe-spec"]),
    ("codegen/macro", "abbe-macro", &["abbe-codegen", "abbe-spec"]),
    ("kinematics", "abbe-kinematics", &["abbe-core"]),
    ("analysis", "abbe-analysis", &["abbe-core", "abbe-kinematics"]),
    ("bound", "abbe-bound", &["abbe-codegen", "abbe-core", "abbe-spec"]),
    ("calibration", "abbe-calibration", &["abbe-analysis", "abbe-core"]),
    ("runtime", "abbe", &["abbe-analysis", "abbe-calibration", "abbe-core"]),
    ("interpreter", "abbe-interpreter", &["abbe", "abbe-codegen", "abbe-spec"]),
    ("manipulators", "abbe-manipulators", &["abbe", "abbe-codegen"]),
    ("exchange", "abbe-exchange", &["abbe", "abbe-codegen", "abbe-interpreter", "abbe-spec"]),
    (
        "study",
        "abbe-study",
        &[
            "abbe",
            "abbe-bound",
            "abbe-codegen",
            "abbe-exchange",
            "abbe-interpreter",
            "abbe-manipulators",
            "abbe-spec",
        ],
    ),
    (
        "metrology",
        "abbe-metrology",
        &["abbe", "abbe-codegen", "abbe-interpreter", "abbe-manipulators", "abbe-spec", "abbe-study"],
    ),
    ("report", "abbe-report", &["abbe", "abbe-metrology", "abbe-spec", "abbe-study"]),
    ("cli", "abbe-cli", &["abbe", "abbe-bound", "abbe-metrology", "abbe-report", "abbe-spec", "abbe-study"]),
    (
        "python",
        "abbe-python",
        &[
            "abbe",
            "abbe-bound",
            "abbe-interpreter",
            "abbe-manipulators",
            "abbe-metrology",
            "abbe-report",
            "abbe-spec",
            "abbe-study",
        ],
    ),
];

/// Cycles between files. Only remove entries from this list.
pub(crate) const CIRCLES: &[&[&str]] = &[];

/// Cycles between folders. Only remove entries from this list.
pub(crate) const CIRCLES_OF_FOLDERS: &[&str] = &[];
