//! Keys of a workspace.
//!
//! Words of a workspace that stand for one of a few values.

use abbe::analysis::ToolOrientation;
use abbe_spec::keys::Value::{self, Choice, Either, List, Names, Number, Table, Text, Whole};
use abbe_spec::keys::{Rule, Then, When, words};

const NUMBER: Value = Number("number");
const VARIABLES: Value = List("names of variables", None, &Text("name"));
const ORIENTED: Value = Either("", &[Choice(|| words(&ORIENTATIONS)), Table("[workspace.box.orientation]")]);
/// Values of an axis of a grid.
pub const AXIS: Value =
    Either("values, as in a grid", &[List("numbers", None, &NUMBER), Table("[workspace.grid.NAME]")]);

abbe_spec::tables! {
    WORKSPACE: ["[workspace]"], [
        "presented": Table("[workspace.presented]"), "-", "one of the forms",
            "Tool points, each brought to one point in space by inverse kinematics";
        "grid": Names("table of `NAME = values`", &AXIS), "length unit or rad; of inputs as the spec's", "one of the forms",
            "Every combination of values of variables and inputs; other variables stay at home. With passive variables instead, such as the coordinates of a platform, the lengths of its legs follow";
        "joints": Table("[workspace.joints]"), "-", "one of the forms", "Samples that fill the joint limits evenly, the same in each run";
        "random": Table("[workspace.random]"), "-", "one of the forms", "Random samples within the joint limits";
        "box": Table("[workspace.box]"), "-", "one of the forms", "Grid of points in `F_0`, reached by inverse kinematics from home";
        "path": Table("[workspace.path]"), "-", "one of the forms", "Configurations from a CSV file";
    ]
    BESIDE: ["[workspace]"], [
        "inputs": Names("table of `INPUT = values`", &AXIS), "as the spec's", "both ends of each range",
            "Values of inputs; every configuration is combined with each of them";
    ]
    PRESENTED: ["[workspace.presented]"], [
        "point": List("three numbers", Some(3), &NUMBER), "length unit", "required", "Point in space, in `F_0`";
        "tool_points": Names("table of `PARAMETER = values`", &AXIS), "length unit or rad", "the nominal tool point",
            "Tool points: values of parameters of the tool's transform";
        "approaches": Names("table of `VARIABLE = values`", &AXIS), "length unit or rad", "home", "Values of the variables that are held";
        "solve": VARIABLES, "-", "required", "Variables that bring the tool point there";
    ]
    SAMPLES: ["[workspace.joints]", "[workspace.random]"], [
        "samples": Whole(1, None), "1", "required", "Number of configurations";
        "moved": List("names of variables and inputs", None, &Text("name")), "-", "all variables, and inputs with a range",
            "Variables and inputs to move; other variables stay at home";
    ]
    RANDOM: ["[workspace.random]"], [
        "seed": Whole(0, None), "1", "`0`", "Seed of the samples: the same seed gives the same samples; `--seed` replaces it";
    ]
    BOX: ["[workspace.box]"], [
        "x": AXIS, "length unit", "required", "Coordinates of the points along x of `F_0`";
        "y": AXIS, "length unit", "required", "Coordinates of the points along y of `F_0`";
        "z": AXIS, "length unit", "required", "Coordinates of the points along z of `F_0`";
        "orientation": Either("one orientation, or a list of them", &[ORIENTED, List("orientations", None, &ORIENTED)]), "-", "`\"free\"`",
            "Orientation of the tool at each point: any; that at home; with its z axis down or up, along z of `F_0`, about which it may turn; or as the table says. Each point is reached in each of several";
        "approaches": Names("table of `VARIABLE = values`", &AXIS), "length unit or rad", "home",
            "Values of variables that are held, such as those of a table: each point is reached at each combination";
        "solve": VARIABLES, "-", "all", "Variables that are solved so that the tool reaches the points; the others stay at their home values";
    ]
    ORIENTATION: ["[workspace.box.orientation]"], [
        "x": List("three numbers", Some(3), &NUMBER), "1", "one or two of these, or `quaternion`", "Direction of the x axis of the tool in `F_0`; the tool may turn about a single axis";
        "y": List("three numbers", Some(3), &NUMBER), "1", "as `x`", "Direction of the y axis of the tool in `F_0`";
        "z": List("three numbers", Some(3), &NUMBER), "1", "as `x`", "Direction of the z axis of the tool in `F_0`";
        "quaternion": List("four numbers", Some(4), &NUMBER), "1", "instead of the axes", "Rotation from the axes of `F_0` to those of the tool: w, x, y, z";
    ]
    PATH: ["[workspace.path]"], [
        "file": Text("path, from the folder of the study"), "-", "required",
            "CSV file: a heading such as `d1 (mm),q3 (deg)`, then one configuration in each line. Columns are variables, parameters and inputs; one without a unit is in the length unit or rad; what has no column stays at home";
    ]
    VALUES: ["[workspace.grid.NAME]"], [
        "from": NUMBER, "length unit or rad", "required", "First value";
        "to": NUMBER, "length unit or rad", "required", "Last value";
        "count": Whole(1, None), "1", "one of the two", "Number of values, both ends included";
        "step": Number("number, positive"), "length unit or rad", "one of the two", "Distance of two values; it must lead to `to` exactly";
    ]
}

/// Returns the relations between the keys of a workspace.
pub fn rules() -> Vec<Rule> {
    let one_of =
        |table, keys: Vec<&'static str>| Rule { table, when: When::Always, then: Then::NeedsOne(keys) };
    vec![
        one_of("[workspace]", WORKSPACE.names().collect()),
        one_of("[workspace.grid.NAME]", vec!["count", "step"]),
    ]
}

pub(super) const ORIENTATIONS: [(&str, ToolOrientation); 4] = [
    ("free", ToolOrientation::Free),
    ("home", ToolOrientation::Home),
    ("down", ToolOrientation::Along(2, [0.0, 0.0, -1.0])),
    ("up", ToolOrientation::Along(2, [0.0, 0.0, 1.0])),
];
