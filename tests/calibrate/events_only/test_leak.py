import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.calibrate.events_only.rest import leak_rate


@given(noise=st.floats(0.01, 20), leak=st.floats(0.05, 20))
def test_the_leak_is_found_from_how_often_it_fires_among_noise(noise, leak):
    if noise / leak > 20:
        return
    # After each of n events per second, leak comes first with probability exp(-n / g).
    surplus = noise / np.expm1(noise / leak)
    assert leak_rate(noise, surplus, 0.0, 0.0) == pytest.approx(leak, rel=1e-3)


@given(noise=st.floats(0.1, 5), leak=st.floats(0.2, 5), decades=st.floats(0.0, 0.3))
def test_the_mean_over_pixels_is_that_of_drawn_ones(noise, leak, decades):
    draws = np.random.default_rng(1).standard_normal(20_000)
    spread = np.log(10) * decades
    ratio = noise * np.exp(spread * draws - spread**2 / 2) / leak
    surplus = float((leak * ratio / np.expm1(np.minimum(ratio, 500))).mean())
    if surplus > 1e-3 * leak:
        assert leak_rate(noise, surplus, decades, 0.0) == pytest.approx(leak, rel=0.03)
