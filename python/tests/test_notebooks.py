"""Notebooks of docs/python: every cell has its stored output. UPDATE_EXPECT=1 stores new outputs."""

import os
import shutil
from pathlib import Path

import pytest

nbformat = pytest.importorskip("nbformat", reason="nbformat and nbclient, which run notebooks, are not installed")
nbclient = pytest.importorskip("nbclient", reason="nbclient, which runs notebooks, is not installed")
pytest.importorskip("ipykernel", reason="ipykernel, which runs notebooks, is not installed")

FOLDER = Path(__file__).parents[2] / "docs/python"
# MIME types that Jupyter shows without extensions.
SHOWN = ("text/plain", "text/html", "image/svg+xml")


def outputs(cell):
    """Merge the outputs of a cell: its printed text, and the value of its last line."""
    shown = []
    for output in cell.outputs:
        if output.output_type == "stream" and shown and shown[-1].get("name") == output.name:
            shown[-1]["text"] += output.text
        elif output.output_type == "stream":
            shown.append(nbformat.v4.new_output("stream", name=output.name, text=output.text))
        else:
            data = {kind: text for kind, text in output.data.items() if kind in SHOWN}
            more = {"execution_count": cell.execution_count} if output.output_type == "execute_result" else {}
            shown.append(nbformat.v4.new_output(output.output_type, data=data, **more))
    return shown


@pytest.mark.parametrize("name", sorted(file.name for file in FOLDER.glob("*.ipynb")))
def test_notebook(name):
    if name == "a-compensator.ipynb" and not shutil.which("cc"):
        pytest.skip("there is no C compiler")
    stored = nbformat.read(FOLDER / name, as_version=4)
    run = nbformat.read(FOLDER / name, as_version=4)
    nbclient.NotebookClient(run, timeout=120, kernel_name="python3", record_timing=False).execute()
    for cell in run.cells:
        if cell.cell_type == "code":
            cell.outputs = outputs(cell)
            assert all(output.get("name") != "stderr" for output in cell.outputs), cell.outputs
    if os.environ.get("UPDATE_EXPECT"):
        run.metadata.pop("widgets", None)
        run.metadata.language_info = {"name": "python"}
        nbformat.write(run, FOLDER / name)
        return
    for cell, expected in zip(run.cells, stored.cells, strict=True):
        assert cell.get("outputs") == expected.get("outputs"), f"{name}: {cell.source}"


def test_there_are_notebooks():
    assert len(list(FOLDER.glob("*.ipynb"))) >= 3
