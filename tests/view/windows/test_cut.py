from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.refusals import Call, Refusal, check_refusal

from texvent.errors import ConfigError, InputError, OutputError
from texvent.events import EventStream
from texvent.frames import Frame, Video, frame_time_us
from texvent.ground_truth import Box, GroundTruth
from texvent.sensor import SensorSize
from texvent.view.drawing.canvas import png_bytes
from texvent.view.drawing.panels import (
    ARROW_US,
    BOX_COLOUR,
    FLOW_COLOUR,
    Annotations,
    annotations_at,
)
from texvent.view.windows import (
    EventWindow,
    SourceOverlay,
    cut_counts,
    cut_windows,
    still_window_us,
)

SIZE = SensorSize(4, 4)


def at_times(*times: int) -> EventStream:
    zeros = [0] * len(times)
    return EventStream.from_columns(zeros, zeros, list(times), zeros, size=SIZE)


@given(
    times=st.lists(st.integers(0, 3000), min_size=1, max_size=40).map(sorted),
    cut=st.integers(0, 40),
    step=st.fractions(Fraction(50, 3), 900, max_denominator=7),
    window=st.none() | st.integers(1, 1000),
)
def test_windows_may_overlap_or_leave_gaps_and_count_the_events_in_them(times, cut, step, window):
    parts = [at_times(*times[:cut]), at_times(*times[cut:])]
    found = [
        (one.start_us, one.stop_us, one.event_count)
        for one in cut_windows(parts, step_us=step, window_us=window)
    ]
    starts = [times[0] + round(index * step) for index in range(3000)]
    stops = starts[1:] if window is None else [start + window for start in starts]
    assert found == [
        (start, stop, sum(start <= t < stop for t in times))
        for start, stop in zip(starts, stops, strict=False)
        if start <= times[-1]
    ]


@pytest.mark.parametrize(("span", "window"), [(10**7, 40_000), (500_000, 10_000), (3, 1)])
def test_stills_gather_a_fiftieth_but_at_most_40_ms(span, window):
    assert still_window_us((5, 5 + span)) == window


@pytest.mark.parametrize("packet", [1, 7, 1000])
def test_slices_of_equal_count_hold_that_many_events_and_leave_none_out(packet):
    events = busy_stream()
    parts = (events[start : start + packet] for start in range(0, len(events), packet))
    windows = list(cut_counts(parts, size=events.size, count=60))
    counts = [window.event_count for window in windows]
    assert counts[:-1] == [60] * (len(counts) - 1)
    assert sum(counts) == len(events)
    for before, after in pairwise(windows):
        assert before.stop_us == after.start_us


def busy_stream() -> EventStream:
    """250 events with distinct times on a small sensor, so that pixels fire again and again."""
    step = np.arange(250)
    return EventStream(step * 7 % 8, step * 5 % 6, 100 + step * 61, step // 3 % 2, SensorSize(8, 6))


def cut(*times: int, step_us: int = 1000, window_us: int = 1000) -> Call:
    return lambda _: [
        *cut_windows([at_times(*times)], step_us=Fraction(step_us), window_us=window_us)
    ]


REFUSED: dict[str, Refusal] = {
    "window": (cut(0, window_us=0), ConfigError, "window 0 µs, step 1000 µs; both must be above 0",
               cut(0, window_us=1)),
    "pause": (cut(0, 1_000_000, 19_000_001), InputError,
              "no event from 1 to 19 s: 18,000 images would be empty; show a part (--time START,",
              cut(0, 1_000_000, 19_000_000)),
    "width": (lambda _: png_bytes(np.zeros((1, 1_000_001), np.uint8)), OutputError,
              "an image of shape (1, 1000001) cannot be written as PNG",
              lambda _: png_bytes(np.zeros((1, 1_000_000), np.uint8))),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_windows_and_images_have_limits(name):
    check_refusal(REFUSED[name], None)


SHOWN = SensorSize(48, 32)


class KnownVideo(Video):
    """The left half moves by its place, (x + 1, -y) px; the right half is unknown."""

    def ground_truth(self, t0_us: int, t1_us: int) -> GroundTruth:
        assert t1_us - t0_us == ARROW_US
        flow = np.full((*SHOWN.shape, 2), np.nan, dtype=np.float32)
        y, x = np.mgrid[: SHOWN.height, :24]
        flow[:, :24] = np.stack([x + 1, -y], axis=2)
        unseen = np.zeros(SHOWN.shape, dtype=np.int32)
        car = Box(1, "car", 10, 12, 30, 24, 1.0)
        return GroundTruth(unseen + np.float32(1), unseen, flow, unseen > 0, (car,))


def video(kind: type[Video] = KnownVideo) -> Video:
    pixels = np.stack([np.full(SHOWN.shape, 50 * i, dtype=np.uint8) for i in range(3)])
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
    image = np.zeros((SHOWN.height * 4, SHOWN.width * 4, 3), dtype=np.uint8)
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


class DrawnVideo(KnownVideo):
    """The same frames, each drawn by itself."""

    def at(self, t_us: int) -> Frame:
        return min(self, key=lambda frame: abs(frame.t_us - t_us))

    def from_frame(self, first: int) -> Iterator[Frame]:
        yield from list(self)[first:]


@pytest.mark.parametrize("fps", [Fraction(24), Fraction(30_000, 1001), Fraction(1000)])
def test_drawn_frames_are_shown_as_stored_ones_with_what_was_asked_for(fps: Fraction) -> None:
    times = [frame_time_us(number, fps) for number in range(9)]
    pixels = np.stack([np.full(SHOWN.shape, 20 * i, dtype=np.uint8) for i in range(9)])
    counts = np.zeros((2, *SHOWN.shape), dtype=np.int32)
    instants = sorted(t_us + step for t_us in times for step in (-2, -1, 0, 1))
    shown, during = [], []
    for kind in (KnownVideo, DrawnVideo):
        beside = SourceOverlay(kind(pixels, times, fps), "boxes", size=SHOWN)
        windows = beside.add_frames(EventWindow(t, t + 1, counts) for t in instants)
        shown.append([int(one.image.mean()) for one in windows])
        extents = [None, *((t, end) for t in instants for end in times if end > t >= 0)]
        during.append([[one.t_us for one in beside.frames_during(each)] for each in extents])
    assert shown[0] == shown[1]
    assert during[0] == during[1]
    for step in (1, 5, 11):  # windows are shorter or longer than what a frame is shown for
        seldom = instants[::step]
        beside = SourceOverlay(KnownVideo(pixels, times, fps), "none", size=SHOWN)
        windows = beside.add_frames(EventWindow(t, t + 1, counts) for t in seldom)
        last = [max(sum(t_us <= t for t_us in times) - 1, 0) for t in seldom]
        assert [int(one.image.mean()) for one in windows] == [20 * one for one in last]
    window = EventWindow(0, 1, counts)
    for overlay, boxes in (("none", 0), ("boxes", 1), ("flow", 0)):
        seen = SourceOverlay(video(), overlay, size=SHOWN).add_annotations(window).annotations
        assert len(seen.boxes if seen else ()) == boxes
