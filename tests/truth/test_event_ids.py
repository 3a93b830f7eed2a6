"""Which object an event shows: by hand, pixel by pixel."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.events import EventStream
from texvent.frames import MotionVectors
from texvent.sensor import SensorSize
from texvent.truth.event_ids import FrameSpan, ids_of_frames, ids_of_scene, moved_ids
from texvent.truth.source import Snapshot
from texvent_scenes.procedural import ProceduralConfig, ProceduralVideo
from texvent_scenes.rendered_scene import Shape

from ..scenes.hand_scenes import HandScene, MovingShape, moving, still
from .hand_video import FPS, SIZE, board_video, level

SMALL = SensorSize(8, 1)


def events_at(columns, row=0, size=SMALL, t=0):
    zeros = np.zeros(len(columns), int)
    return EventStream.from_columns(columns, zeros + row, zeros + t, zeros, size=size)


def snapshot(t_us, ids, depth=None, flow_x=None):
    flow = None if flow_x is None else np.stack([[flow_x], np.zeros((1, 8))], axis=2)
    motion = MotionVectors(
        None if flow is None else flow.astype(np.float32),
        depth=None if depth is None else np.array([depth], np.float32),
        instance=np.array([ids], np.int32),
    )
    return Snapshot(t_us, motion, {})


def test_an_event_of_a_scene_is_what_its_pixel_touches_at_either_instant():
    video = board_video()
    # At 0 the board's front covers columns 40 - 80 · 2 / 7.5 = 18.67 to 40; at 40 ms 1.28 px more.
    every_column = FrameSpan(0, 40_000, events_at(range(80), 25, SIZE))
    found = ids_of_scene(video, every_column)
    assert np.flatnonzero(found == 3).tolist() == list(range(18, 42))
    assert set(found) == {0, 3}


INSTANT = st.lists(st.tuples(st.integers(0, 2), st.integers(1, 9)), min_size=8, max_size=8)
"""Id and depth of eight pixels."""


@given(INSTANT, INSTANT, st.sampled_from([0, -7, 10**7]))
def test_an_event_shows_the_nearest_object_of_both_instants(first, second, began):
    before = snapshot(began, *zip(*first, strict=True))
    after = snapshot(began + 9, *zip(*second, strict=True))
    found = ids_of_frames(before, after, FrameSpan(began, began + 9, events_at(range(8))))
    for one, *seen in zip(found.tolist(), first, second, strict=True):
        objects = [(depth, number) for number, depth in seen if number]
        assert one == min(objects, key=lambda pair: pair[0], default=(0, 0))[1]


@pytest.mark.parametrize("gone_first", [True, False])
def test_of_two_objects_of_a_scene_seen_one_after_the_other_the_nearer_one_counts(gone_first):
    """A near board moves off a far one, or before it; each pixel sees one at each instant."""
    way = 15.0 * (1 if gone_first else -1)
    near = moving((0.0 if gone_first else 0.6, 0.0, 1.5), (way, 0.0, 0.0))
    boards = (
        MovingShape(Shape.BOX, (0.5, 0.1, 1.0), near, instance=3),
        MovingShape(Shape.BOX, (9.0, 0.1, 5.0), still(0.0, 4.0, 1.5), instance=4),
    )
    video = ProceduralVideo(HandScene(boards, level), SIZE, ProceduralConfig(fps=FPS, duration=0.1))
    found = ids_of_scene(video, FrameSpan(0, 40_000, events_at(range(80), 25, SIZE)))
    # 0.5 m either side of 0, then of 0.6 m, 7.9 m away, at a focal length of 80 px.
    assert np.flatnonzero(found == 3).tolist() == list(range(34, 52))
    assert set(found) == {3, 4}


def test_ids_move_along_their_vectors_and_near_ones_cover_far_ones():
    before = snapshot(
        0, [1, 1, 0, 0, 0, 0, 2, 2], [2, 2, 9, 9, 9, 9, 5, 5], [4, 4, 0, 0, 0, 0, -4, -4]
    )
    after = snapshot(1000, [0, 0, 2, 2, 1, 1, 0, 0], [9, 9, 5, 5, 2, 2, 9, 9])
    half, depth = moved_ids(before, after, 0.5)
    assert half.tolist() == [[0, 0, 1, 1, 2, 2, 0, 0]]
    assert depth[0, 2:6].tolist() == [2, 2, 5, 5]
    met, _ = moved_ids(before, after, 0.75)
    assert met.tolist() == [[0, 0, 0, 1, 1, 0, 0, 0]]


@pytest.mark.parametrize("began", [0, -700, 10**9])
def test_between_frames_ids_are_those_of_the_share_of_the_time_that_has_gone(began):
    for flow in (None, [0] * 8):  # without vectors, the closer frame counts
        before, after = snapshot(began, [1] * 8, flow_x=flow), snapshot(began + 1000, [2] * 8)
        for start, stop, seen in ((0, 400, 1), (600, 1000, 2), (600, 999, 2), (-200, 499, 1)):
            span = FrameSpan(began + start, began + stop, events_at([3]))
            assert ids_of_frames(before, after, span).tolist() == [seen if flow is None else 1]
    before = snapshot(began, [1] + [0] * 7, [2] + [9] * 7, [7] + [0] * 7)
    after = snapshot(began + 700, [0] * 7 + [1], [9] * 7 + [2])
    for at in range(8):
        span = FrameSpan(began + 100 * at, began + 100 * at, events_at(range(8)))
        found = ids_of_frames(before, after, span)
        assert np.flatnonzero(found).tolist() == [at]
