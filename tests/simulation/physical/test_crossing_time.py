"""When a decaying change meets a threshold: against a fine search, and equal bits compiled."""

import numpy as np
from hypothesis import example, given
from hypothesis import strategies as st
from tests.examples import examples
from tests.simulation.references.physical import ChangeCurve, change_after, time_to_threshold

from texvent.simulation.kernels.elementary import exponential
from texvent.simulation.physical import crossing_time


def curve_of(change, slope, transient, cutoff, duration) -> ChangeCurve:
    kept = float(exponential(np.float64(-cutoff * duration)))
    return ChangeCurve(change, slope, transient, cutoff, duration, kept)


def first_crossing(curve: ChangeCurve, on: float, off: float) -> float:
    """By looking everywhere."""
    u = np.linspace(0, 1, 200_001) * curve.duration
    change = curve.change + curve.slope * u + curve.transient * (1 - np.exp(-curve.cutoff * u))
    hits = np.flatnonzero((change >= on) | (-change >= off))
    return float(u[hits[0]]) if len(hits) else np.inf


def compiled_times(curves: list[ChangeCurve], on, off):
    rows = np.empty((crossing_time.ROWS, len(on)))
    rows[:8] = (*np.array(curves).T, on, off)
    scratch = np.empty_like(rows), np.empty(len(on), np.int64)
    with np.errstate(all="ignore"):
        crossing_time.find_crossings(rows, *scratch, len(on))
    return rows[crossing_time.WAIT], rows[crossing_time.RISES]


def time_of(curve: ChangeCurve, on=0.2, off=0.2) -> tuple[float, int]:
    return time_to_threshold(curve, on, off)


CURVES = st.builds(
    curve_of,
    st.floats(-0.19, 0.19),
    st.sampled_from([0.0, 1e-9, 1e-6, -3e-5, 2e-4, -1e-2]),
    st.sampled_from([0.0, 1e-8, -1e-3, 0.05, -0.3, 1.7]),
    st.sampled_from([1e-6, 1e-4, 3e-3, 0.05]),
    st.sampled_from([1.0, 700.0, 41_667.0, 1e6]),
)


@examples(200)
@given(CURVES, st.floats(0.05, 0.6))
@example(curve_of(0.0, 1e-6, 1e-8, 1e-4, 1e6), 0.05)
def test_backends_agree_and_find_the_first_crossing(curve, on):
    wait, p = time_of(curve, on)
    # Beside other lanes, on a line and on a curve.
    lanes = [curve_of(0.0, 1e-4, 0.0, 1e-3, 1e4), curve_of(0.1, 1e-5, 0.2, 1e-3, 1e4), curve]
    limits = np.array([0.2, 0.2, on]), np.full(3, 0.2)
    waits, polarities = compiled_times(lanes, *limits)
    assert waits.tolist() == [time_of(one, up)[0] for one, up in zip(lanes, limits[0], strict=True)]
    # A curve may creep up to a threshold and touch it by rounding; small transients are forgotten.
    forgotten = crossing_time.NEGLIGIBLE * min(on, 0.2) + 1e-9
    early, late = (first_crossing(curve, on + d, 0.2 + d) for d in (-forgotten, forgotten))
    assert early - 1e-5 * curve.duration <= wait
    assert wait <= late
    if 0 < wait < np.inf:
        assert polarities[2] == p
        change = change_after(curve, wait, np.exp(-curve.cutoff * wait))
        assert abs(change - (on if p else -0.2)) < 1e-4
