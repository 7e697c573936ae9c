//! The three-axis machine compared with the textbook closed form of its volumetric error: 18 error
//! functions of ISO 230-1 and three squareness errors, at 1,000 positions.

use std::collections::HashMap;

use abbe::Manipulator;
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_manipulators::machine3::{DESCRIPTION, EFFECTS, ERRORS, FRAMES, Inputs, Machine3, Parameters};
use abbe_spec::Spec;
use abbe_study::check::Check;
use abbe_study::{IsoAxis, Machine};

/// The volumetric error of a chain X, Y, Z with tool length L below the nose, by hand:
///
/// ```text
/// Δx = EXX + EXY + EXZ + (EBX + EBY) (z − L) − EBZ L − ECX y − C0Y y + B0Z z
/// Δy = EYX + EYY + EYZ − (EAX + EAY) (z − L) + EAZ L − A0Z z
/// Δz = EZX + EZY + EZZ + EAX y
/// ```
fn by_hand(e: &HashMap<&str, f64>, [_, y, z]: [f64; 3], l: f64, angles: &HashMap<&str, f64>) -> [f64; 3] {
    let [a0z, b0z, c0y] = ["A0Z", "B0Z", "C0Y"].map(|name| angles[name]);
    [
        e["EXX"] + e["EXY"] + e["EXZ"] + (e["EBX"] + e["EBY"]) * (z - l)
            - e["EBZ"] * l
            - e["ECX"] * y
            - c0y * y
            + b0z * z,
        e["EYX"] + e["EYY"] + e["EYZ"] - (e["EAX"] + e["EAY"]) * (z - l) + e["EAZ"] * l - a0z * z,
        e["EZX"] + e["EZY"] + e["EZZ"] + e["EAX"] * y,
    ]
}

#[test]
fn volumetric_error_of_21_errors() {
    let s = Parameters::NOMINAL.to_array();
    let u = Inputs::NOMINAL.to_array();
    let golden = 0.618_033_988_749_895;
    for i in 1..=1000 {
        let part = |factor: f64| (golden * factor * f64::from(i)).fract();
        let q = [600.0 * part(1.0), 400.0 * part(2.7), 450.0 * part(7.1)];
        let mut values = [0.0; EFFECTS];
        Machine3.effects(&q, &s, &u, &mut values).unwrap();
        // Each of the 21 sources has one effect: its value by its name.
        let effects = DESCRIPTION.effects.iter().zip(values);
        let named: HashMap<&str, f64> =
            effects.map(|(effect, value)| (&*DESCRIPTION.sources[effect.source].name, value)).collect();
        // Squareness is a translation proportional to the axis position; the textbook uses its
        // angle.
        let angles = HashMap::from([
            ("A0Z", -named["A0Z"] / q[2]),
            ("B0Z", named["B0Z"] / q[2]),
            ("C0Y", -named["C0Y"] / q[1]),
        ]);
        let expected = by_hand(&named, q, Parameters::NOMINAL.tool_length, &angles);

        let (mut columns, mut errors) = ([[0.0; 6]; ERRORS], [[0.0; 6]; FRAMES]);
        Machine3.error_jacobian(&q, &s, &mut columns).unwrap();
        Machine3.generalized_errors(&q, &s, &u, &mut errors).unwrap();
        for (row, expected) in expected.into_iter().enumerate() {
            let products =
                columns.iter().zip(errors.as_flattened()).map(|(column, error)| column[row] * error);
            let displacement: f64 = products.sum();
            let place = format!("row {row} at {q:?}: {displacement}, by hand {expected}");
            assert!((displacement - expected).abs() <= 1e-12, "{place}");
        }
    }
}

/// Checks that the squareness angles are the same at every position.
#[test]
fn squareness_is_one_angle() {
    let (s, u) = (Parameters::NOMINAL.to_array(), Inputs::NOMINAL.to_array());
    let angle = |name: &str, q: [f64; 3], along: usize| {
        let mut values = [0.0; EFFECTS];
        Machine3.effects(&q, &s, &u, &mut values).unwrap();
        let source = DESCRIPTION.sources.iter().position(|source| source.name == name).unwrap();
        let index = DESCRIPTION.effects.iter().position(|effect| effect.source == source).unwrap();
        values[index] / q[along]
    };
    for (name, along) in [("A0Z", 2), ("B0Z", 2), ("C0Y", 1)] {
        let (near, far) = (angle(name, [1.0, 2.0, 3.0], along), angle(name, [500.0, 390.0, 440.0], along));
        assert!((near - far).abs() < 1e-18 && near != 0.0, "{name}: {near} and {far}");
    }
}

/// Checks the names of ISO 230-1: the roll of X is EAX, and on the side of the workpiece the frame
/// has the opposite sign.
#[test]
fn errors_of_axes_have_the_names_of_iso_230() {
    let named = |machine: Machine| {
        let report = Check { machine }.run(&mut ()).unwrap();
        let one = |axis: &IsoAxis| (axis.name.clone(), axis.carries_workpiece, axis.errors.join(" "));
        report.iso_axes.iter().map(one).collect::<Vec<_>>()
    };
    let own = |name: &str, errors: &str| (name.to_owned(), false, errors.to_owned());
    let slides = [
        own("X", "EXX EYX EZX EBX ECX EAX"),
        own("Y", "EXY EYY EZY EBY ECY EAY"),
        own("Z", "EXZ EYZ EZZ EBZ ECZ EAZ"),
    ];
    let shipped = |name: &str| SHIPPED.iter().find(|shipped| shipped.name == name).unwrap();
    assert_eq!(named(Machine::shipped(shipped("machine3")).unwrap()), slides);
    assert!(named(Machine::shipped(shipped("ur5")).unwrap()).is_empty());
    let table = "[[frame]]\nname = \"C\"\nvariable = { name = \"c\", kind = \"revolute\" }\ntransform = \"Rz(c)\"\n\n[[frame]]\nname = \"bed\"";
    let text = shipped("machine3").spec.replace("[[frame]]\nname = \"bed\"", table);
    let machine = Machine::of_spec(Spec::parse("table.toml", &text).unwrap(), "table");
    let turned = ("C".to_owned(), true, "-EXC -EYC -EZC -EBC -ECC -EAC".to_owned());
    assert_eq!(named(machine), [&[turned][..], &slides].concat());
}

/// Returns the tool point of `[w X' b Y t]` with the errors of X' that a spec states, `(x, y)`.
fn tool_point(source: &str, [x, y]: [f64; 2]) -> [f64; 3] {
    let text = format!(
        "[manipulator]\nname = \"mill\"\nlength = \"mm\"\n\
         [[frame]]\nname = \"X\"\nvariable = {{ name = \"x\", kind = \"prismatic\", limits = [0, 600] }}\ntransform = \"Tx(x)\"\n\
         [[frame]]\nname = \"Y\"\nvariable = {{ name = \"y\", kind = \"prismatic\", limits = [0, 400] }}\ntransform = \"Ty(y)\"\n\
         [tool]\ntransform = \"Tz(-150)\"\n\
         [[source]]\nname = \"table\"\nclass = \"repeatable\"\nframe = \"X\"\n{source}\n"
    );
    let mill = Interpreter::new(Spec::parse("mill.toml", &text).unwrap());
    mill.real_pose(&[x, y], &[], &[]).unwrap().position()
}

/// An axis that carries the workpiece: what a laser between table and spindle reads is written as
/// it is, what the bed sees of the table with the opposite sign, where it turns.
#[test]
fn errors_of_a_table_have_the_signs_of_the_chapter() {
    for [x, y] in [[0.0_f64, 0.0], [300.0, 100.0], [580.0, 390.0]] {
        // Seen from the bed, the table is 20 um too far and turned by 30 urad about its origin.
        let (far, turn) = (0.02 * x / 600.0, 3e-5 * x / 600.0);
        // A point of the bed in the frame of the table: R(-turn) (p - origin).
        let (px, py) = (x - far, y);
        let [cx, cy] = [px * turn.cos() + py * turn.sin(), py * turn.cos() - px * turn.sin()];
        let as_bed = "e_x = \"-0.02 mm*x/(600 mm)\"\ne_r = \"-3e-5*x/(600 mm)\"\nat = \"Tx(-x)\"";
        let [fx, fy, _] = tool_point(as_bed, [x, y]);
        assert!((fx - cx).abs() < 1e-6 && (fy - cy).abs() < 1e-6, "({fx}, {fy}), not ({cx}, {cy})");
        // The laser reads the position of the spindle on the table, and its deviation from x.
        let deviation = px - x;
        let read = format!("e_x = \"{deviation:?} mm\"");
        assert!((tool_point(&read, [x, y])[0] - px).abs() < 1e-12);
    }
}
