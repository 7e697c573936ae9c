//! A PLCopen document has the types, variables, comments and statements of the text: written as
//! text again, the parser of the tests finds the same program.

use abbe_codegen::print::Language;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_tests::structured_text::Program;
use abbe_tests::{hostile, specs};
use roxmltree::{Document, Node};

use super::{shipped, text};

fn children<'d>(node: Node<'d, 'd>) -> impl Iterator<Item = Node<'d, 'd>> {
    node.children().filter(Node::is_element)
}

fn child<'d>(node: Node<'d, 'd>, name: &str) -> Node<'d, 'd> {
    children(node).find(|one| one.tag_name().name() == name).unwrap_or_else(|| panic!("no {name}"))
}

/// Returns the type that an element contains.
fn type_in(node: Node<'_, '_>) -> String {
    let kind = children(node).next().unwrap();
    match kind.tag_name().name() {
        "derived" => kind.attribute("name").unwrap().to_owned(),
        "array" => {
            let dimension = child(kind, "dimension");
            let [lower, upper] = ["lower", "upper"].map(|end| dimension.attribute(end).unwrap());
            format!("ARRAY[{lower}..{upper}] OF {}", type_in(child(kind, "baseType")))
        }
        elementary => elementary.to_owned(),
    }
}

fn variable(node: Node<'_, '_>) -> String {
    let simple = |node: Node<'_, '_>| child(node, "simpleValue").attribute("value").unwrap().to_owned();
    let initial = children(node).find(|one| one.tag_name().name() == "initialValue").map(|initial| {
        let value = children(initial).next().unwrap();
        if value.tag_name().name() == "simpleValue" {
            return format!(" := {}", simple(initial));
        }
        let entries: Vec<String> = children(value).map(simple).collect();
        format!(" := [{}]", entries.join(", "))
    });
    let name = node.attribute("name").unwrap();
    format!("{name} : {}{};\n", type_in(child(node, "type")), initial.unwrap_or_default())
}

/// Writes a document as Structured Text.
fn text_of(document: &str) -> String {
    let document = Document::parse(document).unwrap();
    let types = child(document.root_element(), "types");
    let mut text = "TYPE\n".to_owned();
    for one in children(child(types, "dataTypes")) {
        text += &format!("{} : {};\n", one.attribute("name").unwrap(), type_in(child(one, "baseType")));
    }
    text += "END_TYPE\n";
    for unit in children(child(types, "pous")) {
        let kind = match unit.attribute("pouType").unwrap() {
            "function" => "FUNCTION",
            other => {
                assert_eq!(other, "functionBlock");
                "FUNCTION_BLOCK"
            }
        };
        text += &format!("{kind} {}", unit.attribute("name").unwrap());
        for list in children(child(unit, "interface")) {
            let section = match list.tag_name().name() {
                "returnType" => {
                    text += &format!(" : {}", type_in(list));
                    continue;
                }
                "inputVars" => "VAR_INPUT",
                "outputVars" => "VAR_OUTPUT",
                "inOutVars" => "VAR_IN_OUT",
                "localVars" if list.attribute("constant") == Some("true") => "VAR CONSTANT",
                "localVars" => "VAR",
                other => panic!("{other}"),
            };
            text += &format!("\n{section}\n{}END_VAR", children(list).map(variable).collect::<String>());
        }
        let body = child(child(unit, "body"), "ST").first_element_child().unwrap().text().unwrap();
        text += &format!("\n{body}\nEND_{kind}\n");
    }
    text
}

/// Returns a text without comments, and with one space between words.
fn plain(text: &str) -> String {
    let mut rest = text;
    let mut all = String::new();
    while let Some((before, comment)) = rest.split_once("(*") {
        all += before;
        rest = comment.split_once("*)").unwrap().1;
    }
    (all + rest).split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Returns declarations of several variables as one for each.
fn one_by_one(text: &str) -> String {
    let mut lines = vec![];
    for line in text.lines() {
        match line.trim().split_once(" : ") {
            Some((names, kind)) if names.contains(", ") && !names.contains(['(', '=']) => {
                lines.extend(names.split(", ").map(|name| format!("{name} : {kind}")));
            }
            _ => lines.push(line.to_owned()),
        }
    }
    lines.join("\n")
}

/// Shipped machines, loops and tables, and names and texts that mean something in XML and in
/// Structured Text.
#[test]
fn a_document_is_the_text() {
    let others = ["measured", "linkage", "planar"].map(|name| Spec::read(specs::path(name)).unwrap());
    let hostile = hostile::specs(110).step_by(3);
    let hostile = hostile.filter_map(|(name, text)| Spec::parse(&format!("{name}.toml"), &text).ok());
    for spec in SHIPPED.iter().map(|one| shipped(one.name)).chain(others).chain(hostile) {
        let document = Language::Plcopen.files(&spec).remove(0);
        assert_eq!(document.name, format!("{}.xml", spec.name));
        let again = text_of(&document.text);
        let expected = plain(&one_by_one(&text(&spec))).replace("[ ", "[");
        assert!(
            plain(&again) == expected,
            "{}: {:?}",
            spec.name,
            first_difference(&plain(&again), &expected)
        );
        Program::parse(&again).unwrap_or_else(|fault| panic!("{}: {fault}", spec.name));
    }
}

fn first_difference(ours: &str, expected: &str) -> Option<(String, String)> {
    let mut pairs = ours.split(' ').zip(expected.split(' '));
    pairs.find(|(ours, expected)| ours != expected).map(|(ours, expected)| (ours.into(), expected.into()))
}

/// Comments of blocks and inputs stand in the document.
#[test]
fn comments_become_documentation() {
    let document = Language::Plcopen.files(&shipped("pps")).remove(0).text;
    let document = Document::parse(&document).unwrap();
    let documented = |name: &str, part: &str| {
        let node = document.descendants().find(|node| node.attribute("name") == Some(name)).unwrap();
        let said = child(node, "documentation").first_element_child().unwrap();
        assert!(said.text().unwrap_or_default().contains(part), "{name}: {:?}", said.text());
    };
    documented("pps_compensated", "corrected");
    documented("pps_is_within", "within an interval");
    documented("inputs", "(kg)");
}
