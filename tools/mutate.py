"""Small wrong changes of the program, one at a time: does a test notice each?

`mutations.toml` has the changes; with `--draw` they are new ones at random places. They are made in
a copy of the tree, never in the tree itself.

Example:
    .venv-torch/bin/python -m tools.mutate
    .venv-torch/bin/python -m tools.mutate calibrate "the sign of"
    .venv-torch/bin/python -m tools.mutate --draw 60 --seed 1 --rooms pairs io --since v0.5.0
    .venv-torch/bin/python -m tools.mutate --draw 60 --seed 1 --whole --json draw.json
"""

from __future__ import annotations

import argparse
import contextlib
import json
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Iterator, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NamedTuple

from tools.wrong_changes import PACKAGES, Change, draw, file_of, near_tests, source_path, wide_tests

ROOT = Path(__file__).parent.parent
TABLE = ROOT / "tools" / "mutations.toml"
LAB = Path("lab")
"""Tests of the table that begin with it are those of the laboratory."""
LEFT_OUT = shutil.ignore_patterns(".*", "dist", "_build", "demo-output")
"""What no test of the table needs. Kernels that were compiled before are taken along."""
PATIENCE_S, TEST_PATIENCE_S = 4 * 3600, 1200
"""Tests, or one test, that run for longer hang, which is noticed."""
NOTICED, SURVIVED = "noticed", "SURVIVED"
BRIEF = ("--brief", "--hypothesis-profile", "brief")
NEAR, WHOLE = "near tests in brief and tables", "the whole suite"
"""Tests that judged a drawn change."""
NOT_RUN = (3, 4, 5)
"""Exit codes of pytest where it judged nothing: an error of its own, of its words, no tests."""
NO_TEST = "a hang, a crash or a module that cannot be imported"
NOT_IMPORTED = "ImportError while loading conftest"
"""Words of pytest where a change keeps all tests from being imported."""


class Mutation(NamedTuple):
    """A wrong change of one place."""

    name: str
    """Area, and what is wrong then."""
    file: str
    """As `source_path` takes it."""
    old: str
    """Text that is there once."""
    new: str
    tests: tuple[str, ...]
    """Those that should notice, as pytest names them; below `tests`, or `lab/` and below that."""


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


def run_tests(
    tree: Path, tests: Sequence[str | Path], *, until: Sequence[str] = ("-x",)
) -> tuple[str, list[str]]:
    """Whether tests of a copy of the tree notice its change, and which do.

    Args:
        tree: the copy.
        tests: as pytest names them, and options of its own; none: the whole suite.
        until: when pytest ends, in its words; by default with the first that notices.
    """
    words = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-rfE", *until]
    words += ["--timeout", str(TEST_PATIENCE_S), *map(str, tests)]
    words += ["-o", f"faulthandler_timeout={TEST_PATIENCE_S + 60}"]
    paths = [str(tree / "src"), str(tree / LAB / "src"), str(tree), os.environ.get("PYTHONPATH")]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, paths))}
    # Bytecode of a change that was made within the second of the right text would be taken for it.
    environment["PYTHONDONTWRITEBYTECODE"] = "1"
    with tempfile.TemporaryFile() as said:
        process = subprocess.Popen(
            words,
            cwd=tree,
            env=environment,
            stdout=said,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
        code = None
        try:
            with contextlib.suppress(subprocess.TimeoutExpired):
                code = process.wait(PATIENCE_S)
        finally:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()
        said.seek(0)
        output = said.read().decode(errors="replace")
    if code in NOT_RUN and NOT_IMPORTED not in output:
        raise RuntimeError(f"{' '.join(words)} did not run: {output}")
    failed = re.findall(r"^(?:FAILED|ERROR) (\S.*?)(?: - |$)", output, re.MULTILINE)
    return SURVIVED if code == 0 else NOTICED, failed


@contextlib.contextmanager
def changed(path: Path, text: str) -> Iterator[None]:
    """Another text of a file, for a while."""
    # Renamed back, it keeps its time, by which compiled kernels are found again.
    right = path.rename(path.with_suffix(".right"))
    path.write_text(text, "utf-8")
    try:
        yield
    finally:
        right.replace(path)


def judge(tree: Path, mutation: Mutation) -> str:
    """Change a copy of the tree, run the tests that should notice, change it back."""
    path = tree / source_path(mutation.file)
    with changed(path, path.read_text("utf-8").replace(mutation.old, mutation.new)):
        return run_tests(tree, [path_of_test(one) for one in mutation.tests])[0]


def judge_drawn(tree: Path, change: Change, failing: set[str]) -> tuple[str, str]:
    """Whether the tests near a change notice it in a brief run, or those of all tables; and which.

    A test that fails without the change too is added to `failing` and judges nothing.
    """
    path, near = tree / source_path(change.file), near_tests(change.file, tree)
    # Tests of the laboratory alone do not read the file that defines the option.
    brief = () if all(one.startswith(LAB.name) for one in near) else BRIEF
    wide = wide_tests(change.file, tree)
    runs: list[tuple[list[str], tuple[str, ...]]] = [(near, brief), *([(wide, ())] if wide else [])]
    while True:
        tests, options = runs[0]
        tests = [*tests, *(f"--deselect={one}" for one in failing)]
        with changed(path, change.applied(path.read_text("utf-8"))):
            verdict, noticing = run_tests(tree, tests, until=("-x", *options))
        if verdict == SURVIVED and runs[1:]:
            del runs[0]
        elif verdict == SURVIVED or not noticing or run_tests(tree, noticing)[0] == SURVIVED:
            return verdict, noticing[0] if noticing else NO_TEST
        else:
            failing.update(noticing)


def judge_together(
    tree: Path, changes: Sequence[Change], failing: set[str]
) -> Iterator[tuple[Change, str, str]]:
    """Whether any test of the whole suite notices each of several changes, and which one does.

    The suite runs once with all of them, one of each file at a time; then the tests that failed
    run with each alone. A test that fails without any is added to `failing` and judges nothing.
    """
    rest = list(changes)
    while group := {one.file: one for one in reversed(rest)}:
        rest = [one for one in rest if group[one.file] is not one]
        texts = {tree / source_path(file): one for file, one in group.items()}
        with contextlib.ExitStack() as stack:
            for path, one in texts.items():
                stack.enter_context(changed(path, one.applied(path.read_text("utf-8"))))
            verdict, tests = run_tests(tree, (), until=("-n", "1"))
        if verdict == NOTICED and not tests:
            raise RuntimeError(f"with all of {[*group]} changed the suite does not run")
        if tests:
            failing.update(run_tests(tree, tests, until=())[1])
        tests = [one for one in tests if one not in failing]
        for path, one in texts.items():
            verdict, noticing = SURVIVED, list[str]()
            if tests:
                with changed(path, one.applied(path.read_text("utf-8"))):
                    verdict, noticing = run_tests(tree, tests)
            yield one, verdict, noticing[0] if noticing else NO_TEST


def wilson_interval(count: int, total: int) -> tuple[float, float]:
    """Where a share lies with 95 %, by Wilson's score, DOI 10.1080/01621459.1927.10502953."""
    if not total:
        return 0.0, 1.0
    z = 1.959964
    centre = (count + z * z / 2) / (total + z * z)
    half = z / (total + z * z) * math.sqrt(count * (total - count) / total + z * z / 4)
    return max(0.0, centre - half), min(1.0, centre + half)


def lines_changed_since(commit: str) -> dict[str, set[int]]:
    """Numbers of the lines that were changed after a commit, by files as of `source_path`."""
    folders = dict.fromkeys(str(folder) for folder, _ in PACKAGES.values())
    words = ["git", "diff", "-U0", "--no-prefix", "--diff-filter=d", commit, "--", *folders]
    found: dict[str, set[int]] = {}
    file = ""
    for line in subprocess.check_output(words, cwd=ROOT, text=True).splitlines():
        if line.startswith("+++ "):
            file = file_of(Path(line.removeprefix("+++ ")))
        elif match := re.match(r"@@ -\S+ \+(\d+)(?:,(\d+))? @@", line):
            first, count = int(match[1]), int(match[2] or 1)
            found.setdefault(file, set()).update(range(first, first + count))
    return found


def judge_draw(tree: Path, options: argparse.Namespace) -> int:
    """Draw changes, judge and print each; returns 0 if all are noticed.

    With a file of verdicts, those in it stand: a draw that was stopped goes on.
    """
    lines = lines_changed_since(options.since) if options.since else None
    drawn = dict(enumerate(draw(options.draw, options.seed, tree, options.rooms, lines), 1))
    drawn = {key: one for key, one in drawn.items() if not options.only or key in options.only}
    failing: set[str] = set()
    rows: dict[int, dict[str, Any]] = {}
    if options.json and options.json.exists():
        rows = {row["number"]: row for row in json.loads(options.json.read_text())}

    def note(number: int, verdict: str, test: str, by: str) -> None:
        one = drawn[number]
        text = (tree / source_path(one.file)).read_text("utf-8")
        old, new = (each.splitlines()[one.line - 1].strip() for each in (text, one.applied(text)))
        row = {"number": number, "file": one.file, "line": one.line, "kind": one.kind, "old": old}
        rows[number] = row | {"new": new, "verdict": verdict, "test": test, "by": by}
        noticing = f" by {test}" if verdict == NOTICED else ""
        sys.stdout.write(
            f"{number}  {one.file}:{one.line}  {verdict}{noticing}\n- {old}\n+ {new}\n"
        )
        sys.stdout.flush()
        if options.json:
            options.json.write_text(json.dumps([*rows.values()], indent=1))

    for number in sorted(drawn.keys() - rows.keys()):
        note(number, *judge_drawn(tree, drawn[number], failing), NEAR)
    if options.whole:
        left = {key for key, row in rows.items() if row["verdict"] == SURVIVED}
        numbers = {drawn[key]: key for key in sorted(left) if rows[key]["by"] == NEAR}
        for one, verdict, test in judge_together(tree, [*numbers], failing):
            note(numbers[one], verdict, test, WHOLE)
    survivors = {key: row for key, row in rows.items() if row["verdict"] == SURVIVED}
    count = len(rows) - len(survivors)
    low, high = wilson_interval(count, len(rows))
    sys.stdout.write(f"{count} of {len(rows)} noticed, 95 % interval {low:.0%} to {high:.0%}\n")
    for number, row in survivors.items():
        sys.stdout.write(f"{number}  {row['file']}:{row['line']}  {row['new']}\n")
    return int(bool(survivors))


def judge_table(tree: Path, words: Sequence[str]) -> int:
    """Make the changes whose names hold one of the words, or all; returns 0 if all are noticed."""
    chosen = [one for one in read_table() if not words or any(word in one.name for word in words)]
    tests = sorted({test for one in chosen for test in one.tests})
    if run_tests(tree, [path_of_test(one) for one in tests])[0] is not SURVIVED:
        sys.exit(f"without any change, tests fail: pytest {' '.join(tests)}")
    verdicts = []
    for one in chosen:
        verdicts.append(judge(tree, one))
        sys.stdout.write(f"{verdicts[-1]}  {one.name}\n")
        sys.stdout.flush()
    sys.stdout.write(f"{verdicts.count(NOTICED)} of {len(chosen)} noticed\n")
    return int(SURVIVED in verdicts)


def _read_options(words: Sequence[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="tools.mutate", description=__doc__.partition("\n")[0])
    parser.add_argument("names", nargs="*", help="only changes of the table that are named so")
    parser.add_argument("--draw", type=int, metavar="N", help="N new changes at random places")
    parser.add_argument("--seed", type=int, default=0, help="of the draw")
    parser.add_argument(
        "--rooms", nargs="+", default=(),
        help="draw in these folders of texvent, or in texvent_scenes and texvent_lab",
    )  # fmt: skip
    parser.add_argument("--since", metavar="COMMIT", help="draw in the lines changed since then")
    parser.add_argument(
        "--only", type=lambda text: {int(one) for one in text.split(",")}, metavar="3,17",
        help="judge these numbers of the draw",
    )  # fmt: skip
    parser.add_argument(
        "--whole", action="store_true",
        help="hold those that no near test notices to the whole suite, all at once",
    )  # fmt: skip
    parser.add_argument(
        "--json", type=Path, metavar="FILE", help="keep the verdicts here, and go on"
    )
    return parser.parse_args(words)


def main(words: Sequence[str]) -> int:
    """Judge the changes of the table or of a draw; returns 0 if all are noticed."""
    options = _read_options(words)
    if find_spec("torch") is None:
        sys.exit("some of the tests need torch: make .venv-torch/.torch, and use its Python")
    with tempfile.TemporaryDirectory(prefix="texvent-mutate-") as folder:
        tree = Path(shutil.copytree(ROOT, Path(folder, "tree"), ignore=LEFT_OUT, symlinks=True))
        if options.draw:
            return judge_draw(tree, options)
        return judge_table(tree, options.names)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
