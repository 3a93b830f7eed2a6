"""Every function that takes `progress` tells whole steps of known work, to the end."""

from itertools import groupby
from pathlib import Path

import numpy as np
import pytest
from tests.truth.hand_video import board_video

import texvent
from texvent.dataset.generation.make import make
from texvent.dataset.specification.reading import specification_from
from texvent.metrics.compare import compare
from texvent.run.check import check_source
from texvent.runtime.progress_option import open_progress
from texvent.view.render import render_events

FRAMES = np.random.default_rng(3).integers(0, 256, (6, 12, 16)).astype(np.uint8)
RUN = {"fps": 20, "interpolate": "blend", "fixed_count": 2}
TABLES = {
    "name": "two",
    "options": {"fps": 20, "interpolate": "none"},
    "samples_per_shard": 1,
    "sources": [{"videos": ["*.npy"]}],
}


def packets():
    return texvent.simulate(FRAMES, as_packets=True, **RUN)


def compared(progress):
    events = packets().collect()
    with open_progress(progress) as shown:
        compare(events, events, ["count_ratio", "active_iou", "stpp"], progress=shown)


def rendered(progress):
    with open_progress(progress) as shown:
        render_events(packets().collect(), "a.png", progress=shown)


def made(progress):
    for name in "ab":
        np.save(f"{name}.npy", FRAMES)
    make(specification_from(TABLES, folder=Path().absolute()), "set", progress=progress)


WORK = {
    "simulate": (lambda told: texvent.simulate(FRAMES, progress=told, **RUN), 6),
    "collect": (lambda told: packets().collect(progress=told), 6),
    "save": (lambda told: packets().save("a.h5", progress=told), 6),
    "target rate": (
        lambda told: texvent.simulate(FRAMES, progress=told, target_rate=1e4, noise="none", **RUN),
        9,
    ),
    "truth": (
        lambda told: texvent.simulate(
            board_video(), fixed_count=2, truth_folder="a.truth", progress=told
        ),
        6,
    ),
    "check": (lambda told: check_source(FRAMES, fps=20, progress=told), 6),
    "compare": (compared, 3),
    "render": (rendered, None),
    "data set": (made, 2),
}
"""Work, and the steps of its first task."""


@pytest.mark.parametrize("name", WORK)
def test_progress_rises_to_the_whole(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    calls = []
    work, steps = WORK[name]
    work(lambda *call: calls.append(call))
    assert calls
    assert calls[0][1] == steps
    for task, own in groupby(calls, key=lambda call: call[2]):
        done, totals = [one[0] for one in own], {one[1] for one in calls if one[2] == task}
        assert done == sorted(done)
        (total,) = totals
        assert done[0] >= 0
        assert total is None or name == "target rate" or total - 1 <= done[-1] <= total
