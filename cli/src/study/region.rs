//! The workspace of a study.

use abbe::analysis::{Axis, Presentation, Workspace, joint_grid, joint_samples, presented_volume};
use abbe::{Error, Manipulator};
use abbe_codegen::diagnostic::Diagnostic;
use abbe_codegen::document::{Document, Item, Section};
use abbe_codegen::expr::Dimension;
use abbe_codegen::spec::Spec;

use super::axis::{Candidates, LARGEST, count};
use super::read::constant;
use crate::number;

/// How many joint samples are looked at if nobody says.
const SAMPLES: usize = 1000;

/// Which configurations are looked at.
#[derive(Clone, Debug)]
pub(crate) enum Region {
    /// A volume of tool points, each presented at a point of the room.
    Presented(Presentation),
    /// Every combination of values of some variables.
    Grid(Vec<Axis>),
    /// Samples of some variables within their limits.
    Samples { moved: Vec<usize>, count: usize },
}

impl Region {
    /// All variables, sampled.
    pub(super) fn samples(spec: &Spec) -> Self {
        Self::Samples { moved: (0..spec.variables.len()).collect(), count: SAMPLES }
    }

    /// `[workspace]`: one of `presented`, `grid` and `joints`.
    pub(super) fn read(item: &Item<'_>, document: &mut Document, spec: &Spec) -> Option<Self> {
        let mut section = document.section(item)?;
        section.name = "[workspace]".to_owned();
        section.check_keys(&["presented", "grid", "joints"], document);
        let mut forms =
            section.items().filter(|item| ["presented", "grid", "joints"].contains(&item.key.as_str()));
        let (Some(form), None) = (forms.next(), forms.next()) else {
            document.mistake(
                Diagnostic::new(section.span.clone(), "a workspace has one form")
                    .label("which configurations?")
                    .help("give one of `presented`, `grid`, `joints`"),
            );
            return None;
        };
        let region = match form.key.as_str() {
            "presented" => Self::Presented(presented(&document.section(&form)?, document, spec)?),
            "grid" => Self::Grid(Candidates::variables(spec).axes(&form, document, spec)),
            _ => joints(&document.section(&form)?, document, spec)?,
        };
        if region.count().is_none() {
            let message = format!("this workspace has more than {LARGEST} configurations");
            document.mistake(
                Diagnostic::new(form.key_span.clone(), message)
                    .help("take fewer values per axis, or random samples: `joints = { samples = 100000 }`"),
            );
            return None;
        }
        Some(region)
    }

    /// How many configurations are asked for, if they are not too many.
    fn count(&self) -> Option<usize> {
        let axes = match self {
            Self::Presented(presentation) => [&presentation.tool_points[..], &presentation.approaches],
            Self::Grid(axes) => [&axes[..], &[]],
            Self::Samples { count, .. } => return Some(*count),
        };
        let sizes = axes.concat().into_iter().map(|axis| axis.values.len());
        sizes.into_iter().try_fold(1, usize::checked_mul).filter(|count| *count <= LARGEST)
    }

    /// The configurations.
    pub(crate) fn workspace(&self, manipulator: &dyn Manipulator) -> Result<Workspace, Error> {
        match self {
            Self::Presented(presentation) => presented_volume(manipulator, presentation),
            Self::Grid(axes) => joint_grid(manipulator, axes),
            Self::Samples { moved, count } => joint_samples(manipulator, moved, *count),
        }
    }

    /// The workspace in a sentence.
    pub(crate) fn describe(&self, spec: &Spec) -> String {
        let variable = |i: &usize| spec.variables[*i].name.as_str();
        match self {
            Self::Presented(Presentation { point, tool_points, approaches, solved }) => {
                let sizes = |axes: &[Axis]| axes.iter().map(|axis| axis.values.len()).product::<usize>();
                let parameters = tool_points.iter().map(|axis| spec.parameters[axis.index].name.as_str());
                let held = approaches.iter().map(|axis| variable(&axis.index));
                let [x, y, z] = point.map(number::short);
                format!(
                    "{} tool points ({}) in {} approaches ({}), each brought to ({x}, {y}, {z}) {} by {}",
                    sizes(tool_points),
                    listed(parameters),
                    sizes(approaches),
                    listed(held),
                    spec.length.symbol(),
                    listed(solved.iter().map(variable)),
                )
            }
            Self::Grid(axes) => {
                let axes =
                    axes.iter().map(|axis| format!("{} × {}", axis.values.len(), variable(&axis.index)));
                format!("grid of {}", listed(axes))
            }
            Self::Samples { moved, count } => {
                format!("{count} samples of {} within their limits", listed(moved.iter().map(variable)))
            }
        }
    }
}

fn listed(names: impl Iterator<Item = impl Into<String>>) -> String {
    let names = names.map(Into::into).collect::<Vec<_>>();
    if names.is_empty() { "nothing".to_owned() } else { names.join(", ") }
}

/// `[workspace.presented]`: tool points, each brought to one point of the room.
fn presented(section: &Section<'_>, document: &mut Document, spec: &Spec) -> Option<Presentation> {
    section.check_keys(&["point", "tool_points", "approaches", "solve"], document);
    let point = section.required("point", document).and_then(|item| point(&item, document, spec));
    let tool_points = section.get("tool_points");
    let tool_points = tool_points.map(|item| Candidates::parameters(spec).axes(&item, document, spec));
    let variables = Candidates::variables(spec);
    let approaches =
        section.get("approaches").map(|item| (variables.axes(&item, document, spec), item.span()));
    let (approaches, span) = approaches.unwrap_or_default();
    let solved = section.required("solve", document).map(|item| variables.list(&item, document))?;
    if let Some(both) = approaches.iter().find(|axis| solved.contains(&axis.index)) {
        let message = format!("`{}` cannot be held and solved for", spec.variables[both.index].name);
        document
            .mistake(Diagnostic::new(span, message).help("take it out of `approaches` or out of `solve`"));
    }
    Some(Presentation { point: point?, tool_points: tool_points.unwrap_or_default(), approaches, solved })
}

fn point(item: &Item<'_>, document: &mut Document, spec: &Spec) -> Option<[f64; 3]> {
    let entries: [Item<'_>; 3] = document.entries(item, "three lengths: x, y and z in F_0")?;
    let [x, y, z] =
        entries.map(|entry| constant(&entry, document, spec, Dimension::LENGTH, "a coordinate of the point"));
    Some([x?, y?, z?])
}

/// `[workspace.joints]`: samples within the limits; all variables move if `moved` does not say otherwise.
fn joints(section: &Section<'_>, document: &mut Document, spec: &Spec) -> Option<Region> {
    section.check_keys(&["samples", "moved"], document);
    let moved = match section.get("moved") {
        Some(item) => Candidates::variables(spec).list(&item, document),
        None => (0..spec.variables.len()).collect(),
    };
    let samples = section.required("samples", document)?;
    Some(Region::Samples { moved, count: count(&samples, document, spec)? })
}
