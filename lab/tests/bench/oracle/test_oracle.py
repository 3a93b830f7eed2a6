"""The oracle: its scenes, its camera, its pixels.

python -m lab.tests.bench.oracle.test_oracle    # writes scenes.json anew, after a scene changed
"""

import json
from pathlib import Path

import numpy as np
import pytest

from texvent.sensor import SensorSize
from texvent_lab.bench.oracle.pixel import IDEAL, NOISY, PixelArray, PixelModel
from texvent_lab.bench.oracle.recording import SIZE, TrueFrames, oracle_scene, render_video
from texvent_lab.bench.oracle.scenes import PROMPTS, SCENES, ValueNoise, build_scene, camera_level
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator

ONE = SensorSize(1, 1)
STORED = Path(__file__).with_name("scenes.json")
BLOCK = 4
"""Side of the blocks of pixels whose mean radiance is stored, px."""


def coarse_pictures(name):
    """Mean radiance of blocks of a scene at three instants."""
    scene, (width, height) = build_scene(name, 7, SensorSize(48, 32)), (48, 32)
    shape = (height // BLOCK, BLOCK, width // BLOCK, BLOCK)
    return [scene(one).reshape(shape).mean((1, 3)).round(5).tolist() for one in (0.0, 0.013, 0.4)]


def expose_levels(model, levels, step_us=1000, size=ONE, seed=0):
    """Events of pixels that all see exp(level) at each step, dark current taken off."""
    array = PixelArray(model, size, seed)
    for step, level in enumerate(levels):
        array.expose(np.full(size.shape, np.exp(level) - model.dark_level), step * step_us)
    return array.events()


def test_an_ideal_pixel_on_a_ramp_fires_at_every_threshold_exactly():
    # 0.5, 0.45 and -0.5 log units per ms; references 0.2, 0.4, 0.6, 0.8, then back to 0.6.
    events = expose_levels(IDEAL, [0.0, 0.5, 0.95, 0.45])
    assert events.t.tolist() == pytest.approx([400, 800, 1222, 1667, 2700], abs=1)
    assert events.p.tolist() == [1, 1, 1, 1, 0]


def test_a_refractory_pixel_is_held_in_reset():
    # Crosses at 400 µs, is released at 700 µs (level 0.35): next at 0.55 (1100 µs), is released
    # at 1400 µs (0.7): next at 0.9 (1800 µs).
    events = expose_levels(PixelModel(refractory_us=300), [0.0, 0.5, 1.0])
    assert events.t.tolist() == pytest.approx([400, 1100, 1800], abs=1)


def test_a_dark_pixel_is_slower_than_a_bright_one():
    model = PixelModel(cutoff_hz=250.0)
    bright = expose_levels(model, [np.log(0.5), *[np.log(1.0)] * 20], 200)
    dark = expose_levels(model, [np.log(0.05), *[np.log(0.1)] * 20], 200)
    # The same contrast, ln 2 = 0.69: three events in the light, fewer and later in the dark.
    assert len(bright) == 3
    assert len(dark) < 3
    assert dark.t[0] > 3 * bright.t[0]


def test_leak_events_come_at_the_leak_rate():
    # Each pixel's rate is its own (fixed pattern, mean about 1.18 times the median).
    size = SensorSize(30, 30)
    events = expose_levels(PixelModel(leak_hz=5.0), [0.0] * 1001, 1000, size)
    assert (events.p == 1).all()
    assert len(events) / 900 == pytest.approx(5.0 * 1.18, rel=0.15)


def test_shot_noise_comes_at_its_rate_mostly_off_and_more_in_the_dark():
    size = SensorSize(40, 40)
    model = PixelModel(shot_hz=10.0)
    dark, bright = (
        expose_levels(model, [np.log(radiance)] * 1001, 1000, size) for radiance in (0.005, 0.9)
    )
    assert len(dark) / 1600 == pytest.approx(10.0 * 1.18, rel=0.1)
    assert len(bright) / len(dark) == pytest.approx(0.25, rel=0.1)
    assert dark.p.mean() == pytest.approx(0.42, abs=0.02)


@pytest.mark.parametrize("mismatch", [0.0, 0.08])
def test_a_pixel_at_rest_is_anywhere_between_its_thresholds(mismatch):
    """At rest none fires; along a ramp each fires once per threshold, wherever it began."""
    model, size = PixelModel(threshold_sigma=mismatch, has_random_phase=True), SensorSize(40, 40)
    assert not len(expose_levels(model, [0.0] * 3, size=size))
    array = PixelArray(model, size, 0)
    for way, thresholds in ((1.0, array._on), (-1.0, array._off)):
        little = expose_levels(model, [0.0, 0.1 * way], size=size)
        share = np.mean(0.1 / (array._on + array._off))
        # Those with thresholds below .1 fire twice at times.
        assert len(little) / 1600 == pytest.approx(share, rel=0.15)
        long = expose_levels(model, [0.0, 4.0 * way], size=size)
        per_pixel = np.bincount(long.y.astype(int) * 40 + long.x, minlength=1600)
        least = 4.0 / thresholds - (array._off if way > 0 else array._on) / thresholds - 1
        assert (per_pixel >= np.floor(least)).all()
        assert (per_pixel <= np.ceil(4.0 / thresholds) + 1).all()


def test_two_recordings_share_the_sensor_but_not_the_noise():
    scene = oracle_scene("static", 7)
    # Six steps of exposure are enough to tell the seeds apart.
    arrays = [PixelArray(NOISY, SIZE, seed) for seed in (1, 1, 2)]
    for step in range(400):
        for array in arrays:
            array.expose(scene(0.0), 208 * step)
    first, again, second = (array.events() for array in arrays)
    assert first.equals(again)
    assert not first.equals(second)


@pytest.mark.parametrize("name", SCENES)
def test_every_scene_is_finite_positive_and_its_own_per_seed(name):
    scene = build_scene(name, 7, SIZE)
    for seconds in (0.0, 0.123, 0.5):
        radiance = scene(seconds)
        assert radiance.shape == SIZE.shape
        assert np.isfinite(radiance).all()
        assert (radiance > 0).all()
    assert not np.allclose(scene(0.0), build_scene(name, 21, SIZE)(0.0))
    if name != "static":
        assert not np.allclose(scene(0.0), scene(0.1031))


@pytest.mark.parametrize("name", SCENES)
def test_every_scene_shows_what_it_showed(name):
    stored = json.loads(STORED.read_text())[name]
    np.testing.assert_allclose(coarse_pictures(name), stored, atol=2e-5)


def test_textures_move_at_their_known_flow():
    scene = build_scene("translate", 7, SIZE)
    # 120 and 35 px/s: after 0.2 s the image has moved 24 px right and 7 px down.
    np.testing.assert_allclose(scene(0.2)[7:, 24:], scene(0.0)[:-7, :-24], atol=1e-9)


def test_value_noise_repeats_and_is_smooth():
    noise = ValueNoise(3)
    x = np.linspace(-5, 5, 1001)
    line = noise.sample(x, np.zeros(1))[0]
    assert np.abs(np.diff(line)).max() < 0.02
    assert 0 <= line.min() < line.max() <= 1
    np.testing.assert_allclose(noise.sample(x + 64 * 16 * 5 * 2.3 * 10, np.zeros(1))[0], line)


def test_the_camera_exposes_codes_and_clips():
    assert camera_level(np.array([0.0, 0.5 / 0.9, 5.0])).tolist() == pytest.approx(
        [0.0, 255 * 0.5 ** (1 / 2.2), 255.0]
    )
    video = render_video(oracle_scene("hdr", 7))
    assert len(video) == 13
    assert video.pixels.dtype == np.uint8
    assert video.times_us[-1] == 500_000
    assert video.pixels.max() == 255
    assert video.pixels.min() < 40


def test_true_frames_are_the_film_before_rounding_at_any_instant():
    scene = oracle_scene("mixed", 7)
    true = TrueFrames(scene)
    for rounded, exact in zip(render_video(scene), true, strict=True):
        assert rounded.t_us == exact.t_us
        assert np.abs(exact.pixels - rounded.pixels).max() <= 0.501
    np.testing.assert_array_equal(true.at(41_667).pixels, list(true)[1].pixels)
    assert not true.at(41_667).is_source


def test_a_prompt_is_a_scene_that_the_camera_films_as_the_generator_drew_it():
    name, seed = "prompt-car", 7
    video = ProceduralGenerator(ProceduralConfig(duration=0.5), seed=seed, size=SIZE).generate(
        PROMPTS[name]
    )
    shown = np.rint(camera_level(oracle_scene(name, seed)(0.0)))
    drawn = video.at(0).luma
    assert np.abs(shown - drawn).max() <= 0.501
    # It moves, and another seed shows another scene.
    assert not np.array_equal(oracle_scene(name, seed)(0.0), oracle_scene(name, seed)(0.4))
    assert not np.array_equal(oracle_scene(name, seed)(0.0), oracle_scene(name, 8)(0.0))


if __name__ == "__main__":
    rows = (f"{json.dumps(name)}: {json.dumps(coarse_pictures(name))}" for name in SCENES)
    STORED.write_text("{\n" + ",\n".join(rows) + "\n}\n")
