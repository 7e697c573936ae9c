//! What users of a generated module see: constants, parameters, inputs, the checked functions, the trait.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::literal::number;
use super::text::escaped;
use crate::chain::EffectNode;
use crate::expr::LengthUnit;
use crate::spec::{Class, Component, Distribution, Orientation, Spec, VariableKind};

/// Types that a generated module has or uses already.
const TAKEN: [&str; 16] = [
    "Class",
    "Component",
    "Description",
    "Distribution",
    "Effect",
    "Frame",
    "Input",
    "Inputs",
    "LengthUnit",
    "Orientation",
    "Parameter",
    "Parameters",
    "Self",
    "Source",
    "Variable",
    "VariableKind",
];

/// The name of the manipulator's type: `puma560` becomes `Puma560`, `my_arm` `MyArm`.
pub(super) fn type_name(name: &str) -> String {
    let words = name.split('_').filter(|word| !word.is_empty());
    let name: String = words.map(|word| word[..1].to_ascii_uppercase() + &word[1..]).collect();
    let is_free = name.starts_with(|c: char| c.is_ascii_alphabetic()) && !TAKEN.contains(&name.as_str());
    if is_free { name } else { format!("Manipulator{name}") }
}

/// The counts, and [`DESCRIPTION`] with every name, unit and limit.
pub(super) fn description(spec: &Spec, effects: &[EffectNode]) -> TokenStream {
    let distinct = match spec.orientation {
        Orientation::RotationVector => 6,
        Orientation::EulerYzx => 9,
    };
    let counts = [
        ("FRAMES", spec.frames.len(), "How many frames there are: n."),
        ("ERRORS", 6 * spec.frames.len(), "How many generalized errors there are: 6n, the length of ε."),
        ("VARIABLES", spec.variables.len(), "How many joint variables there are: the length of `q`."),
        ("PARAMETERS", spec.parameters.len(), "How many structural parameters there are: the length of `s`."),
        ("INPUTS", spec.inputs.len(), "How many inputs there are: the length of `u`."),
        ("EFFECTS", effects.len(), "How many errors the sources cause."),
        ("SOURCES", spec.enabled_sources().count(), "How many sources there are."),
        (
            "DISTINCT",
            distinct,
            "How many vectors of a frame's six columns of `J_e` are neither zero nor repeated.",
        ),
    ];
    let counts = counts.map(|(name, count, doc)| {
        let (name, doc) = (format_ident!("{name}"), format!(" {doc}"));
        let count = proc_macro2::Literal::usize_unsuffixed(count);
        quote!(#[doc = #doc] pub const #name: usize = #count;)
    });
    let Spec { name, title, .. } = spec;
    let length = match spec.length {
        LengthUnit::Metre => quote!(LengthUnit::Metre),
        LengthUnit::Millimetre => quote!(LengthUnit::Millimetre),
    };
    let orientation = match spec.orientation {
        Orientation::RotationVector => quote!(Orientation::RotationVector),
        Orientation::EulerYzx => quote!(Orientation::EulerYzx),
    };
    let option = |index: Option<usize>| match index {
        Some(index) => {
            let index = proc_macro2::Literal::usize_unsuffixed(index);
            quote!(Some(#index))
        }
        None => quote!(None),
    };
    let frames = spec.frames.iter().map(|frame| {
        let (name, variable) = (&frame.name, option(frame.variable));
        quote!(Frame::new(#name, #variable))
    });
    let variables = spec.variables.iter().map(|variable| {
        let kind = match variable.kind {
            VariableKind::Revolute => quote!(VariableKind::Revolute),
            VariableKind::Prismatic => quote!(VariableKind::Prismatic),
        };
        let (name, limits, home) = (&variable.name, interval(variable.limits), number(variable.home));
        quote!(Variable::new(#name, #kind, #limits, #home))
    });
    let parameters = spec.parameters.iter().map(|parameter| {
        let (name, value) = (&parameter.name, number(parameter.value));
        let unit = &parameter.unit;
        quote!(Parameter::new(#name, #value, #unit))
    });
    let inputs = spec.inputs.iter().map(|input| {
        let (name, value, range) = (&input.name, number(input.value), interval(input.range));
        let unit = &input.unit;
        quote!(Input::new(#name, #value, #range, #unit))
    });
    let sources = spec.enabled_sources().map(|source| {
        let class = match source.class {
            Class::Repeatable => quote!(Class::Repeatable),
            Class::Random(Distribution::Uniform) => quote!(Class::Random(Distribution::Uniform)),
            Class::Random(Distribution::Normal) => quote!(Class::Random(Distribution::Normal)),
        };
        let (name, reference) = (&source.name, &source.reference);
        quote!(Source::new(#name, #class, #reference))
    });
    let effects = effects.iter().map(|effect| {
        let [source, frame] = [effect.source, effect.frame].map(proc_macro2::Literal::usize_unsuffixed);
        let component = component(effect.component);
        quote!(Effect::new(#source, #frame, #component))
    });
    quote! {
        #(#counts)*

        /// Names, units, limits, sources.
        pub const DESCRIPTION: Description<'static> = Description {
            name: #name,
            title: #title,
            length: #length,
            orientation: #orientation,
            frames: &[#(#frames),*],
            variables: &[#(#variables),*],
            parameters: &[#(#parameters),*],
            inputs: &[#(#inputs),*],
            sources: &[#(#sources),*],
            effects: &[#(#effects),*],
        };
    }
}

fn interval([lower, upper]: [f64; 2]) -> TokenStream {
    let (lower, upper) = (number(lower), number(upper));
    quote!([#lower, #upper])
}

fn component(component: Component) -> TokenStream {
    let name = format_ident!("{component:?}");
    quote!(Component::#name)
}

/// `Parameters` and `Inputs`: named fields with their default values.
pub(super) fn named_values(spec: &Spec) -> TokenStream {
    let parameters: Vec<Field<'_>> =
        spec.parameters.iter().map(|p| Field::new(&p.name, &p.description, &p.unit, p.value)).collect();
    let inputs: Vec<Field<'_>> =
        spec.inputs.iter().map(|i| Field::new(&i.name, &i.description, &i.unit, i.value)).collect();
    let parameters = record(
        "Parameters",
        "The structural parameters `s`, which may be set at run time.",
        "Their nominal values.",
        "PARAMETERS",
        &parameters,
    );
    let inputs = record(
        "Inputs",
        "The inputs `u`: what changes from use to use.",
        "Their default values.",
        "INPUTS",
        &inputs,
    );
    quote!(#parameters #inputs)
}

struct Field<'s> {
    name: &'s str,
    documentation: String,
    value: f64,
}

impl<'s> Field<'s> {
    fn new(name: &'s str, description: &str, unit: &str, value: f64) -> Self {
        let unit = if unit.is_empty() { "rad or a pure number" } else { unit };
        let description = escaped(description);
        let description = description.trim_end_matches('.');
        let documentation = match description.is_empty() {
            true => format!(" In {unit}."),
            false => format!(" {description}; {unit}."),
        };
        Self { name, documentation, value }
    }
}

fn record(name: &str, doc: &str, nominal_doc: &str, count: &str, fields: &[Field<'_>]) -> TokenStream {
    let (doc, nominal_doc) = (format!(" {doc}"), format!(" {nominal_doc}"));
    let (name, count) = (format_ident!("{name}"), format_ident!("{count}"));
    let names: Vec<_> = fields.iter().map(|field| format_ident!("{}", field.name)).collect();
    let docs = fields.iter().map(|field| &field.documentation);
    let values = fields.iter().map(|field| number(field.value));
    let array_doc = " The values in the order of [`DESCRIPTION`].";
    quote! {
        #[doc = #doc]
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct #name {
            #(#[doc = #docs] pub #names: f64,)*
        }

        impl #name {
            #[doc = #nominal_doc]
            pub const NOMINAL: Self = Self { #(#names: #values),* };

            #[doc = #array_doc]
            pub const fn to_array(&self) -> [f64; #count] {
                [#(self.#names),*]
            }
        }

        impl Default for #name {
            fn default() -> Self {
                Self::NOMINAL
            }
        }
    }
}

/// The checked functions and the trait: the same for all, so the runtime has them.
pub(super) fn checked(spec: &Spec) -> TokenStream {
    let name = format_ident!("{}", type_name(&spec.name));
    let doc =
        format!(" {}, as a [`Manipulator`](::abbe::Manipulator).", escaped(spec.title.trim_end_matches('.')));
    quote! {
        ::abbe::checked_face! {
            #[doc = #doc]
            #name
        }
    }
}
