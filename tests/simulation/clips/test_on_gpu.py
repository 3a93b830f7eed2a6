"""Clips on a GPU give the arrays and events of the CPU, bit for bit."""

import numpy as np
import pytest

from texvent.simulation.clips.pixels import ClipOutputs, ClipPixels
from texvent.simulation.clips.scan import simulate_on_cpu

from .test_clips import ALL, EVERYTHING, pixels_of, some_clips

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")
pytest.importorskip("triton")

from texvent.simulation.clips.scan_triton import simulate_on_gpu  # noqa: E402

CASES = {
    "plain": ({}, ALL),
    "everything": ({**EVERYTHING, "HAS_PHASE": 1}, ALL),
    "grids alone": ({"NOISE": 0.1}, ClipOutputs(bins=1)),
    "events alone": ({"gamma": 2.2}, ClipOutputs(grids=False, events=True)),
}


def of_two(pixels: ClipPixels) -> ClipPixels:
    return pixels._replace(numbers=pixels.numbers[:2], keys=pixels.keys[:2])


@pytest.mark.parametrize("name", CASES)
def test_arrays_and_events_are_those_of_the_cpu(name, device):
    columns, outputs = CASES[name]
    frames, times_us = (one[:2, :5] for one in some_clips())
    frames = frames[..., :7, :9].copy()
    pixels = of_two(pixels_of(**columns))
    found = simulate_on_gpu(torch.from_numpy(frames).to(device), times_us, pixels, outputs)
    for field, mine, other in zip(
        found._fields, found, simulate_on_cpu(frames, times_us, pixels, outputs), strict=True
    ):
        assert (mine is None) == (other is None), field
        mine = mine.cpu().numpy() if isinstance(mine, torch.Tensor) else mine
        assert mine is None or np.array_equal(mine, other), field
