from __future__ import annotations

import base64
import html
import re
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from texvent.errors import InputError, OutputError
from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.view.page.comparison import MetricRow, busiest_start, write_comparison

SIZE = SensorSize(40, 30)
HOSTILE = '</script><script>alert("x")</script> "><img src=x onerror=alert(1)> \u2028 {{style}}'
ROW = MetricRow(name="stpp", value="0.5000", unit="1", good="low", blind_to="labels")


def make_events(times: Any, *, column: int = 3, on: int = 1) -> EventStream:
    times = np.asarray(times, np.int64)
    same = np.ones(len(times), np.int64)
    return EventStream(column * same, 5 * same, times, on * same, SIZE)


def images_of(page: str) -> list[np.ndarray]:
    """Dark and light image of each recording."""
    codes = re.findall(r'data:image/png;base64,([^"]+)"', page)
    decoded = [
        cv2.imdecode(np.frombuffer(base64.b64decode(one), np.uint8), cv2.IMREAD_COLOR)
        for one in codes
    ]
    return [one[..., ::-1] for one in decoded if one is not None]


def test_both_images_show_the_busiest_window_of_the_reference(tmp_path: Path) -> None:
    reference = make_events([0, 500_000, 501_000, 502_000, 900_000], column=3)
    guess = make_events([1_000, 510_000, 600_000], column=20, on=0)
    assert busiest_start(reference) == 500_000
    path = write_comparison(tmp_path / "x.html", (("a", guess), ("b", reference)), [ROW])
    page = path.read_text("utf-8")
    assert "3 events, 1 in the image" in page
    assert "5 events, 3 in the image" in page
    dark_guess, light_guess, dark_reference, light_reference = images_of(page)
    for dark, light, column in (
        (dark_guess, light_guess, 20),
        (dark_reference, light_reference, 3),
    ):
        assert light[0, 0].min() == 255
        assert dark[0, 0].max() < 60
        drawn = np.argwhere((light != 255).any(axis=2))
        assert drawn.tolist() == [[5, column]]


def test_rate_curves_share_their_time_and_scale(tmp_path: Path) -> None:
    many = make_events(np.sort(np.tile(np.arange(0, 160_000, 1000), 10)))
    few = make_events(np.arange(0, 160_000, 1000))
    page = write_comparison(tmp_path / "x.html", (("few", few), ("many", many)), []).read_text()
    heights = [float(one) for one in re.findall(r'class="on-area" d="M0 100V([\d.]+)H', page)]
    assert heights[1] == pytest.approx(4, abs=0.1)
    assert 100 - heights[0] == pytest.approx((100 - heights[1]) / 10, rel=0.02)
    assert page.count("0.159 s") + page.count("0.160 s") == 2


def test_the_peak_is_that_of_both_polarities(tmp_path: Path) -> None:
    """It was that of the larger one, which can lie below the mean rate of both."""
    times = np.arange(0, 160_000, 1000)
    ones = np.ones(2 * len(times), np.int64)
    polarity = np.tile([0, 1], len(times))
    even = EventStream(3 * ones, 5 * ones, np.repeat(times, 2), polarity, SIZE)
    page = write_comparison(tmp_path / "x.html", (("a", even), ("b", even)), []).read_text()
    assert page.count("peak 2.01 k events/s") == 2


def test_names_and_metrics_stay_text_and_nothing_is_asked_of_any_server(tmp_path: Path) -> None:
    row = MetricRow(name=HOSTILE, value=HOSTILE, unit=HOSTILE, good=HOSTILE, blind_to=HOSTILE)
    pair = ((HOSTILE, make_events([1, 2])), (HOSTILE, make_events([3])))
    page = write_comparison(tmp_path / "x.html", pair, [row]).read_text("utf-8")
    assert "<script" not in page
    assert "onerror=alert(1)>" not in page
    assert page.count(html.escape(HOSTILE)) >= 8
    assert "script-src" not in page
    assert "default-src 'none'" in page
    assert not re.search(r"https?:|@import|url\(", page)


def test_recordings_without_events_still_give_a_page(tmp_path: Path) -> None:
    none, some = EventStream.empty(SIZE), make_events([7])
    for index, pair in enumerate(((none, none), (some, none), (none, some))):
        named = (("a", pair[0]), ("b", pair[1]))
        assert (
            len(images_of(write_comparison(tmp_path / f"{index}.html", named, []).read_text())) == 4
        )


def test_other_sensors_and_existing_files_are_refused(tmp_path: Path) -> None:
    pair = (("a", make_events([1])), ("b", EventStream.empty(SensorSize(4, 3))))
    with pytest.raises(InputError, match="one size"):
        write_comparison(tmp_path / "x.html", pair, [])
    same = (pair[0], pair[0])
    write_comparison(tmp_path / "x.html", same, [])
    with pytest.raises(OutputError, match="exists already"):
        write_comparison(tmp_path / "x.html", same, [])
