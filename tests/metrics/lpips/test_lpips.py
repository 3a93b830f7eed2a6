"""LPIPS against its definition, its properties, and files that are not its weights."""

import os
import pickle

import numpy as np
import pytest

from texvent.errors import FileFormatError, InputError
from texvent.events import EventStream
from texvent.metrics.event_frames import EventFrameLpips
from texvent.metrics.lpips import (
    ALEX,
    Lpips,
    lpips_distance,
    read_lpips_weights,
    write_lpips_weights,
)
from texvent.represent.event_frame import event_frame
from texvent.sensor import SensorSize

from ..recordings import random_events
from .lpips_files import NARROW, narrow_weights, slow_distance, write_published

WEIGHTS = narrow_weights()


@pytest.fixture(autouse=True)
def _torch(request):
    if request.node.get_closest_marker("torch"):
        pytest.importorskip("torch")


def distance(a, b, weights=WEIGHTS):
    return lpips_distance(a, b, Lpips(weights))


def images(seed, height=37, width=43):
    return np.random.default_rng(seed).random((2, height, width, 3))


@pytest.mark.torch
@pytest.mark.parametrize("seed", [0, 1])
def test_the_distance_agrees_with_its_slow_twin(seed):
    a, b = images(seed)
    weights = narrow_weights(seed)
    expected = slow_distance(a, b, weights)
    assert expected > 0.01
    assert distance(a, b, weights) == pytest.approx(expected, rel=1e-5)


@pytest.mark.torch
@pytest.mark.parametrize(
    ("a", "b", "complaint"),
    [
        (np.zeros((40, 40)), np.zeros((40, 41)), "40x40 px with one of 41x40 px"),
        (np.zeros((40, 40, 4)), np.zeros((40, 40, 4)), r"\[40, 40, 4\]; it must be"),
        (np.full((40, 40), 255.0), np.zeros((40, 40)), "divide 8-bit images by 255"),
    ],
)
def test_what_is_no_pair_of_images_is_refused(a, b, complaint):
    with pytest.raises(InputError, match=complaint):
        distance(a, b)


def test_the_published_file_and_the_converted_one_hold_the_same_arrays(tmp_path):
    read = read_lpips_weights(write_published(WEIGHTS, tmp_path / "alexnet.ckpt"), NARROW)
    write_lpips_weights(read, tmp_path / "lpips.npz")
    again = read_lpips_weights(tmp_path / "lpips.npz", NARROW)
    for name, array in WEIGHTS.items():
        np.testing.assert_array_equal(again[name], array)
    with pytest.raises(FileFormatError, match="does not hold the arrays of LPIPS's network"):
        read_lpips_weights(tmp_path / "lpips.npz")


class Evil:
    def __reduce__(self):
        return (os.mkdir, ("was_run",))


def test_a_pickle_that_would_run_something_is_refused_unrun(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "evil.ckpt").write_bytes(pickle.dumps({"AlexNet_0": Evil()}))
    with pytest.raises(FileFormatError, match=r"evil\.ckpt.*mkdir, which weights do not need"):
        read_lpips_weights(tmp_path / "evil.ckpt")
    assert not (tmp_path / "was_run").exists()


@pytest.mark.parametrize("suffix", [".ckpt", ".npz"])
def test_a_truncated_file_is_refused_by_name(tmp_path, suffix):
    whole = tmp_path / f"whole{suffix}"
    if suffix == ".npz":
        write_lpips_weights(WEIGHTS, whole)
    else:
        write_published(WEIGHTS, whole)
    whole.write_bytes(whole.read_bytes()[: whole.stat().st_size // 2])
    with pytest.raises(FileFormatError, match=r"whole\..* cannot be read as LPIPS's weights"):
        read_lpips_weights(whole)


@pytest.mark.torch
def test_event_frames_are_compared_as_grey_images(tmp_path):
    weights = narrow_weights(layers=ALEX)
    write_lpips_weights(weights, tmp_path / "alex.npz")
    metric = EventFrameLpips(weights=tmp_path / "alex.npz")
    size = SensorSize(40, 33)
    a, b = random_events(1, 600, size, 40_000), random_events(2, 600, size, 40_000)
    frames = [event_frame(one, "polarity").astype(np.float64) for one in (a, b)]
    assert metric(a, b) == pytest.approx(distance(*frames, weights))
    assert metric(a, a) == 0.0
    assert metric.missing() is None
    # A second frame that is empty in both counts 0.
    later = EventStream([0], [0], [90_000], [1], size)
    both = [EventStream.concat([one, later]) for one in (a, b)]
    assert metric(*both) == pytest.approx(metric(a, b) / 3)
