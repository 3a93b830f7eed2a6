"""Targets, and what was measured; misses are shown like hits."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

from texvent_lab.measure.speed.timing import rounded

Document = dict[str, Any]
PAPER, MULTI = "texvent", "esim"


class Target(NamedTuple):
    """A limit and how to read the figure from the document; None where it was not measured."""

    name: str
    limit: float
    at_least: bool
    read: Callable[[Document], float | None]


def _kernel(document: Document, model: str, density: float, way: str = "clip") -> Document:
    rows: Iterator[Document] = (
        row
        for row in document["kernels"]
        if (row["model"], row["size"], row["density"], row["way"])
        == (model, "1280x720", density, way)
    )
    return next(rows)


def _two_over_one(document: Document, way: str, *densities: float) -> float:
    """Least throughput of two threads over that of one."""
    return min(
        float(
            _kernel(document, PAPER, density)["ms_per_frame"]["median"]
            / _kernel(document, PAPER, density, way)["ms_per_frame"]["median"]
        )
        for density in densities
    )


def _ratio(document: Document, clip: str, ours: str) -> float | None:
    for row in document["peers"]:
        if (row["clip"], row["ours"]["name"]) == (clip, ours):
            ratio: float | None = row["ratio_to_fastest_peer"]
            return ratio
    return None


TARGETS = (
    Target(
        "720p, paper preset, 0.1 % firing: time over the floor",
        3.5,
        False,
        lambda one: float(_kernel(one, PAPER, 0.001)["times_floor"]),
    ),
    Target(
        "720p, paper preset, 20 % firing: Mevents/s",
        100.0,
        True,
        lambda one: float(_kernel(one, PAPER, 0.2)["mevents_per_s"]),
    ),
    Target(
        "720p, multi-crossing (esim), 20 % firing: Mevents/s",
        60.0,
        True,
        lambda one: float(_kernel(one, MULTI, 0.2)["mevents_per_s"]),
    ),
    Target(
        "720p, paper preset, two clips in parallel at 5 %: throughput over one",
        1.9,
        True,
        lambda one: _two_over_one(one, "clips", 0.05),
    ),
    Target(
        "heavy clip, paper preset: time of the fastest peer over ours",
        5.0,
        True,
        lambda one: _ratio(one, "heavy", "texvent, paper preset"),
    ),
    Target(
        "heavy clip, esim: time of the fastest peer over ours",
        5.0,
        True,
        lambda one: _ratio(one, "heavy", "texvent, esim"),
    ),
    Target(
        "real video at 200 fps, paper preset: time of the fastest peer over ours",
        20.0,
        True,
        lambda one: _ratio(one, "real video, 200 fps", "texvent, paper preset"),
    ),
    Target(
        "real video at 200 fps, esim: time of the fastest peer over ours",
        20.0,
        True,
        lambda one: _ratio(one, "real video, 200 fps", "texvent, esim"),
    ),
    Target(
        "heavy clip with motion compensation: eventcv's adaptive mode, as many events, over ours",
        10.0,
        True,
        lambda one: _ratio(one, "heavy", "texvent, paper preset, with flow"),
    ),
    Target(
        "heavy clip with motion compensation: eventcv as shipped (adaptive) over ours",
        10.0,
        True,
        lambda one: _ratio(one, "heavy, as shipped", "texvent, paper preset, with flow"),
    ),
    Target(
        "texvent --help, CPU seconds",
        0.3,
        False,
        lambda one: float(one["startup"]["help_cpu_s"]["median"]),
    ),
    Target(
        "two-second clip, warm cache: seconds from launch to the first events in the file",
        3.0,
        False,
        lambda one: float(one["startup"]["first_events_s"]["median"]),
    ),
)


def check_targets(document: Document) -> list[Document]:
    """A row per target: its limit, the figure, and whether it is met (None: not measured)."""
    rows = []
    for target in TARGETS:
        value = target.read(document)
        is_met = None
        if value is not None:
            is_met = value >= target.limit if target.at_least else value <= target.limit
        rows.append(
            {
                "name": target.name,
                "wanted": f"{'at least' if target.at_least else 'at most'} {target.limit:g}",
                "value": None if value is None else rounded(value),
                "is_met": is_met,
            }
        )
    return rows
