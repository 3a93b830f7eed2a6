"""Shards and their records."""

from __future__ import annotations

import functools
import io
import json
import os
import re
import tarfile
import types
import typing
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, BinaryIO

from texvent.errors import FileFormatError, one_line, shown
from texvent.io.atomic import atomic_file
from texvent.prompt_report import PromptReport
from texvent.truth.boxes import SIZE_CLASSES

MADE, FILTERED, FAILED = "made", "filtered", "failed"
LAYOUT = 1


@dataclass(frozen=True, kw_only=True)
class SampleRecord:
    """Result of one sample."""

    key: str
    clip: str
    """Key of its video; all variants of it share this."""
    status: str
    """made, filtered (left out by the filters) or failed."""
    seed: int
    """Seed of its simulation; of its video in a shard of videos."""
    prompt: str | None = None
    label: str | None = None
    is_scene: bool = False
    """Whether it shows a scene file, of which others may have the same prompt."""
    reason: str | None = None
    """Reason for filtering or failure."""
    warnings: tuple[str, ...] = ()
    """Warnings, such as words that are not understood."""
    prompt_report: Mapping[str, Any] | None = None
    """A `PromptReport` as JSON; None where it is not known."""
    events: int = 0
    """Number of stored events."""
    signal_events: int = 0
    """Events of the video without noise; also known of a sample that the filters leave out."""
    duration_us: int = 0
    start_us: int = 0
    """Time of the first frame: 0, but for clips cut from a longer video."""
    width: int = 0
    height: int = 0
    boxes: Mapping[str, Sequence[int]] | None = None
    """Class → its boxes of each of `truth.boxes.SIZE_CLASSES`; None: boxes are not stored."""
    tracks: int = 0
    """Objects that have boxes."""
    unboxed: tuple[str, ...] = ()
    """Names of objects of the scene that have none, because `classes` leaves them out."""
    members: Mapping[str, tuple[int, int]] = field(default_factory=dict)
    """Extension → position of its content in the shard, and bytes."""


@dataclass(frozen=True, kw_only=True)
class ShardRecord:
    """A complete shard."""

    name: str
    """Such as "train-000012"."""
    split: str
    variant: str
    """"videos" for shards of videos."""
    identity: str
    """Identity of its data set; see `Recipe.identity`."""
    sha256: str
    bytes: int
    samples: tuple[SampleRecord, ...]
    seconds: float
    """Working time, s."""
    inputs: Mapping[str, Any] = field(default_factory=dict)
    """Path of a video, its labels, or another file that the samples depend on → its state; see
    `settings.provenance.describe_state`."""
    versions: Mapping[str, str] = field(default_factory=dict)
    """Package → version, of the process that made it."""
    layout: int = LAYOUT

    def count(self, status: str) -> int:
        """Number of its samples with a status."""
        return self.statuses[status]

    @property
    def statuses(self) -> Counter[str]:
        """Status → number of its samples."""
        return Counter(sample.status for sample in self.samples)

    @property
    def events(self) -> int:
        """Events of all its samples."""
        return sum(sample.events for sample in self.samples)


def record_path(shard: Path) -> Path:
    """Path of the record of a shard."""
    return shard.with_suffix(".json")


def write_record(shard: Path, record: ShardRecord) -> None:
    """Write the record of a shard, which makes it complete."""
    tables = asdict(record)
    for sample in tables["samples"]:
        for name in ("is_scene", "boxes", "tracks", "unboxed"):  # which older versions lack
            if sample[name] in (False, None, ()):
                del sample[name]
    text = json.dumps(tables, ensure_ascii=False, separators=(",", ":"))
    with atomic_file(record_path(shard), overwrite=True) as part:
        part.write_text(text + "\n", encoding="utf-8")


def read_record(shard: Path) -> ShardRecord | None:
    """The record of a shard, or None if it has none.

    Raises:
        FileFormatError: it is damaged.
    """
    path = record_path(shard)
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        return None
    except UnicodeDecodeError as error:
        raise FileFormatError(f"{path} is damaged ({one_line(error)}); {REMEDY}") from error
    try:
        return _record(read_json(text))
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
        raise FileFormatError(f"{path} is damaged ({one_line(error)}); {REMEDY}") from error


def read_json(content: str | bytes) -> Any:
    """Values of a JSON text, of which every text can be written.

    Raises:
        ValueError, RecursionError: it is none, or holds half of a character.
    """
    text = content if isinstance(content, str) else content.decode()
    value = json.loads(text)
    if "\\ud" in text.lower():
        json.dumps(value, ensure_ascii=False).encode()
    return value


REMEDY = "delete it, and texvent dataset make makes its shard again"
NAME = re.compile(r"[\w-]{1,200}")
"""Splits, variants and keys, which name files."""


def _record(tables: Mapping[str, Any]) -> ShardRecord:
    """A record, each value of its type: a data set may come from anybody."""
    known = {name: one for name, one in tables.items() if name in _kinds(ShardRecord)}
    samples = tuple(_sample(one) for one in tables["samples"])
    _check_kinds(ShardRecord, known, names=("name", "split", "variant"))
    if known["name"].rpartition("-")[0] != known["split"]:
        raise ValueError(f"{shown(known['name'])} is no shard of split {shown(known['split'])}")
    if not all(isinstance(one, str) for one in known.get("versions", {}).values()):
        raise ValueError("versions are texts")
    return ShardRecord(**{**known, "samples": samples})


def _sample(tables: Mapping[str, Any]) -> SampleRecord:
    _check_kinds(SampleRecord, tables, names=("key", "clip", "status"))
    members = {name: (begin, size) for name, (begin, size) in tables["members"].items()}
    boxes, warnings = tables.get("boxes") or {}, tuple(tables.get("warnings", ()))
    if any(len(sizes) != len(SIZE_CLASSES) for sizes in boxes.values()):
        raise ValueError(f"boxes have {len(SIZE_CLASSES)} sizes")
    counts = [one for some in (*members.values(), *boxes.values()) for one in some]
    if not all(type(one) is int and 0 <= one < 2**63 for one in counts):
        raise ValueError("a place or count is no whole number")
    unboxed = tuple(tables.get("unboxed", ()))
    if not all(isinstance(one, str) for one in (*warnings, *unboxed)):
        raise ValueError("warnings and names of objects are texts")
    if tables.get("prompt_report") is not None:
        PromptReport.from_json(tables["prompt_report"])
    own = {"members": members, "warnings": warnings, "unboxed": unboxed}
    return SampleRecord(**{**tables, **own})


def _check_kinds(record: type, tables: Mapping[str, Any], names: Sequence[str]) -> None:
    """Refuse values of other types than a record's fields, and `names` that are none.

    Raises:
        ValueError, KeyError: see above; or a field is unknown.
    """
    kinds = _kinds(record)
    for name, value in tables.items():
        if type(value) not in kinds[name] or (type(value) is int and not -(2**63) <= value < 2**63):
            raise ValueError(f"{name} is {shown(value)}")
    for name in names:
        if not NAME.fullmatch(tables[name]):
            raise ValueError(f"{name} is {shown(tables[name])}")


@functools.cache
def _kinds(record: type) -> dict[str, set[type]]:
    """Field → types that its value may have in JSON."""
    of_json: dict[Any, set[type]] = {tuple: {list}, Mapping: {dict}, float: {int, float}}
    kinds: dict[str, set[type]] = {}
    for name, hint in typing.get_type_hints(record).items():
        parts = typing.get_args(hint) if type(hint) is types.UnionType else (hint,)
        origins = [typing.get_origin(one) or one for one in parts]
        kinds[name] = {kind for one in origins for kind in of_json.get(one, {one})}
    return kinds


EXTENSION = ".tar"
MODE = 0o444


class TarShardWriter:
    """Adds samples to a tar."""

    def __init__(self, file: BinaryIO) -> None:
        self._tar = tarfile.TarFile(fileobj=file, mode="w", format=tarfile.USTAR_FORMAT)

    def add(self, key: str, members: Mapping[str, bytes]) -> dict[str, tuple[int, int]]:
        """Write the members of a sample.

        Args:
            key: name before the first dot.
            members: extension → content.

        Returns:
            Extension → position of the content in the file, and bytes.
        """
        places = {}
        for extension, content in members.items():
            info = tarfile.TarInfo(f"{key}.{extension}")
            info.size, info.mode = len(content), MODE
            self._tar.addfile(info, io.BytesIO(content))
            begin = self._tar.offset - size_in_tar(len(content)) + tarfile.BLOCKSIZE
            places[extension] = (begin, len(content))
        return places

    def close(self) -> None:
        """Write the end of the tar."""
        self._tar.close()


def size_in_tar(size: int) -> int:
    """Bytes that a member takes: its header, and its content in whole blocks of 512 bytes."""
    return tarfile.BLOCKSIZE * (1 - (-size // tarfile.BLOCKSIZE))


def read_part(shard: Path, begin: int, size: int) -> bytes:
    """`size` bytes of a shard from `begin` on.

    Raises:
        FileFormatError: the file is gone, or shorter than its record says.
    """
    try:
        with shard.open("rb") as file:
            is_there = begin + size <= os.fstat(file.fileno()).st_size
            file.seek(begin if is_there else 0)
            content = file.read(size if is_there else 0)
    except OSError as error:
        raise FileFormatError(f"cannot read {shard}: {one_line(error)}") from error
    if len(content) < size:
        raise FileFormatError(
            f"{shard} is shorter than its record says; run texvent dataset verify"
        )
    return content


def read_members(
    shard: Path, places: Mapping[str, tuple[int, int]], only: Sequence[str] | None = None
) -> dict[str, bytes]:
    """The members of one sample.

    Args:
        shard: the tar.
        places: as `TarShardWriter.add` returned them.
        only: extensions that are wanted; None: all.

    Raises:
        FileFormatError: as `read_part`.
    """
    return {
        extension: read_part(shard, begin, size)
        for extension, (begin, size) in places.items()
        if only is None or extension in only
    }
