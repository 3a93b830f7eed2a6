"""What notebooks of docs/notebooks hold; `make docs` runs them, and refuses errors and warnings."""

import json
import re
from pathlib import Path

import pytest

FOLDER = Path(__file__).parents[2] / "docs/notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))


def cells_of(path: Path) -> list[dict]:
    return json.loads(path.read_text(encoding="utf-8"))["cells"]


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
