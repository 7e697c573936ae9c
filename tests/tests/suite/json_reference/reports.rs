//! Commands with `--json`, and their reports.

/// Name of the report's class in Python, its type, and the commands that print it.
pub(super) const REPORTS: [(&str, &str, &[&str]); 16] = [
    ("AnalyzeReport", "abbe_study::analyze::report::Report", &["analyze", "merge"]),
    ("BoundReport", "abbe_study::bound::report::Report", &["bound"]),
    ("CheckReport", "abbe_study::check::Report", &["check"]),
    ("CompensateReport", "abbe_study::compensate::Report", &["compensate"]),
    ("DoctorReport", "abbe_study::doctor::report::Report", &["doctor"]),
    ("ExploreReport", "abbe_study::explore::report::Report", &["explore"]),
    ("ExportReport", "abbe_exchange::export::report::ExportReport", &["export"]),
    ("IdentifyReport", "abbe_study::identify::report::Report", &["identify"]),
    ("ImportReport", "abbe_exchange::import::report::ImportReport", &["import"]),
    ("JacobianReport", "abbe_study::jacobian::Report", &["jacobian"]),
    ("MeasureReport", "abbe_study::measure::Report", &["measure"]),
    ("MonitorReport", "abbe_study::monitor::report::Report", &["monitor"]),
    ("PlanReport", "abbe_study::plan::report::Report", &["plan"]),
    ("PositioningReport", "abbe_study::positioning::Report", &["positioning"]),
    ("ShippedManipulator", "abbe_study::list::ShippedManipulator", &["list"]),
    ("SimulateReport", "abbe_study::simulate::Report", &["simulate"]),
];
