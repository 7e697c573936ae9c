//! Keys of a study file, except those of its workspaces.

use abbe_spec::keys::Value::{self, Boolean, Choice, Either, List, Names, Number, Open, Table, Tables, Text};
use abbe_spec::keys::{Keys, Rule, Then, When, words};

use super::choices::{CRITERIA, CombinedFigure, KINDS, Kind, MACHINES, MEASURANDS, Metric, UP_AXES};

const TEXT: Value = Text("text");
const NUMBER: Value = Number("number");
const POSITIVE: Value = Number("number, positive");
const SOURCES: Value = List("names of sources", None, &TEXT);

abbe_spec::tables! {
    FILE: ["the file"], [
        "study": Table("[study]"), "-", "required", "Title, tolerance, and changes of the spec";
        "workspace": Table("[workspace]"), "-", "required", "Configurations in which the manipulator is used";
        "published": Tables("[[published]]"), "-", "none", "Published figures to compare with";
        "compensated": Table("[compensated]"), "-", "none", "Published errors after compensation, to compare with";
        "compensation": Open("[compensation]", &NUMBER), "-", "none", "Residuals of the repeatable sources after compensation";
        "allocation": Names("table of `SOURCE = { … }`", &Table("[allocation.NAME]")), "-", "every factor x costs 1/x", "Costs of the factors of the sources that `abbe allocate` chooses";
        "figure": Tables("[[figure]]"), "-", "the manipulator, the shares of the sources, the cloud, the histogram, and one figure over each variable that moves",
            "Figures of the report";
    ]
    STUDY: ["[study]"], [
        "title": TEXT, "-", "required", "Title of reports";
        "description": TEXT, "-", "empty", "Description of the study, for people";
        "reference": TEXT, "-", "empty", "Origin of the numbers";
        "publisher": TEXT, "-", "empty", "Author of the published figures";
        "criterion": Choice(|| words(&CRITERIA)), "-", "`\"worst-case\"`; `\"probability\"` or `\"yield\"` if the tolerance has one",
            "Criterion of the verdict: the largest error over all signs; the paper's sum, a convention and no bound; the probability; or the share of machines that keep the tolerance at all configurations";
        "tolerance": Either("number, positive; or a table", &[POSITIVE, Table("[study.tolerance]")]), "length unit", "none",
            "Permitted position error of the tool point; a table also limits the orientation error";
        "set": Names("table of `NAME = number`", &NUMBER), "as the spec's", "the spec's values", "Values of parameters and inputs";
        "enable": SOURCES, "-", "none", "Sources to include although the spec has `enabled = false`";
        "disable": SOURCES, "-", "none", "Sources to leave out";
        "not_reproducible": List("texts", None, &TEXT), "-", "none", "Published results that cannot be reproduced, one sentence each";
    ]
    TOLERANCE: ["[study.tolerance]"], [
        "position": POSITIVE, "length unit", "none", "Permitted position error of the tool point";
        "orientation": POSITIVE, "rad", "none", "Permitted norm of rows 4 to 6";
        "probability": Number("number between 0 and 1"), "1", "`0.95`, if it is the criterion",
            "Probability with which the tolerance must be met in every configuration; makes it the criterion";
        "yield": Number("number between 0 and 1"), "1", "`0.95`, if it is the criterion",
            "Share of machines that must keep the tolerance at all configurations, each with the probability above; makes it the criterion";
        "unreachable": Number("share between 0 and 1"), "1", "`0`",
            "Share of the configurations that may be unreachable: with more of them the tolerance is not met";
        "machine": Choice(|| words(&MACHINES)), "-", "`\"compensated\"` if the study has `[compensation]`, else `\"as-built\"`",
            "Machine whose verdict counts, for `--check`, too: with its repeatable errors, or with these corrected";
    ]
    COMPENSATION: ["[compensation]"], [
        "residual": Number("length"), "length unit", "none: by source",
            "Norm of what remains of all repeatable sources together, in place of residuals by source";
        "default": Number("share from 0 to 1, or length"), "1", "`1`: nothing is compensated; `0` if the spec has `[covariance]`",
            "Residual of each repeatable source that is not named: a share of its error, or a length";
    ]
    ALLOCATION: ["[allocation.NAME]"], [
        "cost": POSITIVE, "1", "`1`", "Cost c: the factor x of the source costs c/xᵖ";
        "exponent": POSITIVE, "1", "`1`", "Exponent p of the cost";
        "fixed": Boolean, "-", "`false`", "Leaves the source as it is";
    ]

    FIGURE: ["[[figure]]"], [
        "kind": Choice(|| words(&KINDS)), "-", "required",
            "Kind of figure: error over one variable, worst error over two, errors in space, their histogram, share of each source, or the frames at home";
        "caption": TEXT, "-", "empty", "Caption";
        "paper": TEXT, "-", "empty", "Number of the publisher's figure that it corresponds to";
    ]
    GATHERED: ["[[figure]]"], [
        "source": Text("name of a source"), "-", "all repeatable ones together", "Source whose error is drawn; not for pareto and manipulator";
        "workspace": Table("[workspace]"), "-", "that of the study", "Workspace of this figure; not for pareto and manipulator";
    ]
    ROWS: ["[[figure]]"], [
        "rows": Choice(|| words(&MEASURANDS)), "-", "`\"position\"`", "Position error (rows 1 to 3, in mm) or orientation error (rows 4 to 6, in mrad); figures of kind `manipulator` have none";
    ]
    OVER: ["[[figure]]"], [
        "over": Either("name of a variable, parameter or input; two of them for a surface", &[TEXT, List("", Some(2), &TEXT)]), "-", "required for travel and surface",
            "Variable of the horizontal axis, or of both axes of a surface";
    ]
    UP: ["[[figure]]"], [
        "up": Choice(|| words(&UP_AXES)), "-", "`\"z\"`", "Axis of `F_0` that points up in the drawing of the manipulator";
    ]

    PUBLISHED: ["[[published]]"], [
        "norm": NUMBER, "length unit", "not printed", "Published norm";
        "within": POSITIVE, "length unit", "required", "Largest difference that counts as equal: half of the last printed digit";
        "reference": TEXT, "-", "empty", "Page or table of the figure";
    ]
    OF_A_SOURCE: ["[[published]]"], [
        "source": Text("name of a source"), "-", "one of these", "Source of the figure";
        "metric": Choice(|| words(&Metric::ALL)), "-", "required with `source`", "Meaning of the published number";
        "x": NUMBER, "length unit", "not printed", "Published value along x, with `source`";
        "y": NUMBER, "length unit", "not printed", "Published value along y, with `source`";
        "z": NUMBER, "length unit", "not printed", "Published value along z, with `source`";
    ]
    OF_ALL: ["[[published]]"], [
        "combined": Choice(|| words(&CombinedFigure::ALL)), "-", "one of these", "Figure of all sources together";
    ]
    COMPENSATED: ["[compensated]"], [
        "residual": POSITIVE, "length unit", "required", "Repeatable error after compensation";
        "random": POSITIVE, "length unit", "required", "Random error";
        "total": POSITIVE, "length unit", "required", "Sum of both";
        "reference": TEXT, "-", "empty", "Page or table of the figures";
    ]
}

/// Returns the keys of a kind of figure.
pub(super) fn accepted(kind: Kind) -> &'static [&'static Keys] {
    match kind {
        Kind::Travel | Kind::Surface => &[&GATHERED, &OVER, &ROWS, &FIGURE],
        Kind::Cloud | Kind::Histogram => &[&GATHERED, &ROWS, &FIGURE],
        Kind::Manipulator => &[&UP, &FIGURE],
        Kind::Pareto => &[&ROWS, &FIGURE],
    }
}

/// Returns the relations between the keys of a study.
pub fn rules() -> Vec<Rule> {
    let rule = |table, when, then| Rule { table, when, then };
    let mut rules = vec![
        rule("[study.tolerance]", When::Always, Then::NeedsOne(vec!["position", "orientation"])),
        rule("[[figure]]", When::Is("kind", "travel"), Then::Needs(vec!["over"])),
        rule("[[figure]]", When::Is("kind", "surface"), Then::Needs(vec!["over"])),
        rule("[[published]]", When::Always, Then::NeedsOne(vec!["source", "combined"])),
        rule("[[published]]", When::Has("source"), Then::Needs(vec!["metric"])),
        rule("[[published]]", When::Has("source"), Then::Refuses(OF_ALL.names().collect())),
        rule("[[published]]", When::Has("combined"), Then::Refuses(OF_A_SOURCE.names().collect())),
    ];
    for (word, kind) in KINDS {
        let known = accepted(kind);
        let all = TABLES.iter().filter(|keys| keys.tables == FIGURE.tables).flat_map(|keys| keys.names());
        let others = all.filter(|key| !known.iter().any(|keys| keys.contain(key))).collect();
        rules.push(rule("[[figure]]", When::Is("kind", word), Then::Refuses(others)));
    }
    rules
}
