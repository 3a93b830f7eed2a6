"""What values show of themselves in a notebook: small, escaped, nothing consumed."""

import base64
import html
import re
import tracemalloc
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import cv2
import numpy as np
import pytest

import texvent
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.frames import Frame, Video
from texvent.sensor import SensorSize

SIZE = SensorSize(64, 48)
HOSTILE = 'a <script>alert("x")</script> & "car"'
MADE = {
    "prompt": "a red car",
    "generator": "procedural",
    "simulator": "esim",
    "preset": "paper",
    "seed": 41,
    "texvent_version": "9.9",
}


def some_events(count: int = 20_000) -> EventStream:
    index = np.arange(count)
    x, y, p = index * 7 % SIZE.width, index * 13 % SIZE.height, index % 4 == 0
    return EventStream(x, y, index * 50, p.astype(np.uint8), SIZE, MADE)


def html_of(shown: Any) -> str:
    bundle = shown._repr_mimebundle_()
    assert bundle["text/plain"] == repr(shown)
    return str(bundle["text/html"])


def text_of(page: str) -> str:
    """The text that a reader sees, without style."""
    page = re.sub(r"<style>.*?</style>", "", page, flags=re.DOTALL)
    return html.unescape(re.sub(r"<[^>]*>", " ", page))


def image_of(page: str) -> np.ndarray:
    data = base64.b64decode(re.search(r"base64,([^\"]*)", page)[1])
    return cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR)[..., ::-1]


def tags_of(page: str) -> list[str]:
    return re.findall(r"<([a-z]\w*)", page)


def test_events_show_still_rate_and_facts_without_the_network():
    page = html_of(some_events())
    assert [tags_of(page).count(one) for one in ("img", "svg", "script")] == [1, 1, 0]
    assert all(one.startswith("data:") for one in re.findall(r'(?:src|href)="([^"]*)', page))
    assert "://" not in page
    facts = "a red car,20,000 events,64 × 48 pixels,1.000 s,20 k events/s,25.0%,esim,41,9.9"
    for fact in re.split(r",(?!000)", facts):
        assert fact in text_of(page)


def test_the_still_is_the_busiest_window():
    busy = [400_000 + i for i in range(30)]
    t = sorted([0, 100_000, 200_000, 999_999, *busy])
    x = [9 if one in busy else 5 for one in t]
    image = image_of(html_of(EventStream.from_columns(x, [3] * 34, t, [1] * 34, size=SIZE)))
    top = image.shape[0] - 480  # ten pixels for one, below the caption
    assert image[top + 35, 95].tolist() == [0, 0, 255]
    assert image[top + 35, 55].tolist() == [255, 255, 255]


def test_a_display_of_many_events_copies_no_column():
    rng = np.random.default_rng(0)
    x, y, p = (rng.integers(0, side, 2_000_000) for side in (*SIZE, 2))
    events = EventStream(x, y, np.arange(2_000_000), p, SIZE)
    html_of(events)  # what is imported does not count
    tracemalloc.start()
    assert len(html_of(events)) < 300_000
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 12_000_000  # the times alone hold 16 MB


@pytest.mark.parametrize("key", ["prompt", "source", "generator", "simulator", "preset"])
def test_html_of_prompts_and_names_is_escaped(key):
    metadata = {**MADE, key: HOSTILE}
    video = Video(np.zeros((2, 4, 4), np.uint8), [0, 1], metadata=metadata)
    packets = EventPackets([some_events()], SIZE, metadata)
    for shown in (some_events().with_metadata(metadata), packets, video):
        assert "script" not in tags_of(html_of(shown))


def test_a_terminal_and_those_who_want_text_get_text_alone():
    events = some_events(10)
    assert set(events._repr_mimebundle_(include={"text/plain"})) == {"text/plain"}
    assert set(events._repr_mimebundle_(exclude={"text/html"})) == {"text/plain"}


def test_packets_are_not_read():
    packets = EventPackets(iter([some_events(10)]), SIZE, MADE)
    assert "a red car" in text_of(html_of(packets))
    assert len(packets.collect()) == 10
    simulated = texvent.simulate(np.zeros((3, 48, 64), np.uint8), fps=100, as_packets=True)
    assert "64 × 48 pixels" in text_of(html_of(simulated))


def test_a_frame_shows_its_pixels_and_time():
    pixels = np.full((6, 8, 3), (200, 100, 50), np.uint8)
    page = html_of(Frame(pixels, 1_500_000))
    np.testing.assert_allclose(image_of(page)[2, 3], (200, 100, 50), atol=3)
    assert "1.500 s" in text_of(page)


def test_a_video_shows_four_frames_of_all():
    pixels = np.stack([np.full((16, 16), 20 * i, np.uint8) for i in range(10)])
    page = html_of(Video(pixels, [i * 1000 for i in range(10)], Fraction(1000)))
    shown = image_of(page)
    assert shown.shape == (16, 4 * 16 + 3 * 2, 3)
    np.testing.assert_allclose(shown[4, [4, 24, 40, 60], 0], (0, 60, 120, 180), atol=8)
    assert "0.000, 0.003, 0.006, 0.009 s" in text_of(page)
    assert "0.010 s" in text_of(page)


def test_a_live_stream_loses_no_frame():
    def frames() -> Iterator[np.ndarray]:
        for level in (10, 20, 30):
            yield np.full((6, 8), level, np.uint8)

    stream = open_frames(frames(), CaptureConfig(fps=Fraction(100)))
    html_of(stream)
    assert [int(one.pixels[0, 0]) for one in stream] == [10, 20, 30]


@pytest.mark.parametrize("source", ["/films/a.mp4", {"source": "/films/a.mp4", "kind": "file"}])
def test_the_source_is_named_without_its_folder(source):
    shown = text_of(html_of(some_events().with_metadata({"source": source})))
    assert re.search(r"Source\s+a\.mp4", shown)


@pytest.mark.parametrize(("count", "width"), [(1, 480), (2, 2 * 240 + 2), (9, 4 * 240 + 6)])
def test_frames_of_a_video_stand_side_by_side_in_half_the_size_of_one(count, width):
    pixels = np.zeros((max(count, 2), 600, 960), np.uint8)
    video = Video(pixels, range(len(pixels)))
    image = image_of(html_of(video[0] if count == 1 else video))
    assert image.shape[:2] == (300 if count == 1 else 150, width)
