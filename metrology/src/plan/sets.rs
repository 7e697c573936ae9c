//! Reads a plan file: sets of configurations to measure.
//!
//! `docs/reference/plan.md` describes every key.

use abbe_spec::{Diagnostic, Section, Spec, option::SETS};
use std::path::{Path, PathBuf};

use abbe::analysis::{Axis, Configuration, Workspace, joint_grid};
use abbe::{Error, Manipulator};
use serde::Serialize;

use super::keys;
use abbe_study::workspace::{Candidates, Region, count, read_region};
use abbe_study::{Notes, Result, mistake, named};

/// Largest number of rows of a plan.
const MOST_ROWS: usize = 1_000_000;

/// Plan file, read and checked.
#[derive(Clone, Debug)]
pub struct Sets {
    pub(super) title: String,
    repeat: usize,
    sets: Vec<Set>,
    inputs: Vec<Axis>,
    /// Files that were read: the plan itself and those of paths; none for a shipped plan.
    pub(crate) files: Vec<PathBuf>,
}

#[derive(Clone, Debug)]
struct Set {
    name: String,
    content: Content,
}

#[derive(Clone, Debug)]
enum Content {
    Workspace(Region),
    /// One axis at a time.
    Axes(Vec<Axis>),
}

/// Number of rows of a set.
#[derive(Clone, Debug, Serialize)]
pub struct SetSize {
    /// Name of the set.
    pub name: String,
    /// Number of rows.
    pub rows: usize,
}

impl Sets {
    /// Reads the plan in a file, or the shipped one with that name.
    pub fn find(argument: &Path, spec: &Spec) -> Result<Self> {
        let mut document =
            named::document(&SETS, argument, abbe_manipulators::PLANS, "plans", "shipped plan")?;
        document.length = spec.length;
        document.read_tables(|root| read(root, spec))
    }

    /// Returns all rows, and the number of rows of each set.
    pub(super) fn rows(
        &self,
        manipulator: &dyn Manipulator,
        notes: &mut dyn Notes,
    ) -> Result<(Vec<Configuration>, Vec<SetSize>)> {
        // All combinations of the plan's inputs, each a list of indices and values.
        let mut combinations: Vec<Vec<(usize, f64)>> = vec![Vec::new()];
        let sizes = self.inputs.iter().map(|axis| axis.values.len());
        let count = sizes.chain([self.repeat]).fold(1, usize::saturating_mul);
        let few_enough = |more: usize| match count.saturating_mul(more) {
            rows if rows > MOST_ROWS => {
                let message = format!("this plan has too many rows; the limit is {MOST_ROWS}");
                let help = "use fewer input values, fewer configurations, or a smaller `repeat`";
                Err(mistake::with_help(&self.title, message, help))
            }
            _ => Ok(()),
        };
        few_enough(1)?;
        for axis in &self.inputs {
            let with = |before: &Vec<(usize, f64)>| {
                let before = before.clone();
                axis.values.iter().map(move |value| [&before[..], &[(axis.index, *value)]].concat())
            };
            combinations = combinations.iter().flat_map(with).collect();
        }
        let refused = |set: &Set| {
            let name = set.name.clone();
            move |error: Error| mistake::whole(&name, &error)
        };
        let (mut rows, mut counts) = (Vec::new(), Vec::new());
        for set in &self.sets {
            let workspaces: Vec<Box<dyn Workspace + '_>> = match &set.content {
                Content::Workspace(region) => {
                    vec![region.workspace(manipulator, None).map_err(refused(set))?]
                }
                Content::Axes(axes) => {
                    let grids = axes.iter().map(|axis| joint_grid(manipulator, std::slice::from_ref(axis)));
                    let grids = grids.map(|grid| Ok(Box::new(grid.map_err(refused(set))?) as _));
                    grids.collect::<Result<_>>()?
                }
            };
            let all: usize = workspaces.iter().map(|workspace| workspace.len()).sum();
            few_enough(all)?;
            let configurations: Vec<Configuration> =
                workspaces.iter().flat_map(|workspace| workspace.reached()).collect();
            let unreached = all - configurations.len();
            if unreached > 0 {
                notes.note(&format!("{}: {unreached} configurations are unreachable", set.name));
            }
            let before = rows.len();
            for inputs in &combinations {
                for _ in 0..self.repeat {
                    rows.extend(configurations.iter().cloned().map(|mut configuration| {
                        inputs.iter().for_each(|(input, value)| configuration.u[*input] = *value);
                        configuration
                    }));
                }
            }
            counts.push(SetSize { name: set.name.clone(), rows: rows.len() - before });
        }
        Ok((rows, counts))
    }
}

fn read(root: &Section<'_>, spec: &Spec) -> Option<Sets> {
    if !root.is_kind("plan") {
        return None;
    }
    root.check_keys(&[&keys::FILE]);
    let head = root.required("plan")?.table("[plan]", &[&keys::PLAN])?;
    let repeat = head.get("repeat").map_or(Some(1), |item| count(&item, keys::MOST_REPEATS as usize));
    let inputs = root.get("inputs").map_or_else(Vec::new, |item| Candidates::inputs(spec).axes(&item));
    let items = root.required_list("set").and_then(|item| item.array("an array of tables [[set]]"))?;
    if items.is_empty() {
        let item = root.get("set").map_or(0..0, |item| item.span());
        root.document.mistake(Diagnostic::new(item, "a plan needs at least one set").help("add a [[set]]"));
    }
    let mut sets = Vec::new();
    for item in &items {
        let section = item.table("this [[set]]", &[&keys::SET])?;
        let name = section.optional_text("name");
        let content = if let Some(axes) = section.get("axes") {
            if let Some(workspace) = section.get("workspace") {
                let message = "a set has a `workspace` or `axes`, not both";
                let help = "write two sets instead";
                let mistake = Diagnostic::new(axes.key_span.clone(), message).label("one too many");
                root.document.mistake(mistake.context(workspace.key_span, "the other one").help(help));
            }
            Content::Axes(Candidates::variables(spec).axes(&axes))
        } else {
            Content::Workspace(read_region(&section.required("workspace")?, spec)?)
        };
        sets.push(Set { name, content });
    }
    Some(Sets {
        title: head.optional_text("title"),
        repeat: repeat?,
        sets,
        inputs,
        files: root.document.files.take(),
    })
}
