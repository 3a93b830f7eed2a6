"""Live events: none waits in a queue, recordings are whole, the page asks and leaves."""

import base64
import json
import queue
import signal
import sys
import time
import urllib.error
from pathlib import Path
from threading import Event

import cv2
import numpy as np
import pytest
from tests.cli.running import refused, run
from tests.web.opened import open_entry

import texvent
from texvent.api.event_camera import EventCamera
from texvent.capture.fit_to_sensor import fit_pixels
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import InputError, OutputError, TexventError
from texvent.frames import Frame
from texvent.io.block_writer import BlockWriter
from texvent.sensor import SensorSize
from texvent.view.drawing.palettes import PALETTES
from texvent.web.live import LiveEvents
from texvent.web.live_page import LiveServer

CLIP = Path(__file__).parents[1] / "clips" / "bigbuckbunny_excerpt.mp4"
FRAMES = np.random.default_rng(3).integers(0, 256, (6, 12, 16), dtype=np.uint8)


class Fed:
    """Live source of the frames that a test feeds, 10 ms apart."""

    size, fps, frame_count, is_live, metadata = SensorSize(16, 12), None, None, True, {}

    def __init__(self):
        self.waiting = queue.Queue()

    def feed(self, *numbers):
        for number in numbers:
            self.waiting.put(Frame(FRAMES[number % len(FRAMES)], 10_000 * number))

    def end(self):
        self.waiting.put(None)

    def __iter__(self):
        return iter(self.waiting.get, None)


@pytest.fixture
def source():
    fed = Fed()
    yield fed
    fed.end()  # lets the reading thread end


def step(live, source, number):
    """The events shown for a frame."""
    source.feed(number)
    return live.wait(10_000 * number - 1, 60.0).events


class HeldFrame:
    """A frame that the event camera waits for until it is released."""

    def __init__(self, number):
        self.t_us, self.is_taken, self.is_released = 10_000 * number, Event(), Event()

    @property
    def pixels(self):
        self.is_taken.set()
        assert self.is_released.wait(60)
        return FRAMES[0]


def drop(live, source, numbers):
    """Let all of these frames but the first and the last come while the first is simulated."""
    held, arrived = HeldFrame(numbers[0]), live.describe()["frames"]
    source.waiting.put(held)
    assert held.is_taken.wait(60)
    source.feed(*numbers[1:])
    with live._changed:
        assert live._changed.wait_for(lambda: live._arrived == arrived + len(numbers), 60)
    held.is_released.set()
    assert live.wait(10_000 * numbers[-1] - 1, 60) is not None


@pytest.mark.parametrize(("before", "during"), [(0, 0), (3, 0), (0, 2), (4, 1)])
def test_a_recording_counts_the_frames_dropped_while_it_ran(
    source, tmp_path, before, during, capsys
):
    live = LiveEvents(source, {"simulator": "esim"})
    for number in range(4):
        step(live, source, number)
    number = 4
    for name, counts in (("a.h5", (before, during)), ("b.h5", (0, during))):
        for is_recorded, count in enumerate(counts):
            if is_recorded:
                live.record(tmp_path / name, "hdf5")
            drop(live, source, range(number, number + 2 + count))
            number += 2 + count
        live.stop_recording()
        assert texvent.load(tmp_path / name).metadata.get("frames_dropped", 0) == during
        code, said = run("validate", tmp_path / name), capsys.readouterr().out
        assert ("frames of its source are missing" in said) == bool(during)
        assert not during or (code == 1 and f"  {during} frames of its source" in said)
    assert live.describe()["dropped"] == before + 2 * during
    source.end()
    live._threads[0].join()
    assert live.describe()["state"] == "ended"
    live.close()


def test_a_recording_plays_at_its_own_rate_and_again_with_times_that_run_on():
    begun, times = time.perf_counter(), [-1]
    live = LiveEvents(open_frames(FRAMES[:3], CaptureConfig(fps=20)), {})
    while times[-1] < 200_000:
        shown = live.wait(times[-1], 60.0)
        times.append(shown.frame.t_us)
        assert shown.source_us == times[-1] % 150_000  # of the clip, whose passes take 150 ms
        assert time.perf_counter() - begun >= times[-1] / 1e6
    live.close()
    assert {*times[1:]} <= {*range(0, 60_000_000, 50_000)}


@pytest.mark.parametrize("query", ["", "&dark=1"])
def test_both_pictures_show_what_the_sensor_sees(source, tmp_path, query):
    live = LiveEvents(source, {"simulator": "esim", "sensor": "8x8"})
    with LiveServer(live, "camera", tmp_path) as page:
        source.feed(0)
        live.wait(-1, 60.0)
        source.feed(1)
        live.wait(0, 60.0)
        state = json.load(open_entry(page.entry)(f"next?drawn_us=0{query}"))
        seen, events = (
            cv2.imdecode(np.frombuffer(base64.b64decode(state[name]), np.uint8), flags)
            for name, flags in (("camera_jpeg", 0), ("events_png", 1))
        )
        assert seen.shape == events.shape[:2] == (8, 8)
        fitted = fit_pixels(FRAMES[1], SensorSize(8, 8), "cover")
        assert np.abs(seen.astype(float) - fitted).mean() < 12  # JPEG
        palette = PALETTES["paper"].dark if query else PALETTES["paper"]
        assert (events[..., ::-1] == palette.background).all(axis=2).any()
        source.end()


def test_a_live_source_says_the_time_since_its_first_frame(source, tmp_path):
    with LiveServer(LiveEvents(source, {"simulator": "esim"}), "camera", tmp_path) as page:
        ask = open_entry(page.entry)
        for number in (7, 9):
            step(page._live, source, number)
            state = json.load(ask(f"next?drawn_us={10_000 * number - 1}"))
            assert (state["t_us"], state["source_us"]) == (10_000 * number, 10_000 * (number - 7))
        source.end()


def test_events_are_those_of_the_event_camera_and_a_recording_holds_them(source, tmp_path):
    whole = texvent.EventCamera("16x12", simulator="esim")
    expected = [whole.step(frame, 10_000 * number) for number, frame in enumerate(FRAMES)]
    live = LiveEvents(source, {"simulator": "esim"})
    with pytest.raises(InputError, match="no events come"):
        live.record(tmp_path / "a.raw", "evt3")
    assert all(step(live, source, number).equals(expected[number]) for number in range(3))
    with pytest.raises(OutputError, match=r"exists already; choose another name$"):
        live.record(tmp_path, "hdf5")
    live.record(tmp_path / "a.raw", "evt3")
    with pytest.raises(InputError, match="is being recorded"):
        live.change("v2e", None)
    for number in (3, 4):
        step(live, source, number)
    live.stop_recording()
    stored, both = texvent.load(tmp_path / "a.raw"), texvent.EventStream.concat(expected[3:5])
    assert np.array_equal(np.c_[stored.t + 20_000, stored.x], np.c_[both.t, both.x])
    live.change("v2e", 0.3)
    assert live.describe()["state"] == "starting"  # it compiles
    assert len(step(live, source, 5)) == 0  # another camera, its first frame
    state = live.describe()
    assert (state["simulator"], state["contrast_threshold"]) == ("v2e", 0.3)
    assert (state["state"], state["frames"]) == ("starting", 0)
    source.end()
    live.close()
    assert [path.name for path in tmp_path.iterdir()] == ["a.raw"]


def test_every_event_shown_outlives_the_process_and_a_full_disk(source, tmp_path, monkeypatch):
    live = LiveEvents(source, {"simulator": "esim"})
    for number in range(3):
        step(live, source, number)
    live.record(tmp_path / "a.h5", "hdf5")
    for number in (3, 4):
        shown = step(live, source, number)
        kept = texvent.load(tmp_path / "a.h5.unfinished.npy")  # as a kill would leave it now
        last = kept.t >= 10_000 * (number - 3)
        assert np.array_equal(kept.t[last] + 20_000, shown.t)
        assert all(
            np.array_equal(getattr(kept, name)[last], getattr(shown, name)) for name in "xyp"
        )
    assert (kept.size, kept.metadata["simulator"]) == ((16, 12), "esim")

    def full(self, packet):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(BlockWriter, "append", full)
    shown = step(live, source, 5)
    state = live.describe()
    assert (state["recording"], state["state"]) == (None, "running")
    assert state["error"].endswith(f"until then are in {tmp_path}/a.h5.unfinished.npy")
    assert len(texvent.load(tmp_path / "a.h5.unfinished.npy")) == len(kept) + len(shown)
    with pytest.raises(OutputError, match="a recording that broke off; keep it by texvent convert"):
        live.record(tmp_path / "a.h5", "hdf5")
    source.end()
    with pytest.raises(OutputError, match="the disk is full"):
        live.close()


@pytest.mark.parametrize("part", ["reading", "simulating"])
def test_any_error_ends_the_events_with_one_line(source, monkeypatch, part):
    def fail(*_):
        raise ZeroDivisionError("of a library")

    monkeypatch.setattr(*((Fed, "__iter__") if part == "reading" else (EventCamera, "step")), fail)
    live = LiveEvents(source, {"simulator": "esim"})
    source.feed(0)
    live._threads[0].join()
    state = live.describe()
    assert (state["state"], state["error"]) == ("ended", "ZeroDivisionError: of a library")
    source.end()
    with pytest.raises(TexventError, match="ZeroDivisionError: of a library"):
        live.close()


def begin_live(spawn, folder):
    """The command, recording a.aedat4 since it sees events, and a function that asks its page."""
    words = [sys.executable, "-m", "texvent.cli.app", "live", str(CLIP), "--no-browser"]
    command = spawn(words, stdout=-1, text=True, cwd=folder)
    ask, state = open_entry(command.stdout.readline().strip()), {"state": "starting"}
    while state["state"] == "starting":
        state = json.loads(ask("next").read())
    ask("record", json.dumps({"file": "a.aedat4", "format": "aedat4"}).encode())
    frames = json.loads(ask("next").read())["frames"]
    while json.loads(ask("next").read())["frames"] < frames + 20:
        pass
    return command


@pytest.mark.long
def test_ctrl_c_completes_the_recording(tmp_path, spawn):
    command = begin_live(spawn, tmp_path)
    command.send_signal(signal.SIGINT)
    assert command.wait(60) == 0
    assert len(texvent.load(tmp_path / "a.aedat4")) > 0
    assert [path.name for path in tmp_path.iterdir()] == ["a.aedat4"]


@pytest.mark.long
def test_a_kill_leaves_the_recording_to_convert(tmp_path, spawn, capsys):
    command = begin_live(spawn, tmp_path)
    command.kill()
    command.wait()
    kept = tmp_path / "a.aedat4.unfinished.npy"
    assert run("convert", kept, tmp_path / "a.aedat4") == 0
    stored = texvent.load(tmp_path / "a.aedat4")
    assert (stored.size, len(stored) > 0) == ((320, 180), True)


def test_recordings_stay_below_the_folder(source, tmp_path):
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "link").symlink_to(tmp_path)
    with LiveServer(LiveEvents(source, {"simulator": "esim"}), "camera", tmp_path / "in") as page:
        for number in range(3):
            step(page._live, source, number)
        ask = open_entry(page.entry)
        for name in ("../a.h5", "/tmp/a.h5", "link/a.h5", "a" * 5000, "a\0b", "", 3, ".."):
            with pytest.raises(urllib.error.HTTPError) as refusal:
                ask("record", json.dumps({"file": name, "format": "hdf5"}).encode())
            assert refusal.value.code == 400, name
            assert len(refusal.value.read()) < 300, name
            assert page._live.describe()["recording"] is None, name
        source.end()
    assert [path.name for path in tmp_path.rglob("*.h5*")] == []


def test_odd_numbers_of_a_page_give_json(source):
    with LiveServer(LiveEvents(source, {"simulator": "esim"}), "camera", Path()) as page:
        ask = open_entry(page.entry)
        odd = ("nan", "inf", "-inf", "1e308", "-1e308", "1e999", "x")
        for one, number in enumerate(odd, start=1):
            source.feed(2 * one, 2 * one + 1)
            page._live.wait(10_000 * (2 * one + 1) - 1, 60.0)
            answer = ask(f"next?arrived_s={number}&drawn_us={number}").read()
            assert json.loads(answer, parse_constant=pytest.fail)["latency_ms"] == [], number
        source.end()


@pytest.mark.parametrize("models", [("esim",), ("esim", "v2e"), ("v2e", "esim", "esim")])
def test_latency_is_that_of_the_frames_drawn_since_the_model_was_compiled(source, models):
    live, number = LiveEvents(source, {"simulator": models[0]}), 0
    for place, model in enumerate(models):
        if place:
            live.change(model, None)
        ages_ms = []
        for one in range(8):
            step(live, source, number)
            with live._changed:  # the frame is counted where it is shown
                assert live._changed.wait_for(lambda done=one + 1: live._steps == done, 60)
            ages_ms += [1000.0 * (place + 1) + 200 * one] * (one >= 3)
            for age_s in (ages_ms[-1] / 1e3 if ages_ms else 7.0, -60.0, 3601.0):
                live.note_drawn(time.perf_counter() - age_s)
            told, number = live.describe()["latency_ms"], number + 1
            wanted = np.percentile(ages_ms, (50, 95)) if ages_ms else []
            np.testing.assert_allclose(told, wanted, atol=60)
        assert live.describe()["frames"] == 6  # without those that compiled
    source.end()
    live.close()


@pytest.mark.parametrize("begin", ["record", "change"])
def test_an_error_is_said_until_something_new_is_begun(source, tmp_path, begin):
    live = LiveEvents(source, {"simulator": "esim"})
    for number in range(4):
        step(live, source, number)
    live.record(tmp_path / "a.h5", "hdf5")

    def fail(events):
        raise OSError("the disk is full")

    live._recording.append = fail
    for number in (4, 5):
        step(live, source, number)
        assert "the disk is full; its events until then are in" in live.describe()["error"]
        assert live.describe()["recording"] is None
    live.record(tmp_path / "b.h5", "hdf5") if begin == "record" else live.change("v2e", None)
    assert live.describe()["error"] == ""
    source.end()
    live.close()


def test_bad_input_is_one_line(capsys, source):
    assert "no such camera: /dev/video77" in refused(capsys, "live", "/dev/video77")
    with LiveServer(LiveEvents(source, {}), "camera", Path()) as page:
        source.feed(0)
        ask = open_entry(page.entry)
        answers = [ask(f"next?drawn_us={n}").read() for n in (-1, 0)]
        assert ["t_us" in json.loads(answer) for answer in answers] == [True, False]
        port = page.address.rstrip("/").rpartition(":")[2]
        assert f"port {port}: " in refused(capsys, "live", CLIP, "--port", port)
        source.end()
