//! The manipulator that a command is about: a spec file, or a shipped one.

use std::ops::Deref;
use std::path::Path;

use abbe::Manipulator;
use abbe_codegen::diagnostic::Diagnostics;
use abbe_codegen::document::Document;
use abbe_codegen::expr::find_name;
use abbe_codegen::spec::Spec;
use abbe_interpreter::Interpreter;
use abbe_manipulators::{SHIPPED, Shipped};

use crate::failure::Failure;

/// A spec, and the manipulator it was shipped as.
pub(crate) struct Found {
    pub(crate) spec: Spec,
    /// What it is called in messages: the path, or the shipped name.
    pub(crate) origin: String,
    /// What is shipped with it, if it is a shipped one.
    pub(crate) shipped: Option<&'static Shipped>,
}

impl Found {
    /// The manipulator: its generated code if it is shipped and `compiled` may be used, else its spec, interpreted.
    pub(crate) fn manipulator(&self, compiled: bool) -> Runnable<'_> {
        match self.shipped {
            Some(shipped) if compiled => Runnable::Compiled(shipped.compiled),
            _ => Runnable::Interpreted(Box::new(Interpreter::new(&self.spec))),
        }
    }
}

/// A manipulator, one way or the other.
pub(crate) enum Runnable<'s> {
    Compiled(&'static dyn Manipulator),
    Interpreted(Box<Interpreter<'s>>),
}

impl<'s> Deref for Runnable<'s> {
    type Target = dyn Manipulator + 's;

    fn deref(&self) -> &Self::Target {
        match self {
            Self::Compiled(manipulator) => *manipulator,
            Self::Interpreted(interpreter) => &**interpreter,
        }
    }
}

impl Found {
    /// The text of the spec.
    pub(crate) fn text(&self) -> Result<String, Failure> {
        match SHIPPED.iter().find(|shipped| shipped.name == self.origin && !Path::new(&self.origin).is_file())
        {
            Some(shipped) => Ok(shipped.spec.to_owned()),
            None => Ok(Document::read(Path::new(&self.origin))?.text.to_string()),
        }
    }
}

/// Reads the spec that an argument names.
///
/// A file that exists, and whatever looks like a path, is a file; all else must be a shipped name.
pub(crate) fn find(argument: &str) -> Result<Found, Failure> {
    let path = Path::new(argument);
    let is_path = argument.contains(std::path::is_separator) || argument.ends_with(".toml") || path.is_file();
    let shipped = SHIPPED.iter().find(|shipped| shipped.name == argument);
    match shipped {
        Some(shipped) if !is_path => shipped_spec(shipped),
        None if !is_path && !path.exists() => Err(unknown(argument)),
        _ => Ok(Found { spec: Spec::read(path)?, origin: argument.to_owned(), shipped: None }),
    }
}

/// A shipped manipulator, with the file name that its generated code carries.
pub(crate) fn shipped_spec(shipped: &'static Shipped) -> Result<Found, Failure> {
    let spec = Spec::parse(&format!("{}.toml", shipped.name), shipped.spec)?;
    Ok(Found { spec, origin: shipped.name.to_owned(), shipped: Some(shipped) })
}

fn unknown(argument: &str) -> Failure {
    let mut document = Document::new("SPEC", argument);
    let names = SHIPPED.iter().map(|shipped| shipped.name).collect::<Vec<_>>();
    find_name(&mut document, 0..argument.len(), argument, &names, "shipped manipulator");
    let Document { path, text, found } = document;
    let list = found.into_iter().map(|mistake| mistake.label("and no such file")).collect();
    Diagnostics { path, text, list }.into()
}
