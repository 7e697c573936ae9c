//! Functions of long chains: a loop over the frames, behind the transforms.

use std::collections::BTreeMap;

use indexmap::IndexSet;

use super::body::body;
use super::literal::number;
use super::names::Names;
use super::raw::{bindings, has_rows};
use super::writer::{Writer, array};
use crate::chain::Model;
use crate::graph::{Graph, Node, Op};
use crate::program::{FunctionKind, Program};
use crate::spec::{Orientation, Spec};

/// The statements of a function as a loop; none where straight-line code is no longer than the chain, or is all there is.
pub(super) fn loop_body(spec: &Spec, kind: FunctionKind, program: &Program) -> Option<Vec<String>> {
    if !spec.is_long() || program.steps.len() <= spec.frames.len() {
        return None;
    }
    let euler = spec.orientation == Orientation::EulerYzx && has_rows(kind);
    let rows = |call: &'static str| euler.then_some(call);
    let transforms = "let terms = terms(q, s);\nlet transforms = motions(&terms);";
    let errors =
        "let mut errors = [[T::constant(0.0); 6]; FRAMES];\ngeneralized_errors(q, s, u, &mut errors);";
    let columns = rows("::abbe::long::euler_columns(pose, columns)");
    let (lines, margin) = match kind {
        FunctionKind::Effects | FunctionKind::GeneralizedErrors => return None,
        FunctionKind::Transforms => (vec!["*transforms = motions(&terms(q, s));"], None),
        FunctionKind::Pose => (vec![transforms, "::abbe::long::pose(&transforms, pose);"], None),
        FunctionKind::ErrorJacobian => {
            (vec![transforms, "::abbe::long::error_jacobian(&transforms, pose, columns);"], columns)
        }
        FunctionKind::ErrorJacobianDistinct => (
            vec![transforms, "::abbe::long::distinct(&transforms, pose, distinct);"],
            rows("::abbe::long::euler_distinct(pose, distinct)"),
        ),
        FunctionKind::JointJacobian => (
            vec![
                transforms,
                JOINT_TWISTS,
                "::abbe::long::symbol_jacobian(&transforms, &JOINT_TWISTS, &twists, pose, columns);",
            ],
            columns,
        ),
        FunctionKind::ParameterJacobian => (
            vec![
                transforms,
                PARAMETER_TWISTS,
                "::abbe::long::symbol_jacobian(&transforms, &PARAMETER_TWISTS, &twists, pose, columns);",
            ],
            columns,
        ),
        FunctionKind::Displacement => (
            vec![transforms, "::abbe::long::displacement(&transforms, errors, displacement);"],
            rows("::abbe::long::euler_displacement(&transforms, displacement)"),
        ),
        FunctionKind::PredictedDisplacement => (
            vec![transforms, errors, "::abbe::long::displacement(&transforms, &errors, displacement);"],
            rows("::abbe::long::euler_displacement(&transforms, displacement)"),
        ),
        FunctionKind::Covariance => (
            vec![transforms, "::abbe::long::covariance(&transforms, variances, covariance);"],
            rows("::abbe::long::euler_covariance(&transforms, covariance)"),
        ),
        FunctionKind::SourceDisplacements => (
            vec![
                "let zero = T::constant(0.0);",
                "let (mut pose, mut columns) = ([[zero; 3]; 4], [[zero; 6]; ERRORS]);",
                if euler {
                    "let margin = error_jacobian(q, s, &mut pose, &mut columns);"
                } else {
                    "error_jacobian(q, s, &mut pose, &mut columns);"
                },
                "let mut values = [zero; EFFECTS];",
                "effects(q, s, u, &mut values);",
                "::abbe::long::by_source(&super::DESCRIPTION.effects, &values, &columns, displacements);",
            ],
            rows("margin"),
        ),
        FunctionKind::RealPose if spec.has_repeatable_source() => {
            (vec![transforms, errors, "::abbe::long::real_pose(&transforms, &errors, pose);"], None)
        }
        FunctionKind::RealPose => (vec!["self::pose(q, s, pose);"], None),
        FunctionKind::CompensatorStep => (
            vec![
                transforms,
                JOINT_TWISTS,
                "::abbe::long::symbol_jacobian(&transforms, &JOINT_TWISTS, &twists, pose, columns);",
                if spec.has_repeatable_source() { "real_pose(q, s, u, pose);" } else { "" },
            ],
            None,
        ),
    };
    let lines = lines.into_iter().chain(margin).filter(|line| !line.is_empty());
    Some(lines.map(str::to_owned).collect())
}

const JOINT_TWISTS: &str = "let mut twists = [[T::constant(0.0); 6]; JOINT_TWISTS.len()];
::abbe::long::combine(
    &JOINT_TWIST_CONSTANTS,
    &JOINT_TWIST_FACTORS,
    &terms,
    twists.as_flattened_mut(),
);";

const PARAMETER_TWISTS: &str = "let mut twists = [[T::constant(0.0); 6]; PARAMETER_TWISTS.len()];
::abbe::long::combine(
    &PARAMETER_TWIST_CONSTANTS,
    &PARAMETER_TWIST_FACTORS,
    &terms,
    twists.as_flattened_mut(),
);";

/// What the loops take: transforms, and what symbols do to each of them, as sums of constants times few terms.
pub(super) fn helpers(writer: &mut Writer, spec: &Spec, model: &Model) {
    let mut sums = Sums { graph: &model.graph, terms: IndexSet::new() };
    let poses = model.transforms.iter();
    let entries: Vec<Node> =
        poses.flat_map(|frame| frame.axes.iter().flatten().chain(&frame.position)).copied().collect();
    tables(writer, "MOTION", "the entries of all transforms", sums.of(&entries));
    for (name, twists) in [("JOINT", &model.joint_local_twists), ("PARAMETER", &model.parameter_local_twists)]
    {
        writer.blank();
        writer.documentation("Transform and column of everything that a symbol moves.");
        let places: Vec<String> =
            twists.iter().map(|twist| format!("({}, {})", twist.transform, twist.column)).collect();
        let head = format!("const {name}_TWISTS: [(usize, usize); {}] = ", places.len());
        writer.array(&head, &places, ";");
        let entries: Vec<Node> = twists.iter().flat_map(|twist| twist.twist).collect();
        let what = "the velocity and rotation that each of these is";
        tables(writer, &format!("{name}_TWIST"), what, sums.of(&entries));
    }

    let terms: Vec<Node> = sums.terms.into_iter().collect();
    let program = Program::new(&model.graph, &terms);
    let mut names = Names::new(spec);
    let indent = writer.indent() + 4;
    let written = body(&program, &mut names, indent);
    let (arguments, mut statements) = bindings(spec, &names, &program, indent, false);
    statements.extend(written.statements);
    let values: Vec<String> = written.outputs.into_iter().map(|term| term.expression).collect();
    statements.push(array(indent, "", &values, ""));
    writer.blank();
    writer.documentation("All that is not constant in the transforms.");
    writer.lines("#[inline(always)]");
    writer.function("fn terms<T: Scalar>", &arguments, &format!(" -> [T; {}]", values.len()), &statements);

    writer.blank();
    writer.lines("#[inline(always)]");
    let lines = [
        "let mut motions = [[[T::constant(0.0); 3]; 4]; FRAMES + 1];",
        "let entries = motions.as_flattened_mut().as_flattened_mut();",
        "::abbe::long::combine(&MOTION_CONSTANTS, &MOTION_FACTORS, terms, entries);",
        "motions",
    ];
    writer.function(
        "fn motions<T: Scalar>",
        &["terms: &[T]".to_owned()],
        " -> [[[T; 3]; 4]; FRAMES + 1]",
        &lines.map(str::to_owned),
    );
}

/// The constants of sums, and a table of entry, term and factor.
fn tables(writer: &mut Writer, name: &str, what: &str, (constants, factors): (Vec<f64>, Vec<Factor>)) {
    writer.blank();
    writer.documentation(&format!("What is constant in {what}."));
    let values: Vec<String> = constants.into_iter().map(number).collect();
    writer.array(&format!("const {name}_CONSTANTS: [f64; {}] = ", values.len()), &values, ";");
    writer.blank();
    writer.documentation("Entry of these, term, and the factor with which the term is added.");
    let rows: Vec<String> = factors
        .iter()
        .map(|(entry, term, factor)| format!("({entry}, {term}, {})", number(*factor)))
        .collect();
    writer.array(&format!("const {name}_FACTORS: [(usize, usize, f64); {}] = ", rows.len()), &rows, ";");
}

/// Entry, term, factor.
type Factor = (usize, usize, f64);

/// Nodes as sums of a constant and of constants times terms.
struct Sums<'g> {
    graph: &'g Graph,
    terms: IndexSet<Node>,
}

impl Sums<'_> {
    /// The constant of each entry, and the factors.
    fn of(&mut self, entries: &[Node]) -> (Vec<f64>, Vec<Factor>) {
        let (mut constants, mut factors) = (Vec::with_capacity(entries.len()), Vec::new());
        for (entry, node) in entries.iter().enumerate() {
            let (mut constant, mut sum) = (0.0, BTreeMap::new());
            self.add(*node, 1.0, &mut constant, &mut sum);
            constants.push(constant);
            factors.extend(sum.into_iter().filter(|(_, k)| *k != 0.0).map(|(term, k)| (entry, term, k)));
        }
        (constants, factors)
    }

    fn add(&mut self, node: Node, factor: f64, constant: &mut f64, sum: &mut BTreeMap<usize, f64>) {
        let term = match self.graph.op(node) {
            Op::Constant(bits) => {
                *constant += factor * f64::from_bits(bits);
                return;
            }
            Op::Neg(a) => return self.add(a, -factor, constant, sum),
            Op::Add(a, b) => {
                self.add(a, factor, constant, sum);
                return self.add(b, factor, constant, sum);
            }
            Op::Sub(a, b) => {
                self.add(a, factor, constant, sum);
                return self.add(b, -factor, constant, sum);
            }
            Op::Mul(a, b) if self.graph.value(a).is_some() => {
                return self.add(b, factor * self.graph.value(a).unwrap_or(f64::NAN), constant, sum);
            }
            Op::Mul(a, b) if self.graph.value(b).is_some() => {
                return self.add(a, factor * self.graph.value(b).unwrap_or(f64::NAN), constant, sum);
            }
            _ => self.terms.insert_full(node).0,
        };
        *sum.entry(term).or_default() += factor;
    }
}
