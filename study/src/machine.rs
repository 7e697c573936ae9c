//! The manipulator that a job is about: a spec file, or a shipped one.

use std::ffi::OsStr;
use std::ops::Deref;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use abbe::analysis::Sweepable;
use abbe::{Class, Distribution};
use abbe_interpreter::Interpreter;
use abbe_manipulators::{SHIPPED, Shipped};
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::document::Document;
use abbe_spec::{Magnitude, Source, Spec};

use crate::changes::Changes;
use crate::named;

/// A spec, and what was shipped with it.
#[derive(Clone)]
pub struct Machine {
    /// What its file says, with the changes that were made.
    pub spec: Arc<Spec>,
    /// What it is called in messages: the path of its file, or the shipped name.
    pub origin: String,
    /// Its file, if it was read from one.
    pub file: Option<PathBuf>,
    /// What is shipped with it, if it is a shipped one.
    pub shipped: Option<&'static Shipped>,
    /// Whether the spec is no longer that of the generated code.
    changed: bool,
    /// The inputs that were set: they stay where they are.
    fixed_inputs: Vec<usize>,
}

impl Machine {
    /// Reads the spec that an argument names.
    ///
    /// A file that exists, and whatever looks like a path, is a file; all else must be a shipped name.
    pub fn find(argument: impl AsRef<OsStr>) -> Result<Self, Diagnostics> {
        let path = Path::new(&argument);
        let name = path.to_string_lossy();
        let shipped = SHIPPED.iter().find(|shipped| shipped.name == name);
        match shipped {
            Some(shipped) if !named::is_path(path) => Self::shipped(shipped),
            None if !named::is_path(path) => {
                let names = SHIPPED.iter().map(|shipped| shipped.name).collect::<Vec<_>>();
                Err(named::unknown("SPEC", &name, &names, "shipped manipulator"))
            }
            _ => {
                let file = Some(path.to_owned());
                Ok(Self { file, ..Self::new(Spec::read(path)?, &name, None) })
            }
        }
    }

    /// A shipped manipulator, with the file name that its generated code carries.
    pub fn shipped(shipped: &'static Shipped) -> Result<Self, Diagnostics> {
        let spec = Spec::parse(&format!("{}.toml", shipped.name), shipped.spec)?;
        Ok(Self::new(spec, shipped.name, Some(shipped)))
    }

    /// A spec of one's own; `origin` is what messages call it.
    pub fn of_spec(spec: Spec, origin: &str) -> Self {
        Self::new(spec, origin, None)
    }

    fn new(spec: Spec, origin: &str, shipped: Option<&'static Shipped>) -> Self {
        Self {
            spec: Arc::new(spec),
            origin: origin.to_owned(),
            file: None,
            shipped,
            changed: false,
            fixed_inputs: Vec::new(),
        }
    }

    /// Makes changes: what is set becomes nominal. Generated code, which knows nothing of them, is not run any more.
    pub fn change(&mut self, changes: &Changes) {
        changes.apply(Arc::make_mut(&mut self.spec));
        self.changed |= !changes.is_empty();
        self.fixed_inputs.extend(changes.inputs());
    }

    /// Adds what is not known of the magnitudes of repeatable sources: of each whose magnitude has a standard deviation σ a
    /// random source, normal, whose errors are σ times those of magnitude 1.
    pub fn add_magnitude_errors(&mut self) {
        let errors = self.spec.sources.iter().filter_map(magnitude_error).collect::<Vec<_>>();
        if self.spec.sources.iter().any(is_magnitude_error) || !errors.is_empty() {
            let sources = &mut Arc::make_mut(&mut self.spec).sources;
            sources.retain(|source| !is_magnitude_error(source));
            sources.extend(errors);
            self.changed = true;
        }
    }

    /// The inputs that changes have set: no workspace moves them.
    pub fn fixed_inputs(&self) -> &[usize] {
        &self.fixed_inputs
    }

    /// The functions of the manipulator: its generated code if it is shipped, not changed, and `compiled` may be used; else
    /// its spec, interpreted.
    pub fn evaluator(&self, compiled: bool) -> Evaluator {
        match self.shipped {
            Some(shipped) if compiled && !self.changed => Evaluator::Compiled(shipped.compiled),
            _ => Evaluator::Interpreted(Box::new(Interpreter::new(self.spec.clone()))),
        }
    }

    /// The text of the spec, as it was before changes.
    pub fn text(&self) -> Result<String, Diagnostics> {
        match self.shipped {
            Some(shipped) => Ok(shipped.spec.to_owned()),
            None => {
                let file = self.file.as_deref().unwrap_or(Path::new(&self.origin));
                Ok(Document::read(file)?.text.to_string())
            }
        }
    }
}

/// A manipulator that can be evaluated, one way or the other.
pub enum Evaluator {
    /// By its generated code.
    Compiled(&'static dyn Sweepable),
    /// By its spec.
    Interpreted(Box<Interpreter>),
}

impl Deref for Evaluator {
    type Target = dyn Sweepable;

    fn deref(&self) -> &Self::Target {
        match self {
            Self::Compiled(manipulator) => *manipulator,
            Self::Interpreted(interpreter) => &**interpreter,
        }
    }
}

fn magnitude_error(source: &Source) -> Option<Source> {
    let Magnitude { standard_deviation, degrees_of_freedom, .. } = source.magnitude?;
    Some(Source {
        name: format!("{} (its magnitude)", source.name),
        class: Class::Random(Distribution::Normal),
        degrees_of_freedom,
        magnitude: Some(Magnitude {
            value: standard_deviation?,
            standard_deviation: None,
            degrees_of_freedom: f64::INFINITY,
        }),
        ..source.clone()
    })
}

/// No random source of a file has a magnitude.
fn is_magnitude_error(source: &Source) -> bool {
    source.class != Class::Repeatable && source.magnitude.is_some()
}
