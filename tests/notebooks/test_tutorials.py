"""Every notebook of docs/notebooks runs in a kernel, from its first cell to its last."""

from __future__ import annotations

import json
import os
import re
from pathlib import Path

import pytest

FOLDER = Path(__file__).parents[2] / "docs/notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))
MAX_OUTPUT = 3_000_000
"""Characters of all outputs of a notebook, so that it can be kept with them."""


def cells_of(path: Path) -> list[dict]:
    return json.loads(path.read_text(encoding="utf-8"))["cells"]


@pytest.mark.docs
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_tutorial_runs(path, tmp_path):
    import nbformat
    from nbclient import NotebookClient

    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    environment = {name: value for name, value in os.environ.items() if "PYTEST" not in name}
    where = {"metadata": {"path": str(tmp_path)}}
    NotebookClient(notebook, timeout=900, resources=where).execute(env=environment)
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    shown = {name for output in outputs for name in output.get("data", {})}
    assert {"text/html", "image/png"} <= shown
    warnings = [
        output.text
        for output in outputs
        if output.get("name") == "stderr" and "Warn" in output.text
    ]
    assert not warnings
    assert len(json.dumps(outputs)) < MAX_OUTPUT


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_it_is_stored_without_outputs_and_begins_with_the_installation(path):
    code = [cell for cell in cells_of(path) if cell["cell_type"] == "code"]
    assert not [cell for cell in code if cell["outputs"] or cell["execution_count"]]
    first = "".join(code[0]["source"])
    assert 'find_spec("texvent") is None' in first
    assert first == "".join(
        next(cell for cell in cells_of(NOTEBOOKS[0]) if cell["cell_type"] == "code")["source"]
    )


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_links_to_other_notebooks_exist(path):
    text = "".join("".join(cell["source"]) for cell in cells_of(path))
    for target in re.findall(r"\]\(([^)]+\.ipynb)\)", text):
        assert (FOLDER / target).is_file()


def test_the_installation_says_what_to_do_where_nothing_is_found(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code = next(cell for cell in cells_of(NOTEBOOKS[0]) if cell["cell_type"] == "code")
    source = "".join(code["source"]).replace('find_spec("texvent")', 'find_spec("no_such_module")')
    with pytest.raises(SystemExit, match="upload its wheel"):
        exec(source, {})
