from __future__ import annotations

import cv2
import numpy as np

from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.video import Frame
from texvent.view.stills.busiest_window import BusiestWindow
from texvent.view.windows.event_window import WindowCollector

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
