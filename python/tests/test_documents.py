"""Examples of the README and docs/python.md."""

import doctest
import os
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


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
