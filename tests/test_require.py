"""The commands that messages print to install what is missing."""

import re
import sys
from pathlib import Path

import pytest

from texvent import _require
from texvent._require import install_command, lab_command, reinstall_command, require
from texvent.errors import MissingDependencyError

ROOT = Path(__file__).parents[1]


def test_one_function_writes_what_messages_print_to_install():
    sources = [*ROOT.glob("src/**/*.py"), *ROOT.glob("lab/src/**/*.py")]
    texts = {path: path.read_text(encoding="utf-8") for path in sources}
    typed = re.compile(r"pip install ")
    assert [path for path, text in texts.items() if typed.search(text)] == []


@pytest.mark.parametrize("is_ours", [True, False])
def test_pip_is_that_of_the_running_python(is_ours, monkeypatch):
    python = Path(sys.executable)
    folder = python.parent if is_ours else Path("/elsewhere")
    monkeypatch.setattr("shutil.which", lambda name: str(folder / name))
    pip = "pip" if is_ours else f"{python} -m pip"
    assert install_command("texvent[plot]") == f"{pip} install 'texvent[plot]'"


def test_a_checkout_is_installed_anew_from_its_folder_and_a_wheel_from_where_it_came(monkeypatch):
    assert reinstall_command().endswith(f"install -e {ROOT}")
    assert lab_command().endswith(f"install -e {ROOT / 'lab'}")
    with pytest.raises(MissingDependencyError, match=r"install -e '?\S*lab\[train\]'?$"):
        require("no_such_module", extra="texvent-lab[train]")
    monkeypatch.setattr(_require, "CHECKOUT", Path("/elsewhere"))
    note = '{"url": "file:///texvent.whl"}'
    found = type("Found", (), {"read_text": lambda self, name: note})()
    monkeypatch.setattr("importlib.metadata.distribution", lambda name: found)
    assert reinstall_command().endswith("install --force-reinstall --no-deps file:///texvent.whl")
    assert "install ./lab in a clone" in lab_command()
