//! The module of a manipulator.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::face;
use super::header::header;
use super::literal::looks_like_named;
use super::raw::raw_function;
use crate::chain::Model;
use crate::program::{FunctionKind, Operand, Program, functions};
use crate::spec::{Class, Spec};

/// The source of a manipulator's module, `pub mod name { … }`: formatted, the same bytes every time.
pub fn rust(spec: &Spec) -> String {
    let file = syn::parse2(rust_tokens(spec)).expect("generated tokens are a module");
    prettyplease::unparse(&file)
}

/// The tokens of [`rust`].
pub fn rust_tokens(spec: &Spec) -> TokenStream {
    let model = Model::new(spec);
    let functions = functions(&model);
    let documentation = header(spec, &functions);
    let raw = functions.iter().map(|(kind, program)| raw_function(spec, *kind, program));
    let name = format_ident!("{}", spec.name);
    let (description, named_values, face) =
        (face::description(spec, &model.effects), face::named_values(spec), face::checked(spec));
    let allowed = allowed_lints(spec, &functions);
    let imports = imports(spec, &model);
    quote! {
        #(#[doc = #documentation])*
        #(#allowed)*
        pub mod #name {
            use ::abbe::{#(#imports),*};

            #description

            #named_values

            #face

            /// The same as functions of plain arrays, generic over the scalar and without checks: what is not
            /// finite stays so.
            pub mod raw {
                use super::{DISTINCT, EFFECTS, ERRORS, FRAMES, INPUTS, PARAMETERS, SOURCES, VARIABLES};
                use ::abbe::Scalar;

                #(#raw)*
            }
        }
    }
}

/// Lints that numbers and names of the spec, not the generated code, would trip.
fn allowed_lints(spec: &Spec, functions: &[(FunctionKind, Program)]) -> Vec<TokenStream> {
    let mut allowed = Vec::new();
    let names = spec.parameters.iter().map(|p| &p.name).chain(spec.inputs.iter().map(|i| &i.name));
    let mut names = names.chain(spec.variables.iter().map(|v| &v.name));
    if names.any(|name| name.contains(|c: char| c.is_ascii_uppercase()) || name.contains("__")) {
        allowed.push(quote!(#[allow(non_snake_case)]));
    }
    let steps = functions.iter().flat_map(|(_, program)| &program.steps);
    let operands = steps.flat_map(|step| step.action.operands());
    let constants = operands.filter_map(|operand| match operand {
        Operand::Constant(value) => Some(value),
        _ => None,
    });
    let values = spec.parameters.iter().map(|p| p.value).chain(spec.inputs.iter().map(|i| i.value));
    let limits = spec.variables.iter().flat_map(|v| [v.limits[0], v.limits[1], v.home]);
    let ranges = spec.inputs.iter().flat_map(|i| i.range);
    let outputs =
        functions.iter().flat_map(|(_, program)| &program.outputs).filter_map(|output| match output {
            Operand::Constant(value) => Some(*value),
            _ => None,
        });
    if constants.chain(values).chain(limits).chain(ranges).chain(outputs).any(looks_like_named) {
        allowed.push(quote!(#[allow(clippy::approx_constant)]));
    }
    allowed
}

fn imports(spec: &Spec, model: &Model) -> Vec<TokenStream> {
    let mut names = vec!["Description", "Frame", "LengthUnit", "Orientation"];
    if !spec.variables.is_empty() {
        names.extend(["Variable", "VariableKind"]);
    }
    if !spec.parameters.is_empty() {
        names.push("Parameter");
    }
    if !spec.inputs.is_empty() {
        names.push("Input");
    }
    if spec.enabled_sources().next().is_some() {
        names.extend(["Class", "Source"]);
    }
    if spec.enabled_sources().any(|source| source.class != Class::Repeatable) {
        names.push("Distribution");
    }
    if !model.effects.is_empty() {
        names.extend(["Component", "Effect"]);
    }
    names.sort_unstable();
    names
        .into_iter()
        .map(|name| {
            let name = format_ident!("{name}");
            quote!(#name)
        })
        .collect()
}
