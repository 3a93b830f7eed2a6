"""Thresholds of each pixel of a sensor, from a file."""

import math
from pathlib import Path

import numpy as np
import pytest

import texvent
from texvent.errors import FileFormatError, InputError
from texvent.frames import Frame
from texvent.simulation.physical.config import PhysicalConfig
from texvent.simulation.physical.simulator import PhysicalSimulator
from texvent.simulation.physical.threshold_map import (
    ThresholdMap,
    read_threshold_map,
    write_threshold_map,
)

from ..pixel_frames import run
from .physical_pixels import clean, intensity


@pytest.fixture
def path(tmp_path):
    """Pixels of 0.5, 1, 2 times the mean; the last was not measured."""
    on = np.array([[0.5, 1.0, 2.0, math.nan]])
    return write_threshold_map(ThresholdMap(on, on[:, ::-1]), tmp_path / "pixels.npz")


@pytest.mark.parametrize(("end", "counts"), [(4.85, [8, 4, 2, 4]), (3.15, [4, 2, 4, 8])])
def test_each_pixel_fires_at_its_own_threshold(path, end, counts):
    """A change of 0.85 over thresholds of 0.1, 0.2, 0.4, and 0.2 where none was measured."""
    frames = [
        Frame(np.full((1, 4), intensity(level)), t_us) for level, t_us in ((4, 0), (end, 10**6))
    ]
    events = run(clean(threshold_map=path), frames)
    assert np.bincount(events.x, minlength=4).tolist() == counts
    assert events.t[events.x == counts.index(2)] == pytest.approx(
        [0.4e6 / 0.85, 0.8e6 / 0.85], abs=2
    )


@pytest.mark.parametrize("ratio", [0.5, 1.0, 2.0])
def test_shares_of_a_map_are_of_the_mean_of_their_own_polarity(path, ratio):
    def of(**options):
        simulator = PhysicalSimulator(PhysicalConfig(on_off_ratio=ratio, **options))
        simulator.step(Frame(np.zeros((1, 4)), 0))
        return simulator._pixels._sensor.mismatch

    plain, mapped = of(threshold_sigma=0.0), of(threshold_map=path)
    for side, shares in (("threshold_on", [0.5, 1, 2]), ("threshold_off", [None, 2, 1, 0.5])):
        means, found = getattr(plain, side), getattr(mapped, side)
        for x, share in enumerate(shares):
            if share is not None:
                assert found[x] == pytest.approx(share * means[x], rel=1e-3)


def test_pixels_leak_as_often_as_stated_whatever_their_thresholds(path):
    frames = [Frame(np.full((1, 4), 80.0), t_us) for t_us in (0, 2_500_000, 5_100_000)]
    events = run(clean(threshold_map=path, leak_rate_hz=2.0, leak_rate_decades=0.0), frames)
    assert np.bincount(events.x, minlength=4).tolist() == [10] * 4


def test_pixels_that_were_not_measured_keep_what_is_drawn(path):
    def thresholds(**options):
        simulator = PhysicalSimulator(PhysicalConfig(sensor_seed=3, **options))
        simulator.step(Frame(np.zeros((1, 4)), 0))
        return simulator._pixels._sensor.mismatch.threshold_on

    drawn, mixed = thresholds(), thresholds(threshold_map=path)
    assert mixed[3] == drawn[3]
    assert mixed[:3] == pytest.approx([0.15, 0.3, 0.6], rel=1e-3)


def test_a_run_names_its_map_and_refuses_frames_of_another_size(path):
    frames = np.array([[[50] * 4], [[200] * 4]], np.uint8)
    events = texvent.simulate(frames, fps=24, simulator="physical", threshold_map=path)
    assert events.metadata["weights"]["simulator"]["file"] == "pixels.npz"
    with pytest.raises(InputError, match="of 4x1 pixels, the frames have 5x2; use sensor=4x1"):
        texvent.simulate(
            np.zeros((2, 2, 5), np.uint8), fps=24, simulator="physical", threshold_map=path
        )


def test_other_files_are_refused(tmp_path):
    with pytest.raises(InputError, match="no threshold map"):
        read_threshold_map(tmp_path / "none.npz")
    with pytest.raises(InputError, match="longer than 255 bytes"):
        read_threshold_map(Path("x" * 256))
    other, text = tmp_path / "other.npz", tmp_path / "text.npz"
    np.savez(other, x=np.zeros(3))
    text.write_text("on off")
    for wrong in (other, text):
        with pytest.raises(FileFormatError, match="arrays on and off"):
            read_threshold_map(wrong)
    np.savez(other, on=np.ones((2, 2)), off=-np.ones((2, 2)))
    with pytest.raises(FileFormatError, match="above 0 or NaN"):
        read_threshold_map(other)
