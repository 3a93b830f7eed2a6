import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from texvent.simulate.draws import frame_key
from texvent.simulate.kernels.passage import Motion, Voltage, load_find_passages

SHAPE = (3, 4)
# In thresholds per interval of 1000 µs; 0 and the smallest numbers are edge cases of the formulas.
drifts = arrays(np.float64, SHAPE, elements=st.sampled_from([0.0, 1e-300, 1e-9, 0.3, -2.0, 5.0]))
sigmas = arrays(np.float64, SHAPE, elements=st.sampled_from([0.0, 1e-160, 1e-6, 0.1, 1.0, 3.0]))
residuals = arrays(np.float64, SHAPE, elements=st.floats(-0.999, 0.999))


def find(backend, motion, residual, *, seed=0, duration_us=1000.0):
    voltage = Voltage(residual.copy(), np.zeros(residual.shape))
    found = load_find_passages(backend)(motion, voltage, frame_key(seed, 1), duration_us)
    return found, voltage


@settings(max_examples=60, deadline=None)
@given(drifts, sigmas, residuals, st.integers(0, 10))
def test_backends_agree_and_passages_are_sound(drift, sigma, residual, seed):
    drift, sigma = drift / 1000, sigma / np.sqrt(1000)
    motion = Motion(0.5 * drift, drift, sigma)
    reference, left = find("reference", motion, residual, seed=seed)
    compiled, left_compiled = find("cpu", motion, residual, seed=seed)
    for ours, theirs in zip((*reference, *left), (*compiled, *left_compiled), strict=True):
        assert np.array_equal(ours, theirs)
    assert ((reference.after_us >= 0) & (reference.after_us < 1000)).all()
    assert (np.abs(left.residual) < 1).all()
    assert np.isfinite(left.signal).all()
    order = np.lexsort((reference.after_us, reference.pixel))
    assert (order == np.arange(len(order))).all()


def test_where_nothing_moves_nothing_fires_and_the_residual_stays(backend):
    still = np.zeros(SHAPE)
    residual = np.linspace(-0.9, 0.9, 12).reshape(SHAPE)
    found, voltage = find(backend, Motion(still, still, still), residual)
    assert len(found.pixel) == 0
    assert np.array_equal(voltage.residual, residual)


def test_events_are_noise_where_the_signal_drove_less_than_half(backend):
    drift = np.full((1, 2), 0.0015)
    signal = drift * np.array([[0.4, 0.6]])
    found, _ = find(backend, Motion(signal, drift, np.zeros((1, 2))), np.zeros((1, 2)))
    assert found.is_noise.tolist() == [True, False]


def test_the_signals_share_is_counted_over_intervals(backend):
    # 0.6 thresholds of signal, then 0.6 of leak: the signal made more than half of the way.
    drift = np.full((1, 1), 0.0006)
    still = np.zeros((1, 1))
    voltage = Voltage(still.copy(), still.copy())
    step = load_find_passages(backend)
    first = step(Motion(drift, drift, still), voltage, frame_key(0, 1), 1000.0)
    second = step(Motion(still, drift, still), voltage, frame_key(0, 2), 1000.0)
    assert len(first.pixel) == 0
    assert second.is_noise.tolist() == [False]


def test_many_events_of_few_pixels_find_room(backend):
    drift = np.full((1, 2), 0.05)
    found, _ = find(backend, Motion(drift, drift, np.zeros((1, 2))), np.zeros((1, 2)))
    # 50 each; the last falls on the end or just before it, as the sum of gaps rounds.
    assert np.abs(np.bincount(found.pixel) - 50).max() <= 1
