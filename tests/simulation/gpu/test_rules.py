"""What the host works out for the GPU kernels: byte tables and times."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.errors import InputError
from texvent.simulation.gpu.intervals import Clock
from texvent.simulation.texvent.gpu.rules import byte_brightness, byte_trigger_levels


@given(
    balance=st.floats(0.5, 300.0),
    threshold=st.floats(1e-3, 3.0)
    # Exactly the change between two bytes, where one bit decides.
    | st.tuples(st.integers(0, 254), st.integers(1, 255)),
)
def test_byte_levels_fire_where_the_float64_comparison_does(balance, threshold):
    brightness = byte_brightness(balance)
    if isinstance(threshold, tuple):
        first, second = threshold
        threshold = abs(brightness[second] - brightness[first]) or 0.2
    pair = byte_trigger_levels(brightness, threshold)
    low, high = pair >> 16, pair & 0xFFFF
    byte = np.arange(256)
    fires = (byte <= low[:, None]) | (byte >= high[:, None])
    change = brightness[None, :] - brightness[:, None]  # Eq. 5, row: reference, column: intensity
    assert np.array_equal(fires, np.abs(change) >= threshold)


def test_a_time_that_does_not_increase_is_named_with_its_clip():
    clock = Clock(2)
    clock.read(1, [5], None)
    clock.advance()
    with pytest.raises(InputError, match="clip 1: 5 µs does not come after 5 µs"):
        clock.read(1, [[6], [5]], None)
