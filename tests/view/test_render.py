from fractions import Fraction
from pathlib import Path
from typing import Literal

import av
import cv2
import numpy as np
import pytest

from texvent.errors import ConfigError, InputError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.frames import Video
from texvent.sensor import SensorSize
from texvent.view.render import RenderConfig, render_events
from texvent.view.video_writer import VideoWriter

SIZE = SensorSize(32, 24)


def moving_dot(seconds: float = 0.5) -> EventStream:
    t = np.arange(0, int(seconds * 1e6), 500)
    return EventStream(t // 20_000 % 32, t // 500 % 24, t + 7, t // 500 % 2, SIZE)


def video_times(path: Path) -> list[int]:
    with av.open(str(path)) as video:
        return [round(one.pts * one.time_base * 1_000_000) for one in video.decode(video=0)]


def test_a_video_shows_all_events_at_the_asked_rate(tmp_path):
    path = render_events(
        moving_dot(), tmp_path / "out.mp4", config=RenderConfig(render_fps=Fraction(24))
    )
    assert video_times(path) == [round(index * 1_000_000 / 24) for index in range(12)]


@pytest.mark.parametrize(("fps", "speed"), [(30, 1.0), (24, 0.1), (Fraction(30_000, 1001), 3.0)])
def test_without_a_window_a_video_shows_every_event_once(tmp_path, monkeypatch, fps, speed):
    shown, every_us = [], np.arange(0, 500_000, 7)
    events = EventStream(every_us % 32, every_us % 24, every_us, every_us % 2, SIZE)
    monkeypatch.setattr(
        VideoWriter, "show", lambda _, window, **__: shown.append(window.event_count)
    )
    config = RenderConfig(render_fps=Fraction(fps), speed=speed)
    with pytest.raises(InputError):  # nothing was written
        render_events(events, tmp_path / "out.mp4", config=config)
    assert sum(shown) == len(events)


def test_slow_motion_gives_proportionally_more_images(tmp_path):
    path = render_events(moving_dot(), tmp_path / "out.mp4", config=RenderConfig(speed=0.25))
    assert len(video_times(path)) == 60


@pytest.mark.parametrize("count", [None, 180])
def test_an_image_shows_the_busiest_window(tmp_path, count):
    quiet, busy = moving_dot(0.18), moving_dot(0.01)
    burst = EventStream(
        np.repeat(busy.x, 9), np.repeat(busy.y, 9), np.repeat(busy.t, 9), np.ones(180, int), SIZE
    )
    later = EventStream(burst.x, burst.y, burst.t + 400_000, burst.p, SIZE)
    config = RenderConfig(events_per_image=count)
    path = render_events(EventPackets([quiet, later], SIZE), tmp_path / "out.png", config=config)
    image = cv2.imread(str(path))
    # ON is blue; OpenCV's order is blue, green, red.
    assert (image == (255, 0, 0)).all(axis=2).sum() > 100
    legend_only = (image == (0, 0, 255)).all(axis=2).sum()
    assert legend_only < 400, "the burst has no OFF event, so red is in the legend alone"


@pytest.mark.parametrize("extension", [".mp4", ".gif", ".png"])
def test_no_events_are_an_input_error(tmp_path, extension, folder_is_clean):
    with pytest.raises(InputError, match="holds no events"):
        render_events(EventStream.empty(SIZE), tmp_path / f"out{extension}")
    assert folder_is_clean()


@pytest.mark.parametrize("extension", [".mp4", ".gif", ".png", ".html"])
def test_one_event_can_be_shown_in_every_way(tmp_path, extension):
    event = EventStream.from_columns([3], [4], [10**12], [1], size=SIZE)
    path = render_events(event, tmp_path / f"out{extension}")
    assert path.stat().st_size > 300


@pytest.mark.parametrize("extension", [".mp4", ".png"])
def test_the_video_is_shown_on_the_left(tmp_path, extension):
    green = np.zeros((3, *SIZE.shape, 3), dtype=np.uint8)
    green[..., 1] = 200
    path = render_events(
        moving_dot(),
        tmp_path / f"out{extension}",
        frames=Video(green, [0, 100_000, 200_000]),
    )
    if extension == ".mp4":
        with av.open(str(path)) as video:
            image = next(video.decode(video=0)).to_ndarray(format="bgr24")
    else:
        image = cv2.imread(str(path))
    is_green = (image[..., 1] > 180) & (image[..., [0, 2]].max(axis=2) < 30)
    assert 0.3 < is_green.mean() < 0.5


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"palette": "sepia"}, "unknown palette"),
        ({"show": "depth"}, "show is 'depth'"),
    ],
)
def test_options_of_no_choice_are_refused(options, message):
    with pytest.raises(ConfigError, match=message):
        RenderConfig(**options)


def moving_stripes() -> EventStream:
    """Stripes that move right by 200 px/s, with a pause of 70 ms."""
    t = np.arange(0, 200_000, 100)
    t = t[(t < 80_000) | (t > 150_000)]
    y, t = np.tile(np.arange(24), len(t)), np.repeat(t, 24)
    return EventStream((t // 5000 + 9 * (y // 8)) % 32, y, t, t // 100 % 2, SIZE)


@pytest.mark.parametrize("show", ["warped", "flow"])
@pytest.mark.parametrize("extension", [".png", ".mp4", ".gif"])
def test_motion_is_shown_in_place_of_the_events(tmp_path, extension, show):
    kinds: tuple[Literal["events"], Literal["warped", "flow"]] = ("events", show)
    plain, path = (
        render_events(
            moving_stripes(),
            tmp_path / f"{one}{extension}",
            config=RenderConfig(show=one, window=40, patch=24),
        )
        for one in kinds
    )
    assert path.read_bytes() != plain.read_bytes()
    if extension != ".png":
        assert video_times(path) == video_times(plain)
        return
    image, before = (cv2.imread(str(one)).astype(int) for one in (path, plain))
    coloured, was = (np.count_nonzero(np.ptp(one, axis=2) > 60) for one in (image, before))
    assert coloured < was / 2 if show == "warped" else coloured > 2 * was


def test_a_page_cannot_show_motion(tmp_path, folder_is_clean):
    with pytest.raises(ConfigError, match=r"show is flow; a page shows events: render to \.mp4"):
        render_events(moving_stripes(), tmp_path / "out.html", config=RenderConfig(show="flow"))
    assert folder_is_clean()
