"""Commands as `--help` lists their options, and all that a run of one leaves to be seen."""

import contextlib
import functools
import hashlib
import io
import os
import re
import shlex
import shutil
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, NamedTuple
from unittest import mock

import cv2
import numpy as np
from numpy.typing import NDArray

import texvent
from texvent._version import full_version
from texvent.cli.app import main
from texvent.errors import TexventError

ROW = re.compile(r"^  (?=-)(?:-\S+(?: \S+)?, )*--(?P<name>[a-z][a-z0-9-]*)(?: (?P<value>\S+))?")
TIMES = re.compile(r"[\d.,]+ (?:s|ms|kB|MB|GB|hours)\b|[\d.,]+ per second")


_OWN_VERSION = re.compile(
    re.escape(full_version())
    if "+" in full_version()
    # Without git, generators, whose version has no commit, name the same one.
    else rf"(?<!\bversion['\"]: ['\"])(?<!\bversion&quot;: &quot;){re.escape(full_version())}"
)
_STEP = 3.0
"""Of the means of an image's blocks: processors differ in single levels."""
OPAQUE = (".mp4", ".gif", ".avi", ".h5", ".hdf5", ".tar", ".parquet", ".bag", ".mcap", ".db3")
"""Files whose bytes other programs make, or that hold the version between other bytes."""


class Listed(NamedTuple):
    """An option as a page of help lists it."""

    name: str
    section: str
    """Of the page; empty where there are none."""
    text: str
    placeholder: str
    """Empty: a flag; "{a,b}": choices."""
    default: str

    @property
    def flag(self) -> str:
        """As it is typed."""
        return f"--{self.name}"

    def other_values(self) -> list[str]:
        """Words that give a flag, or an option of listed values, each other value."""
        if not self.placeholder:
            return [self.flag]
        if self.placeholder.startswith("{"):
            values = self.placeholder.strip("{}").split(",")
            return [f"{self.flag} {one}" for one in values if one != self.default]
        return []


@functools.cache
def listed_options(command: str) -> dict[str, Listed]:
    """Option → as the whole help of a command lists it."""
    page = io.StringIO()
    with contextlib.redirect_stdout(page), contextlib.suppress(SystemExit):
        main([*shlex.split(command), "--help", "all"])
    found: dict[str, Listed] = {}
    name = section = ""
    for line in page.getvalue().splitlines():
        if heading := re.fullmatch(r"(\w+):", line):
            section, name = heading[1], ""
        if row := ROW.match(line):
            name, placeholder = row["name"], row["value"] or ""
            found[name] = Listed(name, section, "", placeholder, "")
            line = line[row.end() :]
        if name:
            text = f"{found[name].text} {line.strip()}"
            default = re.search(r"\(default: (\S*?)\)", text)
            found[name] = found[name]._replace(text=text, default=default[1] if default else "")
    return {one.name.removeprefix("no-"): one for one in found.values()}


class Outcome(NamedTuple):
    """All that a run leaves."""

    code: int
    printed: str
    """Standard output."""
    errors: str
    """Standard error."""
    streams: dict[str, texvent.EventStream]
    """By the name of the file."""
    files: dict[str, bytes]
    """All others: name → contents."""

    @property
    def said(self) -> str:
        """Standard error, without times and sizes."""
        return TIMES.sub("", self.errors)

    @property
    def events(self) -> list[Any]:
        """Contents of all event files."""
        return [
            (one.size, *(part.tobytes() for part in (one.x, one.y, one.t, one.p)),
             None if one.label is None else one.label.tobytes())
            for one in self.streams.values()
        ]  # fmt: skip

    @property
    def facts(self) -> list[str]:
        """Metadata of event files, without the options."""
        return [str({**one.metadata, "settings": None}) for one in self.streams.values()]

    @property
    def names(self) -> list[str]:
        """Names of all files."""
        return sorted([*self.streams, *self.files])

    @property
    def mark(self) -> str:
        """Digests of what was said, of events with their facts, and of other files.

        Without what differs from machine to machine and by the version; of `OPAQUE` ones, the name.
        """
        arrays = [one.tobytes() for event in self.streams.values() for one in _arrays(event)]
        said, *facts = map(_settled, (f"{self.code} {self.printed} {self.said}", *self.facts))
        files = [
            name.encode() + (b"" if name.endswith(OPAQUE) else _content(name, self.files[name]))
            for name in sorted(self.files)
        ]
        parts = ([said], [*self.streams, *arrays, *facts], files)
        return " ".join(_digest(part) for part in parts)

    def measure(self, name: str) -> float:
        """A figure of all events, of the files, or of what was said.

        Args:
            name: one of those below, or a pattern with a group that is a number.
        """
        streams = list(self.streams.values())
        count, on = sum(map(len, streams)), sum(int(one.p.sum()) for one in streams)
        figures: dict[str, Callable[[], float]] = {
            "count": lambda: count,
            "on": lambda: on,
            "off": lambda: count - on,
            "share of ON": lambda: on / count,
            "pixels": lambda: streams[0].size.width * streams[0].size.height,
            "duration": lambda: max(int(one.t[-1] - one.t[0]) for one in streams),
            "first": lambda: min(int(one.t[0]) for one in streams),
            "last": lambda: max(int(one.t[-1]) for one in streams),
            "spread": lambda: _spread(*streams),
            "bytes": lambda: sum(map(len, self.files.values())),
            "files": lambda: len(self.names),
        }
        if name in figures:
            return figures[name]()
        found = re.search(name, self.printed + self.said)
        assert found is not None, (name, self)
        return float(found[1].replace(",", ""))


def _arrays(events: texvent.EventStream) -> list[NDArray[Any]]:
    columns = [events.x, events.y, events.t, events.p]
    return columns if events.label is None else [*columns, events.label]


def _settled(text: str) -> str:
    """Without times of work, places on the disk, version, and digests that hang on these."""
    text = _OWN_VERSION.sub("VERSION", TIMES.sub("", text))
    text = re.sub(r'"(?:\w*seconds|seen)": ?[^,}\n]+', "", text)
    text = re.sub(r"\b[0-9a-f]{24,64}\b", "DIGEST", text)
    text = re.sub(r"install it with: .*", "", text)  # another line in another environment
    # The last digits of a fit hang on the width of the processor's registers, as does what is
    # left of a sum that is zero.
    text = re.sub(
        r"-?\d+\.\d{6,}(e-?\d+)?", lambda one: f"{round(float(one[0]), 9) + 0.0:.5g}", text
    )
    return re.sub(r"/\S*/(run|cache)\b", r"\1", text)


def _content(name: str, content: bytes) -> bytes:
    """Means of an image's blocks, arrays of an archive; else the bytes, settled where they are
    text."""
    if name.endswith(".png"):
        image = cv2.imdecode(np.frombuffer(content, np.uint8), cv2.IMREAD_UNCHANGED)
        means = cv2.resize(image.astype(np.float32), None, fx=0.25, fy=0.25,
                           interpolation=cv2.INTER_AREA)  # fmt: skip
        return f"{image.shape}".encode() + np.rint(means / _STEP).astype(np.uint8).tobytes()
    if name.endswith(".npz"):
        with np.load(io.BytesIO(content)) as arrays:
            return b"".join(one.encode() + _rounded(arrays[one]).tobytes() for one in arrays.files)
    if content.startswith(b"PK"):  # an archive of events with facts, under a name of its own
        return b""
    try:
        return _settled(content.decode()).encode()
    except UnicodeDecodeError:
        return content


def _rounded(values: NDArray[Any]) -> NDArray[Any]:
    """Without the last digits of floats, which hang on the width of the processor's registers."""
    return np.round(values, 2) + 0.0 if values.dtype.kind == "f" else values


def _digest(parts: Iterable[str | bytes]) -> str:
    whole = hashlib.sha256()
    for one in parts:
        whole.update((one.encode() if isinstance(one, str) else one) + b"\0")
    return whole.hexdigest()[:8]


def _spread(events: texvent.EventStream) -> float:
    """Variance of the number of events of a pixel, over their mean."""
    counts = np.zeros((events.size.height, events.size.width))
    np.add.at(counts, (events.y, events.x), 1)
    return float(counts.var() / counts.mean())


def run_once(folder: Path, words: str, *, before: str = "") -> Outcome:
    """The outcome of a command in an empty folder beside its inputs.

    Args:
        folder: holds the inputs; the command runs in `run/` below it.
        words: of the command line.
        before: words of a command that ran there before, if any.
    """
    place = folder / "run"
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir()
    width_and_downloads = {
        "COLUMNS": "100",
        **dict.fromkeys(("TEXVENT_DATA", "TEXVENT_CACHE"), str(folder / "cache")),
    }
    with contextlib.chdir(place), mock.patch.dict(os.environ, width_and_downloads):
        if before:
            _call(before)
        code, printed, errors = _call(words)
        streams: dict[str, texvent.EventStream] = {}
        files: dict[str, bytes] = {}
        for path in sorted(one for one in Path().rglob("*") if one.is_file()):
            files[str(path)] = path.read_bytes()
            if path.suffix in (".npz", ".h5"):
                with contextlib.suppress(TexventError):
                    streams[str(path)] = texvent.load(path)
                    del files[str(path)]
    return Outcome(code, printed, errors, streams, files)


def _call(words: str) -> tuple[int, str, str]:
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = main(shlex.split(words))
    return code, out.getvalue(), err.getvalue()
