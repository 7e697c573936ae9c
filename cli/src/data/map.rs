//! What the columns of a data file are.

use std::path::Path;
use std::sync::Arc;

use abbe::analysis::sampling;
use abbe::identify::{Observation, Seen, Uncertainty};
use abbe::{Description, Pose};
use abbe_codegen::diagnostic::{Diagnostic, Diagnostics, Span};
use abbe_codegen::document::Document;
use abbe_codegen::spec::VariableKind;

use super::seen::Turn;

/// A column of the file, and where the map names it.
#[derive(Clone, Debug)]
pub(crate) struct Column {
    pub(crate) name: String,
    pub(super) span: Span,
}

/// Where a value comes from.
#[derive(Clone, Debug)]
pub(crate) enum Channel {
    /// A column, times a factor that makes it coherent.
    Column(Column, f64),
    /// It is the same in every row.
    Fixed(f64),
}

/// A target on the end effector.
#[derive(Clone, Debug)]
pub(crate) struct Target {
    pub(crate) columns: [Column; 3],
    pub(crate) factor: f64,
    /// In the frame of the tool.
    pub(crate) position: [f64; 3],
}

/// What was measured.
#[derive(Clone, Debug)]
pub(crate) enum Layout {
    /// The tool point.
    Point([Column; 3], f64),
    /// The commanded tool point, and commanded minus actual.
    Difference([Column; 3], [Column; 3], f64),
    /// Targets on the end effector.
    Targets(Vec<Target>),
    /// Position and orientation.
    Pose([Column; 3], f64, Turn),
}

/// A map, read and checked.
#[derive(Clone, Debug)]
pub(crate) struct Map {
    pub(crate) title: String,
    pub(crate) uncertainty: Uncertainty,
    /// Whether the instrument stands anywhere.
    pub(crate) base_unknown: bool,
    /// Whether it sees in `F_0` exactly: nothing of the base is unknown.
    pub(crate) base_exact: bool,
    /// By variable of the spec.
    pub(crate) joints: Vec<Channel>,
    /// By input of the spec.
    pub(crate) inputs: Vec<Channel>,
    pub(crate) layout: Layout,
    pub(super) path: String,
    pub(super) text: Arc<str>,
}

impl Map {
    /// The map in a file, or the one shipped under that name.
    pub(crate) fn find(argument: &Path, spec: &abbe_codegen::spec::Spec) -> Result<Self, Diagnostics> {
        let name = argument.to_string_lossy();
        let shipped = abbe_manipulators::MAPS.iter().find(|(shipped, _)| *shipped == name);
        let document = match shipped {
            Some((name, text)) if !argument.exists() => Document::new(format!("maps/{name}.toml"), *text),
            _ => Document::read(argument)?,
        };
        super::read::map(document, spec)
    }

    /// The map of a file whose columns are named as the spec names its variables and inputs: in its length unit and in rad.
    /// What has no column among the inputs is nominal.
    pub(crate) fn of_names(header: &[String], spec: &abbe_codegen::spec::Spec) -> Result<Self, Diagnostics> {
        let column =
            |name: &str, unit: &str| format!("{name} = {{ column = \"{name}\", unit = \"{unit}\" }}\n");
        let length = spec.length.symbol();
        let joints = spec.variables.iter().map(|variable| match variable.kind {
            VariableKind::Revolute => column(&variable.name, "rad"),
            VariableKind::Prismatic => column(&variable.name, length),
        });
        let inputs = spec.inputs.iter().filter(|input| header.contains(&input.name));
        let inputs = inputs.map(|input| column(&input.name, &input.unit));
        let text = format!(
            "[data]\nuncertainty = \"1 mm\"\n\n[joints]\n{}\n[inputs]\n{}\n[point]\ncolumns = [\"\", \"\", \"\"]\nunit = \"mm\"\n",
            joints.collect::<String>(),
            inputs.collect::<String>()
        );
        super::read::map(Document::new("the spec's own names, as there is no --map", text), spec)
    }

    /// Whether whole poses are measured.
    pub(crate) fn is_pose(&self) -> bool {
        matches!(self.layout, Layout::Pose(..))
    }

    /// The targets in the frame of the tool: the tool point itself if there are no others.
    pub(crate) fn targets(&self) -> Vec<[f64; 3]> {
        match &self.layout {
            Layout::Targets(targets) => targets.iter().map(|target| target.position).collect(),
            _ => vec![[0.0; 3]],
        }
    }

    /// The variables that have a column.
    pub(crate) fn moved(&self) -> impl Iterator<Item = usize> {
        let columns = self.joints.iter().enumerate();
        columns.filter(|(_, channel)| matches!(channel, Channel::Column(..))).map(|(i, _)| i)
    }

    /// A row that is to be measured at `q`; what the map holds fixed is so, inputs are nominal.
    pub(crate) fn asked(&self, mut q: Vec<f64>, description: &Description) -> Observation {
        for (value, channel) in q.iter_mut().zip(&self.joints) {
            if let Channel::Fixed(fixed) = channel {
                *value = *fixed;
            }
        }
        let u = sampling::nominal_inputs(description);
        Observation { q, u, seen: self.unseen() }
    }

    /// What is seen before anything is.
    pub(super) fn unseen(&self) -> Seen {
        match self.is_pose() {
            true => Seen::Pose(Pose::IDENTITY),
            false => Seen::Points(vec![Some([0.0; 3]); self.targets().len()]),
        }
    }

    /// The columns of joints and inputs.
    pub(super) fn commanded(&self) -> impl Iterator<Item = &Column> {
        self.joints.iter().chain(&self.inputs).filter_map(|channel| match channel {
            Channel::Column(column, _) => Some(column),
            Channel::Fixed(_) => None,
        })
    }

    /// The columns of what was measured.
    pub(super) fn measured(&self) -> Vec<&Column> {
        match &self.layout {
            Layout::Point(columns, _) => columns.iter().collect(),
            Layout::Difference(target, difference, _) => target.iter().chain(difference).collect(),
            Layout::Targets(targets) => targets.iter().flat_map(|target| &target.columns).collect(),
            Layout::Pose(position, _, turn) => position.iter().chain(turn.columns()).collect(),
        }
    }

    /// The mistake that columns are missing: all of them, each where the map names it.
    pub(super) fn missing(&self, file: &Path, columns: &[&Column], header: &[String]) -> Diagnostics {
        let wanted: Vec<&str> =
            self.commanded().chain(self.measured()).map(|column| column.name.as_str()).collect();
        let list = columns.iter().map(|column| {
            // Those that the map has found are not what is missing.
            let free = header.iter().filter(|name| !wanted.contains(&name.as_str()));
            let similarity = |name: &&String| match name.contains(column.name.as_str()) {
                true => 0.9,
                false => strsim::jaro_winkler(&column.name, name),
            };
            let near = free.max_by(|a, b| similarity(a).total_cmp(&similarity(b)));
            let near = near.filter(|name| similarity(name) > 0.55);
            let help = match near {
                Some(name) => format!("did you mean `{name}`? there are: {}", header.join(", ")),
                None => format!("there are: {}", header.join(", ")),
            };
            let message =
                format!("there is no column `{}` in {}", column.name.escape_debug(), file.display());
            Diagnostic::new(column.span.clone(), message).label("the map wants it").help(help)
        });
        Diagnostics { path: self.path.clone(), text: self.text.clone(), list: list.collect() }
    }
}
