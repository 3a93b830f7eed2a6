"""Real and embedded clips pass the checks of a generated video; deliberately broken ones do not."""

import math
import re

import cv2
import numpy as np
import pytest

from texvent.frames import Frame
from texvent.sensor import SensorSize
from texvent.transfer import Transfer, decode_srgb
from texvent.video_check.checks import CHECKS, check_video
from texvent.video_check.measurements import VideoMeasurer, block_means, neighbour_correlation
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator

RNG = np.random.default_rng(0)


def frames(images):
    return [Frame(image.astype(np.float32), i * 40_000) for i, image in enumerate(images)]


@pytest.mark.parametrize(
    ("name", "measured", "said"),
    [("time jump", {"jumps": 2.0, "longest_jump_s": 30.0}, "2, of up to 30 s"),
     ("time jump", {"jumps": 0.0, "longest_jump_s": 0.0}, "none"),
     ("missing frames", {"missing": 1.0}, "a gap in the numbers of images"),
     ("missing frames", {"missing": 0.0}, "no gap in the numbers of images")],
)  # fmt: skip
def test_a_count_is_said_as_it_was_measured(name, measured, said):
    (check,) = (one for one in CHECKS if one.name == name)
    assert check.value(measured) == said
    assert check.is_found(measured) == (not said.startswith("no"))


@pytest.fixture(scope="module")
def clip():
    """24 frames of a pan over a textured image: [N, H, W], 0..255."""
    rng = np.random.default_rng(3)
    ground = cv2.GaussianBlur(rng.uniform(0, 255, (120, 260)).astype(np.float32), (0, 0), 3)
    ground = np.clip((ground - 128) * 5 + 128, 0, 255)
    return np.stack([ground[10:106, i : i + 128] for i in range(24)])


def problems(images) -> set[str]:
    return set(check_video(frames(images)).problems)


class Everything(dict):
    """Measurements that all have one value, and of which none is there by itself."""

    def __missing__(self, name):
        return self["all"]


@pytest.mark.parametrize("check", CHECKS, ids=lambda one: one.name)
def test_a_check_finds_what_is_beyond_the_limit_that_it_states(check):
    least, number, percent = re.match(r"(at least )?([\d.]+)(%?)", check.limit).groups()
    limit = float(number) / (100 if percent else 1) if "usual" not in check.limit else 0.0
    below, above = (math.nextafter(limit, end) for end in (-math.inf, math.inf))
    found = [check.is_found(Everything(all=one)) for one in (below, limit, above)]
    is_least = least is not None or check.name == "dark"
    assert found == [is_least, False, not is_least]


def test_a_moving_image_is_fine(clip):
    assert check_video(frames(clip)).is_fine


@pytest.mark.parametrize(
    "prompt", ["a red car drives left at dusk", "a dog runs on the grass at night"]
)
def test_embedded_scenes_are_fine(prompt):
    config = ProceduralConfig(duration=0.5, samples=1)
    video = ProceduralGenerator(config, seed=1, size=SensorSize(86, 65)).generate(prompt)
    assert check_video(video).problems == ()


def test_one_image_all_the_time_is_frozen(clip):
    assert problems([clip[0]] * 24) == {"frozen", "no motion"}


def test_sensor_noise_on_a_still_image_is_no_motion(clip):
    noisy = [np.clip(clip[0] + RNG.normal(0, 1, clip[0].shape), 0, 255) for _ in range(24)]
    assert "no motion" in problems(noisy)


@pytest.mark.parametrize("gain", [lambda i: 1 + 0.05 * (-1) ** i, lambda i: 1 + 0.06 * GAINS[i]])
def test_brightness_that_jumps_up_and_down_is_flicker(clip, gain):
    assert "flicker" in problems([0.8 * image * gain(i) for i, image in enumerate(clip)])


GAINS = np.random.default_rng(1).normal(size=24)


def test_one_white_frame_is_a_flash(clip):
    flashed = clip.copy()
    flashed[12] = 255
    assert "flash" in problems(flashed)


def test_another_scene_in_the_middle_is_a_cut(clip):
    assert problems([*clip[:12], *(255 - clip[12:, ::-1])]) == {"cut"}


def test_a_black_clip_is_dark_and_a_white_one_saturated(clip):
    assert "dark" in problems(clip * 0.03)
    assert "saturated" in problems(np.minimum(clip * 0.1 + 245, 255))


def test_white_noise_is_noise():
    assert "noise" in problems(RNG.uniform(0, 255, (12, 96, 128)))


def test_block_means_and_correlation_by_hand():
    image = np.arange(16, dtype=np.float32).reshape(4, 4)
    assert np.array_equal(block_means(image), image), "small images keep their pixels"
    wide = np.repeat(np.arange(65, dtype=np.float32)[None], 2, axis=0)
    assert block_means(np.repeat(wide, 2, axis=1)).tolist() == [list(range(65))]
    checks = np.indices((8, 8)).sum(axis=0).astype(np.float32) % 2 * 100
    assert neighbour_correlation(checks) == pytest.approx(-1.0)
    assert neighbour_correlation(np.full((8, 8), 7, np.float32)) == 1.0


def test_linear_light_measures_as_its_gamma_coded_image(clip):
    light = 255 * decode_srgb(clip / np.float32(255))
    linear = [Frame(one, i * 40_000, transfer=Transfer.LINEAR) for i, one in enumerate(light)]
    of_light, of_code = check_video(linear).measurements, check_video(frames(clip)).measurements
    assert of_code.keys() - of_light.keys() == {"dark_end"}  # nothing clips light
    of_code = {name: of_code[name] for name in of_light}
    assert of_light == pytest.approx(of_code, rel=1e-3, abs=1e-3)


def test_cuts_have_times(clip):
    measurer = VideoMeasurer()
    for frame in frames([*clip[:12], *(255 - clip[12:, ::-1])]):
        measurer.add(frame)
    assert measurer.cut_times_us == [480_000]
    assert measurer.measurements()["cuts"] == 1
