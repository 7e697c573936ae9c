//! Analyses of the shipped manipulators. Each is computed once, and all tests read it.

use std::collections::BTreeMap;
use std::sync::{LazyLock, OnceLock};

use abbe_manipulators::SHIPPED;
use serde_json::Value;
use tempfile::tempdir;

use crate::report::files;
use crate::running::{json, prints};

/// Output of `abbe analyze NAME`.
pub(crate) struct Analysis {
    /// The text without options.
    pub(crate) screen: String,
    /// The report of `--json`.
    pub(crate) report: Value,
    /// The files of `--out`.
    pub(crate) files: BTreeMap<String, String>,
}

/// Returns the analysis of a shipped manipulator.
pub(crate) fn analysis(name: &str) -> &'static Analysis {
    static ANALYSES: LazyLock<BTreeMap<&str, OnceLock<Analysis>>> =
        LazyLock::new(|| SHIPPED.iter().map(|shipped| (shipped.name, OnceLock::new())).collect());
    ANALYSES[name].get_or_init(|| {
        let folder = tempdir().unwrap();
        let out = folder.path().join("out");
        Analysis {
            screen: prints(&["analyze", name]),
            report: json(&["analyze", name, "--json", "--out", out.to_str().unwrap()]),
            files: files(&out),
        }
    })
}
