"""Events that other programs made of the same frames, as rows of the benchmarks."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import ClassVar

from texvent.errors import ConfigError, InputError, few, shown
from texvent.event_packets import EventPackets
from texvent.io.files import is_event_path, open_events
from texvent.run.rate_search import ThresholdMatch
from texvent.sensor import SensorSize
from texvent_lab.bench.fidelity.entries import Entry
from texvent_lab.bench.kept_results import digest_of, digest_of_file

TOLERANCE_US = 1_000
"""Jitter of event times that is no other clock; what lies outside the frames is not scored."""
CROWDED, SHORTEST = 10, 1 / 500
"""Events of a file that never lie in so small a share of its frames, where times are in µs."""


def named_folders(texts: Iterable[str], known: Sequence[str] = ()) -> dict[str, Path]:
    """Row → folder of its events.

    Args:
        texts: NAME=FOLDER each.
        known: rows whose names are taken in any case.

    Raises:
        ConfigError: a text is not NAME=FOLDER, there is no such folder, or a row is named twice.
    """
    folders: dict[str, Path] = {}
    spelled = {one.lower(): one for one in known}
    for text in texts:
        name, _, place = text.partition("=")
        folder = Path(place).expanduser()
        if not (name and place and folder.is_dir()):
            allowed = "it must be NAME=FOLDER, a folder that exists"
            raise ConfigError(f"events is {shown(text)}; {allowed}")
        row = spelled.get(name.lower(), name)
        if row in folders:
            raise ConfigError(f"events names {row} twice; give each row one folder")
        folders[row] = folder
    return folders


@dataclass(frozen=True, kw_only=True)
class FileEntry(Entry):
    """A row whose events another program made of the recordings; nothing is simulated for it."""

    simulator: str = "texvent"
    interpolate: str = "none"
    program: str
    default_threshold: ClassVar[None] = None
    files: Mapping[float | None, Mapping[str, Path]]
    """Contrast threshold, or None alone where the program had one setting → recording → event file,
    on the clock of its frames."""

    @classmethod
    def find(cls, name: str, folder: Path, recordings: Sequence[str]) -> FileEntry:
        """The row of a folder with an event file per recording, named as it.

        Sub-folders named by numbers are runs at these thresholds, one of which is then fitted.

        Raises:
            InputError: a recording has no file there, or several; files lie beside thresholds, or
                two folders are of one threshold.
        """
        inside = sorted(folder.iterdir())
        runs: dict[float | None, Path] = {}
        for one in inside:
            threshold = _threshold_of(one.name) if one.is_dir() else None
            if threshold in runs:
                raise InputError(f"{runs[threshold]} and {one} are of one threshold; keep one")
            if threshold is not None:
                runs[threshold] = one
        if runs and any(is_event_path(one) for one in inside if one not in runs.values()):
            raise InputError(
                f"{folder} holds event files beside folders of thresholds "
                f"({next(iter(runs.values())).name} ...); it must hold the ones or the others"
            )
        places = runs or {None: folder}
        files = {one: _files_of(place, recordings) for one, place in places.items()}
        return cls(program=name, files=files)

    @property
    def name(self) -> str:
        """The program's."""
        return self.program

    @cached_property
    def digest(self) -> str:
        """Name of the content of all files."""
        every = [(one, *pair) for one, files in self.files.items() for pair in files.items()]
        return digest_of([(one, name, digest_of_file(path)) for one, name, path in every])

    def fit(
        self, count_events: Callable[[float | None], int], target: int
    ) -> tuple[ThresholdMatch | None, float]:
        """The run whose number of events comes closest; see `Entry.fit`."""
        thresholds = [one for one in self.files if one is not None]
        if not thresholds:
            return super().fit(count_events, target)
        counts = {one: count_events(one) for one in thresholds}
        best = min(thresholds, key=lambda one: abs(counts[one] - target))
        ratio = counts[best] / target if target else math.nan
        return ThresholdMatch(best, ratio, len(counts)), math.nan

    def check(
        self, size: SensorSize, spans_us: Mapping[str, tuple[int, int]], *, is_part: bool = False
    ) -> None:
        """Read all files, which may hold nothing but events of their frames.

        Args:
            size: of the frames.
            spans_us: recording → time of its first frame, and of its last.
            is_part: whether there are other frames, so that some events suffice inside a span.

        Raises:
            InputError, FileFormatError: a file is damaged, of another size or another clock, or
                all end in the first half of their frames, or a single one in the first tenth.
        """
        ends = [
            (_check_file(files[one], one, size, span_us, is_part=is_part), files[one], span_us[1])
            for files in self.files.values()
            for one, span_us in spans_us.items()
        ]
        share, path, last_us = max(ends, key=lambda one: one[0])
        least = 0.5 if len(spans_us) > 1 else 0.1  # one scene alone may be still from then on
        if 0 <= share < least:
            raise InputError(
                f"{path} has no event after {least:.0%} of its frames, which end at {last_us} µs, "
                f"and no other file of {self.program} has; events must be of all frames"
            )

    def packets(
        self,
        recording: str,
        size: SensorSize,
        span_us: tuple[int, int],
        threshold: float | None = None,
    ) -> EventPackets:
        """The events of a recording in a span of time.

        Raises:
            InputError: they have another size, or thresholds wait for a fit.
        """
        if threshold not in self.files:
            raise InputError(
                f"{self.program} has runs at several thresholds, and none is fitted here; give the "
                "folder of one of them"
            )
        return open_events(self.files[threshold][recording], size=size).cut(*span_us)


def _check_file(
    path: Path, recording: str, size: SensorSize, span_us: tuple[int, int], *, is_part: bool
) -> float:
    """See `FileEntry.check`; the share of the frames after which the last event is, or -1."""
    first_us, last_us = span_us
    count = inside = 0
    share = -1.0
    for packet in open_events(path, size=size):
        used = packet.cut(first_us - TOLERANCE_US, last_us + TOLERANCE_US + 1)
        count += len(packet)
        inside += len(used)
        if len(used):
            share = max(0.0, (int(used.t[-1]) - first_us) / (last_us - first_us))
        if inside < count and not is_part:
            t_us = packet.t[0] if packet.t[0] < first_us - TOLERANCE_US else packet.t[-1]
            raise InputError(
                f"{path} has an event at {t_us} µs; the frames of {recording} are from {first_us} "
                f"to {last_us} µs, and events must be on their clock"
            )
    if count and not inside:
        raise InputError(
            f"{path} has no event from {first_us} to {last_us} µs; times must be on the clock of "
            f"the frames of {recording}"
        )
    if inside >= CROWDED and share < SHORTEST:
        raise InputError(
            f"{path} has all its events within {share * (last_us - first_us):.0f} µs; the frames "
            f"of {recording} are from {first_us} to {last_us} µs, and its times must be µs too"
        )
    return share


def _threshold_of(name: str) -> float | None:
    try:
        number = float(name)
    except ValueError:
        return None
    return number if 0 < number < math.inf else None


def _files_of(folder: Path, recordings: Sequence[str]) -> dict[str, Path]:
    events = [one for one in sorted(folder.iterdir()) if is_event_path(one)]
    found = {
        recording: [one for one in events if f"{one.name}.".startswith(f"{recording}.")]
        for recording in recordings
    }
    wrong = [recording for recording, files in found.items() if len(files) != 1]
    if wrong:
        raise InputError(
            f"{folder} has not one event file each of {few(wrong, 4)}; it needs one per "
            f"recording, named as it, such as {wrong[0]}.h5"
        )
    return {one: files[0] for one, files in found.items()}
