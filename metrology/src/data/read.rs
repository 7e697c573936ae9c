//! Reader of a map.

use abbe_spec::{Diagnostic, Document, Item, Section, Spec, expr::Dimension, option::MAP};
use std::{path::Path, sync::Arc};

use abbe::identify::{Uncertainty, register};

use super::choices::{BASES, COMMANDS, JUDGED_TARGETS, QUATERNION_ORDERS};
use super::command_pose::CommandPose;
use super::configurations::resolution;
use super::read_channels::{column, columns, deviation, initial_deviation, inputs, joints, unit};
use super::read_instruments::{instruments, target_position};
use super::read_places::{distances, found_places, placement, sight, stations};
use super::{Base, Column, EULER_ORDERS, Layout, Map, Target, TargetFrame, Turn, keys};
use crate::acceptance::{Acceptance, FIGURE_NAMES, TARGET};
use abbe_study::{Result, RunRecord, check_date, named};

impl Map {
    /// Reads the map in a file, or the shipped map of that name.
    pub fn find(argument: &Path, spec: &Spec) -> Result<Self> {
        let document = named::document(&MAP, argument, abbe_manipulators::MAPS, "maps", "shipped map")?;
        Self::from_document(document, spec)
    }

    /// Parses the text of a map; diagnostics name `path`.
    pub fn parse(path: &str, text: &str, spec: &Spec) -> Result<Self> {
        Self::from_document(Document::new(path, text), spec)
    }

    fn from_document(mut document: Document, spec: &Spec) -> Result<Self> {
        let text = Arc::clone(&document.text);
        document.length = spec.length;
        let tables = document.tables(&text);
        let map = tables.and_then(|tables| read_map(&Section::root(&tables, &document), spec));
        merge_duplicates(&document);
        document.finish(map)
    }
}

/// Merges diagnostics with equal messages into the first one, which lists the other lines.
fn merge_duplicates(document: &Document) {
    let line = |mistake: &Diagnostic| document.line(mistake.span.as_ref().map_or(0, |span| span.start));
    let mut kept: Vec<(Diagnostic, Vec<String>)> = Vec::new();
    for mistake in document.found.take() {
        let same =
            kept.iter_mut().find(|(first, _)| first.message == mistake.message && first.help == mistake.help);
        match same {
            Some((_, others)) => others.push(line(&mistake).to_string()),
            None => kept.push((mistake, Vec::new())),
        }
    }
    let kept = kept
        .into_iter()
        .map(|(mut first, others)| {
            if !others.is_empty() {
                let more = format!(
                    "same error in line{} {}",
                    if others.len() == 1 { "" } else { "s" },
                    others.join(", ")
                );
                first.help = Some(first.help.map_or(more.clone(), |help| format!("{help}; {more}")));
            }
            first
        })
        .collect();
    document.found.replace(kept);
}

fn read_map(root: &Section<'_>, spec: &Spec) -> Option<Map> {
    if !root.is_kind("data") {
        return None;
    }
    root.check_keys(&[&keys::FILE, &keys::FORMS, &keys::STANDS]);
    let head = root.required("data")?.table("[data]", &[&keys::DATA])?;
    let command_pose = root.get("command_pose");
    let (joints, command_pose) = match (&command_pose, root.get("joints")) {
        (Some(item), None) => {
            let section = item.named("[command_pose]")?;
            section.check_keys(&[&keys::POSE, &keys::TURN]);
            let (position, factor, turn) = pose(&section)?;
            let read = CommandPose { position, factor, turn, spec: Box::new(spec.clone()) };
            (Some(CommandPose::joints(spec)), Some(read))
        }
        (Some(item), Some(_)) => {
            let help = "keep one of them: `[joints]`, if the file has joints";
            return item.refuse_key("`[command_pose]` stands in place of `[joints]`", help);
        }
        _ => (joints(root, spec), None),
    };
    let inputs = inputs(root, spec);
    let named = |key: &str| head.get(key).map_or(Some(None), |item| column(&item).map(Some));
    let (group, direction, time, setup) = (named("group"), named("direction"), named("time"), named("setup"));
    let stated = match (head.get("uncertainty"), root.get("instrument")) {
        (None, Some(_)) => None,
        _ => {
            let item = head.required("uncertainty");
            item.and_then(|item| deviation(&item, Dimension::LENGTH))
        }
    };
    let target_frame = TargetFrame::read(&head, spec)?;
    let layout = layout(root, stated, setup.flatten(), &target_frame);
    let layout = distances(root, found_places(root, layout));
    let length = match &layout {
        Some(Layout::Instruments(all)) if stated.flatten().is_none() => Some(Some(all.uncertainty())),
        _ => stated,
    };
    let is_pose = matches!(layout, Some(Layout::Pose(..)));
    let angle = match head.get("angle_uncertainty") {
        Some(item) => deviation(&item, Dimension::NONE),
        None if is_pose => {
            head.required("angle_uncertainty");
            None
        }
        None => Some(Some(1.0)),
    };
    let uncertainty =
        |sigma: Option<f64>, is_angle| sigma.unwrap_or_else(|| initial_deviation(is_angle, spec.length));
    let base = match head.get("base") {
        Some(item) => item.choice(&BASES)?,
        // No camera and no board stands in F_0 by design.
        None if layout.as_ref().is_some_and(is_camera) => Base::Unknown,
        None => Base::Known,
    };
    let stations = stations(root, &head);
    let placement = placement(root, &head, &target_frame, layout.as_ref());
    let (accept, sight) = (accept(root), sight(root));
    let record = record(root);
    let base = match &layout {
        // The pose of `F_0` is absorbed by the fixtures of the instruments.
        Some(Layout::Instruments(all)) if !all.see_the_base() => Base::Exact,
        _ => base,
    };
    Some(Map {
        title: head.optional_text("title"),
        given_columns: given_columns(&head)?,
        uncertainty: Uncertainty { length: uncertainty(length?, false), angle: uncertainty(angle?, true) },
        is_estimated: [length?.is_none(), angle?.is_none()],
        base,
        stations: stations?,
        target_frame,
        placement: placement?,
        is_corrected: head.get("commands").map_or(Some(false), |item| item.choice(&COMMANDS))?,
        accept: accept?,
        sight: sight?,
        record: record?,
        is_newly_stationed: false,
        joints: joints?,
        command_pose,
        inputs: inputs?,
        layout: layout?,
        group: group?,
        direction: direction?,
        time: time?,
        resolution: resolution(spec),
        path: root.document.path.clone(),
        text: Arc::clone(&root.document.text),
        files: root.document.files.take(),
    })
}

/// Reads the names of the columns of a file without a heading.
fn given_columns(head: &Section<'_>) -> Option<Vec<String>> {
    let Some(item) = head.get("columns") else { return Some(Vec::new()) };
    item.array("a list of names")?.iter().map(|item| Some(column(item)?.name)).collect()
}

fn is_camera(layout: &Layout) -> bool {
    matches!(layout, Layout::Instruments(all) if all.camera.is_some())
}

fn layout(
    root: &Section<'_>,
    stated: Option<Option<f64>>,
    setup: Option<Column>,
    frame: &TargetFrame,
) -> Option<Layout> {
    let alone = |item: &Item<'_>| {
        keys::FORMS.contain(&item.key) && !["target", "instrument"].contains(&item.key.as_str())
    };
    if root.get("instrument").is_some() && !root.items().any(|item| alone(&item)) {
        return Some(Layout::Instruments(Box::new(instruments(root, stated, setup, frame)?)));
    }
    let mut forms = root.items().filter(|item| keys::FORMS.contain(&item.key));
    let (Some(form), None) = (forms.next(), forms.next()) else {
        let message = "a map needs exactly one description of the measurements";
        let help = "give one of `[point]`, `[difference]`, `[[target]]` (three or more), `[pose]` \
            and `[[instrument]]`";
        return root.document.refuse(0..0, message, help);
    };
    if form.key == "target" {
        return targets(&form, frame);
    }
    let section = form.named(format!("[{}]", form.key))?;
    let factor = || unit(&section, Dimension::LENGTH);
    match form.key.as_str() {
        "point" => {
            section.check_keys(&[&keys::POINT]);
            let (columns, factor) = (columns(&section, "columns"), factor());
            Some(Layout::Point(columns?, factor?))
        }
        "difference" => {
            section.check_keys(&[&keys::DIFFERENCE]);
            let [target, difference] = ["target", "difference"].map(|key| columns(&section, key));
            let factor = factor();
            Some(Layout::Difference(target?, difference?, factor?))
        }
        _ => {
            section.check_keys(&[&keys::POSE, &keys::TURN]);
            let (position, factor, turn) = pose(&section)?;
            Some(Layout::Pose(position, factor, turn))
        }
    }
}

/// Reads columns of the position and of the orientation of a tool, and the factor of the former.
fn pose(section: &Section<'_>) -> Option<([Column; 3], f64, Turn)> {
    let (position, factor) = (columns(section, "position"), unit(section, Dimension::LENGTH));
    Some((position?, factor?, turn(section)?))
}

fn turn(section: &Section<'_>) -> Option<Turn> {
    if section.get("matrix").is_some() {
        return Some(Turn::Matrix(Box::new(columns(section, "matrix")?)));
    }
    if let Some(item) = section.get("quaternion") {
        let section = item.table("quaternion", &[&keys::QUATERNION])?;
        let order = section.required("order")?.choice(&QUATERNION_ORDERS);
        return Some(Turn::Quaternion(Box::new(columns(&section, "columns")?), order?));
    }
    if let Some(item) = section.get("rotation_vector") {
        let section = item.table("rotation_vector", &[&keys::ROTATION_VECTOR])?;
        let factor = unit(&section, Dimension::NONE);
        return Some(Turn::RotationVector(Box::new(columns(&section, "columns")?), factor?));
    }
    let Some(item) = section.get("euler") else {
        let help = "give `quaternion`, `matrix`, `euler` or `rotation_vector`";
        return section.refuse("this pose has no orientation", help);
    };
    let section = item.table("euler", &[&keys::EULER])?;
    let order = section.required("order").and_then(|item| item.choice(&EULER_ORDERS));
    let factor = unit(&section, Dimension::NONE);
    Some(Turn::Euler(Box::new(columns(&section, "columns")?), order?, factor?))
}

fn targets(item: &Item<'_>, frame: &TargetFrame) -> Option<Layout> {
    let items = item.array("an array of tables [[target]]")?;
    let mut targets = Vec::new();
    for item in &items {
        let section = item.table("this [[target]]", &[&keys::TARGET])?;
        section.optional_text("name");
        let columns = columns(&section, "columns");
        let factor = unit(&section, Dimension::LENGTH);
        let position = target_position(&section.required("position")?, frame)?;
        targets.push(Target { columns: columns?, factor: factor?, position });
    }
    let positions: Vec<[f64; 3]> = targets.iter().filter_map(|target| target.position).collect();
    let mistake = match register(&positions, &positions) {
        _ if targets.len() < 3 => "at least three targets are needed",
        // Where the others are, the rows show.
        _ if positions.len() < targets.len() => return Some(Layout::Targets(targets)),
        None => "at least three targets are needed",
        Some(found) if found.breadth < 1e-3 => {
            "these targets are collinear: a rotation about their line cannot be measured"
        }
        Some(_) => return Some(Layout::Targets(targets)),
    };
    item.refuse_key(mistake, "move one of them off the line, or measure a single one as `[point]`")
}

/// Reads `[accept]`: limits for rows that were not used in a fit.
fn accept(root: &Section<'_>) -> Option<Acceptance> {
    let Some(item) = root.get("accept") else { return Some(Acceptance::default()) };
    let section = item.table("[accept]", &[&keys::ACCEPT])?;
    let figures = FIGURE_NAMES.into_iter().filter_map(|figure| Some((figure, section.get(figure)?)));
    let limits = figures.map(|(figure, item)| Some((figure, item.quantity(Dimension::LENGTH)?)));
    let is_target_fitted = section.get(TARGET).is_some_and(|item| item.choice(&JUDGED_TARGETS) == Some(true));
    Some(Acceptance { limits: limits.collect::<Option<_>>()?, is_target_fitted })
}

/// Reads `[record]`: texts for a page that can be signed.
fn record(root: &Section<'_>) -> Option<RunRecord> {
    let mut record = RunRecord::default();
    let Some(item) = root.get("record") else { return Some(record) };
    let section = item.table("[record]", &[&keys::RECORD])?;
    for key in keys::RECORD.names() {
        let text = section.optional_text(key);
        let wrong = check_date(&text).err().filter(|_| key == "date" && !text.is_empty());
        if let (Some(form), Some(item)) = (wrong, section.get(key)) {
            let message = format!("`{}` is no date", text.escape_debug());
            root.document.mistake(Diagnostic::new(item.span(), message).help(form));
        }
        record.state(key, text);
    }
    Some(record)
}
