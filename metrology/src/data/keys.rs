//! Keys of a map.

use abbe::identify::{INSTRUMENTS, InstrumentKind};
use abbe_spec::keys::Then::{Needs, NeedsOne, Refuses};
use abbe_spec::keys::Value::{self, Choice, Either, List, Names, Number, Table, Tables, Text};
use abbe_spec::keys::When::{Always, Has, Is, Lacks};
use abbe_spec::keys::{Rule, words};

use super::choices::{
    BASES, COMMANDS, INTRINSIC_CHOICES, JUDGED_TARGETS, MOUNTS, PLACEMENTS, QUATERNION_ORDERS, UNKNOWN,
};
use super::{target_frame::TARGET_FRAMES, turn::EULER_ORDERS};

const TEXT: Value = Text("text");
const NUMBER: Value = Number("number");
const COLUMN: Value = Text("name of a column");
const COLUMNS: Value = List("three names of columns", Some(3), &COLUMN);
const LENGTH_UNIT: Value = Text("unit of length");
const VECTOR: Value = List("three numbers", Some(3), &NUMBER);
const CORNER: Value = Either("two or three numbers", &[List("two numbers", Some(2), &NUMBER), VECTOR]);
const QUATERNION_VALUE: Value = List("four numbers, w x y z", Some(4), &NUMBER);
const MATRIX: Value = List("rows of numbers", None, &List("", None, &NUMBER));
const MAYBE: Value = Either("number, or `\"unknown\"`", &[NUMBER, Choice(|| words(&UNKNOWN))]);
const DEVIATION: Value = Either("number, positive, or `\"unknown\"`", &[NUMBER, Choice(|| words(&UNKNOWN))]);

/// Keys of an instrument that can be left out.
const OPTIONAL: [&str; 10] = [
    "target",
    "zero",
    "nominal_radius",
    "range",
    "board",
    "pitch",
    "corners",
    "center",
    "distortion",
    "intrinsics",
];

abbe_spec::tables! {
    FILE: ["the file"], [
        "data": Table("[data]"), "-", "required", "Name of the data and uncertainty of the instrument";
        "joints": Names("table of `VARIABLE = …`", &Table("[joints.NAME]")), "-", "one of the two",
            "Columns of the joint variables, or their constant values; every variable needs one";
        "command_pose": Table("[pose]"), "-", "one of the two",
            "Columns of the pose of the tool that the controller shows, with the keys of `[pose]`, where it gives no joints";
        "inputs": Names("table of `INPUT = …`", &Table("[inputs.NAME]")), "-", "the nominal values",
            "Columns of the inputs, or their constant values";
    ]
    FORMS: ["the file"], [
        "point": Table("[point]"), "-", "one of these", "Columns of the measured tool point";
        "difference": Table("[difference]"), "-", "one of these",
            "Columns of the commanded tool point, and of commanded minus actual";
        "target": Tables("[[target]]"), "-", "one of these",
            "Three or more measured targets on the end effector; beside `[[instrument]]`, the targets that it observes";
        "pose": Table("[pose]"), "-", "one of these", "Columns of the measured position and orientation of the tool";
        "instrument": Tables("[[instrument]]"), "-", "one of these",
            "Instruments with readings of their own, such as ballbars and indicators; several in one file";
    ]
    STANDS: ["the file"], [
        "station": Tables("[[station]]"), "-", "as `base` says",
            "Identified pose of the machine in the frame of the instrument";
        "placement": Either("table, or one for each station: `[[placement]]`", &[Table("[placement]"), Tables("[placement]")]), "-", "as designed",
            "Identified position of the targets, or of the measured frame, on the tool";
        "place": Tables("[[place]]"), "-", "about where `[[instrument]]` says",
            "Identified position, direction and zero of an instrument";
        "distance": Tables("[[distance]]"), "-", "none",
            "Known distances between the points of instruments, such as a bar between two nests: they give the machine its scale";
        "accept": Table("[accept]"), "-", "no limits",
            "Limits for the errors of the machine in `measure`, and for those of the identified model in `identify`; without any, there is no verdict";
        "sight": Table("[sight]"), "-", "unobstructed",
            "Line of sight of the instrument: `plan` and `simulate --samples` take configurations alone in which it sees the targets";
        "record": Table("[record]"), "-", "nothing stated",
            "Statements about the run for the pages of `measure`, `identify`, `monitor` and `compensate`";
    ]
    DATA: ["[data]"], [
        "title": TEXT, "-", "empty", "Name of the data in reports";
        "description": TEXT, "-", "empty", "Description of the data, for people";
        "reference": TEXT, "-", "empty", "Origin of the data";
        "uncertainty": DEVIATION, "length unit", "required without `[[instrument]]`",
            "Standard deviation of one measured coordinate, as the data sheet of the instrument states it; `\"unknown\"`: `identify` estimates it from the data";
        "angle_uncertainty": DEVIATION, "rad", "required for `[pose]`",
            "Standard deviation of a measured rotation; `\"unknown\"`: `identify` estimates it from the data";
        "base": Choice(|| words(&BASES)), "-", "`\"known\"`",
            "Pose of the instrument: in `F_0` but for small errors, anywhere, or exactly in `F_0`";
        "commands": Choice(|| words(&COMMANDS)), "-", "`\"programmed\"`",
            "Joint values of the rows: those of the program, at which `measure` judges the errors from the ideal machine, or those that the controller or `compensate` made of them, at which the machine with the errors of its spec should be where the program meant";
        "group": COLUMN, "-", "rows with the same joints and inputs",
            "Column that identifies the visits of one configuration. Folds, degrees of freedom and uncertainties count configurations, not rows. Without it, rows belong together whose angles differ by at most 0.1 mrad, travels by 0.01 mm, and inputs by 1 % of their range";
        "direction": COLUMN, "-", "not known",
            "Column of the direction or path of approach, any text: `measure` then states the multi-directional variation of ISO 9283";
        "time": COLUMN, "-", "the order of the rows",
            "Column of the time of a row: a number in any unit, or a date such as `2026-03-14` with or without a time. The drift test sorts residuals by this time; `monitor` takes the rows of a day as one check";
        "station": COLUMN, "-", "all rows at one station",
            "Column of the name of the station: each station has its own pose, with `placement = \"per station\"` also its own target or tool, and all share the machine";
        "placement": Choice(|| words(&PLACEMENTS)), "-", "`\"unknown\"`",
            "Position of the targets, or of the measured frame, on the tool: near the nominal one, exactly there, or near the nominal one and another at each station, where the tool was changed or the target mounted anew. Unless it is exact, errors that act as a displacement of the targets are attributed to it, never to the machine";
        "target_frame": Choice(|| words(&TARGET_FRAMES)), "-", "`\"tool\"`",
            "Frame of the positions of targets in `[[target]]` and `[placement]`: that of the tool, with which `--set` moves them, or `flange`, the last frame before the tool, to which they are fixed wherever the tool point is";
        "setup": COLUMN, "-", "none", "Column of the number of the setup, which decides which instruments were read in a row";
    ]
    SIGHT: ["[sight]"], [
        "from": VECTOR, "length unit", "required", "Position of the instrument in `F_0`, at least about";
        "looks": VECTOR, "1", "everywhere", "Direction in `F_0` about which the instrument sees";
        "field": NUMBER, "rad", "`\"90 deg\"`, a half-space", "Largest angle between `looks` and the line to a target";
        "faces": VECTOR, "1", "everywhere", "Direction in the frame of the tool from which its targets are seen";
        "within": NUMBER, "rad", "`\"90 deg\"`, a half-space", "Largest angle between `faces` and the line to the instrument";
    ]
    CHANNEL: ["[joints.NAME]", "[inputs.NAME]"], [
        "column": COLUMN, "-", "required without `value`", "Heading of the column";
        "unit": Text("unit"), "-", "required without `value`", "Unit of the column's numbers; `1` is a pure number, `360 deg/4096` the size of a count";
        "sign": Number("`1` or `-1`"), "1", "`1`", "`-1` if the file counts the joint in the opposite direction";
        "zero": NUMBER, "length unit or rad; of inputs as the spec's", "`0`",
            "Value of the joint or input at which the column is 0; it is added after unit and sign";
        "value": NUMBER, "length unit or rad; of inputs as the spec's", "one of the two", "Constant value in every row";
    ]
    FROM_ROWS: ["[inputs.NAME]"], [
        "approach": Text("name of a variable"), "-", "one of the two",
            "Joint whose last move gives the input: 1 if it was forward, -1 if it was back, 0 before the first move";
        "gravity_moment": Text("name of a variable"), "-", "one of the two",
            "Revolute joint whose moment of gravity gives the input: 1 if it acts forward, -1 if it acts back, 0 if there is none";
        "frame": Text("name of a frame"), "-", "the tool point",
            "Frame whose origin carries the weight of `gravity_moment`: the frame of the joint or a later one";
    ]

    POINT: ["[point]"], [
        "columns": COLUMNS, "-", "required", "Headings of the columns of x, y and z";
        "unit": LENGTH_UNIT, "-", "required", "Unit of their numbers";
    ]
    DIFFERENCE: ["[difference]"], [
        "target": COLUMNS, "-", "required", "Columns of the commanded tool point";
        "difference": COLUMNS, "-", "required", "Columns of commanded minus actual";
        "unit": LENGTH_UNIT, "-", "required", "Unit of all six columns";
    ]
    TARGET: ["[[target]]"], [
        "name": TEXT, "-", "required beside `[[instrument]]`", "Name of the target, by which instruments refer to it";
        "columns": COLUMNS, "-", "required without `[[instrument]]`", "Headings of the columns of x, y and z";
        "unit": LENGTH_UNIT, "-", "required without `[[instrument]]`", "Unit of their numbers";
        "position": Either("three numbers, or `\"unknown\"`", &[VECTOR, Choice(|| words(&UNKNOWN))]), "length unit", "required",
            "Nominal position in the frame of the tool, or in that of `target_frame`; `\"unknown\"`: `identify` and `measure` find it from the rows, anywhere on the tool";
    ]
    ANY_INSTRUMENT: ["[[instrument]]"], [
        "name": TEXT, "-", "required", "Name of the instrument in reports, and of its unknowns: `bar_x`";
        "kind": Choice(|| INSTRUMENTS.map(|kind| kind.name).to_vec()), "-", "required", "Quantity that it measures";
    ]
    INSTRUMENT: ["[[instrument]]"], [
        "column": COLUMN, "-", "required where one number is read", "Heading of the column of its readings";
        "columns": COLUMNS, "-", "required for `\"point\"`", "Headings of the columns of x, y and z";
        "unit": Text("unit"), "-", "required where anything is read", "Unit of its readings";
        "target": Text("name of a target"), "-", "the first target; the tool point, if there is none", "Target that it observes";
        "targets": List("two names of targets", Some(2), &TEXT), "-", "required for `\"between\"`", "The two targets whose distance it measures";
        "at": VECTOR, "length unit", "required where the table says so; a `contact` without it is where the machine as specified has its target", "Approximate position of the instrument in `F_0`";
        "direction": VECTOR, "1", "required where the table says so",
            "Approximate direction in `F_0`: along an indicator, or normal to a plane";
        "mirror": VECTOR, "1", "required for `\"angle\"`", "Normal of the mirror in the frame of the tool";
        "zero": MAYBE, "length unit", "`0`", "Reading minus true value of a `\"distance\"` or `\"between\"`";
        "radius": MAYBE, "length unit", "required for `\"sphere\"`", "Distance of the target from the centre of the sphere when it touches";
        "nominal_radius": NUMBER, "length unit", "`0`",
            "Approximate radius of a sphere with `radius = \"unknown\"`: start value of the fit, and target of `plan` and `simulate`";
        "range": List("two numbers", Some(2), &NUMBER), "unit of its readings", "none: it can be read anywhere",
            "Least and largest reading for which `plan` and `simulate` use it";
    ]
    BOARD: ["[[instrument]]"], [
        "mount": Choice(|| words(&MOUNTS)), "-", "required for `\"camera\"`",
            "Place of the camera: on the tool, with the board in the room; or in the room, with the board on the tool";
        "pixels": List("two texts", Some(2), &TEXT), "-", "required for `\"camera\"`",
            "Beginnings of the headings of its pixels: `u1`, `v1` of the first corner, and so on; cells of corners that were not found are empty";
        "board": List("two numbers", Some(2), &NUMBER), "1", "one of the two",
            "Inner corners of a chessboard: number in a row, and number of rows; the corners are numbered row by row, as OpenCV does";
        "pitch": NUMBER, "length unit", "required for `board`", "Distance of neighbouring corners";
        "corners": List("two or three numbers for each corner", None, &CORNER), "length unit", "one of the two",
            "Positions of the corners on the board, such as those of its tags: x, y, and z unless it is flat";
        "image": List("two numbers", Some(2), &NUMBER), "px", "required for `\"camera\"`",
            "Width and height of the image; a row with a corner outside is not used";
        "focal": List("two numbers", Some(2), &NUMBER), "px", "required for `\"camera\"`", "Focal lengths fx and fy";
        "center": List("two numbers", Some(2), &NUMBER), "px", "the middle of the image",
            "Principal point cx and cy; the center of the first pixel is at (0, 0), as for OpenCV";
        "distortion": List("five numbers", Some(5), &NUMBER), "1", "none", "Distortion k1 k2 p1 p2 k3, in the order of OpenCV";
        "intrinsics": Choice(|| words(&INTRINSIC_CHOICES)), "-", "`\"known\"`",
            "`focal`, `center` and `distortion`: as stated, or near the stated values and fitted with the machine";
    ]
    EVERY_INSTRUMENT: ["[[instrument]]"], [
        "setup": NUMBER, "1", "none: it is read in all rows", "Number in the column `setup` of the rows in which it is read";
        "uncertainty": DEVIATION, "length unit, rad or px", "required without that of `[data]`",
            "Standard deviation of a reading, or of the distance when it touches; `\"unknown\"`: estimated from the data";
    ]
    POSE: ["[pose]"], [
        "position": COLUMNS, "-", "required", "Columns of the tool point";
        "unit": LENGTH_UNIT, "-", "required", "Unit of their numbers";
    ]
    TURN: ["[pose]"], [
        "quaternion": Table("[pose.quaternion]"), "-", "one of these", "Columns of a unit quaternion";
        "matrix": List("nine names of columns", Some(9), &COLUMN), "-", "one of these", "Columns of the rotation matrix, row by row";
        "euler": Table("[pose.euler]"), "-", "one of these", "Columns of three angles";
        "rotation_vector": Table("[pose.rotation_vector]"), "-", "one of these",
            "Columns of the axis times the angle, as the pendant of a UR shows it";
    ]
    QUATERNION: ["[pose.quaternion]"], [
        "columns": List("four names of columns", Some(4), &COLUMN), "-", "required", "Headings of its columns, in the order of `order`";
        "order": Choice(|| words(&QUATERNION_ORDERS)), "-", "required", "Order of the columns: the scalar w first or last";
    ]
    EULER: ["[pose.euler]"], [
        "columns": COLUMNS, "-", "required", "Columns of the three angles, in the order of the product";
        "order": Choice(|| words(&EULER_ORDERS)), "-", "required",
            "Axes of the product: `\"zyx\"` is `Rz(first) Ry(second) Rx(third)`. Angles about fixed axes are the same product from the last to the first";
        "unit": Text("unit of angle"), "-", "required", "Unit of the angles";
    ]
    ROTATION_VECTOR: ["[pose.rotation_vector]"], [
        "columns": COLUMNS, "-", "required", "Columns of x, y and z";
        "unit": Text("unit of angle"), "-", "required", "Unit of its length";
    ]

    STATION: ["[[station]]"], [
        "name": TEXT, "-", "empty", "Text in the column of stations; empty if there is only one";
        "position": VECTOR, "length unit", "required", "Position of the origin of `F_0` in the frame of the instrument";
        "quaternion": QUATERNION_VALUE, "1", "required", "Orientation of `F_0` in the frame of the instrument";
        "covariance": List("six rows of six numbers", Some(6), &List("", Some(6), &NUMBER)), "length unit and rad", "none",
            "Covariance of `e_x e_y e_z e_s e_r e_p` at `F_0`; not used by any command";
    ]
    PLACE: ["[[place]]"], [
        "name": TEXT, "-", "required", "Name of the instrument";
        "position": VECTOR, "length unit", "required of an instrument that observes a point", "Position of that point in `F_0`";
        "direction": VECTOR, "1", "required of an instrument that observes a direction", "Direction in `F_0`";
        "zero": NUMBER, "length unit or rad", "required where the zero is not known", "Reading minus true value; minus the radius of a sphere";
        "intrinsics": List("nine numbers", Some(9), &NUMBER), "px and 1", "required of a camera with `intrinsics = \"fitted\"`",
            "Fitted fx fy cx cy k1 k2 p1 p2 k3";
        "covariance": MATRIX, "length unit and rad", "none",
            "Covariance of x, y, z of the position or of the two tilts of the direction, and of the zero; not used by any command";
    ]
    DISTANCE: ["[[distance]]"], [
        "between": List("two names of instruments", Some(2), &TEXT), "-", "required", "The two instruments whose points are this far apart: each a `\"contact\"`, `\"distance\"` or `\"sphere\"`";
        "value": NUMBER, "length unit", "required", "Their distance, positive";
        "uncertainty": Number("number, positive"), "length unit", "required", "Standard deviation of that distance, from its certificate";
    ]
    ACCEPT: ["[accept]"], [
        "mean": NUMBER, "length unit", "no limit", "Limit of the mean position error";
        "rms": NUMBER, "length unit", "no limit", "Limit of the root mean square of the position error";
        "p95": NUMBER, "length unit", "no limit", "Limit of the 95th percentile of the position error";
        "max": NUMBER, "length unit", "no limit", "Limit of the largest position error";
        "target": Choice(|| words(&JUDGED_TARGETS)), "-", "`\"stated\"`", "The place of a target on the tool: `\"fitted\"` permits one that the map does not state, and is fitted to the judged rows";
    ]
    RECORD: ["[record]"], [
        "date": TEXT, "-", "not stated", "Date of the measurement, optionally with a time: `2026-03-14`";
        "operator": TEXT, "-", "not stated", "Person who measured";
        "machine": TEXT, "-", "not stated", "Machine that was measured";
        "serial": TEXT, "-", "not stated", "Serial number of the machine";
        "instrument": TEXT, "-", "not stated", "Instrument, with its own serial number";
        "certificate": TEXT, "-", "not stated", "Number and date of the calibration certificate of the instrument";
    ]
    PLACEMENT: ["[placement]"], [
        "targets": List("three numbers for each target", None, &VECTOR), "length unit", "required for points",
            "Positions of the targets in the frame of the tool or of `target_frame`, instead of the nominal ones";
        "position": VECTOR, "length unit", "required for poses", "Position of the measured frame in the frame of the tool";
        "quaternion": QUATERNION_VALUE, "1", "required for poses", "Orientation of the measured frame in the frame of the tool";
        "covariance": MATRIX, "length unit and rad", "none",
            "Covariance of all coordinates of the targets, or of the six errors of the frame; not used by any command";
    ]
    PLACEMENT_OF_STATION: ["[placement]"], [
        "station": Text("name of a station"), "-", "required in `[[placement]]`", "Station with this placement, if `placement` in `[data]` is `\"per station\"`";
    ]
}

/// Returns the keys that the table of an instrument of this kind must have, beside those that all
/// have.
pub fn required_keys(kind: &InstrumentKind) -> Vec<&'static str> {
    let found = |key: &&str| kind.finds_position && *key == "at";
    kind.keys.iter().copied().filter(|key| !OPTIONAL.contains(key) && !found(key)).collect()
}

/// Returns the relations between the keys of a map.
pub fn rules() -> Vec<Rule> {
    let rule = |table, when, then| Rule { table, when, then };
    let mut rules = vec![
        rule("the file", Always, NeedsOne(FORMS.names().collect())),
        rule("the file", Always, NeedsOne(vec!["joints", "command_pose"])),
        rule(
            "the file",
            Lacks(vec!["instrument"]),
            Needs(vec!["data.uncertainty", "target[].columns", "target[].unit"]),
        ),
        rule("the file", Has("instrument"), Needs(vec!["target[].name"])),
        rule("the file", Has("instrument"), Refuses(vec!["target[].columns", "target[].unit"])),
        rule("the file", Lacks(vec!["data.uncertainty"]), Needs(vec!["instrument[].uncertainty"])),
        rule(
            "the file",
            Has("pose"),
            Needs(vec![
                "data.angle_uncertainty",
                "placement.position",
                "placement.quaternion",
                "placement[].position",
                "placement[].quaternion",
            ]),
        ),
        rule("the file", Always, Needs(vec!["placement[].station"])),
        // A camera has the pose of the measured frame there, as `[pose]` has.
        rule(
            "the file",
            Lacks(vec!["pose", "instrument"]),
            Needs(vec!["placement.targets", "placement[].targets"]),
        ),
        rule("[joints.NAME]", Lacks(vec!["value"]), Needs(vec!["column", "unit"])),
        rule(
            "[inputs.NAME]",
            Lacks(vec!["value", "approach", "gravity_moment"]),
            Needs(vec!["column", "unit"]),
        ),
        rule("[pose]", Always, NeedsOne(TURN.names().collect())),
    ];
    for key in FROM_ROWS.names() {
        rules.push(rule("[inputs.NAME]", Has(key), Refuses(CHANNEL.names().collect())));
    }
    for kind in INSTRUMENTS {
        let of_kind = || Is("kind", kind.name);
        let others = INSTRUMENT.names().chain(BOARD.names()).filter(|key| !kind.has(key)).collect();
        let required = required_keys(kind);
        if !required.is_empty() {
            rules.push(rule("[[instrument]]", of_kind(), Needs(required)));
        }
        rules.push(rule("[[instrument]]", of_kind(), Refuses(others)));
    }
    rules
}
