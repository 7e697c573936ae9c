//! Allocation: the factors of the error sources that keep a tolerance at least cost.

use abbe_spec::option::option;
use abbe_study::allocate::{AllocatedSource, Report, printed};
use abbe_study::number::{counted, digits, error_unit};
use abbe_study::study_file::Criterion;

use super::analysis::by_criterion;
use super::shared::{changed, place};
use crate::document::{Document, Section, Table};

/// Number of sources on the first screen.
const SHOWN: usize = 10;

/// Describes an allocation.
pub fn allocation(report: &Report) -> Document {
    let (factor, unit) = error_unit(report.length);
    let tolerances = [(report.tolerance, factor, unit), (report.orientation_tolerance, 1e3, "mrad")];
    let kept = tolerances.into_iter().filter_map(|(tolerance, factor, unit)| {
        tolerance.map(|tolerance| format!("{} {unit}", digits(factor * tolerance, 3)))
    });
    let at = counted(report.configurations, "configuration", "configurations");
    let mut shown = table(report);
    let more = shown.rows.split_off(shown.rows.len().min(SHOWN)).len();
    shown.rest = if more > 0 { format!("… {more} more") } else { String::new() };
    let is_drawn = matches!(report.study.criterion, Criterion::Probability | Criterion::Yield);
    let meaning = if is_drawn { DRAWN } else { MEANING };
    let options = report.scales().into_iter().map(|scale| option("scale", scale).to_string()).collect();
    Document {
        kind: "Allocation of a tolerance",
        machine: report.spec.title.clone(),
        title: report.study.title.clone(),
        headline: format!(
            "tolerance {} kept {} at {at}",
            kept.collect::<Vec<_>>().join(" and "),
            by_criterion(report.study.criterion, &report.spec)
        ),
        sections: vec![
            Section::answer().table(shown).facts(facts(report)),
            Section::full("Factors").table(table(report)).state("factors", meaning.to_owned()),
            Section::full("Options").list("options", "These options apply the factors:", options),
        ],
        ..Document::default()
    }
}

/// Definition of the factors.
const MEANING: &str = "Each factor multiplies the errors of its source. The tolerance is kept with these factors as they are \
 printed, and with all smaller ones: no error is relied on to cancel another one. The sum of the costs c/xᵖ is the least possible.";

/// Definition of the factors where draws decide.
const DRAWN: &str = "Each factor multiplies the errors of its source. With these factors as they are printed an analysis keeps the \
 tolerance by its draws, without the sources that counteract others, too. The sum of the costs c/xᵖ is the least at which \
 the root sum of squares is as large: the multiple of the tolerance that it may have is found by bisection, to 1 %.";

/// Tabulates the sources, the smallest factor first.
fn table(report: &Report) -> Table {
    let (factor, unit) = if report.tolerance.is_some() { error_unit(report.length) } else { (1e3, "mrad") };
    let columns = ["source", ">factor", &format!(">alone, {unit}"), ">then"];
    let mut sources: Vec<&AllocatedSource> = report.sources.iter().collect();
    sources.sort_by(|a, b| a.fixed.cmp(&b.fixed).then(a.factor.total_cmp(&b.factor)));
    Table::new("", columns).rows(sources.into_iter().map(|source| {
        let times = printed(source.factor);
        let shown = if source.fixed { "fixed".to_owned() } else { format!("x {times}") };
        let [alone, then] = [1.0, times].map(|times| digits(factor * source.largest * times, 3));
        [source.source.clone(), shown, alone, then]
    }))
}

fn facts(report: &Report) -> Vec<(&'static str, String)> {
    let mut facts = vec![("Study", report.study.title.clone())];
    facts.extend(changed(&report.changes));
    let [cost, all] = [report.cost, report.one_factor_cost].map(|cost| digits(cost, 3));
    facts
        .push(("Cost", format!("{cost}; {all} with the same factor {} for all", printed(report.one_factor))));
    if let Some((worst, _)) = report.active.0.first() {
        let count = report.active.0.len();
        let more = if count > 1 { format!("; reached at {count} configurations") } else { String::new() };
        facts.push(("Worst", place(worst) + &more));
    }
    if report.unreachable > 0 {
        facts.push(("Reach", format!("{} more cannot be reached", report.unreachable)));
    }
    facts
}
