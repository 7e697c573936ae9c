//! The manipulator that a job is about: a spec file, or a shipped one.

use std::ffi::OsStr;
use std::ops::Deref;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use abbe::analysis::{Sweepable, Unevaluated, Workspace};
use abbe::{Class, Description, Distribution};
use abbe_interpreter::Interpreter;
use abbe_manipulators::{MECHANISMS, SHIPPED, Shipped};
use abbe_spec::expr::{Expression, Symbol};
use abbe_spec::option::{NamedOption, option};
use abbe_spec::{Diagnostics, Document, Factor, Magnitude, Source, Spec};

use crate::calibration::{calibration_errors, has_magnitude};
use crate::table_paths::with_table_paths;
use crate::{Changes, Result, mistake, named, number, open_loops};

/// Spec of a manipulator, with its generated code and study if it is a shipped one.
#[derive(Clone)]
pub struct Machine {
    /// Spec, with the changes applied.
    pub spec: Arc<Spec>,
    /// Name in messages: the path of its file, or the shipped name.
    pub origin: String,
    /// File that it was read from.
    pub file: Option<PathBuf>,
    /// Files and generated code of a shipped manipulator.
    pub shipped: Option<&'static Shipped>,
    /// True if the spec differs from that of the generated code.
    changed: bool,
    /// Indices of the inputs that changes fix.
    fixed_inputs: Vec<usize>,
    /// Indices of the parameters that changes set.
    set_parameters: Vec<usize>,
    /// Changes as they were written, each with the name of its option.
    stated_changes: Vec<(&'static str, String)>,
}

impl Machine {
    /// Returns the diagnostic for a configuration of a workspace without finite errors.
    pub(crate) fn not_evaluated(
        &self,
        workspace: &dyn Workspace,
        refused: &Unevaluated,
        description: &Description,
    ) -> Diagnostics {
        let home = workspace.home();
        let found = refused.configuration.and_then(|index| workspace.configuration(index).ok());
        let (at, here) = match &found {
            Some(configuration) => (number::configuration(configuration, home, &self.spec), configuration),
            None => ("home".to_owned(), home),
        };
        let machine = (&*self.spec, &here.q[..], &here.s[..]);
        open_loops::not_evaluated(&self.origin, &at, &refused.error, description, machine)
    }

    /// Reads the spec that an argument names: a file if it exists or looks like a path, else a
    /// shipped name.
    pub fn find(argument: impl AsRef<OsStr>) -> Result<Self> {
        let path = Path::new(&argument);
        let name = path.to_string_lossy();
        if named::is_path(path) {
            let file = Some(path.to_owned());
            return Ok(Self { file, ..Self::new(Spec::read(path)?, &name, None) });
        }
        Self::named(&name)?.ok_or_else(|| {
            let shipped = SHIPPED.iter().map(|shipped| shipped.name);
            let names: Vec<&str> = shipped.chain(MECHANISMS.iter().map(|(name, _)| *name)).collect();
            named::unknown("SPEC", &name, &names, "shipped manipulator")
        })
    }

    /// Returns the shipped manipulator with a name, if there is one.
    pub fn named(name: &str) -> Result<Option<Self>> {
        if let Some(shipped) = SHIPPED.iter().find(|shipped| shipped.name == name) {
            return Self::shipped(shipped).map(Some);
        }
        let Some((_, text)) = MECHANISMS.iter().find(|(known, _)| *known == name) else { return Ok(None) };
        Ok(Some(Self::new(Spec::parse(&format!("{name}.toml"), text)?, name, None)))
    }

    /// Returns a shipped manipulator.
    pub fn shipped(shipped: &'static Shipped) -> Result<Self> {
        let spec = Spec::parse(&format!("{}.toml", shipped.name), shipped.spec)?;
        Ok(Self::new(spec, shipped.name, Some(shipped)))
    }

    /// Returns the text of a shipped machine before changes.
    fn shipped_text(&self) -> Option<&'static str> {
        let mechanism = || MECHANISMS.iter().find(|(name, _)| *name == self.origin);
        self.shipped.map(|shipped| shipped.spec).or_else(|| Some(mechanism()?.1))
    }

    /// Returns whether a command can name the machine: a file, or a shipped one.
    pub fn is_named(&self) -> bool {
        self.file.is_some() || self.shipped_text().is_some()
    }

    /// Returns the machine of a spec that messages name `origin`.
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
            set_parameters: Vec::new(),
            stated_changes: Vec::new(),
        }
    }

    /// Applies changes: values that are set become nominal. The generated code no longer applies.
    pub fn change(&mut self, changes: &Changes) {
        changes.apply(Arc::make_mut(&mut self.spec));
        self.changed |= !changes.is_empty();
        for (symbol, _) in &changes.values {
            match *symbol {
                Symbol::Parameter(i) => self.set_parameters.push(i),
                Symbol::Input(i) => self.fixed_inputs.push(i),
                _ => {}
            }
        }
        self.stated_changes.extend_from_slice(&changes.stated);
    }

    /// Iterates over the changes that were made by options.
    pub fn stated_changes(&self) -> impl Iterator<Item = NamedOption> {
        self.stated_changes.iter().map(|(name, value)| option(name, value))
    }

    /// Adds the uncertainty of the repeatable errors as normal random sources, after all others: σ
    /// times the errors of magnitude 1 for each source with a standard deviation σ of its
    /// magnitude, and the covariance of a calibration, which includes that of the magnitudes that
    /// it identified.
    pub fn add_uncertainties(&mut self) {
        let spec = &self.spec;
        let own = spec.sources.iter().enumerate().filter(|(i, _)| !has_magnitude(spec, *i));
        let magnitudes = own.filter_map(|(_, source)| magnitude_error(source));
        let added: Vec<Source> = magnitudes.chain(calibration_errors(spec)).collect();
        let is_added = |source: &Source| is_magnitude_error(source) || source.is_calibration_error();
        if spec.sources.iter().any(is_added) || !added.is_empty() {
            let sources = &mut Arc::make_mut(&mut self.spec).sources;
            sources.retain(|source| !is_added(source));
            sources.extend(added);
            self.changed = true;
        }
    }

    /// Returns true if the spec has the covariance of a calibration.
    pub fn is_calibrated(&self) -> bool {
        !self.spec.covariance.of.is_empty()
    }

    /// Returns the indices of the inputs that changes fix: no workspace varies them.
    pub fn fixed_inputs(&self) -> &[usize] {
        &self.fixed_inputs
    }

    /// Returns the names of the parameters of the tool that changes set.
    pub fn set_tool_parameters(&self) -> Vec<&str> {
        let symbols = self.spec.tool.iter().flat_map(Factor::expressions).flat_map(Expression::symbols);
        let of_tool = symbols.collect::<Vec<_>>();
        let set = self.set_parameters.iter().filter(|i| of_tool.contains(&Symbol::Parameter(**i)));
        set.map(|i| &*self.spec.parameters[*i].name).collect()
    }

    /// Returns the changes, followed by other options of a run, for its record.
    pub fn options_with(
        &self,
        others: impl IntoIterator<Item = (&'static str, String)>,
    ) -> Vec<(&'static str, String)> {
        let others = others.into_iter().filter(|(_, value)| !value.is_empty());
        self.stated_changes.iter().cloned().chain(others).collect()
    }

    /// Returns the machine with all tables held at their ends.
    pub fn with_held_tables(&self) -> Self {
        Self { spec: Arc::new(self.spec.with_held_tables()), ..self.clone() }
    }

    /// Returns the functions of the manipulator: generated code if it is shipped, unchanged and
    /// `compiled` allows it, else an interpreter of its spec.
    pub fn evaluator(&self, compiled: bool) -> Evaluator {
        match self.shipped {
            Some(shipped) if compiled && !self.changed => Evaluator::Compiled(shipped.compiled),
            _ => Evaluator::Interpreted(Box::new(Interpreter::new(self.spec.clone()))),
        }
    }

    /// Returns whether changes are applied to the spec.
    pub fn is_changed(&self) -> bool {
        self.changed
    }

    /// Fails unless the frames are a chain. `refused` says what is not done for other machines,
    /// `instead` what to do.
    pub fn require_chain(&self, refused: &str, instead: &str) -> Result<()> {
        let structure = match self.spec.is_serial() {
            true => return Ok(()),
            false if self.spec.loops.is_empty() => "branches",
            false => "closed loops",
        };
        let message = format!("{refused}: machines with {structure} are not supported here yet");
        Err(mistake::with_help(&self.origin, message, instead))
    }

    /// Returns the text of the spec before changes.
    pub fn text(&self) -> Result<String> {
        let path = self.file.as_deref().unwrap_or(Path::new(&self.origin));
        let shipped = self.shipped_text().filter(|_| self.file.is_none());
        shipped.map_or_else(|| Ok(Document::read(path)?.text.to_string()), |text| Ok(text.to_owned()))
    }

    /// Returns the text of the spec before changes for another file: relative paths of tables lead
    /// to the same files.
    pub fn text_for(&self, path: &Path) -> Result<String> {
        let folder = |file: &Path| file.parent().map(Path::to_owned).unwrap_or_default();
        let text = self.text()?;
        Ok(match &self.file {
            Some(file) => with_table_paths(&text, &folder(file), &folder(path)),
            None => text,
        })
    }
}

/// Manipulator as generated code or as an interpreted spec.
pub enum Evaluator {
    /// Generated code.
    Compiled(&'static dyn Sweepable),
    /// Interpreter of the spec.
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
        name: magnitude_error_name(source),
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

fn magnitude_error_name(source: &Source) -> String {
    format!("{} (its magnitude)", source.name)
}

/// Returns the index of the source whose factor and switch a source shares: its own; that of the
/// source whose magnitude is uncertain; or `None` for an error of the calibration.
pub(crate) fn followed_source(spec: &Spec, index: usize) -> Option<usize> {
    let source = &spec.sources[index];
    match source {
        _ if source.is_calibration_error() => None,
        _ if is_magnitude_error(source) => {
            spec.sources.iter().position(|other| magnitude_error_name(other) == source.name)
        }
        _ => Some(spec.whole(index)),
    }
}

/// No random source of a file has a magnitude.
fn is_magnitude_error(source: &Source) -> bool {
    source.class != Class::Repeatable && source.magnitude.is_some()
}
