//! The macro `manipulator!`, which expands a spec file to a module.

use std::path::Path;

use proc_macro::TokenStream;
use quote::quote;
use syn::LitStr;

/// Generates the module of a manipulator from its spec file. The path is relative to the crate's
/// `Cargo.toml`.
///
/// ```ignore
/// abbe_macro::manipulator!("specs/arm.toml");
/// let (pose, error_jacobian) = arm::error_jacobian(&q, &arm::Parameters::NOMINAL)?;
/// ```
///
/// The crate is compiled again when the file changes. Mistakes in the file are reported as compile
/// errors that show their position in the file.
#[proc_macro]
pub fn manipulator(input: TokenStream) -> TokenStream {
    let file = match syn::parse2::<LitStr>(input.into()) {
        Ok(file) => file,
        Err(error) => return error.into_compile_error().into(),
    };
    expand(&file).unwrap_or_else(syn::Error::into_compile_error).into()
}

fn expand(file: &LitStr) -> syn::Result<proc_macro2::TokenStream> {
    let fail = |message: &str| Err(syn::Error::new(file.span(), message));
    let Some(root) = std::env::var_os("CARGO_MANIFEST_DIR") else {
        return fail("CARGO_MANIFEST_DIR is not set: build with cargo");
    };
    let path = Path::new(&root).join(file.value());
    match abbe_spec::Spec::read(&path) {
        Ok(spec) => {
            let module: proc_macro2::TokenStream = abbe_codegen::print::rust(&spec).parse()?;
            let files = [&path].into_iter().chain(&spec.beside).map(|path| path.to_string_lossy());
            // Makes the compiler track the files as dependencies.
            Ok(quote! {
                #module
                #(const _: &[u8] = include_bytes!(#files);)*
            })
        }
        Err(mut diagnostics) => {
            diagnostics.path = file.value();
            fail(&format!("mistakes in the spec\n{diagnostics}"))
        }
    }
}

#[cfg(test)]
mod tests;
