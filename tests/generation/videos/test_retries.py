"""Videos that fail the checks are refused, reported, or made again with another seed."""

from fractions import Fraction

import numpy as np
import pytest

from texvent.errors import TexventError
from texvent.generation.video_models.config import GeneratedVideoConfig
from texvent.generation.videos.retries import RETRIES, generate_checked, nth_seed
from texvent.generation.videos.stored_video import write_video

from ..watcher import Watcher


@pytest.fixture
def clip():
    """8 frames of a pan over a textured image: [N, H, W], 0..255."""
    rng = np.random.default_rng(3)
    ground = np.kron(rng.uniform(20, 235, (12, 20)), np.ones((8, 8)))
    return np.stack([ground[:, 2 * i : 2 * i + 128] for i in range(8)]).astype(np.float32)


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
    told = Watcher()
    config = GeneratedVideoConfig(on_failure="retry")
    video = generate_checked(make, config, seed=0, progress=told)
    assert make.asked == [0, nth_seed(0, 1), nth_seed(0, 2)]
    assert video.metadata["seed"] == nth_seed(0, 2)
    assert video.metadata["check"]["problems"] == []
    assert len(told.lines) == 2


def test_the_last_of_the_further_seeds_may_pass_and_no_more_are_tried(make):
    config = GeneratedVideoConfig(on_failure="retry")
    seeds = [nth_seed(0, one) for one in range(RETRIES + 1)]
    for last, is_fine in ((seeds[-1], True), (None, False)):
        make.asked.clear()

        def fault(video, last=last):
            return None if video.metadata["seed"] == last else "a fault"

        if is_fine:
            video = generate_checked(make, config, seed=0, progress=None, find_fault=fault)
            assert video.metadata["seed"] == last
        else:
            with pytest.raises(TexventError, match=f"all {RETRIES + 1} videos"):
                generate_checked(make, config, seed=0, progress=None, find_fault=fault)
        assert make.asked == seeds


def test_rejecting_warning_and_ignoring(make):
    told = Watcher()
    with pytest.raises(TexventError, match=r"failed the check .*frozen, no motion"):
        generate_checked(make, GeneratedVideoConfig(on_failure="reject"), seed=0, progress=told)
    warned = generate_checked(make, GeneratedVideoConfig(on_failure="warn"), seed=0, progress=told)
    assert warned.metadata["check"]["problems"] == ["frozen", "no motion"]
    assert told.lines[-1] == "warning: the generated video looks failed: frozen, no motion"
    ignored = generate_checked(
        make, GeneratedVideoConfig(on_failure="ignore"), seed=0, progress=told
    )
    assert "check" not in ignored.metadata
