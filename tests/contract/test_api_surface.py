"""The public names, pinned; and what importing them costs."""

import re
import subprocess
import sys
from pathlib import Path

import texvent

PUBLIC = set(texvent.__all__)
"""The lines of `__init__.pyi`, which mypy checks."""
HEAVY = ("torch", "numba", "cv2", "av", "h5py", "rich")


def loaded_by(statement: str) -> set[str]:
    code = f"{statement}\nimport sys; print(' '.join(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(done.stdout.split())


def test_the_public_names_are_few_and_all_exist():
    assert {"generate", "simulate", "EventStream"} < PUBLIC
    assert len(PUBLIC) <= 40
    assert all(hasattr(texvent, name) for name in PUBLIC)
    assert set(dir(texvent)) == PUBLIC


def test_the_page_of_the_api_names_all_of_them_and_no_others():
    page = (Path(__file__).parents[2] / "docs/api.md").read_text(encoding="utf-8")
    table = page.partition("| name | gives |")[2].partition("\n\n")[0]
    rows = [row.split("|")[1] for row in table.splitlines() if row.startswith("| `")]
    named = [name for row in rows for name in re.findall(r"`(\w+)", row)]
    assert sorted(named) == sorted(PUBLIC)


def test_the_api_and_the_value_types_load_no_heavy_package():
    names = ("generate", "simulate", "video", "open", "compare", "EventStream", "EventPackets")
    loaded = loaded_by(f"import texvent; {'; '.join(f'texvent.{name}' for name in names)}")
    assert not set(HEAVY) & loaded


def test_no_module_has_the_name_of_a_function():
    modules = {path.stem for path in Path(texvent.__path__[0]).iterdir()}
    assert {name for name in PUBLIC & modules if callable(getattr(texvent, name))} == set()
