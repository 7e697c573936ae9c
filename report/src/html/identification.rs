//! The page of an identification: which errors the machine has, how well they are known, and what is left.

use abbe_spec::Spec;
use abbe_study::Accepted;
use abbe_study::data::Map;
use abbe_study::identify::{Indistinguishable, Kind, Parameter, Report, Sizes, WeaklyDetermined};
use abbe_study::number::{self, digits, fixed};

use super::figure::figures;
use super::provenance::{Provenance, instrument};
use super::{document, escaped, section};
use crate::figures::residuals::{Names, Residual, scenes};

/// The page of an identification; `spec` and `map` are those of the job.
pub fn identification(spec: &Spec, map: &Map, report: &Report, provenance: &Provenance) -> String {
    let heading = format!(
        "<header>\n<p class=\"kind\">Errors from measurements</p>\n<h1>{}</h1>\n<p class=\"study\">{}</p>\n</header>\n",
        escaped(&spec.title),
        escaped(&report.title)
    );
    let lines = report.files.iter().flat_map(|file| file.lines());
    let lines = lines.map(|line| format!("{}<br>\n", escaped(&line))).collect::<String>();
    let notes = report.notes.iter().map(|note| format!("<p>{}</p>\n", escaped(note))).collect::<String>();
    let body = [
        heading,
        verdict(spec, report.accepted.as_ref()),
        summary(spec, report),
        section("How good it is", &(sizes(spec, report) + &notes)),
        section("Errors of the machine", &machine(spec, report)),
        placed(spec, report),
        section("What cannot be told apart", &groups(report)),
        terms(spec, report),
        section("What is left", &pictures(spec, report)),
        section("Instrument", &instrument(spec, map)),
        section("Ranges", &ranges(spec, report)),
        section("Rows", &format!("<p>{lines}</p>\n")),
        section("Input files", &provenance.table()),
    ];
    document(&format!("{}: errors from measurements", spec.title), &body.concat())
}

fn summary(spec: &Spec, report: &Report) -> String {
    let unit = spec.length.symbol();
    let decimals = number::error_decimals(spec.length);
    let show = |value: f64| format!("{} {unit}", fixed(value, decimals));
    let crossed = &report.cross_validation.after;
    let mut cards = vec![
        (
            "Base and tool fitted",
            show(report.fit.base_and_tool.mean),
            "mean position error of the rows that were used".to_owned(),
        ),
        ("Identified", show(report.fit.after.mean), "the same rows".to_owned()),
        ("Left out in turn", show(crossed.mean), format!("{} parts", report.cross_validation.folds)),
    ];
    if let Some(test) = &report.test {
        cards.push((
            "Test rows",
            show(test.after.mean),
            match report.test_rows_of_the_fit {
                0 => format!("{} rows, used for nothing else", test.rows),
                known => format!("{} rows, {known} of them rows of the fit", test.rows),
            },
        ));
    }
    cards.push((
        "Known",
        format!("{} of {}", report.rank, report.unknowns),
        "combinations of unknowns".to_owned(),
    ));
    let cards = cards.into_iter().map(|(name, value, note)| {
        format!("<div class=\"card\"><span>{name}</span><b>{value}</b><small>{note}</small></div>\n")
    });
    format!("<div class=\"cards\">\n{}</div>\n", cards.collect::<String>())
}

fn sizes(spec: &Spec, report: &Report) -> String {
    let decimals = number::error_decimals(spec.length);
    let row = |name: &str, rows: usize, sizes: &Sizes| {
        let sizes =
            [Some(sizes.mean), sizes.standard_error, Some(sizes.rms), Some(sizes.p95), Some(sizes.max)];
        let cells = sizes.map(|size| size.map_or("?".to_owned(), |size| fixed(size, decimals)));
        let cells = cells.map(|cell| format!("<td>{cell}</td>"));
        format!("<tr><td class=\"words\">{name}</td><td>{rows}</td>{}</tr>\n", cells.concat())
    };
    let mut rows = String::new();
    for (set, compared) in [("fit", Some(&report.fit)), ("test", report.test.as_ref())] {
        let Some(compared) = compared else { continue };
        rows += &row(&format!("{set}: as delivered"), compared.rows, &compared.before);
        rows += &row(&format!("{set}: base and tool fitted"), compared.rows, &compared.base_and_tool);
        rows += &row(&format!("{set}: identified"), compared.rows, &compared.after);
        if set == "fit" {
            let name = format!("left out in turn, {} parts", report.cross_validation.folds);
            rows += &row(&name, compared.rows, &report.cross_validation.after);
        }
    }
    let what = if report.instruments.is_empty() { "position error" } else { "error of a reading" };
    format!(
        "<table class=\"ledger\"><thead><tr><th class=\"words\">{what}, {}</th><th>rows</th><th>mean</th><th>±</th><th>rms</th><th>95 %</th>\
         <th>max</th></tr></thead>\n<tbody>{rows}</tbody></table>\n<p>±: one standard error of the mean. What is left is {} times what the instrument's uncertainty explains.</p>\n",
        spec.length.symbol(),
        digits(report.uncertainty_factor, 3)
    )
}

/// Whether declared limits are met, if any were declared.
pub(super) fn verdict(spec: &Spec, accepted: Option<&Accepted>) -> String {
    let Some(accepted) = accepted else { return String::new() };
    let class = if accepted.met { "met" } else { "missed" };
    let sentence = escaped(&accepted.sentence(spec.length));
    format!("<section class=\"verdict\">\n<h2 class=\"{class}\">{sentence}</h2>\n</section>\n")
}

fn machine(spec: &Spec, report: &Report) -> String {
    let meanings = report.meanings.iter().map(|meaning| format!("<li>{}</li>\n", escaped(&meaning.sentence)));
    let meanings = match meanings.collect::<String>() {
        list if list.is_empty() => list,
        list => format!(
            "<p>In numbers of the chain, each in place of the error in brackets:</p>\n<ul>\n{list}</ul>\n"
        ),
    };
    let table = parameters(spec, report, |kind| kind == Kind::Machine);
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
    format!("{meanings}{table}<p>All others are held at zero.</p>\n{correlated}{}", not_known(report))
}

/// What belongs to the station and to the tool.
fn placed(spec: &Spec, report: &Report) -> String {
    let is_placed = |kind: Kind| kind != Kind::Machine;
    if !report.parameters.iter().any(|parameter| is_placed(parameter.kind)) {
        return String::new();
    }
    let table = parameters(spec, report, is_placed);
    let words = "<p>No errors of the machine: they do not go into the spec and are not compensated.</p>\n";
    section("Where the machine stands, and what is mounted on its tool", &format!("{table}{words}"))
}

fn not_known(report: &Report) -> String {
    let one = |not_known: &WeaklyDetermined| {
        let (unit, factor) = if not_known.unit == "rad" { ("mrad", 1e3) } else { (not_known.unit, 1.0) };
        let [told, expected] = [not_known.told, not_known.expected].map(|value| digits(value * factor, 2));
        format!(
            "<li>{}: these data alone tell it to ± {told} {unit}; ± {expected} {unit} is expected</li>\n",
            escaped(&not_known.name)
        )
    };
    match report.not_known.iter().map(one).collect::<String>() {
        list if list.is_empty() => list,
        list => format!("<p>Not known from these data, and held at zero:</p>\n<ul>\n{list}</ul>\n"),
    }
}

fn parameters(spec: &Spec, report: &Report, is_shown: impl Fn(Kind) -> bool) -> String {
    let decimals = number::error_decimals(spec.length);
    let row = |parameter: &Parameter| {
        let (unit, factor) = if parameter.unit == "rad" { ("mrad", 1e3) } else { (parameter.unit, 1.0) };
        let decimals = if parameter.unit == "rad" { 4 } else { decimals };
        let show = |value: f64| match parameter.unit {
            "" => digits(value, 4),
            _ => fixed(value * factor, decimals),
        };
        let sure = parameter.value.abs() / parameter.standard_deviation.max(1e-300);
        let remark = if parameter.hardly_known { "hardly known" } else { "" };
        format!(
            "<tr><td class=\"words\">{}</td><td class=\"words\">{}</td><td>{}</td><td>{}</td><td class=\"words\">{unit}</td><td>{}</td>\
             <td class=\"words\">{remark}</td></tr>\n",
            escaped(&parameter.name),
            escaped(parameter.frame_name.as_deref().unwrap_or_default()),
            show(parameter.value),
            show(parameter.standard_deviation),
            fixed(sure.min(9999.0), 1),
        )
    };
    let shown = report.parameters.iter().filter(|parameter| is_shown(parameter.kind));
    let rows = shown.map(row).collect::<String>();
    format!(
        "<table class=\"ledger\"><thead><tr><th class=\"words\">error</th><th class=\"words\">of</th><th>value</th>\
         <th>standard deviation σ</th><th></th><th>value/σ</th><th></th></tr></thead>\n<tbody>{rows}</tbody></table>\n"
    )
}

/// Groups with the same reason together.
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
        return "<p>Everything that is unknown can be told apart.</p>\n".to_owned();
    }
    let rows = reasons.into_iter().map(|(reason, sentences)| {
        format!(
            "<tr><th class=\"wrapped\">{}</th><td>{}</td></tr>\n",
            escaped(reason),
            sentences.join("<br>")
        )
    });
    format!("<table class=\"facts\"><tbody>{}</tbody></table>\n", rows.collect::<String>())
}

fn terms(spec: &Spec, report: &Report) -> String {
    if report.terms.is_empty() {
        return String::new();
    }
    let decimals = number::error_decimals(spec.length);
    let rows = report.terms.iter().map(|term| {
        format!(
            "<tr><td class=\"words\">{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
            escaped(&term.name),
            fixed(term.before, decimals),
            fixed(term.after, decimals),
            if term.p < 1e-12 { "below 1e-12".to_owned() } else { digits(term.p, 2) }
        )
    });
    let table = format!(
        "<p>Root mean square of a coordinate on rows left out in turn, before and after, {}.</p>\n<table class=\"ledger\"><thead><tr>\
         <th class=\"words\">term, in the order of their gain</th><th>before</th><th>after</th><th>p of the F-test</th></tr></thead>\n\
         <tbody>{}</tbody></table>\n",
        spec.length.symbol(),
        rows.collect::<String>()
    );
    section("Richer terms", &table)
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
    let names = Names { before: "base and tool fitted", after: "identified" };
    let (used, test) = (scenes(&list(false), &names, spec), list(true));
    let mut text = format!("<p>Rows that were used; gross errors are left out.</p>\n{}", figures(&used, 0));
    if !test.is_empty() {
        let drawn = figures(&scenes(&test, &names, spec), used.len());
        text += &format!("<h3>Test rows</h3>\n{drawn}");
    }
    text
}

fn ranges(spec: &Spec, report: &Report) -> String {
    let row = |fitted: &abbe_spec::Fitted| {
        let [lower, upper] = fitted.range.map(|end| number::of_symbol(end, fitted.symbol, spec));
        format!(
            "<tr><th>{}</th><td>{} … {}</td></tr>\n",
            escaped(spec.name_of(fitted.symbol)),
            escaped(&lower),
            escaped(&upper)
        )
    };
    let rows = report.found.fitted.iter().map(row).collect::<String>();
    format!(
        "<p>What is said holds where the rows were; beyond, it is extrapolated.</p>\n<table class=\"facts\"><tbody>{rows}</tbody></table>\n"
    )
}
