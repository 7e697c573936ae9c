//! The crates of the workspace and what each may depend on; circles between files that are still there.

/// The folder of each crate, its package, and the crates it depends on, which all stand above it.
pub(crate) const CRATES: &[(&str, &str, &[&str])] = &[
    ("runtime/core", "abbe-core", &[]),
    ("spec", "abbe-spec", &["abbe-core"]),
    ("codegen", "abbe-codegen", &["abbe-core", "abbe-spec"]),
    ("codegen/macro", "abbe-macro", &["abbe-codegen", "abbe-spec"]),
    ("analysis", "abbe-analysis", &["abbe-core"]),
    ("bound", "abbe-bound", &["abbe-codegen", "abbe-core", "abbe-spec"]),
    ("calibration", "abbe-calibration", &["abbe-analysis", "abbe-core"]),
    ("runtime", "abbe", &["abbe-analysis", "abbe-calibration", "abbe-core"]),
    ("interpreter", "abbe-interpreter", &["abbe", "abbe-codegen", "abbe-spec"]),
    ("manipulators", "abbe-manipulators", &["abbe", "abbe-codegen"]),
    (
        "study",
        "abbe-study",
        &["abbe", "abbe-bound", "abbe-codegen", "abbe-interpreter", "abbe-manipulators", "abbe-spec"],
    ),
    ("report", "abbe-report", &["abbe", "abbe-spec", "abbe-study"]),
    ("cli", "abbe-cli", &["abbe", "abbe-bound", "abbe-report", "abbe-spec", "abbe-study"]),
    (
        "python",
        "abbe-python",
        &[
            "abbe",
            "abbe-bound",
            "abbe-interpreter",
            "abbe-manipulators",
            "abbe-report",
            "abbe-spec",
            "abbe-study",
        ],
    ),
];

/// Files that use each other. Only take lines out of this list.
pub(crate) const CIRCLES: &[&[&str]] = &[
    &["runtime/core/src/function.rs", "runtime/core/src/function/table.rs"],
    &["runtime/core/src/lanes/functions.rs", "runtime/core/src/lanes/run.rs"],
    &["runtime/core/src/lookup_table.rs", "runtime/core/src/scalar.rs"],
    &[
        "analysis/src/reach/bounds.rs",
        "analysis/src/reach/descents.rs",
        "analysis/src/reach/inverse.rs",
        "analysis/src/reach/search.rs",
    ],
    &["analysis/src/sweep/block.rs", "analysis/src/sweep/rows.rs"],
    &[
        "calibration/src/identify/gradient.rs",
        "calibration/src/identify/linearize.rs",
        "calibration/src/identify/residuals.rs",
    ],
    &["calibration/src/identify/left_out.rs", "calibration/src/identify/select.rs"],
    &[
        "study/src/export/dh/fit.rs",
        "study/src/export/dh/mod.rs",
        "study/src/export/dh/rows.rs",
        "study/src/export/dh/text.rs",
        "study/src/export/found.rs",
        "study/src/export/isg_csv.rs",
        "study/src/export/linuxcnc.rs",
        "study/src/export/mod.rs",
        "study/src/export/origins.rs",
        "study/src/export/slides.rs",
        "study/src/export/table.rs",
        "study/src/export/turning.rs",
        "study/src/export/ur_calibration.rs",
        "study/src/export/urdf/edit.rs",
        "study/src/export/urdf/mod.rs",
    ],
    &[
        "study/src/import/dh/cell.rs",
        "study/src/import/dh/ends.rs",
        "study/src/import/dh/mod.rs",
        "study/src/import/dh/rows.rs",
    ],
    &["study/src/import/dh/columns.rs", "study/src/import/dh/text.rs"],
    &["report/src/html/covered.rs", "report/src/html/page.rs"],
    &["report/src/svg/legend.rs", "report/src/svg/mod.rs"],
    &["report/src/text/check/chain.rs", "report/src/text/check/mod.rs"],
    &["python/src/analyze.rs", "python/src/part.rs"],
];
