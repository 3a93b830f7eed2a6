"""Recordings cut into files: one per frame interval, or one per row of a table of labels."""

from __future__ import annotations

import csv
import itertools
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from decimal import Decimal, InvalidOperation
from pathlib import Path

from texvent.errors import FileFormatError, InputError, shown
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.frames import MICROSECONDS
from texvent.io.atomic import atomic_folder
from texvent.io.files import codec_for, extension_of, save

TIMES, LABELS = "timestamps.txt", "labels.csv"
"""Files beside the events: the times between the intervals, or what each file shows."""
MAX_BYTES = 64 * 2**20
MAX_NAME = 60
"""Characters of a folder's name: 240 bytes at most."""
NAMES = {
    "label": ("label", "class", "action", "name"),
    "start": ("start",),
    "stop": ("end", "stop"),
}
"""Column of a table of labels → beginnings of its name."""


@dataclass(frozen=True)
class Interval:
    """Part of a recording: `start_us <= t < stop_us`."""

    start_us: int
    stop_us: int
    label: str | None = None
    """Class that it shows, where a table of labels says it."""


def read_intervals(path: Path) -> list[Interval]:
    """Intervals between the times of a text, or those of a table of labels.

    Args:
        path: rows of one time, with more values after it or without; or of label, start and stop,
            as their names say, or in this order (as DVS128 Gesture's tables). Times with decimals
            are seconds, whole ones µs.

    Raises:
        InputError: no such file.
        FileFormatError: it holds no times, or they do not increase.
    """
    if not path.is_file():
        raise InputError(f"no such file: {path}; give a text of times or a table of labels")
    text = path.read_bytes()[:MAX_BYTES].decode("utf-8-sig", errors="replace")
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    delimiter = next((one for one in ",;\t" if lines and one in lines[0]), " ")
    table = csv.reader((line.strip() for line in lines), delimiter=delimiter, skipinitialspace=True)
    rows = [[word.strip() for word in row] for row in table]
    if delimiter == " ":
        rows = [[word for word in row if word] for row in rows]
    names = rows[0] if rows and not any(_is_number(word) for word in rows[0]) else None
    rows = rows[1:] if names is not None else rows
    if not rows:
        raise FileFormatError(f"{path} holds no times")
    places = _label_places(names, rows[0])
    if places is None:
        times = _times(path, [row[0] for row in rows])
        if len(times) < 2 or any(late <= early for early, late in itertools.pairwise(times)):
            raise FileFormatError(f"{path} must hold two or more times that increase")
        return [Interval(*pair) for pair in itertools.pairwise(times)]
    if min(map(len, rows)) <= max(places.values()):
        raise FileFormatError(f"{path} has a row of fewer values than its first")
    starts, stops = (
        _times(path, [row[places[name]] for row in rows]) for name in ("start", "stop")
    )
    labels = [row[places["label"]] for row in rows]
    for start_us, stop_us, label in zip(starts, stops, labels, strict=True):
        if stop_us <= start_us or not re.search(r"\w", label):
            raise FileFormatError(
                f"{path}: row {shown(label)}, {start_us}, {stop_us} µs: the stop must come after "
                "the start, and a label has a letter or a digit"
            )
    _refuse_same_folders(path, labels)
    return [Interval(*row) for row in zip(starts, stops, labels, strict=True)]


def folder_of(label: str) -> str:
    """Name of the folder of a label: its letters and digits, - and _; others become _."""
    return re.sub(r"[^\w-]", "_", label)[:MAX_NAME]


def _refuse_same_folders(path: Path, labels: Sequence[str]) -> None:
    """Refuse labels whose folders would have one name, also where case does not count.

    Raises:
        FileFormatError: there are some.
    """
    first: dict[str, str] = {}
    for label in labels:
        other = first.setdefault(folder_of(label).casefold(), label)
        if other != label:
            raise FileFormatError(
                f"{path}: the labels {shown(other)} and {shown(label)} would have one folder, "
                f"{shown(folder_of(label))}; rename one of them"
            )


def _label_places(names: Sequence[str] | None, row: Sequence[str]) -> dict[str, int] | None:
    """label, start, stop → number of the column; None: the rows are times."""
    if names is None:
        is_table = len(row) == 3 and all(map(_is_number, row[1:]))
        return {"label": 0, "start": 1, "stop": 2} if is_table else None
    lower = [name.lower() for name in names]
    found = {
        column: [at for at, name in enumerate(lower) if name.startswith(spellings)]
        for column, spellings in NAMES.items()
    }
    return {column: at[0] for column, at in found.items()} if all(found.values()) else None


def _is_number(word: str) -> bool:
    try:
        return Decimal(word).is_finite()
    except InvalidOperation:
        return False


def _times(path: Path, words: Sequence[str]) -> list[int]:
    wrong = next((word for word in words if not _is_number(word)), None)
    if wrong is not None:
        raise FileFormatError(f"{path}: {shown(wrong)} is no time")
    scale = 1 if all(re.fullmatch(r"[-+]?\d+", word) for word in words) else MICROSECONDS
    return [round(Decimal(word) * scale) for word in words]


def split(
    packets: Iterable[EventStream], intervals: Sequence[Interval]
) -> Iterator[tuple[int, list[EventStream]]]:
    """The events of each interval, with its number, in the order in which intervals end.

    Memory holds the events of the intervals that are open; they may overlap.
    """
    waiting = sorted(range(len(intervals)), key=lambda one: intervals[one].start_us)
    opened: dict[int, list[EventStream]] = {}
    for packet in packets:
        if not len(packet):
            continue
        while waiting and intervals[waiting[0]].start_us <= int(packet.t[-1]):
            opened[waiting.pop(0)] = []
        for number, parts in opened.items():
            parts.append(packet.cut(intervals[number].start_us, intervals[number].stop_us))
        ended = [one for one in opened if intervals[one].stop_us <= int(packet.t[-1])]
        for number in sorted(ended, key=lambda one: intervals[one].stop_us):
            yield number, opened.pop(number)
        if not waiting and not opened:
            return
    for number in [*opened, *waiting]:
        yield number, opened.get(number, [])


def write_split(
    events: EventPackets,
    intervals: Sequence[Interval],
    folder: Path,
    *,
    format: str = "npz",
    overwrite: bool = False,
) -> int:
    """A folder with one event file per interval; returns the number of events in them.

    Files are `000000.npz` and so on beside `timestamps.txt` (seconds), or, of a table of labels,
    `LABEL/000000.npz` beside `labels.csv`. Times stay those of the recording.

    Raises:
        OutputError: the folder exists already or cannot be written.
        ConfigError: the format is not written.
    """
    extension = extension_of(format)
    codec_for(Path(f"any{extension}"), format)
    count = 0

    def is_own(path: Path) -> bool:
        named = path.name in (TIMES, LABELS) or path.suffix in (extension, ".json")
        return named or (path.is_dir() and all(map(is_own, path.iterdir())))

    with atomic_folder(folder, overwrite=overwrite, is_own=is_own) as part:
        for number, parts in split(events, intervals):
            label = intervals[number].label
            place = part if label is None else part / folder_of(label)
            place.mkdir(exist_ok=True)
            cut = EventStream.concat([EventStream.empty(events.size), *parts])
            save(
                place / _name(number, extension), cut.with_metadata(events.metadata), format=format
            )
            count += len(cut)
        if intervals[0].label is None:
            times = [intervals[0].start_us, *(one.stop_us for one in intervals)]
            lines = [f"{Decimal(t).scaleb(-6):f}\n" for t in times]
            (part / TIMES).write_text("".join(lines), encoding="utf-8")
        else:
            with (part / LABELS).open("w", encoding="utf-8", newline="") as file:
                table = csv.writer(file)
                table.writerow(["file", "label", "start_us", "stop_us"])
                for number, one in enumerate(intervals):
                    name = f"{folder_of(one.label or '')}/{_name(number, extension)}"
                    table.writerow([name, one.label, one.start_us, one.stop_us])
        if not count and any(map(len, events)):
            last = max(one.stop_us for one in intervals)
            raise InputError(
                f"no event lies in the intervals, {min(one.start_us for one in intervals)}..{last} "
                "µs; times with a point are s, whole numbers µs (texvent info says when the "
                "recording begins and ends)"
            )
    return count


def _name(number: int, extension: str) -> str:
    return f"{number:06d}{extension}"
