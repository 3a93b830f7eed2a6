"""Refusals of voxel grids."""

import numpy as np
import pytest

from texvent.errors import InputError
from texvent.events import EventStream
from texvent.represent.voxel_grid import voxel_dsec, voxel_zhu

from .definitions import SMALL


def test_a_rectify_map_of_another_size_or_with_nan_is_refused():
    with pytest.raises(InputError, match=r"shape \[4, 3, 2\]; a 4x3 sensor needs \[3, 4, 2\]"):
        voxel_dsec(EventStream.empty(SMALL), rectify_map=np.zeros((4, 3, 2)))
    with pytest.raises(InputError, match="every pixel needs a finite place"):
        voxel_dsec(EventStream.empty(SMALL), rectify_map=np.full((3, 4, 2), np.nan))


def test_a_sum_that_could_overflow_is_refused():
    events = EventStream([0, 0], [0, 0], [0, 2**62], [1, 1], SMALL)
    with pytest.raises(InputError, match="too much for one voxel grid"):
        voxel_zhu(events)
