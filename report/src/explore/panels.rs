//! Elements of a page that the scripts fill, with the scripts and the style sheet.

use abbe_study::explore::Report;

use super::modules::script;
use super::policy::policy;
use super::scripts::{data, inline, machine};

const STYLE: &str = include_str!("page/explore.css");

/// Parts of a page with live panels.
pub(crate) struct Panels {
    /// Style sheet, for the head.
    pub(crate) style: String,
    /// Data and scripts, for the end of the body.
    pub(crate) scripts: String,
    /// One empty section for each machine.
    pub(crate) elements: String,
    /// Content security policy, for the head, before everything that it restricts.
    pub(crate) policy: String,
}

impl Panels {
    /// Creates the panels of some machines. `styles` are the other style sheets of the page.
    pub(crate) fn new(reports: &[Report], styles: &[&str]) -> Self {
        let machines: Vec<String> = reports.iter().map(|report| machine(&report.code)).collect();
        let script = script();
        let all: Vec<&str> = machines.iter().map(String::as_str).chain([script.as_str()]).collect();
        let data = reports.iter().map(data).collect::<String>();
        let sections = "<section class=\"abbe-panel\"></section>\n".repeat(reports.len());
        Self {
            style: format!("<style>{STYLE}</style>\n"),
            scripts: data + &all.iter().map(|script| inline(script)).collect::<String>(),
            elements: format!(
                "{sections}<noscript><p>The panel computes in the browser and needs JavaScript, \
                 which is switched off.</p></noscript>\n"
            ),
            policy: policy(&all, &[&[STYLE], styles].concat()),
        }
    }
}
