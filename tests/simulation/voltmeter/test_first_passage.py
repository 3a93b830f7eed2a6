import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from tests.examples import examples
from tests.simulation.references import voltmeter
from tests.simulation.references.sorting import sort_events
from tests.simulation.references.voltmeter import MOST_DISPLACEMENT

from texvent.events import NOISE, SIGNAL
from texvent.simulation.packets import FrameInterval, SortedEvents, UnsortedEvents
from texvent.simulation.random.draws import frame_key
from texvent.simulation.voltmeter import first_passage
from texvent.simulation.voltmeter.config import Constants
from texvent.simulation.voltmeter.first_passage import find_first_passages
from texvent.simulation.voltmeter.voltage import FirstPassageInput, new_voltage

SHAPE = (3, 4)
# In thresholds per interval of 1000 µs; 0 and the smallest numbers are edge cases of the formulas.
drifts = st.sampled_from([0.0, 1e-300, 1e-9, 0.3, -2.0, 5.0])
sigmas = st.sampled_from([0.0, 1e-160, 1e-6, 0.1, 1.0, 3.0])
residuals = arrays(np.float64, SHAPE, elements=st.floats(-0.999, 0.999))
lights = arrays(np.float32, (4, *SHAPE), elements=st.sampled_from([0.0, 50.0, 51.0, 90.0]))


class Sensor:
    """Pixels of given constants, stepped every 1000 µs."""

    def __init__(self, constants, light, residual, step=None):
        self.step = step or first_passage.find_first_passages
        self.constants, self.seen = constants, np.array(light, np.float32)
        self.voltage, self.start_us = new_voltage(np.array(residual, np.float64)), 7000

    def see(self, light, *, seed=0) -> SortedEvents:
        now = np.array(light, np.float32)
        span = self.start_us, self.start_us + 1000
        interval = FrameInterval(*span, frame_key(seed, self.start_us))
        found = self.step(
            FirstPassageInput(self.seen, now, self.constants), self.voltage, interval, 7000
        )
        assert np.array_equal(self.seen, now)
        self.start_us = span[1]
        if isinstance(found, UnsortedEvents):
            return sort_events(found, span, now.shape)
        return found


def constants(*, gain=0.0, drift=0.0, sigma=0.0) -> Constants:
    """Drift and diffusion in thresholds per 1000 µs and its root, whatever the light."""
    return Constants(gain, 20.0, 0.0, drift / 1000, 0.0, sigma / np.sqrt(1000))


@examples(60)
@given(st.sampled_from([0.0, 5.0]), drifts, sigmas, residuals, lights, st.integers(0, 10))
def test_backends_agree_and_passages_are_sound(gain, drift, sigma, residual, light, seed):
    chosen = constants(gain=gain, drift=drift, sigma=sigma)
    reference, compiled = (
        Sensor(chosen, light[0], residual, step)
        for step in (voltmeter.find_first_passages, find_first_passages)
    )
    for now in light[1:]:
        start_us = reference.start_us
        ours, theirs = reference.see(now, seed=seed), compiled.see(now, seed=seed)
        for one, other in zip(ours, theirs, strict=True):
            assert np.array_equal(one, other)
        assert ((ours.t >= start_us) & (ours.t < start_us + 1000)).all()
        for one, other in zip(reference.voltage[:-1], compiled.voltage[:-1], strict=True):
            assert np.array_equal(one, other)
        due, pace, _, signal, _ = reference.voltage
        assert (due >= start_us + 1000 - 7000).all()
        assert (np.abs(pace) > 0).all()
        assert np.isfinite(signal).all()


def test_where_nothing_moves_nothing_fires_and_the_residual_stays():
    residual = np.linspace(-0.9, 0.9, 12).reshape(SHAPE)
    light = np.full(SHAPE, 50.0)
    sensor = Sensor(constants(gain=1.0), light, residual)
    for _ in range(3):
        assert len(sensor.see(light).t) == 0
    # k1 ΔL / (L + k2) is 0.2: enough for those above 0.8.
    fired = sensor.see(np.full(SHAPE, 50.0 + 0.2 * 70 / 0.9))
    assert (fired.y * SHAPE[1] + fired.x).tolist() == np.flatnonzero(residual > 0.8).tolist()
    way = np.sign(sensor.voltage.rate) - sensor.voltage.rate * (
        sensor.voltage.next_crossing_us - 4000
    )
    assert way == pytest.approx((residual + 0.2 - (residual > 0.8)).reshape(-1), abs=1e-5)
    assert np.abs(way).max() <= MOST_DISPLACEMENT


def test_events_are_noise_where_the_signal_drove_less_than_half():
    # Of 1.5 thresholds per interval the change of light makes 0.4 and 0.6 parts.
    for share, label in ((0.4, NOISE), (0.6, SIGNAL)):
        change = share * 1.5 * 70 / (5.0 - share * 1.5 / 2)
        sensor = Sensor(constants(gain=5.0, drift=(1 - share) * 1.5), [[50.0]], [[0.0]])
        assert sensor.see([[50.0 + change]]).label.tolist() == [label]


def test_the_signals_share_is_counted_over_intervals():
    # 0.6 thresholds of signal, then 0.6 of leak: the signal made more than half of the way.
    change = 0.6 * 70 / (5.0 - 0.3)
    sensor = Sensor(constants(gain=5.0, drift=0.0), [[50.0]], [[0.0]])
    assert len(sensor.see([[50.0 + change]]).t) == 0
    sensor.constants = constants(gain=5.0, drift=0.6)
    assert sensor.see([[50.0 + change]]).label.tolist() == [SIGNAL]


def test_a_passage_holds_until_the_light_moves():
    sensor = Sensor(constants(gain=5.0, drift=0.4), [[50.0, 50.0]], [[0.0, 0.0]])
    assert len(sensor.see([[50.0, 50.0]]).t) == 0
    assert sensor.voltage.next_crossing_us == pytest.approx([2500.0, 2500.0])
    # The second goes 0.4 + 0.4 − 0.9 in this interval.
    change = 0.9 * 70 / (5.0 + 0.45)
    assert len(sensor.see([[50.0, 50.0 - change]]).t) == 0
    fired = sensor.see([[50.0, 50.0 - change]])
    assert (fired.x.tolist(), fired.t.tolist()) == ([0], [7000 + 2500])


def test_many_events_of_few_pixels_find_room():
    sensor = Sensor(constants(drift=5000.0), [[50.0, 50.0]], [[0.0, 0.0]])
    fired = sensor.see([[50.0, 50.0]])
    # 5000 each; the last falls on the end or just before it, as the sum of gaps rounds.
    assert np.abs(np.bincount(fired.x) - 5000).max() <= 1
