"""Examples of the README and of the chapters in docs."""

import doctest
import os
import re
import shlex
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
COMMAND = os.environ.get("ABBE")
# test_scale.py runs the recipes for clusters, and a test of the command those for FMUs.
CHAPTERS = [
    page.name
    for page in sorted((ROOT / "docs").glob("*.md"))
    if page.name not in ("scale.md", "fmu.md") and "```python\n" in page.read_text(encoding="utf-8")
]


def blocks(page, language):
    return re.findall(rf"^```{language}$\n(.*?)^```$", (ROOT / page).read_text(encoding="utf-8"), re.M | re.S)


def test_page():
    pytest.importorskip("pyarrow", reason="pyarrow, which the page shows, is not installed")
    page = "\n".join(blocks("docs/python.md", "pycon"))
    runner = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS)
    runner.run(doctest.DocTestParser().get_doctest(page, {}, "docs/python.md", None, None))
    assert runner.tries > 10 and runner.failures == 0


def test_readme(tmp_path):
    (tmp_path / "specs").mkdir()
    [spec] = [block for block in blocks("README.md", "toml") if block.startswith("[manipulator]")]
    (tmp_path / "specs/arm.toml").write_text(spec, encoding="utf-8")
    [python] = blocks("README.md", "python")
    here = os.getcwd()
    try:
        os.chdir(tmp_path)
        exec(python, {})
        *_, jacobian, predicted = [line for line in python.splitlines() if "# (" in line]
        names = {}
        exec(python.split("arm.error_jacobian")[0], names)
        assert names["arm"].error_jacobian(names["q"]).shape == (1_000_000, 6, 12) and "(1000000, 6, 12)" in jacobian
        assert names["arm"].predict(names["q"]).shape == (1_000_000, 6) and "(1000000, 6)" in predicted
    finally:
        os.chdir(here)


@pytest.mark.skipif(not COMMAND, reason="the environment variable ABBE does not name the abbe command")
@pytest.mark.parametrize("page", CHAPTERS)
def test_chapter(page, tmp_path, monkeypatch):
    """Writes the files of a chapter, runs its commands, and executes its Python in one namespace, in the order of the page."""
    monkeypatch.chdir(tmp_path)
    names, executed = {}, 0
    text = (ROOT / "docs" / page).read_text(encoding="utf-8")
    for language, block in re.findall(r"^```([a-z]+)$\n(.*?)^```$", text, re.M | re.S):
        first, _, _ = block.partition("\n")
        name = re.fullmatch(r"(?:# |<!-- )(at the end of )?(\S+)(?: -->)?", first)
        if language in ("toml", "csv", "xml") and name:
            with open(name[2], "a" if name[1] else "w", encoding="utf-8") as file:
                file.write(block)
        elif language == "console":
            arguments = shlex.split(first.removeprefix("$ abbe "))
            subprocess.run([COMMAND, *arguments], check=True, capture_output=True)
        elif language == "python":
            exec(block, names)
            executed += 1
    assert executed
