import math

import numpy as np
import pytest

from texvent.simulate.esim.simulator import EsimConfig, EsimSimulator, log_intensity
from texvent.video import Frame

from ..pixel_frames import frames_of, run


def on_log_scale(value: float) -> float:
    """The intensity whose ln(I / 255 + 0.001) is `value`."""
    return 255 * (math.exp(value) - 1e-3)


def test_log_intensity_is_the_published_one():
    levels = np.array([[0, 51, 255]], np.uint8)
    expected = [[math.log(1e-3), math.log(0.2 + 1e-3), math.log(1 + 1e-3)]]
    assert log_intensity(levels, 1e-3) == pytest.approx(np.array(expected), abs=1e-15)
    assert log_intensity(levels.astype(np.float32), 1e-3) == pytest.approx(np.array(expected))


@pytest.mark.parametrize("sign", [1, -1])
def test_a_ramp_fires_where_it_crosses_each_threshold(sign):
    frames = frames_of([on_log_scale(-3), on_log_scale(-3 + sign * 1.05)], [0, 1_000_000])
    events = run(EsimSimulator(), frames)
    assert events.t == pytest.approx([k * 0.2 / 1.05 * 1e6 for k in range(1, 6)], abs=1)
    assert (events.polarity == sign).all()


def test_the_reference_is_carried_in_steps_across_frames():
    # Ramp B' of docs/equations.md: 0.055 per frame, so crossings lie 0.2 / 0.055 frames apart.
    frames = frames_of([on_log_scale(-3 + 0.055 * i) for i in range(21)], range(0, 21_000, 1000))
    events = run(EsimSimulator(), frames)
    assert events.t == pytest.approx([k * 0.2 / 0.055 * 1000 for k in range(1, 6)], abs=1)
    assert events.p.all()


def test_a_step_fires_once_per_threshold_and_keeps_the_rest():
    frames = frames_of([on_log_scale(v) for v in (-3, -2.5, -2.5, -2.39)], [0, 1000, 2000, 3000])
    events = run(EsimSimulator(), frames)
    # 0.5 crosses 0.2 and 0.4; of the 0.1 left, 0.11 more crosses the third at 0.1 / 0.11.
    assert events.t == pytest.approx([400, 800, 2909], abs=1)


def test_unequal_thresholds_count_apart():
    config = EsimConfig(contrast_threshold_on=0.3, contrast_threshold_off=0.1)
    frames = frames_of([on_log_scale(v) for v in (-3, -2.05, -3)], [0, 1000, 2000])
    events = run(EsimSimulator(config), frames)
    # Up 0.95: three ON, reference at 0.9. Down to 0: nine OFF (0.9 / 0.1, minus rounding).
    assert int(events.p.sum()) == 3
    assert int((1 - events.p).sum()) in (8, 9)


def test_crossings_in_the_refractory_period_are_lost():
    # One crossing every 10 ms; a period of 25 ms lets every third through.
    config = EsimConfig(refractory_period_us=25_000)
    frames = frames_of([on_log_scale(-3), on_log_scale(-3 + 2.01)], [0, 100_500])
    events = run(EsimSimulator(config), frames)
    assert events.t == pytest.approx([10_000, 40_000, 70_000, 100_000], abs=1)


def test_the_reference_steps_over_lost_crossings():
    config = EsimConfig(refractory_period_us=25_000)
    values = [on_log_scale(v) for v in (-3, -2.39, -2.39)]
    events = run(EsimSimulator(config), frames_of(values, [0, 1000, 500_000]))
    assert len(events) == 1


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
