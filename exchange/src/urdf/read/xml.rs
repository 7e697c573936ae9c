//! Parses the XML of a URDF file into links and joints.

use std::collections::HashSet;

use abbe_spec::{Diagnostic, Document, diagnostic::Span, visible::alters_text};
use roxmltree::{Attribute, Node};

use super::robot::{Joint, JointKind, Link, Mimic, Named, Robot};
use crate::placement::Placement;

/// Parses a robot; mistakes go to the document.
pub(super) fn robot(document: &Document) -> Option<Robot> {
    let text = without_namespaces(&document.text);
    let mut notes = Vec::new();
    let xml = match roxmltree::Document::parse(&text) {
        Ok(xml) => xml,
        Err(error) => return document.fail(not_xml(&text, &error)),
    };
    let root = xml.root_element();
    if let Some(mistake) = not_urdf(root) {
        return document.fail(mistake);
    }
    let line = |node: Node<'_, '_>| document.line(node.range().start);
    for node in root.children().filter(is_macro) {
        let name = &node.tag_name().name()[XACRO.len()..];
        notes.push(format!("line {}: the macro `{name}` was not expanded, and is ignored", line(node)));
    }
    let children = |tag| root.children().filter(move |node| node.has_tag_name(tag));
    let mut links: Vec<Link> = children("link").filter_map(|node| link(node, document)).collect();
    let joints: Vec<Joint> = children("joint").filter_map(|node| joint(node, document)).collect();
    if let Some(root) = undeclared_root(&links, &joints) {
        notes.push(format!(
            "the link `{}` is not declared, and was read as the root",
            root.name.escape_debug()
        ));
        links.push(Link { name: root.name.clone(), span: root.span.clone(), mass: None, faults: Vec::new() });
    }
    let meshes = root.descendants().filter(|node| node.has_tag_name("mesh")).count();
    let name = root.attribute("name").filter(|name| !name.trim().is_empty()).unwrap_or("robot").to_owned();
    Some(Robot { name, links, joints, meshes, notes })
}

/// Returns the only parent that is no link, if no link can be the root.
fn undeclared_root<'r>(links: &[Link], joints: &'r [Joint]) -> Option<&'r Named> {
    let declared: HashSet<&str> = links.iter().map(|link| &link.name[..]).collect();
    let carried: HashSet<&str> = joints.iter().map(|joint| &joint.child.name[..]).collect();
    let mut parents =
        joints.iter().map(|joint| &joint.parent).filter(|parent| !declared.contains(&parent.name[..]));
    let first = parents.next()?;
    let is_root = parents.all(|other| other.name == first.name) && !carried.contains(&first.name[..]);
    (is_root && declared.is_subset(&carried)).then_some(first)
}

/// Beginning of the names of elements of xacro, see [`without_namespaces`].
const XACRO: &str = "xacro_";

/// Returns `true` for an element of xacro.
fn is_macro(node: &Node<'_, '_>) -> bool {
    node.tag_name().name().starts_with(XACRO)
}

/// Replaces the colons in names of elements and attributes by underscores, at the same places.
///
/// URDF has no namespaces: its readers take a prefix, declared or not, as part of a name.
fn without_namespaces(text: &str) -> String {
    let others = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>"), ("<!", ">")];
    let mut plain = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(start) = rest.find('<') {
        if let Some((_, end)) = others.iter().find(|(begin, _)| rest[start..].starts_with(begin)) {
            let length = rest[start..].find(end).map_or(rest.len(), |at| start + at + end.len());
            plain.push_str(&rest[..length]);
            rest = &rest[length..];
            continue;
        }
        plain.push_str(&rest[..start]);
        let (mut quote, mut end) = (None, rest.len());
        for (at, c) in rest[start..].char_indices() {
            match quote {
                Some(open) if open == c => quote = None,
                None if matches!(c, '"' | '\'') => quote = Some(c),
                _ => {}
            }
            plain.push(if c == ':' && quote.is_none() { '_' } else { c });
            if c == '>' && quote.is_none() {
                end = start + at + 1;
                break;
            }
        }
        rest = &rest[end..];
    }
    plain + rest
}

/// Takes the mistakes of an element from the document. If xacro has left something in it, that is
/// the only one: the others follow from it.
fn faults(node: Option<Node<'_, '_>>, before: usize, document: &Document) -> Vec<Diagnostic> {
    let faults = document.found.borrow_mut().split_off(before);
    let has_value = |node: &Node<'_, '_>| node.attributes().any(|attribute| attribute.value().contains("${"));
    let left = node.and_then(|node| node.descendants().find(|node| is_macro(node) || has_value(node)));
    left.map_or(faults, |node| vec![not_expanded(node)])
}

fn not_expanded(node: Node<'_, '_>) -> Diagnostic {
    Diagnostic::new(start_of(node), "this is a xacro file, not a URDF file")
        .label("a xacro macro or substitution")
        .help("expand it first: `xacro FILE.xacro > robot.urdf`")
}

/// Returns the mistake in a file that is not XML.
fn not_xml(text: &str, error: &roxmltree::Error) -> Diagnostic {
    if text.trim().is_empty() {
        return Diagnostic::whole_file("this file is empty").help("give the path of a URDF file");
    }
    let at = error.pos();
    let line = text.split_inclusive('\n').take(at.row.saturating_sub(1) as usize).map(str::len).sum();
    let column = |rest: &str| rest.chars().take(at.col.saturating_sub(1) as usize).map(char::len_utf8).sum();
    let place: usize = line + text.get(line..).map_or(0, column);
    let message = error.to_string();
    let (message, help) = if matches!(error, roxmltree::Error::DtdDetected) {
        (
            "this file declares entities".to_owned(),
            "remove <!DOCTYPE …> and write the text of the entities instead",
        )
    } else if !text.trim_start().starts_with('<') {
        ("this file is not XML".to_owned(), "give the path of a URDF file: it begins with <robot name=\"…\">")
    } else {
        (format!("this is not XML: {message}"), "correct the file; `xmllint FILE` shows more details")
    };
    let start = if matches!(error, roxmltree::Error::DtdDetected) { text.find("<!DOCTYPE") } else { None };
    let start = start.unwrap_or(place);
    Diagnostic::new(start..start + 1, message).label("here").help(help)
}

/// Returns the mistake if the root is not that of a URDF file.
fn not_urdf(root: Node<'_, '_>) -> Option<Diagnostic> {
    let span = start_of(root);
    let name = root.tag_name().name();
    // What defines or includes something has not been expanded; a call may have been forgotten.
    let defines = |node: &Node<'_, '_>| {
        is_macro(node)
            && matches!(
                &node.tag_name().name()[XACRO.len()..],
                "macro" | "property" | "include" | "arg" | "if" | "unless"
            )
    };
    if let Some(node) = root.descendants().find(defines) {
        return Some(not_expanded(node));
    }
    let help = match name {
        "robot" => return None,
        "sdf" => "this is SDF: convert it to URDF first (`gz sdf`, `sdformat_urdf`)",
        "mujoco" => "this is MJCF, the format of MuJoCo: convert it to URDF first",
        "COLLADA" => "this is a mesh, not a robot: give the URDF file that refers to it",
        _ => "a URDF file begins with <robot name=\"…\">",
    };
    let message = format!("expected `<robot>`, found `<{name}>`");
    Some(Diagnostic::new(span, message).label("expected `<robot>`").help(help))
}

/// Returns the span of the start tag of an element.
fn start_of(node: Node<'_, '_>) -> Span {
    let Span { start, end } = node.range();
    let text = node.document().input_text();
    let tag = text.get(start..end).and_then(|tag| tag.find('>')).map_or(end, |last| start + last + 1);
    start..tag
}

fn link(node: Node<'_, '_>, document: &Document) -> Option<Link> {
    let name = name(node, document)?;
    let before = document.mistakes();
    let mass = child(node, "inertial").and_then(|inertial| {
        let mass = child(inertial, "mass").and_then(|mass| number(mass, "value", document))?;
        let centre = placement(child(inertial, "origin"), document)?;
        (mass != 0.0).then_some((mass, centre.xyz))
    });
    if let Some((mass, _)) = mass
        && mass < 0.0
    {
        let mistake = Diagnostic::new(start_of(node), format!("the mass of `{name}` is negative"));
        document.mistake(mistake.help("a mass must be 0 or positive"));
    }
    let faults = faults(child(node, "inertial"), before, document);
    Some(Link { name, span: start_of(node), mass, faults })
}

fn joint(node: Node<'_, '_>, document: &Document) -> Option<Joint> {
    let [parent, child_link] = ["parent", "child"].map(|tag| end(node, tag, document));
    let (name, parent, child_link) = (name(node, document)?, parent?, child_link?);
    let before = document.mistakes();
    let kind = kind(node, document).unwrap_or(JointKind::Fixed);
    let placement = placement(child(node, "origin"), document).unwrap_or_default();
    let axis = axis(node, &name, kind, document).unwrap_or_default();
    let limits = limits(node, &name, kind, document).flatten();
    let mimic = child(node, "mimic").and_then(|node| mimic(node, document));
    let faults = faults(Some(node), before, document);
    Some(Joint {
        span: start_of(node),
        kind,
        parent,
        child: child_link,
        placement,
        axis,
        limits,
        mimic,
        name,
        faults,
    })
}

fn kind(node: Node<'_, '_>, document: &Document) -> Option<JointKind> {
    let attribute = attribute(node, "type", document)?;
    let found = JointKind::ALL.into_iter().find(|(name, _)| *name == attribute.value().trim());
    found.map(|(_, kind)| kind).or_else(|| {
        let names = JointKind::ALL.map(|(name, _)| name).join(", ");
        let message = format!("unknown joint type `{}`", attribute.value().escape_debug());
        document.refuse(attribute.range_value(), message, format!("the types are {names}"))
    })
}

/// Reads the link at one end of a joint: `parent` or `child`.
fn end(node: Node<'_, '_>, tag: &str, document: &Document) -> Option<Named> {
    let Some(end) = child(node, tag) else {
        let message = format!("this joint has no <{tag}>");
        return document.refuse(start_of(node), message, format!("name the link: <{tag} link=\"…\"/>"));
    };
    let link = attribute(end, "link", document)?;
    Some(Named { name: link.value().to_owned(), span: link.range_value() })
}

/// Reads the axis of a joint as a unit vector; x without an `<axis>`, by the definition of
/// URDF.
fn axis(node: Node<'_, '_>, name: &str, kind: JointKind, document: &Document) -> Option<[f64; 3]> {
    let Some(axis) = child(node, "axis") else { return Some([1.0, 0.0, 0.0]) };
    let xyz = three(axis, "xyz", [1.0, 0.0, 0.0], document)?;
    let largest = xyz.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    let length = xyz.iter().map(|x| (x / largest).powi(2)).sum::<f64>().sqrt() * largest;
    if length > 0.0 {
        // A unit vector but for rounding stays as it is in the file.
        return Some(if (length - 1.0).abs() < 1e-15 { xyz } else { xyz.map(|x| x / length) });
    }
    if matches!(kind, JointKind::Fixed | JointKind::Floating) {
        return Some([1.0, 0.0, 0.0]);
    }
    let message = format!("the axis of `{name}` is zero");
    document.refuse(start_of(axis), message, "give its direction: <axis xyz=\"0 0 1\"/>")
}

/// Reads the limits of a joint; `Some(None)` for a kind or a joint without limits.
fn limits(node: Node<'_, '_>, name: &str, kind: JointKind, document: &Document) -> Option<Option<[f64; 2]>> {
    let Some(limit) = child(node, "limit") else { return Some(None) };
    if !matches!(kind, JointKind::Revolute | JointKind::Prismatic) {
        return Some(None);
    }
    // The defaults of URDF.
    let [lower, upper] = ["lower", "upper"].map(|key| number_or(limit, key, 0.0, document));
    let (lower, upper) = (lower?, upper?);
    if lower > upper {
        let message = format!("the limits of `{name}` are reversed");
        return document.refuse(start_of(limit), message, "`lower` must not be greater than `upper`");
    }
    Some((lower < upper).then_some([lower, upper]))
}

fn mimic(node: Node<'_, '_>, document: &Document) -> Option<Mimic> {
    let joint = attribute(node, "joint", document)?;
    let multiplier = number_or(node, "multiplier", 1.0, document);
    let offset = number_or(node, "offset", 0.0, document);
    let joint = Named { name: joint.value().to_owned(), span: joint.range_value() };
    Some(Mimic { joint, multiplier: multiplier?, offset: offset? })
}

fn placement(node: Option<Node<'_, '_>>, document: &Document) -> Option<Placement> {
    let Some(node) = node else { return Some(Placement::default()) };
    let xyz = three(node, "xyz", [0.0; 3], document);
    let rpy = three(node, "rpy", [0.0; 3], document);
    Some(Placement { xyz: xyz?, rpy: rpy? })
}

fn three(node: Node<'_, '_>, key: &str, default: [f64; 3], document: &Document) -> Option<[f64; 3]> {
    let Some(attribute) = node.attribute_node(key) else { return Some(default) };
    let numbers: Option<Vec<f64>> = attribute.value().split_whitespace().map(finite).collect();
    match numbers.as_deref() {
        Some(&[x, y, z]) => Some([x, y, z]),
        _ => {
            let message = format!("`{key}` must be three finite numbers");
            document.refuse(attribute.range_value(), message, "separate them by blanks: `0 0 0.5`")
        }
    }
}

fn number_or(node: Node<'_, '_>, key: &str, default: f64, document: &Document) -> Option<f64> {
    if node.has_attribute(key) { number(node, key, document) } else { Some(default) }
}

fn number(node: Node<'_, '_>, key: &str, document: &Document) -> Option<f64> {
    let attribute = attribute(node, key, document)?;
    finite(attribute.value().trim()).or_else(|| {
        let help = "write it with a decimal point: `0.5`";
        document.refuse(attribute.range_value(), format!("`{key}` must be a finite number"), help)
    })
}

fn name(node: Node<'_, '_>, document: &Document) -> Option<String> {
    let attribute = attribute(node, "name", document)?;
    let name = attribute.value();
    if name.trim().is_empty() || name.contains(alters_text) || name.len() > LONGEST {
        let help = format!("a name has at most {LONGEST} bytes, in one line");
        return document.refuse(attribute.range_value(), "this is not a valid name".to_owned(), &help);
    }
    Some(name.to_owned())
}

fn attribute<'a, 'i>(node: Node<'a, 'i>, key: &str, document: &Document) -> Option<Attribute<'a, 'i>> {
    node.attribute_node(key).or_else(|| {
        let message = format!("this <{}> has no `{key}`", node.tag_name().name());
        document.refuse(start_of(node), message, format!("add {key}=\"…\""))
    })
}

/// Longest name in bytes: that of a frame in a spec.
const LONGEST: usize = 200;

fn child<'a, 'i>(node: Node<'a, 'i>, tag: &str) -> Option<Node<'a, 'i>> {
    node.children().find(|child| child.has_tag_name(tag))
}

/// Parses a number that a spec can hold.
fn finite(text: &str) -> Option<f64> {
    text.parse().ok().filter(|number: &f64| number.abs() < 1e150)
}
