//! Reads a spec file from top to bottom.

use std::path::Path;

use abbe_core::{LengthUnit, Orientation};
use sha2::{Digest, Sha256};

use super::covariance::{read_covariance, read_fitted};
use super::deviations::Chain;
use super::frames::{OwnVariable, convention, read_factors};
use super::freedoms::{check_freedoms, check_sources_in_loops};
use super::loads::{check_loaded, read_gravity, read_loads};
use super::loops::read_loops;
use super::positive::check_signs;
use super::rigid::{check_rigid, depends};
use super::sources::{input_uncertainties, parts_of_balls, read_sources};
use super::sum_limits::read_sum_limits;
use super::{Declarations, LENGTHS, Named, ORIENTATIONS, keys, read_parent};
use crate::diagnostic::{Diagnostic, Diagnostics, Span};
use crate::document::{Document, Item, Section};
use crate::expr::Symbol;
use crate::manipulator::{Factor, Frame, Loop, Spec, Tree, Variable, check_manipulator_name, read_title};
use crate::value::read_name;

impl Spec {
    /// Reads and checks a spec file. All syntax errors are reported at once; without any, all
    /// semantic errors.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Diagnostics> {
        Self::from_document(Document::read(path.as_ref())?)
    }

    /// Reads and checks a spec's text. Files of tables are relative to `folder`; `path` is the name
    /// shown in diagnostics.
    pub fn parse_in(folder: &Path, path: &str, text: &str) -> Result<Self, Diagnostics> {
        Self::from_document(Document { folder: Some(folder.to_owned()), ..Document::new(path, text) })
    }

    /// Reads and checks a spec's text; `path` is the name shown in diagnostics. There is no folder,
    /// so tables must contain their points.
    ///
    /// ```
    /// # use abbe_spec::Spec;
    /// let slide = r#"
    ///     [manipulator]
    ///     name = "slide"
    ///     length = "mm"
    ///     [[frame]]
    ///     name = "carriage"
    ///     variable = { name = "d1", kind = "prismatic" }
    ///     transform = "Tx(d1)"
    /// "#;
    /// assert_eq!(Spec::parse("slide.toml", slide)?.frames.len(), 1);
    /// # Ok::<(), abbe_spec::diagnostic::Diagnostics>(())
    /// ```
    pub fn parse(path: &str, text: &str) -> Result<Self, Diagnostics> {
        Self::from_document(Document::new(path, text))
    }

    /// Reads and checks a document.
    pub fn from_document(document: Document) -> Result<Self, Diagnostics> {
        document.read_tables(read)
    }
}

fn read(root: &Section<'_>) -> Option<Spec> {
    if !root.is_kind("manipulator") {
        return None;
    }
    root.check_keys(&[&keys::FILE]);
    let head = root.required("manipulator").and_then(|item| read_head(&item));
    // Without a length unit, nothing else can be read.
    let head = head?;
    let mut declarations = Declarations::new(head.length);
    // Uses of an invalid table would be reported as well.
    declarations.read_tables(root)?;
    declarations.read_parameters(root);
    declarations.read_inputs(root);
    let before = root.document.mistakes();
    let raw_frames = read_frames(root, &mut declarations);
    let named = raw_frames.iter().flatten().map(|raw| (raw.name.as_str(), raw.section.span.clone()));
    let named: Vec<Named<'_>> = named.collect();
    let raw_loops = read_loops(root, &named, &mut declarations);
    let mut complete = true;
    let mut frames = Vec::new();
    for (index, raw) in raw_frames.iter().flatten().enumerate() {
        let stated = raw.section.get("parent");
        let parent = stated.map_or(index.checked_sub(1), |item| read_parent(&item, index, &named));
        let factors = read_frame_factors(raw, &declarations, root.document);
        complete &= factors.is_some();
        frames.push(Frame {
            name: raw.name.clone(),
            description: raw.section.optional_text("description"),
            parent,
            variable: raw.own.and_then(|(own, _)| if let Symbol::Variable(i) = own { Some(i) } else { None }),
            passive: raw.own.and_then(|(own, _)| if let Symbol::Passive(i) = own { Some(i) } else { None }),
            factors: factors.unwrap_or_default(),
            convention: convention(&raw.section),
        });
    }
    let end = end_of_first_chain(&frames);
    let tool =
        root.get("tool").map_or(Some((Vec::new(), end)), |item| read_tool(&item, &named, end, &declarations));
    let tool_frame = tool.as_ref().map_or(end, |(_, frame)| *frame);
    let tool = tool.map(|(factors, _)| factors);
    let read: Vec<Option<Loop>> =
        raw_loops.iter().map(|raw| raw.read(&declarations, root.document)).collect();
    complete &= read.iter().all(Option::is_some);
    let loops: Vec<Loop> = read.into_iter().flatten().collect();
    let tree = Tree { frames: &frames, loops: &loops, tool_frame };
    let is_known = complete && root.document.mistakes() == before;
    if is_known {
        check_freedoms(tree, &declarations, root.document);
    }
    let chain = Chain { tree, complete, tool: tool.as_deref(), scope: &declarations.scope };
    let mut sources = read_sources(root, chain);
    if is_known {
        check_sources_in_loops(
            tree,
            tool.as_deref().unwrap_or_default(),
            &sources,
            &declarations,
            root.document,
        );
    }
    let sum_limits = read_sum_limits(root, &declarations);
    let loads = read_loads(root, tree, &declarations.scope);
    let gravity = read_gravity(root, &declarations.scope)?;
    check_loaded(root, tree, &sources, &loads, &declarations.variables, gravity.is_some());
    check_signs(&sources, &loads, &declarations, root.document);
    let fitted = read_fitted(root, &declarations);
    let covariance = read_covariance(root, &frames, &sources, &declarations.scope);
    let parts = parts_of_balls(&mut sources);
    sources.extend(parts);
    sources.extend(input_uncertainties(&declarations, &sources, root.document));
    raw_frames?;
    complete.then_some(())?;
    let Declarations { scope, parameters, inputs, variables, passive } = declarations;
    let Head { name, title, description, reference, length, orientation } = head;
    let file = Path::new(&root.document.path)
        .file_name()
        .map_or_else(String::new, |f| f.to_string_lossy().into_owned());
    let mut hasher = Sha256::new_with_prefix(root.document.text.as_bytes());
    root.document.beside.borrow().iter().for_each(|(_, bytes)| hasher.update(bytes));
    let hash = hasher.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
    let beside = root.document.beside.borrow().iter().map(|(path, _)| path.clone()).collect();
    Some(Spec {
        name,
        title,
        description,
        reference,
        length,
        orientation,
        parameters,
        inputs,
        variables,
        passive,
        sum_limits,
        frames,
        loops,
        tool_frame,
        tool: tool?,
        sources,
        loads,
        gravity,
        fitted,
        covariance: covariance?,
        tables: scope.tables,
        file,
        beside,
        hash,
    })
}

/// Maximum number of frames. The analysis then takes seconds and 200 MB.
const MOST_FRAMES: usize = 3000;

struct Head {
    name: String,
    title: String,
    description: String,
    reference: String,
    length: LengthUnit,
    orientation: Orientation,
}

fn read_head(item: &Item<'_>) -> Option<Head> {
    let section = item.table("[manipulator]", &[&keys::MANIPULATOR])?;
    let name = section.required("name").and_then(|item| {
        let name = item.string()?;
        check_manipulator_name(&name, item.span(), item.document);
        Some(name)
    });
    let length = section.required("length").and_then(|item| item.choice(&LENGTHS));
    let orientation = section.get("orientation");
    let orientation =
        orientation.map_or(Some(Orientation::RotationVector), |item| item.choice(&ORIENTATIONS));
    let title = section.optional_text("title");
    let description = section.optional_text("description");
    let reference = section.optional_text("reference");
    let name = name.unwrap_or_default();
    let title = if title.is_empty() { name.clone() } else { title };
    let orientation = orientation.unwrap_or(Orientation::RotationVector);
    Some(Head { name, title, description, reference, length: length?, orientation })
}

/// A frame whose transform has not been read yet, because it may use names declared later.
struct RawFrame<'d> {
    section: Section<'d>,
    name: String,
    own: OwnVariable,
    variable_span: Option<Span>,
}

fn read_frames<'d>(root: &Section<'d>, declarations: &mut Declarations) -> Option<Vec<RawFrame<'d>>> {
    let item = root.required_list("frame")?;
    let items = item.array_of_tables("frame")?;
    if items.is_empty() {
        return item.refuse("a manipulator needs at least one frame", "add a [[frame]]");
    }
    let help = "merge frames without errors: a transform can be a product";
    item.at_most(items.len(), MOST_FRAMES, "frames", help)?;
    let (mut frames, mut known) = (Vec::new(), Vec::new());
    for (index, item) in items.iter().enumerate() {
        let Some(mut section) = item.named(format!("frame {}", index + 1)) else { continue };
        let help = "rename one; sources refer to frames by name";
        let name = read_title(&mut section, "frame", &mut known, help).unwrap_or_default();
        section.check_keys(&[&keys::FRAME, &keys::DESCRIBED, &keys::TRANSFORM]);
        let variable = section.get("variable");
        let own = variable.as_ref().and_then(|item| declarations.read_variable(index, item));
        let own = own.and_then(|own| Some((own, declarations.variable(own)?.kind)));
        let variable_span = variable.map(|item| item.span());
        frames.push(RawFrame { section, name, own, variable_span });
    }
    Some(frames)
}

fn read_frame_factors(
    frame: &RawFrame<'_>,
    declarations: &Declarations,
    document: &Document,
) -> Option<Vec<Factor>> {
    let factors = read_factors(&frame.section, frame.own, &declarations.scope)?;
    check_matrices(&factors, declarations, document)?;
    if let (Some((own, _)), Some(span)) = (frame.own, &frame.variable_span)
        && let Some(Variable { name, .. }) = declarations.variable(own)
        && declarations.scope.names.get(name).is_some_and(|name| name.symbol == own)
        && !moves(&factors, own, declarations)
    {
        let message = format!("`{name}` does not move its own frame");
        let label = format!("the transform of \"{}\" does not depend on it", frame.name);
        let help = "use the variable in the transform, or declare it in the frame that it moves";
        document.mistake(Diagnostic::new(span.clone(), message).label(label).help(help));
    }
    Some(factors)
}

/// Returns the index of the last frame of the first chain, which carries the tool by default.
fn end_of_first_chain(frames: &[Frame]) -> usize {
    let follows = |(i, frame): &(usize, &Frame)| frame.parent == i.checked_sub(1);
    frames.iter().enumerate().take_while(follows).count().saturating_sub(1)
}

/// Reads the tool, and the index of the frame that carries it.
fn read_tool(
    item: &Item<'_>,
    frames: &[Named<'_>],
    default: usize,
    declarations: &Declarations,
) -> Option<(Vec<Factor>, usize)> {
    let section = item.table("[tool]", &[&keys::TOOL_FRAME, &keys::DESCRIBED, &keys::TRANSFORM])?;
    let frame = match section.get("frame") {
        Some(item) => read_name(&item, frames.iter().map(|(name, _)| *name), "frame"),
        None => Some(default),
    };
    let factors = read_factors(&section, None, &declarations.scope)?;
    check_matrices(&factors, declarations, item.document)?;
    Some((factors, frame?))
}

fn check_matrices(factors: &[Factor], declarations: &Declarations, document: &Document) -> Option<()> {
    for factor in factors {
        if let Factor::Matrix(matrix) = factor
            && let Some(mistake) = check_rigid(matrix, declarations)
        {
            return document.fail(mistake);
        }
    }
    Some(())
}

/// Returns `true` if a product of factors depends on a variable.
fn moves(factors: &[Factor], own: Symbol, declarations: &Declarations) -> bool {
    factors.iter().flat_map(Factor::expressions).any(|expression| depends(expression, own, declarations))
}
