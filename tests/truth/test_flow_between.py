from __future__ import annotations

import numpy as np

from texvent.truth.flow_between import FrameFlow


def test_nothing_moves_within_an_instant_the_last_one_too() -> None:
    flow = FrameFlow(np.array([0, 10, 20]), np.ones((2, 3, 4, 2), np.float32))
    for t_us in (0, 5, 20):
        np.testing.assert_array_equal(flow.between(t_us, t_us), np.zeros((2, 3, 4)))
    assert np.isnan(flow.between(21, 21)).all()
