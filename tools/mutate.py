"""Small wrong changes of the program, one at a time: does a test notice each?

`mutations.toml` has the changes. They are made in a copy of the tree, never in the tree itself.

Example:
    .venv-torch/bin/python -m tools.mutate
    .venv-torch/bin/python -m tools.mutate calibrate "the sign of"
"""

from __future__ import annotations

import contextlib
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parent.parent
TABLE = ROOT / "tools" / "mutations.toml"
SOURCES = Path("src", "texvent")
LAB = Path("lab")
"""Files and tests of the table that begin with it are those of the laboratory."""
LEFT_OUT = shutil.ignore_patterns(".*", "dist", "_build", "demo-output")
"""What no test of the table needs. Kernels that were compiled before are taken along."""
PATIENCE_S = 3600
"""Tests that run for longer hang, which is noticed."""
NOTICED, SURVIVED = "noticed", "SURVIVED"
NOT_RUN = (3, 4, 5)
"""Exit codes of pytest where it judged nothing: an error of its own, of its words, no tests."""


class Mutation(NamedTuple):
    """A wrong change of one place."""

    name: str
    """Area, and what is wrong then."""
    file: str
    """Below `SOURCES`, or `lab/` and below lab/src/texvent_lab."""
    old: str
    """Text that is there once."""
    new: str
    tests: tuple[str, ...]
    """Those that should notice, as pytest names them; below `tests`, or `lab/` and below that."""


def source_path(file: str) -> Path:
    """Path of a file of the table."""
    inner = Path(file)
    if inner.parts[0] == LAB.name:
        return LAB / "src" / "texvent_lab" / inner.relative_to(LAB)
    return SOURCES / inner


def path_of_test(test: str) -> Path:
    """Path of a test of the table."""
    inner = Path(test)
    return (
        LAB / "tests" / inner.relative_to(LAB)
        if inner.parts[0] == LAB.name
        else Path("tests", inner)
    )


def read_table(path: Path = TABLE, root: Path = ROOT) -> list[Mutation]:
    """The changes of a table.

    Raises:
        ValueError: a text that is to be changed is not there once.
    """
    found = []
    for area, changes in tomllib.loads(path.read_text("utf-8")).items():
        for what, (file, old, new, *tests) in changes.items():
            count = (root / source_path(file)).read_text("utf-8").count(old)
            if count != 1:
                raise ValueError(f"{area}, {what}: {file} has {old!r} {count} times, not once")
            found.append(Mutation(f"{area}: {what}", file, old, new, tuple(tests)))
    return found


def run_tests(tree: Path, tests: Sequence[str]) -> str:
    """What becomes of the change that a copy of the tree holds."""
    words = [sys.executable, "-m", "pytest", "-qx", "-p", "no:cacheprovider"]
    words += [str(path_of_test(one)) for one in tests]
    environment = {
        **os.environ,
        "PYTHONPATH": f"{tree / 'src'}{os.pathsep}{tree / LAB / 'src'}{os.pathsep}{tree}",
    }
    with tempfile.TemporaryFile() as said:
        process = subprocess.Popen(
            words, cwd=tree, env=environment, stdout=said, start_new_session=True
        )
        code = None
        try:
            with contextlib.suppress(subprocess.TimeoutExpired):
                code = process.wait(PATIENCE_S)
        finally:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()
        if code in NOT_RUN:
            said.seek(0)
            raise RuntimeError(f"{' '.join(words)} did not run: {said.read().decode()}")
    return SURVIVED if code == 0 else NOTICED


def judge(tree: Path, mutation: Mutation) -> str:
    """Change a copy of the tree, run the tests that should notice, change it back."""
    path = tree / source_path(mutation.file)
    # Renamed back, it keeps its time, by which compiled kernels are found again.
    right = path.rename(path.with_suffix(".right"))
    path.write_text(right.read_text("utf-8").replace(mutation.old, mutation.new), "utf-8")
    try:
        return run_tests(tree, mutation.tests)
    finally:
        right.replace(path)


def main(words: Sequence[str]) -> int:
    """Make the changes whose names hold one of the words, or all; returns 0 if all are noticed."""
    chosen = [one for one in read_table() if not words or any(word in one.name for word in words)]
    if find_spec("torch") is None:
        sys.exit("some of the tests need torch: make .venv-torch/.torch, and use its Python")
    os.nice(10)
    with tempfile.TemporaryDirectory(prefix="texvent-mutate-") as folder:
        tree = Path(shutil.copytree(ROOT, Path(folder, "tree"), ignore=LEFT_OUT, symlinks=True))
        tests = sorted({test for one in chosen for test in one.tests})
        if run_tests(tree, tests) is not SURVIVED:
            sys.exit(f"without any change, tests fail: pytest {' '.join(tests)}")
        verdicts = []
        for one in chosen:
            verdicts.append(judge(tree, one))
            sys.stdout.write(f"{verdicts[-1]}  {one.name}\n")
            sys.stdout.flush()
    sys.stdout.write(f"{verdicts.count(NOTICED)} of {len(chosen)} noticed\n")
    return int(SURVIVED in verdicts)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
