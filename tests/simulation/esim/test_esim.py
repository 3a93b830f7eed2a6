import math

import numpy as np
import pytest

from texvent.frames import Frame
from texvent.simulation.esim.config import EsimConfig
from texvent.simulation.esim.pixels import log_intensity
from texvent.simulation.esim.simulator import EsimSimulator

from ..pixel_frames import run


def on_log_scale(value: float) -> float:
    """The intensity whose ln(I / 255 + 0.001) is `value`."""
    return 255 * (math.exp(value) - 1e-3)


def test_log_intensity_is_the_published_one():
    levels = np.array([[0, 51, 255]], np.uint8)
    expected = [[math.log(1e-3), math.log(0.2 + 1e-3), math.log(1 + 1e-3)]]
    assert log_intensity(levels, 1e-3) == pytest.approx(np.array(expected), abs=1e-15)
    assert log_intensity(levels.astype(np.float32), 1e-3) == pytest.approx(np.array(expected))


def test_drawn_thresholds_have_the_stated_mean_and_sd_and_are_new_in_every_frame():
    shape = (60, 60)
    low, high = np.full(shape, on_log_scale(-3)), np.full(shape, on_log_scale(-2.5))
    maps = []
    for first_us in (0, 1_000_000):
        frames = [Frame(low, 0)] + [Frame(low, first_us)] * (first_us > 0)
        events = run(
            EsimSimulator(EsimConfig(threshold_sigma=0.03), seed=5),
            [*frames, Frame(high, first_us + 500_000)],
        )
        earliest = np.full(shape, np.iinfo(np.int64).max)
        np.minimum.at(earliest, (events.y, events.x), events.t - first_us)
        maps.append(earliest * 1e-6)  # the ramp rises by 1 per second
    assert maps[0].mean() == pytest.approx(0.2, abs=4 * 0.03 / 60)
    assert maps[0].std() == pytest.approx(0.03, rel=4 / math.sqrt(2 * 3600))
    assert not np.array_equal(*maps)


def test_eq4_counts_with_the_smaller_threshold_and_the_models_logarithm():
    simulator = EsimSimulator(EsimConfig(contrast_threshold_on=0.3, contrast_threshold_off=0.25))
    assert simulator.contrast_threshold == 0.25
    assert simulator.balance == pytest.approx(0.255)
