"""Live events: the newest frame counts, recordings are whole, the page asks and leaves."""

from __future__ import annotations

import contextlib
import json
import queue
import signal
import sys
import time
import urllib.error
import urllib.request
from pathlib import Path

import numpy as np
import pytest
from tests.cli.running import refused

import texvent
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import ConfigError, InputError, OutputError
from texvent.sensor import SensorSize
from texvent.video import Frame
from texvent.web.live import LiveEvents
from texvent.web.live_page import GRACE_S, LiveServer
from texvent.web.newest_frames import NewestFrames

CLIP = Path(__file__).parents[1] / "clips" / "bigbuckbunny_excerpt.mp4"
FRAMES = np.random.default_rng(3).integers(0, 256, (6, 12, 16), dtype=np.uint8)


class Fed:
    """Live source of the frames that a test feeds, 10 ms apart."""

    size, fps, frame_count, is_live, metadata = SensorSize(16, 12), None, None, True, {}

    def __init__(self):
        self.waiting = queue.Queue()

    def feed(self, *numbers):
        for number in numbers:
            frame = None if number is None else Frame(FRAMES[number], 10_000 * number)
            self.waiting.put(frame)

    def __iter__(self):
        return iter(self.waiting.get, None)


@pytest.fixture
def source():
    fed = Fed()
    yield fed
    fed.feed(None)  # lets the reading thread end


def step(live, source, number):
    """The events shown for a frame."""
    source.feed(number)
    return live.wait(number, 60.0).events


def test_of_frames_that_come_while_nobody_asks_the_newest_is_kept_and_the_others_count(source):
    source.feed(0, 1, 2, 3, None)
    frames = NewestFrames(source)
    frames._thread.join()
    assert frames.take()[0].t_us == 30_000
    assert (frames.arrived, frames.dropped, frames.take()) == (4, 3, None)


def test_a_recording_plays_at_its_own_rate_and_again_with_times_that_run_on():
    begun = time.perf_counter()
    frames = NewestFrames(open_frames(FRAMES[:3], CaptureConfig(fps=20)))
    times = [frames.take()[0].t_us for _ in range(5)]
    assert time.perf_counter() - begun >= times[-1] / 1e6
    frames.close()
    assert set(times) <= set(range(0, 10_000_000, 50_000))
    assert times == sorted({*times})
    assert times[-1] >= 200_000


def test_events_are_those_of_the_event_camera_and_a_recording_holds_them(source, tmp_path):
    whole = texvent.EventCamera("16x12", simulator="esim")
    expected = [whole.step(frame, 10_000 * number) for number, frame in enumerate(FRAMES)]
    live = LiveEvents(source, {"simulator": "esim"})
    with pytest.raises(InputError, match="no frame comes"):
        live.record(tmp_path / "a.raw", "evt3")
    assert [step(live, source, number).equals(expected[number]) for number in (0, 1, 2)]
    for path, format, error, words in (
        ("no/a.h5", "hdf5", OutputError, "the folder .* does not exist"),
        ("a.h5", "nosuch", ConfigError, "nosuch"),
        (".", "hdf5", OutputError, "exists already; choose another name$"),
    ):
        with pytest.raises(error, match=words):
            live.record(tmp_path / path, format)
    live.record(tmp_path / "a.raw", "evt3")
    with pytest.raises(InputError, match="is being recorded"):
        live.change("v2e", None)
    for number in (3, 4):
        step(live, source, number)
    live.stop_recording()
    stored = texvent.load(tmp_path / "a.raw")
    both = texvent.EventStream.concat(expected[3:5])
    assert np.array_equal(stored.t, both.t - 20_000)
    assert np.array_equal(stored.x, both.x)
    live.change("v2e", 0.3)
    assert len(step(live, source, 5)) == 0  # another camera, its first frame
    state = live.describe()
    assert (state["simulator"], state["contrast_threshold"]) == ("v2e", 0.3)
    source.feed(None)
    live.close()
    assert [path.name for path in tmp_path.iterdir()] == ["a.raw"]


def test_the_page_asks_for_the_next_frame_and_leaves(source):
    with LiveServer(LiveEvents(source, {}), "camera") as page:

        def ask(path, values=None):
            data = None if values is None else json.dumps(values).encode()
            return urllib.request.urlopen(page.address + path, data, timeout=60).read()

        source.feed(0)
        state = json.loads(ask("next?drawn=0"))
        assert (state["number"], state["events"], state["state"]) == (1, 0, "starting")
        assert state["events_picture"].startswith("data:image/png;base64,")
        assert "number" not in json.loads(ask("next?drawn=1"))
        with pytest.raises(urllib.error.HTTPError, match="400"):
            ask("change", {"simulator": 3})
        ask("leave", {})
        assert not page.is_over()
        time.sleep(GRACE_S + 0.1)
        assert page.is_over()
        ask("next")
        assert not page.is_over()
        source.feed(None)


def test_ctrl_c_completes_the_recording(tmp_path, spawn):
    words = [sys.executable, "-m", "texvent.cli.app", "live", str(CLIP), "--no-browser"]
    with spawn(words, stdout=-1, text=True, cwd=tmp_path) as command:
        address = command.stdout.readline().strip()
        body = json.dumps({"file": "a.aedat4", "format": "aedat4"}).encode()
        deadline = time.monotonic() + 120
        while json.loads(urllib.request.urlopen(f"{address}next").read())["state"] == "starting":
            assert time.monotonic() < deadline
        urllib.request.urlopen(f"{address}record", body)
        time.sleep(0.5)
        command.send_signal(signal.SIGINT)
        assert command.wait(60) == 0
    assert len(texvent.load(tmp_path / "a.aedat4")) > 0
    assert [path.name for path in tmp_path.iterdir()] == ["a.aedat4"]


def test_bad_input_is_one_line(capsys, source):
    assert "no such camera: /dev/video77" in refused(capsys, "live", "/dev/video77")
    assert "unknown simulator 'nosuch'" in refused(capsys, "live", CLIP, "--simulator", "nosuch")
    with contextlib.closing(LiveServer(LiveEvents(source, {}), "camera")) as page:
        port = page.address.rstrip("/").rpartition(":")[2]
        assert f"port {port}: " in refused(capsys, "live", CLIP, "--port", port)
        source.feed(None)
