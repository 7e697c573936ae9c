//! Page of an identification: the errors of the machine, their uncertainties and the residuals.

use abbe_metrology::AcceptanceVerdict;
use abbe_metrology::data::Map;
use abbe_metrology::identify::{
    Indistinguishable, JointProfiles, Kind, Parameter, Report, Sizes, WeaklyDetermined,
};
use abbe_spec::Spec;
use abbe_spec::expr::Symbol;
use abbe_study::explore;
use abbe_study::number::{self, digits, fixed};

use super::figure::figures;
use super::provenance::{Provenance, instrument};
use super::table::{facts, ledger, row_header};
use super::{Card, cards, document, escaped, findings, folded, heading, panel, panels, section, verdict};
use crate::figures::residuals::{ErrorNames, Residual, scenes};
use crate::text::{self, Detail};

/// Builds the page of an identification; `spec` and `map` are those of the job, and `live` is
/// the data of the live panel.
pub fn identification(
    spec: &Spec,
    map: &Map,
    report: &Report,
    provenance: &Provenance,
    live: Option<&explore::Report>,
) -> String {
    let lines = report.files.iter().flat_map(|file| file.lines());
    let lines = lines.map(|line| format!("{}<br>\n", escaped(&line))).collect::<String>();
    let panels = panels(live);
    let before = [
        heading("Errors from measurements", &spec.title, &report.title),
        accepted(spec, report.accepted.as_ref()),
        summary(spec, report),
        panel("Residuals at a configuration", panels.as_ref()),
    ];
    let after = [
        section("Figures", &pictures(spec, report)),
        section("Accuracy", &sizes(spec, report)),
        folded("Errors of the machine", &machine(spec, report)),
        placed(spec, report),
        folded("Indistinguishable errors", &groups(report)),
        terms(spec, report),
        report.profiles.as_ref().map_or_else(String::new, |found| profiles(spec, found)),
        section("Instrument", &instrument(spec, map)),
        folded("Fitted ranges", &ranges(spec, report)),
        folded("Rows", &format!("<p>{lines}</p>\n")),
        provenance.sections(&report.record, report.accepted.is_some()),
    ];
    let (before, after) = (before.concat(), after.concat());
    let findings = findings(|| text::identification(spec, report, Detail::Full), &format!("{before}{after}"));
    document(
        &format!("{}: errors from measurements", spec.title),
        &[before, findings, after].concat(),
        panels.as_ref(),
    )
}

fn summary(spec: &Spec, report: &Report) -> String {
    let unit = spec.length.symbol();
    let decimals = number::error_decimals(spec.length);
    let show = |value: f64| format!("{} {unit}", fixed(value, decimals));
    let card = |name, value, note: String| Card { name, value, note };
    let mut all = vec![
        card(
            "Base and tool fitted",
            show(report.fit.base_and_tool.mean),
            "mean position error of the fitted rows".to_owned(),
        ),
        card("Identified", show(report.fit.after.mean), "the same rows".to_owned()),
        card(
            "Cross-validation",
            show(report.cross_validation.after.mean),
            format!("{}-fold", report.cross_validation.folds),
        ),
    ];
    if let Some(test) = &report.test {
        let note = match report.test_rows_of_the_fit {
            0 => format!("{} rows, used for validation only", test.rows),
            known => format!("{} rows, {known} of them also in the fit", test.rows),
        };
        all.push(card("Test rows", show(test.after.mean), note));
    }
    let known = format!("{} of {}", report.rank, report.unknowns);
    all.push(card("Identifiable", known, "combinations of unknowns".to_owned()));
    cards(all)
}

fn sizes(spec: &Spec, report: &Report) -> String {
    let decimals = number::error_decimals(spec.length);
    let row = |name: &str, rows: usize, sizes: &Sizes| {
        let sizes =
            [Some(sizes.mean), sizes.standard_error, Some(sizes.rms), Some(sizes.p95), Some(sizes.max)];
        let cells = sizes.map(|size| size.map_or("?".to_owned(), |size| fixed(size, decimals)));
        let cells = cells.map(|cell| format!("<td>{cell}</td>"));
        format!("<tr>{}<td>{rows}</td>{}</tr>\n", row_header(name), cells.concat())
    };
    let mut rows = String::new();
    for (set, compared) in [("fit", Some(&report.fit)), ("test", report.test.as_ref())] {
        let Some(compared) = compared else { continue };
        rows += &row(&format!("{set}: as delivered"), compared.rows, &compared.before);
        rows += &row(&format!("{set}: base and tool fitted"), compared.rows, &compared.base_and_tool);
        if let Some(constant) = &compared.constant {
            rows += &row(&format!("{set}: constants alone"), compared.rows, constant);
        }
        rows += &row(&format!("{set}: identified"), compared.rows, &compared.after);
        if set == "fit" {
            let name = format!("{}-fold cross-validation", report.cross_validation.folds);
            rows += &row(&name, compared.rows, &report.cross_validation.after);
        }
    }
    let what = if report.instruments.is_empty() { "Position error" } else { "Residual of a reading" };
    let caption = format!("{what} ({}); ± is the standard error of the mean", spec.length.symbol());
    let columns = ["data set", "rows", "mean", "±", "rms", "95 %", "max"];
    ledger(&caption, &columns, &[0], &format!("<tbody>{rows}</tbody>\n"))
}

/// Formats the verdict on the acceptance limits, if there are any.
pub(super) fn accepted(spec: &Spec, accepted: Option<&AcceptanceVerdict>) -> String {
    accepted.map_or_else(String::new, |accepted| verdict(accepted.met, &accepted.sentence(spec.length), &[]))
}

fn machine(spec: &Spec, report: &Report) -> String {
    let meanings = report.meanings.iter().map(|meaning| format!("<li>{}</li>\n", escaped(&meaning.sentence)));
    let meanings = match meanings.collect::<String>() {
        list if list.is_empty() => list,
        list => format!(
            "<p>Equivalent joint offsets and DH errors, in place of the error in \
             brackets:</p>\n<ul>\n{list}</ul>\n"
        ),
    };
    let table = parameters("Errors of the machine", spec, report, |kind| kind == Kind::Machine);
    let pairs = report.correlations.iter().take(12);
    let pairs =
        pairs.map(|pair| format!("{} with {} {}", pair.of[0], pair.of[1], fixed(pair.correlation, 3)));
    let correlated = match pairs.collect::<Vec<_>>() {
        pairs if pairs.is_empty() => String::new(),
        pairs => {
            let more = report.correlations.len() - pairs.len();
            let more = if more > 0 { format!("; {more} more pairs") } else { String::new() };
            format!("<p>Correlated by more than 0.9: {}{more}.</p>\n", escaped(&pairs.join(", ")))
        }
    };
    format!("{meanings}{table}<p>All others are fixed at zero.</p>\n{correlated}{}", not_known(report))
}

/// Formats the parameters of station and targets.
fn placed(spec: &Spec, report: &Report) -> String {
    let is_placed = |kind: Kind| kind != Kind::Machine;
    if !report.parameters.iter().any(|parameter| is_placed(parameter.kind)) {
        return String::new();
    }
    let table = parameters("Station and targets", spec, report, is_placed);
    let words = "<p>Placements are not errors of the machine: they are not written to the spec \
        and not compensated.</p>\n";
    folded("Placement of the machine and of its tool", &format!("{table}{words}"))
}

fn not_known(report: &Report) -> String {
    let one = |not_known: &WeaklyDetermined| {
        let (unit, factor) = if not_known.unit == "rad" { ("mrad", 1e3) } else { (not_known.unit, 1.0) };
        let [deviation, expected] =
            [not_known.standard_deviation, not_known.expected].map(|value| digits(value * factor, 2));
        format!(
            "<li>{}: standard deviation {deviation} {unit} from these data, expected {expected} \
             {unit}</li>\n",
            escaped(&not_known.name)
        )
    };
    match report.not_known.iter().map(one).collect::<String>() {
        list if list.is_empty() => list,
        list => format!("<p>Poorly determined by these data; fixed at zero:</p>\n<ul>\n{list}</ul>\n"),
    }
}

fn parameters(caption: &str, spec: &Spec, report: &Report, is_shown: impl Fn(Kind) -> bool) -> String {
    let decimals = number::error_decimals(spec.length);
    let row = |parameter: &Parameter| {
        let (unit, factor) = if parameter.unit == "rad" { ("mrad", 1e3) } else { (parameter.unit, 1.0) };
        let decimals = if parameter.unit == "rad" { 4 } else { decimals };
        let show = |value: f64| match parameter.unit {
            "" => digits(value, 4),
            _ => fixed(value * factor, decimals),
        };
        let sure = parameter.value.abs() / parameter.standard_deviation.max(1e-300);
        let remark = if parameter.hardly_known { "prior-dominated" } else { "" };
        format!(
            "<tr>{}<td class=\"words\">{}</td><td>{}</td><td>{}</td><td class=\"words\">{unit}</td><td>{}</td>\
             <td class=\"words\">{remark}</td></tr>\n",
            row_header(&escaped(&parameter.name)),
            escaped(parameter.frame_name.as_deref().unwrap_or_default()),
            show(parameter.value),
            show(parameter.standard_deviation),
            fixed(sure.min(9999.0), 1),
        )
    };
    let shown = report.parameters.iter().filter(|parameter| is_shown(parameter.kind));
    let rows = shown.map(row).collect::<String>();
    let columns = ["error", "of", "value", "σ", "unit", "value/σ", ""];
    ledger(caption, &columns, &[0, 1, 4, 6], &format!("<tbody>{rows}</tbody>\n"))
}

/// Groups consecutive sentences with the same reason.
fn groups(report: &Report) -> String {
    let mut reasons: Vec<(&str, Vec<String>)> = Vec::new();
    for group in &report.groups {
        let sentence = escaped(&Indistinguishable::sentence(group));
        match reasons.last_mut() {
            Some((reason, sentences)) if *reason == group.reason => sentences.push(sentence),
            _ => reasons.push((&group.reason, vec![sentence])),
        }
    }
    if reasons.is_empty() {
        return "<p>All unknowns are identifiable.</p>\n".to_owned();
    }
    let rows = reasons.into_iter().map(|(reason, sentences)| (escaped(reason), sentences.join("<br>")));
    facts("Indistinguishable errors, by reason", rows)
}

fn terms(spec: &Spec, report: &Report) -> String {
    if report.terms.is_empty() {
        return String::new();
    }
    let decimals = number::error_decimals(spec.length);
    let rows = report.terms.iter().map(|term| {
        format!(
            "<tr>{}<td>{}</td><td>{}</td><td>{}</td></tr>\n",
            row_header(&escaped(&term.name)),
            fixed(term.before, decimals),
            fixed(term.after, decimals),
            if term.p < 1e-12 { "below 1e-12".to_owned() } else { digits(term.p, 2) }
        )
    });
    let caption = format!(
        "Additional terms in order of acceptance: root mean square of a coordinate in \
         cross-validation before and after ({})",
        spec.length.symbol()
    );
    let columns = ["term", "before", "after", "p of the F-test"];
    let body = format!("<tbody>{}</tbody>\n", rows.collect::<String>());
    section("Additional terms", &ledger(&caption, &columns, &[0], &body))
}

fn profiles(spec: &Spec, found: &JointProfiles) -> String {
    let rows = found.joints.iter().map(|one| {
        let [from, to] = one.range.map(|end| number::of_symbol(end, Symbol::Variable(one.variable), spec));
        let (factor, unit) = if one.unit == "rad" { (1e3, "mrad") } else { (1.0, one.unit) };
        let [rms, deviation] = [one.rms, one.standard_deviation].map(|value| digits(factor * value, 2));
        format!(
            "<tr>{}<td class=\"words\">{from} … {to}</td><td>{rms}</td><td>{deviation}</td><td \
             class=\"words\">{unit}</td><td>{}</td></tr>\n",
            row_header(&escaped(&one.joint)),
            fixed(one.without, 2)
        )
    });
    let columns = ["joint", "range covered", "rms", "σ", "unit", "error without it"];
    let body = format!("<tbody>{}</tbody>\n", rows.collect::<String>());
    let caption = "Profiles; the last column is the factor of the cross-validation error (root mean \
                   square) without the profile";
    section("Joint profiles", &ledger(caption, &columns, &[0, 1, 4], &body))
}

fn pictures(spec: &Spec, report: &Report) -> String {
    let list = |is_test: bool| {
        let points = report.points.iter().filter(move |point| point.is_test == is_test && !point.is_rejected);
        let residuals = points.map(|point| Residual {
            q: &point.q,
            point: point.point,
            before: Some(point.before),
            after: point.after,
        });
        residuals.collect::<Vec<_>>()
    };
    let names = ErrorNames { before: "base and tool fitted", after: "identified" };
    let (used, test) = (scenes(&list(false), &names, spec), list(true));
    let mut text = format!("<p>Rows used in the fit, without outliers.</p>\n{}", figures(&used, 0));
    if !test.is_empty() {
        let drawn = figures(&scenes(&test, &names, spec), used.len());
        text += &format!("<h3>Test rows</h3>\n{drawn}");
    }
    text
}

fn ranges(spec: &Spec, report: &Report) -> String {
    let row = |fitted: &abbe_spec::Fitted| {
        let [lower, upper] = fitted.range.map(|end| number::of_symbol(end, fitted.symbol, spec));
        (escaped(spec.name_of(fitted.symbol)), escaped(&format!("{lower} … {upper}")))
    };
    facts("Fitted ranges; results beyond them are extrapolations", report.found.fitted.iter().map(row))
}
