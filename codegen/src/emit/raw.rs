//! The array functions of a module: generic over the scalar, without checks.

use std::collections::HashSet;

use super::body::{Output, body};
use super::literal::number;
use super::long::loop_body;
use super::names::Names;
use super::writer::{Writer, array, pattern};
use crate::expr::Symbol;
use crate::program::{FunctionKind, Operand, Program};
use crate::spec::{Orientation, Spec};

/// One raw function.
pub(super) fn raw_function(writer: &mut Writer, spec: &Spec, kind: FunctionKind, program: &Program) {
    let has_margin = spec.orientation == Orientation::EulerYzx && has_rows(kind);
    let looped = loop_body(spec, kind, program);
    let is_loop = looped.is_some();
    let (arguments, statements) = match looped {
        Some(statements) => (loop_arguments(kind, &statements), statements),
        None => straight_line(spec, kind, program, writer.indent() + 4, has_margin),
    };
    documentation(writer, spec, kind, has_margin);
    if is_loop {
        writer.documentation("A loop over the frames.");
    } else {
        writer.documentation(&format!("{}.", program.operations()));
    }
    writer.lines("#[inline(always)]");
    let name = format!("pub fn {}<T: Scalar>", kind.name());
    writer.function(&name, &arguments, if has_margin { " -> T" } else { "" }, &statements);
}

/// All arguments, of which only the inputs may be without use.
fn loop_arguments(kind: FunctionKind, statements: &[String]) -> Vec<String> {
    let mut arguments = vec!["q: &[T; VARIABLES]".to_owned(), "s: &[T; PARAMETERS]".to_owned()];
    if depends_on_inputs(kind) {
        let unused = if statements.iter().any(|line| line.contains("s, u, ")) { "" } else { "_" };
        arguments.push(format!("{unused}u: &[T; INPUTS]"));
    }
    arguments.extend(given(kind).map(|given| format!("{given}: &[[T; 6]; FRAMES]")));
    arguments.extend(filled_arguments(kind, false));
    arguments
}

/// What is given for each generalized error.
fn given(kind: FunctionKind) -> Option<&'static str> {
    match kind {
        FunctionKind::Displacement => Some("errors"),
        FunctionKind::Covariance => Some("variances"),
        _ => None,
    }
}

/// Arguments and statements of a function without loops.
fn straight_line(
    spec: &Spec,
    kind: FunctionKind,
    program: &Program,
    indent: usize,
    has_margin: bool,
) -> (Vec<String>, Vec<String>) {
    let mut names = Names::new(spec);
    if let Some(given) = given(kind) {
        names.name_errors(given);
    }
    let body = body(program, &mut names, indent);
    let (mut arguments, mut statements) = bindings(spec, &names, program, indent, depends_on_inputs(kind));
    if let Some(given) = given(kind) {
        arguments.push(format!("{given}: &[[T; 6]; FRAMES]"));
        let frames: Vec<String> = (0..spec.frames.len())
            .map(|i| {
                let six = [0, 1, 2, 3, 4, 5].map(|k| names.symbol(Symbol::Error(6 * i + k)));
                format!("[{}]", six.join(", "))
            })
            .collect();
        statements.push(pattern(indent, "let ", &frames, &format!(" = *{given};")));
    }
    statements.extend(zero_and_one(program));
    let (outputs, margin) = match body.outputs.split_last() {
        Some((margin, outputs)) if has_margin => (outputs, Some(margin)),
        _ => (&body.outputs[..], None),
    };
    let behind_pose = outputs.len().saturating_sub(12);
    arguments
        .extend(filled_arguments(kind, if fills_pose(kind) { behind_pose == 0 } else { outputs.is_empty() }));
    let mut results = Results { indent, assignments: Vec::new() };
    results.of(spec, kind, outputs);
    let mut assignments = results.assignments;
    assignments.sort_by_key(|assignment| assignment.ready);
    let mut assignments = assignments.into_iter().peekable();
    // What is known is written at once, so that it need not be kept.
    let mut known = body.statements.into_iter();
    for count in 0..=known.len() {
        statements.extend(count.checked_sub(1).and_then(|_| known.next()));
        while let Some(assignment) = assignments.next_if(|assignment| assignment.ready == count) {
            statements.push(assignment.statement);
        }
    }
    if let Some(margin) = margin {
        // What would be named only to be returned is returned as it is.
        let named = format!("let {} = ", margin.expression);
        let last = statements.pop_if(|last| last.starts_with(&named) && last.ends_with(';'));
        statements.push(match &last {
            Some(last) => last[named.len()..last.len() - 1].to_owned(),
            None => margin.expression.clone(),
        });
    }
    (arguments, statements)
}

/// The arguments q and s, and u where a function takes it, and the statements that name what is used of them.
pub(super) fn bindings(
    spec: &Spec,
    names: &Names<'_>,
    program: &Program,
    indent: usize,
    with_inputs: bool,
) -> (Vec<String>, Vec<String>) {
    let used = used_symbols(program);
    let (mut arguments, mut statements) = (Vec::new(), Vec::new());
    let mut take = |letter: &str, size: &str, symbols: Vec<Symbol>| {
        let any = symbols.iter().any(|symbol| used.contains(symbol));
        let unused = if any { "" } else { "_" };
        arguments.push(format!("{unused}{letter}: &[T; {size}]"));
        if any {
            let name = |symbol| if used.contains(symbol) { names.symbol(*symbol) } else { "_" };
            let entries: Vec<String> = symbols.iter().map(|symbol| name(symbol).to_owned()).collect();
            statements.push(pattern(indent, "let ", &entries, &format!(" = *{letter};")));
        }
    };
    take("q", "VARIABLES", (0..spec.variables.len()).map(Symbol::Variable).collect());
    take("s", "PARAMETERS", (0..spec.parameters.len()).map(Symbol::Parameter).collect());
    if with_inputs {
        take("u", "INPUTS", (0..spec.inputs.len()).map(Symbol::Input).collect());
    }
    (arguments, statements)
}

/// The names that 0 and 1 have where they are results.
fn zero_and_one(program: &Program) -> impl Iterator<Item = String> {
    let returned = |(value, _): &(f64, &str)| program.outputs.contains(&Operand::Constant(*value));
    let constants = [(0.0, "zero"), (1.0, "one")].into_iter().filter(returned);
    constants.map(|(value, name)| format!("let {name} = T::constant({});", number(value)))
}

fn used_symbols(program: &Program) -> HashSet<Symbol> {
    let operands = program.steps.iter().flat_map(|step| step.action.operands());
    let symbol = |operand| match operand {
        Operand::Symbol(symbol) => Some(symbol),
        _ => None,
    };
    operands.chain(program.outputs.iter().copied()).filter_map(symbol).collect()
}

fn depends_on_inputs(kind: FunctionKind) -> bool {
    matches!(
        kind,
        FunctionKind::Effects
            | FunctionKind::GeneralizedErrors
            | FunctionKind::PredictedDisplacement
            | FunctionKind::SourceDisplacements
            | FunctionKind::RealPose
            | FunctionKind::CompensatorStep
    )
}

/// Whether a function's results have rows as the spec's orientation says.
pub(super) fn has_rows(kind: FunctionKind) -> bool {
    matches!(
        kind,
        FunctionKind::ErrorJacobian
            | FunctionKind::JointJacobian
            | FunctionKind::ParameterJacobian
            | FunctionKind::ErrorJacobianDistinct
            | FunctionKind::Displacement
            | FunctionKind::Covariance
            | FunctionKind::PredictedDisplacement
            | FunctionKind::SourceDisplacements
    )
}

/// A statement that writes results.
struct Assignment {
    statement: String,
    /// After how many statements of the body all of them are known.
    ready: usize,
}

fn fills_pose(kind: FunctionKind) -> bool {
    matches!(
        kind,
        FunctionKind::Pose
            | FunctionKind::ErrorJacobian
            | FunctionKind::JointJacobian
            | FunctionKind::ParameterJacobian
            | FunctionKind::ErrorJacobianDistinct
            | FunctionKind::RealPose
            | FunctionKind::CompensatorStep
    )
}

/// The arguments that a function fills; what has no entries, as the Jacobian by the parameters of a spec that has none,
/// is never used.
fn filled_arguments(kind: FunctionKind, empty: bool) -> Vec<String> {
    let rows = |name: &str, size: &str| {
        let unused = if empty { "_" } else { "" };
        Some(format!("{unused}{name}: &mut [[T; 6]; {size}]"))
    };
    let last = match kind {
        FunctionKind::Transforms => Some("transforms: &mut [[[T; 3]; 4]; FRAMES + 1]".to_owned()),
        FunctionKind::Pose | FunctionKind::RealPose => None,
        FunctionKind::ErrorJacobian => rows("columns", "ERRORS"),
        FunctionKind::JointJacobian | FunctionKind::CompensatorStep => rows("columns", "VARIABLES"),
        FunctionKind::ParameterJacobian => rows("columns", "PARAMETERS"),
        FunctionKind::ErrorJacobianDistinct => Some("distinct: &mut [[[T; 3]; DISTINCT]; FRAMES]".to_owned()),
        FunctionKind::Effects => Some("effects: &mut [T; EFFECTS]".to_owned()),
        FunctionKind::Displacement | FunctionKind::PredictedDisplacement => {
            Some("displacement: &mut [T; 6]".to_owned())
        }
        FunctionKind::GeneralizedErrors => rows("errors", "FRAMES"),
        FunctionKind::Covariance => rows("covariance", "6"),
        FunctionKind::SourceDisplacements => rows("displacements", "SOURCES"),
    };
    let pose = fills_pose(kind).then(|| "pose: &mut [[T; 3]; 4]".to_owned());
    pose.into_iter().chain(last).collect()
}

/// How results are written.
struct Results {
    indent: usize,
    assignments: Vec<Assignment>,
}

impl Results {
    fn of(&mut self, spec: &Spec, kind: FunctionKind, outputs: &[Output]) {
        let split = |outputs| <[Output]>::split_at(outputs, 12);
        match kind {
            FunctionKind::Transforms => {
                for (i, values) in outputs.chunks(12).enumerate() {
                    self.matrix(&format!("transforms[{i}]"), values);
                }
            }
            FunctionKind::Pose | FunctionKind::RealPose => self.pose(outputs),
            FunctionKind::ErrorJacobian
            | FunctionKind::JointJacobian
            | FunctionKind::CompensatorStep
            | FunctionKind::ParameterJacobian => {
                let (pose, rest) = split(outputs);
                self.pose(pose);
                self.rows("columns", rest);
            }
            FunctionKind::ErrorJacobianDistinct => {
                let (pose, rest) = split(outputs);
                self.pose(pose);
                let vectors = rest.len() / 3 / spec.frames.len();
                for (i, vector) in rest.chunks(3).enumerate() {
                    self.array(&format!("distinct[{}][{}]", i / vectors, i % vectors), vector);
                }
            }
            FunctionKind::Effects => {
                let values: Vec<String> = outputs.iter().map(|output| output.expression.clone()).collect();
                self.assign("*effects", outputs, &values);
            }
            FunctionKind::Displacement | FunctionKind::PredictedDisplacement => {
                self.array("*displacement", outputs);
            }
            FunctionKind::GeneralizedErrors => self.rows("errors", outputs),
            FunctionKind::Covariance => self.rows("covariance", outputs),
            FunctionKind::SourceDisplacements => self.rows("displacements", outputs),
        }
    }

    fn pose(&mut self, values: &[Output]) {
        self.matrix("*pose", values);
    }

    /// Six numbers each.
    fn rows(&mut self, name: &str, values: &[Output]) {
        for (i, row) in values.chunks(6).enumerate() {
            self.array(&format!("{name}[{i}]"), row);
        }
    }

    fn matrix(&mut self, place: &str, values: &[Output]) {
        let column = |column: &[Output]| {
            let entries: Vec<String> = column.iter().map(|entry| entry.expression.clone()).collect();
            array(self.indent + 4, "", &entries, "")
        };
        let columns: Vec<String> = values.chunks(3).map(column).collect();
        self.assign(place, values, &columns);
    }

    fn array(&mut self, place: &str, values: &[Output]) {
        if values.iter().all(|value| value.is_zero) {
            self.assign(place, values, &[format!("zero; {}", values.len())]);
        } else {
            let entries: Vec<String> = values.iter().map(|value| value.expression.clone()).collect();
            self.assign(place, values, &entries);
        }
    }

    fn assign(&mut self, place: &str, values: &[Output], entries: &[String]) {
        let statement = array(self.indent, &format!("{place} = "), entries, ";");
        let ready = values.iter().map(|value| value.ready).max().unwrap_or(0);
        self.assignments.push(Assignment { statement, ready });
    }
}

fn documentation(writer: &mut Writer, spec: &Spec, kind: FunctionKind, margin: bool) {
    let what = match kind {
        FunctionKind::Transforms => {
            "`A_1 … A_n` and the tool `T`, each by itself: columns x, y, z axis and position."
        }
        FunctionKind::Pose => "Pose of the tool point in `F_0`: columns x, y, z axis and position.",
        FunctionKind::ErrorJacobian => "Pose and error Jacobian `J_e`: six columns per frame, frame 1 first.",
        FunctionKind::JointJacobian => "Pose and joint Jacobian `∂X_T/∂q`: one column per variable.",
        FunctionKind::ParameterJacobian => "Pose and `∂X_T/∂s`: one column per structural parameter.",
        FunctionKind::Effects => {
            "The errors that the sources cause, one per entry of the description's effects."
        }
        FunctionKind::GeneralizedErrors => {
            "ε of the repeatable sources: `e_x e_y e_z e_s e_r e_p` of each frame."
        }
        FunctionKind::ErrorJacobianDistinct => match spec.orientation {
            Orientation::RotationVector => {
                "Pose and what of `J_e` is neither zero nor repeated: of each frame its x, y and z axis, then the \
                 moments (rows 1–3) of `e_s e_r e_p`. `abbe::distinct` makes the columns of it."
            }
            Orientation::EulerYzx => {
                "Pose and what of `J_e` is neither zero nor repeated: of each frame its x, y and z axis, then the \
                 moments (rows 1–3) of `e_s e_r e_p`, then their rows 4–6. `abbe::distinct` makes the columns of it."
            }
        },
        FunctionKind::Displacement => {
            "`ΔX = J_e ε` for any ε, `e_x e_y e_z e_s e_r e_p` of each frame: rows as those of a Jacobian."
        }
        FunctionKind::Covariance => {
            "`J_e diag(σ²) J_eᵀ`, column-major, for the variance of each error of each frame, in the order of ε."
        }
        FunctionKind::PredictedDisplacement => {
            "`ΔX = J_e ε` of the repeatable sources: rows as those of a Jacobian."
        }
        FunctionKind::SourceDisplacements => {
            "`ΔX` of each source by itself, of a random one for its magnitude: rows as those of a Jacobian."
        }
        FunctionKind::RealPose => {
            "Pose of the tool point in `F_0` with the errors of the repeatable sources, exactly: \
             `A_1 E_1 … A_n E_n T`."
        }
        FunctionKind::CompensatorStep => {
            "The pose of `real_pose`, and the nominal `J_q` with rotation-vector rows: one column per variable."
        }
    };
    writer.documentation(what);
    writer.documentation_line("");
    if margin {
        writer.documentation("Returns `cos ρ`; where that is 0, rows 4–6 are not finite.");
        writer.documentation_line("");
    }
}
