"""parse_st.py FILE…: reads Structured Text by the grammar of tree-sitter, and fails at the first text that it rejects."""

import sys

import tree_sitter
import tree_sitter_iec61131_3_st as grammar

parser = tree_sitter.Parser(tree_sitter.Language(grammar.language()))


def faults(node):
    """Yields the nodes that are errors or were missing."""
    if node.type == "ERROR" or node.is_missing:
        yield node
    for child in node.children:
        yield from faults(child)


for name in sys.argv[1:]:
    with open(name, "rb") as file:
        tree = parser.parse(file.read())
    for node in faults(tree.root_node):
        row, column = node.start_point
        sys.exit(f"{name}:{row + 1}:{column + 1}: not Structured Text")
