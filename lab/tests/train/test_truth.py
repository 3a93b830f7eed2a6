"""Examples with exact truth: what they hold, and how they are mirrored."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")

from texvent.represent.voxel_grid import voxel_e2vid
from texvent_lab.train.sequences import SequenceData
from texvent_lab.train.truth import TruthExamples, crop_randomly

from .windowed_specification import write_sequence_data

pytestmark = pytest.mark.torch


@pytest.fixture
def data(tmp_path: Path) -> SequenceData:
    return write_sequence_data(tmp_path, length=2)


def test_a_whole_clip_has_all_its_windows_as_they_are(data: SequenceData) -> None:
    examples = TruthExamples.open(data, "train", "depth", 4, is_whole=True)
    found, windows = examples(1, np.random.default_rng(0)), examples.clips.read(1)
    assert found["grids"].shape == (6, 4, 24, 32)
    assert found["depth"].shape == (6, 1, 24, 32)
    np.testing.assert_array_equal(found["depth"][:, 0], windows.targets["depth"])
    for number, events in enumerate(windows.events):
        grid = voxel_e2vid(events, bins=4, normalise=True)
        np.testing.assert_array_equal(found["grids"][number], grid)
        seen = np.zeros((24, 32), bool)
        seen[events.y, events.x] = True
        np.testing.assert_array_equal(found["seen"][number], seen)


def test_a_training_example_is_a_random_run_cropped_and_mirrored_as_chance_decides(
    data: SequenceData,
) -> None:
    plain = TruthExamples.open(replace(data, crop=16), "train", "flow", 4)
    mirrored = replace(plain, flips_x=True, flips_y=True)
    kinds = set()
    for seed in range(12):
        one, other = (each(0, np.random.default_rng(seed)) for each in (plain, mirrored))
        assert one["flow"].shape == (2, 2, 16, 16)
        fitting = [
            (x, y)
            for x in (1, -1)
            for y in (1, -1)
            if np.array_equal(one["grids"][..., ::y, ::x], other["grids"])
            and np.array_equal(one["seen"][..., ::y, ::x], other["seen"])
            and np.array_equal(one["flow"][:, 0, ::y, ::x] * x, other["flow"][:, 0], equal_nan=True)
            and np.array_equal(one["flow"][:, 1, ::y, ::x] * y, other["flow"][:, 1], equal_nan=True)
        ]
        assert fitting
        if len(fitting) == 1:
            kinds.add(fitting[0])
    assert len(kinds) > 1


def test_depth_and_flow_share_their_stored_clips(data: SequenceData) -> None:
    assert data.cache is not None
    for target in ("depth", "flow"):
        TruthExamples.open(data, "train", target, 4)
        assert len(list(data.cache.glob("*.h5"))) == 1


@given(st.integers(1, 9), st.integers(1, 9), st.data())
def test_a_crop_is_the_same_square_of_every_map(height: int, width: int, data) -> None:
    side = data.draw(st.integers(1, min(height, width)))
    seed = data.draw(st.integers(0, 100))
    whole = {"place": np.arange(height * width).reshape(1, height, width)}
    cut = crop_randomly(whole, side, np.random.default_rng(seed))
    top, left = divmod(int(cut["place"][0, 0, 0]), width)
    assert cut["place"].shape == (1, side, side)
    square = whole["place"][..., top : top + side, left : left + side]
    np.testing.assert_array_equal(cut["place"], square)
