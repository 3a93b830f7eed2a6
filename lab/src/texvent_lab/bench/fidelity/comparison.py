"""Significance of differences between the entries of a table."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from texvent_lab.bench.summary import summarise
from texvent_lab.bench.uncertainty import LEAST_WINDOWS, Mean, paired_differences

ALIKE = "≈"
"""Marks a difference that cannot be told from none."""


class Behind(NamedTuple):
    """Distance of an entry from the best."""

    best: str
    """The best entry."""
    difference: Mean
    """The best one minus this one."""


@dataclass(frozen=True)
class Comparison:
    """Entries on the same windows: spans of a recording, textures, or scenes."""

    values: Mapping[str, Sequence[float]]
    """Entry → a value per window, larger ones closer."""
    tracks: Mapping[str, str]
    """Entry → what it gets; the best is sought among those that get the same. What is not here,
    such as half of a recording, is no candidate."""
    is_in_sequence: bool
    """Whether the windows follow each other in time."""

    @property
    def windows(self) -> int:
        """Number of windows."""
        return max(map(len, self.values.values()), default=0)

    @property
    def is_enough(self) -> bool:
        """Whether there are enough windows for a significant difference."""
        return self.windows >= LEAST_WINDOWS

    def mean(self, entry: str) -> float:
        """Mean of the windows where it is defined; NaN if there are none."""
        return summarise(self.values[entry]).mean

    def differences(self, baseline: str) -> dict[str, Mean]:
        """All other entries minus one."""
        return self._differences(baseline, self.values)

    def _differences(self, baseline: str, values: Mapping[str, Sequence[float]]) -> dict[str, Mean]:
        known = {name: np.asarray(one, np.float64) for name, one in values.items()}
        columns = {name: one - known[baseline] for name, one in known.items() if name != baseline}
        return paired_differences(columns, is_in_sequence=self.is_in_sequence)

    @cached_property
    def behind_best(self) -> Mapping[str, Behind]:
        """Entry → how far it is behind the best of those that get the same, which are not there."""
        found: dict[str, Behind] = {}
        for track in dict.fromkeys(self.tracks.values()):
            best = self._best(track)
            if best is None:
                continue
            values = {name: self.values[name] for name in self._candidates(track)}
            against = self._differences(best, values)
            for entry in values:
                if entry != best:
                    found[entry] = Behind(best, against[entry].reversed())
        return found

    def _candidates(self, track: str) -> list[str]:
        return [entry for entry in self.values if self.tracks.get(entry) == track]

    def _best(self, track: str) -> str | None:
        means = {entry: self.mean(entry) for entry in self._candidates(track)}
        known = {entry: mean for entry, mean in means.items() if not math.isnan(mean)}
        return max(known, key=known.__getitem__, default=None)

    def document(self, entry: str) -> dict[str, Any] | None:
        """Distance from the best as plain values; None for the best and for no candidate."""
        behind = self.behind_best.get(entry)
        if behind is None:
            return None
        verdict = {"is_significant": behind.difference.is_significant}
        return {"best": behind.best, **behind.difference.document(), **verdict}

    def behind_text(self, entry: str) -> str:
        """Cell of a table: how far an entry is behind the best; empty for what is no candidate."""
        if entry not in self.tracks:
            return ""
        behind = self.behind_best.get(entry)
        if behind is None:
            return "undefined" if math.isnan(self.mean(entry)) else "best"
        return difference_text(behind.difference)

    def mark(self, entry: str) -> str:
        """Mark for a cell: the best, like the best (≈), too few windows to tell (?), or none."""
        behind = self.behind_best.get(entry)
        if behind is None:
            is_best = entry in self.tracks and not math.isnan(self.mean(entry))
            return "(best)" if is_best and len(self.tracks) > 1 else ""
        if not behind.difference.is_enough:
            return "(?)"
        return "" if behind.difference.is_significant else f"({ALIKE})"


def difference_text(difference: Mean, *, sign: str = "") -> str:
    """A cell: difference, 95 % interval, and `≈` where it may be none.

    Args:
        difference: between two entries.
        sign: "+" shows the sign of positive numbers too.
    """
    if math.isnan(difference.mean):
        return "undefined"
    mean, low, high = (f"{one:{sign}.3f}" for one in (difference.mean, *difference.interval))
    if not difference.is_enough:
        return f"{mean} (too few)"
    return f"{mean} [{low}, {high}]{'' if difference.is_significant else f' {ALIKE}'}"


def comparison_note(windows: int, kind: str) -> str:
    """Legend of a table with that many windows.

    Args:
        windows: how many.
        kind: what they are, in the plural.
    """
    if windows < LEAST_WINDOWS:
        return (
            f"{windows} {kind} are too few to tell entries apart; {LEAST_WINDOWS} and more are "
            "needed.\n"
        )
    return (
        f"Behind the best: of the entries that get the same frames. [ ]: 95 % interval over "
        f"{windows} {kind}. {ALIKE}: no significant difference (the intervals of all that are "
        "compared with the same entry hold together). (too few): too few are defined, or "
        "independent of their neighbours.\n"
    )
