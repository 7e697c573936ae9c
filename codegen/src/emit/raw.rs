//! The array functions of a module: generic over the scalar, without checks.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::body::{Output, body};
use super::names::Names;
use crate::expr::Symbol;
use crate::program::{FunctionKind, Operand, Program};
use crate::spec::{Orientation, Spec};

/// One raw function.
pub(super) fn raw_function(spec: &Spec, kind: FunctionKind, program: &Program) -> TokenStream {
    let mut names = Names::new(spec);
    let given = match kind {
        FunctionKind::Displacement => Some("errors"),
        FunctionKind::Covariance => Some("variances"),
        _ => None,
    };
    if let Some(given) = given {
        names.name_errors(given);
    }
    let body = body(program, &mut names);
    let used = used_symbols(program);
    let mut arguments = Vec::new();
    let mut bindings = Vec::new();
    let mut take = |letter: &str, size: &str, symbols: Vec<Symbol>| {
        let any = symbols.iter().any(|symbol| used.contains(symbol));
        let argument = if any { format_ident!("{letter}") } else { format_ident!("_{letter}") };
        let size = format_ident!("{size}");
        arguments.push(quote!(#argument: &[T; #size]));
        if any {
            let entries = symbols.iter().map(|symbol| {
                if used.contains(symbol) {
                    let name = names.symbol(*symbol);
                    quote!(#name)
                } else {
                    quote!(_)
                }
            });
            bindings.push(quote!(let [#(#entries),*] = *#argument;));
        }
    };
    take("q", "VARIABLES", (0..spec.variables.len()).map(Symbol::Variable).collect());
    take("s", "PARAMETERS", (0..spec.parameters.len()).map(Symbol::Parameter).collect());
    if depends_on_inputs(kind) {
        take("u", "INPUTS", (0..spec.inputs.len()).map(Symbol::Input).collect());
    }
    if let Some(given) = given {
        let given = format_ident!("{given}");
        arguments.push(quote!(#given: &[[T; 6]; FRAMES]));
        let frames = (0..spec.frames.len()).map(|i| {
            let six = (0..6).map(|k| names.symbol(Symbol::Error(6 * i + k)));
            quote!([#(#six),*])
        });
        bindings.push(quote!(let [#(#frames),*] = *#given;));
    }
    let has_margin = spec.orientation == Orientation::EulerYzx && has_rows(kind);
    let (outputs, margin) = match body.outputs.split_last() {
        Some((margin, outputs)) if has_margin => (outputs, Some(margin)),
        _ => (&body.outputs[..], None),
    };
    let results = results(spec, kind, outputs);
    let result_arguments = results.iter().map(|result| &result.argument);
    let mut assignments = results.iter().flat_map(|result| &result.assignments).collect::<Vec<_>>();
    assignments.sort_by_key(|assignment| assignment.ready);
    let mut assignments = assignments.into_iter().peekable();
    let constants = [(0.0, "zero"), (1.0, "one")].into_iter().filter_map(|(value, name)| {
        let name = format_ident!("{name}");
        let literal = super::literal::number(value);
        program
            .outputs
            .contains(&Operand::Constant(value))
            .then(|| quote!(let #name = T::constant(#literal);))
    });
    let returned = margin.map(|_| quote!(-> T));
    let name = format_ident!("{}", kind.name());
    // What is known is written at once, so that it need not be kept.
    let mut statements = Vec::new();
    for known in 0..=body.statements.len() {
        statements.extend(known.checked_sub(1).map(|last| &body.statements[last]));
        while let Some(assignment) = assignments.next_if(|assignment| assignment.ready == known) {
            statements.push(&assignment.statement);
        }
    }
    let documentation = documentation(spec, kind, program, has_margin);
    quote! {
        #(#[doc = #documentation])*
        #[inline(always)]
        pub fn #name<T: Scalar>(#(#arguments,)* #(#result_arguments),*) #returned {
            #(#bindings)*
            #(#constants)*
            #(#statements)*
            #margin
        }
    }
}

fn used_symbols(program: &Program) -> Vec<Symbol> {
    let operands = program.steps.iter().flat_map(|step| step.action.operands());
    operands
        .chain(program.outputs.iter().copied())
        .filter_map(|operand| match operand {
            Operand::Symbol(symbol) => Some(symbol),
            _ => None,
        })
        .collect()
}

/// An argument that a function fills.
struct FilledArgument {
    argument: TokenStream,
    assignments: Vec<Assignment>,
}

/// A statement that writes results.
struct Assignment {
    statement: TokenStream,
    /// After how many statements of the body all of them are known.
    ready: usize,
}

impl Assignment {
    fn new(values: &[Output], statement: TokenStream) -> Self {
        Self { statement, ready: values.iter().map(|value| value.ready).max().unwrap_or(0) }
    }
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
fn has_rows(kind: FunctionKind) -> bool {
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

fn results(spec: &Spec, kind: FunctionKind, outputs: &[Output]) -> Vec<FilledArgument> {
    let matrix = |values: &[Output]| {
        let columns = values.chunks(3).map(|column| quote!([#(#column),*]));
        quote!([#(#columns),*])
    };
    let pose = |values: &[Output]| {
        let value = matrix(values);
        FilledArgument {
            argument: quote!(pose: &mut [[T; 3]; 4]),
            assignments: vec![Assignment::new(values, quote!(*pose = #value;))],
        }
    };
    let rows = |name: &str, size: TokenStream, width: usize, values: &[Output]| {
        // What has no entries, as the Jacobian by the parameters of a spec that has none, is never used.
        let name = if values.is_empty() { format_ident!("_{name}") } else { format_ident!("{name}") };
        let assignments = values.chunks(width).enumerate().map(|(i, row)| {
            let (i, value) = (proc_macro2::Literal::usize_unsuffixed(i), array(row));
            Assignment::new(row, quote!(#name[#i] = #value;))
        });
        let assignments = assignments.collect();
        let width = proc_macro2::Literal::usize_unsuffixed(width);
        FilledArgument { argument: quote!(#name: &mut [[T; #width]; #size]), assignments }
    };
    let vectors = |name: &str, of_frame: usize, values: &[Output]| {
        let name = format_ident!("{name}");
        let assignments = values.chunks(3).enumerate().map(|(i, vector)| {
            let place = [3 * i / of_frame, i % (of_frame / 3)].map(proc_macro2::Literal::usize_unsuffixed);
            let ([frame, number], value) = (place, array(vector));
            Assignment::new(vector, quote!(#name[#frame][#number] = #value;))
        });
        let assignments = assignments.collect();
        FilledArgument { argument: quote!(#name: &mut [[[T; 3]; DISTINCT]; FRAMES]), assignments }
    };
    let behind_pose = |rest: &dyn Fn(&[Output]) -> FilledArgument| {
        let (first, others) = outputs.split_at(12);
        vec![pose(first), rest(others)]
    };
    match kind {
        FunctionKind::Transforms => {
            let assignments = outputs.chunks(12).enumerate().map(|(i, values)| {
                let (i, value) = (proc_macro2::Literal::usize_unsuffixed(i), matrix(values));
                Assignment::new(values, quote!(transforms[#i] = #value;))
            });
            let assignments = assignments.collect();
            let argument = quote!(transforms: &mut [[[T; 3]; 4]; FRAMES + 1]);
            vec![FilledArgument { argument, assignments }]
        }
        FunctionKind::Pose | FunctionKind::RealPose => vec![pose(outputs)],
        FunctionKind::ErrorJacobian => behind_pose(&|rest| rows("columns", quote!(ERRORS), 6, rest)),
        FunctionKind::ErrorJacobianDistinct => {
            behind_pose(&|rest| vectors("distinct", rest.len() / spec.frames.len(), rest))
        }
        FunctionKind::JointJacobian | FunctionKind::CompensatorStep => {
            behind_pose(&|rest| rows("columns", quote!(VARIABLES), 6, rest))
        }
        FunctionKind::ParameterJacobian => behind_pose(&|rest| rows("columns", quote!(PARAMETERS), 6, rest)),
        FunctionKind::Effects => {
            let assignments = vec![Assignment::new(outputs, quote!(*effects = [#(#outputs),*];))];
            vec![FilledArgument { argument: quote!(effects: &mut [T; EFFECTS]), assignments }]
        }
        FunctionKind::GeneralizedErrors => vec![rows("errors", quote!(FRAMES), 6, outputs)],
        FunctionKind::Displacement | FunctionKind::PredictedDisplacement => {
            let value = array(outputs);
            let assignments = vec![Assignment::new(outputs, quote!(*displacement = #value;))];
            vec![FilledArgument { argument: quote!(displacement: &mut [T; 6]), assignments }]
        }
        FunctionKind::Covariance => vec![rows("covariance", quote!(6), 6, outputs)],
        FunctionKind::SourceDisplacements => vec![rows("displacements", quote!(SOURCES), 6, outputs)],
    }
}

/// The values as an array.
fn array(values: &[Output]) -> TokenStream {
    if values.iter().all(Output::is_zero) {
        let length = proc_macro2::Literal::usize_unsuffixed(values.len());
        return quote!([zero; #length]);
    }
    quote!([#(#values),*])
}

fn documentation(spec: &Spec, kind: FunctionKind, program: &Program, margin: bool) -> Vec<String> {
    let what: &[&str] = match kind {
        FunctionKind::Transforms => {
            &["`A_1 … A_n` and the tool `T`, each by itself: columns x, y, z axis and position."]
        }
        FunctionKind::Pose => &["Pose of the tool point in `F_0`: columns x, y, z axis and position."],
        FunctionKind::ErrorJacobian => {
            &["Pose and error Jacobian `J_e`: six columns per frame, frame 1 first."]
        }
        FunctionKind::JointJacobian => &["Pose and joint Jacobian `∂X_T/∂q`: one column per variable."],
        FunctionKind::ParameterJacobian => &["Pose and `∂X_T/∂s`: one column per structural parameter."],
        FunctionKind::Effects => {
            &["The errors that the sources cause, one per entry of the description's effects."]
        }
        FunctionKind::GeneralizedErrors => {
            &["ε of the repeatable sources: `e_x e_y e_z e_s e_r e_p` of each frame."]
        }
        FunctionKind::ErrorJacobianDistinct => match spec.orientation {
            Orientation::RotationVector => &[
                "Pose and what of `J_e` is neither zero nor repeated: of each frame its x, y and z axis, then the",
                "moments (rows 1–3) of `e_s e_r e_p`. `abbe::distinct` makes the columns of it.",
            ],
            Orientation::EulerYzx => &[
                "Pose and what of `J_e` is neither zero nor repeated: of each frame its x, y and z axis, then the",
                "moments (rows 1–3) of `e_s e_r e_p`, then their rows 4–6. `abbe::distinct` makes the columns of it.",
            ],
        },
        FunctionKind::Displacement => {
            &["`ΔX = J_e ε` for any ε, `e_x e_y e_z e_s e_r e_p` of each frame: rows as those of a Jacobian."]
        }
        FunctionKind::Covariance => &[
            "`J_e diag(σ²) J_eᵀ`, column-major, for the variance of each error of each frame, in the order of ε.",
        ],
        FunctionKind::PredictedDisplacement => {
            &["`ΔX = J_e ε` of the repeatable sources: rows as those of a Jacobian."]
        }
        FunctionKind::SourceDisplacements => &[
            "`ΔX` of each source by itself, of a random one for its magnitude: rows as those of a Jacobian.",
        ],
        FunctionKind::RealPose => &[
            "Pose of the tool point in `F_0` with the errors of the repeatable sources, exactly: `A_1 E_1 … A_n E_n T`.",
        ],
        FunctionKind::CompensatorStep => &[
            "The pose of `real_pose`, and the nominal `J_q` with rotation-vector rows: one column per variable.",
        ],
    };
    let mut lines: Vec<String> = what.iter().map(|line| format!(" {line}")).collect();
    if margin {
        lines.push(String::new());
        lines.push(" Returns `cos ρ`; where that is 0, rows 4–6 are not finite.".to_owned());
    }
    lines.push(String::new());
    lines.push(format!(" {}.", program.operations()));
    lines
}
