"""The failure filter passes real and embedded clips and catches deliberately broken ones."""

from fractions import Fraction
from pathlib import Path

import cv2
import numpy as np
import pytest

from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import InputError, TexventError
from texvent.generate.procedural import ProceduralConfig, ProceduralGenerator
from texvent.generate.video_config import GeneratedVideoConfig
from texvent.generate.videos.failure_filter import block_means, check_video, neighbour_correlation
from texvent.generate.videos.retries import generate_checked, nth_seed
from texvent.generate.videos.stored_video import write_video
from texvent.sensor import SensorSize
from texvent.video import Frame

CLIP = Path(__file__).parents[2] / "clips" / "bigbuckbunny_excerpt.mp4"
RNG = np.random.default_rng(0)


def frames(images):
    return [Frame(image.astype(np.float32), i * 40_000) for i, image in enumerate(images)]


@pytest.fixture(scope="module")
def clip():
    """24 frames of a pan over a textured image: [N, H, W], 0..255."""
    rng = np.random.default_rng(3)
    ground = cv2.GaussianBlur(rng.uniform(0, 255, (120, 260)).astype(np.float32), (0, 0), 3)
    ground = np.clip((ground - 128) * 5 + 128, 0, 255)
    return np.stack([ground[10:106, i : i + 128] for i in range(24)])


def problems(images) -> set[str]:
    return set(check_video(frames(images)).problems)


def test_a_moving_image_is_fine(clip):
    report = check_video(frames(clip))
    assert report.is_fine, report
    assert report.summary == "nothing found"


def test_a_real_clip_is_fine():
    assert check_video(open_frames(CLIP, CaptureConfig())).problems == ()


@pytest.mark.parametrize(
    "prompt", ["a red car drives left at dusk", "a dog runs on the grass at night"]
)
def test_embedded_scenes_are_fine(prompt):
    config = ProceduralConfig(duration=0.5, samples=1)
    video = ProceduralGenerator(config, seed=1, size=SensorSize(86, 65)).generate(prompt)
    assert check_video(video).problems == ()


def test_one_image_all_the_time_is_frozen(clip):
    assert problems([clip[0]] * 24) == {"frozen", "no motion"}


def test_a_clip_that_stops_halfway_is_frozen(clip):
    assert problems([*clip[:8], *[clip[8]] * 16]) == {"frozen"}


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


def test_a_single_frame_has_no_motion(clip):
    assert "no motion" in problems(clip[:1])


def test_block_means_and_correlation_by_hand():
    image = np.arange(16, dtype=np.float32).reshape(4, 4)
    assert np.array_equal(block_means(image), image), "small images keep their pixels"
    wide = np.repeat(np.arange(65, dtype=np.float32)[None], 2, axis=0)
    assert block_means(np.repeat(wide, 2, axis=1)).tolist() == [list(range(65))]
    checks = np.indices((8, 8)).sum(axis=0).astype(np.float32) % 2 * 100
    assert neighbour_correlation(checks) == pytest.approx(-1.0)
    assert neighbour_correlation(np.full((8, 8), 7, np.float32)) == 1.0


def test_the_report_goes_into_metadata_as_plain_values(clip):
    facts = check_video(frames([clip[0]] * 3)).as_facts()
    assert facts["problems"] == ["frozen", "no motion"]
    assert all(isinstance(value, float) for name, value in facts.items() if name != "problems")


class Told:
    def __init__(self):
        self.lines = []

    def announce(self, line):
        self.lines.append(line)


@pytest.fixture
def make(tmp_path, clip):
    """Seed 0 and its first successor freeze; every other seed moves."""
    asked = []

    def make_video(seed, progress):
        asked.append(seed)
        is_bad = seed in (0, nth_seed(0, 1))
        luma = np.stack([clip[0]] * 8) if is_bad else clip[:8]
        images = np.repeat(luma[..., None], 3, axis=3)
        return write_video(
            images / np.float32(255),
            tmp_path / f"{seed}.avi",
            Fraction(8),
            {"seed": seed},
            overwrite=True,
        )

    make_video.asked = asked
    return make_video


def test_retrying_takes_the_first_seed_that_passes(make):
    told = Told()
    config = GeneratedVideoConfig(on_failure="retry", retries=3)
    video = generate_checked(make, config, prompt="a pan", seed=0, progress=told)
    assert make.asked == [0, nth_seed(0, 1), nth_seed(0, 2)]
    assert video.metadata["seed"] == nth_seed(0, 2)
    assert video.metadata["check"]["problems"] == []
    assert len(told.lines) == 2


def test_a_missing_clip_model_is_named_before_anything_is_generated(make, tmp_path):
    config = GeneratedVideoConfig(agreement_model=tmp_path / "none")
    with pytest.raises(InputError, match=r"there is no CLIP model in .*none"):
        generate_checked(make, config, prompt="a pan", seed=0, progress=Told())
    assert make.asked == []


def test_retrying_gives_up_after_the_last_seed(make):
    config = GeneratedVideoConfig(on_failure="retry", retries=1)
    with pytest.raises(TexventError, match="all 2 videos, each of another seed, failed"):
        generate_checked(make, config, prompt="a pan", seed=0, progress=Told())


def test_rejecting_warning_and_ignoring(make):
    told = Told()
    with pytest.raises(TexventError, match=r"failed the check .*frozen, no motion"):
        generate_checked(
            make, GeneratedVideoConfig(on_failure="reject"), prompt="a pan", seed=0, progress=told
        )
    warned = generate_checked(
        make, GeneratedVideoConfig(on_failure="warn"), prompt="a pan", seed=0, progress=told
    )
    assert warned.metadata["check"]["problems"] == ["frozen", "no motion"]
    assert told.lines[-1] == "warning: the generated video looks failed: frozen, no motion"
    ignored = generate_checked(
        make, GeneratedVideoConfig(on_failure="ignore"), prompt="a pan", seed=0, progress=told
    )
    assert "check" not in ignored.metadata
