"""`texvent doctor`: a sound installation row by row, and what each fault changes in it."""

import os
import re
import shutil
import sys
import tempfile
import tomllib
from collections.abc import Callable
from importlib import metadata
from pathlib import Path
from types import SimpleNamespace

import av
import pytest
from numba.core import config
from packaging.requirements import Requirement
from tests.cli.running import run

import texvent
from texvent._registry import REGISTRIES
from texvent._require import install_command
from texvent.cli.setup.doctor import DEVELOPERS

PYPROJECT = Path(__file__).parents[2] / "pyproject.toml"
Patch = pytest.MonkeyPatch
Rows = dict[str, list[str]]


def report(capsys: pytest.CaptureFixture[str]) -> tuple[int, Rows, list[str]]:
    """Exit code, name of a row → its mark, state and remedy, and the lines below the rows."""
    code = run("doctor")
    rows, others = {}, []
    for line in capsys.readouterr().out.splitlines():
        if line[2:4] == "  ":
            mark, name, *said = re.split(" {2,}", line)
            rows[name] = [mark, *said]
        else:
            others.append(line)
    return code, rows, others


def is_installed(name: str) -> bool:
    return next(iter(metadata.Distribution.discover(name=name)), None) is not None


def wanted(extra: str = "") -> list[str]:
    """Names of what texvent, or an extra of it alone, needs here."""
    found = []
    for one in map(Requirement, metadata.requires("texvent") or []):
        holds = [one.marker is None or one.marker.evaluate({"extra": name}) for name in ("", extra)]
        if one.name != "texvent" and holds == [not extra, True]:
            found.append(one.name)
    return found


def test_a_sound_installation_is_said_part_by_part(capsys):
    code, rows, others = report(capsys)
    assert (code, {mark for mark, *_ in rows.values()}) == (0, {"ok", "--"})
    version = ".".join(map(str, sys.version_info[:3]))
    assert rows.pop("Python")[1].startswith(f"{version} on ")
    assert rows.pop("texvent")[1].startswith(texvent.__version__)
    assert rows.pop("H.264 encoder") == ["ok", "libx264"]
    free = shutil.disk_usage(Path.cwd()).free / 2**30
    assert float(rows.pop("current folder")[1].split(" GB free")[0]) == pytest.approx(free, abs=1)
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    assert rows.pop("processors") == ["ok", f"{os.cpu_count()} cores, {memory:.0f} GB memory"]
    assert "compiled functions" in rows
    del rows["compiled functions"]
    expected: Rows = {name: ["ok", metadata.version(name)] for name in wanted()}
    for extra in tomllib.loads(PYPROJECT.read_text())["project"]["optional-dependencies"]:
        missing = [one for one in wanted(extra) if not is_installed(one)]
        remedy = install_command(f"texvent[{extra}]")
        row = ["--", f"not here: {', '.join(missing)}", remedy] if missing else ["ok", "here"]
        expected |= {} if extra in DEVELOPERS else {f"[{extra}]": row}
    assert rows == expected
    assert others == [f"{kind}s: {', '.join(one.names())}" for kind, one in REGISTRIES.items()]


def absent(package: str) -> Callable[[Patch, Path], None]:
    return lambda patch, folder: patch.setitem(sys.modules, package, None)


def without_h264(patch: Patch, folder: Path) -> None:
    def refuse(*words: str) -> None:
        assert words == ("libx264", "w")
        raise ValueError

    patch.setattr(av.codec, "Codec", refuse)


def with_space(free: int) -> Callable[[Patch, Path], None]:
    return lambda patch, folder: patch.setattr(
        shutil, "disk_usage", lambda path: SimpleNamespace(free=free)
    )


def kept_in_folder(patch: Patch, folder: Path) -> None:
    patch.setattr(config, "CACHE_DIR", str(folder / "kernels"))


def kept_elsewhere(patch: Patch, folder: Path) -> None:
    kept_in_folder(patch, folder)
    patch.setattr(tempfile, "tempdir", str(folder / "temporary"))


NO_AV = r"cannot be imported: .*av.*"
REBUILT = install_command("--force-reinstall", "--only-binary", ":all:", "av")
KERNELS = "compiled functions"
KEPT = "name a folder that can be written with NUMBA_CACHE_DIR"


def folder_of_others(patch: Patch, folder: Path) -> None:
    may = os.access
    patch.setattr(os, "access", lambda path, mode: path != Path.cwd() and may(path, mode))


FAULTS: dict[str, tuple[Callable[[Patch, Path], None], Rows]] = {
    "old Python": (
        lambda patch, folder: patch.setattr(sys, "version_info", (3, 10, 9)),
        {"Python": ["no", ".*", "install Python 3.11 or newer"]},
    ),
    "no h5py": (absent("h5py"), {"h5py": ["no", ".*imported.*h5py.*", install_command("h5py")]}),
    "no OpenCV": (
        absent("cv2"),
        {
            "opencv-python-headless": [
                *("no", ".*imported.*cv2.*", install_command("opencv-python-headless"))
            ]
        },
    ),
    "no PyAV": (
        absent("av"),
        {
            "av": ["no", NO_AV, install_command("av")],
            "H.264 encoder": ["no", "PyAV is missing", install_command("av")],
        },
    ),
    "no H.264": (
        without_h264,
        {"H.264 encoder": ["no", "PyAV was built without libx264", REBUILT]},
    ),
    "a folder of others": (
        folder_of_others,
        {"current folder": ["no", ".* is not writable", "go to another folder, or use -o"]},
    ),
    "a full disk": (
        with_space(2**30 // 10),
        {"current folder": ["no", "0.1 GB free", "free some space"]},
    ),
    "a nearly full disk": (
        with_space(2**30 // 10 + 1),
        {"current folder": ["ok", "0.1 GB free"]},
    ),
    "kernels among temporary files": (
        kept_in_folder,
        {KERNELS: ["--", "kept in .*/kernels for now", KEPT]},
    ),
    "kernels in a folder": (kept_elsewhere, {KERNELS: ["ok", "kept in .*/kernels"]}),
}
"""Fault → how it is made, and the rows that it changes: mark, patterns of state and remedy."""


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_changes_its_own_rows_and_says_what_helps(fault, tmp_path, monkeypatch, capsys):
    make, expected = FAULTS[fault]
    monkeypatch.setattr(shutil, "disk_usage", lambda path: SimpleNamespace(free=2**33))
    _, before, others = report(capsys)
    make(monkeypatch, tmp_path)
    code, rows, same = report(capsys)
    assert (same, rows.keys()) == (others, before.keys())
    changed = {name: row for name, row in rows.items() if row != before[name]}
    assert changed.keys() == expected.keys()
    for name, (mark, *said) in changed.items():
        wanted_mark, state, *remedy = expected[name]
        assert (mark, said[1:]) == (wanted_mark, remedy)
        assert re.fullmatch(state, said[0]), said
    assert code == any(mark == "no" for mark, *_ in rows.values())
