"""Pictures that stay on the device from RIFE to events give the events of the pipeline's parts."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from tests.interpolate.rife.rife_files import save_published
from tests.simulate.gpu.clips import rows

from texvent.config import InterpolateConfig
from texvent.errors import InputError
from texvent.interpolate.count_policy import count_intermediate
from texvent.interpolate.rife.interpolator import RifeInterpolator
from texvent.pairs.instants import intermediate_times_us
from texvent.simulate.gpu.pairs import GpuPairs
from texvent.simulate.texvent.simulator import TexventConfig, TexventSimulator
from texvent.video import Frame, Video

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")
pytest.importorskip("triton")

TIMES_US = (0, 4_000, 9_000)


@pytest.fixture
def device() -> str:
    return "cuda" if torch.cuda.is_available() else "cpu"


@pytest.fixture
def rife(tmp_path) -> RifeInterpolator:
    """An untrained network, small."""
    from texvent.interpolate.rife.network import RIFE_4_6

    path = save_published(torch, RIFE_4_6, tmp_path / "rife.pkl")
    config = InterpolateConfig(interpolate="rife", interpolator_weights=path)
    return RifeInterpolator(config, Video(np.zeros((2, 8, 8), np.uint8), [0, 1]))


def pictures(*shape: int) -> np.ndarray:
    smooth = np.random.default_rng(1).random((3, *shape)).astype(np.float32)
    return 60 + 70 * smooth


def simulator():
    from texvent.simulate.gpu import GpuSimulator

    return GpuSimulator(TexventConfig(noise="none"), seed=4)


@pytest.mark.parametrize("count", [None, 2])
def test_the_events_are_those_of_the_frames_taken_over_the_host(rife, device, count):
    clip = pictures(24, 32)
    pairs = GpuPairs(simulator(), rife, count=count, max_intermediate=3)
    on_device = [
        pairs.step(torch.from_numpy(picture).to(device), t_us)
        for picture, t_us in zip(clip, TIMES_US, strict=True)
    ]
    assert len(on_device[0]) == 0
    expected = [row for packet in dense_packets(rife, clip, count) for row in rows(packet).tolist()]
    found = [row for batch in on_device for row in rows(batch.stream(0)).tolist()]
    assert len(found) > 300
    if device == "cpu":
        assert found == expected
    else:
        assert abs(len(found) - len(expected)) <= 1e-2 * len(expected)


def dense_packets(rife, clip, count):
    """The same by way of frames on the host and the CPU's pixel model."""
    reference = TexventSimulator(TexventConfig(noise="none"), seed=4)
    frames = [Frame(picture, t_us) for picture, t_us in zip(clip, TIMES_US, strict=True)]
    yield reference.step(frames[0])
    for first, second in itertools.pairwise(frames):
        number = count
        if number is None:
            lumas = first.luma, second.luma
            number = count_intermediate(*lumas, balance=20.0, contrast_threshold=0.2, cap=3)
        times_us = intermediate_times_us(first.t_us, second.t_us, number)
        for frame in rife.between(first, second, times_us):
            yield reference.step(frame)
        yield reference.step(second)


@pytest.mark.parametrize("shape", [(24, 32), (3, 24, 32)])
def test_pictures_in_tensors_are_interpolated_as_frames_are(rife, device, shape):
    first, second, _ = pictures(*shape) * 1.8  # brighter than white in places
    tensors = [torch.from_numpy(one).to(device) for one in (first, second)]
    found = list(rife.between_tensors(*tensors, [0.25, 0.5]))
    host = [np.moveaxis(one, 0, 2) if one.ndim == 3 else one for one in (first, second)]
    expected = rife.between(Frame(host[0], 0), Frame(host[1], 1000), [250, 500])
    for one, other in zip(found, expected, strict=True):
        assert one.device.type == device
        assert np.abs(one.cpu().numpy() - other.pixels).max() < 2e-2


def test_frames_of_other_shapes_are_refused(rife, device):
    pairs = GpuPairs(simulator(), rife)
    pairs.step(torch.zeros(24, 32), 0)
    with pytest.raises(InputError, match="one shape"):
        pairs.step(torch.zeros(24, 40), 10)
    with pytest.raises(InputError, match=r"\[H, W\] or \[3, H, W\]"):
        GpuPairs(simulator(), rife).step(torch.zeros(2, 24, 32), 0)
    with pytest.raises(InputError, match="both must have one shape"):
        next(rife.between_tensors(torch.zeros(4, 4), torch.zeros(4, 5), [0.5]))


def test_a_network_that_gives_nonsense_is_noticed(device):
    class Nonsense:
        def between_tensors(self, first, second, positions):
            for _ in positions:
                yield torch.full_like(first, float("nan"))

    pairs = GpuPairs(simulator(), Nonsense(), count=1)
    pairs.step(torch.zeros(8, 8), 0)
    with pytest.raises(InputError, match="NaN"):
        pairs.step(torch.zeros(8, 8), 10)
