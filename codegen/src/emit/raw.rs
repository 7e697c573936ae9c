//! The array functions of a module: generic over the scalar, without checks.

use proc_macro2::TokenStream;
use quote::{ToTokens, format_ident, quote};

use super::body::{Output, body};
use super::names::Names;
use crate::expr::Symbol;
use crate::program::{FunctionKind, Operand, Program};
use crate::spec::{Orientation, Spec};

/// One raw function.
pub(super) fn raw_function(spec: &Spec, kind: FunctionKind, program: &Program) -> TokenStream {
    let mut names = Names::new(spec);
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
    if matches!(kind, FunctionKind::Effects | FunctionKind::GeneralizedErrors) {
        take("u", "INPUTS", (0..spec.inputs.len()).map(Symbol::Input).collect());
    }
    let (results, margin) = results(spec, kind, &body.outputs);
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
    let returned = margin.as_ref().map(|_| quote!(-> T));
    let name = format_ident!("{}", kind.name());
    // What is known is written at once, so that it need not be kept.
    let mut statements = Vec::new();
    for known in 0..=body.statements.len() {
        statements.extend(known.checked_sub(1).map(|last| &body.statements[last]));
        while let Some(assignment) = assignments.next_if(|assignment| assignment.ready == known) {
            statements.push(&assignment.statement);
        }
    }
    let documentation = documentation(kind, program, margin.is_some());
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

fn results(
    spec: &Spec,
    kind: FunctionKind,
    outputs: &[Output],
) -> (Vec<FilledArgument>, Option<TokenStream>) {
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
        let name = format_ident!("{name}");
        let assignments = values.chunks(width).enumerate().map(|(i, row)| {
            let i = proc_macro2::Literal::usize_unsuffixed(i);
            let statement = if row.iter().all(Output::is_zero) {
                let width = proc_macro2::Literal::usize_unsuffixed(width);
                quote!(#name[#i] = [zero; #width];)
            } else {
                quote!(#name[#i] = [#(#row),*];)
            };
            Assignment::new(row, statement)
        });
        let assignments = assignments.collect();
        let width = proc_macro2::Literal::usize_unsuffixed(width);
        FilledArgument { argument: quote!(#name: &mut [[T; #width]; #size]), assignments }
    };
    match kind {
        FunctionKind::Transforms => {
            let assignments = outputs.chunks(12).enumerate().map(|(i, values)| {
                let (i, value) = (proc_macro2::Literal::usize_unsuffixed(i), matrix(values));
                Assignment::new(values, quote!(transforms[#i] = #value;))
            });
            let assignments = assignments.collect();
            let argument = quote!(transforms: &mut [[[T; 3]; 4]; FRAMES + 1]);
            (vec![FilledArgument { argument, assignments }], None)
        }
        FunctionKind::Pose => (vec![pose(outputs)], None),
        FunctionKind::ErrorJacobian | FunctionKind::JointJacobian | FunctionKind::ParameterJacobian => {
            let euler = spec.orientation == Orientation::EulerYzx;
            let (outputs, margin) = match outputs.split_last() {
                Some((margin, outputs)) if euler => (outputs, Some(margin.to_token_stream())),
                _ => (outputs, None),
            };
            let size = match kind {
                FunctionKind::ErrorJacobian => quote!(ERRORS),
                FunctionKind::JointJacobian => quote!(VARIABLES),
                _ => quote!(PARAMETERS),
            };
            let (first, rest) = outputs.split_at(12);
            let mut columns = rows("columns", size, 6, rest);
            unused_if_empty(&mut columns, "columns", kind);
            (vec![pose(first), columns], margin)
        }
        FunctionKind::Effects => {
            let assignments = vec![Assignment::new(outputs, quote!(*effects = [#(#outputs),*];))];
            (vec![FilledArgument { argument: quote!(effects: &mut [T; EFFECTS]), assignments }], None)
        }
        FunctionKind::GeneralizedErrors => (vec![rows("errors", quote!(FRAMES), 6, outputs)], None),
    }
}

/// A Jacobian of nothing, as by the parameters of a spec that has none, is an argument that is never used.
fn unused_if_empty(result: &mut FilledArgument, name: &str, kind: FunctionKind) {
    if result.assignments.is_empty() && kind == FunctionKind::ParameterJacobian {
        let name = format_ident!("_{name}");
        result.argument = quote!(#name: &mut [[T; 6]; PARAMETERS]);
    }
    if result.assignments.is_empty() && kind == FunctionKind::JointJacobian {
        let name = format_ident!("_{name}");
        result.argument = quote!(#name: &mut [[T; 6]; VARIABLES]);
    }
}

fn documentation(kind: FunctionKind, program: &Program, margin: bool) -> Vec<String> {
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
    };
    let mut lines = vec![format!(" {what}")];
    if margin {
        lines.push(String::new());
        lines.push(" Returns `cos ρ`; where that is 0, rows 4–6 are not finite.".to_owned());
    }
    lines.push(String::new());
    lines.push(format!(" {}.", program.operations()));
    lines
}
