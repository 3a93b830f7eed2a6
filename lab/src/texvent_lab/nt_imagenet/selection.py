"""Streams of N-ImageNet that belong to NT-ImageNet.

Paper, 9.7 and Table 10: 100 classes, 50 streams per class of the validation set, 3k to 170k events
per stream. Which 100 classes is not said; here the first 100 in order of their WordNet ids, as in
N-ImageNet's own "mini" set.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from io import StringIO
from pathlib import Path

import numpy as np

from texvent.errors import InputError, TexventError
from texvent.events import EventStream
from texvent.frames import MICROSECONDS
from texvent.io.arrays.npz import load_stream

CLASSES, PER_CLASS = 100, 50
FEWEST_EVENTS, MOST_EVENTS = 3_000, 170_000
VALIDATION = "extracted_val"
STREAM_EXTENSION = ".npz"
_WNID = re.compile(r"n\d{8}")


@dataclass(frozen=True, kw_only=True)
class Stream:
    """A recorded stream."""

    id: str
    """Name of its file and of the image that was shown, such as "ILSVRC2012_val_00000293"."""
    wnid: str
    """WordNet id of its class, such as "n01440764"."""
    path: Path
    events: int
    duration_us: int
    speed_px_s: float = math.nan
    """See `median_speed`."""


@dataclass(frozen=True, kw_only=True)
class Selection:
    """Streams chosen, and those that were not."""

    streams: tuple[Stream, ...]
    """In order of class and id."""
    classes: tuple[str, ...]
    too_few: tuple[str, ...] = ()
    """Ids of streams with too few events."""
    too_many: tuple[str, ...] = ()
    """Ids of streams with too many."""
    unreadable: Mapping[str, str]
    """Id → why its file cannot be read."""

    def incomplete(self, per_class: int) -> dict[str, int]:
        """Classes that hold fewer streams than they should, and how many."""
        counts = dict.fromkeys(self.classes, 0)
        for stream in self.streams:
            counts[stream.wnid] += 1
        return {wnid: count for wnid, count in counts.items() if count < per_class}


def select_streams(
    folder: Path,
    classes: Sequence[str],
    *,
    per_class: int = PER_CLASS,
    progress: Callable[[int, int], None] = lambda done, total: None,
) -> Selection:
    """The first streams of each class, in order of their ids, whose number of events is in range.

    Every file that is looked at is read, so damaged ones are found here.

    Args:
        folder: see `validation_folder`.
        classes: WordNet ids.
        per_class: streams of each class.
        progress: told of classes done and in all.

    Raises:
        InputError: a class has no folder, or nothing was found.
    """
    root = validation_folder(folder)
    chosen: list[Stream] = []
    too_few, too_many, unreadable = list[str](), list[str](), dict[str, str]()
    for done, wnid in enumerate(classes):
        progress(done, len(classes))
        if not (root / wnid).is_dir():
            raise InputError(f"{root} has no class {wnid}; give the classes it has with --classes")
        count = 0
        for path in sorted((root / wnid).glob(f"*{STREAM_EXTENSION}")):
            if count == per_class:
                break
            try:
                stream = _read(path, wnid)
            except TexventError as error:
                unreadable[path.stem] = str(error)
                continue
            if stream.events < FEWEST_EVENTS:
                too_few.append(stream.id)
            elif stream.events > MOST_EVENTS:
                too_many.append(stream.id)
            else:
                chosen.append(stream)
                count += 1
    if not chosen:
        raise InputError(
            f"no stream in {root} has {FEWEST_EVENTS:,} to {MOST_EVENTS:,} events: {len(too_few)} "
            f"have fewer, {len(too_many)} more, {len(unreadable)} cannot be read"
        )
    return Selection(
        streams=tuple(chosen),
        classes=tuple(classes),
        too_few=tuple(too_few),
        too_many=tuple(too_many),
        unreadable=unreadable,
    )


def validation_folder(folder: Path) -> Path:
    """The folder with a folder per class: `extracted_val` in N-ImageNet's, or the one given.

    Raises:
        InputError: it holds no class.
    """
    inside = folder / VALIDATION
    root = inside if inside.is_dir() else folder
    if not root.is_dir():
        raise InputError(f"there is no folder {root}")
    if not any(_WNID.fullmatch(one.name) for one in root.iterdir()):
        raise InputError(
            f"{root} holds no class (n01440764 ...); give N-ImageNet's folder, which holds "
            f"{VALIDATION}, or that one"
        )
    return root


def choose_classes(folder: Path, count: int = CLASSES, file: Path | None = None) -> tuple[str, ...]:
    """The classes to take: those of a file, or the first in order of their ids.

    Args:
        folder: see `validation_folder`.
        count: how many, without a file.
        file: text with one WordNet id per line; what follows it is not read.

    Raises:
        InputError: the file cannot be read or holds something else; too few classes.
    """
    if file is not None:
        try:
            lines = [line.split() for line in StringIO(file.read_text(encoding="utf-8"))]
        except (OSError, UnicodeDecodeError) as error:
            raise InputError(f"cannot read {file}: {error}") from error
        wnids = [words[0] for words in lines if words]
        wrong = [wnid for wnid in wnids if not _WNID.fullmatch(wnid)]
        if wrong or not wnids or len(set(wnids)) < len(wnids):
            what = f"has {wrong[0][:40]!r}" if wrong else "is empty or names a class twice"
            raise InputError(f"{file} {what}; give one WordNet id per line, such as n01440764")
        return tuple(wnids)
    root = validation_folder(folder)
    found = sorted(one.name for one in root.iterdir() if _WNID.fullmatch(one.name))
    if len(found) < count:
        raise InputError(
            f"{root} has {len(found)} classes, fewer than {count}; name another number with "
            "--class-count"
        )
    return tuple(found[:count])


def median_speed(events: EventStream) -> float:
    """Median speed of edges, px/s, by the slope of the surface of last times of each polarity.

    Source: R. Benosman et al., "Event-based visual flow" (TNNLS 2014).
    Deviation: differences of both neighbours instead of a fitted plane.

    Returns:
        NaN where no pixel has four neighbours with events.
    """
    slopes = []
    for polarity in (0, 1):
        which, last = events.p == polarity, np.full(events.size.shape, np.nan)
        last[events.y[which], events.x[which]] = events.t[which]
        along = (last[1:-1, 2:] - last[1:-1, :-2], last[2:, 1:-1] - last[:-2, 1:-1])
        slopes.append(np.hypot(*along).ravel() / 2)
    found = np.concatenate(slopes)
    found = found[found > 0]
    return float(MICROSECONDS / np.median(found)) if len(found) else math.nan


def _read(path: Path, wnid: str) -> Stream:
    events = load_stream(path)
    duration = int(events.t[-1] - events.t[0]) if len(events) else 0
    return Stream(
        id=path.stem,
        wnid=wnid,
        path=path,
        events=len(events),
        duration_us=duration,
        speed_px_s=median_speed(events),
    )
