//! Reads a study file from top to bottom.

use abbe_spec::{Diagnostic, Document, Item, Section, Spec, expr::Symbol, option::STUDY};
use std::path::{Path, PathBuf};

use abbe_manipulators::{SHIPPED, STUDIES};
use sha2::{Digest, Sha256};

use super::choices::{CRITERIA, Criterion, JudgedMachine};
use super::figure::read_figures;
use super::study::{PROBABILITY, Study, read_allocation, read_compensated, read_published};
use super::tolerance::{self, Tolerance};
use super::{compensation, keys};
use crate::workspace::{Region, constant, read_region};
use crate::{Changes, Machine, Result, find_symbol, named};

impl Study {
    /// Returns the study in `file`; or else the one [beside the spec](Self::beside), the one
    /// shipped with the manipulator, or joint samples.
    pub fn find(file: Option<&Path>, machine: &Machine) -> Result<Self> {
        let beside = Self::beside(machine);
        match (file.or(beside.as_deref()), machine.shipped.and_then(|shipped| shipped.study)) {
            (Some(path), _) => Self::read(Self::document(path)?, &machine.spec),
            (None, Some(text)) => {
                Self::read(Document::new(format!("studies/{}.toml", machine.origin), text), &machine.spec)
            }
            (None, None) => Ok(Self::joint_samples(&machine.spec)),
        }
    }

    /// Reads the study in a file, or the shipped one with that name, which may be that of its
    /// manipulator.
    pub(crate) fn document(argument: &Path) -> Result<Document> {
        let of_machines = SHIPPED.iter().filter_map(|shipped| Some((shipped.name, shipped.study?)));
        let all: Vec<(&str, &str)> = of_machines.chain(STUDIES.iter().copied()).collect();
        named::document(&STUDY, argument, &all, "studies", "shipped study")
    }

    /// Applies changes to a machine, adds its uncertainties, and keeps the inputs that are set
    /// nominal.
    pub(crate) fn change(&mut self, machine: &mut Machine, changes: &Changes) {
        machine.change(changes);
        machine.add_uncertainties();
        self.fix(machine.fixed_inputs());
    }

    /// Returns the study file beside a user's spec, if it exists: `arm.study.toml` beside
    /// `arm.toml`.
    pub fn beside(machine: &Machine) -> Option<PathBuf> {
        let file = machine.file.as_ref()?.with_extension("study.toml");
        file.exists().then_some(file)
    }

    /// Reads a study and checks it against the spec of its manipulator.
    pub fn read(mut document: Document, spec: &Spec) -> Result<Self> {
        document.length = spec.length;
        document.read_tables(|root| read(root, spec))
    }
}

fn read(root: &Section<'_>, spec: &Spec) -> Option<Study> {
    if !root.is_kind("study") {
        return None;
    }
    root.check_keys(&[&keys::FILE]);
    let head = root.required("study").and_then(|item| item.section());
    let region = root.required("workspace").and_then(|item| read_region(&item, spec));
    let moved = region.as_ref().map_or_else(Vec::new, Region::moving_inputs);
    let region = region.map(|mut region| {
        region.over_ranges(spec);
        region
    });
    let published = read_published(root, spec);
    let compensated = root.get("compensated").and_then(|item| read_compensated(&item));
    let compensation = root.get("compensation").and_then(|item| compensation::read(&item, spec));
    let allocation = root.get("allocation").map(|item| read_allocation(&item, spec));
    let figures = read_figures(root, spec, region.as_ref());
    let mut head = head?;
    head.name = "[study]".to_owned();
    head.check_keys(&[&keys::STUDY]);
    let title = head.required("title").and_then(|item| item.string());
    let tolerance = head.get("tolerance").and_then(|item| tolerance::read(&item)).unwrap_or_default();
    let is_known = compensation.is_some() || compensated.is_some() || !spec.covariance.of.is_empty();
    if tolerance.machine == Some(JudgedMachine::Compensated)
        && !is_known
        && let Some(item) = head.get("tolerance")
    {
        let mistake = Diagnostic::new(item.span(), "nothing says what compensation leaves");
        let help = "add [compensation] with a `residual`, or analyze a spec that `abbe identify` wrote";
        root.document.mistake(mistake.label("held against the compensated machine").help(help));
    }
    let default = if compensation.is_some() { JudgedMachine::Compensated } else { JudgedMachine::AsBuilt };
    Some(Study {
        publisher: head.optional_text("publisher"),
        tolerance: tolerance.position,
        orientation_tolerance: tolerance.orientation,
        unreachable: tolerance.unreachable,
        stated_tolerances: Vec::new(),
        criterion: read_criterion(&head, &tolerance)?,
        probability: tolerance.probability.unwrap_or(PROBABILITY),
        required_yield: tolerance.required_yield.unwrap_or(PROBABILITY),
        judged: tolerance.machine.unwrap_or(default),
        changes: read_changes(&head, spec, &moved),
        not_reproducible: head.get("not_reproducible").map_or_else(Vec::new, |item| texts(&item)),
        title: title?,
        region: region?,
        published,
        compensated,
        compensation,
        allocation: allocation.unwrap_or_default(),
        figures,
        file: Some(name_and_hash(root.document)),
        files: root.document.files.take(),
    })
}

/// Reads `criterion`, which must agree with a stated probability or yield.
fn read_criterion(head: &Section<'_>, tolerance: &Tolerance) -> Option<Criterion> {
    let stated = match tolerance {
        Tolerance { required_yield: Some(_), .. } => Some(("yield", Criterion::Yield)),
        Tolerance { probability: Some(_), .. } => Some(("probability", Criterion::Probability)),
        _ => None,
    };
    let Some(item) = head.get("criterion") else {
        return Some(stated.map_or(Criterion::WorstCase, |(_, criterion)| criterion));
    };
    let criterion = item.choice(&CRITERIA)?;
    match stated {
        // Each machine of a yield keeps the tolerance with a probability.
        Some((key, needed)) if criterion != needed && criterion != Criterion::Yield => {
            let message = format!("the tolerance has a `{key}`, which this criterion ignores");
            let help = format!("write criterion = \"{key}\", or remove `{key}` from the tolerance");
            head.document.fail(Diagnostic::new(item.span(), message).label("another criterion").help(help))
        }
        _ => Some(criterion),
    }
}

/// Returns the file name without its folder, and the SHA-256 of the text.
fn name_and_hash(document: &Document) -> (String, String) {
    let name = Path::new(&document.path).file_name().unwrap_or_default().to_string_lossy().into_owned();
    let hash = Sha256::digest(document.text.as_bytes());
    (name, hash.iter().map(|byte| format!("{byte:02x}")).collect())
}

/// Reads the changes by `set`, `enable` and `disable`. `moved` are the inputs that the workspace
/// names.
fn read_changes(head: &Section<'_>, spec: &Spec, moved: &[usize]) -> Changes {
    let mut changes = Changes::default();
    if let Some(section) = head.get("set").and_then(|item| item.section()) {
        for item in section.items() {
            let symbol = find_symbol(head.document, item.key_span.clone(), &item.key, spec);
            let Some((symbol, dimension)) = symbol else { continue };
            if matches!(symbol, Symbol::Input(i) if moved.contains(&i)) {
                let message = format!("`{}` is both set and moved by the workspace", item.key);
                let mistake = Diagnostic::new(item.key_span.clone(), message);
                head.document.mistake(mistake.help("remove it from `set` or from the workspace"));
                continue;
            }
            let what = format!("the value of `{}`", item.key);
            if let Some(value) = constant(&item, dimension, &what) {
                changes.set(head.document, item.span(), spec, symbol, value);
            }
        }
    }
    for (key, on) in [("enable", true), ("disable", false)] {
        let items = head.get(key).and_then(|item| item.array("a list of names of sources"));
        for item in items.into_iter().flatten() {
            if let Some(name) = item.string() {
                changes.switch(head.document, item.span(), &name, spec, on);
            }
        }
    }
    changes
}

/// Reads a list of texts and joins the lines of each.
fn texts(item: &Item<'_>) -> Vec<String> {
    let items = item.array("a list of texts").unwrap_or_default();
    let texts = items.iter().filter_map(|item| item.string());
    texts.map(|text| text.split_whitespace().collect::<Vec<_>>().join(" ")).collect()
}
