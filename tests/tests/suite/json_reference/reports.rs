//! Commands with `--json`, and their reports.

/// Name of the report's class in Python, its type, and the commands that print it.
pub(super) const REPORTS: [(&str, &str, &[&str]); 17] = [
    ("AllocateReport", "abbe_study::factors::Report", &["allocate"]),
    ("AnalyzeReport", "abbe_study::analyze::report::Report", &["analyze", "merge"]),
    ("BoundReport", "abbe_study::bound::report::Report", &["bound"]),
    ("CheckReport", "abbe_study::check::Report", &["check"]),
    ("CompensateReport", "abbe_metrology::compensate::Report", &["compensate"]),
    ("DoctorReport", "abbe_metrology::doctor::job::Report", &["doctor"]),
    ("ExploreReport", "abbe_study::explore::report::Report", &["explore"]),
    ("ExportReport", "abbe_exchange::export::report::ExportReport", &["export"]),
    ("IdentifyReport", "abbe_metrology::identify::report::Report", &["identify"]),
    ("ImportReport", "abbe_exchange::import::report::ImportReport", &["import"]),
    ("JacobianReport", "abbe_study::jacobian::Report", &["jacobian"]),
    ("MeasureReport", "abbe_metrology::measure::Report", &["measure"]),
    ("MonitorReport", "abbe_metrology::monitor::job::Report", &["monitor"]),
    ("PlanReport", "abbe_metrology::plan::report::Report", &["plan"]),
    ("PositioningReport", "abbe_metrology::positioning::Report", &["positioning"]),
    ("ShippedManipulator", "abbe_study::list::ShippedManipulator", &["list"]),
    ("SimulateReport", "abbe_metrology::simulate::Report", &["simulate"]),
];
