"""Embedded scenes: motion is followed, what it does not tell is rendered."""

import numpy as np
import pytest

from texvent.config import InterpolateConfig
from texvent.interpolate.motion.interpolator import MotionInterpolator
from texvent.metrics.compare import compare
from texvent.pipeline import Simulation
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator
from texvent_scenes.raycast.incremental import IncrementalRenderer

SIZE = SensorSize(80, 60)


def video(prompt: str, **options):
    config = ProceduralConfig(duration=0.2, **options)
    return ProceduralGenerator(config, seed=1, size=SIZE).generate(prompt)


def test_frames_agree_with_those_rendered_at_the_instant():
    moving = video("a dog runs across a meadow").with_motion()
    first, second = list(moving)[1:3]
    times = [first.t_us + 5_000, first.t_us + 21_000, first.t_us + 33_000]
    interpolator = MotionInterpolator(InterpolateConfig(interpolate="motion"), moving)
    for frame in interpolator.between(first, second, times):
        off = np.abs(frame.pixels - moving.at(frame.t_us).luma)
        assert not frame.is_source
        assert np.mean(off > 3.0) < 0.003
        assert np.median(off) < 0.05


def test_motion_of_frames_is_the_ground_truth():
    moving = video("a red car drives left").with_motion()
    frames = list(moving)
    truth = moving.ground_truth(frames[1].t_us, frames[2].t_us)
    back = moving.ground_truth(frames[1].t_us, frames[0].t_us)
    motion = frames[1].motion
    np.testing.assert_allclose(motion.forward, truth.flow, rtol=0, atol=1e-4)
    np.testing.assert_allclose(motion.backward, back.flow, rtol=0, atol=1e-4)
    np.testing.assert_allclose(motion.depth, truth.depth, rtol=1e-6)
    assert frames[0].motion.backward is None
    assert frames[-1].motion.forward is None


@pytest.mark.long
@pytest.mark.parametrize(
    ("prompt", "most_drawn"),
    [
        ("cars drive past houses on a street", 0.25),
        ("a fan spins at 20 Hz", 0.4),
        ("a drone hovers over a meadow", 0.5),
        ("a red lamp blinks at 48 Hz in a dark room", 1.01),
    ],
)
def test_events_agree_with_those_of_every_instant_rendered(monkeypatch, prompt, most_drawn):
    drawn = []
    draw = IncrementalRenderer._luma

    def count(self, time_s, pixels, codes, light):
        drawn.append(pixels[0].mean())
        return draw(self, time_s, pixels, codes, light)

    monkeypatch.setattr(IncrementalRenderer, "_luma", count)
    streams, scene = {}, video(prompt)
    for interpolate in ("motion", "exact"):
        options = {"interpolate": interpolate, "fixed_count": 11, "noise": "none"}
        run = Simulation(video=scene, settings=resolve("generate", options))
        streams[interpolate] = run.packets.collect()
    assert compare(streams["motion"], streams["exact"], ["stpp"])["stpp"] > 0.98
    instants = 11 * (scene.frame_count - 1)
    assert sum(drawn) < most_drawn * instants


def test_light_that_beats_is_rendered_at_every_instant():
    scene = video("a ball on a table, the light flickers at 100 Hz")
    assert scene.flicker_hz == 100
    moving = scene.with_motion()
    first, second = list(moving)[:2]
    interpolator = MotionInterpolator(InterpolateConfig(interpolate="motion"), moving)
    for frame in interpolator.between(first, second, [2_500, 7_500]):
        np.testing.assert_allclose(frame.pixels, moving.at(frame.t_us).luma, rtol=1e-6, atol=1e-12)


@pytest.mark.parametrize("interpolate", ["motion", "exact", "blend"])
def test_beats_of_light_ask_for_frames_of_those_that_render_them(interpolate):
    config = ProceduralConfig(duration=0.1, samples=1)
    beating = ProceduralGenerator(config, size=SensorSize(32, 24)).generate(
        "a lamp flickers at 100 Hz"
    )
    settings = resolve("generate", {"interpolate": interpolate, "noise": "none"})
    instants = sum(1 for _ in Simulation(video=beating, settings=settings).steps())
    last_s = (beating.frame_count - 1) / 24
    assert (instants >= 12 * 100 * last_s) == (interpolate != "blend")
