"""Frames pushed one by one give the events of the whole video."""

import numpy as np
import pytest

import texvent
from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.run.pushed import PushedSimulation
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent.video import Frame

FRAMES = np.random.default_rng(7).integers(0, 256, (4, 12, 16), dtype=np.uint8)
TIMES = [0, 20_000, 40_000, 70_000]


def push_all(options: dict) -> EventStream:
    run = PushedSimulation(resolve("simulate", options), SensorSize(16, 12))
    pairs = zip(FRAMES, TIMES, strict=True)
    return EventStream.concat([run.push(Frame(pixels, t)) for pixels, t in pairs])


@pytest.mark.parametrize(
    "options",
    [
        {},
        {"simulator": "esim", "interpolate": "blend"},
        {"simulator": "v2e"},
        {"simulator": "physical", "sensor": "8x8", "white_level": 200.0},
        {"deflicker": True, "randomize": "v2v", "events": "signal"},
    ],
    ids=lambda options: "-".join(map(str, options.values())) or "default",
)
def test_pushed_frames_give_the_events_of_the_video(options):
    whole = texvent.simulate(FRAMES, t_us=TIMES, progress=False, seed=5, **options)
    assert len(whole)
    assert push_all({**options, "seed": 5}).equals(whole)


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
        PushedSimulation(resolve("simulate", options), SensorSize(16, 12))
