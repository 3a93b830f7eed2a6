"""Outcomes of every public function, method and property at values of the types it takes.

    python -m tests.functions.calls          # writes the table anew; CHANGELOG.md says why
    python -m tests.functions.calls NAME     # prints the calls of those so named

`outcomes.txt` has four digits for each call. A function is there as soon as values of all its types
are known. Kernels run as plain Python, so an index beyond an array is an error and nothing is
compiled. A function whose outcome depends on the clock, the order or the machine has no digits.
"""

from __future__ import annotations

import contextlib
import copy
import inspect
import io
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from itertools import islice
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
from tests.functions.values import GIVEN, arguments, give, is_own, made, mark, modules, written

TABLE = Path(__file__).with_name("outcomes.txt")
KEPT = GIVEN.with_name("kept")
PLACES = (str(Path(__file__).parents[2]), sys.prefix, sys.base_prefix)
PACKAGES = ("texvent", "texvent_scenes", "texvent_lab")
ELSEWHERE = tuple(
    f"texvent{one}"
    for one in (
        "_scenes.read", "_scenes.checks", "_scenes.models", "_scenes.staging", "_scenes.raycast",
        "_scenes.procedural", "_scenes.rendered_scene", "_scenes.commands", "_lab.commands",
        "_lab.measure", ".cli.setup", ".generation.videos.video_cache",
        ".generation.diffusers_models.guardrail", "._require", "._registry", ".runtime.jit",
        ".interpolate.dis_flow", ".runtime.files.hidden_parts", ".runtime.memory",
        ".runtime.threads", ".runtime.devices", ".runtime.identity", ".runtime.work",
        ".simulation.gpu",
    )
)  # fmt: skip
"""Scenes, which goldens hold; and what reads memory by its address, or tells of the machine."""
OPTIONAL = ("torch", "triton", "diffusers", "ray", "jax", "tensorflow", "torchvision")
"""Packages that no environment of tests shares: they are kept from being imported."""
MOST_CALLS, SLOW_S, PATIENCE_S = 24, 1.0, 60
"""Calls of a function or object; a function that takes longer has no digits, or hangs."""
DENIED = ("subprocess.Popen", "os.system", "os.fork", "os.exec", "os.posix_spawn", "os.kill",
          "socket.connect", "socket.bind", "socket.getaddrinfo",
          "webbrowser.open")  # fmt: skip
CHANGES = ("os.remove", "os.rename", "os.rmdir", "os.mkdir", "os.truncate", "os.chmod",
           "shutil.rmtree")  # fmt: skip


class TooLong(BaseException):
    """A call that does not end."""


def watch(event: str, words: tuple[Any, ...]) -> None:
    """Keep calls from starting programs, and from changing files elsewhere."""
    if event in DENIED:
        raise PermissionError(event)
    writes = event == "open" and isinstance(words[1], str) and {*"wax+"} & {*words[1]}
    flags = words[2] if event == "open" and isinstance(words[2], int) else 0
    writes = writes or flags & (os.O_WRONLY | os.O_RDWR)
    if (writes or event in CHANGES) and isinstance(words[0], str | bytes):
        place = os.path.realpath(os.fsdecode(words[0]))
        if not place.startswith((str(Path.cwd().parent), "/dev/null")):
            raise PermissionError(event)


def functions() -> Iterator[tuple[str, list[Callable[..., Any]]]]:
    """Names and calls of functions, and of the methods and properties of objects of each class."""
    for module in modules(PACKAGES, ELSEWHERE):
        for name, one in sorted(vars(module).items()):
            if getattr(one, "__module__", "") != module.__name__ or name.startswith("_"):
                continue
            place = f"{module.__name__}.{name}"
            if inspect.isclass(one):
                yield from methods(place, one)
            elif inspect.isroutine(one) or hasattr(one, "__wrapped__"):
                yield place, [one]


def methods(place: str, kind: type) -> Iterator[tuple[str, list[Callable[..., Any]]]]:
    """Those of a class of which an object can be made."""
    if issubclass(kind, BaseException):
        return
    own = [(name, one) for name, one in sorted(vars(kind).items())
           if not name.startswith("_") or name in ("__len__", "__iter__", "__call__")]  # fmt: skip
    objects: list[Any] | None = None
    for name, one in own:
        if isinstance(one, classmethod | staticmethod):
            yield f"{place}.{name}", [getattr(kind, name)]
        elif inspect.isfunction(one) or isinstance(one, property) or hasattr(one, "func"):
            objects = made(kind) if objects is None else objects
            is_call = inspect.isfunction(one)
            yield f"{place}.{name}", [bound(each, name, is_call=is_call) for each in objects]


def bound(one: Any, name: str, *, is_call: bool) -> Callable[..., Any]:
    """A method, or the value of a property, of a copy of an object."""

    def call(*words: Any, **named: Any) -> Any:
        own = copy.deepcopy(one)
        found = getattr(own, name)
        return (found(*words, **named), own) if is_call else found

    if is_call:
        method = getattr(one, name)
        call.__wrapped__ = getattr(method, "__func__", method)  # type: ignore[attr-defined]
        call.__signature__ = inspect.signature(method)  # type: ignore[attr-defined]
    else:
        call.__signature__ = inspect.Signature()  # type: ignore[attr-defined]
    return call


def outcome(call: Callable[..., Any], named: dict[str, Any]) -> tuple[str, bool]:
    """What a call gives, says and changes; and whether it is an error that is not texvent's."""
    said, before = io.StringIO(), dict(os.environ)
    is_fault, found = False, ""
    try:
        own = copy.deepcopy(named)
        with contextlib.redirect_stdout(said):
            found = written(call(**own))
        changed = [name for name in own if written(own[name]) != written(named[name])]
        found += "".join(f" {name}={written(own[name])}" for name in changed)
    except TooLong:
        raise
    except BaseException as error:  # noqa: BLE001, also SystemExit
        is_fault = not is_own(error)
        found = type(error).__name__ + ("" if is_fault else f": {error}")
    finally:
        if dict(os.environ) != before:
            os.environ.clear()
            os.environ.update(before)
        found += clean()
    found = re.sub("install it with: .*", "", found + said.getvalue())
    return re.sub(
        "|".join(map(re.escape, (os.getcwd(), str(Path.cwd().parent), *PLACES))), "", found
    ), is_fault


def states(folder: Path) -> dict[str, tuple[int, int]]:
    """Sizes of the files of a folder, and times of change."""
    return {
        one.name: (one.stat().st_size, one.stat().st_mtime_ns) for one in sorted(folder.iterdir())
    }


def clean() -> str:
    """Remove what a call left behind and mend the given files; names of what it left."""
    found = ""
    for left in sorted(Path().iterdir()):
        found += f" {left.name}"
        shutil.rmtree(left, ignore_errors=True) if left.is_dir() else left.unlink()
    if not GIVEN.is_dir() or states(GIVEN) != states(KEPT):
        shutil.rmtree(GIVEN, ignore_errors=True)
        shutil.copytree(KEPT, GIVEN)
        found += " given"
    return found


def outcomes(calls: list[Callable[..., Any]]) -> Iterator[tuple[str, bool, dict[str, Any]]]:
    """Outcome of each call, whether it is a foreign error, and its arguments."""
    for call in calls:
        for named in islice(arguments(call), MOST_CALLS):
            yield *outcome(call, named), named


def marks(calls: list[Callable[..., Any]], seconds: float) -> str | None:
    """Digits of each call, none if they take long; None: no call is understood."""
    found, faults = [], 0
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        for text, is_fault, _ in outcomes(calls):
            found.append(mark(text))
            faults += is_fault
    except TooLong:
        return ""
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
    return " ".join(found) if faults < len(found) else None


def show(part: str) -> None:
    """Print calls and outcomes."""
    for name, calls in functions():
        if part in name:
            for text, _, named in outcomes(calls):
                print(f"{name} {mark(text)} {written(named)[:300]}\n    {text[:1000]}")  # noqa: T201


def read(path: Path) -> dict[str, str]:
    """Lines of a table: name of a function → its digits."""
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    return {name: digits.strip() for name, _, digits in (one.partition(":") for one in lines)}


def found_by_a_process(*words: str, seed: int = 0) -> dict[str, str]:
    """The table, found in a process of its own, in an empty folder."""
    with tempfile.TemporaryDirectory() as place:
        here, into = Path(place, "here"), Path(place, "table")
        here.mkdir()
        for name in (GIVEN.name, KEPT.name):
            give(Path(place, name))
        env = {"NUMBA_DISABLE_JIT": "1", "PYTHONHASHSEED": str(seed), "HOME": str(here / "home"),
               "COLUMNS": "80", "NO_COLOR": "1", "PYTHONWARNINGS": "ignore"}  # fmt: skip
        command = [sys.executable, "-m", "tests.functions.calls", "--into", str(into), *words]
        path = os.pathsep.join(map(os.path.abspath, filter(None, sys.path)))
        env |= {"PYTHONPATH": path, "MPLCONFIGDIR": matplotlib.get_cachedir()}
        done = subprocess.run(
            command, env={**os.environ, **env}, cwd=here, capture_output=True, text=True
        )
        assert done.returncode == 0, done.stderr[-2000:]
        return read(into)


def find(*, is_new: bool) -> dict[str, str]:
    """Outcomes of all functions, without the digits of those that have none."""
    left_out = () if is_new else {name for name, digits in read(TABLE).items() if not digits}
    if is_new:
        os.sched_setaffinity(0, [min(os.sched_getaffinity(0))])
    lines = {}
    for name, calls in sorted(functions(), key=lambda one: one[0], reverse=is_new):
        found = "" if name in left_out else marks(calls, SLOW_S if is_new else PATIENCE_S)
        if found is not None:
            lines[name] = found
    return lines


def write() -> None:
    """Write the table anew; what three runs, one of them backwards, do not share has no digits."""
    found = found_by_a_process("--new", seed=1)
    for _ in range(2):
        save(found)
        again = found_by_a_process()
        found = {name: one if again.get(name) == one else "" for name, one in found.items()}
    save(found)


def save(lines: dict[str, str]) -> None:
    """Write the table."""
    TABLE.write_text(as_text(lines), encoding="utf-8")


def as_text(lines: dict[str, str]) -> str:
    """Lines of a table."""
    return "".join(f"{name}: {one}".rstrip() + "\n" for name, one in sorted(lines.items()))


def _stop(*_: Any) -> None:
    raise TooLong


if __name__ == "__main__":
    words = sys.argv[1:]
    if words[:1] != ["--into"]:
        show(words[0]) if words else write()
    else:
        sys.modules.update(dict.fromkeys(OPTIONAL))
        sys.setrecursionlimit(600)
        signal.signal(signal.SIGALRM, _stop)
        np.seterr(all="ignore")
        with Path(words[1]).open("w", encoding="utf-8") as into:
            sys.addaudithook(watch)
            into.write(as_text(find(is_new="--new" in words)))
