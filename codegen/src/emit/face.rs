//! What users of a generated module see: constants, parameters, inputs, the checked functions, the trait.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::literal::number;
use super::text::escaped;
use crate::expr::LengthUnit;
use crate::spec::{Class, Component, Distribution, Orientation, Spec, VariableKind};

/// The name of the manipulator's type: `puma560` becomes `Puma560`, `my_arm` `MyArm`.
pub(super) fn type_name(name: &str) -> String {
    let words = name.split('_').filter(|word| !word.is_empty());
    let name: String = words.map(|word| word[..1].to_ascii_uppercase() + &word[1..]).collect();
    if name.starts_with(|c: char| c.is_ascii_alphabetic()) { name } else { format!("Manipulator{name}") }
}

/// The counts, and [`DESCRIPTION`] with every name, unit and limit.
pub(super) fn description(spec: &Spec) -> TokenStream {
    let counts = [
        ("FRAMES", spec.frames.len(), "How many frames there are: n."),
        ("ERRORS", 6 * spec.frames.len(), "How many generalized errors there are: 6n, the length of ε."),
        ("VARIABLES", spec.variables.len(), "How many joint variables there are: the length of `q`."),
        ("PARAMETERS", spec.parameters.len(), "How many structural parameters there are: the length of `s`."),
        ("INPUTS", spec.inputs.len(), "How many inputs there are: the length of `u`."),
        ("EFFECTS", spec.enabled_effects().count(), "How many errors the sources cause."),
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
    let effects = spec.enabled_sources().enumerate().flat_map(|(index, source)| {
        source.effects.iter().map(move |effect| {
            let [source, frame] = [index, effect.frame].map(proc_macro2::Literal::usize_unsuffixed);
            let component = component(effect.component);
            quote!(Effect::new(#source, #frame, #component))
        })
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

/// The checked functions, and the trait they come from.
pub(super) fn functions(spec: &Spec) -> TokenStream {
    let name = format_ident!("{}", type_name(&spec.name));
    let type_doc = format!(" {}, as a [`Manipulator`].", spec.title.trim_end_matches('.'));
    let margin = |call: TokenStream| match spec.orientation {
        Orientation::RotationVector => quote!(#call;),
        Orientation::EulerYzx => quote!(checks::margin(#call)?;),
    };
    let jacobian = |method: &str, size: &str| {
        let (method, size) = (format_ident!("{method}"), format_ident!("{size}"));
        let call = margin(quote!(raw::#method(q, s, &mut pose, columns)));
        quote! {
            fn #method(&self, q: &[f64], s: &[f64], columns: &mut [[f64; 6]]) -> Result<Pose, Error> {
                let q = checks::argument::<VARIABLES>(Quantity::Variables, q)?;
                let s = checks::argument::<PARAMETERS>(Quantity::Parameters, s)?;
                let columns = checks::result::<_, #size>(Quantity::Jacobian, columns)?;
                let mut pose = [[0.0; 3]; 4];
                #call
                checks::finite(Quantity::Pose, pose.as_flattened())?;
                checks::finite(Quantity::Jacobian, columns.as_flattened())?;
                Ok(Pose(pose))
            }
        }
    };
    let jacobians = [
        jacobian("error_jacobian", "ERRORS"),
        jacobian("joint_jacobian", "VARIABLES"),
        jacobian("parameter_jacobian", "PARAMETERS"),
    ];
    let checked = checked_functions(&name);
    quote! {
        #[doc = #type_doc]
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct #name;

        impl Manipulator for #name {
            fn description(&self) -> Description<'_> {
                DESCRIPTION
            }

            fn transforms(&self, q: &[f64], s: &[f64], transforms: &mut [Pose]) -> Result<(), Error> {
                let q = checks::argument::<VARIABLES>(Quantity::Variables, q)?;
                let s = checks::argument::<PARAMETERS>(Quantity::Parameters, s)?;
                let transforms = checks::result::<_, { FRAMES + 1 }>(Quantity::Pose, transforms)?;
                let mut columns = [[[0.0; 3]; 4]; FRAMES + 1];
                raw::transforms(q, s, &mut columns);
                checks::finite(Quantity::Pose, columns.as_flattened().as_flattened())?;
                *transforms = columns.map(Pose);
                Ok(())
            }

            fn pose(&self, q: &[f64], s: &[f64]) -> Result<Pose, Error> {
                let q = checks::argument::<VARIABLES>(Quantity::Variables, q)?;
                let s = checks::argument::<PARAMETERS>(Quantity::Parameters, s)?;
                let mut pose = [[0.0; 3]; 4];
                raw::pose(q, s, &mut pose);
                checks::finite(Quantity::Pose, pose.as_flattened())?;
                Ok(Pose(pose))
            }

            #(#jacobians)*

            fn effects(&self, q: &[f64], s: &[f64], u: &[f64], effects: &mut [f64]) -> Result<(), Error> {
                let q = checks::argument::<VARIABLES>(Quantity::Variables, q)?;
                let s = checks::argument::<PARAMETERS>(Quantity::Parameters, s)?;
                let u = checks::argument::<INPUTS>(Quantity::Inputs, u)?;
                let effects = checks::result::<_, EFFECTS>(Quantity::Errors, effects)?;
                checks::inputs(DESCRIPTION.inputs, u)?;
                raw::effects(q, s, u, effects);
                checks::finite(Quantity::Errors, effects)
            }

            fn generalized_errors(
                &self,
                q: &[f64],
                s: &[f64],
                u: &[f64],
                errors: &mut [[f64; 6]],
            ) -> Result<(), Error> {
                let q = checks::argument::<VARIABLES>(Quantity::Variables, q)?;
                let s = checks::argument::<PARAMETERS>(Quantity::Parameters, s)?;
                let u = checks::argument::<INPUTS>(Quantity::Inputs, u)?;
                let errors = checks::result::<_, FRAMES>(Quantity::Errors, errors)?;
                checks::inputs(DESCRIPTION.inputs, u)?;
                raw::generalized_errors(q, s, u, errors);
                checks::finite(Quantity::Errors, errors.as_flattened())
            }
        }

        #checked
    }
}

/// Functions with arrays of the right size, which therefore cannot be called with the wrong one.
fn checked_functions(name: &proc_macro2::Ident) -> TokenStream {
    let jacobian = |method: &str, size: &str, doc: &str| {
        let (method, size) = (format_ident!("{method}"), format_ident!("{size}"));
        let doc = format!(" {doc}; [`Error`] where that does not exist.");
        quote! {
            #[doc = #doc]
            pub fn #method(q: &[f64; VARIABLES], s: &Parameters) -> Result<(Pose, [[f64; 6]; #size]), Error> {
                let mut columns = [[0.0; 6]; #size];
                let pose = #name.#method(q, &s.to_array(), &mut columns)?;
                Ok((pose, columns))
            }
        }
    };
    let jacobians = [
        jacobian("error_jacobian", "ERRORS", "Pose and error Jacobian `J_e`, one `[f64; 6]` per column"),
        jacobian(
            "joint_jacobian",
            "VARIABLES",
            "Pose and joint Jacobian `∂X_T/∂q`, one `[f64; 6]` per variable",
        ),
        jacobian("parameter_jacobian", "PARAMETERS", "Pose and `∂X_T/∂s`, one `[f64; 6]` per parameter"),
    ];
    quote! {
        /// The pose of the tool point in `F_0`; [`Error`] if a number is not finite.
        pub fn pose(q: &[f64; VARIABLES], s: &Parameters) -> Result<Pose, Error> {
            #name.pose(q, &s.to_array())
        }

        #(#jacobians)*

        /// The errors that the sources cause, of random ones the magnitude, one per entry of
        /// [`DESCRIPTION`]`.effects`; [`Error`] if an input is outside its range.
        pub fn effects(q: &[f64; VARIABLES], s: &Parameters, u: &Inputs) -> Result<[f64; EFFECTS], Error> {
            let mut effects = [0.0; EFFECTS];
            #name.effects(q, &s.to_array(), &u.to_array(), &mut effects)?;
            Ok(effects)
        }

        /// ε: the sum of the repeatable sources, `e_x e_y e_z e_s e_r e_p` of each frame; [`Error`] if an input
        /// is outside its range.
        pub fn generalized_errors(
            q: &[f64; VARIABLES],
            s: &Parameters,
            u: &Inputs,
        ) -> Result<[[f64; 6]; FRAMES], Error> {
            let mut errors = [[0.0; 6]; FRAMES];
            #name.generalized_errors(q, &s.to_array(), &u.to_array(), &mut errors)?;
            Ok(errors)
        }
    }
}
