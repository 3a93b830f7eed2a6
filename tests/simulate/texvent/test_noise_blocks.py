"""Noise by blocks of pixels: the bits of the definition."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.simulate.references import noise_blocks as noise_reference

from texvent.simulate.random.draws import frame_key
from texvent.simulate.texvent import noise as noise_cpu


@settings(max_examples=60)
@given(
    st.integers(0, 2**63 - 1),
    st.sampled_from([1, 7, 4095, 4096, 4097, 20_000]),
    st.sampled_from([0.0, 1e-6, 5e-4, 0.02, 1.5]),
    st.floats(0, 1),
)
def test_backends_place_noise_alike(seed, pixels, mean, on_fraction):
    one, two = (
        module.place_noise(frame_key(seed, 5), mean, on_fraction, pixels)
        for module in (noise_reference, noise_cpu)
    )
    assert [column.dtype for column in one] == [column.dtype for column in two]
    assert all(np.array_equal(a, b) for a, b in zip(one, two, strict=True))
    assert np.all(np.diff(one.pixel * 2 + one.p) >= 0)
    assert np.all((one.fraction >= 0) & (one.fraction < 1))
