"""The functions of `elementary`, compiled by Numba to be called in kernels: same bits."""

from __future__ import annotations

import numba

from texvent.simulate.backend import elementary

# Without Python's check for division by zero, loops over these fill whole vector registers.
# Numba's cache looks at this file only: whoever changes `elementary` must touch this one as well.
_compile = numba.njit(cache=True, nogil=True, error_model="numpy")

natural_log = _compile(elementary.natural_log)
split_exponential = _compile(elementary.split_exponential)
cosine_of_turns = _compile(elementary.cosine_of_turns)
_LIMIT = elementary.LARGEST_EXPONENT


@numba.njit(cache=True, nogil=True, error_model="numpy")
def exponential(x: float) -> float:
    """See `elementary.exponential`."""
    scale, excess = split_exponential(min(max(x, -_LIMIT), _LIMIT))
    return float(scale + scale * excess)


@numba.njit(cache=True, nogil=True, error_model="numpy")
def decay_and_gain(angle: float) -> tuple[float, float]:
    """See `elementary.decay_and_gain`."""
    scale, excess = split_exponential(-min(angle, _LIMIT))
    lost = (1.0 - scale) - scale * excess
    return scale + scale * excess, lost / angle
