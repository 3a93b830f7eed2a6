"""Perturbations move events as their names say: each way as often, and no more than they may."""

import numpy as np
import pytest

from texvent import EventStream, SensorSize
from texvent_lab.bench.perturbations import PERTURBATIONS

COUNT, SIDE = 4_000, 101
CHANCE = np.random.default_rng(4)
PLACES = CHANCE.permutation(SIDE * SIDE)[:COUNT]
EVENTS = EventStream.from_columns(
    PLACES % SIDE, PLACES // SIDE, 50_000 + np.sort(CHANCE.permutation(900_000)[:COUNT]),
    CHANCE.integers(0, 2, COUNT), size=SensorSize(SIDE, SIDE),
)  # fmt: skip
"""One event in each of some pixels, each at its own time."""


def by_pixel(events, column):
    """[SIDE, SIDE] the value of a column where an event is."""
    found = np.full((SIDE, SIDE), -1, np.int64)
    found[events.y, events.x] = getattr(events, column)
    return found[EVENTS.y, EVENTS.x]


@pytest.mark.parametrize("axis", ["x", "y"])
def test_jitter_goes_each_way_as_often(axis):
    moved = PERTURBATIONS["jitter 1 px"](EVENTS, np.random.default_rng(0))
    assert moved.t.tolist() == EVENTS.t.tolist()
    before, after = (getattr(one, axis).astype(int) for one in (EVENTS, moved))
    inner = (before > 0) & (before < SIDE - 1)
    steps, counts = np.unique((after - before)[inner], return_counts=True)
    assert steps.tolist() == [-1, 0, 1]
    assert counts == pytest.approx(inner.sum() / 3, rel=0.1)
    for edge, way in ((0, 1), (SIDE - 1, -1)):
        assert {*(after - before)[before == edge].tolist()} == {0, way}


@pytest.mark.parametrize("name", [one for one in PERTURBATIONS if one.endswith(" ms")])
def test_times_move_by_what_the_name_says(name):
    kind, figure, _ = name.split()
    moved = PERTURBATIONS[name](EVENTS, np.random.default_rng(0))
    steps = by_pixel(moved, "t") - EVENTS.t
    if kind == "shift":
        shift = int(1000 * float(figure))  # of those that do not leave the recording
        assert set(steps[EVENTS.t + shift <= EVENTS.t[-1]].tolist()) == {shift}
    else:
        assert steps.std() == pytest.approx(1000 * float(figure), rel=0.1)
        assert abs(steps.mean()) < 100 * float(figure)


@pytest.mark.parametrize("name", [one for one in PERTURBATIONS if one.endswith(" %")])
def test_shares_are_those_of_the_name(name):
    kind, share, _ = name.split()
    moved = PERTURBATIONS[name](EVENTS, np.random.default_rng(0))
    part = COUNT * int(share) / 100
    spread = 5.0 * np.sqrt(COUNT)
    if kind in ("drop", "noise"):
        expected = COUNT - part if kind == "drop" else COUNT + part
        assert len(moved) == pytest.approx(expected, abs=spread)
    elif kind == "flip":
        flipped = np.count_nonzero(by_pixel(moved, "p") != EVENTS.p)
        assert flipped == pytest.approx(part, abs=spread if int(share) < 100 else 0)
