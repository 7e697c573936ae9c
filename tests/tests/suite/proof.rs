//! The structured product rule equals `Graph::diff` of the fully multiplied chain
//! `A_1 E_1 A_2 E_2 … A_n E_n T`, differentiated by every generalized error: equations (6) and (9).

use abbe::Orientation;
use abbe_codegen::chain::{Model, transform};
use abbe_codegen::graph::{Frame, Graph, Node};
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_spec::expr::Symbol;
use abbe_tests::chains::coupled_joints;

/// Returns `A_1 E_1 … A_n E_n T` with exact rotations, with symbols for all 6n errors.
fn multiplied(graph: &mut Graph, spec: &Spec) -> Frame {
    let mut product = graph.identity();
    for (i, frame) in spec.frames.iter().enumerate() {
        let nominal = transform(graph, &frame.factors);
        product = graph.then(&product, &nominal);
        let mut error = graph.identity();
        // Translations first, then R_y(e_s) R_z(e_r) R_x(e_p), the order of ε: stated independently
        // of the definitions to be proved.
        let symbols: [Node; 6] = std::array::from_fn(|k| graph.symbol(Symbol::Error(6 * i + k)));
        let [x, y, z, spin, roll, pitch] = symbols;
        for (axis, symbol) in [(0, x), (1, y), (2, z)] {
            error = graph.moved(&error, axis, symbol);
        }
        for (axis, symbol) in [(1, spin), (2, roll), (0, pitch)] {
            error = graph.turned(&error, axis, symbol);
        }
        product = graph.then(&product, &error);
    }
    let tool = transform(graph, &spec.tool);
    graph.then(&product, &tool)
}

/// Returns rows 1–6 of `∂X_T/∂x` from the twelve entries of a pose and their derivatives.
fn rows(graph: &mut Graph, orientation: Orientation, pose: &Frame, symbol: Symbol) -> [Node; 6] {
    let entries: Vec<Node> = pose.axes.iter().flatten().chain(&pose.position).copied().collect();
    let slopes = graph.diff_all(&entries, symbol);
    let turn: [Node; 3] = match orientation {
        // vee(dR Rᵀ): entry (i, j) of the product, from columns.
        Orientation::RotationVector => std::array::from_fn(|axis| {
            let (i, j) = ((axis + 2) % 3, (axis + 1) % 3);
            (0..3).fold(graph.zero(), |sum, column| {
                let product = graph.mul(slopes[3 * column + i], entries[3 * column + j]);
                graph.add(sum, product)
            })
        }),
        // Spin, roll and pitch as functions of the matrix, differentiated directly.
        Orientation::EulerYzx => {
            let [x, y, z] = pose.axes;
            let (r31, r23) = (graph.neg(x[2]), graph.neg(z[1]));
            let spin = graph.atan2(r31, x[0]);
            let roll = graph.call(abbe_spec::expr::Function::Asin, x[1]);
            let pitch = graph.atan2(r23, y[1]);
            [spin, roll, pitch].map(|angle| graph.diff(angle, symbol))
        }
        // Yaw, pitch and roll of R_z R_x R_y: r12 = −sin ψ cos θ, r32 = sin θ, r31 = −cos θ sin φ.
        Orientation::Iec61217 => {
            let [x, y, z] = pose.axes;
            let (r12, r31) = (graph.neg(y[0]), graph.neg(x[2]));
            let yaw = graph.atan2(r12, y[1]);
            let pitch = graph.call(abbe_spec::expr::Function::Asin, y[2]);
            let roll = graph.atan2(r31, z[2]);
            [yaw, pitch, roll].map(|angle| graph.diff(angle, symbol))
        }
    };
    [slopes[9], slopes[10], slopes[11], turn[0], turn[1], turn[2]]
}

/// Returns a value for every symbol: zero for errors, arbitrary for the others.
fn values(sample: usize) -> impl Fn(Symbol) -> f64 {
    move |symbol| {
        let spread =
            |index: usize, offset: f64| ((index * 7 + sample * 13) as f64 * 0.618 + offset).sin() * 0.9;
        match symbol {
            Symbol::Variable(i) => spread(i, 0.1),
            Symbol::Parameter(i) => spread(i, 0.5) + 1.0,
            Symbol::Input(i) => spread(i, 0.9),
            Symbol::Passive(_)
            | Symbol::Error(_)
            | Symbol::Magnitude(_)
            | Symbol::Target(_)
            | Symbol::Local(_) => 0.0,
        }
    }
}

fn compare(spec: &Spec) {
    let mut model = Model::new(spec);
    let graph = &mut model.graph;
    let product = multiplied(graph, spec);
    let mut structured: Vec<Node> = model.error_jacobian.columns.concat();
    structured.extend(model.joint_jacobian.columns.iter().flatten());
    structured.extend(model.parameter_jacobian.columns.iter().flatten());
    let errors = (0..6 * spec.frames.len()).map(Symbol::Error);
    let variables = (0..spec.variables.len()).map(Symbol::Variable);
    let parameters = (0..spec.parameters.len()).map(Symbol::Parameter);
    let differentiated: Vec<Node> = errors
        .chain(variables)
        .chain(parameters)
        .flat_map(|symbol| rows(graph, spec.orientation, &product, symbol))
        .collect();
    assert_eq!(structured.len(), differentiated.len());
    for sample in 0..5 {
        let a = graph.evaluate(&structured, values(sample));
        let b = graph.evaluate(&differentiated, values(sample));
        let largest = a.iter().fold(1.0, |largest: f64, value| largest.max(value.abs()));
        for (index, (a, b)) in a.iter().zip(&b).enumerate() {
            let place = format!("{}: column {}, row {}", spec.name, index / 6, index % 6);
            assert!((a - b).abs() <= 1e-12 * largest, "{place}: {a} structured, {b} differentiated");
        }
    }
}

#[test]
fn structured_equals_differentiated_for_every_shipped_manipulator() {
    for shipped in SHIPPED {
        let mut spec = Spec::parse(shipped.name, shipped.spec).unwrap();
        for orientation in [Orientation::RotationVector, Orientation::EulerYzx, Orientation::Iec61217] {
            spec.orientation = orientation;
            compare(&spec);
        }
    }
}

/// Checks features that the shipped specs lack: variables in several frames, twice in one, inside a
/// matrix and in the tool, a screw joint, and an axis in general direction.
#[test]
fn structured_equals_differentiated_for_coupled_joints() {
    let mut spec = Spec::parse("coupled.toml", coupled_joints()).unwrap();
    for orientation in [Orientation::RotationVector, Orientation::EulerYzx, Orientation::Iec61217] {
        spec.orientation = orientation;
        compare(&spec);
    }
}
