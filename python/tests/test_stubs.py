"""Stubs: their docstrings are those of the module. `UPDATE_EXPECT=1` writes them."""

import ast
import doctest
import inspect
import json
import os
import re
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

import abbe

STUBS = Path(__file__).parents[1] / "abbe/_abbe.pyi"


def documented(tree):
    """Yield each public class, method and function of the stubs, with its docstring in the module."""
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            owner = getattr(abbe._abbe, node.name)
            yield node, inspect.getdoc(owner)
            for method in node.body:
                if isinstance(method, ast.FunctionDef) and not method.name.startswith("_"):
                    yield method, inspect.getdoc(getattr(owner, method.name))
        elif isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
            yield node, inspect.getdoc(getattr(abbe._abbe, node.name))


def literal(text, indent):
    """Format a docstring."""
    text = text.replace("\\", "\\\\")
    if "\n" not in text:
        return f'{indent}"""{text}"""'
    return textwrap.indent(f'"""{text}\n"""', indent, lambda line: line.strip())


def with_docstrings(source):
    """Return the stubs with the docstrings of the module."""
    tree, lines = ast.parse(source), source.splitlines()
    for node, text in sorted(documented(tree), key=lambda pair: -pair[0].lineno):
        assert text, node.name
        first = node.body[0]
        indent = " " * (node.col_offset + 4)
        is_docstring = isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant) and isinstance(first.value.value, str)
        body = literal(text, indent).splitlines()
        if isinstance(node, ast.ClassDef):
            start, end = first.lineno - 1, first.end_lineno if is_docstring else first.lineno - 1
            # A decorator is above its function.
            start = end = min([start, *(one.lineno - 1 for one in getattr(first, "decorator_list", []))]) if not is_docstring else end
            lines[(first.lineno - 1 if is_docstring else start) : end] = body
        elif is_docstring:
            lines[first.lineno - 1 : first.end_lineno] = body
        else:
            assert lines[first.end_lineno - 1].endswith(": ...")
            lines[first.end_lineno - 1] = lines[first.end_lineno - 1].removesuffix(" ...")
            lines[first.end_lineno : first.end_lineno] = body
    return "\n".join(lines) + "\n"


def test_docstrings_are_those_of_the_module():
    source = STUBS.read_text(encoding="utf-8")
    wanted = with_docstrings(source)
    if os.environ.get("UPDATE_EXPECT"):
        STUBS.write_text(wanted, encoding="utf-8")
    else:
        assert source == wanted, "UPDATE_EXPECT=1 writes the docstrings"


EXAMPLE = '''
import abbe
from abbe.reports import AnalyzeReport

machine = abbe.load("pps")
report: AnalyzeReport = machine.analyze(monte_carlo=0)
radius: float = report.combined.radius
first: str = report.ledger.sources[0].name
pose = machine.pose(report.combined.worst)
angle: float = report.combined.worst["q4"]
if report.verdict is not None and report.verdict.position is not None:
    verdict: str = report.verdict.position.verdict
    probability: float = report.verdict.position.probability
machine.identify("data.csv", "ur5", robust="tukey").parameters[0].standard_deviation
'''

WRONG = '''
import abbe

machine = abbe.load("pps")
machine.analyze().combined.radios
machine.identify("data.csv", "ur5", robust="turkey")
radius: str = machine.analyze().combined.radius
'''


def test_fields_are_typed(tmp_path):
    pytest.importorskip("mypy", reason="mypy is not installed")
    (tmp_path / "right.py").write_text(EXAMPLE, encoding="utf-8")
    (tmp_path / "wrong.py").write_text(WRONG, encoding="utf-8")
    run = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path / "cache")]
    right = subprocess.run([*run, "right.py"], cwd=tmp_path, capture_output=True, text=True)
    assert right.returncode == 0, right.stdout
    wrong = subprocess.run([*run, "wrong.py"], cwd=tmp_path, capture_output=True, text=True).stdout
    assert [line.split(":")[1] for line in wrong.splitlines() if ": error:" in line] == ["5", "6", "7"], wrong


def examples():
    """Yield the examples of the chapter, of the docstrings and of the notebooks, as Python."""
    docs, parser = Path(__file__).parents[2] / "docs", doctest.DocTestParser()
    texts = {"chapter": "\n".join(re.findall(r"^```pycon\n(.*?)^```", (docs / "python.md").read_text(encoding="utf-8"), re.M | re.S))}
    for name, owner in [("Machine", abbe.Machine), ("abbe", abbe)]:
        texts |= {f"{name}_{member}": inspect.getdoc(getattr(owner, member)) or "" for member in dir(owner) if not member.startswith("_")}
    for name, text in texts.items():
        if code := "".join(example.source for example in parser.get_examples(text)):
            yield name, code
    for notebook in sorted((docs / "python").glob("*.ipynb")):
        cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
        yield notebook.stem.replace("-", "_"), "\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code")


def test_examples_are_typed(tmp_path):
    pytest.importorskip("mypy", reason="mypy is not installed")
    for name, code in examples():
        (tmp_path / f"{name}.py").write_text(code, encoding="utf-8")
    files = sorted(path.name for path in tmp_path.glob("*.py"))
    run = [sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports", "--cache-dir", str(tmp_path / "cache"), *files]
    found = subprocess.run(run, cwd=tmp_path, capture_output=True, text=True)
    assert len(files) > 20 and found.returncode == 0, found.stdout
