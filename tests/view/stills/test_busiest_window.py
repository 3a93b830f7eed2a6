from fractions import Fraction

import cv2
import numpy as np

from texvent.events import EventStream
from texvent.frames import Frame
from texvent.sensor import SensorSize
from texvent.view.stills import BusiestWindow, find_busiest
from texvent.view.windows import WindowCollector, cut_windows

SIZE = SensorSize(32, 24)


def image_of(png: bytes | None) -> np.ndarray:
    assert png is not None
    return cv2.cvtColor(
        cv2.imdecode(np.frombuffer(png, np.uint8), cv2.IMREAD_COLOR), cv2.COLOR_BGR2RGB
    )


def test_the_interval_with_the_most_events_is_shown_with_its_frame() -> None:
    picker, collector = BusiestWindow(size=SIZE), WindowCollector(SIZE)
    for index, count in enumerate([0, 1, 20, 3]):
        pixels = np.full((*SIZE.shape, 3), 50 * index, dtype=np.uint8)
        rows = np.arange(count)
        times = np.full(count, index * 1000 - 1)
        packet = EventStream(np.full(count, 9), rows, times, np.ones(count, int), SIZE)
        window = collector.append(Frame(pixels, index * 1000), packet)
        if window is not None:
            picker.consider(window)
    image = image_of(picker.png())
    # 20 events lie between frames 1 and 2; the video shows frame 1 during that time.
    assert (image[-5, 5] == 50).all()
    assert (image == (0, 0, 255)).all(axis=2).sum() > 20


def test_a_lone_frame_is_shown_with_no_events() -> None:
    picker = BusiestWindow(size=SIZE)
    assert picker.png() is None
    collector = WindowCollector(SIZE)
    collector.append(Frame(np.full(SIZE.shape, 99, dtype=np.uint8), 0), EventStream.empty(SIZE))
    window = collector.single_frame()
    assert window is not None
    picker.consider(window)
    image = image_of(picker.png())
    assert (image[-5, 5] == 99).all()
    assert (image[-5, -5] == 255).all()


def test_the_busiest_window_is_that_of_all_windows_however_packets_are_cut() -> None:
    rng = np.random.default_rng(0)
    for _ in range(40):
        count = int(rng.integers(1, 60))
        columns = (rng.integers(0, 24, count), rng.integers(0, 24, count))
        times = np.cumsum(rng.choice([0, 1, 3, 50, 500], count))
        events = EventStream(*columns, times, rng.integers(0, 2, count), SIZE)
        cut = int(rng.integers(0, count + 1))
        packets, length = (events[:cut], events[cut:]), int(rng.integers(1, 120))
        windows = cut_windows(packets, step_us=Fraction(length), window_us=length)
        wanted = max(windows, key=lambda window: window.event_count)
        found = find_busiest(packets, length)
        assert found is not None
        assert (found.start_us, found.stop_us) == (wanted.start_us, wanted.stop_us)
        assert np.array_equal(found.counts, wanted.counts)
