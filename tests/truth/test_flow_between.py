import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from texvent.truth.flow_between import FrameFlow


def test_nothing_moves_within_an_instant_the_last_one_too() -> None:
    flow = FrameFlow(np.array([0, 10, 20]), np.ones((2, 3, 4, 2), np.float32))
    for t_us in (0, 5, 20):
        np.testing.assert_array_equal(flow.between(t_us, t_us), np.zeros((2, 3, 4)))
    assert np.isnan(flow.between(21, 21)).all()


@given(
    seed=st.integers(0, 999),
    ends=st.tuples(st.integers(0, 3), st.integers(0, 3)).map(sorted),
    hides=st.booleans(),
)
def test_whole_steps_are_followed_pixel_by_pixel_until_something_hides_them(seed, ends, hides):
    rng, shape, (first, last) = np.random.default_rng(seed), (5, 6), ends
    times_us = np.array([-7, 10, 21, 40])
    flow = rng.integers(-1, 2, (3, *shape, 2)).astype(np.float32)
    hidden = rng.random((3, *shape)) < 0.2
    found = FrameFlow(times_us, flow, hidden if hides else None).between(
        int(times_us[first]), int(times_us[last])
    )
    for y, x in np.ndindex(shape):
        place, total = np.array([x, y]), np.zeros(2)
        for step in range(first, last):
            if not (0 <= place[0] < shape[1] and 0 <= place[1] < shape[0]):
                total = np.full(2, np.nan)
                break
            column, row = place
            place = place + flow[step, row, column].astype(int)
            total = place - [x, y]
            if hides and hidden[step, row, column]:
                place = np.array([-1, -1])  # what is seen there later is another thing
        np.testing.assert_array_equal(found[:, y, x], total)
