"""Frames given one by one give the events of the whole video; a loop can be closed over them."""

import runpy
from pathlib import Path

import matplotlib
import numpy as np
import pytest

import texvent
from texvent.api.event_camera import USED_CAPTURE
from texvent.errors import ConfigError, InputError, TexventWarning
from texvent.events import EventStream

PENDULUM = Path(__file__).parents[2] / "docs" / "examples" / "plot_17_pendulum.py"
FRAMES = np.random.default_rng(7).integers(0, 256, (4, 12, 16), dtype=np.uint8)
TIMES = [0, 20_000, 40_000, 70_000]


def step_all(camera: texvent.EventCamera) -> EventStream:
    return EventStream.concat([camera.step(*one) for one in zip(FRAMES, TIMES, strict=True)])


def test_steps_have_the_options_of_a_video():
    options = {"simulator": "physical", "sensor": "8x8", "white_level": 200.0, "seed": 5}
    options |= {"randomize": "v2v", "keep_events": "signal", "contrast_threshold": 0.2}
    whole = texvent.simulate(FRAMES, t_us=TIMES, progress=False, **options)
    assert len(whole)
    assert step_all(texvent.EventCamera((16, 12), **options)) == whole


CAPTURED = {"white_level": 200.0, "fit": "stretch", "transfer": "linear"}


@pytest.mark.parametrize("name", USED_CAPTURE)
def test_each_option_of_frames_has_the_effect_that_it_has_on_a_video(name):
    for sensor in [{"sensor": "8x8"}, *([{}] if name != "fit" else [])]:
        plain = {**sensor, "simulator": "esim", "seed": 5}
        options = {name: CAPTURED[name], **plain}
        whole = texvent.simulate(FRAMES, t_us=TIMES, progress=False, **options)
        assert step_all(texvent.EventCamera((16, 12), **options)) == whole
        assert step_all(texvent.EventCamera((16, 12), **plain)) != whole


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"start": 1.0}, "start is for videos and files"),
        ({"fps": 30}, "fps is for videos and files"),
        ({"target_rate": 1e5}, "target_rate reads the first second"),
        ({"interpolate": "exact"}, "interpolate is exact, which needs more than frames"),
    ],
)
def test_options_that_need_later_frames_are_refused(options, words):
    with pytest.raises(ConfigError, match=words):
        texvent.EventCamera("16x12", **options)


def test_a_camera_without_a_size_is_refused():
    with pytest.raises(ConfigError, match="name the size of the frames"):
        texvent.EventCamera(sensor="davis346")


def test_events_held_back_come_at_the_end(held_back):
    whole = texvent.simulate(FRAMES, t_us=TIMES, progress=False, simulator="esim")
    camera = texvent.EventCamera((16, 12), simulator=held_back)
    assert len(step_all(camera)) == 0
    assert camera.finish().equals(whole)
    assert len(camera.finish()) == 0


@pytest.mark.parametrize(
    ("frame", "t_us", "words"),
    [
        (FRAMES[1][:6], 20_000, "the frame is 16x6; this event camera takes 16x12"),
        (FRAMES[1], 0, "frame times must strictly increase"),
        (np.full((12, 16), np.nan), 20_000, "NaN"),
        (FRAMES[1].astype(np.int64), 20_000, "uint8 .0..255., uint16"),
    ],
)
def test_a_bad_frame_is_refused(frame, t_us, words):
    camera = texvent.EventCamera((16, 12))
    camera.step(FRAMES[0] * (1.0 if frame.dtype.kind == "f" else np.uint8(1)), 0)
    with pytest.raises(InputError, match=words):
        camera.step(frame, t_us)


@pytest.mark.parametrize("end", ["finish", "close"])
def test_a_camera_that_ended_takes_no_frame_before_a_reset(end):
    camera = texvent.EventCamera((16, 12))
    camera.step(FRAMES[0], 0)
    getattr(camera, end)()
    with pytest.raises(InputError, match=r"reset\(\) starts it again"):
        camera.step(FRAMES[1], 20_000)
    camera.reset()
    assert len(camera.step(FRAMES[0], 0)) == 0


@pytest.mark.long
def test_a_controller_that_sees_only_events_keeps_a_rod_upright():
    with matplotlib.rc_context({"backend": "agg"}):
        ran = runpy.run_path(str(PENDULUM))
    assert len(ran["upright"]) == ran["STEPS"]
    assert np.abs(ran["upright"]).max() < np.radians(8)
    assert np.abs(ran["fallen"][-1]) > np.radians(90)
    assert len(ran["fallen"]) < ran["STEPS"]


@pytest.mark.parametrize(("step", "unit"), [(1, "s"), (33, "ms"), (33_333_333, "ns")])
def test_times_in_another_unit_are_warned_of_once(step, unit):
    camera = texvent.EventCamera((2, 2), noise="none")
    frames = [np.full((2, 2), 50 + index, np.uint8) for index in range(6)]
    with pytest.warns(
        TexventWarning, match=rf"µs apart.*\b{unit} \(.* per second\), \w+ply|divide"
    ):
        _ = [camera.step(frame, step * index) for index, frame in enumerate(frames)]


def test_a_missing_frame_is_named():
    with pytest.raises(InputError, match="is None, no frame"):
        texvent.EventCamera((2, 2)).step(None, 0)
