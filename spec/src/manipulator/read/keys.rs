//! Keys of a spec file.
//!
//! Words of a spec file that stand for one of a few values.

use abbe_core::{Class, Component, Distribution, LengthUnit, Orientation, VariableKind};

use crate::expr::{Extrapolation, Interpolation};
use crate::keys::Value::{self, Boolean, Choice, Either, List, Names, Number, Table, Tables, Text};
use crate::keys::{Rule, Then, When, words};
use crate::manipulator::{Axes, Beam, Closure};

const NUMBER: Value = Number("number");
const EXPRESSION: Value = Number("expression");
const SAMPLES: Value =
    Either("numbers, or a table as below", &[List("numbers", None, &NUMBER), Table("[tables.NAME.x]")]);
const ROWS: Value = List("rows of numbers", None, &List("numbers", None, &NUMBER));

crate::tables! {
    FILE: ["the file"], [
        "manipulator": Table("[manipulator]"), "-", "required", "Name and units of the machine";
        "parameters": Names("table", &Either("", &[NUMBER, Table("[parameters.NAME]")])), "-", "none",
            "Lengths and angles of the chain that can be changed at run time";
        "inputs": Names("table", &Either("", &[NUMBER, Table("[inputs.NAME]")])), "-", "none",
            "Quantities that change from use to use, such as a payload or a temperature";
        "tables": Names("table", &Table("[tables.NAME]")), "-", "none", "Functions given by measured points";
        "frame": Tables("[[frame]]"), "-", "required", "Transforms `A_1 … A_n`, from the base to the tip";
        "loop": Tables("[[loop]]"), "-", "none", "Conditions that frames of different branches meet: closed loops";
        "limit": Tables("[[limit]]"), "-", "none", "Limits of sums and differences of joint variables, beside the limits of each";
        "tool": Table("[tool]"), "-", "no tool: the tool point is the origin of `F_n`",
            "Transform from `F_n` to the tool point";
        "source": Tables("[[source]]"), "-", "none", "Physical errors of the machine";
        "load": Tables("[[load]]"), "-", "none", "Masses, forces and moments that bend beams and compliances";
        "gravity": List("three numbers", Some(3), &EXPRESSION), "none: give one", "none",
            "Acceleration of gravity along x, y, z of `F_0`; the same as `gravity` in `[manipulator]`";
        "fitted": Names("table of `NAME = [LOWER, UPPER]`", &List("two numbers", Some(2), &NUMBER)), "-", "none",
            "Ranges of joints and inputs in which `identify` fitted the errors; `measure`, `compensate` and `analyze` warn beyond them";
        "covariance": Table("[covariance]"), "-", "not known", "Covariance of the errors that `identify` fitted";
    ]
    MANIPULATOR: ["[manipulator]"], [
        "name": Text("name in lower case"), "-", "required", "Name of the module and the type in generated code";
        "title": Text("text"), "-", "`name`", "Name of the machine in reports";
        "description": Text("text"), "-", "empty", "Description of the machine, for people";
        "reference": Text("text"), "-", "empty", "Origin of the numbers, such as a drawing or a data sheet";
        "length": Choice(|| words(&LENGTHS)), "-", "required",
            "Unit of every length: in this file, in generated code and in results";
        "orientation": Choice(|| words(&ORIENTATIONS)), "-", "`\"rotation-vector\"`",
            "Meaning of rows 4 to 6 of `J_e`: a rotation vector, Euler angles about y, z, x, or the table angles of IEC 61217: yaw about z, pitch about x, roll about y";
        "gravity": List("three expressions", Some(3), &EXPRESSION), "none: give one", "none; loads need it",
            "Acceleration of gravity along x, y, z of `F_0`";
    ]
    PARAMETER: ["[parameters.NAME]"], [
        "value": NUMBER, "length unit, rad or 1; others must be written", "required",
            "Nominal value; its unit decides whether it is a length, an angle or another quantity";
        "description": Text("text"), "-", "empty", "Description of the parameter, for people";
        "reference": Text("text"), "-", "empty", "Origin of the value";
    ]
    INPUT: ["[inputs.NAME]"], [
        "value": NUMBER, "length unit, rad or 1; others must be written", "required", "Nominal value";
        "range": List("two numbers", Some(2), &NUMBER), "as `value`", "no limits", "Lower and upper limit";
        "levels": List("numbers", None, &NUMBER), "as `value`", "any value in the range", "Values that are used, such as payloads of 0 and 8 kg: samples, and studies and plans that name no others, take these alone";
        "uncertainty": Number("number, positive"), "as `value`", "none: the value is exact",
            "Standard uncertainty of the value in use, such as that of a load cell: a normal random source named `uncertainty of NAME`";
        "description": Text("text"), "-", "empty", "Description of the input, for people";
        "reference": Text("text"), "-", "empty", "Origin of the value and the range";
    ]

    LOOKUP: ["[tables.NAME]"], [
        "file": Text("path of a CSV file, from the folder of the spec"), "-", "the points are here",
            "File of the points: a line of column names, then rows; lines that begin with `#` are comments";
        "x": SAMPLES, "length unit, rad or 1; others must be written", "required",
            "Points at which the function was measured, in rising or falling order";
        "y": SAMPLES, "as `x`", "required", "Measured values, one for each `x`";
        "interpolation": Choice(|| words(&INTERPOLATIONS)), "-", "required",
            "Curve between the points: straight lines, or monotone cubics";
        "outside": Choice(|| words(&OUTSIDE)), "-", "an error",
            "Values beyond the first and the last point: `\"hold\"` keeps those of the ends";
        "description": Text("text"), "-", "empty", "Description of the function, repeated in generated code";
        "reference": Text("text"), "-", "empty", "Origin of the points";
    ]
    AXIS: ["[tables.NAME.x]", "[tables.NAME.y]"], [
        "column": Text("text"), "-", "required with `file`", "Heading of the column";
        "values": List("numbers", None, &NUMBER), "`unit`", "required without `file`", "The numbers";
        "unit": Text("unit"), "-", "a pure number", "Unit of the numbers";
    ]

    FRAME: ["[[frame]]"], [
        "name": Text("text in one line"), "-", "required", "Name of the frame, by which sources refer to it; must be unique";
        "parent": Text("name of an earlier frame, or `base`"), "-", "the frame before it",
            "Frame that it hangs on: where its transform begins. `base` is `F_0`";
        "variable": Table("[frame.variable]"), "-", "none: the frame is fixed", "Joint variable that moves the frame";
    ]
    TOOL_FRAME: ["[tool]"], [
        "frame": Text("name of a frame"), "-", "the last frame of the first chain, before any `parent`", "Frame that carries the tool";
    ]
    DESCRIBED: ["[[frame]]", "[tool]"], [
        "description": Text("text"), "-", "empty", "Description, for people";
        "reference": Text("text"), "-", "empty", "Origin of the numbers";
    ]
    TRANSFORM: ["[[frame]]", "[tool]"], [
        "transform": Text("product of motions in one text"), "length unit or rad", "one of these",
            "Motions from left to right, such as `Rz(q1) Tz(300)`: `Tx Ty Tz` translate along an axis, `Rx Ry Rz` rotate about one";
        "matrix": List("four rows of four expressions", Some(4), &List("", Some(4), &EXPRESSION)),
            "length unit in the last column", "one of these",
            "Homogeneous 4 × 4 matrix; it must be a rigid motion for all values of its names";
        "dh": Table("[frame.dh]"), "-", "one of these",
            "Standard Denavit-Hartenberg numbers: `Rz(theta) Tz(d) Tx(a) Rx(alpha)`";
        "mdh": Table("[frame.mdh]"), "-", "one of these",
            "Modified (Craig's) Denavit-Hartenberg numbers: `Rx(alpha) Tx(a) Rz(theta) Tz(d)`";
        "origin": Table("[frame.origin]"), "-", "one of these",
            "Origin of a URDF joint; the variable moves the frame along or about `axis`";
        "axis": List("three numbers of length 1", Some(3), &NUMBER), "1", "`[1, 0, 0]`",
            "Axis of the variable, in the frame given by `origin`";
    ]
    VARIABLE: ["[frame.variable]", "[loop.variable]"], [
        "name": Text("name"), "-", "required", "Name of the variable in expressions, commands and files";
        "kind": Choice(|| words(&JOINT_KINDS)), "-", "required", "Kind of joint: an angle or a length";
        "limits": List("two numbers", Some(2), &NUMBER), "length unit or rad", "no limits", "Lower and upper joint limit";
        "home": NUMBER, "length unit or rad", "`0`", "Value in the home position, within the limits";
        "description": Text("text"), "-", "empty", "Description of the joint, for people";
    ]
    FRAME_VARIABLE: ["[frame.variable]"], [
        "passive": Boolean, "-", "`false`", "`true` for a joint without a drive, which the loops determine";
    ]
    LIMIT: ["[[limit]]"], [
        "sum": EXPRESSION, "length unit or rad", "required", "Sum or difference of joint variables, such as `a2 + a3`, each with a constant factor or without";
        "limits": List("two numbers", Some(2), &NUMBER), "length unit or rad", "one of the two", "Smallest and largest sum that the machine permits";
        "equals": NUMBER, "length unit or rad", "one of the two", "Value of the sum, where joints move together";
    ]
    LOOP: ["[[loop]]"], [
        "name": Text("text in one line"), "-", "required", "Name of the loop; must be unique";
        "frames": List("two names of frames", Some(2), &Text("name of a frame, or `base`")), "-", "required",
            "The two frames that meet, or between which the length is";
        "closes": Either("`\"point\"`, `\"pose\"`, `\"distance\"`, or a list of coordinates",
            &[Choice(|| words(&CLOSURES)), List("", None, &Choice(|| Closure::COORDINATES.to_vec()))]), "-", "required",
            "What closes: the origins meet, the poses meet, the origins have a distance; or some coordinates of the first frame's pose relative to the second's are zero: the position `x`, `y`, `z` and the rotation `rx`, `ry`, `rz` along and about the axes of the second frame's parent";
        "length": EXPRESSION, "length unit", "required for a distance", "Distance of the two origins: a leg or strut";
        "variable": Table("[loop.variable]"), "-", "none: a strut", "Joint variable of a leg, for `length`";
        "description": Text("text"), "-", "empty", "Description of the loop, for people";
        "reference": Text("text"), "-", "empty", "Origin of the numbers";
    ]
    DENAVIT_HARTENBERG: ["[frame.dh]", "[frame.mdh]"], [
        "theta": EXPRESSION, "rad", "required", "Rotation about z";
        "d": EXPRESSION, "length unit", "required", "Translation along z";
        "a": EXPRESSION, "length unit", "required", "Translation along x";
        "alpha": EXPRESSION, "rad", "required", "Rotation about x";
    ]
    ORIGIN: ["[frame.origin]"], [
        "xyz": List("three expressions", Some(3), &EXPRESSION), "length unit", "`[0, 0, 0]`",
            "Position of the frame in the previous one";
        "rpy": List("three expressions", Some(3), &EXPRESSION), "rad", "`[0, 0, 0]`",
            "Roll, pitch and yaw of URDF, in this order: `Rz(yaw) Ry(pitch) Rx(roll)`";
    ]

    SOURCE: ["[[source]]"], [
        "name": Text("text in one line"), "-", "required", "Name of the source, by which studies and options refer to it; must be unique";
        "class": Choice(|| words(&CLASSES)), "-", "required",
            "Repeatable: a known value and sign. Tolerance: one fixed value in each machine, unknown within its bound. Random: another value at each visit of a configuration";
        "distribution": Choice(|| Distribution::ALL.map(Distribution::name).to_vec()), "-", "uniform for a tolerance; random sources must have it",
            "Distribution of a tolerance over machines, or of a random source; its value is the half-width of a uniform or triangular distribution, the amplitude of an arcsine one, the standard deviation of a normal one, or the semi-axis of a disc or ball, in which two or three errors of a frame are evenly distributed together";
        "degrees_of_freedom": Number("number, positive"), "1", "none: the standard deviation is known",
            "Degrees of freedom of the standard deviation of a normal source, if it was estimated: n − 1 for n readings";
        "enabled": Boolean, "-", "`true`", "Includes the source; `--enable` and `--disable` change it for a run";
        "scale": Number("number from 0"), "1", "`1`", "Factor of all errors of the source, which `abbe allocate` writes; `--scale` multiplies it";
        "magnitude": Table("[source.magnitude]"), "-", "none",
            "Factor of the source and its uncertainty; `identify` fits it together with the errors of the frames";
        "description": Text("text"), "-", "empty", "Description of the error, for people";
        "reference": Text("text"), "-", "empty", "Origin of the value, such as a data sheet or a measurement";
        "effect": Tables("[[source.effect]]"), "-", "none: the effect stands in the source",
            "Effects on several frames; those of a random source share one random number";
    ]
    PLACE: ["[[source]]", "[[source.effect]]"], [
        "frame": Text("name of a frame"), "-", "required without `joint` and `parameter`", "Frame that has the error; `\"base\"` is `F_0`, unless a frame has this name";
        "at": Text("product of motions in one text"), "length unit or rad", "at the frame itself",
            "Location of the error on the link, as a transform from the frame; the error is in the axes of that location";
    ]
    CAUSE: ["[[source]]", "[[source.effect]]"], [
        "e_x": EXPRESSION, "length unit", "`0`", "Translation along x of the frame";
        "e_y": EXPRESSION, "length unit", "`0`", "Translation along y of the frame";
        "e_z": EXPRESSION, "length unit", "`0`", "Translation along z of the frame";
        "e_s": EXPRESSION, "rad", "`0`", "Spin: rotation about **y** of the frame";
        "e_r": EXPRESSION, "rad", "`0`", "Roll: rotation about **z** of the frame";
        "e_p": EXPRESSION, "rad", "`0`", "Pitch: rotation about **x** of the frame";
        "beam": Table("[source.beam]"), "-", "none", "Beam with the frame at its tip, which bends under the loads beyond it";
        "compliance": Table("[source.compliance]"), "-", "none", "Elastic joint or bearing at the frame, which yields to the loads at it or beyond it";
    ]
    DEVIATION: ["[[source]]", "[[source.effect]]"], [
        "joint": Text("name of a variable"), "-", "none", "Joint that has the `error`, for example of its encoder, gearbox or zero offset, or the `stiffness`";
        "parameter": Text("name of a parameter"), "-", "none", "Parameter with the `error`, wherever it occurs in the chain";
        "error": EXPRESSION, "as the joint or the parameter", "required with `parameter`; with `joint`, this or `stiffness`", "Actual minus nominal value";
        "stiffness": Number("expression, positive"), "none: give one", "rigid",
            "Stiffness of the `joint`, which deviates by the moment of the loads about it (of a slide or leg, the force along it, as in `\"20 N/um\"`), divided by the stiffness";
        "moment": EXPRESSION, "none: give one", "that of the loads",
            "Measured moment (of a slide, force) on an elastic `joint`, for example an input that follows a torque sensor";
        "dh": Table("[source.dh]"), "-", "none", "Errors of the Denavit-Hartenberg numbers of the `frame`";
    ]
    NUMBERS: ["[source.dh]", "[source.effect.dh]"], [
        "theta": EXPRESSION, "rad", "`0`", "Error of theta";
        "d": EXPRESSION, "length unit", "`0`", "Error of d";
        "a": EXPRESSION, "length unit", "`0`", "Error of a";
        "alpha": EXPRESSION, "rad", "`0`", "Error of alpha";
    ]
    MAGNITUDE: ["[source.magnitude]"], [
        "value": NUMBER, "1", "`1`", "Factor of the source";
        "standard_deviation": Number("number, positive"), "1", "none: nothing is known",
            "Standard deviation of `value` before any measurement; `analyze` adds it as a normal random source";
        "degrees_of_freedom": Number("number, positive"), "1", "none: the standard deviation is known",
            "Degrees of freedom of `standard_deviation`, if it was estimated from few measurements";
    ]
    BEAM: ["[source.beam]", "[source.effect.beam]"], [
        "length": Number("expression, positive"), "length unit", "required", "Length from the clamped end to the frame";
        "axis": Choice(|| words(&BEAM_AXES)), "-", "`\"x\"`", "Axis of the frame along which the beam arrives at it";
        "EI_x": Number("expression, positive"), "none: give one", "required unless the beam is along x",
            "Stiffness against bending about x: of a beam along y the deflection along z, along z that along y";
        "EI_y": Number("expression, positive"), "none: give one", "required unless the beam is along y",
            "Stiffness against bending about y: of a beam along x the deflection along z, along z that along x";
        "EI_z": Number("expression, positive"), "none: give one", "required unless the beam is along z",
            "Stiffness against bending about z: of a beam along x the deflection along y, along y that along x";
        "GJ": Number("expression, positive"), "none: give one", "rigid", "Torsional stiffness";
        "EA": Number("expression, positive"), "none: give one", "rigid", "Stiffness against extension";
        "mass_per_length": Number("expression, positive"), "none: give one", "`0`", "Mass per length, which weighs under `gravity`";
    ]
    COMPLIANCE: ["[source.compliance]", "[source.effect.compliance]"], [
        "diagonal": List("six expressions", Some(6), &EXPRESSION), "none: give one", "one of these",
            "Error per force or moment, each along or about its own axis: x, y, z, then about y, z, x";
        "matrix": List("six rows of six expressions", Some(6), &List("", Some(6), &EXPRESSION)), "none: give one", "one of these",
            "Error (row) per force or moment (column), both along x, y, z, then about y, z, x; symmetric";
    ]
    COVARIANCE: ["[covariance]"], [
        "of": Tables("[covariance.of]"), "-", "required", "Errors of the rows and columns";
        "rows": ROWS, "length unit, rad, and 1", "required", "Covariance matrix of these errors; symmetric";
    ]
    COVARIANCE_OF: ["[covariance.of]"], [
        "source": Text("name of a source"), "-", "none", "Source; without `error`, the factor of the whole source, nominally 1";
        "error": Choice(|| Component::ALL.map(Component::name).to_vec()), "-", "required without `source`", "Error of a frame; with a source, the one that it has";
        "frame": Text("name of a frame"), "-", "`F_0`", "Frame that has the error, without a source";
        "joint": Text("name of a joint variable"), "-", "none", "Joint of which the source has an error; its covariance is that of an addend of this error";
    ]
    LOAD: ["[[load]]"], [
        "name": Text("text"), "-", "none", "Name of the load, for people";
        "mass": Number("expression, positive"), "none: give one", "none", "Mass, which weighs under `gravity`";
        "force": List("three expressions", Some(3), &EXPRESSION), "none: give one", "none", "Force that acts at `point`";
        "moment": List("three expressions", Some(3), &EXPRESSION), "none: give one", "none", "Moment";
        "axes": Choice(|| words(&LOAD_AXES)), "-", "`\"frame\"`",
            "Axes of `force` and `moment`: those of the moving frame, or those of `F_0`";
        "frame": Text("name of a frame"), "-", "required", "Frame that carries the load";
        "point": Either("three expressions, or `\"tool\"`", &[List("", Some(3), &EXPRESSION), Choice(|| words(&TOOL))]), "length unit", "the frame's origin",
            "Point of action in that frame; `\"tool\"` is the tool point, with the frame that carries the tool";
        "description": Text("text"), "-", "empty", "Description of the load, for people";
        "reference": Text("text"), "-", "empty", "Origin of the values";
    ]
}

/// Returns the relations between the keys of a spec file.
pub fn rules() -> Vec<Rule> {
    let rule = |table, when, then| Rule { table, when, then };
    let mut rules = vec![
        rule("[tables.NAME]", When::Has("file"), Then::Needs(vec!["x.column", "y.column"])),
        rule("[[frame]]", When::Always, Then::NeedsOne(TRANSFORM.names().collect())),
        rule("[tool]", When::Always, Then::NeedsOne(TRANSFORM.names().collect())),
        rule("[[loop]]", When::Is("closes", "distance"), Then::Needs(vec!["length"])),
        rule("[[source]]", When::Is("class", "random"), Then::Needs(vec!["distribution"])),
        rule("[[source]]", When::Lacks(vec!["joint", "parameter", "effect"]), Then::Needs(vec!["frame"])),
        rule("[[source.effect]]", When::Lacks(vec!["joint", "parameter"]), Then::Needs(vec!["frame"])),
        rule("[[load]]", When::Always, Then::NeedsOne(vec!["mass", "force", "moment"])),
    ];
    for table in ["[[source]]", "[[source.effect]]"] {
        rules.extend([
            rule(table, When::Has("parameter"), Then::Needs(vec!["error"])),
            rule(table, When::Has("joint"), Then::NeedsOne(vec!["error", "stiffness"])),
            rule(table, When::Has("moment"), Then::Needs(vec!["stiffness"])),
        ]);
    }
    for table in BEAM.tables {
        for (word, axis) in BEAM_AXES {
            let whens = [Some(When::Is("axis", word)), (axis == 0).then(|| When::Lacks(vec!["axis"]))];
            for when in whens.into_iter().flatten() {
                let [first, second] = Beam::bending_keys(axis);
                rules.push(rule(table, when.clone(), Then::Needs(vec![first, second])));
                rules.push(rule(table, when, Then::Refuses(vec![["EI_x", "EI_y", "EI_z"][axis]])));
            }
        }
    }
    for table in COMPLIANCE.tables {
        rules.push(rule(table, When::Always, Then::NeedsOne(COMPLIANCE.names().collect())));
    }
    rules
}

pub(super) const LENGTHS: [(&str, LengthUnit); 2] =
    [("mm", LengthUnit::Millimetre), ("m", LengthUnit::Metre)];

pub(super) const ORIENTATIONS: [(&str, Orientation); 3] = [
    ("rotation-vector", Orientation::RotationVector),
    ("euler-yzx", Orientation::EulerYzx),
    ("iec-61217", Orientation::Iec61217),
];

pub(super) const JOINT_KINDS: [(&str, VariableKind); 2] =
    [("revolute", VariableKind::Revolute), ("prismatic", VariableKind::Prismatic)];

pub(super) const INTERPOLATIONS: [(&str, Interpolation); 2] =
    [("linear", Interpolation::Linear), ("cubic", Interpolation::Cubic)];

pub(super) const OUTSIDE: [(&str, Extrapolation); 1] = [("hold", Extrapolation::Hold)];

/// Closures of a loop, each with its coordinates; a distance has none.
pub(super) const CLOSURES: [(&str, &[usize]); 3] =
    [("point", &[0, 1, 2]), ("pose", &[0, 1, 2, 3, 4, 5]), ("distance", &[])];

/// Classes of a source, with a distribution that stands for any.
pub(super) const CLASSES: [(&str, Class); 3] = [
    ("repeatable", Class::Repeatable),
    ("tolerance", Class::Tolerance(Distribution::Uniform)),
    ("random", Class::Random(Distribution::Uniform)),
];

pub(super) const BEAM_AXES: [(&str, usize); 3] = [("x", 0), ("y", 1), ("z", 2)];

pub(super) const LOAD_AXES: [(&str, Axes); 2] = [("frame", Axes::Frame), ("base", Axes::Base)];

pub(super) const TOOL: [(&str, ()); 1] = [("tool", ())];
