"""The process that reads damaged inputs, one after another: lines of JSON in, lines of JSON out.

A word on standard input is a reader and a number; the answer is what became of it. Whatever the
libraries print goes nowhere. The parent ends the process when a reader hangs or fills the memory.
"""

from __future__ import annotations

import json
import os
import random
import resource
import shutil
import sys
import tempfile
import time
import traceback
import warnings
from pathlib import Path
from typing import IO, Any

from texvent.errors import MissingDependencyError, TexventError

from .array_damage import CODE_RAN
from .damage import damage_input
from .outcomes import LONGEST_ERROR, MAX_GROWTH_BYTES, MAX_SECONDS
from .reader import Reader
from .readers import readers

ADDRESS_SPACE_MARGIN = 3 * 2**30
"""What a reader may reserve beyond what the process holds; more is MemoryError."""


def main() -> None:
    """Answer until standard input ends."""
    answers = os.fdopen(os.dup(1), "w")
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    warnings.simplefilter("error")
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        session = Session(Path(folder), answers)
        for line in sys.stdin:
            try:
                session.answer(*json.loads(line))
            except Exception:  # noqa: BLE001  # ends the run: the fuzzer itself is wrong
                session.tell({"broken": traceback.format_exc(limit=-6)})
        os.chdir("/")


class Session:
    """Sound inputs made once, and a place for their damaged copies."""

    def __init__(self, folder: Path, answers: IO[str]) -> None:
        self._folder = folder
        self._answers = answers
        self._sound: dict[str, tuple[Path, Path]] = {}
        self._digests: dict[str, Any] = {}

    def answer(self, name: str, number: int, finding: str | None) -> None:
        """Damage an input in the way of that number, or take a kept one, and read it."""
        reader = readers()[name]
        self.tell({"state": "preparing"})
        try:
            self._prepare(reader)
        except MissingDependencyError as error:
            self.tell({"outcome": "not run", "detail": str(error).split(";")[0]})
            return
        place, relative = self._sound[name]
        copy = self._folder / "damaged"
        shutil.rmtree(copy, ignore_errors=True)
        shutil.copytree(place, copy)
        if finding is None:
            kind = damage_input(random.Random(f"{name} {number}"), copy)
        else:
            shutil.copy(finding, copy / relative)
            kind = f"finding {Path(finding).name}"
        _allow_memory(ADDRESS_SPACE_MARGIN)
        self.tell({"state": "reading", "damage": kind})
        result = self._read(reader, copy / relative)
        _allow_memory(None)
        if (self._folder / CODE_RAN).exists():
            result = {"outcome": "code ran", "detail": kind}
            (self._folder / CODE_RAN).rmdir()
        self.tell({**result, "damage": kind})

    def _prepare(self, reader: Reader) -> None:
        """Read the sound input once, so that what loads and compiles does so untimed."""
        if reader.name in self._sound:
            return
        place = Path(tempfile.mkdtemp(dir=self._folder))
        path = reader.make(place)
        self._digests[reader.name] = reader.read(path)
        self._sound[reader.name] = place, path.relative_to(place)

    def _read(self, reader: Reader, path: Path) -> dict[str, Any]:
        before = _memory("VmRSS")
        Path("/proc/self/clear_refs").write_text("5")
        start = time.monotonic()
        result = outcome_of(reader, path, self._digests[reader.name])
        seconds = time.monotonic() - start
        growth = _memory("VmHWM") - before
        if seconds > MAX_SECONDS:
            result = {"outcome": "hang", "detail": f"{seconds:.1f} s, then {result}"}
        if growth > MAX_GROWTH_BYTES:
            result = {"outcome": "blow-up", "detail": f"{growth >> 20} MiB, then {result}"}
        return result

    def tell(self, facts: dict[str, Any]) -> None:
        """Answer the parent."""
        self._answers.write(json.dumps(facts) + "\n")
        self._answers.flush()


def outcome_of(reader: Reader, path: Path, sound: Any) -> dict[str, Any]:
    """What became of an input, and the error in words."""
    try:
        found = reader.read(path)
    except TexventError as error:
        message = str(error)
        bare = message.replace(f"{path}", "").replace(f"{path.parent}", "")
        if "\n" in message:
            return {"outcome": "several lines", "detail": message}
        if len(bare) >= LONGEST_ERROR:
            return {"outcome": "too long", "detail": f"{len(bare)}: {bare[:700]}"}
        return {"outcome": "refused", "detail": bare}
    except MemoryError:
        return {"outcome": "blow-up", "detail": traceback.format_exc(limit=-4)}
    except Exception:  # noqa: BLE001  # any other error is what is looked for
        return {"outcome": "traceback", "detail": traceback.format_exc(limit=-4)}
    return {"outcome": "same" if found == sound else "changed", "detail": ""}


def _memory(field: str) -> int:
    """A field of the process's status, bytes."""
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith(field):
            return int(line.split()[1]) * 1024
    raise AssertionError(field)


def _allow_memory(margin: int | None) -> None:
    hard = resource.getrlimit(resource.RLIMIT_AS)[1]
    limit = hard if margin is None else _memory("VmSize") + margin
    resource.setrlimit(resource.RLIMIT_AS, (limit, hard))


if __name__ == "__main__":
    main()
