"""What the benchmark of depth and flow computes by itself: ranks, sharpness, trivial predictors."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np
import pytest

from texvent.events import EventStream
from texvent.sensor import SensorSize

pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")

from texvent_lab.measure.depth_flow import (
    angle,
    main,
    rank_correlation,
    sharpness,
    spread,
)
from texvent_lab.registries import TASKS
from texvent_lab.train.run import train_from_file
from texvent_lab.train.schedule import Hardware

from ..train.sequences.windowed_specification import write_specification

pytestmark = pytest.mark.torch


def test_ranks_by_hand() -> None:
    rising = np.array([1.0, 2, 3, 4])
    assert rank_correlation(rising, rising**3) == pytest.approx(1)
    assert rank_correlation(rising, -rising) == pytest.approx(-1)
    # Ranks 1, 2.5, 2.5, 4 of the second: covariance 4.5, variances 5 and 4.5.
    found = rank_correlation(rising, np.array([0.0, 7, 7, 9]))
    assert found == pytest.approx(4.5 / np.sqrt(5 * 4.5))


def test_a_moving_edge_is_sharp_along_its_own_flow() -> None:
    # A column of 8 px that moves by 10 px in 10 ms, an event per px and ms.
    steps = np.repeat(np.arange(10), 8)
    rows = np.tile(np.arange(8), 10)
    events = EventStream(5 + steps, rows, steps * 1000, steps % 2, SensorSize(24, 8))
    flow = np.zeros((2, 8, 24))
    assert sharpness(events, flow) == pytest.approx(1)
    flow[0] = 1000
    # One column of 10 events per px, in place of ten columns of 1.
    assert sharpness(events, flow) > 9
    flow[0] = -1000
    # Ten columns again, two pixels apart.
    assert sharpness(events, flow) == pytest.approx(1)


def test_directions_and_spreads_by_hand() -> None:
    found = np.degrees(angle(np.array([[1.0, 0, -2], [0.0, 3, 0]])))
    assert found.tolist() == pytest.approx([0, 90, 180])
    # Of 1, 2, 4 the median is 2; the logarithms are log 2, 0 and log 2 away from it.
    assert spread(np.array([1.0, 2, 4])) == pytest.approx(100 * (2 ** (2 / 3) - 1))
    assert spread(np.full(3, 7.0)) == 0


def test_networks_are_scored_beside_trivial_predictors(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_specification(tmp_path)
    path, out = tmp_path / "training.toml", tmp_path / "found.json"
    path.write_text(
        'data = {specification = "tiny.toml", variant = "paper", slice_us = 40_000, length = 2, '
        'cache = "cache"}\nnetwork = {width = 2}\nschedule = {epochs = 1, batch_size = 2}\n'
    )
    words = ["depth_flow", "--json", str(out), "scenes", "--split", "validation"]
    for task in ("flow", "depth"):
        state = train_from_file(TASKS.load(task), path, tmp_path / task, Hardware(device="cpu"))
        words += [str(path), str(tmp_path / task)]
        assert state.rows[0]
    monkeypatch.setattr(sys, "argv", words)
    main()
    found = json.loads(out.read_text())
    assert found["environment"]["commit"]
    flow, depth = found["scenes"]["flow"], found["scenes"]["depth"]
    assert flow["network"]["EPE"] == pytest.approx(flow["training"]["curve"][0], abs=2e-4)
    assert depth["network"]["abs_rel"] == pytest.approx(depth["training"]["curve"][0], abs=2e-4)
    assert flow["zero flow"]["EPE"] > 0
    assert depth["median depth image"]["abs_rel"] <= depth["median depth"]["abs_rel"] + 0.5
