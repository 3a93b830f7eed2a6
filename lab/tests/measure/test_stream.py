"""The plain simulator beside which the training stream is timed."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")
from texvent_lab.measure.stream import plain_kinds, simulate_plainly

pytestmark = pytest.mark.torch
THRESHOLDS = st.floats(0.05, 1.0)


@pytest.mark.parametrize("kind", plain_kinds())
@given(on=THRESHOLDS, off=THRESHOLDS, seed=st.integers(0, 99), span=st.sampled_from([1, 20, 250]))
def test_without_noise_the_counts_are_the_change_of_brightness_to_a_threshold(
    kind, on, off, seed, span
):
    """A potential that starts between the thresholds ends there; frames at rest have no event."""
    frames = np.random.default_rng(seed).integers(0, span, (7, 5, 8)).astype(np.uint8)
    drawn = {"threshold_on": on, "threshold_off": off, "hot_fraction": 0.0}
    counts = simulate_plainly(frames, drawn, 3, plain_kinds()[kind])
    assert counts.shape == (2, 3, 5, 8)
    steps = np.where(counts > 0, on, off) * counts
    ends = np.log(1e-3 + (frames[[0, -1]] / 255.0) ** 2.2)
    left = (ends[1] - ends[0]) - steps.sum(axis=(0, 1), dtype=float)
    assert np.abs(left).max() < on + off
    if span == 1:
        assert not counts.any()
