"""Which entries of a table can be told apart, and which not from the best."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.metrics.event_sharpness import estimate_velocities, flow_warp_sharpness
from texvent.metrics.spike_trains import Trains, time_to_nearest
from texvent.metrics.stpp import Stpp
from texvent.metrics.summary import summarise
from texvent.metrics.uncertainty import LEAST_WINDOWS, Mean, paired_differences

ALIKE = "≈"
"""Marks a difference that cannot be told from none."""


class Behind(NamedTuple):
    """How far an entry is behind."""

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
        """How many there are."""
        return max(map(len, self.values.values()), default=0)

    @property
    def is_enough(self) -> bool:
        """Whether any entries could be told apart."""
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
        """How far an entry is behind, as plain values; None for the best and for no candidate."""
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
    """What the columns of a table with that many windows say, or why there are none.

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


CAP_US = 10_000
BIN_US = 500
BINS = 2 * CAP_US // BIN_US
"""Bins of the histogram of time errors: from −10 to +10 ms."""


@dataclass(frozen=True, kw_only=True)
class Details:
    """What lies behind one entry's score on one scene."""

    levels: list[list[float]]
    """STPP per level, mean over scoring seeds: rows 1, 2, 4, 8, 16 cells in time, columns 1 .. 32
    in space."""
    time_error: list[float]
    """Share of true events whose nearest simulated event (same pixel and polarity) is so much
    later: `BINS` bins of 0.5 ms from −10 to +10 ms, mean over seeds. What is missing from 1 has
    no partner within 10 ms."""
    sharpness: list[float]
    """Flow-warp sharpness along the known flow, per seed; NaN for scenes without one."""
    flow_error: list[float]
    """px/s between the known flow and what contrast maximisation finds in the events, per seed;
    NaN for scenes without a flow, or with too few events."""


def describe(
    predicted: Sequence[EventStream],
    references: Sequence[EventStream],
    velocity_px_s: tuple[float, float] | None,
) -> Details:
    """Details of simulated events against the true ones.

    Args:
        predicted: one stream per scoring seed.
        references: the true streams, in the same order.
        velocity_px_s: (vx, vy) of the whole scene, px/s, or None.
    """
    pairs = list(zip(predicted, references, strict=True))
    levels = [Stpp().levels(one, other) for one, other in pairs]
    errors = [time_errors(one, other) for one, other in pairs]
    known = velocity_px_s if velocity_px_s != (0.0, 0.0) else None
    return Details(
        levels=np.mean(levels, axis=0).tolist(),
        time_error=np.mean(errors, axis=0).tolist(),
        sharpness=[flow_warp_sharpness(one, known) if known else math.nan for one in predicted],
        flow_error=[_flow_error(one, known) if known else math.nan for one in predicted],
    )


def time_errors(predicted: EventStream, reference: EventStream) -> NDArray[np.float64]:
    """Histogram of the time from each true event to the nearest simulated one.

    Returns:
        [40] float64, shares of the true events; all 0 if either stream is empty.
    """
    if not len(predicted) or not len(reference):
        return np.zeros(BINS)
    error_us = time_to_nearest(Trains.of(reference), Trains.of(predicted), cap_us=CAP_US)
    near = error_us[error_us < CAP_US]
    counts = np.bincount((near + CAP_US) // BIN_US, minlength=BINS)
    return np.asarray(counts / len(reference))


def _flow_error(events: EventStream, known: tuple[float, float]) -> float:
    found = estimate_velocities(events)
    if not found:
        return math.nan
    return float(np.mean([math.hypot(vx - known[0], vy - known[1]) for vx, vy in found]))
