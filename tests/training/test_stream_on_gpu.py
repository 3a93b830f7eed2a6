"""Batches of the stream on a GPU are those of the CPU, bit for bit."""

import itertools
from dataclasses import replace

import pytest

from .written import Sliding

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")
pytest.importorskip("triton")

from texvent.training import ClipRanges, EventStream, PhysicalRanges  # noqa: E402

RANGES = {
    "v2v": ClipRanges(hot_fraction=(0.1, 0.2), mismatch=(0.0, 0.1), refractory_us=(0, 20_000)),
    "physical": replace(PhysicalRanges(), hot_fraction=(0.1, 0.2), noise_scale=(1.0, 20.0)),
}


@pytest.mark.parametrize("pixels", RANGES)
def test_batches_are_those_of_the_cpu(pixels):
    """On a CPU the kernels of GPUs run in Triton's interpreter."""
    is_gpu = torch.cuda.is_available()
    streams = [
        EventStream(
            Sliding(), batch=2, frames=2, size=(8, 6), randomize=RANGES[pixels], device=device,
            outputs=("grids", "counts", "surfaces", "events"), frames_per_grid=2, seed=3,
        )
        for device in ("cpu", "cuda" if is_gpu else "cpu")
    ]  # fmt: skip
    if not is_gpu:
        streams[1]._is_on_gpu = True
    for expected, found in itertools.islice(zip(*streams, strict=True), 2):
        for name in ("first", "frames", "times_us", "grids", "counts", "surfaces"):
            mine, other = getattr(found, name).cpu(), getattr(expected, name)
            assert mine.dtype == other.dtype, name
            assert torch.equal(mine, other), name
        for mine, other in zip(found.events, expected.events, strict=True):
            for name in "txyp":
                assert torch.equal(getattr(mine, name).cpu(), getattr(other, name)), name
        assert all(len(clip) > 10 for clip in expected.events)
