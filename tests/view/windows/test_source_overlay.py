from collections.abc import Iterator
from fractions import Fraction

import numpy as np
import pytest

from texvent.frames import Frame, Video, frame_time_us
from texvent.ground_truth import Box, GroundTruth
from texvent.sensor import SensorSize
from texvent.view.drawing.panels import (
    ARROW_US,
    BOX_COLOUR,
    FLOW_COLOUR,
    Annotations,
    annotations_at,
)
from texvent.view.windows import EventWindow, SourceOverlay

SIZE = SensorSize(48, 32)


class KnownVideo(Video):
    """The left half moves by its place, (x + 1, -y) px; the right half is unknown."""

    def ground_truth(self, t0_us: int, t1_us: int) -> GroundTruth:
        assert t1_us - t0_us == ARROW_US
        flow = np.full((*SIZE.shape, 2), np.nan, dtype=np.float32)
        y, x = np.mgrid[: SIZE.height, :24]
        flow[:, :24] = np.stack([x + 1, -y], axis=2)
        unseen = np.zeros(SIZE.shape, dtype=np.int32)
        car = Box(1, "car", 10, 12, 30, 24, 1.0)
        return GroundTruth(unseen + np.float32(1), unseen, flow, unseen > 0, (car,))


def video(kind: type[Video] = KnownVideo) -> Video:
    pixels = np.stack([np.full(SIZE.shape, 50 * i, dtype=np.uint8) for i in range(3)])
    return kind(pixels, [0, 10_000, 20_000])


def is_painted(image: np.ndarray, colour: tuple[int, int, int]) -> np.ndarray:
    return (image == colour).all(axis=2)


def test_arrows_stand_where_motion_is_known_and_show_it() -> None:
    arrows = annotations_at(video(), 0, "flow").arrows
    assert arrows is not None
    assert len(arrows) > 10
    assert (arrows[:, 0] < 24).all()
    np.testing.assert_array_equal(arrows[:, 2:], (arrows[:, :2] - 0.5) * [1, -1] + [1, 0])


@pytest.mark.parametrize(("overlay", "boxes", "arrows"), [("boxes", 1, 0), ("flow", 0, 1)])
def test_only_what_was_asked_for_is_marked(overlay, boxes: int, arrows: int) -> None:
    annotations = annotations_at(video(), 0, overlay)
    assert len(annotations.boxes) == boxes
    assert (annotations.arrows is not None) == arrows


def test_a_box_is_drawn_around_its_pixels_at_any_enlargement() -> None:
    image = np.zeros((SIZE.height * 4, SIZE.width * 4, 3), dtype=np.uint8)
    annotations_at(video(), 0, "boxes").draw(image, 4)
    rows, columns = np.nonzero(is_painted(image, BOX_COLOUR))
    assert (columns.min(), rows.max()) == pytest.approx((40, 95), abs=2)
    assert columns.max() == pytest.approx(119, abs=2)
    assert not is_painted(image, BOX_COLOUR)[60:80, 60:80].any(), "hollow"


def test_an_arrow_is_drawn_from_its_tail_along_the_motion() -> None:
    image = np.zeros((64, 64, 3), dtype=np.uint8)
    Annotations(arrows=np.array([[2, 8, 10, 0]], dtype=np.float32)).draw(image, 4)
    _, columns = np.nonzero(is_painted(image, FLOW_COLOUR))
    assert (columns.min(), columns.max()) == pytest.approx((8, 48), abs=2)


def test_each_interval_gets_the_frame_that_was_on_show_when_it_began() -> None:
    counts = np.zeros((2, *SIZE.shape), dtype=np.int32)
    starts = [-5, 0, 9_999, 10_000, 25_000]
    beside = SourceOverlay(video(), "none", size=SIZE)
    shown = beside.add_frames(EventWindow(t, t + 1, counts) for t in starts)
    assert [int(one.image.mean()) for one in shown] == [0, 0, 0, 50, 100]


@pytest.mark.parametrize(
    ("extent", "times"),
    [
        (None, [0, 100_000, 200_000]),
        ((150_000, 160_000), [100_000]),
        ((100_000, 200_000), [100_000]),
        ((50_000, 200_001), [0, 100_000, 200_000]),
        ((900_000, 999_000), [200_000]),
    ],
)
def test_a_page_holds_the_frames_that_are_on_during_its_events(extent, times) -> None:
    pixels = np.zeros((3, *SIZE.shape, 3), dtype=np.uint8)
    beside = SourceOverlay(Video(pixels, [0, 100_000, 200_000]), "none", size=SIZE)
    assert [frame.t_us for frame in beside.frames_during(extent)] == times


class DrawnVideo(KnownVideo):
    """The same frames, each drawn by itself."""

    def at(self, t_us: int) -> Frame:
        return min(self, key=lambda frame: abs(frame.t_us - t_us))

    def from_frame(self, first: int) -> Iterator[Frame]:
        yield from list(self)[first:]


@pytest.mark.parametrize("fps", [Fraction(24), Fraction(30_000, 1001), Fraction(1000)])
def test_drawn_frames_are_shown_as_stored_ones_with_what_was_asked_for(fps: Fraction) -> None:
    times = [frame_time_us(number, fps) for number in range(9)]
    pixels = np.stack([np.full(SIZE.shape, 20 * i, dtype=np.uint8) for i in range(9)])
    counts = np.zeros((2, *SIZE.shape), dtype=np.int32)
    instants = sorted(t_us + step for t_us in times for step in (-2, -1, 0, 1))
    shown, during = [], []
    for kind in (KnownVideo, DrawnVideo):
        beside = SourceOverlay(kind(pixels, times, fps), "boxes", size=SIZE)
        windows = beside.add_frames(EventWindow(t, t + 1, counts) for t in instants)
        shown.append([int(one.image.mean()) for one in windows])
        extents = [None, *((t, end) for t in instants for end in times if end > t >= 0)]
        during.append([[one.t_us for one in beside.frames_during(each)] for each in extents])
    assert shown[0] == shown[1]
    assert during[0] == during[1]
    window = EventWindow(0, 1, counts)
    for overlay, boxes in (("none", 0), ("boxes", 1), ("flow", 0)):
        seen = SourceOverlay(video(), overlay, size=SIZE).add_annotations(window).annotations
        assert len(seen.boxes if seen else ()) == boxes
