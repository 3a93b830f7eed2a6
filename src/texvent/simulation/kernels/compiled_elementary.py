"""The functions of `elementary`, compiled by Numba to be called in kernels: same bits."""

from __future__ import annotations

from texvent.runtime.jit import jit
from texvent.simulation.kernels import elementary

# Without Python's check for division by zero, loops over these fill whole vector registers.
natural_log = jit(error_model="numpy")(elementary.natural_log)
split_exponential = jit(error_model="numpy")(elementary.split_exponential)
cosine_of_turns = jit(error_model="numpy")(elementary.cosine_of_turns)
_LIMIT = elementary.LARGEST_EXPONENT


@jit(error_model="numpy")
def exponential(x: float) -> float:
    """See `elementary.exponential`."""
    scale, excess = split_exponential(min(max(x, -_LIMIT), _LIMIT))
    return float(scale + scale * excess)


@jit(error_model="numpy")
def decay_and_gain(angle: float) -> tuple[float, float]:
    """See `elementary.decay_and_gain`."""
    scale, excess = split_exponential(-min(angle, _LIMIT))
    lost = (1.0 - scale) - scale * excess
    return scale + scale * excess, lost / angle
