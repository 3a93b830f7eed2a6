"""What values show of themselves in a notebook: small, escaped, nothing consumed."""

from __future__ import annotations

import base64
import html
import json
import re
import tracemalloc
from collections.abc import Iterator
from fractions import Fraction
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

import texvent
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.video import Frame, Video
from texvent.view.notebook.displays import busiest_range, shrink_counts
from texvent.view.page.sample import rate_counts

SIZE = SensorSize(64, 48)
MAX_BYTES = 300_000
HOSTILE = 'a <script>alert("x")</script> & "car"'
MADE = {
    "prompt": "a red car",
    "generator": "procedural",
    "simulator": "esim",
    "preset": "paper",
    "seed": 41,
    "texvent_version": "9.9",
}


def some_events(count: int = 20_000, size: SensorSize = SIZE) -> EventStream:
    index = np.arange(count)
    x, y, p = index * 7 % size.width, index * 13 % size.height, index % 4 == 0
    return EventStream(x, y, index * 50, p.astype(np.uint8), size, MADE)


def noise(count: int, size: SensorSize) -> EventStream:
    """The worst for an image's size: no two pixels are alike."""
    rng = np.random.default_rng(0)
    x, y = rng.integers(0, size.width, count), rng.integers(0, size.height, count)
    t = np.sort(rng.integers(0, 10**6, count))
    return EventStream(x, y, t, rng.integers(0, 2, count), size, MADE)


def html_of(shown: Any) -> str:
    bundle = shown._repr_mimebundle_()
    assert bundle["text/plain"] == repr(shown)
    return str(bundle["text/html"])


def text_of(page: str) -> str:
    """The text that a reader sees, without frames and style."""
    page = re.sub(r"<style>.*?</style>|<iframe.*?</iframe>", "", page, flags=re.DOTALL)
    return html.unescape(re.sub(r"<[^>]*>", " ", page))


class Tags(HTMLParser):
    """Names of the tags of a page, and addresses in it."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.names: list[str] = []
        self.addresses: list[str] = []
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.names.append(tag)
        self.addresses += [value or "" for name, value in attrs if name in ("src", "href")]


def test_events_show_still_cloud_rate_and_facts():
    page = html_of(some_events())
    names = Tags(page).names
    assert [names.count(one) for one in ("img", "iframe", "svg", "script")] == [2, 1, 1, 0]
    seen = text_of(page)
    for fact in (
        "a red car",
        "20,000 events",
        "64 × 48 pixels",
        "1.000 s",
        "20 k events/s",
        "25.0%",
        "procedural",
        "esim, preset paper",
        "41",
        "9.9",
    ):
        assert fact in seen


def test_nothing_is_asked_of_the_network():
    page = html_of(some_events())
    frame = html.unescape(re.search(r'srcdoc="([^"]*)"', page)[1])
    for text in (page, frame):
        assert all(one.startswith("data:") for one in Tags(text).addresses)
        assert "://" not in text


def test_the_still_is_the_busiest_window_in_the_palettes_colours():
    quiet = [[0, 100_000, 200_000, 999_999], [5, 5, 5, 5]]
    busy_us = [400_000 + i for i in range(30)]
    t = sorted(quiet[0] + busy_us)
    x = [9 if one in busy_us else 5 for one in t]
    events = EventStream.from_columns(x, [3] * 34, t, [1] * 34, size=SIZE)
    assert busiest_range(events) == (400_000, 420_000)
    sources = re.findall(
        r'<img class="(light|dark)".*?src="data:image/png;base64,([^"]*)"', html_of(events)
    )
    light, dark = (
        cv2.imdecode(np.frombuffer(base64.b64decode(data), np.uint8), cv2.IMREAD_COLOR)[..., ::-1]
        for _, data in sources
    )
    assert light.shape == dark.shape == (48, 64, 3)
    assert light[3, 9].tolist() == [0, 0, 255]
    assert light[3, 5].tolist() == [255, 255, 255]
    assert dark[3, 5].tolist() == [20, 22, 26]
    assert dark[3, 9].sum() > 400  # lighter blue, legible on black


def test_blocks_of_pixels_are_summed():
    counts = np.arange(2 * 3 * 5, dtype=np.int32).reshape(2, 3, 5)
    small = shrink_counts(counts, 2)
    assert small.shape == (2, 2, 3)
    assert small[0].tolist() == [[0 + 1 + 5 + 6, 2 + 3 + 7 + 8, 4 + 9], [10 + 11, 12 + 13, 14]]


def test_rate_counts_by_hand():
    t, p = [10, 11, 19, 20, 39], [1, 0, 1, 1, 0]
    events = EventStream.from_columns([0] * 5, [0] * 5, t, p, size=SIZE)
    assert rate_counts(events, (10, 40), 3).tolist() == [[1, 0, 1], [2, 1, 0]]
    assert rate_counts(events, (10, 20), 1).tolist() == [[1], [2]]
    assert rate_counts(events, (8, 11), 187).sum() == 1  # 187 · (3 / 187) is above 3
    assert rate_counts(EventStream.empty(SIZE), (0, 1), 1).tolist() == [[0], [0]]


@pytest.mark.parametrize(
    "events",
    [
        noise(200_000, SensorSize(1280, 720)),
        noise(400_000, SensorSize(480, 360)),
        noise(100_000, SensorSize(5000, 2)),
        some_events(1),
    ],
    ids=["hd", "fine", "line", "one"],
)
def test_a_display_is_small(events):
    assert len(html_of(events)) < MAX_BYTES


def test_a_display_of_many_events_copies_no_column():
    events = noise(2_000_000, SIZE)
    html_of(events)  # what is imported does not count
    tracemalloc.start()
    html_of(events)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 4_000_000  # the times alone hold 16 MB


@pytest.mark.parametrize("key", ["prompt", "source", "generator", "simulator", "preset"])
def test_html_of_prompts_and_names_is_escaped(key):
    metadata = {**MADE, key: HOSTILE}
    video = Video(np.zeros((2, 4, 4), np.uint8), [0, 1], metadata=metadata)
    for shown in (
        some_events().with_metadata(metadata),
        EventPackets([some_events()], SIZE, metadata),
        video,
    ):
        page = html_of(shown)
        assert "alert(" not in re.sub(r"&lt;script&gt;alert\(", "", page)
        assert "script" not in Tags(page).names


def test_a_terminal_and_those_who_want_text_get_text_alone():
    events = some_events(10)
    assert set(events._repr_mimebundle_(include={"text/plain"})) == {"text/plain"}
    assert set(events._repr_mimebundle_(exclude={"text/html"})) == {"text/plain"}


def test_packets_of_a_generator_are_not_consumed():
    packets = EventPackets(iter([some_events(10)]), SIZE, MADE)
    assert "a red car" in text_of(html_of(packets))
    assert len(packets.collect()) == 10


def test_packets_that_are_made_when_asked_for_are_not_made():
    def make() -> Iterator[EventStream]:
        raise AssertionError("a display must not simulate")
        yield

    frames = np.zeros((3, 48, 64), np.uint8)
    packets = texvent.simulate(frames, fps=100, as_packets=True)
    assert "64 × 48 pixels" in text_of(html_of(packets))
    assert "not read through" in text_of(html_of(EventPackets(make(), SIZE)))


def test_a_damaged_file_still_displays(tmp_path: Path):
    path = some_events().save(tmp_path / "out.h5")
    packets = texvent.open(path)
    path.write_bytes(b"")
    assert "EventPackets" in text_of(html_of(packets))


def test_a_frame_shows_its_pixels_and_time():
    pixels = np.zeros((6, 8, 3), np.uint8)
    pixels[2, 3] = (200, 100, 50)
    page = html_of(Frame(pixels, 1_500_000))
    png = base64.b64decode(re.search(r"base64,([^\"]*)", page)[1])
    shown = cv2.imdecode(np.frombuffer(png, np.uint8), cv2.IMREAD_COLOR)
    assert shown[2, 3].tolist() == [50, 100, 200]
    assert "1.500000 s" in text_of(page)


def test_a_video_shows_four_frames_of_all():
    pixels = np.stack([np.full((6, 8), 20 * i, np.uint8) for i in range(10)])
    page = html_of(Video(pixels, [i * 1000 for i in range(10)], Fraction(1000)))
    png = base64.b64decode(re.search(r"base64,([^\"]*)", page)[1])
    shown = cv2.imdecode(np.frombuffer(png, np.uint8), cv2.IMREAD_GRAYSCALE)
    assert shown.shape == (6, 4 * 8 + 3 * 2)
    assert shown[0, [0, 10, 20, 30]].tolist() == [0, 60, 120, 180]
    assert "0.000, 0.003, 0.006, 0.009 s" in text_of(page)


def test_a_live_stream_loses_no_frame():
    def frames() -> Iterator[np.ndarray]:
        for level in (10, 20, 30):
            yield np.full((6, 8), level, np.uint8)

    stream = open_frames(frames(), CaptureConfig(fps=Fraction(100)))
    assert stream.is_live
    assert "no frame was taken" in text_of(html_of(stream))
    assert [int(one.pixels[0, 0]) for one in stream] == [10, 20, 30]


def test_a_folder_of_images_shows_its_first_frame_and_gives_all_afterwards(tmp_path: Path):
    for i in range(3):
        cv2.imwrite(str(tmp_path / f"{i}.png"), np.full((6, 8), 50 * i, np.uint8))
    frames = open_frames(tmp_path, CaptureConfig(fps=Fraction(100)))
    page = html_of(frames)
    assert "Frame at 0.000 s" in text_of(page)
    assert Tags(page).names.count("img") == 1
    assert [int(one.pixels[0, 0]) for one in frames] == [0, 50, 100]


def test_the_cloud_holds_the_events_in_their_places():
    events = EventStream.from_columns([3, 7], [1, 2], [100, 300], [1, 0], size=SIZE)
    frame = html.unescape(re.search(r'srcdoc="([^"]*)"', html_of(events))[1])
    data = json.loads(re.search(r'id="data">(.*?)</script>', frame)[1])
    assert np.frombuffer(base64.b64decode(data["xy"]), "<u2").tolist() == [3, 1, 7, 2]
    assert np.frombuffer(base64.b64decode(data["t"]), "<f4").tolist() == [0, 1]
    assert list(base64.b64decode(data["p"])) == [1, 0]
    assert (data["width"], data["height"], data["duration_us"]) == (64, 48, 200)
