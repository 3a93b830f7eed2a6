"""Folder of NT-ImageNet: captions as a list of prompts, streams, a report, a specification.

Only ids, captions, counts of events and our own events are written: ImageNet's images may not be
redistributed, and N-ImageNet's events stay under their own licence (AGPL-3.0).
"""

from __future__ import annotations

import csv
import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from io import StringIO
from pathlib import Path
from typing import Any

from texvent.errors import FileFormatError, OutputError, one_line
from texvent.io.atomic import atomic_file
from texvent.runtime.identity import derived_seed
from texvent_lab.nt_imagenet.selection import Stream

CAPTIONS, STREAMS = "captions.jsonl", "streams.csv"
REPORT, SPECIFICATION = "report.json", "specification.toml"
PAIRS, MADE = "pairs.json", "made_captions.json"
OWN = frozenset({CAPTIONS, STREAMS, REPORT, SPECIFICATION, PAIRS, MADE})


@dataclass(frozen=True, kw_only=True)
class Captioned:
    """A stream and its caption: a line of `captions.jsonl`, and a prompt of a data set."""

    id: str
    caption: str
    label: str
    """WordNet id."""
    seed: int
    """Seed of the video made from it; it is another for every id, so equal captions stay apart."""

    @classmethod
    def of(cls, stream: Stream, caption: str) -> Captioned:
        """The caption of a stream."""
        seed = derived_seed("NT-ImageNet", stream.id)
        return cls(id=stream.id, caption=caption, label=stream.wnid, seed=seed)


def prepare_folder(folder: Path) -> None:
    """Make the folder, or go on with one of this command.

    Raises:
        OutputError: it holds other files, or cannot be made.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        foreign = sorted(
            one.name for one in folder.iterdir()
            if one.name not in OWN and not one.name.startswith(".")
        )  # fmt: skip
    except OSError as error:
        raise OutputError(f"cannot make {folder}: {one_line(error)}") from error
    if foreign and not (folder / STREAMS).exists():
        raise OutputError(f"{folder} holds other files ({foreign[0]}); name another folder with -o")


def write_captions(folder: Path, captioned: Iterable[Captioned]) -> None:
    """Write the list of prompts."""
    _write(folder / CAPTIONS, "".join(_line(asdict(one)) for one in captioned))


def read_captioned(path: Path) -> list[Captioned]:
    """Captions that `write_captions` wrote.

    Raises:
        FileFormatError: it cannot be read or holds something else.
    """
    try:
        lines = StringIO(path.read_text(encoding="utf-8"))
        captioned = [Captioned(**json.loads(line)) for line in lines]
    except (OSError, ValueError, TypeError) as error:
        raise FileFormatError(
            f"{path} cannot be read as captions ({one_line(error)}); give the {CAPTIONS} of "
            "texvent nt-imagenet"
        ) from error
    if not captioned:
        raise FileFormatError(f"{path} holds no caption")
    return captioned


def write_streams(folder: Path, streams: Sequence[Stream], root: Path) -> None:
    """Write the table of streams, their paths counted from N-ImageNet's folder of classes."""
    names = ("id", "class", "events", "duration_us", "stream")
    rows = ((s.id, s.wnid, s.events, s.duration_us, s.path.relative_to(root)) for s in streams)
    with (
        atomic_file(folder / STREAMS, overwrite=True) as part,
        part.open("w", encoding="utf-8", newline="") as file,
    ):
        csv.writer(file, lineterminator="\n").writerows([names, *rows])


def write_facts(path: Path, facts: Mapping[str, Any]) -> None:
    """Write a report as JSON."""
    _write(path, json.dumps(facts, indent=1, ensure_ascii=False) + "\n")


def write_specification(folder: Path) -> bool:
    """Write a specification to make events of the captions, unless there is one already.

    Returns:
        Whether it was written.
    """
    path = folder / SPECIFICATION
    if path.exists():
        return False
    _write(path, _SPECIFICATION.format(captions=CAPTIONS))
    return True


_SPECIFICATION = """\
# Events of our own for the captions of NT-ImageNet:
#     texvent dataset plan specification.toml
#     texvent dataset make specification.toml -o events
name = "nt-imagenet"
description = "Events simulated from captions of ImageNet's validation images"
# license = "..."       # of captions and events; a set that is published needs one
samples_per_shard = 50

[splits]
test = 1.0

[[sources]]
file = "{captions}"

[options]
sensor = "640x480"      # that of N-ImageNet's recordings
# Without a generator the embedded one draws what it knows of a caption, which is little: name a
# learned one (texvent generators), such as the paper's.
# generator = "cosmos-7b"

[variants.texvent]
"""


def _write(path: Path, text: str) -> None:
    with atomic_file(path, overwrite=True) as part:
        part.write_text(text, encoding="utf-8")


def _line(table: Mapping[str, Any]) -> str:
    return json.dumps(table, ensure_ascii=False) + "\n"
