import base64
import html
import json
import os
import re
import webbrowser

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.view.page.html_parts import count_text
from texvent.view.page.writer import PageWriter, show

SIZE = SensorSize(40, 30)
HOSTILE = (
    '</script><script>alert("x")</script> {{data}} &amp; <img src=https://example.org/x> '
    '"><img onerror=alert(1)> \u2028alert(2)'
)


def make_events(count: int, metadata: dict[str, object] | None = None) -> EventStream:
    step = np.arange(count)
    return EventStream(step % 40, step % 30, 1_000 + step * 100, step % 2, SIZE, metadata or {})


@example(999_999)
@example(999_600_000_000)
@given(st.floats(0.0, 14.0).map(lambda one: round(10.0**one)))
def test_a_count_of_any_size_is_written_with_three_digits_and_its_unit(count):
    said = count_text(count)
    figure, _, unit = said.partition(" ")
    shown = float(figure) * {"": 1.0, "k": 1e3, "M": 1e6, "G": 1e9}[unit]
    assert shown == pytest.approx(count, rel=0.05 if count >= 0.9995e12 else 0.005)
    assert ("e+" in figure, unit == "") == (count >= 0.9995e12, not 1000 <= count < 0.9995e12)


def data_of(page: str) -> dict[str, object]:
    found = re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.DOTALL)
    assert found is not None
    data: dict[str, object] = json.loads(found[1])
    return data


def column(data: dict[str, object], name: str, dtype: str) -> np.ndarray:
    return np.frombuffer(base64.b64decode(str(data[name])), dtype)


def test_the_page_holds_the_events_and_the_facts(tmp_path):
    events = make_events(500, {"prompt": "two trees", "seed": 0, "settings": {"alpha": 30}})
    page = show(events, tmp_path / "out.html").read_text("utf-8")
    data = data_of(page)
    assert (data["width"], data["height"], data["count"]) == (40, 30, 500)
    assert (data["start_us"], data["duration_us"]) == (1_000, 49_900)
    np.testing.assert_array_equal(
        column(data, "xy", "<u2").reshape(-1, 2), np.stack([events.x, events.y], axis=1)
    )
    np.testing.assert_array_equal(column(data, "p", "u1"), events.p)
    shares = column(data, "t", "<f4")
    np.testing.assert_allclose(shares * 49_900 + 1_000, events.t, atol=0.01)
    for text in ("two trees", "Seed", "Sensor", "alpha", "pixels · 0.050 s · 500 events",
                 "0.049901 s, from 1,000 µs", "10 k events per second"):  # fmt: skip
        assert text in page
    assert "Shows all 500 events." in page
    assert "500 (50.0% ON)" in page


def test_a_sample_is_announced_with_both_numbers(tmp_path):
    with PageWriter(tmp_path / "out.html", size=SIZE, sample_limit=100) as writer:
        for start in range(0, 1000, 130):
            writer.append(make_events(1000)[start : start + 130])
    page = (tmp_path / "out.html").read_text("utf-8")
    assert "Shows 100 of 1,000 events, drawn uniformly at random" in page
    assert data_of(page)["count"] == 100


def test_nothing_is_asked_of_any_server(tmp_path):
    page = show(make_events(50, {"prompt": "a car"}), tmp_path / "out.html").read_text("utf-8")
    assert not re.search(r"https?:|//[a-z]+\.|@import|url\(|fetch\(|XMLHttp|WebSocket", page)
    assert "default-src 'none'" in page
    assert not re.search(r"\{\{\w+\}\}", page), "every placeholder is filled"


def test_text_from_the_user_stays_text(tmp_path):
    metadata = {"prompt": HOSTILE, HOSTILE: HOSTILE, "nested": {HOSTILE: [HOSTILE]}}
    page = show(make_events(50, metadata), tmp_path / "out.html").read_text("utf-8")
    plain = show(make_events(50, {"prompt": "x"}), tmp_path / "plain.html").read_text("utf-8")
    assert page.count("<script") == plain.count("<script") == 2
    assert "<img src=https" not in page
    assert "<img onerror" not in page
    assert "\u2028" not in str(re.findall(r"<script.*?</script>", page, re.DOTALL))
    assert html.escape(HOSTILE) in page, "a placeholder inside user text is not filled"


def test_no_events_still_give_a_page(tmp_path):
    page = show(EventStream.empty(SIZE), tmp_path / "out.html").read_text("utf-8")
    assert data_of(page)["count"] == 0
    assert "No events." in page


def test_the_rate_curve_is_drawn_without_any_script(tmp_path):
    page = show(make_events(500), tmp_path / "out.html").read_text("utf-8")
    areas = dict(re.findall(r'class="(on|off)-area" d="M0 100V([\d.]+)H', page))
    # ON goes up (smaller y), OFF goes down.
    assert float(areas["on"]) < 100 < float(areas["off"])


def test_without_a_path_the_browser_opens_a_temporary_page(monkeypatch, tmp_path):
    opened: list[str] = []
    monkeypatch.setattr(webbrowser, "open", opened.append)
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr("tempfile.tempdir", None)
    old, foreign = make_events(5).show(), tmp_path / "texvent-view-of-another-kind"
    foreign.write_text("a file")
    for one in (old.parent, foreign):
        os.utime(one, (0, 0))
    page, again = make_events(5).show(), make_events(5).show()
    assert opened == [one.as_uri() for one in (old, page, again)]
    assert [one.exists() for one in (old, foreign, page, again)] == [False, True, True, True]
    assert page.parent.parent == tmp_path
    assert page.parent.stat().st_mode & 0o077 == 0
