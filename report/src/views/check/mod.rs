//! Check: whether the spec is valid, and what it describes.

mod chain;
mod tree;

use abbe_spec::{Frame, Input, Spec, Variable};
use abbe_study::check::{Identifiable, Law, Report};
use abbe_study::number::{self, counted, quantity, short};

use super::shared::{notes, some};
use crate::document::{Document, Section, Table, first};
use tree::joint;

/// Number of joints on the first screen.
const JOINTS: usize = 8;
/// Number of remarks on the first screen.
const REMARKS: usize = 3;

/// Describes the check of a spec.
pub fn check(report: &Report) -> Document {
    let spec = &report.spec;
    let mut failures: Vec<String> = report.laws.iter().filter_map(|law| law.failure.clone()).collect();
    failures.dedup();
    let open = report.tree.as_ref().and_then(|tree| tree::failure(tree, spec));
    let answer =
        failures.into_iter().fold(Section::answer().state("open_loops", open), |section, failure| {
            section.state("failed_law", failure)
        });
    let remarks = some("Remark", &report.notes, REMARKS);
    let mut sections = vec![
        answer.table(joints(spec)).facts([facts(report), remarks].concat()),
        Section::full("Description").state("description", spec.description.clone()),
        Section::full("Frames").table(frames(spec)),
        iso_axes(report),
    ];
    sections.extend(report.tree.iter().flat_map(|tree| tree::sections(tree, spec)));
    sections.extend(report.home.iter().flat_map(|home| chain::sections(home, spec)));
    sections.extend([
        Section::full("Parameters").table(parameters(spec)),
        Section::full("Inputs").table(inputs(spec)),
        Section::full("Sources").table(sources_one_by_one(report)),
        notes(&report.notes, REMARKS),
        identifiability(report),
        laws(report),
        Section::full("Operations of the generated code").table(operations(report)),
    ]);
    Document {
        kind: "Check of a spec",
        machine: format!("{} ({})", spec.title, report.facts.spec),
        headline: verdict(report),
        sections,
        ..Document::default()
    }
}

fn verdict(report: &Report) -> String {
    let count = report.laws.len();
    let failed: Vec<&str> = report.laws.iter().filter(|law| !law.holds).map(|law| law.law).collect();
    let remarks = match report.warnings.len() + report.notes.len() {
        0 => String::new(),
        count => format!(", {}", counted(count, "remark", "remarks")),
    };
    if report.tree.as_ref().is_some_and(|tree| !tree.closes()) {
        return format!("FAILED, the loops are not closed at home{remarks}");
    }
    match failed.as_slice() {
        [] => format!("OK, spec valid, {count} self-checks passed{remarks}"),
        failed => format!("FAILED, {} of {count} self-checks: {}{remarks}", failed.len(), failed.join(", ")),
    }
}

fn joints(spec: &Spec) -> Table {
    let rows = spec.variables.iter().enumerate().map(|(i, variable)| {
        let [kind, limits, home] = joint(variable, spec.length);
        let moved = match spec.leg(i) {
            Some(leg) => format!("loop {}", leg.name),
            None => format!("frame {}", spec.frames[variable.frame].name),
        };
        [variable.name.clone(), kind, limits, home, moved]
    });
    let sums = spec.sum_limits.iter().map(|limit| {
        let home: Vec<f64> = spec.variables.iter().map(|variable| variable.home).collect();
        let (limits, home) = (limit.range, limit.value(&home));
        let sum = Variable { kind: limit.kind, limits, home, ..spec.variables[limit.terms[0].0].clone() };
        let [_, limits, home] = joint(&sum, spec.length);
        [limit.sum.to_string(), "sum".to_owned(), limits, home, String::new()]
    });
    let columns = ["joint", "kind", "limits", "home", "moves"];
    let all = spec.variables.len();
    let shown = if all > JOINTS { JOINTS - 1 } else { all };
    let mut table = Table::new("", columns).rows(rows.take(shown).chain(sums));
    if shown < all {
        table.rest = format!("… and {} more", all - shown);
    }
    table
}

fn facts(report: &Report) -> Vec<(&'static str, String)> {
    let spec = &report.spec;
    let moving = spec.variables.len();
    let is_fixed = |frame: &&Frame| frame.variable.is_none() && frame.passive.is_none();
    let fixed = spec.frames.iter().filter(is_fixed).count();
    let (name, tool) = match &report.tree {
        Some(tree) => ("Tree", format!("; tool on {}", tree.tool)),
        None => ("Chain", String::new()),
    };
    let mut facts = vec![(
        name,
        format!(
            "{}, {}, {} fixed{tool}; lengths in {}; orientation as {}",
            counted(spec.frames.len(), "frame", "frames"),
            counted(moving, "joint", "joints"),
            fixed,
            spec.length.symbol(),
            report.facts.orientation
        ),
    )];
    facts.extend(report.tree.iter().filter(|tree| tree.closes()).flat_map(|tree| tree::facts(tree, spec)));
    if let Some(home) = &report.home {
        let [x, y, z] =
            [0, 1, 2].map(|i| number::trimmed(home.pose[i][3], number::error_decimals(spec.length)));
        facts.push(("Home", format!("tool point at ({x}, {y}, {z}) {} in F_0", spec.length.symbol())));
    }
    facts.push(("Sources", sources(report)));
    if !spec.parameters.is_empty() {
        let names: Vec<&str> = spec.parameters.iter().map(|parameter| parameter.name.as_str()).collect();
        facts.push((
            "Given",
            format!("{}: {}", counted(names.len(), "parameter", "parameters"), first(&names, 8)),
        ));
    }
    if !spec.inputs.is_empty() {
        let inputs: Vec<String> = spec
            .inputs
            .iter()
            .map(|input| format!("{} {} ({})", input.name, quantity(input.value, &input.unit), values(input)))
            .collect();
        facts.push(("Inputs", first(&inputs, 4)));
    }
    if !report.identifiable.is_empty() {
        facts.push(("Identify", identifiable(&report.identifiable)));
    }
    facts
}

fn sources(report: &Report) -> String {
    let all = &report.facts.sources;
    let of = |class: &str| all.iter().filter(|one| one.enabled && one.class.starts_with(class)).count();
    let [repeatable, tolerances, random] = ["repeatable", "tolerance", "random"].map(of);
    let more = |count: usize, name: &str| if count > 0 { format!(", {count} {name}") } else { String::new() };
    let off = more(all.len() - repeatable - tolerances - random, "disabled");
    let tolerances = more(tolerances, if tolerances == 1 { "tolerance" } else { "tolerances" });
    if all.is_empty() {
        "none".to_owned()
    } else {
        format!("{repeatable} repeatable{tolerances}, {random} random{off}")
    }
}

fn identifiable(counts: &[Identifiable]) -> String {
    let rank = |measurement: &str| {
        let found = counts.iter().find(|one| one.measurement == measurement && !one.base);
        found.map_or(String::new(), |one| match one.rank {
            Some(rank) => format!("{rank} of {}", one.unknowns),
            None => format!("an unknown number of {}", one.unknowns),
        })
    };
    format!("{} generalized errors from measured poses, {} from measured points", rank("pose"), rank("point"))
}

fn parameters(spec: &Spec) -> Table {
    let rows =
        spec.parameters.iter().map(|p| [p.name.clone(), quantity(p.value, &p.unit), p.description.clone()]);
    Table::new("", ["name", "nominal", "what"]).rows(rows)
}

fn inputs(spec: &Spec) -> Table {
    let rows = spec.inputs.iter().map(|u| {
        let range = format!("{} {}", values(u), u.unit);
        [u.name.clone(), quantity(u.value, &u.unit), range, u.description.clone()]
    });
    Table::new("", ["name", "nominal", "range", "what"]).rows(rows)
}

/// Returns the range of an input, or its levels.
fn values(input: &Input) -> String {
    match &input.levels[..] {
        [] => input.range.map(short).join(" … "),
        levels => levels.iter().map(|level| short(*level)).collect::<Vec<_>>().join(", "),
    }
}

fn sources_one_by_one(report: &Report) -> Table {
    let rows = report.facts.sources.iter().map(|source| {
        let state = if source.enabled { "on" } else { "off" };
        [source.name.clone(), source.class.to_owned(), source.at.clone(), state.to_owned()]
    });
    Table::new("", ["name", "class", "at", ""]).rows(rows)
}

fn operations(report: &Report) -> Table {
    let rows = report.facts.operations.iter().map(|f| [f.function.to_owned(), f.operations.to_string()]);
    Table::new("", ["function", ">operations"]).rows(rows)
}

fn frames(spec: &Spec) -> Table {
    let rows = spec.frames.iter().enumerate().map(|(i, frame)| {
        let number = (i + 1).to_string();
        let driven = frame.variable.map(|variable| &spec.variables[variable]);
        let Some(variable) = driven.or(frame.passive.map(|passive| &spec.passive[passive])) else {
            return [number, frame.name.clone(), String::new(), "fixed".into(), String::new(), String::new()];
        };
        let [kind, limits, home] = joint(variable, spec.length);
        let kind = if driven.is_some() { kind } else { format!("{kind}, passive") };
        [number, frame.name.clone(), variable.name.clone(), kind, limits, home]
    });
    if spec.is_serial() {
        return Table::new("", ["", "frame", "variable", "kind", "limits", "home"]).rows(rows);
    }
    let parents = spec.frames.iter().map(|frame| match frame.parent {
        Some(parent) => spec.frames[parent].name.clone(),
        None => "base".to_owned(),
    });
    let rows = rows.zip(parents).map(|([number, frame, variable, kind, limits, home], parent)| {
        [number, frame, parent, variable, kind, limits, home]
    });
    let legs = spec.variables.iter().enumerate().filter_map(|(i, variable)| {
        let leg = spec.leg(i)?;
        let [kind, limits, home] = joint(variable, spec.length);
        Some([
            String::new(),
            format!("loop {}", leg.name),
            String::new(),
            variable.name.clone(),
            kind,
            limits,
            home,
        ])
    });
    let columns = ["", "frame", "hangs on", "variable", "kind", "limits", "home"];
    Table::new("", columns).rows(rows.chain(legs))
}

/// Lists the names of ISO 230-1.
fn iso_axes(report: &Report) -> Section {
    let rows = report.iso_axes.iter().map(|axis| {
        let [x, y, z, s, r, p] = axis.errors.clone();
        let carried = if axis.carries_workpiece { "workpiece" } else { "tool" };
        [axis.name.clone(), carried.to_owned(), x, y, z, s, r, p]
    });
    let columns = ["frame", "carries", "e_x", "e_y", "e_z", "e_s", "e_r", "e_p"];
    let slides = "Slides are taken to carry the tool, which a spec does not say. The errors of a frame are those of the \
                  tool as the workpiece sees it: errors of a slide that carries the workpiece, as the bed sees them, have \
                  the opposite signs.";
    let section = Section::full("Errors of the axes by ISO 230-1").table(Table::new("", columns).rows(rows));
    if report.iso_axes.is_empty() {
        return section;
    }
    let sign = report.iso_axes.iter().any(|axis| axis.carries_workpiece).then(|| {
        "ISO 230-1 states the error of an axis that carries the workpiece as seen from the part that \
         carries it: the error of the frame has the opposite sign."
            .to_owned()
    });
    section.state("slides_carry_the_tool", slides.to_owned()).state("workpiece_signs", sign)
}

fn identifiability(report: &Report) -> Section {
    let section = Section::full("Identifiability");
    if report.laws.is_empty() {
        return section;
    }
    let (counted, configurations) = (&report.identifiable, report.identifiability_configurations);
    let find = |measurement: &str, base: bool| {
        let counted = counted.iter().find(|way| way.measurement == measurement && way.base == base);
        match counted.map(|way| (way.rank, way.unknowns, &way.reason)) {
            Some((Some(rank), unknowns, _)) => format!("{rank} of {unknowns}"),
            Some((None, unknowns, reason)) => format!("an unknown number ({reason}) of {unknowns}"),
            None => String::new(),
        }
    };
    let (pose, pose_base) = (find("pose", false), find("pose", true));
    let (point, point_base) = (find("point", false), find("point", true));
    let text = format!(
        "Identifiable generalized errors of the frames: {pose} from poses (or three targets), \
         {point} from tool points alone; with an unknown base frame {pose_base} and {point_base}. \
         The others are linear combinations of these. Rank of the identification Jacobian over \
         {configurations} configurations with all joints moved.",
    );
    section.state("identifiable", text)
}

fn laws(report: &Report) -> Section {
    let rows = report.laws.iter().map(|law: &Law| {
        let slope = law.expected != 0.0;
        let value = match law.value {
            Some(0.0) => "0".to_owned(),
            Some(value) if slope => format!("{value:.4}"),
            Some(value) => format!("{value:.1e}"),
            None => String::new(),
        };
        let bound = if slope {
            format!("{} ± {}", law.expected, law.tolerance)
        } else {
            format!("at most {:.0e}", law.tolerance)
        };
        let verdict = if law.holds { "holds" } else { "FAILS" };
        [law.law.to_owned(), value, bound, verdict.to_owned()]
    });
    let caption = format!("At {} configurations", report.configurations);
    Section::full("Laws").table(Table::new(caption, ["law", ">found", ">expected", ""]).rows(rows))
}
